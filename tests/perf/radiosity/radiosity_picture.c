// How far a picture of a matt scene is from the truth:
//   radiosity_picture TRUTH.tsv LIGHT SCENE.pov PICTURE.ppm [SCENE.pov PICTURE.ppm ...]
// prints the error of the reflected light over all pixels that show a bin of the truth
// (see radiosity_bench), and how many bins they were; more scenes are further views.
// LIGHT is the radiosity of what the truth gives an emission of 1. Pictures are linear PPM
// of 16 bits. Pixels too bright for the file, and bins of few pixels, are left out.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "api/context.h"
#include "scene/camera.h"
#include "trace/intersect.h"
#include "truth.h"

enum { PIXELS_LEAST = 8 };

struct view {
    double area, value[3];
    int pixels;
};

static struct view seen[BINS_MOST];

// The bin that a point lies on; -1: none.
static int bin_at(struct vec3 p, struct vec3 d)
{
    for (int k = 0; k < bins; k++) {
        const struct bin *x = &bin[k];
        const struct vec3 n = vec3_cross(x->a, x->b), r = vec3_sub(p, x->p);
        const double size = vec3_length(x->a);
        if (vec3_dot(d, n) >= 0 || fabs(vec3_dot(r, n)) > .05 * size * vec3_length(n))
            continue;
        const double aa = vec3_dot(x->a, x->a), ab = vec3_dot(x->a, x->b),
                     bb = vec3_dot(x->b, x->b);
        const double ra = vec3_dot(r, x->a), rb = vec3_dot(r, x->b),
                     det = aa * bb - ab * ab;
        const double u = (ra * bb - rb * ab) / det, v = (rb * aa - ra * ab) / det;
        if (u >= 0 && u < 1 && v >= 0 && v < 1)
            return k;
    }
    return -1;
}

// Where a pixel's ray meets the plane of a bin.
static struct vec3 on_plane(const struct camera *c, const struct bin *x, double i,
                            double j, int w, int h)
{
    struct ray ray;
    const struct vec3 n = vec3_cross(x->a, x->b);
    camera_ray(c, i, j, w, h, &ray);
    const double t = vec3_dot(vec3_sub(x->p, ray.o), n) / vec3_dot(ray.d, n);
    return vec3_mad(ray.o, t, ray.d);
}

static void add_pixel(const struct camera *c, int k, int i, int j, int w, int h,
                      const double value[3])
{
    const struct vec3 o = on_plane(c, &bin[k], i, j, w, h);
    const double area =
        vec3_length(vec3_cross(vec3_sub(on_plane(c, &bin[k], i + 1, j, w, h), o),
                               vec3_sub(on_plane(c, &bin[k], i, j + 1, w, h), o)));
    seen[k].area += area;
    seen[k].pixels++;
    for (int m = 0; m < 3; m++)
        seen[k].value[m] += area * value[m];
}

// The next number of the header of a PPM file, which may hold comments.
static int header_number(FILE *file)
{
    int c = getc(file), n = 0;
    while (c == '#' || c == ' ' || c == '\n') {
        while (c == '#' && (c = getc(file)) != '\n' && c != EOF)
            c = '#';
        c = getc(file);
    }
    for (; c >= '0' && c <= '9'; c = getc(file))
        n = 10 * n + c - '0';
    return n; // and the blank behind it is read
}

static void add_picture(const char *scene, const char *picture)
{
    struct lambert_context *ctx = lambert_context_new();
    FILE *file = fopen(picture, "rb");
    int w, h;
    if (lambert_load_file(ctx, scene) != LAMBERT_OK) {
        fprintf(stderr, "%s\n", lambert_error(ctx));
        exit(1);
    }
    if (!file || getc(file) != 'P' || getc(file) != '6' ||
        (w = header_number(file)) < 1 || (h = header_number(file)) < 1 ||
        header_number(file) != 65535) {
        fprintf(stderr, "%s: no PPM of 16 bits\n", picture);
        exit(1);
    }
    const struct camera *c = &ctx->world->scene->camera;
    struct trace_scratch *scratch = trace_scratch_new(ctx->world);
    for (int k = 0; k < w * h; k++) {
        unsigned char x[6];
        double value[3], highest = 0;
        if (fread(x, 1, 6, file) != 6)
            exit(1);
        for (int m = 0; m < 3; m++) {
            value[m] = (256.0 * x[2 * m] + x[2 * m + 1]) / 65535;
            highest = fmax(highest, value[m]);
        }
        struct ray_query q = {.hidden_by = 0};
        if (highest > .999 || !camera_ray(c, k % w + .5, k / w + .5, w, h, &q.ray))
            continue;
        const struct hit hit = trace_closest_1(ctx->world, scratch, &q);
        if (!(hit.b.t < INFINITY))
            continue;
        const int at = bin_at(vec3_mad(q.ray.o, hit.b.t, q.ray.d), q.ray.d);
        if (at >= 0)
            add_pixel(c, at, k % w, k / w, w, h, value);
    }
    fclose(file);
    trace_scratch_free(scratch);
    lambert_context_free(ctx);
}

int main(int argc, char **argv)
{
    if (argc < 5) {
        fprintf(stderr, "usage: radiosity_picture TRUTH.tsv LIGHT SCENE.pov PICTURE.ppm "
                        "[SCENE.pov PICTURE.ppm ...]\n");
        return 64;
    }
    truth_read(argv[1]);
    const double light = atof(argv[2]);
    for (int i = 3; i + 1 < argc; i += 2)
        add_picture(argv[i], argv[i + 1]);
    struct error_sum sum = {0, 0};
    int used = 0;
    for (int k = 0; k < bins; k++) {
        double h[3];
        if (seen[k].pixels < PIXELS_LEAST)
            continue;
        used++;
        for (int m = 0; m < 3; m++)
            h[m] = (seen[k].value[m] / seen[k].area / light - bin[k].e) / bin[k].rho[m];
        error_add(&sum, vec3_length(vec3_cross(bin[k].a, bin[k].b)), bin[k].rho, h,
                  bin[k].h);
    }
    printf("%.4g\t%d\n", error_of(&sum), used);
    return 0;
}
