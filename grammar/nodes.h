#ifndef GRAMMAR_NODES_H
#define GRAMMAR_NODES_H

#include "lang/parse_state.h"

// The nodes that the grammar's actions make. Inline: there are millions of them.

static inline struct ast *of_list(struct parse *p, enum ast_kind kind, struct span where,
                                  enum word word, struct ast *list)
{
    struct ast *n = ast_new(p->arena, kind, where);
    n->word = (uint16_t)word;
    n->list = list;
    return n;
}

static inline struct ast *unary(struct parse *p, struct span where, int op,
                                struct ast *operand)
{
    struct ast *n = ast_new(p->arena, AST_UNARY, where);
    n->op = (uint16_t)op;
    n->left = operand;
    return n;
}

static inline struct ast *binary(struct parse *p, struct span where, int op,
                                 struct ast *left, struct ast *right)
{
    struct ast *n = ast_new(p->arena, AST_BINARY, where);
    n->op = (uint16_t)op;
    n->left = left;
    n->right = right;
    return n;
}

static inline struct ast *conditional(struct parse *p, struct span where,
                                      struct ast *condition, struct ast *yes,
                                      struct ast *no)
{
    condition->next = yes;
    yes->next = no;
    return of_list(p, AST_CONDITIONAL, where, WORD_NONE, condition);
}

static inline struct ast *word(struct parse *p, struct span where, enum word w)
{
    return of_list(p, AST_WORD, where, w, NULL);
}

// A list while it is read is its last node, whose `next` is the first: one pointer goes
// through the parser's stack, as values written in parts stall it when they are copied.
static inline struct ast *append(struct ast *list, struct ast *node)
{
    node->next = list ? list->next : node;
    if (list)
        list->next = node;
    return node;
}

static inline struct ast *one(struct ast *node) { return append(NULL, node); }

static inline struct ast *join(struct ast *a, struct ast *b)
{
    struct ast *first = a->next;
    a->next = b->next;
    b->next = first;
    return b;
}

// The first node of a list that is complete.
static inline struct ast *all(struct ast *list)
{
    if (!list)
        return NULL;
    struct ast *first = list->next;
    list->next = NULL;
    return first;
}

// What stands before a list in brackets, with that list: a call, or an array's element.
static inline struct ast *with_list(struct ast *what, enum ast_kind kind,
                                    struct span where, struct ast *list)
{
    what->kind = kind;
    what->where = where;
    what->list = list;
    return what;
}

// A list's comma: false when there is nothing for it to follow.
static inline bool comma(struct ast *list)
{
    if (!list || list->comma_after)
        return false;
    list->comma_after = 1;
    return true;
}

// An array element of several items is one node.
static inline struct ast *element(struct parse *p, struct ast *items)
{
    struct ast *last = items, *first = all(items);
    if (first == last)
        return first;
    return of_list(p, AST_BLOCK, span_join(first->where, last->where), WORD_NONE, first);
}

static inline bool is_texture(const struct ast *n)
{
    return n && n->kind == AST_BLOCK && n->word == WORD_texture;
}

// Adds an element to an initialiser; textures with no comma between are layers.
static inline struct ast *add_element(struct parse *p, struct ast *last, struct ast *n)
{
    bool layers = last && last->kind == AST_BLOCK && last->word == WORD_NONE &&
                  is_texture(last->list);
    if (!is_texture(n) || !last || last->comma_after || !(layers || is_texture(last)))
        return append(last, n);
    if (!layers) {
        struct ast *first = arena_new_struct(p->arena, struct ast);
        *first = *last;
        first->next = NULL;
        last->word = WORD_NONE;
        last->list = first;
    }
    struct ast *end = last->list;
    while (end->next)
        end = end->next;
    end->next = n;
    last->where = span_join(last->where, n->where);
    return last;
}

#endif
