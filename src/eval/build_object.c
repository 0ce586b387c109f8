#include "eval/build.h"

// Objects: primitives through the table of shapes, copies, and objects in lists.

// A block whose first item is an object: a copy with modifiers. The keyword does not
// matter, except that a CSG block holding finished blocks is no copy.
static bool is_copy(const struct args *a, bool csg)
{
    const struct ast *n = a->at;
    return args_at_value(a, VALUE_OBJECT) && (!csg || (n->text && n->len));
}

static struct object *copy_of(struct args *a)
{
    const struct value *v = args_take_value(a, VALUE_OBJECT);
    struct object *o = object_copy(a->b->arena, v->data);
    o->where = a->owner->where;
    build_modifiers(a, o);
    return o;
}

// The first item of `object { }` when it is a block that was not finished yet.
static struct object *object_block(struct args *a)
{
    bool was;
    const struct object *inner = args_object(a, &was);
    if (!was) {
        args_expected(a, "object", "a declared object or a block");
        return NULL;
    }
    if (!inner)
        return NULL;
    struct object *o = object_copy(a->b->arena, inner);
    o->where = a->owner->where;
    build_modifiers(a, o);
    return o;
}

static struct object *primitive(struct args *a, const struct shape_ops *ops)
{
    void *shape = arena_alloc(a->b->arena, ops->size);
    if (!ops->build(shape, a)) {
        args_fail(a);
        return NULL;
    }
    struct object *o = object_new_shape(a->b->arena, ops, shape, a->owner->where);
    build_modifiers(a, o);
    return o;
}

struct object *build_object(struct args *a, const struct ast *block)
{
    struct args in = args_of(a->b, block, a);
    struct object *o;
    bool csg = block->word == WORD_union || block->word == WORD_merge ||
               block->word == WORD_intersection || block->word == WORD_difference ||
               block->word == WORD_composite;
    const struct shape_ops *ops = a->b->shape[block->word];
    if (block->word == WORD_light_group) {
        o = build_light_group(&in);
    } else if (is_copy(&in, csg)) {
        o = copy_of(&in);
    } else if (csg) {
        o = build_csg(&in, block);
    } else if (block->word == WORD_light_source) {
        o = build_light(&in, block);
    } else if (block->word == WORD_object) {
        o = object_block(&in);
    } else if (ops) {
        o = primitive(&in, ops);
    } else {
        diag_at(args_diags(a), DIAG_NOT_BUILT, block->where, in.name);
        args_fail(&in);
        o = NULL;
    }
    return in.failed ? NULL : o;
}

// The tree is followed by recursion, which has an end.
static const struct object *limited(struct args *a, struct span where,
                                    const struct object *o)
{
    if (!o || (o->depth < OBJECT_DEPTH_MAX && o->leaves <= OBJECT_LEAVES_MAX))
        return o;
    if (o->depth >= OBJECT_DEPTH_MAX)
        diag_at(a->b->e->diags, DIAG_TOO_DEEP, where, "objects", OBJECT_DEPTH_MAX);
    else
        diag_at(a->b->e->diags, DIAG_TOO_LARGE, where, OBJECT_LEAVES_MAX);
    args_fail(a);
    return NULL;
}

const struct object *args_object(struct args *a, bool *was_object)
{
    const struct span where = a->at ? a->at->where : (struct span){0};
    const struct value *v = args_take_value(a, VALUE_OBJECT);
    *was_object = true;
    if (v)
        return limited(a, where, v->data);
    if (a->at && a->at->kind == AST_VALUE && !a->at->value) { // reported already
        args_next(a);
        args_fail(a);
        return NULL;
    }
    if (builder_is_object_word(args_at_block(a)))
        return limited(a, where, build_object(a, args_next(a)));
    *was_object = false;
    return NULL;
}

const struct object *build_one_object(struct args *a, const struct ast *block,
                                      const struct transform *before)
{
    struct args in = args_of(a->b, block, a);
    bool was;
    const struct object *inner = args_object(&in, &was);
    if (!was)
        args_error(&in, args_span(&in), "an object is expected");
    if (!inner)
        return NULL;
    struct object *o = object_copy(a->b->arena, inner);
    if (before)
        object_move(a->b, o, before);
    build_modifiers(&in, o);
    return in.failed ? NULL : o;
}
