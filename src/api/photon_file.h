#ifndef API_PHOTON_FILE_H
#define API_PHOTON_FILE_H

#include "lambert/lambert.h"

struct lambert_context;
struct photons;
struct render_settings;

// photons { save_file load_file }: photons as they were shot, for other pictures of the scene.
// The file is a header (8 bytes "LPHO 1\n", then as uint32 of this machine: 1, the number of
// photons on surfaces, that in media) and nine floats a photon: place, unit direction to where
// it came from, red, green, blue.

// Where the scene names such a file: makes settings->photons, which the caller frees
// (photons_free).
enum lambert_status photon_files_use(struct lambert_context *ctx,
                                     struct render_settings *settings,
                                     struct photons **out);

#endif
