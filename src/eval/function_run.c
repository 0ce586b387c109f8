// Evaluation of functions (spec/language 4.16).

#include <math.h>
#include <string.h>

#include "eval/expr.h"
#include "eval/function_tape.h"
#include "eval/internal.h"
#include "math/elementary.h"
#include "scene/texture.h"

bool function_math_arity(enum word w, int *least, int *most)
{
    *least = *most = 1;
    switch (w) {
    case WORD_sin: case WORD_cos: case WORD_tan: case WORD_asin: case WORD_acos:
    case WORD_atan: case WORD_sinh: case WORD_cosh: case WORD_tanh: case WORD_asinh:
    case WORD_acosh: case WORD_atanh: case WORD_abs: case WORD_radians: case WORD_degrees:
    case WORD_int: case WORD_floor: case WORD_ceil: case WORD_sqrt: case WORD_exp:
    case WORD_ln: case WORD_log: return true;
    case WORD_div: case WORD_mod: case WORD_atan2: case WORD_pow:
        *least = *most = 2;
        return true;
    case WORD_min: case WORD_max:
        *least = 2;
        *most = FUNCTION_REGISTERS;
        return true;
    case WORD_select:
        *least = 3;
        *most = 4;
        return true;
    default: return false;
    }
}

static double select_of(const double *a, int n)
{
    if (a[0] < 0)
        return a[1];
    return n == 4 && a[0] == 0 ? a[2] : a[n - 1];
}

static double extreme(const double *a, int n, bool max)
{
    double v = a[0];
    for (int i = 1; i < n; i++)
        if (max ? a[i] > v : a[i] < v)
            v = a[i];
    return v;
}

double function_math(enum word w, const double *a, int n)
{
    static const double pi = 3.14159265358979323846;
    switch (w) {
    case WORD_sin: return det_sin(a[0]);
    case WORD_cos: return det_cos(a[0]);
    case WORD_tan: return det_tan(a[0]);
    case WORD_asin: return det_asin(a[0]);
    case WORD_acos: return det_acos(a[0]);
    case WORD_atan: return det_atan(a[0]);
    case WORD_sinh: return det_sinh(a[0]);
    case WORD_cosh: return det_cosh(a[0]);
    case WORD_tanh: return det_tanh(a[0]);
    case WORD_asinh: return det_asinh(a[0]);
    case WORD_acosh: return det_acosh(a[0]);
    case WORD_atanh: return det_atanh(a[0]);
    case WORD_abs: return fabs(a[0]);
    case WORD_radians: return a[0] * pi / 180;
    case WORD_degrees: return a[0] * 180 / pi;
    case WORD_int: return number_to_int(a[0]);
    case WORD_floor: return floor(a[0]);
    case WORD_ceil: return ceil(a[0]);
    case WORD_sqrt: return sqrt(a[0]);
    case WORD_exp: return det_exp(a[0]);
    case WORD_ln: return det_log(a[0]);
    case WORD_log: return det_log10(a[0]);
    case WORD_div: return number_to_int(a[0] / a[1]);
    case WORD_mod: return fmod(a[0], a[1]);
    case WORD_atan2: return det_atan2(a[0], a[1]);
    case WORD_pow: return det_pow(a[0], a[1]);
    case WORD_min: return extreme(a, n, false);
    case WORD_max: return extreme(a, n, true);
    default: return select_of(a, n);
    }
}

static double compare(int op, double a, double b)
{
    switch (op) {
    case STEP_LESS: return a < b;
    case STEP_GREATER: return a > b;
    case STEP_EQUAL: return a == b;
    case STEP_NOT_EQUAL: return a != b;
    case STEP_LESS_EQUAL: return a <= b;
    case STEP_GREATER_EQUAL: return a >= b;
    case STEP_AND: return a != 0 && b != 0;
    default: return a != 0 || b != 0;
    }
}

static double call(const struct step *s, const double *argument)
{
    double v[5] = {0};
    function_run(s->callee, argument, v);
    if (s->op == STEP_GRAY)
        return 0.297 * v[0] + 0.589 * v[1] + 0.114 * v[2];
    return v[s->b];
}

static double run_tape(const struct function *f, const double *argument)
{
    double r[FUNCTION_REGISTERS];
    memcpy(r, argument, (size_t)f->parameters * sizeof *r);
    for (uint32_t i = 0; i < f->step_count; i++) {
        const struct step *s = &f->step[i];
        switch (s->op) {
        case STEP_CONSTANT: r[s->to] = s->k; break;
        case STEP_COPY: r[s->to] = r[s->a]; break;
        case STEP_NEGATE: r[s->to] = -r[s->a]; break;
        case STEP_ADD: r[s->to] = r[s->a] + r[s->b]; break;
        case STEP_SUBTRACT: r[s->to] = r[s->a] - r[s->b]; break;
        case STEP_MULTIPLY: r[s->to] = r[s->a] * r[s->b]; break;
        case STEP_DIVIDE: r[s->to] = r[s->a] / r[s->b]; break;
        case STEP_MATH: r[s->to] = function_math(s->word, r + s->a, s->b); break;
        case STEP_CALL: case STEP_GRAY: r[s->to] = call(s, r + s->a); break;
        case STEP_JUMP: i = (uint32_t)s->to - 1; break;
        case STEP_UNLESS:
            if (r[s->a] == 0)
                i = (uint32_t)s->to - 1;
            break;
        default: r[s->to] = compare(s->op, r[s->a], r[s->b]);
        }
    }
    return r[f->result];
}

// No surface is there: slopes are 0.
static void run_pigment(const struct pigment *pigment, struct vec3 p, double out[5])
{
    const struct texture_point at = {.p = p, .p_world = p, .uv = {p.x, p.y}};
    struct rgbft c = {0};
    pigment_color(pigment, &at, &c);
    out[0] = c.r;
    out[1] = c.g;
    out[2] = c.b;
    out[3] = c.filter;
    out[4] = c.transmit;
}

static double run_pattern(const struct pattern *pattern, struct vec3 p)
{
    const struct pattern_context none = {.p_world = p, .uv = {p.x, p.y}};
    return pattern_value(pattern, p, &none);
}

static double run_internal(const struct function *f, struct vec3 p, const double *more)
{
    const struct internal_function *i = f->data;
    return i->value(p, more, f->defaults);
}

void function_run(const struct function *f, const double *argument, double out[5])
{
    if (f->kind == FUNCTION_TAPE) {
        out[0] = run_tape(f, argument);
        return;
    }
    if (f->kind == FUNCTION_SPLINE) {
        const struct spline *s = f->data;
        spline_at(s, s->kind, argument[0], out);
        return;
    }
    struct vec3 p = vec3(argument[0], argument[1], argument[2]);
    switch (f->kind) {
    case FUNCTION_INTERNAL: out[0] = run_internal(f, p, argument + 3); break;
    case FUNCTION_PIGMENT: run_pigment(f->data, p, out); break;
    case FUNCTION_PATTERN: out[0] = run_pattern(f->data, p); break;
    default:
        p = transform_point(f->data, p);
        out[0] = p.x;
        out[1] = p.y;
        out[2] = p.z;
    }
}

int function_parameters(const struct function *f) { return f->parameters; }
int function_width(const struct function *f) { return f->width; }

double function_at(const void *data, struct vec3 p)
{
    double argument[3] = {p.x, p.y, p.z}, out[5];
    function_run(data, argument, out);
    return out[0];
}
