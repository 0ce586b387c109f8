#include "eval/build.h"
#include "eval/expr.h"
#include "eval/function.h"
#include "math/color.h"
#include "scene/heights.h"

// The samples of height_field: a function of x and y or a picture.

enum { SIDE_MAX = 65536 };
static const double SAMPLES_MAX = 1 << 28;

static bool make_room(struct args *a, struct span where, double width, double height,
                      struct heights *out)
{
    if (!(width >= 2 && height >= 2)) {
        args_error(a, where, "a height_field needs at least 2 samples along each side");
        return false;
    }
    if (width > SIDE_MAX || height > SIDE_MAX || width * height > SAMPLES_MAX) {
        args_error(a, where, "the height_field has too many samples");
        return false;
    }
    out->width = (int)width;
    out->height = (int)height;
    out->at = arena_new_array(a->b->arena, float, (size_t)out->width * (size_t)out->height);
    return true;
}

// 16 bits, which wrap: 1.5 is the same as 0.5 (spec/shapes.md 4.21).
static float stored(double f)
{
    double v = trunc(65535 * f);
    if (!isfinite(v))
        return 0;
    v = fmod(v, 65536);
    return (float)(v < 0 ? v + 65536 : v);
}

static double sample(const struct tape *f, double x, double y)
{
    const double argument[3] = {x, y, 0};
    double out[5] = {0};
    tape_run(f, argument, out);
    if (tape_width(f) < 3)
        return out[0];
    return 0.297 * out[0] + 0.589 * out[1] + 0.114 * out[2];
}

// function w, h { body }
static bool from_function(struct args *a, const struct ast *block, struct heights *out)
{
    const struct ast *w = block->list, *h = w ? w->next : NULL, *body = h ? h->next : NULL;
    double width, height;
    if (!body) {
        args_error(a, block->where, "function needs a width and a height here");
        return false;
    }
    if (!eval_float(a->b->e, w, &width) || !eval_float(a->b->e, h, &height))
        return false;
    struct ast only = *block;
    only.list = ast_copy(a->b->e->parse, body);
    const struct value *v = function_value(a->b->e, &only);
    if (!v || !make_room(a, block->where, floor(width + 0.5), floor(height + 0.5), out))
        return false;
    if (tape_arguments(v->data) != 3) {
        args_error(a, block->where, "the function must be one of x and y");
        return false;
    }
    for (int j = 0; j < out->height; j++) // the function's y runs down
        for (int i = 0; i < out->width; i++) {
            const double y = (out->height - 1 - j) / (out->height - 1.);
            out->at[(size_t)j * (size_t)out->width + (size_t)i] =
                stored(sample(v->data, i / (out->width - 1.), y));
        }
    return true;
}

bool args_heights(struct args *a, struct heights *out)
{
    bool ok = false;
    if (args_at_block(a) == WORD_function)
        ok = from_function(a, args_next(a), out);
    else
        diag_at(args_diags(a), DIAG_NOT_BUILT, args_span(a), "a height_field of a file");
    if (!ok)
        args_fail(a);
    return ok;
}
