// Any bytes as a scene: lexer, stream, grammar and evaluation must report and return.
#include <stdint.h>
#include <stddef.h>
#include <stdlib.h>

#include "base/arena.h"
#include "eval/eval.h"

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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct arena *a = arena_new(1 << 16);
    struct source_map sources;
    source_map_init(&sources, a);
    char *text = arena_strndup(a, size ? (const char *)data : "", size);
    uint32_t file = source_add(&sources, "fuzz.pov", text, size, (struct span){0});
    struct diag_sink diags = {.emit = ignore, .errors_max = 20};
    struct eval_options options = {.message = ignore_text, .image_width = 8,
                                   .image_height = 8};
    struct scene scene = {0};
    eval_scene(a, &sources, file, &diags, &options, &scene);
    arena_free(a);
    return 0;
}
