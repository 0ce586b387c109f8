#ifndef CMD_REPORT_H
#define CMD_REPORT_H

#include "cmd/cmd.h"

// Of the pixels at most 1 % are off, at most 5 %, more; or there are no two pictures.
enum verdict {
    VERDICT_MATCH,
    VERDICT_NEAR,
    VERDICT_FAR,
    VERDICT_NOT_RENDERED,
    VERDICT_NO_REFERENCE,
    VERDICT_COUNT
};

enum { REASON_MAX = 160 };

// One scene by both programs.
struct compared_scene {
    const char *scene; // as given
    char *name;        // of its files, without extension
    enum verdict verdict;
    struct lambert_difference difference; // these where there are two pictures,
    double percent;                       // of the pixels are off
    double reference_seconds, seconds;    // of the processes
    char reason[REASON_MAX];              // else why not
};

static inline bool is_compared(const struct compared_scene *r)
{
    return r->verdict <= VERDICT_FAR;
}

const char *verdict_text(enum verdict v); // a word or two

// Writes FOLDER/index.html. False: it could not be written (errno).
bool report_write(const char *folder, const struct compared_scene *rows, size_t count);

#endif
