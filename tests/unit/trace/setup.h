#ifndef TESTS_TRACE_SETUP_H
#define TESTS_TRACE_SETUP_H

#include "image/image.h"
#include "scene/scene.h"
#include "trace/render.h"

// Scenes put together by hand, with the linear values that POV-Ray 3.7 renders for the
// same scene text (five digits).
struct setup {
    struct arena *arena;
    struct scene scene;
    struct interior interior;
    struct finish finish;
    struct light light;
    const struct object *object[8];
    struct render_settings settings;
};

void setup_open(struct setup *s);
// camera { orthographic location <0,0,-10> direction z right size*x up size*y }
void setup_wall_camera(struct setup *s, double size);
// camera { location <0,0,-4> direction 2*z right x up y }
void setup_glass_camera(struct setup *s);
const struct texture *setup_texture(struct setup *s, struct rgbft color,
                                    const struct finish *f);
struct object *setup_add(struct setup *s, const struct shape_ops *ops, const void *shape,
                         const struct texture *texture);
struct object *setup_add_plane(struct setup *s, struct vec3 normal, struct rgbft color);
struct object *setup_add_sphere(struct setup *s, struct vec3 centre, double radius,
                                struct rgbft color);
void setup_add_light(struct setup *s); // s->light
// A sky whose colour tells the direction.
void setup_add_sky(struct setup *s);
void setup_background(struct setup *s, float r, float g, float b);
struct image setup_shoot(struct setup *s, int w, int h);

struct row {
    int x, y;
    double r, g, b;
};

// Renders, compares some pixels and frees the scene.
void setup_check(struct setup *s, int w, int h, const struct row *row, size_t count);
#define CHECK(s, w, h, ...)                                                              \
    do {                                                                                 \
        static const struct row rows[] = {__VA_ARGS__};                                  \
        setup_check(&(s), w, h, rows, sizeof rows / sizeof rows[0]);                     \
    } while (0)

#endif
