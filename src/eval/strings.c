// The functions that take or make strings (spec/language 2.8, 2.10).

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/arena.h"
#include "eval/functions.h"
#include "eval/text.h"

static bool give_number(struct call *c, double v)
{
    c->result.n[0] = v;
    return true;
}

static bool give_text(struct call *c, const struct text_buffer *b)
{
    c->result.text = b->text;
    return true;
}

bool call_asc(struct call *c)
{
    const char *s = c->arg[0].s;
    return give_number(c, *s ? text_unit(&s, s + strlen(s)) : 0);
}

bool call_strlen(struct call *c)
{
    return give_number(c, (double)text_units(c->arg[0].s, strlen(c->arg[0].s)));
}

bool call_strcmp(struct call *c)
{
    const char *a = c->arg[0].s, *b = c->arg[1].s;
    const char *a_end = a + strlen(a), *b_end = b + strlen(b);
    int64_t difference = 0;
    while (!difference && (a < a_end || b < b_end)) {
        int64_t from_a = a < a_end ? text_unit(&a, a_end) : 0;
        int64_t from_b = b < b_end ? text_unit(&b, b_end) : 0;
        difference = from_a - from_b;
    }
    return give_number(c, (double)difference);
}

bool call_val(struct call *c) { return give_number(c, atof(c->arg[0].s)); }

bool call_file_exists(struct call *c)
{
    return give_number(c, file_find(c->e, c->arg[0].s, NULL) != NULL);
}

bool call_chr(struct call *c)
{
    double n = number_to_int(c->arg[0].f);
    if (n < 0 || n > 65535)
        return call_domain(c, "the code is not between 0 and 65535");
    struct text_buffer b = {.arena = c->e->nodes};
    text_add(&b, "", 0);
    if (n > 0)
        text_add_unit(&b, (uint32_t)n);
    return give_text(c, &b);
}

bool call_concat(struct call *c)
{
    struct text_buffer b = {.arena = c->e->nodes};
    for (uint32_t i = 0; i < c->count; i++)
        text_add(&b, c->arg[i].s, strlen(c->arg[i].s));
    return give_text(c, &b);
}

static bool change_case(struct call *c, char first, char last, int by)
{
    struct text_buffer b = {.arena = c->e->nodes};
    text_add(&b, c->arg[0].s, strlen(c->arg[0].s));
    for (char *s = b.text; *s; s++)
        if (*s >= first && *s <= last)
            *s = (char)(*s + by);
    return give_text(c, &b);
}

bool call_strupr(struct call *c) { return change_case(c, 'a', 'z', 'A' - 'a'); }
bool call_strlwr(struct call *c) { return change_case(c, 'A', 'Z', 'a' - 'A'); }

bool call_substr(struct call *c)
{
    const char *s = c->arg[0].s, *end = s + strlen(s);
    double from = number_to_int(c->arg[1].f), count = number_to_int(c->arg[2].f);
    if (from < 1 || count < 0 || from + count - 1 > (double)text_units(s, strlen(s)))
        return call_domain(c, "the part reaches outside the string");
    for (double i = 1; i < from; i++)
        text_unit(&s, end);
    const char *stop = s;
    for (double i = 0; i < count; i++)
        text_unit(&stop, end);
    struct text_buffer b = {.arena = c->e->nodes};
    text_add(&b, s, (size_t)(stop - s));
    return give_text(c, &b);
}

static void add_number(struct text_buffer *b, double v, double width, double precision)
{
    enum { PLAIN_MAX = 254 }; // longer text is written with an exponent
    char text[1024];
    int w = (int)number_to_int(width), p = (int)number_to_int(precision);
    p = p < 0 ? 6 : p > 500 ? 500 : p;
    bool zeros = w < 0;
    w = abs(w > 250 ? 250 : w < -250 ? -250 : w);
    int n = snprintf(text, sizeof text, zeros ? "%0*.*f" : "%*.*f", w, p, v);
    if (n > PLAIN_MAX)
        n = snprintf(text, sizeof text, zeros ? "%0*.*g" : "%*.*g", w, p > 200 ? 200 : p,
                     v);
    text_add(b, text, (size_t)n);
}

bool call_str(struct call *c)
{
    struct text_buffer b = {.arena = c->e->nodes};
    add_number(&b, c->arg[0].f, c->arg[1].f, c->arg[2].f);
    return give_text(c, &b);
}

bool call_vstr(struct call *c)
{
    struct text_buffer b = {.arena = c->e->nodes};
    double n = number_to_int(c->arg[0].f);
    n = n < 2 ? 2 : n > 5 ? 5 : n;
    for (int i = 0; i < (int)n; i++) {
        if (i)
            text_add(&b, c->arg[2].s, strlen(c->arg[2].s));
        add_number(&b, c->arg[1].n[i], c->arg[3].f, c->arg[4].f);
    }
    return give_text(c, &b);
}

bool call_datetime(struct call *c)
{
    const char *format = c->count > 1 ? c->arg[1].s : "%Y-%m-%d %H:%M:%SZ";
    char text[400];
    double seconds = floor(c->arg[0].f * 86400 + 0.5);
    if (!*format || strlen(format) > 200)
        return call_domain(c, "the format is empty or too long");
    if (!(fabs(seconds) < 1e12))
        return call_domain(c, "the date is out of range");
    time_t t = (time_t)seconds + 946684800; // 2000-01-01 00:00 UTC
    struct tm utc;
    size_t n = gmtime_r(&t, &utc) ? strftime(text, sizeof text, format, &utc) : 0;
    if (!n)
        return call_domain(c, "the format gives nothing");
    struct text_buffer b = {.arena = c->e->nodes};
    text_add(&b, text, n);
    return give_text(c, &b);
}
