#ifndef IRRADIANCE_FILL_H
#define IRRADIANCE_FILL_H

#include "irradiance/gather.h"

// Fills the store; false: cancelled.
bool irradiance_fill(struct irradiance_cache *c, const struct render_settings *settings,
                     struct watch *watch, struct irradiance_report *report);

#endif
