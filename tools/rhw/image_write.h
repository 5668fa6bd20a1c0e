// SPDX-License-Identifier: MIT
// Encoders of picture files: PNG (libspng), PPM, JPEG (libjpeg), WebP (libwebp) and EXR (OpenEXRCore). PNG and PPM ask
// for one row at a time, so that a conversion to bytes needs no second copy of the picture.
#ifndef CLI_IMAGE_WRITE_H
#define CLI_IMAGE_WRITE_H

#include "output_file.h"

#include <stdint.h>

enum cli_picture_format {
    CLI_PICTURE_UNKNOWN = -1,
    CLI_PICTURE_PNG,
    CLI_PICTURE_EXR,
    CLI_PICTURE_PPM,
    CLI_PICTURE_JPEG,
    CLI_PICTURE_WEBP
};

/// What a file's name ends in (.png, .exr, .ppm, .jpg, .jpeg, .webp; capitals too) says about its format.
enum cli_picture_format cli_picture_format_of(const char *path);

/// Fills one row of a raster: uint8_t or uint16_t samples, as `bits` says.
typedef void cli_raster_row(const void *user, int y, void *row);

enum { CLI_RASTER_TEXTS_MAX = 4 };

/// What a PNG file says in words: a keyword of 1 to 79 bytes, and a text that is not empty.
struct cli_raster_text {
    const char *keyword, *text;
};

struct cli_raster {
    int width, height;
    int channels;                        ///< 1 grey, 3 RGB, 4 RGBA with straight alpha
    int bits;                            ///< 8 or 16
    bool srgb;                           ///< samples are sRGB-encoded colours; false: numbers
    char comment[160];                   ///< kept in the file where the format can; "" for none
    const struct cli_raster_text *texts; ///< kept in a PNG beside the comment
    int text_count;                      ///< at most CLI_RASTER_TEXTS_MAX
    cli_raster_row *row;
    const void *user;
};

/// One channel of an EXR file; 4 bytes per sample.
struct cli_exr_channel {
    const char *name;  ///< "layer.channel", or "R", "G", "B", "A"
    bool integer;      ///< uint32_t, else float
    const void *first; ///< sample of the top left pixel
    int pixel_stride;  ///< bytes; rows are tightly packed
};

/// What an EXR file says beside its channels: the standard attributes worldToCamera and worldToNDC, and objectNames.
struct cli_exr_about {
    bool has_camera; ///< one camera saw the whole picture; without it no matrix is read
    double world_to_camera[16], world_to_ndc[16]; ///< column major, for column vectors
    /// A model far from the origin has its own origin, and matrices for what is counted from there.
    bool is_far;
    double origin[3], origin_to_camera[16], origin_to_ndc[16];
    const char **objects; ///< names of the ids from 1 on
    int object_count;
};

/// All of them report failure in one line and return false; the caller then discards the file. PNG and EXR ask the file
/// whether to go on.
bool cli_png_write(struct cli_output_file *file, const struct cli_raster *raster);
/// Binary: P5 for one channel, P6 for three. Four are misuse.
bool cli_ppm_write(struct cli_output_file *file, const struct cli_raster *raster);
/// 8 bits, one or three channels, quality 1..100, colours at full resolution.
bool cli_jpeg_write(struct cli_output_file *file, const struct cli_raster *raster, int quality);
/// 8 bits, at most 16383 pixels each way; quality 1..100, or 0: lossless.
bool cli_webp_write(struct cli_output_file *file, const struct cli_raster *raster, int quality);
/// Scan lines, ZIP compression on `threads` threads; the bytes do not depend on their number.
bool cli_exr_write(struct cli_output_file *file, int width, int height,
                   const struct cli_exr_channel *channels, int channel_count,
                   const struct cli_exr_about *about, int threads);

#endif
