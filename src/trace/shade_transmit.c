#include "base/arena.h"
#include "math/elementary.h"
#include "trace/contact.h"
#include "trace/inside.h"
#include "trace/near_zero.h"
#include "trace/shade.h"

struct vec3 mirrored(struct vec3 d, struct vec3 n, struct vec3 surface)
{
    struct vec3 q = vec3_mad(d, -2 * vec3_dot(d, n), n);
    if (vec3_dot(q, surface) < 0) {
        if (vec3_dot(q, n) < 0)
            q = vec3_mad(d, -2 * vec3_dot(d, surface), surface);
        else
            q = vec3_mad(q, -2 * vec3_dot(q, surface), surface);
    }
    return vec3_normalize(q);
}

double fresnel_index(const struct inside *list, const struct interior *interior)
{
    const double own = interior_ior(interior);
    if (!list)
        return own;
    const double last = interior_ior(list->interior);
    if (inside_find(list, interior))
        return list->outer ? last / own : 1 / own;
    return own / last;
}

static struct rgb mix(struct rgb a, struct rgb b, float f)
{
    return rgb_add(rgb_scale(1 - f, a), rgb_scale(f, b));
}

// Fresnel's reflectance of unpolarised light.
float fresnel_reflectance(double cosine, double n)
{
    const double s = n * n + cosine * cosine - 1;
    if (s <= 0)
        return 1;
    const double g = sqrt(s), c = cosine;
    const double a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
    return (float)fmax(0, fmin(1, 0.5 * a * a * (1 + b * b)));
}

struct rgb finish_reflectivity(const struct finish *f, double cosine, struct rgb color,
                               double index, float *weight)
{
    struct rgb r;
    if (f->fresnel) {
        r = mix(f->reflection_min, f->reflection_max, fresnel_reflectance(cosine, index));
        *weight = rgb_max(r);
    } else {
        const double base = 1 - cosine;
        double k = f->reflection_falloff == 1
                       ? base
                       : det_pow_single(fmax(0, base), f->reflection_falloff);
        if (fabs(k) < NEAR_ZERO)
            k = 0;
        else if (fabs(k - 1) < NEAR_ZERO)
            k = 1;
        r = mix(f->reflection_min, f->reflection_max, (float)k);
        *weight = fmaxf(rgb_max(f->reflection_min), rgb_max(f->reflection_max));
    }
    if (f->reflection_metallic != 0)
        r = metal_tint(r, color, f->reflection_metallic, cosine);
    return r;
}

struct rgb layer_reflectivity(const struct shading *s, const struct layer *l,
                              float *weight)
{
    const double index = !l->finish->fresnel ? 1
                         : s->contact
                             ? 1 / crossing_eta(&s->contact->sides)
                             : fresnel_index(s->path->inside, s->at.surface->interior);
    return finish_reflectivity(l->finish, -vec3_dot(s->path->d, l->n), l->color, index,
                               weight);
}

bool finish_has_mirror(const struct finish *f)
{
    const struct rgb a = f->reflection_min, b = f->reflection_max;
    return a.r != 0 || a.g != 0 || a.b != 0 || b.r != 0 || b.g != 0 || b.b != 0;
}

static struct path path_from(const struct shading *s, struct vec3 d, uint32_t way)
{
    struct path p = *s->path;
    p.d = d;
    p.o = trace_offset(&s->at, d);
    p.hash = hash_mix(p.hash, way);
    return p;
}

static bool same(struct vec3 a, struct vec3 b)
{
    return fabs(a.x - b.x) < NEAR_ZERO && fabs(a.y - b.y) < NEAR_ZERO &&
           fabs(a.z - b.z) < NEAR_ZERO;
}

// The mirror terms of all layers; those along `except` are left out (spec/lighting.md
// 6.4: total reflection has brought them).
void shade_mirrors(struct shading *s, const struct plain_result *r,
                   const struct vec3 *except)
{
    for (uint32_t i = r->begin; i < r->end; i++) {
        const struct layer *l = &s->layer[i];
        const struct finish *f = l->finish;
        if (!finish_has_mirror(f) || (except && same(l->n, *except)))
            continue;
        float weight;
        const struct rgb mirror = layer_reflectivity(s, l, &weight);
        if (mirror.r == 0 && mirror.g == 0 && mirror.b == 0)
            continue;
        struct path p = path_from(s, mirrored(s->path->d, l->n, s->view.n), 2 * i + 1);
        p.flags |= PATH_REFLECTED;
        p.through_t = 0;
        p.weight *= l->trans * weight;
        if (s->dark)
            p.weight *= weight; // photons end by the square, as in POV-Ray
        struct rgb irid = {1, 1, 1};
        if (f->irid != 0)
            irid = irid_factor(s, f, l->n, p.d);
        const struct rgb factor = rgb_mul(rgb_scale(r->weight, mirror), p.through);
        if (f->reflection_exponent != 1) {
            p.through = irid;
            power_emit(s->t, &p, factor, f->reflection_exponent);
        } else {
            p.through = rgb_mul(factor, irid);
            path_emit(s->t, &p);
        }
    }
}

struct crossing_sides interior_cross(struct tracer *t, const struct inside *list,
                                     const struct interior *x)
{
    if (!list)
        return (struct crossing_sides){NULL, x, inside_enter(t, list, x), false};
    if (list->interior == x)
        return (struct crossing_sides){x, list->outer ? list->outer->interior : NULL,
                                       list->outer, false};
    if (inside_find(list, x))
        return (struct crossing_sides){x, x, inside_remove(t->arena, list, x), true};
    return (struct crossing_sides){list->interior, x, inside_enter(t, list, x), false};
}

double crossing_eta(const struct crossing_sides *c)
{
    const double from = c->from ? interior_ior(c->from) : 1;
    const double to = c->to ? interior_ior(c->to) : 1;
    return c->straight ? 1 : from / to;
}

static double dispersion(const struct interior *i)
{
    return i && i->dispersion > 0 ? i->dispersion : 1;
}

static int bands(const struct crossing_sides *c)
{
    static const int usual = 7;
    int n = c->from ? c->from->dispersion_samples : 0;
    if (c->to && c->to->dispersion_samples > n)
        n = c->to->dispersion_samples;
    return n > 0 ? n : usual;
}

static double spectrum_sum(const struct job *job, double wavelength, int k)
{
    const double at = (wavelength - 375) / 5;
    if (at <= 0)
        return job->spectrum[0][k];
    if (at >= SPECTRUM_NODES - 1)
        return job->spectrum[SPECTRUM_NODES - 1][k];
    const int i = (int)at;
    const double f = at - i;
    return job->spectrum[i][k] * (1 - f) + job->spectrum[i + 1][k] * f;
}

static float hue(const struct job *job, double wavelength, double width, int k)
{
    return (float)((spectrum_sum(job, wavelength + width / 2, k) -
                    spectrum_sum(job, wavelength - width / 2, k)) *
                   350 / width);
}

struct bending {
    const struct plain_result *r;
    struct crossing_sides sides;
    struct vec3 top; // normal of the top layer
    struct vec3 n;   // the same against the ray
    struct rgb fade; // A of spec/lighting.md 6.4
    float weight;
};

static void continue_straight(struct shading *s, const struct bending *b)
{
    struct path p = path_from(s, s->path->d, 0);
    p.inside = b->sides.inside;
    p.flags |= PATH_CONTINUED;
    p.weight = b->weight;
    const struct rgb own = b->r->any ? b->r->filter : rgb_even(b->r->weight);
    p.through = rgb_mul(p.through, rgb_mul(b->fade, own));
    p.through_t *= rgb_luminance(b->fade) * b->r->weight * (b->r->any ? b->r->trans : 1);
    path_emit(s->t, &p);
}

// One ray through the surface with index ratio eta, or back from it. False: back.
static bool bend(struct shading *s, const struct bending *b, double eta, struct rgb share,
                 float share_t, float wavelength, uint32_t way)
{
    const struct vec3 d = s->path->d;
    const double c = -vec3_dot(d, b->n);
    const double k = 1 + eta * eta * (c * c - 1);
    const struct rgb factor = rgb_mul(s->path->through, rgb_mul(b->fade, share));
    if (k < 0) {
        struct path p = path_from(s, mirrored(d, b->top, s->view.n), way);
        p.flags |= PATH_REFLECTED;
        p.weight = b->weight;
        p.wavelength = wavelength;
        p.through = rgb_scale(b->r->weight, factor);
        p.through_t = 0;
        const struct finish *f = s->layer[b->r->begin].finish;
        if (f->irid != 0)
            p.through = rgb_mul(p.through, irid_factor(s, f, b->top, p.d));
        path_emit(s->t, &p);
        return false;
    }
    const struct vec3 bent =
        vec3_normalize(vec3_mad(vec3_scale(eta, d), eta * c - sqrt(k), b->n));
    struct path p = path_from(s, bent, way);
    p.inside = b->sides.inside;
    p.weight = b->weight;
    p.wavelength = wavelength;
    p.through = rgb_mul(factor, b->r->any ? b->r->filter : rgb_even(b->r->weight));
    p.through_t *=
        share_t * rgb_luminance(b->fade) * b->r->weight * (b->r->any ? b->r->trans : 1);
    path_emit(s->t, &p);
    return true;
}

static bool refract(struct shading *s, const struct bending *b)
{
    const struct crossing_sides *c = &b->sides;
    const double eta = crossing_eta(c);
    const double spread = c->straight ? 1 : dispersion(c->from) / dispersion(c->to);
    const struct rgb white = {1, 1, 1};
    if (fabs(eta - 1) < NEAR_ZERO && fabs(spread - 1) < NEAR_ZERO) {
        continue_straight(s, b);
        return true;
    }
    if (fabs(spread - 1) < NEAR_ZERO)
        return bend(s, b, eta, white, 1, s->path->wavelength, 0);
    if (s->path->wavelength > 0)
        return bend(s, b, eta * det_pow(spread, -(s->path->wavelength - 555) / 350.0),
                    white, 1, s->path->wavelength, 0);
    const int n = bands(c);
    bool out = false;
    for (int i = 0; i < n; i++) {
        const double width = 350.0 / n, wavelength = 380 + width * (i + 0.5);
        const struct rgb color = {hue(s->t->job, wavelength, width, 0),
                                  hue(s->t->job, wavelength, width, 1),
                                  hue(s->t->job, wavelength, width, 2)};
        out |= bend(s, b, eta * det_pow(spread, -(wavelength - 555) / 350),
                    rgb_scale(1.0f / (float)n, color), 0, (float)wavelength,
                    hash_mix(7, (uint32_t)i));
    }
    return out;
}

struct rgb way_fade(const struct interior *x, const struct inside *inside, double s)
{
    struct rgb fade = rgb_even(x->old_refraction);
    if (fabs(x->fade_distance) > NEAR_ZERO && inside_find(inside, x))
        fade = rgb_mul(fade, interior_fade(x, s));
    return fade;
}

bool shade_refract(struct shading *s, const struct plain_result *r)
{
    const struct job *job = s->t->job;
    struct bending b;
    if (!(r->trans > job->adc_bailout) || !job->refraction || r->end == r->begin)
        return true;
    const struct vec3 top = s->layer[r->begin].n;
    b.r = r;
    b.sides = shading_crosses(s);
    b.top = top;
    b.n = vec3_dot(top, s->path->d) > 0 ? vec3_neg(top) : top;
    b.fade = way_fade(s->at.surface->interior, s->path->inside, s->s);
    if (s->contact)
        b.fade = rgb_mul(b.fade, s->contact->pass);
    b.weight = s->path->weight;
    if (r->any && r->weight > 0)
        b.weight *=
            fmaxf(fabsf(r->filter.r), fmaxf(fabsf(r->filter.g), fabsf(r->filter.b))) /
            r->weight;
    return refract(s, &b);
}

void shade_transmit(struct shading *s, const struct plain_result *r)
{
    const struct vec3 *except = NULL;
    if (!shade_refract(s, r))
        except = &s->layer[r->begin].n;
    if (s->t->job->mirrors)
        shade_mirrors(s, r, except);
}
