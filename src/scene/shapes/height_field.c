// height_field { heights [water_level w] [smooth] }
//
// Two triangles a cell over the unit square; the solid is what lies below them, down to
// minus infinity, and below the water. Sides and water are not drawn.
//
// Along a line the height above the surface is linear between the places where it passes
// over a grid line or a diagonal. Its sign is taken once at each such place and handed from
// piece to piece, so no ray slips through an edge or a corner. A tree of lowest and highest
// heights skips what the line passes far above or below.
#include "scene/shapes/height_field.h"

#include <math.h>

#include "base/arena.h"
#include "image/texels.h"
#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape_kernels.h"
#include "scene/shapes/extrude.h"

static double value(const struct height_field *f, int i, int j)
{
    return (double)f->h.at[(size_t)j * (size_t)f->h.width + (size_t)i];
}

// ---- building -------------------------------------------------------------------------

static void cell_range(const struct height_field *f, int i, int j, float range[2])
{
    for (int k = 0; k < 4; k++) {
        const float v = (float)value(f, i + (k & 1), j + (k >> 1));
        range[0] = v < range[0] ? v : range[0];
        range[1] = v > range[1] ? v : range[1];
    }
}

static void child_range(const struct height_field *f, int level, int i, int j,
                        float range[2])
{
    if (level == 0) {
        cell_range(f, i, j, range);
        return;
    }
    const struct height_level *l = &f->level[level];
    const float *r = l->range[(size_t)j * (size_t)l->width + (size_t)i];
    range[0] = r[0] < range[0] ? r[0] : range[0];
    range[1] = r[1] > range[1] ? r[1] : range[1];
}

static void make_level(struct height_field *f, int n, int from_w, int from_h)
{
    const struct height_level *l = &f->level[n];
    for (int j = 0; j < l->height; j++)
        for (int i = 0; i < l->width; i++) {
            float *r = l->range[(size_t)j * (size_t)l->width + (size_t)i];
            r[0] = HUGE_VALF;
            r[1] = -HUGE_VALF;
            for (int k = 0; k < 4; k++)
                if (2 * i + (k & 1) < from_w && 2 * j + (k >> 1) < from_h)
                    child_range(f, n - 1, 2 * i + (k & 1), 2 * j + (k >> 1), r);
        }
}

static void make_levels(struct height_field *f, struct arena *arena)
{
    int w = f->h.width - 1, h = f->h.height - 1, n = 0;
    size_t all = 0;
    while (w > 1 || h > 1 || n == 0) {
        struct height_level *l = &f->level[++n];
        l->width = w = (w + 1) / 2;
        l->height = h = (h + 1) / 2;
        f->level_from[n] = (double)all;
        f->level_width[n] = w;
        all += (size_t)w * (size_t)h;
    }
    f->top = n;
    f->ranges = arena_alloc(arena, all * sizeof *f->ranges);
    w = f->h.width - 1;
    h = f->h.height - 1;
    for (n = 1; n <= f->top; n++) {
        struct height_level *l = &f->level[n];
        l->range = f->ranges + (size_t)f->level_from[n];
        make_level(f, n, w, h);
        w = l->width;
        h = l->height;
    }
    f->low = (double)f->level[f->top].range[0][0] / HEIGHT_UNIT;
    f->high = (double)f->level[f->top].range[0][1] / HEIGHT_UNIT;
}

// The mean of the normals of the triangles with a sample as their corner of the right angle, in
// the shape's space. Beyond the field's edge there is no triangle: its weight is 0. Loops over
// all are what compilers take in lanes.
static void sample_normal(const struct height_field *f, int i, int j, double n[3])
{
    const int w = f->h.width, d = f->h.height;
    const double h = value(f, i, j);
    const bool left = i > 0, right = i + 1 < w, front = j > 0, back = j + 1 < d;
    const double a[2] = {right ? h - value(f, i + 1, j) : 0,
                         left ? value(f, i - 1, j) - h : 0};
    const double b[2] = {back ? h - value(f, i, j + 1) : 0,
                         front ? value(f, i, j - 1) - h : 0};
    const double weight[4] = {right && back, left && back, right && front, left && front};
    double x[4], y[4], z[4], sum[3] = {0};
    for (int q = 0; q < 4; q++) {
        const double u = a[q & 1], v = b[q >> 1];
        y[q] = weight[q] / sqrt(u * u + 1 + v * v);
        x[q] = y[q] * u;
        z[q] = y[q] * v;
    }
    for (int q = 0; q < 4; q++) {
        sum[0] += x[q];
        sum[1] += y[q];
        sum[2] += z[q];
    }
    n[0] = sum[0] * (w - 1);
    n[1] = sum[1] * HEIGHT_UNIT;
    n[2] = sum[2] * (d - 1);
    const double by = 1 / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        n[k] *= by;
}

enum { NORMALS_MAX = 1 << 20 }; // 24 bytes each

static void make_normals(struct height_field *f, struct arena *arena)
{
    const size_t w = (size_t)f->h.width, all = w * (size_t)f->h.height;
    if (!f->smooth || all > NORMALS_MAX)
        return;
    f->normal = arena_alloc(arena, all * sizeof *f->normal);
    for (size_t k = 0; k < all; k++)
        sample_normal(f, (int)(k % w), (int)(k / w), f->normal[k]);
}

// The picture's bottom row lies at z = 0.
static bool read_heights(struct height_field *f, struct args *args)
{
    struct transfer decode;
    const struct texels *t = args_image(args, &decode);
    if (!t)
        return false;
    if (t->width < 2 || t->height < 2) {
        args_reject(args, "a height_field needs at least two samples along each side");
        return false;
    }
    const size_t w = (size_t)t->width;
    f->h.width = t->width;
    f->h.height = t->height;
    f->h.at = arena_new_array(args_arena(args), float, w *(size_t)t->height);
    for (int j = 0; j < t->height; j++)
        for (int i = 0; i < t->width; i++)
            f->h.at[(size_t)j * w + (size_t)i] =
                (float)texels_height(t, i, t->height - 1 - j, decode);
    return true;
}

static bool build(void *shape, struct args *args)
{
    struct height_field *f = shape;
    double water = 0;
    if (!read_heights(f, args))
        return false;
    for (;;) {
        if (args_word(args, "smooth")) {
            f->smooth = true;
            double on;
            if (args_at_number(args) && args_float(args, "smooth", &on))
                f->smooth = on != 0;
        } else if (args_word(args, "water_level")) {
            if (!args_float(args, "water_level", &water))
                return false;
        } else {
            break;
        }
    }
    make_levels(f, args_arena(args));
    make_normals(f, args_arena(args));
    f->water = fmax(f->low, water) - 0.001 / HEIGHT_UNIT;
    f->under_water = f->water > f->low;
    return true;
}

// ---- rays -----------------------------------------------------------------------------

// What is not drawn: a side across x or z, or the water (y), numbered from FLAT on.
static const uint32_t FLAT = UINT32_MAX - 2;

static void flat(struct height_walk *w, int axis, double t)
{
    boundary_list_add(w->out, (t + w->shift) / w->length, w->error / w->length,
                      w->in ? CROSS_EXIT : CROSS_ENTER, FLAT + (uint32_t)axis)
        ->drawn = 0;
}

// The state from t on.
static void turn(struct height_walk *w, bool in, double t, double dt, uint32_t part)
{
    if (!w->started) { // what the line's first piece says
        w->started = true;
        if (in && w->sides)
            flat(w, w->ends[0], t);
        w->in = in;
        return;
    }
    if (in == w->in)
        return;
    boundary_list_add(w->out, (t + w->shift) / w->length, (dt + w->error) / w->length,
                      w->in ? CROSS_EXIT : CROSS_ENTER, part);
    w->in = in;
}

// One triangle's plane between t0 and t1: height h + hx x + hz z over the cell's corner.
static void piece(struct height_walk *w, const double plane[3], const double corner[2],
                  double t0, double t1, uint32_t part)
{
    const double x = w->o[0] - corner[0], z = w->o[2] - corner[1];
    const double above = w->o[1] - (plane[0] + plane[1] * x + plane[2] * z);
    const double slope = w->d[1] - (plane[1] * w->d[0] + plane[2] * w->d[2]);
    if (!w->started)
        turn(w, above + t0 * slope < 0, t0, 0, part);
    const bool in = above + t1 * slope < 0;
    if (in == w->in)
        return;
    const double noise = GAMMA(8) * ((w->cells + fabs(w->o[0]) + fabs(w->o[2])) *
                                         (fabs(plane[1]) + fabs(plane[2])) +
                                     fabs(plane[0]) + fabs(w->o[1]));
    const double t = fmax(t0, fmin(t1, -above / slope));
    turn(w, in, t, fmin(noise / fabs(slope), t1 - t0), part);
}

static void cell(struct height_walk *w, int i, int j, double t0, double t1)
{
    const struct height_field *f = w->field;
    const double y00 = value(f, i, j) / HEIGHT_UNIT,
                 y10 = value(f, i + 1, j) / HEIGHT_UNIT;
    const double y01 = value(f, i, j + 1) / HEIGHT_UNIT,
                 y11 = value(f, i + 1, j + 1) / HEIGHT_UNIT;
    const double below[3] = {y00, y10 - y00, y01 - y00};
    const double beyond[3] = {y11, y11 - y01, y11 - y10};
    const double near[2] = {i, j}, far[2] = {i + 1, j + 1};
    const uint32_t part = 2 * ((uint32_t)j * (uint32_t)(f->h.width - 1) + (uint32_t)i);
    // x + z over the cell's diagonal
    const double over = w->o[0] + w->o[2] - (i + j + 1.), rise = w->d[0] + w->d[2];
    const bool first = over + t0 * rise < 0, last = over + t1 * rise < 0;
    const double t = first == last ? t1 : fmax(t0, fmin(t1, -over / rise));
    if (first)
        piece(w, below, near, t0, t, part);
    else
        piece(w, beyond, far, t0, t, part + 1);
    if (first == last)
        return;
    if (last)
        piece(w, below, near, t, t1, part);
    else
        piece(w, beyond, far, t, t1, part + 1);
}

// Where the line passes a grid line of axis 0 or 2, and on which side of it it is at t0.
static double pass(const struct height_walk *w, int axis, int line, double t0,
                   int *side_at)
{
    const double d = w->d[axis], t = (line - w->o[axis]) / d;
    if (d == 0) {
        *side_at = w->o[axis] >= line;
        return HUGE_VAL;
    }
    *side_at = (t <= t0) == (d > 0);
    return t > t0 ? t : HUGE_VAL;
}

// The triangle below the line at t.
static uint32_t part_at(const struct height_walk *w, double t)
{
    const int columns = w->field->h.width - 1, rows = w->field->h.height - 1;
    const double x = w->o[0] + t * w->d[0], z = w->o[2] + t * w->d[2];
    const int i = (int)fmax(0, fmin(floor(x), columns - 1));
    const int j = (int)fmax(0, fmin(floor(z), rows - 1));
    return 2 * ((uint32_t)j * (uint32_t)columns + (uint32_t)i) + (x - i + z - j >= 1);
}

static void block(struct height_walk *w, int level, int i, int j, double t0, double t1)
{
    const struct height_field *f = w->field;
    if (level == 0) {
        cell(w, i, j, t0, t1);
        return;
    }
    const struct height_level *l = &f->level[level];
    const float *range = l->range[(size_t)j * (size_t)l->width + (size_t)i];
    const double y0 = w->o[1] + t0 * w->d[1], y1 = w->o[1] + t1 * w->d[1];
    const double margin = GAMMA(16) * (fabs(w->o[1]) + fabs(y0) + fabs(y1) + 1);
    const bool over = fmin(y0, y1) > (double)range[1] / HEIGHT_UNIT + margin;
    if (over || fmax(y0, y1) < (double)range[0] / HEIGHT_UNIT - margin) {
        turn(w, !over, t0, w->error, part_at(w, t0));
        return;
    }
    const int half = 1 << (level - 1), child = level - 1;
    const int child_w = child ? f->level[child].width : f->h.width - 1;
    const int child_h = child ? f->level[child].height : f->h.height - 1;
    int a = 0, b = 0;
    double tx = HUGE_VAL, tz = HUGE_VAL;
    if (2 * i + 1 < child_w)
        tx = pass(w, 0, (2 * i + 1) * half, t0, &a);
    if (2 * j + 1 < child_h)
        tz = pass(w, 2, (2 * j + 1) * half, t0, &b);
    for (double t = t0; t < t1;) {
        const double next = fmin(t1, fmin(tx, tz));
        block(w, child, 2 * i + a, 2 * j + b, t, next);
        if (tx <= next) {
            a = !a;
            tx = HUGE_VAL;
        }
        if (tz <= next) {
            b = !b;
            tz = HUGE_VAL;
        }
        t = next;
    }
}

// The stretch of the line over the square; false: none.
static bool clip(struct height_walk *w, double *t0, double *t1)
{
    const double size[3] = {w->field->h.width - 1, 0, w->field->h.height - 1};
    for (int axis = 0; axis < 3; axis += 2) {
        const double d = w->d[axis], o = w->o[axis];
        if (d == 0) {
            if (!(o >= 0 && o <= size[axis]))
                return false;
            continue;
        }
        const double a = -o / d, b = (size[axis] - o) / d;
        if (fmin(a, b) > *t0) {
            *t0 = fmin(a, b);
            w->ends[0] = axis;
        }
        if (fmax(a, b) < *t1) {
            *t1 = fmax(a, b);
            w->ends[1] = axis;
        }
    }
    return *t0 < *t1;
}

static struct height_walk walk_of(const struct height_field *f, const struct ray *ray,
                                  struct boundary_list *out)
{
    const double size = 2 + fabs(f->low) + fabs(f->high);
    struct height_walk w = {.field = f, .out = out, .length = vec3_length(ray->d)};
    const struct vec3 u = vec3_scale(1 / w.length, ray->d);
    const struct vec3 middle = vec3(0.5, 0.5 * (f->low + f->high), 0.5);
    w.shift = vec3_dot(vec3_sub(middle, ray->o), u);
    const struct vec3 o = vec3_mad(ray->o, w.shift, u);
    const double sx = f->h.width - 1, sz = f->h.height - 1;
    w.o[0] = sx * o.x;
    w.o[1] = o.y;
    w.o[2] = sz * o.z;
    // A field that was made thin is crossed by lines that are steep here.
    const double across = fmax(fabs(u.x), fabs(u.z)),
                 most = RUNS_ALONG(across, 1) ? 1 : across;
    w.d[0] = RUNS_ALONG(u.x, most) ? 0 : sx * u.x;
    w.d[1] = u.y;
    w.d[2] = RUNS_ALONG(u.z, most) ? 0 : sz * u.z;
    w.cells = sx + sz;
    w.error = GAMMA(8) * (size + fabs(w.shift) + vec3_max_abs(ray->o));
    return w;
}

// From t0 to t1 of the walk; whole vertical lines in one cell.
static void walk(struct height_walk *w, double t0, double t1)
{
    const struct height_field *f = w->field;
    if (w->d[0] != 0 || w->d[2] != 0) {
        block(w, f->top, 0, 0, t0, t1);
        return;
    }
    const int i = (int)fmax(0, fmin(floor(w->o[0]), f->h.width - 2.));
    const int j = (int)fmax(0, fmin(floor(w->o[2]), f->h.height - 2.));
    const double reach = fabs(w->o[1]) + fabs(f->low) + fabs(f->high) + 1;
    cell(w, i, j, fmax(t0, -reach), fmin(t1, reach));
}

// The half space below the water within the same stretch of the line.
static void add_water(struct height_walk *w, double t0, double t1)
{
    const double h = w->field->water, t = (h - w->o[1]) / w->d[1];
    const bool level = RUNS_ALONG(w->d[1], 1);
    bool in = level || isinf(t0) ? (level ? w->o[1] < h : w->d[1] > 0)
                                 : w->o[1] + t0 * w->d[1] < h;
    w->in = false;
    if (in && !isinf(t0))
        flat(w, w->ends[0], t0);
    w->in = in;
    if (!level && t > t0 && t < t1) {
        flat(w, 1, t);
        w->in = in = !in;
    }
    if (in && !isinf(t1))
        flat(w, w->ends[1], t1);
}

// Keeps the crossings of the union of two solids; `depth` of them hold the line's start.
static void unite(struct boundary_list *l, uint32_t from, int depth)
{
    uint32_t kept = from;
    boundary_list_sort(l, from);
    for (uint32_t i = from; i < l->count; i++) {
        const int before = depth;
        depth += l->at[i].crossing == CROSS_ENTER ? 1 : -1;
        if (before == 0 || depth == 0)
            l->at[kept++] = l->at[i];
    }
    l->count = kept;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    struct height_walk w = walk_of(shape, ray, out);
    const uint32_t from = out->count;
    double t0 = -HUGE_VAL, t1 = HUGE_VAL;
    if (!clip(&w, &t0, &t1))
        return;
    w.sides = !isinf(t0);
    walk(&w, t0, t1);
    if (w.in && !isinf(t1))
        flat(&w, w.ends[1], t1);
    if (!w.field->under_water)
        return;
    add_water(&w, t0, t1);
    unite(out, from, isinf(t0) && w.d[1] > 0 ? 2 : 0);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    return k->height_field(shape, rays, lanes, any, out);
}

// Lanes number samples by 31 bits and have the levels in a small table.
static bool has_lanes(const void *shape)
{
    const struct height_field *f = shape;
    return f->top < HEIGHT_LANE_LEVELS &&
           (size_t)f->h.width * (size_t)f->h.height < (size_t)1 << 30;
}

// ---- the rest -------------------------------------------------------------------------

static struct aabb surface_bounds(const void *shape)
{
    const struct height_field *f = shape;
    return aabb_pad((struct aabb){vec3(0, fmax(f->low, f->water), 0),
                                  vec3(1, fmax(f->high, f->water), 1)});
}

static struct aabb bounds(const void *shape)
{
    struct aabb b = surface_bounds(shape);
    b.min.y = -HUGE_VAL;
    return b;
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct height_field *f = shape;
    if (!(p.x >= 0 && p.x <= 1 && p.z >= 0 && p.z <= 1))
        return false;
    const double x = p.x * (f->h.width - 1), z = p.z * (f->h.height - 1);
    const int i = (int)fmin(floor(x), f->h.width - 2.);
    const int j = (int)fmin(floor(z), f->h.height - 2.);
    const double u = x - i, v = z - j, y10 = value(f, i + 1, j), y01 = value(f, i, j + 1);
    const double y00 = value(f, i, j), y11 = value(f, i + 1, j + 1);
    const double y = u + v < 1 ? y00 + u * (y10 - y00) + v * (y01 - y00)
                               : y11 + (1 - u) * (y01 - y11) + (1 - v) * (y10 - y11);
    return p.y < fmax(y / HEIGHT_UNIT, f->water);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct height_field *f = shape;
    if (b->part >= FLAT) { // CSG asks how steeply a ray meets it
        const uint32_t axis = b->part - FLAT;
        out->p = p;
        out->ng = out->ns = vec3(axis == 0, axis == 1, axis == 2);
        return;
    }
    const uint32_t at = b->part / 2, columns = (uint32_t)(f->h.width - 1);
    const int i = (int)(at % columns), j = (int)(at / columns);
    const double y10 = value(f, i + 1, j), y01 = value(f, i, j + 1);
    const double corner = b->part % 2 ? value(f, i + 1, j + 1) : value(f, i, j);
    const double sx = f->h.width - 1, sz = f->h.height - 1;
    const struct vec3 n =
        b->part % 2 ? vec3(sx * (y01 - corner), HEIGHT_UNIT, sz * (y10 - corner))
                    : vec3(sx * (corner - y10), HEIGHT_UNIT, sz * (corner - y01));
    out->p = p;
    out->ng = out->ns = vec3_normalize(n);
    out->uv = (struct vec2){p.x, p.y};
    if (!f->smooth)
        return;
    const double u = fmax(0, fmin(1, p.x * sx - i)), v = fmax(0, fmin(1, p.z * sz - j));
    const double share[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    struct vec3 s = {0, 0, 0};
    for (int k = 0; k < 4; k++) {
        const int ci = i + (k & 1), cj = j + (k >> 1);
        double made[3];
        const double *c = made;
        if (f->normal)
            c = f->normal[(size_t)cj * (size_t)f->h.width + (size_t)ci];
        else
            sample_normal(f, ci, cj, made);
        s = vec3_mad(s, share[k], vec3(c[0], c[1], c[2]));
    }
    out->ns = vec3_normalize(s);
}

static void print(const void *shape, FILE *out)
{
    const struct height_field *f = shape;
    fprintf(out, "height_field { /* %d x %d samples */", f->h.width, f->h.height);
    fputs(f->smooth ? " smooth water_level " : " water_level ", out);
    shape_print_number(out, f->water + 0.001 / HEIGHT_UNIT);
}

const struct shape_ops height_field_ops = {
    .keyword = "height_field",
    .size = sizeof(struct height_field),
    .flags = SHAPE_SOLID | SHAPE_HIERARCHY,
    .build = build,
    .bounds = bounds,
    .surface_bounds = surface_bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .has_lanes = has_lanes,
    .surface = surface,
    .print = print,
};
