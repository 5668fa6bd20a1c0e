// SPDX-License-Identifier: MIT
// Channels that are some bits of a word: the codec of every format that is neither bytes, halves nor floats. One piece
// of code reads from the format's row where each channel stands, and what its bits are.
#ifndef RHW_TEXEL_FIELDS_H
#define RHW_TEXEL_FIELDS_H

#include "format/format.h"
#include "base/simd_layout.h"

// Numbers -------------------------------------------------------------------------------------------

// Return steps / (2^bits − 1), correctly rounded, for whole steps of up to 16 bits times `unit`, a power of two. The
// divisor's reciprocal is 2^−bits and a rest, and the first product is exact. With one rounding or with two, the sum is
// right for all steps: test_codes_are_quotients tries them.
RHW_INLINE f32x8 unit_of_steps(f32x8 steps, int bits, float unit)
{
    const float part = 1.0f / (float)(1 << bits), rest = part / (float)((1 << bits) - 1);
    return f32x8_fused(steps, rhw_splat(rest / unit), steps * (part / unit));
}

// From 1.5 · 2^23, whose bits these are, to 2^24 floats have no fraction. Rounded numbers have them added.
static const int32_t shifted_bits = 0x4b400000;

// Return v · (2^bits − 1) rounded to nearest, ties to even, for v of −1..1 and up to 16 bits, plus shifted_bits.
// Floats do it exactly without a fused operation, too: v · 2^bits is exact, and so are the whole number n that is
// nearest to it and the distance d from n, of −1/2..1/2. The product is n + d − v, so that n is right unless v is above
// d + 1/2 or below d − 1/2. These are exact where they can be nearer to 0 than v, which then is at least 2^−(bits + 1)
// away from it. A tie, n + d − v = n ∓ 1/2, is met by v = ±1/2 alone, and n is even there.
RHW_INLINE i32x8 steps_of_unit(f32x8 v, int bits, bool is_signed)
{
    const f32x8 shift = rhw_splat(0x1.8p23f);
    if (F32_FUSES || bits == 1) { // v = 1/2 is between 0 and 1 of one bit, and n would be 1
        return (i32x8)f32x8_fused(v, rhw_splat((float)((1 << bits) - 1)), shift);
    }
    const f32x8 scaled = v * (float)(1 << bits), shifted = scaled + shift;
    const f32x8 distance = scaled - (shifted - shift);
    const i32x8 steps = (i32x8)shifted + rhw_less(distance + 0.5f, v);
    return is_signed ? steps - rhw_less(v, distance - 0.5f) : steps;
}

// Return values as numbers of 0..2^bits − 1 (Vulkan 1.3 §3.9.2, "Conversion From Floating-Point to Normalized
// Fixed-Point"), plus shifted_bits. NaN becomes 0.
RHW_INLINE i32x8 unorm_from_float(f32x8 value, int bits)
{
    return steps_of_unit(rhw_saturate(value), bits, false);
}

// Return values as numbers with a sign, by the same rules. Values `never_nan` are spared the question.
RHW_INLINE i32x8 snorm_from_float(f32x8 value, int bits, bool never_nan)
{
    f32x8 v = rhw_clamp(value, rhw_splat(-1.0f), rhw_splat(1.0f));
    if (!never_nan) {
        v = (f32x8)((i32x8)v & rhw_equal(value, value));
    }
    return steps_of_unit(v, bits - 1, true);
}

// Return by how much ufloat_from_float says too much: the exponent of 2^−14, which stands for 0.
RHW_INLINE int32_t ufloat_excess(int places)
{
    return (127 - 14) << places;
}

// Return values as floats without a sign, of 5 bits of exponent and `places` of fraction (OpenGL 4.6 §2.3.4.3), rounded
// to nearest, ties to even, plus ufloat_excess. What is finite stays finite, and what is below 0 becomes 0, as what is
// no number does.
RHW_INLINE i32x8 ufloat_from_float(f32x8 value, int places)
{
    const int dropped = 23 - places;
    const f32x8 held = rhw_clamp(value, rhw_splat(0.0f), rhw_splat(65536.0f - (float)(1 << (15 - places))));
    // A power of two that is larger by the dropped places rounds, when it is added, to the last place that is kept.
    // Below 2^−14 that is the place of 2^−14.
    const i32x8 exponent = rhw_max_int((i32x8)held & 0x7f800000, i32x8_splat((127 - 14) << 23));
    const i32x8 power = exponent + i32x8_splat(dropped << 23);
    const i32x8 kept =
        (i32x8)(held + (f32x8)power) - power; // with the first place, which counts up the exponent
    return kept + (exponent >> dropped);
}

// Return the code of a value that may be infinite or no number, where `code` is what ufloat_from_float says.
RHW_INLINE i32x8 ufloat_special(f32x8 value, i32x8 code, int places)
{
    const i32x8 infinity = i32x8_splat(31 << places);
    code = rhw_select_int(rhw_equal_int((i32x8)value, i32x8_splat(0x7f800000)), infinity, code);
    return rhw_select_int(rhw_equal(value, value), code, infinity | i32x8_splat(1 << (places - 1)));
}

// Nine bits each, and one exponent --------------------------------------------------------------------

enum { SHARED_BIAS = 24 }; // a channel is its 9 bits · 2^(exponent − 24)

// Return 2^n of whole n in −126..127.
RHW_INLINE f32x8 power_of_two(i32x8 n)
{
    return (f32x8)((n + 127) << 23);
}

RHW_INLINE i32x8 round_half_up(f32x8 value)
{
    const f32x8 floor = rhw_floor(value);
    const i32x8 up = rhw_less_equal(rhw_splat(0.5f), value - floor);
    return rhw_int_from_float_unchecked(floor) - up;
}

// Return a colour with a shared exponent (Vulkan 1.3 §3.9.3, "RGB to Shared Exponent Conversion").
RHW_INLINE i32x8 shared_from_float(const f32x8 value[4])
{
    const f32x8 zero = rhw_splat(0.0f);
    f32x8 color[3], most = zero;
    for (int c = 0; c < 3; c++) {
        color[c] = rhw_min(rhw_max(value[c], zero), rhw_splat(65408.0f)); // NaN becomes 0
        most = rhw_max(color[c], most);
    }
    const i32x8 log = (((i32x8)most >> 23) & 0xff) - 127;
    i32x8 exponent = rhw_max_int(log, i32x8_splat(-16)) + 16;
    const i32x8 top = round_half_up(most * power_of_two(SHARED_BIAS - exponent));
    exponent = exponent - rhw_equal_int(top, i32x8_splat(512));
    i32x8 word = exponent << 27;
    for (int c = 0; c < 3; c++) {
        word = word | (round_half_up(color[c] * power_of_two(SHARED_BIAS - exponent)) << (9 * c));
    }
    return word;
}

// Texels --------------------------------------------------------------------------------------------

RHW_INLINE f32x8 field_value(enum rhw_channel_type type, i32x8 word, int first, int bits)
{
    const i32x8 raised = word << (32 - bits - first), code = (i32x8)((u32x8)raised >> (32 - bits));
    switch (type) {
    case RHW_CHANNEL_UNORM:
        // A channel below the sign of the word is converted where it stands.
        if (first + bits < 32) {
            const i32x8 steps = word & i32x8_splat(((1 << bits) - 1) << first);
            return unit_of_steps(rhw_float_from_int(steps), bits, (float)(1 << first));
        }
        return unit_of_steps(rhw_float_from_int(code), bits, 1.0f);
    case RHW_CHANNEL_SNORM:
        return rhw_max(unit_of_steps(rhw_float_from_int(raised >> (32 - bits)), bits - 1, 1.0f),
                       rhw_splat(-1.0f));
    case RHW_CHANNEL_SINT: return (f32x8)(raised >> (32 - bits));
    case RHW_CHANNEL_UFLOAT: return f32x8_from_half(code << (15 - bits));
    case RHW_CHANNEL_SHARED:
        return rhw_float_from_int(code) * power_of_two((i32x8)((u32x8)word >> 27) - SHARED_BIAS);
    default: return (f32x8)code;
    }
}

// Decode the channels that the format has. Words are those of raw_texels (texel_codec.h).
RHW_INLINE void decode_known_fields(const struct rhw_format_info *format, const i32x8 word[4], f32x8 *value)
{
    for (int c = 0; c < format->channels; c++) {
        const int first = format->first[c];
        value[c] = field_value(format->type, word[first / 32], first % 32, format->bits[c]);
    }
}

// Encode UNORM or SNORM. Numbers are added up in their places. What is added to them besides is one sum, which is taken
// away at the end: shifted_bits, less half the range of numbers with a sign, which thus borrow nothing from the channel
// above. That half is the highest bit of a number, which changes then.
RHW_INLINE void encode_normalized(const struct rhw_format_info *format, const f32x8 *value, bool never_nan,
                                  i32x8 word[4])
{
    uint32_t besides[2] = {0, 0}, high[2] = {0, 0};
    for (int c = 0; c < format->channels; c++) {
        const bool is_signed = format->type == RHW_CHANNEL_SNORM;
        const int w = format->first[c] / 32, first = format->first[c] % 32, bits = format->bits[c];
        const uint32_t half = is_signed ? 1u << (bits - 1) : 0;
        const i32x8 steps =
            is_signed ? snorm_from_float(value[c], bits, never_nan) : unorm_from_float(value[c], bits);
        word[w] = (i32x8)((u32x8)word[w] + ((u32x8)steps << first));
        besides[w] += ((uint32_t)shifted_bits - half) << first;
        high[w] |= half << first;
    }
    for (int w = 0; w < (format->size + 3) / 4; w++) {
        word[w] = (i32x8)(((u32x8)word[w] - besides[w]) ^ high[w]);
    }
}

// Encode floats without a sign. Codes are added up in their places, and the excess of all is taken away at the end. If
// a value is infinity or no number, the sum of all is one of these too.
RHW_INLINE void encode_ufloats(const struct rhw_format_info *format, const f32x8 *value, i32x8 word[4])
{
    f32x8 sum = value[0];
    for (int c = 1; c < format->channels; c++) {
        sum = sum + value[c];
    }
    const bool is_special = rhw_any(~rhw_less(sum, rhw_infinity()));
    uint32_t excess = 0;
    for (int c = 0; c < format->channels; c++) {
        const int places = format->bits[c] - 5, first = format->first[c];
        i32x8 code = ufloat_from_float(value[c], places);
        if (is_special) {
            code = ufloat_special(value[c], code - ufloat_excess(places), places) + ufloat_excess(places);
        }
        word[0] = (i32x8)((u32x8)word[0] + ((u32x8)code << first));
        excess += (uint32_t)ufloat_excess(places) << first;
    }
    word[0] = (i32x8)((u32x8)word[0] - excess);
}

RHW_INLINE void encode_known_fields(const struct rhw_format_info *format, const f32x8 *value, i32x8 word[4])
{
    word[0] = word[1] = i32x8_splat(0);
    if (format->type == RHW_CHANNEL_SHARED) {
        word[0] = shared_from_float(value);
        return;
    }
    if (rhw_format_is_normalized(format)) {
        encode_normalized(format, value, false, word);
        return;
    }
    if (format->type == RHW_CHANNEL_UFLOAT) {
        encode_ufloats(format, value, word);
        return;
    }
    for (int c = 0; c < format->channels; c++) {
        const int first = format->first[c];
        const i32x8 code = (i32x8)value[c] & (int32_t)((1u << format->bits[c]) - 1);
        word[first / 32] = word[first / 32] | (code << (first % 32));
    }
}

// decode_fields and encode_fields serve a format that the caller does not know.
static __attribute__((noinline)) void decode_fields(const struct rhw_format_info *format, const i32x8 word[4],
                                                    f32x8 *value)
{
    decode_known_fields(format, word, value);
}

static __attribute__((noinline)) void encode_fields(const struct rhw_format_info *format, const f32x8 *value,
                                                    i32x8 word[4])
{
    encode_known_fields(format, value, word);
}

#endif
