// Images on surfaces: from a point to texels and their colour (spec/textures 9).
#include "scene/image_map.h"

#include <math.h>

#include "base/arena.h"
#include "math/color.h"
#include "math/pi.h"
#include "scene/pattern_math.h"

// ---- where a point falls -----------------------------------------------------
// C's fmod, by a product that is exact: of a size that has at most 31 bits.
static inline double remainder_of(double v, double size)
{
    const double a = fabs(v), times = a / size;
    if (a < size)
        return v;
    if (!(size > 0 && times < 0x1p22))
        return fmod(v, size);
    double r = a - (int)times * size;
    r = r < 0 ? r + size : r >= size ? r - size : r;
    return copysign(r, v);
}

// As fmod does, but never negative and never `size`.
static double wrap(double v, double size)
{
    v = remainder_of(v, size);
    if (v < 0)
        v += size;
    return v >= size ? 0 : v;
}

static bool spherical(struct vec3 p, double *u, double *v)
{
    const double rho = vec3_length(p);
    if (rho == 0)
        return false;
    p = vec3(p.x / rho, p.y / rho, p.z / rho);
    const double length = sqrt(p.x * p.x + p.z * p.z);
    *u = length == 0 ? 0 : azimuth(p.x, p.z) / (2 * PI);
    *v = 0.5 + quick_atan2(p.y, length) / PI;
    return true;
}

static bool toroidal(struct vec3 p, double *u, double *v)
{
    const double length = sqrt(p.x * p.x + p.z * p.z), x = length - 1;
    const double r = sqrt(x * x + p.y * p.y);
    if (length == 0 || r == 0)
        return false;
    double phi = quick_atan2(fabs(p.y), -x);
    if (p.y > 0)
        phi = 2 * PI - phi;
    *u = azimuth(p.x, p.z) / (2 * PI);
    *v = phi / (2 * PI);
    return true;
}

// To 0..w, 0..h with the row upwards; repeats not yet folded.
static bool project(const struct image_map *m, struct vec3 p, double w, double h,
                    double *u, double *v)
{
    switch (m->projection) {
    case IMAGE_SPHERICAL:
        if (!spherical(p, u, v))
            return false;
        break;
    case IMAGE_CYLINDRICAL:
        if (sqrt(p.x * p.x + p.z * p.z) == 0 || (m->once && (p.y < 0 || p.y > 1)))
            return false;
        *u = azimuth(p.x, p.z) / (2 * PI) * w;
        *v = remainder_of(p.y * h, h);
        return true;
    case IMAGE_TOROIDAL:
        if (!toroidal(p, u, v))
            return false;
        break;
    default:
        if (m->once && (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1))
            return false;
        *u = remainder_of(p.x * w, w);
        *v = remainder_of(p.y * h, h);
        return true;
    }
    *u *= w;
    *v *= h;
    return true;
}

// Column and row (0..width, 0..height from the top) that a point sees; false: outside.
static bool image_map_place(const struct image_map *m, struct vec3 p, double *column,
                            double *row)
{
    const double width = m->texels->width, height = m->texels->height;
    double u, v;
    if (!project(m, p, (float)(width * m->repeat.u), (float)(height * m->repeat.v), &u,
                 &v))
        return false;
    u += -width * m->offset.u + PATTERN_EDGE;
    v += -height * m->offset.v + PATTERN_EDGE;
    if (!isfinite(u) || !isfinite(v) ||
        (m->once && (u >= width || v >= height || u < 0 || v < 0)))
        return false;
    *column = wrap(u, width);
    *row = wrap(-v, height);
    return true;
}

// ---- one texel ---------------------------------------------------------------
static inline int inside(int i, int size, bool once)
{
    if (i >= 0 && i < size)
        return i;
    if (once)
        return i < 0 ? 0 : size - 1;
    i %= size;
    return i < 0 ? i + size : i;
}

static inline float sample(const struct image_map *m, const struct texels *t, int x,
                           int y, int k)
{
    const double raw = texels_raw(t, x, y, k);
    if (m->decoded)
        return m->decoded[(int)raw];
    return (float)transfer_encode(m->working, transfer_decode(m->decode, raw));
}

static inline struct rgbft fetch(const struct image_map *m, int x, int y, int *index)
{
    const struct texels *t = m->texels;
    x = inside(x, t->width, m->once);
    y = inside(y, t->height, m->once);
    if (t->indexed) {
        *index = texels_index(t, x, y);
        return m->palette[*index];
    }
    struct rgbft c = {.filter = m->filter_all, .transmit = m->transmit_all};
    *index = -1;
    c.r = sample(m, t, x, y, 0);
    c.g = t->channels < 3 ? c.r : sample(m, t, x, y, 1);
    c.b = t->channels < 3 ? c.r : sample(m, t, x, y, 2);
    if (t->channels == 2 || t->channels == 4)
        c.transmit += 1 - (float)texels_raw(t, x, y, t->channels - 1) / t->max;
    return c;
}

// ---- between texels ----------------------------------------------------------
struct sum {
    double c[5], index;
    bool indexed;
};

static inline void add(struct sum *s, const struct image_map *m, int x, int y,
                       double weight)
{
    int index;
    const struct rgbft c = fetch(m, x, y, &index);
    s->c[0] += weight * c.r;
    s->c[1] += weight * c.g;
    s->c[2] += weight * c.b;
    s->c[3] += weight * c.filter;
    s->c[4] += weight * c.transmit;
    s->index += weight * index;
    s->indexed = index >= 0;
}

static void add_four(struct sum *s, const struct image_map *m, int x, int y, double p,
                     double q)
{
    double w[4] = {p * q, (1 - p) * q, p * (1 - q), (1 - p) * (1 - q)};
    if (m->interpolation == IMAGE_DISTANCE) {
        const double pp = p * p, qq = q * q, rr = (1 - p) * (1 - p),
                     ss = (1 - q) * (1 - q);
        const double d[4] = {rr + ss, pp + ss, rr + qq, pp + qq};
        double total = 0;
        for (int i = 0; i < 4; i++)
            total += 1 / d[i];
        for (int i = 0; i < 4; i++) // on a texel's centre it alone counts
            w[i] = d[i] == 0 ? 1 : isfinite(total) ? 1 / d[i] / total : 0;
    }
    add(s, m, x, y, w[0]);
    add(s, m, x - 1, y, w[1]);
    add(s, m, x, y - 1, w[2]);
    add(s, m, x - 1, y - 1, w[3]);
}

static void cubic_weights(double p, double w[4])
{
    const double t = 1 - p;
    w[0] = -0.5 * p * t * t;
    w[1] = 0.5 * t * (t * (3 * p + 1) + 1);
    w[2] = 0.5 * p * (p * (3 * t + 1) + 1);
    w[3] = -0.5 * t * p * p;
}

static void add_sixteen(struct sum *s, const struct image_map *m, int x, int y, double p,
                        double q)
{
    double wx[4], wy[4];
    cubic_weights(p, wx);
    cubic_weights(q, wy);
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++)
            add(s, m, x - 2 + i, y - 2 + j, wx[i] * wy[j]);
}

// The colour there, interpolated, alpha as transmit, premultiplied as the image is. The
// index: interpolated and truncated, -1 when the image has none.
static struct rgbft image_map_texel(const struct image_map *m, double column, double row,
                                    int *index)
{
    if (m->interpolation == IMAGE_NEAREST)
        return fetch(m, (int)column, (int)row, index);
    struct sum s = {.indexed = false};
    column += 0.5;
    row += 0.5;
    const int x = (int)column, y = (int)row;
    if (m->interpolation == IMAGE_BICUBIC)
        add_sixteen(&s, m, x, y, column - x, row - y);
    else
        add_four(&s, m, x, y, column - x, row - y);
    *index = s.indexed ? (int)s.index : -1;
    return (struct rgbft){(float)s.c[0], (float)s.c[1], (float)s.c[2], (float)s.c[3],
                          (float)s.c[4]};
}

// ---- what it is used as ------------------------------------------------------
static float grey(struct rgbft c)
{
    return (float)luminance((double)c.r, (double)c.g, (double)c.b);
}

bool image_map_color(const struct image_map *m, struct vec3 p, struct rgbft *out)
{
    double column, row;
    int index;
    if (!image_map_place(m, p, &column, &row)) {
        *out = (struct rgbft){1, 1, 1, 0, 1};
        return false;
    }
    struct rgbft c = image_map_texel(m, column, row, &index);
    const float alpha = 1 - c.filter - c.transmit;
    if (m->premultiplied && alpha > (float)PATTERN_EDGE) {
        c.r /= alpha;
        c.g /= alpha;
        c.b /= alpha;
    }
    *out = c;
    return true;
}

static bool has_alpha(const struct texels *t)
{
    return t->palette_alpha || t->channels == 2 || t->channels == 4;
}

double image_map_value(const struct image_map *m, struct vec3 p)
{
    double column, row;
    int index;
    if (!image_map_place(m, p, &column, &row))
        return 0;
    const struct rgbft c = image_map_texel(m, column, row, &index);
    // Not alpha but 1 - alpha (spec/textures 9.7).
    return clamp01(!m->use_alpha ? grey(c) : has_alpha(m->texels) ? c.transmit : c.r);
}

static double bump_height(const struct image_map *m, double column, double row)
{
    const struct texels *t = m->texels;
    int index;
    column += column < 0 ? t->width : column >= t->width ? -t->width : 0;
    row += row < 0 ? t->height : row >= t->height ? -t->height : 0;
    const struct rgbft c = image_map_texel(m, column, row, &index);
    return m->use_index && index >= 0 ? (double)index : (double)grey(c);
}

struct vec3 image_map_bump(const struct image_map *m, float amount, struct vec3 n,
                           struct vec3 p)
{
    double u, v;
    if (!image_map_place(m, p, &u, &v))
        return n;
    const double a = (double)amount * bump_height(m, u, v);
    const double b = (double)amount * bump_height(m, u - 1, v + 1);
    const double c = (double)amount * bump_height(m, u + 1, v + 1);
    const struct vec3 bump =
        vec3_normalize(vec3_cross(vec3(2, c - b, 0), vec3(1, a - b, -1)));
    struct vec3 x = vec3_cross(n, vec3(0, 1, 0)), y = n;
    if (vec3_length(x) < PATTERN_EDGE) {
        x = vec3(1, 0, 0);
        y = vec3(0, n.y < 0 ? -1 : 1, 0);
    }
    x = vec3_normalize(x);
    const struct vec3 z = vec3_normalize(vec3_cross(x, y));
    return vec3_mad(vec3_mad(vec3_scale(bump.x, x), bump.y, y), -bump.z, z);
}

uint32_t image_map_entry(const struct image_map *m, struct vec3 p, uint32_t count)
{
    double column, row;
    int index = 0;
    if (image_map_place(m, p, &column, &row)) {
        const struct rgbft c = image_map_texel(m, column, row, &index);
        if (index < 0)
            index = (int)(255 * clamp01(c.r));
    }
    uint32_t i = index > 0 ? (uint32_t)index : 0;
    if (i > count) // `count` itself is let through, and then the last entry
        i %= count;
    return i < count ? i : count - 1;
}

// ---- tables ------------------------------------------------------------------
static float convert(const struct image_map *m, float v)
{
    if (m->decode.kind != TRANSFER_NONE)
        v = (float)transfer_decode(m->decode, v);
    if (m->working.kind != TRANSFER_NONE)
        v = (float)transfer_encode(m->working, v);
    return v;
}

static void prepare_palette(struct arena *a, struct image_map *m)
{
    const struct texels *t = m->texels;
    struct rgbft *p = arena_new_array(a, struct rgbft, (size_t)t->palette_count);
    for (int i = 0; i < t->palette_count; i++)
        p[i] = (struct rgbft){.r = convert(m, t->palette[i][0] / 255.0f),
                              .g = convert(m, t->palette[i][1] / 255.0f),
                              .b = convert(m, t->palette[i][2] / 255.0f),
                              .transmit = 1 - t->palette[i][3] / 255.0f};
    m->palette = p;
}

static bool texels_opaque(const struct texels *t)
{
    const int alpha = t->channels - 1;
    if (t->indexed || t->channels % 2)
        return true; // the palette is looked at elsewhere
    for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++)
            if (texels_raw(t, x, y, alpha) < (double)t->max)
                return false;
    return true;
}

void image_map_prepare(struct arena *a, struct image_map *m)
{
    const struct texels *t = m->texels;
    m->opaque = !m->once && texels_opaque(t);
    if (t->indexed) {
        prepare_palette(a, m);
    } else if (t->format != TEXEL_F32) {
        const int count = t->format == TEXEL_U8 ? 256 : 65536;
        float *table = arena_new_array(a, float, (size_t)count);
        for (int i = 0; i < count; i++) {
            table[i] = convert(m, (float)i / t->max);
            if (texels_grey_is_coarse(t))
                table[i] = texels_coarse_grey(table[i]);
        }
        m->decoded = table;
    }
}
