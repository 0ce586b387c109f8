// Bounds over eight boxes at once (tape.h): in lanes where the tape fits.
#include "math/processor.h"
#include "scene/tape_kernel.h"
#include "scene/tape_steps.h"

bool tape_has_lanes(const struct tape *t)
{
    return t->register_count <= TAPE_LANE_REGISTERS_MAX && t->arguments <= 3;
}

bool tape_is_flat(const struct tape *t) { return tape_has_lanes(t) && !t->calls; }

const struct tape_kernels *tape_kernels_best(void)
{
#ifdef LAMBERT_X86
    if (processor_has("avx512"))
        return &tape_kernels_avx512;
    if (processor_has("avx2"))
        return &tape_kernels_avx2;
#endif
    return &tape_kernels_base;
}

static void one_by_one(const struct tape *t, const struct tape_boxes *in, bool slopes,
                       struct tape_slopes *out)
{
    for (int l = 0; l < TAPE_LANES; l++) {
        struct tape_slope arg[3];
        for (int i = 0; i < 3; i++) {
            arg[i].v = interval(in->lo[i][l], in->hi[i][l]);
            for (int k = 0; k < 3; k++)
                arg[i].d[k] = interval_point(slopes && i == k);
        }
        struct tape_slope r[TAPE_WIDTH_MAX];
        if (t->width == 1)
            r[0] = tape_bounds_slope(t, arg, 3);
        else
            tape_bounds_all(t, arg, 3, r);
        for (int k = 0; k < t->width; k++) {
            out[k].lo[l] = r[k].v.lo;
            out[k].hi[l] = r[k].v.hi;
            for (int i = 0; i < 3; i++) {
                out[k].slope_lo[i][l] = r[k].d[i].lo;
                out[k].slope_hi[i][l] = r[k].d[i].hi;
            }
        }
    }
}

void tape_bounds_packet(const struct tape *t, const struct tape_boxes *in, bool slopes,
                        struct tape_slopes *out)
{
    if (tape_has_lanes(t))
        tape_kernels_best()->bounds(t, in, slopes, out);
    else
        one_by_one(t, in, slopes, out);
}
