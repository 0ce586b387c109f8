// Whether two functions are one.
#include "scene/tape_steps.h"

#include <string.h>

static bool is_equal_step(const struct tape_step *s, const struct tape_step *r)
{
    const bool same = s->op == r->op && s->to == r->to && s->a == r->a && s->b == r->b &&
                      s->c == r->c && s->d == r->d && s->list == r->list &&
                      s->count == r->count && s->data == r->data;
    if (!same || s->callee == r->callee)
        return same;
    return s->op != TAPE_EXTERN && tape_equal(s->callee, r->callee);
}

static uint32_t listed(const struct tape *t)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < t->step_count; i++)
        count += t->step[i].count;
    return count;
}

bool tape_equal(const struct tape *t, const struct tape *u)
{
    if (t == u)
        return true;
    if (t->step_count != u->step_count || t->constant_count != u->constant_count ||
        t->arguments != u->arguments || t->width != u->width)
        return false;
    for (int i = 0; i < t->width; i++)
        if (t->result[i] != u->result[i])
            return false;
    // As bits: -0 is another number than 0.
    if (t->constant_count &&
        memcmp(t->constant, u->constant, t->constant_count * sizeof *t->constant) != 0)
        return false;
    for (uint32_t i = 0; i < t->step_count; i++)
        if (!is_equal_step(&t->step[i], &u->step[i]))
            return false;
    const uint32_t count = listed(t);
    return !count || memcmp(t->list, u->list, count * sizeof *t->list) == 0;
}
