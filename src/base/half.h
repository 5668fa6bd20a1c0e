// SPDX-License-Identifier: MIT
// Conversion between IEEE 754 binary16 and binary32. It gives bit for bit what F16C instructions give: it rounds to
// nearest, ties to even; NaN keeps its sign and the upper bits of its payload and becomes quiet.
#ifndef RHW_HALF_H
#define RHW_HALF_H

#include <stdint.h>
#include <string.h>

static inline float rhw_half_to_float(uint16_t half)
{
    const uint32_t sign = (uint32_t)(half & 0x8000) << 16;
    const uint32_t magnitude = half & 0x7fff;
    uint32_t bits;
    if (magnitude >= 0x7c00) { // infinity or NaN
        bits = 0x7f800000 | (magnitude & 0x3ff) << 13 | (magnitude > 0x7c00 ? 0x400000 : 0);
    } else if (magnitude >= 0x400) {
        bits = (magnitude << 13) + ((127 - 15) << 23);
    } else { // denormal or zero: magnitude · 2^-24, exact
        const float value = (float)magnitude * 0x1p-24f;
        memcpy(&bits, &value, sizeof bits);
    }
    bits |= sign;
    float result;
    memcpy(&result, &bits, sizeof result);
    return result;
}

static inline uint16_t rhw_half_from_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000;
    const uint32_t magnitude = bits & 0x7fffffff;
    uint32_t half;
    if (magnitude > 0x7f800000) {
        half = 0x7e00 | (magnitude >> 13 & 0x3ff);
    } else if (magnitude >= 0x477ff000) { // 65520, halfway from the largest half to 2^16, and above
        half = 0x7c00;
    } else if (magnitude >= 0x38800000) { // 2^-14, the smallest normal half
        // Add half of the last kept place less one, and that place's own bit, so that ties go to even. A carry out of
        // the significand raises the exponent, as it should.
        half = (magnitude - (112u << 23) + 0xfff + (magnitude >> 13 & 1)) >> 13;
    } else {
        // 0.5 has units of 2^-24 in its last place, as denormal halves have.
        float shifted;
        memcpy(&shifted, &magnitude, sizeof shifted);
        shifted += 0.5f;
        memcpy(&half, &shifted, sizeof half);
        half -= 0x3f000000;
    }
    return (uint16_t)(sign | half);
}

#endif
