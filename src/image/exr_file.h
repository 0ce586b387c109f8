#ifndef IMAGE_EXR_FILE_H
#define IMAGE_EXR_FILE_H

// The C core of OpenEXR, loaded for reading and writing.
#include <openexr.h>

#include "base/library.h"
#include "image/codec.h"

#define FUNCTIONS(F)                                                                     \
    F(exr_add_channel)                                                                   \
    F(exr_add_part)                                                                      \
    F(exr_attr_get_chromaticities)                                                       \
    F(exr_attr_set_string)                                                               \
    F(exr_decoding_choose_default_routines)                                              \
    F(exr_decoding_destroy)                                                              \
    F(exr_decoding_initialize)                                                           \
    F(exr_decoding_run)                                                                  \
    F(exr_decoding_update)                                                               \
    F(exr_encoding_choose_default_routines)                                              \
    F(exr_encoding_destroy)                                                              \
    F(exr_encoding_initialize)                                                           \
    F(exr_encoding_run)                                                                  \
    F(exr_encoding_update)                                                               \
    F(exr_finish)                                                                        \
    F(exr_get_channels)                                                                  \
    F(exr_get_data_window)                                                               \
    F(exr_get_default_error_message)                                                     \
    F(exr_get_error_code_as_string)                                                      \
    F(exr_get_scanlines_per_chunk)                                                       \
    F(exr_get_storage)                                                                   \
    F(exr_get_tile_sizes)                                                                \
    F(exr_initialize_required_attr_simple)                                               \
    F(exr_read_scanline_chunk_info)                                                      \
    F(exr_read_tile_chunk_info)                                                          \
    F(exr_start_read)                                                                    \
    F(exr_start_write)                                                                   \
    F(exr_write_header)                                                                  \
    F(exr_write_scanline_chunk_info)

struct openexr {
    FUNCTIONS(LIBRARY_POINTER)
};

#ifdef EXR_SONAME
LIBRARY_LOADED(openexr, EXR_SONAME)
#else
LIBRARY_LINKED(openexr)
#endif

struct exr_file {
    struct openexr lib;
    exr_context_t context;
};

static inline void exr_file_error(exr_const_context_t f, exr_result_t code,
                                  const char *text)
{
    (void)f, (void)code, (void)text; // the code is returned too
}

#endif
