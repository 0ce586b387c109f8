#ifndef CMD_REPORT_H
#define CMD_REPORT_H

#include "cmd/cmd.h"

// One scene by both programs.
struct compared_scene {
    const char *scene;   // as given
    char *name;          // of its files, without extension
    const char *verdict; // a word or two
    bool compared;       // otherwise `reason` says why not
    struct lambert_difference difference;
    double percent, reference_seconds, seconds;
    const char *reason;
};

// Writes FOLDER/index.html. False: it could not be written (errno).
bool report_write(const char *folder, const struct compared_scene *rows, size_t count);

#endif
