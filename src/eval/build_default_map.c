#include "eval/build.h"

#include <string.h>

// The colours of a pattern that has no map (spec/textures 8.4).

#define COLOR(r, g, b)                                                                   \
    {                                                                                    \
        r, g, b, 0, 0                                                                    \
    }
#define MAP(name)                                                                        \
    static const struct color_map name##_map = {ARRAY_COUNT(name##_key), name##_key,     \
                                                name##_color}

static const float index_key[] = {0, 1, 2, 3, 4, 5};
static const struct rgbft checker_color[] = {COLOR(0, 0, 1), COLOR(0, 1, 0)};
static const struct color_map checker_map = {2, index_key, checker_color};
static const struct rgbft hexagon_color[] = {COLOR(0, 0, 1), COLOR(0, 1, 0),
                                             COLOR(1, 0, 0)};
static const struct color_map hexagon_map = {3, index_key, hexagon_color};
static const struct rgbft brick_color[] = {COLOR(0.5f, 0.5f, 0.5f),
                                           COLOR(0.6f, 0.15f, 0.15f)};
static const struct color_map brick_map = {2, index_key, brick_color};
static const struct rgbft six_color[] = {COLOR(1, 0, 0), COLOR(0, 1, 0), COLOR(0, 0, 1),
                                         COLOR(1, 1, 0), COLOR(0, 1, 1), COLOR(1, 0, 1)};
static const struct color_map square_map = {4, index_key, six_color};
static const struct color_map six_map = {6, index_key, six_color};

static const float bozo_key[] = {0.4f, 0.4f, 0.6f, 0.6f, 0.8f, 0.8f};
static const struct rgbft bozo_color[] = {COLOR(1, 1, 1), COLOR(0, 1, 0), COLOR(0, 1, 0),
                                          COLOR(0, 0, 1), COLOR(0, 0, 1), COLOR(1, 0, 0)};
MAP(bozo);
static const float wood_key[] = {0.6f, 0.6f};
static const struct rgbft wood_color[] = {COLOR(0.666f, 0.312f, 0.2f),
                                          COLOR(0.4f, 0.1333f, 0.066f)};
MAP(wood);
static const float mandel_key[] = {0.001f, 0.001f, 0.012f, 0.015f, 0.1f};
static const struct rgbft mandel_color[] = {
    COLOR(0, 0, 0), COLOR(0, 1, 1), COLOR(1, 1, 0), COLOR(1, 0, 1), COLOR(0, 1, 1)};
MAP(mandel);
static const float radial_key[] = {0, 0.333f, 0.666f, 1};
static const struct rgbft radial_color[] = {COLOR(0, 1, 1), COLOR(1, 1, 0),
                                            COLOR(1, 0, 1), COLOR(0, 1, 1)};
MAP(radial);
static const float agate_key[] = {0, 0.5f, 0.5f, 0.6f, 0.6f, 1};
static const struct rgbft agate_color[] = {
    COLOR(1, 1, 1),          COLOR(0.95f, 0.75f, 0.5f), COLOR(0.9f, 0.7f, 0.5f),
    COLOR(0.9f, 0.7f, 0.4f), COLOR(1, 0.7f, 0.4f),      COLOR(0.6f, 0.3f, 0)};
MAP(agate);
static const float marble_key[] = {0, 0.9f, 0.9f};
static const struct rgbft marble_color[] = {COLOR(0.9f, 0.8f, 0.8f),
                                            COLOR(0.9f, 0.08f, 0.08f), COLOR(0, 0, 0)};
MAP(marble);
static const float gray_key[] = {0, 1};
static const struct rgbft gray_color[] = {COLOR(0, 0, 0), COLOR(1, 1, 1)};
MAP(gray);

static const struct {
    const char *pattern;
    const struct color_map *map;
} defaults[] = {
    {"checker", &checker_map}, {"object", &checker_map}, {"hexagon", &hexagon_map},
    {"brick", &brick_map},     {"square", &square_map},  {"triangular", &six_map},
    {"cubic", &six_map},       {"bozo", &bozo_map},      {"wood", &wood_map},
    {"mandel", &mandel_map},   {"radial", &radial_map},  {"agate", &agate_map},
    {"marble", &marble_map},
};

const struct color_map *color_map_default(const struct pattern *p)
{
    for (size_t i = 0; p->ops && i < ARRAY_COUNT(defaults); i++)
        if (strcmp(defaults[i].pattern, p->ops->keyword) == 0)
            return defaults[i].map == &mandel_map && p->fractal_exponent != 2
                       ? &gray_map
                       : defaults[i].map;
    return &gray_map;
}

bool color_map_is_default(const struct color_map *m)
{
    for (size_t i = 0; i < ARRAY_COUNT(defaults); i++)
        if (m == defaults[i].map)
            return true;
    return m == &gray_map;
}
