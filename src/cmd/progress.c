// What the user sees while a picture is made.
#include "cmd/cmd.h"

#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

static const double redraw_seconds = 0.1; // on a terminal
static const double report_seconds = 10;  // in a log
static const double quiet_seconds = 1;    // of a phase, before anything is said

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

// What is left of a phase is judged by its own time.
static void begin_phase(struct progress *p, enum lambert_phase phase, double now)
{
    p->phase = phase;
    p->start = p->shown_at = now;
    p->shown_percent = 0;
    p->started = false;
}

static void show_reading(struct progress *p, uint32_t line, uint32_t lines, double now)
{
    const double often = p->terminal ? redraw_seconds : report_seconds;
    if (now - p->start <= quiet_seconds || now - p->shown_at < often)
        return;
    print_reading(p, line, lines, now - p->start);
    p->shown_at = now;
}

static void show_on_terminal(struct progress *p, uint32_t done, uint32_t total,
                             double now)
{
    if (now - p->shown_at < redraw_seconds)
        return;
    print_bar(p, done, total, now - p->start);
    p->shown_at = now;
}

// Each tenth, but not all of them in a blink.
static void show_in_log(struct progress *p, uint32_t done, uint32_t total, double now)
{
    const unsigned tenth = (unsigned)(10.0 * done / total) * 10;
    if (done == total || now - p->start <= quiet_seconds ||
        (now - p->shown_at < report_seconds && tenth <= p->shown_percent))
        return;
    print_line(p, done, total, now - p->start);
    p->shown_at = now;
    p->shown_percent = tenth;
}

bool progress_show(void *user, uint32_t done, uint32_t total)
{
    struct cmd *c = user;
    struct progress *p = &c->progress;
    const double now = cmd_seconds();
    if (p->phase != lambert_progress_phase(c->ctx))
        begin_phase(p, lambert_progress_phase(c->ctx), now);
    const bool tiles = p->phase != LAMBERT_PHASE_READING;
    if (tiles && !p->started) {
        p->before = done - (done > 0);
        p->started = true;
    }
    if (p->on && !tiles)
        show_reading(p, done, total, now);
    else if (p->on && done && p->terminal)
        show_on_terminal(p, done, total, now);
    else if (p->on && done)
        show_in_log(p, done, total, now);
    return !c->interrupted;
}

void progress_end(struct cmd *c)
{
    if (c->progress.shown)
        fputs("\r\033[K", stderr);
    c->progress.shown = false;
}
