#include "test.h"

#include "setup.h"

#include "base/arena.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"

void setup_open(struct setup *s)
{
    memset(s, 0, sizeof *s);
    s->arena = arena_new(4096);
    s->finish = finish_default;
    s->finish.ambient = rgb(0, 0, 0);
    s->interior.old_refraction = 1;
    s->light = light_default;
    s->light.location = vec3(2, 3, -4);
    s->light.color = rgb(1, 0.9f, 0.5f);
    s->settings = render_settings_default;
    s->scene.settings = (struct settings){.version = 370,
                                          .max_trace_level = 5,
                                          .adc_bailout = 1 / 255.0f,
                                          .ambient_light = {1, 1, 1},
                                          .irid_wavelength = {0.70f, 0.52f, 0.48f}};
    s->scene.camera = camera_default;
    s->scene.has_camera = true;
    s->scene.object = s->object;
}

void setup_wall_camera(struct setup *s, double size)
{
    struct camera *c = &s->scene.camera;
    c->kind = CAMERA_ORTHOGRAPHIC;
    c->location = vec3(0, 0, -10);
    c->right = vec3(size, 0, 0);
    c->up = vec3(0, size, 0);
}

void setup_glass_camera(struct setup *s)
{
    struct camera *c = &s->scene.camera;
    c->location = vec3(0, 0, -4);
    c->direction = vec3(0, 0, 2);
    c->right = vec3(1, 0, 0);
}

const struct texture *setup_texture(struct setup *s, struct rgbft color,
                                    const struct finish *f)
{
    struct pigment *p = arena_new_struct(s->arena, struct pigment);
    struct texture_layer *l = arena_new_struct(s->arena, struct texture_layer);
    struct texture *x = arena_new_struct(s->arena, struct texture);
    struct finish *own = arena_new_struct(s->arena, struct finish);
    *own = *f;
    *p = (struct pigment){.kind = PIGMENT_SOLID, .color = color};
    *l = (struct texture_layer){.pigment = p, .finish = own};
    *x = (struct texture){.kind = TEXTURE_PLAIN, .layer = l, .layer_count = 1};
    return x;
}

struct object *setup_add(struct setup *s, const struct shape_ops *ops, const void *shape,
                         const struct texture *texture)
{
    struct object *o = object_new_shape(s->arena, ops, shape, (struct span){0, 0, 0, 0});
    o->texture = (struct attached_texture){texture, &transform_identity};
    struct interior *i = arena_new_struct(s->arena, struct interior);
    *i = s->interior;
    o->interior = i;
    s->object[s->scene.object_count++] = o;
    return o;
}

struct object *setup_add_plane(struct setup *s, struct vec3 normal, struct rgbft color)
{
    struct plane *p = arena_new_struct(s->arena, struct plane);
    p->normal = normal;
    return setup_add(s, &plane_ops, p, setup_texture(s, color, &s->finish));
}

struct object *setup_add_sphere(struct setup *s, struct vec3 centre, double radius,
                                struct rgbft color)
{
    struct sphere *p = arena_new_struct(s->arena, struct sphere);
    *p = (struct sphere){centre, radius, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    return setup_add(s, &sphere_ops, p, setup_texture(s, color, &s->finish));
}

void setup_add_light(struct setup *s)
{
    struct object *o = arena_new_struct(s->arena, struct object);
    s->light.axis = vec3_normalize(vec3_sub(s->light.point_at, s->light.location));
    struct light *l = arena_new_struct(s->arena, struct light);
    *l = s->light;
    *o = (struct object){
        .kind = OBJECT_LIGHT, .light = l, .transform = &transform_identity};
    s->object[s->scene.object_count++] = o;
}

static double function_x(const void *d, struct vec3 p)
{
    (void)d;
    return (p.x / 1.1 + 1) / 2;
}
static double function_y(const void *d, struct vec3 p)
{
    (void)d;
    return (p.y / 1.1 + 1) / 2;
}
static double function_z(const void *d, struct vec3 p)
{
    (void)d;
    return (p.z / 1.1 + 1) / 2;
}

void setup_add_sky(struct setup *s)
{
    static double (*const function[3])(const void *, struct vec3) = {
        function_x, function_y, function_z};
    static const float key[] = {0, 1};
    static const float weight[] = {1, 1, 1};
    static const struct rgbft color[3][2] = {{{0, 0, 0, 0, 0}, {3, 0, 0, 0, 0}},
                                             {{0, 0, 0, 0, 0}, {0, 3, 0, 0, 0}},
                                             {{0, 0, 0, 0, 0}, {0, 0, 3, 0, 0}}};
    const struct pigment **entry = arena_new_array(s->arena, const struct pigment *, 4);
    for (int k = 0; k < 3; k++) {
        struct color_map *m = arena_new_struct(s->arena, struct color_map);
        *m = (struct color_map){2, key, color[k]};
        struct pigment *p = arena_new_struct(s->arena, struct pigment);
        *p = (struct pigment){.kind = PIGMENT_COLORS, .colors = m};
        struct pattern *pattern = arena_new_struct(s->arena, struct pattern);
        *pattern = (struct pattern){.ops = &function_pattern_ops,
                                    .frequency = 1,
                                    .function = function[k],
                                    .noise_generator = 2};
        p->pattern = pattern;
        entry[k] = p;
    }
    struct pigment_map *map = arena_new_struct(s->arena, struct pigment_map);
    *map = (struct pigment_map){3, weight, entry};
    struct pigment *mean = arena_new_struct(s->arena, struct pigment);
    *mean =
        (struct pigment){.kind = PIGMENT_AVERAGE, .map = map, .pattern = &pattern_none};
    entry[3] = mean;
    struct sky_sphere *sky = arena_new_struct(s->arena, struct sky_sphere);
    *sky = (struct sky_sphere){entry + 3, 1, {1, 1, 1}};
    s->scene.sky = sky;
}

void setup_background(struct setup *s, float r, float g, float b)
{
    s->scene.background = (struct rgbft){r, g, b, 0, 0};
    s->scene.has_background = true;
}

struct image setup_shoot(struct setup *s, int w, int h)
{
    struct image out = {0};
    s->settings.width = s->settings.col_end = w;
    s->settings.height = s->settings.row_end = h;
    struct world *world = world_build(s->arena, &s->scene);
    assert_true(render_world(world, &s->settings, NULL, &out, NULL));
    return out;
}

void setup_check(struct setup *s, int w, int h, const struct row *row, size_t count)
{
    struct image out = setup_shoot(s, w, h);
    for (size_t i = 0; i < count; i++) {
        const float *p = image_at(&out, row[i].x, row[i].y);
        const double want[3] = {row[i].r, row[i].g, row[i].b};
        for (int k = 0; k < 3; k++)
            if (!(fabs((double)p[k] - want[k]) <= 2e-4 + 6e-4 * want[k]))
                fail_msg("pixel %d,%d: got %g %g %g, want %g %g %g", row[i].x, row[i].y,
                         (double)p[0], (double)p[1], (double)p[2], want[0], want[1],
                         want[2]);
    }
    image_free(&out);
    arena_free(s->arena);
}
