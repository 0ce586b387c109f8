#ifndef TESTS_FAKE_ARGS_H
#define TESTS_FAKE_ARGS_H

#include <stdbool.h>

struct args;
struct arena;
struct diag_sink;

struct args *fake_args_new(struct arena *a, struct diag_sink *sink, const char *text);
bool fake_args_failed(const struct args *a);

#endif
