#ifndef TRACE_PHOTONS_H
#define TRACE_PHOTONS_H

#include "scene/effects.h"
#include "trace/photon_map.h"
#include "trace/shade.h"

// Photons (spec/lighting.md 11): light that goes from lamps to targets and on by mirrors and
// glass, shot before the picture and found again where surfaces and media are shaded.
struct photons {
    struct photon_map surface, media;
    struct photon_gather gather[PHOTON_USES];
};

// Whether lamps and targets of the scene have anything to do with each other.
bool photons_wanted(const struct job *job);
// Whether a target bends (mirrors) the light of a lamp.
bool photons_refract(const struct photon_target *target, const struct light *light);
bool photons_reflect(const struct photon_target *target, const struct light *light);
// Where photons come from other than lamps, and who keeps them.
struct photon_store {
    void *user;
    bool (*load)(void *user, struct photons *p); // fills the maps; false: there are none
    void (*save)(void *user, const struct photons *p); // in the order of the shots
};
// Shoots them all; NULL: the scene has none. *cancel ends it early. Both may be NULL.
struct photons *photons_shoot(const struct job *job, const struct photon_store *store,
                              const volatile bool *cancel);
void photons_free(struct photons *p);

// Whether a surface gathers photons where there are any.
static inline bool photons_collect(const struct surface *s)
{
    return !s->photons || s->photons->collect;
}
// Whether photons bring the light of a lamp, past targets, which then throw shadows
// (spec/lighting.md 7.5), to a surface that gathers them. 0: no; 1: past those with refraction
// on; 2: past all.
static inline uint8_t photons_instead(const struct job *job, bool collects,
                                      const struct light *light)
{
    if (!job->photons || !job->photons->surface.count || light->photon_refraction < 0 ||
        !collects)
        return 0;
    return light->photon_refraction > 0 ? 2 : 1;
}
// Whether photons bring the light that goes through a surface; instead: as above, not 0.
static inline bool photons_instead_of(const struct surface *s, uint8_t instead)
{
    const struct photon_target *p = s->photons;
    return p && p->target && p->refraction >= 0 && (p->refraction > 0 || instead == 2);
}
struct media_mix;
// photons_instead to a point in media.
uint8_t photons_instead_in_media(const struct job *job, const struct media_mix *mix,
                                 const struct light *light);

struct media_march;
struct media_sample;
// The light of photons at samples in media: added to their `light` (photon_media.c).
void photon_media_lit(struct media_march *m, struct media_sample *sample,
                      const struct vec3 *scattering, uint32_t count);

// How obliquely photons may come in before they count no more (spec/lighting.md 11.5).
static const double photon_steepest = 0.1;

// The light of photons on the layers of a hit (shade_photons.c).
void shade_photons(struct shading *s);

#endif
