// The callbacks of the directive stream: names, assignments, scopes, includes
// (spec/language 3).

#include <string.h>

#include "base/arena.h"
#include "eval/array.h"
#include "eval/builder.h"
#include "eval/calc.h"
#include "eval/expr.h"
#include "eval/include_hint.h"
#include "eval/symbol.h"
#include "eval/text.h"
#include "lang/bulk.h"
#include "scene/shapes/mesh.h"

enum { SCOPES_MAX = 4200 };

static enum name_class class_of(const struct value *v)
{
    switch (v->kind) {
    case VALUE_NONE: return NAME_UNDECLARED;
    case VALUE_NUMBER: return NAME_VALUE;
    case VALUE_STRING: return NAME_STRING;
    case VALUE_FUNCTION:
    case VALUE_SPLINE: return NAME_FUNCTION;
    case VALUE_ARRAY: return NAME_ARRAY;
    case VALUE_MACRO: return NAME_MACRO;
    case VALUE_OBJECT: return NAME_OBJECT;
    default: return NAME_BLOCK;
    }
}

static struct name_info lookup(void *user, const char *name, size_t len)
{
    struct eval *e = user;
    struct place p = symbols_find(e->symbols, name, len, symbols_depth(e->symbols));
    const struct value *v = place_found(p) ? place_peek(e->nodes, p) : NULL;
    if (!v)
        return (struct name_info){.class = NAME_UNDECLARED};
    struct name_info info = {
        .class = class_of(v), .value = v, .deprecated = v->deprecated};
    if (v->kind == VALUE_MACRO)
        memcpy(&info.macro, &v->data, sizeof info.macro);
    return info;
}

static const struct value *hold(void *user, const struct value *v)
{
    return value_hold(((struct eval *)user)->nodes, v);
}

static const char *undeclared(void *user, const char *name, size_t len,
                              enum undeclared_kind kind, const char *word)
{
    return undeclared_hint(user, name, len, kind, word);
}

static bool number(void *user, const struct ast *expr, double *out)
{
    return eval_float(user, expr, out);
}

static bool string(void *user, const struct ast *expr, const char **out)
{
    return eval_string(user, expr, out);
}

static bool path(void *user, const struct ast *expr, const char **out)
{
    return eval_path(user, expr, out);
}

static bool is_declared(void *user, const struct lvalue *name)
{
    struct eval *e = user;
    struct place p = eval_place(e, name, symbols_depth(e->symbols));
    return place_found(p) && place_peek(e->nodes, p);
}

// ---- assignment --------------------------------------------------------------

static bool declare_begin(void *user, struct lvalue *to)
{
    struct eval *e = user;
    to->scope = symbols_depth(e->symbols);
    if (to->local && !to->index)
        symbols_make(e->symbols, to->name, to->len, true);
    return true;
}

bool eval_assign(struct eval *e, const struct lvalue *to, const struct value *v)
{
    struct place p = {0};
    uint32_t scope = to->scope ? to->scope : symbols_depth(e->symbols);
    if (to->index || !to->local)
        p = eval_place(e, to, scope);
    if (to->index && !place_found(p)) {
        if (!lookup(e, to->name, to->len).value)
            diag_at(e->diags, DIAG_UNDECLARED, to->where, (int)to->len, to->name);
        return false;
    }
    if (!place_found(p))
        p = symbols_make_at(e->symbols, to->name, to->len, to->local ? scope : 1);
    const struct value *old = p.array ? NULL : place_peek(e->nodes, p);
    if (old && (old->kind == VALUE_MACRO || old->kind == VALUE_FUNCTION)) {
        diag_at(e->diags, DIAG_REDECLARED, to->where, (int)to->len, to->name,
                value_kind_name(old));
        return false;
    }
    if (place_set(e->arena, p, v))
        return true;
    diag_at(e->diags, DIAG_ELEMENT_KIND, to->where, value_kind_name(v));
    return false;
}

static bool declare(void *user, const struct lvalue *to, const struct ast *items)
{
    struct eval *e = user;
    const struct value *v = eval_rvalue(e, items);
    if (!v)
        return false;
    if (to->deprecated) {
        struct value *marked = arena_new_struct(e->arena, struct value);
        *marked = *v;
        marked->deprecated = true;
        v = marked;
        eval_deprecate(e, to);
    }
    return eval_assign(e, to, v);
}

static bool declare_number(void *user, const struct lvalue *to, double v)
{
    struct value number_value = value_of_number(&v, 1);
    return eval_assign(user, to, &number_value);
}

static void *name_of(void *user, const char *name, size_t len)
{
    return symbols_name(((struct eval *)user)->symbols, name, len);
}

static bool advance(void *user, void *name, double by, double *out)
{
    return symbols_advance(((struct eval *)user)->symbols, name, by, out);
}

static bool undef(void *user, const struct lvalue *name)
{
    struct eval *e = user;
    if (name->index) {
        struct place p = eval_place(e, name, symbols_depth(e->symbols));
        if (place_found(p))
            place_clear(p);
        return place_found(p);
    }
    if (!symbols_remove(e->symbols, name->name, name->len))
        diag_at(e->diags, DIAG_UNDEF_UNKNOWN, name->where, (int)name->len, name->name);
    return true;
}

static bool define_macro(void *user, const char *name, size_t len, struct span where,
                         void *macro)
{
    struct eval *e = user;
    struct place p = symbols_make(e->symbols, name, len, false);
    const struct value *old = place_get(e->nodes, p);
    if (old && old->kind != VALUE_MACRO) {
        diag_at(e->diags, DIAG_REDECLARED, where, (int)len, name, value_kind_name(old));
        return false;
    }
    return place_set(e->arena, p, value_new_data(e->arena, VALUE_MACRO, macro));
}

static bool declare_array(void *user, const struct lvalue *to, const struct ast *sizes,
                          const struct ast *elements)
{
    const struct value *v = eval_array(user, sizes, elements);
    return v && eval_assign(user, to, v);
}

// ---- scopes ------------------------------------------------------------------

static bool enter_scope(void *user, struct span where)
{
    struct eval *e = user;
    if (symbols_depth(e->symbols) >= SCOPES_MAX) {
        diag_at(e->diags, DIAG_SCOPES, where, "");
        return false;
    }
    symbols_enter(e->symbols);
    return true;
}

static void leave_scope(void *user) { symbols_leave(((struct eval *)user)->symbols); }

static bool bind_argument(void *user, const char *parameter, size_t len,
                          const struct macro_argument *argument)
{
    struct eval *e = user;
    if (argument->by_reference) {
        const struct lvalue *r = &argument->reference;
        struct place p = eval_place(e, r, symbols_depth(e->symbols) - 1);
        const struct value *v = place_found(p) ? place_peek(e->nodes, p) : NULL;
        if (!v) {
            if (place_found(p))
                diag_at(e->diags, DIAG_UNSET, r->where, (int)r->len, r->name);
            else if (!lookup(e, r->name, r->len).value)
                diag_at(e->diags, DIAG_UNDECLARED, r->where, (int)r->len, r->name);
            return false;
        }
        if (v->kind != VALUE_FUNCTION) {
            symbols_refer(e->symbols, parameter, len, p);
            return true;
        }
        struct place own = symbols_make(e->symbols, parameter, len, true);
        return place_set(e->arena, own, v);
    }
    const struct value *v = eval_rvalue(e, argument->rvalue);
    if (!v)
        return false;
    struct place own = symbols_make(e->symbols, parameter, len, true);
    return place_set(e->arena, own, v);
}

// ---- finished nodes ----------------------------------------------------------

static void become(struct ast *n, const struct value *v, bool keep_name)
{
    n->kind = AST_VALUE;
    n->value = v;
    n->list = NULL;
    if (!keep_name) {
        n->text = NULL;
        n->len = 0;
    }
}

static struct ast *finish_call(struct eval *e, struct ast *n)
{
    struct call_result r = {0};
    bool ok;
    if (n->kind == AST_CALL) {
        ok = eval_call(e, n, &r);
    } else {
        ok = eval_apply(e, n, r.n, &r.width);
    }
    if (!ok) { // once is enough
        become(n, NULL, false);
        n->op = OP_FAILED;
        return n;
    }
    if (!r.width) {
        struct value *v = arena_new_struct(e->nodes, struct value);
        v->kind = VALUE_STRING;
        v->string.text = r.text;
        v->string.len = (uint32_t)strlen(r.text);
        become(n, v, false);
    } else if (r.width == 1) {
        n->kind = AST_NUMBER;
        n->list = NULL;
        n->value = NULL;
        n->number = r.n[0];
        n->len = 0;
    } else {
        become(n, value_new_number(e->nodes, r.n, r.width), false);
    }
    return n;
}

static struct ast *finish(void *user, struct ast *n)
{
    struct eval *e = user;
    if (n->kind == AST_CALL || n->kind == AST_APPLY)
        return finish_call(e, n);
    const struct value *v = NULL;
    if (n->kind == AST_INDEX)
        v = eval_named(e, n);
    else if (n->kind == AST_BLOCK && builder_is_object_word(n->word))
        v = builder_object(e->builder, n);
    else
        return n;
    if (!v && n->kind == AST_BLOCK) { // reported: a value of nothing, read once only
        n->kind = AST_VALUE;
        n->text = NULL;
        n->len = 0;
        n->value = NULL;
        return n;
    }
    if (!v)
        return NULL;
    become(n, v, n->kind == AST_INDEX);
    return n;
}

static void *faces(void *user) { return mesh_soup_new(((struct eval *)user)->nodes); }

static void face(void *user, void *mesh, const struct ast *block)
{
    builder_face(((struct eval *)user)->builder, mesh, block);
}

// ---- version, limits, files ----------------------------------------------------

static bool version(void *user, struct span where, double v)
{
    struct eval *e = user;
    const double hundredfold = 100 * v + 0.5;
    if (!(hundredfold > -1 && hundredfold < 371)) {
        diag_at(e->diags, DIAG_VERSION, where, v);
        return false;
    }
    e->version = (int)hundredfold;
    e->version_seen = true;
    settings_noise(e->builder);
    return true;
}

static bool may_go_on(void *user, struct span where, uint64_t steps)
{
    struct eval *e = user;
    const struct eval_options *o = e->options;
    if (o->steps_max && steps > o->steps_max) {
        diag_at(e->diags, DIAG_TOO_MANY_STEPS, where, (unsigned long long)o->steps_max);
        return false;
    }
    enum { SELDOM = 64 }; // a look at the clock costs as much as a short statement
    if (o->reading && ++e->asked % SELDOM == 0 && !o->reading(o->reading_user, where))
        return false;
    return eval_has_memory(e, where, 0);
}

bool eval_has_memory(struct eval *e, struct span where, size_t more)
{
    const size_t most = e->options->memory_max;
    if (!most ||
        (more <= most && arena_size(e->arena) + arena_size(e->parse) <= most - more))
        return true;
    diag_at(e->diags, DIAG_TOO_MUCH_MEMORY, where, most / 1048576.0);
    return false;
}

static bool defaults(void *user, const struct ast *items)
{
    return builder_defaults(((struct eval *)user)->builder, items);
}

static bool open_include(void *user, const char *name, struct span where,
                         const char **found, const char **text, size_t *len)
{
    static const char *const extensions[] = {".inc", ".INC", NULL};
    struct eval *e = user;
    *found = file_find(e, name, extensions);
    if (*found && file_read(e->sources->arena, *found, text, len))
        return true;
    const char *hint = file_hint(e);
    diag_hint(e->diags, DIAG_INCLUDE_NOT_FOUND, where,
              hint ? hint : include_hint(e, name), name);
    return false;
}

struct stream_host eval_host(struct eval *e)
{
    return (struct stream_host){
        .user = e,
        .lookup = lookup,
        .hold = hold,
        .undeclared = undeclared,
        .deprecated = eval_deprecated,
        .number = number,
        .string = string,
        .path = path,
        .is_declared = is_declared,
        .declare_begin = declare_begin,
        .declare = declare,
        .declare_number = declare_number,
        .name_of = name_of,
        .advance = advance,
        .declare_array = declare_array,
        .calculate = e->options->statement ? NULL : calc_run,
        .undef = undef,
        .define_macro = define_macro,
        .enter_scope = enter_scope,
        .leave_scope = leave_scope,
        .bind_argument = bind_argument,
        .finish = finish,
        .faces = faces,
        .face = face,
        .message = eval_message,
        .version = version,
        .may_go_on = may_go_on,
        .defaults = defaults,
        .file_io = eval_file_io,
        .open_include = open_include,
    };
}
