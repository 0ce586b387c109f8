// INI files: `Keyword = value`, switches, [sections], comments with ; and #.
#include "cmd/cmd.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { INI_DEPTH_MAX = 10, INI_ERRORS_MOST = 20 };

struct ini {
    struct cmd *cmd;
    const char *path, *section;
    int depth;
    unsigned line;
    bool skipping; // in a section nobody asked for
    bool found;    // the section that was asked for
    char *others;  // the names of the other sections
};

static const char *skip_blanks(const char *s) { return s + strspn(s, " \t\r\n"); }

static size_t trimmed(const char *s, size_t n)
{
    while (n && strchr(" \t\r\n", s[n - 1]))
        n--;
    return n;
}

static int place_fail(const struct ini *in, int code)
{
    fprintf(stderr, "  in %s:%u\n", in->path, in->line);
    return code;
}

// Whether a word begins another option, so that the value before it is done.
static bool begins_option(const char *s)
{
    if (!*s || *s == ';' || *s == '#' || *s == '+' || *s == '-')
        return true;
    size_t n = strcspn(s, "= \t\r\n;#");
    const char *after = skip_blanks(s + n);
    return *after == '=' && cmdline_find_keyword(s, n);
}

// The value at s: quoted, one word, or, when no option follows it, all to the end.
static char *take_value(const char *s, bool whole_line, const char **end)
{
    if (whole_line) {
        *end = s + strlen(s);
        return text_format("%.*s", (int)trimmed(s, strlen(s)), s);
    }
    if (*s == '"' || *s == '\'') {
        const char *close = strchr(s + 1, *s);
        size_t n = close ? (size_t)(close - s - 1) : strlen(s + 1);
        *end = s + 1 + n + (close ? 1 : 0);
        return text_format("%.*s", (int)n, s + 1);
    }
    size_t n = strcspn(s, " \t\r\n;");
    if (!begins_option(skip_blanks(s + n)))
        n = trimmed(s, strcspn(s, ";"));
    *end = s + n;
    return text_format("%.*s", (int)n, s);
}

static int take_option(struct ini *in, const char *s, const char **end)
{
    size_t n = strcspn(s, "= \t\r\n;#");
    const char *value_at = skip_blanks(s + n);
    char *keyword, *value;
    int code;
    if (*value_at != '=') { // a bare file
        value = take_value(s, false, end);
        code = cmdline_file(in->cmd, value);
        free(value);
        return code;
    }
    keyword = text_format("%.*s", (int)n, s);
    bool command = n > 8 && text_same(s + n - 8, "_Command", 8);
    value = take_value(skip_blanks(value_at + 1), command, end);
    if (text_same(keyword, "Include_INI", 12))
        code = ini_read(in->cmd, value, NULL, in->depth + 1);
    else
        code = cmdline_keyword(in->cmd, keyword, value);
    free(keyword);
    free(value);
    return code;
}

static void enter_section(struct ini *in, const char *s)
{
    const size_t n = strcspn(s + 1, "]\r\n");
    in->skipping =
        !in->section || strlen(in->section) != n || !text_same(in->section, s + 1, n);
    in->found |= !in->skipping;
    if (!in->section || in->found)
        return;
    char *more = text_format("%s%s[%.*s]", in->others ? in->others : "",
                             in->others ? ", " : "", (int)n, s + 1);
    free(in->others);
    in->others = more;
}

static int take_line(struct ini *in, const char *s)
{
    s = skip_blanks(s);
    if (*s == '[') {
        enter_section(in, s);
        return CMD_OK;
    }
    while (!in->skipping && *s && *s != ';' && *s != '#') {
        int code;
        if (*s == '+' || *s == '-') {
            size_t n = strcspn(s, " \t\r\n;");
            char *arg = text_format("%.*s", (int)n, s);
            code = cmdline_switch(in->cmd, arg);
            free(arg);
            s += n;
        } else {
            code = take_option(in, s, &s);
        }
        if (code)
            return place_fail(in, code);
        s = skip_blanks(s);
    }
    return CMD_OK;
}

int ini_read(struct cmd *c, const char *path, const char *section, int depth)
{
    struct ini in = {.cmd = c, .path = path, .section = section, .depth = depth};
    if (depth > INI_DEPTH_MAX)
        return cmd_fail(CMD_USAGE, "%s: INI files include each other too deep", path);
    FILE *f = fopen(path, "r");
    char *with_extension = f ? NULL : text_format("%s.ini", path);
    if (!f && !(f = fopen(with_extension, "r"))) {
        free(with_extension);
        return cmd_fail(CMD_NO_INPUT, "cannot read '%s': %s", path, strerror(errno));
    }
    free(with_extension);
    char *line = NULL;
    size_t capacity = 0;
    int code = CMD_OK, errors = 0;
    while (errors < INI_ERRORS_MOST && getline(&line, &capacity, f) >= 0) {
        in.line++;
        const int of_line = take_line(&in, line);
        code = code ? code : of_line;
        errors += of_line != CMD_OK;
    }
    const bool failed = ferror(f);
    const int why = errno; // of a folder, for one
    free(line);
    fclose(f);
    if (failed)
        code = cmd_fail(CMD_NO_INPUT, "cannot read '%s': %s", path, strerror(why));
    if (!code && section && !in.found)
        cmd_warn(c, "%s has no section [%s]%s%s", path, section,
                 in.others ? "; it has " : "", in.others ? in.others : "");
    free(in.others);
    return code;
}
