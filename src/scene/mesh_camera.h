#ifndef SCENE_MESH_CAMERA_H
#define SCENE_MESH_CAMERA_H

#include <stdbool.h>
#include <stdint.h>

#include "math/transform.h"

struct arena;
struct camera;
struct mesh;

// How the faces of the meshes are given to pixels (spec/lighting.md 1.3).
enum mesh_camera_way {
    MESH_CAMERA_RAYS,  // a mesh for each ray of a pixel, a face for each pixel
    MESH_CAMERA_LIST,  // the faces of all meshes as one list
    MESH_CAMERA_WIDTH, // meshes side by side
    MESH_CAMERA_UV,    // the face that holds the pixel in the uv of the first mesh
};

struct camera_mesh {
    const struct mesh *mesh;
    const struct transform *transform;
};

// A camera whose rays leave the faces of meshes.
struct mesh_camera {
    enum mesh_camera_way way;
    uint32_t rays;       // of a pixel
    double max_distance; // of what a ray from the camera sees; 0: no limit
    bool smooth;         // MESH_CAMERA_UV: along the interpolated normals
    const struct camera_mesh *mesh;
    const struct transform **turn; // of each mesh: its own, or an earlier one that turns
                                   // normals as it does
    uint32_t mesh_count;
    uint32_t face_count;       // of all meshes
    const struct uv_faces *uv; // MESH_CAMERA_UV: the faces by their place
};

// Fills face_count, turn and what finds faces by uv.
void mesh_camera_finish(struct mesh_camera *m, struct arena *a);
// The face that a caller has asked last: the meshes of a camera are mostly one in several places.
// All zero at first.
struct mesh_camera_memo {
    const struct mesh *mesh;
    uint32_t face;
    struct vec3 centre, normal;
    const struct transform
        *turn; // what made the direction of the normal; NULL: nothing yet
    struct vec3 direction;
};
// Ray k of the pixel position (x, y) of a w x h picture, as camera_ray's; the direction is
// a unit vector. False: there is none. memo: NULL, or of this camera alone.
bool mesh_camera_ray(const struct camera *c, double x, double y, int w, int h, uint32_t k,
                     struct mesh_camera_memo *memo, struct vec3 *origin,
                     struct vec3 *direction);

#endif
