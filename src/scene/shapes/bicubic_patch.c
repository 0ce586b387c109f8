// bicubic_patch { type t [flatness f] [u_steps u] [v_steps v] [uv_vectors ...] 16 points }
//
// The true surface, whatever the flatness and the steps say: they count with --pov-patches
// alone, which draws the triangles that POV-Ray draws.
#include <math.h>

#include "scene/args.h"
#include "scene/shape_kernels.h"
#include "scene/shapes/extrude.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/patch.h"
#include "scene/shapes/slabs.h"

struct bicubic {
    struct patch patch;
    struct vec2 uv[4];
    long type;
    bool empty;                   // a point or a line
    double hint[4];               // as hint_word
    const struct mesh *triangles; // drawn instead; NULL: the surface
    struct arena *arena;          // to make them anew
};

enum { FLATNESS, U_STEPS, V_STEPS, ACCURACY, HINTS };
static const char *const hint_word[HINTS] = {"flatness", "u_steps", "v_steps",
                                             "accuracy"};

static bool read_options(struct bicubic *s, struct args *args)
{
    s->type = -1;
    if (args_at_number(args) && !args_at_vector(args)) { // the old form
        if (!args_int(args, "type", &s->type))
            return false;
        args_warn(args, "numbers without keywords are an old form; write type, flatness, "
                        "u_steps, v_steps");
        double number[HINTS] = {0};
        int n = 0;
        while (args_at_number(args) && !args_at_vector(args) && n < HINTS)
            if (!args_float(args, "flatness or steps", &number[n++]))
                return false;
        for (int i = 0; i < n && i < 3; i++) // the flatness may be left out
            s->hint[n < 3 ? U_STEPS + i : i] = number[i];
    }
    for (;;) {
        bool known = false;
        for (int i = 0; i < HINTS && !known; i++)
            if (args_word(args, hint_word[i])) {
                known = true;
                if (!args_float(args, hint_word[i], &s->hint[i]))
                    return false;
            }
        if (!known && args_word(args, "type")) {
            known = true;
            if (!args_int(args, "type", &s->type))
                return false;
        }
        if (!known)
            return true;
    }
}

static bool read_uvs(struct bicubic *s, struct args *args)
{
    static const struct vec2 square[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const bool given = args_word(args, "uv_vectors");
    for (int i = 0; i < 4; i++) {
        s->uv[i] = square[i];
        if (given && !args_vec2(args, "uv vector", &s->uv[i]))
            return false;
    }
    return true;
}

// Whether all control points lie on one line.
static bool is_line(const struct patch *p)
{
    const struct vec3 o = p->p[0][0];
    struct vec3 far = {0, 0, 0};
    for (int i = 1; i < 16; i++) {
        const struct vec3 q = vec3_sub(p->p[i / 4][i % 4], o);
        if (vec3_dot(q, q) > vec3_dot(far, far))
            far = q;
    }
    const double size = vec3_length(far);
    for (int i = 1; i < 16; i++) {
        const struct vec3 off = vec3_cross(vec3_sub(p->p[i / 4][i % 4], o), far);
        if (vec3_length(off) > GAMMA(64) * size * (size + vec3_max_abs(o)))
            return false;
    }
    return true;
}

static void make_triangles(struct bicubic *s)
{
    s->triangles = patch_triangles(&s->patch, s->hint[FLATNESS], s->hint[U_STEPS],
                                   s->hint[V_STEPS], s->arena);
}

static bool build(void *shape, struct args *args)
{
    struct bicubic *s = shape;
    if (!read_options(s, args) || !read_uvs(s, args))
        return false;
    if (s->type < 0 || s->type > 2) {
        args_reject(args, "type 0 or type 1 is needed");
        return false;
    }
    if (s->type == 2) {
        args_warn(args, "type 2 is not known; type 1 is taken");
        s->type = 1;
    }
    for (int i = 0; i < 16; i++)
        if (!args_vec3(args, "control point", &s->patch.p[i / 4][i % 4]))
            return false;
    s->empty = is_line(&s->patch);
    patch_build(&s->patch, args_arena(args));
    s->arena = args_arena(args);
    if (args_pov_patches(args))
        make_triangles(s);
    return true;
}

// How flat POV-Ray's pieces are counts where they are, after all transforms.
static bool absorb(void *shape, const struct transform *t)
{
    struct bicubic *s = shape;
    if (!s->triangles)
        return false;
    for (int i = 0; i < 16; i++)
        s->patch.p[i / 4][i % 4] = transform_point(t, s->patch.p[i / 4][i % 4]);
    patch_build(&s->patch, s->arena);
    make_triangles(s);
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct bicubic *s = shape;
    return s->patch.bounds;
}

static bool inside(const void *shape, struct vec3 p)
{
    (void)shape;
    (void)p;
    return false;
}

static void fill(struct boundary *b, const struct patch_hit *h)
{
    b->t = h->t;
    b->dt = h->dt;
    b->u = h->u;
    b->v = h->v;
    b->part = 0;
    b->crossing = CROSS_TOUCH;
    b->drawn = 1;
}

enum { STACK = 16 };

// Two leaves have found one point of their common edge.
static bool is_same(const struct boundary *b, const struct patch_hit *h)
{
    return fabs(b->u - h->u) <= 0x1p-36 && fabs(b->v - h->v) <= 0x1p-36 &&
           fabs(b->t - h->t) <= 2 * (b->dt + h->dt);
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct bicubic *s = shape;
    const struct patch *p = &s->patch;
    if (s->triangles) {
        mesh_intersect(s->triangles, ray, out);
        return;
    }
    if (s->empty)
        return;
    const struct slabs slabs = slabs_of(&p->bounds, ray);
    const struct patch_ray r = patch_ray_of(ray);
    const uint32_t from = out->count;
    uint32_t stack[STACK], depth = 0;
    stack[depth++] = 0;
    while (depth) {
        const uint32_t at = stack[--depth];
        const struct patch_node *n = &p->node[at];
        struct patch_hit hit[PATCH_HITS];
        double t;
        if (!slabs_meet(&n->box, &slabs, -INFINITY, INFINITY, &t))
            continue;
        if (n->other) {
            stack[depth++] = n->other;
            stack[depth++] = at + 1;
            continue;
        }
        const int count = patch_meet_leaf(&p->leaf[n->leaf], &r, hit);
        for (int i = 0; i < count; i++) {
            uint32_t k = from;
            while (k < out->count && !is_same(&out->at[k], &hit[i]))
                k++;
            if (k == out->count)
                boundary_list_add(out, HUGE_VAL, 0, CROSS_TOUCH, 0);
            if (hit[i].t < out->at[k].t) // the nearer one, as lanes take it
                fill(&out->at[k], &hit[i]);
        }
    }
    boundary_list_sort(out, from);
}

// Where there is no tree.
static bool closest(const void *shape, const struct ray *ray, struct boundary *out)
{
    const struct bicubic *s = shape;
    return s->triangles && mesh_closest(s->triangles, ray, out);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    return k->patch(&((const struct bicubic *)shape)->patch, rays, lanes, any, out);
}

static bool has_lanes(const void *shape)
{
    const struct bicubic *s = shape;
    return !s->triangles && !s->empty;
}

// At a collapsed edge, where one derivative vanishes, the limit from the inside.
static struct vec3 normal_at(const struct patch *p, double u, double v)
{
    struct vec3 at, du, dv, n = {0, 0, 0};
    for (double move = 0; move<0.5; move = move> 0 ? 16 * move : 0x1p-20) {
        patch_derivatives(p, u + move * (0.5 - u), v + move * (0.5 - v), &at, &du, &dv);
        n = vec3_cross(du, dv);
        const double size = vec3_max_abs(vec3_sub(p->bounds.max, p->bounds.min));
        if (vec3_length(n) > 0x1p-30 * size * fmax(vec3_length(du), vec3_length(dv)))
            return vec3_normalize(n);
    }
    n = vec3_normalize(n);
    return vec3_dot(n, n) > 0 ? n : vec3(1, 0, 0);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct bicubic *s = shape;
    double u = b->u, v = b->v;
    if (s->triangles) {
        out->uv = (struct vec2){0, 0};
        mesh_surface(s->triangles, b, p, out);
        u = out->uv.u;
        v = out->uv.v;
    } else {
        out->p = p;
        out->ng = out->ns = normal_at(&s->patch, u, v);
    }
    const double w[4] = {(1 - u) * (1 - v), (1 - u) * v, u * v, u * (1 - v)};
    out->uv = (struct vec2){0, 0};
    for (int i = 0; i < 4; i++) {
        out->uv.u += w[i] * s->uv[i].u;
        out->uv.v += w[i] * s->uv[i].v;
    }
}

static void print(const void *shape, FILE *out)
{
    const struct bicubic *s = shape;
    fprintf(out, "bicubic_patch { type %ld", s->type);
    for (int i = 0; i < HINTS; i++)
        if (s->hint[i] != 0) {
            fprintf(out, " %s ", hint_word[i]);
            shape_print_number(out, s->hint[i]);
        }
    fputs(" uv_vectors", out);
    for (int i = 0; i < 4; i++) {
        fputs(i ? ", " : " ", out);
        shape_print_vec2(out, s->uv[i]);
    }
    for (int i = 0; i < 16; i++) {
        fputs(", ", out);
        shape_print_vec3(out, s->patch.p[i / 4][i % 4]);
    }
}

const struct shape_ops bicubic_patch_ops = {
    .keyword = "bicubic_patch",
    .size = sizeof(struct bicubic),
    .flags = SHAPE_BOUNDED | SHAPE_UV,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest = closest,
    .closest8 = closest8,
    .has_lanes = has_lanes,
    .surface = surface,
    .print = print,
};
