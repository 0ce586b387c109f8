// The lambert command.
#include "cmd/cmd.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

int cmd_fail(int code, const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    fputs("lambert: ", stderr);
    vfprintf(stderr, fmt, ap);
    fputc('\n', stderr);
    va_end(ap);
    return code;
}

void cmd_warn(struct cmd *c, const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    char *text = text_format_list(fmt, ap);
    va_end(ap);
    char *line = text_format("lambert: warning: %s\n", text);
    fputs(line, stderr);
    streams_warn(c, line);
    free(line);
    free(text);
    c->warnings++;
}

static bool is_shown(struct cmd *c, enum lambert_message_kind kind)
{
    const bool text = kind == LAMBERT_SCENE_TEXT;
    if (kind == LAMBERT_ERROR)
        return true;
    if (c->quiet && kind != LAMBERT_WARNING)
        return false;
    return lambert_option_number(c->ctx, "console-all") != 0 &&
           lambert_option_number(c->ctx, text ? "console-debug" : "console-warning") != 0;
}

static void on_message(void *user, const struct lambert_message *m)
{
    struct cmd *c = user;
    if (streams_repeat(c, m))
        return;
    streams_write(c, m);
    if (!is_shown(c, m->kind))
        return;
    progress_end(c);
    fputs(m->rendered, stderr);
    size_t n = strlen(m->rendered);
    c->progress.mid_line = n && m->rendered[n - 1] != '\n';
}

static sigset_t watched_signals(void)
{
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGALRM); // of --time-limit
    return set;
}

// A command and what it returned.
struct errand {
    struct cmd *c;
    int (*run)(struct cmd *c);
    int code;
};

// Waits for signals while a thread of its own runs the command, so that nothing global is
// needed. The first stops after the tiles in hand, the second at once.
static void watch_signals(void *user)
{
    struct cmd *c = ((struct errand *)user)->c;
    const sigset_t set = watched_signals();
    int signal;
    while (sigwait(&set, &signal) == 0 && !c->finished) {
        if (signal == SIGALRM && c->interrupted)
            continue; // it stops already
        c->out_of_time = signal == SIGALRM;
        if (c->stage == STAGE_READ) {
            progress_end(c);
            fprintf(stderr, "lambert: %s while reading the scene; nothing is written\n",
                    cmd_interruption(c));
        }
        if (c->interrupted || c->stage <= STAGE_READ)
            _exit(CMD_INTERRUPTED);
        c->interrupted = true;
        lambert_cancel(c->ctx);
    }
}

const char *cmd_interruption(const struct cmd *c)
{
    return c->out_of_time ? "out of time" : "interrupted";
}

static void run_errand(void *user)
{
    struct errand *e = user;
    const bool watched = !pthread_equal(e->c->watch, pthread_self());
    if (!watched) { // the system refused a thread
        const sigset_t set = watched_signals();
        pthread_sigmask(SIG_UNBLOCK, &set, NULL);
    }
    e->code = e->run(e->c);
    e->c->finished = true;
    if (watched) // the signal ends the watch
        pthread_kill(e->c->watch, SIGTERM);
}

// 0: none.
static void begin_time_limit(const struct cmd *c)
{
    const double seconds = lambert_option_number(c->ctx, "time-limit");
    const struct itimerval in = {
        .it_value = {(time_t)seconds, (suseconds_t)(1e6 * fmod(seconds, 1))}};
    setitimer(ITIMER_REAL, &in, NULL);
}

static int run_watched(struct cmd *c, int (*run)(struct cmd *c))
{
    struct errand errand = {c, run, CMD_FAILED};
    const sigset_t set = watched_signals();
    c->watch = pthread_self();
    pthread_sigmask(SIG_BLOCK, &set, NULL);
    lambert_run_deep(run_errand, watch_signals, &errand);
    return errand.code;
}

// What is already in the environment counts less than anything said on the line.
static int read_environment(struct cmd *c)
{
    const char *ini = getenv("POVINI");
    if (ini && access(ini, R_OK) == 0)
        return ini_read(c, ini, NULL, 0);
    if (!ini && access("povray.ini", R_OK) == 0)
        return ini_read(c, "povray.ini", NULL, 0);
    return CMD_OK;
}

static void add_library_paths(struct cmd *c, const char *list)
{
    while (list && *list) {
        size_t n = strcspn(list, ":");
        char *folder = text_format("%.*s", (int)n, list);
        if (n)
            lambert_option_set(c->ctx, "library-path", folder);
        free(folder);
        list += n + (list[n] == ':');
    }
}

static void settle_color(struct cmd *c)
{
    const char *term = getenv("TERM"), *no = getenv("NO_COLOR");
    bool can = isatty(STDERR_FILENO) && term && strcmp(term, "dumb") != 0 && !(no && *no);
    if (strcmp(lambert_option_text(c->ctx, "color"), "auto") == 0)
        lambert_option_set(c->ctx, "color", can ? "always" : "never");
}

static bool asked(struct cmd *c, const char *name)
{
    return lambert_option_is_set(c->ctx, name);
}

// The first word may say what to do; without one it is rendering.
static const struct command {
    const char *name;
    int (*run)(struct cmd *c);
    bool renders; // as POV-Ray would: its INI file counts
} commands[] = {
    {"render", cmd_render, true}, {"compare", cmd_compare, false},
    {"check", cmd_check, true},   {"fmt", cmd_format, false},
    {"mesh", cmd_mesh, false},
};

static const struct command *find_command(int argc, char **argv)
{
    for (size_t i = 1; argc > 1 && i < sizeof commands / sizeof *commands; i++)
        if (strcmp(argv[1], commands[i].name) == 0)
            return &commands[i];
    return &commands[0];
}

// Whether that was all that was asked for; main() sees to it that it was written.
static bool tells_of_itself(struct cmd *c)
{
    if (asked(c, "help"))
        help_print(stdout, strcmp(lambert_option_text(c->ctx, "help"), "all") == 0);
    else if (asked(c, "version"))
        printf("lambert %s\n", lambert_version());
    else if (asked(c, "man"))
        man_print(stdout);
    else if (asked(c, "completion"))
        completion_print(stdout);
    else
        return false;
    return true;
}

static int run(struct cmd *c, int argc, char **argv)
{
    const struct command *command = find_command(argc, argv);
    int named = command != &commands[0];
    int code = command->renders ? read_environment(c) : CMD_OK;
    if (!code)
        code = cmdline_parse(c, argc - named, argv + named);
    if (code)
        return code;
    if (tells_of_itself(c))
        return CMD_OK;
    add_library_paths(c, getenv("LAMBERT_PATH"));
    add_library_paths(c, getenv("POVINC"));
    settle_color(c);
    c->quiet = lambert_option_number(c->ctx, "quiet") != 0;
    c->verbose = lambert_option_number(c->ctx, "verbose") != 0;
    code = settings_write(c);
    if (!code)
        code = streams_open(c);
    if (code)
        return code;
    if (command->run != cmd_compare) // which limits each renderer
        begin_time_limit(c);
    code = run_watched(c, command->run);
    int closed = streams_close(c);
    return code ? code : closed;
}

int main(int argc, char **argv)
{
    heap_begin();
    struct cmd c = {.ctx = lambert_context_new(), .program = argv[0]};
    if (!c.ctx)
        return cmd_fail(CMD_FAILED, "out of memory");
    lambert_set_message_function(c.ctx, on_message, &c);
    lambert_set_progress_function(c.ctx, progress_show, &c);
    int code = run(&c, argc, argv);
    if (fflush(stdout) != 0 || ferror(stdout))
        code = code ? code : cmd_fail(CMD_IO, "cannot write to standard output");
    if (!code && c.warnings && lambert_option_number(c.ctx, "werror"))
        code = CMD_FAILED;
    lambert_context_free(c.ctx);
    cmdline_free(&c);
    return code;
}
