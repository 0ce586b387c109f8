#ifndef IMAGE_HUFFMAN_H
#define IMAGE_HUFFMAN_H

// Huffman's codes as deflate has them (RFC 1951).
#include <stdint.h>

enum { HUFFMAN_SYMBOLS = 286, HUFFMAN_LONGEST = 15 };

struct huffman {
    uint16_t word[HUFFMAN_SYMBOLS]; // its first bit lowest
    uint8_t bits[HUFFMAN_SYMBOLS];  // 0: the symbol has none
};

// Of n symbols that occur `count` times, less than 2^23; words are at most `longest` bits long and at least two.
void huffman_make(struct huffman *h, const uint32_t *count, uint32_t n, unsigned longest);

#endif
