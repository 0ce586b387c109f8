#ifndef RADIOSITY_RADIOSITY_H
#define RADIOSITY_RADIOSITY_H

#include "radiosity/patches.h"
#include "radiosity/solver.h"
#include "trace/indirect.h"

// Emitting elements in the picture: their light by the mesh, or per pixel.
enum emitters { EMITTERS_AUTO, EMITTERS_MESH };
enum { EMITTERS_MOST = 512 }; // that are looked at from each pixel
enum closure { CLOSURE_AUTO, CLOSURE_ENFORCE, CLOSURE_REPORT };

struct radiosity_options {
    struct patch_settings patches;
    struct form_factor_settings factors;
    struct solver_settings solver; // .solver "auto": by size
    double error;                  // wanted relative error; 0: one solution as set
    enum emitters emitters;
    enum closure closure;
    struct watch *watch; // NULL: nobody waits
    uint32_t gather;     // rays of a final gathering per hit; 0: none
    uint32_t lamp_rays;  // points of an element at which lamps are looked at
    double memory;       // bytes that may be taken; 0: half of the machine's
};
extern const struct radiosity_options radiosity_defaults;

// What was done, for reports.
struct radiosity_report {
    uint32_t elements, levels, steps;
    uint64_t rays, links;
    double seconds, bytes;
    double error;  // estimated, relative rms of the reflected light; < 0: not estimated
    double defect; // of the energy identity
    double row_sum_least, row_sum_most, asymmetry;
    bool converged, closed, balanced, loaded;
    const char *solver, *method;
};

// A glowing element, or several in one rectangle of a chart.
struct emitter {
    struct element e;
    struct cell at;
    int side;
    double radius;            // of an element by itself
    bool polygon;             // Lambert's formula of the corners is exact
    double power;             // the area times the greatest channel of what it gives off
    struct rgb color;         // of that: the greatest is 1
    struct shaft shaft;       // where radiosity.shafts
    struct flat_emitter flat; // where radiosity.flat
    uint32_t first_edge;      // of radiosity.edges, of a polygon
};

// Light in the open, where the patches' job has media that scatter (volume.c).
struct volume;
struct radiosity;
void volume_find(struct radiosity *r);
void volume_light(const struct volume *v, struct vec3 p, struct open_light *out);
void volume_free(struct volume *v);

// A job whose patches do not see what is clear all over.
struct clear_world {
    struct job job;
    struct world world;
    struct accel *accel;
    struct world_object *object;
};
// *out, for clear_world_free, is NULL where nothing is clear and the job itself will do.
const struct job *clear_left_out(const struct job *job, struct clear_world **out);
void clear_world_free(struct clear_world *c);

struct radiosity {
    struct clear_world *clear; // NULL, or of the patches' job
    struct patches *patches;
    struct radiosity_solution solution;
    double (*lamps)[3];
    struct radiosity_options settings;
    struct radiosity_report report;
    struct emitter *emitter; // whose light is found per pixel
    uint32_t emitter_count;
    struct polygon_edges edges; // theirs
    bool flat;                  // all of them are, and whole
    bool shafts;                // theirs are known
    uint64_t *between;     // then: the objects (bits) that may hide one from an element
    double (*shown)[3];    // irradiance for the picture, without what emitters give it
    struct volume *volume; // light in the open; NULL: nobody asks
    uint64_t key;          // of the scene as elements and lamps see it
};

// Solves the scene of a job, which must live as long. `saved` (NULL: none) is a file of
// radiosity_save that is used when it belongs to the same scene and settings. NULL: it
// cannot be solved, with the reason in error, or it was cancelled.
struct radiosity *radiosity_new(const struct job *job,
                                const struct radiosity_options *settings,
                                const char *saved, char *error, size_t error_size);
void radiosity_free(struct radiosity *r);

// What the tracer asks.
struct indirect radiosity_indirect(const struct radiosity *r);

// Element values as a polygon file. False: *error says why.
bool radiosity_write_ply(const struct radiosity *r, const char *path, char *error,
                         size_t error_size);
bool radiosity_save(const struct radiosity *r, const char *path, char *error,
                    size_t error_size);
// False: the file cannot be read or belongs to something else.
bool radiosity_load(struct radiosity *r, const char *path, char *error,
                    size_t error_size);
// The radiosity of the element that a hit lies on; black where there is none.
struct rgb radiosity_of_hit(const struct radiosity *r, struct trace_scratch *scratch,
                            const struct ray *ray, const struct hit *hit);

// ---- between the parts ---------------------------------------------------
// Irradiance by lamps and sky at every element.
void lamps_gather(const struct patches *p, uint32_t points, int threads,
                  double (*out)[3]);
// What glows and is lit from per pixel; none where it is too many.
void emitters_find(struct radiosity *r);
void *emitters_begin(const void *data);
void emitters_end(void *state);
// Irradiance of the emitters at a point, of normal n, on an element or ELEMENT_NONE.
struct rgb emitters_light(const struct radiosity *r, void *state, struct tracer *t,
                          struct vec3 o, struct vec3 n, uint32_t element, uint32_t hash);
uint64_t radiosity_key(const struct radiosity *r);
// One solution on the given elements; false: it does not fit, or no memory.
bool radiosity_level(struct radiosity *r, char *error, size_t error_size);
// Solves at rising numbers of elements until the estimated error is met.
bool radiosity_to_error(struct radiosity *r, const struct job *job, char *error,
                        size_t error_size);
// The estimated error of what the elements show, relative rms of the reflected light.
// share: of each element, the square of what it is off times its area; 0 where none of
// the few points lay on it.
double radiosity_probe(struct radiosity *r, double *share);
void radiosity_level_free(struct radiosity *r);

#endif
