// Objects as scene text: what --dump-csg shows. Parsing the text gives the same dump.
#include "scene/light.h"
#include "scene/object.h"

static void indent_by(FILE *out, int indent) { fprintf(out, "%*s", 2 * indent, ""); }

static void print_matrix(FILE *out, const struct transform *t, int indent)
{
    if (t->identity)
        return;
    indent_by(out, indent);
    fputs("matrix <", out);
    for (int i = 0; i < 9; i++) {
        shape_print_number(out, t->linear.m[i / 3][i % 3]);
        fputs(", ", out);
    }
    shape_print_number(out, t->offset.x);
    fputs(", ", out);
    shape_print_number(out, t->offset.y);
    fputs(", ", out);
    shape_print_number(out, t->offset.z);
    fputs(">\n", out);
}

static void print_list(const char *word, const struct object *const *list, uint32_t count,
                       FILE *out, int indent)
{
    if (!count)
        return;
    indent_by(out, indent);
    fprintf(out, "%s {\n", word);
    for (uint32_t i = 0; i < count; i++)
        object_print(list[i], out, indent + 1);
    indent_by(out, indent);
    fputs("}\n", out);
}

static bool has_modifiers(const struct object *o)
{
    return !o->transform->identity || o->clip_count || o->bound_count || o->flags;
}

// The order matters to the reader: `inverse` and the transform belong to the object,
// clips and bounds are written in the space outside.
static void print_modifiers(const struct object *o, FILE *out, int indent)
{
    static const struct {
        unsigned flag;
        const char *text;
    } rows[] = {
        {OBJECT_INVERSE, "inverse"},
        {OBJECT_HOLLOW, "hollow"},
        {OBJECT_NO_SHADOW, "no_shadow"},
        {OBJECT_NO_IMAGE, "no_image"},
        {OBJECT_NO_REFLECTION, "no_reflection"},
        {OBJECT_NO_RADIOSITY, "no_radiosity"},
        {OBJECT_DOUBLE_ILLUMINATE, "double_illuminate"},
        {OBJECT_CUTAWAY, "cutaway_textures"},
        {OBJECT_UV_MAPPING, "uv_mapping"},
        {OBJECT_NO_SPLIT, "split_union off"},
        {OBJECT_STURM, "sturm"},
    };
    print_matrix(out, o->transform, indent);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (o->flags & rows[i].flag) {
            indent_by(out, indent);
            fprintf(out, "%s\n", rows[i].text);
        }
    print_list("clipped_by", o->clip, o->clip_count, out, indent);
    print_list("bounded_by", o->bound, o->bound_count, out, indent);
}

static void print_light(const struct light *l, FILE *out, int indent)
{
    indent_by(out, indent);
    fputs("light_source { ", out);
    shape_print_vec3(out, l->location);
    fprintf(out, ", rgb <%.9g, %.9g, %.9g>%s%s }\n", (double)l->color.r,
            (double)l->color.g, (double)l->color.b, l->shadowless ? " shadowless" : "",
            l->parallel ? " parallel" : "");
}

void object_print(const struct object *o, FILE *out, int indent)
{
    static const char *const op[] = {"union", "merge", "intersection", "difference"};
    if (o->kind == OBJECT_LIGHT) {
        print_light(o->light, out, indent);
        return;
    }
    indent_by(out, indent);
    if (o->kind == OBJECT_SHAPE) {
        o->ops->print(o->shape, out);
        if (!has_modifiers(o)) {
            fputs(" }\n", out);
            return;
        }
        fputc('\n', out);
    } else {
        fprintf(out, "%s {\n", op[o->op]);
        for (uint32_t i = 0; i < o->child_count; i++)
            object_print(o->child[i], out, indent + 1);
    }
    print_modifiers(o, out, indent + 1);
    indent_by(out, indent);
    fputs("}\n", out);
}
