// The tokens of a file as text.
#include "lang/lexer.h"

#include <stdlib.h>

#include "lang/lexeme.h"
#include "parser.h"

static const char *kind_of(const struct token *t)
{
    switch (t->kind) {
    case TOK_NUMBER: return "number";
    case TOK_STRING: return "string";
    case TOK_NAME: return "name";
    default: return t->word ? "word" : "mark";
    }
}

void lex_print(const struct source_map *sources, uint32_t file, struct diag_sink *diags,
               FILE *out)
{
    struct source_file *f = sources->file[file];
    uint32_t count;
    struct word_table words;
    word_table_init(&words);
    struct lexeme *tokens = lex_file(sources, file, diags, &words, NULL, &count);
    for (uint32_t i = 0; i < count; i++) {
        struct token t;
        lexeme_token(&tokens[i], file, f->text, 0, &t);
        const struct source_line line = source_line(f, t.where.begin);
        fprintf(out, "%u:%u %s ", line.number, t.where.begin - line.begin + 1,
                kind_of(&t));
        if (t.kind == TOK_NUMBER)
            fprintf(out, "%.17g\n", t.number);
        else
            fprintf(out, t.kind == TOK_STRING ? "\"%.*s\"\n" : "%.*s\n", (int)t.len,
                    t.text);
    }
    free(tokens);
}
