// Rooms: the objects inside of which light can be.
#include "radiosity/patches.h"

#include <string.h>

#include "base/memory.h"
#include "trace/tracer.h"

// Inside of a disc is the half space below it, but what lies there is in the open; so is
// what lies inside of what patches do not see.
static bool encloses(const struct world *w, uint32_t object)
{
    const struct world_object *o = &w->object[object];
    return !(o->flags & OBJECT_NO_RADIOSITY) &&
           (o->is_csg || w->leaf[o->first_leaf].ops != &disc_ops);
}

bool patches_in_room(const struct patches *p, struct vec3 at)
{
    enum { MOST = 64 };
    uint32_t object[MOST];
    const uint32_t n = trace_containing(p->job->world, at, object, MOST);
    for (uint32_t i = 0, k = 0; i < n; i++) {
        while (k < p->room_count && p->room[k] < object[i])
            k++;
        if ((k == p->room_count || p->room[k] != object[i]) &&
            encloses(p->job->world, object[i]))
            return false;
    }
    return true;
}

static void room_add(struct patches *p, struct vec3 at, uint32_t except)
{
    enum { MOST = 64 };
    uint32_t object[MOST];
    const uint32_t n = trace_containing(p->job->world, at, object, MOST);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t k = 0;
        while (k < p->room_count && p->room[k] < object[i])
            k++;
        if (object[i] == except || !encloses(p->job->world, object[i]) ||
            (k < p->room_count && p->room[k] == object[i]))
            continue;
        memmove(p->room + k + 1, p->room + k, (p->room_count - k) * sizeof *p->room);
        p->room[k] = object[i];
        p->room_count++;
    }
}

static bool surface_glows(const struct surface *s)
{
    for (uint32_t i = 0; s->texture->kind == TEXTURE_PLAIN && i < s->texture->layer_count;
         i++) {
        const struct rgb e = s->texture->layer[i].finish->emission;
        if (e.r > 0 || e.g > 0 || e.b > 0)
            return true;
    }
    return false;
}

// Points just outside a chart; room: whether one of them lies where light can be.
enum { OUTSIDE_POINTS = 16 };
static uint32_t outside_points(const struct patches *p, const struct chart *c,
                               struct vec3 *out, bool *room)
{
    const struct leaf *l = &p->job->world->leaf[c->leaf];
    uint32_t n = 0;
    for (int k = 0; k < OUTSIDE_POINTS; k++) {
        struct vec3 at, normal;
        if (!chart_point(c, l, (k % 4 + .5) / 4, (k / 4 + .5) / 4, &at, &normal))
            continue;
        const double up = l->inverted ? -1e-6 : 1e-6;
        out[n] = vec3_mad(at, up * (vec3_max_abs(at) + p->size), normal);
        *room = *room || patches_in_room(p, out[n]);
        n++;
    }
    return n;
}

// A leaf that glows where no other light is: inside a solid object.
static void glow_room(struct patches *p, uint32_t leaf)
{
    struct vec3 at[OUTSIDE_POINTS];
    const uint32_t object = p->job->world->leaf[leaf].object;
    bool room = false;
    for (uint32_t c = p->leaf_first[leaf]; c < p->leaf_first[leaf + 1] && !room; c++)
        outside_points(p, &p->chart[c], at, &room);
    for (uint32_t c = p->leaf_first[leaf]; c < p->leaf_first[leaf + 1] && !room; c++) {
        bool ignored = false;
        const uint32_t n = outside_points(p, &p->chart[c], at, &ignored);
        for (uint32_t k = 0; k < n; k++)
            room_add(p, at[k], object);
    }
}

void patches_find_rooms(struct patches *p)
{
    const struct job *job = p->job;
    const struct world *w = job->world;
    p->room = must_calloc(w->object_count + 1, sizeof *p->room);
    room_add(p, job->camera->location, UINT32_MAX);
    for (uint32_t i = 0; i < job->lamp_count; i++)
        room_add(p, job->lamp[i].light->location, UINT32_MAX);
    for (uint32_t l = 0; l < w->leaf_count; l++)
        if (w->leaf[l].drawn && surface_glows(&w->surface[w->leaf[l].surface]))
            glow_room(p, l);
}
