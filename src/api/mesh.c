// The objects of a scene as triangle meshes.
#include <stdio.h>
#include <stdlib.h>

#include "api/context.h"
#include "api/mesh_file.h"
#include "base/memory.h"
#include "base/stack.h"
#include "tess/contour.h"
#include "tess/parts.h"
#include "tess/sheet.h"

struct mesh_export {
    struct lambert_context *ctx;
    enum mesh_format format;
    const char *path;
    struct lambert_mesh_stats stats;
    bool ok;
};

static void left_out(struct mesh_export *e, const struct object *o)
{
    const char *why = !object_is_solid(o) ? "has no inside"
                      : aabb_is_finite(object_bounds(o))
                          ? "is empty, or finer than a cell"
                          : "has no end";
    diag_at(&e->ctx->diags, DIAG_MESH_LEFT_OUT, o->where, why);
}

static void one_mesh(struct mesh_export *e, struct arena *a, const struct object *o,
                     struct tess_mesh *out)
{
    const struct contour_settings settings = {
        .resolution = (int)option_number(e->ctx, "mesh-resolution"),
        .sharp = option_flag(e->ctx, "mesh-sharp")};
    struct tess_parts parts;
    tess_parts_of(a, o, &parts);
    if (parts.solid) {
        struct tess_solid solid;
        tess_solid_open(&solid, a, parts.solid);
        if (solid.world && !aabb_is_empty(solid.bounds))
            contour_solid(&solid, &settings, out);
        tess_solid_close(&solid);
        if (!out->triangle_count)
            left_out(e, parts.solid);
    }
    if (parts.sheet)
        sheet_mesh(parts.sheet, settings.resolution, out);
    if (parts.other)
        left_out(e, parts.other);
}

// On a large stack: objects may be thousands of levels deep.
static void write_meshes(void *user)
{
    struct mesh_export *e = user;
    const struct scene *scene = &e->ctx->scene;
    struct tess_mesh *mesh = must_calloc(scene->object_count + 1, sizeof *mesh);
    char(*text)[24] = must_calloc(scene->object_count + 1, sizeof *text);
    const char **name = must_calloc(scene->object_count + 1, sizeof *name);
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->object_count && !e->ctx->cancel; i++) {
        const struct object *o = scene->object[i];
        if (o->kind == OBJECT_LIGHT)
            continue;
        struct tess_mesh m = {0};
        struct arena *a = arena_new(1 << 16);
        one_mesh(e, a, o, &m);
        arena_free(a);
        e->stats.objects++;
        if (!m.triangle_count) {
            e->stats.left_out++;
            tess_mesh_free(&m);
            continue;
        }
        e->stats.vertices += m.vertex_count;
        e->stats.triangles += m.triangle_count;
        snprintf(text[count], sizeof *text, "object_%u", e->stats.objects);
        name[count] = text[count];
        mesh[count++] = m;
    }
    struct byte_buffer bytes = {0};
    const struct codec_error error = {e->ctx->error, sizeof e->ctx->error};
    if (count && !e->ctx->cancel) {
        mesh_encode(e->format, mesh, name, count, &bytes);
        e->ok = !bytes.failed ? file_write(e->path, &bytes, error)
                              : codec_fail(error, "out of memory");
    }
    free(bytes.data);
    for (uint32_t i = 0; i < count; i++)
        tess_mesh_free(&mesh[i]);
    free(mesh);
    free(text);
    free(name);
}

enum lambert_status lambert_mesh_write(struct lambert_context *ctx, const char *path,
                                       struct lambert_mesh_stats *out)
{
    struct mesh_export e = {.ctx = ctx, .format = mesh_format_of(path), .path = path};
    *out = e.stats;
    if (!ctx->world)
        return context_fail(ctx, LAMBERT_ERROR_ARGUMENT, "no scene is loaded");
    if (e.format == MESH_UNKNOWN)
        return context_fail(ctx, LAMBERT_ERROR_OPTION,
                            "'%s': there are meshes of type .obj, .stl and .ply", path);
    ctx->error[0] = '\0';
    stack_run(write_meshes, &e);
    *out = e.stats;
    if (ctx->cancel)
        return LAMBERT_CANCELLED;
    if (e.ok)
        return LAMBERT_OK;
    if (ctx->error[0])
        return LAMBERT_ERROR_OUTPUT;
    return context_fail(ctx, LAMBERT_ERROR_SCENE, "no object can be made a mesh");
}
