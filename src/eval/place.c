// Places that assignments, references and subscripts mean.

#include <math.h>

#include "eval/array.h"
#include "eval/expr.h"
#include "eval/symbol.h"

bool eval_index(struct eval *e, struct place base, const struct ast *index,
                struct span where, struct place *out)
{
    const struct array_value *a = base.array;
    uint64_t flat = 0;
    for (uint32_t i = 0; i < a->dimensions; i++, index = index->next) {
        double v;
        if (!index) {
            diag_at(e->diags, DIAG_SUBSCRIPTS, where, "too few subscripts");
            return false;
        }
        if (!eval_float(e, index, &v))
            return false;
        v += INDEX_SLACK;
        if (!(v >= 0 && v < a->size[i])) {
            diag_at(e->diags, DIAG_SUBSCRIPT_RANGE, index->where,
                    (long)number_to_int(floor(v)), (unsigned)a->size[i]);
            return false;
        }
        v = number_to_int(v);
        flat = flat * a->size[i] + (uint32_t)v;
    }
    *out = (struct place){.array = base.array, .index = (uint32_t)flat};
    return true;
}

struct place eval_place(struct eval *e, const struct lvalue *to, uint32_t depth)
{
    struct place none = {0};
    struct place p = symbols_find(e->symbols, to->name, to->len, depth);
    for (const struct ast *index = to->index; index && place_found(p);) {
        const struct value *v = place_get(e->nodes, p);
        if (!v || v->kind != VALUE_ARRAY) {
            diag_at(e->diags, DIAG_SUBSCRIPTS, to->where, "this is no array");
            return none;
        }
        struct place whole = {.array = v->array};
        if (!eval_index(e, whole, index, to->where, &p))
            return none;
        for (uint32_t i = 0; i < v->array->dimensions; i++)
            index = index->next;
    }
    return p;
}
