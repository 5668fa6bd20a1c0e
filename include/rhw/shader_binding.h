// SPDX-License-Identifier: MIT
// Shader functions sample and fetch textures, and read and write storage, through bindings in memory (bind.h) with
// these functions. Each does for a binding what the function without `binding` in its name does for a slot, with the
// same bits. shader.h includes this header.
//
// `binding` may be NULL, empty or of another kind than the function is for. The function then does what it does for a
// slot that has nothing. Any thread may call these functions, as far as others do not write what they read; nothing of
// them is checked by validation. A write is an effect (shader_storage.h).
#ifndef RHW_SHADER_BINDING_H
#define RHW_SHADER_BINDING_H

#include "bind.h"
#include "shader_no_lanes.h"
#include "shader_sample.h"
#include "shader_storage.h"

/// Return the number of mip levels of the binding's texture, or 0 without one.
RHW_API int rhw_binding_sample_levels(const struct rhw_binding *binding);

/// Return the number of samples in a texel of the binding's texture, or 0 without one.
RHW_API int rhw_binding_sample_samples(const struct rhw_binding *binding);

/// Texels of one float each: texel (x, y) is texels[y * pitch + x].
struct rhw_texel_plane {
    const float *texels; ///< NULL: there are none
    int32_t width, height, pitch;
};

/// Return the texels of level 0 of a 2D texture whose format is R32_FLOAT or D32_FLOAT, as shadow maps have, that a
/// shader may read by itself: rhw_binding_sample_fetch gives them as the first component. Return none for other
/// textures and for views in another order of channels.
RHW_API struct rhw_texel_plane rhw_binding_sample_plane(const struct rhw_binding *binding);

/// Return true if a sample of the binding reads a 2D texture without layers. Return false where there is nothing to
/// sample, or no sampler.
RHW_API bool rhw_binding_sample_is_2d(const struct rhw_binding *binding);

/// Return true if what a texture gives by a sampler may depend on the gradient, level or bias of a request. If not, all
/// of these give the same bits, and a shader may spare them: one level is read, by one filter, without anisotropy. The
/// sampler's binding may be that of the texture. Return false where one of them is missing.
RHW_API bool rhw_binding_sample_needs_gradient(const struct rhw_binding *texture,
                                               const struct rhw_binding *sampler);

/// Return the number of whole words of the binding's bytes, or 0 without any.
RHW_API uint32_t rhw_binding_storage_count(const struct rhw_binding *binding);

/// Return the words of the binding's bytes, for reading, and set *count to their number. Without any, return NULL.
/// Where functions on other threads write the words, they are read by relaxed atomics, as rhw_binding_storage_load
/// does.
RHW_API const uint32_t *rhw_binding_storage_words(const struct rhw_binding *binding, uint32_t *count);

RHW_QUIET_BEGIN

#if RHW_HAS_LANES

// Lanes ----------------------------------------------------------------------------------------------

/// Take the next binding of those that lanes name by `index`. Return the index of the first lane of `*todo`, set
/// `*lanes` to the lanes of `*todo` that have this index, and clear them in `*todo`. Where lanes name bindings of their
/// own, a loop samples one binding after the other:
///
///     for (rhw_int todo = group->mask, lanes; rhw_any(todo);) {
///         const int32_t i = rhw_binding_next(index, &todo, &lanes);
///         rhw_binding_sample_lod(&table[i], uv, lod, texel);
///         ... rhw_select(lanes, texel[c], result[c]) ...
///     }
///
/// `*todo` has a lane. The program looks whether its table has the index.
static inline int32_t rhw_binding_next(rhw_int index, rhw_int *todo, rhw_int *lanes)
{
    const int bits = rhw_mask_bits(*todo);
    int first = 0;
    while (first < RHW_LANES - 1 && (bits >> first & 1) == 0) {
        first++;
    }
    const int32_t named = index[first];
    *lanes = rhw_equal_int(index, rhw_splat_int(named)) & *todo;
    *todo &= ~*lanes;
    return named;
}

/// Do what rhw_sample does.
RHW_API void rhw_binding_sample(const struct rhw_binding *binding, const struct rhw_sample_request *request,
                                rhw_float texel[4]);

/// Do what rhw_sample_gather does.
RHW_API void rhw_binding_sample_gather(const struct rhw_binding *binding,
                                       const struct rhw_sample_request *request, int channel,
                                       rhw_float texel[4]);

/// Do what rhw_sample_fetch does.
RHW_API void rhw_binding_sample_fetch(const struct rhw_binding *binding, const rhw_int *at,
                                      const rhw_int *level, rhw_float texel[4]);

/// Do what rhw_sample_fetch_sample does.
RHW_API void rhw_binding_sample_fetch_sample(const struct rhw_binding *binding, const rhw_int *at,
                                             const rhw_int *sample, rhw_float texel[4]);

/// Do what rhw_sample_query_lod does.
RHW_API void rhw_binding_sample_query_lod(const struct rhw_binding *binding,
                                          const struct rhw_sample_request *request, rhw_float lod[2]);

/// Do what rhw_sample_size does.
RHW_API void rhw_binding_sample_size(const struct rhw_binding *binding, const rhw_int *level,
                                     rhw_int size[3]);

/// Do what rhw_sample_compare_window does.
RHW_API void rhw_binding_sample_compare_window(const struct rhw_binding *binding,
                                               const struct rhw_sample_request *request, int columns,
                                               int rows, rhw_float *parts);

/// Sample several bindings for all `count` groups of one call of a fragment function, as rhw_sample_groups does: bit n
/// of `which` samples table[n] of group g into texels[g * stride + n].
RHW_API void rhw_binding_sample_groups(const struct rhw_binding *table, const struct rhw_fragment *groups,
                                       int count, uint32_t which, int at, rhw_float (*texels)[4], int stride);

/// Do what rhw_storage_access does.
RHW_API void rhw_binding_storage_access(const struct rhw_binding *binding,
                                        const struct rhw_storage_request *request, rhw_int *before);

/// Do what rhw_image_load does.
RHW_API void rhw_binding_image_load(const struct rhw_binding *binding, const rhw_int *at, rhw_float texel[4]);

/// Do what rhw_image_store does.
RHW_API void rhw_binding_image_store(const struct rhw_binding *binding, const rhw_int *at,
                                     const rhw_int *mask, const rhw_float texel[4]);

/// Do what rhw_image_atomic does.
RHW_API void rhw_binding_image_atomic(const struct rhw_binding *binding,
                                      const struct rhw_storage_request *request, rhw_int *before);

/// Do what rhw_image_size does.
RHW_API void rhw_binding_image_size(const struct rhw_binding *binding, rhw_int size[3]);

/// Do what rhw_sample_grad does.
static inline void rhw_binding_sample_grad(const struct rhw_binding *binding, const rhw_float *coordinates,
                                           const rhw_float *grad, rhw_float texel[4])
{
    const struct rhw_sample_request request = {coordinates,          grad,
                                               (const rhw_float *)0, (const rhw_float *)0,
                                               (const rhw_int *)0,   (const rhw_float *)0};
    rhw_binding_sample(binding, &request, texel);
}

/// Do what rhw_sample_lod does.
static inline void rhw_binding_sample_lod(const struct rhw_binding *binding, const rhw_float *coordinates,
                                          rhw_float lod, rhw_float texel[4])
{
    const struct rhw_sample_request request = {
        coordinates,          (const rhw_float *)0, &lod,
        (const rhw_float *)0, (const rhw_int *)0,   (const rhw_float *)0};
    rhw_binding_sample(binding, &request, texel);
}

/// Do what rhw_sample_bias does.
static inline void rhw_binding_sample_bias(const struct rhw_binding *binding, const rhw_float *coordinates,
                                           const rhw_float *grad, rhw_float bias, rhw_float texel[4])
{
    const struct rhw_sample_request request = {
        coordinates, grad, (const rhw_float *)0, (const rhw_float *)0, (const rhw_int *)0, &bias};
    rhw_binding_sample(binding, &request, texel);
}

/// Do what rhw_sample_compare_grad does.
static inline rhw_float rhw_binding_sample_compare_grad(const struct rhw_binding *binding,
                                                        const rhw_float *coordinates, rhw_float reference,
                                                        const rhw_float *grad)
{
    const struct rhw_sample_request request = {
        coordinates, grad, (const rhw_float *)0, &reference, (const rhw_int *)0, (const rhw_float *)0};
    rhw_float texel[4];
    rhw_binding_sample(binding, &request, texel);
    return texel[0];
}

/// Do what rhw_sample_compare_lod does.
static inline rhw_float rhw_binding_sample_compare_lod(const struct rhw_binding *binding,
                                                       const rhw_float *coordinates, rhw_float reference,
                                                       rhw_float lod)
{
    const struct rhw_sample_request request = {coordinates, (const rhw_float *)0, &lod,
                                               &reference,  (const rhw_int *)0,   (const rhw_float *)0};
    rhw_float texel[4];
    rhw_binding_sample(binding, &request, texel);
    return texel[0];
}

/// Do what rhw_storage_load does.
static inline rhw_int rhw_binding_storage_load(const struct rhw_binding *binding, rhw_int index, rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_LOAD, &mask, &index, (const rhw_int *)0,
                                                (const rhw_int *)0};
    rhw_int before;
    rhw_binding_storage_access(binding, &request, &before);
    return before;
}

/// Do what rhw_storage_store does.
static inline void rhw_binding_storage_store(const struct rhw_binding *binding, rhw_int index, rhw_int value,
                                             rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_STORE, &mask, &index, &value, (const rhw_int *)0};
    rhw_binding_storage_access(binding, &request, (rhw_int *)0);
}

/// Do what rhw_storage_atomic does.
static inline rhw_int rhw_binding_storage_atomic(const struct rhw_binding *binding,
                                                 enum rhw_storage_operation operation, rhw_int index,
                                                 rhw_int value, rhw_int mask)
{
    const struct rhw_storage_request request = {operation, &mask, &index, &value, (const rhw_int *)0};
    rhw_int before;
    rhw_binding_storage_access(binding, &request, &before);
    return before;
}

/// Do what rhw_storage_compare_exchange does.
static inline rhw_int rhw_binding_storage_compare_exchange(const struct rhw_binding *binding, rhw_int index,
                                                           rhw_int comparand, rhw_int value, rhw_int mask)
{
    const struct rhw_storage_request request = {RHW_STORAGE_COMPARE_EXCHANGE, &mask, &index, &value,
                                                &comparand};
    rhw_int before;
    rhw_binding_storage_access(binding, &request, &before);
    return before;
}

#endif

// One at a time --------------------------------------------------------------------------------------

/// Do what rhw_sample1 does.
RHW_API void rhw_binding_sample1(const struct rhw_binding *binding, const struct rhw_sample_request1 *request,
                                 float texel[4]);

/// Do what rhw_sample_gather1 does.
RHW_API void rhw_binding_sample_gather1(const struct rhw_binding *binding,
                                        const struct rhw_sample_request1 *request, int channel,
                                        float texel[4]);

/// Do what rhw_sample_fetch1 does.
RHW_API void rhw_binding_sample_fetch1(const struct rhw_binding *binding, const int32_t *at, int32_t level,
                                       float texel[4]);

/// Do what rhw_sample_fetch_sample1 does.
RHW_API void rhw_binding_sample_fetch_sample1(const struct rhw_binding *binding, const int32_t *at,
                                              int32_t sample, float texel[4]);

/// Do what rhw_sample_query_lod1 does.
RHW_API void rhw_binding_sample_query_lod1(const struct rhw_binding *binding,
                                           const struct rhw_sample_request1 *request, float lod[2]);

/// Do what rhw_sample_size1 does.
RHW_API void rhw_binding_sample_size1(const struct rhw_binding *binding, int32_t level, int32_t size[3]);

/// Do what rhw_sample_compare_window1 does.
RHW_API void rhw_binding_sample_compare_window1(const struct rhw_binding *binding,
                                                const struct rhw_sample_request1 *request, int columns,
                                                int rows, float *parts);

/// Do what rhw_storage_access1 does.
RHW_API int32_t rhw_binding_storage_access1(const struct rhw_binding *binding,
                                            enum rhw_storage_operation operation, uint32_t index,
                                            int32_t value, int32_t comparand);

/// Do what rhw_image_load1 does.
RHW_API void rhw_binding_image_load1(const struct rhw_binding *binding, const int32_t *at, float texel[4]);

/// Do what rhw_image_store1 does.
RHW_API void rhw_binding_image_store1(const struct rhw_binding *binding, const int32_t *at,
                                      const float texel[4]);

/// Do what rhw_image_atomic1 does.
RHW_API int32_t rhw_binding_image_atomic1(const struct rhw_binding *binding,
                                          enum rhw_storage_operation operation, const int32_t *at,
                                          int32_t value, int32_t comparand);

/// Do what rhw_image_size1 does.
RHW_API void rhw_binding_image_size1(const struct rhw_binding *binding, int32_t size[3]);

/// Do what rhw_sample_grad1 does.
static inline void rhw_binding_sample_grad1(const struct rhw_binding *binding, const float *coordinates,
                                            const float *grad, float texel[4])
{
    const struct rhw_sample_request1 request = {
        coordinates, grad, (const float *)0, (const float *)0, (const int32_t *)0, (const float *)0};
    rhw_binding_sample1(binding, &request, texel);
}

/// Do what rhw_sample_lod1 does.
static inline void rhw_binding_sample_lod1(const struct rhw_binding *binding, const float *coordinates,
                                           float lod, float texel[4])
{
    const struct rhw_sample_request1 request = {coordinates,      (const float *)0,   &lod,
                                                (const float *)0, (const int32_t *)0, (const float *)0};
    rhw_binding_sample1(binding, &request, texel);
}

/// Do what rhw_sample_bias1 does.
static inline void rhw_binding_sample_bias1(const struct rhw_binding *binding, const float *coordinates,
                                            const float *grad, float bias, float texel[4])
{
    const struct rhw_sample_request1 request = {coordinates,        grad, (const float *)0, (const float *)0,
                                                (const int32_t *)0, &bias};
    rhw_binding_sample1(binding, &request, texel);
}

/// Do what rhw_sample_compare_grad1 does.
static inline float rhw_binding_sample_compare_grad1(const struct rhw_binding *binding,
                                                     const float *coordinates, float reference,
                                                     const float *grad)
{
    const struct rhw_sample_request1 request = {
        coordinates, grad, (const float *)0, &reference, (const int32_t *)0, (const float *)0};
    float texel[4];
    rhw_binding_sample1(binding, &request, texel);
    return texel[0];
}

/// Do what rhw_sample_compare_lod1 does.
static inline float rhw_binding_sample_compare_lod1(const struct rhw_binding *binding,
                                                    const float *coordinates, float reference, float lod)
{
    const struct rhw_sample_request1 request = {coordinates, (const float *)0,   &lod,
                                                &reference,  (const int32_t *)0, (const float *)0};
    float texel[4];
    rhw_binding_sample1(binding, &request, texel);
    return texel[0];
}

/// Do what rhw_storage_load1 does.
static inline int32_t rhw_binding_storage_load1(const struct rhw_binding *binding, uint32_t index)
{
    return rhw_binding_storage_access1(binding, RHW_STORAGE_LOAD, index, 0, 0);
}

/// Do what rhw_storage_store1 does.
static inline void rhw_binding_storage_store1(const struct rhw_binding *binding, uint32_t index,
                                              int32_t value)
{
    rhw_binding_storage_access1(binding, RHW_STORAGE_STORE, index, value, 0);
}

/// Do what rhw_storage_atomic1 does.
static inline int32_t rhw_binding_storage_atomic1(const struct rhw_binding *binding,
                                                  enum rhw_storage_operation operation, uint32_t index,
                                                  int32_t value)
{
    return rhw_binding_storage_access1(binding, operation, index, value, 0);
}

/// Do what rhw_storage_compare_exchange1 does.
static inline int32_t rhw_binding_storage_compare_exchange1(const struct rhw_binding *binding, uint32_t index,
                                                            int32_t comparand, int32_t value)
{
    return rhw_binding_storage_access1(binding, RHW_STORAGE_COMPARE_EXCHANGE, index, value, comparand);
}

RHW_QUIET_END

#endif
