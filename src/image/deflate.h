#ifndef IMAGE_DEFLATE_H
#define IMAGE_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Blocks of RFC 1951, each with Huffman codes of its own, of repeats that the caller found.
enum { DEFLATE_LONGEST = 258, DEFLATE_SHORTEST = 3, DEFLATE_FARTHEST = 1 << 15 };

// Bytes as they are, then `length` that stand `distance` before.
struct repeat {
    uint32_t literals;
    uint16_t length, distance;
};

struct bit_writer {
    uint8_t *at; // room for eight bytes more than are written
    uint64_t bits;
    unsigned count;
};
void bits_put(struct bit_writer *to, uint32_t bits, unsigned count);
void bits_align(struct bit_writer *to); // up to the next byte

// The block of the bytes from `data` on that the repeats and `rest` bytes behind them make up; no more
// than 1 << 20 repeats and bytes that are in none.
void deflate_block(struct bit_writer *to, const uint8_t *data,
                   const struct repeat *repeats, size_t count, size_t rest, bool last);
// No more bytes than that for so many bytes in so many blocks.
size_t deflate_bound(size_t size, size_t blocks);

#endif
