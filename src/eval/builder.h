#ifndef EVAL_BUILDER_H
#define EVAL_BUILDER_H

#include "eval/eval.h"

struct pattern_defaults;
struct pattern;
struct pigment;

// Turns blocks into parts of the scene. One per evaluation.
struct builder *builder_new(struct eval *e);

// A finished object block (sphere{}, union{}, object{}, light_source{} ...): an
// AST_VALUE node holding the object, or NULL after an error.
const struct value *builder_object(struct builder *b, const struct ast *block);
// A triangle { } or smooth_triangle { } of a mesh that is being read.
struct mesh_soup;
void builder_face(struct builder *b, struct mesh_soup *mesh, const struct ast *block);
// Any other block that can stand on a right side (texture, pigment, finish,
// transform, camera, color_map ...). `items` may be several textures in a row.
const struct value *builder_block(struct builder *b, const struct ast *items);
// A statement of the scene: adds to b's scene.
bool builder_statement(struct builder *b, const struct ast *item);
bool builder_defaults(struct builder *b, const struct ast *items);
// Fills what the end of parsing decides: default camera, gamma, background.
bool builder_finish(struct builder *b);

// What patterns and noise functions ask at any time; follows the settings.
// Sets the noise generator that the language version asks for, if none was chosen.
void settings_noise(struct builder *b);
const struct pattern_defaults *builder_pattern_defaults(const struct builder *b);

// `pigment { }` and `pattern { }` of a function; NULL after an error.
const struct pigment *builder_function_pigment(struct builder *b,
                                               const struct ast *block);
const struct pattern *builder_function_pattern(struct builder *b,
                                               const struct ast *block);

bool builder_is_object_word(enum word w);
bool builder_is_block_word(enum word w);

#endif
