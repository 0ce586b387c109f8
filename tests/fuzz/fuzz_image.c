// Any bytes through the image readers (by their mark; as TGA without one), and through
// what the scene asks of the texels.
#include <stdlib.h>

#include "base/arena.h"
#include "scene/image_map.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void look(const struct texels *t)
{
    struct arena *a = arena_new(1 << 12);
    struct image_map m = {.texels = t,
                          .repeat = {1, 1},
                          .interpolation = t->width % 5 == 1 ? 0 : t->width % 5,
                          .decode = {TRANSFER_SRGB, 0}};
    image_map_prepare(a, &m);
    const int x[] = {0, t->width / 2, t->width - 1},
              y[] = {0, t->height / 2, t->height - 1};
    struct rgbft c;
    double sum = 0;
    for (int i = 0; i < 9; i++) {
        sum += texels_height(t, x[i % 3], y[i / 3], (struct transfer){TRANSFER_NONE, 1});
        image_map_color(&m, vec3(0.3 * i, 0.1 * i, 0), &c);
        sum += (double)c.r + image_map_value(&m, vec3(0.1 * i, -0.3 * i, 0));
        sum += image_map_bump(&m, 0.5f, vec3(0, 1, 0), vec3(0.1 * i, 0.2, 0)).x;
    }
    if (sum == 0.123456789) // so that nothing is left out
        abort();
    arena_free(a);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct texels t;
    char error[256];
    if (texels_decode(&t, data, size, IMAGE_TGA, error, sizeof error))
        look(&t);
    texels_free(&t);
    return 0;
}
