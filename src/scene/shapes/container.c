// What isosurface and parametric share: contained_by and their hints.
#include "scene/shapes/container.h"

#include "scene/args.h"

struct container container_default(void)
{
    return (struct container){.ops = &box_ops,
                              .shape.box = {vec3(-1, -1, -1), vec3(1, 1, 1)}};
}

bool container_read(struct args *a, struct container *c)
{
    struct args *in = args_block(a, "contained_by"), *shape;
    if (!in)
        return false;
    struct container read = {.ops = &box_ops};
    if (!(shape = args_block(in, "box"))) {
        read.ops = &sphere_ops;
        shape = args_block(in, "sphere");
    }
    if (!shape) {
        args_reject(in, "it takes a box or a sphere");
        return true;
    }
    if (!read.ops->build(&read.shape, shape))
        return true;
    const struct aabb b = container_bounds(&read);
    if (!args_end(shape) || !args_end(in))
        args_reject(in, "it takes a plain box or sphere, nothing else");
    else if (!(b.min.x < b.max.x && b.min.y < b.max.y && b.min.z < b.max.z))
        args_reject(in, "the container has no volume");
    else
        *c = read;
    return true;
}

struct aabb container_bounds(const struct container *c)
{
    return c->ops->bounds(&c->shape);
}

void container_print(const struct container *c, FILE *out)
{
    fputs(" contained_by { ", out);
    c->ops->print(&c->shape, out);
    fputs(" } }", out);
}

bool container_hint(struct args *a, const char *word, double preset, double *out)
{
    double v;
    if (!args_word(a, word))
        return false;
    if (!args_float(a, word, &v))
        return true;
    *out = v;
    if (v > 0)
        return true;
    char text[80];
    snprintf(text, sizeof text, "%s must be positive: %g is used", word, preset);
    args_warn(a, text);
    *out = preset;
    return true;
}
