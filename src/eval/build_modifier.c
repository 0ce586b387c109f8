#include "eval/build.h"

#include <math.h>
#include <string.h>

#include "scene/shapes/box.h"
#include "scene/shapes/height_field.h"

// Object modifiers (spec/language 4.5, spec/shapes 2).

void object_move(struct builder *b, struct object *o, const struct transform *t)
{
    object_transform(b->arena, o, t);
    if (o->interior)
        o->interior = interior_moved(b->arena, o->interior, t);
}

// The attached texture with its own transform folded in, or the default one.
static const struct texture *settled(struct builder *b, struct attached_texture *at)
{
    if (!at->texture)
        return NULL;
    if (!at->transform->identity)
        at->texture = texture_transform(b->arena, at->texture, at->transform);
    at->transform = &transform_identity;
    return at->texture;
}

static void add_texture(struct args *a, struct attached_texture *at,
                        const struct ast *block)
{
    const struct texture *below = settled(a->b, at), *top = build_texture(a, block);
    if (top)
        at->texture = below ? build_layer(a, block->where, below, top) : top;
    if (!below)
        at->transform = &transform_identity;
}

// pigment, normal, finish: change the top layer.
static void change_layer(struct args *a, struct attached_texture *at)
{
    const struct ast *n = args_next(a);
    const struct texture *present = settled(a->b, at);
    if (!present) {
        present = a->b->default_texture;
        at->transform = &transform_identity;
    }
    if (present->kind != TEXTURE_PLAIN) {
        args_error(a, n->where, "the texture below is patterned and cannot be changed");
        return;
    }
    struct texture *x = arena_new_struct(a->b->arena, struct texture);
    struct texture_layer *layer =
        arena_new_array(a->b->arena, struct texture_layer, present->layer_count);
    *x = *present;
    memcpy(layer, present->layer, present->layer_count * sizeof *layer);
    x->layer = layer;
    struct texture_layer *top = &layer[x->layer_count - 1];
    if (n->word == WORD_pigment)
        top->pigment = build_pigment(a, n, top->pigment);
    else if (n->word == WORD_normal)
        top->normal = build_normal(a, n, top->normal);
    else
        top->finish = build_finish(a, n, top->finish);
    if (!a->failed && top->pigment && top->finish)
        at->texture = x;
}

// Objects then TRANS of clipped_by and bounded_by.
static struct pointer_list build_object_list(struct args *a)
{
    struct pointer_list l = {0};
    struct transform t;
    bool was;
    while (a->at) {
        const struct object *o = args_object(a, &was);
        if (o)
            pointer_list_add(a->b->arena, &l, o);
        if (!was)
            break;
    }
    while (build_trans(a, &t)) {
        for (uint32_t i = 0; i < l.count; i++) {
            struct object *moved = object_copy(a->b->arena, l.at[i]);
            object_move(a->b, moved, &t);
            l.at[i] = moved;
        }
    }
    if (a->at)
        args_unknown(a, NULL, 0);
    return l;
}

// The box from the bottom of a height field, y = 0 or the water level, to its top: the solid
// itself, which reaches down to minus infinity, would clip nothing below. NULL: any other
// object.
static const struct object *field_box(struct args *a, const struct object *o)
{
    if (o->ops != &height_field_ops || o->flags & OBJECT_INVERSE)
        return NULL;
    const struct height_field *f = o->shape;
    const struct aabb bounds = shape_surface_bounds(o->ops, o->shape);
    struct box *box = arena_new_struct(a->b->arena, struct box);
    *box = (struct box){bounds.min, bounds.max};
    if (!f->under_water)
        box->min.y = fmin(0, box->min.y);
    struct object *x = object_new_shape(a->b->arena, &box_ops, box, o->where);
    object_transform(a->b->arena, x, o->transform);
    return x;
}

// Height fields that clip are followed by their boxes.
static struct pointer_list with_boxes(struct args *a, struct pointer_list l)
{
    struct pointer_list all = {.count = 0};
    for (uint32_t i = 0; i < l.count; i++) {
        const struct object *box = field_box(a, l.at[i]);
        pointer_list_add(a->b->arena, &all, l.at[i]);
        if (box)
            pointer_list_add(a->b->arena, &all, box);
    }
    return all;
}

static void clip_or_bound(struct args *a, struct object *o, bool clip)
{
    const struct object *const **list = clip ? &o->clip : &o->bound;
    uint32_t *count = clip ? &o->clip_count : &o->bound_count;
    struct args in = args_of(a->b, args_next(a), a);
    if (args_take(&in, clip ? WORD_bounded_by : WORD_clipped_by)) {
        if (*count)
            args_error(&in, args_span(&in),
                       "the list is filled already, it cannot be shared");
        *list = clip ? o->bound : o->clip;
        *count = clip ? o->bound_count : o->clip_count;
        if (in.at)
            args_unknown(&in, NULL, 0);
        return;
    }
    struct pointer_list more = build_object_list(&in);
    if (more.count == 0) {
        if (!in.failed)
            args_error(&in, args_span(&in), "an object is expected");
        return;
    }
    if (clip)
        more = with_boxes(a, more);
    const struct object **all =
        arena_new_array(a->b->arena, const struct object *, *count + more.count);
    for (uint32_t i = 0; i < *count; i++)
        all[i] = (*list)[i];
    for (uint32_t i = 0; i < more.count; i++) {
        all[*count + i] = more.at[i];
        object_hold(o, more.at[i]);
        if (all[*count + i]->texture.texture)
            args_error(&in, in.owner->where, "a textured object cannot clip or bound");
    }
    *list = all;
    *count += more.count;
}

static void material(struct args *a, struct object *o)
{
    struct material m = {o->texture, o->interior_texture, o->interior};
    m = build_material(a, args_next(a), m);
    o->texture = m.texture;
    o->interior_texture = m.interior_texture;
    o->interior = m.interior;
}

static bool photon_item(struct args *a, struct photon_target *t)
{
    const enum word w = args_at_word(a);
    switch (w) {
    case WORD_target:
        args_next(a);
        t->spacing = 1;
        args_optional(a, &t->spacing);
        t->target = t->spacing > 0;
        return true;
    case WORD_refraction:
        args_next(a);
        t->refraction = args_switch(a) ? 1 : -1;
        return true;
    case WORD_reflection:
        args_next(a);
        t->reflection = args_switch(a) ? 1 : -1;
        return true;
    case WORD_collect:
        args_next(a);
        t->collect = args_switch(a);
        return true;
    case WORD_pass_through:
        args_next(a);
        t->pass_through = args_switch(a);
        return true;
    default: return false;
    }
}

// What is to bend light cannot let it pass as if nothing were there: the later word holds.
static void photon_conflict(struct args *a, struct span where, bool pass_through,
                            struct photon_target *t)
{
    if (!t->pass_through || !t->target || t->refraction <= 0)
        return;
    args_warning(a, where, "a target with refraction cannot have pass_through too");
    if (pass_through)
        t->refraction = 0;
    else
        t->pass_through = false;
}

void build_photons(struct args *a, struct object *o)
{
    static const enum word words[] = {WORD_target, WORD_refraction, WORD_reflection,
                                      WORD_pass_through, WORD_collect};
    struct photon_target *t = arena_new_struct(a->b->arena, struct photon_target);
    struct args in = args_of(a->b, args_next(a), a);
    *t = o->photons ? *o->photons : (struct photon_target){.collect = true};
    while (in.at) {
        const struct span where = args_span(&in);
        const bool pass_through = args_at_word(&in) == WORD_pass_through;
        if (!photon_item(&in, t))
            args_unknown(&in, words, ARRAY_COUNT(words));
        else
            photon_conflict(&in, where, pass_through, t);
    }
    o->photons = t;
}

double build_importance(struct args *a)
{
    static const struct field fields[] = {{WORD_importance, FIELD_DOUBLE, 0, 1e-10, 1}};
    double importance = 1;
    struct args in = args_of(a->b, args_next(a), a);
    while (in.at)
        if (!fields_read(&in, fields, 1, &importance))
            fields_unknown(&in, fields, 1, NULL, 0);
    return importance;
}

static bool block_modifier(struct args *a, struct object *o)
{
    switch (args_at_block(a)) {
    case WORD_texture: add_texture(a, &o->texture, args_next(a)); return true;
    case WORD_interior_texture:
        add_texture(a, &o->interior_texture, args_next(a));
        return true;
    case WORD_pigment:
    case WORD_normal:
    case WORD_finish: change_layer(a, &o->texture); return true;
    case WORD_interior:
        o->interior = build_interior(a, args_next(a), o->interior);
        return true;
    case WORD_material: material(a, o); return true;
    case WORD_clipped_by: clip_or_bound(a, o, true); return true;
    case WORD_bounded_by: clip_or_bound(a, o, false); return true;
    case WORD_photons: build_photons(a, o); return true;
    case WORD_radiosity: o->importance = (float)build_importance(a); return true;
    default: return false;
    }
}

// Switches: `word [b]` sets or clears a flag.
static const struct {
    enum word word;
    unsigned flag;
} switches[] = {
    {WORD_no_image, OBJECT_NO_IMAGE},
    {WORD_no_reflection, OBJECT_NO_REFLECTION},
    {WORD_no_radiosity, OBJECT_NO_RADIOSITY},
    {WORD_double_illuminate, OBJECT_DOUBLE_ILLUMINATE},
    {WORD_hollow, OBJECT_HOLLOW},
    {WORD_sturm, OBJECT_STURM},
    {WORD_hierarchy, 0},
};

static void wrong_owner(struct args *a, const char *word)
{
    diag_at(args_diags(a), DIAG_UNKNOWN_ITEM, args_span(a), word, a->name);
    args_fail(a);
}

static bool switch_modifier(struct args *a, struct object *o)
{
    enum word w = args_at_word(a);
    for (size_t i = 0; i < ARRAY_COUNT(switches); i++) {
        if (switches[i].word != w)
            continue;
        unsigned needs = w == WORD_sturm       ? SHAPE_STURM
                         : w == WORD_hierarchy ? SHAPE_HIERARCHY
                                               : 0;
        if (needs && !(o->kind == OBJECT_SHAPE && o->ops->flags & needs))
            wrong_owner(a, word_text(w));
        args_next(a);
        bool on = args_switch(a);
        o->flags = on ? o->flags | switches[i].flag : o->flags & ~switches[i].flag;
        if (w == WORD_hollow)
            o->flags |= OBJECT_HOLLOW_SET;
        return true;
    }
    return false;
}

bool args_part(struct args *a, struct transform *out, const struct texture **texture)
{
    static const enum word known[] = {WORD_translate, WORD_rotate,    WORD_scale,
                                      WORD_matrix,    WORD_transform, WORD_texture,
                                      WORD_pigment,   WORD_normal,    WORD_finish};
    struct object part = {.transform = &transform_identity,
                          .texture.transform = &transform_identity};
    struct transform t;
    while (a->at) {
        enum word w = args_at_block(a);
        if (build_trans(a, &t))
            object_transform(a->b->arena, &part, &t);
        else if (w == WORD_texture || w == WORD_pigment || w == WORD_normal ||
                 w == WORD_finish)
            block_modifier(a, &part);
        else
            args_unknown(a, known, ARRAY_COUNT(known));
    }
    *out = *part.transform;
    *texture = settled(a->b, &part.texture);
    return !a->failed;
}

static void inverse(struct args *a, struct object *o)
{
    if (o->kind == OBJECT_SHAPE && !(o->ops->flags & SHAPE_SOLID))
        args_warning(a, args_span(a), "a patch has no inside, inverse does nothing");
    o->flags ^= OBJECT_INVERSE;
}

// In POV-Ray a text is a union of its letters.
static bool is_union(const struct object *o)
{
    return o->kind == OBJECT_CSG ? o->op == CSG_UNION
                                 : o->kind == OBJECT_SHAPE && o->ops == &text_ops;
}

static bool word_modifier(struct args *a, struct object *o)
{
    bool csg = o->kind == OBJECT_CSG;
    const char *text;
    switch (args_at_word(a)) {
    case WORD_inverse: inverse(a, o); break;
    case WORD_no_shadow: o->flags |= OBJECT_NO_SHADOW; break;
    case WORD_uv_mapping:
        if (o->texture.texture)
            args_error(a, args_span(a), "uv_mapping must stand before the texture");
        o->flags |= OBJECT_UV_MAPPING;
        break;
    case WORD_cutaway_textures:
        if (!csg || (o->op != CSG_INTERSECTION && o->op != CSG_DIFFERENCE))
            wrong_owner(a, "cutaway_textures");
        o->flags |= OBJECT_CUTAWAY;
        break;
    case WORD_split_union:
        if (!is_union(o))
            wrong_owner(a, "split_union");
        args_next(a);
        o->flags &= ~(unsigned)OBJECT_NO_SPLIT;
        if (!args_switch(a))
            o->flags |= OBJECT_NO_SPLIT;
        return true;
    case WORD_dtag:
        args_next(a);
        args_string(a, "tag", &text);
        return true;
    default: return switch_modifier(a, o);
    }
    args_next(a);
    return true;
}

static const enum word modifier_words[] = {WORD_translate,
                                           WORD_rotate,
                                           WORD_scale,
                                           WORD_matrix,
                                           WORD_transform,
                                           WORD_texture,
                                           WORD_pigment,
                                           WORD_normal,
                                           WORD_finish,
                                           WORD_interior,
                                           WORD_interior_texture,
                                           WORD_material,
                                           WORD_clipped_by,
                                           WORD_bounded_by,
                                           WORD_photons,
                                           WORD_radiosity,
                                           WORD_no_image,
                                           WORD_no_reflection,
                                           WORD_no_radiosity,
                                           WORD_no_shadow,
                                           WORD_double_illuminate,
                                           WORD_hollow,
                                           WORD_sturm,
                                           WORD_hierarchy,
                                           WORD_inverse,
                                           WORD_uv_mapping,
                                           WORD_cutaway_textures,
                                           WORD_split_union,
                                           WORD_open};

void build_modifiers(struct args *a, struct object *o)
{
    struct transform t;
    struct rgbft c;
    while (a->at) {
        if (build_trans(a, &t)) {
            object_move(a->b, o, &t);
        } else if (block_modifier(a, o) || word_modifier(a, o)) {
            continue;
        } else if (args_at_color(a)) {
            args_warning(a, args_span(a), "a colour outside of pigment { } is ignored");
            args_color(a, false, &c);
        } else {
            args_unknown(a, modifier_words, ARRAY_COUNT(modifier_words));
        }
    }
    if (o->interior_texture.texture && !o->texture.texture && !a->failed)
        args_error(a, args_span(a), "interior_texture needs a texture too");
}
