// Wavefront OBJ (text, an object a mesh), STL and PLY (little-endian binary).
#include "api/mesh_file.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

enum mesh_format mesh_format_of(const char *path)
{
    const char *dot = strrchr(path, '.');
    return !dot                           ? MESH_UNKNOWN
           : strcasecmp(dot, ".obj") == 0 ? MESH_OBJ
           : strcasecmp(dot, ".stl") == 0 ? MESH_STL
           : strcasecmp(dot, ".ply") == 0 ? MESH_PLY
                                          : MESH_UNKNOWN;
}

static void put_u32(struct byte_buffer *b, uint32_t v)
{
    const uint8_t bytes[4] = {(uint8_t)v, (uint8_t)(v >> 8), (uint8_t)(v >> 16),
                              (uint8_t)(v >> 24)};
    byte_buffer_append(b, bytes, sizeof bytes);
}

static void put_double_point(struct byte_buffer *b, struct vec3 p)
{
    for (int axis = 0; axis < 3; axis++) {
        const double d = vec3_axis(p, axis);
        uint64_t bits;
        memcpy(&bits, &d, sizeof bits);
        put_u32(b, (uint32_t)bits);
        put_u32(b, (uint32_t)(bits >> 32));
    }
}

static void put_point(struct byte_buffer *b, struct vec3 p)
{
    for (int axis = 0; axis < 3; axis++) {
        const float f = (float)vec3_axis(p, axis);
        uint32_t bits;
        memcpy(&bits, &f, sizeof bits);
        put_u32(b, bits);
    }
}

static void put_text(struct byte_buffer *b, const char *text, int n)
{
    byte_buffer_append(b, text, (size_t)n);
}

static void obj(const struct tess_mesh *mesh, const char *const *name, uint32_t count,
                struct byte_buffer *out)
{
    char line[160];
    uint32_t base = 1;
    put_text(out, line, snprintf(line, sizeof line, "# lambert\n"));
    for (uint32_t i = 0; i < count; i++) {
        const struct tess_mesh *m = &mesh[i];
        put_text(out, line, snprintf(line, sizeof line, "o %.100s\n", name[i]));
        for (uint32_t v = 0; v < m->vertex_count; v++)
            put_text(out, line,
                     snprintf(line, sizeof line, "v %.12g %.12g %.12g\n", m->vertex[v].x,
                              m->vertex[v].y, m->vertex[v].z));
        for (uint32_t t = 0; t < m->triangle_count; t++)
            put_text(out, line,
                     snprintf(line, sizeof line, "f %u %u %u\n", m->triangle[t][0] + base,
                              m->triangle[t][1] + base, m->triangle[t][2] + base));
        base += m->vertex_count;
    }
}

static uint32_t total_of(const struct tess_mesh *mesh, uint32_t count, bool triangles)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++)
        n += triangles ? mesh[i].triangle_count : mesh[i].vertex_count;
    return n;
}

static void stl(const struct tess_mesh *mesh, uint32_t count, struct byte_buffer *out)
{
    // Must not begin with "solid": that would be the text form.
    static const char head[80] = "lambert";
    byte_buffer_append(out, head, sizeof head);
    put_u32(out, total_of(mesh, count, true));
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t t = 0; t < mesh[i].triangle_count; t++) {
            const uint32_t *k = mesh[i].triangle[t];
            const struct vec3 a = mesh[i].vertex[k[0]], b = mesh[i].vertex[k[1]],
                              c = mesh[i].vertex[k[2]];
            const struct vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
            put_point(out, vec3_length(n) > 0 ? vec3_normalize(n) : n);
            put_point(out, a);
            put_point(out, b);
            put_point(out, c);
            byte_buffer_append(out, "\0\0", 2);
        }
    }
}

static void ply(const struct tess_mesh *mesh, uint32_t count, struct byte_buffer *out)
{
    char head[400];
    put_text(out, head,
             snprintf(head, sizeof head,
                      "ply\nformat binary_little_endian 1.0\ncomment lambert\n"
                      "element vertex %u\nproperty double x\nproperty double y\n"
                      "property double z\nelement face %u\n"
                      "property list uchar uint vertex_indices\nend_header\n",
                      total_of(mesh, count, false), total_of(mesh, count, true)));
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t v = 0; v < mesh[i].vertex_count; v++)
            put_double_point(out, mesh[i].vertex[v]);
    uint32_t base = 0;
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t t = 0; t < mesh[i].triangle_count; t++) {
            byte_buffer_append(out, "\3", 1);
            for (int k = 0; k < 3; k++)
                put_u32(out, mesh[i].triangle[t][k] + base);
        }
        base += mesh[i].vertex_count;
    }
}

void mesh_encode(enum mesh_format format, const struct tess_mesh *mesh,
                 const char *const *name, uint32_t count, struct byte_buffer *out)
{
    switch (format) {
    case MESH_STL: stl(mesh, count, out); break;
    case MESH_PLY: ply(mesh, count, out); break;
    default: obj(mesh, name, count, out);
    }
}
