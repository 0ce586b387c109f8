// Speed against accuracy of intersection, as a table (doc/accuracy.md). The methods that the
// renderer does not use live here.
// usage: intersection_bench [quartic|quadric|patch|csg|isosurface]
#include "bench.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double bench_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*state >> 11) + .5) * 0x1p-53;
}

struct vec3 bench_in_cube(uint64_t *state)
{
    const double x = bench_random(state), y = bench_random(state),
                 z = bench_random(state);
    return vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

struct ray bench_chord(uint64_t *state)
{
    const struct vec3 a = bench_in_cube(state), b = bench_in_cube(state);
    const struct vec3 d = vec3_normalize(vec3_sub(b, a));
    return (struct ray){vec3_mad(a, -4, d), d, 0, INFINITY};
}

void *bench_memory(uint64_t bytes)
{
    void *p = calloc(1, bytes);
    if (!p) {
        fputs("no memory\n", stderr);
        exit(1);
    }
    return p;
}

struct boundary_list *bench_list(void)
{
    static struct boundary_list list;
    list.count = 0;
    return &list;
}

void found_sort(struct found *f)
{
    for (int i = 1; i < f->count; i++)
        for (int k = i; k > 0 && f->t[k] < f->t[k - 1]; k--) {
            const double t = f->t[k];
            f->t[k] = f->t[k - 1];
            f->t[k - 1] = t;
        }
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// CPU seconds of all rays once: the best of at least five passes and a third of a second.
static double time_of(const struct trial *t, meet_line *meet, const void *thing,
                      struct found *found)
{
    double best = INFINITY, spent = 0;
    for (int pass = 0; pass < 5 || spent < .3; pass++) {
        const double begin = seconds();
        for (int i = 0; i < t->rays; i++) {
            found[i].count = 0;
            meet(thing, &t->ray[i], &found[i]);
        }
        const double took = seconds() - begin;
        spent += took;
        best = fmin(best, took);
        if (spent > 20)
            break;
    }
    return best;
}

// The largest error of a ray's answers; INFINITY: another number of them.
static double error_of(const struct found *f, const struct found *truth)
{
    if (f->count != truth->count)
        return INFINITY;
    double error = 0;
    for (int i = 0; i < f->count; i++)
        if (!(fabs(f->t[i] - truth->t[i]) <= error))
            error = fabs(f->t[i] - truth->t[i]);
    return error;
}

void bench_method(const struct trial *t, const char *method, double knob, meet_line *meet,
                  const void *thing)
{
    struct found *found = bench_memory((uint64_t)t->rays * sizeof *found);
    const double took = time_of(t, meet, thing, found);
    int wrong = 0, right = 0;
    double squares = 0, most = 0;
    for (int i = 0; i < t->rays; i++) {
        const double e = error_of(&found[i], &t->truth[i]);
        if (!(e <= t->tolerance)) {
            wrong++;
        } else if (found[i].count) {
            right++;
            squares += e * e;
            most = fmax(most, e);
        }
    }
    printf("%s\t%s\t%s\t%g\t%.4g\t%.4g\t%.3g\t%.3g\t%d\n", t->family, t->set, method,
           knob, t->rays / took, (double)wrong / t->rays,
           right ? sqrt(squares / right) : 0, most, t->rays);
    fflush(stdout);
    free(found);
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        void (*run)(void);
    } family[] = {{"quartic", bench_quartics},
                  {"quadric", bench_quadrics},
                  {"patch", bench_patches},
                  {"csg", bench_csg},
                  {"isosurface", bench_isosurfaces}};
    puts("#family\tset\tmethod\tknob\trays/s\twrong\trms error\tlargest error\trays");
    for (size_t i = 0; i < sizeof family / sizeof *family; i++)
        if (argc < 2 || strcmp(argv[1], family[i].name) == 0)
            family[i].run();
    return 0;
}
