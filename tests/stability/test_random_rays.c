// Every shape of shapes.def on random and on awkward rays, at sizes from 1e-6 to 1e6 and
// moved by a million times its size: crossings alternate, the state between them is what
// `inside` says, and each lies where bisection on `inside` finds the surface. A shape
// without a sample fails. LAMBERT_ROUNDS: rays a shape (make check-long: 10,000).
#include "test.h"

#include <stdlib.h>

#include "loaded.h"
#include "math/gamma.h"
#include "samples.h"
#include "scene/shape.h"
#include "trace/scratch.h"

static bool can_try(const char *text)
{
    if (strncmp(text, "text", 4) != 0 || font_file())
        return true;
    print_message("not tried, for want of a font: %s\n", text);
    return false;
}

static int rounds(int otherwise)
{
    const char *v = getenv("LAMBERT_ROUNDS");
    return v ? atoi(v) : otherwise;
}

static double unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*s >> 33) + .5) / 2147483648.;
}

static struct vec3 in_cube(uint64_t *s)
{
    const double x = unit(s), y = unit(s), z = unit(s);
    return vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

struct place {
    double size, moved; // the offset in sizes
};
static const struct place places[] = {
    {1, 0}, {1e-6, 0}, {1e6, 0}, {1, 1e6}, {1e-6, 1e6}, {1e6, 1e6},
};
enum { PLACES = sizeof places / sizeof places[0] };

// ---- rays ---------------------------------------------------------------------------

enum kind { RANDOM, GRID, CENTRE, LEANING, TANGENT, CHORD, POLE, KINDS };

// What the last ray met, for those that touch it and that go through two of its points; and
// where apexes, poles and edges lie: the corners of the bounds and what is between them.
struct last {
    bool met, bounded;
    struct vec3 p[2], n, centre, half;
};

static struct vec3 axis_of(int k) { return vec3(k == 0, k == 1, k == 2); }

static double quarter(uint64_t *s) { return .25 * floor(10 * unit(s) - 5); }

// An apex, a pole, the middle of an edge or face, a corner.
static struct vec3 pole(const struct last *last, uint64_t *s)
{
    const double x = floor(3 * unit(s)) - 1, y = floor(3 * unit(s)) - 1,
                 z = floor(3 * unit(s)) - 1;
    return vec3_add(last->centre, vec3_mul(vec3(x, y, z), last->half));
}

// In units of the size, about the origin.
static struct ray unit_ray(enum kind kind, const struct last *last, uint64_t *s)
{
    struct vec3 through = vec3_scale(1.2, in_cube(s)), d = in_cube(s);
    const struct vec3 axis = axis_of((int)(3 * unit(s)));
    if (kind == GRID) {
        through = vec3(quarter(s), quarter(s), quarter(s));
        d = axis;
    } else if (kind == CENTRE) {
        through = unit(s) < .5 ? vec3(0, 0, 0) : axis_of((int)(3 * unit(s)));
        d = unit(s) < .3 ? axis : d;
    } else if (kind == LEANING) {
        d = vec3_mad(axis, pow(10, -2 - 16 * unit(s)), d);
    } else if (kind == TANGENT && last->met) {
        through = vec3_mad(last->p[0], pow(10, -6 - 10 * unit(s)), in_cube(s));
        d = vec3_cross(last->n, d);
    } else if (kind == CHORD && last->met) {
        through = last->p[0];
        d = vec3_sub(last->p[1], last->p[0]);
    } else if (kind == POLE && last->bounded) {
        through = pole(last, s);
        const double way = unit(s);
        d = way < .3 ? axis : way < .7 ? vec3_sub(pole(last, s), through) : d;
    }
    d = vec3_normalize(d);
    if (!(vec3_dot(d, d) > .5))
        d = axis;
    return (struct ray){vec3_mad(through, -5, d), d, -HUGE_VAL, HUGE_VAL};
}

static struct vec3 offset_of(const struct place *g)
{
    return vec3_scale(g->size * g->moved, vec3(1, -.7, .3));
}

static struct ray placed(const struct ray *r, const struct place *g)
{
    return (struct ray){vec3_mad(offset_of(g), g->size, r->o), r->d, -HUGE_VAL, HUGE_VAL};
}

// ---- judging ------------------------------------------------------------------------

struct trial {
    struct loaded l;
    const struct leaf *leaf;
    const struct place *place;
    struct ray ray;
    struct boundary_list list;
    double size; // of the coordinates
};

static bool is_turned(const struct trial *v)
{
    const char *word = v->leaf->ops->keyword;
    return strcmp(word, "lathe") == 0 || strcmp(word, "sor") == 0;
}

// Where a lathe or a sor has a rim at the height of a nearly horizontal line, the line is
// taken as horizontal (FLAT in scene/shapes/revolve.c): off by its slope times the radius.
static double taken_as_flat(const struct trial *v)
{
    const double slope = fabs(v->ray.d.y);
    return is_turned(v) && slope < 0x1p-23 ? 2 * slope * v->place->size : 0;
}

// A line that touches a turned segment from inside: its polynomial is that of the squared
// distance times the squared slope, and loses so many digits of what tells twins apart.
static double lost_in_slope(const struct trial *v)
{
    const double slope2 = v->ray.d.y * v->ray.d.y;
    return is_turned(v) && slope2 > 0x1p-28 ? GAMMA(8) * v->place->size / slope2 : 0;
}

// How far the point at t may be off for the rounding of o + t d, its way into shape space
// and the shape's parameters, which were moved there.
static double rounding(const struct trial *v, double t)
{
    return GAMMA(40) * (v->size + fabs(t)) + taken_as_flat(v);
}

static bool inside_at(const struct trial *v, struct vec3 p)
{
    return world_object_inside(v->l.world, 0, p);
}

static bool is_state_near(const struct trial *v, double t, bool want, double more)
{
    const struct vec3 p = ray_at(&v->ray, t);
    for (int k = 0; k < 27; k++) {
        const struct vec3 by =
            vec3((k + 1) % 3 - 1, (k / 3 + 1) % 3 - 1, (k / 9 + 1) % 3 - 1);
        if (inside_at(v, vec3_mad(p, rounding(v, t) + more, by)) == want)
            return true;
    }
    return false;
}

// Within the rounding of the surface, as along a face that the ray runs in.
static bool is_in_doubt(const struct trial *v, double t)
{
    return is_state_near(v, t, true, 0) && is_state_near(v, t, false, 0);
}

// The change of t that takes a point over its own rounding, at a crossing.
static double slack(const struct trial *v, uint32_t i)
{
    const struct boundary *b = &v->list.at[i];
    struct interaction at;
    const struct hit h = {*b};
    trace_interaction(v->l.world, &v->ray, &h, &at);
    return rounding(v, b->t) / fmax(fabs(vec3_dot(at.ng, v->ray.d)), GAMMA(12));
}

static bool state_after(const struct trial *v, uint32_t i)
{
    return i ? v->list.at[i - 1].crossing == CROSS_ENTER
             : v->list.at[0].crossing == CROSS_EXIT;
}

static double reach_of(const struct trial *v) { return 12 * v->place->size; }

// No further from the origin than that: beyond, coordinates have no digits left.
static double in_reach(const struct trial *v, double t)
{
    return fmin(fmax(t, -reach_of(v)), 2 * reach_of(v));
}

static double stretch_begin(const struct trial *v, uint32_t i)
{
    return in_reach(v, i ? v->list.at[i - 1].t : v->list.at[0].t - reach_of(v));
}

static double stretch_end(const struct trial *v, uint32_t i)
{
    const uint32_t last = v->list.count - 1;
    return in_reach(v, i <= last ? v->list.at[i].t : v->list.at[last].t + reach_of(v));
}

static double margin_at(const struct trial *v, uint32_t i)
{
    return v->list.at[i].dt + slack(v, i);
}

static const char *fault_of_states(const struct trial *v, double *where)
{
    for (uint32_t i = 0; i <= v->list.count; i++) {
        const double begin = stretch_begin(v, i) + (i ? margin_at(v, i - 1) : 0);
        const double end = stretch_end(v, i) - (i < v->list.count ? margin_at(v, i) : 0);
        for (int k = 1; begin < end && k < 8; k++) {
            *where = begin + (end - begin) * k / 8;
            if (!is_state_near(v, *where, state_after(v, i), lost_in_slope(v)))
                return state_after(v, i) ? "outside where it should be inside"
                                         : "inside where it should be outside";
        }
    }
    return NULL;
}

// Bisection on `inside`, between the middles of the stretches before and after at most.
static const char *fault_of_places(const struct trial *v, double *where)
{
    for (uint32_t i = 0; i < v->list.count; i++) {
        const double t = v->list.at[i].t, near_by = 0x1p20 * margin_at(v, i);
        if (t != in_reach(v, t))
            continue;
        double a = fmax(t - near_by, (stretch_begin(v, i) + stretch_end(v, i)) / 2);
        double b =
            fmin(t + near_by, (stretch_begin(v, i + 1) + stretch_end(v, i + 1)) / 2);
        const bool before = state_after(v, i);
        if (inside_at(v, ray_at(&v->ray, a)) != before ||
            inside_at(v, ray_at(&v->ray, b)) == before)
            continue; // thinner than the rounding, or fault_of_states has said so
        for (int k = 0; k < 80; k++) {
            const double mid = (a + b) / 2;
            *(inside_at(v, ray_at(&v->ray, mid)) == before ? &a : &b) = mid;
        }
        *where = a;
        if (!(fabs(a - t) <= margin_at(v, i)) && !is_in_doubt(v, (a + t) / 2))
            return "a crossing is not where bisection finds it";
    }
    return NULL;
}

// The point of the surface that a crossing names lies on the ray.
static const char *fault_of_points(const struct trial *v, double *where)
{
    for (uint32_t i = 0; i < v->list.count; i++) {
        const struct hit h = {v->list.at[i]};
        struct interaction at;
        trace_interaction(v->l.world, &v->ray, &h, &at);
        *where = h.b.t;
        const double off = vec3_length(vec3_sub(at.p, ray_at(&v->ray, h.b.t)));
        if (!(off <= h.b.dt + 4 * rounding(v, h.b.t)))
            return "the surface is elsewhere";
        if (!(fabs(vec3_length(at.ng) - 1) < 1e-12))
            return "the normal is not of unit length";
    }
    return NULL;
}

// Not at the middle itself, where a ray to the centre may meet a single point.
static const char *fault_of_a_miss(const struct trial *v, double *where)
{
    for (int k = 0; k < 40; k++) {
        *where = (3 + .1 * (k + .37)) * v->place->size;
        if (!is_state_near(v, *where, false, 0))
            return "inside, but nothing is met";
    }
    return NULL;
}

static const char *fault(const struct trial *v, double *where)
{
    const bool solid = v->leaf->solid;
    for (uint32_t i = 0; i < v->list.count; i++) {
        const struct boundary *b = &v->list.at[i];
        *where = b->t;
        if (!isfinite(b->t) || !(b->dt >= 0) || !isfinite(b->dt))
            return "not finite";
        if (i && b->t < b[-1].t)
            return "not ascending";
        if ((b->crossing == CROSS_TOUCH) == solid ||
            (solid && i && b->crossing == b[-1].crossing))
            return "not alternating";
    }
    const char *why = fault_of_points(v, where);
    if (!solid || why)
        return why;
    if (v->list.count == 0)
        return v->leaf->ops->flags & SHAPE_BOUNDED ? fault_of_a_miss(v, where) : NULL;
    why = fault_of_states(v, where);
    return why ? why : fault_of_places(v, where);
}

static void remember(struct last *last, const struct trial *v, uint64_t *s)
{
    const uint32_t i = (uint32_t)(unit(s) * v->list.count);
    last->met = i < v->list.count && v->list.at[i].t == in_reach(v, v->list.at[i].t);
    if (!last->met)
        return;
    const struct hit h = {v->list.at[i]};
    struct interaction at;
    trace_interaction(v->l.world, &v->ray, &h, &at);
    last->p[1] = last->p[0];
    last->p[0] = vec3_scale(1 / v->place->size, vec3_sub(at.p, offset_of(v->place)));
    last->n = at.ng;
}

static void print_fault(const struct trial *v, const char *text, int ray, const char *why,
                        double where)
{
    print_error("%.50s at size %g moved %g, ray %d <%.17g, %.17g, %.17g> -> <%.17g, "
                "%.17g, %.17g>: %s at %.17g\n",
                text, v->place->size, v->place->moved, ray, v->ray.o.x, v->ray.o.y,
                v->ray.o.z, v->ray.d.x, v->ray.d.y, v->ray.d.z, why, where);
    for (uint32_t k = 0; k < v->list.count; k++)
        print_error("  t %.17g +- %g, %d\n", v->list.at[k].t, v->list.at[k].dt,
                    v->list.at[k].crossing);
}

static void load_sample(struct loaded *l, const char *text, const struct place *g)
{
    const struct vec3 o = offset_of(g);
    load(l,
         "#declare K = %.17g; #declare FONT = \"%s\";\n"
         "%s translate <%.17g, %.17g, %.17g> }\n",
         g->size, font_file() ? font_file() : "", text, o.x, o.y, o.z);
}

// To a grid, which takes the padding of bounds away again.
static struct vec3 rounded(struct vec3 v)
{
    return vec3_scale(
        0x1p-30, vec3(round(0x1p30 * v.x), round(0x1p30 * v.y), round(0x1p30 * v.z)));
}

static struct last last_of(const struct trial *v)
{
    const struct aabb b = v->leaf->bounds;
    const struct vec3 o = offset_of(v->place);
    const double scale = .5 / v->place->size;
    return (struct last){.bounded = aabb_is_finite(b) && !aabb_is_empty(b),
                         .centre = rounded(vec3_scale(
                             scale, vec3_add(vec3_sub(b.min, o), vec3_sub(b.max, o)))),
                         .half = rounded(vec3_scale(scale, vec3_sub(b.max, b.min)))};
}

static bool is_sound(const char *text, const struct place *g, int rays, int *met)
{
    struct trial v = {.place = g};
    load_sample(&v.l, text, g);
    v.leaf = &v.l.world->leaf[0];
    v.size = g->size * (8 + fabs(g->moved));
    struct last last = last_of(&v);
    uint64_t s = 4711;
    bool sound = true;
    for (int i = 0; i < rays && sound; i++) {
        const struct ray r = unit_ray((enum kind)(i % KINDS), &last, &s);
        v.ray = placed(&r, g);
        v.list.count = 0;
        leaf_crossings(v.l.world, 0, &v.ray, &v.list);
        double where = 0;
        const char *why = fault(&v, &where);
        if (why) {
            print_fault(&v, text, i, why, where);
            sound = false;
        }
        *met += v.list.count > 0;
        remember(&last, &v, &s);
    }
    boundary_list_free(&v.list);
    unload(&v.l);
    return sound;
}

static void every_shape_has_a_sample(void **state)
{
    (void)state;
    for (size_t i = 0; i < shape_count; i++) {
        const size_t n = strlen(shape_table[i]->keyword);
        bool found = false;
        for (int k = 0; k < SAMPLES; k++)
            found |= strncmp(samples[k], shape_table[i]->keyword, n) == 0 &&
                     samples[k][n] == ' ';
        if (!found)
            fail_msg("shapes.def has '%s', this test has no sample of it",
                     shape_table[i]->keyword);
    }
}

static void crossings_lie_on_the_surface(void **state)
{
    (void)state;
    const int rays = rounds(300) / PLACES + 1;
    int failed = 0;
    for (int i = 0; i < SAMPLES; i++) {
        int met = 0;
        for (int k = 0; can_try(samples[i]) && k < PLACES; k++)
            failed += !is_sound(samples[i], &places[k], rays, &met);
        if (can_try(samples[i]) && met == 0)
            fail_msg("no ray meets %s }", samples[i]);
    }
    assert_int_equal(failed, 0);
}

static void degenerate_shapes_are_sound(void **state)
{
    (void)state;
    const int rays = rounds(140) / PLACES + 1;
    int failed = 0, met = 0;
    for (int i = 0; i < DEGENERATE; i++)
        for (int k = 0; can_try(degenerate[i]) && k < PLACES; k++)
            failed += !is_sound(degenerate[i], &places[k], rays, &met);
    assert_int_equal(failed, 0);
    assert_true(met > 0);
}

// A line leaves by the side that it nears by 2e-13 of its way, though it is steep in the space of
// a field that was made thin.
static void thin_fields_end_at_their_sides(void **state)
{
    (void)state;
    struct loaded l;
    struct boundary_list list = {0};
    const double drift = 0x1p-42, side = 5.5;
    const struct ray ray = {
        {1 - side * drift, .6, -5}, {drift, -.2, 1}, -HUGE_VAL, HUGE_VAL};
    load(&l, "height_field { function 9, 9 { .5 + .4*sin(9*x) } scale <1, 1e-5, 1> }\n");
    leaf_crossings(l.world, 0, &ray, &list);
    assert_int_equal(list.count, 2);
    assert_float_equal(list.at[0].t, 5, 1e-12);
    assert_float_equal(list.at[1].t, side, 4 * ROUNDOFF / drift);
    boundary_list_free(&list);
    unload(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape_has_a_sample),
        cmocka_unit_test(crossings_lie_on_the_surface),
        cmocka_unit_test(degenerate_shapes_are_sound),
        cmocka_unit_test(thin_fields_end_at_their_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
