// `lambert SCENE`: one picture, or the frames of an animation.
#include "cmd/cmd.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int cmd_exit_code(enum lambert_status status)
{
    switch (status) {
    case LAMBERT_OK: return CMD_OK;
    case LAMBERT_CANCELLED: return CMD_INTERRUPTED;
    case LAMBERT_ERROR_OPTION: return CMD_USAGE;
    case LAMBERT_ERROR_INPUT: return CMD_NO_INPUT;
    case LAMBERT_ERROR_OUTPUT: return CMD_NO_OUTPUT;
    case LAMBERT_ERROR_SCENE:
    case LAMBERT_ERROR_ARGUMENT:
    case LAMBERT_ERROR_MEMORY: break;
    }
    return CMD_FAILED;
}

static int report(struct cmd *c, enum lambert_status status)
{
    return cmd_fail(cmd_exit_code(status), "%s", lambert_error(c->ctx));
}

// Said before hours of rendering, not after.
static int check_output(const char *path)
{
    const char *slash = strrchr(path, '/');
    if (strcmp(path, "-") == 0)
        return CMD_OK;
    char *folder =
        slash ? text_format("%.*s", (int)(slash - path + 1), path) : text_format(".");
    bool exists = access(path, F_OK) == 0;
    bool ok = access(folder, W_OK) == 0 || (exists && access(path, W_OK) == 0);
    const int why = errno;
    free(folder);
    return ok ? CMD_OK
              : cmd_fail(CMD_NO_OUTPUT, "cannot write '%s': %s", path, strerror(why));
}

// Where a picture goes that cannot be written where it should: the time it took is not lost.
static char *refuge_of(const char *path)
{
    const char *folder = getenv("TMPDIR"), *slash = strrchr(path, '/');
    return text_format("%s/lambert-%ld-%s", folder && *folder ? folder : "/tmp",
                       (long)getpid(), slash ? slash + 1 : path);
}

static int write_picture(struct cmd *c, const struct lambert_image *image,
                         const char *path)
{
    enum lambert_status status = lambert_image_write(c->ctx, image, path);
    if (status == LAMBERT_OK)
        return CMD_OK;
    if (strcmp(path, "-") == 0)
        return cmd_fail(CMD_IO, "%s", lambert_error(c->ctx));
    char *why = text_format("%s", lambert_error(c->ctx)), *refuge = refuge_of(path);
    if (lambert_image_write(c->ctx, image, refuge) == LAMBERT_OK)
        cmd_fail(CMD_NO_OUTPUT, "%s; the picture is in '%s'", why, refuge);
    else
        cmd_fail(CMD_NO_OUTPUT, "%s", why);
    free(why);
    free(refuge);
    return CMD_NO_OUTPUT;
}

static bool asked(struct cmd *c, const char *name)
{
    return lambert_option_number(c->ctx, name) != 0;
}

static void say_picture(struct cmd *c, FILE *out, const char *name,
                        const struct lambert_stats *s)
{
    fprintf(out, "%s: %d x %d, %.2f s\n", name,
            (int)lambert_option_number(c->ctx, "width"),
            (int)lambert_option_number(c->ctx, "height"),
            s->parse_seconds + s->build_seconds + s->trace_seconds);
}

static uint32_t tiles_done(const struct cmd *c)
{
    struct lambert_stats s;
    lambert_get_stats(c->ctx, &s);
    return s.tiles_done;
}

static void say_done(struct cmd *c, const char *path, bool whole)
{
    struct lambert_stats s;
    lambert_get_stats(c->ctx, &s);
    const char *name = !path                    ? "nothing written"
                       : strcmp(path, "-") == 0 ? "standard output"
                                                : path;
    if (!whole)
        fprintf(stderr, "lambert: %s; %u of %u tiles are done, the rest is empty: %s%s\n",
                cmd_interruption(c), s.tiles_done, s.tiles_total, name,
                c->keeps ? "; --continue goes on from here" : "");
    else if (!c->quiet)
        say_picture(c, stderr, name, &s);
    if (c->stream[STREAM_RENDER])
        say_picture(c, c->stream[STREAM_RENDER], name, &s);
}

// Once more with the same limit would come as far: as far as before.
static void warn_of_standstill(struct cmd *c)
{
    struct lambert_stats s;
    lambert_get_stats(c->ctx, &s);
    if (c->out_of_time && s.samples && !s.pixels)
        cmd_warn(c,
                 "no tile was finished within --time-limit=%g; it takes more time or a "
                 "smaller --tile-size, which begins anew",
                 lambert_option_number(c->ctx, "time-limit"));
}

static void say_stats(struct cmd *c, const char *path)
{
    const char *form = lambert_option_text(c->ctx, "stats");
    const bool json = form && strcmp(form, "json") == 0;
    const bool piped = path && strcmp(path, "-") == 0; // the picture is what stdout has
    if (c->stream[STREAM_STATISTIC])
        stats_print(c, c->stream[STREAM_STATISTIC], false, path);
    if (form || c->verbose)
        stats_print(c, json && !piped ? stdout : stderr, json, path);
}

// Beside the picture; standard output and devices have no beside. Unless tiles are to be kept
// as they are finished, the file is made only when the picture is interrupted.
static void keep_state(struct cmd *c, const char *path)
{
    bool file = path && strcmp(path, "-") != 0 && strncmp(path, "/dev/", 5) != 0;
    if (!file && (asked(c, "continue") || asked(c, "save-state")))
        cmd_warn(c, "no file is written, so that nothing can be kept to continue");
    char *state = file ? text_format("%s.lambert-state", path) : NULL;
    lambert_set_state_file(c->ctx, state);
    free(state);
    c->keeps = file;
}

// As POV-Ray does: a picture without a state is one that was finished.
static bool is_finished(struct cmd *c, const char *path)
{
    if (!asked(c, "continue") || !path || strcmp(path, "-") == 0)
        return false;
    char *state = text_format("%s.lambert-state", path);
    bool finished = access(path, F_OK) == 0 && access(state, F_OK) != 0;
    free(state);
    if (finished && !c->quiet)
        fprintf(stderr, "lambert: %s is there already; not rendered again\n", path);
    return finished;
}

static int render_to(struct cmd *c, const char *scene, const char *path)
{
    struct lambert_image *image;
    if (is_finished(c, path))
        return CMD_OK;
    keep_state(c, path);
    if (c->verbose)
        fprintf(stderr, "lambert: reading %s\n", scene);
    progress_begin(c);
    c->stage = STAGE_READ;
    enum lambert_status status = lambert_load_file(c->ctx, scene);
    progress_end(c);
    c->stage = STAGE_START;
    if (status != LAMBERT_OK)
        return report(c, status);
    c->stage = STAGE_RENDER;
    status = lambert_render(c->ctx, &image);
    progress_end(c);
    c->stage = STAGE_WRITE;
    warn_of_standstill(c);
    if (!image && status != LAMBERT_CANCELLED)
        return report(c, status);
    bool empty = !image || (status == LAMBERT_CANCELLED && !tiles_done(c));
    int code = path && !empty ? write_picture(c, image, path) : CMD_OK;
    lambert_image_free(image);
    if (code)
        return code;
    if (empty)
        return cmd_fail(CMD_INTERRUPTED,
                        "%s before the first tile was done; nothing is written",
                        cmd_interruption(c));
    say_done(c, path, status == LAMBERT_OK);
    say_stats(c, path);
    c->stage = STAGE_START;
    return cmd_exit_code(status);
}

struct animation {
    long first, last, begin, end, step;
    double clock_first, clock_last, delta;
};

static double number(struct cmd *c, const char *name)
{
    return lambert_option_number(c->ctx, name);
}

// A frame of a subset: below 1 a fraction of all (spec/language 7.4).
static long subset(double v, long fallback, const struct animation *a)
{
    if (v <= 0)
        return fallback;
    return v < 1 ? (long)((double)(a->last - a->first + 1) * v) : (long)v;
}

static struct animation animation_of(struct cmd *c)
{
    struct animation a = {
        .first = (long)number(c, "first-frame"),
        .last = (long)number(c, "last-frame"),
        .step = (long)number(c, "frame-step"),
        .clock_first = number(c, "first-clock"),
        .clock_last = number(c, "last-clock"),
    };
    bool cyclic = number(c, "cyclic") != 0;
    long intervals = a.last - a.first + (cyclic ? 1 : 0);
    a.delta = intervals ? (a.clock_last - a.clock_first) / (double)intervals : 0;
    a.begin = subset(number(c, "start-frame"), a.first, &a);
    a.end = subset(number(c, "end-frame"), a.last, &a);
    if (a.begin < a.first)
        a.begin = a.first;
    if (a.end < a.begin)
        a.end = a.begin;
    if (cyclic) // what POV-Ray calls the last frame from here on
        a.last++;
    return a;
}

static void set_number(struct cmd *c, const char *name, double v)
{
    char text[64];
    snprintf(text, sizeof text, "%.17g", v);
    lambert_option_set(c->ctx, name, text);
}

// The frame's clock and the place that commands are told of. frame < 0: a single picture.
static int begin_frame(struct cmd *c, const char *scene, const struct animation *a,
                       long frame, int digits, char **path)
{
    int code = CMD_OK;
    free(*path);
    *path = NULL;
    if (frame >= 0) {
        set_number(c, "frame", (double)frame);
        set_number(c, "clock", a->clock_first + (double)(frame - a->first) * a->delta);
    }
    if (number(c, "write"))
        *path = output_name(c, scene, frame, digits, &code);
    c->place = (struct command_place){scene, *path, frame};
    return code;
}

static int render_frame(struct cmd *c, const char *scene, const char *path)
{
    int code = path ? check_output(path) : CMD_OK;
    if (!code)
        code = render_to(c, scene, path);
    return !code && c->interrupted ? CMD_INTERRUPTED : code;
}

// The commands at the end, by how it came to it.
static int end_scene(struct cmd *c, enum command_action action, int code)
{
    if (code == CMD_INTERRUPTED || action == ACTION_USER_ABORT) {
        command_run(c, COMMAND_USER_ABORT);
        code = code ? code : CMD_FAILED;
    } else if (code || action == ACTION_FATAL) {
        command_run(c, COMMAND_FATAL);
        return code ? code : CMD_FAILED;
    }
    if (action == ACTION_QUIT)
        return code;
    action = command_run(c, COMMAND_POST_SCENE);
    if (action != ACTION_USER_ABORT && action != ACTION_FATAL)
        return code;
    command_run(c, action == ACTION_FATAL ? COMMAND_FATAL : COMMAND_USER_ABORT);
    return CMD_FAILED;
}

// Frames a->begin to a->end, each between its commands. What a failed command asks for is
// as POV-Ray has it: before the scene, "skip" is all frames and "all" the last command too.
static int render_frames(struct cmd *c, const char *scene, const struct animation *a,
                         int digits)
{
    char *path = NULL;
    int code = begin_frame(c, scene, a, a->begin, digits, &path);
    enum command_action action = code ? ACTION_NONE : command_run(c, COMMAND_PRE_SCENE);
    if (action == ACTION_SKIP_ALL)
        action = ACTION_QUIT;
    for (long n = a->begin; n <= a->end && !code && !action; n += a->step) {
        code = begin_frame(c, scene, a, n, digits, &path);
        action = code ? ACTION_NONE : command_run(c, COMMAND_PRE_FRAME);
        if (action == ACTION_SKIP)
            action = ACTION_NONE;
        else if (!code && !action && !(code = render_frame(c, scene, path)))
            action = command_run(c, COMMAND_POST_FRAME);
    }
    code = end_scene(c, action, code);
    free(path);
    return code;
}

static int render_animation(struct cmd *c, const char *scene)
{
    struct animation a = animation_of(c);
    char digits[32];
    int width = snprintf(digits, sizeof digits, "%ld", a.last);
    if (a.last < a.first)
        return cmd_fail(CMD_USAGE, "the last frame (%ld) comes before the first (%ld)",
                        a.last, a.first);
    c->animation = true;
    set_number(c, "frame-initial", (double)a.first);
    set_number(c, "frame-final", (double)a.last);
    set_number(c, "frame-initial-clock", a.clock_first);
    set_number(c, "frame-final-clock", a.clock_last);
    set_number(c, "frame-clock-delta", a.delta);
    return render_frames(c, scene, &a, width);
}

static int render_still(struct cmd *c, const char *scene)
{
    const struct animation one = {.begin = -1, .end = -1, .step = 1};
    return render_frames(c, scene, &one, 0);
}

// POV-Ray adds the extension when it is missing.
static char *find_scene(const char *name)
{
    char *with_extension = text_format("%s.pov", name);
    bool plain = strcmp(name, "-") == 0 || access(name, F_OK) == 0;
    if (!plain && access(with_extension, F_OK) == 0)
        return with_extension;
    free(with_extension);
    return text_format("%s", name);
}

static int dump(struct cmd *c, const char *scene)
{
    enum lambert_status status;
    if (number(c, "dump-tokens"))
        status = lambert_dump_tokens(c->ctx, scene, stdout);
    else if (number(c, "dump-ast"))
        status = lambert_dump_ast(c->ctx, scene, stdout);
    else
        status = lambert_dump_csg(c->ctx, scene, stdout);
    return status == LAMBERT_OK ? CMD_OK : report(c, status);
}

int cmd_render(struct cmd *c)
{
    const char *name = lambert_option_text(c->ctx, "input");
    if (!name)
        return cmd_fail(CMD_USAGE, "no scene given; try 'lambert --help'");
    if (c->file_count > 1)
        return cmd_fail(CMD_USAGE, "one scene at a time: '%s' and '%s'", c->file[0],
                        c->file[1]);
    char *scene = find_scene(name);
    int code;
    commands_check(c);
    double first = number(c, "first-frame"), last = number(c, "last-frame");
    if (number(c, "dump-tokens") || number(c, "dump-ast") || number(c, "dump-csg"))
        code = dump(c, scene);
    else if (first != last || (last != 0 && last != 1))
        code = render_animation(c, scene);
    else
        code = render_still(c, scene);
    free(scene);
    return code;
}
