#include "radiosity/sequence.h"

static uint32_t reverse(uint32_t x)
{
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

// A permutation in which a bit changes higher bits only; applied to reversed bits it
// swaps the halves of every elementary interval.
static uint32_t permute(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

static uint32_t scramble(uint32_t x, uint32_t seed)
{
    return reverse(permute(reverse(x), seed));
}

uint32_t sequence_seed(uint32_t a, uint32_t b)
{
    uint32_t h = a * 0x9e3779b9u ^ (b + 0x7f4a7c15u + (a << 6) + (a >> 2));
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

// Direction numbers of dimensions 1 to 3 from the primitive polynomials x + 1,
// x^2 + x + 1 and x^3 + x + 1 with first values {1}, {1, 3}, {1, 3, 1} (Joe, Kuo 2008).
static const uint32_t directions[3][32] = {
    {0x80000000u, 0xc0000000u, 0xa0000000u, 0xf0000000u, 0x88000000u, 0xcc000000u,
     0xaa000000u, 0xff000000u, 0x80800000u, 0xc0c00000u, 0xa0a00000u, 0xf0f00000u,
     0x88880000u, 0xcccc0000u, 0xaaaa0000u, 0xffff0000u, 0x80008000u, 0xc000c000u,
     0xa000a000u, 0xf000f000u, 0x88008800u, 0xcc00cc00u, 0xaa00aa00u, 0xff00ff00u,
     0x80808080u, 0xc0c0c0c0u, 0xa0a0a0a0u, 0xf0f0f0f0u, 0x88888888u, 0xccccccccu,
     0xaaaaaaaau, 0xffffffffu},
    {0x80000000u, 0xc0000000u, 0x60000000u, 0x90000000u, 0xe8000000u, 0x5c000000u,
     0x8e000000u, 0xc5000000u, 0x68800000u, 0x9cc00000u, 0xee600000u, 0x55900000u,
     0x80680000u, 0xc09c0000u, 0x60ee0000u, 0x90550000u, 0xe8808000u, 0x5cc0c000u,
     0x8e606000u, 0xc5909000u, 0x6868e800u, 0x9c9c5c00u, 0xeeee8e00u, 0x5555c500u,
     0x8000e880u, 0xc0005cc0u, 0x60008e60u, 0x9000c590u, 0xe8006868u, 0x5c009c9cu,
     0x8e00eeeeu, 0xc5005555u},
    {0x80000000u, 0xc0000000u, 0x20000000u, 0x50000000u, 0xf8000000u, 0x74000000u,
     0xa2000000u, 0x93000000u, 0xd8800000u, 0x25400000u, 0x59e00000u, 0xe6d00000u,
     0x78080000u, 0xb40c0000u, 0x82020000u, 0xc3050000u, 0x208f8000u, 0x51474000u,
     0xfbea2000u, 0x75d93000u, 0xa0858800u, 0x914e5400u, 0xdbe79e00u, 0x25db6d00u,
     0x58800080u, 0xe54000c0u, 0x79e00020u, 0xb6d00050u, 0x800800f8u, 0xc00c0074u,
     0x200200a2u, 0x50050093u},
};

void sobol_point(uint32_t index, uint32_t seed, double out[4])
{
    // The order is shuffled in the same way, so that sequences of different seeds have
    // nothing to do with each other.
    index = scramble(index, seed);
    uint32_t x[4] = {reverse(index), 0, 0, 0};
    for (uint32_t left = index; left; left &= left - 1) {
        const int bit = __builtin_ctz(left);
        x[1] ^= directions[0][bit];
        x[2] ^= directions[1][bit];
        x[3] ^= directions[2][bit];
    }
    for (uint32_t d = 0; d < 4; d++)
        out[d] = scramble(x[d], sequence_seed(seed, d + 1)) * (1.0 / 4294967296.0);
}

void random_point(uint32_t index, uint32_t seed, double out[4])
{
    for (uint32_t d = 0; d < 4; d++)
        out[d] = sequence_seed(sequence_seed(index, seed), d) * (1.0 / 4294967296.0);
}
