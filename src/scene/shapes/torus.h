#ifndef SCENE_SHAPES_TORUS_H
#define SCENE_SHAPES_TORUS_H

// Around the y axis: (sqrt(x*x + z*z) - major)^2 + y*y <= minor*minor.
struct torus {
    double major, minor;
};

#endif
