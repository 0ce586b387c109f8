// Portable pixmaps: P6, and P5 for grey.
#include "image/codec.h"

#include <stdio.h>
#include <string.h>

static void write_header(struct byte_buffer *out, const struct image *im,
                         const struct image_write_options *o)
{
    char line[64];
    byte_buffer_append(out, o->grey ? "P5\n" : "P6\n", 3);
    for (size_t i = 0; i < o->metadata.count; i++) {
        // A line end inside the text would end the comment.
        byte_buffer_append(out, "# ", 2);
        byte_buffer_append(out, o->metadata.key[i], strlen(o->metadata.key[i]));
        byte_buffer_append(out, ": ", 2);
        size_t n = strcspn(o->metadata.text[i], "\r\n");
        byte_buffer_append(out, o->metadata.text[i], n);
        byte_buffer_append(out, "\n", 1);
    }
    int n = snprintf(line, sizeof line, "%d %d\n%d\n", im->width, im->height,
                     (1 << o->bits) - 1);
    byte_buffer_append(out, line, (size_t)n);
}

bool ppm_encode(const struct image *im, const struct image_write_options *options,
                struct byte_buffer *out, struct codec_error e)
{
    struct image_write_options o = *options;
    struct sample_rows rows;
    o.alpha = false; // the format has none
    if (o.grey)      // and grey is written without gamma (spec/lighting.md 3.4)
        o.transfer = o.working;
    bool ok = sample_rows_begin(&rows, im, &o);
    write_header(out, im, &o);
    for (int y = 0; ok && y < im->height; y++)
        byte_buffer_append(out, sample_rows_bytes(&rows, y, 0),
                           rows.count * (o.bits > 8 ? 2 : 1));
    sample_rows_end(&rows);
    return (ok && !out->failed) || codec_fail(e, "out of memory");
}
