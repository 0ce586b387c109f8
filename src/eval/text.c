#include "eval/text.h"

#include <string.h>

void text_add(struct text_buffer *b, const char *text, size_t len)
{
    if (b->len + len + 1 > b->capacity) {
        size_t capacity = 2 * b->capacity + len + 32;
        char *grown = arena_alloc(b->arena, capacity);
        if (b->len)
            memcpy(grown, b->text, b->len);
        b->text = grown;
        b->capacity = capacity;
    }
    if (len)
        memcpy(b->text + b->len, text, len);
    b->len += len;
    b->text[b->len] = 0;
}

void text_add_unit(struct text_buffer *b, uint32_t unit)
{
    char c[3];
    if (unit < 0x80) {
        c[0] = (char)unit;
        text_add(b, c, 1);
    } else if (unit < 0x800) {
        c[0] = (char)(0xc0 | unit >> 6);
        c[1] = (char)(0x80 | (unit & 63));
        text_add(b, c, 2);
    } else {
        c[0] = (char)(0xe0 | unit >> 12);
        c[1] = (char)(0x80 | (unit >> 6 & 63));
        c[2] = (char)(0x80 | (unit & 63));
        text_add(b, c, 3);
    }
}

uint32_t text_unit(const char **at, const char *end)
{
    const unsigned char *s = (const unsigned char *)*at;
    size_t left = (size_t)(end - *at);
    if (s[0] >= 0xc2 && s[0] < 0xe0 && left >= 2 && (s[1] & 0xc0) == 0x80) {
        *at += 2;
        return (uint32_t)(s[0] & 31) << 6 | (s[1] & 63);
    }
    if (s[0] >= 0xe0 && s[0] < 0xf0 && left >= 3 && (s[1] & 0xc0) == 0x80 &&
        (s[2] & 0xc0) == 0x80) {
        *at += 3;
        return (uint32_t)(s[0] & 15) << 12 | (uint32_t)(s[1] & 63) << 6 | (s[2] & 63);
    }
    if (s[0] >= 0xf0 && left >= 4) {
        *at += 4;
        return 0xfffd; // no unit of 16 bits holds it
    }
    *at += 1;
    return s[0];
}

size_t text_units(const char *text, size_t len)
{
    size_t n = 0;
    for (const char *end = text + len; text < end; n++)
        text_unit(&text, end);
    return n;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// The four digits after \u, or -1.
static int32_t hex_unit(const char *at, const char *end)
{
    if (end - at < 4)
        return -1;
    int32_t unit = 0;
    for (int i = 0; i < 4; i++) {
        int digit = hex_digit(at[i]);
        if (digit < 0)
            return -1;
        unit = unit * 16 + digit;
    }
    return unit;
}

const char *text_unescape(struct text_buffer *b, const char *raw, size_t len, bool path)
{
    static const char letters[] = "abfnrtv\\'\"";
    static const char meaning[] = "\a\b\f\n\r\t\v\\'\"";
    const char *end = raw + len;
    text_add(b, "", 0);
    while (raw < end) {
        const char *slash = memchr(raw, '\\', (size_t)(end - raw));
        if (!slash || slash + 1 == end) {
            text_add(b, raw, (size_t)(end - raw));
            return NULL;
        }
        text_add(b, raw, (size_t)(slash - raw));
        const char *known = memchr(letters, slash[1], sizeof letters - 1);
        if (path && slash[1] != '"') {
            text_add(b, slash, 1);
            raw = slash + 1;
        } else if (known) {
            text_add(b, &meaning[known - letters], 1);
            raw = slash + 2;
        } else {
            int32_t unit = slash[1] == 'u' ? hex_unit(slash + 2, end) : -1;
            if (unit < 0)
                return slash;
            text_add_unit(b, (uint32_t)unit);
            raw = slash + 6;
        }
    }
    return NULL;
}
