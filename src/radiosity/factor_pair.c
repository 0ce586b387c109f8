// Form factors of two elements with nothing between.
#include "math/pi.h"
#include "radiosity/factor_nodes.h"
#include "radiosity/polygon.h"

bool element_at(const struct factor_state *s, uint32_t element, double u, double v,
                struct element_point *out)
{
    const struct enclosure *e = s->enclosure;
    if (e->point)
        return e->point(s->of_enclosure, element, u, v, out);
    out->p = polygon_uniform(&e->element[element], u, v);
    out->normal = e->element[element].normal;
    out->error = 0;
    return true;
}

bool pair_is_dark(const struct element *a, const struct element *b)
{
    // Relative to the size of both; below it a height is rounding.
    static const double flat = 1e-9;
    const struct vec3 between = vec3_sub(b->centre, a->centre);
    const double size = vec3_length(between);
    bool a_sees = a->curved, b_sees = b->curved;
    for (uint32_t i = 0; i < b->corner_count && !a_sees; i++)
        a_sees = vec3_dot(vec3_sub(b->corner[i], a->centre), a->normal) > flat * size;
    for (uint32_t i = 0; i < a->corner_count && !b_sees; i++)
        b_sees = vec3_dot(vec3_sub(a->corner[i], b->centre), b->normal) > flat * size;
    return !a_sees || !b_sees;
}

// A quadrature node at (u, v). Curved elements have their nodes on the surface.
static bool node_at(const struct factor_state *s, uint32_t element, double u, double v,
                    struct element_point *out, double *jacobian)
{
    const struct element *e = &s->enclosure->element[element];
    out->p = polygon_point(e, u, v, jacobian);
    out->normal = e->normal;
    out->error = 0;
    if (!s->enclosure->point || (!e->curved && !e->partial))
        return true;
    return element_at(s, element, u, v, out);
}

// Part of an element's parameter square.
struct panel {
    double u, v, side;
};

// What is seen from there: the polygon of an element that is flat and whole, else pieces.
struct target {
    const struct vec3 (*corner)[4];
    uint32_t count, corners;
    double scale;
};

static double target_factor(const struct target *t, const struct element_point *from)
{
    double sum = 0;
    for (uint32_t i = 0; i < t->count; i++)
        sum += lambert_polygon(from->p, from->normal, t->corner[i], t->corners);
    return sum * t->scale;
}

// Sums over the panel: of area, and of area times the factor of the points.
struct panel_sum {
    double area, factor;
};

static struct panel_sum panel_integral(const struct factor_state *s, uint32_t from,
                                       const struct target *to, struct panel at, int k)
{
    const struct gauss *g = gauss_rule(k);
    struct panel_sum sum = {0, 0};
    for (int i = 0; i < k; i++) {
        for (int j = 0; j < k; j++) {
            struct element_point node;
            double jacobian;
            if (!node_at(s, from, at.u + at.side * g->at[i], at.v + at.side * g->at[j],
                         &node, &jacobian))
                continue;
            const double w = g->weight[i] * g->weight[j] * jacobian * at.side * at.side;
            sum.area += w;
            sum.factor += w * target_factor(to, &node);
        }
    }
    return sum;
}

// Quarters the panel until that changes less than `allowed`.
static struct panel_sum panel_refine(const struct factor_state *s, uint32_t from,
                                     const struct target *to, struct panel at,
                                     struct panel_sum whole, double allowed, int depth)
{
    const int k = s->settings->points + 1;
    struct panel_sum quarter[4], sum = {0, 0};
    struct panel part[4];
    for (int i = 0; i < 4; i++) {
        const double half = at.side / 2;
        part[i] = (struct panel){at.u + (i & 1) * half, at.v + (i >> 1) * half, half};
        quarter[i] = panel_integral(s, from, to, part[i], k);
        sum.area += quarter[i].area;
        sum.factor += quarter[i].factor;
    }
    if (depth == 0 || fabs(sum.factor - whole.factor) <= allowed)
        return sum;
    sum = (struct panel_sum){0, 0};
    for (int i = 0; i < 4; i++) {
        const struct panel_sum q =
            panel_refine(s, from, to, part[i], quarter[i], allowed / 2, depth - 1);
        sum.area += q.area;
        sum.factor += q.factor;
    }
    return sum;
}

// From points of an element to a target about `distance` away.
static double points_factor(struct factor_state *s, uint32_t from,
                            const struct target *to, double distance)
{
    const struct panel all = {0, 0, 1};
    const bool near = distance < 3 * polygon_radius(&s->enclosure->element[from]);
    const int k = s->settings->points;
    struct panel_sum sum = panel_integral(s, from, to, all, near ? k + 1 : k);
    if (near && sum.area > 0) {
        const double allowed = s->settings->tolerance * fmax(sum.factor, 1e-3 * sum.area);
        sum = panel_refine(s, from, to, all, sum, allowed, s->settings->depth);
    }
    return sum.area > 0 ? sum.factor / sum.area : 0;
}

// From what exists of an element in part: its pieces stand for it, so that no ray is
// needed to know its points.
static double parts_factor(struct factor_state *s, uint32_t from, const struct target *to)
{
    enum { K = 2 }; // 8 x 8 points in all
    const struct gauss *g = gauss_rule(K);
    const struct element_pieces *p = pieces_of(s, from);
    struct panel_sum sum = {0, 0};
    for (uint32_t i = 0; i < p->count; i++) {
        struct element piece = {.corner_count = 4};
        for (int c = 0; c < 4; c++)
            piece.corner[c] = p->corner[i][c];
        for (int k = 0; k < K * K; k++) {
            double jacobian;
            const struct element_point at = {
                polygon_point(&piece, g->at[k / K], g->at[k % K], &jacobian),
                p->normal[i], 0};
            const double w = g->weight[k / K] * g->weight[k % K] * jacobian;
            sum.area += w;
            sum.factor += w * target_factor(to, &at);
        }
    }
    return sum.area > 0 ? sum.factor / sum.area : 0;
}

static bool is_plain(const struct element *e) { return !e->curved && !e->partial; }

static double polygon_factor(struct factor_state *s, uint32_t from, uint32_t to,
                             double distance)
{
    const struct element *e = &s->enclosure->element[to];
    const struct target t = {&e->corner, 1, e->corner_count, (double)e->coverage};
    if (s->enclosure->element[from].partial)
        return parts_factor(s, from, &t);
    return points_factor(s, from, &t, distance - polygon_radius(e));
}

static double pieces_factor(struct factor_state *s, uint32_t from, uint32_t to,
                            double distance)
{
    const struct element *e = &s->enclosure->element[to];
    const struct element_pieces *p = pieces_of(s, to);
    const struct target t = {(const struct vec3(*)[4])p->corner, p->count, 4, p->scale};
    if (s->enclosure->element[from].partial) {
        // Both may share a place in the cache.
        const struct element_pieces own = *p;
        const struct target copy = {own.corner, own.count, 4, own.scale};
        return parts_factor(s, from, &copy);
    }
    return points_factor(s, from, &t, distance - polygon_radius(e));
}

double factor_analytic(struct factor_state *s, uint32_t small, uint32_t big)
{
    // The polygon formula is exact for what is flat and whole. Of two others, points of
    // both will do where they are apart by more than their sizes, and on one smooth
    // surface, where the kernel is bounded.
    static const double apart = 1;
    const struct element *a = &s->enclosure->element[small];
    const struct element *b = &s->enclosure->element[big];
    const double distance = vec3_length(vec3_sub(b->centre, a->centre));
    if (is_plain(b))
        return polygon_factor(s, small, big, distance);
    const double ra = polygon_radius(a), rb = polygon_radius(b);
    const bool smooth = a->curved && b->curved && a->surface == b->surface;
    if (smooth || distance > ra + rb + 2 * apart * fmax(ra, rb))
        return is_plain(a) ? polygon_factor(s, big, small, distance) * b->area / a->area
                           : nodes_factor(s, small, big);
    if (is_plain(a) && 4 * ra > rb)
        return polygon_factor(s, big, small, distance) * b->area / a->area;
    return pieces_factor(s, small, big, distance);
}

double factor_from_point(struct factor_state *s, const struct element_point *from,
                         uint32_t to)
{
    const struct element *e = &s->enclosure->element[to];
    if (is_plain(e)) {
        const struct target t = {&e->corner, 1, e->corner_count, (double)e->coverage};
        return target_factor(&t, from);
    }
    const struct element_pieces *p = pieces_of(s, to);
    const struct target t = {(const struct vec3(*)[4])p->corner, p->count, 4, p->scale};
    return target_factor(&t, from);
}

double point_kernel(const struct element_point *a, const struct element_point *b)
{
    const struct vec3 d = vec3_sub(b->p, a->p);
    const double ca = vec3_dot(d, a->normal), cb = -vec3_dot(d, b->normal);
    const double r2 = vec3_dot(d, d);
    return ca > 0 && cb > 0 ? ca * cb / (PI * r2 * r2) : 0;
}

double factor_area(struct factor_state *s, uint32_t small, uint32_t big)
{
    const int k = s->settings->points;
    const struct gauss *g = gauss_rule(k);
    struct element_point to[GAUSS_MAX * GAUSS_MAX], from;
    double weight[GAUSS_MAX * GAUSS_MAX], jacobian, area = 0, sum = 0;
    uint32_t count = 0;
    for (int i = 0; i < k * k; i++) {
        if (!node_at(s, big, g->at[i / k], g->at[i % k], &to[count], &jacobian))
            continue;
        weight[count++] = g->weight[i / k] * g->weight[i % k] * jacobian;
    }
    for (int i = 0; i < k * k; i++) {
        if (!node_at(s, small, g->at[i / k], g->at[i % k], &from, &jacobian))
            continue;
        const double w = g->weight[i / k] * g->weight[i % k] * jacobian;
        area += w;
        for (uint32_t j = 0; j < count; j++)
            sum += w * weight[j] * point_kernel(&from, &to[j]);
    }
    return area > 0 ? sum / area : 0;
}

double factor_disc(struct factor_state *s, uint32_t small, uint32_t big)
{
    // Wallace, Elmquist, Haines 1989: A cos cos / (pi r^2 + A), between the centres.
    const struct element *a = &s->enclosure->element[small];
    const struct element *b = &s->enclosure->element[big];
    const struct vec3 d = vec3_sub(b->centre, a->centre);
    const double ca = vec3_dot(d, a->normal), cb = -vec3_dot(d, b->normal);
    const double r2 = vec3_dot(d, d);
    return ca > 0 && cb > 0 ? b->area * ca * cb / (r2 * (PI * r2 + b->area)) : 0;
}
