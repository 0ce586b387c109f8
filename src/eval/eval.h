#ifndef EVAL_EVAL_H
#define EVAL_EVAL_H

#include <stdbool.h>
#include <stdint.h>

#include "base/diag.h"
#include "eval/value.h"
#include "lang/ast.h"
#include "lang/stream.h"
#include "math/color.h"
#include "math/vec.h"
#include "scene/scene.h"

struct arena;
struct symbol_tables; // eval/symbol.h
struct builder;       // eval/builder.h

// What the caller sets before a scene is evaluated.
struct eval_options {
    const char *const *library_path;
    uint32_t library_path_count;
    const char *const *declare; // "NAME=1.5" or "NAME=\"text\""
    uint32_t declare_count;
    int version; // 100*f from the command line; 0: none
    double clock;
    bool clock_set;
    int image_width, image_height;
    const char *input_name;
    bool output_alpha;
    bool pov_patches; // bicubic patches are the triangles that POV-Ray draws
    uint32_t camera;  // the scene's n-th, and from the first on again; 0: the last
    // Limits for scenes of unknown origin: tokens read, those of loops and macros each
    // time anew, and bytes of all that is kept meanwhile. 0: none.
    uint64_t steps_max;
    size_t memory_max;
    // Text of #debug, #warning and so on; NULL: to stderr.
    void (*message)(void *user, enum word directive, const char *text);
    void *message_user;
    // Sees each statement the grammar hands over, before it is carried out; or NULL.
    void (*statement)(void *user, const struct ast *item);
    void *statement_user;
    // Told now and then what is read; false ends the reading. Or NULL.
    bool (*reading)(void *user, struct span where);
    void *reading_user;
    // The first surface of an object along a unit direction, for trace(); or NULL.
    bool (*trace)(void *user, const struct object *o, struct vec3 from, struct vec3 d,
                  struct vec3 *hit, struct vec3 *normal);
    void *trace_user;
    // Where relative names of files to write go, and where a scene may write; NULL: the
    // working directory.
    const char *output_folder;
    // Names that are handed over at the end if the scene declared them as a number or a
    // string; NULL ends the list.
    const char *const *wanted;
    void (*found)(void *user, const char *name, const char *text);
    void *found_user;
    // Other folders that it may write in.
    const char *const *write_folder;
    uint32_t write_folder_count;
    // The folders that it may read in, or none: anywhere. What it may write, it may read.
    const char *const *read_folder;
    uint32_t read_folder_count;
    // Told of each file that a scene refers to, before it is read; or NULL.
    void (*file_found)(void *user, const char *path);
    void *file_user;
};

// One evaluation of one scene file. Everything that is not in a struct of its own.
struct eval {
    struct arena *arena; // the scene's: values, objects
    struct arena *parse; // scratch until the scene is read
    struct arena *nodes; // the stream's: good as long as the node at hand
    struct source_map *sources;
    struct diag_sink *diags;
    const struct eval_options *options;
    struct symbol_tables *symbols;
    struct calc_table *calcs;
    uint32_t asked; // how often whether to go on
    struct builder *builder;
    struct scene *scene;
    int version; // in force now, 100*f
    bool version_seen;
    uint32_t *random; // streams of seed(), by index
    uint32_t random_count, random_capacity;
    uint32_t depth;                   // nesting of the expression being evaluated
    struct deprecation *deprecations; // names still to be warned of
    char *line[3];                    // of #debug, #render, #statistics: not ended yet
    struct scene_file *files;         // opened by the scene, newest first
    bool file_refused; // the last file looked for is there but may not be read
};

// Parses and evaluates the file into *scene. False when an error was reported.
bool eval_scene(struct arena *arena, struct source_map *sources, uint32_t file,
                struct diag_sink *diags, const struct eval_options *options,
                struct scene *scene);

// Expressions with the language's width rules (spec/language 2.4). Each takes ONE
// expression node. They report and return false when the node is not of the kind.
bool eval_number(struct eval *e, const struct ast *n, int wanted, double out[5],
                 int *width);
bool eval_float(struct eval *e, const struct ast *n, double *out);
bool eval_vec2(struct eval *e, const struct ast *n, struct vec2 *out);
bool eval_vec3(struct eval *e, const struct ast *n, struct vec3 *out);
bool eval_vec4(struct eval *e, const struct ast *n, double out[4]);
// Texts are good as long as the node; whoever keeps one copies it.
bool eval_string(struct eval *e, const struct ast *n, const char **out);
bool eval_path(struct eval *e, const struct ast *n, const char **out); // no escapes

// Whether an item can start a numeric expression / a colour phrase.
bool ast_is_number(const struct ast *n);
bool ast_is_color_start(const struct ast *n);
// Reads a colour phrase (`rgb <1,0,0> filter 0.5`, a colour identifier, a plain
// expression) from the items at *at and advances *at past it. rgb_only: the places
// of spec/language 2.6 that drop filter and transmit.
bool eval_color(struct eval *e, const struct ast **at, bool rgb_only, struct rgbft *out);

// The value of a right side: a list of items as stream_host.declare gets it.
const struct value *eval_rvalue(struct eval *e, const struct ast *items);
// `array [sizes] { elements }`; elements may be NULL.
const struct value *eval_array(struct eval *e, const struct ast *sizes,
                               const struct ast *elements);

#endif
