#include "eval/build.h"

// translate, rotate, scale, matrix, transform (spec/language 4.17).

static void scale(struct args *a, struct span where, struct vec3 v, struct transform *out)
{
    static const char *const zero[] = {"x scale factor is 0, 1 is used instead",
                                       "y scale factor is 0, 1 is used instead",
                                       "z scale factor is 0, 1 is used instead"};
    double *c[] = {&v.x, &v.y, &v.z};
    for (int i = 0; i < 3; i++) {
        if (*c[i] == 0) {
            args_warning(a, where, zero[i]);
            *c[i] = 1;
        }
    }
    *out = transform_scale(v);
}

// A column of zeros gets a 1 on the diagonal: scenes flatten things that way.
static void matrix(struct args *a, struct transform *out)
{
    const double zero = 1e-10; // the language's own "is zero"
    double m[12], rows[4][3];
    struct span where = args_span(a);
    if (!args_floats(a, "matrix", m, 12))
        return;
    for (int i = 0; i < 12; i++)
        rows[i / 3][i % 3] = m[i];
    for (int j = 0; j < 3; j++) {
        if (fabs(rows[0][j]) < zero && fabs(rows[1][j]) < zero &&
            fabs(rows[2][j]) < zero) {
            args_warning(a, where, "a column of the matrix is 0, its diagonal becomes 1");
            rows[j][j] = 1;
        }
    }
    if (!transform_matrix((const double(*)[3])rows, out)) {
        args_error(a, where, "the matrix is singular");
        *out = transform_identity;
    }
}

static void named(struct args *a, struct transform *out)
{
    const struct value *v = args_take_value(a, VALUE_TRANSFORM);
    if (v) {
        *out = *(const struct transform *)v->data;
    } else {
        args_expected(a, "transform", "a declared transform or { }");
        args_skip(a);
    }
}

static bool transform_block(struct args *a, struct transform *out);

bool build_trans(struct args *a, struct transform *out)
{
    struct vec3 v;
    enum word w = args_at_word(a);
    if (args_at_block(a) == WORD_transform) {
        struct args inner = args_of(a->b, args_next(a), a);
        transform_block(&inner, out);
        return true;
    }
    if (w != WORD_translate && w != WORD_rotate && w != WORD_scale && w != WORD_matrix &&
        w != WORD_transform)
        return false;
    *out = transform_identity;
    args_next(a);
    struct span where = args_span(a);
    if (w == WORD_transform)
        named(a, out);
    else if (w == WORD_matrix)
        matrix(a, out);
    else if (!args_vec3(a, word_text(w), &v))
        args_skip(a);
    else if (w == WORD_translate)
        *out = transform_translate(v);
    else if (w == WORD_rotate)
        *out = transform_rotate(v);
    else
        scale(a, where, v, out);
    return true;
}

static bool transform_block(struct args *a, struct transform *out)
{
    static const enum word known[] = {WORD_translate, WORD_rotate,    WORD_scale,
                                      WORD_matrix,    WORD_transform, WORD_inverse};
    struct transform t;
    bool inverse = false;
    *out = transform_identity;
    const struct value *v = args_take_value(a, VALUE_TRANSFORM);
    if (v)
        *out = *(const struct transform *)v->data;
    while (a->at) {
        const struct value *id = args_take_value(a, VALUE_TRANSFORM);
        if (id)
            *out = transform_then(out, id->data);
        else if (build_trans(a, &t))
            *out = transform_then(out, &t);
        else if (args_take(a, WORD_inverse))
            inverse = true;
        else
            args_unknown(a, known, ARRAY_COUNT(known));
    }
    if (inverse)
        *out = transform_invert(out);
    return !a->failed;
}
