#include "image/deflate.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "image/huffman.h"

enum {
    END = 256,
    LITERALS = HUFFMAN_SYMBOLS,
    DISTANCES = 30,
    LENGTHS = 19,
    LONGEST_LENGTH_WORD = 7,
    WINDOW = 1 << 15,
    LEAST_MATCH = 6, // bytes; few in noise have a match so long
    LONGEST_MATCH = 258,
    TOKENS = 1 << 15, // of a block
    HASH_BITS = 12,
    STEP_SHIFT =
        4, // after so many bytes (a power of two) without a match steps get wider
    STEP_MAX = 16,
};

// Bits that wait, the first lowest, and where they go.
struct bit_writer {
    uint64_t bits;
    unsigned count;
    uint8_t *at;
};

struct packer {
    struct bit_writer out; // has room for what the block takes
    uint8_t *begin;
    size_t capacity;
    uint32_t literal[LITERALS], distance[DISTANCES]; // how often in the block
    struct huffman literals, distances;
    uint32_t seen[1 << HASH_BITS]; // where bytes of this hash were last
    uint32_t token_count;
    uint32_t token[TOKENS]; // a byte, or a distance and, from bit 16, a length
};

// ---- bytes ------------------------------------------------------------------------------
static inline uint64_t little(uint64_t v)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return v;
#else
    return __builtin_bswap64(v);
#endif
}

static inline uint64_t load8(const uint8_t *p)
{
    uint64_t v;
    memcpy(&v, p, sizeof v);
    return little(v);
}

// How many are equal, `most` at most.
static inline uint32_t equal_bytes(const uint8_t *a, const uint8_t *b, uint32_t most)
{
    uint32_t n = 0;
    for (; n + 8 <= most; n += 8) {
        const uint64_t differ = load8(a + n) ^ load8(b + n);
        if (differ)
            return n + (uint32_t)__builtin_ctzll(differ) / 8;
    }
    while (n < most && a[n] == b[n])
        n++;
    return n;
}

static inline void put(struct bit_writer *w, uint64_t value, unsigned bits)
{
    w->bits |= value << w->count;
    w->count += bits;
}

// Whole bytes go; up to seven bits stay.
static inline void put_out(struct bit_writer *w)
{
    const uint64_t bits = little(w->bits);
    memcpy(w->at, &bits, sizeof bits);
    w->at += w->count >> 3;
    w->bits >>= w->count & 56;
    w->count &= 7;
}

static inline void put_word(struct bit_writer *w, const struct huffman *h,
                            unsigned symbol)
{
    put(w, h->word[symbol], h->bits[symbol]);
}

static bool reserve(struct packer *p, size_t more)
{
    const size_t used = (size_t)(p->out.at - p->begin);
    if (p->capacity - used >= more)
        return true;
    const size_t capacity = used + more + p->capacity / 2;
    uint8_t *begin = realloc(p->begin, capacity);
    if (!begin)
        return false;
    p->begin = begin;
    p->out.at = begin + used;
    p->capacity = capacity;
    return true;
}

// ---- symbols ----------------------------------------------------------------------------
// Lengths from 3 and distances from 1 are symbols of four and of two a power of two, and
// further bits.
struct symbol {
    unsigned symbol, extra, value;
};

static inline struct symbol distance_symbol(uint32_t distance)
{
    const uint32_t d = distance - 1;
    if (d < 4)
        return (struct symbol){d, 0, 0};
    const unsigned extra = 30u - (unsigned)__builtin_clz(d);
    return (struct symbol){2 * extra + (d >> extra), extra, d & ((1u << extra) - 1)};
}

static inline struct symbol length_symbol(uint32_t length)
{
    const uint32_t l = length - 3;
    if (length == LONGEST_MATCH)
        return (struct symbol){LITERALS - 1, 0, 0};
    if (l < 8)
        return (struct symbol){END + 1 + l, 0, 0};
    const unsigned extra = 29u - (unsigned)__builtin_clz(l);
    return (struct symbol){END + 1 + 4 * extra + (l >> extra), extra,
                           l & ((1u << extra) - 1)};
}

// ---- the codes of a block -----------------------------------------------------------------
// Lengths of words: 16 repeats the last, 17 and 18 are runs of symbols that have none.
struct lengths {
    uint8_t symbol[LITERALS + DISTANCES], extra[LITERALS + DISTANCES];
    uint32_t count;
};

static void lengths_add(struct lengths *l, unsigned symbol, unsigned extra)
{
    l->symbol[l->count] = (uint8_t)symbol;
    l->extra[l->count++] = (uint8_t)extra;
}

static void lengths_of(struct lengths *l, const uint8_t *bits, uint32_t n)
{
    l->count = 0;
    for (uint32_t i = 0, run; i < n; i += run) {
        const uint32_t most = bits[i] ? 7 : 138;
        for (run = 1; run < most && i + run < n && bits[i + run] == bits[i]; run++)
            ;
        if (!bits[i] && run >= 11) {
            lengths_add(l, 18, run - 11);
        } else if (!bits[i] && run >= 3) {
            lengths_add(l, 17, run - 3);
        } else if (bits[i] && run >= 4) {
            lengths_add(l, bits[i], 0);
            lengths_add(l, 16, run - 4);
        } else {
            lengths_add(l, bits[i], 0);
            run = 1;
        }
    }
}

static uint32_t used_of(const struct huffman *h, uint32_t n)
{
    while (!h->bits[n - 1])
        n--;
    return n;
}

static void put_codes(struct packer *p, bool last)
{
    static const uint8_t order[LENGTHS] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                           11, 4,  12, 3, 13, 2, 14, 1, 15};
    static const uint8_t extra[LENGTHS] = {[16] = 2, [17] = 3, [18] = 7};
    struct bit_writer *w = &p->out;
    const uint32_t literals = used_of(&p->literals, LITERALS),
                   distances = used_of(&p->distances, DISTANCES);
    uint8_t bits[LITERALS + DISTANCES];
    memcpy(bits, p->literals.bits, literals);
    memcpy(bits + literals, p->distances.bits, distances);
    struct lengths l;
    lengths_of(&l, bits, literals + distances);
    uint32_t count[LENGTHS] = {0};
    for (uint32_t i = 0; i < l.count; i++)
        count[l.symbol[i]]++;
    struct huffman h;
    huffman_make(&h, count, LENGTHS, LONGEST_LENGTH_WORD);
    uint32_t told = LENGTHS;
    while (told > 4 && !h.bits[order[told - 1]])
        told--;
    const unsigned own_codes = 2;
    put(w, last | own_codes << 1, 3);
    put(w, literals - 257, 5);
    put(w, distances - 1, 5);
    put(w, told - 4, 4);
    for (uint32_t i = 0; i < told; i++) {
        put_out(w);
        put(w, h.bits[order[i]], 3);
    }
    for (uint32_t i = 0; i < l.count; i++) {
        put_out(w);
        put_word(w, &h, l.symbol[i]);
        put(w, l.extra[i], extra[l.symbol[i]]);
    }
    put_out(w);
}

// ---- blocks -----------------------------------------------------------------------------
static void put_tokens(struct packer *p)
{
    struct bit_writer w = p->out; // that no byte written may change
    for (uint32_t i = 0; i < p->token_count; i++) {
        const uint32_t t = p->token[i];
        if (t < END) {
            put_word(&w, &p->literals, t);
            if (w.count >= 32)
                put_out(&w);
            continue;
        }
        put_out(&w);
        const struct symbol length = length_symbol(t >> 16),
                            distance = distance_symbol(t & 0xffff);
        put_word(&w, &p->literals, length.symbol);
        put(&w, length.value, length.extra);
        put_word(&w, &p->distances, distance.symbol);
        put(&w, distance.value, distance.extra);
        put_out(&w);
    }
    put_word(&w, &p->literals, END);
    put_out(&w);
    p->out = w;
}

// At most.
static size_t block_size(const struct packer *p)
{
    enum {
        CODES = 600,
        FURTHER = 5 + 13
    }; // bytes of codes; bits of a match past its words
    size_t bits = 0;
    for (uint32_t i = 0; i < LITERALS; i++)
        bits += (size_t)p->literal[i] * p->literals.bits[i];
    for (uint32_t i = 0; i < DISTANCES; i++)
        bits += (size_t)p->distance[i] * (p->distances.bits[i] + (size_t)FURTHER);
    return bits / 8 + CODES;
}

static bool put_block(struct packer *p, bool last)
{
    p->literal[END] = 1;
    huffman_make(&p->literals, p->literal, LITERALS, HUFFMAN_LONGEST);
    huffman_make(&p->distances, p->distance, DISTANCES, HUFFMAN_LONGEST);
    if (!reserve(p, block_size(p)))
        return false;
    put_codes(p, last);
    put_tokens(p);
    memset(p->literal, 0, sizeof p->literal);
    memset(p->distance, 0, sizeof p->distance);
    p->token_count = 0;
    return true;
}

// ---- matches ----------------------------------------------------------------------------
static inline void add_literal(struct packer *p, unsigned byte)
{
    p->token[p->token_count++] = byte;
    p->literal[byte]++;
}

static inline void add_match(struct packer *p, uint32_t length, uint32_t distance)
{
    p->token[p->token_count++] = length << 16 | distance;
    p->literal[length_symbol(length).symbol]++;
    p->distance[distance_symbol(distance).symbol]++;
}

// The first bytes of `v` that a match must have.
static inline uint64_t key_of(uint64_t v) { return v << (64 - 8 * LEAST_MATCH); }

static inline uint32_t *seen_of(struct packer *p, uint64_t v)
{
    return &p->seen[key_of(v) * 0x9e3779b97f4a7c15u >> (64 - HASH_BITS)];
}

// The last places of a match at `from`, which are likely to be matched themselves.
static inline void note_end(struct packer *p, const uint8_t *data, size_t end)
{
    for (size_t k = end - 2; k < end; k++)
        *seen_of(p, load8(data + k)) = (uint32_t)k;
}

// Places are modulo 2^32: what a wrong one would tell is compared, and lies in the data.
static bool add_data(struct packer *p, const uint8_t *data, size_t count)
{
    size_t i = 0;
    uint32_t misses = 0;
    while (i + 8 < count) {
        if (p->token_count + STEP_MAX > TOKENS && !put_block(p, false))
            return false;
        const uint64_t now = load8(data + i);
        uint32_t *seen = seen_of(p, now);
        const uint32_t distance = (uint32_t)i - *seen;
        *seen = (uint32_t)i;
        if (distance - 1 < WINDOW && distance <= i &&
            !key_of(now ^ load8(data + i - distance))) {
            const size_t left = count - i;
            const uint32_t most = left < LONGEST_MATCH ? (uint32_t)left : LONGEST_MATCH;
            const uint8_t *after = data + i + LEAST_MATCH;
            const uint32_t length =
                LEAST_MATCH + equal_bytes(after, after - distance, most - LEAST_MATCH);
            add_match(p, length, distance);
            i += length;
            misses = 0;
            if (i + 8 < count)
                note_end(p, data, i);
            continue;
        }
        const uint32_t wide = 1 + (misses++ >> STEP_SHIFT);
        size_t step = wide < STEP_MAX ? wide : STEP_MAX;
        step = step < count - i ? step : count - i;
        for (; step; step--)
            add_literal(p, data[i++]);
    }
    if (p->token_count + 8 > TOKENS && !put_block(p, false))
        return false;
    while (i < count)
        add_literal(p, data[i++]);
    return put_block(p, true);
}

// ---- the stream ---------------------------------------------------------------------------
// Adler's sum; blocks are so short that its parts stay below 2^32.
static uint32_t checksum(const uint8_t *data, size_t count)
{
    enum { BLOCK = 4096, MODULUS = 65521 };
    uint32_t a = 1, b = 0;
    for (size_t at = 0, n; at < count; at += n) {
        n = count - at < BLOCK ? count - at : BLOCK;
        uint32_t sum = 0, weighed = 0;
        for (uint32_t i = 0; i < n; i++) {
            sum += data[at + i];
            weighed += data[at + i] * (uint32_t)(n - i);
        }
        b = (uint32_t)((b + (uint64_t)n * a + weighed) % MODULUS);
        a = (a + sum) % MODULUS;
    }
    return b << 16 | a;
}

static bool add_stream(struct packer *p, const uint8_t *data, size_t count)
{
    enum { ENDS = 32 };
    if (!reserve(p, count / 8 + ENDS))
        return false;
    *p->out.at++ = 0x78; // deflate, a window of 2^15
    *p->out.at++ = 0x01; // fast; makes the two a multiple of 31
    if (!add_data(p, data, count) || !reserve(p, ENDS))
        return false;
    put(&p->out, 0, 7); // to a whole byte
    put_out(&p->out);
    const uint32_t sum = checksum(data, count);
    for (int shift = 24; shift >= 0; shift -= 8)
        *p->out.at++ = (uint8_t)(sum >> shift);
    return true;
}

uint8_t *deflate_zlib(const uint8_t *data, size_t count, size_t *size)
{
    struct packer *p = calloc(1, sizeof *p);
    if (!p)
        return NULL;
    const bool ok = add_stream(p, data, count);
    uint8_t *begin = p->begin;
    *size = (size_t)(p->out.at - begin);
    free(p);
    if (ok)
        return begin;
    free(begin);
    return NULL;
}
