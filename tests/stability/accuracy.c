// The parts of povray.sh, which prints the tables of doc/accuracy.md: `scene` prints a
// scene that makes POV-Ray trace the rays, `table` reads what it answered, `picture` prints
// a scene of the picture tests and `pixels` counts in what was rendered.
#include "test.h"

#include <stdlib.h>

#include "cases.h"
#include "loaded.h"
#include "scenes.h"

enum { CASES = sizeof cases / sizeof cases[0], VARIANTS = 4 };

struct variant {
    double scale, move;
    unsigned without;
};
static const struct variant variants[VARIANTS] = {
    {1, 0, 0}, {1e-5, 0, FIXED}, {1e5, 0, FIXED}, {1, 1e6, FIXED | STILL}};

struct answer {
    bool given;
    double t; // INFINITY: a miss
    struct vec3 n;
};

static struct vec3 origin_of(const struct ray_case *c, const struct variant *v)
{
    return vec3_add(vec3_scale(v->scale, c->o), vec3(v->move, v->move, v->move));
}

static void print_scene(void)
{
    puts("#version 3.7;\nglobal_settings { assumed_gamma 1 }\n"
         "#macro Shoot(Name, Thing, O, D)\n"
         "  #local N = <0, 0, 0>;\n  #local H = trace(Thing, O, D, N);\n"
         "  #debug concat(\"answer \", Name, \" \",\n"
         "    #if (vlength(N) = 0) \"-1 0 0 0\" #else concat(str(vlength(H - O), 0, 17), "
         "\" \",\n"
         "    vstr(3, N, \" \", 0, 9)) #end, \"\\n\")\n#end");
    for (int i = 0; i < CASES; i++)
        for (int k = 0; k < VARIANTS; k++) {
            const struct variant *v = &variants[k];
            if (cases[i].flags & v->without)
                continue;
            const struct vec3 o = origin_of(&cases[i], v), d = vec3_normalize(cases[i].d);
            printf("#declare Thing = %s\n", cases[i].object);
            printf("#declare Thing = object { Thing scale %.17g translate %.17g }\n",
                   v->scale, v->move);
            printf(
                "Shoot(\"%d %d\", Thing, <%.17g, %.17g, %.17g>, <%.17g, %.17g, %.17g>)\n",
                i, k, o.x, o.y, o.z, d.x, d.y, d.z);
        }
}

static bool read_answers(const char *path, struct answer a[CASES][VARIANTS])
{
    FILE *in = fopen(path, "r");
    char line[512];
    if (!in)
        return false;
    while (fgets(line, sizeof line, in)) {
        int i, k;
        double t;
        struct vec3 n;
        if (sscanf(line, "answer %d %d %lf %lf %lf %lf", &i, &k, &t, &n.x, &n.y, &n.z) ==
                6 &&
            i >= 0 && i < CASES && k >= 0 && k < VARIANTS)
            a[i][k] = (struct answer){true, t < 0 ? INFINITY : t, n};
    }
    fclose(in);
    return true;
}

static struct answer ask_lambert(const struct ray_case *c, const struct variant *v)
{
    struct loaded l;
    struct interaction at = {.p = {0, 0, 0}};
    load(&l, "#declare Thing = %s\nobject { Thing scale %.17g translate %.17g }\n",
         c->object, v->scale, v->move);
    const struct hit h = shoot(&l, origin_of(c, v), c->d, &at);
    unload(&l);
    return (struct answer){true, h.b.t, at.ng};
}

// To 1e-6, which forgives most roundings; lambert is held to far less by the tests.
static bool holds(const struct ray_case *c, const struct variant *v,
                  const struct answer *a)
{
    const double want = c->t;
    if (want == MISS)
        return !isfinite(a->t);
    if (!(fabs(a->t / v->scale - want) <= 1e-6 * fmax(1, want)))
        return false;
    return vec3_dot(c->n, c->n) == 0 || vec3_length(vec3_sub(a->n, c->n)) < 1e-3;
}

static void print_answer(const struct ray_case *c, const struct variant *v,
                         const struct answer *a)
{
    if (!a->given)
        fputs(" | -", stdout);
    else if (!isfinite(a->t))
        printf(" | %smiss", holds(c, v, a) ? "" : "**");
    else
        printf(" | %s%.12g", holds(c, v, a) ? "" : "**", a->t);
    if (a->given && !holds(c, v, a)) {
        if (isfinite(a->t) && fabs(a->t / v->scale - c->t) <= 1e-6 * fmax(1, c->t))
            fputs(", wrong normal", stdout);
        fputs("**", stdout);
    }
}

static int print_table(const char *path)
{
    static struct answer pov[CASES][VARIANTS];
    if (!read_answers(path, pov)) {
        fprintf(stderr, "cannot read %s\n", path);
        return 1;
    }
    int held[2] = {0, 0}, count = 0;
    puts("| Case | Truth | lambert | POV-Ray 3.7 | POV-Ray at 1e-5 | at 1e5 | moved 1e6 "
         "|\n"
         "|---|---|---|---|---|---|---|");
    for (int i = 0; i < CASES; i++) {
        struct ray_case c = cases[i];
        if (c.tolerance == -1)
            c.t = torus_crest(&c);
        printf("| %s", c.name);
        if (c.t == MISS)
            printf(" | miss");
        else
            printf(" | %.12g", c.t);
        const struct answer ours = ask_lambert(&c, &variants[0]);
        print_answer(&c, &variants[0], &ours);
        for (int k = 0; k < VARIANTS; k++) {
            const bool asked = !(c.flags & variants[k].without);
            if (k == 0)
                print_answer(&c, &variants[0], &pov[i][0]);
            else
                printf(" | %s", !asked                                ? ""
                                : !pov[i][k].given                    ? "-"
                                : holds(&c, &variants[k], &pov[i][k]) ? "holds"
                                                                      : "**fails**");
            if (!asked)
                continue;
            const struct answer own = ask_lambert(&c, &variants[k]);
            held[0] += holds(&c, &variants[k], &own);
            held[1] += pov[i][k].given && holds(&c, &variants[k], &pov[i][k]);
            count++;
        }
        puts(" |");
    }
    printf("\nOf %d rays %d hold in lambert and %d in POV-Ray.\n", count, held[0],
           held[1]);
    return 0;
}

static int print_failure(const char *name)
{
    for (size_t i = 0; i < sizeof failures / sizeof failures[0]; i++)
        if (strcmp(name, failures[i].name) == 0) {
            fputs(failures[i].scene, stdout);
            return 0;
        }
    fprintf(stderr, "no picture is called %s\n", name);
    return 1;
}

static int print_picture_scene(const char *name, double size, double place)
{
    if (strcmp(name, "still-life") == 0 || strcmp(name, "sheet") == 0 ||
        strcmp(name, "glass") == 0)
        puts("#version 3.7; global_settings { assumed_gamma 1 }");
    if (strcmp(name, "still-life") == 0)
        printf(still_life, size, place);
    else if (strcmp(name, "sheet") == 0)
        fputs(rising_sheet, stdout);
    else if (strcmp(name, "glass") == 0)
        printf(close_glass, size);
    else
        return print_failure(name);
    return 0;
}

static struct image read_picture(const char *path)
{
    char error[256];
    struct image im;
    if (!image_read(&im, path, (struct transfer){TRANSFER_NONE, 1}, error,
                    sizeof error)) {
        fprintf(stderr, "%s: %s\n", path, error);
        exit(1);
    }
    return im;
}

// How many pixels of a differ from b by more than 1 of 255; without b, how many are black.
static int count_pixels(const char *path, const char *other)
{
    struct image a = read_picture(path), b = other ? read_picture(other) : a;
    int n = 0;
    for (int i = 0; i < a.width * a.height; i++) {
        float most = 0;
        for (int k = 0; k < 3; k++) {
            const float v = a.pixel[i * a.channels + k];
            most = fmaxf(most, other ? fabsf(v - b.pixel[i * b.channels + k]) : v);
        }
        n += other ? most > 1.5f / 255 : most < .5f / 255;
    }
    printf("%d\n", n);
    return 0;
}

enum { GAP = 4 };

// Pictures side by side in two rows, each pixel as two by two.
static int write_sheet(const char *path, char **picture, int count)
{
    const int columns = (count + 1) / 2, step = 2 * PICTURE_SIZE + GAP;
    struct image out;
    char error[256];
    if (!image_init(&out, columns * step - GAP, 2 * step - GAP, 3))
        return 1;
    for (int i = 0; i < out.width * out.height * 3; i++)
        out.pixel[i] = 1;
    for (int p = 0; p < count; p++) {
        const struct image im = read_picture(picture[p]);
        for (int y = 0; y < 2 * PICTURE_SIZE; y++)
            for (int x = 0; x < 2 * PICTURE_SIZE; x++)
                memcpy(image_at(&out, x + p % columns * step, y + p / columns * step),
                       image_at(&im, x / 2, y / 2), 3 * sizeof(float));
    }
    const struct image_write_options o = {.bits = 8, .transfer = {TRANSFER_NONE, 1}};
    if (image_write(&out, path, &o, error, sizeof error))
        return 0;
    fprintf(stderr, "%s: %s\n", path, error);
    return 1;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "scene") == 0) {
        print_scene();
        return 0;
    }
    if (argc == 3 && strcmp(argv[1], "table") == 0)
        return print_table(argv[2]);
    if (argc == 5 && strcmp(argv[1], "picture") == 0)
        return print_picture_scene(argv[2], atof(argv[3]), atof(argv[4]));
    if ((argc == 3 || argc == 4) && strcmp(argv[1], "pixels") == 0)
        return count_pixels(argv[2], argc == 4 ? argv[3] : NULL);
    if (argc > 3 && strcmp(argv[1], "sheet") == 0)
        return write_sheet(argv[2], argv + 3, argc - 3);
    fputs("usage: accuracy scene | table ANSWERS | picture NAME SIZE PLACE |\n"
          "       pixels PICTURE [OTHER] | sheet OUT PICTURES...\n",
          stderr);
    return 2;
}
