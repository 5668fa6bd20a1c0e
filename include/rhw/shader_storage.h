// SPDX-License-Identifier: MIT
// Shader functions read, write and change storage with these functions: 32-bit words of storage buffers, and texels of
// storage images and texel buffers. shader.h includes this header.
//
// A write, or a change by an atomic, is an effect. A program declares that its functions have effects: RHW_USE_EFFECTS
// for the fragment function, vertex_effects for the vertex function. docs/shaders.md says how often the library calls
// functions with effects, in which order, and which effects give the same bytes on every run.
#ifndef RHW_SHADER_STORAGE_H
#define RHW_SHADER_STORAGE_H

#include "base.h"
#include "shader_vector.h"

struct rhw_bindings;

// Buffers -------------------------------------------------------------------------------------------

/// An operation on a word. LOAD and STORE read and write whole words. All others are atomic: each is one step, which
/// others see before it or after it. An atomic is no fence for other words (Vulkan 1.3, memory model: relaxed, with the
/// scope of the device).
enum rhw_storage_operation {
    RHW_STORAGE_LOAD,
    RHW_STORAGE_STORE,
    RHW_STORAGE_ADD, ///< add integers; the sum wraps
    RHW_STORAGE_MIN, ///< take the lesser of two signed integers
    RHW_STORAGE_MAX, ///< take the greater of two signed integers
    RHW_STORAGE_MIN_UNSIGNED,
    RHW_STORAGE_MAX_UNSIGNED,
    RHW_STORAGE_AND,
    RHW_STORAGE_OR,
    RHW_STORAGE_XOR,
    RHW_STORAGE_EXCHANGE,
    RHW_STORAGE_COMPARE_EXCHANGE, ///< write the value if the word equals `comparand`
    RHW_STORAGE_OPERATION_COUNT
};

/// Do an operation on one word, as one lane of rhw_storage_access. Return the word as it was before, or 0 if there is
/// no such word.
RHW_API int32_t rhw_storage_access1(const struct rhw_bindings *bindings, int slot,
                                    enum rhw_storage_operation operation, uint32_t index, int32_t value,
                                    int32_t comparand);
/// Return the number of whole words in the slot's range, or 0 if no buffer is bound.
RHW_API uint32_t rhw_storage_count(const struct rhw_bindings *bindings, int slot);

RHW_QUIET_BEGIN

#if RHW_HAS_LANES

/// A request says what 8 lanes do to a storage buffer. Zero the struct, then set the members that the operation reads.
/// The request and what it points to are read during the call.
struct rhw_storage_request {
    enum rhw_storage_operation operation;
    const rhw_int *mask;      ///< lanes that do it, mostly the group's mask; NULL means all lanes
    const rhw_int *index;     ///< number of the word in the slot's range, unsigned
    const rhw_int *value;     ///< operand of all operations but LOAD
    const rhw_int *comparand; ///< operand of COMPARE_EXCHANGE
};

/// Do the operation of a request on the buffer in storage slot `slot`, 0..RHW_MAX_STORAGE_BUFFERS − 1. `bindings` is
/// the member of the group that the shader function received. Lanes take their turn from the first to the last.
/// `before`, which may be NULL, is set to the words as they were before, with 0 in lanes that do nothing. A word
/// outside of the range, or in a slot without a buffer, reads as 0 and is not written (robustBufferAccess2).
RHW_API void rhw_storage_access(const struct rhw_bindings *bindings, int slot,
                                const struct rhw_storage_request *request, rhw_int *before);

/// Return the words at `index` in the lanes of `mask`, and 0 in other lanes.
static inline rhw_int rhw_storage_load(const struct rhw_bindings *bindings, int slot, rhw_int index,
                                       rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_LOAD, &mask, &index, (const rhw_int *)0,
                                                (const rhw_int *)0};
    rhw_int before;
    rhw_storage_access(bindings, slot, &request, &before);
    return before;
}

/// Write `value` at `index` in the lanes of `mask`. If several lanes have the same index, the word keeps the value of
/// the last of these lanes.
static inline void rhw_storage_store(const struct rhw_bindings *bindings, int slot, rhw_int index,
                                     rhw_int value, rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_STORE, &mask, &index, &value, (const rhw_int *)0};
    rhw_storage_access(bindings, slot, &request, (rhw_int *)0);
}

/// Change the words at `index` by an operation other than COMPARE_EXCHANGE, in the lanes of `mask`. Return the words as
/// they were before.
static inline rhw_int rhw_storage_atomic(const struct rhw_bindings *bindings, int slot,
                                         enum rhw_storage_operation operation, rhw_int index, rhw_int value,
                                         rhw_int mask)
{
    const struct rhw_storage_request request = {operation, &mask, &index, &value, (const rhw_int *)0};
    rhw_int before;
    rhw_storage_access(bindings, slot, &request, &before);
    return before;
}

/// Write `value` at `index` if the word there equals `comparand`, in the lanes of `mask`. Return the words as they were
/// before.
static inline rhw_int rhw_storage_compare_exchange(const struct rhw_bindings *bindings, int slot,
                                                   rhw_int index, rhw_int comparand, rhw_int value,
                                                   rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_COMPARE_EXCHANGE, &mask, &index, &value,
                                                &comparand};
    rhw_int before;
    rhw_storage_access(bindings, slot, &request, &before);
    return before;
}

#endif

static inline int32_t rhw_storage_load1(const struct rhw_bindings *bindings, int slot, uint32_t index)
{
    return rhw_storage_access1(bindings, slot, RHW_STORAGE_LOAD, index, 0, 0);
}

static inline void rhw_storage_store1(const struct rhw_bindings *bindings, int slot, uint32_t index,
                                      int32_t value)
{
    rhw_storage_access1(bindings, slot, RHW_STORAGE_STORE, index, value, 0);
}

static inline int32_t rhw_storage_atomic1(const struct rhw_bindings *bindings, int slot,
                                          enum rhw_storage_operation operation, uint32_t index, int32_t value)
{
    return rhw_storage_access1(bindings, slot, operation, index, value, 0);
}

static inline int32_t rhw_storage_compare_exchange1(const struct rhw_bindings *bindings, int slot,
                                                    uint32_t index, int32_t comparand, int32_t value)
{
    return rhw_storage_access1(bindings, slot, RHW_STORAGE_COMPARE_EXCHANGE, index, value, comparand);
}

RHW_QUIET_END

// Images --------------------------------------------------------------------------------------------

/// Read a texel, as one lane of rhw_image_load.
RHW_API void rhw_image_load1(const struct rhw_bindings *bindings, int slot, const int32_t *at,
                             float texel[4]);

/// Write a texel, as one lane of rhw_image_store.
RHW_API void rhw_image_store1(const struct rhw_bindings *bindings, int slot, const int32_t *at,
                              const float texel[4]);

/// Change a texel, as one lane of rhw_image_atomic. Return the texel as it was before.
RHW_API int32_t rhw_image_atomic1(const struct rhw_bindings *bindings, int slot,
                                  enum rhw_storage_operation operation, const int32_t *at, int32_t value,
                                  int32_t comparand);

/// Read the size of an image, as one lane of rhw_image_size.
RHW_API void rhw_image_size1(const struct rhw_bindings *bindings, int slot, int32_t size[3]);

#if RHW_HAS_LANES

/// Read the texel at `at` from image slot `slot`, 0..RHW_MAX_STORAGE_IMAGES − 1. `bindings` is the member of the group
/// that the shader function received. `at` has x, y and z as far as the kind of texture has them, and the layer of an
/// array. For a cube it has x, y and 6 × cube + face, for a texel buffer x. The texel is decoded as by
/// rhw_sample_fetch; integer formats give their bits. A texel outside of the image is 0 in the channels that the format
/// has. Channels that the format lacks are 0, 0, 0, 1; the 1 is an integer in integer formats. All channels are so in a
/// slot without an image (robustImageAccess2).
RHW_API void rhw_image_load(const struct rhw_bindings *bindings, int slot, const rhw_int *at,
                            rhw_float texel[4]);

/// Write the texels of the lanes of `mask`, from the first lane to the last. A `mask` of NULL means all lanes. The
/// texel is encoded as a colour target encodes it. Lanes outside of the image write nothing. A texel of several words
/// is not written in one step.
RHW_API void rhw_image_store(const struct rhw_bindings *bindings, int slot, const rhw_int *at,
                             const rhw_int *mask, const rhw_float texel[4]);

/// Do the operation of a request on texels of the formats R32_UINT and R32_SINT, or LOAD, STORE and EXCHANGE on those
/// of R32_FLOAT. request->index points to the coordinates that `at` is in the other functions. `before`, which may be
/// NULL, is set to the texels as they were before. It is 0 outside of the image and for other formats and operations,
/// whose texels stay as they are.
RHW_API void rhw_image_atomic(const struct rhw_bindings *bindings, int slot,
                              const struct rhw_storage_request *request, rhw_int *before);

/// Set `size` to the width, the height and the number of slices or layers of the level that is set; a cube has six
/// layers. Dimensions that the kind of texture lacks are 1. All are 0 in a slot without an image.
RHW_API void rhw_image_size(const struct rhw_bindings *bindings, int slot, rhw_int size[3]);

#endif

#endif
