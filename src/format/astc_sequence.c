// SPDX-License-Identifier: MIT
// A number of a sequence is its digit, a third (trit) or a fifth (quint) of the range, and `bits` low bits.
#include "astc_sequence.h"

struct range {
    uint8_t bits;
    uint8_t base; // 3: trits, 5: quints, 1: bits alone
};

static const struct range ranges[RHW_ASTC_RANGES] = {
    {1, 1}, {0, 3}, {2, 1}, {0, 5}, {1, 3}, {3, 1}, {1, 5}, {2, 3}, {4, 1}, {2, 5}, {3, 3},
    {5, 1}, {3, 5}, {4, 3}, {6, 1}, {4, 5}, {5, 3}, {7, 1}, {5, 5}, {6, 3}, {8, 1},
};

int rhw_astc_sequence_bits(int range, int count)
{
    const struct range *const r = &ranges[range];
    const int digits = r->base == 3 ? (8 * count + 4) / 5 : r->base == 5 ? (7 * count + 2) / 3 : 0;
    return digits + count * r->bits;
}

struct number {
    uint8_t digit, low;
};

static int bit(int value, int at)
{
    return value >> at & 1;
}

// Unpack five trits from 8 bits, lowest number first.
static void unpack_trits(int packed, struct number number[5])
{
    int low = packed & 0x1f;
    if ((packed & 0x1c) == 0x1c) {
        low = (packed >> 3 & 0x1c) | (packed & 3);
        number[4].digit = number[3].digit = 2;
    } else if ((packed & 0x60) == 0x60) {
        number[4].digit = 2;
        number[3].digit = (uint8_t)bit(packed, 7);
    } else {
        number[4].digit = (uint8_t)bit(packed, 7);
        number[3].digit = packed >> 5 & 3;
    }
    if ((low & 3) == 3) {
        number[2].digit = 2;
        number[1].digit = (uint8_t)bit(low, 4);
        number[0].digit = (uint8_t)(bit(low, 3) << 1 | (bit(low, 2) & ~bit(low, 3)));
    } else if ((low & 0xc) == 0xc) {
        number[2].digit = number[1].digit = 2;
        number[0].digit = low & 3;
    } else {
        number[2].digit = (uint8_t)bit(low, 4);
        number[1].digit = low >> 2 & 3;
        number[0].digit = (uint8_t)(bit(low, 1) << 1 | (bit(low, 0) & ~bit(low, 1)));
    }
}

// Unpack three quints from 7 bits.
static void unpack_quints(int packed, struct number number[3])
{
    if ((packed & 6) == 6 && (packed & 0x60) == 0) {
        const int low = bit(packed, 0);
        number[2].digit = (uint8_t)(low << 2 | (bit(packed, 4) & ~low) << 1 | (bit(packed, 3) & ~low));
        number[1].digit = number[0].digit = 4;
        return;
    }
    int low = packed & 0x1f;
    number[2].digit = packed >> 5 & 3;
    if ((packed & 6) == 6) {
        low = (packed & 0x18) | (~packed >> 4 & 6) | bit(packed, 0);
        number[2].digit = 4;
    }
    if ((low & 7) == 5) {
        number[1].digit = 4;
        number[0].digit = low >> 3 & 3;
    } else {
        number[1].digit = low >> 3 & 3;
        number[0].digit = low & 7;
    }
}

// Take the next numbers: 5 with trits, 3 with quints, else 1. Their packed digits stand between their low bits.
static int take_numbers(struct rhw_bit_stream *stream, const struct range *range, struct number number[5])
{
    static const uint8_t trit_bits[5] = {2, 2, 1, 2, 1}, quint_bits[3] = {3, 2, 2};
    const int count = range->base == 3 ? 5 : range->base == 5 ? 3 : 1;
    const uint8_t *const digit_bits = range->base == 3 ? trit_bits : quint_bits;
    int packed = 0, at = 0;
    for (int i = 0; i < count; i++) {
        number[i].digit = 0;
        number[i].low = (uint8_t)rhw_stream_take(stream, range->bits);
        if (range->base != 1) {
            packed |= rhw_stream_take(stream, digit_bits[i]) << at;
            at += digit_bits[i];
        }
    }
    if (range->base == 3) {
        unpack_trits(packed, number);
    } else if (range->base == 5) {
        unpack_quints(packed, number);
    }
    return count;
}

// Repeat `bits` up to `width`.
static int repeat(int value, int bits, int width)
{
    int result = 0;
    for (int at = width - bits; at > -bits; at -= bits) {
        result |= at >= 0 ? value << at : value >> -at;
    }
    return result;
}

// Return the column B of "ASTC color unquantization parameters": where the low bits without the lowest one, which are
// `high`, stand.
static int spread_color(const struct range *range, int high)
{
    if (range->base == 3) {
        switch (range->bits) {
        case 1: return 0;
        case 2: return 0x116 * high;
        case 3: return high << 7 | high << 2 | high;
        case 4: return high << 6 | high;
        case 5: return high << 5 | high >> 2;
        default: return high << 4 | high >> 4;
        }
    }
    switch (range->bits) {
    case 1: return 0;
    case 2: return 0x10c * high;
    case 3: return high << 7 | high << 1 | high >> 1;
    case 4: return high << 6 | high >> 1;
    default: return high << 5 | high >> 3;
    }
}

static uint8_t color_of(const struct range *range, const struct number *number)
{
    static const uint8_t trit_step[7] = {0, 204, 93, 44, 22, 11, 5}, quint_step[6] = {0, 113, 54, 26, 13, 6};
    if (range->base == 1) {
        return (uint8_t)repeat(number->low, range->bits, 8);
    }
    const int step = range->base == 3 ? trit_step[range->bits] : quint_step[range->bits];
    const int mask = number->low & 1 ? 0x1ff : 0;
    const int value = (number->digit * step + spread_color(range, number->low >> 1)) ^ mask;
    return (uint8_t)((mask & 0x80) | value >> 2);
}

// Return the column B of "ASTC weight unquantization parameters".
static int spread_weight(const struct range *range, int high)
{
    return range->bits == 1   ? 0
           : range->bits == 3 ? high << 5 | high
           : range->base == 3 ? 0x45 * high
                              : 0x42 * high;
}

static uint8_t weight_of(const struct range *range, const struct number *number)
{
    static const uint8_t trit_step[4] = {0, 50, 23, 11}, quint_step[3] = {0, 28, 13};
    static const uint8_t trits[3] = {0, 32, 63}, quints[5] = {0, 16, 32, 47, 63};
    int weight;
    if (range->base == 1) {
        weight = repeat(number->low, range->bits, 6);
    } else if (range->bits == 0) {
        weight = range->base == 3 ? trits[number->digit] : quints[number->digit];
    } else {
        const int step = range->base == 3 ? trit_step[range->bits] : quint_step[range->bits];
        const int mask = number->low & 1 ? 0x7f : 0;
        const int value = (number->digit * step + spread_weight(range, number->low >> 1)) ^ mask;
        weight = (mask & 0x20) | value >> 2;
    }
    return (uint8_t)(weight > 32 ? weight + 1 : weight);
}

void rhw_astc_take_colors(struct rhw_bit_stream stream, int range, int count, uint8_t *color)
{
    struct number number[5];
    for (int i = 0; i < count;) {
        const int taken = take_numbers(&stream, &ranges[range], number);
        for (int k = 0; k < taken && i < count; k++) {
            color[i++] = color_of(&ranges[range], &number[k]);
        }
    }
}

void rhw_astc_take_weights(struct rhw_bit_stream stream, int range, int count, uint8_t *weight)
{
    struct number number[5];
    for (int i = 0; i < count;) {
        const int taken = take_numbers(&stream, &ranges[range], number);
        for (int k = 0; k < taken && i < count; k++) {
            weight[i++] = weight_of(&ranges[range], &number[k]);
        }
    }
}
