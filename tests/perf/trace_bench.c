// Rays per second of the tracer's core on generated worlds: camera rays and the shadow
// rays of their hits, one thread. Usage: trace_bench [width [scene]]
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/arena.h"
#include "scene/shapes/box.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"
#include "trace/intersect.h"

enum { BATCH = 1024, OBJECTS_MAX = 200000 };

static const struct pigment grey = {.kind = PIGMENT_SOLID, .color = {.r = .5f}};
static const struct finish matt = {.diffuse = .6f, .old_ior = -1};
static const struct texture_layer layer = {.pigment = &grey, .finish = &matt};
static const struct texture texture = {.layer = &layer, .layer_count = 1};

struct maker {
    struct arena *a;
    const struct object **object;
    uint32_t count;
    uint64_t random;
};

static double between(struct maker *m, double lo, double hi)
{
    m->random = m->random * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * (double)(m->random >> 11) * 0x1p-53;
}

static struct object *sphere_at(struct maker *m, double x, double y, double z, double r)
{
    struct sphere *s = arena_new_struct(m->a, struct sphere);
    *s = (struct sphere){vec3(x, y, z), r, transform_identity.linear};
    return object_new_shape(m->a, &sphere_ops, s, (struct span){0});
}

static struct object *box_of(struct maker *m, struct vec3 min, struct vec3 max)
{
    struct box *b = arena_new_struct(m->a, struct box);
    *b = (struct box){min, max};
    return object_new_shape(m->a, &box_ops, b, (struct span){0});
}

static void add(struct maker *m, struct object *o) { m->object[m->count++] = o; }

static void add_ground(struct maker *m)
{
    struct plane *p = arena_new_struct(m->a, struct plane);
    *p = (struct plane){vec3(0, 1, 0), vec3(0, -5, 0)};
    add(m, object_new_shape(m->a, &plane_ops, p, (struct span){0}));
}

// A box less n spheres, turned and moved.
static struct object *cheese(struct maker *m, double size, uint32_t n)
{
    const struct object **child = arena_new_array(m->a, const struct object *, n + 1);
    child[0] = box_of(m, vec3(-size, -size, -size), vec3(size, size, size));
    double r = n <= 6 ? .42 : 1.2 / cbrt(n);
    for (uint32_t i = 1; i <= n; i++)
        child[i] = sphere_at(m, between(m, -size, size), between(m, -size, size),
                             between(m, -size, size), r * size);
    struct object *o =
        object_new_csg(m->a, CSG_DIFFERENCE, child, n + 1, (struct span){0});
    struct transform t = transform_rotate(vec3(between(m, 0, 90), between(m, 0, 90), 0));
    object_transform(m->a, o, &t);
    return o;
}

static void one(struct maker *m) { add(m, cheese(m, 3, 4)); }
static void holes(struct maker *m) { add(m, cheese(m, 3, 2000)); }

static void many(struct maker *m)
{
    for (int i = 0; i < 1000; i++) {
        struct object *o = cheese(m, .4, 6);
        struct transform t = transform_translate(
            vec3(between(m, -5, 5), between(m, -4, 5), between(m, -5, 5)));
        object_transform(m->a, o, &t);
        add(m, o);
    }
}

static void spheres(struct maker *m)
{
    for (int i = 0; i < 100000; i++)
        add(m,
            sphere_at(m, between(m, -5, 5), between(m, -4.5, 5), between(m, -5, 5), .05));
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void set_ray(struct ray_batch *b, uint32_t i, struct vec3 o, struct vec3 d)
{
    b->o[0][i] = o.x, b->o[1][i] = o.y, b->o[2][i] = o.z;
    b->d[0][i] = d.x, b->d[1][i] = d.y, b->d[2][i] = d.z;
    b->t_min[i] = 0;
    b->t_max[i] = INFINITY;
    b->hidden_by[i] = 0;
}

struct totals {
    double closest, occluded;
    uint64_t rays, shadows;
};

static void run(const struct world *w, struct trace_scratch *s, int width,
                struct totals *sum)
{
    struct ray_batch *b = ray_batch_new(BATCH), *l = ray_batch_new(BATCH);
    struct hit_batch *hits = hit_batch_new(BATCH);
    uint8_t dark[BATCH];
    const struct vec3 eye = vec3(3, 4, -14), sun = vec3_normalize(vec3(4, 9, -6));
    for (int first = 0; first < width * width; first += BATCH) {
        b->count = 0;
        for (int i = first; i < first + BATCH && i < width * width; i++) {
            double x = (i % width + .5) / width - .5, y = .5 - (i / width + .5) / width;
            struct vec3 d = vec3_sub(vec3(x * 14, y * 14, 0), eye);
            set_ray(b, b->count++, eye, vec3_normalize(d));
        }
        double t0 = seconds();
        trace_closest(w, s, b, hits);
        double t1 = seconds();
        l->count = 0;
        for (uint32_t i = 0; i < b->count; i++) {
            struct interaction at;
            struct ray r = {eye, vec3(b->d[0][i], b->d[1][i], b->d[2][i]), 0, INFINITY};
            const struct hit hit = hit_batch_at(hits, i);
            if (isinf(hit.b.t))
                continue;
            trace_interaction(w, &r, &hit, &at);
            set_ray(l, l->count++, trace_offset(&at, sun), sun);
        }
        double t2 = seconds();
        trace_occluded(w, s, l, dark);
        sum->occluded += seconds() - t2;
        sum->closest += t1 - t0;
        sum->rays += b->count;
        sum->shadows += l->count;
    }
    hit_batch_free(hits);
    ray_batch_free(b);
    ray_batch_free(l);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        void (*make)(struct maker *m);
    } scenes[] = {{"one", one}, {"many", many}, {"spheres", spheres}, {"holes", holes}};
    int width = argc > 1 ? atoi(argv[1]) : 512;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        if (argc > 2 && strcmp(argv[2], scenes[i].name))
            continue;
        struct maker m = {.a = arena_new(1 << 20), .random = 1};
        m.object = calloc(OBJECTS_MAX, sizeof *m.object);
        if (!m.object)
            return 1;
        add_ground(&m);
        scenes[i].make(&m);
        struct scene scene = {.object = m.object, .object_count = m.count};
        scene.default_texture = (struct attached_texture){&texture, &transform_identity};
        double t0 = seconds();
        struct world *w = world_build(m.a, &scene);
        double built = seconds() - t0;
        struct trace_scratch *s = trace_scratch_new(w);
        struct totals sum = {0};
        run(w, s, width, &sum);
        printf("%-8s build %.3f s  closest %6.2f M/s  occluded %6.2f M/s\n",
               scenes[i].name, built, 1e-6 * (double)sum.rays / sum.closest,
               1e-6 * (double)sum.shadows / sum.occluded);
        trace_scratch_free(s);
        free(m.object);
        arena_free(m.a);
    }
    return 0;
}
