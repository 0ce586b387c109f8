#include "scene/shape.h"

#include <stdlib.h>
#include <string.h>

const struct shape_ops *const shape_table[] = {
#define SHAPE(name) &name##_ops,
#include "scene/shapes.def"
#undef SHAPE
};

const size_t shape_count = sizeof shape_table / sizeof shape_table[0];

const struct shape_ops *shape_find(const char *keyword, size_t len)
{
    for (size_t i = 0; i < shape_count; i++) {
        const char *k = shape_table[i]->keyword;
        if (strlen(k) == len && memcmp(k, keyword, len) == 0)
            return shape_table[i];
    }
    return NULL;
}

bool shape_is_bounded(const struct shape_ops *ops, const void *shape)
{
    return ops->is_bounded ? ops->is_bounded(shape) : (ops->flags & SHAPE_BOUNDED) != 0;
}

bool shape_is_solid(const struct shape_ops *ops, const void *shape)
{
    return ops->is_solid ? ops->is_solid(shape) : (ops->flags & SHAPE_SOLID) != 0;
}

struct aabb shape_placed_bounds(const struct shape_ops *ops, const void *shape,
                                const struct transform *t)
{
    const struct aabb b = ops->bounds(shape);
    if (t->identity || aabb_is_empty(b))
        return b;
    return ops->placed_bounds ? ops->placed_bounds(shape, t)
                              : aabb_pad(aabb_transform(b, t));
}

struct aabb shape_surface_bounds(const struct shape_ops *ops, const void *shape)
{
    return ops->surface_bounds ? ops->surface_bounds(shape) : ops->bounds(shape);
}

void shape_print_number(FILE *out, double v)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, v);
        if (strtod(text, NULL) == v)
            break;
    }
    fputs(text, out);
}

void shape_print_vec2(FILE *out, struct vec2 v)
{
    fputc('<', out);
    shape_print_number(out, v.u);
    fputs(", ", out);
    shape_print_number(out, v.v);
    fputc('>', out);
}

void shape_print_vec3(FILE *out, struct vec3 v)
{
    fputc('<', out);
    shape_print_number(out, v.x);
    fputs(", ", out);
    shape_print_number(out, v.y);
    fputs(", ", out);
    shape_print_number(out, v.z);
    fputc('>', out);
}
