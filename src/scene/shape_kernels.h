#ifndef SCENE_SHAPE_KERNELS_H
#define SCENE_SHAPE_KERNELS_H

#include "scene/shape.h"

// Eight rays, as shape_ops.closest8 takes them.
struct shape_rays {
    double o[3][8], d[3][8], t_min[8], t_max[8];
};

// What they meet first; only the lanes that closest8 returns are filled.
struct shape_hits {
    double t[8], dt[8], u[8], v[8];
    uint32_t part[8];
    uint8_t crossing[8];         // enum crossing
    uint64_t evaluations;        // added to, as those of a boundary_list
    const volatile bool *cancel; // these two as well
    bool cut;
};

static inline bool shape_hits_give_up(struct shape_hits *h)
{
    if (!h->cancel || !*h->cancel)
        return false;
    return h->cut = true;
}

// All crossings of eight lines, which are entered and left in turn; of one part, and drawn.
enum { LINE_CROSSINGS = 7 };
struct shape_lines {
    double t[LINE_CROSSINGS][8], dt[LINE_CROSSINGS][8];
    uint8_t count[8];
    unsigned leaving; // lanes whose first crossing is an exit
};

// Appends those of a lane.
void shape_lines_add(const struct shape_lines *x, int lane, struct boundary_list *out);

void shape_hits_put(struct shape_hits *h, int lane, const struct boundary *b);
struct boundary shape_hits_at(const struct shape_hits *h, int lane);
struct ray shape_rays_lane(const struct shape_rays *rays, int lane);
struct shape_rays shape_rays_alike(const struct ray *ray); // in all lanes
// closest8 of one lane by the shape's `intersect`, for lanes that a kernel does not take.
unsigned shape_lane_alone(const struct shape_ops *ops, const void *shape,
                          const struct shape_rays *rays, int lane,
                          struct shape_hits *out);
// The same of several; returns those that meet it.
unsigned shape_lanes_alone(const struct shape_ops *ops, const void *shape,
                           const struct shape_rays *rays, unsigned lanes,
                           struct shape_hits *out);

// What shapes have compiled once per instruction set, with the same results.
struct blob;
struct extrude_solid;
struct height_field;
struct isosurface;
struct julia;
struct ovus;
struct patch;
struct poly;
struct polygon;
struct revolve;
struct superellipsoid;
struct superellipsoid_roots;
struct sweep;
struct shape_kernels {
    unsigned (*blob)(const struct blob *s, const struct shape_rays *rays, unsigned lanes,
                     struct shape_hits *out, unsigned *odd);
    unsigned (*extrude)(const struct extrude_solid *s, const struct shape_rays *rays,
                        unsigned lanes, struct shape_hits *out, unsigned *odd);
    unsigned (*height_field)(const struct height_field *f, const struct shape_rays *rays,
                             unsigned lanes, bool any, struct shape_hits *out);
    unsigned (*isosurface)(const struct isosurface *s, const struct shape_rays *rays,
                           unsigned lanes, bool any, struct shape_hits *out);
    unsigned (*julia)(const struct julia *j, const struct shape_rays *rays,
                      unsigned lanes, bool any, struct shape_hits *out);
    unsigned (*ovus)(const struct ovus *s, const struct shape_rays *rays, unsigned lanes,
                     struct shape_hits *out);
    unsigned (*patch)(const struct patch *p, const struct shape_rays *rays,
                      unsigned lanes, bool any, struct shape_hits *out);
    unsigned (*poly)(const struct poly *s, const struct shape_rays *rays, unsigned lanes,
                     bool any, struct shape_hits *out);
    unsigned (*poly_lines)(const struct poly *s, const struct shape_rays *rays,
                           unsigned lanes, struct shape_lines *out);
    unsigned (*polygon)(const struct polygon *s, const struct shape_rays *rays,
                        unsigned lanes, struct shape_hits *out);
    unsigned (*revolve)(const struct revolve *s, const struct shape_rays *rays,
                        unsigned lanes, bool any, struct shape_hits *out, unsigned *odd);
    unsigned (*sphere_sweep)(const struct sweep *s, const struct shape_rays *rays,
                             unsigned lanes, struct shape_hits *out, unsigned *odd);
    unsigned (*superellipsoid)(const struct superellipsoid *s,
                               const struct shape_rays *rays, unsigned lanes, bool any,
                               struct shape_hits *out);
    // F and its derivative at eight places o + t u of one line, of any superellipsoid.
    void (*superellipsoid_samples)(const struct superellipsoid *s, struct vec3 o,
                                   struct vec3 u, const double t[8], double f[8],
                                   double slope[8]);
    void (*superellipsoid_roots)(const struct superellipsoid *s, unsigned lanes,
                                 struct superellipsoid_roots *r);
    // Lower bounds on F between neighbours of nine places of such a line.
    void (*superellipsoid_least)(const struct superellipsoid *s, struct vec3 o,
                                 struct vec3 u, const double t[9], double f[8]);
};

extern const struct shape_kernels shape_kernels_base, shape_kernels_avx2,
    shape_kernels_avx512;

#endif
