// Deflate's blocks: codes from counts, and all that is told of them before the bytes.
#include "image/deflate.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { SYMBOLS = 286, END = 256, LENGTHS = 29, DISTANCES = 30, SIZES = 19 };
enum { LONGEST_CODE = 15, LONGEST_SIZE_CODE = 7, BLOCK_MOST = 1 << 20 };

struct code {
    uint8_t size[SYMBOLS];  // 0: never used
    uint16_t bits[SYMBOLS]; // the first bit lowest
};

// The last of the lengths is a symbol of its own, though the one before would reach it.
static const uint16_t length_first[LENGTHS + 1] = {
    3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23,  27,
    31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258, 259};
static const uint8_t length_extra[LENGTHS] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                              2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};

struct distance {
    unsigned symbol, extra, offset;
};

// Two symbols for each power of two from 4 on, counted from a distance of 1.
static inline struct distance distance_of(unsigned distance)
{
    const unsigned d = distance - 1, extra = 30 - (unsigned)__builtin_clz(d | 2);
    return (struct distance){2 * extra + (d >> extra), extra, d & ((1u << extra) - 1)};
}

// What is written at once between two flushes has up to 56 bits.
static inline void put(struct bit_writer *to, uint64_t bits, unsigned count)
{
    to->bits |= bits << to->count;
    to->count += count;
}

static inline void flush(struct bit_writer *to)
{
    for (unsigned i = 0; i < 8; i++) // one store
        to->at[i] = (uint8_t)(to->bits >> 8 * i);
    to->at += to->count / 8;
    to->bits >>= to->count / 8 * 8;
    to->count %= 8;
}

void bits_put(struct bit_writer *to, uint32_t bits, unsigned count)
{
    put(to, bits, count);
    flush(to);
}

void bits_align(struct bit_writer *to) { bits_put(to, 0, -to->count % 8); }

// Keys have the count above the symbol.
enum { SYMBOL_BITS = 9, SYMBOL_MASK = (1 << SYMBOL_BITS) - 1 };
static_assert(BLOCK_MOST < 1 << (31 - SYMBOL_BITS), "counts have room above symbols");

static int by_key(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

// How many of n symbols, the rarest first, have codes of each size: Huffman's tree, whose
// nodes are made in the order of their counts.
static void tree_sizes(const uint32_t *key, size_t n, unsigned *of_size, size_t sizes)
{
    uint32_t count[2 * SYMBOLS];
    uint16_t parent[2 * SYMBOLS];
    uint16_t depth[2 * SYMBOLS];
    for (size_t i = 0; i < n; i++)
        count[i] = key[i] >> SYMBOL_BITS;
    size_t leaf = 0, node = n, root = 2 * n - 2;
    for (size_t next = n; next <= root; next++) {
        count[next] = 0;
        for (int child = 0; child < 2; child++) {
            const bool from_leaf =
                leaf < n && (node == next || count[leaf] <= count[node]);
            const size_t least = from_leaf ? leaf++ : node++;
            count[next] += count[least];
            parent[least] = (uint16_t)next;
        }
    }
    depth[root] = 0;
    for (size_t i = root; i-- > 0;) {
        depth[i] = (uint16_t)(depth[parent[i]] + 1);
        if (i < n)
            of_size[depth[i] < sizes ? depth[i] : sizes - 1]++;
    }
}

// Codes that would be longer than `most` get that size, and shorter ones are made longer
// until all find room.
static void limit_sizes(unsigned *of_size, size_t sizes, unsigned most)
{
    for (size_t s = most + 1; s < sizes; s++) {
        of_size[most] += of_size[s];
        of_size[s] = 0;
    }
    size_t used = 0;
    for (unsigned s = 1; s <= most; s++)
        used += (size_t)of_size[s] << (most - s);
    for (; used > (size_t)1 << most; used--) {
        unsigned s = most - 1;
        while (!of_size[s])
            s--;
        of_size[most]--;
        of_size[s]--;
        of_size[s + 1] += 2;
    }
}

static uint16_t reversed(unsigned bits, unsigned size)
{
    unsigned r = 0;
    for (unsigned i = 0; i < size; i++)
        r |= (bits >> i & 1) << (size - 1 - i);
    return (uint16_t)r;
}

static void code_make(struct code *code, const uint32_t *count, size_t symbols,
                      unsigned most)
{
    enum { TREE_SIZES = 64 };
    uint32_t key[SYMBOLS];
    unsigned of_size[TREE_SIZES] = {0};
    size_t n = 0;
    *code = (struct code){0};
    for (size_t i = 0; i < symbols; i++)
        if (count[i])
            key[n++] = count[i] << SYMBOL_BITS | (uint32_t)i;
    qsort(key, n, sizeof *key, by_key);
    if (n > 1)
        tree_sizes(key, n, of_size, TREE_SIZES);
    else
        of_size[1] = (unsigned)n;
    limit_sizes(of_size, TREE_SIZES, most);
    for (unsigned s = most, i = 0; s > 0; s--)
        for (unsigned k = 0; k < of_size[s]; k++)
            code->size[key[i++] & SYMBOL_MASK] = (uint8_t)s;
    unsigned next[LONGEST_CODE + 1] = {0};
    for (unsigned s = 1; s < most; s++)
        next[s + 1] = (next[s] + of_size[s]) << 1;
    for (size_t i = 0; i < symbols; i++)
        if (code->size[i])
            code->bits[i] = reversed(next[code->size[i]]++, code->size[i]);
}

static void put_code(struct bit_writer *to, const struct code *code, size_t symbol)
{
    put(to, code->bits[symbol], code->size[symbol]);
}

static size_t used(const struct code *code, size_t symbols, size_t least)
{
    while (symbols > least && !code->size[symbols - 1])
        symbols--;
    return symbols;
}

// Sizes of both codes in a row, where what repeats is told by a symbol and a number.
struct size_row {
    size_t count;
    uint8_t symbol[SYMBOLS + DISTANCES], extra[SYMBOLS + DISTANCES];
};
enum { SAME = 16, ZEROS = 17, MANY_ZEROS = 18 };

static struct size_row size_row(const uint8_t *size, size_t n)
{
    struct size_row row = {0};
    for (size_t i = 0, same; i < n; i += same) {
        for (same = 1; i + same < n && same < 138 && size[i + same] == size[i];)
            same++;
        uint8_t symbol = size[i], least = 1;
        if (!symbol && same >= 3) {
            symbol = same > 10 ? MANY_ZEROS : ZEROS;
            least = same > 10 ? 11 : 3;
        } else if (i && symbol == size[i - 1] && same >= 3) {
            symbol = SAME;
            least = 3;
            same = same < 6 ? same : 6;
        } else {
            same = 1;
        }
        row.symbol[row.count] = symbol;
        row.extra[row.count++] = (uint8_t)(same - least);
    }
    return row;
}

static void put_codes(struct bit_writer *to, const struct code *symbols,
                      const struct code *distances, bool last)
{
    static const uint8_t order[SIZES] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                         11, 4,  12, 3, 13, 2, 14, 1, 15};
    static const uint8_t extra[SIZES] = {[SAME] = 2, [ZEROS] = 3, [MANY_ZEROS] = 7};
    const size_t n = used(symbols, SYMBOLS, END + 1), m = used(distances, DISTANCES, 1);
    uint8_t size[SYMBOLS + DISTANCES];
    memcpy(size, symbols->size, n);
    memcpy(size + n, distances->size, m);
    const struct size_row row = size_row(size, n + m);
    uint32_t count[SIZES] = {0};
    for (size_t i = 0; i < row.count; i++)
        count[row.symbol[i]]++;
    struct code sizes;
    code_make(&sizes, count, SIZES, LONGEST_SIZE_CODE);
    size_t told = SIZES;
    while (told > 4 && !sizes.size[order[told - 1]])
        told--;
    bits_put(to, (unsigned)last | 2 << 1, 3);
    bits_put(to,
             (uint32_t)(n - (END + 1)) | (uint32_t)(m - 1) << 5 |
                 (uint32_t)(told - 4) << 10,
             14);
    for (size_t i = 0; i < told; i++)
        bits_put(to, sizes.size[order[i]], 3);
    for (size_t i = 0; i < row.count; i++) {
        put_code(to, &sizes, row.symbol[i]);
        bits_put(to, row.extra[i], extra[row.symbol[i]]);
    }
}

// A symbol's code and what follows it, with the number of bits in the lowest byte.
static inline void put_entry(struct bit_writer *to, uint32_t entry)
{
    put(to, entry >> 8, entry & 255);
}

struct entries {
    uint32_t literal[256], length[DEFLATE_LONGEST + 1];
};

static void entries_make(struct entries *e, const struct code *symbols)
{
    for (size_t i = 0; i < 256; i++)
        e->literal[i] = (uint32_t)symbols->bits[i] << 8 | symbols->size[i];
    for (size_t s = 0; s < LENGTHS; s++) {
        const uint32_t size = symbols->size[END + 1 + s],
                       bits = symbols->bits[END + 1 + s];
        for (uint32_t l = length_first[s]; l < length_first[s + 1]; l++)
            e->length[l] =
                (bits | (l - length_first[s]) << size) << 8 | (size + length_extra[s]);
    }
}

static void put_bytes(struct bit_writer *writer, const struct entries *e,
                      const struct code *distances, const uint8_t *data,
                      const struct repeat *repeats, size_t count, size_t rest)
{
    struct bit_writer own = *writer,
                      *to = &own; // which no byte that is written may change
    for (size_t i = 0; i <= count; i++) {
        const uint8_t *end = data + (i < count ? repeats[i].literals : rest);
        for (; end - data >= 3; data += 3) {
            put_entry(to, e->literal[data[0]]);
            put_entry(to, e->literal[data[1]]);
            put_entry(to, e->literal[data[2]]);
            flush(to);
        }
        for (; data < end; data++)
            put_entry(to, e->literal[*data]);
        flush(to);
        if (i == count)
            break;
        const struct distance d = distance_of(repeats[i].distance);
        put_entry(to, e->length[repeats[i].length]);
        put_code(to, distances, d.symbol);
        put(to, d.offset, d.extra);
        flush(to);
        data += repeats[i].length;
    }
    *writer = own;
}

struct counts {
    uint32_t symbol[SYMBOLS], distance[DISTANCES];
};

// Bytes that follow one another are mostly alike: counts of their own do not wait for those
// of the byte before.
static void count_bytes(struct counts *c, const uint8_t *data,
                        const struct repeat *repeats, size_t count, size_t rest)
{
    uint32_t byte[4][256] = {0}, length[DEFLATE_LONGEST + 1] = {0};
    for (size_t i = 0; i <= count; i++) {
        const uint8_t *end = data + (i < count ? repeats[i].literals : rest);
        for (; end - data >= 4; data += 4)
            for (int k = 0; k < 4; k++)
                byte[k][data[k]]++;
        for (; data < end; data++)
            byte[0][*data]++;
        if (i == count)
            break;
        length[repeats[i].length]++;
        c->distance[distance_of(repeats[i].distance).symbol]++;
        data += repeats[i].length;
    }
    for (size_t i = 0; i < 256; i++)
        c->symbol[i] = byte[0][i] + byte[1][i] + byte[2][i] + byte[3][i];
    for (size_t s = 0; s < LENGTHS; s++)
        for (size_t l = length_first[s]; l < length_first[s + 1]; l++)
            c->symbol[END + 1 + s] += length[l];
    c->symbol[END] = 1;
}

void deflate_block(struct bit_writer *to, const uint8_t *data,
                   const struct repeat *repeats, size_t count, size_t rest, bool last)
{
    struct counts counts = {0};
    struct code symbols, distances;
    struct entries entries;
    count_bytes(&counts, data, repeats, count, rest);
    code_make(&symbols, counts.symbol, SYMBOLS, LONGEST_CODE);
    code_make(&distances, counts.distance, DISTANCES, LONGEST_CODE);
    put_codes(to, &symbols, &distances, last);
    entries_make(&entries, &symbols);
    put_bytes(to, &entries, &distances, data, repeats, count, rest);
    put_code(to, &symbols, END);
    flush(to);
}

// Three bytes that repeat take six at most (codes of 15 bits, 5 and 13 more), others two; the
// codes take 14 bits for each size of 316 at most.
size_t deflate_bound(size_t size, size_t blocks)
{
    enum { CODES = 700 };
    return 2 * size + CODES * blocks;
}
