// `lambert check FILE...`: all that a scene's text has to say, without a picture.
#include "cmd/cmd.h"

int cmd_check(struct cmd *c)
{
    int code = CMD_OK;
    if (!c->file_count)
        return cmd_fail(CMD_USAGE, "check takes scene files");
    for (size_t i = 0; i < c->file_count && !c->interrupted; i++) {
        if (c->verbose)
            fprintf(stderr, "lambert: reading %s\n", c->file[i]);
        enum lambert_status status = lambert_check_file(c->ctx, c->file[i]);
        if (status == LAMBERT_OK)
            continue;
        code = cmd_fail(cmd_exit_code(status), "%s", lambert_error(c->ctx));
    }
    return code;
}
