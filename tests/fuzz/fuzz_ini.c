// Any bytes as an INI file: settings are taken or refused, whatever stands there.
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

#include "cmd/cmd.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// The command's own, without its output.
int cmd_fail(int code, const char *fmt, ...)
{
    va_list ap;
    char text[4096];
    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    return code;
}

void cmd_warn(struct cmd *c, const char *fmt, ...)
{
    va_list ap;
    char text[4096];
    va_start(ap, fmt);
    vsnprintf(text, sizeof text, fmt, ap);
    va_end(ap);
    c->warnings++;
}

static void read_section(const char *path, const char *section)
{
    struct cmd c = {.ctx = lambert_context_new(), .program = "lambert"};
    int code = CMD_OK;
    if (!c.ctx)
        abort();
    ini_read(&c, path, section, 0);
    if (c.file_count) // what comes next would use these names
        free(output_name(&c, c.file[c.file_count - 1], 7, 3, &code));
    lambert_context_free(c.ctx);
    cmdline_free(&c);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[] = "fuzz-XXXXXX";
    int fd = mkstemp(path);
    if (fd < 0 || write(fd, data, size) != (ssize_t)size)
        abort();
    close(fd);
    read_section(path, NULL);
    read_section(path, "High");
    unlink(path);
    return 0;
}
