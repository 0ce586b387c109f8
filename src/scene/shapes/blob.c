// blob { [threshold T] sphere { c, r, s } cylinder { a, b, r, s } component s, r, c ... }
//
// Each component has the field s (1 - d^2/r^2)^2 within its radius; the surface is where
// the sum is T. A cylinder is a straight piece and two half balls.
#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "math/eigen.h"
#include "scene/args.h"
#include "scene/shapes/blob.h"

// 1 - d^2/r^2 of one component at a point, or 0 where it does not reach; *v goes from its
// nearest part to the point, in its own space.
static double reach(const struct blob_component *c, struct vec3 p, struct vec3 *v)
{
    if (!c->transform.identity)
        p = transform_inverse_point(&c->transform, p);
    *v = vec3_sub(p, c->c);
    const double along = vec3_dot(*v, c->axis);
    if ((c->kind == PART_STRAIGHT && !(along >= 0 && along < c->length)) ||
        (c->kind == PART_BASE && along >= 0) ||
        (c->kind == PART_APEX && along < c->length))
        return 0;
    if (c->kind == PART_STRAIGHT || c->kind == PART_APEX)
        *v = vec3_mad(*v, c->kind == PART_APEX ? -c->length : -along, c->axis);
    const double k = 1 - vec3_dot(*v, *v) / (c->r * c->r);
    return k > 0 ? k : 0;
}

static bool is_near(const struct blob_reach *r, struct vec3 p)
{
    const struct vec3 v = vec3_sub(p, r->c);
    return vec3_dot(v, v) < r->r2;
}

// The field and its gradient at a point.
static double field(const struct blob *b, struct vec3 p, struct vec3 *gradient)
{
    double sum = 0;
    struct blob_near near;
    *gradient = vec3(0, 0, 0);
    blob_near_begin(&near, b, p);
    for (uint32_t i; blob_near_next(&near, &i);) {
        const struct blob_component *c = &b->at[i];
        struct vec3 v;
        const double k = is_near(&b->reach[i], p) ? reach(c, p, &v) : 0;
        if (!(k > 0))
            continue;
        sum += c->s * k * k;
        const struct vec3 g = vec3_scale(-4 * c->s * k / (c->r * c->r), v);
        *gradient = vec3_add(
            *gradient, c->transform.identity ? g : transform_normal(&c->transform, g));
    }
    return sum;
}

static const struct texture *part_texture(const void *shape, uint32_t i)
{
    const struct blob *b = shape;
    for (uint32_t k = 0; k < b->count; k++)
        if (b->at[k].texture && i-- == 0)
            return b->at[k].texture;
    return NULL;
}

// Every component counts with its share of the field, without regard to sign.
static void textures_at(const void *shape, const struct boundary *at, struct vec3 p,
                        shape_texture_visit *visit, void *user)
{
    (void)at;
    const struct blob *b = shape;
    struct blob_near near;
    struct vec3 v;
    double sum = 0;
    blob_near_begin(&near, b, p);
    for (uint32_t i; blob_near_next(&near, &i);) {
        const double k = reach(&b->at[i], p, &v);
        sum += fabs(b->at[i].s) * k * k;
    }
    if (!(sum > 0)) {
        visit(user, NULL, 1);
        return;
    }
    blob_near_begin(&near, b, p);
    for (uint32_t i; blob_near_next(&near, &i);) {
        const double k = reach(&b->at[i], p, &v);
        if (k > 0 && b->at[i].s != 0)
            visit(user, b->at[i].texture, fabs(b->at[i].s) * k * k / sum);
    }
}

static struct aabb bounds(const void *shape)
{
    const struct blob *b = shape;
    struct aabb box = aabb_empty();
    if (0 > b->threshold)
        return aabb_infinite();
    for (uint32_t i = 0; i < b->count; i++)
        if (b->at[i].s > 0)
            box = aabb_join(box, blob_component_box(&b->at[i]));
    return box;
}

static bool is_bounded(const void *shape)
{
    return ((const struct blob *)shape)->threshold > 0;
}

static bool inside(const void *shape, struct vec3 p)
{
    struct vec3 gradient;
    const struct blob *b = shape;
    return field(b, p, &gradient) >= b->threshold;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    blob_intersect(shape, ray, out);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    (void)any;
    unsigned odd;
    const unsigned met = k->blob(shape, rays, lanes, out, &odd);
    return met | shape_lanes_alone(&blob_ops, shape, rays, odd, out);
}

// Else space is solid where no component reaches, and lines that meet none count as well.
static bool has_lanes(const void *shape)
{
    const struct blob *b = shape;
    return b->threshold > 0;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    struct vec3 gradient;
    field(shape, p, &gradient);
    struct vec3 n = vec3_normalize(vec3_neg(gradient));
    if (vec3_dot(n, n) == 0)
        n = vec3(1, 0, 0);
    out->p = p;
    out->ng = out->ns = n;
    out->uv = (struct vec2){p.x, p.y};
}

// ---- reading ------------------------------------------------------------

static struct blob_component *add(struct blob *b, struct arena *a)
{
    if (b->count == b->capacity) {
        b->capacity = b->capacity ? 2 * b->capacity : 16;
        struct blob_component *more =
            arena_new_array(a, struct blob_component, b->capacity);
        if (b->count)
            memcpy(more, b->at, b->count * sizeof *more);
        b->at = more;
    }
    struct blob_component *c = &b->at[b->count++];
    c->transform = transform_identity;
    c->axis = vec3(0, 0, 1);
    return c;
}

static bool read_ball(struct blob *b, struct args *block, struct arena *a)
{
    struct blob_component c = {.kind = PART_BALL, .axis = {0, 0, 1}};
    if (!args_vec3(block, "centre", &c.c) || !args_float(block, "radius", &c.r))
        return false;
    args_word(block, "strength");
    if (!args_float(block, "strength", &c.s) ||
        !args_part(block, &c.transform, &c.texture))
        return false;
    *add(b, a) = c;
    return true;
}

static bool read_cylinder(struct blob *b, struct args *block, struct arena *a)
{
    struct blob_component c = {.kind = PART_STRAIGHT};
    struct vec3 end;
    if (!args_vec3(block, "base", &c.c) || !args_vec3(block, "apex", &end) ||
        !args_float(block, "radius", &c.r))
        return false;
    args_word(block, "strength");
    if (!args_float(block, "strength", &c.s) ||
        !args_part(block, &c.transform, &c.texture))
        return false;
    const struct vec3 along = vec3_sub(end, c.c);
    c.length = vec3_length(along);
    if (!(c.length > 0)) {
        args_reject(block, "the ends of the cylinder coincide");
        return false;
    }
    c.axis = vec3_scale(1 / c.length, along);
    *add(b, a) = c;
    c.kind = PART_BASE;
    *add(b, a) = c;
    c.kind = PART_APEX;
    *add(b, a) = c;
    return true;
}

// The most that a transform makes of a length.
static double longest(const struct mat3 *m)
{
    double square[3][3], most = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            square[i][k] = m->m[i][0] * m->m[k][0] + m->m[i][1] * m->m[k][1] +
                           m->m[i][2] * m->m[k][2];
    const struct eigen e = eigen_of((const double(*)[3])square);
    for (int i = 0; i < 3; i++)
        most = fmax(most, e.value[i]);
    return sqrt(most);
}

static struct blob_reach reach_of(const struct blob_component *c)
{
    const double grow = 1 + 0x1p-30; // far more than rounding
    const double half = c->kind == PART_STRAIGHT ? 0.5 * c->length : 0;
    const double along = c->kind == PART_STRAIGHT ? half
                         : c->kind == PART_APEX   ? c->length
                                                  : 0;
    const struct vec3 middle = vec3_mad(c->c, along, c->axis);
    const struct transform *m = &c->transform;
    const double times = m->identity ? 1 : longest(&m->linear);
    const struct vec3 at = transform_point(m, middle);
    const double size = vec3_max_abs(at) + vec3_max_abs(m->offset) +
                        times * (vec3_max_abs(middle) + c->length + fabs(c->r));
    const double r = sqrt(c->r * c->r + half * half) * times * grow + 0x1p-40 * size;
    return (struct blob_reach){at, r * r};
}

static bool build(void *shape, struct args *args)
{
    struct blob *b = shape;
    struct arena *a = args_arena(args);
    b->threshold = 1;
    for (;;) {
        struct args *block;
        if (args_word(args, "threshold")) {
            if (!args_float(args, "threshold", &b->threshold))
                return false;
        } else if (args_word(args, "component")) {
            struct blob_component c = {
                .kind = PART_BALL, .axis = {0, 0, 1}, .transform = transform_identity};
            if (!args_float(args, "strength", &c.s) ||
                !args_float(args, "radius", &c.r) || !args_vec3(args, "centre", &c.c))
                return false;
            *add(b, a) = c;
        } else if ((block = args_block(args, "sphere"))) {
            if (!read_ball(b, block, a))
                return false;
        } else if ((block = args_block(args, "cylinder"))) {
            if (!read_cylinder(b, block, a))
                return false;
        } else {
            break;
        }
    }
    if (b->count == 0) {
        args_reject(args, "a blob needs at least one component");
        return false;
    }
    b->reach = arena_new_array(a, struct blob_reach, b->count);
    for (uint32_t i = 0; i < b->count; i++)
        b->reach[i] = reach_of(&b->at[i]);
    blob_make_tree(b, a);
    return true;
}

static void print_component(const struct blob_component *c, FILE *out)
{
    fputs(c->kind == PART_STRAIGHT ? " cylinder { " : " sphere { ", out);
    shape_print_vec3(out, c->c);
    if (c->kind == PART_STRAIGHT) {
        fputs(", ", out);
        shape_print_vec3(out, vec3_mad(c->c, c->length, c->axis));
    }
    fputs(", ", out);
    shape_print_number(out, c->r);
    fputs(", ", out);
    shape_print_number(out, c->s);
    if (!c->transform.identity) {
        const struct mat3 *m = &c->transform.linear;
        fputs(" matrix <", out);
        for (int i = 0; i < 9; i++) {
            shape_print_number(out, m->m[i / 3][i % 3]);
            fputs(", ", out);
        }
        const struct vec3 o = c->transform.offset;
        shape_print_number(out, o.x);
        fputs(", ", out);
        shape_print_number(out, o.y);
        fputs(", ", out);
        shape_print_number(out, o.z);
        fputs(">", out);
    }
    fputs(" }", out);
}

static void print(const void *shape, FILE *out)
{
    const struct blob *b = shape;
    fputs("blob { threshold ", out);
    shape_print_number(out, b->threshold);
    for (uint32_t i = 0; i < b->count; i++)
        if (b->at[i].kind == PART_BALL || b->at[i].kind == PART_STRAIGHT)
            print_component(&b->at[i], out);
}

const struct shape_ops blob_ops = {
    .keyword = "blob",
    .size = sizeof(struct blob),
    .flags = SHAPE_SOLID | SHAPE_STURM | SHAPE_HIERARCHY,
    .build = build,
    .bounds = bounds,
    .is_bounded = is_bounded,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .has_lanes = has_lanes,
    .surface = surface,
    .texture = part_texture,
    .textures_at = textures_at,
    .print = print,
};
