#ifndef EVAL_FILE_DATA_H
#define EVAL_FILE_DATA_H

#include <stdbool.h>
#include <stddef.h>

#include "eval/value.h"

struct arena;

// The text that #read takes apart (spec/language 3.13): numbers, vectors and strings,
// each with a comma after it.
struct file_data {
    const char *text;
    size_t len, at;
};

enum file_item { FILE_ITEM_END, FILE_ITEM_VALUE, FILE_ITEM_LAST, FILE_ITEM_WRONG };

// The next item and the token after it, whatever that is. LAST: the file ends right
// behind the value.
enum file_item file_data_next(struct file_data *d, struct arena *a, struct value *out);
size_t file_data_line(const struct file_data *d);

#endif
