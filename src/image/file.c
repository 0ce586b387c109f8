// Pictures to and from the file system.
#define _XOPEN_SOURCE 700 // realpath
#include "base/whole_file.h"
#include "image/codec.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
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
    if (n > SIZE_MAX / 2 - offset) { // doubling must end
        b->failed = true;
        return;
    }
    if (offset + n > b->capacity) {
        size_t capacity = b->capacity ? b->capacity : 65536;
        while (capacity < offset + n)
            capacity *= 2;
        uint8_t *p = realloc(b->data, capacity);
        if (!p) {
            b->failed = true;
            return;
        }
        b->data = p;
        b->capacity = capacity;
    }
    if (offset > b->size) // what is left out is zero
        memset(b->data + b->size, 0, offset - b->size);
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

// The file takes its place only when it is whole.
static bool replace_file(const char *path, const struct byte_buffer *b,
                         struct codec_error e)
{
    struct whole_file w;
    if (whole_file_begin(&w, path) &&
        whole_file_end(&w, fwrite(b->data, 1, b->size, w.f) == b->size))
        return true;
    codec_fail(e, "cannot write '%s': %s", path, strerror(errno));
    return false;
}

static bool write_into(const char *path, const struct byte_buffer *b,
                       struct codec_error e)
{
    bool standard = strcmp(path, "-") == 0;
    int fd = standard ? STDOUT_FILENO : open(path, O_WRONLY | O_CLOEXEC);
    bool ok = fd >= 0 && write_all(fd, b);
    if (!ok)
        codec_fail(e, "cannot write %s%s%s: %s", standard ? "" : "'",
                   standard ? "standard output" : path, standard ? "" : "'",
                   strerror(errno));
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

static const struct writer {
    enum image_type type;
    const char *word, *letters, *more;
    bool light;
    image_encoder *encode;
} writers[] = {
#define WRITER(type, word, letters, more, light, encode)                                 \
    {type, word, letters, more, light, encode},
#include "image/writers.def"
#undef WRITER
};
enum { WRITERS = sizeof writers / sizeof writers[0] };

static const struct writer *writer_of(enum image_type type)
{
    for (int i = 0; i < WRITERS; i++)
        if (writers[i].type == type)
            return &writers[i];
    return NULL;
}

bool image_write(const struct image *im, const char *path,
                 const struct image_write_options *options, char *error,
                 size_t error_size)
{
    struct codec_error e = {error, error_size};
    struct byte_buffer bytes = {0};
    const struct writer *writer = writer_of(options->type);
    bool ok = writer ? writer->encode(im, options, &bytes, e)
                     : codec_fail(e, "no such file type");
    if (ok)
        ok = file_write(path, &bytes, e);
    free(bytes.data);
    return ok;
}

enum image_type image_type_of_word(const char *word)
{
    for (int i = 0; i < WRITERS; i++)
        if (strcmp(word, writers[i].word) == 0)
            return writers[i].type;
    return IMAGE_UNKNOWN;
}

const char *image_type_word_of_letter(char letter)
{
    for (int i = 0; i < WRITERS; i++)
        if (letter && strchr(writers[i].letters, letter & ~0x20))
            return writers[i].word;
    return NULL;
}

bool image_type_is_light(enum image_type type)
{
    const struct writer *writer = writer_of(type);
    return writer && writer->light;
}

static bool same_word(const char *a, const char *b, size_t n)
{
    return strlen(b) == n && strncasecmp(a, b, n) == 0;
}

enum image_type image_type_of(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && i < WRITERS; i++) {
        if (same_word(writers[i].word, dot + 1, strlen(writers[i].word)))
            return writers[i].type;
        for (const char *at = writers[i].more; *at;) {
            const size_t n = strcspn(at, " ");
            if (same_word(at, dot + 1, n))
                return writers[i].type;
            at += n + (at[n] == ' ');
        }
    }
    return IMAGE_UNKNOWN;
}

bool file_bytes(const char *path, struct byte_buffer *b, struct codec_error e)
{
    FILE *f = fopen(path, "rb");
    if (!f)
        return codec_fail(e, "%s", strerror(errno));
    char chunk[65536];
    size_t n;
    while ((n = fread(chunk, 1, sizeof chunk, f)) > 0)
        byte_buffer_append(b, chunk, n);
    bool ok = !ferror(f) && !b->failed;
    fclose(f);
    return ok || codec_fail(e, "%s", strerror(EIO));
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
    uint8_t start[16];
    FILE *f = fopen(path, "rb");
    size_t n = f ? fread(start, 1, sizeof start, f) : 0;
    if (f)
        fclose(f);
    return image_type_of_bytes(start, n);
}

// Colours of integer files are plain; pictures in memory are premultiplied.
static bool image_of_texels(struct image *im, const struct texels *t,
                            struct transfer transfer)
{
    static const int place[5][4] = {
        [1] = {0, 0, 0, -1}, [2] = {0, 0, 0, 1}, [3] = {0, 1, 2, -1}, [4] = {0, 1, 2, 3}};
    const bool alpha = t->indexed ? t->palette_alpha : t->channels % 2 == 0;
    if (!image_init(im, t->width, t->height, alpha ? 4 : 3))
        return false;
    for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++) {
            float *p = image_at(im, x, y);
            for (int k = 0; k < im->channels; k++)
                p[k] = t->indexed ? (float)(t->palette[texels_index(t, x, y)][k] / 255.0)
                                  : (float)(texels_raw(t, x, y, place[t->channels][k]) /
                                            (double)t->max);
            for (int k = 0; k < 3; k++) {
                if (t->format != TEXEL_F32)
                    p[k] = (float)transfer_decode(transfer, (double)p[k]);
                if (alpha && !t->premultiplied)
                    p[k] *= p[3];
            }
        }
    return true;
}

bool image_read(struct image *im, const char *path, struct transfer transfer, char *error,
                size_t error_size)
{
    struct codec_error e = {error, error_size};
    struct byte_buffer b = {0};
    struct texels t;
    *im = (struct image){0};
    bool ok = file_bytes(path, &b, e) &&
              texels_decode(&t, b.data, b.size, texels_type_of(path), error, error_size);
    if (ok) {
        ok = image_of_texels(im, &t, transfer) || codec_fail(e, "out of memory");
        texels_free(&t);
    }
    free(b.data);
    return ok;
}
