#ifndef TRACE_WAVE_H
#define TRACE_WAVE_H

#include "trace/tracer.h"

// Room for `count` more samples, with sums of zero.
void wave_sums_grow(struct tracer *t, uint32_t count);
// The same with sums of anything.
void wave_sums_reserve(struct tracer *t, uint32_t count);
// Traces a queue to its end, adding to the sums.
void wave_run(struct tracer *t, const struct path_queue *queue);
// The same for the `count` rays that stand in the tracer's batch, straight from a camera
// with one eye; their samples are 0 to count - 1.
void wave_run_camera(struct tracer *t, const struct vec2 *position, uint32_t count);
void wave_frames_free(struct wave_frame *frame);
// Puts the rays of the wave (t->wave) into the batch (t->rays), sorted.
void wave_put(struct tracer *t);
// Brings the rays of a queue from `first` on into the order of their parents.
void path_queue_sort(struct path_queue *q, uint32_t first);
void path_queue_free(struct path_queue *q);

// floor without its call.
static inline int32_t whole_below(double v)
{
    const int32_t whole = (int32_t)v;
    return whole - (whole > v);
}

// The random numbers of a sample depend on its place alone.
static inline uint32_t tracer_position_hash(struct vec2 p)
{
    // 1/1024 of a pixel tells all sample places apart.
    const int32_t x = whole_below(p.u * 1024), y = whole_below(p.v * 1024);
    return hash_mix(hash_mix(1, (uint32_t)x), (uint32_t)y);
}

#endif
