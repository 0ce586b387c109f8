// Messages that go to files too, and the settings as an INI file.
#include "cmd/cmd.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char *const stream_options[STREAM_COUNT] = {
    [STREAM_ALL] = "file-all",         [STREAM_DEBUG] = "file-debug",
    [STREAM_WARNING] = "file-warning", [STREAM_FATAL] = "file-fatal",
    [STREAM_RENDER] = "file-render",   [STREAM_STATISTIC] = "file-statistic",
};

// The file's name; as in POV-Ray one of its own when the option is only turned on. NULL: none.
static const char *path_of(const struct cmd *c, enum stream i)
{
    static const char *const usual[STREAM_COUNT] = {
        [STREAM_ALL] = "alltext.out",     [STREAM_DEBUG] = "debug.out",
        [STREAM_WARNING] = "warning.out", [STREAM_FATAL] = "fatal.out",
        [STREAM_RENDER] = "render.out",   [STREAM_STATISTIC] = "stats.out",
    };
    static const char *const on[] = {"on", "true", "yes"},
                             *off[] = {"off", "false", "no"};
    const char *path = lambert_option_text(c->ctx, stream_options[i]);
    for (size_t k = 0; path && k < sizeof on / sizeof *on; k++) {
        if (strcasecmp(path, on[k]) == 0)
            return usual[i];
        if (strcasecmp(path, off[k]) == 0)
            return NULL;
    }
    return path;
}

static void put(struct cmd *c, enum stream own, const char *text)
{
    if (c->stream[own])
        fputs(text, c->stream[own]);
    if (c->stream[STREAM_ALL])
        fputs(text, c->stream[STREAM_ALL]);
}

int streams_open(struct cmd *c)
{
    const char *mode = lambert_option_number(c->ctx, "append-file") ? "a" : "w";
    for (int i = 0; i < STREAM_COUNT; i++) {
        const char *path = path_of(c, i);
        if (path && !(c->stream[i] = fopen(path, mode)))
            return cmd_fail(CMD_NO_OUTPUT, "cannot write '%s': %s", path,
                            strerror(errno));
    }
    c->streams_open = true;
    if (c->held)
        put(c, STREAM_WARNING, c->held);
    return CMD_OK;
}

void streams_warn(struct cmd *c, const char *line)
{
    if (c->streams_open) {
        put(c, STREAM_WARNING, line);
        return;
    }
    char *all = text_format("%s%s", c->held ? c->held : "", line);
    free(c->held);
    c->held = all;
}

bool streams_repeat(struct cmd *c, const struct lambert_message *m)
{
    enum { MOST = 200 }; // to be remembered
    if (!c->animation || m->kind != LAMBERT_WARNING)
        return false;
    for (size_t i = 0; i < c->told_count; i++)
        if (strcmp(c->told[i], m->rendered) == 0)
            return true;
    if (!c->told)
        c->told = calloc(MOST, sizeof *c->told);
    if (c->told && c->told_count < MOST)
        c->told[c->told_count++] = text_format("%s", m->rendered);
    return false;
}

void streams_write(struct cmd *c, const struct lambert_message *m)
{
    static const enum stream of[] = {[LAMBERT_NOTE] = STREAM_WARNING,
                                     [LAMBERT_WARNING] = STREAM_WARNING,
                                     [LAMBERT_ERROR] = STREAM_FATAL,
                                     [LAMBERT_SCENE_TEXT] = STREAM_DEBUG};
    put(c, of[m->kind], m->rendered);
}

int streams_close(struct cmd *c)
{
    for (size_t i = 0; i < c->told_count; i++)
        free(c->told[i]);
    free(c->told);
    c->told = NULL;
    c->told_count = 0;
    bool ok = true;
    for (int i = 0; i < STREAM_COUNT; i++) {
        if (c->stream[i] && (ferror(c->stream[i]) | fclose(c->stream[i])) != 0)
            ok = false;
        c->stream[i] = NULL;
    }
    return ok ? CMD_OK : cmd_fail(CMD_IO, "cannot write all messages to their files");
}

static void write_value(FILE *f, const char *keyword, const char *value)
{
    bool quoted = strpbrk(value, " \t;#") && !strchr(value, '"');
    bool text = strchr(value, '"') && !strchr(value, '\'');
    const char *quote = quoted ? "\"" : text ? "'" : "";
    fprintf(f, "%s=%s%s%s\n", keyword, quote, value, quote);
}

int settings_write(struct cmd *c)
{
    const char *path = lambert_option_text(c->ctx, "create-ini");
    const struct lambert_option *o;
    if (!path)
        return CMD_OK;
    FILE *f = fopen(path, "w");
    for (size_t i = 0; f && (o = lambert_option_at(i)); i++) {
        const char *const *list;
        size_t n = lambert_option_list(c->ctx, o->name, &list);
        if (!o->keyword || !lambert_option_is_set(c->ctx, o->name) ||
            strcmp(o->name, "create-ini") == 0 || o->kind == LAMBERT_OPTION_ACTION)
            continue;
        if (o->kind != LAMBERT_OPTION_LIST)
            write_value(f, o->keyword, lambert_option_text(c->ctx, o->name));
        for (size_t k = 0; o->kind == LAMBERT_OPTION_LIST && k < n; k++)
            write_value(f, o->keyword, list[k]);
    }
    if (f && (ferror(f) | fclose(f)) == 0)
        return CMD_OK;
    return cmd_fail(CMD_NO_OUTPUT, "cannot write '%s': %s", path, strerror(errno));
}
