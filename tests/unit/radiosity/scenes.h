#ifndef TESTS_RADIOSITY_SCENES_H
#define TESTS_RADIOSITY_SCENES_H

#include "api/context.h"
#include "base/arena.h"
#include "radiosity/radiosity.h"

// A scene from its text, its patches and its solution.
struct scene_run {
    struct lambert_context *ctx;
    struct arena *arena;
    struct job *job;
    struct radiosity *r;
};

// M(reflectance, emission): a matt texture.
#define HEAD                                                                             \
    "#version 3.7; global_settings { assumed_gamma 1 }\n"                                \
    "#macro M(Rho, E) texture { pigment { rgb 1 }"                                       \
    " finish { ambient 0 diffuse Rho emission E } } #end\n"

struct scene_run scene_load(const char *text);
struct scene_run scene_load_file(const char *path);
struct scene_run scene_solve(const char *text, const struct radiosity_options *options);
void scene_solve_loaded(struct scene_run *s, const struct radiosity_options *options);
void scene_free(struct scene_run *s);
// The defaults with so many patches.
struct radiosity_options with(double patches, const char *solver);

struct mean {
    double area, b, h, least, most;
};
// Over the elements for which `which` holds; NULL: all.
struct mean mean_of(const struct scene_run *s, bool (*which)(const struct element *));

// make check takes the short way; `make check-radiosity` all of it.
bool in_full(void);

#endif
