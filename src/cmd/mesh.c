// `lambert mesh SCENE -o out.obj`: the scene's objects as triangle meshes.

#include "cmd/cmd.h"

int cmd_mesh(struct cmd *c)
{
    const char *path = lambert_option_text(c->ctx, "output");
    if (c->file_count != 1 || !path)
        return cmd_fail(CMD_USAGE, "mesh takes one scene and -o NAME.obj, .stl or .ply");
    enum lambert_status status = lambert_load_file(c->ctx, c->file[0]);
    if (status != LAMBERT_OK)
        return cmd_fail(cmd_exit_code(status), "%s", lambert_error(c->ctx));
    c->stage = STAGE_RENDER;
    struct lambert_mesh_stats stats;
    status = lambert_mesh_write(c->ctx, path, &stats);
    if (status != LAMBERT_OK)
        return cmd_fail(cmd_exit_code(status), "%s", lambert_error(c->ctx));
    if (!c->quiet)
        fprintf(stderr, "%s: %u of %u objects, %llu vertices, %llu triangles\n", path,
                stats.objects - stats.left_out, stats.objects,
                (unsigned long long)stats.vertices, (unsigned long long)stats.triangles);
    return CMD_OK;
}
