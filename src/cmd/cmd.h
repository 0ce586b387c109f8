#ifndef CMD_CMD_H
#define CMD_CMD_H

#include <pthread.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "lambert/lambert.h"

// The command. It knows the renderer through its public interface alone.

enum exit_code {
    CMD_OK = 0,
    CMD_FAILED = 1,      // errors in the scene, or a comparison out of tolerance
    CMD_INTERRUPTED = 2, // the part that was done is written
    CMD_USAGE = 64,
    CMD_NO_INPUT = 66,
    CMD_NO_OUTPUT = 73,
    CMD_IO = 74,
};

enum stage { STAGE_START, STAGE_READ, STAGE_RENDER, STAGE_WRITE };

struct progress {
    double start, shown_at;
    uint32_t before; // tiles that were there from the start
    unsigned shown_percent;
    enum lambert_phase phase;
    bool terminal, on, started;
    bool shown;    // something is in the line that goes when anything else is written
    bool mid_line; // the scene has written a line whose end is to come
};

// Files that get messages besides the console.
enum stream {
    STREAM_ALL,
    STREAM_DEBUG,
    STREAM_WARNING,
    STREAM_FATAL,
    STREAM_RENDER,
    STREAM_STATISTIC,
    STREAM_COUNT
};

// When the settings may ask for a command, and what a failed one may ask for.
enum command_at {
    COMMAND_PRE_SCENE,
    COMMAND_PRE_FRAME,
    COMMAND_POST_FRAME,
    COMMAND_POST_SCENE,
    COMMAND_USER_ABORT,
    COMMAND_FATAL,
    COMMAND_COUNT
};
enum command_action {
    ACTION_NONE,
    ACTION_SKIP,
    ACTION_SKIP_ALL,
    ACTION_QUIT,
    ACTION_USER_ABORT,
    ACTION_FATAL
};
struct command_place {
    const char *scene, *picture; // NULL: none
    long frame;                  // below 0: a single picture
};

struct cmd {
    struct lambert_context *ctx;
    const char *program; // how the command was called, for messages
    char **file;         // bare file names that are no INI files, in order
    size_t file_count, file_capacity;
    volatile int stage; // enum stage; what a signal means depends on it
    volatile bool interrupted;
    volatile bool out_of_time; // interrupted by --time-limit
    volatile bool finished;    // the watch is to end with the next signal
    bool quiet, verbose;
    bool keeps; // finished tiles, to continue
    unsigned warnings;
    FILE *stream[STREAM_COUNT]; // NULL: none
    bool streams_open;
    char *held; // warnings from before the streams were open
    bool animation;
    char **told; // its warnings so far
    size_t told_count;
    struct progress progress;
    struct command_place place; // what commands are told
    pthread_t watch;            // the thread that waits for signals
};

// Before memory is asked for.
void heap_begin(void);

// Prints "lambert: ..." and returns the code, so that it can stand after `return`.
int cmd_fail(int code, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
void cmd_warn(struct cmd *c, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
double cmd_seconds(void);
const char *cmd_interruption(const struct cmd *c); // what a message calls it
int cmd_exit_code(enum lambert_status status);

// args.c, ini.c: CMD_OK or an exit code after a message.
int cmdline_parse(struct cmd *c, int argc, char **argv);
int cmdline_switch(struct cmd *c, const char *arg);                         // +X -X
int cmdline_keyword(struct cmd *c, const char *keyword, const char *value); // INI
int cmdline_file(struct cmd *c, const char *name);
void cmdline_free(struct cmd *c); // what these keep
const struct lambert_option *cmdline_find_keyword(const char *keyword, size_t len);
bool text_same(const char *a, const char *b, size_t n); // ASCII, case ignored
int ini_read(struct cmd *c, const char *path, const char *section, int depth);

// help.c
void help_print(FILE *out, bool all);
void man_print(FILE *out);
void completion_print(FILE *out);

// output.c: the name of the picture file, to be freed. frame < 0: no animation.
char *output_name(struct cmd *c, const char *scene, long frame, int digits, int *code);
// What cannot be done without: where it is NULL, says so and aborts.
void *must_have(void *memory);
char *text_format(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
char *text_format_list(const char *fmt, va_list ap) __attribute__((format(printf, 1, 0)));

// streams.c
int streams_open(struct cmd *c);
void streams_write(struct cmd *c, const struct lambert_message *m);
void streams_warn(struct cmd *c, const char *line); // of the command itself
// Whether a frame before has said so.
bool streams_repeat(struct cmd *c, const struct lambert_message *m);
int streams_close(struct cmd *c);
int settings_write(struct cmd *c); // Create_Ini

// commands.c
void commands_check(struct cmd *c); // warns of those that are not allowed
enum command_action command_run(struct cmd *c, enum command_at at);

// progress.c
void progress_begin(struct cmd *c);
bool progress_show(void *cmd, uint32_t done, uint32_t total);
void progress_end(struct cmd *c);

// stats.c
void stats_print(struct cmd *c, FILE *out, bool json, const char *picture);

// render.c, compare.c, scenes.c, check.c, format.c, mesh.c
int cmd_render(struct cmd *c);
int cmd_compare(struct cmd *c);
int cmd_check(struct cmd *c);
int cmd_format(struct cmd *c);
int cmd_mesh(struct cmd *c);
int compare_scenes(struct cmd *c);

// process.c: runs a program in `folder` with its output in a log file. Seconds it
// took; negative when it was stopped at the limit.
struct process {
    const char *const *argv;
    const char *folder; // NULL: here
    const char *log;    // NULL: dropped
    double limit;
    int status; // of waitpid
};
double process_run(struct process *p);

#endif
