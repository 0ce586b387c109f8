// Curved elements and those that exist in part, as points with shares of the area, and
// as small polygons. Both are kept for the elements used last.
#include "radiosity/factor_nodes.h"

#include "base/memory.h"
#include "radiosity/polygon.h"
#include "radiosity/sequence.h"

enum { SETS = 1024, TRIES = 16 * NODES_MOST };

struct node_cache {
    struct element_nodes nodes[SETS];
    struct element_pieces pieces[SETS];
};

struct node_cache *node_cache_new(void)
{
    struct node_cache *c = must_calloc(1, sizeof *c);
    for (uint32_t i = 0; i < SETS; i++)
        c->nodes[i].element = c->pieces[i].element = ELEMENT_NONE;
    return c;
}

static struct node_cache *cache_of(struct factor_state *s)
{
    if (!s->nodes)
        s->nodes = node_cache_new();
    return s->nodes;
}

// Whole: Gauss points; what exists in part has points drawn from what exists.
static void nodes_find(struct factor_state *s, struct element_nodes *n)
{
    const struct element *e = &s->enclosure->element[n->element];
    const int k = s->settings->points < NODES_SIDE ? s->settings->points : NODES_SIDE;
    const struct gauss *g = gauss_rule(k);
    double sum = 0;
    n->count = 0;
    for (int i = 0; i < k * k && !e->partial; i++) {
        const double u = g->at[i / k], v = g->at[i % k];
        if (!element_at(s, n->element, u, v, &n->at[n->count]))
            continue;
        double jacobian;
        polygon_point(e, u, v, &jacobian);
        n->weight[n->count] = jacobian * g->weight[i / k] * g->weight[i % k];
        sum += n->weight[n->count++];
    }
    for (uint32_t i = 0; i < TRIES && n->count < NODES_MOST && sum <= 0; i++) {
        double x[4];
        sobol_point(i, n->element, x);
        if (!element_at(s, n->element, x[0], x[1], &n->at[n->count]))
            continue;
        n->weight[n->count++] = 1;
    }
    if (sum <= 0)
        sum = n->count;
    for (uint32_t i = 0; i < n->count; i++)
        n->weight[i] *= e->area / sum;
}

const struct element_nodes *nodes_of(struct factor_state *s, uint32_t element)
{
    struct element_nodes *n = &cache_of(s)->nodes[element % SETS];
    if (n->element != element) {
        n->element = element;
        nodes_find(s, n);
    }
    return n;
}

static bool surface_at(struct factor_state *s, uint32_t element, double u, double v,
                       struct vec3 *p)
{
    const struct enclosure *e = s->enclosure;
    if (e->surface)
        return e->surface(s->of_enclosure, element, u, v, p);
    *p = polygon_point(&e->element[element], u, v, NULL);
    return true;
}

static void pieces_find(struct factor_state *s, struct element_pieces *p)
{
    const struct element *e = &s->enclosure->element[p->element];
    struct vec3 grid[PIECE_SIDE + 1][PIECE_SIDE + 1];
    bool there[PIECE_SIDE + 1][PIECE_SIDE + 1];
    double area = 0;
    for (int i = 0; i <= PIECE_SIDE; i++)
        for (int j = 0; j <= PIECE_SIDE; j++)
            there[i][j] = surface_at(s, p->element, (double)i / PIECE_SIDE,
                                     (double)j / PIECE_SIDE, &grid[i][j]);
    p->count = 0;
    for (int k = 0; k < PIECE_SIDE * PIECE_SIDE; k++) {
        const int i = k / PIECE_SIDE, j = k % PIECE_SIDE;
        struct element_point middle;
        struct element piece = {.corner_count = 4};
        if (!there[i][j] || !there[i + 1][j] || !there[i + 1][j + 1] ||
            !there[i][j + 1] ||
            !element_at(s, p->element, (i + .5) / PIECE_SIDE, (j + .5) / PIECE_SIDE,
                        &middle))
            continue;
        piece.corner[0] = grid[i][j];
        piece.corner[1] = grid[i + 1][j];
        piece.corner[2] = grid[i + 1][j + 1];
        piece.corner[3] = grid[i][j + 1];
        element_finish(&piece);
        area += piece.area;
        const bool turned = vec3_dot(piece.normal, middle.normal) < 0;
        for (int c = 0; c < 4; c++)
            p->corner[p->count][c] = piece.corner[turned ? 3 - c : c];
        p->normal[p->count++] = turned ? vec3_neg(piece.normal) : piece.normal;
    }
    p->scale = area > 0 ? e->area / area : 0;
    if (!p->count) {
        p->count = 1;
        p->scale = (double)e->coverage;
        p->normal[0] = e->normal;
        for (uint32_t c = 0; c < 4; c++)
            p->corner[0][c] = e->corner[c < e->corner_count ? c : 0];
    }
}

const struct element_pieces *pieces_of(struct factor_state *s, uint32_t element)
{
    struct element_pieces *p = &cache_of(s)->pieces[element % SETS];
    if (p->element != element) {
        p->element = element;
        pieces_find(s, p);
    }
    return p;
}

double nodes_factor(struct factor_state *s, uint32_t a, uint32_t b)
{
    const struct element_nodes *x = nodes_of(s, a);
    // Both may share a place in the cache.
    struct element_nodes own;
    if (a % SETS == b % SETS && a != b) {
        own = *x;
        x = &own;
    }
    const struct element_nodes *y = nodes_of(s, b);
    double sum = 0;
    for (uint32_t i = 0; i < x->count; i++)
        for (uint32_t j = 0; j < y->count; j++)
            sum += x->weight[i] * y->weight[j] * point_kernel(&x->at[i], &y->at[j]);
    return sum / s->enclosure->element[a].area;
}

double factor_self(struct factor_state *s, uint32_t element)
{
    const struct element *e = &s->enclosure->element[element];
    if (!e->curved || !(e->area > 0))
        return 0;
    // The kernel of two points of a smooth surface is bounded: squared curvature / 4 pi
    // on a sphere. A point and itself have none: their share goes to the others.
    const struct element_nodes *n = nodes_of(s, element);
    double sum = 0, weight = 0;
    for (uint32_t i = 0; i < n->count; i++) {
        for (uint32_t j = 0; j < n->count; j++) {
            if (i == j)
                continue;
            const double w = n->weight[i] * n->weight[j];
            sum += w * point_kernel(&n->at[i], &n->at[j]);
            weight += w;
        }
    }
    return weight > 0 ? sum / weight * e->area : 0;
}
