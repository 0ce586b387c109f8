#ifndef EVAL_BUILD_H
#define EVAL_BUILD_H

#include "base/arena.h"
#include "eval/builder.h"
#include "scene/args.h"
#include "scene/effects.h"

// Private to the builder: the cursor over a block's items, the tables of simple
// items, and one function per family of block.

// A list that grows in the scene arena.
struct pointer_list {
    const void **at;
    uint32_t count, capacity;
};
void pointer_list_add(struct arena *a, struct pointer_list *l, const void *p);

// What `camera` knows beyond struct camera: the order of evaluation needs it.
struct camera_state {
    struct camera camera;
    struct vec3 sky, look_at, focal_point;
    double angle, angle_v;
    bool has_look_at, has_up_right, has_angle, has_angle_v, has_focal_point;
    struct transform transform;
};

// What material { } holds.
struct material {
    struct attached_texture texture, interior_texture;
    const struct interior *interior;
};

struct image_file; // image_source.c

struct builder {
    struct eval *e;
    struct arena *arena;
    const struct pattern_ops *pattern[WORD_COUNT]; // by keyword; NULL: none
    const struct shape_ops *shape[WORD_COUNT];
    const struct texture *default_texture; // plain, one layer
    struct camera_state camera;            // the one in force
    struct camera_state camera_default;
    struct pattern_defaults *pattern_defaults; // filled when parsing ends
    struct pointer_list objects, fogs, rainbows, medias, past_defaults;
    struct pointer_list cameras; // if one of them is to be chosen
    bool gamma_set, noise_set;
    struct image_file *images; // read so far
    void *shared[WORD_COUNT];  // by a shape's keyword: what all shapes of it share
};

// The items of one block, read in order.
struct args {
    struct builder *b;
    const struct ast *at;    // next item; NULL at the end
    const struct ast *owner; // the block, for places
    const char *name;        // its keyword, for messages
    struct args *parent;     // whose `failed` is set too
    bool failed;
    const struct ast *last; // the item taken before `at`; NULL: none
};

struct args args_of(struct builder *b, const struct ast *block, struct args *parent);
struct args args_list(struct builder *b, const struct ast *items, const struct ast *owner,
                      const char *name, struct args *parent);
void args_fail(struct args *a);
// The word of the next item if it is a bare word / a block, else WORD_NONE.
enum word args_at_word(const struct args *a);
enum word args_at_block(const struct args *a);
bool args_take(struct args *a, enum word w); // consumes a bare word
const struct ast *args_next(struct args *a); // consumes anything
const struct value *args_at_value(const struct args *a, enum value_kind kind);
const struct value *args_take_value(struct args *a, enum value_kind kind);
// Reports and passes over an item that has no place here, and what belongs to it.
void args_unknown(struct args *a, const enum word *known, size_t count);
// Says that something else was expected, with a hint for a name that is not declared; false.
bool args_expected(struct args *a, const char *role, const char *type);
void args_skip(struct args *a);      // to the next word or block
void args_not_built(struct args *a); // the next item: one error, passed over
// As args_find_file, but says nothing when there is none.
bool args_look_for_file(struct args *a, const char *name, const char **path);
bool args_color(struct args *a, bool rgb_only, struct rgbft *out);
bool args_rgb(struct args *a, struct rgb *out);
bool args_at_color(struct args *a);
bool args_switch(struct args *a);               // [b = on]
bool args_optional(struct args *a, double *io); // [f = what *io is]
// `message` is a whole sentence fragment; code must have the format "%s: %s".
void args_error(struct args *a, struct span where, const char *message);
void args_warning(struct args *a, struct span where, const char *message);
struct span args_span(const struct args *a); // of the next item or the end

// ---- tables of simple items ------------------------------------------------
enum field_kind {
    FIELD_FLOAT,       // float
    FIELD_DOUBLE,      // double
    FIELD_INT,         // int
    FIELD_NEAREST,     // int, the nearest in the range
    FIELD_SWITCH,      // bool, optional value
    FIELD_FLAG,        // bool, no value
    FIELD_NUMBER_BOOL, // bool, value required
    FIELD_VEC3,
    FIELD_UNIT, // vector; normalised
    FIELD_RGB,
    FIELD_COLOR,
    FIELD_RECIPROCAL, // float, stored as 1/f; 0 stays 0
    FIELD_METALLIC,   // float, optional value, 1
    FIELD_STRING,     // read and dropped
};
struct field {
    enum word word;
    enum field_kind kind;
    size_t offset;
    double min, max; // both 0: any value
};
// If the next item is a word of the table, reads it into *into.
bool fields_read(struct args *a, const struct field *f, size_t n, void *into);
// Reports the next item as unknown; the table's words and `more` are the known ones.
void fields_unknown(struct args *a, const struct field *f, size_t n,
                    const enum word *more, size_t more_count);
#define ARRAY_COUNT(a) (sizeof(a) / sizeof((a)[0]))

// ---- parts -----------------------------------------------------------------
// If the next item is TRANS, reads it; *out is transform_identity after an error.
bool build_trans(struct args *a, struct transform *out);

const struct pigment *build_pigment(struct args *a, const struct ast *block,
                                    const struct pigment *start);
const struct pigment *build_pigment_body(struct args *a, const struct pigment *start);
const struct normal *build_normal(struct args *a, const struct ast *block,
                                  const struct normal *start);
const struct normal *build_normal_body(struct args *a, const struct normal *start);
const struct finish *build_finish(struct args *a, const struct ast *block,
                                  const struct finish *start);
const struct texture *build_texture(struct args *a, const struct ast *block);
const struct texture *build_texture_body(struct args *a);
// bottom + top layers; NULL after an error.
const struct texture *build_layer(struct args *a, struct span where,
                                  const struct texture *bottom,
                                  const struct texture *top);
const struct pigment *build_density(struct args *a, const struct ast *block,
                                    const struct pigment *start);

const struct color_map *build_color_map(struct args *a, const struct ast *block);
const struct pigment_map *build_pigment_map(struct args *a, const struct ast *block,
                                            bool average, bool density);
const struct normal_map *build_normal_map(struct args *a, const struct ast *block,
                                          bool average);
const struct texture_map *build_texture_map(struct args *a, const struct ast *block,
                                            bool average);
const struct slope_map *build_slope_map(struct args *a, const struct ast *block);
const struct color_map *color_map_default(const struct pattern *p);
bool color_map_is_default(const struct color_map *m);

const struct interior *build_interior(struct args *a, const struct ast *block,
                                      const struct interior *start);
const struct media *build_media(struct args *a, const struct ast *block);
struct material build_material(struct args *a, const struct ast *block,
                               struct material start);

struct object *build_object(struct args *a, const struct ast *block);
struct object *build_csg(struct args *a, const struct ast *block);
struct object *build_light(struct args *a, const struct ast *block);
struct object *build_light_group(struct args *a);
void build_modifiers(struct args *a, struct object *o);
void object_move(struct builder *b, struct object *o, const struct transform *t);
// The next item as an object if it is one (a value or a block), consumed.
const struct object *args_object(struct args *a, bool *was_object);
// `object`s then TRANS: looks_like, projected_through, object patterns.
const struct object *build_one_object(struct args *a, const struct ast *block,
                                      const struct transform *before);

bool build_camera(struct args *a, const struct ast *block, struct camera_state *c);
const struct fog *build_fog(struct args *a, const struct ast *block);
const struct rainbow *build_rainbow(struct args *a, const struct ast *block);
const struct sky_sphere *build_sky_sphere(struct args *a, const struct ast *block);
bool build_background(struct args *a, const struct ast *block);
bool build_settings(struct args *a, const struct ast *block);
bool build_photons_settings(struct args *a, const struct ast *block);
// radiosity { importance } of an object or of #default.
double build_importance(struct args *a);
void build_photons(struct args *a, struct object *o); // of an object
bool build_radiosity_settings(struct args *a, const struct ast *block);
bool build_old_setting(struct args *a);
void settings_finish(struct builder *b);

// ---- patterns --------------------------------------------------------------
enum body_kind { BODY_PIGMENT, BODY_NORMAL, BODY_TEXTURE, BODY_DENSITY, BODY_FUNCTION };

// Where pattern items write. One of the three is set;
// none for BODY_FUNCTION.
struct body {
    enum body_kind kind;
    struct pattern *pattern;
    struct pigment *pigment; // density too
    struct normal *normal;
    struct texture *texture;
    bool average, bitmap, list, plain; // what stands in the pattern's place
    bool has_map;
};
// If the next item is a pattern keyword, reads it with its arguments.
bool build_pattern(struct args *a, struct body *body);
// If the next item is a modifier of `pmods`, reads it.
bool build_pattern_modifier(struct args *a, struct body *body);
// When a body is read: reports what its parameters together get wrong.
void pattern_finish(struct args *a, struct pattern *p);
bool build_warp(struct args *a, struct pattern *p); // next item is warp {}
// Fills a pattern from `function { expression }`.
bool build_function_pattern(struct eval *e, const struct ast *block, struct pattern *p);
// image_map, bump_map and image_pattern: the block at hand into the body's pattern.
void build_image_pattern(struct args *a, struct body *body, enum word use);
void build_material_map(struct args *a, struct texture *x);
// The arguments of density_file.
void build_density_file(struct args *a, struct pattern *p);
bool word_is_pattern(const struct builder *b, enum word w);
const enum word *pattern_modifier_words(size_t *count);

#endif
