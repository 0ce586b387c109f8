// The table of options, and the values a context has for them.
#include "api/context.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define KIND(k) LAMBERT_OPTION_##k
static const struct lambert_option options[] = {
#define OPTION(name, letter, pov, keyword, turns, kind, value, choices, initial, min,    \
               max, group, help)                                                         \
    {name,    letter,  pov, keyword, turns, KIND(kind), value,                           \
     choices, initial, min, max,     group, help},
#include "api/options.def"
#undef OPTION
};
enum { OPTION_COUNT = sizeof options / sizeof options[0] };

size_t lambert_option_count(void) { return OPTION_COUNT; }

const struct lambert_option *lambert_option_at(size_t i)
{
    return i < OPTION_COUNT ? &options[i] : NULL;
}

static int find(const char *name)
{
    for (int i = 0; i < OPTION_COUNT; i++)
        if (options[i].name[0] == name[0] && strcmp(options[i].name, name) == 0)
            return i;
    return -1;
}

const struct lambert_option *lambert_option_find(const char *name)
{
    int i = find(name);
    return i < 0 ? NULL : &options[i];
}

const char *lambert_option_suggest(const char *name)
{
    const char *names[OPTION_COUNT];
    for (int i = 0; i < OPTION_COUNT; i++)
        names[i] = options[i].name;
    return diag_closest(name, strlen(name), names, OPTION_COUNT);
}

const char *lambert_keyword_suggest(const char *keyword)
{
    enum { LONGEST = 40 };
    char low[OPTION_COUNT + 1][LONGEST]; // the last is what was written
    const char *names[OPTION_COUNT];
    for (int i = 0; i <= OPTION_COUNT; i++) {
        const char *from = i == OPTION_COUNT ? keyword : options[i].keyword;
        size_t n = 0;
        for (; from && from[n] && n + 1 < LONGEST; n++)
            low[i][n] = from[n] >= 'A' && from[n] <= 'Z' ? (char)(from[n] + 32) : from[n];
        low[i][n] = 0;
        if (i < OPTION_COUNT)
            names[i] = low[i];
    }
    const char *near =
        diag_closest(low[OPTION_COUNT], strlen(low[OPTION_COUNT]), names, OPTION_COUNT);
    for (int i = 0; near && i < OPTION_COUNT; i++)
        if (near == low[i])
            return options[i].keyword;
    return NULL;
}

static bool same_word(const char *a, const char *b, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (((unsigned char)a[i] | 0x20) != ((unsigned char)b[i] | 0x20))
            return false;
    return true;
}

// Numbers have a point, whatever the user's language.
static bool parse_number(const char *text, double *out)
{
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    locale_t old = c ? uselocale(c) : (locale_t)0;
    char *end;
    *out = strtod(text, &end);
    if (c) {
        uselocale(old);
        freelocale(c);
    }
    while (*end == ' ' || *end == '\t')
        end++;
    return end != text && !*end && isfinite(*out);
}

// As in INI files: on when it begins like one of these.
static bool parse_flag(const char *text)
{
    static const char *const words[] = {"on", "true", "yes", "1"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        size_t n = strlen(words[i]);
        if (strlen(text) >= n && same_word(text, words[i], n))
            return true;
    }
    return false;
}

static const char *parse_choice(struct arena *a, const char *choices, const char *text)
{
    size_t n = strlen(text);
    for (const char *at = choices; *at;) {
        size_t len = strcspn(at, "|");
        if (len == n && same_word(at, text, n))
            return arena_strndup(a, at, n);
        at += len + (at[len] == '|');
    }
    return NULL;
}

// POV-Ray's letters for file types. What may follow them, as in `N16`, means nothing there.
static const char *file_type_word(const char *text)
{
    const bool letter = text[0] && !text[1 + strspn(text + 1, "0123456789gG")];
    const char *word = letter ? image_type_word_of_letter(text[0]) : NULL;
    return word ? word : text;
}

static enum lambert_status bad_value(struct lambert_context *ctx,
                                     const struct lambert_option *o, const char *value)
{
    if (o->kind == LAMBERT_OPTION_CHOICE)
        return context_fail(ctx, LAMBERT_ERROR_OPTION,
                            "'%s' is no value for --%s; it takes %s", value, o->name,
                            o->choices);
    return context_fail(
        ctx, LAMBERT_ERROR_OPTION, "'%s' is no value for --%s; it takes %s from %g to %g",
        value, o->name, o->kind == LAMBERT_OPTION_INT ? "a whole number" : "a number",
        o->min, o->max);
}

static enum lambert_status set_number(struct lambert_context *ctx,
                                      const struct lambert_option *o,
                                      struct option_value *v, const char *value)
{
    double number;
    if (!parse_number(value, &number) || number < o->min || number > o->max)
        return bad_value(ctx, o, value);
    if (o->kind == LAMBERT_OPTION_INT && number != floor(number))
        return bad_value(ctx, o, value);
    v->number = number;
    return LAMBERT_OK;
}

static void add_to_list(struct lambert_context *ctx, struct option_value *v,
                        const char *text)
{
    if (v->count == v->capacity) {
        size_t capacity = v->capacity ? 2 * v->capacity : 8;
        const char **list = arena_new_array(ctx->arena, const char *, capacity);
        if (v->count)
            memcpy(list, v->list, v->count * sizeof *list);
        v->list = list;
        v->capacity = capacity;
    }
    v->list[v->count++] = text;
}

static enum lambert_status set_value(struct lambert_context *ctx,
                                     const struct lambert_option *o,
                                     struct option_value *v, const char *value)
{
    const char *text = value;
    double gamma;
    switch (o->kind) {
    case LAMBERT_OPTION_FLAG: v->number = parse_flag(value); break;
    case LAMBERT_OPTION_INT:
    case LAMBERT_OPTION_FLOAT:
        if (set_number(ctx, o, v, value) != LAMBERT_OK)
            return LAMBERT_ERROR_OPTION;
        break;
    case LAMBERT_OPTION_CHOICE:
        text = parse_choice(ctx->arena, o->choices,
                            strcmp(o->name, "type") == 0 ? file_type_word(value) : value);
        if (!text)
            return bad_value(ctx, o, value);
        break;
    case LAMBERT_OPTION_STRING:
        if (strstr(o->name, "-gamma") && strcasecmp(value, "sRGB") != 0 &&
            (!parse_number(value, &gamma) || gamma <= 0))
            return context_fail(
                ctx, LAMBERT_ERROR_OPTION,
                "'%s' is no value for --%s; it takes sRGB or a number above 0", value,
                o->name);
        break;
    case LAMBERT_OPTION_LIST:
        add_to_list(ctx, v, arena_strndup(ctx->arena, value, strlen(value)));
        break;
    case LAMBERT_OPTION_FILE:
    case LAMBERT_OPTION_ACTION: break;
    }
    v->text = arena_strndup(ctx->arena, text, strlen(text));
    return LAMBERT_OK;
}

enum lambert_status lambert_option_set(struct lambert_context *ctx, const char *name,
                                       const char *value)
{
    int i = find(name);
    if (i >= 0)
        return set_value(ctx, &options[i], &ctx->value[i], value);
    const char *near = lambert_option_suggest(name);
    if (near)
        return context_fail(ctx, LAMBERT_ERROR_OPTION,
                            "no option '--%s'; did you mean '--%s'?", name, near);
    return context_fail(ctx, LAMBERT_ERROR_OPTION, "no option '--%s'", name);
}

enum lambert_status option_from_scene(struct lambert_context *ctx, const char *name,
                                      const char *text)
{
    const int i = find(name);
    return set_value(ctx, &options[i], &ctx->scene_value[i], text);
}

// The user's value, else the scene's; NULL: neither.
static const struct option_value *given(const struct lambert_context *ctx, int i)
{
    return ctx->value[i].text         ? &ctx->value[i]
           : ctx->scene_value[i].text ? &ctx->scene_value[i]
                                      : NULL;
}

bool lambert_option_is_set(const struct lambert_context *ctx, const char *name)
{
    int i = find(name);
    return i >= 0 && ctx->value[i].text;
}

double lambert_option_number(const struct lambert_context *ctx, const char *name)
{
    int i = find(name);
    if (i < 0)
        return 0;
    if (given(ctx, i))
        return given(ctx, i)->number;
    double number = 0;
    if (!options[i].initial)
        return 0;
    if (options[i].kind == LAMBERT_OPTION_FLAG)
        return parse_flag(options[i].initial);
    parse_number(options[i].initial, &number);
    return number;
}

const char *lambert_option_text(const struct lambert_context *ctx, const char *name)
{
    int i = find(name);
    if (i < 0)
        return NULL;
    return given(ctx, i) ? given(ctx, i)->text : options[i].initial;
}

size_t lambert_option_list(const struct lambert_context *ctx, const char *name,
                           const char *const **values)
{
    int i = find(name);
    *values = i < 0 ? NULL : ctx->value[i].list;
    return i < 0 ? 0 : ctx->value[i].count;
}

double option_number(const struct lambert_context *ctx, const char *name)
{
    return lambert_option_number(ctx, name);
}

bool option_flag(const struct lambert_context *ctx, const char *name)
{
    return lambert_option_number(ctx, name) != 0;
}

// A number is a power; 1 is no encoding. Else it is "sRGB".
struct transfer option_transfer(const struct lambert_context *ctx, const char *name)
{
    double gamma;
    if (!parse_number(lambert_option_text(ctx, name), &gamma))
        return (struct transfer){TRANSFER_SRGB, 0};
    if (fabs(gamma - 1) <= 0.01) // spec/lighting.md 3.1
        return (struct transfer){TRANSFER_NONE, 0};
    return (struct transfer){TRANSFER_POWER, gamma};
}
