#ifndef TEST_WORLD_FIXTURE_H
#define TEST_WORLD_FIXTURE_H

#include "plain_textures.h"
#include "test.h"

#include "base/arena.h"
#include "trace/intersect.h"
#include "trace/scratch.h"

// A scene that a test puts together, and what meets it.
struct fixture {
    struct arena *a;
    struct scene scene;
    struct world *w; // from finish() on
    struct trace_scratch *s;
    const struct object *object[512];
};

int setup(void **state);
int teardown(void **state);
void add(struct fixture *f, const struct object *o);
void finish(struct fixture *f);
struct object *sphere_at(struct fixture *f, double x, double y, double z, double r);
struct object *box_of(struct fixture *f, struct vec3 min, struct vec3 max);
struct object *unit_box(struct fixture *f);
struct object *half_space(struct fixture *f, struct vec3 normal, double d);
struct object *csg(struct fixture *f, enum csg_op op, const struct object *x,
                   const struct object *y);
struct object *moved(struct fixture *f, struct object *o, struct transform t);
struct ray_query query(struct vec3 o, struct vec3 d);
double first_t(struct fixture *f, struct vec3 o, struct vec3 d);
struct vec3 first_normal(struct fixture *f, struct vec3 o, struct vec3 d);
double random_unit(uint64_t *s);
double between(uint64_t *s, double lo, double hi);


static const struct vec3 Z = {0, 0, 1}, BACK = {0, 0, -1};

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

#endif
