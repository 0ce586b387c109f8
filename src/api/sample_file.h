#ifndef API_SAMPLE_FILE_H
#define API_SAMPLE_FILE_H

#include <stdint.h>

#include "lambert/lambert.h"

struct irradiance_cache;
struct lambert_context;

// Samples of POV-Ray's radiosity { } in files, for another picture of the scene
// (--gi-save, --gi-load, Radiosity_To_File, Radiosity_From_File).
// A file is a header (8 bytes "LIRR 1\n"; of this machine: uint32 1, uint32 the number of
// samples, uint64 a digest of the picture they were taken for, uint64 one of its scene's
// text), the samples (ten doubles: place, unit normal, unit direction to the nearest
// surface, its distance; then radius and quality as doubles, three floats of light, uint32
// depth) and a digest of all that as uint64.

struct samples_read {
    uint32_t count; // from the file
    bool complete;  // they are those of this very picture: no more are needed
};

// Adds the samples of the file that the settings name to the cache; none when they name
// none, or one of POV-Ray's that is not there.
enum lambert_status samples_load(struct lambert_context *ctx, struct irradiance_cache *c,
                                 struct samples_read *out);
// Writes them where the settings say so.
enum lambert_status samples_save(struct lambert_context *ctx,
                                 const struct irradiance_cache *c);

#endif
