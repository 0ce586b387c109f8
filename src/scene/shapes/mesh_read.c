// mesh { triangle {} smooth_triangle {} ... } and mesh2 { vertex_vectors {} ... }
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/mesh.h"

// An array that doubles in the arena.
static void *grown(struct arena *a, void *old, uint32_t count, uint32_t *capacity,
                   size_t size)
{
    if (count < *capacity)
        return old;
    const uint32_t more = *capacity ? 2 * *capacity : 64;
    void *p = arena_alloc(a, more * size);
    if (count)
        memcpy(p, old, count * size);
    *capacity = more;
    return p;
}

// Exporters write <0, 0, 0> where faces around a vertex cancel out. As in POV-Ray that is x;
// how many there were is said once.
static const double zero_normal_within = 1e-10;

static struct vec3 normal_read(struct mesh *m, struct vec3 n)
{
    if (vec3_max_abs(n) >= zero_normal_within)
        return vec3_normalize(n);
    m->zero_normals++;
    return vec3(1, 0, 0);
}

static const struct texture *whole_texture(const struct mesh *m)
{
    const uint32_t first = m->face_texture ? m->face_texture[0][0] : UINT32_MAX;
    bool same = first != UINT32_MAX;
    for (uint32_t i = 0; i < m->face_count && same; i++) {
        const uint32_t *t = m->face_texture[i];
        same = t[0] == first && t[1] == first && t[2] == first;
    }
    return same ? m->texture[first] : NULL;
}

static void *kept(struct arena *a, const void *from, size_t size)
{
    return memcpy(arena_alloc(a, size), from, size);
}

static bool finish(struct mesh *m, struct args *args)
{
    if (m->face_count == 0) {
        args_reject(args, "there are no triangles");
        return false;
    }
    if (m->zero_normals) {
        char text[80];
        snprintf(text, sizeof text,
                 "normals without length: %u; <1, 0, 0> is taken for each",
                 m->zero_normals);
        args_warn(args, text);
    }
    m->whole = whole_texture(m);
    mesh_finish(m, args_arena(args));
    return true;
}

static bool read_inside_vector(struct mesh *m, struct args *args)
{
    if (!args_vec3(args, "inside_vector", &m->inside_vector))
        return false;
    m->solid = vec3_dot(m->inside_vector, m->inside_vector) > 0;
    m->inside_vector = vec3_normalize(m->inside_vector);
    return true;
}

// ---- mesh -----------------------------------------------------------------------------

// Rows of one size that grow by doubling outside the arena, where what they grew out of
// would stay.
struct rows {
    void *at;
    uint32_t count, capacity;
};

static void *rows_add(struct rows *r, size_t size)
{
    if (r->count == r->capacity) {
        r->capacity = r->capacity ? 2 * r->capacity : 64;
        r->at = realloc(r->at, r->capacity * size);
        if (!r->at)
            abort();
    }
    return (char *)r->at + r->count++ * size;
}

// What a mesh is read into; normals, uv coordinates and textures from the first triangle on
// that has some: those before it are filled in.
struct soup {
    struct mesh *m;
    struct arena *arena;
    uint32_t textures_capacity;
    struct rows vertex, normal, uv, face, face_normal, face_uv, face_texture;
};

// The number of a texture of the mesh, which gets it unless it has it.
static uint32_t texture_number(struct mesh *m, struct arena *a, const struct texture *x,
                               uint32_t *capacity)
{
    for (uint32_t i = m->texture_count; i-- > 0;)
        if (m->texture[i] == x)
            return i;
    m->texture = grown(a, m->texture, m->texture_count, capacity, sizeof *m->texture);
    m->texture[m->texture_count] = x;
    return m->texture_count++;
}

// texture { T } or texture_list { T T T } of one triangle.
static bool read_textures(struct soup *s, struct args *block, uint32_t out[3])
{
    const struct texture *x;
    struct args *list = args_block(block, "texture_list");
    out[0] = out[1] = out[2] = UINT32_MAX;
    if (list) {
        for (int i = 0; i < 3; i++) {
            if (!(x = args_texture(list))) {
                args_reject(list, "three declared textures are expected");
                return false;
            }
            out[i] = texture_number(s->m, s->arena, x, &s->textures_capacity);
        }
    } else if ((x = args_texture(block))) {
        out[0] = out[1] = out[2] =
            texture_number(s->m, s->arena, x, &s->textures_capacity);
    }
    if (args_end(block) && !args_at_texture(block))
        return true;
    args_reject(block, "after the corners of a triangle only uv_vectors, texture { } and "
                       "texture_list { } may follow");
    return false;
}

typedef uint32_t corners[3];

// The row of the face that was just added, in what not all faces have.
static uint32_t *face_row(const struct soup *s, struct rows *r, uint32_t others)
{
    corners *row = NULL;
    while (r->count < s->face.count) {
        row = rows_add(r, sizeof *row);
        (*row)[0] = (*row)[1] = (*row)[2] = others;
    }
    return row ? *row : NULL;
}

static void add_normals(struct soup *s, const struct vec3 n[3])
{
    uint32_t *row = face_row(s, &s->face_normal, UINT32_MAX);
    for (int i = 0; i < 3; i++) {
        row[i] = s->normal.count;
        *(struct vec3 *)rows_add(&s->normal, sizeof *n) = normal_read(s->m, n[i]);
    }
}

// Corner 0 of the uv coordinates is that of triangles without.
static void add_uv(struct soup *s, const struct vec2 uv[3])
{
    if (!s->uv.count)
        *(struct vec2 *)rows_add(&s->uv, sizeof *uv) = (struct vec2){0, 0};
    uint32_t *row = face_row(s, &s->face_uv, 0);
    for (int i = 0; i < 3; i++) {
        row[i] = s->uv.count;
        *(struct vec2 *)rows_add(&s->uv, sizeof *uv) = uv[i];
    }
}

static bool read_triangle(struct soup *s, struct args *block, bool smooth)
{
    struct vec3 p[3], n[3];
    struct vec2 uv[3];
    uint32_t texture[3];
    for (int i = 0; i < 3; i++)
        if (!args_vec3(block, "corner", &p[i]) ||
            (smooth && !args_vec3(block, "normal", &n[i])))
            return false;
    const bool mapped = args_word(block, "uv_vectors");
    for (int i = 0; i < 3 && mapped; i++)
        if (!args_vec2(block, "uv vector", &uv[i]))
            return false;
    uint32_t *face = rows_add(&s->face, sizeof(corners));
    for (int i = 0; i < 3; i++) {
        face[i] = s->vertex.count;
        *(struct vec3 *)rows_add(&s->vertex, sizeof *p) = p[i];
    }
    if (smooth)
        add_normals(s, n);
    if (mapped)
        add_uv(s, uv);
    if (!read_textures(s, block, texture))
        return false;
    if (texture[0] != UINT32_MAX)
        memcpy(face_row(s, &s->face_texture, UINT32_MAX), texture, sizeof texture);
    return true;
}

static bool read_soup(struct soup *s, struct args *args)
{
    for (;;) {
        struct args *block;
        if ((block = args_block(args, "triangle"))) {
            if (!read_triangle(s, block, false))
                return false;
        } else if ((block = args_block(args, "smooth_triangle"))) {
            if (!read_triangle(s, block, true))
                return false;
        } else if (args_word(args, "inside_vector")) {
            if (!read_inside_vector(s->m, args))
                return false;
        } else {
            return true;
        }
    }
}

// The rows in the arena; NULL when there are none. Frees them.
static void *rows_keep(struct rows *r, struct arena *a, size_t size)
{
    void *all = r->count ? kept(a, r->at, r->count * size) : NULL;
    free(r->at);
    return all;
}

static bool build_mesh(void *shape, struct args *args)
{
    struct mesh *m = shape;
    struct arena *a = args_arena(args);
    struct soup s = {.m = m, .arena = a};
    const bool ok = read_soup(&s, args);
    // Of what not all have, the faces after the last that has some.
    if (s.face_normal.count)
        face_row(&s, &s.face_normal, UINT32_MAX);
    if (s.face_uv.count)
        face_row(&s, &s.face_uv, 0);
    if (s.face_texture.count)
        face_row(&s, &s.face_texture, UINT32_MAX);
    m->vertex_count = s.vertex.count;
    m->normal_count = s.normal.count;
    m->uv_count = s.uv.count;
    m->face_count = s.face.count;
    m->vertex = rows_keep(&s.vertex, a, sizeof *m->vertex);
    m->normal = rows_keep(&s.normal, a, sizeof *m->normal);
    m->uv = rows_keep(&s.uv, a, sizeof *m->uv);
    m->face = rows_keep(&s.face, a, sizeof *m->face);
    m->face_normal = rows_keep(&s.face_normal, a, sizeof *m->face_normal);
    m->face_uv = rows_keep(&s.face_uv, a, sizeof *m->face_uv);
    m->face_texture = rows_keep(&s.face_texture, a, sizeof *m->face_texture);
    return ok && finish(m, args);
}

// ---- mesh2 -----------------------------------------------------------------------------

static bool read_count(struct args *block, uint32_t *out)
{
    long n;
    if (!args_int(block, "count", &n))
        return false;
    if (n < 0 || n > 500000000) {
        args_reject(block, "the count is out of range");
        return false;
    }
    *out = (uint32_t)n;
    return true;
}

static bool read_vectors(struct args *block, struct arena *a, struct vec3 **out,
                         uint32_t *count)
{
    uint32_t n, capacity = 0;
    struct args_vectors all;
    if (args_vectors(block, &all)) {
        *out = kept(a, all.number, all.count * sizeof **out);
        *count = all.count;
        return true;
    }
    if (!read_count(block, &n))
        return false;
    // Grown as they come: the count may lie about a file that ends early.
    for (uint32_t i = 0; i < n; i++) {
        *out = grown(a, *out, i, &capacity, sizeof **out);
        if (!args_vec3(block, "vector", &(*out)[i]))
            return false;
    }
    *count = n;
    return true;
}

static bool read_uvs(struct args *block, struct arena *a, struct mesh *m)
{
    uint32_t n, capacity = 0;
    struct args_vectors all;
    if (args_vectors(block, &all)) {
        m->uv = kept(a, all.number, all.count * sizeof *m->uv);
        m->uv_count = all.count;
        return true;
    }
    if (!read_count(block, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        m->uv = grown(a, m->uv, i, &capacity, sizeof *m->uv);
        if (!args_vec2(block, "uv vector", &m->uv[i]))
            return false;
    }
    m->uv_count = n;
    return true;
}

// Up to three numbers behind the corners of a face.
static bool read_face_textures(struct mesh *m, struct args *block, struct arena *a,
                               uint32_t face, uint32_t *capacity)
{
    uint32_t index[3], n = 0;
    for (; n < 3 && args_at_number(block) && !args_at_vector(block); n++) {
        long at;
        if (!args_int(block, "texture index", &at))
            return false;
        if (at < 0 || at >= (long)m->texture_count) {
            args_reject(block, "a texture index is out of range");
            return false;
        }
        index[n] = (uint32_t)at;
    }
    if (n == 2) {
        args_reject(block, "a face has one texture index or three");
        return false;
    }
    if (m->texture_count == 0)
        return true;
    m->face_texture = grown(a, m->face_texture, face, capacity, sizeof *m->face_texture);
    for (uint32_t i = 0; i < 3; i++)
        m->face_texture[face][i] = n == 0 ? UINT32_MAX : index[n == 1 ? 0 : i];
    return true;
}

static bool read_texture_list(struct mesh *m, struct args *block, struct arena *a)
{
    uint32_t n, capacity = 0;
    if (!read_count(block, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        const struct texture *x = args_texture(block);
        if (!x) {
            args_reject(block, "there are fewer textures than said");
            return false;
        }
        m->texture = grown(a, m->texture, i, &capacity, sizeof *m->texture);
        m->texture[i] = x;
        m->texture_count = i + 1;
    }
    return true;
}

static bool take_indices(struct args *block, struct arena *a, uint32_t limit,
                         const struct args_vectors *all, struct mesh *textures,
                         uint32_t (**out)[3], uint32_t *count)
{
    for (size_t i = 0; i < (size_t)all->count * 3; i++)
        if (all->index[i] >= limit) {
            args_reject(block, "an index is out of range");
            return false;
        }
    *out = kept(a, all->index, all->count * sizeof **out);
    if (textures && textures->texture_count) { // none of the faces has one
        const size_t size = all->count * sizeof *textures->face_texture;
        textures->face_texture = memset(arena_alloc(a, size), 0xff, size);
    }
    *count = all->count;
    return true;
}

static bool read_indices(struct args *block, struct arena *a, uint32_t limit,
                         struct mesh *textures, uint32_t (**out)[3], uint32_t *count)
{
    uint32_t n, capacity = 0, texture_capacity = 0;
    struct args_vectors all;
    if (args_vectors(block, &all))
        return take_indices(block, a, limit, &all, textures, out, count);
    if (!read_count(block, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        struct vec3 v;
        *out = grown(a, *out, i, &capacity, sizeof **out);
        if (!args_vec3(block, "indices", &v))
            return false;
        const double at[3] = {v.x, v.y, v.z};
        for (int k = 0; k < 3; k++) {
            if (!(at[k] > -1 && at[k] < limit)) {
                args_reject(block, "an index is out of range");
                return false;
            }
            (*out)[i][k] = (uint32_t)at[k];
        }
        if (textures && !read_face_textures(textures, block, a, i, &texture_capacity))
            return false;
    }
    *count = n;
    return true;
}

// Faces without indices of their own use those of the corners, if the counts agree.
static bool default_indices(struct mesh *m, struct args *args, bool normals,
                            uint32_t given, uint32_t (**index)[3])
{
    const uint32_t n = normals ? m->normal_count : m->uv_count;
    if (n == 0 || given == m->face_count)
        return true;
    if (given == 0 && n == m->vertex_count) {
        *index = m->face;
        return true;
    }
    if (given == 0 && !normals && n == 1) {
        *index = arena_alloc(args_arena(args), m->face_count * sizeof **index);
        return true;
    }
    if (normals && given > 0 && given < m->face_count) { // the rest are flat
        uint32_t(*all)[3] = arena_alloc(args_arena(args), m->face_count * sizeof *all);
        memset(all, 0xff, m->face_count * sizeof *all);
        memcpy(all, *index, given * sizeof *all);
        *index = all;
        return true;
    }
    args_reject(args, normals
                          ? "the counts of normals and vertices differ and there are no "
                            "normal_indices"
                          : "uv_indices are missing or their count differs");
    return false;
}

static bool build_mesh2(void *shape, struct args *args)
{
    struct mesh *m = shape;
    struct arena *a = args_arena(args);
    uint32_t uvs = 0, normals = 0;
    for (;;) {
        struct args *block;
        bool ok = true;
        if ((block = args_block(args, "vertex_vectors")))
            ok = read_vectors(block, a, &m->vertex, &m->vertex_count);
        else if ((block = args_block(args, "normal_vectors")))
            ok = read_vectors(block, a, &m->normal, &m->normal_count);
        else if ((block = args_block(args, "uv_vectors")))
            ok = read_uvs(block, a, m);
        else if ((block = args_block(args, "texture_list")))
            ok = read_texture_list(m, block, a);
        else if ((block = args_block(args, "face_indices")))
            ok = read_indices(block, a, m->vertex_count, m, &m->face, &m->face_count);
        else if ((block = args_block(args, "uv_indices")))
            ok = read_indices(block, a, m->uv_count, NULL, &m->face_uv, &uvs);
        else if ((block = args_block(args, "normal_indices")))
            ok = read_indices(block, a, m->normal_count, NULL, &m->face_normal, &normals);
        else if (args_word(args, "inside_vector"))
            ok = read_inside_vector(m, args);
        else
            break;
        if (!ok)
            return false;
    }
    for (uint32_t i = 0; i < m->normal_count; i++)
        m->normal[i] = normal_read(m, m->normal[i]);
    return default_indices(m, args, false, uvs, &m->face_uv) &&
           default_indices(m, args, true, normals, &m->face_normal) && finish(m, args);
}

#define MESH_OPS(word)                                                                   \
    const struct shape_ops word##_ops = {                                                \
        .keyword = #word,                                                                \
        .size = sizeof(struct mesh),                                                     \
        .flags = SHAPE_BOUNDED | SHAPE_HIERARCHY | SHAPE_UV | SHAPE_FLAT,                \
        .build = build_##word,                                                           \
        .bounds = mesh_bounds,                                                           \
        .is_solid = mesh_is_solid,                                                       \
        .inside = mesh_inside,                                                           \
        .intersect = mesh_intersect,                                                     \
        .closest = mesh_closest,                                                         \
        .surface = mesh_surface,                                                         \
        .texture = mesh_texture,                                                         \
        .textures_at = mesh_textures_at,                                                 \
        .print = mesh_print,                                                             \
    }

MESH_OPS(mesh);
MESH_OPS(mesh2);
