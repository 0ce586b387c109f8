#ifndef TRACE_PAINT_H
#define TRACE_PAINT_H

#include "scene/texture.h"
#include "trace/simple.h"

// Hits of surfaces that are not simple have their textures evaluated eight hits of a surface
// at a time: maps give each hit its plain textures with their weights, and those the colours
// and normals of their layers, with the bits and in the order of texture_walk and
// layer_eval. Where the light has the rules of trace/simple.h, it is found eight hits at a
// time, too (trace/paint_lit.c); else hit by hit (trace/shade.c).

// A layer of a plain texture in the lanes of a group that see it.
struct paint_sheet {
    const struct texture_layer *layer;
    unsigned lanes, found; // found: as pigment_color returns
    double n[3][8];
    float color[5][8];                    // as struct rgbft
    float att[8], filter[3][8], trans[8]; // as struct layer
};

// A plain texture in the lanes of a group.
struct paint_coat {
    const struct texture *texture;
    unsigned lanes;
    unsigned open; // lanes that more light than adc_bailout passes
    unsigned any;  // lanes where some layer has a colour
    double weight[8];
    uint32_t sheet, sheet_count; // its layers, from the top
    float passed[3][8];          // what the layers let through together, and
    float filter[3][8];          // the same with the weight
    float trans[8];
};

// Eight hits of a surface.
struct paint_group {
    struct simple_group hits;
    const struct surface *surface;
    uint32_t sheet, sheet_count, coat, coat_count;
};

struct paint_texture {
    const struct texture *texture;
    const struct pigment_tape *const *tape; // of a plain one's layers; NULL: one colour
    const struct paint_texture *entry;      // of a map
};

struct paint_surface {
    uint32_t number;                  // of its list of hits
    const struct paint_texture *top;  // NULL: its hits are not painted
    const struct paint_texture *back; // seen from inside; NULL: the same
    bool lit;                         // its light is found eight hits at a time
};

// The most at one hit.
enum { PAINT_LAYERS = 16, PAINT_PARTS = 8 };
// The most that wait.
enum { PAINT_GROUPS = 32, PAINT_SHEETS = 512, PAINT_COATS = 256 };

struct paint_scratch {
    uint16_t *head, *tail; // of a surface's list of hits
    uint16_t link[BATCH_SIZE];
    uint32_t seen[BATCH_SIZE], seen_count; // surfaces
    struct paint_group group[PAINT_GROUPS];
    struct paint_sheet sheet[PAINT_SHEETS];
    struct paint_coat coat[PAINT_COATS];
    uint32_t group_count, sheet_count, coat_count;
    struct indirect_kept *asks; // by ray, where job.collects
};

// A layer at one hit.
struct painted {
    struct vec3 n;
    struct rgbft color;
    bool found;
};

// One plain texture at a hit. Layers below opaque ones are not set.
struct paint_part {
    const struct texture *texture;
    double weight;
    const struct painted *layer;
};

void paint_compile(struct job *job, struct arena *a);
void paint_init(struct tracer *t);
void paint_end(struct tracer *t);
// Keeps the hit of ray k of the batch if its surface is painted.
bool paint_take(struct tracer *t, uint32_t k);
// Shades the hits that were kept.
void paint_shade(struct tracer *t);
// Where the order of hits counts for light by way of others (job.collects): shades all painted hits
// of the batch but for that.
void paint_first(struct tracer *t);
// And then asks for that of ray k, if its surface is painted.
bool paint_ask(struct tracer *t, uint32_t k);

// ---- shadow rays ---------------------------------------------------------------------
// Whether paint_pass knows what the surface lets through.
bool paint_filters(const struct job *job, uint32_t surface);
// What it lets through at up to eight hits of shadow rays among transparent things, which stand
// in walk_rays and walk_hit.
void paint_pass(struct tracer *t, uint32_t surface, const uint16_t *ray, uint32_t count,
                struct rgb pass[8]);

// ---- light, eight hits at a time --------------------------------------------------------
// The rules of a surface's light, and of its textures', that lanes know.
bool paint_lights_surface(const struct job *job, const struct surface *s);
bool paint_lights_texture(const struct job *job, const struct texture *x);
// What the layer mirrors in the lanes of `lanes`, for conserve_energy.
void paint_mirror(const struct tracer *t, const struct paint_group *g,
                  const struct paint_sheet *s, unsigned lanes, float out[3][8]);
// The light of the groups that wait, of one surface, and the rays that go on from them.
void paint_light(struct tracer *t, const struct paint_group *g, uint32_t count);

#endif
