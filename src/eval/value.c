#include "eval/value.h"

#include "base/arena.h"

static const char *const kind_names[] = {
    [VALUE_NONE] = "nothing",
    [VALUE_NUMBER] = "number",
    [VALUE_STRING] = "string",
    [VALUE_FUNCTION] = "function",
    [VALUE_SPLINE] = "spline",
    [VALUE_ARRAY] = "array",
    [VALUE_OBJECT] = "object",
    [VALUE_TEXTURE] = "texture",
    [VALUE_PIGMENT] = "pigment",
    [VALUE_NORMAL] = "normal",
    [VALUE_FINISH] = "finish",
    [VALUE_INTERIOR] = "interior",
    [VALUE_MATERIAL] = "material",
    [VALUE_MEDIA] = "media",
    [VALUE_DENSITY] = "density",
    [VALUE_COLOR_MAP] = "color_map",
    [VALUE_PIGMENT_MAP] = "pigment_map",
    [VALUE_NORMAL_MAP] = "normal_map",
    [VALUE_SLOPE_MAP] = "slope_map",
    [VALUE_TEXTURE_MAP] = "texture_map",
    [VALUE_DENSITY_MAP] = "density_map",
    [VALUE_TRANSFORM] = "transform",
    [VALUE_CAMERA] = "camera",
    [VALUE_FOG] = "fog",
    [VALUE_RAINBOW] = "rainbow",
    [VALUE_SKY_SPHERE] = "sky_sphere",
    [VALUE_FILE] = "file",
    [VALUE_MACRO] = "macro",
};

const char *value_kind_name(const struct value *v)
{
    static const char *const numbers[] = {"number", "float",      "uv vector",
                                          "vector", "4-D vector", "colour"};
    if (!v)
        return "undeclared name";
    if (v->kind == VALUE_NUMBER && v->width <= 5)
        return numbers[v->width];
    return kind_names[v->kind];
}

struct value value_of_number(const double *n, int width)
{
    struct value v = {.kind = VALUE_NUMBER, .width = (uint8_t)width};
    for (int i = 0; i < width; i++)
        v.n[i] = width == 5 ? (double)(float)n[i] : n[i];
    return v;
}

const struct value *value_new_number(struct arena *a, const double *n, int width)
{
    struct value *v = arena_new_struct(a, struct value);
    *v = value_of_number(n, width);
    return v;
}

const struct value *value_new_string(struct arena *a, const char *text, size_t len)
{
    struct value *v = arena_new_struct(a, struct value);
    v->kind = VALUE_STRING;
    v->string.text = arena_strndup(a, text, len);
    v->string.len = (uint32_t)len;
    return v;
}

const struct value *value_new_data(struct arena *a, enum value_kind kind,
                                   const void *data)
{
    struct value *v = arena_new_struct(a, struct value);
    v->kind = kind;
    v->data = data;
    return v;
}
