// SPDX-License-Identifier: MIT
// Files of images that tests make byte by byte, and what becomes of them.
#ifndef TEST_IMAGE_FILE_H
#define TEST_IMAGE_FILE_H

#include "unit.h"

#include <string.h>

#include "import/image/read.h"

// A file under construction, in bytes from the least on.
struct image_file {
    uint8_t bytes[4096];
    size_t size;
};

static inline void image_file_put(struct image_file *file, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        file->bytes[file->size++] = (uint8_t)(i < 8 ? value >> 8 * i : 0);
    }
}

static inline void image_file_put_bytes(struct image_file *file, const void *bytes, size_t size)
{
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

static inline struct image_file image_file_of(const void *bytes, size_t size)
{
    struct image_file file = {.size = 0};
    image_file_put_bytes(&file, bytes, size);
    return file;
}

// Return the image of a file, which has to be read.
static inline struct scene_image image_file_decode(const struct image_file *file)
{
    struct scene_image image = {.width = 0};
    const char *const problem = scene_image_decode(file->bytes, file->size, &image);
    if (problem != NULL) {
        fail_msg("%s", problem);
    }
    assert_non_null(image.texels);
    return image;
}

// Hold that a file is refused for this reason, and that nothing is written then.
static inline void image_file_expect_refused(const struct image_file *file, const char *problem)
{
    struct scene_image image = {.width = 77};
    assert_string_equal(scene_image_decode(file->bytes, file->size, &image), problem);
    assert_int_equal(image.width, 77);
    assert_null(image.texels);
}

#endif
