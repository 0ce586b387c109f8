#include "eval/build.h"
#include "eval/function.h"

const struct pigment *builder_function_pigment(struct builder *b, const struct ast *block)
{
    static const struct pigment bare;
    struct args top = args_list(b, block, block, "function", NULL);
    return build_pigment(&top, block, &bare);
}

static bool is_refused(enum word w)
{
    static const enum word words[] = {WORD_square,    WORD_triangular, WORD_tiling,
                                      WORD_pavement,  WORD_slope,      WORD_aoi,
                                      WORD_average,   WORD_facets,     WORD_uv_mapping,
                                      WORD_image_map, WORD_bump_map};
    for (size_t i = 0; i < ARRAY_COUNT(words); i++)
        if (words[i] == w)
            return true;
    return false;
}

const struct pattern *builder_function_pattern(struct builder *b, const struct ast *block)
{
    struct args top = args_list(b, block, block, "function", NULL);
    struct args in = args_of(b, block, &top);
    struct pattern *p = arena_new_struct(b->arena, struct pattern);
    struct body body = {.kind = BODY_FUNCTION, .pattern = p};
    enum word w = args_at_block(&in) ? args_at_block(&in) : args_at_word(&in);
    size_t known;
    const enum word *words = pattern_modifier_words(&known);
    if (is_refused(w) || !build_pattern(&in, &body)) {
        diag_at(b->e->diags, DIAG_FUNCTION_ITEM, block->where,
                w ? word_text(w) : "no pattern");
        return NULL;
    }
    while (in.at)
        if (!build_pattern_modifier(&in, &body))
            args_unknown(&in, words, known);
    pattern_finish(&in, p);
    return in.failed ? NULL : p;
}

// The pattern `function { }`: an expression in x, y, z.
bool build_function_pattern(struct eval *e, const struct ast *block, struct pattern *p)
{
    const struct tape *t = function_expression(e, block);
    p->function = t ? tape_at : NULL;
    p->function_data = t;
    return t != NULL;
}
