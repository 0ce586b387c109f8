#ifndef TRACE_SHADE_CAUSTIC_H
#define TRACE_SHADE_CAUSTIC_H

// What the layers of one hit make of photons, eight at a time (shade_photons.c).
#include "trace/photons.h"
#include "trace/shade_lit.h"

enum { CAUSTIC_ROOM = 64 }; // photons whose light is worked out together

// A number of one layer in all lanes.
struct caustic_layer {
    double d[3][8], n[3][8];
    float color[3][8], att[8];
};

static void caustic_spread(const struct layer *l, struct vec3 d,
                           struct caustic_layer *out)
{
    const float color[3] = {l->color.r, l->color.g, l->color.b};
    v8_store(out->d, V8_SET(d));
    v8_store(out->n, V8_SET(l->n));
    for (int k = 0; k < 3; k++)
        f8_store(out->color[k], f8_set(color[k]));
    f8_store(out->att, f8_set(l->att));
}

// Adds what one layer sends on of light of colour 1 from `from` (layer_lit).
static void caustic_layer_lit(const struct shading *s, const struct layer *l,
                              bool side_test, uint32_t count, float (*from)[CAUSTIC_ROOM],
                              float (*sum)[CAUSTIC_ROOM])
{
    const bool dull = s->t->job->settings.purpose == RENDER_GATHER;
    struct caustic_layer x;
    caustic_spread(l, s->path->d, &x);
    const struct lit_layer lit = {l->finish,
                                  (const double(*)[8])x.d,
                                  (const double(*)[8])x.n,
                                  (const float(*)[8])x.color,
                                  x.att,
                                  NULL};
    for (uint32_t i = 0; i < count; i += 8) {
        const struct vec8 to = {r8_of_floats(f8_load(from[0] + i)),
                                r8_of_floats(f8_load(from[1] + i)),
                                r8_of_floats(f8_load(from[2] + i))};
        unsigned live = 255;
        const struct rgb8 c =
            rgb8_mul(lit8(&lit, side_test, dull, to, &live), rgb8_set(l->filter));
        const struct float8 part[3] = {c.r, c.g, c.b};
        for (int k = 0; k < 3 && live; k++) {
            const struct float8 before = f8_load(sum[k] + i);
            f8_store(sum[k] + i, f8_select(live, f8_add(before, part[k]), before));
        }
    }
}

// Fills the directions and energies of up to CAUSTIC_ROOM photons; places behind the last
// hold the first, whose light nobody adds.
static void caustic_load(const struct photon *photon, const uint32_t *id, uint32_t count,
                         float (*from)[CAUSTIC_ROOM], float (*energy)[CAUSTIC_ROOM])
{
    for (uint32_t i = 0; i < count || i % 8; i++) {
        const struct photon *x = &photon[id[i < count ? i : 0]];
        for (int k = 0; k < 3; k++)
            from[k][i] = x->from[k];
        energy[0][i] = x->energy.r;
        energy[1][i] = x->energy.g;
        energy[2][i] = x->energy.b;
    }
}

// The factor of photons that come in obliquely.
LANES_INLINE struct float8 caustic_slant(struct vec3 n, float (*from)[CAUSTIC_ROOM],
                                         uint32_t i)
{
    const struct vec8 to = {r8_of_floats(f8_load(from[0] + i)),
                            r8_of_floats(f8_load(from[1] + i)),
                            r8_of_floats(f8_load(from[2] + i))};
    const struct real8 facing = v8_dot(V8_SET(n), to);
    return f8_of(r8_div(r8_set(1), r8_max(facing, r8_set(photon_steepest))));
}

static struct rgb caustics(const struct shading *s, const struct photon *photon,
                           const uint32_t *id, uint32_t count, bool side_test)
{
    float total[3] = {0, 0, 0};
    for (uint32_t begin = 0, n; begin < count; begin += n) {
        float from[3][CAUSTIC_ROOM], energy[3][CAUSTIC_ROOM], sum[3][CAUSTIC_ROOM];
        n = count - begin < CAUSTIC_ROOM ? count - begin : CAUSTIC_ROOM;
        caustic_load(photon, id + begin, n, from, energy);
        memset(sum, 0, sizeof sum);
        for (uint32_t i = 0; i < s->layer_count; i++)
            if (finish_takes_light(s->layer[i].finish))
                caustic_layer_lit(s, &s->layer[i], side_test, n, from, sum);
        for (uint32_t i = 0; i < n; i += 8) {
            const struct float8 slant = caustic_slant(s->view.n, from, i);
            for (int k = 0; k < 3; k++)
                f8_store(sum[k] + i, f8_mul(f8_mul(slant, f8_load(energy[k] + i)),
                                            f8_load(sum[k] + i)));
        }
        for (uint32_t i = 0; i < n; i++)
            for (int k = 0; k < 3; k++)
                total[k] += sum[k][i];
    }
    return rgb(total[0], total[1], total[2]);
}

#endif
