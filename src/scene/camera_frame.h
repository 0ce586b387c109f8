#ifndef SCENE_CAMERA_FRAME_H
#define SCENE_CAMERA_FRAME_H

// What all rays of a camera share, for one ray (camera.c) and for eight (trace/shade_camera.h).
#include "math/elementary.h"
#include "math/pi.h"
#include "scene/camera.h"

static const double PANORAMIC_STEEPEST = 2e10;
// The distortion of an Omnimax projector's lens.
static const double OMNIMAX_0 = 1.411269, OMNIMAX_2 = 0.09439, OMNIMAX_4 = 0.25674;

struct camera_frame {
    const struct camera *camera;
    struct vec3 right, up, direction; // unit
    double len_right, len_up;
    double angle, angle_v; // radians
};

static inline struct camera_frame camera_frame_of(const struct camera *c)
{
    return (struct camera_frame){.camera = c,
                                 .right = vec3_normalize(c->right),
                                 .up = vec3_normalize(c->up),
                                 .direction = vec3_normalize(c->direction),
                                 .len_right = vec3_length(c->right),
                                 .len_up = vec3_length(c->up),
                                 .angle = c->angle * DEGREE,
                                 .angle_v = c->angle_v * DEGREE};
}

// How the picture lies in the dome: a *= across, b = (b - top) / upright + top.
struct omnimax_scale {
    double across, top, upright;
};

static inline struct omnimax_scale omnimax_scale(const struct camera_frame *f)
{
    static const double dome_aspect = 1.283458;
    const double aspect = f->len_right / f->len_up;
    if (aspect > dome_aspect)
        return (struct omnimax_scale){aspect / dome_aspect, 1, dome_aspect};
    return (struct omnimax_scale){1, aspect > 1, aspect};
}

// The angle around the axis, -pi/2 to 3 pi/2, of a unit vector across and up.
static inline double camera_phi(double across, double up)
{
    const double phi = det_asin(up < -1 ? -1 : up > 1 ? 1 : up);
    return across < 0 ? PI - phi : phi;
}

#endif
