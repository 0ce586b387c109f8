#ifndef LANG_TOKEN_H
#define LANG_TOKEN_H

#include <stddef.h>
#include <stdint.h>

#include "base/source.h"

struct bulk;
struct value;

// Three numbers written out, as one token.
struct lexed_vector {
    double v[3];
    uint32_t len; // bytes of its text
};

enum { LITERAL_NAMES_MAX = 4 };

// A block that is written out but for names of blocks and objects (lang/literal.h).
struct named_literal {
    uint32_t len;    // bytes of its text
    uint32_t tokens; // that it stands for
    uint32_t count;  // of names
    struct {
        uint32_t begin, len; // in the file
    } name[LITERAL_NAMES_MAX];
    struct lexeme *piece; // its tokens and their calc_place.slots, once they were needed
    uint32_t *slots;
};

// One token of a file as it is kept, made once by the lexer: scenes that programs write have
// tens of millions. lang/lexeme.h tells what is not here.
struct lexeme {
    uint16_t kind; // a TOK_* of grammar/parser.y, or a character
    uint16_t word; // a reserved word; of a TOK_NUMBER: bytes of its text
    uint32_t begin;
    union {
        double number;
        const struct lexed_vector *vector; // TOK_VECTOR3: `<1, 2, 3>` of plain numbers
        const struct bulk *bulk;           // TOK_BULK: the contents of a block of mesh2
        struct named_literal *named;       // TOK_NAMED
        struct {
            uint32_t len;    // of all others: bytes of the text
            uint32_t tokens; // of a TOK_LITERAL: how many it stands for
        };
    };
};

// The same while it is looked at. `word` is the index of a reserved
// word in keywords.def (enum word), or WORD_NONE for an ordinary name.
struct token {
    int kind;
    struct span where;
    uint16_t word;
    uint16_t len;
    const char *text; // points into the source; not terminated
    union {
        double number;
        const double *vector;
        const struct bulk *bulk;
        struct named_literal *named;
    };
    const struct value *value; // a declared name, when read by the stream: its value
};

// Reserved words, in the order of keywords.def: WORD_sphere, WORD_rotate, ...
enum word {
    WORD_NONE,
#define WORD(name, class) WORD_##name,
#include "lang/keywords.def"
#undef WORD
    WORD_COUNT
};

// The class column of keywords.def.
enum word_class {
    CLASS_NONE,
    CLASS_CAMERA,
    CLASS_COLOUR_WORDS,
    CLASS_DIRECTIVE_HELPERS,
    CLASS_DIRECTIVE_WORDS,
    CLASS_FINISH,
    CLASS_FLOAT_CONSTANTS_AND_VARIABLES,
    CLASS_FLOAT_FUNCTIONS,
    CLASS_FOG__RAINBOW,
    CLASS_GLOBAL_SETTINGS,
    CLASS_IMAGE_FILE_WORDS,
    CLASS_INTERIOR__MEDIA,
    CLASS_LIGHTS,
    CLASS_OBJECTS,
    CLASS_OBJECT_MODIFIERS,
    CLASS_ONLY_INSIDE__FUNCTION,
    CLASS_OTHER_SCENE_LEVEL_BLOCKS,
    CLASS_PATTERNS,
    CLASS_PATTERN_MODIFIERS,
    CLASS_PHOTONS,
    CLASS_PRIMITIVE_WORDS,
    CLASS_RADIOSITY,
    CLASS_RESERVED__USED_NOWHERE,
    CLASS_RVALUE_WORD,
    CLASS_STRING_FUNCTIONS,
    CLASS_TRANSFORM_WORDS,
    CLASS_VALUE_BLOCKS,
    CLASS_VECTOR_CONSTANTS,
    CLASS_VECTOR_FUNCTIONS,
    CLASS_WARPS,
};

const char *word_text(enum word w);
enum word_class word_class(enum word w);
enum word word_find(const char *text, size_t len); // WORD_NONE: not reserved
// The same for those who ask often: a hash table, made by word_table_init.
struct word_table {
    struct {
        uint16_t word;
        uint16_t len;
    } at[2048];
};
void word_table_init(struct word_table *t);
enum word word_table_find(const struct word_table *t, const char *text, size_t len);
// For those who come by the letters anyway: begin with WORD_HASH, go on with word_hash_add.
#define WORD_HASH 2166136261u
static inline uint32_t word_hash_add(uint32_t h, char c)
{
    return (h ^ (unsigned char)c) * 16777619u; // FNV-1a
}
enum word word_table_find_hashed(const struct word_table *t, const char *text, size_t len,
                                 uint32_t hash);
const char *const *word_list(void); // WORD_COUNT - 1 texts, sorted

#endif
