#ifndef RADIOSITY_FORM_FACTOR_H
#define RADIOSITY_FORM_FACTOR_H

#include "base/watch.h"
#include "radiosity/enclosure.h"

struct form_factor_settings {
    const char *method; // a name of form_factors.def
    int points;         // Gauss points along each side of an element
    double tolerance;   // relative, of pairs close to each other
    int depth;          // how often such an element is quartered at most
    int shadow_rays;    // of a pair, at least
    double visibility;  // error of a factor by what hides it; heavy pairs have more rays
    int rays;           // of an element
    int resolution;     // pixels along a side of the hemicube
    uint32_t seed;
    int threads; // 0: all cores
    struct watch *watch;
};
extern const struct form_factor_settings form_factor_defaults;

enum form_factor_method {
#define FORM_FACTOR(name, pair, row, help) FORM_FACTOR_##name,
#include "radiosity/form_factors.def"
#undef FORM_FACTOR
    FORM_FACTOR_COUNT
};
// FORM_FACTOR_COUNT: no such name.
enum form_factor_method form_factor_find(const char *name);
const char *form_factor_name(enum form_factor_method m);

// What one thread needs.
struct hemicube;
struct node_cache;
struct factor_state {
    const struct enclosure *enclosure;
    const struct form_factor_settings *settings;
    void *of_enclosure;
    struct ray_batch *rays;
    uint8_t *hidden;
    uint32_t *met;
    struct hemicube *hemicube;
    struct node_cache *nodes; // NULL: not used so far
    uint64_t ray_count;
};
struct factor_state *factor_state_new(const struct enclosure *e,
                                      const struct form_factor_settings *s);
void factor_state_free(struct factor_state *s);

typedef double pair_function(struct factor_state *s, uint32_t small, uint32_t big);
typedef void row_function(struct factor_state *s, uint32_t i, float *row);
pair_function factor_analytic, factor_area, factor_disc;
row_function row_hemicube, row_rays, row_sobol;

// A point of the element; of the polygon where the enclosure has no points. False: this
// part of the element does not exist.
bool element_at(const struct factor_state *s, uint32_t element, double u, double v,
                struct element_point *out);
// Unit vector with probability cosine / pi about n.
struct vec3 cosine_direction(struct vec3 n, double u, double v);
// How much of the light between two elements gets through, by shadow rays between points
// of both, weighted by the kernel of the form factor; the larger the factor with nothing
// between, the more rays.
double pair_visibility(struct factor_state *s, uint32_t a, uint32_t b, double factor);
// F from a point to an element with nothing between.
double factor_from_point(struct factor_state *s, const struct element_point *from,
                         uint32_t to);
// F from a curved element to itself.
double factor_self(struct factor_state *s, uint32_t element);
// The kernel cos cos / (pi r^2) of two points; 0 when one does not see the other.
double point_kernel(const struct element_point *a, const struct element_point *b);
// Whether both elements lie wholly behind each other, or in one plane.
bool pair_is_dark(const struct element *a, const struct element *b);
// F from element i to element j, shadows included: by the pair function or, for methods
// that know only rows, by the analytic one.
double pair_factor(struct factor_state *s, uint32_t i, uint32_t j);

// All of them, i to j, into row.
void factor_row(struct factor_state *s, uint32_t i, float *row);

// The dense matrix: f[i * count + j] is F from i to j.
struct factors {
    uint32_t count;
    float *f;
    double row_sum_least, row_sum_most, row_sum_mean; // as computed
    double asymmetry; // greatest |A_i F_ij - A_j F_ji| over the mean area, as computed
    bool symmetric, balanced;
    uint64_t rays;
};
// Bytes a dense matrix takes.
double factors_bytes(uint32_t count);
// False: no memory.
bool factors_compute(struct factors *f, const struct enclosure *e,
                     const struct form_factor_settings *s);
void factors_free(struct factors *f);
// Makes A_i F_ij symmetric by the mean of both.
void factors_symmetrize(struct factors *f, const struct enclosure *e);
// Scales a symmetric matrix from both sides until every row of elements that see
// anything sums to 1 (Sinkhorn 1967); right in closed enclosures only. Returns the
// greatest remaining error of a row.
double factors_balance(struct factors *f, const struct enclosure *e, struct watch *watch);

#endif
