// The page that `lambert compare SCENE...` leaves beside its pictures: both pictures of each
// scene and the heat map, the worst first. Pointing at a picture shows the other one.
#include "cmd/report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char style[] =
    "body{font:14px sans-serif;margin:1em;background:#222;color:#ddd}"
    "table{border-spacing:.6em}td{vertical-align:top}"
    "img{display:block;image-rendering:pixelated;min-width:240px}"
    ".blink{position:relative}.blink img+img{position:absolute;left:0;top:0}"
    ".blink:hover img+img{opacity:0}"
    ".match{color:#8d8}.near{color:#dd8}.far,.not,.no{color:#f88}"
    "a{color:inherit}";

const char *verdict_text(enum verdict v)
{
    static const char *const text[VERDICT_COUNT] = {"match", "near", "far",
                                                    "not rendered", "no reference"};
    return text[v];
}

// Text as HTML shows it.
static void put_text(FILE *f, const char *text)
{
    for (; *text; text++) {
        switch (*text) {
        case '<': fputs("&lt;", f); break;
        case '>': fputs("&gt;", f); break;
        case '&': fputs("&amp;", f); break;
        case '"': fputs("&quot;", f); break;
        default: fputc(*text, f);
        }
    }
}

// A file's name as a link: all but letters, digits and a few more is escaped.
static void put_link(FILE *f, const char *name, const char *end)
{
    for (; *name; name++)
        if (strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.",
                   *name))
            fputc(*name, f);
        else
            fprintf(f, "%%%02X", (unsigned)(unsigned char)*name);
    fputs(end, f);
}

static void put_image(FILE *f, const char *name, const char *end)
{
    fputs("<img alt=\"\" src=\"", f);
    put_link(f, name, end);
    fputs("\">", f);
}

static void put_log(FILE *f, const char *folder, const char *name)
{
    char *path = text_format("%s/%s.log", folder, name);
    if (access(path, R_OK) == 0) {
        fputs("<br><a href=\"", f);
        put_link(f, name, ".log\">log</a>");
    }
    free(path);
}

static void put_row(FILE *f, const char *folder, const struct compared_scene *r)
{
    const char *verdict = verdict_text(r->verdict);
    fprintf(f, "<tr><td><b class=\"%s\">%s</b><br>", verdict, verdict);
    put_text(f, r->scene);
    fputs("<br>", f);
    if (!is_compared(r)) {
        put_text(f, r->reason);
        put_log(f, folder, r->name);
        fputs("</td></tr>\n", f);
        return;
    }
    fprintf(f, "%.3f %% off<br>PSNR %.1f dB<br>%.2f s, here %.2f s</td>\n", r->percent,
            r->difference.psnr, r->reference_seconds, r->seconds);
    fputs("<td>", f);
    put_image(f, r->name, ".reference.png");
    fputs("</td><td class=\"blink\">", f);
    put_image(f, r->name, ".reference.png");
    put_image(f, r->name, ".png");
    fputs("</td><td>", f);
    put_image(f, r->name, ".heat.png");
    fputs("</td></tr>\n", f);
}

// What failed first, then by the share of pixels that are off; then as they came.
static int by_difference(const void *a, const void *b)
{
    const struct compared_scene *const *x = a, *const *y = b;
    const double p = is_compared(*x) ? (*x)->percent : 1000,
                 q = is_compared(*y) ? (*y)->percent : 1000;
    if (p != q)
        return p < q ? 1 : -1;
    return *x < *y ? -1 : *x > *y;
}

bool report_write(const char *folder, const struct compared_scene *rows, size_t count)
{
    const struct compared_scene **order = malloc((count + 1) * sizeof(void *));
    char *path = text_format("%s/index.html", folder);
    FILE *f = order ? fopen(path, "w") : NULL;
    if (f) {
        for (size_t i = 0; i < count; i++)
            order[i] = &rows[i];
        qsort(order, count, sizeof *order, by_difference);
        fprintf(f,
                "<!DOCTYPE html>\n<meta charset=\"utf-8\"><title>Comparison</title>\n"
                "<style>%s</style>\n<table>\n<tr><th>scene</th><th>reference</th>"
                "<th>lambert (point: reference)</th><th>difference</th></tr>\n",
                style);
        for (size_t i = 0; i < count; i++)
            put_row(f, folder, order[i]);
        fputs("</table>\n", f);
    }
    const bool ok = f && !ferror(f);
    const bool closed = f && fclose(f) == 0;
    free(order);
    free(path);
    return ok && closed;
}
