#ifndef SCENE_ARGS_H
#define SCENE_ARGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/diag.h"
#include "image/image.h"
#include "math/vec.h"

struct arena;
struct texels;
struct texture;
struct transform;

// The values written in an object's braces, read in order by its build
// function. Commas are optional between values. Implemented by eval/args.c; a
// shape only reads. Each reader reports what is missing and returns false.
struct args;

bool args_float(struct args *a, const char *role, double *out);
bool args_int(struct args *a, const char *role, long *out); // truncated
bool args_vec2(struct args *a, const char *role, struct vec2 *out);
bool args_vec3(struct args *a, const char *role, struct vec3 *out);
bool args_vec4(struct args *a, const char *role, double out[4]);
bool args_string(struct args *a, const char *role, const char **out);
// `< f, f, ... >` with exactly n numbers (cubic, quartic, poly).
bool args_floats(struct args *a, const char *role, double *out, size_t n);

// The whole block when it is `n, <...>, ...` of plain numbers; false, and nothing is read,
// when it must be read one by one.
struct args_vectors {
    uint32_t count, width;
    const double *number;  // count*width; NULL: `index` instead
    const uint32_t *index; // whole numbers
};
bool args_vectors(struct args *a, struct args_vectors *out);

// The triangles of a mesh that come next, which were read as they came; or NULL.
struct mesh_soup;
struct mesh_soup *args_faces(struct args *a);

// True when the next item can start a number (an optional argument is there).
bool args_at_number(struct args *a);
// Whether the next number item is a vector (more than one component).
bool args_at_vector(struct args *a);
// Consumes the word (keyword) if it is next: `open`, `linear_spline`.
bool args_word(struct args *a, const char *word);
// If the next item is the block `word { ... }`, consumes it and returns its
// contents as an args of their own, else NULL.
struct args *args_block(struct args *a, const char *word);
// If the next item is a call, `word (a, b)` or `word (a, b): c`, consumes it and returns
// its arguments (with c as the last) as an args of their own, else NULL.
struct args *args_call(struct args *a, const char *word);
// If the next item is texture { TEXID } or a declared texture, consumes it and returns the
// texture.
const struct texture *args_texture(struct args *a);
bool args_at_texture(struct args *a);
// The block `function { expression in x, y, z }`, which must be next; NULL after an error.
struct tape;
const struct tape *args_function(struct args *a, const char *role);
bool args_end(struct args *a); // nothing is left (or only object modifiers)

// Reports `message` at the block; the shape is then dropped. / A warning only.
void args_reject(struct args *a, const char *message);
void args_warn(struct args *a, const char *message);
// The path of a file found as #include finds it, or in the fonts and images installed
// with the include files; the extension is added when the name has none.
bool args_find_file(struct args *a, const char *role, const char *name,
                    const char *extension, const char **path);
// What follows the arguments of a part that is no object of its own (a blob component):
// transforms, composed, and its texture in the object's space, NULL if it has none.
bool args_part(struct args *a, struct transform *out, const struct texture **texture);
// An image with what stands before its modifiers: `[png] "file" [gamma g]` or
// `function W, H { }`. decode: what `gamma` asks for. NULL after an error. The texels are
// the scene's and shared (image/texels.h; texels_height for heights).
const struct texels *args_image(struct args *a, struct transfer *decode);

// Whether bicubic patches are to be the triangles that POV-Ray draws.
bool args_pov_patches(struct args *a);

struct arena *args_arena(struct args *a); // the scene's
// A place of the scene's for all shapes of this keyword, NULL at first: what they share.
void **args_shared(struct args *a);
struct diag_sink *args_diags(struct args *a);
struct span args_where(struct args *a); // of the next item, or of the block's end
const char *args_owner(struct args *a);

#endif
