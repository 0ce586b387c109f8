#ifndef SCENE_PIGMENT_TAPE_H
#define SCENE_PIGMENT_TAPE_H

#include "scene/texture.h"

struct noise_kernels;

// A pigment compiled for a scene: straight-line steps that eight points run through
// together (scene/surface_kernel.c), with the bits of pigment_color. What a pigment does
// not use has no step; what none of the points needs is jumped over.
//
// Steps work on levels: 0 is the place outside, each map around makes one level more. A
// level has a point, a value and a colour.
enum { PIGMENT_LEVELS = 8 };

enum pigment_op {
    PIGMENT_MOVE,       // point: the way into a transform's space
    PIGMENT_TURBULENCE, // point
    PIGMENT_WARP,       // point: any other warp
    PIGMENT_FAR,        // point: not too far off
    PIGMENT_UV_POINT,   // point: (u, v, 0)
    PIGMENT_VALUE,      // value: the pattern's at the point
    PIGMENT_COLOR,      // colour: always the same
    PIGMENT_RAMP,       // colour: the value's in a colour map
    PIGMENT_TEXEL,      // colour: the image's at the point
    PIGMENT_FIND,       // which entries of a map the value lies between
    PIGMENT_ENTRY,      // the next level's points: those that need an entry; none: jump
    PIGMENT_KEEP,       // the next level's colour as that entry's
    PIGMENT_BLEND,      // colour: between the two entries
    PIGMENT_SUM_BEGIN,
    PIGMENT_SUM_ADD,
    PIGMENT_SUM_END, // colour: the mean of entries
};

// A colour map by channel, filled up to a multiple of eight.
struct pigment_ramp {
    uint32_t count;
    bool quick;  // ascending keys, nothing out of the ordinary
    bool opaque; // neither filter nor transmit
    const float *key;
    const float *channel[5];
};

// The keys of a pigment map, filled up as those of a ramp. `entry`: the first entry with the same pigment.
struct pigment_keys {
    uint32_t count;
    bool ascending;
    const float *key;
    const uint32_t *entry;
};

struct pigment_step {
    enum pigment_op op;
    int level, from; // from: whose point is read
    uint32_t entry;  // ENTRY, KEEP: its number
    uint32_t next;   // ENTRY: the step to go on with
    float weight;    // SUM_ADD: of the entry; SUM_END: all
    union {
        const struct transform *transform;
        const struct turbulence *turbulence;
        const struct warp *warp;
        const struct pattern *pattern;
        const struct rgbft *color;
        const struct pigment_ramp *ramp;
        const struct image_map *image;
        const struct pigment_keys *keys;
    };
};

struct pigment_tape {
    const struct pigment_step *step;
    uint32_t count;
    int channels; // 3: neither filter nor transmit anywhere
};

// Compiles the pigments of a scene, which share colour maps. Begins with the arena set.
enum { PIGMENT_RAMPS = 64 };

struct pigment_compiler {
    struct arena *arena;
    const struct color_map *map[PIGMENT_RAMPS];
    const struct pigment_ramp *ramp[PIGMENT_RAMPS];
};

// NULL: its maps are nested too deeply.
const struct pigment_tape *pigment_compile(struct pigment_compiler *c,
                                           const struct pigment *p);
// Whether it may ask for uv coordinates; false only for certain.
bool pigment_wants_uv(const struct pigment *p);
bool normal_wants_uv(const struct normal *n);

// The number of the first key that is not below v, the last for all above it: the `b` of
// map_find, for keys that ascend.
static inline uint32_t map_search(const float *key, uint32_t count, double v)
{
    if (v >= key[count - 1])
        return count - 1;
    uint32_t low = 0, high = count - 1;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (key[middle] < v)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// ---- eight points ---------------------------------------------------------------------
// Compiled once per instruction set; each returns the bits of the function for one point.
struct surface_kernels {
    const char *name;
    const struct noise_kernels *noise;
    // pattern_warp; moves the points in place.
    void (*warp)(const struct pattern *p, double at[3][8]);
    // pattern_value_at, in the lanes of `live`.
    void (*values)(const struct pattern *p, const struct pattern_packet *packet,
                   const double warped[3][8], unsigned live, double out[8]);
    // pigment_color at places of the texture's outer space; the lanes that have a colour.
    // Of a tape of three channels the other two stay as they are.
    unsigned (*colors)(const struct pigment_tape *t, const struct pattern_packet *packet,
                       const double place[3][8], unsigned live, float out[5][8]);
    // normal_perturb; v: the normals of the texture_point, then the perturbed ones.
    void (*perturb)(const struct normal *n, const struct pattern_packet *packet,
                    const double place[3][8], unsigned live, double v[3][8]);
    // pattern_normal_in, without keeping lengths, and pattern_normal_out.
    void (*normal_in)(const struct pattern *p, double v[3][8]);
    void (*normal_out)(const struct pattern *p, double v[3][8]);
};

extern const struct surface_kernels surface_kernels_base, surface_kernels_avx2,
    surface_kernels_avx512;
// By the name of noise_kernels_find.
const struct surface_kernels *surface_kernels_find(const char *name);

#endif
