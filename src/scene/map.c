// Search in blend maps (spec/textures 3.3).

#include "scene/texture.h"

// Keys are searched in written order even when they are not ascending.
void map_find(const float *key, uint32_t count, double v, uint32_t *a, uint32_t *b,
              double *fraction)
{
    uint32_t c = 0;
    if (v >= key[count - 1])
        c = count - 1;
    else
        while (c < count - 1 && key[c] < v)
            c++;
    *b = c;
    *fraction = 0;
    if (c == 0 || v >= key[c]) {
        *a = c;
        return;
    }
    *a = c - 1;
    *fraction = (v - key[c - 1]) / ((double)key[c] - key[c - 1]);
}
