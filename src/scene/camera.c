#include "scene/camera.h"

#include "math/elementary.h"
#include "math/pi.h"
#include "scene/camera_frame.h"
#include "scene/mesh_camera.h"
#include "scene/texture.h"

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
    const struct camera_frame *frame;
    double u, v; // -0.5..0.5, right and up
    struct vec3 origin, d;
    double x0, y0;
};

// The direction at angle y0 from the axis, and at an angle around it.
static struct vec3 polar(const struct view *w, double cos_phi, double sin_phi)
{
    const struct camera_frame *f = w->frame;
    const double s = det_sin(w->y0);
    return vec3_add(vec3_mad(vec3_scale(cos_phi * s, f->right), sin_phi * s, f->up),
                    vec3_scale(det_cos(w->y0), f->direction));
}

// The distance of (a, b) from the middle and its direction there; above 1 there is no picture.
static double disc(struct view *w, double a, double b, double *cos_phi, double *sin_phi)
{
    const double rho = sqrt(a * a + b * b);
    *cos_phi = rho > 0 ? a / rho : 1;
    *sin_phi = rho > 0 ? b / rho : 0;
    if (w->frame->camera->normal)
        w->x0 = camera_phi(*cos_phi, *sin_phi);
    return rho;
}

static bool fisheye(struct view *w)
{
    const struct camera_frame *f = w->frame;
    double cos_phi, sin_phi;
    const double rho =
        disc(w, 2 * w->u * f->len_right, 2 * w->v * f->len_up, &cos_phi, &sin_phi);
    w->y0 = rho * f->angle / 2;
    w->d = polar(w, cos_phi, sin_phi);
    return rho <= 1;
}

// Cut off 135 degrees below.
static bool omnimax(struct view *w)
{
    const struct omnimax_scale s = omnimax_scale(w->frame);
    double cos_phi, sin_phi;
    const double rho = disc(w, 2 * w->u * s.across,
                            (2 * w->v - s.top) / s.upright + s.top, &cos_phi, &sin_phi);
    const double rho2 = rho * rho, tan135 = -1;
    w->y0 = rho * (OMNIMAX_0 - OMNIMAX_2 * rho2 + OMNIMAX_4 * rho2 * rho2);
    w->d = polar(w, cos_phi, sin_phi);
    return rho <= 1 && !(sin_phi * det_sin(w->y0) < tan135 * det_cos(w->y0));
}

static void ultra_wide(struct view *w)
{
    const struct camera_frame *f = w->frame;
    w->x0 = w->u * f->angle;
    w->y0 = w->v * f->angle * f->len_up / f->len_right;
    w->d = vec3_add(vec3_mad(vec3_scale(det_sin(w->x0), f->right), det_sin(w->y0), f->up),
                    vec3_scale(det_cos(w->x0) * det_cos(w->y0), f->direction));
}

static void panoramic(struct view *w)
{
    const struct camera *c = w->frame->camera;
    w->x0 = PI * (0.5 - w->u);
    w->y0 = PI * w->v;
    const double t = fmax(-PANORAMIC_STEEPEST,
                          fmin(PANORAMIC_STEEPEST, det_sin(w->y0) / det_cos(w->y0)));
    w->d = vec3_add(vec3_mad(vec3_scale(det_cos(w->x0), c->right), t, c->up),
                    vec3_scale(det_sin(w->x0), c->direction));
}

// Types 1 and 3 bend across, 2 and 4 upwards; 3 and 4 are parallel along the axis.
static void cylinder(struct view *w)
{
    const struct camera_frame *f = w->frame;
    const enum camera_kind kind = f->camera->kind;
    const bool across = kind == CAMERA_CYLINDER_1 || kind == CAMERA_CYLINDER_3;
    w->x0 = w->u * (across ? f->angle : f->len_right);
    w->y0 = w->v * (across ? f->len_up : f->angle);
    const double bend = across ? w->x0 : w->y0, along = across ? w->y0 : w->x0;
    const struct vec3 around = across ? f->right : f->up,
                      axis = across ? f->up : f->right;
    w->d = vec3_mad(vec3_scale(det_sin(bend), around), det_cos(bend), f->direction);
    if (kind == CAMERA_CYLINDER_3 || kind == CAMERA_CYLINDER_4)
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
    const struct camera_frame *f = w->frame;
    w->x0 = w->u * f->angle;
    w->y0 = w->v * f->angle_v;
    w->d = rotate(rotate(f->camera->direction, f->right, -w->y0), f->up, w->x0);
}

static bool view_ray(struct view *w)
{
    const struct camera *c = w->frame->camera;
    switch (c->kind) {
    case CAMERA_PERSPECTIVE:
        w->d = vec3_mad(vec3_mad(c->direction, w->u, c->right), w->v, c->up);
        break;
    case CAMERA_ORTHOGRAPHIC:
        w->origin = vec3_mad(vec3_mad(w->origin, w->u, c->right), w->v, c->up);
        w->d = c->direction;
        break;
    case CAMERA_FISHEYE: return fisheye(w);
    case CAMERA_OMNIMAX: return omnimax(w);
    case CAMERA_ULTRA_WIDE_ANGLE: ultra_wide(w); break;
    case CAMERA_PANORAMIC: panoramic(w); break;
    case CAMERA_SPHERICAL: spherical(w); break;
    default: cylinder(w); break;
    }
    return true;
}

static bool view_at(struct view *w, const struct camera_frame *f, double x, double y,
                    int width, int height)
{
    *w = (struct view){.frame = f,
                       .u = x / width - 0.5,
                       .v = 0.5 - y / height,
                       .origin = f->camera->location};
    w->x0 = w->u;
    w->y0 = w->v;
    return view_ray(w);
}

static struct vec3 bent(const struct camera *c, const struct view *w, struct vec3 d)
{
    if (!c->normal)
        return d;
    const struct texture_point at = {
        .p = {w->x0, w->y0, 0}, .uv = {w->x0, w->y0}, .normal = d, .ray_d = d};
    return vec3_normalize(normal_perturb(c->normal, &at));
}

bool camera_ray(const struct camera *c, double x, double y, int w, int h, struct ray *out)
{
    struct view view;
    if (c->kind == CAMERA_MESH)
        return camera_mesh_ray(c, x, y, w, h, 0, out);
    const struct camera_frame frame = camera_frame_of(c);
    if (!view_at(&view, &frame, x, y, w, h))
        return false;
    *out = (struct ray){view.origin, bent(c, &view, vec3_normalize(view.d)), 0, INFINITY};
    return true;
}

bool camera_mesh_ray(const struct camera *c, double x, double y, int w, int h, uint32_t k,
                     struct ray *out)
{
    const struct view at = {0}; // one bend for all: at the origin
    struct vec3 o, d;
    if (!mesh_camera_ray(c, x, y, w, h, k, NULL, &o, &d))
        return false;
    *out = (struct ray){o, bent(c, &at, d), 0, INFINITY};
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
    const struct camera_frame frame = camera_frame_of(c);
    if (!view_at(&view, &frame, x, y, w, h))
        return false;
    const struct vec3 shift =
        vec3_sub(vec3_scale(lens.u, l->across), vec3_scale(lens.v, l->upright));
    const struct vec3 d = vec3_sub(vec3_scale(l->reach, view.d), shift);
    *out = (struct ray){vec3_add(c->location, shift), bent(c, &view, vec3_normalize(d)),
                        0, INFINITY};
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
