#include "trace/lamp.h"

#include "math/elementary.h"
#include "math/pi.h"

void lamp_init(struct lamp *lamp, const struct light *light, uint32_t index)
{
    *lamp = (struct lamp){.light = light, .index = index};
    if (light->kind == LIGHT_SPOT) {
        lamp->cos_radius = det_cos(light->radius * DEGREE);
        lamp->cos_falloff = det_cos(light->falloff * DEGREE);
    }
    lamp->dull = light->shadowless;
    lamp->inert = light->color.r == 0 && light->color.g == 0 && light->color.b == 0;
}

static double smooth(double low, double high, double v)
{
    if (v < low)
        return 0;
    if (v >= high)
        return 1;
    const double t = (v - low) / (high - low);
    return t * t * (3 - 2 * t);
}

static double power(double base, double exponent)
{
    return exponent == 0 ? 1 : exponent == 1 ? base : det_pow_single(base, exponent);
}

static double spot(const struct lamp *lamp, const struct lamp_view *v)
{
    const double along = vec3_dot(v->l, lamp->light->axis);
    const double k = v->distance > 0 ? -along : along;
    if (k <= 0)
        return 0;
    double factor = power(k, lamp->light->tightness);
    if (lamp->cos_radius > 0 && k < lamp->cos_radius)
        factor *= smooth(lamp->cos_falloff, lamp->cos_radius, k);
    return factor;
}

static double cylinder(const struct lamp *lamp, struct vec3 at, struct vec3 p)
{
    const struct light *light = lamp->light;
    const struct vec3 from = vec3_sub(p, at);
    const double along = vec3_dot(from, light->axis);
    if (along <= 0)
        return 0;
    const double off = vec3_length(vec3_mad(from, -along, light->axis));
    if (off >= light->falloff)
        return 0;
    const double inward = 1 - off / light->falloff;
    double factor = power(inward, light->tightness);
    if (light->radius > 0 && off > light->radius)
        factor *= smooth(0, 1 - light->radius / light->falloff, inward);
    return factor;
}

void lamp_direction(const struct lamp *lamp, struct vec3 at, struct vec3 p,
                    struct lamp_view *out)
{
    const struct light *light = lamp->light;
    const struct vec3 to = vec3_sub(at, p);
    out->color = light->color;
    if (light->parallel || light->kind == LIGHT_CYLINDER) {
        out->l = light->area ? vec3_normalize(vec3_sub(at, light->point_at))
                             : vec3_neg(light->axis);
        out->distance = vec3_dot(to, out->l);
        return;
    }
    out->distance = vec3_length(to);
    out->l = out->distance > 0 ? vec3_scale(1 / out->distance, to) : to;
}

double lamp_attenuation(const struct lamp *lamp, struct vec3 at, struct vec3 p,
                        const struct lamp_view *v)
{
    const struct light *light = lamp->light;
    double factor = 1;
    if (light->kind == LIGHT_SPOT)
        factor = spot(lamp, v);
    else if (light->kind == LIGHT_CYLINDER)
        factor = cylinder(lamp, at, p);
    if (light->fade_power > 0 && light->fade_distance != 0)
        factor *= 2 / (1 + power(v->distance / light->fade_distance, light->fade_power));
    return factor;
}

bool lamp_view(const struct lamp *lamp, struct vec3 at, struct vec3 p,
               struct lamp_view *out)
{
    if (lamp->inert)
        return false;
    lamp_direction(lamp, at, p, out);
    const double factor = lamp_attenuation(lamp, at, p, out);
    if (factor == 0)
        return false;
    if (factor != 1)
        out->color = rgb_scale((float)factor, out->color);
    return true;
}

// The grid turned to face p, about the light's own first length.
static void orient(const struct light *light, struct vec3 p, struct vec3 *axis1,
                   struct vec3 *axis2)
{
    const struct vec3 l = vec3_normalize(vec3_sub(light->location, p));
    const struct vec3 e = fabs(fabs(l.z) - 1) < 0.01 ? vec3(0, 1, 0) : vec3(0, 0, 1);
    const double length = vec3_length(light->axis1);
    *axis1 = vec3_scale(length, vec3_normalize(vec3_cross(l, e)));
    *axis2 = vec3_scale(length, vec3_normalize(vec3_cross(l, *axis1)));
}

struct lamp_grid lamp_grid_of(const struct lamp *lamp, struct vec3 p)
{
    struct lamp_grid g = {lamp->light->axis1, lamp->light->axis2};
    if (lamp->light->orient)
        orient(lamp->light, p, &g.axis1, &g.axis2);
    return g;
}

struct vec3 lamp_grid_point(const struct lamp *lamp, const struct lamp_grid *g, double u,
                            double v)
{
    const struct light *light = lamp->light;
    double ju = light->size1 > 1 ? u / (light->size1 - 1) - 0.5 : 0;
    double jv = light->size2 > 1 ? v / (light->size2 - 1) - 0.5 : 0;
    if (light->circular) {
        // The small shift keeps the grid's centre defined (spec/lighting.md 8.4).
        ju += 0.001;
        jv += 0.001;
        const double squash = fmax(fabs(ju), fabs(jv)) / sqrt(ju * ju + jv * jv);
        ju *= squash;
        jv *= squash;
    }
    return vec3_mad(vec3_mad(light->location, ju, g->axis1), jv, g->axis2);
}
