// SPDX-License-Identifier: MIT
// The functions of shader_integer.h and shader_pack.h; see isa_kit.h. This file is compiled with RHW_ISA_SUFFIX =
// baseline, avx2, ...
#include "isa_kit.h"

static rhw_int bits(rhw_float a)
{
    return rhw_bits_from_float(a);
}

static int32_t bits1(float a)
{
    return rhw_bits_from_float1(a);
}

// Small integers of both signs, and those that are special as divisors, of any input.
static rhw_int small(rhw_float a)
{
    return (bits(a) >> 8 & 0x1ff) - 256;
}

static int32_t small1(float a)
{
    return (bits1(a) >> 8 & 0x1ff) - 256;
}

static void divide_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_divide_int(bits(a[0]), bits(a[1])));
    r[1] = rhw_float_from_bits(rhw_divide_int(bits(a[2]), small(a[3])));
}

static void divide_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_divide_int1(bits1(a[0]), bits1(a[1])));
    r[1] = rhw_float_from_bits1(rhw_divide_int1(bits1(a[2]), small1(a[3])));
}

static void remainder_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_remainder_int(bits(a[0]), bits(a[1])));
    r[1] = rhw_float_from_bits(rhw_remainder_int(bits(a[2]), small(a[3])));
}

static void remainder_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_remainder_int1(bits1(a[0]), bits1(a[1])));
    r[1] = rhw_float_from_bits1(rhw_remainder_int1(bits1(a[2]), small1(a[3])));
}

static void divide_uint_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_divide_uint(bits(a[0]), bits(a[1])));
    r[1] = rhw_float_from_bits(rhw_divide_uint(bits(a[2]), small(a[3])));
}

static void divide_uint_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_divide_uint1(bits1(a[0]), bits1(a[1])));
    r[1] = rhw_float_from_bits1(rhw_divide_uint1(bits1(a[2]), small1(a[3])));
}

static void remainder_uint_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_remainder_uint(bits(a[0]), bits(a[1])));
    r[1] = rhw_float_from_bits(rhw_remainder_uint(bits(a[2]), small(a[3])));
}

static void remainder_uint_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_remainder_uint1(bits1(a[0]), bits1(a[1])));
    r[1] = rhw_float_from_bits1(rhw_remainder_uint1(bits1(a[2]), small1(a[3])));
}

static void bit_count_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_bit_count(bits(a[0])));
}

static void bit_count_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_bit_count1(bits1(a[0])));
}

static void bit_reverse_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_bit_reverse(bits(a[0])));
}

static void bit_reverse_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_bit_reverse1(bits1(a[0])));
}

static void find_lsb_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_find_lsb(bits(a[0])));
}

static void find_lsb_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_find_lsb1(bits1(a[0])));
}

static void find_msb_uint_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_find_msb_uint(bits(a[0])));
}

static void find_msb_uint_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_find_msb_uint1(bits1(a[0])));
}

static void find_msb_int_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_find_msb_int(bits(a[0])));
}

static void find_msb_int_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_find_msb_int1(bits1(a[0])));
}

static void half_bits_from_float_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_half_bits_from_float(a[0]));
}

static void half_bits_from_float_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_half_bits_from_float1(a[0]));
}

static void float_from_half_bits_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_half_bits(bits(a[0]));
}

static void float_from_half_bits_one(const float *a, float *r)
{
    r[0] = rhw_float_from_half_bits1(bits1(a[0]));
}

static void ldexp_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_ldexp(a[0], bits(a[1]));
    r[1] = rhw_ldexp(a[2], small(a[3]));
}

static void ldexp_one(const float *a, float *r)
{
    r[0] = rhw_ldexp1(a[0], bits1(a[1]));
    r[1] = rhw_ldexp1(a[2], small1(a[3]));
}

static void frexp_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_int exponent;
    r[0] = rhw_frexp(a[0], &exponent);
    r[1] = rhw_float_from_bits(exponent);
}

static void frexp_one(const float *a, float *r)
{
    int32_t exponent;
    r[0] = rhw_frexp1(a[0], &exponent);
    r[1] = rhw_float_from_bits1(exponent);
}

static void modf_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_modf(a[0], &r[1]);
}

static void modf_one(const float *a, float *r)
{
    r[0] = rhw_modf1(a[0], &r[1]);
}

static void pack_unorm4x8_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_pack_unorm4x8(a));
}

static void pack_unorm4x8_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_pack_unorm4x8_1(a));
}

static void unpack_unorm4x8_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_unpack_unorm4x8(bits(a[0]), r);
}

static void unpack_unorm4x8_one(const float *a, float *r)
{
    rhw_unpack_unorm4x8_1(bits1(a[0]), r);
}

static void pack_snorm4x8_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_pack_snorm4x8(a));
}

static void pack_snorm4x8_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_pack_snorm4x8_1(a));
}

static void unpack_snorm4x8_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_unpack_snorm4x8(bits(a[0]), r);
}

static void unpack_snorm4x8_one(const float *a, float *r)
{
    rhw_unpack_snorm4x8_1(bits1(a[0]), r);
}

static void pack_unorm2x16_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_pack_unorm2x16(a));
}

static void pack_unorm2x16_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_pack_unorm2x16_1(a));
}

static void unpack_unorm2x16_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_unpack_unorm2x16(bits(a[0]), r);
}

static void unpack_unorm2x16_one(const float *a, float *r)
{
    rhw_unpack_unorm2x16_1(bits1(a[0]), r);
}

static void pack_snorm2x16_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_pack_snorm2x16(a));
}

static void pack_snorm2x16_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_pack_snorm2x16_1(a));
}

static void unpack_snorm2x16_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_unpack_snorm2x16(bits(a[0]), r);
}

static void unpack_snorm2x16_one(const float *a, float *r)
{
    rhw_unpack_snorm2x16_1(bits1(a[0]), r);
}

static void pack_half2x16_lanes(const rhw_float *a, rhw_float *r)
{
    r[0] = rhw_float_from_bits(rhw_pack_half2x16(a));
}

static void pack_half2x16_one(const float *a, float *r)
{
    r[0] = rhw_float_from_bits1(rhw_pack_half2x16_1(a));
}

static void unpack_half2x16_lanes(const rhw_float *a, rhw_float *r)
{
    rhw_unpack_half2x16(bits(a[0]), r);
}

static void unpack_half2x16_one(const float *a, float *r)
{
    rhw_unpack_half2x16_1(bits1(a[0]), r);
}

static const struct kit_function functions[] = {
    {"divide_int", divide_int_lanes, divide_int_one},
    {"remainder_int", remainder_int_lanes, remainder_int_one},
    {"divide_uint", divide_uint_lanes, divide_uint_one},
    {"remainder_uint", remainder_uint_lanes, remainder_uint_one},
    {"bit_count", bit_count_lanes, bit_count_one},
    {"bit_reverse", bit_reverse_lanes, bit_reverse_one},
    {"find_lsb", find_lsb_lanes, find_lsb_one},
    {"find_msb_uint", find_msb_uint_lanes, find_msb_uint_one},
    {"find_msb_int", find_msb_int_lanes, find_msb_int_one},
    {"half_bits_from_float", half_bits_from_float_lanes, half_bits_from_float_one},
    {"float_from_half_bits", float_from_half_bits_lanes, float_from_half_bits_one},
    {"ldexp", ldexp_lanes, ldexp_one},
    {"frexp", frexp_lanes, frexp_one},
    {"modf", modf_lanes, modf_one},
    {"pack_unorm4x8", pack_unorm4x8_lanes, pack_unorm4x8_one},
    {"unpack_unorm4x8", unpack_unorm4x8_lanes, unpack_unorm4x8_one},
    {"pack_snorm4x8", pack_snorm4x8_lanes, pack_snorm4x8_one},
    {"unpack_snorm4x8", unpack_snorm4x8_lanes, unpack_snorm4x8_one},
    {"pack_unorm2x16", pack_unorm2x16_lanes, pack_unorm2x16_one},
    {"unpack_unorm2x16", unpack_unorm2x16_lanes, unpack_unorm2x16_one},
    {"pack_snorm2x16", pack_snorm2x16_lanes, pack_snorm2x16_one},
    {"unpack_snorm2x16", unpack_snorm2x16_lanes, unpack_snorm2x16_one},
    {"pack_half2x16", pack_half2x16_lanes, pack_half2x16_one},
    {"unpack_half2x16", unpack_half2x16_lanes, unpack_half2x16_one},
};

const struct kit_table RHW_ISA_NAME(kit_bits_table) = {sizeof functions / sizeof functions[0], functions};
