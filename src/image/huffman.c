#include "image/huffman.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static int by_value(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

struct node {
    uint32_t sum, parent, depth;
};

// Depths in the tree of n leaves, lightest first; returns the greatest. The two lightest of those leaves and
// nodes that have no parent are joined; nodes that are made are never lighter than earlier ones.
static unsigned tree_depths(const uint32_t *leaf, uint32_t n, uint8_t *depth)
{
    struct node node[2 * HUFFMAN_SYMBOLS];
    for (uint32_t i = 0; i < n; i++)
        node[i].sum = leaf[i];
    uint32_t next_leaf = 0, next_node = n, end = n;
    for (; end < 2 * n - 1; end++) {
        node[end].sum = 0;
        for (int k = 0; k < 2; k++) {
            const bool take =
                next_leaf < n &&
                (next_node == end || node[next_leaf].sum <= node[next_node].sum);
            struct node *child = &node[take ? next_leaf++ : next_node++];
            node[end].sum += child->sum;
            child->parent = end;
        }
    }
    unsigned deepest = 0;
    node[end - 1].depth = 0;
    for (uint32_t i = end - 1; i-- > 0;) {
        node[i].depth = node[node[i].parent].depth + 1;
        deepest = node[i].depth > deepest ? node[i].depth : deepest;
    }
    for (uint32_t i = 0; i < n; i++)
        depth[i] = (uint8_t)node[i].depth;
    return deepest;
}

static uint16_t reversed(unsigned word, unsigned bits)
{
    unsigned r = 0;
    for (; bits; bits--, word >>= 1)
        r = r << 1 | (word & 1);
    return (uint16_t)r;
}

// Words of one length are numbers in the order of their symbols.
static void give_words(struct huffman *h, uint32_t n)
{
    unsigned count[HUFFMAN_LONGEST + 1] = {0}, next[HUFFMAN_LONGEST + 1] = {0};
    for (uint32_t i = 0; i < n; i++)
        count[h->bits[i]]++;
    count[0] = 0;
    for (unsigned b = 1; b <= HUFFMAN_LONGEST; b++)
        next[b] = (next[b - 1] + count[b - 1]) << 1;
    for (uint32_t i = 0; i < n; i++)
        if (h->bits[i])
            h->word[i] = reversed(next[h->bits[i]]++, h->bits[i]);
}

void huffman_make(struct huffman *h, const uint32_t *count, uint32_t n, unsigned longest)
{
    enum { SYMBOL_BITS = 9 };
    uint32_t sorted[HUFFMAN_SYMBOLS], leaf[HUFFMAN_SYMBOLS], used = 0;
    uint8_t depth[HUFFMAN_SYMBOLS];
    for (uint32_t i = 0; i < n; i++)
        if (count[i])
            sorted[used++] = count[i] << SYMBOL_BITS | i;
    for (uint32_t i = 0; used < 2; i++)
        if (!count[i])
            sorted[used++] = 1u << SYMBOL_BITS | i;
    qsort(sorted, used, sizeof *sorted, by_value);
    for (uint32_t i = 0; i < used; i++)
        leaf[i] = sorted[i] >> SYMBOL_BITS;
    while (tree_depths(leaf, used, depth) > longest)
        for (uint32_t i = 0; i < used; i++) // flatter, in the end flat
            leaf[i] = (leaf[i] + 1) / 2;
    memset(h->bits, 0, sizeof h->bits);
    for (uint32_t i = 0; i < used; i++)
        h->bits[sorted[i] & ((1u << SYMBOL_BITS) - 1)] = depth[i];
    give_words(h, n);
}
