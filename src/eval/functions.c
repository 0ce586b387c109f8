// The float and vector functions of expressions (spec/language 2.8, 2.9).

#include "eval/functions.h"

#include <math.h>
#include <time.h>

#include "base/arena.h"
#include "eval/array.h"
#include "eval/symbol.h"
#include "image/texels.h"
#include "math/elementary.h"
#include "math/pi.h"
#include "scene/image_map.h"
#include "scene/noise.h"
#include "scene/object.h"

static const double zero_within = 1e-10; // spec/language, conventions

static const struct builtin builtins[WORD_COUNT] = {
#define BUILTIN(word, least_, most_, arguments_, kind)                                   \
    [WORD_##word] = {.run = call_##word,                                                 \
                     .arguments = arguments_,                                            \
                     .least = least_,                                                    \
                     .most = most_,                                                      \
                     .result = kind},
#include "eval/functions.def"
#undef BUILTIN
};

const struct builtin *builtin_find(enum word w) { return &builtins[w]; }

bool word_is_string_function(enum word w) { return builtins[w].result == 's'; }

bool call_domain(struct call *c, const char *what)
{
    diag_at(c->e->diags, DIAG_DOMAIN, c->node->where, c->name, what);
    return false;
}

static bool read_argument(struct eval *e, const struct ast *n, char kind, bool path,
                          bool first_component_only, struct argument *a)
{
    int width;
    a->node = n;
    switch (kind) {
    case 'f': return eval_float(e, n, &a->f);
    case 's': return path ? eval_path(e, n, &a->s) : eval_string(e, n, &a->s);
    case 'v':
        if (first_component_only) // vstr does not repeat a float
            return eval_number(e, n, 1, a->n, &width);
        return eval_vec3(e, n, &a->v);
    default: // o
        a->o = eval_named(e, n);
        return a->o || n->kind != AST_INDEX;
    }
}

bool eval_call(struct eval *e, const struct ast *n, struct call_result *out)
{
    const struct builtin *f = &builtins[n->word];
    if (!f->run) {
        diag_at(e->diags, DIAG_NOT_BUILT, n->where, word_text(n->word));
        return false;
    }
    const struct ast *list = n->kind == AST_CALL ? n->list : NULL;
    struct call c = {.e = e, .node = n, .name = word_text(n->word)};
    for (const struct ast *a = list; a; a = a->next)
        c.count++;
    if (c.count < f->least || ((f->most || !f->least) && c.count > f->most)) {
        diag_at(e->diags, DIAG_CALL_ARGUMENTS, n->where, c.name, (int)c.count);
        return false;
    }
    struct argument few[8] = {0};
    struct argument *arg =
        c.count <= 8 ? few : arena_new_array(e->parse, struct argument, c.count);
    const char *kind = f->arguments;
    uint32_t i = 0;
    for (const struct ast *a = list; a; a = a->next, i++) {
        if (!read_argument(e, a, *kind, n->word == WORD_file_exists, n->word == WORD_vstr,
                           &arg[i]))
            return false;
        if (kind[1])
            kind++;
    }
    c.arg = arg;
    c.result.width = f->result == 'f' ? 1 : f->result == 'v' ? 3 : 0;
    bool ok = f->run(&c);
    *out = c.result;
    return ok;
}

static bool give(struct call *c, double v)
{
    c->result.n[0] = v;
    return true;
}

static bool give_vector(struct call *c, struct vec3 v)
{
    c->result.n[0] = v.x;
    c->result.n[1] = v.y;
    c->result.n[2] = v.z;
    return true;
}

#define PLAIN(word, value)                                                               \
    bool call_##word(struct call *c)                                                     \
    {                                                                                    \
        double a = c->arg[0].f;                                                          \
        return give(c, value);                                                           \
    }
PLAIN(abs, fabs(a))
PLAIN(acosh, det_acosh(a))
PLAIN(asinh, det_asinh(a))
PLAIN(atan, det_atan(a))
PLAIN(atanh, det_atanh(a))
PLAIN(ceil, ceil(a))
PLAIN(cos, det_cos(a))
PLAIN(cosh, det_cosh(a))
PLAIN(degrees, a * 180 / PI)
PLAIN(exp, det_exp(a))
PLAIN(floor, floor(a))
PLAIN(int, number_to_int(a))
PLAIN(radians, a *PI / 180)
PLAIN(seed, random_seed(c->e, a))
PLAIN(sin, det_sin(a))
PLAIN(sinh, det_sinh(a))
PLAIN(tan, det_tan(a))
PLAIN(tanh, det_tanh(a))

static double clamped(struct call *c)
{
    double a = c->arg[0].f;
    if (a >= -1 && a <= 1)
        return a;
    diag_at(c->e->diags, DIAG_CLAMPED, c->node->where, c->name);
    return a > 1 ? 1 : -1;
}

bool call_acos(struct call *c) { return give(c, det_acos(clamped(c))); }
bool call_asin(struct call *c) { return give(c, det_asin(clamped(c))); }

bool call_ln(struct call *c)
{
    double a = c->arg[0].f;
    return a > 0 ? give(c, det_log(a)) : call_domain(c, "the argument must be positive");
}

bool call_log(struct call *c)
{
    double a = c->arg[0].f;
    return a > 0 ? give(c, det_log10(a))
                 : call_domain(c, "the argument must be positive");
}

bool call_sqrt(struct call *c)
{
    double a = c->arg[0].f;
    return a >= 0 ? give(c, sqrt(a)) : call_domain(c, "the argument is negative");
}

bool call_atan2(struct call *c)
{
    double a = c->arg[0].f, b = c->arg[1].f;
    if (fabs(a) < zero_within && fabs(b) < zero_within)
        return call_domain(c, "both arguments are 0");
    return give(c, det_atan2(a, b));
}

bool call_pow(struct call *c)
{
    double a = c->arg[0].f, b = c->arg[1].f;
    if (a == 0 && b == 0)
        return call_domain(c, "both arguments are 0");
    return give(c, det_pow(a, b));
}

bool call_div(struct call *c)
{
    return give(c, number_to_int(c->arg[0].f / c->arg[1].f));
}

bool call_mod(struct call *c) { return give(c, fmod(c->arg[0].f, c->arg[1].f)); }

bool call_max(struct call *c)
{
    double v = c->arg[0].f;
    for (uint32_t i = 1; i < c->count; i++)
        if (c->arg[i].f > v)
            v = c->arg[i].f;
    return give(c, v);
}

bool call_min(struct call *c)
{
    double v = c->arg[0].f;
    for (uint32_t i = 1; i < c->count; i++)
        if (c->arg[i].f < v)
            v = c->arg[i].f;
    return give(c, v);
}

bool call_select(struct call *c)
{
    double a = c->arg[0].f;
    if (a < 0)
        return give(c, c->arg[1].f);
    if (c->count == 4 && a == 0)
        return give(c, c->arg[2].f);
    return give(c, c->arg[c->count - 1].f);
}

static int32_t bits(const struct argument *a) { return (int32_t)number_to_int(a->f); }

bool call_bitwise_and(struct call *c)
{
    int32_t v = bits(&c->arg[0]);
    for (uint32_t i = 1; i < c->count; i++)
        v &= bits(&c->arg[i]);
    return give(c, v);
}

bool call_bitwise_or(struct call *c)
{
    int32_t v = bits(&c->arg[0]);
    for (uint32_t i = 1; i < c->count; i++)
        v |= bits(&c->arg[i]);
    return give(c, v);
}

bool call_bitwise_xor(struct call *c)
{
    int32_t v = bits(&c->arg[0]);
    for (uint32_t i = 1; i < c->count; i++)
        v ^= bits(&c->arg[i]);
    return give(c, v);
}

bool call_rand(struct call *c)
{
    bool ok;
    double v = random_next(c->e, c->arg[0].f, c->node->where, &ok);
    return give(c, v) && ok;
}

bool call_now(struct call *c)
{
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    double seconds = (double)(t.tv_sec - 946684800) + (double)(t.tv_nsec / 1000) * 1e-6;
    return give(c, seconds / 86400);
}

static const struct array_value *array_argument(struct call *c)
{
    const struct value *v = c->arg[0].o;
    if (v && v->kind == VALUE_ARRAY)
        return v->array;
    call_domain(c, "expected an array");
    return NULL;
}

bool call_dimensions(struct call *c)
{
    const struct array_value *a = array_argument(c);
    return a && give(c, a->dimensions);
}

bool call_dimension_size(struct call *c)
{
    const struct array_value *a = array_argument(c);
    double k = number_to_int(c->arg[1].f) - 1;
    return a && give(c, k >= 0 && k < a->dimensions ? a->size[(int)k] : 0);
}

static const struct object *object_argument(struct call *c)
{
    const struct value *v = c->arg[0].o;
    return v && v->kind == VALUE_OBJECT ? v->data : NULL;
}

bool call_inside(struct call *c)
{
    const struct object *o = object_argument(c);
    if (!o || !object_is_solid(o))
        return call_domain(c, "expected an object that has an inside");
    return give(c, object_inside(o, c->arg[1].v));
}

// POV-Ray's bounds of what has no end.
static double extent(double v)
{
    const double far = 1e10 / 2;
    return v > far ? far : v < -far ? -far : v + 0.0; // no -0
}

// The size in pixels of a pigment's image; of other pigments 0.
static struct vec3 image_size(const struct pigment *p)
{
    if (p->kind != PIGMENT_IMAGE)
        return vec3(0, 0, 0);
    return vec3(p->image->texels->width, p->image->texels->height, 0);
}

static bool give_extent(struct call *c, bool max)
{
    const struct value *v = c->arg[0].o;
    if (max && v && v->kind == VALUE_PIGMENT)
        return give_vector(c, image_size(v->data));
    const struct object *o = object_argument(c);
    if (!o)
        return give_vector(c, vec3(0, 0, 0));
    struct aabb b = object_bounds(o);
    struct vec3 corner = max ? b.max : b.min;
    return give_vector(c, vec3(extent(corner.x), extent(corner.y), extent(corner.z)));
}

// trace(OBJ, from, direction, NORMAL): NORMAL is a name that holds a vector.
static bool set_normal(struct call *c, struct vec3 n)
{
    const struct ast *name = c->arg[3].node;
    const struct value *old = c->arg[3].o;
    struct eval *e = c->e;
    struct place p = {0};
    if (old && old->kind == VALUE_NUMBER && old->width == 3 && name->len)
        p = symbols_find(e->symbols, name->text, name->len, symbols_depth(e->symbols));
    if (!p.symbol)
        return call_domain(c, "the name of a vector is expected last");
    struct value v = value_of_number((const double[]){n.x, n.y, n.z}, 3);
    return place_set(e->arena, p, &v);
}

bool call_trace(struct call *c)
{
    const struct object *o = object_argument(c);
    const struct eval_options *options = c->e->options;
    struct vec3 hit = vec3(0, 0, 0), normal = hit;
    struct vec3 d = vec3_normalize(c->arg[2].v);
    if (!o || !options->trace)
        return call_domain(c, "expected an object that rays can meet");
    if (vec3_max_abs(d) > 0 &&
        !options->trace(options->trace_user, o, c->arg[1].v, d, &hit, &normal))
        hit = normal = vec3(0, 0, 0);
    return (c->count < 4 || set_normal(c, normal)) && give_vector(c, hit);
}

bool call_min_extent(struct call *c) { return give_extent(c, false); }
bool call_max_extent(struct call *c) { return give_extent(c, true); }

bool call_vdot(struct call *c) { return give(c, vec3_dot(c->arg[0].v, c->arg[1].v)); }
bool call_vlength(struct call *c) { return give(c, vec3_length(c->arg[0].v)); }

bool call_vcross(struct call *c)
{
    return give_vector(c, vec3_cross(c->arg[0].v, c->arg[1].v));
}

bool call_vnormalize(struct call *c)
{
    if (vec3_max_abs(c->arg[0].v) == 0 && c->e->version >= 350)
        diag_at(c->e->diags, DIAG_ZERO_VECTOR, c->node->where, "");
    return give_vector(c, vec3_normalize(c->arg[0].v));
}

bool call_vrotate(struct call *c)
{
    struct transform t = transform_rotate(c->arg[1].v);
    return give_vector(c, transform_vector(&t, c->arg[0].v));
}

bool call_vaxis_rotate(struct call *c)
{
    struct transform t = transform_rotate_axis(c->arg[1].v, c->arg[2].f * PI / 180);
    return give_vector(c, transform_vector(&t, c->arg[0].v));
}

bool call_vturbulence(struct call *c)
{
    double octaves = number_to_int(c->arg[2].f);
    octaves = octaves < 1 ? 1 : octaves > 10 ? 10 : octaves;
    return give_vector(
        c, noise_dturbulence(c->arg[3].v, c->arg[0].f, c->arg[1].f, (int)octaves));
}
