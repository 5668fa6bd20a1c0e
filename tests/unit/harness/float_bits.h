// SPDX-License-Identifier: MIT
// These functions give the bits of a float as an unsigned number, and the float of such bits.
#ifndef TEST_FLOAT_BITS_H
#define TEST_FLOAT_BITS_H

#include <stdint.h>
#include <string.h>

static inline uint32_t to_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline float from_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
