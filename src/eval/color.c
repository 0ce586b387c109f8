// Colour phrases (spec/language 2.6).

#include "eval/expr.h"
#include "math/elementary.h"

static bool is_part(enum word w)
{
    return w == WORD_red || w == WORD_green || w == WORD_blue || w == WORD_filter ||
           w == WORD_transmit || w == WORD_alpha;
}

struct model {
    int width; // 0: no colour model word
    bool transmit, srgb;
};

static struct model model_of(enum word w)
{
    switch (w) {
    case WORD_rgb: return (struct model){3, false, false};
    case WORD_rgbf: return (struct model){4, false, false};
    case WORD_rgbt: return (struct model){4, true, false};
    case WORD_rgbft: return (struct model){5, false, false};
    case WORD_srgb: return (struct model){3, false, true};
    case WORD_srgbf: return (struct model){4, false, true};
    case WORD_srgbt: return (struct model){4, true, true};
    case WORD_srgbft: return (struct model){5, false, true};
    default: return (struct model){0, false, false};
    }
}

bool ast_is_color_start(const struct ast *n)
{
    while (n && n->kind == AST_BINARY && !n->parens)
        n = n->left;
    if (!n)
        return false;
    if (n->kind == AST_WORD) {
        enum word w = n->word;
        return w == WORD_color || w == WORD_colour || is_part(w) || model_of(w).width;
    }
    return n->kind == AST_VALUE && n->value && n->value->kind == VALUE_NUMBER &&
           n->value->width == 5 && n->len;
}

// In single precision as in POV-Ray, whose last digits show in printed values.
static float srgb_decode(float v)
{
    return v <= 0.04045f ? v / 12.92f
                         : (float)det_pow((v + 0.055f) / 1.055f, (double)2.4f);
}

static bool decode(struct eval *e, struct span where, double c[5])
{
    const struct settings *s = &e->scene->settings;
    if (s->gamma_mode == GAMMA_NONE) {
        diag_at(e->diags, DIAG_SRGB_NEEDS_GAMMA, where, "");
        return false;
    }
    for (int i = 0; i < 3 && s->gamma_mode == GAMMA_POWER; i++) {
        c[i] = srgb_decode((float)c[i]);
        if (s->assumed_gamma != 1)
            c[i] = det_pow(c[i], 1 / s->assumed_gamma);
    }
    return true;
}

static bool read_model(struct eval *e, struct model m, const struct ast *n, double c[5])
{
    int width;
    if (!eval_full(e, n, m.width, c, &width))
        return false;
    if (width != m.width)
        diag_at(e->diags, DIAG_COLOR_WIDTH, n->where, m.width, width);
    if (m.transmit) {
        c[4] = c[3];
        c[3] = 0;
    }
    return !m.srgb || decode(e, n->where, c);
}

static bool read_parts(struct eval *e, const struct ast **at, double c[5])
{
    for (const struct ast *n = *at; n && n->kind == AST_WORD && is_part(n->word);
         n = *at) {
        enum word w = n->word;
        int i = w == WORD_red        ? 0
                : w == WORD_green    ? 1
                : w == WORD_blue     ? 2
                : w == WORD_transmit ? 4
                                     : 3;
        if (!n->next) {
            diag_at(e->diags, DIAG_EXPECTED_NUMBER, n->where, "nothing");
            return false;
        }
        *at = n->next->next;
        if (!eval_float(e, n->next, &c[i]))
            return false;
    }
    return true;
}

static bool read_first(struct eval *e, const struct ast **at, bool rgb_only, double c[5])
{
    const struct ast *n = *at;
    struct model m = n && n->kind == AST_WORD ? model_of(n->word) : (struct model){0};
    if (m.width) {
        if (!n->next) {
            diag_at(e->diags, DIAG_EXPECTED_NUMBER, n->where, "nothing");
            return false;
        }
        *at = n->next->next;
        return read_model(e, m, n->next, c);
    }
    if (!n || !ast_is_number(n))
        return true; // nothing but parts
    int width;
    *at = n->next;
    if (!eval_full(e, n, rgb_only ? 3 : 5, c, &width))
        return false;
    return true;
}

bool eval_color(struct eval *e, const struct ast **at, bool rgb_only, struct rgbft *out)
{
    double c[5] = {0};
    const struct ast *first = *at;
    if (first && first->kind == AST_WORD &&
        (first->word == WORD_color || first->word == WORD_colour))
        *at = first->next;
    if (!read_first(e, at, rgb_only, c) || !read_parts(e, at, c))
        return false;
    if (rgb_only && (c[3] != 0 || c[4] != 0)) {
        diag_at(e->diags, DIAG_RGB_ONLY, first->where, "");
        c[3] = c[4] = 0;
    }
    *out =
        (struct rgbft){(float)c[0], (float)c[1], (float)c[2], (float)c[3], (float)c[4]};
    return true;
}
