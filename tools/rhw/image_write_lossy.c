// SPDX-License-Identifier: MIT
// JPEG and WebP encoders; see image_write.h.
#include "image_write.h"

#include "image_webp.h"
#include "message.h"

#include <errno.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

// JPEG ----------------------------------------------------------------------------------------------

// libjpeg ends a failure by a jump.
struct jpeg_failure {
    struct jpeg_error_mgr manager;
    jmp_buf jump;
};

static void fail_jpeg(j_common_ptr info)
{
    struct jpeg_failure *failure = (struct jpeg_failure *)info->err;
    longjmp(failure->jump, 1);
}

static void compress_jpeg(struct jpeg_compress_struct *jpeg, const struct cli_raster *raster, int quality,
                          unsigned char *row)
{
    jpeg->image_width = (JDIMENSION)raster->width;
    jpeg->image_height = (JDIMENSION)raster->height;
    jpeg->input_components = raster->channels;
    jpeg->in_color_space = raster->channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg->dct_method = JDCT_ISLOW; // the one that gives the same bytes whatever the CPU
    jpeg->optimize_coding = TRUE;
    jpeg_set_quality(jpeg, quality, TRUE);
    jpeg->comp_info[0].h_samp_factor = jpeg->comp_info[0].v_samp_factor = 1; // full resolution of colours
    jpeg_start_compress(jpeg, TRUE);
    if (raster->comment[0]) {
        jpeg_write_marker(jpeg, JPEG_COM, (const JOCTET *)raster->comment, (unsigned)strlen(raster->comment));
    }
    for (int y = 0; y < raster->height; y++) {
        raster->row(raster->user, y, row);
        jpeg_write_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_compress(jpeg);
}

bool cli_jpeg_write(struct cli_output_file *file, const struct cli_raster *raster, int quality)
{
    struct jpeg_compress_struct jpeg;
    struct jpeg_failure failure;
    unsigned char *const row = malloc((size_t)raster->width * (size_t)raster->channels);
    if (!row) {
        cli_error(file->path, "out of memory");
        return false;
    }
    jpeg.err = jpeg_std_error(&failure.manager);
    failure.manager.error_exit = fail_jpeg;
    errno = 0;
    const bool failed = setjmp(failure.jump) != 0;
    if (!failed) {
        jpeg_create_compress(&jpeg);
        jpeg_stdio_dest(&jpeg, file->stream);
        compress_jpeg(&jpeg, raster, quality, row);
    } else {
        char message[JMSG_LENGTH_MAX];
        jpeg.err->format_message((j_common_ptr)&jpeg, message);
        cli_error(file->path, "cannot be written: %s", errno ? strerror(errno) : message);
    }
    jpeg_destroy_compress(&jpeg);
    free(row);
    return !failed;
}

// WebP ----------------------------------------------------------------------------------------------

static int write_webp(const uint8_t *data, size_t size, const WebPPicture *picture)
{
    return fwrite(data, 1, size, picture->custom_ptr) == size;
}

static bool import_webp(WebPPicture *picture, const struct cli_raster *raster)
{
    const size_t pitch = (size_t)raster->width * (size_t)(raster->channels == 4 ? 4 : 3);
    unsigned char *const pixels = malloc(pitch * (size_t)raster->height);
    if (!pixels) {
        return false;
    }
    for (int y = 0; y < raster->height; y++) {
        unsigned char *const row = pixels + (size_t)y * pitch;
        raster->row(raster->user, y, row);
        for (int x = raster->width; raster->channels == 1 && x-- > 0;) { // grey, from the end
            row[3 * x] = row[3 * x + 1] = row[3 * x + 2] = row[x];
        }
    }
    const bool imported = raster->channels == 4 ? WebPPictureImportRGBA(picture, pixels, (int)pitch)
                                                : WebPPictureImportRGB(picture, pixels, (int)pitch);
    free(pixels);
    return imported;
}

bool cli_webp_prepare(WebPConfig *config, WebPPicture *picture, const struct cli_raster *raster, int quality)
{
    if (!WebPConfigInit(config) || !WebPPictureInit(picture)) {
        return false;
    }
    if (quality == 0) {
        WebPConfigLosslessPreset(config, 2);
        config->exact = 1; // colours under full transparency too
    } else {
        config->quality = (float)quality;
    }
    picture->use_argb = quality == 0;
    picture->width = raster->width;
    picture->height = raster->height;
    const bool imported = import_webp(picture, raster);
    if (!imported) {
        WebPPictureFree(picture);
    }
    return imported;
}

bool cli_webp_write(struct cli_output_file *file, const struct cli_raster *raster, int quality)
{
    WebPConfig config;
    WebPPicture picture;
    errno = 0;
    bool written = cli_webp_prepare(&config, &picture, raster, quality);
    if (written) {
        picture.writer = write_webp;
        picture.custom_ptr = file->stream;
        written = WebPEncode(&config, &picture);
        WebPPictureFree(&picture);
    }
    if (!written) {
        cli_error(file->path, "cannot be written: %s", strerror(errno ? errno : ENOMEM));
    }
    return written;
}
