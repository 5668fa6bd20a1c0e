// SPDX-License-Identifier: MIT
// What stands behind the storage functions of shaders: the buffers and images of a draw, by slot, for reading and
// writing.
#ifndef RHW_STORAGE_H
#define RHW_STORAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rhw/shader_storage.h"
#include "rhw/types.h"

// Words of 32 bits that shader functions may change on any thread, hence always atomically.
struct rhw_storage_words {
    uint32_t *words; // NULL: nothing is bound
    uint32_t count;
    bool is_read_only;
};

struct rhw_format_info;
struct rhw_kernels;
struct rhw_texture_data;

// A level of a texture, or a texel buffer, which is a row of texels.
struct rhw_storage_image {
    const struct rhw_texture_data *texture; // NULL: no level is bound
    const struct rhw_format_info *info;     // format of the texels; NULL: nothing is bound
    unsigned char *texels;                  // texels of a texel buffer
    int32_t count;                          // number of these
    int level;
    bool is_read_only;
};

// Return the whole words of `size` bytes.
struct rhw_storage_words rhw_storage_words_of(void *bytes, size_t size, bool is_read_only);
// Return a level of a texture as an image.
struct rhw_storage_image rhw_storage_image_of_level(const struct rhw_texture_data *texture, int level,
                                                    bool is_read_only);
// Return `size` bytes as a row of texels, RHW_MAX_TEXEL_BUFFER of them at most. The format is one of colour, and not
// compressed.
struct rhw_storage_image rhw_storage_image_of_texels(enum rhw_format format, void *bytes, size_t size,
                                                     bool is_read_only);

// The storage of a draw.
struct rhw_storage {
    struct rhw_storage_words buffers[RHW_MAX_STORAGE_BUFFERS];
    struct rhw_storage_image images[RHW_MAX_STORAGE_IMAGES];
};

// Storage with no buffer in any slot.
extern const struct rhw_storage rhw_no_storage;

// Do what the functions of shader_storage.h do that have these names, for words and for an image.
void rhw_words_access(struct rhw_storage_words range, const struct rhw_storage_request *request,
                      rhw_int *before);
int32_t rhw_words_access1(struct rhw_storage_words range, enum rhw_storage_operation operation,
                          uint32_t index, int32_t value, int32_t comparand);
void rhw_bound_image_load(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                          const rhw_int *at, rhw_float texel[4]);
void rhw_bound_image_store(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                           const rhw_int *at, const rhw_int *mask, const rhw_float texel[4]);
void rhw_bound_image_atomic(const struct rhw_storage_image *image, const struct rhw_storage_request *request,
                            rhw_int *before);
void rhw_bound_image_size(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                          rhw_int size[3]);
void rhw_bound_image_load1(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                           const int32_t *at, float texel[4]);
void rhw_bound_image_store1(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                            const int32_t *at, const float texel[4]);
int32_t rhw_bound_image_atomic1(const struct rhw_storage_image *image, enum rhw_storage_operation operation,
                                const int32_t *at, int32_t value, int32_t comparand);
void rhw_bound_image_size1(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                           int32_t size[3]);

// Do the operation to a word and return what the word was. STORE returns 0.
int32_t rhw_storage_word(uint32_t *word, enum rhw_storage_operation operation, uint32_t value,
                         uint32_t comparand);

#endif
