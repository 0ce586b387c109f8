#include "eval/build.h"
#include "eval/function.h"

// The pattern `function { }`: an expression in x, y, z.
bool build_function_pattern(struct eval *e, const struct ast *block, struct pattern *p)
{
    const struct value *v = function_value(e, block);
    if (!v)
        return false;
    const struct function *f = v->data;
    if (function_parameters(f) != 3 || function_width(f) != 1) {
        diag_at(e->diags, DIAG_FUNCTION_ITEM, block->where, "a parameter list or a vector");
        return false;
    }
    p->function = function_at;
    p->function_data = f;
    return true;
}
