#include "eval/file_data.h"

#include <string.h>

#include "base/arena.h"
#include "eval/text.h"
#include "lang/number.h"

enum { KIND_END = 256, KIND_NUMBER, KIND_STRING }; // or a character

struct datum_text {
    int kind;
    double number;
    const char *text; // of a string, between the quotes
    size_t len;
};

static char here(const struct file_data *d)
{
    return d->at < d->len ? d->text[d->at] : 0;
}

static char after(const struct file_data *d)
{
    return d->at + 1 < d->len ? d->text[d->at + 1] : 0;
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

static void skip_comment(struct file_data *d)
{
    if (after(d) == '/') {
        while (d->at < d->len && here(d) != '\n')
            d->at++;
        return;
    }
    for (d->at += 2; d->at < d->len; d->at++)
        if (here(d) == '*' && after(d) == '/') {
            d->at += 2;
            return;
        }
}

static void skip_blank(struct file_data *d)
{
    while (d->at < d->len) {
        if (here(d) == '/' && (after(d) == '/' || after(d) == '*'))
            skip_comment(d);
        else if (strchr(" \t\r\n\f\v\x1a", here(d)))
            d->at++;
        else
            return;
    }
}

static struct datum_text string_lexeme(struct file_data *d)
{
    size_t begin = ++d->at;
    while (d->at < d->len && here(d) != '"')
        d->at += here(d) == '\\' && d->at + 1 < d->len ? 2 : 1;
    struct datum_text l = {
        .kind = KIND_STRING, .text = d->text + begin, .len = d->at - begin};
    d->at++;
    return l;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

static void pass_digits(struct file_data *d)
{
    while (is_digit(here(d)))
        d->at++;
}

static void pass_number(struct file_data *d)
{
    pass_digits(d);
    if (here(d) == '.')
        d->at++;
    pass_digits(d);
    if (here(d) != 'e' && here(d) != 'E')
        return;
    d->at++;
    if (here(d) == '-' || here(d) == '+')
        d->at++;
    pass_digits(d);
}

static struct datum_text next_lexeme(struct file_data *d)
{
    skip_blank(d);
    struct datum_text l = {.kind = KIND_END};
    char c = here(d);
    if (d->at >= d->len)
        return l;
    if (is_digit(c) || (c == '.' && is_digit(after(d)))) {
        size_t begin = d->at;
        pass_number(d);
        l.kind = KIND_NUMBER;
        l.number = number_parse(d->text + begin, d->at - begin);
        return l;
    }
    if (c == '"')
        return string_lexeme(d);
    l.kind = (unsigned char)c;
    d->at++;
    while (is_letter(c) && is_letter(here(d))) // a word is one token
        d->at++;
    return l;
}

static bool signed_number(struct file_data *d, struct datum_text l, double *out)
{
    bool minus = l.kind == '-';
    if (minus || l.kind == '+')
        l = next_lexeme(d);
    *out = minus ? -l.number : l.number;
    return l.kind == KIND_NUMBER;
}

static bool vector(struct file_data *d, struct value *out)
{
    double n[5];
    int width = 0;
    struct datum_text l = next_lexeme(d);
    for (; l.kind != '>'; l = next_lexeme(d)) {
        if (width == 5 || !signed_number(d, l, &n[width++]))
            return false;
        size_t before = d->at;
        if (next_lexeme(d).kind != ',')
            d->at = before;
    }
    *out = value_of_number(n, width);
    return width >= 2;
}

static bool string(struct arena *a, struct datum_text l, struct value *out)
{
    struct text_buffer b = {.arena = a};
    if (text_unescape(&b, l.text, l.len, false))
        return false;
    *out = (struct value){.kind = VALUE_STRING};
    out->string.text = b.text ? b.text : "";
    out->string.len = (uint32_t)b.len;
    return true;
}

enum file_item file_data_next(struct file_data *d, struct arena *a, struct value *out)
{
    double n;
    bool ok;
    struct datum_text l = next_lexeme(d);
    switch (l.kind) {
    case KIND_END: return FILE_ITEM_END;
    case KIND_STRING: ok = string(a, l, out); break;
    case '<': ok = vector(d, out); break;
    default:
        ok = signed_number(d, l, &n);
        if (ok)
            *out = value_of_number(&n, 1);
    }
    if (!ok)
        return FILE_ITEM_WRONG;
    return next_lexeme(d).kind == KIND_END ? FILE_ITEM_LAST : FILE_ITEM_VALUE;
}

size_t file_data_line(const struct file_data *d)
{
    size_t line = 1;
    for (size_t i = 0; i < d->at && i < d->len; i++)
        line += d->text[i] == '\n';
    return line;
}
