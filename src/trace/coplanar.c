#include "trace/coplanar.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "scene/shape.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/disc.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/triangle.h"

// A flat face of a leaf, in world space. What is round is taken for the square around it.
struct face {
    struct vec3 corner[4]; // or a point on the plane
    uint32_t corners;      // 0: it has no end
    struct vec3 normal;    // outward, unit
    double error;          // bounds the distance of the corners from the true plane
    uint32_t leaf;
    bool sheet; // seen from both sides
    double key; // nearly equal for planes that are nearly equal
    double from, to;
};

struct faces {
    struct face *at;
    uint32_t count, capacity;
};

static struct face *add(struct faces *f, struct vec3 normal, uint32_t corners)
{
    if (f->count == f->capacity) {
        f->capacity = f->capacity ? 2 * f->capacity : 64;
        f->at = realloc(f->at, f->capacity * sizeof *f->at);
        if (!f->at)
            abort();
    }
    struct face *x = &f->at[f->count++];
    *x = (struct face){.normal = normal, .corners = corners};
    return x;
}

// ---- faces of shapes, in their own space ----------------------------------------------

static void box_faces(const void *shape, struct faces *out)
{
    const struct box *b = shape;
    const double side[2][3] = {{b->min.x, b->min.y, b->min.z},
                               {b->max.x, b->max.y, b->max.z}};
    for (int k = 0; k < 6; k++) {
        const int axis = k >> 1, end = k & 1, u = (axis + 1) % 3, v = (axis + 2) % 3;
        double n[3] = {0}, p[3];
        n[axis] = end ? 1 : -1;
        struct face *f = add(out, vec3(n[0], n[1], n[2]), 4);
        for (int c = 0; c < 4; c++) {
            p[axis] = side[end][axis];
            p[u] = side[c == 1 || c == 2][u];
            p[v] = side[c >> 1][v];
            f->corner[c] = vec3(p[0], p[1], p[2]);
        }
    }
}

static void plane_faces(const void *shape, struct faces *out)
{
    const struct plane *p = shape;
    add(out, p->normal, 0)->corner[0] = p->point;
}

// Of half the width r around a centre.
static void square(struct faces *out, struct vec3 centre, struct vec3 normal, double r)
{
    const struct frame g = frame_around(centre, normal);
    struct face *f = add(out, normal, 4);
    for (int c = 0; c < 4; c++)
        f->corner[c] = vec3_add(
            centre, frame_vector(&g, c == 1 || c == 2 ? r : -r, c >> 1 ? r : -r, 0));
}

static void disc_faces(const void *shape, struct faces *out)
{
    const struct disc *d = shape;
    square(out, d->centre, d->normal, d->radius);
    out->at[out->count - 1].sheet = true;
}

static void ends(const struct frame *f, double length, double r0, double r1,
                 struct faces *out)
{
    square(out, f->origin, vec3_neg(f->e3), r0);
    square(out, vec3_mad(f->origin, length, f->e3), f->e3, r1);
}

static void cylinder_faces(const void *shape, struct faces *out)
{
    const struct cylinder *c = shape;
    if (!c->open)
        ends(&c->frame, c->length, c->radius, c->radius, out);
}

static void cone_faces(const void *shape, struct faces *out)
{
    const struct cone *c = shape;
    if (!c->open)
        ends(&c->frame, c->length, c->r0, c->r1, out);
}

static void triangle_faces(const void *shape, struct faces *out)
{
    const struct triangle *t = shape;
    if (t->degenerate)
        return;
    struct face *f = add(out, t->face, 3);
    memcpy(f->corner, t->p, sizeof t->p);
    f->sheet = true;
}

static const struct {
    const struct shape_ops *ops;
    void (*faces)(const void *shape, struct faces *out);
} kinds[] = {
    {&box_ops, box_faces},
    {&plane_ops, plane_faces},
    {&disc_ops, disc_faces},
    {&cylinder_ops, cylinder_faces},
    {&cone_ops, cone_faces},
    {&triangle_ops, triangle_faces},
    {&smooth_triangle_ops, triangle_faces},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

// ---- in the world -----------------------------------------------------------------------

// A direction that no scene's author had in mind.
static const struct vec3 odd = {.5413, .3178, .7791};

// The key is made of the plane's point nearest to the origin and of the normal, whichever
// way it points: equal for faces in one plane but for some of their errors.
static void place(const struct leaf *l, struct face *f)
{
    const struct transform *t = l->transform;
    const uint32_t points = f->corners ? f->corners : 1;
    double size = 0;
    for (uint32_t c = 0; c < points; c++) {
        if (!t->identity)
            f->corner[c] = transform_point(t, f->corner[c]);
        size = fmax(size, vec3_max_abs(f->corner[c]));
    }
    if (!t->identity)
        f->normal = vec3_normalize(transform_normal(t, f->normal));
    if (l->inverted)
        f->normal = vec3_neg(f->normal);
    f->error = GAMMA(64) * (size + 2 * vec3_max_abs(t->offset));
    const double across = vec3_dot(f->normal, odd);
    f->key = vec3_dot(f->normal, f->corner[0]) * across + across * across;
}

// The faces of a leaf, behind those of `out`.
static void gather(const struct world *w, uint32_t leaf, struct faces *out)
{
    const struct leaf *l = &w->leaf[leaf];
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].ops == l->ops) {
            const uint32_t first = out->count;
            kinds[k].faces(l->shape, out);
            for (uint32_t i = first; i < out->count; i++) {
                out->at[i].leaf = leaf;
                place(l, &out->at[i]);
            }
            return;
        }
}

static double key_error(const struct face *f) { return 8 * (f->error + GAMMA(64)); }

static void stretch_of(struct face *f)
{
    f->from = f->corners ? INFINITY : -INFINITY;
    f->to = -f->from;
    for (uint32_t c = 0; c < f->corners; c++) {
        const double x = vec3_dot(odd, f->corner[c]);
        f->from = fmin(f->from, x);
        f->to = fmax(f->to, x);
    }
}

// How many faces have keys in a cell, by hashes of the cells of two grids, one half a cell
// off: faces in one plane share a cell in one of them.
struct cells {
    uint8_t *count;
    unsigned bits;
    double width; // much more than errors of keys
};

static uint8_t *cell_of(const struct cells *c, double key, int grid)
{
    const double at = floor(key / c->width + .5 * grid);
    const uint64_t x =
        (uint64_t)(int64_t)fmax(-0x1p62, fmin(at, 0x1p62)) * 2 + (uint64_t)grid;
    return c->count + (x * 0x9e3779b97f4a7c15u >> (64 - c->bits));
}

static void count_face(const struct cells *c, const struct face *f)
{
    for (int g = 0; g < 2; g++) {
        uint8_t *n = cell_of(c, f->key, g);
        *n = *n < 2 ? *n + 1 : 2;
    }
}

static bool has_mates(const struct cells *c, const struct face *f)
{
    return key_error(f) > c->width / 16 || *cell_of(c, f->key, 0) > 1 ||
           *cell_of(c, f->key, 1) > 1;
}

// ---- pairs ------------------------------------------------------------------------------

// Whether a line along a side of f has all of g beyond it, or no more than its edge.
static bool parted_by_side(const struct face *f, const struct face *g, double error)
{
    for (uint32_t i = 0; i < f->corners; i++) {
        const struct vec3 a = f->corner[i], b = f->corner[(i + 1) % f->corners];
        const struct vec3 along = vec3_sub(b, a);
        const struct vec3 inward = vec3_cross(f->normal, along);
        const double length = vec3_length(inward);
        // The third corner tells which way the corners go around.
        const double sign =
            vec3_dot(inward, vec3_sub(f->corner[(i + 2) % f->corners], a)) < 0 ? -1 : 1;
        bool all = true;
        for (uint32_t k = 0; k < g->corners && all; k++)
            all = sign * vec3_dot(inward, vec3_sub(g->corner[k], a)) <= error * length;
        if (all)
            return true;
    }
    return false;
}

static bool in_plane(const struct face *f, const struct face *g, double error)
{
    for (uint32_t k = 0; k < (g->corners ? g->corners : 1); k++)
        if (!(fabs(vec3_dot(f->normal, vec3_sub(g->corner[k], f->corner[0]))) <= error))
            return false;
    return true;
}

static bool coincide(const struct face *f, const struct face *g)
{
    const double error = f->error + g->error, turn = vec3_dot(f->normal, g->normal);
    if (turn < 0 && !f->sheet && !g->sheet)
        return false;
    // Of two planes the normals themselves are compared; a finite face has its corners.
    if (!f->corners && !g->corners && !(fabs(turn) >= 1 - GAMMA(64)))
        return false;
    if (!in_plane(g->corners ? f : g, g->corners ? g : f, error))
        return false;
    if (f->corners && g->corners)
        return in_plane(g, f, error) && !parted_by_side(f, g, error) &&
               !parted_by_side(g, f, error);
    return true;
}

static int by_key(const void *a, const void *b)
{
    const struct face *x = a, *y = b;
    return (x->key > y->key) - (x->key < y->key);
}

static int by_from(const void *a, const void *b)
{
    const struct face *x = a, *y = b;
    return (x->from > y->from) - (x->from < y->from);
}

static struct aabb box_of(const struct face *f)
{
    if (!f->corners)
        return aabb_infinite();
    const struct vec3 error = vec3(f->error, f->error, f->error);
    struct aabb box = aabb_empty();
    for (uint32_t c = 0; c < f->corners; c++) {
        box = aabb_add(box, vec3_sub(f->corner[c], error));
        box = aabb_add(box, vec3_add(f->corner[c], error));
    }
    return box;
}

// Of one run over all pairs. First leaves are marked, then pairs of marked leaves listed.
struct hunt {
    struct world *w;
    uint64_t left; // comparisons: a crowd in one plane is not worth more time
    bool list;
    struct coplanar_pair *pair;
    uint32_t count, capacity;
};

static void list_pair(struct hunt *h, const struct face *f, const struct face *g)
{
    const bool f_later = h->w->leaf[f->leaf].object > h->w->leaf[g->leaf].object;
    const struct face *later = f_later ? f : g, *earlier = f_later ? g : f;
    if (h->count == h->capacity) {
        h->capacity = h->capacity ? 2 * h->capacity : 64;
        h->pair = realloc(h->pair, h->capacity * sizeof *h->pair);
        if (!h->pair)
            abort();
    }
    h->pair[h->count++] =
        (struct coplanar_pair){.leaf = later->leaf,
                               .earlier = h->w->leaf[earlier->leaf].object,
                               .where = aabb_meet(box_of(f), box_of(g))};
}

static void take_pair(struct hunt *h, const struct face *f, const struct face *g)
{
    struct leaf *a = &h->w->leaf[f->leaf], *b = &h->w->leaf[g->leaf];
    if (h->list)
        list_pair(h, f, g);
    else
        a->coplanar = b->coplanar = true;
}

static bool matters(const struct hunt *h, const struct face *f, const struct face *g)
{
    const struct leaf *a = &h->w->leaf[f->leaf], *b = &h->w->leaf[g->leaf];
    return a->object != b->object &&
           (h->list ? a->coplanar && b->coplanar : a->surface != b->surface);
}

// Pairs among faces of one key, in the order of their beginnings.
static void pairs(struct hunt *h, struct face *f, uint32_t count)
{
    qsort(f, count, sizeof *f, by_from);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count && f[k].from < f[i].to && h->left;
             k++, --h->left)
            if (matters(h, &f[i], &f[k]) && coincide(&f[i], &f[k]))
                take_pair(h, &f[i], &f[k]);
}

// In crowds nothing is looked for: it would take time that other scenes of their size do not.
enum { OBJECTS_MOST = 1 << 14, FACES_MOST = 1 << 13 };

// Calls `each` for all leaves that may have faces.
static void walk(const struct world *w, struct faces *f, const struct cells *c,
                 void (*each)(const struct cells *c, struct faces *f, uint32_t first))
{
    for (uint32_t i = 0; i < w->leaf_count && f->count <= FACES_MOST; i++) {
        const uint32_t first = f->count;
        if (w->leaf[i].drawn && w->object[w->leaf[i].object].opaque)
            gather(w, i, f);
        if (f->count > first)
            each(c, f, first);
    }
}

static void count_faces(const struct cells *c, struct faces *f, uint32_t first)
{
    for (uint32_t i = first; i < f->count; i++)
        count_face(c, &f->at[i]);
    f->count = first;
}

static void keep_faces(const struct cells *c, struct faces *f, uint32_t first)
{
    uint32_t kept = first;
    for (uint32_t i = first; i < f->count; i++)
        if (has_mates(c, &f->at[i]))
            f->at[kept++] = f->at[i];
    f->count = kept;
}

static void hunt(struct hunt *h, struct faces *f)
{
    h->left = 64 * (uint64_t)f->count;
    qsort(f->at, f->count, sizeof *f->at, by_key);
    for (uint32_t i = 0, end; i < f->count; i = end) {
        for (end = i + 1; end < f->count; end++)
            if (f->at[end].key - f->at[end - 1].key > key_error(&f->at[end]))
                break;
        if (end - i > 1)
            pairs(h, f->at + i, end - i);
    }
}

static int by_leaf(const void *a, const void *b)
{
    const struct coplanar_pair *x = a, *y = b;
    return x->leaf != y->leaf ? (x->leaf > y->leaf) - (x->leaf < y->leaf)
                              : (x->earlier > y->earlier) - (x->earlier < y->earlier);
}

static void keep_pairs(struct world *w, const struct hunt *h)
{
    struct coplanar_pair *pair =
        arena_new_array(w->arena, struct coplanar_pair, h->count);
    memcpy(pair, h->pair, h->count * sizeof *pair);
    qsort(pair, h->count, sizeof *pair, by_leaf);
    for (uint32_t i = h->count; i-- > 0;)
        w->leaf[pair[i].leaf].first_pair = i;
    w->coplanar_pair = pair;
    w->coplanar_pair_count = h->count;
}

static bool mark(struct world *w, struct faces *f)
{
    for (uint32_t i = 0; i < f->count; i++)
        stretch_of(&f->at[i]);
    struct hunt h = {.w = w};
    hunt(&h, f);
    h.list = true;
    hunt(&h, f);
    if (h.count > 0)
        keep_pairs(w, &h);
    free(h.pair);
    return h.count > 0;
}

bool coplanar_mark(struct world *w)
{
    if (w->object_count < 2 || w->object_count > OBJECTS_MOST)
        return false;
    struct faces f = {.count = 0};
    struct cells c = {.bits = 10, .width = 0x1p-30};
    if (aabb_is_finite(w->bounds))
        c.width *= 1 + fmax(vec3_max_abs(w->bounds.min), vec3_max_abs(w->bounds.max));
    while (c.bits < 18 && (uint64_t)1 << c.bits < 16 * (uint64_t)w->leaf_count)
        c.bits++;
    c.count = calloc((size_t)1 << c.bits, 1);
    if (!c.count)
        abort();
    walk(w, &f, &c, count_faces);
    walk(w, &f, &c, keep_faces);
    const bool found = f.count > 1 && f.count <= FACES_MOST && mark(w, &f);
    free(c.count);
    free(f.at);
    return found;
}
