// The truth of a closed or open scene of matt polygons, independent of lambert:
//   radiosity_truth cube                  the cube C1 from closed form factors
//   radiosity_truth SCENE.faces PARTICLES by particle tracing with triangles alone
// writes a table of bins: parallelograms p, a, b on surfaces, reflectance there, and the
// mean irradiance (radiosity of what arrives) with its standard error, and emission.
//
// SCENE.faces holds lines
//   matt R G B [E]                        reflectance and emission of what follows
//   quad NAME U V SHRINK x y z ...        four corners, counter-clockwise seen from where
//                                         it is lit; U by V bins, on its part SHRINK
//   box NAME SHRINK x0 y0 z0 x1 y1 z1     lit from outside, bins by size
//   room NAME x0 y0 z0 x1 y1 z1           lit from inside
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "math/vec.h"

static const double pi = 3.14159265358979323846;
enum { TRIANGLES = 1024, BINS = 8192, BATCHES = 20 };

struct matt {
    double rho[3], emission;
};

struct face {
    char name[32];
    struct vec3 p, a, b, n; // frame of the bins
    struct matt matt;
    double area; // of its triangles
    int nu, nv, first_bin;
};

struct triangle {
    struct vec3 p, a, b, n;
    int face;
};

static struct face face[TRIANGLES];
static struct triangle triangle[TRIANGLES];
static double *got;                // [batch][bin][3]
static double dropped[BATCHES][3]; // what left the scene
static int faces, triangles, bins;

// ---- the scene -----------------------------------------------------------------------
static void add_triangle(struct vec3 p, struct vec3 q, struct vec3 r, int f)
{
    struct triangle *t = &triangle[triangles++];
    *t = (struct triangle){p, vec3_sub(q, p), vec3_sub(r, p), {0, 0, 0}, f};
    const struct vec3 n = vec3_cross(t->a, t->b);
    face[f].area += vec3_length(n) / 2;
    t->n = vec3_normalize(n);
}

static void add_quad(const char *name, const struct vec3 c[4], int nu, int nv,
                     double shrink, const struct matt *m)
{
    if (triangles + 2 > TRIANGLES || bins + nu * nv > BINS) {
        fprintf(stderr, "too many faces\n");
        exit(1);
    }
    struct face *f = &face[faces];
    *f = (struct face){.matt = *m, .nu = nu, .nv = nv, .first_bin = bins};
    snprintf(f->name, sizeof f->name, "%s", name);
    f->a = vec3_scale(shrink, vec3_sub(c[1], c[0]));
    f->b = vec3_scale(shrink, vec3_sub(c[3], c[0]));
    const struct vec3 middle = vec3_mad(c[0], .5, vec3_sub(c[2], c[0]));
    f->p = vec3_mad(vec3_mad(middle, -.5, f->a), -.5, f->b);
    f->n = vec3_normalize(vec3_cross(f->a, f->b));
    add_triangle(c[0], c[1], c[2], faces);
    add_triangle(c[0], c[2], c[3], faces);
    bins += nu * nv;
    faces++;
}

// Bins of about a sixteenth of `side`.
static int bins_for(double length, double side)
{
    const int n = (int)(length / side * 8 + .5);
    return n < 1 ? 1 : n;
}

static void add_box(const char *name, const double x[6], bool inside, double shrink,
                    const struct matt *m)
{
    const double side = inside ? fmax(x[3] - x[0], fmax(x[4] - x[1], x[5] - x[2])) : 3;
    for (int k = 0; k < 6; k++) {
        const int axis = k / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const bool upper = k & 1;
        double c[4][3];
        for (int j = 0; j < 4; j++) {
            c[j][axis] = x[axis + 3 * upper];
            c[j][u] = x[u + 3 * (j == 1 || j == 2)];
            c[j][v] = x[v + 3 * (j >= 2)];
        }
        struct vec3 corner[4];
        for (int j = 0; j < 4; j++) {
            // u, v turn about the axis upwards.
            const int i = upper != inside ? j : 3 - j;
            corner[j] = vec3(c[i][0], c[i][1], c[i][2]);
        }
        char full[40];
        snprintf(full, sizeof full, "%s%c%c", name, upper ? '+' : '-', "xyz"[axis]);
        add_quad(full, corner,
                 bins_for(vec3_length(vec3_sub(corner[1], corner[0])), side),
                 bins_for(vec3_length(vec3_sub(corner[3], corner[0])), side), shrink, m);
    }
}

static void read_scene(const char *path)
{
    FILE *file = fopen(path, "r");
    char line[512], name[32];
    struct matt m = {{0, 0, 0}, 0};
    if (!file) {
        perror(path);
        exit(1);
    }
    while (fgets(line, sizeof line, file)) {
        double x[12], shrink;
        int nu, nv;
        if (sscanf(line, "matt %lf %lf %lf %lf", &x[0], &x[1], &x[2], &x[3]) >= 3) {
            const bool glows = sscanf(line, "matt %*f %*f %*f %lf", &m.emission) == 1;
            m = (struct matt){{x[0], x[1], x[2]}, glows ? m.emission : 0};
        } else if (sscanf(line,
                          "quad %31s %d %d %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf "
                          "%lf %lf",
                          name, &nu, &nv, &shrink, &x[0], &x[1], &x[2], &x[3], &x[4],
                          &x[5], &x[6], &x[7], &x[8], &x[9], &x[10], &x[11]) == 16) {
            const struct vec3 c[4] = {{x[0], x[1], x[2]},
                                      {x[3], x[4], x[5]},
                                      {x[6], x[7], x[8]},
                                      {x[9], x[10], x[11]}};
            add_quad(name, c, nu, nv, shrink, &m);
        } else if (sscanf(line, "box %31s %lf %lf %lf %lf %lf %lf %lf", name, &shrink,
                          &x[0], &x[1], &x[2], &x[3], &x[4], &x[5]) == 8) {
            add_box(name, x, false, shrink, &m);
        } else if (sscanf(line, "room %31s %lf %lf %lf %lf %lf %lf", name, &x[0], &x[1],
                          &x[2], &x[3], &x[4], &x[5]) == 7) {
            add_box(name, x, true, 1, &m);
        } else if (line[0] != '#' && line[0] != '\n') {
            fprintf(stderr, "%s: not understood: %s", path, line);
            exit(1);
        }
    }
    fclose(file);
}

// ---- particles -----------------------------------------------------------------------
static uint64_t random_state;

static double random_number(void) // splitmix64
{
    uint64_t z = (random_state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// The triangle met first, -1: none. `own` is the one the ray starts on.
static int meet(struct vec3 o, struct vec3 d, int own, double *t)
{
    int best = -1;
    *t = INFINITY;
    for (int i = 0; i < triangles; i++) {
        const struct triangle *x = &triangle[i];
        // Moeller and Trumbore 1997.
        const struct vec3 q = vec3_cross(d, x->b);
        const double det = vec3_dot(x->a, q);
        if (i == own || det == 0)
            continue;
        const struct vec3 s = vec3_sub(o, x->p);
        const double u = vec3_dot(s, q) / det;
        if (!(u >= 0 && u <= 1))
            continue;
        const struct vec3 r = vec3_cross(s, x->a);
        const double v = vec3_dot(d, r) / det, at = vec3_dot(x->b, r) / det;
        if (!(v >= 0 && u + v <= 1 && at > 0 && at < *t))
            continue;
        // Another triangle of the same plane is not met from it.
        if (own >= 0 && at < 1e-9 && x->face == triangle[own].face)
            continue;
        *t = at;
        best = i;
    }
    return best;
}

static struct vec3 cosine_about(struct vec3 n)
{
    const double z = 2 * random_number() - 1, angle = 2 * pi * random_number();
    const double r = sqrt(1 - z * z);
    // A point of the unit sphere about the tip of n: Lambert's law.
    return vec3_normalize(vec3_add(n, vec3(r * cos(angle), r * sin(angle), z)));
}

static int bin_of(const struct face *f, struct vec3 p)
{
    const struct vec3 d = vec3_sub(p, f->p);
    // The frame may be askew.
    const double aa = vec3_dot(f->a, f->a), ab = vec3_dot(f->a, f->b),
                 bb = vec3_dot(f->b, f->b);
    const double da = vec3_dot(d, f->a), db = vec3_dot(d, f->b), det = aa * bb - ab * ab;
    const double u = (da * bb - db * ab) / det, v = (db * aa - da * ab) / det;
    if (!(u >= 0 && u < 1 && v >= 0 && v < 1))
        return -1;
    return f->first_bin + (int)(v * f->nv) * f->nu + (int)(u * f->nu);
}

static int emitter(const double *up_to)
{
    const double x = random_number() * up_to[triangles - 1];
    int i = 0;
    while (up_to[i] <= x)
        i++;
    return i;
}

static void particle(int batch, const double *up_to)
{
    int at = emitter(up_to);
    double w[3] = {1, 1, 1}, u = random_number(), v = random_number(), t;
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const struct triangle *s = &triangle[at];
    struct vec3 o = vec3_mad(vec3_mad(s->p, u, s->a), v, s->b);
    for (;;) {
        const struct vec3 d = cosine_about(triangle[at].n);
        const int hit = meet(o, d, at, &t);
        if (hit < 0) {
            for (int c = 0; c < 3; c++)
                dropped[batch][c] += w[c];
            return;
        }
        o = vec3_mad(o, t, d);
        const struct face *f = &face[triangle[hit].face];
        if (vec3_dot(d, triangle[hit].n) > 0)
            return; // through a crack
        const int bin = bin_of(f, o);
        for (int c = 0; c < 3 && bin >= 0; c++)
            got[(batch * bins + bin) * 3 + c] += w[c];
        const double most = fmax(w[0], fmax(w[1], w[2]));
        double p = 0;
        for (int c = 0; c < 3; c++)
            p = fmax(p, w[c] * f->matt.rho[c] / most);
        if (random_number() >= p)
            return;
        for (int c = 0; c < 3; c++)
            w[c] *= f->matt.rho[c] / p;
        at = hit;
    }
}

// Whether all of a bin is free: a ray straight off it does not come from within a solid.
static bool bin_is_free(const struct face *f, int k)
{
    enum { SIDE = 9 };
    for (int j = 0; j < SIDE * SIDE; j++) {
        const double u = (k % f->nu + (j % SIDE + .5) / SIDE) / f->nu;
        const double v = (k / f->nu + (j / SIDE + .5) / SIDE) / f->nv;
        const struct vec3 p = vec3_mad(vec3_mad(f->p, u, f->a), v, f->b);
        const double size = vec3_length(f->a);
        double t;
        // Askew, so as not to run along the sides of what stands here.
        const struct vec3 d = vec3_normalize(
            vec3_add(f->n, vec3(.0123 * f->n.y, .0217 * f->n.z, .0171 * f->n.x)));
        // The frame of a warped face lies off it by up to 2e-3.
        const int hit = meet(vec3_mad(p, 4e-3 * size, f->n), d, -1, &t);
        if (hit >= 0 && vec3_dot(d, triangle[hit].n) > 0)
            return false;
    }
    return true;
}

static void print_bin(const struct face *f, int k, const double h[3], const double off[3])
{
    const struct vec3 a = vec3_scale(1.0 / f->nu, f->a),
                      b = vec3_scale(1.0 / f->nv, f->b);
    const struct vec3 p = vec3_mad(vec3_mad(f->p, k % f->nu, a), k / f->nu, b);
    printf("%s\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%.9g\t%g\t%g\t%g",
           f->name, p.x, p.y, p.z, a.x, a.y, a.z, b.x, b.y, b.z, f->matt.rho[0],
           f->matt.rho[1], f->matt.rho[2]);
    printf("\t%.6g\t%.6g\t%.6g\t%.2g\t%.2g\t%.2g\t%g\n", h[0], h[1], h[2], off[0], off[1],
           off[2], f->matt.emission);
}

static void trace(double count)
{
    double up_to[TRIANGLES], sum = 0;
    for (int i = 0; i < triangles; i++) {
        const struct face *f = &face[triangle[i].face];
        const double area = vec3_length(vec3_cross(triangle[i].a, triangle[i].b)) / 2;
        up_to[i] = sum += area * f->matt.emission;
    }
    got = calloc((size_t)BATCHES * (size_t)bins * 3, sizeof *got);
    if (!got || sum <= 0)
        exit(1);
    for (int k = 0; k < BATCHES; k++)
        for (double i = 0; i < count / BATCHES; i++)
            particle(k, up_to);
    const double power = sum / floor(count / BATCHES + .999999);
    double lost[3] = {0, 0, 0};
    for (int k = 0; k < BATCHES; k++)
        for (int c = 0; c < 3; c++)
            lost[c] += dropped[k][c] / count;
    printf("# %g particles; lost %.5f %.5f %.5f\n", count, lost[0], lost[1], lost[2]);
    for (int i = 0; i < faces; i++) {
        const struct face *f = &face[i];
        const double area = vec3_length(vec3_cross(f->a, f->b)) / (f->nu * f->nv);
        for (int k = 0; k < f->nu * f->nv; k++) {
            double mean[3] = {0}, off[3];
            for (int c = 0; c < 3; c++) {
                double square = 0;
                for (int b = 0; b < BATCHES; b++) {
                    const double h =
                        got[(b * bins + f->first_bin + k) * 3 + c] * power / area;
                    mean[c] += h / BATCHES;
                    square += h * h / BATCHES;
                }
                off[c] = sqrt(fmax(square - mean[c] * mean[c], 0) / (BATCHES - 1));
            }
            if (mean[0] > 0 && bin_is_free(f, k))
                print_bin(f, k, mean, off);
        }
    }
}

// ---- the cube --------------------------------------------------------------------------
// Form factors of parallel and perpendicular squares by their closed forms (Howell C-13,
// C-14 for any rectangles), floor E = 1, all reflectances .5.
enum { N = 64, CELLS = 8 };

static double parallel(double x, double y)
{
    const double a = sqrt(x * x + 1), b = sqrt(y * y + 1);
    return (y * a * atan(y / a) + x * b * atan(x / b) - .5 * log(x * x + y * y + 1)) /
           (2 * pi);
}

static double perpendicular(double x, double e, double z)
{
    const double k2 = x * x + z * z, k = sqrt(k2);
    if (k2 == 0)
        return e == 0 ? 0 : e * e * log(e * e) / (8 * pi);
    return (e * k * atan(e / k) - (k2 - e * e) * log(k2 + e * e) / 4) / (2 * pi);
}

static double facing[N][N];    // by difference of columns and of rows
static double corner[N][N][N]; // by distances from the edge, and along it
static double b_floor[N][N], b_ceiling[N][N], b_wall[N][N]; // wall: along, up

static void cube_factors(void)
{
    const double s = 1.0 / N;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            for (int k = 0; k < 16; k++)
                facing[i][j] += (((k >> 3) + (k >> 2) + (k >> 1) + k) & 1 ? -1 : 1) *
                                parallel(s * (i + (k & 1) - (k >> 1 & 1)),
                                         s * (j + (k >> 2 & 1) - (k >> 3))) /
                                (s * s);
    for (int x = 0; x < N; x++)
        for (int z = 0; z < N; z++)
            for (int e = 0; e < N; e++)
                for (int k = 0; k < 16; k++)
                    corner[x][z][e] +=
                        (((k >> 3) + (k >> 2) + (k >> 1) + k) & 1 ? -1 : 1) *
                        perpendicular(s * (x + (k & 1)),
                                      s * (e + (k >> 2 & 1) - (k >> 3)),
                                      s * (z + (k >> 1 & 1))) /
                        (s * s);
}

static double from_facing(double (*b)[N], int i, int j)
{
    double sum = 0;
    for (int x = 0; x < N; x++)
        for (int y = 0; y < N; y++)
            sum += facing[abs(i - x)][abs(j - y)] * b[x][y];
    return sum;
}

// From a surface whose cells lie `along` the edge and `away` from it, to one at distance
// d from the edge and place e along it.
static double from_beside(double (*b)[N], bool along_first, bool turned, int d, int e)
{
    double sum = 0;
    for (int a = 0; a < N; a++)
        for (int l = 0; l < N; l++) {
            const int away = turned ? N - 1 - a : a;
            sum += corner[d][a][abs(e - l)] * (along_first ? b[l][away] : b[away][l]);
        }
    return sum;
}

static double floor_h(double (*other)[N], bool is_ceiling, int i, int j)
{
    double h = from_facing(other, i, j);
    h += from_beside(b_wall, true, is_ceiling, i, j);
    h += from_beside(b_wall, true, is_ceiling, N - 1 - i, j);
    h += from_beside(b_wall, true, is_ceiling, j, i);
    return h + from_beside(b_wall, true, is_ceiling, N - 1 - j, i);
}

// At `l` along and `z` up a wall.
static double wall_h(int l, int z)
{
    double h = from_facing(b_wall, l, z);
    h += from_beside(b_floor, true, false, z, l);
    h += from_beside(b_ceiling, true, false, N - 1 - z, l);
    // The walls at both ends: the edge is upright.
    h += from_beside(b_wall, false, false, l, z);
    return h + from_beside(b_wall, false, false, N - 1 - l, z);
}

static void cube_bins(const char *name, struct vec3 p, struct vec3 a, struct vec3 b,
                      double (*radiosity)[N], double emission)
{
    static const double off[3] = {2e-5, 2e-5, 2e-5};
    struct face f = {.p = p,
                     .a = a,
                     .b = b,
                     .nu = CELLS,
                     .nv = CELLS,
                     .matt = {{.5, .5, .5}, emission}};
    snprintf(f.name, sizeof f.name, "%s", name);
    for (int k = 0; k < CELLS * CELLS; k++) {
        double sum = 0;
        for (int i = 0; i < N / CELLS; i++)
            for (int j = 0; j < N / CELLS; j++)
                sum +=
                    radiosity[k % CELLS * (N / CELLS) + i][k / CELLS * (N / CELLS) + j];
        const double h = (sum / (N / CELLS * (N / CELLS)) - emission) / .5;
        const double rgb[3] = {h, h, h};
        print_bin(&f, k, rgb, off);
    }
}

static void cube(void)
{
    enum { SWEEPS = 18 };
    cube_factors();
    for (int k = 0; k < SWEEPS; k++) {
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++) {
                b_floor[i][j] = 1 + .5 * floor_h(b_ceiling, false, i, j);
                b_ceiling[i][j] = .5 * floor_h(b_floor, true, i, j);
                b_wall[i][j] = .5 * wall_h(i, j);
            }
    }
    const struct vec3 o = {0, 0, 0}, x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    printf("# closed form factors, %d x %d a wall\n", N, N);
    // a along the edge with the floor, a x b inwards.
    cube_bins("floor", o, x, y, b_floor, 1);
    cube_bins("ceiling", vec3_add(z, x), vec3_neg(x), y, b_ceiling, 0);
    cube_bins("wall-x", o, y, z, b_wall, 0);
    cube_bins("wall+x", vec3_add(x, y), vec3_neg(y), z, b_wall, 0);
    cube_bins("wall-y", x, vec3_neg(x), z, b_wall, 0);
    cube_bins("wall+y", y, x, z, b_wall, 0);
}

int main(int argc, char **argv)
{
    printf(
        "#face\tp\tp\tp\ta\ta\ta\tb\tb\tb\trho\trho\trho\tH\tH\tH\toff\toff\toff\tE\n");
    if (argc == 2 && strcmp(argv[1], "cube") == 0) {
        cube();
        return 0;
    }
    if (argc != 3) {
        fprintf(stderr, "usage: radiosity_truth cube | SCENE.faces PARTICLES\n");
        return 64;
    }
    read_scene(argv[1]);
    trace(atof(argv[2]));
    return 0;
}
