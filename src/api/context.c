// Contexts: their life, their errors, their messages.
#include "api/context.h"

#include "base/clock.h"
#include "base/stack.h"

#include <stdarg.h>
#include <stdlib.h>

#ifndef LAMBERT_VERSION
#define LAMBERT_VERSION "unknown"
#endif

const char *lambert_version(void) { return LAMBERT_VERSION; }

struct lambert_context *lambert_context_new(void)
{
    struct lambert_context *ctx = calloc(1, sizeof *ctx);
    if (!ctx)
        return NULL;
    ctx->arena = arena_new(1 << 14);
    ctx->value = arena_new_array(ctx->arena, struct option_value, lambert_option_count());
    ctx->scene_value =
        arena_new_array(ctx->arena, struct option_value, lambert_option_count());
    return ctx;
}

void context_forget_scene(struct lambert_context *ctx)
{
    if (ctx->scene_arena)
        arena_free(ctx->scene_arena);
    ctx->scene_arena = NULL;
    ctx->world = NULL;
    for (size_t i = 0; i < lambert_option_count(); i++)
        ctx->scene_value[i] = (struct option_value){0};
    ctx->stats = (struct lambert_stats){0};
}

void lambert_context_free(struct lambert_context *ctx)
{
    if (!ctx)
        return;
    context_forget_scene(ctx);
    arena_free(ctx->arena);
    free(ctx);
}

const char *lambert_error(const struct lambert_context *ctx) { return ctx->error; }

enum lambert_status context_fail(struct lambert_context *ctx, enum lambert_status status,
                                 const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    vsnprintf(ctx->error, sizeof ctx->error, fmt, ap);
    va_end(ap);
    return status;
}

double context_seconds(void) { return clock_seconds(CLOCK_MONOTONIC); }

void lambert_set_message_function(struct lambert_context *ctx, lambert_message_fn fn,
                                  void *user)
{
    ctx->message = fn;
    ctx->message_user = user;
}

void lambert_set_progress_function(struct lambert_context *ctx, lambert_progress_fn fn,
                                   void *user)
{
    ctx->progress = fn;
    ctx->progress_user = user;
}

enum lambert_phase lambert_progress_phase(const struct lambert_context *ctx)
{
    return ctx->phase;
}

void lambert_run_deep(void (*fn)(void *user), void (*meanwhile)(void *user), void *user)
{
    stack_run_beside(fn, meanwhile, user);
}

void lambert_cancel(struct lambert_context *ctx) { ctx->cancel = true; }

void lambert_get_stats(const struct lambert_context *ctx, struct lambert_stats *out)
{
    *out = ctx->stats;
}
