// Pavements: whatever cell one starts from, as many cells as a piece has are reached without
// crossing a wall, and walls are walls from both sides.

#include "test.h"

#include "base/arena.h"
#include "scene/patterns/paving.h"

enum { CELLS_MOST = 64 };

struct cell {
    int64_t i, j;
};

// The neighbour across an edge, and the number that the edge has there.
static struct cell across(const struct paving_map *g, struct cell c, int edge, int *back)
{
    if (g->paving->sides == 4) {
        *back = edge ^ 1;
        const int step = edge % 2 ? 1 : -1;
        return edge < 2 ? (struct cell){c.i + step, c.j} : (struct cell){c.i, c.j + step};
    }
    *back = edge;
    const int turn = paving_points_up(c.i, c.j) ? 1 : -1;
    return edge == 2 ? (struct cell){c.i, c.j - turn}
                     : (struct cell){c.i + (edge == 0 ? -turn : turn), c.j};
}

static bool wall(const struct paving_map *g, struct cell c, int edge)
{
    const unsigned first =
        g->paving->sides == 4 ? (unsigned)SQUARE_WALL : (unsigned)TRIANGLE_WALL;
    return paving_borders(g, c.i, c.j) & first << edge;
}

static int cells_reached(const struct paving_map *g, struct cell from)
{
    const int edges = g->paving->sides == 4 ? 4 : 3;
    struct cell seen[CELLS_MOST] = {from};
    int n = 1;
    for (int k = 0; k < n; k++)
        for (int e = 0; e < edges; e++) {
            int back, s = 0;
            const struct cell next = across(g, seen[k], e, &back);
            assert_int_equal(wall(g, seen[k], e), wall(g, next, back));
            if (wall(g, seen[k], e))
                continue;
            while (s < n && (seen[s].i != next.i || seen[s].j != next.j))
                s++;
            if (s < n)
                continue;
            assert_true(n < CELLS_MOST);
            seen[n++] = next;
        }
    return n;
}

static void pieces_are_whole(void **state)
{
    (void)state;
    static const int64_t far[] = {0, 1000003, -1000003, 99999999999989, -99999999999989};
    struct arena *a = arena_new(1 << 14);
    const struct paving_map *g;
    int count = 0;
    for (int sides = 3; sides <= 6; sides++)
        for (int tiles = 1; sides != 5 && tiles <= (sides == 6 ? 5 : 6); tiles++)
            for (int pattern = 1; (g = paving_map_new(a, sides, tiles, pattern));
                 pattern++) {
                count++;
                for (int k = 0; k < 5; k++)
                    for (int i = -7; i <= 7; i++)
                        for (int j = -7; j <= 7; j++) {
                            const struct cell c = {far[k] + i, far[k * k % 5] + j};
                            assert_int_equal(cells_reached(g, c),
                                             sides == 6 ? 6 * tiles : tiles);
                        }
            }
    assert_int_equal(count, 112);
    assert_null(paving_map_new(a, 4, 7, 1));
    assert_null(paving_map_new(a, 5, 1, 1));
    assert_null(paving_map_new(a, 3, 1, 0));
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pieces_are_whole)};
    return cmocka_run_group_tests_name("pavings", tests, NULL, NULL);
}
