// SPDX-License-Identifier: MIT
// Numbers of 8 and 16 bits, and the numbers of 32 bits that stand for them.
#include "module.h"

#include <string.h>

static float as_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t as_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

uint32_t shader_float_from_half(uint32_t bits)
{
    const uint32_t sign = (bits & 0x8000) << 16, exponent = bits >> 10 & 0x1f, fraction = bits & 0x3ff;
    if (exponent == 0) {
        return sign | as_bits((float)fraction * 0x1p-24f);
    }
    return sign | ((exponent == 0x1f ? 0xffu : exponent + 112) << 23) | (fraction << 13);
}

uint32_t shader_half_from_float(uint32_t bits)
{
    const uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7fffffff;
    if (magnitude > 0x7f800000) {
        return sign | 0x7e00; // not a number
    }
    if (magnitude >= 0x477ff000) { // 65520 and above are nearer to 65536, which is no half
        return sign | 0x7c00;
    }
    if (magnitude < 0x38800000) { // below 2⁻¹⁴ the last place is 2⁻²⁴
        return sign | (as_bits(as_float(magnitude) + 0.5f) - as_bits(0.5f));
    }
    const uint32_t odd = magnitude >> 13 & 1;
    return sign | (((magnitude + 0xfff + odd) >> 13) - (112u << 10));
}

uint32_t shader_extend(const struct shader_type *type, uint32_t bits)
{
    if (type->kind == SHADER_FLOAT) {
        return type->bits == 16 ? shader_float_from_half(bits & 0xffff) : bits;
    }
    if (type->kind != SHADER_INT || type->bits == 32) {
        return bits;
    }
    const int shift = 32 - type->bits;
    const uint32_t upper = bits << shift;
    return type->is_signed ? (uint32_t)((int32_t)upper >> shift) : upper >> shift;
}
