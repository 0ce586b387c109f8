// `lambert compare A B` for two pictures.
#include "cmd/cmd.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void print_result(struct cmd *c, const struct lambert_difference *d)
{
    double percent = 100 * (double)d->pixels_off / (double)d->pixels;
    if (lambert_option_number(c->ctx, "csv")) {
        printf("off_percent,rmse,psnr_db,largest\n%.4f,%.6f,%.2f,%.6f\n", percent,
               d->rmse, d->psnr, d->largest);
        return;
    }
    printf("pixels off by more than %g/255: %.3f %% (%llu of %llu)\n",
           lambert_option_number(c->ctx, "threshold"), percent,
           (unsigned long long)d->pixels_off, (unsigned long long)d->pixels);
    printf("RMSE %.6f, PSNR %.2f dB, largest difference %.1f/255\n", d->rmse, d->psnr,
           d->largest * 255);
}

static int write_map(struct cmd *c, const struct lambert_image *map)
{
    const char *folder = lambert_option_text(c->ctx, "out");
    if (!lambert_option_is_set(c->ctx, "out"))
        return CMD_OK;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return cmd_fail(CMD_NO_OUTPUT, "cannot make '%s': %s", folder, strerror(errno));
    char *path = text_format("%s/heat.png", folder);
    enum lambert_status status = lambert_image_write(c->ctx, map, path);
    free(path);
    return status == LAMBERT_OK ? CMD_OK
                                : cmd_fail(CMD_NO_OUTPUT, "%s", lambert_error(c->ctx));
}

static int compare_opened(struct cmd *c, const struct lambert_image *a,
                          const struct lambert_image *b)
{
    struct lambert_difference d;
    struct lambert_image *map;
    double threshold = lambert_option_number(c->ctx, "threshold") / 255;
    if (lambert_image_compare(c->ctx, a, b, threshold, &d, &map) != LAMBERT_OK)
        return cmd_fail(CMD_FAILED, "%s", lambert_error(c->ctx));
    print_result(c, &d);
    int code = write_map(c, map);
    lambert_image_free(map);
    if (code)
        return code;
    double percent = 100 * (double)d.pixels_off / (double)d.pixels;
    return percent <= lambert_option_number(c->ctx, "tolerance") ? CMD_OK : CMD_FAILED;
}

static int compare_pictures(struct cmd *c)
{
    struct lambert_image *a = NULL, *b = NULL;
    int code;
    if (lambert_image_read(c->ctx, c->file[0], &a) != LAMBERT_OK ||
        lambert_image_read(c->ctx, c->file[1], &b) != LAMBERT_OK)
        code = cmd_fail(CMD_NO_INPUT, "%s", lambert_error(c->ctx));
    else
        code = compare_opened(c, a, b);
    lambert_image_free(a);
    lambert_image_free(b);
    return code;
}

int cmd_compare(struct cmd *c)
{
    if (c->file_count == 2 && lambert_image_can_read(c->file[0]) &&
        lambert_image_can_read(c->file[1]))
        return compare_pictures(c);
    if (c->file_count && !lambert_image_can_read(c->file[0]))
        return compare_scenes(c);
    return cmd_fail(CMD_USAGE, "compare takes two pictures, or scenes");
}
