// A tape as an expression of the scene language (tape.h).
#include "scene/shape.h"
#include "scene/tape_steps.h"

enum { NODES_PRINTED = 4000 }; // shared ones as often as they are read

struct printer {
    const struct tape *t;
    FILE *out;
    int left;
};

static const char *const words[] = {
    [TAPE_ABS] = "abs",     [TAPE_FLOOR] = "floor",   [TAPE_CEIL] = "ceil",
    [TAPE_INTEGER] = "int", [TAPE_SQRT] = "sqrt",     [TAPE_EXP] = "exp",
    [TAPE_LOG] = "ln",      [TAPE_LOG10] = "log",     [TAPE_SIN] = "sin",
    [TAPE_COS] = "cos",     [TAPE_TAN] = "tan",       [TAPE_ASIN] = "asin",
    [TAPE_ACOS] = "acos",   [TAPE_ATAN] = "atan",     [TAPE_SINH] = "sinh",
    [TAPE_COSH] = "cosh",   [TAPE_TANH] = "tanh",     [TAPE_ASINH] = "asinh",
    [TAPE_ACOSH] = "acosh", [TAPE_ATANH] = "atanh",   [TAPE_MIN] = "min",
    [TAPE_MAX] = "max",     [TAPE_MOD] = "mod",       [TAPE_ATAN2] = "atan2",
    [TAPE_POW] = "pow",     [TAPE_SELECT] = "select",
};
static const char *const signs[] = {
    [TAPE_ADD] = "+",         [TAPE_SUBTRACT] = "-",
    [TAPE_MULTIPLY] = "*",    [TAPE_DIVIDE] = "/",
    [TAPE_LESS] = "<",        [TAPE_GREATER] = ">",
    [TAPE_EQUAL] = "=",       [TAPE_NOT_EQUAL] = "!=",
    [TAPE_LESS_EQUAL] = "<=", [TAPE_GREATER_EQUAL] = ">=",
    [TAPE_AND] = "&",         [TAPE_OR] = "|",
};

static void node(struct printer *p, uint32_t id);

static void list(struct printer *p, const uint32_t *arg, int n, const char *between)
{
    fputc('(', p->out);
    for (int i = 0; i < n; i++) {
        fputs(i ? between : "", p->out);
        node(p, arg[i]);
    }
    fputc(')', p->out);
}

static void number(struct printer *p, double v)
{
    fputs(v < 0 ? "(" : "", p->out);
    shape_print_number(p->out, v);
    fputs(v < 0 ? ")" : "", p->out);
}

static void node(struct printer *p, uint32_t id)
{
    const struct tape_node *n = &p->t->node[id];
    if (p->left-- <= 0) {
        fputs("/* longer than is printed */ 0", p->out);
        return;
    }
    switch ((enum tape_op)n->op) {
    case TAPE_CONSTANT: number(p, n->k); break;
    case TAPE_ARGUMENT: fputc("xyz"[(int)n->k], p -> out); break;
    case TAPE_NEGATE:
        fputs("(-", p->out);
        list(p, n->arg, 1, "");
        fputs(")", p->out);
        break;
    case TAPE_SQUARE: list(p, (const uint32_t[]){n->arg[0], n->arg[0]}, 2, " * "); break;
    case TAPE_EXTERN:
    case TAPE_CALL:
    case TAPE_SUM:
    case TAPE_PRODUCT:
        fprintf(p->out, "/* %s */ 0",
                n->op == TAPE_EXTERN ? ((const struct tape_extern *)n->callee)->name
                                     : "called function");
        break;
    case TAPE_LENGTH:
        fputs("sqrt", p->out);
        list(p, n->arg, 1, "");
        break;
    default:
        if (n->op < sizeof signs / sizeof *signs && signs[n->op]) {
            char sign[8];
            snprintf(sign, sizeof sign, " %s ", signs[n->op]);
            list(p, n->arg, 2, sign);
            break;
        }
        fputs(words[n->op], p->out);
        list(p, n->arg, (int)tape_operands(n), ", ");
    }
}

void tape_print(const struct tape *t, FILE *out)
{
    struct printer p = {t, out, NODES_PRINTED};
    node(&p, t->node_result[0]);
}
