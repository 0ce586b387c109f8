#ifndef BASE_LIBRARY_H
#define BASE_LIBRARY_H

#include <stdbool.h>
#include <stddef.h>

// Shared libraries that few scenes need are loaded when they are: libtiff alone brings ten
// others, which cost every run more than a small picture does.
//
// A user lists the functions once, as FUNCTIONS(F): F(name) F(name) ..., and makes of the
// list a structure of pointers by LIBRARY_POINTER and a function that fills it, load(), by
// LIBRARY_LOADED. Where configure found no name to load the library by, it is linked, and
// LIBRARY_LINKED makes that function.
#define LIBRARY_POINTER(name)  __typeof__(name) *name;
#define LIBRARY_NAME(name)     #name,
#define LIBRARY_FUNCTION(name) name,
#define LIBRARY_LOADED(type, file)                                                       \
    static bool load(struct type *lib, char *why, size_t why_size)                       \
    {                                                                                    \
        static const char *const names[] = {FUNCTIONS(LIBRARY_NAME)};                    \
        return library_load(file, names, sizeof names / sizeof names[0], lib, why,       \
                            why_size);                                                   \
    }
#define LIBRARY_LINKED(type)                                                             \
    static bool load(struct type *lib, char *why, size_t why_size)                       \
    {                                                                                    \
        (void)why, (void)why_size;                                                       \
        *lib = (struct type){FUNCTIONS(LIBRARY_FUNCTION)};                               \
        return true;                                                                     \
    }

// Loads `file` (a name that the dynamic linker knows, such as "libtiff.so.6"), unless it is
// loaded, and fills `pointers`, a structure of `count` pointers to its functions. It stays
// to the end of the program. False: it or one of the functions is not there, and `why`
// says so.
bool library_load(const char *file, const char *const *names, size_t count,
                  void *pointers, char *why, size_t why_size);

#endif
