#ifndef IMAGE_JPEG_JOB_H
#define IMAGE_JPEG_JOB_H

// libjpeg, loaded for reading and writing; its errors jump back to who called it.
#include <setjmp.h>
#include <stdio.h>

#include <jpeglib.h>

#include "base/library.h"
#include "image/codec.h"

#define FUNCTIONS(F)                                                                     \
    F(jpeg_CreateCompress)                                                               \
    F(jpeg_CreateDecompress)                                                             \
    F(jpeg_destroy_compress)                                                             \
    F(jpeg_destroy_decompress)                                                           \
    F(jpeg_finish_compress)                                                              \
    F(jpeg_finish_decompress)                                                            \
    F(jpeg_mem_dest)                                                                     \
    F(jpeg_mem_src)                                                                      \
    F(jpeg_read_header)                                                                  \
    F(jpeg_read_scanlines)                                                               \
    F(jpeg_set_defaults)                                                                 \
    F(jpeg_set_quality)                                                                  \
    F(jpeg_start_compress)                                                               \
    F(jpeg_start_decompress)                                                             \
    F(jpeg_std_error)                                                                    \
    F(jpeg_write_marker)                                                                 \
    F(jpeg_write_scanlines)

struct libjpeg {
    FUNCTIONS(LIBRARY_POINTER)
};

#ifdef JPEG_SONAME
LIBRARY_LOADED(libjpeg, JPEG_SONAME)
#else
LIBRARY_LINKED(libjpeg)
#endif

struct jpeg_job {
    struct jpeg_error_mgr manager; // first: libjpeg hands this back
    jmp_buf back;
    struct codec_error error;
};

static inline void jpeg_job_fail(j_common_ptr c)
{
    struct jpeg_job *job = (struct jpeg_job *)c->err;
    char text[JMSG_LENGTH_MAX];
    job->manager.format_message(c, text);
    codec_fail(job->error, "%s", text);
    longjmp(job->back, 1);
}

#endif
