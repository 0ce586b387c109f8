#ifndef IMAGE_PNG_ERROR_H
#define IMAGE_PNG_ERROR_H

// libpng's errors, for reading and writing: they jump back to who called it. The error
// pointer of a png_struct is a struct codec_error.
#include <png.h>

#include "image/codec.h"

static inline void png_error_jump(png_structp png, png_const_charp text)
{
    const struct codec_error *error = png_get_error_ptr(png);
    codec_fail(*error, "%s", text);
    longjmp(png_jmpbuf(png), 1);
}

static inline void png_no_warning(png_structp png, png_const_charp text)
{
    (void)png, (void)text;
}

#endif
