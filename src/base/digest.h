#ifndef BASE_DIGEST_H
#define BASE_DIGEST_H

#include <stddef.h>
#include <stdint.h>

// FNV-1a of 64 bits; begin with digest_start.
static const uint64_t digest_start = 0xcbf29ce484222325u;

static inline uint64_t digest_add(uint64_t digest, const void *data, size_t n)
{
    const unsigned char *p = data;
    for (size_t i = 0; i < n; i++)
        digest = (digest ^ p[i]) * 0x100000001b3u;
    return digest;
}

#endif
