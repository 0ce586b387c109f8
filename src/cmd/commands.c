// Commands that INI files ask to run before and after pictures (spec/language 7.6). An INI
// file may come with a scene from elsewhere, so that nothing runs unless the command line,
// and it alone, allows it.
#include "cmd/cmd.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static const char *const names[COMMAND_COUNT] = {
    [COMMAND_PRE_SCENE] = "pre-scene",   [COMMAND_PRE_FRAME] = "pre-frame",
    [COMMAND_POST_FRAME] = "post-frame", [COMMAND_POST_SCENE] = "post-scene",
    [COMMAND_USER_ABORT] = "user-abort", [COMMAND_FATAL] = "fatal-error",
};

static const char *text_of(struct cmd *c, enum command_at at, const char *part)
{
    char *option = text_format("%s-%s", names[at], part);
    const char *text = lambert_option_text(c->ctx, option);
    free(option);
    return text && *text ? text : NULL;
}

static void put_size(struct cmd *c, FILE *out, const char *name)
{
    fprintf(out, "%d", (int)lambert_option_number(c->ctx, name));
}

// One %X; false when it stands for nothing and stays as it is, as in POV-Ray.
static bool put_expansion(struct cmd *c, FILE *out, char letter)
{
    const struct command_place *p = &c->place;
    const char *slash = p->scene ? strrchr(p->scene, '/') : NULL;
    switch (letter) {
    case 'o': fputs(p->picture ? p->picture : "", out); return true;
    case 's': fputs(slash ? slash + 1 : p->scene ? p->scene : "", out); return true;
    case 'n': fprintf(out, "%ld", p->frame < 0 ? 1 : p->frame); return true;
    case 'k': fprintf(out, "%.6f", lambert_option_number(c->ctx, "clock")); return true;
    case 'w': put_size(c, out, "width"); return true;
    case 'h': put_size(c, out, "height"); return true;
    default: return false;
    }
}

static char *expand(struct cmd *c, const char *text)
{
    char *line = NULL;
    size_t size = 0;
    FILE *out = must_have(open_memstream(&line, &size));
    for (; *text; text++) {
        if (*text == '%' && put_expansion(c, out, text[1]))
            text++;
        else
            fputc(*text, out);
    }
    fclose(out);
    return line;
}

void commands_check(struct cmd *c)
{
    if (lambert_option_number(c->ctx, "allow-commands"))
        return;
    for (int at = 0; at < COMMAND_COUNT; at++) {
        const char *command = text_of(c, at, "command");
        if (command)
            cmd_warn(c, "the %s command '%s' is not run; --allow-commands permits it",
                     names[at], command);
    }
}

// The action of a Return option: a letter, behind - or ! for when the command succeeds.
static enum command_action action_of(struct cmd *c, enum command_at at, bool failed)
{
    const char *text = text_of(c, at, "return");
    if (!text)
        return ACTION_NONE;
    bool negated = *text == '-' || *text == '!';
    if (failed == negated)
        return ACTION_NONE;
    switch (text[negated] & ~0x20) {
    case 'S': return ACTION_SKIP;
    case 'A': return ACTION_SKIP_ALL;
    case 'Q': return ACTION_QUIT;
    case 'U': return ACTION_USER_ABORT;
    case 'F': return ACTION_FATAL;
    default: return ACTION_NONE;
    }
}

// True when it ran and returned 0.
static bool run_shell(const char *line)
{
    int status = -1;
    fflush(NULL);
    pid_t pid = fork();
    if (pid == 0) { // only calls that are safe between fork and exec
        sigset_t none;
        sigemptyset(&none);
        sigprocmask(SIG_SETMASK, &none, NULL);
        execl("/bin/sh", "sh", "-c", line, (char *)NULL);
        _exit(127);
    }
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR)
        ;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

enum command_action command_run(struct cmd *c, enum command_at at)
{
    const char *text = text_of(c, at, "command");
    if (!text || !lambert_option_number(c->ctx, "allow-commands"))
        return ACTION_NONE;
    char *line = expand(c, text);
    bool failed = !run_shell(line);
    enum command_action action = action_of(c, at, failed);
    if (failed)
        cmd_warn(c, "the %s command '%s' failed", names[at], line);
    free(line);
    return action;
}
