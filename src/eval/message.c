// What a scene says: #debug, #warning and so on, and warnings of deprecated names.

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "eval/expr.h"

static void tell(struct eval *e, enum word directive, const char *text)
{
    if (e->options->message)
        e->options->message(e->options->message_user, directive, text);
    else
        fputs(text, stderr);
}

// Whole lines are shown; what the scene leaves without a line end never is.
static void tell_lines(struct eval *e, enum word directive, const char *text)
{
    char **kept = &e->line[directive == WORD_debug    ? 0
                           : directive == WORD_render ? 1
                                                      : 2];
    const char *end = strrchr(text, '\n');
    size_t old = *kept ? strlen(*kept) : 0, len = strlen(text);
    char *all = must_malloc(old + len + 1, 1);
    if (old)
        memcpy(all, *kept, old);
    memcpy(all + old, text, len + 1);
    free(*kept);
    *kept = all;
    if (!end)
        return;
    size_t whole = old + (size_t)(end + 1 - text);
    *kept = strdup(all + whole);
    all[whole] = 0;
    tell(e, directive, all);
    free(all);
}

// Without the line ends that a scene puts after its messages.
static const char *one_line(struct eval *e, const char *text)
{
    size_t len = strlen(text);
    while (len && text[len - 1] == '\n')
        len--;
    return arena_strndup(e->parse, text, len);
}

bool eval_message(void *user, enum word directive, struct span where, const char *text)
{
    struct eval *e = user;
    if (directive == WORD_warning) {
        diag_at(e->diags, DIAG_SCENE_WARNING, where, one_line(e, text));
        return true;
    }
    if (directive == WORD_error) {
        diag_at(e->diags, DIAG_SCENE_ERROR, where, one_line(e, text));
        e->diags->errors_max = e->diags->errors; // nothing is read after it
        return false;
    }
    tell_lines(e, directive, text);
    return true;
}

// `#declare deprecated NAME`, until it has been said.
struct deprecation {
    struct deprecation *next;
    const char *name, *text; // text: what to say; NULL: the standard
};

void eval_deprecate(struct eval *e, const struct lvalue *to)
{
    struct deprecation *d = arena_new_struct(e->arena, struct deprecation);
    d->next = e->deprecations;
    d->name = arena_strndup(e->arena, to->name, to->len);
    if (to->deprecated_text && eval_string(e, to->deprecated_text, &d->text))
        d->text = arena_strndup(e->arena, d->text, strlen(d->text));
    e->deprecations = d;
}

void eval_deprecated(void *user, const char *name, size_t len, struct span where)
{
    struct eval *e = user;
    for (struct deprecation **at = &e->deprecations; *at; at = &(*at)->next) {
        const struct deprecation *d = *at;
        if (strlen(d->name) != len || memcmp(d->name, name, len))
            continue;
        *at = d->next;
        if (d->text)
            diag_at(e->diags, DIAG_SCENE_WARNING, where, d->text);
        else
            diag_at(e->diags, DIAG_DEPRECATED, where, d->name);
        return;
    }
}
