#include "base/diag.h"

#include <ctype.h>
#include <stdarg.h>
#include <string.h>

struct row {
    enum diag_code code;
    enum severity severity;
    const char *text;
};

static const struct row rows[] = {
#define DIAG(name, number, severity, text) {DIAG_##name, severity, text},
#include "base/diagnostics.def"
#undef DIAG
};

static const char *const severity_name[] = {"note", "warning", "error"};

static const struct row *find_row(enum diag_code code)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].code == code)
            return &rows[i];
    return NULL;
}

static bool same_span(struct span a, struct span b)
{
    return a.file == b.file && a.begin == b.begin && a.end == b.end &&
           a.expansion == b.expansion;
}

// What the scene itself says (#warning) is said as often as it says it.
static bool repeats(struct diag_sink *sink, enum diag_code code, struct span where)
{
    enum { RECENT = sizeof sink->recent / sizeof sink->recent[0] };
    if (!where.end || code == DIAG_SCENE_WARNING)
        return false;
    for (unsigned i = 0; i < RECENT; i++)
        if (sink->recent[i].code == code && same_span(sink->recent[i].where, where))
            return true;
    sink->recent[sink->recent_at].code = code;
    sink->recent[sink->recent_at].where = where;
    sink->recent_at = (sink->recent_at + 1) % RECENT;
    return false;
}

void diag_report(struct diag_sink *sink, enum diag_code code, struct span where,
                 const struct span *related, const char *hint, ...)
{
    const struct row *row = find_row(code);
    char text[1024];
    va_list ap;
    va_start(ap, hint);
    vsnprintf(text, sizeof text, row->text, ap);
    va_end(ap);
    struct diag d = {code, row->severity, where, related ? *related : (struct span){0},
                     text, hint};
    if (d.severity == SEV_ERROR && diag_full(sink))
        return;
    if (d.severity != SEV_NOTE && repeats(sink, code, where)) {
        sink->repeats += d.severity == SEV_ERROR;
        return;
    }
    sink->errors += d.severity == SEV_ERROR;
    sink->warnings += d.severity == SEV_WARNING;
    if (sink->emit)
        sink->emit(sink->user, &d);
}

struct place {
    const char *name;
    unsigned line, column; // 1-based
};

static struct place place_of(const struct source_map *m, struct span s)
{
    const struct source_line line = source_line(m->file[s.file], s.begin);
    return (struct place){line.name, line.number, s.begin - line.begin + 1};
}

enum { EXCERPT_BEFORE = 160, EXCERPT_MAX = 240 };

// Prints the source line and underlines the part of the span that is on it.
static void print_excerpt(FILE *out, const struct source_map *m, struct span s, char mark,
                          const char *hint)
{
    const struct source_file *f = m->file[s.file];
    const struct source_line line = source_line(m->file[s.file], s.begin);
    uint32_t start = line.begin, stop = line.end;
    while (stop > start && f->text[stop - 1] == '\r')
        stop--;
    // Generated scenes have lines of a megabyte: what is near the place is shown.
    if (s.begin > start + EXCERPT_BEFORE)
        start = s.begin - EXCERPT_BEFORE;
    if (stop > start + EXCERPT_MAX)
        stop = start + EXCERPT_MAX;
    uint32_t end = s.end < stop ? s.end : stop;
    fprintf(out, "%5u | ", (unsigned)line.number);
    for (uint32_t i = start; i < stop; i++) { // no escape sequences for the terminal
        unsigned char c = (unsigned char)f->text[i];
        fputc((c < 0x20 && c != '\t') || c == 0x7f ? '?' : c, out);
    }
    fputs("\n      | ", out);
    for (uint32_t i = start; i < s.begin; i++)
        fputc(f->text[i] == '\t' ? '\t' : ' ', out);
    fputc(mark, out);
    for (uint32_t i = s.begin + 1; i < end; i++)
        fputc('~', out);
    if (hint)
        fprintf(out, " %s", hint);
    fputc('\n', out);
}

static void print_stack(FILE *out, const struct source_map *m, struct span s)
{
    int shown = 0;
    for (uint32_t e = s.expansion; e && shown < 8; shown++) {
        const struct expansion *x = &m->expansions[e];
        struct place p = place_of(m, x->called_at);
        fprintf(out, "  in macro %s() called from %s:%u:%u\n", x->macro, p.name, p.line,
                p.column);
        s = x->called_at;
        e = s.expansion;
    }
    for (const struct source_file *f = m->file[s.file]; f->included_at.end;
         f = m->file[f->included_at.file]) {
        struct place p = place_of(m, f->included_at);
        fprintf(out, "  included from %s:%u\n", p.name, p.line);
    }
}

static void print_json_string(FILE *out, const char *s)
{
    fputc('"', out);
    for (; *s; s++) {
        unsigned char c = (unsigned char)*s;
        if (c == '"' || c == '\\')
            fprintf(out, "\\%c", c);
        else if (c < 0x20)
            fprintf(out, "\\u%04x", c);
        else
            fputc(c, out);
    }
    fputc('"', out);
}

static void print_json(FILE *out, const struct source_map *m, const struct diag *d)
{
    fprintf(out, "{\"v\":1,\"t\":\"diag\",\"sev\":\"%s\",\"code\":\"E%04d\"",
            severity_name[d->severity], (int)d->code);
    if (d->where.end) {
        struct place p = place_of(m, d->where);
        fputs(",\"file\":", out);
        print_json_string(out, p.name);
        fprintf(out, ",\"line\":%u,\"col\":%u,\"endCol\":%u", p.line, p.column,
                p.column + (d->where.end - d->where.begin));
    }
    fputs(",\"msg\":", out);
    print_json_string(out, d->message);
    if (d->hint) {
        fputs(",\"hint\":", out);
        print_json_string(out, d->hint);
    }
    fputs("}\n", out);
}

static void print_pov(FILE *out, const struct source_map *m, const struct diag *d)
{
    static const char *const kind[] = {"Note", "Parse Warning", "Parse Error"};
    if (d->where.end) {
        struct place p = place_of(m, d->where);
        fprintf(out, "File '%s' line %u: ", p.name, p.line);
    }
    fprintf(out, "%s: %s\n", kind[d->severity], d->message);
}

void diag_print(FILE *out, const struct source_map *m, const struct diag *d,
                enum diag_style style, bool color)
{
    static const char *const tint[] = {"\033[36m", "\033[35m", "\033[31m"};
    if (style == DIAG_JSON) {
        print_json(out, m, d);
        return;
    }
    if (style == DIAG_POV) {
        print_pov(out, m, d);
        return;
    }
    if (d->where.end) {
        struct place p = place_of(m, d->where);
        fprintf(out, "%s:%u:%u: ", p.name, p.line, p.column);
    } else {
        fputs("lambert: ", out);
    }
    fprintf(out, "%s%s:%s %s [E%04d]", color ? tint[d->severity] : "",
            severity_name[d->severity], color ? "\033[0m" : "", d->message, (int)d->code);
    if (style == DIAG_GCC || !d->where.end) {
        if (d->hint)
            fprintf(out, " (%s)", d->hint);
        fputc('\n', out);
        return;
    }
    fputc('\n', out);
    print_excerpt(out, m, d->where, '^', d->hint);
    if (d->related.end)
        print_excerpt(out, m, d->related, '~', NULL);
    print_stack(out, m, d->where);
}

// Optimal string alignment: letters put in, left out, replaced, or two beside each other
// swapped; upper and lower case are one. Words longer than WORD_MAX are not compared.
enum { WORD_MAX = 40 };

static bool same_letter(char a, char b)
{
    return tolower((unsigned char)a) == tolower((unsigned char)b);
}

static unsigned least_of(unsigned a, unsigned b) { return a < b ? a : b; }

static unsigned edit_distance(const char *a, size_t na, const char *b, size_t nb)
{
    unsigned table[3][WORD_MAX + 1]; // the last three rows
    for (size_t j = 0; j <= nb; j++)
        table[0][j] = (unsigned)j;
    for (size_t i = 1; i <= na; i++) {
        unsigned *row = table[i % 3];
        const unsigned *above = table[(i - 1) % 3], *second = table[(i + 1) % 3];
        row[0] = (unsigned)i;
        for (size_t j = 1; j <= nb; j++) {
            row[j] = above[j - 1] + !same_letter(a[i - 1], b[j - 1]);
            row[j] = least_of(row[j], least_of(above[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) &&
                same_letter(a[i - 2], b[j - 1]))
                row[j] = least_of(row[j], second[j - 2] + 1);
        }
    }
    return table[na % 3][nb];
}

const char *diag_closest(const char *word, size_t len, const char *const *list,
                         size_t count)
{
    const char *best = NULL;
    unsigned below = len < 6 ? 2 : len < 9 ? 3 : 4; // slips: one, two, three
    if (len < 2 || len > WORD_MAX)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        size_t n = strlen(list[i]);
        if (n > WORD_MAX || (n > len ? n - len : len - n) >= below ||
            (n == len && memcmp(word, list[i], n) == 0))
            continue;
        unsigned d = edit_distance(word, len, list[i], n);
        if (d < below) {
            below = d;
            best = list[i];
        }
    }
    return best;
}
