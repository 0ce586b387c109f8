// Compiles pigments to steps (scene/pigment_tape.h).

#include "scene/pigment_tape.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "scene/image_map.h"
#include "scene/noise_kernel.h"
#include "scene/warp.h"

struct build {
    struct pigment_compiler *compiler;
    struct pigment_step *step;
    uint32_t count, capacity;
    int channels;
};

static struct pigment_step *add(struct build *b, enum pigment_op op, int level)
{
    if (b->count == b->capacity) {
        const uint32_t more = b->capacity ? 2 * b->capacity : 16;
        struct pigment_step *step =
            arena_new_array(b->compiler->arena, struct pigment_step, more);
        if (b->count)
            memcpy(step, b->step, b->count * sizeof *step);
        b->step = step;
        b->capacity = more;
    }
    struct pigment_step *s = &b->step[b->count++];
    *s = (struct pigment_step){.op = op, .level = level, .from = level};
    return s;
}

// The way into the pattern's space. Returns the level that has the point then.
static int add_place(struct build *b, const struct pattern *p, int from, int level)
{
    for (const struct warp *w = p->warps; w; w = w->next) {
        if (w->kind == WARP_TRANSFORM && w->transform.identity)
            continue;
        struct pigment_step *s = add(b,
                                     w->kind == WARP_TRANSFORM    ? PIGMENT_MOVE
                                     : w->kind == WARP_TURBULENCE ? PIGMENT_TURBULENCE
                                                                  : PIGMENT_WARP,
                                     level);
        s->from = from;
        if (w->kind == WARP_TRANSFORM)
            s->transform = &w->transform;
        else if (w->kind == WARP_TURBULENCE)
            s->turbulence = &w->turbulence;
        else
            s->warp = w;
        from = level;
    }
    if (turbulence_is_warp(p)) {
        struct pigment_step *s = add(b, PIGMENT_TURBULENCE, level);
        s->from = from;
        s->turbulence = p->turbulence;
        from = level;
    }
    add(b, PIGMENT_FAR, level)->from = from;
    return level;
}

static void add_value(struct build *b, const struct pattern *p, int from, int level)
{
    struct pigment_step *s = add(b, PIGMENT_VALUE, level);
    s->from = from;
    s->pattern = p;
}

static bool ascends(const float *key, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++)
        if (!(key[i - 1] <= key[i]))
            return false;
    return key[0] == key[0];
}

static void add_color(struct build *b, const struct rgbft *c, int level)
{
    add(b, PIGMENT_COLOR, level)->color = c;
    if (c->filter != 0 || c->transmit != 0)
        b->channels = 5;
}

// Of finite numbers the difference of equal ones is nothing; -0 would become 0.
static bool is_plain(float v) { return isfinite(v) && !(v == 0 && signbit(v)); }

static const struct pigment_ramp *ramp_new(struct arena *a, const struct color_map *m)
{
    struct pigment_ramp *r = arena_new_struct(a, struct pigment_ramp);
    const uint32_t room = (m->count + 7) & ~7u;
    float *v = arena_new_array(a, float, 6 * (size_t)room);
    *r = (struct pigment_ramp){.count = m->count, .opaque = true, .key = v};
    bool plain = ascends(m->key, m->count);
    for (uint32_t i = 0; i < room; i++) {
        const uint32_t k = i < m->count ? i : m->count - 1;
        const struct rgbft *c = &m->color[k];
        const float channel[5] = {c->r, c->g, c->b, c->filter, c->transmit};
        v[i] = m->key[k];
        plain &= isfinite(m->key[k]);
        for (int j = 0; j < 5; j++) {
            v[(size_t)(j + 1) * room + i] = channel[j];
            plain &= is_plain(channel[j]);
        }
        r->opaque &= c->filter == 0 && c->transmit == 0;
    }
    for (int j = 0; j < 5; j++)
        r->channel[j] = v + (size_t)(j + 1) * room;
    r->quick = plain;
    return r;
}

static const struct pigment_ramp *ramp_of(struct build *b, const struct color_map *m)
{
    struct pigment_compiler *c = b->compiler;
    const size_t i = ((uintptr_t)m >> 4 ^ (uintptr_t)m >> 12) % PIGMENT_RAMPS;
    if (c->map[i] != m) {
        c->map[i] = m;
        c->ramp[i] = ramp_new(c->arena, m);
    }
    if (!c->ramp[i]->opaque)
        b->channels = 5;
    return c->ramp[i];
}

static bool same_color(const struct rgbft *x, const struct rgbft *y)
{
    return memcmp(x, y, sizeof *x) == 0;
}

static bool is_even(const struct color_map *m)
{
    const struct rgbft *c = m->color;
    if (!is_plain(c->r) || !is_plain(c->g) || !is_plain(c->b) || !is_plain(c->filter) ||
        !is_plain(c->transmit))
        return false;
    for (uint32_t i = 1; i < m->count; i++)
        if (!same_color(c, &m->color[i]))
            return false;
    return true;
}

static bool add_pigment(struct build *b, const struct pigment *p, int from, int level);

static const float *keys_with_room(struct arena *a, const struct pigment_map *m)
{
    const uint32_t room = (m->count + 7) & ~7u;
    float *key = arena_new_array(a, float, room);
    for (uint32_t i = 0; i < room; i++)
        key[i] = m->key[i < m->count ? i : m->count - 1];
    return key;
}

static bool add_map(struct build *b, const struct pigment *p, int from, int level)
{
    const struct pigment_map *m = p->map;
    from = add_place(b, p->pattern, from, level);
    if (m->count == 1)
        return add_pigment(b, m->entry[0], from, level);
    add_value(b, p->pattern, from, level);
    struct pigment_keys *keys = arena_new_struct(b->compiler->arena, struct pigment_keys);
    uint32_t *entry = arena_new_array(b->compiler->arena, uint32_t, m->count);
    *keys = (struct pigment_keys){m->count, ascends(m->key, m->count),
                                  keys_with_room(b->compiler->arena, m), entry};
    add(b, PIGMENT_FIND, level)->keys = keys;
    for (uint32_t i = 0; i < m->count; i++) {
        entry[i] = i;
        for (uint32_t k = 0; k < i && entry[i] == i; k++)
            if (m->entry[k] == m->entry[i])
                entry[i] = k;
        if (entry[i] != i)
            continue;
        const uint32_t at = b->count;
        add(b, PIGMENT_ENTRY, level)->entry = i;
        if (!add_pigment(b, m->entry[i], from, level + 1))
            return false;
        add(b, PIGMENT_KEEP, level)->entry = i;
        b->step[at].next = b->count;
    }
    add(b, PIGMENT_BLEND, level);
    return true;
}

static bool add_average(struct build *b, const struct pigment *p, int from, int level)
{
    const struct pigment_map *m = p->map;
    float total = 0;
    from = add_place(b, p->pattern, from, level);
    add(b, PIGMENT_SUM_BEGIN, level);
    for (uint32_t i = 0; i < m->count; i++) {
        if (!add_pigment(b, m->entry[i], from, level + 1))
            return false;
        add(b, PIGMENT_SUM_ADD, level)->weight = m->key[i];
        total += m->key[i];
    }
    add(b, PIGMENT_SUM_END, level)->weight = total;
    if (!(total > 0)) // no numbers
        b->channels = 5;
    return true;
}

// Every colour of it, where it is seen at all.
static bool image_is_opaque(const struct image_map *m)
{
    bool opaque = m->filter_all == 0 && m->transmit_all == 0;
    const struct texels *t = m->texels;
    if (!t->indexed)
        return opaque && t->channels % 2;
    for (int i = 0; i < t->palette_count; i++)
        opaque &= m->palette[i].filter == 0 && m->palette[i].transmit == 0;
    return opaque;
}

static bool add_pigment(struct build *b, const struct pigment *p, int from, int level)
{
    static const struct rgbft none;
    if (level >= PIGMENT_LEVELS)
        return false;
    switch (p->kind) {
    case PIGMENT_NONE: add_color(b, &none, level); return true;
    case PIGMENT_SOLID: add_color(b, &p->color, level); return true;
    case PIGMENT_UV:
        add(b, PIGMENT_UV_POINT, level);
        return add_pigment(b, p->map->entry[0], level, level);
    case PIGMENT_COLORS:
        if (is_even(p->colors)) {
            add_color(b, p->colors->color, level);
            return true;
        }
        from = add_place(b, p->pattern, from, level);
        add_value(b, p->pattern, from, level);
        add(b, PIGMENT_RAMP, level)->ramp = ramp_of(b, p->colors);
        return true;
    case PIGMENT_MAP: return add_map(b, p, from, level);
    case PIGMENT_AVERAGE: return add_average(b, p, from, level);
    case PIGMENT_IMAGE:
        add_place(b, p->pattern, from, level);
        add(b, PIGMENT_TEXEL, level)->image = p->image;
        // Where it does not reach, maps around it mix in what is clear.
        if (!image_is_opaque(p->image) || (p->image->once && level > 1))
            b->channels = 5;
        return true;
    }
    return false;
}

const struct pigment_tape *pigment_compile(struct pigment_compiler *c,
                                           const struct pigment *p)
{
    struct build b = {.compiler = c, .channels = 3};
    if (!add_pigment(&b, p, 0, 1))
        return NULL;
    struct pigment_tape *t = arena_new_struct(c->arena, struct pigment_tape);
    *t = (struct pigment_tape){b.step, b.count, b.channels};
    return t;
}

// ---- what is asked for ----------------------------------------------------------------

static bool pattern_wants_uv(const struct pattern *p)
{
    return p && p->pigment && pigment_wants_uv(p->pigment);
}

bool pigment_wants_uv(const struct pigment *p)
{
    if (p->kind == PIGMENT_UV || pattern_wants_uv(p->pattern))
        return true;
    const bool mapped = p->kind == PIGMENT_MAP || p->kind == PIGMENT_AVERAGE;
    for (uint32_t i = 0; mapped && i < p->map->count; i++)
        if (pigment_wants_uv(p->map->entry[i]))
            return true;
    return false;
}

bool normal_wants_uv(const struct normal *n)
{
    if (n->kind == NORMAL_UV || pattern_wants_uv(&n->pattern))
        return true;
    const bool mapped = n->kind == NORMAL_MAP || n->kind == NORMAL_AVERAGE;
    for (uint32_t i = 0; mapped && i < n->map->count; i++)
        if (normal_wants_uv(n->map->entry[i]))
            return true;
    return false;
}

const struct surface_kernels *surface_kernels_find(const char *name)
{
    const struct noise_kernels *noise = noise_kernels_find(name);
#ifdef LAMBERT_X86
    if (noise && noise == surface_kernels_avx512.noise)
        return &surface_kernels_avx512;
    if (noise && noise == surface_kernels_avx2.noise)
        return &surface_kernels_avx2;
#endif
    return noise ? &surface_kernels_base : NULL;
}
