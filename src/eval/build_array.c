// `array [sizes] { elements }`.

#include "base/arena.h"
#include "eval/array.h"
#include "eval/expr.h"
#include "lang/bulk.h"

static bool fill_array(struct eval *e, struct array_value *a, const struct ast *entry,
                       uint32_t dimension, uint32_t *next)
{
    uint32_t count = 0;
    for (const struct ast *n = entry->list; n; n = n->next, count++) {
        if (count >= a->size[dimension])
            break;
        if (dimension + 1 < a->dimensions) {
            if (n->kind != AST_ENTRY) {
                diag_at(e->diags, DIAG_INITIALISERS, n->where, a->size[dimension]);
                return false;
            }
            if (!fill_array(e, a, n, dimension + 1, next))
                return false;
            continue;
        }
        struct ast alone = *n;
        alone.next = NULL;
        bool several = n->kind == AST_BLOCK && n->word == WORD_NONE;
        const struct value *v = eval_rvalue(e, several ? n->list : &alone);
        if (!v)
            return false;
        if (!array_set(e->arena, a, (*next)++, v)) {
            diag_at(e->diags, DIAG_ELEMENT_KIND, n->where, value_kind_name(v));
            return false;
        }
    }
    uint32_t given = 0;
    for (const struct ast *n = entry->list; n; n = n->next)
        given++;
    if (given != a->size[dimension])
        diag_at(e->diags, DIAG_INITIALISERS, entry->where, a->size[dimension]);
    return given == a->size[dimension];
}

// Elements that were read as one token.
static bool fill_whole(struct eval *e, struct array_value *a, const struct ast *entry)
{
    const struct bulk *b = entry->list->bulk;
    for (uint32_t i = 0; i < a->dimensions; i++)
        if (i >= b->dimensions || b->size[i] != a->size[i]) {
            diag_at(e->diags, DIAG_INITIALISERS, entry->where, a->size[i]);
            return false;
        }
    if (b->dimensions > a->dimensions) {
        diag_at(e->diags, DIAG_EXPECTED_NUMBER, entry->where, "braces");
        return false;
    }
    array_fill(e->arena, a, b->number, (uint8_t)b->width);
    return true;
}

static bool fill(struct eval *e, struct array_value *a, const struct ast *entry)
{
    uint32_t next = 0;
    return entry->list && entry->list->kind == AST_BULK
               ? fill_whole(e, a, entry)
               : fill_array(e, a, entry, 0, &next);
}

// Pointers or numbers come with the first element; a size may be a slip of the pen.
static bool array_fits(struct eval *e, struct span where, uint32_t dimensions,
                       const long *size)
{
    double bytes = sizeof(double) + sizeof(bool);
    for (uint32_t i = 0; i < dimensions; i++)
        bytes *= (double)size[i];
    const size_t most = e->options->memory_max;
    return !most || bytes <= 0 ||
           eval_has_memory(e, where, bytes < (double)most ? (size_t)bytes : most);
}

const struct value *eval_array(struct eval *e, const struct ast *sizes,
                               const struct ast *elements)
{
    long size[ARRAY_DIMENSIONS_MAX];
    uint32_t dimensions = 0;
    for (const struct ast *n = sizes; n; n = n->next) {
        double v;
        if (dimensions == ARRAY_DIMENSIONS_MAX) {
            diag_at(e->diags, DIAG_SUBSCRIPTS, n->where, "more than 5 dimensions");
            return NULL;
        }
        if (!eval_float(e, n, &v))
            return NULL;
        size[dimensions++] = (long)number_to_int(v + INDEX_SLACK);
    }
    if (!array_fits(e, sizes->where, dimensions, size))
        return NULL;
    struct array_value *a = array_new(e->arena, dimensions, size);
    if (!a) {
        diag_at(e->diags, DIAG_ARRAY_SIZE, sizes->where, "");
        return NULL;
    }
    if (elements && !fill(e, a, elements))
        return NULL;
    struct value *v = arena_new_struct(e->arena, struct value);
    v->kind = VALUE_ARRAY;
    v->array = a;
    return v;
}
