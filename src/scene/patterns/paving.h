#ifndef SCENE_PATTERNS_PAVING_H
#define SCENE_PATTERNS_PAVING_H

#include <stdint.h>

#include "scene/pattern.h"

// How the plane is paved with pieces of some cells (spec/textures 7), and what each cell of
// one period has around it.
enum { PAVING_CELLS = 60 }; // ten hexagons of six triangles

// Triangles: which edges are at the border of the piece, which vertices touch another piece
// while both edges there are inside, and where the border turns by 120 degrees (paving_bends).
// Edges: left, right, bottom.
enum paving_triangle {
    TRIANGLE_WALL = 1 << 0,
    TRIANGLE_POST = 1 << 3,
    TRIANGLE_BEND = 1 << 6,
};
// Squares: sides -x, x, -z, z, the corners (paving_corners) that touch another piece between
// sides inside, and one of these that faces two sides at the border, or none.
enum paving_square {
    SQUARE_WALL = 1 << 0,
    SQUARE_POST = 1 << 4,
    SQUARE_TURN = 1 << 8,
    SQUARE_TURN_CORNER = 9, // where its number starts
};

struct paving {
    int sides, tiles, pattern;
    int a, b, c; // period: (a, 0) and (b, c)
    int count;
    int8_t cell[12][3]; // column, row, piece
};

// Local vertices of a triangle: top (edges 0, 1), left (0, 2), right (1, 2).
enum vertex { TOP, LEFT, RIGHT };
static const struct {
    int8_t open, closed, vertex, centre; // edges; centre: of the arc
} paving_bends[6] = {{0, 1, TOP, LEFT},  {0, 2, LEFT, TOP},   {1, 0, TOP, RIGHT},
                     {1, 2, RIGHT, TOP}, {2, 0, LEFT, RIGHT}, {2, 1, RIGHT, LEFT}};
static const int8_t paving_corners[4][2] = {{-1, -1}, {-1, 1}, {1, -1}, {1, 1}};

// A triangle's column and row: i - j even points up.
static inline bool paving_points_up(int64_t i, int64_t j) { return ((i - j) & 1) == 0; }

// A paving and the borders of the cells of one period.
struct paving_map {
    const struct paving *paving;
    uint16_t cell[PAVING_CELLS];
};

// In the arena; NULL: there is no such pattern of these tiles.
const struct paving_map *paving_map_new(struct arena *a, int sides, int tiles,
                                        int pattern);
// Of the cell in column i and row j, both smaller than 1e15 in size.
unsigned paving_borders(const struct paving_map *m, int64_t i, int64_t j);

#endif
