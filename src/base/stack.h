#ifndef BASE_STACK_H
#define BASE_STACK_H

// Runs fn(user) to its end on a thread with a stack large enough for the deepest nesting
// that the limits of the language allow, whatever the caller's stack is. Memory is used
// only as deep as the calls go. On this thread when it was started so and little of its stack
// is used, and when the system refuses another.
void stack_run(void (*fn)(void *user), void *user);
// The same on another thread always, while this one runs meanwhile(user), which is not called
// when the system refuses the thread. NULL: it waits.
void stack_run_beside(void (*fn)(void *user), void (*meanwhile)(void *user), void *user);

#endif
