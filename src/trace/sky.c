#include "trace/sky.h"

#include "scene/texture.h"

static struct rgbft sky_pigment(const struct pigment *p, struct vec3 d)
{
    const struct texture_point at = {.p = d};
    struct rgbft c = {0, 0, 0, 0, 0};
    pigment_color(p, &at, &c);
    return c;
}

static struct rgb sky_old(const struct job *job, struct vec3 d, float *t)
{
    const struct scene *scene = job->scene;
    const struct sky_sphere *sky = scene->sky;
    struct rgb sum = {0, 0, 0};
    struct rgbft product = {1, 1, 1, 1, 1};
    float trans = 1;
    for (uint32_t i = sky->count; i-- > 0;) {
        const struct rgbft c = sky_pigment(sky->pigment[i], d);
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

struct rgb sky_color(const struct job *job, struct vec3 d, bool opaque, float *t)
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
        return sky_old(job, d, t);

    struct rgb sum = {0, 0, 0}, filter = {1, 1, 1};
    for (uint32_t i = scene->sky ? scene->sky->count : 0; i-- > 0;) {
        const struct rgbft c = sky_pigment(scene->sky->pigment[i], d);
        const struct rgb seen = rgb_scale(rgbft_opacity(c), rgbft_rgb(c));
        sum = rgb_add(sum, rgb_mul(rgb_mul(seen, filter), scene->sky->emission));
        filter = rgb_mul(filter, rgbft_pass(c));
    }
    sum = rgb_add(sum,
                  rgb_mul(rgb_scale(rgbft_opacity(ground), rgbft_rgb(ground)), filter));
    filter = rgb_mul(filter, rgbft_pass(ground));
    *t = fminf(1, fabsf(rgb_grey(filter)));
    return sum;
}
