// Densities of media at eight points, compiled once per instruction set: ISA names it. The
// expressions are those of one point in media_mix.c, in their order.
#include "math/isa.h"
#include "math/lanes_vec.h"
#include "scene/effects.h"
#include "scene/pigment_tape.h"
#include "trace/media_mix.h"
#include "trace/shade_kernel.h"

extern const struct surface_kernels OF_ISA(surface_kernels_);

static void density_alone(const struct pigment *p, const struct media_places *w,
                          uint32_t count, double out[3][8])
{
    for (uint32_t i = 0; i < 8; i++) {
        struct rgbft c = {0};
        const struct vec3 at = {w->at[0][i], w->at[1][i], w->at[2][i]};
        const struct vec3 d = {w->ray_d[0][i], w->ray_d[1][i], w->ray_d[2][i]};
        const struct texture_point point = {.p = at, .p_world = at, .ray_d = d};
        if (i >= count || !pigment_color(p, &point, &c))
            c = (struct rgbft){0};
        out[0][i] = (double)c.r;
        out[1][i] = (double)c.g;
        out[2][i] = (double)c.b;
    }
}

// Tapes run through eight points at once (scene/pigment_tape.h).
LANES_INLINE struct vec8 density_of(const struct pigment *p,
                                    const struct pigment_tape *tape,
                                    const struct media_places *w, uint32_t count)
{
    static const double no_normal[3][8];
    enum { WORTH = 3 };
    if (!tape || count < WORTH) {
        double c[3][8];
        density_alone(p, w, count, c);
        return v8_load((const double(*)[8])c);
    }
    float c[5][8];
    const struct pattern_packet packet = {w->at, no_normal, w->ray_d, NULL};
    const struct mask8 found = m8_of(
        OF_ISA(surface_kernels_).colors(tape, &packet, w->at, (1u << count) - 1, c));
    const struct real8 none = r8_set(0);
    return (struct vec8){r8_select(found, r8_of_floats(f8_load(c[0])), none),
                         r8_select(found, r8_of_floats(f8_load(c[1])), none),
                         r8_select(found, r8_of_floats(f8_load(c[2])), none)};
}

// sum += density * color.
LANES_INLINE void add_times(double sum[3][8], struct vec8 density, struct vec3 color)
{
    if (color.x == 0 && color.y == 0 && color.z == 0)
        return;
    const struct vec8 s = v8_load((const double(*)[8])sum);
    v8_store(sum, (struct vec8){r8_add(s.x, r8_mul(density.x, r8_set(color.x))),
                                r8_add(s.y, r8_mul(density.y, r8_set(color.y))),
                                r8_add(s.z, r8_mul(density.z, r8_set(color.z)))});
}

media_add_fn OF_ISA(media_add_);

void OF_ISA(media_add_)(const struct media *m, const struct pigment_tape *const *tape,
                        const struct media_places *place, uint32_t count,
                        struct media_eight *sum)
{
    const struct vec3 lost = media_extinction(m), given = vec3_of_rgb(m->emission),
                      scattered = vec3_of_rgb(m->scattering);
    for (uint32_t i = 0; i < count; i += 8, place++, sum++) {
        const struct real8 one = r8_set(1);
        struct vec8 density = {one, one, one};
        for (uint32_t j = 0; j < m->density_count; j++) {
            const struct vec8 c = density_of(m->density[j], tape ? tape[j] : NULL, place,
                                             count - i < 8 ? count - i : 8);
            density = (struct vec8){r8_mul(density.x, c.x), r8_mul(density.y, c.y),
                                    r8_mul(density.z, c.z)};
        }
        add_times(sum->extinction, density, lost);
        add_times(sum->emission, density, given);
        add_times(sum->scattering, density, scattered);
    }
}
