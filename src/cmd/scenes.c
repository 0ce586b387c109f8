// `lambert compare SCENE...`: each scene by lambert and by the reference program, at
// the same settings, and how much the pictures differ.
#define _XOPEN_SOURCE 700 // realpath
#include "cmd/report.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ARGUMENTS_MAX = 64 };
static const double match_percent = 1, near_percent = 5;

struct job {
    struct cmd *cmd;
    char *out;                           // folder, absolute
    const char *settings[ARGUMENTS_MAX]; // Keyword=value
    size_t settings_count;
};

// A name for the scene's files: its path with the slashes taken out.
static char *flat_name(const char *scene)
{
    while (*scene == '/' || *scene == '.')
        scene++;
    char *name = text_format("%s", scene);
    for (char *p = name; *p; p++)
        if (*p == '/')
            *p = '-';
    char *dot = strrchr(name, '.');
    if (dot && dot != name)
        *dot = 0;
    return name;
}

static bool passed_on(const struct lambert_option *o)
{
    return o->keyword && strcmp(o->name, "input") != 0 &&
           (strcmp(o->group, "picture") == 0 || strcmp(o->group, "quality") == 0 ||
            strcmp(o->group, "scene") == 0 || strcmp(o->name, "threads") == 0);
}

static void add_setting(struct job *j, const char *keyword, const char *value)
{
    if (j->settings_count < ARGUMENTS_MAX - 1)
        j->settings[j->settings_count++] = text_format("%s=%s", keyword, value);
}

// Both renderers take INI keywords, so one list serves both. What is on or off by a
// default that an installed INI file could change is said as well.
static void collect_settings(struct job *j)
{
    static const char *const always[] = {"width", "height", "antialias", "quality",
                                         "jitter"};
    struct lambert_context *ctx = j->cmd->ctx;
    const struct lambert_option *o;
    for (size_t i = 0; i < sizeof always / sizeof always[0]; i++) {
        o = lambert_option_find(always[i]);
        add_setting(j, o->keyword, lambert_option_text(ctx, o->name));
    }
    for (size_t i = 0; (o = lambert_option_at(i)); i++) {
        const char *const *list;
        if (!passed_on(o) || !lambert_option_is_set(ctx, o->name))
            continue;
        size_t n = lambert_option_list(ctx, o->name, &list);
        for (size_t k = 0; k < n; k++)
            add_setting(j, o->keyword, list[k]);
        if (o->kind != LAMBERT_OPTION_LIST)
            add_setting(j, o->keyword, lambert_option_text(ctx, o->name));
    }
}

// FNV-1a, 64 bits.
static uint64_t hash(uint64_t h, const void *data, size_t n)
{
    const unsigned char *p = data;
    for (size_t i = 0; i < n; i++)
        h = (h ^ p[i]) * 0x100000001b3u;
    return h;
}

static uint64_t cache_key(const struct job *j, const char *scene)
{
    uint64_t h = hash(0xcbf29ce484222325u, scene, strlen(scene) + 1);
    for (size_t i = 0; i < j->settings_count; i++)
        h = hash(h, j->settings[i], strlen(j->settings[i]) + 1);
    FILE *f = fopen(scene, "rb");
    char chunk[4096];
    size_t n;
    while (f && (n = fread(chunk, 1, sizeof chunk, f)) > 0)
        h = hash(h, chunk, n);
    if (f)
        fclose(f);
    return h;
}

static double time_limit(const struct cmd *c)
{
    static const double usual = 600;
    const double asked = lambert_option_number(c->ctx, "time-limit");
    return asked > 0 ? asked : usual;
}

// Seconds, or a negative number when there is no picture.
static double run_renderer(const struct job *j, const char *const *own,
                           const char *folder, const char *log, int *status)
{
    const char *argv[ARGUMENTS_MAX + 16];
    size_t n = 0;
    while (own[n] && n < 15) {
        argv[n] = own[n];
        n++;
    }
    for (size_t i = 0; i < j->settings_count; i++)
        argv[n++] = j->settings[i];
    argv[n] = NULL;
    struct process p = {argv, folder, log, time_limit(j->cmd), 0};
    double seconds = process_run(&p);
    *status = p.status;
    bool ok = seconds >= 0 && WIFEXITED(p.status) && WEXITSTATUS(p.status) == 0;
    return ok ? seconds : (seconds < 0 ? seconds : -seconds - 1e-9);
}

static double run_reference(const struct job *j, const char *scene, const char *folder,
                            const char *picture, const char *log)
{
    char *input = text_format("+I%s", scene), *output = text_format("+O%s", picture);
    char *library = text_format("+L%s", folder);
    const char *own[] = {lambert_option_text(j->cmd->ctx, "reference"),
                         input,
                         output,
                         library,
                         "+FN8",
                         "-D",
                         "-P",
                         "-V",
                         NULL};
    int status;
    double seconds = run_renderer(j, own, folder, log, &status);
    free(input);
    free(output);
    free(library);
    return seconds;
}

// The cached time stands beside the cached picture; a failure is cached too.
static double reference_picture(const struct job *j, const char *scene,
                                const char *folder, const char *picture, const char *log)
{
    const char *cache = lambert_option_text(j->cmd->ctx, "reference-cache");
    if (!cache)
        return run_reference(j, scene, folder, picture, log);
    mkdir(cache, 0777);
    char *real = realpath(cache, NULL);
    uint64_t key = cache_key(j, scene);
    char *kept =
        text_format("%s/%016llx.png", real ? real : cache, (unsigned long long)key);
    char *note =
        text_format("%s/%016llx.seconds", real ? real : cache, (unsigned long long)key);
    double seconds = 0;
    FILE *f = fopen(note, "r");
    bool known = f && fscanf(f, "%lf", &seconds) == 1;
    if (f)
        fclose(f);
    if (!known) {
        seconds = run_reference(j, scene, folder, kept, log);
        f = fopen(note, "w");
        if (f) {
            fprintf(f, "%.6f\n", seconds);
            fclose(f);
        }
    }
    unlink(picture);
    if (symlink(kept, picture) != 0)
        seconds = -1;
    free(real);
    free(kept);
    free(note);
    return seconds;
}

static double run_self(const struct job *j, const char *scene, const char *folder,
                       const char *picture, const char *log, int *status)
{
    char *input = text_format("--input=%s", scene);
    char *output = text_format("--output=%s", picture);
    char *library = text_format("--library-path=%s", folder);
    const char *own[] = {
        "/proc/self/exe",    input,           output, library, "--type=png", "-q",
        "--diagnostics=gcc", "--color=never", NULL};
    own[0] = access(own[0], X_OK) == 0 ? own[0] : j->cmd->program;
    double seconds = run_renderer(j, own, folder, log, status);
    free(input);
    free(output);
    free(library);
    return seconds;
}

// The first error of the log, without its place, or how the process ended.
static void find_reason(struct compared_scene *r, const char *log, double seconds,
                        int status)
{
    char line[1024];
    FILE *f = fopen(log, "r");
    r->reason[0] = 0;
    while (f && !r->reason[0] && fgets(line, sizeof line, f)) {
        char *at = strstr(line, "error: ");
        if (!at)
            at = strstr(line, "Error: "); // POV-Ray's
        if (!at && strncmp(line, "lambert: ", 9) == 0 && !strstr(line, "warning: "))
            at = line + 2; // "lambert: " and "error: " + 2
        if (at)
            snprintf(r->reason, sizeof r->reason, "%.*s", (int)strcspn(at + 7, "\n"),
                     at + 7);
    }
    if (f)
        fclose(f);
    if (WIFSIGNALED(status) && WTERMSIG(status) == 9 && seconds < 0)
        snprintf(r->reason, sizeof r->reason, "time limit");
    else if (WIFSIGNALED(status))
        snprintf(r->reason, sizeof r->reason, "signal %d", WTERMSIG(status));
    else if (!r->reason[0] && WEXITSTATUS(status) == 0)
        snprintf(r->reason, sizeof r->reason, "it failed and does not say why");
    else if (!r->reason[0])
        snprintf(r->reason, sizeof r->reason, "exit code %d", WEXITSTATUS(status));
}

static void judge(struct cmd *c, struct compared_scene *r, const char *reference,
                  const char *picture, const char *map_path)
{
    struct lambert_image *a = NULL, *b = NULL, *map = NULL;
    double threshold = lambert_option_number(c->ctx, "threshold") / 255;
    r->verdict = VERDICT_FAR;
    if (lambert_image_read(c->ctx, reference, &a) != LAMBERT_OK ||
        lambert_image_read(c->ctx, picture, &b) != LAMBERT_OK ||
        lambert_image_compare(c->ctx, a, b, threshold, &r->difference, &map) !=
            LAMBERT_OK) {
        snprintf(r->reason, sizeof r->reason, "%s", lambert_error(c->ctx));
        r->verdict = a ? VERDICT_NOT_RENDERED : VERDICT_NO_REFERENCE;
    } else {
        r->percent =
            100 * (double)r->difference.pixels_off / (double)r->difference.pixels;
        r->verdict = r->percent <= match_percent  ? VERDICT_MATCH
                     : r->percent <= near_percent ? VERDICT_NEAR
                                                  : VERDICT_FAR;
        lambert_image_write(c->ctx, map, map_path);
    }
    lambert_image_free(a);
    lambert_image_free(b);
    lambert_image_free(map);
}

static void compare_scene(const struct job *j, struct compared_scene *r)
{
    char *scene = realpath(r->scene, NULL);
    if (!scene) {
        r->verdict = VERDICT_NOT_RENDERED;
        snprintf(r->reason, sizeof r->reason, "%s", strerror(errno));
        return;
    }
    char *folder = text_format("%.*s", (int)(strrchr(scene, '/') - scene + 1), scene);
    const char *name = r->name;
    char *reference = text_format("%s/%s.reference.png", j->out, name);
    char *picture = text_format("%s/%s.png", j->out, name);
    char *map = text_format("%s/%s.heat.png", j->out, name);
    char *reference_log = text_format("%s/%s.reference.log", j->out, name);
    char *log = text_format("%s/%s.log", j->out, name);
    int status = 0;
    unlink(picture);
    unlink(map);
    r->reference_seconds = reference_picture(j, scene, folder, reference, reference_log);
    r->seconds = run_self(j, scene, folder, picture, log, &status);
    if (r->seconds < 0) {
        r->verdict = VERDICT_NOT_RENDERED;
        find_reason(r, log, r->seconds, status);
    } else if (r->reference_seconds < 0) {
        r->verdict = VERDICT_NO_REFERENCE;
        const double limit = time_limit(j->cmd);
        find_reason(r, reference_log, r->reference_seconds, 0);
        if (-r->reference_seconds >= limit)
            snprintf(r->reason, sizeof r->reason,
                     "the reference program takes longer than %g s", limit);
    } else {
        judge(j->cmd, r, reference, picture, map);
    }
    free(scene);
    free(folder);
    free(reference);
    free(picture);
    free(map);
    free(reference_log);
    free(log);
}

static void print_row(const struct compared_scene *r, bool csv)
{
    double ratio = r->reference_seconds > 0 && r->seconds > 0
                       ? r->seconds / r->reference_seconds
                       : 0;
    const bool compared = is_compared(r);
    if (csv) {
        printf("\"%s\",%s,", r->scene, verdict_text(r->verdict));
        if (compared)
            printf("%.4f,%.6f,%.2f,%.3f,%.3f,%.3f,", r->percent, r->difference.rmse,
                   r->difference.psnr, r->reference_seconds, r->seconds, ratio);
        else
            fputs(",,,,,,", stdout);
        putchar('"');
        for (const char *p = r->reason; *p; p++)
            printf(*p == '"' ? "\"\"" : "%c", *p);
        fputs("\"\n", stdout);
    } else if (compared) {
        printf("%-12s %8.3f %9.5f %7.2f %8.2f %8.2f %7.2f  %s\n",
               verdict_text(r->verdict), r->percent, r->difference.rmse,
               r->difference.psnr, r->reference_seconds, r->seconds, ratio, r->scene);
    } else {
        printf("%-12s %8s %9s %7s %8s %8s %7s  %s: %s\n", verdict_text(r->verdict), "-",
               "-", "-", "-", "-", "-", r->scene, r->reason);
    }
    fflush(stdout);
}

static void print_header(bool csv)
{
    if (csv)
        puts("scene,verdict,off_percent,rmse,psnr_db,reference_seconds,lambert_seconds,"
             "ratio,reason");
    else
        printf("%-12s %8s %9s %7s %8s %8s %7s  %s\n", "verdict", "% off", "RMSE", "PSNR",
               "ref. s", "ours s", "ratio", "scene");
}

// How many scenes came to which verdict.
static void print_counts(const size_t count[VERDICT_COUNT])
{
    const char *comma = "";
    for (int v = 0; v < VERDICT_COUNT; v++) {
        if (!count[v])
            continue;
        printf("%s%zu %s", comma, count[v], verdict_text(v));
        comma = ", ";
    }
    putchar('\n');
}

// Compares one scene after the other and returns how many are out of tolerance.
static size_t compare_all(const struct job *j, struct compared_scene *rows, bool csv)
{
    const struct cmd *c = j->cmd;
    const double tolerance = lambert_option_number(c->ctx, "tolerance");
    size_t count[VERDICT_COUNT] = {0}, failed = 0;
    print_header(csv);
    for (size_t i = 0; i < c->file_count; i++) {
        struct compared_scene *r = &rows[i];
        r->scene = c->file[i];
        r->name = flat_name(r->scene);
        compare_scene(j, r);
        print_row(r, csv);
        count[r->verdict]++;
        failed += !is_compared(r) || r->percent > tolerance;
    }
    if (!csv)
        print_counts(count);
    return failed;
}

int compare_scenes(struct cmd *c)
{
    struct job j = {.cmd = c};
    const char *out = lambert_option_text(c->ctx, "out");
    const bool csv = lambert_option_number(c->ctx, "csv") != 0;
    if (mkdir(out, 0777) != 0 && errno != EEXIST)
        return cmd_fail(CMD_NO_OUTPUT, "cannot make '%s': %s", out, strerror(errno));
    j.out = realpath(out, NULL);
    if (!j.out)
        return cmd_fail(CMD_NO_OUTPUT, "cannot use '%s': %s", out, strerror(errno));
    collect_settings(&j);
    struct compared_scene *rows = must_have(calloc(c->file_count + 1, sizeof *rows));
    const size_t failed = compare_all(&j, rows, csv);
    int code = failed ? CMD_FAILED : CMD_OK;
    if (!csv) {
        printf("side by side: %s/index.html\n", out);
        if (!report_write(j.out, rows, c->file_count))
            code = cmd_fail(CMD_NO_OUTPUT, "cannot write '%s/index.html': %s", j.out,
                            strerror(errno));
    }
    for (size_t i = 0; i < c->file_count; i++)
        free(rows[i].name);
    free(rows);
    for (size_t i = 0; i < j.settings_count; i++)
        free((void *)(uintptr_t)j.settings[i]);
    free(j.out);
    return code;
}
