#ifndef API_GI_H
#define API_GI_H

#include "api/context.h"
#include "trace/render.h"

struct gi;

// Prepares the light by way of other surfaces that option `gi` asks for, and writes the
// files that were asked for; *out is NULL when it is off. settings gets what the tracer
// must know.
enum lambert_status gi_prepare(struct lambert_context *ctx,
                               struct render_settings *settings, struct gi **out);
void gi_free(struct gi *g);
// The file that a solution is taken from, or written to; NULL: none.
const char *gi_solution(const struct lambert_context *ctx, bool in);

#endif
