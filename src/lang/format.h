#ifndef LANG_FORMAT_H
#define LANG_FORMAT_H

#include <stdbool.h>
#include <stdio.h>

#include "base/diag.h"

// Writes a source file with each line indented by what is open before it: braces,
// brackets and #if, #while, #for, #switch and #macro, `width` blanks each. Tokens,
// comments and line ends stay as they are; blanks at the ends of lines go. Lines that
// begin inside a string or a comment are not touched. Formatting twice changes nothing
// more. False, with nothing written, when the text has errors.
bool format_source(struct source_map *sources, uint32_t file, struct diag_sink *diags,
                   int width, FILE *out);

#endif
