// SPDX-License-Identifier: MIT
// Shader functions read and write memory with these functions: 8 values in a row, and 8 values from anywhere in a
// table. shader.h includes this header.
#ifndef RHW_SHADER_MEMORY_H
#define RHW_SHADER_MEMORY_H

#include "shader_vector.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

// In a row ------------------------------------------------------------------------------------------

/// Return 8 values that stand one after the other. No alignment is asked.
static inline rhw_float rhw_load(const float *values)
{
    rhw_float lanes;
    memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

/// Return 8 integers that stand one after the other. No alignment is asked.
static inline rhw_int rhw_load_int(const int32_t *values)
{
    rhw_int lanes;
    memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

/// Write 8 values one after the other. Dead lanes are written too, so there must be room for all 8. No alignment is
/// asked.
static inline void rhw_store(float *values, rhw_float lanes)
{
    memcpy(values, &lanes, sizeof lanes);
}

/// Write 8 integers one after the other. Dead lanes are written too, so there must be room for all 8. No alignment is
/// asked.
static inline void rhw_store_int(int32_t *values, rhw_int lanes)
{
    memcpy(values, &lanes, sizeof lanes);
}

// From anywhere -------------------------------------------------------------------------------------
// A table has `count` values, for example in the uniforms or behind `user`. An index outside of the table reads 0, as
// with robustBufferAccess2 of Vulkan. So dead lanes may have any index, and −1 may stand for no entry. `table` may be
// NULL if count is 0. An array of structs is a table of members: the index of a member is index * (size / 4) + member.

/// Return table[index] lane by lane, or 0 where index is below 0 or not below `count`.
static inline rhw_float rhw_gather(const float *table, int32_t count, rhw_int index)
{
    const rhw_int inside = ~rhw_less_int(index, rhw_splat_int(0)) & rhw_less_int(index, rhw_splat_int(count));
#if defined(__AVX2__)
    return (rhw_float)_mm256_mask_i32gather_ps(_mm256_setzero_ps(), table, (__m256i)index, (__m256)inside, 4);
#else
    rhw_float lanes = rhw_splat(0.0f);
    for (int i = 0; i < RHW_LANES; i++) {
        if (inside[i]) {
            lanes[i] = table[index[i]];
        }
    }
    return lanes;
#endif
}

/// Return table[index] of integers lane by lane, or 0 where index is below 0 or not below `count`.
static inline rhw_int rhw_gather_int(const int32_t *table, int32_t count, rhw_int index)
{
    const rhw_int inside = ~rhw_less_int(index, rhw_splat_int(0)) & rhw_less_int(index, rhw_splat_int(count));
#if defined(__AVX2__)
    return (rhw_int)_mm256_mask_i32gather_epi32(_mm256_setzero_si256(), table, (__m256i)index,
                                                (__m256i)inside, 4);
#else
    rhw_int lanes = rhw_splat_int(0);
    for (int i = 0; i < RHW_LANES; i++) {
        if (inside[i]) {
            lanes[i] = table[index[i]];
        }
    }
    return lanes;
#endif
}

RHW_QUIET_END

#endif

#endif
