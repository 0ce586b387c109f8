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
