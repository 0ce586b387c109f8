#ifndef EVAL_SPLINE_H
#define EVAL_SPLINE_H

#include "eval/eval.h"
#include "scene/tape.h"

enum spline_kind { SPLINE_LINEAR, SPLINE_QUADRATIC, SPLINE_CUBIC, SPLINE_NATURAL };

struct spline_point {
    double at, p[5];
    double second[5]; // natural: second derivative
};

// Points in ascending order of `at`; at least one (spec/language 4.15).
struct spline {
    enum spline_kind kind;
    int width; // 2..5
    uint32_t count;
    struct spline_point *point;
};

// The value of `spline { }`; NULL after an error.
const struct value *spline_value(struct eval *e, const struct ast *block);
// `out` gets `width` components. Any kind may be asked for.
void spline_at(const struct spline *s, enum spline_kind kind, double at, double out[5]);
// As functions call it, by width.
extern const struct tape_extern spline_extern[6];
bool spline_kind_of(enum word w, enum spline_kind *out);

#endif
