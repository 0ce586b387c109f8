#include "trace/face_pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/larger.h"
#include "trace/face.h"

struct face *faces_add(struct faces *f)
{
    f->at = must_grow(f->at, f->count, &f->capacity, sizeof *f->at);
    struct face *x = &f->at[f->count++];
    *x = (struct face){.flat = false};
    return x;
}

// Which faces of a leaf count: those of opaque objects and of what is clear.
static void gather(const struct world *w, uint32_t leaf, struct faces *out)
{
    const struct leaf *l = &w->leaf[leaf];
    const uint32_t first = out->count;
    const bool clear = !w->surface[l->surface].opaque;
    const bool opaque = w->object[l->object].opaque;
    if (opaque || clear) {
        flat_faces(l, out);
        curved_faces(l, out);
    }
    for (uint32_t i = first; i < out->count; i++) {
        out->at[i].leaf = leaf;
        out->at[i].clear = clear;
    }
}

static struct aabb box_of(const struct world *w, const struct face *f)
{
    return f->flat ? flat_face_box(&f->plane, f->error) : w->leaf[f->leaf].bounds;
}

// Where the rest of its object leaves the face to be met: a plane that is clipped or one of
// several leaves has an end there.
static struct aabb seen_within(const struct world *w, const struct face *f)
{
    const struct aabb object = w->object[w->leaf[f->leaf].object].bounds;
    const struct vec3 e = vec3(f->error, f->error, f->error);
    return aabb_meet(box_of(w, f), aabb_pad((struct aabb){vec3_sub(object.min, e),
                                                          vec3_add(object.max, e)}));
}

static void stretch_add(struct face *f, struct vec3 p)
{
    const double x = vec3_dot(face_odd, p);
    f->from = fmin(f->from, x);
    f->to = fmax(f->to, x);
}

static void stretch_of(const struct world *w, struct face *f)
{
    const struct aabb box = box_of(w, f);
    const bool ends = aabb_is_finite(box);
    f->from = ends ? INFINITY : -INFINITY;
    f->to = -f->from;
    if (ends && f->flat)
        for (uint32_t c = 0; c < f->plane.corners; c++)
            stretch_add(f, f->plane.corner[c]);
    else if (ends) {
        stretch_add(f, box.min); // all parts of the direction are positive
        stretch_add(f, box.max);
    }
}

// ---- likely pairs, by keys --------------------------------------------------------------

static double key_error(const struct face *f) { return 8 * (f->error + GAMMA(64)); }

// How many faces have keys in a cell, by hashes of the cells of two grids, one half a cell
// off: faces in one place share a cell in one of them.
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

static bool coincide(const struct world *w, const struct face *f, const struct face *g)
{
    if (f->flat != g->flat || !aabb_overlap(seen_within(w, f), seen_within(w, g)))
        return false;
    return f->flat ? flat_faces_coincide(f, g) : curved_faces_coincide(f, g);
}

// Of one run over all pairs. First leaves are marked, then pairs of marked leaves listed.
struct hunt {
    struct world *w;
    uint64_t left; // comparisons: a crowd in one plane is not worth more time
    bool list;
    struct face_pair *pair;
    uint32_t count, capacity;
};

static void list_half(struct hunt *h, const struct face *f, const struct face *g)
{
    h->pair = must_grow(h->pair, h->count, &h->capacity, sizeof *h->pair);
    h->pair[h->count++] = (struct face_pair){
        .leaf = f->leaf,
        .other = h->w->leaf[g->leaf].object,
        .contact = f->clear && g->clear,
        .error = f->error + g->error,
        .where = aabb_meet(seen_within(h->w, f), seen_within(h->w, g))};
}

static void list_pair(struct hunt *h, const struct face *f, const struct face *g)
{
    const bool f_later = f->clear != g->clear
                             ? f->clear
                             : h->w->leaf[f->leaf].object > h->w->leaf[g->leaf].object;
    const bool both = f->clear && g->clear;
    if (f_later || both)
        list_half(h, f, g);
    if (!f_later || both)
        list_half(h, g, f);
}

static void take_pair(struct hunt *h, const struct face *f, const struct face *g)
{
    struct leaf *a = &h->w->leaf[f->leaf], *b = &h->w->leaf[g->leaf];
    if (h->list)
        list_pair(h, f, g);
    else
        a->paired = b->paired = true;
}

static bool matters(const struct hunt *h, const struct face *f, const struct face *g)
{
    const struct leaf *a = &h->w->leaf[f->leaf], *b = &h->w->leaf[g->leaf];
    if (a->object == b->object)
        return false;
    if (f->clear ||
        g->clear) // flat ones on opaque ones are found by boxes (coincident.c)
        return f->clear == g->clear || !f->flat;
    return h->list ? a->paired && b->paired : a->surface != b->surface;
}

// Pairs among faces of one key, in the order of their beginnings.
static void pairs(struct hunt *h, struct face *f, uint32_t count)
{
    qsort(f, count, sizeof *f, by_from);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count && f[k].from < f[i].to && h->left;
             k++, --h->left)
            if (matters(h, &f[i], &f[k]) && coincide(h->w, &f[i], &f[k]))
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
        if (w->leaf[i].drawn)
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
    const struct face_pair *x = a, *y = b;
    return x->leaf != y->leaf         ? (x->leaf > y->leaf) - (x->leaf < y->leaf)
           : x->contact != y->contact ? x->contact - y->contact
                                      : (x->other > y->other) - (x->other < y->other);
}

// Says of a leaf that it has this pair.
static void tell_contact(struct world *w, const struct face_pair *p)
{
    struct leaf *l = &w->leaf[p->leaf];
    l->apart = larger(p->error, l->apart);
    w->surface[l->surface].in_contact = w->has_contacts = true;
}

static void keep_pairs(struct world *w, const struct hunt *h)
{
    struct face_pair *pair = arena_new_array(w->arena, struct face_pair, h->count);
    memcpy(pair, h->pair, h->count * sizeof *pair);
    qsort(pair, h->count, sizeof *pair, by_leaf);
    for (uint32_t i = h->count; i-- > 0;) {
        w->leaf[pair[i].leaf].first_pair = i;
        if (pair[i].contact)
            tell_contact(w, &pair[i]);
    }
    w->face_pair = pair;
    w->face_pair_count = h->count;
}

static bool mark(struct world *w, struct faces *f)
{
    for (uint32_t i = 0; i < f->count; i++)
        stretch_of(w, &f->at[i]);
    struct hunt h = {.w = w};
    hunt(&h, f);
    h.list = true;
    hunt(&h, f);
    if (h.count > 0)
        keep_pairs(w, &h);
    free(h.pair);
    return h.count > 0;
}

bool face_pairs_mark(struct world *w)
{
    if (w->object_count < 2 || w->object_count > OBJECTS_MOST)
        return false;
    struct faces f = {.count = 0};
    struct cells c = {.bits = 10, .width = 0x1p-30};
    if (aabb_is_finite(w->bounds))
        c.width *= 1 + fmax(vec3_max_abs(w->bounds.min), vec3_max_abs(w->bounds.max));
    while (c.bits < 18 && (uint64_t)1 << c.bits < 16 * (uint64_t)w->leaf_count)
        c.bits++;
    c.count = must_calloc((size_t)1 << c.bits, 1);
    walk(w, &f, &c, count_faces);
    walk(w, &f, &c, keep_faces);
    const bool found = f.count > 1 && f.count <= FACES_MOST && mark(w, &f);
    free(c.count);
    free(f.at);
    return found;
}
