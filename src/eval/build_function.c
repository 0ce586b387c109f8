#include "eval/build.h"

bool build_function_pattern(struct eval *e, const struct ast *block, struct pattern *p)
{
    (void)p;
    diag_at(e->diags, DIAG_NOT_BUILT, block->where, "function");
    return false;
}
