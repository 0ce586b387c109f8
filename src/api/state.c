#define _POSIX_C_SOURCE 200809L // O_NOFOLLOW, ssize_t
#include "api/state.h"
#include "api/gi.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "api/context.h"
#include "base/digest.h"

// Numbers as this machine has them: `order` tells a state from another kind of machine.
struct header {
    char magic[16];
    uint32_t order, tiles;
    uint64_t key; // of scene, options and version
};
static const char magic[16] = "lambert-state-1";
static const uint32_t order = 0x01020304;

struct record {
    uint32_t tile;
    int32_t x0, y0, x1, y1;
    uint32_t unused;
    uint64_t digest; // of the above and the pixels
};

// Of a file's bytes; that it cannot be read counts as well.
static uint64_t digest_add_file(uint64_t digest, const char *path)
{
    FILE *f = fopen(path, "rb");
    char chunk[16384];
    size_t n;
    digest = digest_add(digest, f ? "file" : "none", 4);
    while (f && (n = fread(chunk, 1, sizeof chunk, f)) > 0)
        digest = digest_add(digest, chunk, n);
    if (f)
        fclose(f);
    return digest;
}

static uint64_t add_text(uint64_t digest, const char *text)
{
    return digest_add(digest, text ? text : "", text ? strlen(text) + 1 : 1);
}

// Options that may change a pixel; threads and where the picture goes do not.
static bool decides_pixels(const struct lambert_option *o)
{
    static const char *const groups[] = {"scene", "picture", "quality", "radiosity",
                                         "internal"};
    if (strcmp(o->group, "radiosity") == 0 &&
        (o->kind == LAMBERT_OPTION_FILE || strstr(o->name, "-file")))
        return false; // what is in them counts, not where they are
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++)
        if (strcmp(o->group, groups[i]) == 0)
            return true;
    return strcmp(o->name, "tile-size") == 0 || strcmp(o->name, "alpha") == 0 ||
           strcmp(o->name, "clockless") == 0;
}

uint64_t picture_key(const struct lambert_context *ctx)
{
    uint64_t key = add_text(digest_start, lambert_version());
    const struct lambert_option *o;
    for (size_t i = 0; (o = lambert_option_at(i)); i++) {
        const char *const *list;
        if (!decides_pixels(o))
            continue;
        key = add_text(add_text(key, o->name), lambert_option_text(ctx, o->name));
        size_t n = lambert_option_list(ctx, o->name, &list);
        for (size_t k = 0; k < n; k++)
            key = add_text(key, list[k]);
    }
    for (const struct read_file *f = ctx->files_read; f; f = f->next)
        key = digest_add_file(key, f->path);
    return text_key(ctx, key);
}

uint64_t text_key(const struct lambert_context *ctx, uint64_t key)
{
    for (uint32_t i = 0; i < ctx->sources.count; i++)
        key = digest_add(key, ctx->sources.file[i]->text, ctx->sources.file[i]->len);
    return key;
}

static uint64_t key_of(const struct lambert_context *ctx)
{
    const char *solution = gi_solution(ctx, true);
    return solution ? digest_add_file(picture_key(ctx), solution) : picture_key(ctx);
}

static size_t row_bytes(const struct image *im, int x0, int x1)
{
    return (size_t)(x1 - x0) * (size_t)im->channels * sizeof *im->pixel;
}

static struct record record_of(const struct image *im, const struct render_tile *tile)
{
    struct record r = {tile->index, tile->x0, tile->y0, tile->x1, tile->y1, 0, 0};
    r.digest = digest_add(digest_start, &r, offsetof(struct record, digest));
    for (int y = r.y0; y < r.y1; y++)
        r.digest = digest_add(r.digest, image_at(im, r.x0, y), row_bytes(im, r.x0, r.x1));
    return r;
}

static bool write_all(int file, const void *data, size_t n)
{
    for (const char *p = data; n;) {
        ssize_t got = write(file, p, n);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return false;
        p += got;
        n -= (size_t)got;
    }
    return true;
}

// A state that cannot be written must not stop the picture.
static void give_up(struct render_state *s)
{
    diag_at(&s->ctx->diags, DIAG_STATE_WRITE, (struct span){0}, s->path, strerror(errno));
    if (s->file >= 0)
        close(s->file);
    s->file = -1;
}

static void keep_tile(void *user, const struct render_tile *tile)
{
    struct render_state *s = user;
    if (s->file < 0)
        return;
    struct record r = record_of(s->picture, tile);
    bool ok = write_all(s->file, &r, sizeof r);
    for (int y = r.y0; ok && y < r.y1; y++)
        ok = write_all(s->file, image_at(s->picture, r.x0, y),
                       row_bytes(s->picture, r.x0, r.x1));
    if (!ok)
        give_up(s);
}

static void clear_tile(struct image *im, const struct render_tile *t)
{
    for (int y = t->y0; y < t->y1; y++)
        memset(image_at(im, t->x0, y), 0, row_bytes(im, t->x0, t->x1));
}

// One tile into the picture. False at the end and at what was not written whole.
static bool read_tile(struct render_state *s, FILE *f,
                      const struct render_settings *settings)
{
    struct record r;
    if (fread(&r, sizeof r, 1, f) != 1 || r.tile >= s->tiles)
        return false;
    struct render_tile tile = render_tile_at(settings, r.tile);
    if (tile.x0 != r.x0 || tile.y0 != r.y0 || tile.x1 != r.x1 || tile.y1 != r.y1 ||
        s->have[r.tile])
        return false;
    bool ok = true;
    for (int y = r.y0; ok && y < r.y1; y++)
        ok = fread(image_at(s->picture, r.x0, y), row_bytes(s->picture, r.x0, r.x1), 1,
                   f) == 1;
    if (!ok || record_of(s->picture, &tile).digest != r.digest) {
        clear_tile(s->picture, &tile);
        return false;
    }
    s->have[r.tile] = 1;
    s->restored++;
    return true;
}

// How much of the file is good: 0 when it is not this picture's.
static long restore(struct render_state *s, const struct header *wanted,
                    const struct render_settings *settings)
{
    FILE *f = fopen(s->path, "rb");
    struct header h;
    if (!f)
        return 0;
    long good = 0;
    if (fread(&h, sizeof h, 1, f) == 1 && memcmp(&h, wanted, sizeof h) == 0) {
        do
            good = ftell(f);
        while (read_tile(s, f, settings));
    } else {
        diag_at(&s->ctx->diags, DIAG_STATE_OTHER, (struct span){0}, s->path);
    }
    fclose(f);
    return good;
}

// Links are not followed and nothing that is no state is written over.
static bool open_file(struct render_state *s, long good, const struct header *h)
{
    if (good) {
        s->file = open(s->path, O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
        return s->file >= 0 && ftruncate(s->file, good) == 0;
    }
    if (unlink(s->path) != 0 && errno != ENOENT)
        return false;
    s->file = open(s->path, O_WRONLY | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return s->file >= 0 && write_all(s->file, h, sizeof *h);
}

static struct header header_of(const struct render_state *s)
{
    struct header h = {.order = order, .tiles = s->tiles, .key = key_of(s->ctx)};
    memcpy(h.magic, magic, sizeof magic);
    return h;
}

void render_state_open(struct render_state *s, struct lambert_context *ctx,
                       enum state_mode mode, const struct render_settings *settings,
                       struct image *picture)
{
    *s = (struct render_state){.ctx = ctx,
                               .path = ctx->state_path,
                               .settings = settings,
                               .picture = picture,
                               .tiles = render_tile_count(settings),
                               .file = -1};
    uint8_t *tiles = calloc((size_t)s->tiles + 1, 1);
    if (mode == STATE_AT_END) {
        s->done = tiles;
        return;
    }
    s->have = tiles;
    struct header h = header_of(s);
    long good = mode == STATE_RESUME && s->have ? restore(s, &h, settings) : 0;
    if (!open_file(s, good, &h))
        give_up(s);
}

static void mark_tile(void *user, const struct render_tile *tile)
{
    struct render_state *s = user;
    s->done[tile->index] = 1;
}

void render_state_attach(struct render_state *s, struct render_progress *progress)
{
    progress->have = s->have;
    progress->keep = s->done ? mark_tile : keep_tile;
    progress->keep_user = s;
}

static void write_done(struct render_state *s)
{
    struct header h = header_of(s);
    if (!open_file(s, 0, &h))
        give_up(s);
    for (uint32_t i = 0; i < s->tiles; i++) {
        struct render_tile tile = render_tile_at(s->settings, i);
        if (s->done[i])
            keep_tile(s, &tile);
    }
}

void render_state_close(struct render_state *s, bool whole)
{
    if (s->done && !whole && memchr(s->done, 1, s->tiles))
        write_done(s);
    if (s->file >= 0)
        close(s->file);
    s->ctx->state_is_over = whole;
    free(s->have);
    free(s->done);
}

void render_state_remove(struct lambert_context *ctx)
{
    if (ctx->state_is_over && ctx->state_path)
        unlink(ctx->state_path);
    ctx->state_is_over = false;
}
