// Pictures to and from the file system.
#define _XOPEN_SOURCE 700 // realpath
#include "image/codec.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool codec_fail(struct codec_error e, const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    vsnprintf(e.text, e.size, fmt, ap);
    va_end(ap);
    return false;
}

void byte_buffer_write(struct byte_buffer *b, size_t offset, const void *data, size_t n)
{
    if (b->failed)
        return;
    if (offset + n > b->capacity) {
        size_t capacity = b->capacity ? b->capacity : 65536;
        while (capacity < offset + n)
            capacity *= 2;
        uint8_t *p = realloc(b->data, capacity);
        if (!p) {
            b->failed = true;
            return;
        }
        memset(p + b->capacity, 0, capacity - b->capacity);
        b->data = p;
        b->capacity = capacity;
    }
    memcpy(b->data + offset, data, n);
    if (offset + n > b->size)
        b->size = offset + n;
}

void byte_buffer_append(struct byte_buffer *b, const void *data, size_t n)
{
    byte_buffer_write(b, b->size, data, n);
}

static bool write_all(int fd, const struct byte_buffer *b)
{
    for (size_t at = 0; at < b->size;) {
        ssize_t n = write(fd, b->data + at, b->size - at);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        at += (size_t)n;
    }
    return true;
}

// A new file beside `path`. Its name is in *temporary, to be freed.
static int open_beside(const char *path, char **temporary)
{
    size_t n = strlen(path) + 32;
    char *name = malloc(n);
    *temporary = name;
    for (int i = 0; name && i < 100; i++) {
        snprintf(name, n, "%s.%ld-%d.part", path, (long)getpid(), i);
        int fd = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST)
            return fd;
    }
    return -1;
}

// The file takes its place only when it is whole and on the disk's books.
static bool replace_file(const char *path, const struct byte_buffer *b,
                         struct codec_error e)
{
    char *temporary = NULL;
    int fd = open_beside(path, &temporary);
    bool ok = fd >= 0 && write_all(fd, b);
    int why = errno;
    if (fd >= 0 && close(fd) && ok) {
        why = errno;
        ok = false;
    }
    if (ok && rename(temporary, path)) {
        why = errno;
        ok = false;
    }
    if (!ok) {
        if (fd >= 0)
            unlink(temporary);
        codec_fail(e, "cannot write '%s': %s", path, strerror(why));
    }
    free(temporary);
    return ok;
}

static bool write_into(const char *path, const struct byte_buffer *b,
                       struct codec_error e)
{
    bool standard = strcmp(path, "-") == 0;
    int fd = standard ? STDOUT_FILENO : open(path, O_WRONLY | O_CLOEXEC);
    bool ok = fd >= 0 && write_all(fd, b);
    if (!ok)
        codec_fail(e, "cannot write '%s': %s", path, strerror(errno));
    if (fd >= 0 && !standard)
        close(fd);
    return ok;
}

// Devices and pipes cannot be replaced, and a link should stay a link.
bool file_write(const char *path, const struct byte_buffer *b, struct codec_error e)
{
    struct stat st;
    if (strcmp(path, "-") == 0 || (stat(path, &st) == 0 && !S_ISREG(st.st_mode)))
        return write_into(path, b, e);
    char *target = realpath(path, NULL);
    bool ok = replace_file(target ? target : path, b, e);
    free(target);
    return ok;
}

bool image_write(const struct image *im, const char *path,
                 const struct image_write_options *options, char *error,
                 size_t error_size)
{
    struct codec_error e = {error, error_size};
    struct byte_buffer bytes = {0};
    bool ok = false;
    switch (options->type) {
    case IMAGE_PNG: ok = png_encode(im, options, &bytes, e); break;
    case IMAGE_PPM: ok = ppm_encode(im, options, &bytes, e); break;
    case IMAGE_EXR: ok = exr_encode(im, options, &bytes, e); break;
    default: codec_fail(e, "no such file type"); break;
    }
    if (ok)
        ok = file_write(path, &bytes, e);
    free(bytes.data);
    return ok;
}

bool file_bytes(const char *path, struct byte_buffer *b, struct codec_error e)
{
    FILE *f = fopen(path, "rb");
    if (!f)
        return codec_fail(e, "cannot read '%s': %s", path, strerror(errno));
    char chunk[65536];
    size_t n;
    while ((n = fread(chunk, 1, sizeof chunk, f)) > 0)
        byte_buffer_append(b, chunk, n);
    bool ok = !ferror(f) && !b->failed;
    fclose(f);
    return ok || codec_fail(e, "cannot read '%s'", path);
}

// By the first bytes: names lie.
enum image_type image_type_of_bytes(const uint8_t *data, size_t size)
{
    static const struct {
        const char *text;
        size_t size;
        enum image_type type;
    } marks[] = {{"\xff\xd8\xff", 3, IMAGE_JPEG},
                 {"II*\0", 4, IMAGE_TIFF},
                 {"MM\0*", 4, IMAGE_TIFF},
                 {"GIF8", 4, IMAGE_GIF},
                 {"BM", 2, IMAGE_BMP},
                 {"FORM", 4, IMAGE_IFF},
                 {"#?RADIANCE", 10, IMAGE_HDR},
                 {"#?RGBE", 6, IMAGE_HDR}};
    if (size >= 8 && memcmp(data, "\x89PNG\r\n\x1a\n", 8) == 0)
        return IMAGE_PNG;
    if (size >= 4 && memcmp(data, "\x76\x2f\x31\x01", 4) == 0)
        return IMAGE_EXR;
    if (size >= 2 && data[0] == 'P' && data[1] >= '1' && data[1] <= '6')
        return IMAGE_PPM;
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++)
        if (size >= marks[i].size && memcmp(data, marks[i].text, marks[i].size) == 0)
            return marks[i].type;
    return IMAGE_UNKNOWN;
}

enum image_type image_type_of_file(const char *path)
{
    uint8_t start[8];
    FILE *f = fopen(path, "rb");
    size_t n = f ? fread(start, 1, sizeof start, f) : 0;
    if (f)
        fclose(f);
    return image_type_of_bytes(start, n);
}

bool image_read(struct image *im, const char *path, struct transfer transfer, char *error,
                size_t error_size)
{
    struct codec_error e = {error, error_size};
    struct byte_buffer b = {0};
    *im = (struct image){0};
    bool ok = file_bytes(path, &b, e);
    if (ok) {
        switch (image_type_of_bytes(b.data, b.size)) {
        case IMAGE_PNG: ok = png_decode(im, b.data, b.size, transfer, e); break;
        case IMAGE_EXR: ok = exr_decode(im, b.data, b.size, e); break;
        case IMAGE_PPM: ok = ppm_decode(im, b.data, b.size, transfer, e); break;
        default: ok = codec_fail(e, "not a PNG, EXR or PPM file"); break;
        }
    }
    free(b.data);
    return ok;
}
