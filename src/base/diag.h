#ifndef BASE_DIAG_H
#define BASE_DIAG_H

#include <stdbool.h>
#include <stdio.h>

#include "base/source.h"

enum severity { SEV_NOTE, SEV_WARNING, SEV_ERROR };

// One row per message the program can give; a number is never reused.
enum diag_code {
#define DIAG(name, number, severity, text) DIAG_##name = number,
#include "base/diagnostics.def"
#undef DIAG
};

struct diag {
    enum diag_code code;
    enum severity severity;
    struct span where;   // what the caret underlines; end == 0: no place
    struct span related; // end == 0, or a second place ("declared here")
    const char *message;
    const char *hint; // NULL, or what to do: "did you mean 'pigment'?"
};

enum {
    DIAG_REPEATS_MAX = 1000
}; // of errors already said: then a loop is not worth its end

// Stages report here and go on; the caller decides whether to stop. A sink is
// owned by one context, so two contexts never share messages.
struct diag_sink {
    void (*emit)(void *user, const struct diag *d);
    void *user;
    unsigned errors, warnings;
    unsigned errors_max; // 0: no limit. Stages stop when errors reach it
    // What was said last: loops fail at the same place again, and a calculation that fails
    // is evaluated again.
    struct {
        enum diag_code code;
        struct span where;
    } recent[32];
    unsigned recent_at;
    unsigned repeats; // errors that were left out
};

static inline bool diag_full(const struct diag_sink *s)
{
    return s->errors_max &&
           (s->errors >= s->errors_max || s->repeats >= DIAG_REPEATS_MAX);
}

// `hint` and `related` may be NULL. The variadic part fills the row's format.
void diag_report(struct diag_sink *sink, enum diag_code code, struct span where,
                 const struct span *related, const char *hint, ...);

#define diag_at(sink, code, where, ...)                                                  \
    diag_report((sink), (code), (where), NULL, NULL, __VA_ARGS__)
#define diag_hint(sink, code, where, hint, ...)                                          \
    diag_report((sink), (code), (where), NULL, (hint), __VA_ARGS__)

// How messages look. TEXT: with source line, caret and call stack. GCC: one
// line each. JSON: one object a line. POV: POV-Ray's own wording of places.
enum diag_style { DIAG_TEXT, DIAG_GCC, DIAG_JSON, DIAG_POV };

void diag_print(FILE *out, const struct source_map *m, const struct diag *d,
                enum diag_style style, bool color);

// The word of `list` (count entries) closest to `word` by edit distance, or
// NULL when none is close enough to be a likely slip of the finger.
const char *diag_closest(const char *word, size_t len, const char *const *list,
                         size_t count);

#endif
