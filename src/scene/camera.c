#include "scene/camera.h"

#include <float.h>

#include "math/elementary.h"
#include "scene/mesh_camera.h"
#include "scene/texture.h"

static const double pi = 3.14159265358979323846;

const struct camera camera_default = {
    .kind = CAMERA_PERSPECTIVE,
    .direction = {0, 0, 1},
    .right = {1.33, 0, 0},
    .up = {0, 1, 0},
    .angle = 90,
    .angle_v = 180,
    .focal_distance = 1,
    .confidence = 0.9,
    .variance = 1e-4,
};

// What the formulas of spec/lighting.md 1.3 work on, and what they leave for the
// camera normal: the type's last intermediate coordinates.
struct view {
    const struct camera *c;
    double u, v;                      // -0.5..0.5, right and up
    struct vec3 right, up, direction; // unit
    double len_right, len_up;
    struct vec3 origin, d;
    double x0, y0;
};

static double radians(double degrees) { return degrees * (pi / 180); }

// The direction at angle theta from the axis and phi around it.
static struct vec3 polar(const struct view *w, double phi, double theta)
{
    const double s = det_sin(theta);
    return vec3_add(
        vec3_mad(vec3_scale(det_cos(phi) * s, w->right), det_sin(phi) * s, w->up),
        vec3_scale(det_cos(theta), w->direction));
}

static double polar_phi(double a, double b, double rho)
{
    if (rho == 0)
        return 0;
    const double phi = det_asin(fmax(-1, fmin(1, b / rho)));
    return a < 0 ? pi - phi : phi;
}

static bool fisheye(struct view *w)
{
    const double a = 2 * w->u * w->len_right, b = 2 * w->v * w->len_up;
    const double rho = sqrt(a * a + b * b);
    if (rho > 1)
        return false;
    w->x0 = polar_phi(a, b, rho);
    w->y0 = rho * radians(w->c->angle) / 2;
    w->d = polar(w, w->x0, w->y0);
    return true;
}

// The distortion of an Omnimax projector's lens, cut off 135 degrees below.
static bool omnimax(struct view *w)
{
    static const double dome_aspect = 1.283458;
    const double aspect = w->len_right / w->len_up;
    double a = 2 * w->u, b = 2 * w->v;
    if (aspect > dome_aspect) {
        a *= aspect / dome_aspect;
        b = (b - 1) / dome_aspect + 1;
    } else if (aspect > 1) {
        b = (b - 1) / aspect + 1;
    } else {
        b /= aspect;
    }
    const double rho = sqrt(a * a + b * b);
    if (rho > 1)
        return false;
    const double rho2 = rho * rho;
    w->x0 = polar_phi(a, b, rho);
    w->y0 = rho * (1.411269 - 0.09439 * rho2 + 0.25674 * rho2 * rho2);
    const double tan135 = -1;
    if (det_sin(w->x0) * det_sin(w->y0) < tan135 * det_cos(w->y0))
        return false;
    w->d = polar(w, w->x0, w->y0);
    return true;
}

static void ultra_wide(struct view *w)
{
    const double angle = radians(w->c->angle);
    w->x0 = w->u * angle;
    w->y0 = w->v * angle * w->len_up / w->len_right;
    w->d = vec3_add(vec3_mad(vec3_scale(det_sin(w->x0), w->right), det_sin(w->y0), w->up),
                    vec3_scale(det_cos(w->x0) * det_cos(w->y0), w->direction));
}

static void panoramic(struct view *w)
{
    static const double steepest = 2e10;
    w->x0 = pi * (0.5 - w->u);
    w->y0 = pi * w->v;
    const double t = fmax(-steepest, fmin(steepest, det_tan(w->y0)));
    w->d = vec3_add(vec3_mad(vec3_scale(det_cos(w->x0), w->c->right), t, w->c->up),
                    vec3_scale(det_sin(w->x0), w->c->direction));
}

// Types 1 and 3 bend across, 2 and 4 upwards; 3 and 4 are parallel along the axis.
static void cylinder(struct view *w)
{
    const double angle = radians(w->c->angle);
    const bool across =
        w->c->kind == CAMERA_CYLINDER_1 || w->c->kind == CAMERA_CYLINDER_3;
    w->x0 = across ? w->u * angle : w->u * w->len_right;
    w->y0 = across ? w->v * w->len_up : w->v * angle;
    const double bend = across ? w->x0 : w->y0, along = across ? w->y0 : w->x0;
    const struct vec3 around = across ? w->right : w->up,
                      axis = across ? w->up : w->right;
    w->d = vec3_mad(vec3_scale(det_sin(bend), around), det_cos(bend), w->direction);
    if (w->c->kind == CAMERA_CYLINDER_3 || w->c->kind == CAMERA_CYLINDER_4)
        w->origin = vec3_mad(w->origin, along, axis);
    else
        w->d = vec3_mad(w->d, along, axis);
}

// Rodrigues' formula; the axis is a unit vector.
static struct vec3 rotate(struct vec3 p, struct vec3 axis, double angle)
{
    const double c = det_cos(angle);
    return vec3_add(vec3_mad(vec3_scale(c, p), det_sin(angle), vec3_cross(axis, p)),
                    vec3_scale(vec3_dot(axis, p) * (1 - c), axis));
}

static void spherical(struct view *w)
{
    w->x0 = w->u * radians(w->c->angle);
    w->y0 = w->v * radians(w->c->angle_v);
    w->d = rotate(rotate(w->c->direction, w->right, -w->y0), w->up, w->x0);
}

static bool view_ray(struct view *w)
{
    w->x0 = w->u;
    w->y0 = w->v;
    switch (w->c->kind) {
    case CAMERA_PERSPECTIVE:
        w->d = vec3_mad(vec3_mad(w->c->direction, w->u, w->c->right), w->v, w->c->up);
        return true;
    case CAMERA_ORTHOGRAPHIC:
        w->origin = vec3_mad(vec3_mad(w->origin, w->u, w->c->right), w->v, w->c->up);
        w->d = w->c->direction;
        return true;
    default: break;
    }
    w->len_right = vec3_length(w->c->right);
    w->len_up = vec3_length(w->c->up);
    w->right = vec3_normalize(w->c->right);
    w->up = vec3_normalize(w->c->up);
    w->direction = vec3_normalize(w->c->direction);
    switch (w->c->kind) {
    case CAMERA_FISHEYE: return fisheye(w);
    case CAMERA_OMNIMAX: return omnimax(w);
    case CAMERA_ULTRA_WIDE_ANGLE: ultra_wide(w); break;
    case CAMERA_PANORAMIC: panoramic(w); break;
    case CAMERA_SPHERICAL: spherical(w); break;
    default: cylinder(w); break;
    }
    return true;
}

static bool view_at(struct view *w, const struct camera *c, double x, double y, int width,
                    int height)
{
    *w = (struct view){
        .c = c, .u = x / width - 0.5, .v = 0.5 - y / height, .origin = c->location};
    return view_ray(w);
}

static struct vec3 bent(const struct view *w, struct vec3 d)
{
    if (!w->c->normal)
        return d;
    const struct texture_point at = {
        .p = {w->x0, w->y0, 0}, .uv = {w->x0, w->y0}, .normal = d, .ray_d = d};
    return vec3_normalize(normal_perturb(w->c->normal, &at));
}

bool camera_ray(const struct camera *c, double x, double y, int w, int h, struct ray *out)
{
    struct view view;
    if (c->kind == CAMERA_MESH)
        return camera_mesh_ray(c, x, y, w, h, 0, out);
    if (!view_at(&view, c, x, y, w, h))
        return false;
    *out = (struct ray){view.origin, bent(&view, vec3_normalize(view.d)), 0, INFINITY};
    return true;
}

bool camera_mesh_ray(const struct camera *c, double x, double y, int w, int h, uint32_t k,
                     struct ray *out)
{
    const struct view at = {.c = c}; // one bend for all: at the origin
    struct vec3 o, d;
    if (!mesh_camera_ray(c, x, y, w, h, k, &o, &d))
        return false;
    *out = (struct ray){o, bent(&at, d), 0, INFINITY};
    return true;
}

struct camera_lens camera_lens_of(const struct camera *c)
{
    const struct vec3 across = vec3_normalize(vec3_cross(c->up, c->direction));
    return (struct camera_lens){across, vec3_normalize(vec3_cross(c->direction, across)),
                                c->focal_distance / vec3_length(c->direction)};
}

// Spec/lighting.md 1.4. The types with an origin per pixel lose it here, as in
// POV-Ray: every ray starts on the one lens.
bool camera_lens_ray(const struct camera *c, const struct camera_lens *l, double x,
                     double y, int w, int h, struct vec2 lens, struct ray *out)
{
    struct view view;
    if (!view_at(&view, c, x, y, w, h))
        return false;
    const struct vec3 shift =
        vec3_sub(vec3_scale(lens.u, l->across), vec3_scale(lens.v, l->upright));
    const struct vec3 d = vec3_sub(vec3_scale(l->reach, view.d), shift);
    *out = (struct ray){vec3_add(c->location, shift), bent(&view, vec3_normalize(d)), 0,
                        INFINITY};
    return true;
}

bool camera_has_one_eye(const struct camera *c)
{
    return c->kind != CAMERA_ORTHOGRAPHIC && c->kind != CAMERA_CYLINDER_3 &&
           c->kind != CAMERA_CYLINDER_4 && c->kind != CAMERA_MESH && !camera_has_lens(c);
}

bool camera_has_lens(const struct camera *c)
{
    return c->aperture != 0 && c->blur_samples > 0 && c->kind != CAMERA_MESH;
}
