#ifndef BASE_WATCH_H
#define BASE_WATCH_H

#include <stdbool.h>
#include <stddef.h>

// Who waits for a solution: may end it, and hears how far it is. Without one (NULL)
// nobody does. After a cancel what is computed is worth nothing but safe to free.
struct watch {
    const volatile bool *cancel;                // NULL: never
    void (*progress)(void *user, double share); // NULL: nobody listens; 0 to 1, rising
    void *user;
    double from, to; // part of the whole that the work in hand is
    double told;
};

static inline bool watch_cancelled(const struct watch *w)
{
    return w && w->cancel && *w->cancel;
}
// The work from now on is the part [from, to] of the whole.
static inline void watch_part(struct watch *w, double from, double to)
{
    if (!w)
        return;
    w->from = from;
    w->to = to;
}
// How much of that part is done. Only from the thread that began the whole.
static inline void watch_tell(struct watch *w, double share)
{
    if (!w || !w->progress)
        return;
    const double whole = w->from + share * (w->to - w->from);
    if (whole <= w->told)
        return;
    w->told = whole;
    w->progress(w->user, whole);
}

#endif
