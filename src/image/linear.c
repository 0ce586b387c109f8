// From a picture's own numbers to linear light, for the files that hold it.
#include "image/codec.h"

bool image_linear(struct image *to, const struct image *im,
                  const struct image_write_options *o, int channels)
{
    const struct transfer t = o->unmanaged ? o->transfer : o->working;
    if (!image_init(to, im->width, im->height, channels))
        return false;
    for (int y = 0; y < im->height; y++) {
        for (int x = 0; x < im->width; x++) {
            const float *from = image_at(im, x, y);
            float *p = image_at(to, x, y);
            for (int k = 0; k < 3; k++) {
                const float v = from[im->channels >= 3 ? k : 0];
                p[k] = t.kind == TRANSFER_NONE ? v : (float)transfer_decode(t, (double)v);
            }
            if (channels == 4)
                p[3] = im->channels == 4 ? from[3] : 1;
        }
    }
    return true;
}
