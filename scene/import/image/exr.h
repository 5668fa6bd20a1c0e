// SPDX-License-Identifier: MIT
// OpenEXR files, by the C core of the library: all channels for who compares pictures, colours for textures.
#ifndef SCENE_IMAGE_EXR_H
#define SCENE_IMAGE_EXR_H

#include "model.h"

enum { SCENE_EXR_CHANNELS_MAX = 128, SCENE_EXR_NAME_MAX = 256 };

struct scene_exr_channel {
    char name[SCENE_EXR_NAME_MAX];
    bool is_integer;      ///< its samples are uint32_t, not float
    const uint8_t *plane; ///< samples of 4 bytes, row by row; NULL if the channel was not asked for
};

struct scene_exr {
    int width, height; ///< 1..RHW_MAX_TARGET_SIZE
    int channel_count;
    struct scene_exr_channel *channels;
    void *memory;
};

/// Return zeroed memory for `count` elements of `size` bytes, which free() takes. Return NULL if they are too many.
typedef void *scene_exr_allocate(void *user, size_t count, size_t size);

/// Read a file by its path, with all channels, whose memory `allocate` gives. Return NULL on success. Return a short
/// reason (static storage) if not, which is scene_exr_no_memory where memory is missing, and set `detail` to what the
/// library says of a file that is not valid. scene_exr_free takes `exr` in either case.
const char *scene_exr_read_file(const char *path, scene_exr_allocate *allocate, void *user,
                                struct scene_exr *exr, const char **detail);
extern const char scene_exr_no_memory[];
void scene_exr_free(struct scene_exr *exr);

/// Decode an EXR file in memory as scene_image_decode does, but leave has_alpha alone: from the channels R, G, B and A,
/// or Y for grey.
const char *scene_image_decode_exr(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
