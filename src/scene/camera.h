#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"

struct normal;
struct pigment;

enum camera_kind {
    CAMERA_PERSPECTIVE,
    CAMERA_ORTHOGRAPHIC,
    CAMERA_FISHEYE,
    CAMERA_ULTRA_WIDE_ANGLE,
    CAMERA_OMNIMAX,
    CAMERA_PANORAMIC,
    CAMERA_CYLINDER_1,
    CAMERA_CYLINDER_2,
    CAMERA_CYLINDER_3,
    CAMERA_CYLINDER_4,
    CAMERA_SPHERICAL,
    CAMERA_MESH,
};

// As it stands after every item was combined (spec/lighting.md 1.2).
struct camera {
    enum camera_kind kind;
    struct vec3 location, direction, right, up;
    double angle, angle_v; // degrees; for the angular kinds
    double aperture, focal_distance, confidence, variance;
    int blur_samples_min, blur_samples;
    const struct normal *normal;    // NULL: none
    const struct mesh_camera *mesh; // of CAMERA_MESH (scene/mesh_camera.h)
    // Of the lens: how likely a place of it, x and y in 0..1, takes light. NULL: a disc.
    const struct pigment *bokeh;
};
extern const struct camera camera_default;

// The ray of sub-pixel position (x, y) in pixels from the left/top corner of a
// w x h picture; pixel (i,j)'s centre is (i+0.5, j+0.5). Unit direction,
// t_min = 0, t_max = infinity. False: no ray there (fisheye corner).
bool camera_ray(const struct camera *c, double x, double y, int w, int h,
                struct ray *out);

// The same of ray k of a CAMERA_MESH, whose pixels are the mean of their rays.
bool camera_mesh_ray(const struct camera *c, double x, double y, int w, int h, uint32_t k,
                     struct ray *out);

// The plane of the lens, and how many lengths of `direction` away all is sharp.
struct camera_lens {
    struct vec3 across, upright; // unit
    double reach;
};
struct camera_lens camera_lens_of(const struct camera *c);
// The same through a point of the lens, in scene units off its centre (focal blur).
bool camera_lens_ray(const struct camera *c, const struct camera_lens *l, double x,
                     double y, int w, int h, struct vec2 lens, struct ray *out);
bool camera_has_lens(const struct camera *c);
// Whether every ray starts at `location`.
bool camera_has_one_eye(const struct camera *c);

#endif
