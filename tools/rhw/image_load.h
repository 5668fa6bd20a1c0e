// SPDX-License-Identifier: MIT
// Pictures that `compare` reads: PNG (any kind), WebP, PPM and PGM, EXR. Samples stay in the type the file has, so
// that ids of 32 bits and 16 bit colours arrive unharmed; a row of one channel is handed out as doubles.
#ifndef CLI_IMAGE_LOAD_H
#define CLI_IMAGE_LOAD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum cli_sample_type { CLI_SAMPLE_U8, CLI_SAMPLE_U16, CLI_SAMPLE_U32, CLI_SAMPLE_FLOAT };

enum { CLI_IMAGE_CHANNELS_MAX = 128, CLI_CHANNEL_NAME_MAX = 256 };

struct cli_image_channel {
    char name[CLI_CHANNEL_NAME_MAX];
    enum cli_sample_type type;
    const uint8_t *first;            ///< top left sample; NULL: the channel is 1 everywhere
    size_t pixel_stride, row_stride; ///< bytes
};

struct cli_loaded_image {
    int width, height; ///< 1..RHW_MAX_TARGET_SIZE
    bool encoded; ///< PNG, WebP, PPM: R, G, B, A in fractions of full scale; false: EXR, the file's own channels
    double full_scale; ///< what a stored sample is divided by: 65535/65535 and 255/255 give the same bits
    struct cli_image_channel *channels;
    int channel_count;
    void *memory;
    size_t most; ///< bytes that may be allocated for `memory`
};

/// Bytes of memory that a picture may take where nobody says otherwise: 16384 pixels each way of 16 bit colours.
#define CLI_IMAGE_MOST ((size_t)2 << 30)

/// Reads a picture whatever its name ends in: its first bytes tell. One that would take more than `most` bytes of
/// memory is refused before it does. Reports failure in one line.
bool cli_image_load(struct cli_loaded_image *image, const char *path, size_t most);
void cli_image_unload(struct cli_loaded_image *image);

/// For the decoders: allocates `count` elements of `size` bytes, zeroed, as `memory`, within image->most. Reports
/// failure in one line.
bool cli_image_allocate(struct cli_loaded_image *image, const char *path, size_t count, size_t size);

/// One row of one channel; `row` has image->width elements.
void cli_image_row(const struct cli_loaded_image *image, int channel, int y, double *row);
/// The channel of that name, or -1.
int cli_image_find_channel(const struct cli_loaded_image *image, const char *name);

#endif
