// Photons in files.
#include "api/photon_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "api/context.h"
#include "base/whole_file.h"
#include "trace/photons.h"

struct header {
    char magic[8];
    uint32_t order, surface, media;
};
static const char magic[8] = "LPHO 1\n";

enum { FLOATS = 9, CHUNK = 1024 };

struct use {
    struct lambert_context *ctx;
    const char *load, *save;
    enum lambert_status status;
};

// ---- writing -------------------------------------------------------------------------

static bool write_map(FILE *f, const struct photon_map *m)
{
    for (uint32_t i = 0; i < m->count; i++) {
        const struct photon *p = &m->photon[i];
        const float v[FLOATS] = {p->p[0],     p->p[1],     p->p[2],
                                 p->from[0],  p->from[1],  p->from[2],
                                 p->energy.r, p->energy.g, p->energy.b};
        if (fwrite(v, sizeof v, 1, f) != 1)
            return false;
    }
    return true;
}

static void save(void *user, const struct photons *p)
{
    struct use *u = user;
    struct whole_file w;
    struct header h = {.order = 1, .surface = p->surface.count, .media = p->media.count};
    memcpy(h.magic, magic, sizeof magic);
    if (whole_file_begin(&w, u->save) &&
        whole_file_end(&w, fwrite(&h, sizeof h, 1, w.f) == 1 &&
                               write_map(w.f, &p->surface) && write_map(w.f, &p->media)))
        return;
    u->status = context_fail(u->ctx, LAMBERT_ERROR_OUTPUT, "cannot write '%s': %s",
                             u->save, strerror(errno));
}

// ---- reading -------------------------------------------------------------------------

// False where the file ends early or a number is none.
static bool read_map(FILE *f, uint32_t count, struct photon_map *m)
{
    static const struct photon none;
    float v[CHUNK][FLOATS];
    while (count) {
        const uint32_t n = count < CHUNK ? count : CHUNK;
        if (fread(v, sizeof *v, n, f) != n)
            return false;
        for (uint32_t i = 0; i < n; i++) {
            struct photon p = none;
            float sum = 0;
            for (int k = 0; k < FLOATS; k++)
                sum += fabsf(v[i][k]);
            if (!isfinite(sum))
                return false;
            memcpy(p.p, v[i], sizeof p.p);
            memcpy(p.from, v[i] + 3, sizeof p.from);
            p.energy = (struct rgb){v[i][6], v[i][7], v[i][8]};
            photon_add(m, &p);
        }
        count -= n;
    }
    return true;
}

static bool load(void *user, struct photons *p)
{
    struct use *u = user;
    struct header h;
    const char *why = NULL;
    FILE *f = fopen(u->load, "rb");
    if (!f)
        why = strerror(errno);
    else if (fread(&h, sizeof h, 1, f) != 1 ||
             memcmp(h.magic, magic, sizeof magic) != 0 || h.order != 1)
        why = "it holds no photons of this program and version";
    else if (!read_map(f, h.surface, &p->surface) || !read_map(f, h.media, &p->media) ||
             fgetc(f) != EOF)
        why = "it is cut off or damaged";
    if (f)
        fclose(f);
    if (why)
        u->status = context_fail(u->ctx, LAMBERT_ERROR_INPUT, "cannot use '%s': %s",
                                 u->load, why);
    return !why;
}

enum lambert_status photon_files_use(struct lambert_context *ctx,
                                     struct render_settings *settings,
                                     struct photons **out)
{
    const struct photon_settings *p = &ctx->scene.settings.photons;
    struct use u = {ctx, p->load_file, p->save_file, LAMBERT_OK};
    const struct photon_store store = {&u, u.load ? load : NULL, u.save ? save : NULL};
    *out = NULL;
    if (!p->on || (!u.load && !u.save))
        return LAMBERT_OK;
    settings->photons = *out = render_photons(ctx->world, settings, &store, &ctx->cancel);
    if (u.status == LAMBERT_OK)
        return LAMBERT_OK;
    photons_free(*out);
    *out = NULL;
    return u.status;
}
