// SPDX-License-Identifier: MIT
// Storage buffers from shader functions: reads, writes and atomics of 32-bit words. Included by shader.h.
//
// A function that writes, or changes a word by an atomic, has effects, which its program declares: RHW_USE_EFFECTS for
// the fragment function, vertex_effects for the vertex function. docs/shaders.md says how often such functions are
// called, in which order, and which effects give the same bytes on every run.
#ifndef RHW_SHADER_STORAGE_H
#define RHW_SHADER_STORAGE_H

#include "base.h"
#include "shader_vector.h"

struct rhw_bindings;

/// What is done to a word. All but LOAD and STORE are atomic, each a step of its own that others see before or after it,
/// and no fence for other words (Vulkan 1.3, memory model: relaxed, with the scope of the device). Loads and stores are
/// of whole words.
enum rhw_storage_operation {
    RHW_STORAGE_LOAD,
    RHW_STORAGE_STORE,
    RHW_STORAGE_ADD, ///< wraps
    RHW_STORAGE_MIN,
    RHW_STORAGE_MAX, ///< of signed integers
    RHW_STORAGE_MIN_UNSIGNED,
    RHW_STORAGE_MAX_UNSIGNED,
    RHW_STORAGE_AND,
    RHW_STORAGE_OR,
    RHW_STORAGE_XOR,
    RHW_STORAGE_EXCHANGE,
    RHW_STORAGE_COMPARE_EXCHANGE, ///< the value is written where the word equals `comparand`
    RHW_STORAGE_OPERATION_COUNT
};

/// One lane of rhw_storage_access: gives the word as it was before, 0 where there is none.
RHW_API int32_t rhw_storage_access1(const struct rhw_bindings *textures, int slot,
                                    enum rhw_storage_operation operation, uint32_t index, int32_t value,
                                    int32_t comparand);
/// The whole words of the slot's range; 0 where nothing is bound.
RHW_API uint32_t rhw_storage_count(const struct rhw_bindings *textures, int slot);

RHW_QUIET_BEGIN

#if RHW_HAS_LANES

/// What 8 lanes do to a storage buffer. Zero the struct, then set what the operation reads.
struct rhw_storage_request {
    enum rhw_storage_operation operation;
    const rhw_int *mask;      ///< the lanes that do it: mostly the group's mask; NULL: all
    const rhw_int *index;     ///< of the word in the slot's range, as an unsigned number
    const rhw_int *value;     ///< of all but LOAD
    const rhw_int *comparand; ///< of COMPARE_EXCHANGE
};

/// Does it to the buffer in storage slot `slot`, 0..RHW_MAX_STORAGE_BUFFERS − 1, that a group's `textures` stand for,
/// lane after lane from the first. `before` gets the words as they were, 0 in lanes that do nothing; it may be NULL. A
/// word outside the range, or in a slot without a buffer, reads as 0 and is not written (robustBufferAccess2).
RHW_API void rhw_storage_access(const struct rhw_bindings *textures, int slot,
                                const struct rhw_storage_request *request, rhw_int *before);

/// The words at `index` in lanes of `mask`; 0 in others.
static inline rhw_int rhw_storage_load(const struct rhw_bindings *textures, int slot, rhw_int index,
                                       rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_LOAD, &mask, &index, (const rhw_int *)0,
                                                (const rhw_int *)0};
    rhw_int before;
    rhw_storage_access(textures, slot, &request, &before);
    return before;
}

/// Writes `value` at `index` in lanes of `mask`. Where several lanes have one index, the last one's stays.
static inline void rhw_storage_store(const struct rhw_bindings *textures, int slot, rhw_int index,
                                     rhw_int value, rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_STORE, &mask, &index, &value, (const rhw_int *)0};
    rhw_storage_access(textures, slot, &request, (rhw_int *)0);
}

/// An atomic, by any operation but COMPARE_EXCHANGE; gives the words as they were.
static inline rhw_int rhw_storage_atomic(const struct rhw_bindings *textures, int slot,
                                         enum rhw_storage_operation operation, rhw_int index, rhw_int value,
                                         rhw_int mask)
{
    const struct rhw_storage_request request = {operation, &mask, &index, &value, (const rhw_int *)0};
    rhw_int before;
    rhw_storage_access(textures, slot, &request, &before);
    return before;
}

/// Writes `value` where the word equals `comparand`; gives the words as they were.
static inline rhw_int rhw_storage_compare_exchange(const struct rhw_bindings *textures, int slot,
                                                   rhw_int index, rhw_int comparand, rhw_int value,
                                                   rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_COMPARE_EXCHANGE, &mask, &index, &value,
                                                &comparand};
    rhw_int before;
    rhw_storage_access(textures, slot, &request, &before);
    return before;
}

#endif

static inline int32_t rhw_storage_load1(const struct rhw_bindings *textures, int slot, uint32_t index)
{
    return rhw_storage_access1(textures, slot, RHW_STORAGE_LOAD, index, 0, 0);
}

static inline void rhw_storage_store1(const struct rhw_bindings *textures, int slot, uint32_t index,
                                      int32_t value)
{
    rhw_storage_access1(textures, slot, RHW_STORAGE_STORE, index, value, 0);
}

static inline int32_t rhw_storage_atomic1(const struct rhw_bindings *textures, int slot,
                                          enum rhw_storage_operation operation, uint32_t index, int32_t value)
{
    return rhw_storage_access1(textures, slot, operation, index, value, 0);
}

static inline int32_t rhw_storage_compare_exchange1(const struct rhw_bindings *textures, int slot,
                                                    uint32_t index, int32_t comparand, int32_t value)
{
    return rhw_storage_access1(textures, slot, RHW_STORAGE_COMPARE_EXCHANGE, index, value, comparand);
}

RHW_QUIET_END

// Images

/// A lane of rhw_image_load, rhw_image_store, rhw_image_atomic and rhw_image_size.
RHW_API void rhw_image_load1(const struct rhw_bindings *textures, int slot, const int32_t *at,
                             float texel[4]);
RHW_API void rhw_image_store1(const struct rhw_bindings *textures, int slot, const int32_t *at,
                              const float texel[4]);
RHW_API int32_t rhw_image_atomic1(const struct rhw_bindings *textures, int slot,
                                  enum rhw_storage_operation operation, const int32_t *at, int32_t value,
                                  int32_t comparand);
RHW_API void rhw_image_size1(const struct rhw_bindings *textures, int slot, int32_t size[3]);

#if RHW_HAS_LANES

/// The texel at `at` of image slot `slot`, 0..RHW_MAX_STORAGE_IMAGES − 1, that a group's `textures` stand for: `at` has x,
/// y and z as the texture has them, and the layer of an array; of a cube x, y and 6 × cube + face; of a texel buffer x. It
/// is decoded as by rhw_sample_fetch; integer formats give their bits. Outside it is 0 in the channels that the format
/// has; those that it lacks are 0, 0, 0, 1, of integers the whole number, as all are in a slot without an image (robustImageAccess2).
RHW_API void rhw_image_load(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                            rhw_float texel[4]);

/// Writes the texels of lanes of `mask` (NULL: all), encoded as a colour target's; nothing outside, lane after lane from the
/// first. A texel of several words is not written in one step.
RHW_API void rhw_image_store(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                             const rhw_int *mask, const rhw_float texel[4]);

/// Does what the request says to texels of R32_UINT and R32_SINT: request->index is what `at` is elsewhere. `before` gets the texels as
/// they were, 0 outside and with other formats, which stay as they are; it may be NULL.
RHW_API void rhw_image_atomic(const struct rhw_bindings *textures, int slot,
                              const struct rhw_storage_request *request, rhw_int *before);

/// Width, height and, of a 3D texture, slices of the level that is set, else layers, six for each cube; 1 for what the kind
/// lacks. Zeros in a slot without an image.
RHW_API void rhw_image_size(const struct rhw_bindings *textures, int slot, rhw_int size[3]);

#endif

#endif
