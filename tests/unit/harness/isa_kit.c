// SPDX-License-Identifier: MIT
// The lanes, vectors and memory of the kit; see isa_kit.h. This file is compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "isa_kit.h"

static const float matrix[16] = {1.5f, -2, 0.25f, 3, 0.1f, 7, -0.5f, 2, 0.75f, 9, -4, 0.3f, 1, -6, 0.125f, 5};
static const int32_t integers[5] = {3, -1, 2147483647, -2147483647 - 1, 77};

static rhw_int bits(rhw_float a)
{
    return rhw_bits_from_float(a);
}

static int32_t bits1(float a)
{
    return rhw_bits_from_float1(a);
}

static float from_mask(bool mask)
{
    return rhw_float_from_bits1(-(int32_t)mask);
}

static void less_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_less(a[0], a[1]));
}

static void less_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_less1(a[0], a[1]));
}

static void less_equal_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_less_equal(a[0], a[1]));
}

static void less_equal_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_less_equal1(a[0], a[1]));
}

static void equal_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_equal(a[0], a[1]));
}

static void equal_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_equal1(a[0], a[1]));
}

static void greater_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_greater(a[0], a[1]));
}

static void greater_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_greater1(a[0], a[1]));
}

static void greater_equal_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_greater_equal(a[0], a[1]));
}

static void greater_equal_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_greater_equal1(a[0], a[1]));
}

static void not_equal_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_not_equal(a[0], a[1]));
}

static void not_equal_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_not_equal1(a[0], a[1]));
}

static void less_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_less_int(bits(a[0]), bits(a[1])));
}

static void less_int_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_less_int1(bits1(a[0]), bits1(a[1])));
}

static void equal_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_equal_int(bits(a[0]), bits(a[1])));
}

static void equal_int_one(const float *a, float *r)
{
    r[0] = from_mask(rhw_equal_int1(bits1(a[0]), bits1(a[1])));
}

static void select_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_select(rhw_less(a[0], a[1]), a[2], a[3]);
}

static void select_one(const float *a, float *r)
{
    r[0] = rhw_select1(rhw_less1(a[0], a[1]), a[2], a[3]);
}

static void select_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_select_int(rhw_less(a[0], a[1]), bits(a[2]), bits(a[3])));
}

static void select_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_select_int1(rhw_less1(a[0], a[1]), bits1(a[2]), bits1(a[3])));
}

static void min_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_min(a[0], a[1]);
}

static void min_one(const float *a, float *r)
{
    r[0] = rhw_min1(a[0], a[1]);
}

static void max_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_max(a[0], a[1]);
}

static void max_one(const float *a, float *r)
{
    r[0] = rhw_max1(a[0], a[1]);
}

static void min_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_min_int(bits(a[0]), bits(a[1])));
}

static void min_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_min_int1(bits1(a[0]), bits1(a[1])));
}

static void max_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_max_int(bits(a[0]), bits(a[1])));
}

static void max_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_max_int1(bits1(a[0]), bits1(a[1])));
}

static void clamp_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_clamp(a[0], a[1], a[2]);
}

static void clamp_one(const float *a, float *r)
{
    r[0] = rhw_clamp1(a[0], a[1], a[2]);
}

static void saturate_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_saturate(a[0]);
}

static void saturate_one(const float *a, float *r)
{
    r[0] = rhw_saturate1(a[0]);
}

static void bits_from_float_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_int(rhw_bits_from_float(a[0]));
}

static void bits_from_float_one(const float *a, float *r)
{
    r[0] = rhw_float_from_int1(rhw_bits_from_float1(a[0]));
}

static void float_from_bits_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_splat_int(1) + (bits(a[0]) & 0xffff));
}

static void float_from_bits_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(1 + (bits1(a[0]) & 0xffff));
}

static void float_from_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_int(bits(a[0]));
}

static void float_from_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_int1(bits1(a[0]));
}

static void int_from_float_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_int_from_float(a[0]));
}

static void int_from_float_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_int_from_float1(a[0]));
}

static void int_from_float_unchecked_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_int_from_float_unchecked(rhw_clamp(a[0], -1e9f, 1e9f)));
}

static void int_from_float_unchecked_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_int_from_float_unchecked1(rhw_clamp1(a[0], -1e9f, 1e9f)));
}

static void abs_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_abs(a[0]);
}

static void abs_one(const float *a, float *r)
{
    r[0] = rhw_abs1(a[0]);
}

static void copysign_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_copysign(a[0], a[1]);
}

static void copysign_one(const float *a, float *r)
{
    r[0] = rhw_copysign1(a[0], a[1]);
}

static void sign_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_sign(a[0]);
}

static void sign_one(const float *a, float *r)
{
    r[0] = rhw_sign1(a[0]);
}

static void trunc_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_trunc(a[0]);
}

static void trunc_one(const float *a, float *r)
{
    r[0] = rhw_trunc1(a[0]);
}

static void floor_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_floor(a[0]);
}

static void floor_one(const float *a, float *r)
{
    r[0] = rhw_floor1(a[0]);
}

static void ceil_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_ceil(a[0]);
}

static void ceil_one(const float *a, float *r)
{
    r[0] = rhw_ceil1(a[0]);
}

static void round_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_round(a[0]);
}

static void round_one(const float *a, float *r)
{
    r[0] = rhw_round1(a[0]);
}

static void fract_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_fract(a[0]);
}

static void fract_one(const float *a, float *r)
{
    r[0] = rhw_fract1(a[0]);
}

static void mix_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_mix(a[0], a[1], a[2]);
}

static void mix_one(const float *a, float *r)
{
    r[0] = rhw_mix1(a[0], a[1], a[2]);
}

static void smoothstep_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_smoothstep(a[0], a[1], a[2]);
}

static void smoothstep_one(const float *a, float *r)
{
    r[0] = rhw_smoothstep1(a[0], a[1], a[2]);
}

static void sqrt_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_sqrt(a[0]);
}

static void sqrt_one(const float *a, float *r)
{
    r[0] = rhw_sqrt1(a[0]);
}

static void rsqrt_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_rsqrt(a[0]);
}

static void rsqrt_one(const float *a, float *r)
{
    r[0] = rhw_rsqrt1(a[0]);
}

static void dot2_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_dot2(a, a + 4);
}

static void dot2_one(const float *a, float *r)
{
    r[0] = rhw_dot2_1(a, a + 4);
}

static void length2_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_length2(a);
}

static void length2_one(const float *a, float *r)
{
    r[0] = rhw_length2_1(a);
}

static void normalize2_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_normalize2(a, r);
}

static void normalize2_one(const float *a, float *r)
{
    rhw_normalize2_1(a, r);
}

static void dot3_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_dot3(a, a + 4);
}

static void dot3_one(const float *a, float *r)
{
    r[0] = rhw_dot3_1(a, a + 4);
}

static void length3_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_length3(a);
}

static void length3_one(const float *a, float *r)
{
    r[0] = rhw_length3_1(a);
}

static void normalize3_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_normalize3(a, r);
}

static void normalize3_one(const float *a, float *r)
{
    rhw_normalize3_1(a, r);
}

static void dot4_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_dot4(a, a + 4);
}

static void dot4_one(const float *a, float *r)
{
    r[0] = rhw_dot4_1(a, a + 4);
}

static void length4_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_length4(a);
}

static void length4_one(const float *a, float *r)
{
    r[0] = rhw_length4_1(a);
}

static void normalize4_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_normalize4(a, r);
}

static void normalize4_one(const float *a, float *r)
{
    rhw_normalize4_1(a, r);
}

static void cross_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_cross(a, a + 3, r);
}

static void cross_one(const float *a, float *r)
{
    rhw_cross1(a, a + 3, r);
}

static void reflect2_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_reflect2(a, a + 3, r);
}

static void reflect2_one(const float *a, float *r)
{
    rhw_reflect2_1(a, a + 3, r);
}

static void reflect3_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_reflect3(a, a + 3, r);
}

static void reflect3_one(const float *a, float *r)
{
    rhw_reflect3_1(a, a + 3, r);
}

static void mat4_mul_vec4_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_mat4_mul_vec4(matrix, a, r);
}

static void mat4_mul_vec4_one(const float *a, float *r)
{
    rhw_mat4_mul_vec4_1(matrix, a, r);
}

static void mat4_mul_point_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_mat4_mul_point(matrix, a, r);
}

static void mat4_mul_point_one(const float *a, float *r)
{
    rhw_mat4_mul_point1(matrix, a, r);
}

static void mat4_mul_direction_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_mat4_mul_direction(matrix, a, r);
}

static void mat4_mul_direction_one(const float *a, float *r)
{
    rhw_mat4_mul_direction1(matrix, a, r);
}

static void mat3_mul_vec3_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_mat3_mul_vec3(matrix, a, r);
}

static void mat3_mul_vec3_one(const float *a, float *r)
{
    rhw_mat3_mul_vec3_1(matrix, a, r);
}

static void gather_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_gather(matrix, 16, rhw_int_from_float(a[0]));
}

static void gather_one(const float *a, float *r)
{
    r[0] = rhw_gather1(matrix, 16, rhw_int_from_float1(a[0]));
}

static void gather_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_int(rhw_gather_int(integers, 5, rhw_int_from_float(a[0])));
}

static void gather_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_int1(rhw_gather_int1(integers, 5, rhw_int_from_float1(a[0])));
}

static const struct kit_function functions[] = {
    {"less", less_lanes, less_one},
    {"less_equal", less_equal_lanes, less_equal_one},
    {"equal", equal_lanes, equal_one},
    {"greater", greater_lanes, greater_one},
    {"greater_equal", greater_equal_lanes, greater_equal_one},
    {"not_equal", not_equal_lanes, not_equal_one},
    {"less_int", less_int_lanes, less_int_one},
    {"equal_int", equal_int_lanes, equal_int_one},
    {"select", select_lanes, select_one},
    {"select_int", select_int_lanes, select_int_one},
    {"min", min_lanes, min_one},
    {"max", max_lanes, max_one},
    {"min_int", min_int_lanes, min_int_one},
    {"max_int", max_int_lanes, max_int_one},
    {"clamp", clamp_lanes, clamp_one},
    {"saturate", saturate_lanes, saturate_one},
    {"bits_from_float", bits_from_float_lanes, bits_from_float_one},
    {"float_from_bits", float_from_bits_lanes, float_from_bits_one},
    {"float_from_int", float_from_int_lanes, float_from_int_one},
    {"int_from_float", int_from_float_lanes, int_from_float_one},
    {"int_from_float_unchecked", int_from_float_unchecked_lanes, int_from_float_unchecked_one},
    {"abs", abs_lanes, abs_one},
    {"copysign", copysign_lanes, copysign_one},
    {"sign", sign_lanes, sign_one},
    {"trunc", trunc_lanes, trunc_one},
    {"floor", floor_lanes, floor_one},
    {"ceil", ceil_lanes, ceil_one},
    {"round", round_lanes, round_one},
    {"fract", fract_lanes, fract_one},
    {"mix", mix_lanes, mix_one},
    {"smoothstep", smoothstep_lanes, smoothstep_one},
    {"sqrt", sqrt_lanes, sqrt_one},
    {"rsqrt", rsqrt_lanes, rsqrt_one},
    {"dot2", dot2_lanes, dot2_one},
    {"length2", length2_lanes, length2_one},
    {"normalize2", normalize2_lanes, normalize2_one},
    {"dot3", dot3_lanes, dot3_one},
    {"length3", length3_lanes, length3_one},
    {"normalize3", normalize3_lanes, normalize3_one},
    {"dot4", dot4_lanes, dot4_one},
    {"length4", length4_lanes, length4_one},
    {"normalize4", normalize4_lanes, normalize4_one},
    {"cross", cross_lanes, cross_one},
    {"reflect2", reflect2_lanes, reflect2_one},
    {"reflect3", reflect3_lanes, reflect3_one},
    {"mat4_mul_vec4", mat4_mul_vec4_lanes, mat4_mul_vec4_one},
    {"mat4_mul_point", mat4_mul_point_lanes, mat4_mul_point_one},
    {"mat4_mul_direction", mat4_mul_direction_lanes, mat4_mul_direction_one},
    {"mat3_mul_vec3", mat3_mul_vec3_lanes, mat3_mul_vec3_one},
    {"gather", gather_lanes, gather_one},
    {"gather_int", gather_int_lanes, gather_int_one},
};

const struct kit_table RHW_ISA_NAME(kit_lanes_table) = {sizeof functions / sizeof functions[0], functions};
