// Solutions in files: saved for other cameras, and as polygons.
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/digest.h"
#include "base/whole_file.h"
#include "radiosity/radiosity.h"

// ---- key ---------------------------------------------------------------------------
// Of everything that light depends on.
uint64_t radiosity_key(const struct radiosity *r)
{
    const struct patches *p = r->patches;
    uint64_t h = digest_start;
    h = digest_add(h, &p->element_count, sizeof p->element_count);
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        h = digest_add(h, e->corner, sizeof e->corner);
        h = digest_add(h, &e->area, sizeof e->area);
        h = digest_add(h, &e->reflectance, sizeof e->reflectance);
        h = digest_add(h, &e->emission, sizeof e->emission);
        h = digest_add(h, r->lamps[i], sizeof r->lamps[i]);
    }
    return h;
}

// ---- writing -----------------------------------------------------------------------
static bool cannot_write(const char *path, char *error, size_t error_size)
{
    snprintf(error, error_size, "cannot write '%s': %s", path, strerror(errno));
    return false;
}

static const char magic[8] = "LRAD 1\n";

struct header {
    char magic[8];
    uint64_t key;
    uint32_t count, number; // number: 1 in the writer's byte order
};

bool radiosity_save(const struct radiosity *r, const char *path, char *error,
                    size_t error_size)
{
    struct whole_file w;
    const struct radiosity_solution *s = &r->solution;
    struct header h = {.key = r->key, .count = s->count, .number = 1};
    memcpy(h.magic, magic, sizeof magic);
    if (!whole_file_begin(&w, path))
        return cannot_write(path, error, error_size);
    const bool ok = fwrite(&h, sizeof h, 1, w.f) == 1 &&
                    fwrite(s->b, sizeof *s->b, s->count, w.f) == s->count &&
                    fwrite(s->h, sizeof *s->h, s->count, w.f) == s->count &&
                    fwrite(s->h_emitted, sizeof *s->h_emitted, s->count, w.f) == s->count;
    return whole_file_end(&w, ok) || cannot_write(path, error, error_size);
}

bool radiosity_load(struct radiosity *r, const char *path, char *error, size_t error_size)
{
    struct header h;
    FILE *f = fopen(path, "rb");
    if (!f) {
        snprintf(error, error_size, "cannot read '%s': %s", path, strerror(errno));
        return false;
    }
    struct radiosity_solution *s = &r->solution;
    const char *why = NULL;
    if (fread(&h, sizeof h, 1, f) != 1 || memcmp(h.magic, magic, sizeof magic) != 0 ||
        h.number != 1)
        why = "it is no solution of this version";
    else if (h.key != r->key || h.count != r->patches->element_count)
        why = "it belongs to another scene, or to other patch settings";
    else if (!solution_init(s, h.count))
        why = "there is no memory";
    else if (fread(s->b, sizeof *s->b, h.count, f) != h.count ||
             fread(s->h, sizeof *s->h, h.count, f) != h.count ||
             fread(s->h_emitted, sizeof *s->h_emitted, h.count, f) != h.count ||
             fgetc(f) != EOF)
        why = "it is cut off or damaged";
    fclose(f);
    if (why)
        snprintf(error, error_size, "cannot use '%s': %s", path, why);
    return why == NULL;
}

bool radiosity_write_ply(const struct radiosity *r, const char *path, char *error,
                         size_t error_size)
{
    struct whole_file w;
    const struct patches *p = r->patches;
    if (!whole_file_begin(&w, path))
        return cannot_write(path, error, error_size);
    FILE *f = w.f;
    fprintf(f,
            "ply\nformat ascii 1.0\ncomment radiosity of patches\n"
            "element vertex %u\nproperty double x\nproperty double y\nproperty double z\n"
            "element face %u\nproperty list uchar uint vertex_indices\n"
            "property float red\nproperty float green\nproperty float blue\n"
            "property double area\nend_header\n",
            4 * p->element_count, p->element_count);
    for (uint32_t i = 0; i < p->element_count; i++)
        for (int k = 0; k < 4; k++) {
            const struct vec3 v = p->element[i].corner[k];
            fprintf(f, "%.9g %.9g %.9g\n", v.x, v.y, v.z);
        }
    for (uint32_t i = 0; i < p->element_count; i++) {
        const double *b = r->solution.b[i];
        fprintf(f, "4 %u %u %u %u %.7g %.7g %.7g %.9g\n", 4 * i, 4 * i + 1, 4 * i + 2,
                4 * i + 3, b[0], b[1], b[2], p->element[i].area);
    }
    return whole_file_end(&w, !ferror(f)) || cannot_write(path, error, error_size);
}
