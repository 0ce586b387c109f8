// checker: unit cubes of two kinds in turn

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    // Whole numbers up to 3e17 fit the integer.
    const int64_t cell =
        (int64_t)(floor(at.x + PATTERN_EDGE) + floor(at.y + PATTERN_EDGE) +
                  floor(at.z + PATTERN_EDGE));
    return (double)(cell & 1);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    uint32_t odd = formula_constant(f, 0);
    for (int i = 0; i < 3; i++) {
        const uint32_t cell = formula_floor(f, formula_offset(f, at[i], PATTERN_EDGE));
        odd = tape_binary(f->b, TAPE_NOT_EQUAL, odd, formula_odd(f, cell));
    }
    return odd;
}

const struct pattern_ops checker_pattern_ops = {.keyword = "checker",
                                                .frequency = 0,
                                                .list = 2,
                                                .value = value,
                                                .formula = formula,
                                                .plain = PLAIN_CHECKER};
