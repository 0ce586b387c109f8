#ifndef IMAGE_JPEG_JOB_H
#define IMAGE_JPEG_JOB_H

// libjpeg's errors, for reading and writing: they jump back to who called it.
#include <setjmp.h>
#include <stdio.h>

#include <jpeglib.h>

#include "image/codec.h"

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
