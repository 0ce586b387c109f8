// mesh2 { vertex_vectors {} ... }, and what it has in common with mesh { } when read.
#include <stdio.h>
#include <string.h>

#include "base/arena.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/mesh_read.h"

static const double zero_normal_within = 1e-10;

struct vec3 mesh_read_normal(struct vec3 n, uint32_t *zero_normals)
{
    if (vec3_max_abs(n) >= zero_normal_within)
        return vec3_normalize(n);
    ++*zero_normals;
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

bool mesh_read_finish(struct mesh *m, struct args *args)
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

bool mesh_read_inside_vector(struct mesh *m, struct args *args)
{
    if (!args_vec3(args, "inside_vector", &m->inside_vector))
        return false;
    m->solid = vec3_dot(m->inside_vector, m->inside_vector) > 0;
    m->inside_vector = vec3_normalize(m->inside_vector);
    return true;
}

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
        *out = arena_grow(a, *out, i, &capacity, sizeof **out);
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
        m->uv = arena_grow(a, m->uv, i, &capacity, sizeof *m->uv);
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
    m->face_texture =
        arena_grow(a, m->face_texture, face, capacity, sizeof *m->face_texture);
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
        m->texture = arena_grow(a, m->texture, i, &capacity, sizeof *m->texture);
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
        *out = arena_grow(a, *out, i, &capacity, sizeof **out);
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
            ok = mesh_read_inside_vector(m, args);
        else
            break;
        if (!ok)
            return false;
    }
    for (uint32_t i = 0; i < m->normal_count; i++)
        m->normal[i] = mesh_read_normal(m->normal[i], &m->zero_normals);
    return default_indices(m, args, false, uvs, &m->face_uv) &&
           default_indices(m, args, true, normals, &m->face_normal) &&
           mesh_read_finish(m, args);
}

MESH_OPS(mesh2);
