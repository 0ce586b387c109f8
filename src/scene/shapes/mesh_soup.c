// mesh { triangle {} smooth_triangle {} ... }: triangles that say their corners themselves.
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "scene/shapes/mesh_read.h"

// Rows of one size that grow by doubling outside the arena, where what they grew out of
// would stay.
struct rows {
    void *at;
    uint32_t count, capacity;
};

static void *rows_add(struct rows *r, size_t size)
{
    r->at = must_grow(r->at, r->count, &r->capacity, size);
    return (char *)r->at + r->count++ * size;
}

// Rows without doubles: triangles side by side say the same corners, normals and textures.
struct table {
    struct rows rows;
    uint32_t *slot; // 1 + a row's number, by a hash of what it holds; 0: none
    uint32_t slots; // a power of two
};

enum { WORDS_MAX = 3 }; // of a row, of eight bytes

static uint32_t *slot_of(const struct table *t, const uint64_t *row, size_t words)
{
    uint64_t h = 0;
    for (size_t i = 0; i < words; i++)
        h = (h ^ row[i] ^ row[i] >> 32) * 0x9e3779b97f4a7c15u;
    const uint64_t *rows = t->rows.at;
    uint32_t at = (uint32_t)(h >> 32) & (t->slots - 1);
    while (t->slot[at] && memcmp(rows + (t->slot[at] - 1) * words, row, 8 * words) != 0)
        at = (at + 1) & (t->slots - 1);
    return &t->slot[at];
}

static void more_slots(struct table *t, size_t words)
{
    free(t->slot);
    t->slots = t->slots ? 2 * t->slots : 16;
    t->slot = must_calloc(t->slots, sizeof *t->slot);
    for (uint32_t i = 0; i < t->rows.count; i++)
        *slot_of(t, (const uint64_t *)t->rows.at + i * words, words) = i + 1;
}

// The number of the row that holds this.
static uint32_t table_add(struct table *t, const void *what, size_t size)
{
    enum { NEAR = 4 }; // the last rows are looked at first
    const size_t words = size / 8;
    uint64_t row[WORDS_MAX];
    memcpy(row, what, size);
    const uint64_t *rows = t->rows.at;
    for (uint32_t i = t->rows.count, k = 0; i-- > 0 && k < NEAR; k++)
        if (memcmp(rows + i * words, row, size) == 0)
            return i;
    if (2 * t->rows.count >= t->slots)
        more_slots(t, words);
    uint32_t *slot = slot_of(t, row, words);
    if (!*slot) {
        memcpy(rows_add(&t->rows, size), row, size);
        *slot = t->rows.count;
    }
    return *slot - 1;
}

// Normals, uv coordinates and textures of faces are there from the first triangle on that
// has some: those before it are filled in.
struct mesh_soup {
    struct table vertex, normal, uv, texture;
    struct rows face, face_normal, face_uv, face_texture;
    uint32_t zero_normals;
    bool failed;
};

static void table_free(struct table *t)
{
    free(t->slot);
    free(t->rows.at);
    *t = (struct table){0};
}

static void soup_end(void *soup)
{
    struct mesh_soup *s = soup;
    struct table *tables[] = {&s->vertex, &s->normal, &s->uv, &s->texture};
    struct rows *rows[] = {&s->face, &s->face_normal, &s->face_uv, &s->face_texture};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        table_free(tables[i]);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        free(rows[i]->at);
        *rows[i] = (struct rows){0};
    }
}

struct mesh_soup *mesh_soup_new(struct arena *a)
{
    struct mesh_soup *s = arena_new_struct(a, struct mesh_soup);
    arena_at_end(a, soup_end, s);
    return s;
}

typedef uint32_t corners[3];

// The row of the face that was just added, in what not all faces have.
static uint32_t *face_row(const struct mesh_soup *s, struct rows *r, uint32_t others)
{
    corners *row = NULL;
    while (r->count < s->face.count) {
        row = rows_add(r, sizeof *row);
        (*row)[0] = (*row)[1] = (*row)[2] = others;
    }
    return row ? *row : NULL;
}

// texture { T } or texture_list { T T T } of one triangle.
static bool read_textures(struct mesh_soup *s, struct args *block)
{
    const struct texture *x[3] = {NULL, NULL, NULL};
    struct args *list = args_block(block, "texture_list");
    if (list) {
        for (int i = 0; i < 3; i++)
            if (!(x[i] = args_texture(list))) {
                args_reject(list, "three declared textures are expected");
                return false;
            }
    } else {
        x[0] = x[1] = x[2] = args_texture(block);
    }
    if (!args_end(block) || args_at_texture(block)) {
        args_reject(block, "after the corners of a triangle only uv_vectors, texture { } "
                           "and texture_list { } may follow");
        return false;
    }
    if (x[0]) {
        uint32_t *row = face_row(s, &s->face_texture, UINT32_MAX);
        for (int i = 0; i < 3; i++)
            row[i] = table_add(&s->texture, &x[i], sizeof x[i]);
    }
    return true;
}

static void add_normals(struct mesh_soup *s, const struct vec3 n[3])
{
    uint32_t *row = face_row(s, &s->face_normal, UINT32_MAX);
    for (int i = 0; i < 3; i++) {
        const struct vec3 unit = mesh_read_normal(n[i], &s->zero_normals);
        row[i] = table_add(&s->normal, &unit, sizeof unit);
    }
}

// Row 0 of the uv coordinates is that of triangles without.
static void add_uv(struct mesh_soup *s, const struct vec2 uv[3])
{
    static const struct vec2 none = {0, 0};
    if (!s->uv.rows.count)
        table_add(&s->uv, &none, sizeof none);
    uint32_t *row = face_row(s, &s->face_uv, 0);
    for (int i = 0; i < 3; i++)
        row[i] = table_add(&s->uv, &uv[i], sizeof uv[i]);
}

static bool read_triangle(struct mesh_soup *s, struct args *block, bool smooth)
{
    struct vec3 p[3], n[3];
    struct vec2 uv[3];
    for (int i = 0; i < 3; i++)
        if (!args_vec3(block, "corner", &p[i]) ||
            (smooth && !args_vec3(block, "normal", &n[i])))
            return false;
    const bool mapped = args_word(block, "uv_vectors");
    for (int i = 0; i < 3 && mapped; i++)
        if (!args_vec2(block, "uv vector", &uv[i]))
            return false;
    uint32_t *face = rows_add(&s->face, sizeof(corners));
    for (int i = 0; i < 3; i++)
        face[i] = table_add(&s->vertex, &p[i], sizeof p[i]);
    if (smooth)
        add_normals(s, n);
    if (mapped)
        add_uv(s, uv);
    return read_textures(s, block);
}

void mesh_soup_add(struct mesh_soup *s, struct args *block, bool smooth)
{
    s->failed = s->failed || !read_triangle(s, block, smooth);
}

void mesh_soup_fail(struct mesh_soup *s) { s->failed = true; }

// The rows in the arena; NULL when there are none.
static void *rows_keep(const struct rows *r, struct arena *a, size_t size)
{
    return r->count ? memcpy(arena_alloc(a, r->count * size), r->at, r->count * size)
                    : NULL;
}

static void *table_keep(const struct table *t, struct arena *a, size_t size,
                        uint32_t *count)
{
    *count = t->rows.count;
    return rows_keep(&t->rows, a, size);
}

static void take(struct mesh *m, struct mesh_soup *s, struct arena *a)
{
    // Of what not all have, the faces after the last that has some.
    if (s->face_normal.count)
        face_row(s, &s->face_normal, UINT32_MAX);
    if (s->face_uv.count)
        face_row(s, &s->face_uv, 0);
    if (s->face_texture.count)
        face_row(s, &s->face_texture, UINT32_MAX);
    m->zero_normals = s->zero_normals;
    m->vertex = table_keep(&s->vertex, a, sizeof *m->vertex, &m->vertex_count);
    m->normal = table_keep(&s->normal, a, sizeof *m->normal, &m->normal_count);
    m->uv = table_keep(&s->uv, a, sizeof *m->uv, &m->uv_count);
    m->texture = table_keep(&s->texture, a, sizeof *m->texture, &m->texture_count);
    m->face_count = s->face.count;
    m->face = rows_keep(&s->face, a, sizeof *m->face);
    m->face_normal = rows_keep(&s->face_normal, a, sizeof *m->face_normal);
    m->face_uv = rows_keep(&s->face_uv, a, sizeof *m->face_uv);
    m->face_texture = rows_keep(&s->face_texture, a, sizeof *m->face_texture);
    soup_end(s);
}

static bool build_mesh(void *shape, struct args *args)
{
    struct mesh *m = shape;
    struct mesh_soup *soup = NULL, *more;
    for (;;) {
        if ((more = args_faces(args)))
            soup = more; // the same each time
        else if (!args_word(args, "inside_vector"))
            break;
        else if (!mesh_read_inside_vector(m, args))
            return false;
    }
    if (soup && soup->failed)
        return false;
    if (soup)
        take(m, soup, args_arena(args));
    return mesh_read_finish(m, args);
}

MESH_OPS(mesh);
