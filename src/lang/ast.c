#include "lang/ast.h"

#include <string.h>

#include "base/arena.h"

struct ast *ast_new(struct arena *a, enum ast_kind kind, struct span where)
{
    struct ast *n = arena_new_struct(a, struct ast);
    n->kind = kind;
    n->where = where;
    return n;
}

struct ast_list ast_append(struct ast_list list, struct ast *node)
{
    if (list.last)
        list.last->next = node;
    else
        list.first = node;
    list.last = node;
    list.count++;
    return list;
}

int ast_count(const struct ast *first)
{
    int count = 0;
    for (; first; first = first->next)
        count++;
    return count;
}

static struct ast *copy_list(struct arena *a, const struct ast *n)
{
    struct ast_list list = {0};
    for (; n; n = n->next)
        list = ast_append(list, ast_copy(a, n));
    return list.first;
}

struct ast *ast_copy(struct arena *a, const struct ast *node)
{
    if (!node)
        return NULL;
    struct ast *n = arena_new_struct(a, struct ast);
    *n = *node;
    n->next = NULL;
    switch (node->kind) {
    case AST_UNARY:
    case AST_MEMBER: n->left = ast_copy(a, node->left); break;
    case AST_VECTOR3: {
        double *v = arena_new_array(a, double, 3);
        memcpy(v, node->vector, 3 * sizeof *v);
        n->vector = v;
        break;
    }
    case AST_BINARY:
        n->left = ast_copy(a, node->left);
        n->right = ast_copy(a, node->right);
        break;
    default: n->list = copy_list(a, node->list);
    }
    return n;
}

static const char *op_text(uint16_t op, char buffer[2])
{
    if (op == OP_LE)
        return "<=";
    if (op == OP_GE)
        return ">=";
    if (op == OP_NE)
        return "!=";
    buffer[0] = (char)op;
    buffer[1] = 0;
    return buffer;
}

static void print_head(const struct ast *n, FILE *out)
{
    char buffer[2];
    static const char *const kinds[] = {
        [AST_NUMBER] = "number",
        [AST_STRING] = "string",
        [AST_VALUE] = "value",
        [AST_UNDECLARED] = "undeclared",
        [AST_WORD] = "word",
        [AST_CONSTANT] = "constant",
        [AST_VECTOR] = "vector",
        [AST_VECTOR3] = "vector",
        [AST_BULK] = "vectors",
        [AST_FACES] = "faces",
        [AST_UNARY] = "unary",
        [AST_BINARY] = "binary",
        [AST_CONDITIONAL] = "conditional",
        [AST_MEMBER] = "member",
        [AST_CALL] = "call",
        [AST_APPLY] = "apply",
        [AST_INDEX] = "index",
        [AST_BLOCK] = "block",
        [AST_ENTRY] = "entry",
    };
    fputs(kinds[n->kind], out);
    switch (n->kind) {
    case AST_NUMBER: fprintf(out, " %.17g", n->number); break;
    case AST_STRING: fprintf(out, " \"%.*s\"", (int)n->len, n->text); break;
    case AST_VALUE:
    case AST_UNDECLARED:
    case AST_APPLY:
    case AST_INDEX:
        if (n->len)
            fprintf(out, " %.*s", (int)n->len, n->text);
        break;
    case AST_WORD:
    case AST_CONSTANT:
    case AST_MEMBER:
    case AST_CALL:
    case AST_BLOCK: fprintf(out, " %s", word_text((enum word)n->word)); break;
    case AST_UNARY:
    case AST_BINARY: fprintf(out, " %s", op_text(n->op, buffer)); break;
    case AST_VECTOR3:
        fprintf(out, " %.17g %.17g %.17g", n->vector[0], n->vector[1], n->vector[2]);
        break;
    case AST_BULK:
    case AST_FACES:
    case AST_VECTOR:
    case AST_CONDITIONAL:
    case AST_ENTRY: break;
    }
    if (n->comma_after)
        fputs(" ,", out);
    fputc('\n', out);
}

void ast_print(const struct ast *n, FILE *out, int indent)
{
    fprintf(out, "%*s", indent, "");
    print_head(n, out);
    indent += 2;
    if (n->kind == AST_UNARY || n->kind == AST_MEMBER || n->kind == AST_BINARY)
        ast_print(n->left, out, indent);
    if (n->kind == AST_BINARY)
        ast_print(n->right, out, indent);
    else if (n->kind != AST_UNARY && n->kind != AST_MEMBER)
        for (const struct ast *c = n->list; c; c = c->next)
            ast_print(c, out, indent);
}
