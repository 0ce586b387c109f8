#ifndef API_CONTEXT_H
#define API_CONTEXT_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/diag.h"
#include "base/source.h"
#include "image/image.h"
#include "lambert/lambert.h"
#include "scene/scene.h"
#include "trace/render.h"

// What stands behind the handles of the public interface.

struct option_value {
    const char *text; // NULL: never set
    double number;
    const char **list;
    size_t count, capacity;
};

struct lambert_context {
    struct arena *arena;              // options
    struct option_value *value;       // one per option
    struct option_value *scene_value; // what the scene itself asks for
    char error[1024];

    lambert_message_fn message;
    void *message_user;
    lambert_progress_fn progress;
    void *progress_user;
    volatile bool cancel;
    const char *state_path;   // of a render that may be continued; NULL: none
    bool state_is_over;       // its picture is whole: once that is written, the file goes
    enum lambert_phase phase; // that progress is about

    // Of the scene that is loaded.
    struct arena *scene_arena;
    struct source_map sources;
    struct diag_sink diags;
    struct scene scene;
    struct world *world;
    struct lambert_stats stats;
    // Files it reads besides its text; with a state_path or saved light only.
    struct read_file {
        const char *path;
        const struct read_file *next; // the one before
    } * files_read;
};

struct lambert_image {
    struct image im;
    struct transfer working;
    bool unmanaged; // see image_write_options
};

enum lambert_status context_fail(struct lambert_context *ctx, enum lambert_status status,
                                 const char *fmt, ...)
    __attribute__((format(printf, 3, 4)));
double context_seconds(void);
// Takes `lambert_NAME` of a scene as option NAME, unless the user has set that.
enum lambert_status option_from_scene(struct lambert_context *ctx, const char *name,
                                      const char *text);
void context_forget_scene(struct lambert_context *ctx);

// Values that always exist: wrong names are our own mistakes.
double option_number(const struct lambert_context *ctx, const char *name);
bool option_flag(const struct lambert_context *ctx, const char *name);
struct transfer option_transfer(const struct lambert_context *ctx, const char *name);

#endif
