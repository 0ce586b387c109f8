#ifndef SCENE_SHAPES_TORUS_H
#define SCENE_SHAPES_TORUS_H

// Around the y axis: (sqrt(x*x + z*z) - major)^2 + y*y <= minor*minor.
struct torus {
    double major, minor;
};

// The search for crossings begins and ends outside by this share of the minor radius.
#define TORUS_MARGIN 0x1p-3

#endif
