// Compares a picture with the pixels that a scene file lists:
//     // expect: x y r g b [alpha]
//     // tol: abs A rel R
// and prints the first one that is off by more than A + R*|value|.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/image.h"

struct tolerance {
    double absolute, relative;
};

static int pixel_is_off(const struct image *im, const char *line, struct tolerance tol)
{
    int x, y;
    double want[4];
    const int n = sscanf(line, "// expect: %d %d %lf %lf %lf %lf", &x, &y, &want[0],
                         &want[1], &want[2], &want[3]) -
                  2;
    if (n < 3 || x < 0 || y < 0 || x >= im->width || y >= im->height ||
        n > im->channels) {
        printf("# cannot compare: %s", line);
        return 1;
    }
    const float *got = image_at(im, x, y);
    for (int k = 0; k < n; k++) {
        const double limit = tol.absolute + tol.relative * fabs(want[k]);
        if (fabs((double)got[k] - want[k]) <= limit)
            continue;
        printf("# pixel %d,%d channel %d: got %.6g, want %.6g +- %.2g\n", x, y, k,
               (double)got[k], want[k], limit);
        return 1;
    }
    return 0;
}

int main(int argc, char **argv)
{
    struct image im = {0};
    char line[1024];
    if (argc != 3)
        return 2;
    if (!image_read(&im, argv[2], (struct transfer){TRANSFER_NONE, 1}, line,
                    sizeof line)) {
        printf("# %s\n", line);
        return 2;
    }
    FILE *scene = fopen(argv[1], "r");
    if (!scene)
        return 2;
    struct tolerance tol = {2e-4, 6e-4};
    int seen = 0, off = 0;
    // The tolerance may stand below the pixels, so it is looked for first.
    while (fgets(line, sizeof line, scene) && !strncmp(line, "//", 2))
        (void)sscanf(line, "// tol: abs %lf rel %lf", &tol.absolute, &tol.relative);
    rewind(scene);
    while (!off && fgets(line, sizeof line, scene) && !strncmp(line, "//", 2)) {
        if (strncmp(line, "// expect:", 10))
            continue;
        seen++;
        off = pixel_is_off(&im, line, tol);
    }
    fclose(scene);
    image_free(&im);
    return off || !seen;
}
