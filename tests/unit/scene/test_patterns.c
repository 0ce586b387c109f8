// Values of noise, patterns and warps against tests/data/pattern-values.tsv, and bumps
// against normal-values.tsv. Reads just enough of the scene language for the rows.

#include "test.h"

#include <stdlib.h>

#include "base/arena.h"
#include "scene/density_grid.h"
#include "scene/noise.h"
#include "scene/object.h"
#include "scene/pattern.h"
#include "scene/texture.h"

// Stands in for the object pattern's only need, so that no shape is linked.
bool object_inside(const struct object *o, struct vec3 p)
{
    (void)o;
    return p.x > 0;
}

struct reader {
    struct arena *arena;
    const char *at;
    char word[64]; // the word or sign that next_word took
    char bad[64];  // the first thing that was not understood
    struct pattern pattern;
    int axis; // of the function pattern
    double amount, accuracy;
    bool has_amount;
};

static bool next_word(struct reader *r)
{
    while (*r->at == ' ' || *r->at == ',')
        r->at++;
    size_t n = strspn(r->at, "abcdefghijklmnopqrstuvwxyz_0123456789");
    if (n == 0)
        n = *r->at != 0;
    if (n >= sizeof r->word)
        n = sizeof r->word - 1;
    memcpy(r->word, r->at, n);
    r->word[n] = 0;
    r->at += n;
    return n > 0;
}

static bool peek(struct reader *r, const char *word)
{
    const char *was = r->at;
    bool same = next_word(r) && !strcmp(r->word, word);
    if (!same)
        r->at = was;
    return same;
}

static bool at_value(struct reader *r)
{
    r->at += strspn(r->at, " ,");
    if (strchr("xyz", *r->at) && *r->at)
        return strchr(" ,}", r->at[1]) != NULL;
    return *r->at && strchr("-+.0123456789<", *r->at) != NULL;
}

static struct vec3 vector(struct reader *r);

static double number(struct reader *r)
{
    r->at += strspn(r->at, " ,");
    char *end;
    double v = strtod(r->at, &end);
    r->at = end;
    return v;
}

static struct vec3 axis_of(char c) { return vec3(c == 'x', c == 'y', c == 'z'); }

static struct vec3 vector(struct reader *r)
{
    r->at += strspn(r->at, " ,");
    double v[3] = {0};
    if (*r->at == '<') {
        r->at++;
        for (int i = 0; *r->at && *r->at != '>'; i++) {
            double c = number(r);
            if (i < 3)
                v[i] = c;
            r->at += strspn(r->at, " ,");
        }
        r->at += *r->at == '>';
        return vec3(v[0], v[1], v[2]);
    }
    double sign = 1;
    if (*r->at == '-' && strchr("xyz", r->at[1])) {
        sign = -1;
        r->at++;
    }
    if (*r->at && strchr("xyz", *r->at))
        return vec3_scale(sign, axis_of(*r->at++));
    double n = number(r);
    if (*r->at == '*') {
        struct vec3 a = axis_of(r->at[1]);
        r->at += 2;
        return vec3_scale(n, a);
    }
    return vec3(n, n, n);
}

static struct turbulence turbulence_usual(void)
{
    return (struct turbulence){{0, 0, 0}, 6, 2, 0.5f};
}

static bool turbulence_item(struct reader *r, struct turbulence *t, const char *w)
{
    if (!strcmp(w, "turbulence"))
        t->amount = vector(r);
    else if (!strcmp(w, "octaves"))
        t->octaves = (int)number(r);
    else if (!strcmp(w, "lambda"))
        t->lambda = (float)number(r);
    else if (!strcmp(w, "omega"))
        t->omega = (float)number(r);
    else
        return false;
    return true;
}

static bool transform_item(struct reader *r, const char *w)
{
    struct transform t;
    if (!strcmp(w, "scale"))
        t = transform_scale(vector(r));
    else if (!strcmp(w, "rotate"))
        t = transform_rotate(vector(r));
    else if (!strcmp(w, "translate"))
        t = transform_translate(vector(r));
    else if (!strcmp(w, "matrix")) {
        double m[4][3];
        r->at = strchr(r->at, '<') + 1;
        for (int i = 0; i < 12; i++)
            m[i / 3][i % 3] = number(r);
        r->at += *r->at == '>';
        assert_true(transform_matrix((const double(*)[3])m, &t));
    } else
        return false;
    pattern_add_transform(r->arena, &r->pattern, &t);
    return true;
}

// The projections; what they share is dist_exp and orientation.
static bool mapping(struct reader *r, struct warp *w, const char *name)
{
    static const char *const names[] = {"planar", "cylindrical", "spherical", "toroidal",
                                        "cubic"};
    for (int i = 0; i < 5; i++)
        if (!strcmp(name, names[i])) {
            w->kind = (enum warp_kind)(WARP_PLANAR + i);
            if (i == 0 && at_value(r)) {
                w->orientation = vec3_normalize(vector(r));
                w->distance = number(r);
            }
            return true;
        }
    if (!strcmp(name, "orientation"))
        w->orientation = vec3_normalize(vector(r));
    else if (!strcmp(name, "dist_exp"))
        w->dist_exp = number(r);
    else if (!strcmp(name, "major_radius"))
        w->major_radius = number(r);
    else
        return false;
    return true;
}

static bool warp_block(struct reader *r)
{
    struct warp w = {.kind = WARP_REPEAT, .major_radius = 1, .strength = 1, .falloff = 2};
    w.turbulence = turbulence_usual();
    w.orientation = vec3(0, 0, 1);
    peek(r, "{");
    while (next_word(r) && strcmp(r->word, "}")) {
        char name[64];
        strcpy(name, r->word);
        if (mapping(r, &w, name))
            continue;
        if (w.kind != WARP_BLACK_HOLE && turbulence_item(r, &w.turbulence, name)) {
            w.kind = WARP_TURBULENCE;
        } else if (!strcmp(name, "black_hole")) {
            w.kind = WARP_BLACK_HOLE;
            w.centre = vector(r);
            w.radius = number(r);
        } else if (!strcmp(name, "strength")) {
            w.strength = number(r);
        } else if (!strcmp(name, "falloff")) {
            w.falloff = number(r);
        } else if (!strcmp(name, "type")) {
            w.type = (int)number(r);
        } else if (!strcmp(name, "inverse")) {
            w.inverse = true;
        } else if (w.kind == WARP_REPEAT && !strcmp(name, "repeat")) {
            w.repeat = vector(r);
        } else if (w.kind == WARP_REPEAT && !strcmp(name, "offset")) {
            w.offset = vector(r);
        } else if (w.kind == WARP_REPEAT && !strcmp(name, "flip")) {
            w.flip = vector(r);
        } else {
            // repeat and turbulence of a black hole are adjusted while they are read
            snprintf(r->bad, sizeof r->bad, "black_hole repeat");
            return false;
        }
    }
    pattern_add_warp(r->arena, &r->pattern, &w);
    return true;
}

static bool wave_item(struct reader *r, const char *w)
{
    static const char *const names[] = {"ramp_wave",    "triangle_wave", "sine_wave",
                                        "scallop_wave", "cubic_wave",    "poly_wave"};
    for (int i = 0; i < 6; i++)
        if (!strcmp(w, names[i])) {
            r->pattern.wave = (enum wave)i;
            if (i == WAVE_POLY && at_value(r))
                r->pattern.exponent = (float)number(r);
            return true;
        }
    return false;
}

static bool parameter(struct reader *r, const char *w)
{
    struct pattern *p = &r->pattern;
    const struct {
        const char *word;
        float *out;
    } floats[] = {{"frequency", &p->frequency}, {"phase", &p->phase},
                  {"agate_turb", &p->value[0]}, {"mortar", &p->value[0]},
                  {"control0", &p->value[0]},   {"control1", &p->value[1]},
                  {"size", &p->value[0]},       {"coords", &p->value[1]},
                  {"metric", &p->metric},       {"offset", &p->offset}};
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++)
        if (!strcmp(w, floats[i].word)) {
            *floats[i].out = (float)vector(r).x;
            return true;
        }
    if (!strcmp(w, "noise_generator"))
        p->noise_generator = (int)number(r);
    else if (!strcmp(w, "interpolate"))
        p->integer[0] = (int)number(r);
    else if (!strcmp(w, "exponent"))
        p->fractal_exponent = (int)number(r);
    else if (!strcmp(w, "form") || !strcmp(w, "brick_size"))
        p->vector = vector(r);
    else if (!strcmp(w, "solid"))
        p->solid = true;
    else if (!strcmp(w, "exterior") || !strcmp(w, "interior")) {
        bool out = *w == 'e';
        *(out ? &p->exterior_type : &p->interior_type) = (int)number(r);
        *(out ? &p->exterior_factor : &p->interior_factor) = number(r);
    } else
        return false;
    return true;
}

static double coordinate(const void *data, struct vec3 p)
{
    return 0.5 + vec3_axis(p, *(const int *)data) / 128;
}

static void julia_arguments(struct reader *r)
{
    r->pattern.vector = vector(r);
    r->pattern.integer[0] = (int)number(r);
}

static FILE *open_data(const char *name)
{
    const char *top = getenv("top_srcdir");
    char path[1024];
    snprintf(path, sizeof path, "%s/tests/data/%s", top ? top : ".", name);
    FILE *f = fopen(path, "r");
    if (!f)
        fail_msg("cannot open %s", path);
    return f;
}

static bool density_file(struct reader *r)
{
    char name[64];
    int n = 0;
    if (sscanf(r->at, " df3 \"data/%63[^\"]\"%n", name, &n) != 1 || !n)
        return false;
    r->at += n;
    FILE *f = open_data(name);
    uint8_t *data = arena_new_array(r->arena, uint8_t, 256);
    struct density_grid *g = arena_new_struct(r->arena, struct density_grid);
    const size_t size = fread(data, 1, 256, f);
    fclose(f);
    for (size_t cut = 0; cut < size; cut++) // half of a file is none
        if (cut != 6 + (size - 6) / 2 && cut != 6 + (size - 6) / 4)
            assert_false(density_grid_init(g, data, cut));
    assert_true(density_grid_init(g, data, size));
    r->pattern.density = g;
    return true;
}

// What follows the keyword directly.
static bool arguments(struct reader *r, const char *w)
{
    struct pattern *p = &r->pattern;
    if (!strcmp(w, "gradient")) {
        p->vector = vec3_normalize(vector(r));
    } else if (!strcmp(w, "spiral1") || !strcmp(w, "spiral2") || !strcmp(w, "mandel")) {
        p->integer[0] = (int)number(r);
    } else if (!strcmp(w, "julia")) {
        julia_arguments(r);
    } else if (!strcmp(w, "magnet")) {
        p->integer[1] = (int)number(r);
        p->integer[2] = peek(r, "julia");
        if (p->integer[2])
            julia_arguments(r);
        else if (peek(r, "mandel"))
            p->integer[0] = (int)number(r);
    } else if (!strcmp(w, "function")) {
        static const char form[] = " { 0.5+x/128 }";
        if (strncmp(r->at, form, 7) || strncmp(r->at + 8, form + 8, sizeof form - 9))
            return false;
        r->axis = r->at[7] - 'x';
        p->function = coordinate;
        p->function_data = &r->axis;
        r->at += sizeof form - 1;
    } else if (!strcmp(w, "density_file")) {
        return density_file(r);
    } else if (!strcmp(w, "object") || !strcmp(w, "pigment_pattern") ||
               !strcmp(w, "slope") || !strcmp(w, "image_pattern") ||
               !strcmp(w, "tiling") || !strcmp(w, "pavement")) {
        return false;
    }
    return true;
}

// Reads a pattern with its modifiers up to '}' or the end.
static bool read_pattern(struct reader *r)
{
    while (next_word(r) && strcmp(r->word, "}")) {
        char w[64];
        strcpy(w, r->word);
        const struct pattern_ops *ops = pattern_find(w, strlen(w));
        if (ops && !r->pattern.ops) {
            pattern_set_kind(&r->pattern, ops);
            if (!arguments(r, w)) {
                snprintf(r->bad, sizeof r->bad, "%s", w);
                return false;
            }
            if (at_value(r)) {
                r->amount = number(r);
                r->has_amount = true;
            }
            continue;
        }
        struct turbulence t = turbulence_usual();
        if (r->pattern.turbulence)
            t = *r->pattern.turbulence;
        if (turbulence_item(r, &t, w)) {
            struct turbulence *copy = arena_new_struct(r->arena, struct turbulence);
            *copy = t;
            r->pattern.turbulence = copy;
        } else if (!strcmp(w, "bump_size")) {
            r->amount = number(r);
        } else if (!strcmp(w, "accuracy")) {
            r->accuracy = number(r);
        } else if (!strcmp(w, "warp")) {
            if (!warp_block(r))
                return false;
        } else if (!transform_item(r, w) && !wave_item(r, w) && !parameter(r, w)) {
            if (!*r->bad)
                snprintf(r->bad, sizeof r->bad, "%s", w);
            return false;
        }
    }
    return r->pattern.ops != NULL;
}

// Why a row may be left out. Anything else that is not understood fails.
static bool excused(const char *word)
{
    static const char *const list[] = {"black_hole repeat", // the parser adjusts it
                                       "function", // user code: the evaluator's tests
                                       "image_pattern", // image files
                                       "pavement",      // tests/tables
                                       "tiling",
                                       "object",
                                       "pigment_pattern",
                                       "slope", // need objects, pigments, surfaces
                                       "average",
                                       "normal_map",
                                       "slope_map",
                                       "bump_map",
                                       "uv_mapping",
                                       "normal"};
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        if (!strcmp(word, list[i]))
            return true;
    return false;
}

static bool row_value(struct reader *r, const char *sdl, const char *expr, struct vec3 p,
                      double *out)
{
    static const char head[] = "function { pattern { ";
    if (!*sdl && !strncmp(expr, "f_noise_generator(x,y,z,", 24)) {
        *out = noise_value(p, atoi(expr + 24));
        return true;
    }
    if (!*sdl && !strcmp(expr, "f_noise3d(x,y,z)")) {
        *out = noise_value(p, 2);
        return true;
    }
    // Lists of greys 0.1, 0.2, ...: entry i is (i + 1) / 10.
    const char *list = strstr(sdl, " rgb 0.1 rgb 0.2 ");
    if (list && !strcmp(expr, "F(x,y,z).red") &&
        !strncmp(sdl, "function { pigment { ", 21)) {
        const struct pattern_ops *ops = pattern_find(sdl + 21, (size_t)(list - sdl - 21));
        if (!ops)
            return false;
        pattern_set_kind(&r->pattern, ops);
        *out = (pattern_value(&r->pattern, p, &(struct pattern_context){0}) + 1) / 10;
        return true;
    }
    if (strncmp(sdl, head, sizeof head - 1))
        return false; // functions, pigments, splines: the evaluator's tests
    r->at = sdl + sizeof head - 1;
    if (!read_pattern(r)) {
        if (!excused(r->bad))
            fail_msg("not understood: '%s' in %s", r->bad, sdl);
        return false;
    }
    double v = pattern_value(&r->pattern, p, &(struct pattern_context){0});
    if (!strcmp(expr, "F(x,y,z)"))
        *out = v;
    else if (!strcmp(expr, "128*(F(x,y,z)-0.5)"))
        *out = 128 * (v - 0.5);
    else if (!strncmp(expr, "128*(F(x,y,z)-0.5)-", 19) && expr[19] && !expr[20])
        *out = 128 * (v - 0.5) - vec3_axis(p, expr[19] - 'x');
    else if (strncmp(expr, "F(x+100,y,z)", 12) == 0)
        return false; // moved by the expression: the evaluator's tests
    else
        fail_msg("expression %s", expr);
    return true;
}

static int split(char *line, char **field, int max)
{
    int n = 0;
    line[strcspn(line, "\n")] = 0;
    while (n < max) {
        field[n++] = line;
        line = strchr(line, '\t');
        if (!line)
            break;
        *line++ = 0;
    }
    return n;
}

static void pattern_rows(void **state)
{
    (void)state;
    FILE *f = open_data("pattern-values.tsv");
    struct arena *arena = arena_new(1 << 16);
    char line[4096], *field[7];
    unsigned checked = 0, left = 0, wrong = 0, seen[128] = {0};
    assert_true(pattern_count <= 128);
    assert_non_null(fgets(line, sizeof line, f));
    while (fgets(line, sizeof line, f)) {
        if (split(line, field, 7) != 7)
            continue;
        arena_reset(arena);
        struct reader r = {.arena = arena};
        struct vec3 p = vec3(atof(field[3]), atof(field[4]), atof(field[5]));
        double got = NAN, want = atof(field[6]);
        if (!row_value(&r, field[1], field[2], p, &got)) {
            left++;
            continue;
        }
        checked++;
        for (size_t i = 0; i < pattern_count; i++)
            seen[i] += pattern_table[i] == r.pattern.ops;
        if (!(fabs(got - want) <= 1e-6 * fmax(1, fabs(want))) &&
            !(isnan(got) && isnan(want)) && wrong++ < 20)
            print_error("%s %s at %s %s %s: got %.12g, want %s\n", field[1], field[2],
                        field[3], field[4], field[5], got, field[6]);
    }
    fclose(f);
    arena_free(arena);
    print_message("# %u rows checked, %u left to others\n", checked, left);
    // Seen only through pigments and surfaces.
    static const char *const none[] = {"aoi",    "facets",   "image_pattern",
                                       "object", "pavement", "pigment_pattern",
                                       "slope",  "tiling"};
    for (size_t i = 0; i < pattern_count; i++) {
        bool known = seen[i] > 0;
        for (size_t k = 0; k < sizeof none / sizeof none[0]; k++)
            known |= !strcmp(none[k], pattern_table[i]->keyword);
        if (!known)
            fail_msg("no rows: %s", pattern_table[i]->keyword);
    }
    assert_int_equal(wrong, 0);
    assert_true(checked >= 1500);
}

static void normal_rows(void **state)
{
    (void)state;
    FILE *f = open_data("normal-values.tsv");
    struct arena *arena = arena_new(1 << 16);
    char line[4096], *field[10];
    unsigned checked = 0, left = 0, wrong = 0;
    assert_non_null(fgets(line, sizeof line, f));
    while (fgets(line, sizeof line, f)) {
        if (split(line, field, 10) != 10)
            continue;
        arena_reset(arena);
        struct reader r = {.arena = arena, .amount = 0.5, .accuracy = 0.02};
        r.at = field[0];
        if (!read_pattern(&r)) {
            if (!excused(r.bad))
                fail_msg("not understood: '%s' in %s", r.bad, field[0]);
            left++;
            continue;
        }
        checked++;
        struct normal n = {
            .amount = (float)r.amount, .delta = (float)r.accuracy, .pattern = r.pattern};
        struct texture_point at = {
            .p = vec3(atof(field[1]), atof(field[2]), atof(field[3])),
            .normal = vec3(atof(field[4]), atof(field[5]), atof(field[6]))};
        struct vec3 got = normal_perturb(&n, &at);
        struct vec3 want = vec3(atof(field[7]), atof(field[8]), atof(field[9]));
        // The table was read from pictures: six digits.
        if (vec3_max_abs(vec3_sub(got, want)) > 4e-6 && wrong++ < 20)
            print_error("%s at %s %s %s: got %.6f %.6f %.6f, want %s %s %s\n", field[0],
                        field[1], field[2], field[3], got.x, got.y, got.z, field[7],
                        field[8], field[9]);
    }
    fclose(f);
    arena_free(arena);
    print_message("# %u rows checked, %u left out\n", checked, left);
    assert_int_equal(wrong, 0);
    assert_true(checked >= 200);
}

static void map_keys(void **state)
{
    (void)state;
    const float key[] = {0.2f, 0.5f, 0.5f, 0.8f};
    uint32_t a, b;
    double f;
    map_find(key, 4, 0.1, &a, &b, &f);
    assert_true(a == 0 && b == 0);
    map_find(key, 4, 0.5, &a, &b, &f); // the first of equal keys at the key itself
    assert_true(a == 1 && b == 1);
    map_find(key, 4, 0.65, &a, &b, &f); // the last above it
    assert_true(a == 2 && b == 3);
    assert_near(f, 0.5, 1e-6);
    map_find(key, 4, 0.9, &a, &b, &f);
    assert_true(a == 3 && b == 3);
    map_find(key, 4, NAN, &a, &b, &f);
    assert_true(a < 4 && b < 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pattern_rows),
        cmocka_unit_test(normal_rows),
        cmocka_unit_test(map_keys),
    };
    return cmocka_run_group_tests_name("patterns", tests, NULL, NULL);
}
