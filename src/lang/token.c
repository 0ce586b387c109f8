#include "lang/token.h"

#include <string.h>

static const char *const texts[WORD_COUNT] = {
    [WORD_NONE] = "",
#define WORD(name, class) [WORD_##name] = #name,
#include "lang/keywords.def"
#undef WORD
};

static const unsigned char classes[WORD_COUNT] = {
#define WORD(name, class) [WORD_##name] = CLASS_##class,
#include "lang/keywords.def"
#undef WORD
};

const char *word_text(enum word w) { return w < WORD_COUNT ? texts[w] : ""; }

enum word_class word_class(enum word w)
{
    return w < WORD_COUNT ? (enum word_class)classes[w] : CLASS_NONE;
}

const char *const *word_list(void) { return texts + 1; }

// keywords.def is in alphabetical order (a test checks it).
enum word word_find(const char *text, size_t len)
{
    int lo = 1, hi = WORD_COUNT;
    while (lo < hi) {
        int mid = (lo + hi) / 2;
        int order = strncmp(texts[mid], text, len);
        if (order == 0)
            order = texts[mid][len] != 0;
        if (order == 0)
            return (enum word)mid;
        if (order < 0)
            lo = mid + 1;
        else
            hi = mid;
    }
    return WORD_NONE;
}

static uint32_t word_hash(const char *text, size_t len)
{
    uint32_t h = WORD_HASH;
    for (size_t i = 0; i < len; i++)
        h = word_hash_add(h, text[i]);
    return h;
}

static uint32_t first_place(uint32_t hash) { return (hash ^ hash >> 15) % 2048; }

void word_table_init(struct word_table *t)
{
    *t = (struct word_table){0};
    for (int w = 1; w < WORD_COUNT; w++) {
        const size_t len = strlen(texts[w]);
        uint32_t at = first_place(word_hash(texts[w], len));
        while (t->at[at].word)
            at = (at + 1) % 2048;
        t->at[at].word = (uint16_t)w;
        t->at[at].len = (uint16_t)len;
    }
}

enum word word_table_find_hashed(const struct word_table *t, const char *text, size_t len,
                                 uint32_t hash)
{
    for (uint32_t at = first_place(hash); t->at[at].word; at = (at + 1) % 2048)
        if (t->at[at].len == len && memcmp(texts[t->at[at].word], text, len) == 0)
            return (enum word)t->at[at].word;
    return WORD_NONE;
}

enum word word_table_find(const struct word_table *t, const char *text, size_t len)
{
    return word_table_find_hashed(t, text, len, word_hash(text, len));
}
