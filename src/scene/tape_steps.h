#ifndef SCENE_TAPE_STEPS_H
#define SCENE_TAPE_STEPS_H

#include "math/elementary.h"
#include "scene/tape.h"

// Private to tape_*.c: what a tape is made of.

enum tape_op {
#define UNARY(name, value, derivative)  TAPE_##name,
#define BINARY(name, value, by_a, by_b) TAPE_##name,
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    TAPE_LENGTH, // sqrt(a), which is the sum of the squares of b, c and d (b again: of two)
    TAPE_SELECT,   // a < 0 ? b : a == 0 ? c : d
    TAPE_EXTERN,   // registers to.. = the extern of the registers in `list`
    TAPE_CALL,     // a tape of the registers in `list`
    TAPE_SUM,      // of the tape for k = list[0], list[0] + 1 .. list[1], list[2..]
    TAPE_PRODUCT,  // likewise
    TAPE_CONSTANT, // nodes only: steps find these in the first registers
    TAPE_ARGUMENT,
};

// a, b, c, d are registers; calls have `count` of them in the tape's list.
struct tape_step {
    uint8_t op;
    uint16_t to, a, b, c, d;
    uint32_t list, count;
    const void *callee; // struct tape_extern, struct tape
    const void *data;   // of an extern
};

// What the builder made, kept so that callers can take it in with their own constants.
struct tape_node {
    uint8_t op;
    uint8_t part;    // component of an extern's results
    uint32_t arg[4]; // nodes before this one
    uint32_t *list;  // calls
    uint32_t count;
    double k; // constant, number of an argument
    const void *callee, *data;
};
// How many of `arg` it reads.
uint32_t tape_operands(const struct tape_node *n);

// Registers: constants, arguments, the rest.
struct tape {
    uint32_t step_count, constant_count, register_count;
    const struct tape_step *step;
    const double *constant;
    const uint16_t *list;
    uint16_t result[TAPE_WIDTH_MAX];
    int arguments, width, depth; // depth: of calls inside calls
    bool opaque;
    bool calls; // other tapes
    uint32_t node_count, node_result[TAPE_WIDTH_MAX];
    const struct tape_node *node;
};

// An argument list on the C stack and the nesting of tapes bound what a run needs.
enum {
    TAPE_REGISTERS_MAX = 1024,
    TAPE_NODES_MAX = 1 << 16,
    TAPE_INLINE_MAX = 4096, // nodes of a tape that takes in what it calls
    TAPE_DEPTH_MAX = 16,
    TAPE_LIST_MAX = 128,
    TAPE_UNROLL_MAX = 64,
};

#define TAPE_LOG10_E 0.43429448190325182765

// One operation of tape_bounds_slope; a call on its arguments.
void tape_bounds_step(enum tape_op op, const struct tape_slope *a,
                      const struct tape_slope *b, const struct tape_slope *c,
                      const struct tape_slope *d, int n, struct tape_slope *to);
void tape_bounds_call(const struct tape_step *s, const struct tape_slope *in, int n,
                      struct tape_slope *to);
// A call of eight points.
// NULL for k: without kernels.
void tape_call_packet(const struct noise_kernels *k, const struct tape_step *s,
                      const double (*in)[TAPE_LANES], double (*out)[TAPE_LANES]);

// Truncated; out of 32 bits: -2147483648.
static inline double tape_integer(double v)
{
    return v > -2147483649.0 && v < 2147483648.0 ? trunc(v) : -2147483648.0;
}

static inline double tape_power_slope(double a, double b)
{
    return b == 0 ? 0 : b * det_pow(a, b - 1);
}

#endif
