#ifndef TRACE_SHADE_CAMERA_H
#define TRACE_SHADE_CAMERA_H

// Rays of cameras, eight at a time: camera_ray, kind by kind with its bits.
#include "math/pi.h"
#include "math/trig_lanes.h"
#include "scene/camera_frame.h"
#include "scene/pigment_tape.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

// struct view of scene/camera.c in lanes; `frame` is the same for all rays.
struct view8 {
    const struct camera_frame *frame;
    struct real8 u, v;
    struct vec8 origin, d;
    struct real8 x0, y0;
    unsigned exists;
};

LANES_INLINE struct vec8 v8_scale(struct real8 s, struct vec3 v)
{
    const struct vec8 v8 = V8_SET(v);
    return (struct vec8){r8_mul(v8.x, s), r8_mul(v8.y, s), r8_mul(v8.z, s)};
}

LANES_INLINE struct vec8 v8_cross(struct vec3 a, struct vec8 b)
{
    const struct vec8 a8 = V8_SET(a);
    return (struct vec8){r8_sub(r8_mul(a8.y, b.z), r8_mul(a8.z, b.y)),
                         r8_sub(r8_mul(a8.z, b.x), r8_mul(a8.x, b.z)),
                         r8_sub(r8_mul(a8.x, b.y), r8_mul(a8.y, b.x))};
}

LANES_INLINE struct vec8 v8_mad_to(struct vec8 a, struct real8 s, struct vec3 v)
{
    const struct vec8 v8 = V8_SET(v);
    return v8_mad(a, s, v8);
}

LANES_INLINE struct vec8 polar8(const struct view8 *w, struct real8 cos_phi,
                                struct real8 sin_phi)
{
    const struct camera_frame *f = w->frame;
    const struct real8 s = det_sin8(w->y0);
    return v8_add(
        v8_mad_to(v8_scale(r8_mul(cos_phi, s), f->right), r8_mul(sin_phi, s), f->up),
        v8_scale(det_cos8(w->y0), f->direction));
}

// Whether the distance from the middle is one the picture has; its polar form.
LANES_INLINE struct real8 disc8(struct view8 *w, struct real8 a, struct real8 b,
                                struct real8 *cos_phi, struct real8 *sin_phi)
{
    const struct real8 rho = r8_sqrt(r8_add(r8_mul(a, a), r8_mul(b, b)));
    const struct mask8 middle = r8_le(rho, r8_set(0));
    w->exists = m8_bits(r8_le(rho, r8_set(1)));
    *cos_phi = r8_select(middle, r8_set(1), r8_div(a, rho));
    *sin_phi = r8_select(middle, r8_set(0), r8_div(b, rho));
    if (w->frame->camera->normal) {
        double at[2][8];
        r8_store(at[0], *cos_phi);
        r8_store(at[1], *sin_phi);
        for (int i = 0; i < 8; i++)
            at[0][i] = camera_phi(at[0][i], at[1][i]);
        w->x0 = r8_load(at[0]);
    }
    return rho;
}

static void fisheye8(struct view8 *w)
{
    const struct camera_frame *f = w->frame;
    struct real8 cos_phi, sin_phi;
    const struct real8 two = r8_set(2);
    const struct real8 rho =
        disc8(w, r8_mul(r8_mul(two, w->u), r8_set(f->len_right)),
              r8_mul(r8_mul(two, w->v), r8_set(f->len_up)), &cos_phi, &sin_phi);
    w->y0 = r8_div(r8_mul(rho, r8_set(f->angle)), two);
    w->d = polar8(w, cos_phi, sin_phi);
}

static void omnimax8(struct view8 *w)
{
    const struct omnimax_scale s = omnimax_scale(w->frame);
    const struct real8 two = r8_set(2), one = r8_set(1);
    const struct real8 a = r8_mul(r8_mul(two, w->u), r8_set(s.across));
    const struct real8 b =
        r8_add(r8_div(r8_sub(r8_mul(two, w->v), r8_set(s.top)), r8_set(s.upright)),
               r8_set(s.top));
    struct real8 cos_phi, sin_phi;
    const struct real8 rho = disc8(w, a, b, &cos_phi, &sin_phi), rho2 = r8_mul(rho, rho);
    w->y0 = r8_mul(rho, r8_add(r8_sub(r8_set(OMNIMAX_0), r8_mul(r8_set(OMNIMAX_2), rho2)),
                               r8_mul(r8_mul(r8_set(OMNIMAX_4), rho2), rho2)));
    const struct mask8 below =
        r8_lt(r8_mul(sin_phi, det_sin8(w->y0)), r8_mul(r8_neg(one), det_cos8(w->y0)));
    w->exists &= ~m8_bits(below);
    w->d = polar8(w, cos_phi, sin_phi);
}

static void ultra_wide8(struct view8 *w)
{
    const struct camera_frame *f = w->frame;
    w->x0 = r8_mul(w->u, r8_set(f->angle));
    w->y0 = r8_div(r8_mul(r8_mul(w->v, r8_set(f->angle)), r8_set(f->len_up)),
                   r8_set(f->len_right));
    w->d = v8_add(v8_mad_to(v8_scale(det_sin8(w->x0), f->right), det_sin8(w->y0), f->up),
                  v8_scale(r8_mul(det_cos8(w->x0), det_cos8(w->y0)), f->direction));
}

static void panoramic8(struct view8 *w)
{
    const struct camera *c = w->frame->camera;
    w->x0 = r8_mul(r8_set(PI), r8_sub(r8_set(0.5), w->u));
    w->y0 = r8_mul(r8_set(PI), w->v);
    const struct real8 most = r8_set(PANORAMIC_STEEPEST);
    const struct real8 t =
        r8_max(r8_neg(most), r8_min(most, r8_div(det_sin8(w->y0), det_cos8(w->y0))));
    w->d = v8_add(v8_mad_to(v8_scale(det_cos8(w->x0), c->right), t, c->up),
                  v8_scale(det_sin8(w->x0), c->direction));
}

static void cylinder8(struct view8 *w)
{
    const struct camera_frame *f = w->frame;
    const enum camera_kind kind = f->camera->kind;
    const bool across = kind == CAMERA_CYLINDER_1 || kind == CAMERA_CYLINDER_3;
    w->x0 = r8_mul(w->u, r8_set(across ? f->angle : f->len_right));
    w->y0 = r8_mul(w->v, r8_set(across ? f->len_up : f->angle));
    const struct real8 bend = across ? w->x0 : w->y0, along = across ? w->y0 : w->x0;
    const struct vec3 around = across ? f->right : f->up,
                      axis = across ? f->up : f->right;
    w->d = v8_mad_to(v8_scale(det_sin8(bend), around), det_cos8(bend), f->direction);
    if (kind == CAMERA_CYLINDER_3 || kind == CAMERA_CYLINDER_4)
        w->origin = v8_mad_to(w->origin, along, axis);
    else
        w->d = v8_mad_to(w->d, along, axis);
}

LANES_INLINE struct vec8 rotate8(struct vec8 p, struct vec3 axis, struct real8 angle)
{
    const struct real8 c = det_cos8(angle);
    const struct vec8 a = V8_SET(axis), turned = v8_cross(axis, p);
    const struct vec8 around =
        v8_mad((struct vec8){r8_mul(p.x, c), r8_mul(p.y, c), r8_mul(p.z, c)},
               det_sin8(angle), turned);
    return v8_add(around, v8_scale(r8_mul(v8_dot(a, p), r8_sub(r8_set(1), c)), axis));
}

static void spherical8(struct view8 *w)
{
    const struct camera_frame *f = w->frame;
    const struct vec8 ahead = V8_SET(f->camera->direction);
    w->x0 = r8_mul(w->u, r8_set(f->angle));
    w->y0 = r8_mul(w->v, r8_set(f->angle_v));
    w->d = rotate8(rotate8(ahead, f->right, r8_neg(w->y0)), f->up, w->x0);
}

static void view8_ray(struct view8 *w)
{
    const struct camera *c = w->frame->camera;
    const struct vec8 right = V8_SET(c->right), up = V8_SET(c->up),
                      direction = V8_SET(c->direction);
    switch (c->kind) {
    case CAMERA_PERSPECTIVE:
        w->d = v8_mad(v8_mad(direction, w->u, right), w->v, up);
        break;
    case CAMERA_ORTHOGRAPHIC:
        w->origin = v8_mad(v8_mad(w->origin, w->u, right), w->v, up);
        w->d = direction;
        break;
    case CAMERA_FISHEYE: fisheye8(w); break;
    case CAMERA_OMNIMAX: omnimax8(w); break;
    case CAMERA_ULTRA_WIDE_ANGLE: ultra_wide8(w); break;
    case CAMERA_PANORAMIC: panoramic8(w); break;
    case CAMERA_SPHERICAL: spherical8(w); break;
    default: cylinder8(w); break;
    }
}

// bent() of scene/camera.c.
static struct vec8 bent8(const struct shade_kernels *k, const struct view8 *w,
                         struct vec8 d)
{
    static const double origin[3][8];
    double place[3][8] = {{0}}, ray[3][8], n[3][8];
    r8_store(place[0], w->x0);
    r8_store(place[1], w->y0);
    v8_store(ray, d);
    v8_store(n, d);
    const double(*at)[8] = (const double(*)[8])place,
          (*along)[8] = (const double(*)[8])ray;
    const struct pattern_packet packet = {origin, along, along, at};
    k->surface->perturb(w->frame->camera->normal, &packet, at, w->exists, n);
    return v8_normalize(v8_load((const double(*)[8])n));
}

// Stores the lanes there are from place `at` on; the next place.
static uint32_t store_rays8(const struct view8 *w, struct vec8 d, unsigned lanes,
                            uint32_t at, struct ray_batch *out)
{
    double o8[3][8], d8[3][8];
    v8_store(o8, w->origin);
    v8_store(d8, d);
    for (; lanes; lanes &= lanes - 1, at++) {
        const int i = __builtin_ctz(lanes);
        for (int k = 0; k < 3; k++) {
            out->o[k][at] = o8[k][i];
            out->d[k][at] = d8[k][i];
        }
    }
    return at;
}

// Pairs i to i + n - 1 of an array; where n < 8, the first stands for those that are not there.
LANES_INLINE void load_pairs(const struct vec2 *from, uint32_t n, struct real8 *u,
                             struct real8 *v)
{
    struct vec2 last[8];
    if (n < 8) {
        for (uint32_t k = 0; k < 8; k++)
            last[k] = from[k < n ? k : 0];
        from = last;
    }
    r8_load_pairs(&from->u, u, v);
}

// camera_lens_ray of scene/camera.c, of what view8_ray gave.
LANES_INLINE void through_lens(struct view8 *w, const struct camera_lens *lens,
                               struct real8 u, struct real8 v)
{
    const struct vec8 shift =
                          v8_sub(v8_scale(u, lens->across), v8_scale(v, lens->upright)),
                      location = V8_SET(w->frame->camera->location);
    const struct real8 reach = r8_set(lens->reach);
    w->origin = v8_add(location, shift);
    w->d = v8_sub((struct vec8){r8_mul(w->d.x, reach), r8_mul(w->d.y, reach),
                                r8_mul(w->d.z, reach)},
                  shift);
}

static uint32_t camera(const struct job *job, const struct vec2 *position,
                       const struct vec2 *on_lens, uint32_t count, struct ray_batch *out,
                       uint16_t *place)
{
    const struct camera *c = job->camera;
    const struct camera_frame frame = camera_frame_of(c);
    struct camera_lens lens;
    if (on_lens)
        lens = camera_lens_of(c);
    const struct real8 width = r8_set(job->settings.width),
                       height = r8_set(job->settings.height), half = r8_set(0.5);
    uint32_t made = 0;
    for (uint32_t i = 0; i < count; i += 8) {
        const uint32_t n = count - i < 8 ? count - i : 8;
        struct real8 px, py;
        load_pairs(position + i, n, &px, &py);
        struct view8 w = {.frame = &frame,
                          .u = r8_sub(r8_div(px, width), half),
                          .v = r8_sub(half, r8_div(py, height)),
                          .origin = V8_SET(c->location),
                          .exists = 255};
        w.x0 = w.u;
        w.y0 = w.v;
        view8_ray(&w);
        if (on_lens) {
            struct real8 u, v;
            load_pairs(on_lens + i, n, &u, &v);
            through_lens(&w, &lens, u, v);
        }
        struct vec8 d = v8_normalize(w.d);
        if (c->normal)
            d = bent8(job->kernels, &w, d);
        const unsigned lanes = w.exists & (255u >> (8 - n));
        for (unsigned rest = lanes, at = made; rest; rest &= rest - 1)
            place[at++] = (uint16_t)(i + (uint32_t)__builtin_ctz(rest));
        if (lanes == 255) {
            r8_store(out->o[0] + made, w.origin.x);
            r8_store(out->o[1] + made, w.origin.y);
            r8_store(out->o[2] + made, w.origin.z);
            r8_store(out->d[0] + made, d.x);
            r8_store(out->d[1] + made, d.y);
            r8_store(out->d[2] + made, d.z);
            made += 8;
        } else {
            made = store_rays8(&w, d, lanes, made, out);
        }
    }
    for (uint32_t i = 0; i < made; i++)
        out->hidden_by[i] = OBJECT_NO_IMAGE;
    return made;
}

#endif
