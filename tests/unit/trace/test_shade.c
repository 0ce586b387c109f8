#include "test.h"

#include <stdlib.h>

#include "base/arena.h"
#include "math/color.h"
#include "scene/scene.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"
#include "trace/photon_map.h"
#include "trace/render.h"

// Scenes put together by hand, with the linear values that POV-Ray 3.7 renders for the
// same scene text (five digits).
struct setup {
    struct arena *arena;
    struct scene scene;
    struct interior interior;
    struct finish finish;
    struct light light;
    struct pigment pigment;
    const struct object *object[8];
    struct render_settings settings;
};

static void open_scene(struct setup *s)
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

// camera { orthographic location <0,0,-10> direction z right 4*x up 4*y }
static void wall_camera(struct setup *s, double size)
{
    struct camera *c = &s->scene.camera;
    c->kind = CAMERA_ORTHOGRAPHIC;
    c->location = vec3(0, 0, -10);
    c->right = vec3(size, 0, 0);
    c->up = vec3(0, size, 0);
}

// camera { location <0,0,-4> direction 2*z right x up y }
static void glass_camera(struct setup *s)
{
    struct camera *c = &s->scene.camera;
    c->location = vec3(0, 0, -4);
    c->direction = vec3(0, 0, 2);
    c->right = vec3(1, 0, 0);
}

static const struct texture *plain(struct setup *s, struct rgbft color,
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

static struct object *add(struct setup *s, const struct shape_ops *ops, const void *shape,
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

static struct object *add_plane(struct setup *s, struct vec3 normal, struct rgbft color)
{
    struct plane *p = arena_new_struct(s->arena, struct plane);
    p->normal = normal;
    return add(s, &plane_ops, p, plain(s, color, &s->finish));
}

static struct object *add_sphere(struct setup *s, struct vec3 centre, double radius,
                                 struct rgbft color)
{
    struct sphere *p = arena_new_struct(s->arena, struct sphere);
    *p = (struct sphere){centre, radius, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    return add(s, &sphere_ops, p, plain(s, color, &s->finish));
}

static void add_light(struct setup *s)
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

// A sky whose colour tells the direction.
static void add_sky(struct setup *s)
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

static void background(struct setup *s, float r, float g, float b)
{
    s->scene.background = (struct rgbft){r, g, b, 0, 0};
    s->scene.has_background = true;
}

struct row {
    int x, y;
    double r, g, b;
};

static struct image shoot(struct setup *s, int w, int h)
{
    struct image out = {0};
    s->settings.width = s->settings.col_end = w;
    s->settings.height = s->settings.row_end = h;
    struct world *world = world_build(s->arena, &s->scene);
    assert_true(render_world(world, &s->settings, NULL, &out, NULL));
    return out;
}

static void check(struct setup *s, int w, int h, const struct row *row, size_t count)
{
    struct image out = shoot(s, w, h);
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

#define CHECK(s, w, h, ...)                                                              \
    do {                                                                                 \
        static const struct row rows[] = {__VA_ARGS__};                                  \
        check(&(s), w, h, rows, sizeof rows / sizeof rows[0]);                           \
    } while (0)

static const struct rgbft clay = {0.8f, 0.6f, 0.4f, 0, 0};
static const struct rgbft clear = {1, 1, 1, 0, 1};

static void wall(struct setup *s)
{
    open_scene(s);
    wall_camera(s, 4);
    s->finish.diffuse = 0.7f;
}

static void diffuse(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    CHECK(s, 4, 4, {0, 0, 0.4056, 0.27378, 0.1014}, {3, 0, 0.52079, 0.35154, 0.13019},
          {1, 1, 0.41959, 0.28322, 0.10489}, {3, 3, 0.37076, 0.25026, 0.0927});
}

static void phong(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.finish.diffuse = 0.3f;
    s.finish.phong = 0.8f;
    s.finish.phong_size = 20;
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    CHECK(s, 4, 4, {0, 0, 0.1751, 0.11847, 0.04408}, {3, 0, 0.41051, 0.31923, 0.14946});
}

static void specular_and_irid(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.finish.diffuse = 0.6f;
    s.finish.specular = 0.3f;
    s.finish.irid = 0.4f;
    s.finish.irid_thickness = 0.3f;
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    CHECK(s, 4, 4, {0, 0, 0.40421, 0.41424, 0.16367}, {3, 0, 0.77879, 0.63876, 0.24016},
          {3, 3, 0.33069, 0.3563, 0.14301});
}

static void lit_from_behind(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.light.location = vec3(1, 2, 4);
    s.finish.diffuse = 0.6f;
    s.finish.diffuse_back = 0.3f;
    s.finish.specular = 0.9f;
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay)->flags |= OBJECT_NO_SHADOW;
    CHECK(s, 4, 4, {0, 0, 0.20238, 0.13661, 0.0506}, {3, 0, 0.23633, 0.15953, 0.05908});
}

static void transparent_and_lit(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    background(&s, 0.3f, 0.6f, 0.9f);
    s.finish.ambient = rgb_gray(0.1f);
    s.finish.specular = 0.5f;
    s.finish.roughness = 10;
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), (struct rgbft){0.8f, 0.6f, 0.4f, 0.3f, 0.2f});
    CHECK(s, 4, 4, {0, 0, 0.61296, 0.60923, 0.47778}, {3, 0, 0.85078, 0.81032, 0.5823});
}

static void shadow_of_a_filter(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, (struct rgbft){0.9f, 0.5f, 0.2f, 0.8f, 0})
        ->flags |= OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 1, 0.21752, 0.04532, 0.00269}, {2, 1, 0.23461, 0.04888, 0.0029},
          {0, 2, 0.18247, 0.03801, 0.00225}, {1, 2, 0.1977, 0.04118, 0.00244});
}

static void shadow_fades(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    s.interior.fade_power = 2;
    s.interior.fade_distance = 1;
    s.interior.fade_color = rgb(0.7f, 0.2f, 0.1f);
    add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, clear)->flags |= OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 1, 0.33941, 0.13889, 0.04476}, {2, 1, 0.37197, 0.16042, 0.05271},
          {1, 2, 0.30016, 0.11127, 0.03444});
}

static void shadow_caustics(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    s.interior.caustics = 45 * 0.6f;
    add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, clear)->flags |= OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 1, 0.42473, 0.2867, 0.10619}, {1, 2, 0.90046, 0.60781, 0.22512},
          {2, 2, 0.40665, 0.27449, 0.10166});
}

static void area_light(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.light.area = true;
    s.light.axis1 = vec3(1.5, 0, 0);
    s.light.axis2 = vec3(0, 1.5, 0);
    s.light.size1 = s.light.size2 = 5;
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, (struct rgbft){1, 1, 1, 0, 0})->flags |=
        OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 0, 0.4172, 0.2816, 0.10429}, {2, 0, 0.48701, 0.32872, 0.12175},
          {0, 1, 0.24431, 0.1649, 0.06108}, {1, 1, 0, 0, 0});
}

static void area_illumination(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.light.area = s.light.area_illumination = true;
    s.light.axis1 = vec3(1.5, 0, 0);
    s.light.axis2 = vec3(0, 1.5, 0);
    s.light.size1 = s.light.size2 = 3;
    s.light.fade_distance = 4;
    s.light.fade_power = 2;
    s.finish.specular = 0.5f;
    add_light(&s);
    add_plane(&s, vec3(0, 0, 1), clay);
    add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, (struct rgbft){1, 1, 1, 0, 0})->flags |=
        OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {0, 0, 0.36094, 0.26218, 0.11086}, {3, 0, 0.77504, 0.59222, 0.27051},
          {1, 1, 0, 0, 0});
}

static void mirror(struct setup *s)
{
    open_scene(s);
    wall_camera(s, 1);
    background(s, 0.3f, 0.6f, 0.9f);
    s->finish.diffuse = 0;
}

// normal z or -z, rotate x*60
static struct vec3 tilted(double sign) { return vec3(0, -sign * sqrt(0.75), sign * 0.5); }

static void mirror_between_two_colours(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = rgb(0.1f, 0.2f, 0.3f);
    s.finish.reflection_max = rgb(0.9f, 0.8f, 0.7f);
    s.finish.reflection_falloff = 3;
    add_plane(&s, tilted(1), clay);
    CHECK(s, 1, 1, {0, 0, 0.06, 0.165, 0.31501});
}

static void mirror_fresnel(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = rgb_gray(0.1f);
    s.finish.reflection_max = rgb_gray(0.9f);
    s.finish.fresnel = true;
    s.interior.ior = 1.5f;
    add_plane(&s, tilted(-1), clay);
    CHECK(s, 1, 1, {0, 0, 0.05141, 0.10282, 0.15421});
}

static void mirror_exponent(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = s.finish.reflection_max = rgb_gray(0.8f);
    s.finish.reflection_exponent = 2;
    add_plane(&s, tilted(1), clay);
    CHECK(s, 1, 1, {0, 0, 0.07201, 0.288, 0.64801});
}

static void mirror_conserves_energy(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = s.finish.reflection_max = rgb(0.2f, 0.4f, 0.6f);
    s.finish.conserve_energy = true;
    add_plane(&s, tilted(1), (struct rgbft){0.8f, 0.6f, 0.4f, 0.5f, 0.3f});
    CHECK(s, 1, 1, {0, 0, 0.228, 0.456, 0.72});
}

static void facing_mirrors(struct setup *s)
{
    open_scene(s);
    wall_camera(s, 1);
    s->scene.camera.location = vec3(0, 0, -1);
    s->finish.diffuse = 0;
    s->finish.emission = rgb_gray(0.1f);
    s->finish.reflection_min = s->finish.reflection_max = rgb_gray(0.8f);
    add_plane(s, vec3(0, 0, 1), (struct rgbft){1, 1, 1, 0, 0});
    struct plane *p = arena_new_struct(s->arena, struct plane);
    *p = (struct plane){vec3(0, 0, 1), vec3(0, 0, -2)};
    add(s, &plane_ops, p, plain(s, (struct rgbft){1, 1, 1, 0, 0}, &s->finish));
}

static void trace_level_counts_surfaces(void **state)
{
    (void)state;
    struct setup s;
    facing_mirrors(&s);
    s.scene.settings.max_trace_level = 4;
    CHECK(s, 1, 1, {0, 0, 0.2952, 0.2952, 0.2952});
}

static void light_rays_end(void **state)
{
    (void)state;
    struct setup s;
    facing_mirrors(&s);
    s.scene.settings.max_trace_level = 50;
    s.scene.settings.adc_bailout = 0.3f;
    CHECK(s, 1, 1, {0, 0, 0.36893, 0.36893, 0.36893});
}

static void glass(struct setup *s)
{
    open_scene(s);
    glass_camera(s);
    add_sky(s);
    s->finish.diffuse = 0;
}

static void refraction(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.5f;
    add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {1, 1, 0.58981, 0.41019, 0.93645}, {2, 1, 0.50001, 0.41776, 0.94705},
          {2, 2, 0.50001, 0.50001, 0.95454}, {2, 3, 0.50001, 0.58224, 0.94705});
}

static void total_reflection(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    const double a = -42 * 3.14159265358979323846 / 180;
    s.scene.camera.direction = vec3(0, -sin(a), cos(a));
    s.scene.camera.up = vec3(0, 0.6 * cos(a), 0.6 * sin(a));
    s.scene.camera.right = vec3(0.001, 0, 0);
    s.scene.camera.location = vec3(0, 4 * sin(a), -4 * cos(a));
    s.interior.ior = 1.5f;
    s.finish.reflection_min = s.finish.reflection_max = rgb_gray(0.3f);
    add_plane(&s, vec3(0, 0, 1), (struct rgbft){0.9f, 0.6f, 0.3f, 0.5f, 0.1f});
    CHECK(s, 1, 5, {0, 0, 0.50001, 0.87459, 0.24251}, {0, 1, 0.50001, 0.84224, 0.20086},
          {0, 3, 0.42499, 0.58557, 0.22078}, {0, 4, 0.42499, 0.54524, 0.23452});
}

static void glass_with_fresnel(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.5f;
    s.finish.reflection_max = rgb_gray(1);
    s.finish.fresnel = true;
    add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {1, 1, 0.62698, 0.45843, 0.95225}, {2, 1, 0.54052, 0.46401, 0.95644},
          {2, 2, 0.54, 0.54, 0.95817});
}

static void nested_glass(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.2f;
    add_sphere(&s, vec3(0, 0, 0), 1, clear);
    s.interior.ior = 1.5f;
    add_sphere(&s, vec3(0.1, 0, 0), 0.5, clear);
    CHECK(s, 7, 7, {2, 2, 0.68962, 0.36208, 0.8894}, {3, 3, 0.53697, 0.50001, 0.95305},
          {4, 4, 0.42963, 0.61126, 0.93507});
}

static void fading_glass(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.fade_distance = 0.5;
    s.interior.fade_power = 1;
    s.interior.fade_color = rgb(0.8f, 0.3f, 0.1f);
    add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {2, 1, 0.42141, 0.2453, 0.27877}, {2, 2, 0.42001, 0.22001, 0.26728});
}

static void dispersion(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.5f;
    s.interior.dispersion = 1.2f;
    add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {2, 1, 0.49689, 0.42153, 0.94137}, {2, 2, 0.49689, 0.50001, 0.95091},
          {2, 3, 0.49689, 0.57847, 0.94137});
}

static void foggy(struct setup *s, struct fog *fog)
{
    open_scene(s);
    s->scene.camera.location = vec3(0, 1, -10);
    s->scene.camera.direction = vec3(0, 0, 1.5);
    s->scene.camera.right = vec3(1, 0, 0);
    s->finish.diffuse = 0;
    s->finish.emission = rgb_gray(1);
    static const struct fog *list[1];
    list[0] = fog;
    s->scene.fog = list;
    s->scene.fog_count = 1;
    add_plane(s, vec3(0, 0, -1), clay);
}

static void fog_of_constant_density(void **state)
{
    (void)state;
    struct setup s;
    struct fog fog = {
        .type = FOG_CONSTANT, .distance = 12, .color = {0.3f, 0.4f, 0.9f, 0, 0}};
    foggy(&s, &fog);
    CHECK(s, 4, 4, {0, 0, 0.50658, 0.48263, 0.69342}, {1, 1, 0.51604, 0.48643, 0.68395});
}

static void ground_fog(void **state)
{
    (void)state;
    struct setup s;
    struct fog fog = {.type = FOG_GROUND,
                      .distance = 4,
                      .alt = 0.7,
                      .offset = -0.5,
                      .up = {0, 1, 0},
                      .color = {0.3f, 0.4f, 0.9f, 0, 0}};
    foggy(&s, &fog);
    CHECK(s, 4, 4, {0, 0, 0.71119, 0.56448, 0.48881}, {0, 3, 0.37458, 0.42983, 0.82542});
}

static void alpha_of_transparency(void **state)
{
    (void)state;
    struct setup s;
    open_scene(&s);
    wall_camera(&s, 4);
    s.finish.diffuse = 0;
    s.finish.emission = rgb_gray(1);
    s.settings.output_alpha = true;
    add_plane(&s, vec3(0, 0, -1), (struct rgbft){0.5f, 0.25f, 0.8f, 0.4f, 0});
    struct image out = shoot(&s, 1, 1);
    assert_near(image_at(&out, 0, 0)[0], 0.30001, 3e-4);
    assert_near(image_at(&out, 0, 0)[3], 0.84522, 3e-4);
    image_free(&out);
    arena_free(s.arena);
}

// The same bits whatever the number of threads and the size of tiles.
static void one_picture(void **state)
{
    (void)state;
    struct image first = {0};
    for (int turn = 0; turn < 4; turn++) {
        static const int tile[] = {32, 16, 64, 32};
        struct setup s;
        glass(&s);
        s.interior.ior = 1.5f;
        s.finish.reflection_max = rgb_gray(1);
        s.finish.fresnel = true;
        s.finish.diffuse = 0.5f;
        s.light.area = s.light.jitter = true;
        s.light.axis1 = vec3(1, 0, 0);
        s.light.axis2 = vec3(0, 1, 0);
        s.light.size1 = s.light.size2 = 3;
        add_light(&s);
        add_sphere(&s, vec3(0, 0, 0), 1, (struct rgbft){0.9f, 0.8f, 0.7f, 0, 0.7f});
        add_sphere(&s, vec3(0.4, 0.3, -1), 0.4, (struct rgbft){0.7f, 0.8f, 1, 0.8f, 0});
        s.settings.threads = turn ? 3 : 1;
        s.settings.tile_size = tile[turn];
        struct image out = shoot(&s, 80, 60);
        if (turn) {
            assert_memory_equal(out.pixel, first.pixel, 80 * 60 * 4 * sizeof(float));
            image_free(&out);
        } else {
            first = out;
        }
        arena_free(s.arena);
    }
    image_free(&first);
}

// A map that holds the most says that there was more, and takes nothing.
static void a_full_map_of_photons_says_so(void **state)
{
    (void)state;
    const struct photon x = {.p = {1, 2, 3}};
    struct photon_map some = {0},
                      full = {.count = PHOTONS_MOST, .capacity = PHOTONS_MOST};
    for (int i = 0; i < 100; i++)
        photon_add(&some, &x);
    assert_int_equal(some.count, 100);
    assert_false(some.full);
    struct photon_map more = {0};
    photon_map_append(&more, &some);
    photon_map_append(&more, &some);
    assert_int_equal(more.count, 200);
    assert_true(more.photon[199].p[2] == 3);
    photon_map_end(&more);
    photon_add(&full, &x);
    assert_true(full.full);
    full.full = false;
    photon_map_append(&full, &some);
    assert_true(full.full);
    assert_int_equal(full.count, PHOTONS_MOST);
    const struct photon_map cut = {.full = true};
    photon_map_append(&some,
                      &cut); // what another map has left out is missing here as well
    assert_true(some.full);
    photon_map_end(&some);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diffuse),
        cmocka_unit_test(phong),
        cmocka_unit_test(specular_and_irid),
        cmocka_unit_test(lit_from_behind),
        cmocka_unit_test(transparent_and_lit),
        cmocka_unit_test(shadow_of_a_filter),
        cmocka_unit_test(shadow_fades),
        cmocka_unit_test(shadow_caustics),
        cmocka_unit_test(area_light),
        cmocka_unit_test(area_illumination),
        cmocka_unit_test(mirror_between_two_colours),
        cmocka_unit_test(mirror_fresnel),
        cmocka_unit_test(mirror_exponent),
        cmocka_unit_test(mirror_conserves_energy),
        cmocka_unit_test(trace_level_counts_surfaces),
        cmocka_unit_test(light_rays_end),
        cmocka_unit_test(refraction),
        cmocka_unit_test(total_reflection),
        cmocka_unit_test(glass_with_fresnel),
        cmocka_unit_test(nested_glass),
        cmocka_unit_test(fading_glass),
        cmocka_unit_test(dispersion),
        cmocka_unit_test(fog_of_constant_density),
        cmocka_unit_test(ground_fog),
        cmocka_unit_test(alpha_of_transparency),
        cmocka_unit_test(one_picture),
        cmocka_unit_test(a_full_map_of_photons_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
