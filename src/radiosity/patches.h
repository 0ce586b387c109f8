#ifndef RADIOSITY_PATCHES_H
#define RADIOSITY_PATCHES_H

#include "base/watch.h"
#include "radiosity/chart.h"
#include "radiosity/enclosure.h"
#include "radiosity/sight_kernel.h"
#include "trace/job.h"

struct interaction;
struct tracer;

// The elements of a scene: cells of charts on the exact surfaces. A point belongs to an
// element when a ray finds it on the scene's surface and the space before it is one that
// light can be in.
struct patch_settings {
    double size;  // longest side of a cell; 0: from `count`
    double count; // elements wanted, about
    int samples;  // along a side of a cell, for area and colour
    int depth;    // how often cells that exist in part are quartered
    bool trial;   // only to know how many there are: what is hard to reach may be missed
    int threads;
    struct watch *watch;
};
extern const struct patch_settings patch_defaults;

// A rectangle of a chart's square.
struct cell {
    double u, v, du, dv;
    uint32_t chart;
    uint32_t child;      // first of four; 0: none
    uint32_t part;       // first of two of the same place, a wall between; 0: none
    uint32_t anchor;     // of such a part; 0: none
    uint32_t from;       // while elements are refined: which of the quartered cells
    bool twin;           // what the anchor does not see
    uint8_t dead;        // bit: no element may be on this side
    uint32_t element[2]; // on the outer and inner side; ELEMENT_NONE: none
};

// A cell that a wall stands on is parted by what a point above it sees, and what it does
// not: by side; n is the normal there, 0 where the side is whole.
struct anchor {
    struct vec3 o[2], n[2];
};

// The hulls that hold an object together. None: it has no end.
enum { HULLS_MOST = 4 };
struct shaft_hulls {
    uint32_t count;
    struct shaft_hull hull[HULLS_MOST];
};

struct patches {
    const struct job *job;
    struct patch_settings settings;
    struct chart *chart;
    uint32_t chart_count;
    uint32_t *leaf_first; // charts of leaf l: leaf_first[l] up to leaf_first[l + 1]
    struct cell *cell;
    uint32_t cell_count, cell_capacity;
    struct anchor *anchor; // from 1
    uint32_t anchor_count, anchor_capacity;
    struct element *element;
    uint32_t *element_cell; // cell of an element; the side is the lowest bit
    uint16_t *neighbours;   // bit k: neighbour k is seen; bit 8 + k: its second part
    uint32_t element_count, element_capacity;
    uint32_t *room; // objects in which light can be
    uint32_t room_count;
    const struct sight_kernels *sight;
    struct shaft *shaft;       // NULL: too many objects
    struct shaft_boxes boxes;  // of the objects, where there are shafts
    struct shaft_hulls *hulls; // of the objects, where there are shafts
    double size;               // of cells
    struct vec3 around[12]; // corners of all objects, and where rays of the camera start
    uint32_t around_count;  // 0: not known
    struct enclosure enclosure;
};

// NULL: the scene has no surface that could take part.
struct patches *patches_build(const struct job *job, const struct patch_settings *s);
void patches_free(struct patches *p);

// Quarters the cells of elements; both sides of a cell go together. Elements change their
// numbers: returns of each the number of the one that was there before. The caller frees
// it.
uint32_t *patches_refine(struct patches *p, const bool *split);

// The element a ray ran into; ELEMENT_NONE: none.
uint32_t patch_of_hit(const struct patches *p, struct trace_scratch *scratch,
                      const struct ray *ray, const struct hit *hit);
// Elements around a hit and how much each counts there (bilinear within one chart, none
// that the hit's own element does not see). met: trace_interaction of the hit. Returns how
// many, at most 4; 0: no element.
uint32_t patch_around(const struct patches *p, struct trace_scratch *scratch,
                      const struct ray *ray, const struct hit *hit,
                      const struct interaction *met, uint32_t element[4],
                      double weight[4]);

// The point at (u, v) of the square of a cell's side, uniform in area on planar ones; that
// side exists in part or as a whole. False: this part of it does not.
bool patch_cell_point(const struct patches *p, struct trace_scratch *scratch,
                      const struct cell *c, int side, bool partial, double u, double v,
                      struct element_point *out);

// The neighbour of an element in direction k, 0 to 7; ELEMENT_NONE: none that it sees.
uint32_t patch_neighbour(const struct patches *p, uint32_t element, int k);

// ---- between the parts ---------------------------------------------------
// Whether the element's point at (u, v) of its cell's square exists, and where.
struct patch_probe {
    struct trace_scratch *scratch;
    const struct patches *p;
};
bool patch_point(const struct patch_probe *probe, const struct cell *c, int side,
                 double u, double v, struct element_point *out, struct hit *hit,
                 struct ray *ray);
// Its two halves: the ray that looks for the point, and the point where that was met.
// Which side of a wall on the cell it lies on is not asked.
bool patch_aim(const struct patches *p, const struct cell *c, int side, double u,
               double v, struct element_point *out, struct ray *ray);
bool patch_met(const struct patches *p, const struct cell *c, const struct ray *ray,
               const struct hit *hit, struct element_point *out);
// The charts of a scene's surfaces, measured and not yet cut.
struct patches *patches_charts(const struct job *job, const struct patch_settings *s);
// Cells along u and v of a chart's square so that none is longer than the size.
void patches_grid(const struct chart *c, double size, uint32_t grid[2]);
// Cuts the charts into cells no longer than the size, and those into elements. NULL, and p
// is freed: there is nothing to cut.
struct patches *patches_cut(struct patches *p, double size);
// Both, by s->size, or where that is 0 by the area of s->count squares.
struct patches *patches_cut_by(const struct job *job, const struct patch_settings *s);
// As many elements as s->count, about.
struct patches *patches_counted(const struct job *job, const struct patch_settings *s);
// Finds the objects inside of which light can be: where the camera or a lamp is, and around
// what glows.
void patches_find_rooms(struct patches *p);
// Whether a point lies in no other objects than those.
bool patches_in_room(const struct patches *p, struct vec3 at);
// Room for more cells, at the end of the list; pointers to others are void.
struct cell *cells_add(struct patches *p, uint32_t count);
// Whether the anchor sees a point of its cell.
bool anchor_sees(const struct patches *p, struct trace_scratch *scratch, uint32_t anchor,
                 int side, struct vec3 at);
// Makes elements of the cells, and quarters and parts cells where that is needed; of
// those from `first` on.
void elements_find(struct patches *p);
void elements_add(struct patches *p, uint32_t first);
void cell_split(struct patches *p, uint32_t index);
// What elements have of each other; anew after their number has changed.
void patches_connect(struct patches *p);
// Reflectance and emission at a hit, as the picture has them.
void patch_color(struct tracer *t, const struct ray *ray, const struct hit *hit,
                 struct rgb *reflectance, struct rgb *emission);
void patches_enclosure(struct patches *p);
void patches_neighbours(struct patches *p);
void patches_shafts(struct patches *p);
// Whether the corners of an element bound all of it.
bool patch_is_flat(const struct patches *p, const struct element *e);
bool patches_may_hide(const struct patches *p, uint32_t a, uint32_t b);
// The same for what is no element of the list; not beyond SHAFT_OBJECTS objects.
struct shaft patches_shaft(const struct patches *p, const struct element *e,
                           const struct cell *c);
// Which of `some` objects (bits) may hide part of one from the other.
uint64_t shafts_hide(const struct patches *p, const struct shaft *a,
                     const struct shaft *b, uint64_t some);
// Those of `some` that may hide what of a flat polygon rises above the horizon of a point.
uint64_t hulls_hide(const struct patches *p, struct vec3 o, struct vec3 n,
                    const struct element *polygon, uint64_t some);
// The same of one flat element from another.
uint64_t hulls_hide_all(const struct patches *p, const struct element *a,
                        const struct element *b, uint64_t some);
// Of a world's objects; the caller frees them.
struct shaft_hulls *hulls_of(const struct world *w);
// Whether the boxes and the hollows are the same.
bool shaft_equals(const struct shaft *a, const struct shaft *b);
// Whether a point lies in the box, up to rounding.
bool shaft_holds(const struct shaft *s, struct vec3 at);
// Drops elements that no light can reach on its way to the camera.
void patches_prune(struct patches *p);

#endif
