#include "loaded.h"

#include "test.h"

#include <stdlib.h>
#include <unistd.h>

static void print_diag(void *user, const struct diag *d)
{
    diag_print(stdout, user, d, DIAG_TEXT, false);
}

static const char head[] = "#version 3.7; global_settings { assumed_gamma 1 }\n";

static char *text_of(const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    const size_t size = sizeof head + (size_t)vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *text = malloc(size);
    assert_non_null(text);
    memcpy(text, head, sizeof head);
    vsnprintf(text + sizeof head - 1, size - sizeof head + 1, format, args);
    return text;
}

void load(struct loaded *l, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = text_of(format, args);
    va_end(args);
    *l = (struct loaded){.arena = arena_new(1 << 16)};
    struct source_map *sources = arena_new_struct(l->arena, struct source_map);
    source_map_init(sources, l->arena);
    uint32_t file = source_add(sources, "case.scn", text, strlen(text), (struct span){0});
    struct diag_sink sink = {.emit = print_diag, .user = sources};
    const struct eval_options options = {
        .image_width = PICTURE_SIZE, .image_height = PICTURE_SIZE, .input_name = "case"};
    if (!eval_scene(l->arena, sources, file, &sink, &options, &l->scene))
        fail_msg("the scene does not evaluate: %s", text);
    l->world = world_build(l->arena, &l->scene);
    l->scratch = trace_scratch_new(l->world);
    free(text);
}

void unload(struct loaded *l)
{
    trace_scratch_free(l->scratch);
    arena_free(l->arena);
}

struct hit shoot(struct loaded *l, struct vec3 o, struct vec3 d, struct interaction *at)
{
    const struct ray_query q = {.ray = {o, vec3_normalize(d), 0, HUGE_VAL}};
    const struct hit h = trace_closest_1(l->world, l->scratch, &q);
    if (at && isfinite(h.b.t))
        trace_interaction(l->world, &q.ray, &h, at);
    return h;
}

struct image render_picture(const struct loaded *l, int threads, int tile_size)
{
    struct render_settings s = render_settings_default;
    s.width = s.height = s.col_end = s.row_end = PICTURE_SIZE;
    s.threads = threads;
    s.tile_size = tile_size;
    struct image picture;
    struct render_stats stats;
    assert_true(image_init(&picture, PICTURE_SIZE, PICTURE_SIZE, 4));
    assert_true(render_world(l->world, &s, NULL, &picture, &stats));
    return picture;
}

static int byte_of(float v) { return (int)(255 * fmin(1, fmax(0, v)) + .5); }

int picture_difference(const struct image *a, const struct image *b)
{
    int most = 0;
    for (int i = 0; i < a->width * a->height * a->channels; i++) {
        const int d = abs(byte_of(a->pixel[i]) - byte_of(b->pixel[i]));
        most = d > most ? d : most;
    }
    return most;
}

const char *font_file(void)
{
    static const char *const known[] = {
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu/DejaVuSans.ttf",
        "/usr/share/povray-3.7/include/timrom.ttf",
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (access(known[i], R_OK) == 0)
            return known[i];
    return NULL;
}
