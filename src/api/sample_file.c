#include "api/sample_file.h"

#include <errno.h>
#include <string.h>

#include "api/context.h"
#include "api/gi.h"
#include "api/state.h"
#include "base/digest.h"
#include "base/whole_file.h"
#include "irradiance/cache.h"
#include "irradiance/store.h"

struct header {
    char magic[8];
    uint32_t order, count;
    uint64_t picture, text;
};
static const char magic[8] = "LIRR 1\n";

struct record {
    double p[3], n[3], to[3], nearest, radius, quality;
    float light[3];
    uint32_t depth;
};

static struct header header_of(const struct lambert_context *ctx, uint32_t count)
{
    struct header h = {.order = 1, .count = count};
    memcpy(h.magic, magic, sizeof magic);
    h.picture = picture_key(ctx);
    h.text = text_key(ctx, digest_start);
    return h;
}

// ---- writing -------------------------------------------------------------------------

static struct record record_of(const struct cache_sample *s)
{
    return (struct record){{s->p.x, s->p.y, s->p.z},
                           {s->n.x, s->n.y, s->n.z},
                           {s->to.x, s->to.y, s->to.z},
                           s->nearest,
                           s->radius,
                           s->quality,
                           {s->light.r, s->light.g, s->light.b},
                           s->depth};
}

static bool put(FILE *f, uint64_t *digest, const void *data, size_t size)
{
    *digest = digest_add(*digest, data, size);
    return fwrite(data, size, 1, f) == 1;
}

enum lambert_status samples_save(struct lambert_context *ctx,
                                 const struct irradiance_cache *c)
{
    const char *path = gi_solution(ctx, false);
    uint32_t count;
    uint64_t digest = digest_start;
    struct whole_file w;
    if (!path)
        return LAMBERT_OK;
    const struct cache_sample *sample = irradiance_cache_samples(c, &count);
    const struct header h = header_of(ctx, count);
    bool ok = whole_file_begin(&w, path);
    if (ok) {
        ok = put(w.f, &digest, &h, sizeof h);
        for (uint32_t i = 0; ok && i < count; i++) {
            const struct record r = record_of(&sample[i]);
            ok = put(w.f, &digest, &r, sizeof r);
        }
        ok = whole_file_end(&w, ok && fwrite(&digest, sizeof digest, 1, w.f) == 1);
    }
    return ok ? LAMBERT_OK
              : context_fail(ctx, LAMBERT_ERROR_OUTPUT, "cannot write '%s': %s", path,
                             strerror(errno));
}

// ---- reading -------------------------------------------------------------------------

static struct cache_sample sample_of(const struct record *r)
{
    struct cache_sample s = {.p = vec3(r->p[0], r->p[1], r->p[2]),
                             .radius = r->radius,
                             .n = vec3(r->n[0], r->n[1], r->n[2]),
                             .nearest = r->nearest,
                             .to = vec3(r->to[0], r->to[1], r->to[2])};
    s.quality = r->quality;
    s.light = rgb(r->light[0], r->light[1], r->light[2]);
    s.depth = r->depth;
    return s;
}

// Whether all of a file's samples came into the cache.
static bool read_samples(FILE *f, const struct header *h, struct irradiance_cache *c)
{
    uint64_t digest = digest_add(digest_start, h, sizeof *h), written;
    for (uint32_t i = 0; i < h->count; i++) {
        struct record r;
        if (fread(&r, sizeof r, 1, f) != 1)
            return false;
        digest = digest_add(digest, &r, sizeof r);
        const struct cache_sample s = sample_of(&r);
        if (!irradiance_cache_add(c, &s))
            return false;
    }
    return fread(&written, sizeof written, 1, f) == 1 && written == digest &&
           fgetc(f) == EOF;
}

enum lambert_status samples_load(struct lambert_context *ctx, struct irradiance_cache *c,
                                 struct samples_read *out)
{
    const char *path = gi_solution(ctx, true), *why = NULL;
    struct header h;
    *out = (struct samples_read){0};
    if (!path)
        return LAMBERT_OK;
    FILE *f = fopen(path, "rb");
    if (!f)
        why = strerror(errno);
    else if (fread(&h, sizeof h, 1, f) != 1 ||
             memcmp(h.magic, magic, sizeof magic) != 0 || h.order != 1)
        why = "it holds no radiosity samples of this program and version";
    else if (!read_samples(f, &h, c))
        why = "it is cut off or damaged";
    if (f)
        fclose(f);
    if (why)
        return context_fail(ctx, LAMBERT_ERROR_INPUT, "cannot use '%s': %s", path, why);
    const struct header here = header_of(ctx, h.count);
    if (h.text != here.text)
        diag_at(&ctx->diags, DIAG_BLOCK_WARNING, (struct span){0}, "radiosity",
                "the scene is no longer what it was when the samples of this file were "
                "taken: they show the light of then");
    *out = (struct samples_read){h.count, h.picture == here.picture};
    return LAMBERT_OK;
}
