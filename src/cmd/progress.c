// What the user sees while a picture is made, and the counts at the end.
#include "cmd/cmd.h"

#include <math.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

static const double redraw_seconds = 0.1; // on a terminal
static const double report_seconds = 10;  // in a log
static const double quiet_seconds = 1;    // of reading, before anything is said

double cmd_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

void progress_begin(struct cmd *c)
{
    struct progress *p = &c->progress;
    *p = (struct progress){.start = cmd_seconds(),
                           .terminal = isatty(STDERR_FILENO),
                           .on = !c->quiet,
                           .mid_line = p->mid_line};
    p->shown_at = p->start;
}

static void print_duration(FILE *out, double seconds)
{
    unsigned long s = (unsigned long)(seconds + 0.5);
    if (s >= 3600)
        fprintf(out, "%luh%02lum", s / 3600, s / 60 % 60);
    else if (s >= 60)
        fprintf(out, "%lum%02lus", s / 60, s % 60);
    else
        fprintf(out, "%lus", s);
}

// Seconds, as fast as the tiles of this run went.
static double left(const struct progress *p, uint32_t done, uint32_t total,
                   double elapsed)
{
    return elapsed / (done - p->before) * (total - done);
}

// Of unknown length: loops and includes stay at one line.
static void print_reading(struct progress *p, uint32_t line, uint32_t lines,
                          double elapsed)
{
    if (p->mid_line)
        return;
    fprintf(stderr,
            p->terminal ? "\rreading: line %u of %u, "
                        : "lambert: reading line %u of %u, ",
            line, lines);
    print_duration(stderr, elapsed);
    fputs(p->terminal ? "\033[K" : " gone\n", stderr);
    p->shown = p->terminal;
}

static unsigned columns(void)
{
    struct winsize w;
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &w) == 0 && w.ws_col ? w.ws_col : 80;
}

// Never longer than the window: a line that wraps cannot be drawn over.
static void print_bar(struct progress *p, uint32_t done, uint32_t total, double elapsed)
{
    enum { BAR_NEEDS = 60, COUNTS_NEED = 40, LEFT_NEEDS = 16 };
    const unsigned percent = (unsigned)(100.0 * done / total), wide = columns();
    char bar[21];
    size_t full = (size_t)(20.0 * done / total);
    memset(bar, '#', full);
    memset(bar + full, '.', 20 - full);
    bar[20] = 0;
    fputc('\r', stderr);
    if (wide >= BAR_NEEDS)
        fprintf(stderr, "[%s] ", bar);
    if (p->phase == LAMBERT_PHASE_RADIOSITY && wide >= COUNTS_NEED)
        fprintf(stderr, "radiosity: %u %%  ", percent);
    else
        fprintf(stderr, "%3u%%  ", percent);
    if (p->phase != LAMBERT_PHASE_RADIOSITY && wide >= COUNTS_NEED)
        fprintf(stderr, "%u/%u tiles  ", done, total);
    if (done < total && p->phase == LAMBERT_PHASE_TILES && wide >= LEFT_NEEDS) {
        fputs("ETA ", stderr);
        print_duration(stderr, left(p, done, total, elapsed));
    }
    fputs("\033[K", stderr);
    p->shown = true;
}

static void print_line(const struct progress *p, uint32_t done, uint32_t total,
                       double elapsed)
{
    if (p->phase == LAMBERT_PHASE_RADIOSITY) {
        fprintf(stderr, "lambert: radiosity: %u %%, ", (unsigned)(100.0 * done / total));
        print_duration(stderr, elapsed);
        fputs(" gone\n", stderr);
        return;
    }
    fprintf(stderr, "lambert: %u%% (%u of %u tiles), ", (unsigned)(100.0 * done / total),
            done, total);
    print_duration(stderr, elapsed);
    fputs(" gone, ", stderr);
    print_duration(stderr, left(p, done, total, elapsed));
    fputs(" to go\n", stderr);
}

bool progress_show(void *user, uint32_t done, uint32_t total)
{
    struct cmd *c = user;
    struct progress *p = &c->progress;
    double now = cmd_seconds(), since = now - p->shown_at;
    if (p->phase != lambert_progress_phase(c->ctx)) {
        // What is left of a phase is judged by its own time.
        p->phase = lambert_progress_phase(c->ctx);
        p->start = p->shown_at = now;
        p->shown_percent = 0;
        p->started = false;
    }
    if (p->phase == LAMBERT_PHASE_READING) {
        if (p->on && now - p->start > quiet_seconds &&
            since >= (p->terminal ? redraw_seconds : report_seconds)) {
            print_reading(p, done, total, now - p->start);
            p->shown_at = now;
        }
        return !c->interrupted;
    }
    if (!p->started)
        p->before = done - (done > 0);
    p->started = true;
    if (!p->on || !done)
        return !c->interrupted;
    if (p->terminal) {
        if (since >= redraw_seconds) {
            print_bar(p, done, total, now - p->start);
            p->shown_at = now;
        }
        return !c->interrupted;
    }
    // Each tenth, but not all of them in a blink.
    unsigned tenth = (unsigned)(10.0 * done / total) * 10;
    if (done < total && now - p->start > 1 &&
        (since >= report_seconds || tenth > p->shown_percent)) {
        print_line(p, done, total, now - p->start);
        p->shown_at = now;
        p->shown_percent = tenth;
    }
    return !c->interrupted;
}

void progress_end(struct cmd *c)
{
    if (c->progress.shown)
        fputs("\r\033[K", stderr);
    c->progress.shown = false;
}

static void print_json_text(FILE *out, const char *s)
{
    fputc('"', out);
    for (; *s; s++) {
        unsigned char ch = (unsigned char)*s;
        if (ch == '"' || ch == '\\')
            fprintf(out, "\\%c", ch);
        else if (ch < 0x20)
            fprintf(out, "\\u%04x", ch);
        else
            fputc(ch, out);
    }
    fputc('"', out);
}

static void print_json(struct cmd *c, FILE *out, const struct lambert_stats *s,
                       const char *picture)
{
    fputs("{\"v\":1,\"t\":\"stats\",\"scene\":", out);
    print_json_text(out, lambert_option_text(c->ctx, "input"));
    fputs(",\"picture\":", out);
    print_json_text(out, picture ? picture : "");
    fprintf(out, ",\"parse_seconds\":%.6f,\"build_seconds\":%.6f,\"trace_seconds\":%.6f",
            s->parse_seconds, s->build_seconds, s->trace_seconds);
    fprintf(out, ",\"write_seconds\":%.6f,\"trace_cpu_seconds\":%.6f", s->write_seconds,
            s->trace_cpu_seconds);
    fprintf(out, ",\"pixels\":%llu,\"samples\":%llu,\"rays\":%llu,\"shadow_rays\":%llu",
            (unsigned long long)s->pixels, (unsigned long long)s->samples,
            (unsigned long long)s->rays, (unsigned long long)s->shadow_rays);
    fprintf(out, ",\"node_visits\":%llu,\"leaf_tests\":%llu,\"csg_tests\":%llu",
            (unsigned long long)s->node_visits, (unsigned long long)s->leaf_tests,
            (unsigned long long)s->csg_tests);
    fprintf(out, ",\"function_evaluations\":%llu",
            (unsigned long long)s->function_evaluations);
    fprintf(out, ",\"tiles_done\":%u,\"tiles_total\":%u,\"objects\":%u,\"leaves\":%u",
            s->tiles_done, s->tiles_total, s->objects, s->leaves);
    fprintf(out, ",\"lights\":%u,\"memory_peak\":%llu,\"warnings\":%u}\n", s->lights,
            (unsigned long long)s->memory_peak, s->warnings);
}

void stats_print(struct cmd *c, FILE *out, bool json, const char *picture)
{
    struct lambert_stats s;
    lambert_get_stats(c->ctx, &s);
    if (json) {
        print_json(c, out, &s, picture);
        return;
    }
    double rays = (double)(s.rays + s.shadow_rays);
    fprintf(out, "parse %.3f s, build %.3f s, trace %.3f s, write %.3f s\n",
            s.parse_seconds, s.build_seconds, s.trace_seconds, s.write_seconds);
    fprintf(out, "objects %u, shapes %u, lights %u\n", s.objects, s.leaves, s.lights);
    fprintf(out, "pixels %llu, samples %llu, rays %llu, shadow rays %llu",
            (unsigned long long)s.pixels, (unsigned long long)s.samples,
            (unsigned long long)s.rays, (unsigned long long)s.shadow_rays);
    if (s.trace_seconds > 0)
        fprintf(out, " (%.3g million rays/s)", rays / s.trace_seconds * 1e-6);
    fprintf(out, "\nnode visits %llu, shape tests %llu, CSG tests %llu\n",
            (unsigned long long)s.node_visits, (unsigned long long)s.leaf_tests,
            (unsigned long long)s.csg_tests);
    if (s.function_evaluations)
        fprintf(out, "function evaluations for surfaces %llu (%.3g a ray)\n",
                (unsigned long long)s.function_evaluations,
                (double)s.function_evaluations / rays);
    fprintf(out, "memory at most %.1f MB\n", (double)s.memory_peak / 1048576);
}
