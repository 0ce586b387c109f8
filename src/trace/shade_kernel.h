#ifndef TRACE_SHADE_KERNEL_H
#define TRACE_SHADE_KERNEL_H

#include "trace/antialias.h"
#include "trace/simple.h"

struct media;
struct media_eight;
struct media_places;
struct pigment_tape;
struct surface_kernels;
struct paint_coat;
struct paint_group;
struct paint_sheet;
struct photon;
struct shading;

// Places on surfaces that an area light may shine on: as in interaction; the grid's axes as
// they see them; hash of the way there and the lamp.
struct area_places {
    double p[3][BATCH_SIZE], ng[3][BATCH_SIZE], error[BATCH_SIZE];
    double axis1[3][BATCH_SIZE], axis2[3][BATCH_SIZE];
    uint32_t hash[BATCH_SIZE];
};

// From a place to a point of the grid, u * size2 + v.
struct area_ray {
    uint32_t place, point, value; // value: where what it brings is kept
};

// Adds what a medium is at `count` points, eight a block; tape: its densities', NULL where
// there is none.
typedef void media_add_fn(const struct media *m, const struct pigment_tape *const *tape,
                          const struct media_places *place, uint32_t count,
                          struct media_eight *sum);

// What shading compiles once per instruction set, as trace/packet.h.
struct shade_kernels {
    const char *name;
    const struct surface_kernels *surface; // of the same instruction set
    // The rays of a camera with quick_camera, as camera_ray gives them, or camera_lens_ray if
    // on_lens is not NULL; their number. place: of which position each is, as some have none.
    uint32_t (*camera)(const struct job *job, const struct vec2 *position,
                       const struct vec2 *on_lens, uint32_t count, struct ray_batch *out,
                       uint16_t *place);
    // Fills a group from up to eight rays of the batch and their hits.
    void (*place)(struct tracer *t, const uint16_t *ray, uint32_t count,
                  struct simple_group *g);
    // Adds what the group's surfaces give off by themselves.
    void (*own)(struct tracer *t, const struct simple_class *c,
                const struct simple_group *g);
    // Light of one lamp on groups of one class. `queued` shadow rays wait; returns how many
    // do then.
    uint32_t (*light)(struct tracer *t, const struct simple_class *c,
                      const struct lamp *lamp, const struct simple_group *g,
                      uint32_t groups, uint32_t queued);
    // Fills what leaves the group by mirrors and, where the class is clear, through it.
    void (*bounce)(const struct simple_class *c, const struct simple_group *g,
                   struct simple_bounce *b);
    // Adds what `count` shadow rays let through to their slots.
    void (*lit)(struct wavefront *w, const struct shadow_batch *b, uint32_t count);
    // What the wave's slots have collected, as the samples of the same numbers.
    void (*sums)(const struct wavefront *w, struct sample_sum *out);
    // det_exp_single of `count` numbers; both arrays have room for eight more.
    void (*exps)(const double *x, uint32_t count, float *out);
    // The same in place, as doubles.
    void (*exp_single)(double *x, uint32_t count);
    // What the fake caustics of a surface multiply light along d by (trace/shadow.c).
    void (*focus)(const double n[3][8], const double d[3][8], double caustics,
                  float out[8]);
    // struct antialias's.
    judge_function *judge;
    differ_function *differ;
    // Which of eight rays of a batch meet one of the boxes, as box_meets.
    unsigned (*meets)(const struct aabb *box, uint32_t count,
                      const struct ray_batch *rays, uint32_t first);
    // What the fogs of the scene do to the rays of the wave (trace/sky.h).
    void (*fogs)(struct tracer *t);
    // The rays to points of an area light: as area_point, lamp_direction and trace_offset say.
    void (*toward)(const struct lamp *lamp, const struct area_places *places,
                   const struct area_ray *ray, uint32_t count, struct ray_batch *out);
    // The ways from the origins of the rays to a lamp, and its colour there, red, green, blue
    // each `stride` behind the other: as lamp_view says. dark: where that is false; returns
    // whether it is anywhere. Arrays have room for eight more.
    bool (*views)(const struct lamp *lamp, uint32_t count, struct ray_batch *rays,
                  uint8_t *dark, float *color, uint32_t stride);
    // Of eight ways of length s, those that certainly do not meet the cone of a spot light.
    unsigned (*misses_cone)(const struct lamp *lamp, const double o[3][8],
                            const double d[3][8], const double s[8]);
    // ---- painted hits (trace/paint.h)
    // `place` without colours. uv: with uv coordinates.
    void (*points)(struct tracer *t, const uint16_t *ray, uint32_t count, bool uv,
                   struct simple_group *g);
    // Points and normals as a texture of a surface sees them, which m has moved, and those
    // normals again in the world, unit.
    void (*texture_space)(const struct surface *s, const struct transform *m,
                          const struct simple_group *g, double place[3][8],
                          double normal[3][8]);
    void (*world_normals)(const struct surface *s, const struct transform *m,
                          double v[3][8]);
    // Puts a layer, whose colours and normals are known, below those of the coat, as
    // shade_plain. mirror: what it mirrors if it conserves energy, else NULL. Returns the
    // lanes in which more than adc_bailout passes.
    unsigned (*sheet_pass)(const struct job *job, struct paint_sheet *s,
                           const float mirror[3][8], struct paint_coat *coat);
    // As own and light.
    void (*own_sheets)(struct tracer *t, const struct paint_group *g);
    uint32_t (*light_sheets)(struct tracer *t, bool side_test, const struct lamp *lamp,
                             const struct paint_group *g, uint32_t groups,
                             uint32_t queued);
    // Fills what one layer mirrors, of which `share` is the surface's, as bounce does.
    void (*mirror_sheet)(const struct paint_group *g, const struct paint_sheet *s,
                         const float share[8], struct simple_bounce *b);
    // The light of photons of a map that the layers of one hit send on, summed in their order;
    // finishes with crand, irid or subsurface light are not for this.
    struct rgb (*caustics)(const struct shading *s, const struct photon *photon,
                           const uint32_t *id, uint32_t count, bool side_test);
    media_add_fn *media_add; // trace/media_kernel.c
};

extern const struct shade_kernels shade_kernels_base, shade_kernels_avx2,
    shade_kernels_avx512;

#endif
