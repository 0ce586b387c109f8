// The name of the picture file (spec/language 7.4).
#include "cmd/cmd.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

void *must_have(void *memory)
{
    if (!memory) {
        fputs("lambert: out of memory\n", stderr);
        abort();
    }
    return memory;
}

char *text_format_list(const char *fmt, va_list ap)
{
    va_list again;
    va_copy(again, ap);
    int n = vsnprintf(NULL, 0, fmt, ap);
    char *text = must_have(malloc((size_t)n + 1));
    vsnprintf(text, (size_t)n + 1, fmt, again);
    va_end(again);
    return text;
}

char *text_format(const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    char *text = text_format_list(fmt, ap);
    va_end(ap);
    return text;
}

static char *scene_base(const char *scene)
{
    if (strcmp(scene, "-") == 0)
        return text_format("stdin");
    const char *slash = strrchr(scene, '/');
    const char *name = slash ? slash + 1 : scene;
    const char *dot = strrchr(name, '.');
    return text_format(
        "%.*s", (int)(dot && dot != name ? (size_t)(dot - name) : strlen(name)), name);
}

static bool is_directory(const char *path)
{
    struct stat st;
    return path[0] && (path[strlen(path) - 1] == '/' ||
                       (stat(path, &st) == 0 && S_ISDIR(st.st_mode)));
}

// A device or pipe is written to as it is called.
static bool is_special(const char *path)
{
    struct stat st;
    return stat(path, &st) == 0 && !S_ISREG(st.st_mode) && !S_ISDIR(st.st_mode);
}

// The extension of the file: that of the type when one is set, else that of the name.
// Sets *stem to the length of the name without an extension that is the type's own.
static const char *extension_of(struct cmd *c, const char *name, size_t *stem, int *code)
{
    const char *type = lambert_option_text(c->ctx, "type");
    const char *slash = strrchr(name, '/');
    const char *dot = strrchr(slash ? slash : name, '.');
    *stem = strlen(name);
    if (dot && !type && lambert_image_can_read(name) && !lambert_image_can_write(name))
        *code =
            cmd_fail(CMD_USAGE,
                     "'%s' cannot be written; there are .png, .exr, .ppm, .jpg, .tga, "
                     ".bmp and .hdr",
                     name);
    if (dot && (type ? strcasecmp(dot + 1, type) == 0 : lambert_image_can_write(name))) {
        *stem = (size_t)(dot - name);
        return dot + 1;
    }
    return type ? type : "png";
}

char *output_name(struct cmd *c, const char *scene, long frame, int digits, int *code)
{
    const char *given = lambert_option_text(c->ctx, "output");
    if (given && !*given)
        given = NULL;
    char *base = scene_base(scene), *path = NULL;
    char number[32] = "";
    size_t stem;
    *code = CMD_OK;
    if (given && (strcmp(given, "-") == 0 || strcmp(given, "stdout") == 0)) {
        free(base);
        return text_format("-");
    }
    if (given && is_special(given)) {
        free(base);
        return text_format("%s", given);
    }
    const char *scene_slash = strrchr(scene, '/');
    if (!given) // beside the scene, as POV-Ray has it
        path = text_format("%.*s%s", scene_slash ? (int)(scene_slash + 1 - scene) : 0,
                           scene, base);
    else if (is_directory(given))
        path = text_format("%s%s%s", given, given[strlen(given) - 1] == '/' ? "" : "/",
                           base);
    else
        path = text_format("%s", given);
    free(base);
    if (frame >= 0)
        snprintf(number, sizeof number, "%0*ld", digits, frame);
    // A scene called a.png.pov makes a.png.png, as it must: only given names count.
    const char *extension =
        extension_of(c, given && !is_directory(given) ? path : "", &stem, code);
    if (!given || is_directory(given))
        stem = strlen(path);
    char *name = text_format("%.*s%s.%s", (int)stem, path, number, extension);
    free(path);
    return name;
}
