#include "eval/array.h"

#include <string.h>

#include "base/arena.h"

// So that indices fit 32 bits and a mistyped size does not ask for all memory.
enum { ARRAY_ELEMENTS_MAX = 1 << 28 };

struct array_value *array_new(struct arena *a, uint32_t dimensions, const long *size)
{
    uint64_t count = 1;
    for (uint32_t i = 0; i < dimensions; i++) {
        if (size[i] < 1 || size[i] > ARRAY_ELEMENTS_MAX)
            return NULL;
        count *= (uint64_t)size[i];
        if (count > ARRAY_ELEMENTS_MAX)
            return NULL;
    }
    struct array_value *v = arena_new_struct(a, struct array_value);
    v->dimensions = dimensions;
    for (uint32_t i = 0; i < dimensions; i++)
        v->size[i] = (uint32_t)size[i];
    v->count = (uint32_t)count;
    v->set = arena_new_array(a, bool, v->count);
    return v;
}

static void make_room(struct arena *a, struct array_value *v)
{
    if (v->kind == VALUE_NUMBER)
        v->number = arena_new_array(a, double, (size_t)v->count * v->width);
    else
        v->element = arena_new_array(a, const struct value *, v->count);
}

struct array_value *array_copy(struct arena *a, const struct array_value *from)
{
    struct array_value *v = arena_new_struct(a, struct array_value);
    *v = *from;
    v->set = arena_new_array(a, bool, v->count);
    memcpy(v->set, from->set, v->count * sizeof *v->set);
    if (v->kind == VALUE_NONE)
        return v;
    make_room(a, v);
    if (v->kind == VALUE_NUMBER) {
        memcpy(v->number, from->number, (size_t)v->count * v->width * sizeof(double));
        return v;
    }
    for (uint32_t i = 0; i < v->count; i++) {
        v->element[i] = from->element[i];
        if (v->set[i] && v->kind == VALUE_ARRAY) {
            struct value *inner = arena_new_struct(a, struct value);
            inner->kind = VALUE_ARRAY;
            inner->array = array_copy(a, from->element[i]->array);
            v->element[i] = inner;
        }
    }
    return v;
}

const struct value *array_get(struct arena *copies, const struct array_value *v,
                              uint32_t index)
{
    if (!v->set[index])
        return NULL;
    if (v->kind != VALUE_NUMBER)
        return v->element[index];
    return value_new_number(copies, v->number + (size_t)index * v->width, v->width);
}

void array_fill(struct arena *a, struct array_value *v, const double *number,
                uint8_t width)
{
    v->kind = VALUE_NUMBER;
    v->width = width;
    make_room(a, v);
    memcpy(v->number, number, (size_t)v->count * width * sizeof *number);
    memset(v->set, true, v->count * sizeof *v->set);
}

bool array_set(struct arena *a, struct array_value *v, uint32_t index,
               const struct value *to)
{
    uint8_t width = to->kind == VALUE_NUMBER ? to->width : 0;
    if (v->kind == VALUE_NONE) {
        v->kind = to->kind;
        v->width = width;
        make_room(a, v);
    }
    if (v->kind != to->kind || v->width != width)
        return false;
    if (v->kind == VALUE_NUMBER)
        memcpy(v->number + (size_t)index * width, to->n, width * sizeof(double));
    else
        v->element[index] = to->kind == VALUE_STRING
                                ? value_new_string(a, to->string.text, to->string.len)
                                : to;
    v->set[index] = true;
    return true;
}
