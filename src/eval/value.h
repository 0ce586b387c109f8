#ifndef EVAL_VALUE_H
#define EVAL_VALUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lang/token.h"
#include "math/transform.h"

enum value_kind {
    VALUE_NONE,
    VALUE_NUMBER, // width 1 float .. 5 colour
    VALUE_STRING,
    VALUE_FUNCTION,
    VALUE_SPLINE,
    VALUE_ARRAY,
    VALUE_OBJECT,  // const struct object * (lights too)
    VALUE_TEXTURE, // const struct texture *
    VALUE_PIGMENT,
    VALUE_NORMAL,
    VALUE_FINISH,
    VALUE_INTERIOR,
    VALUE_MATERIAL,
    VALUE_MEDIA,
    VALUE_DENSITY,
    VALUE_COLOR_MAP,
    VALUE_PIGMENT_MAP,
    VALUE_NORMAL_MAP,
    VALUE_SLOPE_MAP,
    VALUE_TEXTURE_MAP,
    VALUE_DENSITY_MAP,
    VALUE_TRANSFORM,
    VALUE_CAMERA,
    VALUE_FOG,
    VALUE_RAINBOW,
    VALUE_SKY_SPHERE,
    VALUE_FILE,
    VALUE_MACRO,
};

struct arena;
struct array_value; // eval/array.h: shared, mutable through #declare A[i] only

// Immutable once made, in the scene arena; names point at values.
struct value {
    enum value_kind kind;
    uint8_t width;   // VALUE_NUMBER: 1..5; 5 is a colour, rounded to single precision
    bool deprecated; // `#declare deprecated`
    bool warned;
    union {
        double n[5]; // colour: red green blue filter transmit
        struct {
            const char *text; // terminated, escapes resolved
            uint32_t len;
        } string;
        struct array_value *array;
        const void *data; // what the kind says
    };
};

const char *value_kind_name(const struct value *v); // "float", "texture", ...

// New values. A number of width 5 is rounded to single precision.
struct value value_of_number(const double *n, int width);
const struct value *value_new_number(struct arena *a, const double *n, int width);
const struct value *value_new_string(struct arena *a, const char *text, size_t len);
const struct value *value_new_data(struct arena *a, enum value_kind kind,
                                   const void *data);

#endif
