#ifndef TESS_PARTS_H
#define TESS_PARTS_H

#include "scene/object.h"

struct arena;

// An object as what meshes can be made of: the solids and the sheets that its unions
// bring together.
struct tess_parts {
    const struct object *solid; // with finite bounds; NULL: none
    const struct object *sheet; // for sheet_mesh; NULL: none
    const struct object *other; // the first that is neither; NULL: none
};

// An object that is wholly one of them is itself the part; parts of a union are unions.
void tess_parts_of(struct arena *a, const struct object *o, struct tess_parts *out);

#endif
