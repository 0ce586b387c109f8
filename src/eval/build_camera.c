#include "eval/build.h"
#include "math/elementary.h"
#include "math/larger.h"
#include "math/pi.h"
#include "scene/mesh_camera.h"
#include "scene/shapes/mesh.h"

#include <string.h>

// camera { } (spec/language 4.12, spec/lighting 1.2). Items are collected, then
// combined in a fixed order when the block ends.

static const double IS_ZERO = 1e-10; // the language's own threshold

static const struct {
    enum word word;
    enum camera_kind kind;
} kinds[] = {
    {WORD_perspective, CAMERA_PERSPECTIVE},
    {WORD_orthographic, CAMERA_ORTHOGRAPHIC},
    {WORD_fisheye, CAMERA_FISHEYE},
    {WORD_ultra_wide_angle, CAMERA_ULTRA_WIDE_ANGLE},
    {WORD_omnimax, CAMERA_OMNIMAX},
    {WORD_panoramic, CAMERA_PANORAMIC},
    {WORD_spherical, CAMERA_SPHERICAL},
};

#define AT(member) offsetof(struct camera_state, member)
static const struct field camera_fields[] = {
    {WORD_location, FIELD_VEC3, AT(camera.location), 0, 0},
    {WORD_direction, FIELD_VEC3, AT(camera.direction), 0, 0},
    {WORD_sky, FIELD_VEC3, AT(sky), 0, 0},
    {WORD_aperture, FIELD_DOUBLE, AT(camera.aperture), 0, 0},
    {WORD_confidence, FIELD_DOUBLE, AT(camera.confidence), 0, 1},
    {WORD_variance, FIELD_DOUBLE, AT(camera.variance), 0, 1},
};
static const enum word other_words[] = {
    WORD_up,          WORD_right,        WORD_look_at, WORD_angle,
    WORD_focal_point, WORD_blur_samples, WORD_normal,  WORD_bokeh,
    WORD_translate,   WORD_rotate,       WORD_scale,   WORD_transform,
    WORD_perspective, WORD_orthographic, WORD_fisheye, WORD_panoramic,
    WORD_spherical,   WORD_cylinder,     WORD_omnimax, WORD_ultra_wide_angle};

static bool kind_item(struct args *a, struct camera_state *c)
{
    enum word w = args_at_word(a);
    long n;
    for (size_t i = 0; i < ARRAY_COUNT(kinds); i++) {
        if (kinds[i].word == w) {
            args_next(a);
            c->camera.kind = kinds[i].kind;
            return true;
        }
    }
    if (w != WORD_cylinder)
        return false;
    args_next(a);
    if (!args_int(a, "kind of cylinder", &n) || n < 1 || n > 4)
        args_error(a, args_span(a), "the cylinder camera has kinds 1 to 4");
    else
        c->camera.kind = (enum camera_kind)(CAMERA_CYLINDER_1 + (n - 1));
    return true;
}

static void angle(struct args *a, struct camera_state *c)
{
    struct span where = args_span(a);
    enum camera_kind k = c->camera.kind;
    bool flat = k == CAMERA_PERSPECTIVE || k == CAMERA_ORTHOGRAPHIC;
    c->has_angle = true;
    c->has_angle_v = false;
    c->angle = 0;
    if (k == CAMERA_ORTHOGRAPHIC ? !args_optional(a, &c->angle)
                                 : !args_float(a, "angle", &c->angle))
        return;
    if (c->angle < 0 || (flat && c->angle >= 180))
        args_error(a, where, "the angle of view must be from 0 to below 180 degrees");
    if (k == CAMERA_SPHERICAL && args_at_number(a))
        c->has_angle_v = args_float(a, "vertical angle", &c->angle_v);
}

// Samples of a pixel: what a camera keeps of each takes memory.
enum { BLUR_SAMPLES_MOST = 1048576 };

static void blur_samples(struct args *a, struct camera *c)
{
    double first = 0, second = 0;
    struct span where = args_span(a);
    if (!args_float(a, "blur_samples", &first))
        return;
    bool two = args_at_number(a) && args_float(a, "blur_samples", &second);
    const double least = two ? trunc(first) : 0, most = trunc(two ? second : first);
    if (!(most >= 1 && least <= most)) {
        args_error(a, where,
                   "blur_samples: the maximum must be at least 1 and the minimum");
    } else if (most > BLUR_SAMPLES_MOST) {
        args_error(a, where, "blur_samples: at most 1048576 samples are possible");
    } else {
        c->blur_samples_min = (int)larger(least, 0);
        c->blur_samples = (int)most;
    }
}

static void bokeh(struct args *a, struct camera *c)
{
    const struct ast *block = args_next(a);
    struct args in = args_of(a->b, block, a);
    if (args_at_block(&in) == WORD_pigment)
        c->bokeh =
            build_pigment(&in, args_next(&in), a->b->default_texture->layer->pigment);
    if (in.at)
        args_unknown(&in, NULL, 0);
}

// Whether an object is a mesh and nothing else; its faces are in the space of *out.
static bool mesh_of(const struct object *o, struct camera_mesh *out)
{
    if (o->kind != OBJECT_SHAPE ||
        (strcmp(o->ops->keyword, "mesh") != 0 && strcmp(o->ops->keyword, "mesh2") != 0))
        return false;
    *out = (struct camera_mesh){o->shape, o->transform};
    return true;
}

static void meshes(struct args *in, const struct ast *block, struct mesh_camera *m)
{
    struct pointer_list l = {0};
    for (;;) {
        const struct span where = args_span(in);
        bool was = true;
        struct camera_mesh *mesh = arena_new_struct(in->b->arena, struct camera_mesh);
        const struct object *o = args_object(in, &was);
        if (!was)
            break;
        if (o && mesh_of(o, mesh))
            pointer_list_add(in->b->arena, &l, mesh);
        else if (o)
            args_error(in, where, "mesh_camera takes meshes only");
    }
    if (!l.count && !in->failed)
        args_error(in, block->where, "mesh_camera needs a mesh");
    struct camera_mesh *all = arena_new_array(in->b->arena, struct camera_mesh, l.count);
    for (uint32_t i = 0; i < l.count; i++)
        all[i] = *(const struct camera_mesh *)l.at[i];
    m->mesh = all;
    m->mesh_count = l.count;
}

// mesh_camera { rays, distribution, [distance] meshes [smooth] }
static void mesh_camera(struct args *a, struct camera *c)
{
    const struct ast *block = args_next(a);
    struct args in = args_of(a->b, block, a);
    struct mesh_camera *m = arena_new_struct(a->b->arena, struct mesh_camera);
    long rays, way;
    if (!args_int(&in, "rays per pixel", &rays) || !args_int(&in, "distribution", &way))
        return;
    if (args_at_number(&in))
        args_float(&in, "largest distance", &m->max_distance);
    if (rays < 1 || rays > 1000000 || way < 0 || way > MESH_CAMERA_UV)
        args_error(
            &in, block->where,
            "mesh_camera takes 1 to 1000000 rays a pixel and a distribution of 0 to 3");
    meshes(&in, block, m);
    m->smooth = args_take(&in, WORD_smooth);
    if (in.at)
        args_unknown(&in, NULL, 0);
    if (in.failed)
        return;
    if (rays > 1 && way >= MESH_CAMERA_WIDTH)
        args_error(&in, block->where, "distributions 2 and 3 have 1 ray a pixel");
    m->rays = (uint32_t)rays;
    m->way = (enum mesh_camera_way)way;
    if (m->way == MESH_CAMERA_UV && !m->mesh->mesh->face_uv)
        args_error(
            &in, block->where,
            "distribution 3 finds faces by uv_vectors, which the first mesh has not");
    mesh_camera_finish(m, a->b->arena);
    c->kind = CAMERA_MESH;
    c->mesh = m;
}

static bool item(struct args *a, struct camera_state *c)
{
    enum word w = args_at_word(a);
    if (args_at_block(a) == WORD_normal) {
        c->camera.normal = build_normal(a, args_next(a), NULL);
        return true;
    }
    if (args_at_block(a) == WORD_bokeh) {
        bokeh(a, &c->camera);
        return true;
    }
    if (args_at_block(a) == WORD_mesh_camera) {
        mesh_camera(a, &c->camera);
        return true;
    }
    if (w != WORD_up && w != WORD_right && w != WORD_look_at && w != WORD_angle &&
        w != WORD_focal_point && w != WORD_blur_samples)
        return false;
    args_next(a);
    switch (w) {
    case WORD_up:
        c->has_up_right = true;
        args_vec3(a, "up", &c->camera.up);
        break;
    case WORD_right:
        c->has_up_right = true;
        args_vec3(a, "right", &c->camera.right);
        break;
    case WORD_look_at: c->has_look_at = args_vec3(a, "look_at", &c->look_at); break;
    case WORD_focal_point:
        c->has_focal_point = args_vec3(a, "focal_point", &c->focal_point);
        break;
    case WORD_angle: angle(a, c); break;
    default: blur_samples(a, &c->camera); break;
    }
    if (a->failed)
        args_skip(a);
    return true;
}

static void look_at(struct args *a, struct camera_state *s)
{
    struct camera *c = &s->camera;
    double d = vec3_length(c->direction), u = vec3_length(c->up),
           r = vec3_length(c->right);
    bool left_handed = vec3_dot(vec3_cross(c->up, c->direction), c->right) > 0;
    struct vec3 to = vec3_sub(s->look_at, c->location);
    if (vec3_length(to) == 0) {
        args_error(a, a->owner->where, "location and look_at are the same point");
        return;
    }
    struct vec3 direction = vec3_normalize(to), right = vec3_cross(s->sky, direction);
    if (vec3_max_abs(right) < IS_ZERO) {
        args_warning(a, a->owner->where, "the camera looks along sky, right is kept");
        right = c->right;
    }
    right = vec3_normalize(right);
    struct vec3 up = vec3_cross(direction, right);
    c->direction = vec3_scale(d, direction);
    c->up = vec3_scale(u, up);
    c->right = vec3_scale(left_handed ? r : -r, right);
}

static void angles(struct camera_state *s)
{
    struct camera *c = &s->camera;
    bool sphere = c->kind == CAMERA_SPHERICAL;
    c->angle = s->has_angle && s->angle > 0 ? s->angle : sphere ? 360 : 90;
    c->angle_v = s->has_angle_v ? s->angle_v : c->angle / 2;
    if (sphere && !s->has_angle)
        c->angle_v = 180;
}

static void combine(struct args *a, struct camera_state *s)
{
    struct camera *c = &s->camera;
    bool flat = c->kind == CAMERA_PERSPECTIVE || c->kind == CAMERA_ORTHOGRAPHIC;
    double focal = 1;
    if (flat && s->has_angle && s->angle > 0) {
        focal = vec3_length(c->right) / (2 * det_tan(s->angle * PI / 360));
        c->direction = vec3_scale(focal, vec3_normalize(c->direction));
    }
    if (s->has_look_at) {
        focal = vec3_length(c->direction);
        look_at(a, s);
    }
    if (c->kind == CAMERA_ORTHOGRAPHIC && (!s->has_up_right || s->has_angle)) {
        double k =
            vec3_length(vec3_sub(s->look_at, c->location)) / vec3_length(c->direction);
        c->right = vec3_scale(k, c->right);
        c->up = vec3_scale(k, c->up);
    }
    if (s->has_focal_point)
        focal = vec3_length(vec3_sub(s->focal_point, c->location));
    c->focal_distance = focal == 0 ? 1 : focal;
    angles(s);
}

static void move(struct camera *c, const struct transform *t)
{
    c->location = transform_point(t, c->location);
    c->direction = transform_vector(t, c->direction);
    c->up = transform_vector(t, c->up);
    c->right = transform_vector(t, c->right);
}

static void check_perpendicular(struct args *a, const struct camera *c)
{
    struct vec3 d = vec3_normalize(c->direction), u = vec3_normalize(c->up),
                r = vec3_normalize(c->right);
    if (fabs(vec3_dot(r, u)) > IS_ZERO || fabs(vec3_dot(r, d)) > IS_ZERO ||
        fabs(vec3_dot(u, d)) > IS_ZERO)
        args_warning(a, a->owner->where, "right, up and direction are not perpendicular");
}

bool build_camera(struct args *a, const struct ast *block, struct camera_state *c)
{
    struct args in = args_of(a->b, block, a);
    const struct value *id = args_take_value(&in, VALUE_CAMERA);
    struct transform t, all = transform_identity;
    *c = id ? *(const struct camera_state *)id->data : a->b->camera_default;
    while (!id && in.at && kind_item(&in, c))
        continue;
    while (in.at) {
        if (build_trans(&in, &t))
            all = transform_then(&all, &t);
        else if (id || (!fields_read(&in, camera_fields, ARRAY_COUNT(camera_fields), c) &&
                        !item(&in, c)))
            fields_unknown(&in, camera_fields, ARRAY_COUNT(camera_fields), other_words,
                           ARRAY_COUNT(other_words));
    }
    if (in.failed)
        return false;
    if (!id)
        combine(&in, c);
    move(&c->camera, &all);
    check_perpendicular(&in, &c->camera);
    return !in.failed;
}
