// How far a picture of a matt scene is from the truth:
//   radiosity_picture TRUTH.tsv LIGHT SCENE.pov PICTURE.ppm [SCENE.pov PICTURE.ppm ...]
// prints the error of the reflected light over the bins of the truth (see radiosity_bench)
// that a picture shows wholly, and how many they were; more scenes are further views.
// LIGHT is the radiosity of what the truth gives an emission of 1. Pictures are linear PPM
// of 16 bits. Pixels too bright for the file, and bins of few pixels, are left out; so are
// bins of which anything is hidden, as the truth is the mean of all of it. The mean of a
// bin is the value in its middle of the plane fitted to its pixels: a few rows of pixels
// do not lie evenly about the middle.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "api/context.h"
#include "scene/camera.h"
#include "trace/intersect.h"
#include "truth.h"

enum { PIXELS_LEAST = 8 };

// Sums over the pixels of a bin, weighted by their areas: of (1, x, y) times 1, x and y,
// the place in the bin from its middle, and times the value.
struct view {
    struct vec3 one, x, y, value[3];
    int pixels;
    bool whole;
};

static struct view seen[BINS_MOST];

// Where in a bin a point lies, 0 to 1 in it.
static struct vec2 place_in(const struct bin *x, struct vec3 p)
{
    const struct vec3 r = vec3_sub(p, x->p);
    const double aa = vec3_dot(x->a, x->a), ab = vec3_dot(x->a, x->b),
                 bb = vec3_dot(x->b, x->b);
    const double ra = vec3_dot(r, x->a), rb = vec3_dot(r, x->b), det = aa * bb - ab * ab;
    return (struct vec2){(ra * bb - rb * ab) / det, (rb * aa - ra * ab) / det};
}

// The bin that a ray meets first, and where; -1: none. Walls may be warped a little, and
// lie near the planes of others where they meet: the surface's normal tells.
static int bin_met(const struct world *world, struct trace_scratch *scratch,
                   const struct ray_query *q, struct vec2 *place)
{
    static const double alike = .9; // cosine
    const struct hit hit = trace_closest_1(world, scratch, q);
    struct interaction at;
    if (!(hit.b.t < INFINITY))
        return -1;
    trace_interaction(world, &q->ray, &hit, &at);
    const struct vec3 up = vec3_dot(at.ng, q->ray.d) > 0 ? vec3_neg(at.ng) : at.ng;
    for (int k = 0; k < bins; k++) {
        const struct bin *x = &bin[k];
        const struct vec3 n = vec3_normalize(vec3_cross(x->a, x->b));
        if (vec3_dot(up, n) < alike ||
            fabs(vec3_dot(vec3_sub(at.p, x->p), n)) > .05 * vec3_length(x->a))
            continue;
        *place = place_in(x, at.p);
        if (place->u >= 0 && place->u < 1 && place->v >= 0 && place->v < 1)
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

static void add_pixel(const struct camera *c, int k, struct vec2 place, int i, int j,
                      int w, int h, const double value[3])
{
    const struct vec3 o = on_plane(c, &bin[k], i, j, w, h);
    const double area =
        vec3_length(vec3_cross(vec3_sub(on_plane(c, &bin[k], i + 1, j, w, h), o),
                               vec3_sub(on_plane(c, &bin[k], i, j + 1, w, h), o)));
    struct view *s = &seen[k];
    const struct vec3 at = vec3(area, area * (place.u - .5), area * (place.v - .5));
    s->one = vec3_add(s->one, at);
    s->x = vec3_mad(s->x, place.u - .5, at);
    s->y = vec3_mad(s->y, place.v - .5, at);
    for (int m = 0; m < 3; m++)
        s->value[m] = vec3_mad(s->value[m], value[m], at);
    s->pixels++;
}

// Whether the pixels of a bin are enough, and not all in one row.
static bool spread(const struct view *s)
{
    static const double least = 1.0 / 500; // even ones have 1 / 144
    const double area = s->one.x;
    return s->pixels >= PIXELS_LEAST &&
           vec3_dot(s->one, vec3_cross(s->x, s->y)) > least * area * area * area;
}

// The value in the middle of a bin by least squares.
static double middle_value(const struct view *s, int m)
{
    const struct vec3 n = vec3_cross(s->x, s->y);
    return vec3_dot(s->value[m], n) / vec3_dot(s->one, n);
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

// Whether the camera sees all of a bin, by points on it.
static bool wholly_seen(const struct world *world, struct trace_scratch *scratch,
                        const struct camera *c, int k)
{
    enum { SIDE = 16 };
    struct ray middle;
    struct vec2 place;
    camera_ray(c, .5, .5, 1, 1, &middle);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const struct vec3 p =
            vec3_mad(vec3_mad(bin[k].p, (i % SIDE + .5) / SIDE, bin[k].a),
                     (i / SIDE + .5) / SIDE, bin[k].b);
        struct vec3 o = c->location;
        if (!camera_has_one_eye(c)) // parallel
            o = vec3_mad(p, -vec3_dot(vec3_sub(p, o), middle.d), middle.d);
        const struct ray_query q = {{o, vec3_normalize(vec3_sub(p, o)), 0, INFINITY}, 0};
        if (bin_met(world, scratch, &q, &place) != k)
            return false;
    }
    return true;
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
        struct vec2 place;
        const int at = bin_met(ctx->world, scratch, &q, &place);
        if (at >= 0)
            add_pixel(c, at, place, k % w, k / w, w, h, value);
    }
    for (int k = 0; k < bins; k++)
        seen[k].whole = seen[k].whole || wholly_seen(ctx->world, scratch, c, k);
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
        if (!seen[k].whole || !spread(&seen[k]))
            continue;
        used++;
        for (int m = 0; m < 3; m++)
            h[m] = (middle_value(&seen[k], m) / light - bin[k].e) / bin[k].rho[m];
        error_add(&sum, vec3_length(vec3_cross(bin[k].a, bin[k].b)), bin[k].rho, h,
                  bin[k].h);
    }
    printf("%.4g\t%d\n", error_of(&sum), used);
    return 0;
}
