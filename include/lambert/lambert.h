#ifndef LAMBERT_LAMBERT_H
#define LAMBERT_LAMBERT_H

// The public interface of the lambert ray tracer: read a scene, trace it, write the
// picture. Nothing is global: contexts know nothing of each other, and each may be
// used by one thread at a time. Strings a function returns live as long as its handle.

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LAMBERT_API __attribute__((visibility("default")))

enum lambert_status {
    LAMBERT_OK,
    LAMBERT_ERROR_SCENE,    // the scene has errors; messages were given
    LAMBERT_ERROR_OPTION,   // no such option, or a value it does not take
    LAMBERT_ERROR_INPUT,    // a file cannot be read
    LAMBERT_ERROR_OUTPUT,   // a file cannot be written
    LAMBERT_ERROR_ARGUMENT, // the call made no sense, e.g. render before load
    LAMBERT_ERROR_MEMORY,
    LAMBERT_CANCELLED, // stopped on request; the picture is there, in part
};

LAMBERT_API const char *lambert_version(void);

// Reading, building and rendering need a deep stack, and make a thread that has one each time
// they are called. Within `fn`, which runs on such a thread while the caller's runs
// `meanwhile` (NULL: it waits; not called when the system refuses the thread), they do not.
LAMBERT_API void lambert_run_deep(void (*fn)(void *user), void (*meanwhile)(void *user),
                                  void *user);

// --- Contexts -------------------------------------------------------------

struct lambert_context;
LAMBERT_API struct lambert_context *lambert_context_new(void); // NULL: no memory
// Forgets the scene that is loaded, too; images live on. NULL is no context.
LAMBERT_API void lambert_context_free(struct lambert_context *ctx);
// What went wrong in the last call that did not return LAMBERT_OK.
LAMBERT_API const char *lambert_error(const struct lambert_context *ctx);

// --- Options --------------------------------------------------------------
// Every setting has a long name, and most have the name of a POV-Ray switch and INI
// keyword. The table behind these functions is the only list of them.

enum lambert_option_kind {
    LAMBERT_OPTION_FLAG, // on or off
    LAMBERT_OPTION_INT,
    LAMBERT_OPTION_FLOAT,
    LAMBERT_OPTION_STRING,
    LAMBERT_OPTION_FILE,
    LAMBERT_OPTION_CHOICE, // one of the words of `choices`, separated by '|'
    LAMBERT_OPTION_LIST,   // strings; setting it adds one
    LAMBERT_OPTION_ACTION, // the command's own: does something and is done
};

struct lambert_option {
    const char *name;    // "width"
    const char *letter;  // "o": also given as -o; or NULL
    const char *pov;     // "W": POV-Ray's switch, or NULL
    const char *keyword; // "Width": INI keyword, or NULL
    // +SWITCH turns this option on, -SWITCH off, besides setting the value; or NULL
    const char *turns;
    enum lambert_option_kind kind;
    const char *value; // its name in help texts, or NULL
    const char *choices;
    const char *initial; // NULL: none
    double min, max;     // of numbers
    const char *group;
    const char *help; // one line; "" for an option that is taken and does nothing
};

LAMBERT_API size_t lambert_option_count(void);
LAMBERT_API const struct lambert_option *lambert_option_at(size_t i);
LAMBERT_API const struct lambert_option *lambert_option_find(const char *name);
// The name a mistyped one was likely meant to be, or NULL.
LAMBERT_API const char *lambert_option_suggest(const char *name);
// The same of INI keywords, whose case does not matter.
LAMBERT_API const char *lambert_keyword_suggest(const char *keyword);

// Sets an option, or adds to a list, by its long name ("width"). LAMBERT_ERROR_OPTION: there
// is none of that name, or it does not take the value. A flag is on for "on", "true", "yes"
// and "1" (and what begins so), else off.
LAMBERT_API enum lambert_status lambert_option_set(struct lambert_context *ctx,
                                                   const char *name, const char *value);
// Whether it was set so, and has not just its initial value or one that the scene asks for.
LAMBERT_API bool lambert_option_is_set(const struct lambert_context *ctx,
                                       const char *name);
// The value as it counts now: set, else the scene's, else initial. Flags are 0 or 1; 0 and
// NULL also where there is none.
LAMBERT_API double lambert_option_number(const struct lambert_context *ctx,
                                         const char *name);
LAMBERT_API const char *lambert_option_text(const struct lambert_context *ctx,
                                            const char *name);
// *values: what a list holds, in the order it was added. Returns how many.
LAMBERT_API size_t lambert_option_list(const struct lambert_context *ctx,
                                       const char *name, const char *const **values);

// --- Messages and progress ------------------------------------------------

enum lambert_message_kind {
    LAMBERT_NOTE,
    LAMBERT_WARNING,
    LAMBERT_ERROR,
    LAMBERT_SCENE_TEXT, // #debug, #render, #statistics of the scene
};

struct lambert_message {
    enum lambert_message_kind kind;
    int code;                          // E0107 is 107; 0: none
    const char *file;                  // NULL: no place
    unsigned line, column, end_column; // from 1
    const char *text;
    const char *hint;     // NULL, or what to do
    const char *rendered; // the whole message in the style of option `diagnostics`
};
// Without a function messages are dropped.
typedef void (*lambert_message_fn)(void *user, const struct lambert_message *message);
LAMBERT_API void lambert_set_message_function(struct lambert_context *ctx,
                                              lambert_message_fn fn, void *user);

// Called after each finished tile, from the thread that did it, never twice at once; while
// radiosity is solved, whenever it is a little further (thousandths); while a scene is read,
// some times a second (lines of its own text: loops, macros and includes stay at theirs).
// Returning false cancels.
typedef bool (*lambert_progress_fn)(void *user, uint32_t done, uint32_t total);
LAMBERT_API void lambert_set_progress_function(struct lambert_context *ctx,
                                               lambert_progress_fn fn, void *user);
// What `done` and `total` count in such a call.
enum lambert_phase {
    LAMBERT_PHASE_TILES,
    LAMBERT_PHASE_RADIOSITY,
    LAMBERT_PHASE_READING,
};
LAMBERT_API enum lambert_phase lambert_progress_phase(const struct lambert_context *ctx);
// Stops lambert_load_file after the statement, and lambert_render after the tiles or the
// piece of radiosity in hand. May be called from any thread and from a signal handler.
LAMBERT_API void lambert_cancel(struct lambert_context *ctx);

// --- Rendering ------------------------------------------------------------

// Reads a scene file ("-" is standard input) in place of any earlier one, with the
// options as they are now. LAMBERT_ERROR_INPUT: it cannot be read; LAMBERT_ERROR_SCENE: it
// has errors, which messages told.
LAMBERT_API enum lambert_status lambert_load_file(struct lambert_context *ctx,
                                                  const char *path);

// Reads a scene file and evaluates it, without making anything that can be traced.
LAMBERT_API enum lambert_status lambert_check_file(struct lambert_context *ctx,
                                                   const char *path);
// Writes the file with its lines indented anew and every token, comment and line end
// kept.
LAMBERT_API enum lambert_status lambert_format_file(struct lambert_context *ctx,
                                                    const char *path, FILE *out);

// The file an interrupted render leaves its finished tiles in, removed when the whole picture
// has been written; NULL: none. To be set before loading. With option `save-state` or
// `continue` tiles are written as they are finished; with `continue` those that an interrupted
// render of the same scene and settings left are taken over.
LAMBERT_API void lambert_set_state_file(struct lambert_context *ctx, const char *path);

struct lambert_image;
// Traces what was loaded. *out is new, also after LAMBERT_CANCELLED; else NULL.
LAMBERT_API enum lambert_status lambert_render(struct lambert_context *ctx,
                                               struct lambert_image **out);

// Of the last scene that was loaded, and of the last picture of it.
struct lambert_stats {
    double parse_seconds, build_seconds, trace_seconds, write_seconds; // by the clock
    double trace_cpu_seconds; // of all threads, while tracing
    uint64_t pixels, samples; // finished pixels, and rays from the camera
    uint64_t rays, shadow_rays;
    uint64_t node_visits, leaf_tests, csg_tests; // of trees of boxes, shapes, CSG objects
    uint64_t function_evaluations;               // to find surfaces given by functions
    uint32_t tiles_done, tiles_total;
    uint32_t objects, leaves, lights; // leaves: shapes, those inside of CSG counted
    uint64_t memory_peak;             // bytes, of the whole process
    unsigned errors, warnings;        // of messages about the scene
};
LAMBERT_API void lambert_get_stats(const struct lambert_context *ctx,
                                   struct lambert_stats *out);

// --- Meshes -----------------------------------------------------------------

struct lambert_mesh_stats {
    uint32_t objects;  // all but lights
    uint32_t left_out; // no end, finer than a cell, or a sheet that is not exported
    uint64_t vertices, triangles;
};
// Writes the objects of what was loaded as triangle meshes, one for each object: closed,
// 2-manifold and turned outward (by the right-hand rule in the scene's coordinates) for
// solids. The name says the format: .obj, .stl or .ply (the last two binary). Options
// `mesh-resolution` and `mesh-sharp` count. LAMBERT_ERROR_OPTION: another name;
// LAMBERT_ERROR_SCENE: no object can be made a mesh. An older file stays whole when this
// fails.
LAMBERT_API enum lambert_status lambert_mesh_write(struct lambert_context *ctx,
                                                   const char *path,
                                                   struct lambert_mesh_stats *out);

// For those who work on lambert: what a stage makes of the file.
LAMBERT_API enum lambert_status lambert_dump_tokens(struct lambert_context *ctx,
                                                    const char *path, FILE *out);
LAMBERT_API enum lambert_status lambert_dump_ast(struct lambert_context *ctx,
                                                 const char *path, FILE *out);
LAMBERT_API enum lambert_status lambert_dump_csg(struct lambert_context *ctx,
                                                 const char *path, FILE *out);

// --- Pictures -------------------------------------------------------------

LAMBERT_API void lambert_image_free(struct lambert_image *image);
LAMBERT_API int lambert_image_width(const struct lambert_image *image);
LAMBERT_API int lambert_image_height(const struct lambert_image *image);
LAMBERT_API int lambert_image_channels(const struct lambert_image *image); // 3 or 4
// Rows from the top, channels together, premultiplied, in the scene's working space.
LAMBERT_API const float *lambert_image_pixels(const struct lambert_image *image);

// By the extension of a file's name, in upper or lower case: whether pictures of that type
// are read and written. Files are read by what is in them, whatever they are called.
LAMBERT_API bool lambert_image_can_read(const char *path);
LAMBERT_API bool lambert_image_can_write(const char *path);
// Writes with the context's options (file type, bits, gamma, alpha); "-" is standard
// output. LAMBERT_ERROR_OUTPUT: it cannot be written; an older file stays whole then.
LAMBERT_API enum lambert_status lambert_image_write(struct lambert_context *ctx,
                                                    const struct lambert_image *image,
                                                    const char *path);
// A file's numbers as they are, 0..1 in integer files. *out is NULL after an error
// (LAMBERT_ERROR_INPUT, LAMBERT_ERROR_MEMORY).
LAMBERT_API enum lambert_status lambert_image_read(struct lambert_context *ctx,
                                                   const char *path,
                                                   struct lambert_image **out);

struct lambert_difference {
    uint64_t pixels, pixels_off; // off: some channel differs by more than `threshold`
    double rmse, psnr; // of the encoded values 0..1, in dB; psnr may be infinite
    double largest;    // difference of two encoded values, 0..1
};
// Compares what a viewer would show: both encoded as sRGB, clipped to 0..1, as is
// `threshold`. The heat map (NULL: none) shows where and how much. LAMBERT_ERROR_ARGUMENT:
// the sizes differ.
LAMBERT_API enum lambert_status
lambert_image_compare(struct lambert_context *ctx, const struct lambert_image *a,
                      const struct lambert_image *b, double threshold,
                      struct lambert_difference *out, struct lambert_image **heat_map);

#ifdef __cplusplus
}
#endif

#endif
