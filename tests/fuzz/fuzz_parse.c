// Any bytes as a scene: lexer, stream, grammar, evaluation, building and a few rays must
// report and return.
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/time.h>

#include "base/arena.h"
#include "base/stack.h"
#include "eval/eval.h"
#include "trace/render.h"
#include "trace/world.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void ignore(void *user, const struct diag *d)
{
    (void)user;
    (void)d;
}

static void ignore_text(void *user, enum word directive, const char *text)
{
    (void)user;
    (void)directive;
    (void)text;
}

static volatile bool out_of_time;

static void stop(int signal)
{
    (void)signal;
    out_of_time = true;
}

// As --time-limit, in processor time: a mutant may ask for hours of light, but has to stop.
static void limit_time(int seconds)
{
    const struct itimerval in = {.it_value = {seconds, 0}};
    out_of_time = false;
    signal(SIGVTALRM, stop);
    setitimer(ITIMER_VIRTUAL, &in, NULL);
}

static void trace(struct arena *a, const struct scene *scene)
{
    enum { LIMIT = 5 };
    struct render_settings settings = render_settings_default;
    const struct render_progress progress = {.cancel = &out_of_time};
    struct image picture = {0};
    settings.width = settings.col_end = 4;
    settings.height = settings.row_end = 3;
    settings.threads = 1;
    const struct world *w = world_build(a, scene);
    limit_time(LIMIT);
    if (w && image_init(&picture, settings.width, settings.height, 4))
        render_world(w, &settings, &progress, &picture, NULL);
    limit_time(0);
    image_free(&picture);
}

struct input {
    const uint8_t *data;
    size_t size;
};

static void run(void *user)
{
    const struct input *in = user;
    const uint8_t *data = in->data;
    const size_t size = in->size;
    static const char *const library[] = {POVRAY_INCLUDE_DIR};
    struct arena *a = arena_new(1 << 16);
    struct source_map sources;
    source_map_init(&sources, a);
    char *text = arena_strndup(a, size ? (const char *)data : "", size);
    uint32_t file = source_add(&sources, "fuzz.pov", text, size, (struct span){0});
    struct diag_sink diags = {.emit = ignore, .errors_max = 20};
    // The limits let the endless loops of mutants end.
    struct eval_options options = {.message = ignore_text,
                                   .image_width = 4,
                                   .image_height = 3,
                                   .library_path = library,
                                   .library_path_count = 1,
                                   .steps_max = 200000,
                                   .memory_max = 256 << 20};
    struct scene scene = {0};
    if (eval_scene(a, &sources, file, &diags, &options, &scene))
        trace(a, &scene);
    arena_free(a);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct input in = {data, size};
    stack_run(run, &in); // as the program does
    return 0;
}
