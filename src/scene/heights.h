#ifndef SCENE_HEIGHTS_H
#define SCENE_HEIGHTS_H

// The samples of a height_field: width * height values, 0 to 65535 for whole files,
// at[j * width + i] for x = i/(width - 1) and z = j/(height - 1).
struct heights {
    int width, height;
    float *at;
};

#endif
