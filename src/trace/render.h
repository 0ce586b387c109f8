#ifndef TRACE_RENDER_H
#define TRACE_RENDER_H

#include <stdbool.h>
#include <stdint.h>

#include "image/image.h"
#include "trace/indirect.h"
#include "trace/intersect.h"
#include "trace/world.h"

struct photons;

// What rays are traced for.
enum render_purpose {
    RENDER_PICTURE,
    RENDER_SCOUT,  // the camera's, to find where light by way of others is wanted
    RENDER_GATHER, // such light (spec/lighting.md 12.3): no highlights, lamps are points
};

// Spec/language 7.2 names of the switches in brackets.
struct render_settings {
    int width, height;
    int col_begin, col_end, row_begin, row_end; // half-open, in pixels; full by default
    int threads;                                // 0: all cores
    int tile_size;                              // 32
    int antialias;                              // 0 off, 1, 2 [+AM]
    double aa_threshold;                        // 0.3
    int aa_depth;                               // 3 [+R]
    double aa_gamma;                            // 2.5
    bool aa_jitter;                             // on
    double aa_jitter_amount;                    // 1.0
    int quality;                                // 9
    bool output_alpha;
    struct indirect indirect;
    const struct photons *photons; // shot before; NULL: render_world shoots them
    enum render_purpose purpose;
};
extern const struct render_settings render_settings_default;

struct render_tile {
    uint32_t index;
    int x0, y0, x1, y1; // half-open, in pixels
};

// Tiles are counted in rows from the top left of the part that is rendered.
uint32_t render_tile_count(const struct render_settings *settings);
struct render_tile render_tile_at(const struct render_settings *settings, uint32_t i);

// Called from the rendering thread that finished a tile (serialised by a lock).
struct render_progress {
    void (*tile)(void *user, uint32_t done, uint32_t total);
    void *user;
    const volatile bool *cancel; // set to stop after the current tiles, or in them where
                                 // one ray may take long; may be NULL
    // For renders that are continued: by tile, whether it is in the picture already, and
    // who is told of each that is new. NULL: neither.
    const uint8_t *have;
    void (*keep)(void *user, const struct render_tile *tile);
    void *keep_user;
};

struct render_stats {
    struct trace_stats trace;
    uint64_t samples, pixels;
    double seconds;     // wall, of tracing alone
    double cpu_seconds; // the process's, in that time
    uint32_t tiles_done, tiles_total;
    bool photons_left_out; // there were more than a map holds
};

// The photons of a scene (trace/photons.h), for several jobs; NULL: it has none. The
// settings are those of the picture; store may be NULL.
struct photon_store;
struct photons *render_photons(const struct world *w,
                               const struct render_settings *settings,
                               const struct photon_store *store,
                               const volatile bool *cancel);

// Renders into a picture of linear (working space) RGB floats, or premultiplied RGBA when it
// has four channels.
// True when every tile was done; false after a cancel (missing tiles are zero).
bool render_world(const struct world *w, const struct render_settings *settings,
                  const struct render_progress *progress, struct image *out,
                  struct render_stats *stats);

#endif
