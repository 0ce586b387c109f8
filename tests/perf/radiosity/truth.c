#include "truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct bin bin[BINS_MOST];
int bins;

void truth_read(const char *path)
{
    char line[1024];
    FILE *file = fopen(path, "r");
    if (!file) {
        perror(path);
        exit(1);
    }
    while (fgets(line, sizeof line, file) && bins < BINS_MOST) {
        struct bin *x = &bin[bins];
        if (line[0] == '#')
            continue;
        if (sscanf(line,
                   "%31s %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf "
                   "%*f %*f %*f %lf",
                   x->name, &x->p.x, &x->p.y, &x->p.z, &x->a.x, &x->a.y, &x->a.z, &x->b.x,
                   &x->b.y, &x->b.z, &x->rho[0], &x->rho[1], &x->rho[2], &x->h[0],
                   &x->h[1], &x->h[2], &x->e) != 17) {
            fprintf(stderr, "%s: not understood: %s", path, line);
            exit(1);
        }
        bins++;
    }
    fclose(file);
}

void error_add(struct error_sum *s, double area, const double rho[3], const double got[3],
               const double truth[3])
{
    for (int c = 0; c < 3; c++) {
        const double d = rho[c] * (got[c] - truth[c]);
        s->off += area * d * d;
        s->all += area * rho[c] * rho[c] * truth[c] * truth[c];
    }
}

double error_of(const struct error_sum *s) { return sqrt(s->off / s->all); }
