#ifndef API_STATE_H
#define API_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/image.h"

struct lambert_context;
struct render_progress;
struct render_settings;

// What a render that may be interrupted leaves beside its picture: a header with a digest
// of all that decides the pixels, then the finished tiles one by one, each with a digest of
// its own, so that a file cut short anywhere loses the last tile only.

struct render_state {
    struct lambert_context *ctx;
    const char *path;
    const struct render_settings *settings;
    struct image *picture;
    uint8_t *have;     // by tile, from the file; NULL: none are here
    uint8_t *done;     // by tile, when all are to be written at the end; NULL: at once
    uint32_t tiles;    // in the whole picture
    uint32_t restored; // of them, from the file
    int file;          // -1: nothing is kept any more
};

// Of all that decides the pixels but saved light: version, settings, the scene and what it
// reads besides.
uint64_t picture_key(const struct lambert_context *ctx);
// Continues a digest with the text of the scene.
uint64_t text_key(const struct lambert_context *ctx, uint64_t key);

enum state_mode {
    STATE_AT_END, // written when the picture ends before it is whole
    STATE_KEEP,   // tiles are written as they are finished: these outlive any end
    STATE_RESUME, // the same, after the file's tiles are put into the picture
};

// Prepares the state at ctx->state_path. One of another scene, other settings or version is
// reported and begun anew. `settings` and `picture` stay valid until it is closed.
void render_state_open(struct render_state *s, struct lambert_context *ctx,
                       enum state_mode mode, const struct render_settings *settings,
                       struct image *picture);
// Adds what the tracer needs to know to its progress functions.
void render_state_attach(struct render_state *s, struct render_progress *progress);
// Writes what is not there yet, unless the picture is whole.
void render_state_close(struct render_state *s, bool whole);
// The last picture was written: removes the file if that was whole.
void render_state_remove(struct lambert_context *ctx);

#endif
