// SPDX-License-Identifier: MIT
// What a translated shader does to 8 lanes where that is more than a function of shader.h: resources of a struct
// rhw_shader_frame, words of buffers, and the operations of SPIR-V on integers. Shaders that rhw_shader_program_emit_c
// writes as C include this header, and the interpreter of rhw-shader calls the same functions, so both give the same
// bits. A program that writes shaders by hand has no need of it.
#ifndef RHW_SHADER_SPIRV_H
#define RHW_SHADER_SPIRV_H

#include "rhw.h"
#include "shader.h"
#include "shader_subgroup.h"
#include "spirv.h"

RHW_QUIET_BEGIN

// Resources ------------------------------------------------------------------------------------------

/// Return element `element` of a binding of `count` elements that begins at place `first` of a set, or NULL where the
/// set is NULL or the binding has no such element.
static inline const struct rhw_binding *rhw_spirv_element(const struct rhw_shader_frame *frame, uint32_t set,
                                                          uint32_t first, uint32_t count, uint32_t element)
{
    const struct rhw_binding *const bindings = frame->sets[set];
    return bindings && element < count ? bindings + first + element : (const struct rhw_binding *)0;
}

/// Return a texture with a sampler, put together in `pair`, or NULL where one of them is missing.
static inline const struct rhw_binding *rhw_spirv_pair(const struct rhw_binding *texture,
                                                       const struct rhw_binding *sampler,
                                                       struct rhw_binding *pair)
{
    return texture && sampler && rhw_binding_of_pair(texture, sampler, pair) ? pair
                                                                             : (const struct rhw_binding *)0;
}

/// Words of 32 bits that a shader reads. `words` is NULL where there are none.
struct rhw_spirv_words {
    const uint32_t *words;
    uint32_t count;
};

/// Return the words of a buffer.
static inline struct rhw_spirv_words rhw_spirv_words_of(const struct rhw_binding *binding)
{
    struct rhw_spirv_words words;
    words.words = rhw_binding_storage_words(binding, &words.count);
    return words;
}

/// Return the bytes of a buffer as OpArrayLength takes them: whole words.
static inline int32_t rhw_spirv_bytes(struct rhw_spirv_words words)
{
    return (int32_t)(words.count > UINT32_MAX / 4 ? UINT32_MAX & ~3u : 4 * words.count);
}

/// Return a word, or 0 where there is none. Others may write it at the same time.
static inline int32_t rhw_spirv_word(struct rhw_spirv_words words, uint32_t index)
{
    return index < words.count ? (int32_t)__atomic_load_n(&words.words[index], __ATOMIC_RELAXED) : 0;
}

/// Return a word of the push constants. Bytes that they do not have are 0.
static inline int32_t rhw_spirv_push_word(const struct rhw_shader_frame *frame, uint32_t index)
{
    int32_t value = 0;
    if (index <= UINT32_MAX / 4 && 4 * index < frame->push_size) {
        const uint32_t left = frame->push_size - 4 * index;
        memcpy(&value, (const unsigned char *)frame->push_constants + 4 * (size_t)index,
               left < sizeof value ? left : sizeof value);
    }
    return value;
}

/// Return true, now and then, if the work is given up that a loop belongs to (rhw_work_is_given_up). *rounds counts.
static inline bool rhw_spirv_is_given_up(uint32_t *rounds, const struct rhw_bindings *bindings)
{
    return ++*rounds % 256 == 0 && rhw_work_is_given_up(bindings);
}

#if RHW_HAS_LANES

/// Return the mask of a < b for unsigned integers.
static inline rhw_int rhw_spirv_less_uint(rhw_int a, rhw_int b)
{
    const rhw_int sign = rhw_splat_int(INT32_MIN);
    return rhw_less_int(a ^ sign, b ^ sign);
}

/// Return the word at a place in bytes, lane by lane.
static inline rhw_int rhw_spirv_index(rhw_int offset, uint32_t more)
{
    return (rhw_int)(((rhw_uint)offset + more) >> 2);
}

/// Return a word of the push constants for each lane.
static inline rhw_int rhw_spirv_push(const struct rhw_shader_frame *frame, rhw_int index)
{
    rhw_int value = rhw_splat_int(0);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        value[lane] = rhw_spirv_push_word(frame, (uint32_t)index[lane]);
    }
    return value;
}

/// Return a word for each lane of `inside`, whose words there are, and 0 in other lanes. Indices are below 2^31. Lanes
/// mostly read one word, or a row of them, which spares a gather. Words are read whole, whoever writes them.
static inline rhw_int rhw_spirv_pick(const uint32_t *words, rhw_int index, rhw_int inside)
{
#if defined(__AVX2__)
    const rhw_int row = {0, 1, 2, 3, 4, 5, 6, 7};
    const rhw_int from_first = (rhw_int)((rhw_uint)index - (uint32_t)index[0]);
    if (!rhw_any(inside)) {
        return rhw_splat_int(0);
    }
    if (rhw_mask_bits(rhw_equal_int(from_first, row)) == 0xff) {
        return (rhw_int)_mm256_maskload_epi32((const int *)words + index[0], (__m256i)inside);
    }
    if (rhw_mask_bits(rhw_equal_int(from_first, rhw_splat_int(0))) == 0xff) {
        return rhw_splat_int((int32_t)__atomic_load_n(&words[index[0]], __ATOMIC_RELAXED)) & inside;
    }
    return (rhw_int)_mm256_mask_i32gather_epi32(_mm256_setzero_si256(), (const int *)words, (__m256i)index,
                                                (__m256i)inside, 4);
#else
    rhw_int value = rhw_splat_int(0);
    for (unsigned left = (unsigned)rhw_mask_bits(inside); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        value[lane] = (int32_t)__atomic_load_n(&words[(uint32_t)index[lane]], __ATOMIC_RELAXED);
    }
    return value;
#endif
}

/// Return a word for each lane of `mask`, and 0 in other lanes. Others may write the words at the same time.
static inline rhw_int rhw_spirv_load(struct rhw_spirv_words words, rhw_int index, rhw_int mask)
{
    const rhw_int inside = rhw_spirv_less_uint(index, rhw_splat_int((int32_t)words.count)) & mask;
    if (words.count <= INT32_MAX) {
        return rhw_spirv_pick(words.words, index, inside);
    }
    rhw_int value = rhw_splat_int(0);
    for (unsigned left = (unsigned)rhw_mask_bits(inside); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        value[lane] = (int32_t)__atomic_load_n(&words.words[(uint32_t)index[lane]], __ATOMIC_RELAXED);
    }
    return value;
}

/// Return a word for each lane, of words that nobody writes.
static inline rhw_int rhw_spirv_gather(struct rhw_spirv_words words, rhw_int index)
{
    return rhw_spirv_load(words, index, rhw_splat_int(-1));
}

/// Write a word for each lane of `mask` to memory of a workgroup, which one thread works on.
static inline void rhw_spirv_share(void *shared, uint32_t size, rhw_int index, rhw_int value, rhw_int mask)
{
    const rhw_int inside = rhw_spirv_less_uint(index, rhw_splat_int((int32_t)(size / 4))) & mask;
    for (unsigned left = (unsigned)rhw_mask_bits(inside); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        ((int32_t *)shared)[(uint32_t)index[lane]] = value[lane];
    }
}

/// Write the lowest `bits` bits, 8 or 16, of a value for each lane of `mask`, at a place in bytes. What else the word
/// has stays, whoever writes it at the same time.
static inline void rhw_spirv_store_part(const struct rhw_binding *binding, rhw_int offset, uint32_t more,
                                        rhw_int value, int bits, rhw_int mask)
{
    for (unsigned left = (unsigned)rhw_mask_bits(mask); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const uint32_t byte = (uint32_t)offset[lane] + more, shift = 8 * (byte & 3);
        const uint32_t part = ((1u << bits) - 1) << shift;
        rhw_binding_storage_atomic1(binding, RHW_STORAGE_AND, byte >> 2, (int32_t)~part);
        rhw_binding_storage_atomic1(binding, RHW_STORAGE_OR, byte >> 2,
                                    (int32_t)((uint32_t)value[lane] << shift & part));
    }
}

/// Return a word for each lane of memory that the lanes have for themselves, or 0 where there is none.
static inline rhw_int rhw_spirv_own(const rhw_int *own, uint32_t count, rhw_int index)
{
    rhw_int value = rhw_splat_int(0);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const uint32_t word = (uint32_t)index[lane];
        value[lane] = word < count ? own[word][lane] : 0;
    }
    return value;
}

/// Return the word that all lanes name.
static inline rhw_int rhw_spirv_own_alike(const rhw_int *own, uint32_t count, uint32_t index)
{
    return index < count ? own[index] : rhw_splat_int(0);
}

/// Write a word for each lane of `mask`.
static inline void rhw_spirv_own_store(rhw_int *own, uint32_t count, rhw_int index, rhw_int value,
                                       rhw_int mask)
{
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const uint32_t word = (uint32_t)index[lane];
        if (mask[lane] && word < count) {
            own[word][lane] = value[lane];
        }
    }
}

/// Write the word that all lanes name, in the lanes of `mask`.
static inline void rhw_spirv_own_store_alike(rhw_int *own, uint32_t count, uint32_t index, rhw_int value,
                                             rhw_int mask)
{
    if (index < count) {
        own[index] = rhw_select_int(mask, value, own[index]);
    }
}

/// Return a constant for each lane, or 0 where there is none.
static inline rhw_int rhw_spirv_table(const int32_t *table, uint32_t count, rhw_int index)
{
    rhw_int value = rhw_splat_int(0);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const uint32_t word = (uint32_t)index[lane];
        value[lane] = word < count ? table[word] : 0;
    }
    return value;
}

/// Return the constant that all lanes name.
static inline rhw_int rhw_spirv_table_alike(const int32_t *table, uint32_t count, uint32_t index)
{
    return rhw_splat_int(index < count ? table[index] : 0);
}

/// Change the words at `index` by an operation, in the lanes of `mask`. Return the words as they were before.
static inline rhw_int rhw_spirv_atomic(const struct rhw_binding *binding,
                                       enum rhw_storage_operation operation, rhw_int index, rhw_int value,
                                       rhw_int comparand, rhw_int mask)
{
    const struct rhw_storage_request request = {operation, &mask, &index, &value, &comparand};
    rhw_int before;
    rhw_binding_storage_access(binding, &request, &before);
    return before;
}

// Arithmetic -----------------------------------------------------------------------------------------

/// Return a + b, which wraps.
static inline rhw_int rhw_spirv_add(rhw_int a, rhw_int b)
{
    return (rhw_int)((rhw_uint)a + (rhw_uint)b);
}

/// Return a − b, which wraps.
static inline rhw_int rhw_spirv_sub(rhw_int a, rhw_int b)
{
    return (rhw_int)((rhw_uint)a - (rhw_uint)b);
}

/// Return a · b, which wraps.
static inline rhw_int rhw_spirv_mul(rhw_int a, rhw_int b)
{
    return (rhw_int)((rhw_uint)a * (rhw_uint)b);
}

/// Return the upper 32 bits of the product of signed integers.
static inline rhw_int rhw_spirv_mul_high(rhw_int a, rhw_int b)
{
    rhw_int result = rhw_splat_int(0);
    for (int i = 0; i < RHW_LANES; i++) {
        result[i] = (int32_t)((uint64_t)((int64_t)a[i] * b[i]) >> 32);
    }
    return result;
}

/// Return the upper 32 bits of the product of unsigned integers.
static inline rhw_int rhw_spirv_mul_high_uint(rhw_int a, rhw_int b)
{
    rhw_int result = rhw_splat_int(0);
    for (int i = 0; i < RHW_LANES; i++) {
        result[i] = (int32_t)((uint64_t)(uint32_t)a[i] * (uint32_t)b[i] >> 32);
    }
    return result;
}

/// Return a shifted to the left by the lower 5 bits of b.
static inline rhw_int rhw_spirv_shift_left(rhw_int a, rhw_int b)
{
    return (rhw_int)((rhw_uint)a << (rhw_uint)(b & 31));
}

/// Return a shifted to the right by the lower 5 bits of b, with zeros from the left.
static inline rhw_int rhw_spirv_shift_right(rhw_int a, rhw_int b)
{
    return (rhw_int)((rhw_uint)a >> (rhw_uint)(b & 31));
}

/// Return a shifted to the right by the lower 5 bits of b, with its sign from the left.
static inline rhw_int rhw_spirv_shift_right_signed(rhw_int a, rhw_int b)
{
    return a >> (b & 31);
}

/// Return the float nearest to an unsigned integer, ties to even.
static inline rhw_float rhw_spirv_float_from_uint(rhw_int a)
{
    rhw_float result = rhw_splat(0.0f);
    for (int i = 0; i < RHW_LANES; i++) {
        result[i] = (float)(uint32_t)a[i];
    }
    return result;
}

/// Return a truncated towards zero. Numbers from 2^32 on give 2^32 − 1, negative numbers and NaN give 0.
static inline rhw_int rhw_spirv_uint_from_float(rhw_float a)
{
    rhw_int result = rhw_splat_int(0);
    for (int i = 0; i < RHW_LANES; i++) {
        result[i] = !(a[i] > 0.0f) ? 0 : a[i] >= 4294967296.0f ? -1 : (int32_t)(uint32_t)a[i];
    }
    return result;
}

/// Return two halves in one integer, the first in its lower bits.
static inline rhw_int rhw_spirv_pack_halves(rhw_float low, rhw_float high)
{
    const rhw_float v[2] = {low, high};
    return rhw_pack_half2x16(v);
}

/// Return the half in the lower 16 bits.
static inline rhw_float rhw_spirv_low_half(rhw_int a)
{
    return rhw_float_from_half_bits(a & 0xffff);
}

/// Return the half in the upper 16 bits.
static inline rhw_float rhw_spirv_high_half(rhw_int a)
{
    return rhw_float_from_half_bits((rhw_int)((rhw_uint)a >> 16));
}

/// Return the fraction of rhw_frexp.
static inline rhw_float rhw_spirv_fraction(rhw_float a)
{
    rhw_int exponent;
    return rhw_frexp(a, &exponent);
}

/// Return the exponent of rhw_frexp.
static inline rhw_int rhw_spirv_exponent(rhw_float a)
{
    rhw_int exponent;
    (void)rhw_frexp(a, &exponent);
    return exponent;
}

// Inputs ---------------------------------------------------------------------------------------------

/// Return a varying at the partner pixel of derivatives: (x ^ 1, y) for axis 0, and (x, y ^ 1) for axis 1. `w` is that
/// of rhw_interpolate_at.
static inline rhw_float rhw_spirv_partner(const struct rhw_fragment *fragment, int component, int w, int axis)
{
    const rhw_int odd = rhw_int_from_float(fragment->coord[axis]) & 1;
    rhw_float offset[2];
    offset[1 - axis] = rhw_splat(0.0f);
    offset[axis] = rhw_float_from_int(1 - 2 * odd);
    return rhw_interpolate_at(fragment, component, w, offset);
}

/// Return a varying at an offset of pixels to the right and down. `w` is that of rhw_interpolate_at.
static inline rhw_float rhw_spirv_input_at(const struct rhw_fragment *fragment, int component, int w,
                                           rhw_float x, rhw_float y)
{
    rhw_float offset[2];
    offset[0] = x;
    offset[1] = y;
    return rhw_interpolate_at(fragment, component, w, offset);
}

/// Return how many pixels a sample lies from the centre: to the right for axis 0, down for axis 1. A sample that the
/// pass does not have lies at the centre.
static inline rhw_float rhw_spirv_sample_place(const struct rhw_shader_frame *frame, rhw_int number, int axis)
{
    rhw_float place = rhw_splat(0.0f);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        float position[2];
        (void)rhw_sample_position((int)frame->samples, number[lane], position);
        place[lane] = position[axis] - 0.5f;
    }
    return place;
}

// Images ---------------------------------------------------------------------------------------------

/// Return a count in the place of a texel's component, as bits.
static inline rhw_float rhw_spirv_count(int count)
{
    return rhw_float_from_bits(rhw_splat_int(count));
}

/// Set the first 3 components of `texel` to the bits of rhw_binding_sample_size.
static inline void rhw_spirv_size(const struct rhw_binding *binding, const rhw_int *level, rhw_float texel[4])
{
    rhw_int size[3] = {rhw_splat_int(0), rhw_splat_int(0), rhw_splat_int(0)};
    rhw_binding_sample_size(binding, level, size);
    for (int i = 0; i < 3; i++) {
        texel[i] = rhw_float_from_bits(size[i]);
    }
}

/// Set the first 3 components of `texel` to the bits of rhw_binding_image_size.
static inline void rhw_spirv_image_size(const struct rhw_binding *binding, rhw_float texel[4])
{
    rhw_int size[3] = {rhw_splat_int(0), rhw_splat_int(0), rhw_splat_int(0)};
    rhw_binding_image_size(binding, size);
    for (int i = 0; i < 3; i++) {
        texel[i] = rhw_float_from_bits(size[i]);
    }
}

/// Return the bias of a request, raised as far as the level of detail is below the least that is asked for.
static inline rhw_float rhw_spirv_raised_bias(const struct rhw_binding *binding,
                                              const struct rhw_sample_request *request, rhw_float least)
{
    rhw_float lod[2];
    rhw_binding_sample_query_lod(binding, request, lod);
    const rhw_float bias = request->bias ? *request->bias : rhw_splat(0.0f);
    const rhw_int is_below = rhw_less(lod[0], least);
    return bias + rhw_select(is_below, rhw_max(least - lod[1], rhw_splat(0.0f)), rhw_splat(0.0f));
}

/// Return the first component of what rhw_binding_sample_fetch gives of a plane. Numbers outside of it pick no texel.
static inline rhw_float rhw_spirv_fetch_first(const struct rhw_texel_plane *plane, rhw_int x, rhw_int y)
{
    const rhw_int inside = rhw_spirv_less_uint(x, rhw_splat_int(plane->width)) &
                           rhw_spirv_less_uint(y, rhw_splat_int(plane->height));
    const rhw_int number = (rhw_int)((rhw_uint)y * (uint32_t)plane->pitch + (rhw_uint)x);
#if defined(__AVX2__)
    return (rhw_float)_mm256_mask_i32gather_ps(_mm256_setzero_ps(), plane->texels, (__m256i)number,
                                               (__m256)inside, 4);
#else
    return rhw_gather(plane->texels, plane->pitch * plane->height, number | ~inside);
#endif
}

/// Fetch from level 0 of a 2D texture, which lies in a plane if that has texels.
static inline void rhw_spirv_fetch(const struct rhw_binding *binding, const struct rhw_texel_plane *plane,
                                   const rhw_int at[4], rhw_float texel[4])
{
    if (plane->texels) {
        texel[0] = rhw_spirv_fetch_first(plane, at[0], at[1]);
        texel[1] = texel[2] = rhw_splat(0.0f);
        texel[3] = rhw_splat(1.0f);
    } else {
        rhw_binding_sample_fetch(binding, at, (const rhw_int *)0, texel);
    }
}

/// Put a binding into a table, or one that holds nothing where it is NULL.
static inline void rhw_spirv_list(const struct rhw_binding *binding, struct rhw_binding *entry)
{
    static const struct rhw_binding empty = {{0, 0, 0, 0, 0, 0, 0, 0}};
    *entry = binding ? *binding : empty;
}

/// Sample bindings of a table, whose bits `which` has, at the varyings `at` and `at` + 1 of all groups, with the
/// derivatives of these: table[n] of group g into texels[g * stride + n].
static inline void rhw_spirv_sample_groups(const struct rhw_binding *table, const struct rhw_fragment *groups,
                                           int count, uint32_t which, int at, rhw_float (*texels)[4],
                                           int stride)
{
    uint32_t plain = 0;
    for (uint32_t todo = which; todo != 0; todo &= todo - 1) {
        plain |= rhw_binding_sample_is_2d(&table[__builtin_ctz(todo)]) ? todo & -todo : 0;
    }
    if (plain != 0) {
        rhw_binding_sample_groups(table, groups, count, plain, at, texels, stride);
    }
    for (uint32_t todo = which & ~plain; todo != 0; todo &= todo - 1) {
        const int n = __builtin_ctz(todo);
        for (int g = 0; g < count; g++) {
            const rhw_float *const varying = &groups[g].varying[at], *const ddx = &groups[g].ddx[at],
                                   *const ddy = &groups[g].ddy[at], zero = rhw_splat(0.0f);
            const rhw_float coordinates[4] = {varying[0], varying[1], zero, zero};
            const rhw_float gradient[6] = {ddx[0], ddx[1], ddy[0], ddy[1], zero, zero};
            rhw_binding_sample_grad(&table[n], coordinates, gradient, texels[g * stride + n]);
        }
    }
}

/// Sample at a level of detail that is at least `least`.
static inline void rhw_spirv_sample_above(const struct rhw_binding *binding,
                                          const struct rhw_sample_request *request, rhw_float least,
                                          rhw_float texel[4])
{
    const rhw_float bias = rhw_spirv_raised_bias(binding, request, least);
    struct rhw_sample_request raised = *request;
    raised.bias = &bias;
    rhw_binding_sample(binding, &raised, texel);
}

/// Change texels by an operation, in the lanes of `mask`. Return the texels as they were before.
static inline rhw_int rhw_spirv_image_atomic(const struct rhw_binding *binding,
                                             enum rhw_storage_operation operation, const rhw_int *at,
                                             rhw_int value, rhw_int comparand, rhw_int mask)
{
    const struct rhw_storage_request request = {operation, &mask, at, &value, &comparand};
    rhw_int before;
    rhw_binding_image_atomic(binding, &request, &before);
    return before;
}

/// Take what was sampled for some lanes.
static inline void rhw_spirv_take(rhw_int lanes, const rhw_float texel[4], rhw_float texels[4])
{
    for (int c = 0; c < 4; c++) {
        texels[c] = rhw_select(lanes, texel[c], texels[c]);
    }
}

// Lanes of several groups ----------------------------------------------------------------------------

/// Return true if a mask is −1 in a lane of some group.
static inline bool rhw_spirv_any(const rhw_int *masks, int count)
{
    rhw_int any = rhw_splat_int(0);
    for (int g = 0; g < count; g++) {
        any |= masks[g];
    }
    return rhw_any(any);
}

/// Return the first of `count` groups that has a lane in its mask, or `count`.
static inline int rhw_spirv_first(const rhw_int *masks, int count)
{
    int first = 0;
    while (first < count && !rhw_any(masks[first])) {
        first++;
    }
    return first;
}

#endif

RHW_QUIET_END

#endif
