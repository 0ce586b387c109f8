// From a scene file to what the tracer takes.
#include "api/context.h"
#include "api/gi.h"
#include "api/probe.h"
#include "api/state.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/diag.h"
#include "base/read_text.h"
#include "base/stack.h"
#include "eval/eval.h"
#include "lang/ast.h"
#include "lang/format.h"
#include "lang/lexer.h"
#include "scene/object.h"
#include "trace/world.h"

static enum diag_style style_of(const char *word)
{
    switch (word[0]) {
    case 'g': return DIAG_GCC;
    case 'j': return DIAG_JSON;
    case 'p': return DIAG_POV;
    default: return DIAG_TEXT;
    }
}

static void set_place(struct lambert_message *m, const struct source_map *sources,
                      struct span where)
{
    const struct source_line line = source_line(sources->file[where.file], where.begin);
    m->file = line.name;
    m->line = line.number;
    m->column = where.begin - line.begin + 1;
    m->end_column = m->column + (where.end - where.begin);
}

// A diagnostic of any stage becomes a message to the caller.
static void emit(void *user, const struct diag *d)
{
    struct lambert_context *ctx = user;
    static const enum lambert_message_kind kinds[] = {LAMBERT_NOTE, LAMBERT_WARNING,
                                                      LAMBERT_ERROR};
    if (!ctx->message)
        return;
    char *rendered = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&rendered, &size);
    if (!out)
        return;
    diag_print(out, &ctx->sources, d, style_of(lambert_option_text(ctx, "diagnostics")),
               strcmp(lambert_option_text(ctx, "color"), "always") == 0);
    fclose(out);
    struct lambert_message m = {.kind = kinds[d->severity],
                                .code = (int)d->code,
                                .text = d->message,
                                .hint = d->hint,
                                .rendered = rendered};
    if (d->where.end)
        set_place(&m, &ctx->sources, d->where);
    ctx->message(ctx->message_user, &m);
    free(rendered);
}

static void scene_text(void *user, enum word directive, const char *text)
{
    struct lambert_context *ctx = user;
    (void)directive;
    if (!ctx->message)
        return;
    struct lambert_message m = {
        .kind = LAMBERT_SCENE_TEXT, .text = text, .rendered = text};
    ctx->message(ctx->message_user, &m);
}

// Places in the text are 32-bit numbers.
enum { SCENE_BYTES_MAX = 1 << 30 };

// The file as source number 0. An include header (NULL: none) is a line before the first.
static enum lambert_status open_source(struct lambert_context *ctx, const char *path,
                                       const char *header, uint32_t *file)
{
    struct arena *a = ctx->scene_arena = arena_new(1 << 17);
    source_map_init(&ctx->sources, a);
    ctx->diags =
        (struct diag_sink){.emit = emit,
                           .user = ctx,
                           .errors_max = (unsigned)option_number(ctx, "max-errors")};
    const char *prefix = header ? arena_printf(a, "#include \"%s\"\n", header) : "";
    bool standard = strcmp(path, "-") == 0;
    FILE *f = standard ? stdin : fopen(path, "rb");
    if (!f)
        return context_fail(ctx, LAMBERT_ERROR_INPUT, "cannot read '%s': %s", path,
                            strerror(errno));
    size_t len;
    errno = 0;
    char *text = text_read(f, a, prefix, SCENE_BYTES_MAX, &len);
    bool ok = text && !ferror(f);
    const char *why = len > SCENE_BYTES_MAX ? "larger than a scene can be (1 GiB)"
                      : errno               ? strerror(errno)
                                            : "read error";
    if (!standard)
        fclose(f);
    if (!ok)
        return context_fail(ctx, LAMBERT_ERROR_INPUT, "cannot read '%s': %s", path, why);
    const char *name = standard ? "<stdin>" : arena_strndup(a, path, strlen(path));
    *file = source_add(&ctx->sources, name, text, len, (struct span){0});
    ctx->sources.file[*file]->ended = true;
    ctx->sources.file[*file]->header = header ? "--include-header" : NULL;
    return LAMBERT_OK;
}

// What the user said, then the includes of an installed POV-Ray, then our own of the same
// names.
static void set_library_path(struct lambert_context *ctx, struct eval_options *o)
{
    const char *const *given;
    size_t n = lambert_option_list(ctx, "library-path", &given);
    const char **path = arena_new_array(ctx->scene_arena, const char *, n + 2);
    for (size_t i = 0; i < n; i++)
        path[i] = given[i];
#ifdef POVRAY_INCLUDE_DIR
    path[n++] = POVRAY_INCLUDE_DIR;
#endif
#ifdef LAMBERT_INCLUDE_DIR
    path[n++] = LAMBERT_INCLUDE_DIR;
#endif
    o->library_path = path;
    o->library_path_count = (uint32_t)n;
}

// What the user declared, then the names every scene finds (spec/language 1.6): their
// numbers go through text of six digits, as POV-Ray's do.
static void set_declarations(struct lambert_context *ctx, struct eval_options *o)
{
    static const char *const names[][2] = {
        {"image_width", "width"},
        {"image_height", "height"},
        {"clock_delta", "frame-clock-delta"},
        {"initial_clock", "frame-initial-clock"},
        {"final_clock", "frame-final-clock"},
        {"initial_frame", "frame-initial"},
        {"final_frame", "frame-final"},
        {"frame_number", "frame"},
    };
    enum { NAMES = sizeof names / sizeof names[0] };
    const char *const *given;
    size_t n = lambert_option_list(ctx, "declare", &given);
    const char **declare = arena_new_array(ctx->scene_arena, const char *, n + NAMES + 1);
    for (size_t i = 0; i < n; i++)
        declare[i] = given[i];
    for (size_t i = 0; i < NAMES; i++)
        declare[n++] = arena_printf(ctx->scene_arena, "%s=%.6g", names[i][0],
                                    option_number(ctx, names[i][1]));
    declare[n++] =
        arena_printf(ctx->scene_arena, "input_file_name=\"%s\"", o->input_name);
    o->declare = declare;
    o->declare_count = (uint32_t)n;
}

static const char *folder_of(struct lambert_context *ctx, const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? arena_strndup(ctx->scene_arena, path, (size_t)(slash + 1 - path))
                 : ".";
}

// Where the scene's own files go: where a name of the picture says, else where POV-Ray has them.
static const char *output_folder(struct lambert_context *ctx)
{
    const char *given = lambert_option_text(ctx, "output");
    struct stat s;
    if (!given || !*given)
        return ".";
    if (given[strlen(given) - 1] == '/' || (stat(given, &s) == 0 && S_ISDIR(s.st_mode)))
        return given;
    return folder_of(ctx, given);
}

// Where else it may write.
static void set_write_folders(struct lambert_context *ctx, struct eval_options *o)
{
    const char *const *given;
    size_t n = lambert_option_list(ctx, "permit-write", &given);
    const char **folder = arena_new_array(ctx->scene_arena, const char *, n + 1);
    for (size_t i = 0; i < n; i++)
        folder[i] = given[i];
    folder[n++] = folder_of(ctx, o->input_name);
    o->write_folder = folder;
    o->write_folder_count = (uint32_t)n;
}

// Where it may read, none for anywhere.
static void set_read_folders(struct lambert_context *ctx, struct eval_options *o)
{
    const char *const *given;
    size_t n = lambert_option_list(ctx, "permit-read", &given);
    if (!n && !option_flag(ctx, "restrict-read"))
        return;
    const char **folder =
        arena_new_array(ctx->scene_arena, const char *, n + o->library_path_count + 2);
    for (size_t i = 0; i < n; i++)
        folder[i] = given[i];
    for (uint32_t i = 0; i < o->library_path_count; i++)
        folder[n++] = o->library_path[i];
    folder[n++] = ".";
    folder[n++] = folder_of(ctx, o->input_name);
    o->read_folder = folder;
    o->read_folder_count = (uint32_t)n;
}

static void file_found(void *user, const char *path)
{
    struct lambert_context *ctx = user;
    struct read_file *f = arena_new_struct(ctx->scene_arena, struct read_file);
    *f = (struct read_file){arena_strndup(ctx->scene_arena, path, strlen(path)),
                            ctx->files_read};
    ctx->files_read = f;
}

static struct eval_options eval_settings(struct lambert_context *ctx, const char *path)
{
    const uint32_t frame = (uint32_t)option_number(ctx, "frame");
    struct eval_options o = {
        .version = (int)(option_number(ctx, "language") * 100 + 0.5),
        .clock = (double)(float)option_number(ctx, "clock"), // spec/language 7.4
        .clock_set = lambert_option_is_set(ctx, "clock"),
        .image_width = (int)option_number(ctx, "width"),
        .image_height = (int)option_number(ctx, "height"),
        .input_name = path,
        .output_alpha = option_flag(ctx, "alpha"),
        .pov_patches = option_flag(ctx, "pov-patches"),
        .camera = option_flag(ctx, "clockless") ? frame > 1 ? frame : 1 : 0,
        .steps_max = (uint64_t)option_number(ctx, "max-parse-steps"),
        .memory_max = (size_t)option_number(ctx, "max-parse-memory") << 20,
        .message = scene_text,
        .message_user = ctx,
        .output_folder = output_folder(ctx),
    };
    ctx->files_read = NULL;
    if (ctx->state_path || gi_solution(ctx, true) || gi_solution(ctx, false)) {
        o.file_found = file_found;
        o.file_user = ctx;
    }
    set_declarations(ctx, &o);
    set_library_path(ctx, &o);
    set_write_folders(ctx, &o);
    set_read_folders(ctx, &o);
    return o;
}

// A language version of 3.7 asked for by option turns gamma handling on for a scene
// that says nothing of it (spec/lighting.md 3.3).
static void settle_gamma(struct lambert_context *ctx)
{
    struct settings *s = &ctx->scene.settings;
    if (s->gamma_mode == GAMMA_NONE && option_number(ctx, "language") >= 3.7) {
        s->gamma_mode = GAMMA_POWER;
        s->assumed_gamma = 1;
    }
}

static void print_statement(void *user, const struct ast *item)
{
    ast_print(item, user, 0);
}

// Options of the group "radiosity" may stand in the scene, as lambert_NAME.
static const char *const *scene_settings(struct lambert_context *ctx)
{
    const char **names =
        arena_new_array(ctx->scene_arena, const char *, lambert_option_count() + 1);
    size_t n = 0;
    for (size_t i = 0; i < lambert_option_count(); i++) {
        const struct lambert_option *o = lambert_option_at(i);
        if (strcmp(o->group, "radiosity") != 0 || o->kind == LAMBERT_OPTION_FILE)
            continue;
        char *name = arena_printf(ctx->scene_arena, "lambert_%s", o->name);
        for (char *p = name; *p; p++)
            *p = *p == '-' ? '_' : *p;
        names[n++] = name;
    }
    return names;
}

struct setting_errors {
    struct lambert_context *ctx;
    bool any;
};

static void setting_found(void *user, const char *name, const char *text)
{
    struct setting_errors *e = user;
    char *option = arena_printf(e->ctx->scene_arena, "%s", name + strlen("lambert_"));
    for (char *p = option; *p; p++)
        *p = *p == '_' ? '-' : *p;
    if (!e->any)
        e->any = option_from_scene(e->ctx, option, text) != LAMBERT_OK;
}

// What runs on the large stack.
struct reading {
    struct lambert_context *ctx;
    const struct eval_options *options;
    uint32_t file;
    double told_at; // when progress was
    bool ok;
};

// The place in the scene's own text from which the reading came to `where`.
static struct span outermost(const struct source_map *m, uint32_t file, struct span where)
{
    for (;;) {
        const struct span included_at = m->file[where.file]->included_at;
        if (where.expansion)
            where = m->expansions[where.expansion].called_at;
        else if (where.file != file && included_at.end)
            where = included_at;
        else
            return where;
    }
}

static bool tell_reading(void *user, struct span where)
{
    static const double often = 0.1; // seconds
    struct reading *r = user;
    struct lambert_context *ctx = r->ctx;
    double now = context_seconds();
    if (!ctx->progress || now - r->told_at < often)
        return !ctx->cancel;
    r->told_at = now;
    struct source_file *f = ctx->sources.file[r->file];
    where = outermost(&ctx->sources, r->file, where);
    if (!ctx->progress(ctx->progress_user, source_line(f, where.begin).number,
                       source_line(f, f->len).number))
        ctx->cancel = true;
    return !ctx->cancel;
}

static void read_scene(void *user)
{
    struct reading *r = user;
    struct lambert_context *ctx = r->ctx;
    r->ok = eval_scene(ctx->scene_arena, &ctx->sources, r->file, &ctx->diags, r->options,
                       &ctx->scene);
}

static void build_world(void *user)
{
    struct lambert_context *ctx = user;
    ctx->world = world_build(ctx->scene_arena, &ctx->scene);
}

static enum lambert_status evaluate(struct lambert_context *ctx, const char *path,
                                    FILE *ast)
{
    uint32_t file;
    context_forget_scene(ctx);
    enum lambert_status status =
        open_source(ctx, path, lambert_option_text(ctx, "include-header"), &file);
    if (status != LAMBERT_OK)
        return status;
    double start = context_seconds();
    struct eval_options o = eval_settings(ctx, path);
    if (ast) {
        o.statement = print_statement;
        o.statement_user = ast;
    }
    ctx->scene = (struct scene){0};
    struct probe *probe = probe_new();
    o.trace = probe_trace;
    o.trace_user = probe;
    struct setting_errors settings = {ctx, false};
    o.wanted = scene_settings(ctx);
    o.found = setting_found;
    o.found_user = &settings;
    struct reading reading = {ctx, &o, file, start, false};
    o.reading = tell_reading;
    o.reading_user = &reading;
    ctx->phase = LAMBERT_PHASE_READING;
    stack_run(read_scene, &reading);
    ctx->phase = LAMBERT_PHASE_TILES;
    bool stopped = ctx->cancel;
    ctx->cancel = false;
    probe_free(probe);
    ctx->stats.parse_seconds = context_seconds() - start;
    ctx->stats.errors = ctx->diags.errors;
    ctx->stats.warnings = ctx->diags.warnings;
    if (stopped)
        return context_fail(ctx, LAMBERT_CANCELLED, "stopped on request");
    if (!reading.ok || ctx->diags.errors)
        return context_fail(ctx, LAMBERT_ERROR_SCENE, "%s: %u error%s", path,
                            ctx->diags.errors, ctx->diags.errors == 1 ? "" : "s");
    if (ctx->diags.warnings && option_flag(ctx, "werror"))
        return context_fail(ctx, LAMBERT_ERROR_SCENE, "%s: warnings count as errors",
                            path);
    if (settings.any)
        return LAMBERT_ERROR_OPTION;
    settle_gamma(ctx);
    return LAMBERT_OK;
}

enum lambert_status lambert_load_file(struct lambert_context *ctx, const char *path)
{
    enum lambert_status status = evaluate(ctx, path, NULL);
    if (status != LAMBERT_OK)
        return status;
    double start = context_seconds();
    stack_run(build_world, ctx);
    ctx->stats.build_seconds = context_seconds() - start;
    if (!ctx->world)
        return context_fail(ctx, LAMBERT_ERROR_SCENE, "%s: nothing can be traced", path);
    ctx->stats.objects = ctx->world->object_count;
    ctx->stats.leaves = ctx->world->leaf_count;
    ctx->stats.lights = ctx->world->light_count;
    return LAMBERT_OK;
}

enum lambert_status lambert_check_file(struct lambert_context *ctx, const char *path)
{
    return evaluate(ctx, path, NULL);
}

enum lambert_status lambert_format_file(struct lambert_context *ctx, const char *path,
                                        FILE *out)
{
    uint32_t file;
    context_forget_scene(ctx);
    enum lambert_status status = open_source(ctx, path, NULL, &file);
    int width = (int)option_number(ctx, "indent");
    if (status != LAMBERT_OK)
        return status;
    if (!format_source(&ctx->sources, file, &ctx->diags, width, out))
        return context_fail(ctx, LAMBERT_ERROR_SCENE, "%s: %u error%s", path,
                            ctx->diags.errors, ctx->diags.errors == 1 ? "" : "s");
    return LAMBERT_OK;
}

enum lambert_status lambert_dump_tokens(struct lambert_context *ctx, const char *path,
                                        FILE *out)
{
    uint32_t file;
    context_forget_scene(ctx);
    enum lambert_status status =
        open_source(ctx, path, lambert_option_text(ctx, "include-header"), &file);
    if (status != LAMBERT_OK)
        return status;
    lex_print(&ctx->sources, file, &ctx->diags, out);
    return ctx->diags.errors ? LAMBERT_ERROR_SCENE : LAMBERT_OK;
}

enum lambert_status lambert_dump_ast(struct lambert_context *ctx, const char *path,
                                     FILE *out)
{
    return evaluate(ctx, path, out);
}

enum lambert_status lambert_dump_csg(struct lambert_context *ctx, const char *path,
                                     FILE *out)
{
    enum lambert_status status = evaluate(ctx, path, NULL);
    for (uint32_t i = 0; status == LAMBERT_OK && i < ctx->scene.object_count; i++)
        object_print(ctx->scene.object[i], out, 0);
    return status;
}
