#include "scenes.h"

#include "test.h"

#include <stdlib.h>
#include <unistd.h>

struct scene_run scene_load_file(const char *path)
{
    struct scene_run s = {.ctx = lambert_context_new(), .arena = arena_new(4096)};
    if (lambert_load_file(s.ctx, path) != LAMBERT_OK)
        fail_msg("%s: %s", path, lambert_error(s.ctx));
    s.job = arena_alloc(s.arena, sizeof *s.job);
    job_init(s.job, s.arena, s.ctx->world, &render_settings_default);
    return s;
}

struct scene_run scene_load(const char *text)
{
    char path[] = "/tmp/lambert-radiosity-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    assert_true(write(file, text, strlen(text)) == (ssize_t)strlen(text));
    close(file);
    const struct scene_run s = scene_load_file(path);
    unlink(path);
    return s;
}

void scene_solve_loaded(struct scene_run *s, const struct radiosity_options *options)
{
    char error[512] = "";
    s->r = radiosity_new(s->job, options, NULL, error, sizeof error);
    if (!s->r)
        fail_msg("%s", error);
}

struct scene_run scene_solve(const char *text, const struct radiosity_options *options)
{
    struct scene_run s = scene_load(text);
    scene_solve_loaded(&s, options);
    return s;
}

void scene_free(struct scene_run *s)
{
    radiosity_free(s->r);
    arena_free(s->arena);
    lambert_context_free(s->ctx);
}

struct radiosity_options with(double patches, const char *solver)
{
    struct radiosity_options o = radiosity_defaults;
    o.patches.count = patches;
    o.solver.solver = solver;
    return o;
}

struct mean mean_of(const struct scene_run *s, bool (*which)(const struct element *))
{
    struct mean m = {.least = INFINITY, .most = -INFINITY};
    const struct patches *p = s->r->patches;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        if (which && !which(e))
            continue;
        const double b = s->r->solution.b[i][1];
        m.area += e->area;
        m.b += e->area * b;
        m.h += e->area * s->r->solution.h[i][1];
        m.least = fmin(m.least, b);
        m.most = fmax(m.most, b);
    }
    m.b /= m.area;
    m.h /= m.area;
    return m;
}

bool in_full(void) { return getenv("LAMBERT_RADIOSITY_FULL") != NULL; }
