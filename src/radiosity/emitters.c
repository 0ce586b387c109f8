// What glows, lit from per pixel: few elements of much power need no patches to be seen by.
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "math/pi.h"
#include "radiosity/polygon.h"
#include "radiosity/radiosity.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "trace/tracer.h"

enum { MERGED_MOST = 2048, EDGES_MOST = 4 * EMITTERS_MOST };

// Whether Lambert's formula of the corners is exact for an element.
static bool is_polygon(const struct element *e)
{
    return !e->curved && !e->partial && fabsf(e->coverage - 1) < 1e-5f;
}

// ---- one emitter of many cells -----------------------------------------------------
// Whether b goes on where a ends, along u or v.
static bool goes_on(const struct cell *a, const struct cell *b, bool along_v)
{
    static const double same = 1e-9; // of the square
    const double at = along_v ? a->u - b->u : a->v - b->v;
    const double wide = along_v ? a->du - b->du : a->dv - b->dv;
    const double end = along_v ? a->v + a->dv - b->v : a->u + a->du - b->u;
    return fabs(at) < same && fabs(wide) < same && fabs(end) < same;
}

static bool alike(const struct patches *p, const struct emitter *a,
                  const struct emitter *b)
{
    static const float same = 1e-5f; // of the brighter one
    const enum chart_kind kind = p->chart[a->at.chart].kind;
    const struct rgb x = a->e.emission, y = b->e.emission;
    const float most = same * fmaxf(rgb_max(x), rgb_max(y));
    return a->at.chart == b->at.chart && a->side == b->side &&
           (kind == CHART_FLAT || kind == CHART_TRIANGLE) && !a->at.anchor &&
           !b->at.anchor && is_polygon(&a->e) && is_polygon(&b->e) &&
           fabsf(x.r - y.r) <= most && fabsf(x.g - y.g) <= most &&
           fabsf(x.b - y.b) <= most;
}

static void merge(const struct patches *p, struct emitter *a, const struct emitter *b,
                  bool along_v)
{
    static const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const struct chart *chart = &p->chart[a->at.chart];
    const double area = a->e.area + b->e.area;
    struct element *e = &a->e;
    struct cell *at = &a->at;
    e->emission = rgb_add(rgb_scale((float)(e->area / area), e->emission),
                          rgb_scale((float)(b->e.area / area), b->e.emission));
    e->area = area;
    *(along_v ? &at->dv : &at->du) += along_v ? b->at.dv : b->at.du;
    for (int k = 0; k < 4; k++) {
        struct vec3 n;
        chart_point(chart, &p->job->world->leaf[chart->leaf],
                    at->u + corner[k][0] * at->du, at->v + corner[k][1] * at->dv,
                    &e->corner[k], &n);
    }
    polygon_turn(e);
    e->corner_count = 4;
    e->coverage = (float)(area / polygon_area(e));
}

// Merges what goes on along u or v. True: something did.
static bool merge_along(struct radiosity *r, bool along_v)
{
    const uint32_t before = r->emitter_count;
    for (uint32_t i = 0; i < r->emitter_count; i++)
        for (uint32_t j = 0; j < r->emitter_count; j++) {
            struct emitter *a = &r->emitter[i], *b = &r->emitter[j];
            if (i == j || !goes_on(&a->at, &b->at, along_v) || !alike(r->patches, a, b))
                continue;
            merge(r->patches, a, b, along_v);
            *b = r->emitter[--r->emitter_count];
            i = i == r->emitter_count ? j : i;
            j = UINT32_MAX; // from the start: it has another end
        }
    return r->emitter_count < before;
}

// Whether the light of all is looked at by shafts first: where nothing can come between
// no ray is sent. With many emitters or objects something mostly can.
static void find_shafts(struct radiosity *r)
{
    enum { TESTS_MOST = 512 };
    const struct patches *p = r->patches;
    r->shafts = p->shaft && r->emitter_count * p->job->world->object_count <= TESTS_MOST;
    for (uint32_t i = 0; i < r->emitter_count && r->shafts; i++) {
        r->shafts = r->emitter[i].polygon;
        r->emitter[i].shaft = patches_shaft(p, &r->emitter[i].e, &r->emitter[i].at);
    }
    if (!r->shafts)
        return;
    r->between = must_calloc(p->element_count, sizeof *r->between);
    for (uint32_t k = 0; k < p->element_count; k++)
        for (uint32_t i = 0; i < r->emitter_count; i++) {
            uint64_t some =
                shafts_hide(p, &p->shaft[k], &r->emitter[i].shaft, ~r->between[k]);
            if (some && patch_is_flat(p, &p->element[k]))
                some = hulls_hide_all(p, &p->element[k], &r->emitter[i].e, some);
            r->between[k] |= some;
        }
}

// Edges of those that are polygons, for lanes.
static void find_edges(struct radiosity *r)
{
    struct polygon_edges *edges = &r->edges;
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->emitter_count; i++)
        count += r->emitter[i].polygon ? r->emitter[i].e.corner_count : 0;
    edges->count = (count + 7) & ~7u;
    edges->a[0] = must_calloc(6 * (size_t)edges->count, sizeof(double));
    for (int k = 1; k < 6; k++)
        *(k < 3 ? &edges->a[k] : &edges->b[k - 3]) = edges->a[0] + k * edges->count;
    for (uint32_t i = 0, at = 0; i < r->emitter_count; i++) {
        struct emitter *x = &r->emitter[i];
        const uint32_t n = x->e.corner_count;
        x->first_edge = at;
        for (uint32_t c = 0; c < n && x->polygon; c++, at++)
            for (int k = 0; k < 3; k++) {
                edges->a[k][at] = vec3_axis(x->e.corner[c], k);
                edges->b[k][at] = vec3_axis(x->e.corner[c + 1 == n ? 0 : c + 1], k);
            }
    }
}

// Charts of those whose points are easily found; r->flat: all are such.
static void find_flat(struct radiosity *r)
{
    const struct patches *p = r->patches;
    r->flat = true;
    for (uint32_t i = 0; i < r->emitter_count; i++) {
        struct emitter *x = &r->emitter[i];
        const struct chart *c = &p->chart[x->at.chart];
        const struct transform *t = p->job->world->leaf[c->leaf].transform;
        x->flat = (struct flat_emitter){.o = transform_point(t, c->o),
                                        .a = transform_vector(t, c->a),
                                        .b = transform_vector(t, c->b),
                                        .n = x->e.normal,
                                        .u = x->at.u,
                                        .du = x->at.du,
                                        .v = x->at.v,
                                        .dv = x->at.dv,
                                        .triangle = c->kind == CHART_TRIANGLE};
        r->flat &= !x->e.partial && (c->kind == CHART_FLAT || c->kind == CHART_TRIANGLE);
    }
}

void emitters_find(struct radiosity *r)
{
    const struct patches *p = r->patches;
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->element_count; i++)
        count += rgb_max(p->element[i].emission) > 0;
    if (r->settings.emitters == EMITTERS_MESH || count > MERGED_MOST)
        return;
    r->emitter = must_calloc(count, sizeof *r->emitter);
    for (uint32_t i = 0; i < p->element_count; i++)
        if (rgb_max(p->element[i].emission) > 0)
            r->emitter[r->emitter_count++] =
                (struct emitter){.e = p->element[i],
                                 .at = p->cell[p->element_cell[i] / 2],
                                 .side = (int)(p->element_cell[i] & 1),
                                 .radius = polygon_radius(&p->element[i])};
    for (bool merged = true; merged;) {
        merged = merge_along(r, false);
        merged = merge_along(r, true) || merged;
    }
    if (r->emitter_count > EMITTERS_MOST)
        r->emitter_count = 0;
    for (uint32_t i = 0; i < r->emitter_count; i++) {
        struct emitter *x = &r->emitter[i];
        const float most = rgb_max(x->e.emission);
        x->polygon = is_polygon(&x->e);
        x->color = rgb_scale(1 / most, x->e.emission);
        x->power = x->e.area * (double)most;
    }
    find_shafts(r);
    find_edges(r);
    find_flat(r);
}

// ---- their light -------------------------------------------------------------------
// What a tracer keeps: looks at emitters, all at once.
struct looks {
    struct ray_batch *rays;
    struct emitter_aims aims;
    const struct emitter *drawn[EMITTER_RAYS]; // what is aimed at
    const struct emitter *of[EMITTER_RAYS];    // what the rays go to
    double weight[EMITTER_RAYS];               // of the rays
};

void *emitters_begin(const void *data)
{
    struct looks *l = must_calloc(1, sizeof *l);
    (void)data;
    l->rays = ray_batch_new(EMITTER_RAYS);
    return l;
}

void emitters_end(void *state)
{
    struct looks *l = state;
    ray_batch_free(l->rays);
    free(l);
}

// Point k of Sobol's first EMITTER_RAYS in two dimensions, moved by a digital shift: as
// well spread for that many as any scrambling, and cheap.
static void net_point(uint32_t k, const uint32_t shift[2], double out[2])
{
    static const uint8_t x[EMITTER_RAYS] = {0, 8, 4, 12, 2, 10, 6, 14,
                                            1, 9, 5, 13, 3, 11, 7, 15};
    static const uint8_t y[EMITTER_RAYS] = {0,  8, 12, 4,  10, 2,  6, 14,
                                            15, 7, 3,  11, 5,  13, 9, 1};
    out[0] = ((uint32_t)x[k] << 28 ^ shift[0]) * 0x1p-32;
    out[1] = ((uint32_t)y[k] << 28 ^ shift[1]) * 0x1p-32;
}

// A point of an emitter; where it does not exist another one is drawn.
static bool emitter_point(const struct radiosity *r, struct tracer *t,
                          const struct emitter *x, uint32_t k, const uint32_t shift[2],
                          struct element_point *out)
{
    enum { TRIES = 16 };
    double s[4];
    net_point(k, shift, s);
    for (uint32_t again = 1;; again++) {
        if (patch_cell_point(r->patches, t->scratch, &x->at, x->side, x->e.partial, s[0],
                             s[1], out))
            return true;
        if (again == TRIES)
            return false;
        random_point(k, sequence_seed(shift[0], again), s);
    }
}

// About what an element gives at a point, for drawing: more than nothing where any of it
// is above the horizon.
static double drawn_by(const struct emitter *x, struct vec3 o, struct vec3 n)
{
    static const double near = 4; // radii: there Lambert's formula is worth its time
    const struct element *e = &x->e;
    const struct vec3 d = vec3_sub(e->centre, o);
    const double r = x->radius, d2 = vec3_dot(d, d) + r * r;
    if (d2 < near * near * r * r)
        return lambert_polygon(o, n, e->corner, e->corner_count) * (double)e->coverage;
    const double here = vec3_dot(d, n) + r,
                 there = (e->curved ? r : 0) - vec3_dot(d, e->normal);
    return here > 0 && there > 0 ? e->area * here * there / (PI * d2 * d2) : 0;
}

// What the emitting elements give at a point by Lambert's formula, summed up into up_to.
// Returns the part of polygons.
static double emitters_sum(const struct radiosity *r, struct vec3 o, struct vec3 n,
                           double *up_to)
{
    double sum = 0, polygons = 0, term[EDGES_MOST], height[EDGES_MOST];
    r->patches->sight->edges(&r->edges, o, n, term, height);
    for (uint32_t i = 0; i < r->emitter_count; i++) {
        const struct emitter *x = &r->emitter[i];
        const double given =
            x->polygon ? lambert_of_edges(o, n, x->e.corner, x->e.corner_count,
                                          term + x->first_edge, height + x->first_edge)
                       : drawn_by(x, o, n);
        const double c = given * (double)rgb_max(x->e.emission);
        sum += c;
        polygons += x->polygon ? c : 0;
        up_to[i] = sum;
    }
    return polygons;
}

// Those of `some` objects that may hide any of it, more closely.
static uint64_t in_hulls(const struct radiosity *r, struct vec3 o, struct vec3 n,
                         const double *up_to, uint64_t some)
{
    double before = 0;
    uint64_t found = 0;
    for (uint32_t i = 0; i < r->emitter_count && some & ~found; before = up_to[i++])
        if (up_to[i] > before)
            found |= hulls_hide(r->patches, o, n, &r->emitter[i].e, some & ~found);
    return found;
}

// The objects (bits) that may hide any of it.
static uint64_t in_between(const struct radiosity *r, uint32_t element, struct vec3 o,
                           struct vec3 n, const double *up_to)
{
    const struct patches *p = r->patches;
    struct shaft at = {.centre = o};
    double before = 0;
    uint64_t some = UINT64_MAX, found = 0;
    if (element != ELEMENT_NONE && shaft_holds(&p->shaft[element], o)) {
        at.hollow = p->shaft[element].hollow;
        some = r->between[element];
    }
    const struct shaft *last = NULL;
    for (uint32_t i = 0; i < r->emitter_count && some & ~found; before = up_to[i++]) {
        // Two triangles of a rectangle lie in the same box.
        const struct shaft *to = &r->emitter[i].shaft;
        if (!(up_to[i] > before) || (last && shaft_equals(last, to)))
            continue;
        found |= shafts_hide(p, &at, to, some & ~found);
        last = to;
    }
    return in_hulls(r, o, n, up_to, found);
}

// All of it with its colour, where nothing hides any.
static struct rgb all_open(const struct radiosity *r, const double *up_to)
{
    struct rgb light = {0, 0, 0};
    double before = 0;
    for (uint32_t i = 0; i < r->emitter_count; before = up_to[i++])
        light =
            rgb_add(light, rgb_scale((float)(up_to[i] - before), r->emitter[i].color));
    return light;
}

// Draws emitters by what they give, and points of them.
static void draw(const struct radiosity *r, struct tracer *t, struct looks *l,
                 const double *up_to, uint32_t hash)
{
    const double sum = up_to[r->emitter_count - 1];
    struct emitter_aims *x = &l->aims;
    const struct element_point here = {x->o, x->n, 0};
    double s[4];
    random_point(0, hash, s);
    const uint32_t shift[2] = {sequence_seed(hash, 1), sequence_seed(hash, 2)};
    for (uint32_t k = 0, i = 0; k < EMITTER_RAYS; k++) {
        const double at = (k + s[0]) / EMITTER_RAYS * sum;
        while (i + 1 < r->emitter_count && up_to[i] <= at)
            i++;
        l->drawn[k] = &r->emitter[i];
        if (r->flat) {
            double uv[2];
            net_point(k, shift, uv);
            x->u[k] = uv[0];
            x->v[k] = uv[1];
            x->of[k] = &l->drawn[k]->flat;
            continue;
        }
        struct element_point to;
        x->kernel[k] = 0;
        if (!emitter_point(r, t, l->drawn[k], k, shift, &to))
            continue;
        x->kernel[k] = point_kernel(&here, &to);
        x->d[0][k] = to.p.x - x->o.x;
        x->d[1][k] = to.p.y - x->o.y;
        x->d[2][k] = to.p.z - x->o.z;
    }
    if (r->flat)
        r->patches->sight->aim(x);
}

// Rays to the points drawn that give anything. Returns the weight of those on polygons.
static double put_looks(const struct radiosity *r, struct looks *l, const double *up_to)
{
    // Of a point relative to the mean: nearer than an element's size it has no bound.
    static const double weight_most = 8;
    const struct emitter_aims *x = &l->aims;
    const struct emitter *before = NULL;
    double all = 0, scale = 0;
    l->rays->count = 0;
    for (uint32_t k = 0; k < EMITTER_RAYS; k++) {
        const struct emitter *e = l->drawn[k];
        const ptrdiff_t i = e - r->emitter;
        if (e != before) {
            const double share = up_to[i] - (i ? up_to[i - 1] : 0);
            scale = e->power / share;
            before = e;
        }
        const double given = x->kernel[k] * scale;
        if (!(given > 0))
            continue;
        const double weight = given < weight_most ? given : weight_most;
        const uint32_t ray = l->rays->count;
        all += e->polygon ? weight : 0;
        l->of[ray] = e;
        l->weight[ray] = weight;
        ray_put_from(l->rays, x->o, vec3(x->d[0][k], x->d[1][k], x->d[2][k]),
                     SHORT_OF_EMITTER);
        l->rays->hidden_by[ray] = OBJECT_NO_RADIOSITY;
    }
    return all;
}

// Irradiance of the emitting elements at a point: shadow rays to points of their true
// surfaces, elements drawn by what they give. Of polygons the points say what part of
// Lambert's sum is open; of other elements they are the integral.
struct rgb emitters_light(const struct radiosity *r, void *state, struct tracer *t,
                          struct vec3 o, struct vec3 n, uint32_t element, uint32_t hash)
{
    double up_to[EMITTERS_MOST];
    const double polygons = emitters_sum(r, o, n, up_to);
    const double sum = r->emitter_count ? up_to[r->emitter_count - 1] : 0;
    struct rgb open = {0, 0, 0}, other = {0, 0, 0};
    uint8_t hidden[EMITTER_RAYS];
    struct looks *const l = state;
    if (sum <= 0)
        return open;
    const uint64_t some = r->shafts ? in_between(r, element, o, n, up_to) : 0;
    if (r->shafts && !some)
        return all_open(r, up_to);
    l->aims.o = o;
    l->aims.n = n;
    draw(r, t, l, up_to, hash);
    const double all = put_looks(r, l, up_to);
    if (r->shafts)
        trace_occluded_by(t->job->world, t->scratch, l->rays, some, hidden);
    else
        trace_occluded(t->job->world, t->scratch, l->rays, hidden);
    for (uint32_t k = 0; k < l->rays->count; k++) {
        if (hidden[k])
            continue;
        struct rgb *into = l->of[k]->polygon ? &open : &other;
        *into = rgb_add(*into, rgb_scale((float)l->weight[k], l->of[k]->color));
    }
    open = rgb_scale(all > 0 ? (float)(polygons / all) : 0, open);
    return rgb_add(open, rgb_scale((float)(sum / EMITTER_RAYS), other));
}
