#include "math/elementary.h"
#include "math/pi.h"
#include "scene/noise.h"
#include "trace/area.h"
#include "trace/near_zero.h"
#include "trace/photons.h"
#include "trace/projected.h"
#include "trace/shade.h"
#include "trace/simple.h"

// The part of the tint at an angle of the light (spec/lighting.md 5.4).
static float metal_angle(double cosine)
{
    if (!(fabs(cosine) <= 1))
        return 0;
    const double x = fabs(det_acos(cosine)) / (PI / 2);
    const double y = 0.014567225 / ((x - 1.12) * (x - 1.12)) - 0.011612903;
    return (float)fmax(0, fmin(1, y));
}

struct rgb metal_tint(struct rgb c, struct rgb tint, float metallic, double cosine)
{
    const float k = metallic * (1 - metal_angle(cosine));
    return rgb(c.r * (1 + k * (tint.r - 1)), c.g * (1 + k * (tint.g - 1)),
               c.b * (1 + k * (tint.b - 1)));
}

struct rgb irid_factor(const struct shading *s, const struct finish *f, struct vec3 n,
                       struct vec3 l)
{
    const struct job *job = s->t->job;
    const struct vec3 d = s->path->d;
    double thickness = (double)f->irid_thickness;
    if (f->irid_turbulence != 0)
        thickness *= 1 + (double)f->irid_turbulence *
                             (2 * noise_turbulence(s->at.p, 2, 0.5, 5,
                                                   job->scene->settings.noise_generator) -
                              1);
    const double way = 2 * PI * thickness * (fabs(vec3_dot(n, l)) + fabs(vec3_dot(n, d)));
    const struct rgb w = job->irid_wavelength;
    const float a = f->irid;
    return rgb(1 + a * (float)det_cos(way / (double)w.r),
               1 + a * (float)det_cos(way / (double)w.g),
               1 + a * (float)det_cos(way / (double)w.b));
}

// q^n for a cosine q. Most highlights are far off, or have a whole exponent.
static double highlight_power(double q, double n)
{
    static const double dark = 40; // exp(-40) is below any float next to a colour
    static const double by_squares = 4096;
    // 1 - q bounds -log(q) from below, so q^n <= exp(-n (1 - q)).
    if (n * (1 - q) > dark)
        return 0;
    if (n != floor(n) || n < 0 || n > by_squares)
        return det_pow_single(q, n);
    double power = 1;
    for (uint32_t bits = (uint32_t)n; bits; bits >>= 1) {
        if (bits & 1)
            power *= q;
        q *= q;
    }
    return power;
}

static struct rgb highlights(const struct layer *l, struct vec3 d, struct vec3 to,
                             double facing)
{
    static const float sharp = 60;
    static const double sharp_cut = 0.0008;
    const struct finish *f = l->finish;
    float sum = 0;
    if (f->phong != 0) {
        const struct vec3 r = vec3_mad(d, -2 * vec3_dot(d, l->n), l->n);
        const double q = vec3_dot(r, to);
        if (q > 0 && (f->phong_size < sharp || q > sharp_cut))
            sum += f->phong * (float)highlight_power(q, (double)f->phong_size);
    }
    if (f->specular != 0) {
        const struct vec3 h = vec3_sub(to, d);
        const double q = vec3_dot(h, l->n), length = vec3_length(h);
        if (q > 0 && length > 0)
            sum += f->specular * (float)highlight_power(q / length, (double)f->roughness);
    }
    if (sum == 0)
        return rgb(0, 0, 0);
    struct rgb c = rgb_even(sum);
    if (f->metallic != 0)
        c = metal_tint(c, l->color, f->metallic, facing);
    return c;
}

// What one layer sends to the eye of light of colour 1 that comes from `to`
// (spec/lighting.md 5.3).
static struct rgb layer_lit(const struct shading *s, const struct layer *l,
                            const struct lamp *lamp, struct vec3 to, bool side_test)
{
    const struct finish *f = l->finish;
    const double facing = vec3_dot(l->n, to);
    bool back = false;
    if (side_test && facing < NEAR_ZERO) {
        if (f->diffuse_back == 0)
            return rgb(0, 0, 0);
        back = true;
    }
    struct rgb c = {0, 0, 0};
    const float d = back ? f->diffuse_back : f->diffuse;
    if (d > 0 && !(f->has_subsurface && s->t->job->subsurface)) {
        const double cosine = fabs(facing);
        float i =
            (float)(f->brilliance == 1 ? cosine : det_pow_single(cosine, f->brilliance));
        i *= d * l->att;
        if (f->crand > 0)
            i -= f->crand *
                 (float)hash_unit(hash_mix(s->path->hash, lamp ? lamp->index + 100 : 99));
        c = rgb_scale(i, l->color);
    }
    if (!back && !(lamp ? lamp->dull : s->t->job->settings.purpose == RENDER_GATHER))
        c = rgb_add(c, highlights(l, s->path->d, to, facing));
    if (f->irid != 0)
        c = rgb_mul(c, irid_factor(s, f, l->n, to));
    return rgb_mul(c, l->filter);
}

bool finish_takes_light(const struct finish *f)
{
    return f->diffuse != 0 || f->diffuse_back != 0 || f->specular != 0 || f->phong != 0;
}

struct rgb layers_lit(const struct shading *s, const struct lamp *lamp, struct vec3 to,
                      bool side_test)
{
    struct rgb sum = {0, 0, 0};
    for (uint32_t i = 0; i < s->layer_count; i++)
        if (finish_takes_light(s->layer[i].finish))
            sum = rgb_add(sum, layer_lit(s, &s->layer[i], lamp, to, side_test));
    return sum;
}

static bool is_black(struct rgb c)
{
    const float e = (float)NEAR_ZERO;
    return fabsf(c.r) < e && fabsf(c.g) < e && fabsf(c.b) < e;
}

// The sum over the lightlets of area_illumination, each with its own direction.
static struct rgb area_lit(const struct shading *s, const struct lamp *lamp,
                           bool side_test)
{
    const struct light *light = lamp->light;
    const struct lamp_grid grid = lamp_grid_of(lamp, s->at.p);
    struct rgb sum = {0, 0, 0};
    for (int u = 0; u < light->size1; u++) {
        for (int v = 0; v < light->size2; v++) {
            const struct vec3 at =
                area_point(lamp, &grid, area_lit_hash(s->path->hash), u, v);
            struct lamp_view view;
            if (!lamp_view(lamp, at, s->at.p, &view))
                continue;
            sum =
                rgb_add(sum, rgb_mul(view.color, layers_lit(s, lamp, view.l, side_test)));
        }
    }
    return rgb_scale(1.0f / (float)(light->size1 * light->size2), sum);
}

static void shade_lamp(struct shading *s, const struct lamp *lamp)
{
    const struct job *job = s->t->job;
    const struct light *light = lamp->light;
    const bool area = light->area && job->area_lights && job->shadows;
    const bool lightlets = lamp_has_lightlets(job, light);
    const bool side_test = !(s->at.surface->flags & OBJECT_DOUBLE_ILLUMINATE);
    struct lamp_view view;
    struct rgb value;
    if (lightlets) {
        lamp_direction(lamp, light->location, s->at.p, &view);
        value = area_lit(s, lamp, side_test);
    } else {
        if (!lamp_view(lamp, light->location, s->at.p, &view) || is_black(view.color))
            return;
        value = rgb_mul(view.color, layers_lit(s, lamp, view.l, side_test));
    }
    if (value.r == 0 && value.g == 0 && value.b == 0)
        return;
    value = rgb_mul(value, s->path->through);
    if (!job->shadows || (light->shadowless && !lamp->window) || view.distance <= 0) {
        tracer_add(s->t, value);
        return;
    }
    struct shadow_request r = {
        .o = trace_offset(&s->at, view.l),
        .d = view.l,
        .t_max = view.distance,
        .value = value,
        .inside = s->path->inside,
        .slot = s->t->slot,
        .lamp = lamp->index,
        .photons = photons_instead(job, photons_collect(s->at.surface), light)};
    if (area && !light->shadowless)
        area_add(s->t, &(struct area_request){lamp, s->at.p, s->at.ng, s->at.error, value,
                                              r.slot, s->path->hash, r.photons});
    else if (lamp->window && !window_met(lamp->window, r.o, r.d, &r.t_max))
        return;
    else if (light->shadowless)
        tracer_add(s->t, value);
    else
        shadow_add(s->t, &r);
}

void shade_lights(struct shading *s)
{
    bool any = false;
    for (uint32_t i = 0; i < s->layer_count; i++)
        any |= finish_takes_light(s->layer[i].finish);
    if (!any)
        return;
    const struct lamp_list *list = &s->t->job->lamps[s->at.surface->light_group];
    for (uint32_t i = 0; i < list->count; i++)
        if (!list->lamp[i]->inert)
            shade_lamp(s, list->lamp[i]);
}
