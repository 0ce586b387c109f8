#ifndef SCENE_TEXTURE_H
#define SCENE_TEXTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "scene/pattern.h"

struct arena;
struct media;

// ---- maps ---------------------------------------------------------------
// Entries in written order; keys are single precision (spec/textures 3.3).
struct color_map {
    uint32_t count;
    const float *key;
    const struct rgbft *color;
};

struct pigment_map {
    uint32_t count;
    const float *key; // for `average`: the weights
    const struct pigment *const *entry;
};
struct normal_map {
    uint32_t count;
    const float *key;
    const struct normal *const *entry;
};
struct texture_map {
    uint32_t count;
    const float *key;
    const struct texture *const *entry;
};
struct slope_map {
    uint32_t count;
    const float *key;
    const struct vec2 *entry; // height, slope
};

// Finds the entries around v: *a == *b when one alone counts; fraction goes to b.
void map_find(const float *key, uint32_t count, double v, uint32_t *a, uint32_t *b,
              double *fraction);

// ---- pigment ------------------------------------------------------------
enum pigment_kind {
    PIGMENT_NONE,    // no colour was given: black
    PIGMENT_SOLID,   // color
    PIGMENT_COLORS,  // pattern through color_map
    PIGMENT_MAP,     // pattern through pigment_map (list patterns too)
    PIGMENT_AVERAGE, // weights in map
    PIGMENT_IMAGE,   // image_map
    PIGMENT_UV,      // `uv_mapping` body: entry 0 of map, evaluated at (u,v,0)
};

struct pigment {
    enum pigment_kind kind;
    struct rgbft color;
    // Also carries transforms and warps. NONE, SOLID, UV: may be NULL.
    const struct pattern *pattern;
    const struct color_map *colors;
    const struct pigment_map *map;
    const struct image_map *image;
    bool has_quick_color;
    struct rgbft quick_color;
};

// ---- normal -------------------------------------------------------------
enum normal_kind {
    NORMAL_PATTERN, // by the pattern's own perturbation or by differences
    NORMAL_MAP,
    NORMAL_AVERAGE,
    NORMAL_SLOPES,
    NORMAL_BUMP_MAP,
    NORMAL_UV,
};

struct normal {
    enum normal_kind kind;
    float amount; // 0.5
    float delta;  // `accuracy`, 0.02
    bool no_bump_scale;
    struct pattern pattern;
    const struct normal_map *map;
    const struct slope_map *slopes;
    const struct image_map *image; // bump_map
    float bump_size;
};

// ---- finish -------------------------------------------------------------
struct finish {
    struct rgb ambient, emission;
    float diffuse, diffuse_back, brilliance, crand;
    float matt, matt_back; // diffuse as it was written, not scaled as an albedo
    float phong, phong_size, specular, roughness; // roughness as 1/r: the exponent
    float metallic;
    float irid, irid_thickness, irid_turbulence;
    struct rgb reflection_min, reflection_max;
    float reflection_falloff, reflection_exponent, reflection_metallic; // exponent as 1/e
    bool fresnel, conserve_energy, has_subsurface;
    struct rgb subsurface_translucency, subsurface_anisotropy;
    // obsolete items that move to the interior; < 0: not given
    float old_ior, old_caustics, old_refraction;
};
extern const struct finish finish_default;

// ---- texture ------------------------------------------------------------
struct texture_layer {
    const struct pigment *pigment; // never NULL
    const struct normal *normal;   // NULL: none
    const struct finish *finish;   // never NULL
    bool covers;                   // another layer
};

enum texture_kind {
    TEXTURE_PLAIN, // layers, bottom (first written) first
    TEXTURE_MAP,   // pattern through texture_map (list patterns too)
    TEXTURE_AVERAGE,
    TEXTURE_MATERIAL, // material_map: image index chooses the entry of map
    TEXTURE_UV,
};

struct texture {
    enum texture_kind kind;
    const struct texture_layer *layer;
    uint32_t layer_count;
    const struct pattern *pattern; // PLAIN: may be NULL
    const struct texture_map *map;
    const struct image_map *image;
};

// Copies that move: everything below shares what does not move.
const struct pigment *pigment_transform(struct arena *a, const struct pigment *p,
                                        const struct transform *t);
const struct normal *normal_transform(struct arena *a, const struct normal *n,
                                      const struct transform *t);
const struct texture *texture_transform(struct arena *a, const struct texture *x,
                                        const struct transform *t);

// ---- evaluation (scene/surface.c) ---------------------------------------
// Where a texture is evaluated. p and normal are in the texture's outer space (the
// space outside texture_transform); the rest is in world space.
struct texture_point {
    struct vec3 p;
    struct vec2 uv;
    // Towards the ray, before this layer's perturbation. The world's unit normal
    // through transform_inverse_normal, NOT normalised again (no_bump_scale and the
    // amount of a bump depend on its length only as the language defines).
    struct vec3 normal;
    struct vec3 ray_d;   // world, unit; zero: none
    struct vec3 p_world; // world, for slope with point_at
    // What slope and aoi see: the normal that normal_perturb made last; zero: no surface.
    struct vec3 normal_seen;
    bool uv_mapping; // the object flag: textures take (u,v,0)
};

// False: the pigment gave no colour here (image_map `once` outside).
bool pigment_color(const struct pigment *p, const struct texture_point *at,
                   struct rgbft *out);
// The perturbed normal in the texture's outer space, unit without no_bump_scale (to the
// world by transform_normal, then normalise).
struct vec3 normal_perturb(const struct normal *n, const struct texture_point *at);
// The entries of a MAP/AVERAGE/MATERIAL texture that count at this point, with
// their weights (sum 1); returns how many (at most max).
int texture_select(const struct texture *x, const struct texture_point *at,
                   const struct texture **entry, double *weight, int max);
// The point as the entries that texture_select gave see it, and a normal of theirs on
// its way back out.
struct texture_point texture_entry_point(const struct texture *x,
                                         const struct texture_point *at);
struct vec3 texture_entry_normal(const struct texture *x, struct vec3 n);
// Whether it may ask for uv coordinates; false only for certain.
bool texture_wants_uv(const struct texture *x);
// Whether the texture can never let light through (spec/lighting.md 7.1).
bool texture_is_opaque(const struct texture *x);
// Whether it lets all light through, everywhere.
bool texture_is_clear(const struct texture *x);

// ---- interior -----------------------------------------------------------
struct interior {
    float ior; // 0: unset (1)
    float dispersion;
    int dispersion_samples;
    float caustics; // as stored: 45 times what was written
    struct rgb fade_color;
    double fade_distance, fade_power;
    float old_refraction;             // 1
    bool hollow;                      // filled when the world is compiled
    const struct media *const *media; // scene/effects.h; they add up
    uint32_t media_count;
};
// A copy whose densities are moved by t; i itself where nothing moves.
const struct interior *interior_moved(struct arena *a, const struct interior *i,
                                      const struct transform *t);

#endif
