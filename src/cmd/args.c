// The command line: GNU options, POV-Ray switches, INI keywords, files.
#include "cmd/cmd.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool text_same(const char *a, const char *b, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        char x = a[i], y = b[i];
        if (x >= 'A' && x <= 'Z')
            x = (char)(x + 32);
        if (y >= 'A' && y <= 'Z')
            y = (char)(y + 32);
        if (x != y)
            return false;
    }
    return true;
}

static bool is_name(const char *text, size_t n)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_";
    for (size_t i = 0; i < n; i++)
        if (!strchr(letters, text[i]) && (i == 0 || text[i] < '0' || text[i] > '9'))
            return false;
    return true;
}

// POV-Ray takes such declarations in silence: they declare nothing, or something else.
static void warn_of_declare(struct cmd *c, const char *text)
{
    const size_t name = strcspn(text, "=");
    const char *value = text + name + (text[name] == '=');
    char *end;
    strtod(value, &end);
    if (text[name] != '=' || name == 0 || !is_name(text, name))
        cmd_warn(c, "Declare=%s declares nothing; it is written Declare=NAME=NUMBER",
                 text);
    else if (*value != '"' && (end == value || end[strspn(end, " \t")]))
        cmd_warn(c, "Declare=%s: '%s' is no number; as much as can be read of it is used",
                 text, value);
}

// Anything but one of these is off, as in POV-Ray.
static bool is_switch(const char *text)
{
    static const char *const words[] = {"on",  "true",  "yes", "1",
                                        "off", "false", "no",  "0"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(text) >= strlen(words[i]) &&
            text_same(text, words[i], strlen(words[i])))
            return true;
    return false;
}

static bool is_folder(const char *path)
{
    struct stat st;
    return stat(path, &st) == 0 && S_ISDIR(st.st_mode);
}

static int cmdline_set(struct cmd *c, const struct lambert_option *o, const char *value)
{
    if (lambert_option_set(c->ctx, o->name, value) != LAMBERT_OK)
        return cmd_fail(CMD_USAGE, "%s", lambert_error(c->ctx));
    if (strcmp(o->name, "declare") == 0)
        warn_of_declare(c, value);
    if (o->kind == LAMBERT_OPTION_FLAG && !is_switch(value))
        cmd_warn(c, "'%s' is no value for %s, which is on or off; it is taken as off",
                 value, o->keyword ? o->keyword : o->name);
    if (strcmp(o->name, "library-path") == 0 && !is_folder(value))
        cmd_warn(c, "the library path '%s' is no folder that exists", value);
    return CMD_OK;
}

const struct lambert_option *cmdline_find_keyword(const char *keyword, size_t len)
{
    const struct lambert_option *o;
    for (size_t i = 0; (o = lambert_option_at(i)); i++)
        if (o->keyword && strlen(o->keyword) == len &&
            text_same(o->keyword, keyword, len))
            return o;
    return NULL;
}

static int set_named(struct cmd *c, const char *name, const char *value)
{
    return cmdline_set(c, lambert_option_find(name), value);
}

// What POV-Ray calls an option: where only the quality or the form of the picture depends
// on a number, one out of range is the nearest in it, as there.
static int set_pov(struct cmd *c, const struct lambert_option *o, const char *value)
{
    static const char *const groups[] = {"quality", "output", "compatibility"};
    bool forgives = false;
    char *end, near[32];
    const double n = strtod(value, &end), nearest = fmin(fmax(n, o->min), o->max);
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        forgives |= strcmp(o->group, groups[i]) == 0;
    if ((o->kind != LAMBERT_OPTION_INT && o->kind != LAMBERT_OPTION_FLOAT) || !forgives ||
        end == value || *end || !(fabs(n - nearest) > 0))
        return cmdline_set(c, o, value);
    snprintf(near, sizeof near, "%.9g", nearest);
    cmd_warn(c, "%s=%s is taken as %s: the range is %.9g to %.9g", o->keyword, value,
             near, o->min, o->max);
    return cmdline_set(c, o, near);
}

// POV-Ray's C is Targa with packed runs, its T plain.
static int set_type(struct cmd *c, const struct lambert_option *o, const char *value)
{
    const bool packed = strcmp(value, "C") == 0 || strcmp(value, "c") == 0;
    const int code = packed ? set_named(c, "compression", "1") : CMD_OK;
    return code ? code : cmdline_set(c, o, value);
}

// +F[type][bits][g], the parts behind the type in any order.
static int set_format(struct cmd *c, const char *switch_text, const char *rest, bool on)
{
    int code = set_named(c, "write", on ? "on" : "off");
    if (*rest && strchr("nNeEpPsStTcCjJbBhH", *rest) && !code) {
        char type[2] = {*rest++, 0};
        code = set_type(c, lambert_option_find("type"), type);
    }
    while (*rest && !code) {
        if (*rest == 'g' || *rest == 'G') {
            code = set_named(c, "grey", "on");
            rest++;
        } else if (*rest >= '0' && *rest <= '9') {
            const struct lambert_option *o = lambert_option_find("bits");
            const size_t n = strspn(rest, "0123456789");
            char *bits = text_format("%.*s", (int)n, rest);
            rest += n;
            code = set_pov(c, o, bits);
            free(bits);
        } else {
            return cmd_fail(CMD_USAGE,
                            "'%s' is no option: after +F come a file type, a "
                            "number of bits and g",
                            switch_text);
        }
    }
    return code;
}

// The longest name that is a prefix of the text. A name with a value fits only when
// something follows it, a name without only when nothing does.
static const struct lambert_option *find_switch(const char *text, const char **rest)
{
    const struct lambert_option *o, *best = NULL;
    size_t best_len = 0, len = strlen(text);
    for (size_t i = 0; (o = lambert_option_at(i)); i++) {
        size_t n = o->pov ? strlen(o->pov) : 0;
        bool valued = o->kind != LAMBERT_OPTION_FLAG;
        if (n <= best_len || n > len || !text_same(text, o->pov, n) ||
            valued != (n < len))
            continue;
        best = o;
        best_len = n;
    }
    *rest = text + best_len;
    return best;
}

// The switch of that name that takes a value.
static const struct lambert_option *find_whole(const char *text)
{
    const struct lambert_option *o;
    for (size_t i = 0; (o = lambert_option_at(i)); i++)
        if (o->pov && strlen(o->pov) == strlen(text) &&
            text_same(text, o->pov, strlen(text)))
            return o;
    return NULL;
}

static char *unquoted(const char *text)
{
    size_t n = strlen(text);
    if (n >= 2 && (text[0] == '"' || text[0] == '\'') && text[n - 1] == text[0])
        return text_format("%.*s", (int)(n - 2), text + 1);
    return text_format("%s", text);
}

int cmdline_switch(struct cmd *c, const char *arg)
{
    const char *rest;
    bool on = arg[0] == '+';
    const struct lambert_option *o = find_switch(arg + 1, &rest);
    if (!o && (o = find_whole(arg + 1)) != NULL)
        return cmd_fail(CMD_USAGE, "'%s' needs a value right behind it: %s%s", arg, arg,
                        o->value);
    if (!o && (arg[1] == 'F' || arg[1] == 'f'))
        return set_format(c, arg, arg + 2, on);
    if (!o && (arg[1] == 'A' || arg[1] == 'a'))
        return cmd_fail(CMD_USAGE, "'%s' is no option; a threshold is written +A0.3",
                        arg);
    if (!o)
        return cmd_fail(CMD_USAGE, "'%s' is no option; --help=all lists them", arg);
    if (o->kind == LAMBERT_OPTION_FLAG)
        return cmdline_set(c, o, on ? "on" : "off");
    if (o->turns) {
        int code = set_named(c, o->turns, on ? "on" : "off");
        if (code)
            return code;
    }
    char *value = unquoted(rest);
    int code = set_pov(c, o, value);
    free(value);
    if (code)
        fprintf(stderr, "  in '%s'\n", arg);
    return code;
}

int cmdline_keyword(struct cmd *c, const char *keyword, const char *value)
{
    size_t len = strlen(keyword);
    const struct lambert_option *o = cmdline_find_keyword(keyword, len);
    const char *near = o ? NULL : lambert_keyword_suggest(keyword);
    if (near)
        return cmd_fail(CMD_USAGE, "'%s' is no INI keyword; did you mean '%s'?", keyword,
                        near);
    if (!o)
        return cmd_fail(CMD_USAGE, "'%s' is no INI keyword; --help=all lists them",
                        keyword);
    if (strcmp(o->name, "include-ini") == 0)
        return ini_read(c, value, NULL, 1);
    if (strcmp(o->name, "type") == 0)
        return set_type(c, o, value);
    return set_pov(c, o, value);
}

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n >= m && text_same(text + n - m, end, m);
}

static void add_file(struct cmd *c, const char *name)
{
    if (c->file_count == c->file_capacity) {
        c->file_capacity = c->file_capacity ? 2 * c->file_capacity : 16;
        c->file = must_have(realloc(c->file, c->file_capacity * sizeof *c->file));
    }
    c->file[c->file_count++] = text_format("%s", name);
}

int cmdline_file(struct cmd *c, const char *name)
{
    size_t n = strlen(name);
    const char *bracket = strrchr(name, '[');
    if (n > 1 && name[n - 1] == '/')
        return set_named(c, "library-path", name);
    if (bracket && name[n - 1] == ']' && access(name, F_OK) != 0) {
        char *file = text_format("%.*s", (int)(bracket - name), name);
        char *section = text_format("%.*s", (int)(name + n - 2 - bracket), bracket + 1);
        int code = ini_read(c, file, section, 0);
        free(file);
        free(section);
        return code;
    }
    if (ends_with(name, ".ini"))
        return ini_read(c, name, NULL, 0);
    add_file(c, name);
    return set_named(c, "input", name);
}

void cmdline_free(struct cmd *c)
{
    for (size_t i = 0; i < c->file_count; i++)
        free(c->file[i]);
    free(c->file);
    free(c->held);
}

static int unknown_long(const char *name, size_t len)
{
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)len, name);
    const char *near = lambert_option_suggest(word);
    if (near)
        return cmd_fail(CMD_USAGE, "no option '--%s'; did you mean '--%s'?", word, near);
    return cmd_fail(CMD_USAGE, "no option '--%s'; --help=all lists them", word);
}

static const struct lambert_option *find_long(const char *name, size_t len)
{
    const struct lambert_option *o;
    for (size_t i = 0; (o = lambert_option_at(i)); i++)
        if (strlen(o->name) == len && memcmp(o->name, name, len) == 0 &&
            strcmp(o->group, "internal") != 0)
            return o;
    return NULL;
}

// *at: index of the argument; moved on when the value is the next one.
static int parse_valued(struct cmd *c, const struct lambert_option *o, const char *value,
                        int *at, int argc, char **argv)
{
    char first[32];
    if (value)
        return cmdline_set(c, o, value);
    if (o->kind == LAMBERT_OPTION_FLAG || o->kind == LAMBERT_OPTION_ACTION)
        return cmdline_set(c, o, "on");
    if (o->value && o->value[0] == '[') {
        snprintf(first, sizeof first, "%.*s", (int)strcspn(o->choices, "|"), o->choices);
        return cmdline_set(c, o, first);
    }
    if (*at + 1 >= argc)
        return cmd_fail(CMD_USAGE, "--%s needs a value: %s", o->name, o->value);
    return cmdline_set(c, o, argv[++*at]);
}

static int parse_long(struct cmd *c, int *at, int argc, char **argv)
{
    const char *name = argv[*at] + 2;
    size_t len = strcspn(name, "=");
    const char *value = name[len] ? name + len + 1 : NULL;
    const struct lambert_option *o = find_long(name, len);
    if (!o && strncmp(name, "no-", 3) == 0 && !value) {
        o = find_long(name + 3, len - 3);
        if (o && o->kind == LAMBERT_OPTION_FLAG)
            return cmdline_set(c, o, "off");
        o = NULL;
    }
    if (!o)
        return unknown_long(name, len);
    return parse_valued(c, o, value, at, argc, argv);
}

static const struct lambert_option *find_letter(const char *arg)
{
    const struct lambert_option *o;
    if (arg[0] != '-' || !arg[1] || arg[2])
        return NULL;
    if (arg[1] == '?')
        return lambert_option_find("help");
    for (size_t i = 0; (o = lambert_option_at(i)); i++)
        if (o->letter && o->letter[0] == arg[1])
            return o;
    return NULL;
}

// NAME=VALUE with a name that could be a keyword.
static bool is_keyword(const char *arg)
{
    size_t n = strcspn(arg, "=");
    return arg[n] && n == strspn(arg, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                      "abcdefghijklmnopqrstuvwxyz");
}

static int parse_keyword(struct cmd *c, const char *arg)
{
    size_t n = strcspn(arg, "=");
    char *keyword = text_format("%.*s", (int)n, arg);
    char *value = unquoted(arg + n + 1);
    int code = cmdline_keyword(c, keyword, value);
    free(keyword);
    free(value);
    return code;
}

static int parse_one(struct cmd *c, int *at, int argc, char **argv)
{
    const char *arg = argv[*at];
    const struct lambert_option *letter = find_letter(arg);
    if (strncmp(arg, "--", 2) == 0)
        return parse_long(c, at, argc, argv);
    if (letter)
        return parse_valued(c, letter, NULL, at, argc, argv);
    if ((arg[0] == '+' || arg[0] == '-') && arg[1])
        return cmdline_switch(c, arg);
    if (is_keyword(arg) && access(arg, F_OK) != 0)
        return parse_keyword(c, arg);
    return cmdline_file(c, arg);
}

int cmdline_parse(struct cmd *c, int argc, char **argv)
{
    bool only_files = false;
    for (int i = 1; i < argc; i++) {
        int code = CMD_OK;
        if (!only_files && strcmp(argv[i], "--") == 0)
            only_files = true;
        else if (only_files)
            code = cmdline_file(c, argv[i]);
        else
            code = parse_one(c, &i, argc, argv);
        if (code)
            return code;
    }
    return CMD_OK;
}
