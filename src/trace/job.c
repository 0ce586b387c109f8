#include "trace/job.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "scene/mesh_camera.h"
#include "scene/pigment_tape.h"
#include "trace/accel.h"
#include "trace/media.h"
#include "trace/packet.h"
#include "trace/paint.h"
#include "trace/photons.h"
#include "trace/projected.h"
#include "trace/scout.h"
#include "trace/simple.h"
#include "trace/sky.h"
#include "trace/subsurface.h"

static const struct lamp *lamp_of(struct job *job, struct arena *a,
                                  const struct light *light)
{
    for (uint32_t i = 0; i < job->lamp_count; i++)
        if (job->lamp[i].light == light)
            return &job->lamp[i];
    struct lamp *lamp = &job->lamp[job->lamp_count];
    lamp_init(lamp, light, job->lamp_count++);
    if (light->projected_through)
        lamp->window = window_new(a, light->projected_through);
    lamp->dull |= job->settings.purpose == RENDER_GATHER;
    lamp->inert |= job->settings.purpose == RENDER_SCOUT;
    return lamp;
}

static void lamps_init(struct job *job, struct arena *a, const struct world *w)
{
    uint32_t most = w->light_count;
    for (uint32_t g = 0; g < w->light_group_count; g++)
        most += w->light_group[g].count;
    job->lamp = arena_new_array(a, struct lamp, most + 1);
    struct lamp_list *list =
        arena_new_array(a, struct lamp_list, w->light_group_count + 1);
    for (uint32_t g = 0; g <= w->light_group_count; g++) {
        const struct light_group *group = g ? &w->light_group[g - 1] : NULL;
        const uint32_t global = !group || group->global_lights ? w->light_count : 0;
        const uint32_t count = global + (group ? group->count : 0);
        const struct lamp **lamp = arena_new_array(a, const struct lamp *, count + 1);
        for (uint32_t i = 0; i < global; i++)
            lamp[i] = lamp_of(job, a, w->light[i]);
        for (uint32_t i = global; i < count; i++)
            lamp[i] = lamp_of(job, a, group->light[i - global]);
        list[g] = (struct lamp_list){lamp, count};
    }
    job->lamps = list;
}

// The three bands of spec/lighting.md 6.3, before they are scaled.
static void spectrum_height(double wavelength, double h[3])
{
    const double k = 0.964 - 0.934 * (740 - wavelength) / 365;
    const double red = 5 * (k - 0.75), violet = 4 * (k - 0.12), green = 4.5 * (k - 0.57),
                 blue = 4 * (k - 0.28);
    h[0] = 1.15 - red * red;
    if (h[0] < 0)
        h[0] = fmax(0, 0.12 - violet * violet);
    h[1] = fmax(0, 0.97 * (1.1 - green * green));
    h[2] = fmax(0, 0.98 * (1 - blue * blue));
}

static void spectrum_init(struct job *job)
{
    double sum[3] = {0}, so_far[3] = {0}, h[3];
    for (int i = 0; i < SPECTRUM_NODES; i++) {
        spectrum_height(375 + 5 * i, h);
        for (int k = 0; k < 3; k++)
            sum[k] += h[k];
    }
    for (int i = 0; i < SPECTRUM_NODES; i++) {
        spectrum_height(375 + 5 * i, h);
        for (int k = 0; k < 3; k++) {
            so_far[k] += h[k];
            job->spectrum[i][k] = (float)(floor(so_far[k] / sum[k] * 1e4 + 0.5) / 1e4);
        }
    }
}

static void sky_init(struct job *job)
{
    const struct scene *s = job->scene;
    job->has_air = job->air && (s->fog_count || s->rainbow_count || job->has_media);
    job->even_sky = !s->sky;
    for (int opaque = 0; opaque < 2 && job->even_sky; opaque++)
        job->sky[opaque] = sky_color(job, vec3(0, 0, 1), opaque, &job->sky_clear[opaque]);
}

// Boxes are grown by this much of their coordinates: many times what crossings are off.
static const double clear_margin = 1e-6;

static struct aabb grown(struct aabb b)
{
    const double by = clear_margin * fmax(vec3_max_abs(b.min), vec3_max_abs(b.max));
    return (struct aabb){vec3_sub(b.min, vec3(by, by, by)),
                         vec3_add(b.max, vec3(by, by, by))};
}

// Boxes of the objects that let light through: few, so that asking costs little.
static void clear_init(struct job *job, struct arena *a)
{
    enum { FEW = 8 };
    const struct world *w = job->world;
    struct aabb *box = arena_new_array(a, struct aabb, FEW);
    for (uint32_t i = 0; i < w->object_count; i++) {
        if (w->object[i].opaque)
            continue;
        const struct aabb b = grown(w->object[i].bounds);
        if (job->clear_count < FEW)
            box[job->clear_count++] = b;
        else
            box[FEW - 1] = aabb_join(box[FEW - 1], b);
    }
    job->clear = box;
}

static struct even_pass even_pass(const struct job *job, const struct surface *s)
{
    const struct texture *x = s->texture;
    if (s->parts || s->interior_texture || s->interior->caustics != 0 ||
        x->kind != TEXTURE_PLAIN || x->layer_count != 1 ||
        x->layer[0].pigment->kind != PIGMENT_SOLID || !job->pigments)
        return (struct even_pass){false, {0, 0, 0}};
    return (struct even_pass){true, rgbft_pass(x->layer[0].pigment->color)};
}

static void pass_init(struct job *job, struct arena *a)
{
    const struct world *w = job->world;
    if (!w->has_transparent)
        return;
    struct even_pass *pass = arena_new_array(a, struct even_pass, w->surface_count);
    bool all_even = true;
    for (uint32_t i = 0; i < w->surface_count; i++) {
        pass[i] = even_pass(job, &w->surface[i]);
        all_even &= pass[i].known || w->surface[i].opaque;
    }
    job->pass = pass;
    job->lists_crossings =
        all_even && !job->has_media && !w->has_contacts && packet_lists_crossings(w);
    clear_init(job, a);
}

void job_init(struct job *job, struct arena *a, const struct world *w,
              const struct render_settings *settings)
{
    const struct settings *s = &w->scene->settings;
    const int q = settings->quality;
    *job = (struct job){
        .world = w,
        .scene = w->scene,
        .camera = w->scene->has_camera ? &w->scene->camera : &camera_default,
        .settings = *settings,
        .max_level = s->max_trace_level,
        .adc_bailout = s->adc_bailout,
        .old_opacity = s->version < 370,
        .old_layers = s->version < 350,
        .see_through = settings->output_alpha,
        .ambient_light = settings->indirect.no_ambient ? rgb(0, 0, 0) : s->ambient_light,
        .irid_wavelength = s->irid_wavelength,
        .lights = q >= 2,
        .shadows = q >= 4,
        .area_lights = q >= 5 && settings->purpose != RENDER_GATHER,
        .pigments = q >= 6,
        .refraction = q >= 6,
        .mirrors = q >= 8,
        .normals = q >= 8,
        .atmosphere = q >= 9,
        .air = q >= 9 && settings->purpose != RENDER_SCOUT &&
               (settings->purpose != RENDER_GATHER || s->radiosity_settings.media),
        .photons = settings->purpose == RENDER_SCOUT ? NULL : settings->photons,
        .collects = settings->purpose != RENDER_PICTURE && settings->indirect.data,
    };
    const unsigned never =
        settings->purpose == RENDER_GATHER ? (unsigned)OBJECT_NO_RADIOSITY : 0;
    job->hidden_by[0] = never ? never : (unsigned)OBJECT_NO_IMAGE;
    job->hidden_by[1] = never | (unsigned)OBJECT_NO_REFLECTION;
    job->reach = job->camera->mesh ? job->camera->mesh->max_distance : 0;
    job->surface_kernels = surface_kernels_find(w->accel->kernels->name);
    const char *shading = getenv("LAMBERT_SHADING");
    job->general = shading && strcmp(shading, "general") == 0;
    lamps_init(job, a, w);
    spectrum_init(job);
    media_compile(job, a);
    job->shoots = settings->purpose != RENDER_SCOUT && photons_wanted(job);
    if (s->subsurface.on && job->atmosphere &&
        (settings->purpose == RENDER_PICTURE ||
         (settings->purpose == RENDER_GATHER && s->radiosity_settings.subsurface)))
        job->subsurface = subsurface_plan_new(job, a);
    sky_init(job);
    bows_init(job, a);
    sky_compile(job, a);
    pass_init(job, a);
    simple_compile(job, a);
    scout_compile(job, a);
    paint_compile(job, a);
}
