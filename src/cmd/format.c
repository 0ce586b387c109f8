#define _XOPEN_SOURCE 700 // realpath
// `lambert fmt FILE...`: scenes indented anew.
#include "cmd/cmd.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct text {
    char *at;
    size_t len;
};

static int read_file(const char *path, struct text *out)
{
    FILE *f = fopen(path, "rb"), *copy = open_memstream(&out->at, &out->len);
    char chunk[65536];
    size_t n;
    while (f && copy && (n = fread(chunk, 1, sizeof chunk, f)) > 0)
        fwrite(chunk, 1, n, copy);
    bool ok = f && copy && !ferror(f);
    int error = errno;
    if (f)
        fclose(f);
    if (copy)
        fclose(copy);
    return ok ? CMD_OK
              : cmd_fail(CMD_NO_INPUT, "cannot read '%s': %s", path, strerror(error));
}

static int formatted(struct cmd *c, const char *path, struct text *out)
{
    FILE *f = open_memstream(&out->at, &out->len);
    if (!f)
        return cmd_fail(CMD_FAILED, "out of memory");
    enum lambert_status status = lambert_format_file(c->ctx, path, f);
    fclose(f);
    return status == LAMBERT_OK
               ? CMD_OK
               : cmd_fail(cmd_exit_code(status), "%s", lambert_error(c->ctx));
}

// Beside the old file, then in its place: it is never half written. A link stays one.
static int replace_file(const char *path, const struct text *t)
{
    char *real = realpath(path, NULL);
    char *part = text_format("%s.part", real ? real : path);
    struct stat s;
    FILE *f = fopen(part, "wbx");
    bool ok = f && fwrite(t->at, 1, t->len, f) == t->len;
    if (f && fclose(f) != 0)
        ok = false;
    ok = ok && stat(path, &s) == 0 && chmod(part, s.st_mode & 07777) == 0 &&
         rename(part, real ? real : path) == 0;
    int error = errno;
    if (!ok && f)
        unlink(part);
    free(part);
    free(real);
    return ok ? CMD_OK
              : cmd_fail(CMD_NO_OUTPUT, "cannot write '%s': %s", path, strerror(error));
}

static int format_one(struct cmd *c, const char *path)
{
    struct text new = {0}, old = {0};
    bool check = lambert_option_number(c->ctx, "check") != 0;
    bool in_place = lambert_option_number(c->ctx, "in-place") != 0;
    int code = formatted(c, path, &new);
    if (!code && (check || in_place))
        code = read_file(path, &old);
    bool same = old.len == new.len && (!new.len || memcmp(old.at, new.at, new.len) == 0);
    if (code) {
    } else if (check && !same) {
        printf("%s\n", path);
        code = CMD_FAILED;
    } else if (in_place && !same) {
        code = replace_file(path, &new);
    } else if (!check && !in_place && fwrite(new.at, 1, new.len, stdout) != new.len) {
        code = cmd_fail(CMD_IO, "cannot write to standard output");
    }
    free(new.at);
    free(old.at);
    return code;
}

int cmd_format(struct cmd *c)
{
    int code = CMD_OK;
    if (!c->file_count)
        return cmd_fail(CMD_USAGE, "fmt takes scene files");
    for (size_t i = 0; i < c->file_count; i++) {
        int one = format_one(c, c->file[i]);
        code = one ? one : code;
    }
    return code;
}
