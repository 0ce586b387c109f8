// Prints the tables of noise_tables.h as C, from the recurrences of spec/textures 1.
// Run once while lambert is built.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/noise_tables.h"

struct tables {
    uint16_t hash[NOISE_HASH_SIZE], corner[NOISE_HASH_SIZE];
    double value[NOISE_VALUE_COUNT];
    uint16_t permutation[NOISE_GRADIENT_COUNT];
    double gradient[NOISE_GRADIENT_COUNT][3];
};

static void make_hash(struct tables *t)
{
    uint32_t s = 0;
    for (unsigned i = 0; i < 4096; i++)
        t->hash[i] = (uint16_t)i;
    for (unsigned i = 4096; i-- > 0;) {
        unsigned j = noise_draw(&s) % 4096;
        uint16_t swap = t->hash[i];
        t->hash[i] = t->hash[j];
        t->hash[j] = swap;
    }
    memcpy(t->hash + 4096, t->hash, 4096 * sizeof t->hash[0]);
}

// CRC-16, polynomial 0xA001 reflected, of the double's big-endian bytes three times.
static unsigned crc_of(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    unsigned crc = 0;
    for (int n = 0; n < 24; n++) {
        crc ^= (unsigned)(bits >> (56 - 8 * (n % 8))) & 0xff;
        for (int b = 0; b < 8; b++)
            crc = crc & 1 ? crc >> 1 ^ 0xa001 : crc >> 1;
    }
    return crc;
}

static void make_values(struct tables *t)
{
    for (int i = 0; i < NOISE_VALUE_COUNT; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.6g", 2 * (crc_of(0.12345 * i) / 65535.0) - 1);
        t->value[i] = strtod(text, NULL);
    }
}

static void make_gradients(struct tables *t)
{
    const int n = NOISE_GRADIENT_PERIOD;
    uint32_t s = 1;
    for (int i = 0; i < n; i++) {
        double v[3], norm;
        do {
            for (int k = 0; k < 3; k++)
                v[k] = ((double)(noise_draw(&s) % 4096) - 2048) / 2048;
            norm = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        } while (norm > 1 || norm < 1e-5);
        for (int k = 0; k < 3; k++)
            t->gradient[i][k] = v[k] * (1 / sqrt(norm));
        t->permutation[i] = (uint16_t)i;
    }
    // The first swap reaches one past the permutation: a value is lost there.
    t->permutation[n] = 0;
    for (int i = n; i > 0; i -= 2) {
        uint16_t k = t->permutation[i];
        unsigned j = noise_draw(&s) % (unsigned)n;
        t->permutation[i] = t->permutation[j];
        t->permutation[j] = k;
    }
    for (int i = 0; i < n + 2; i++) {
        t->permutation[n + i] = t->permutation[i];
        memcpy(t->gradient[n + i], t->gradient[i], sizeof t->gradient[i]);
    }
}

static void print_integers(const char *type, const char *name, const char *size,
                           const uint16_t *v, int count)
{
    printf("const %s %s[%s] = {", type, name, size);
    for (int i = 0; i < count; i++)
        printf("%s%u,", i % 16 ? "" : "\n", v[i]);
    printf("};\n");
}

// Matsumoto and Nishimura, "Mersenne Twister", 1998: MT19937, seed 5489.
static void print_random(void)
{
    uint32_t mt[624];
    mt[0] = 5489;
    for (uint32_t i = 1; i < 624; i++)
        mt[i] = 1812433253u * (mt[i - 1] ^ mt[i - 1] >> 30) + i;
    printf("const uint32_t noise_random_table[NOISE_RANDOM_COUNT] = {");
    for (int i = 0; i < NOISE_RANDOM_COUNT; i++) {
        int k = i % 624;
        uint32_t y = (mt[k] & 0x80000000u) | (mt[(k + 1) % 624] & 0x7fffffffu);
        mt[k] = mt[(k + 397) % 624] ^ y >> 1 ^ (y & 1 ? 0x9908b0dfu : 0);
        y = mt[k];
        y ^= y >> 11;
        y ^= y << 7 & 0x9d2c5680u;
        y ^= y << 15 & 0xefc60000u;
        y ^= y >> 18;
        printf("%s%uu,", i % 8 ? "" : "\n", y);
    }
    printf("};\n");
}

static void print_rows(const struct tables *t)
{
    printf("const double noise_row_table[NOISE_ROW_COUNT][4] = {\n");
    for (int i = 0; i < NOISE_ROW_COUNT; i++)
        printf("{%a, %a, %a, %a},\n", 0.5 * t->value[i], t->value[i + 1], t->value[i + 2],
               t->value[i + 3]);
    printf("};\n");
}

static void print_fans(const struct tables *t)
{
    printf("const double noise_fan_table[NOISE_FAN_COUNT][4] = {\n");
    for (int i = 0; i < NOISE_FAN_COUNT; i++)
        printf("{%a, %a, %a, 0},\n", t->value[i], t->value[i + 4], t->value[i + 8]);
    printf("};\n");
}

// Vector noise at (i, 0, 0) is the lattice value alone.
static void print_waves(const struct tables *t)
{
    uint32_t s = NOISE_WAVE_SEED;
    printf("const double noise_wave_table[NOISE_WAVE_COUNT][4] = {\n");
    for (int i = 0; i < NOISE_WAVE_COUNT; i++) {
        unsigned zero = 10000 & 4095, x = (unsigned)(i + 10000) & 4095;
        unsigned k = t->hash[t->hash[t->hash[x] ^ zero] ^ zero] & 255;
        double v[3];
        for (unsigned m = 0; m < 3; m++)
            v[m] = t->value[k + 4 * m] * 0.5;
        double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        double frequency = noise_draw(&s) * NOISE_WAVE_STEP + 0.01;
        printf("{%a, %a, %a, %a},\n", v[0] / length, v[1] / length, v[2] / length,
               frequency);
    }
    printf("};\n");
}

int main(void)
{
    struct tables t;
    make_hash(&t);
    make_values(&t);
    make_gradients(&t);
    printf("// Generated by gen_noise_tables.\n#include \"scene/noise_tables.h\"\n");
    print_integers("uint16_t", "noise_hash_table", "NOISE_HASH_SIZE", t.hash,
                   NOISE_HASH_SIZE);
    for (int i = 0; i < NOISE_HASH_SIZE; i++)
        t.corner[i] = (uint16_t)(4 * (t.hash[i] & 255));
    print_integers("uint16_t", "noise_corner_table", "NOISE_HASH_SIZE", t.corner,
                   NOISE_HASH_SIZE);
    print_integers("uint16_t", "noise_permutation", "NOISE_GRADIENT_COUNT", t.permutation,
                   NOISE_GRADIENT_COUNT);
    printf("const double noise_value_table[NOISE_VALUE_COUNT] = {\n");
    for (int i = 0; i < NOISE_VALUE_COUNT; i++)
        printf("%a,\n", t.value[i]);
    printf("};\n");
    print_rows(&t);
    print_fans(&t);
    printf("const double noise_gradient[NOISE_GRADIENT_COUNT][3] = {\n");
    for (int i = 0; i < NOISE_GRADIENT_COUNT; i++)
        printf("{%a, %a, %a},\n", t.gradient[i][0], t.gradient[i][1], t.gradient[i][2]);
    printf("};\n");
    print_waves(&t);
    print_random();
    return fflush(stdout) || ferror(stdout);
}
