#ifndef BASE_STACK_H
#define BASE_STACK_H

// Runs fn(user) to its end on a thread with a stack large enough for the deepest nesting
// that the limits of the language allow, whatever the caller's stack is. Memory is used
// only as deep as the calls go. When the system refuses the thread, on this one.
void stack_run(void (*fn)(void *user), void *user);

#endif
