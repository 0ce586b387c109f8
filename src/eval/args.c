#include "eval/build.h"

#include <string.h>

#include "eval/expr.h"
#include "eval/function.h"
#include "eval/include_hint.h"
#include "lang/bulk.h"

// The readers that shapes use (scene/args.h). Numbers and vectors written out are
// taken straight from the AST: a mesh has millions of them.

// A sign that was meant to begin the value that is missing is taken for a sum with the one
// before: y -1.
static const char *joined_hint(const struct args *a)
{
    if (!a->last)
        return NULL;
    const struct span where = a->last->where;
    const char *text = a->b->e->sources->file[where.file]->text;
    int depth = 0;
    for (uint32_t i = where.begin; i + 1 < where.end; i++) {
        depth += text[i] == '<' || text[i] == '(';
        depth -= text[i] == '>' || text[i] == ')';
        if (depth == 0 && i > where.begin && (text[i] == '-' || text[i] == '+') &&
            text[i - 1] == ' ' && text[i + 1] != ' ')
            return "a ',' before a sign keeps what is in front of it apart";
    }
    return NULL;
}

// Names of types of picture files that only their extensions have, and all other names.
static const char *name_hint(struct args *a, const struct ast *n)
{
    if (strncmp(a->name, "image", 5) == 0 && n->len == 3 &&
        memcmp(n->text, "jpg", 3) == 0)
        return "did you mean 'jpeg'?";
    if (strncmp(a->name, "image", 5) == 0 && n->len == 3 &&
        memcmp(n->text, "tif", 3) == 0)
        return "did you mean 'tiff'?";
    return undeclared_hint(a->b->e, n->text, n->len, UNDECLARED_VALUE, NULL);
}

bool args_expected(struct args *a, const char *role, const char *type)
{
    const struct ast *n = a->at;
    if (n && n->kind == AST_VALUE && !n->value)
        args_next(a); // already reported
    else if (n && n->kind == AST_UNDECLARED)
        diag_hint(args_diags(a), DIAG_UNKNOWN_NAME, args_span(a), name_hint(a, n),
                  arena_strndup(a->b->e->parse, n->text, n->len), a->name);
    else
        diag_hint(args_diags(a), DIAG_EXPECTED_ARG, args_span(a), joined_hint(a), a->name,
                  role, type);
    args_fail(a);
    return false;
}

static const struct ast *number_item(struct args *a, const char *role, const char *type)
{
    if (a->at && ast_is_number(a->at))
        return args_next(a);
    double unused;
    if (a->at && a->at->kind == AST_UNDECLARED) { // says so, with the closest name
        eval_float(a->b->e, args_next(a), &unused);
        args_fail(a);
        return NULL;
    }
    args_expected(a, role, type);
    return NULL;
}

static bool checked(struct args *a, bool ok)
{
    if (!ok)
        args_fail(a);
    return ok;
}

bool args_float(struct args *a, const char *role, double *out)
{
    const struct ast *n = number_item(a, role, "float");
    if (!n)
        return false;
    if (n->kind == AST_NUMBER) {
        *out = n->number;
        return true;
    }
    return checked(a, eval_float(a->b->e, n, out));
}

bool args_int(struct args *a, const char *role, long *out)
{
    const struct span where = args_span(a);
    double v;
    if (!args_float(a, role, &v))
        return false;
    if (!(v > -2147483649.0 && v < 2147483648.0)) {
        args_error(a, where, "value is too large for an integer");
        return false;
    }
    *out = (long)v;
    return true;
}

// The components of a vector of n plain numbers (a sign is allowed).
static bool literal_vector(const struct ast *n, double *out, size_t count)
{
    if (n->kind == AST_VECTOR3 && count == 3) {
        memcpy(out, n->vector, 3 * sizeof *out);
        return true;
    }
    if (n->kind != AST_VECTOR)
        return false;
    const struct ast *c = n->list;
    for (size_t i = 0; i < count; i++, c = c->next) {
        if (!c)
            return false;
        if (c->kind == AST_NUMBER)
            out[i] = c->number;
        else if (c->kind == AST_UNARY && c->op == '-' && c->left->kind == AST_NUMBER)
            out[i] = -c->left->number;
        else
            return false;
    }
    return !c;
}

bool args_vec2(struct args *a, const char *role, struct vec2 *out)
{
    double v[2];
    const struct ast *n = number_item(a, role, "uv vector");
    if (!n)
        return false;
    if (literal_vector(n, v, 2)) {
        *out = (struct vec2){v[0], v[1]};
        return true;
    }
    return checked(a, eval_vec2(a->b->e, n, out));
}

bool args_vec3(struct args *a, const char *role, struct vec3 *out)
{
    double v[3];
    const struct ast *n = number_item(a, role, "vector");
    if (!n)
        return false;
    if (literal_vector(n, v, 3)) {
        *out = vec3(v[0], v[1], v[2]);
        return true;
    }
    return checked(a, eval_vec3(a->b->e, n, out));
}

bool args_vec4(struct args *a, const char *role, double out[4])
{
    const struct ast *n = number_item(a, role, "4-D vector");
    return n && checked(a, eval_vec4(a->b->e, n, out));
}

bool args_string(struct args *a, const char *role, const char **out)
{
    const struct ast *n = a->at;
    bool text =
        n && (n->kind == AST_STRING || n->kind == AST_CALL ||
              (n->kind == AST_VALUE && n->value && n->value->kind == VALUE_STRING));
    if (!text)
        return args_expected(a, role, "string");
    args_next(a);
    if (!checked(a, eval_string(a->b->e, n, out)))
        return false;
    *out = arena_strndup(a->b->arena, *out, strlen(*out));
    return true;
}

bool args_floats(struct args *a, const char *role, double *out, size_t n)
{
    const struct ast *v = a->at;
    size_t count = 0;
    bool three = v && v->kind == AST_VECTOR3;
    if (!v || (v->kind != AST_VECTOR && !three))
        return args_expected(a, role, "list of numbers in < >");
    if (three)
        count = 3;
    for (const struct ast *c = v->list; c; c = c->next)
        count++;
    if (count != n) {
        char want[48];
        snprintf(want, sizeof want, "%zu numbers in < >, not %zu", n, count);
        return args_expected(a, role, want);
    }
    args_next(a);
    if (three)
        memcpy(out, v->vector, 3 * sizeof *out);
    for (const struct ast *c = v->list; c; c = c->next, out++)
        if (!checked(a, eval_float(a->b->e, c, out)))
            return false;
    return true;
}

bool args_vectors(struct args *a, struct args_vectors *out)
{
    if (!a->at || a->at->kind != AST_BULK)
        return false;
    const struct bulk *b = args_next(a)->bulk;
    *out = (struct args_vectors){b->count, b->width, b->number, b->index};
    return true;
}

struct mesh_soup *args_faces(struct args *a)
{
    return a->at && a->at->kind == AST_FACES ? args_next(a)->faces : NULL;
}

bool args_at_number(struct args *a) { return a->at && ast_is_number(a->at); }

bool args_at_vector(struct args *a)
{
    const struct ast *n = a->at;
    double v[5];
    int width;
    if (!n || !ast_is_number(n))
        return false;
    if (n->kind == AST_NUMBER || n->kind == AST_VECTOR || n->kind == AST_VECTOR3)
        return n->kind != AST_NUMBER;
    return eval_number(a->b->e, n, 1, v, &width) && width > 1;
}

bool args_word(struct args *a, const char *word)
{
    enum word w = args_at_word(a);
    if (w == WORD_NONE || strcmp(word_text(w), word) != 0)
        return false;
    args_next(a);
    return true;
}

struct args *args_block(struct args *a, const char *word)
{
    enum word w = args_at_block(a);
    if (w == WORD_NONE || strcmp(word_text(w), word) != 0)
        return NULL;
    struct args *inner = arena_new_struct(a->b->e->nodes, struct args);
    *inner = args_of(a->b, args_next(a), a);
    return inner;
}

struct args *args_call(struct args *a, const char *word)
{
    const struct ast *n = a->at;
    if (!n || n->kind != AST_CALL || strcmp(word_text((enum word)n->word), word) != 0)
        return NULL;
    struct args *inner = arena_new_struct(a->b->e->nodes, struct args);
    *inner = args_of(a->b, args_next(a), a);
    return inner;
}

const struct texture *args_texture(struct args *a)
{
    const struct value *v = args_take_value(a, VALUE_TEXTURE);
    if (v)
        return v->data;
    return args_at_block(a) == WORD_texture ? build_texture(a, args_next(a)) : NULL;
}

bool args_at_texture(struct args *a)
{
    return args_at_value(a, VALUE_TEXTURE) || args_at_block(a) == WORD_texture;
}

const struct tape *args_function(struct args *a, const char *role)
{
    if (args_at_block(a) != WORD_function) {
        args_expected(a, role, "function { } block");
        return NULL;
    }
    const struct tape *t = function_expression(a->b->e, args_next(a));
    if (!t)
        args_fail(a);
    return t;
}

bool args_end(struct args *a)
{
    const struct ast *n = a->at;
    return !n || n->kind == AST_BLOCK || n->kind == AST_WORD;
}

bool args_pov_patches(struct args *a) { return a->b->e->options->pov_patches; }

struct arena *args_arena(struct args *a) { return a->b->arena; }

void **args_shared(struct args *a) { return &a->b->shared[a->owner->word]; }

struct diag_sink *args_diags(struct args *a) { return a->b->e->diags; }

struct span args_where(struct args *a) { return args_span(a); }

const char *args_owner(struct args *a) { return a->name; }

void args_reject(struct args *a, const char *message)
{
    args_error(a, a->owner ? a->owner->where : args_span(a), message);
}

void args_warn(struct args *a, const char *message)
{
    args_warning(a, a->owner ? a->owner->where : args_span(a), message);
}

static bool find_name(struct args *a, const char *name, const char **path)
{
    *path = file_find(a->b->e, name, NULL);
    return *path;
}

bool args_look_for_file(struct args *a, const char *name, const char **path)
{
    return find_name(a, name, path);
}

bool args_find_file(struct args *a, const char *role, const char *name,
                    const char *extension, const char **path)
{
    const char *slash = strrchr(name, '/'), *dot = strrchr(name, '.');
    if (find_name(a, name, path))
        return true;
    if (extension && (!dot || (slash && dot < slash))) {
        const char *sign = extension[0] == '.' ? "" : ".";
        if (find_name(a, arena_printf(a->b->arena, "%s%s%s", name, sign, extension),
                      path))
            return true;
    }
    const struct ast *at = a->owner->list;
    while (at && !(at->kind == AST_STRING && at->len == strlen(name) &&
                   memcmp(at->text, name, at->len) == 0))
        at = at->next;
    diag_hint(args_diags(a), DIAG_NO_FILE, (at ? at : a->owner)->where,
              file_hint(a->b->e), a->name, role, name);
    args_fail(a);
    return false;
}
