// The vertex of a loop, and edges along features (Kobbelt et al. 2001, sections 3.2, 3.3).
#include <stdlib.h>

#include "base/memory.h"
#include "math/eigen.h"
#include "tess/contour.h"

// Normals that stay within this cosine of each other (37 degrees) are one smooth piece.
static const double smooth_cosine = 0.8;
// Faces of two shapes may meet at less (11 degrees) and still make an edge.
static const double face_cosine = 0.98;
// Steps shorter than this part of a cell have found where faces meet.
static const double found_meet = 1e-9;
// A direction in which the tangent planes fix the vertex less than this, relative to the
// best, is left to the mean of the crossings: along an edge, or in a plane.
static const double flat_share = 0.05;
// The same once the planes are those at the vertex: 9 degrees between two.
static const double face_share = 0.006;
// A vertex farther from the surface than this part of a cell is no feature.
static const double feature_error = 0.05;
// How far, in cells, a vertex may lie out of its own.
static const double cell_margin = 0.7;

// ---- the vertex of a loop --------------------------------------------------------------

// The least move from p to the tangent planes at points of faces, in the sense of least
// squares.
static struct vec3 to_planes(const struct tess_crossing *face, int count, double share,
                             struct vec3 p)
{
    double a[3][3] = {{0}};
    struct vec3 right = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        const struct tess_crossing *x = &face[i];
        const double n[3] = {x->n.x, x->n.y, x->n.z};
        const double d = vec3_dot(x->n, vec3_sub(x->p, p));
        for (int r = 0; r < 3; r++)
            for (int s = 0; s < 3; s++)
                a[r][s] += n[r] * n[s];
        right = vec3_mad(right, d, x->n);
    }
    const struct eigen e = eigen_of((const double(*)[3])a);
    const double most = fmax(e.value[0], fmax(e.value[1], e.value[2]));
    struct vec3 move = {0, 0, 0};
    for (int k = 0; k < 3; k++)
        if (e.value[k] > share * most)
            move = vec3_mad(move, vec3_dot(e.vector[k], right) / e.value[k], e.vector[k]);
    return move;
}

// Where the faces around a loop meet: nearest to their tangent planes, which are taken
// anew at the place found until it is on curved faces too (Newton's method).
static struct vec3 meet_of_faces(const struct contour *c, const uint32_t *vertex,
                                 int count, struct vec3 mean)
{
    enum { LOOP_MOST = 12, STEPS = 6 };
    struct tess_crossing face[LOOP_MOST];
    for (int i = 0; i < count; i++)
        face[i] = c->crossing[vertex[i]];
    struct vec3 p = mean;
    for (int step = 0; step < STEPS; step++) {
        const struct vec3 move =
            to_planes(face, count, step ? face_share : flat_share, p);
        p = vec3_add(p, move);
        if ((step && !(vec3_length(move) > found_meet * c->step)) ||
            vec3_length(vec3_sub(p, mean)) > 2 * c->step)
            break;
        for (int i = 0; i < count; i++) {
            struct tess_crossing on;
            if (vec3_dot(face[i].n, face[i].n) > 0 &&
                tess_solid_project(c->solid, &face[i], p, &on) &&
                vec3_length(vec3_sub(on.p, p)) < c->step &&
                vec3_dot(on.n, face[i].n) > smooth_cosine)
                face[i] = on;
        }
    }
    return p;
}

// Two faces, or one that is not smooth.
static bool is_bent(const struct contour *c, const uint32_t *vertex, int count)
{
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            const struct tess_crossing *x = &c->crossing[vertex[i]];
            const struct tess_crossing *y = &c->crossing[vertex[j]];
            const bool same = x->leaf == y->leaf && x->part == y->part;
            if (vec3_dot(x->n, y->n) < (same ? smooth_cosine : face_cosine))
                return true;
        }
    return false;
}

// Along the normal, from a cell outside to a cell inside; no surface there, or one that
// faces elsewhere: the point stays.
static struct vec3 drop(const struct contour *c, struct vec3 p, struct vec3 n)
{
    struct tess_crossing x;
    if (tess_solid_first(c->solid, vec3_mad(p, c->step, n), vec3_mad(p, -c->step, n),
                         &x) &&
        vec3_dot(x.n, n) > 0.5 && vec3_length(vec3_sub(x.p, p)) < c->step / 2)
        return x.p;
    return p;
}

// A vertex far out of its cell crosses the fans of other cells.
static bool in_cell(const struct contour *c, struct vec3 low, struct vec3 p)
{
    const struct vec3 at = vec3_scale(1 / c->step, vec3_sub(p, low));
    for (int axis = 0; axis < 3; axis++)
        if (!(vec3_axis(at, axis) > -cell_margin &&
              vec3_axis(at, axis) < 1 + cell_margin))
            return false;
    return true;
}

struct vec3 contour_centre(const struct contour *c, struct vec3 low,
                           const uint32_t *vertex, int count, bool *feature)
{
    struct vec3 mean = {0, 0, 0}, n = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        mean = vec3_mad(mean, 1.0 / count, c->crossing[vertex[i]].p);
        n = vec3_add(n, c->crossing[vertex[i]].n);
    }
    *feature = false;
    if (!(vec3_length(n) > 0))
        return mean;
    n = vec3_normalize(n);
    if (c->sharp && is_bent(c, vertex, count)) {
        const struct vec3 p = meet_of_faces(c, vertex, count, mean);
        const struct vec3 on = drop(c, p, n);
        if (in_cell(c, low, p) &&
            vec3_length(vec3_sub(on, p)) < feature_error * c->step) {
            *feature = true;
            return p;
        }
    }
    return drop(c, mean, n);
}

// ---- edges along features ----------------------------------------------------------------

// The two fans that meet at a segment on a face: triangles a b f and b a g become
// f a g and g b f, if that is the only segment between the two fans: an edge f g must not
// be there twice.
struct segment {
    uint32_t low, high, triangle;
};

static int segment_order(const void *a, const void *b)
{
    const struct segment *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    return x->high < y->high ? -1 : x->high > y->high;
}

struct turned {
    uint32_t low, high;
};

static int turned_order(const void *a, const void *b)
{
    const struct turned *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    return x->high < y->high ? -1 : x->high > y->high;
}

static struct segment *segments_of(const struct tess_mesh *m)
{
    struct segment *s = must_malloc(m->triangle_count + 1, sizeof *s);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const uint32_t a = m->triangle[t][0], b = m->triangle[t][1];
        s[t] = (struct segment){a < b ? a : b, a < b ? b : a, t};
    }
    qsort(s, m->triangle_count, sizeof *s, segment_order);
    return s;
}

static bool only_of_pair(const struct turned *pair, uint32_t count, struct turned p)
{
    const struct turned *at = bsearch(&p, pair, count, sizeof *pair, turned_order);
    const bool before = at > pair && turned_order(at - 1, at) == 0;
    const bool after = at + 1 < pair + count && turned_order(at + 1, at) == 0;
    return !before && !after;
}

void contour_turn_edges(struct contour *c)
{
    struct tess_mesh *m = c->mesh;
    struct segment *s = segments_of(m);
    struct turned *pair = must_malloc(m->triangle_count + 1, sizeof *pair);
    uint32_t count = 0;
    for (uint32_t i = 0; i + 1 < m->triangle_count; i += 2) {
        const uint32_t f = m->triangle[s[i].triangle][2];
        const uint32_t g = m->triangle[s[i + 1].triangle][2];
        pair[count++] = (struct turned){f < g ? f : g, f < g ? g : f};
    }
    qsort(pair, count, sizeof *pair, turned_order);
    for (uint32_t i = 0; i + 1 < m->triangle_count; i += 2) {
        uint32_t *t = m->triangle[s[i].triangle], *u = m->triangle[s[i + 1].triangle];
        const uint32_t a = t[0], b = t[1], f = t[2], g = u[2];
        if (!c->feature[f] || !c->feature[g] ||
            !only_of_pair(pair, count, (struct turned){f < g ? f : g, f < g ? g : f}))
            continue;
        t[0] = f;
        t[1] = a;
        t[2] = g;
        u[0] = g;
        u[1] = b;
        u[2] = f;
    }
    free(s);
    free(pair);
}
