#include "trace/sky.h"

#include <stdlib.h>

#include "base/arena.h"
#include "base/memory.h"
#include "scene/pigment_tape.h"
#include "scene/texture.h"

static struct rgbft sky_pigment(const struct pigment *p, struct vec3 d)
{
    const struct texture_point at = {.p = d};
    struct rgbft c = {0, 0, 0, 0, 0};
    pigment_color(p, &at, &c);
    return c;
}

// color: of the sky's pigments.
static struct rgb sky_old(const struct job *job, const struct rgbft *color, float *t)
{
    const struct scene *scene = job->scene;
    const struct sky_sphere *sky = scene->sky;
    struct rgb sum = {0, 0, 0};
    struct rgbft product = {1, 1, 1, 1, 1};
    float trans = 1;
    for (uint32_t i = sky->count; i-- > 0;) {
        const struct rgbft c = color[i];
        sum = rgb_add(sum, rgb_scale(trans * rgbft_opacity(c), rgbft_rgb(c)));
        product =
            (struct rgbft){product.r * c.r, product.g * c.g, product.b * c.b,
                           product.filter * c.filter, product.transmit * c.transmit};
        trans = fabsf(product.filter) + fabsf(product.transmit);
    }
    *t = 0;
    return rgb_add(rgb_mul(sum, sky->emission),
                   rgb_mul(rgbft_rgb(scene->background), rgbft_pass(product)));
}

// What is seen through the sky's pigments, of these colours.
static struct rgb sky_seen(const struct job *job, const struct rgbft *color, bool opaque,
                           float *t)
{
    const struct scene *scene = job->scene;
    const bool through = job->see_through && !opaque;
    struct rgbft ground = {0, 0, 0, 0, 1};
    if (scene->has_background)
        ground = scene->background;
    if (job->old_opacity && scene->has_background) {
        ground.filter = 0;
        ground.transmit = job->see_through ? 1 : 0;
    }
    if (job->old_opacity && through) {
        *t = 1;
        return rgb(0, 0, 0);
    }
    if (!scene->has_background && !job->see_through)
        ground.transmit = 0;
    if (!job->see_through && !job->old_opacity) {
        // What a transparent background lets through is black without an alpha channel.
        const float keep = 1 - ground.transmit;
        ground = (struct rgbft){keep * ground.r, keep * ground.g, keep * ground.b, 0, 0};
    }
    if (!through)
        ground.filter = ground.transmit = 0;
    if (job->old_opacity && scene->sky)
        return sky_old(job, color, t);

    struct rgb sum = {0, 0, 0}, filter = {1, 1, 1};
    for (uint32_t i = scene->sky ? scene->sky->count : 0; i-- > 0;) {
        const struct rgbft c = color[i];
        const struct rgb seen = rgb_scale(rgbft_opacity(c), rgbft_rgb(c));
        sum = rgb_add(sum, rgb_mul(rgb_mul(seen, filter), scene->sky->emission));
        filter = rgb_mul(filter, rgbft_pass(c));
    }
    sum = rgb_add(sum,
                  rgb_mul(rgb_scale(rgbft_opacity(ground), rgbft_rgb(ground)), filter));
    filter = rgb_mul(filter, rgbft_pass(ground));
    *t = fminf(1, fabsf(rgb_luminance(filter)));
    return sum;
}

enum { SKY_PIGMENTS = 8 }; // more are rare; they take memory of the thread's own

struct rgb sky_color(const struct job *job, struct vec3 d, bool opaque, float *t)
{
    const struct sky_sphere *sky = job->scene->sky;
    const uint32_t count = sky ? sky->count : 0;
    struct rgbft few[SKY_PIGMENTS] = {{0}}, *color = few;
    if (count > SKY_PIGMENTS)
        color = must_calloc(count, sizeof *color);
    for (uint32_t i = 0; i < count; i++)
        color[i] = sky_pigment(sky->pigment[i], d);
    const struct rgb c = sky_seen(job, color, opaque, t);
    if (color != few)
        free(color);
    return c;
}

// ---- eight directions -----------------------------------------------------------------

void sky_compile(struct job *job, struct arena *a)
{
    const struct sky_sphere *sky = job->scene->sky;
    struct pigment_compiler compiler = {.arena = a};
    if (!sky || job->general || sky->count > SKY_PIGMENTS)
        return;
    const struct pigment_tape **tape =
        arena_new_array(a, const struct pigment_tape *, sky->count + 1);
    for (uint32_t i = 0; i < sky->count; i++) {
        tape[i] = pigment_compile(&compiler, sky->pigment[i]);
        if (!tape[i])
            return;
    }
    job->sky_tape = tape;
}

void sky_colors(const struct job *job, const double d[3][8], uint32_t count,
                const bool opaque[8], struct rgb out[8], float t[8])
{
    static const double none[3][8]; // no surface
    const struct pattern_packet packet = {none, none, none, NULL};
    const struct sky_sphere *sky = job->scene->sky;
    struct rgbft color[8][SKY_PIGMENTS];
    for (uint32_t i = 0; i < sky->count; i++) {
        float c[5][8] = {{0}};
        const unsigned found = job->surface_kernels->colors(job->sky_tape[i], &packet, d,
                                                            (1u << count) - 1, c);
        for (uint32_t k = 0; k < count; k++)
            color[k][i] =
                found >> k & 1
                    ? (struct rgbft){c[0][k], c[1][k], c[2][k], c[3][k], c[4][k]}
                    : sky_pigment(sky->pigment[i], vec3(d[0][k], d[1][k], d[2][k]));
    }
    for (uint32_t k = 0; k < count; k++)
        out[k] = sky_seen(job, color[k], opaque[k], &t[k]);
}
