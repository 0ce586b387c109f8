// From a picture's own numbers to linear light, for the files that hold it.
#include "image/codec.h"

#include <math.h>

// One pixel that is no number, or endless, would spoil all that other programs blur it into.
static float within(float v, float most)
{
    return isnan(v) ? 0 : fmaxf(-most, fminf(v, most));
}

bool image_linear(struct image *to, const struct image *im,
                  const struct image_write_options *o, int channels, float most)
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
                p[k] = within(
                    t.kind == TRANSFER_NONE ? v : (float)transfer_decode(t, (double)v),
                    most);
            }
            if (channels == 4)
                p[3] = im->channels == 4 ? within(from[3], most) : 1;
        }
    }
    return true;
}
