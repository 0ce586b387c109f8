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

const char *word_text(enum word w)
{
    return w < WORD_COUNT ? texts[w] : "";
}

enum word_class word_class(enum word w)
{
    return w < WORD_COUNT ? (enum word_class)classes[w] : CLASS_NONE;
}

const char *const *word_list(void)
{
    return texts + 1;
}

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
    uint32_t h = 2166136261u; // FNV-1a
    for (size_t i = 0; i < len; i++)
        h = (h ^ (unsigned char)text[i]) * 16777619u;
    return (h ^ h >> 15) % 2048;
}

void word_table_init(struct word_table *t)
{
    *t = (struct word_table){0};
    for (int w = 1; w < WORD_COUNT; w++) {
        uint32_t at = word_hash(texts[w], strlen(texts[w]));
        while (t->word[at])
            at = (at + 1) % 2048;
        t->word[at] = (uint16_t)w;
    }
}

enum word word_table_find(const struct word_table *t, const char *text, size_t len)
{
    for (uint32_t at = word_hash(text, len); t->word[at]; at = (at + 1) % 2048) {
        const char *word = texts[t->word[at]];
        if (strncmp(word, text, len) == 0 && word[len] == 0)
            return (enum word)t->word[at];
    }
    return WORD_NONE;
}
