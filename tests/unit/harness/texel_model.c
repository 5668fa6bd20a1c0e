// SPDX-License-Identifier: MIT
// See texel_model.h.
#include "texel_model.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/half.h"
#include "float_bits.h"
#include "reference.h"
#include "format/srgb.h"

// The name -------------------------------------------------------------------------------------------

static enum texel_type type_of(const char *name, bool shared)
{
    static const char *const types[] = {"UNORM", "SRGB", "SNORM", "UINT", "SINT", "FLOAT"};
    const char *const last = strrchr(name, '_') + 1;
    for (int i = 0; i < 6; i++) {
        if (strcmp(last, types[i]) == 0) {
            return shared ? TEXEL_SHARED : (enum texel_type)i;
        }
    }
    abort();
}

// "RGB10A2" is R, G, B of 10 bits and A of 2; "RGB565" has a digit for each letter.
static int read_channels(const char *name, char letter[5], int bits[5])
{
    int count = 0;
    while (*name != '_') {
        const int group = count;
        while (isalpha((unsigned char)*name)) {
            letter[count++] = *name++;
        }
        char digits[4] = "";
        int length = 0;
        while (isdigit((unsigned char)*name)) {
            digits[length++] = *name++;
        }
        for (int i = group; i < count; i++) {
            bits[i] = length == 3 ? digits[i - group] - '0' : atoi(digits);
        }
    }
    return count;
}

struct texel_model texel_model_of(const char *name)
{
    struct texel_model model = {0};
    char letter[5];
    int bits[5], all = 0;
    const int letters = read_channels(name + strlen("RHW_FORMAT_"), letter, bits);
    for (int i = 0; i < letters; i++) {
        all += bits[i];
    }
    const bool shared = letter[letters - 1] == 'E';
    model.type = type_of(name, shared);
    model.bytes = all / 8;
    model.channels = letters - shared;
    // Packed in 16 bits, the first channel is highest.
    const bool high = all == 16 && bits[0] < 8;
    int first = high ? all : 0;
    for (int i = 0; i < model.channels; i++) {
        const int channel = (int)(strchr("RGBA", letter[i]) - "RGBA");
        first -= high ? bits[i] : 0;
        model.has[channel] = true;
        model.first[channel] = first;
        model.bits[channel] = bits[i];
        first += high ? 0 : bits[i];
    }
    return model;
}

// Numbers --------------------------------------------------------------------------------------------

static uint32_t field(const unsigned char *texel, int first, int bits)
{
    uint32_t value = 0;
    for (int i = 0; i < bits; i++) {
        value |= (uint32_t)(texel[(first + i) / 8] >> (first + i) % 8 & 1) << i;
    }
    return value;
}

static void set_field(unsigned char *texel, int first, int bits, uint32_t value)
{
    for (int i = 0; i < bits; i++) {
        const unsigned char bit = (unsigned char)(1 << (first + i) % 8);
        unsigned char *const byte = &texel[(first + i) / 8];
        *byte = (unsigned char)(value >> i & 1 ? *byte | bit : *byte & ~bit);
    }
}

static int32_t signed_field(uint32_t code, int bits)
{
    return (int32_t)(code << (32 - bits)) >> (32 - bits);
}

// A float without sign, of 5 bits of exponent (Khronos Data Format Specification 1.3 §10.3).
static double ufloat_value(uint32_t code, int bits)
{
    const int places = bits - 5;
    const int exponent = (int)(code >> places);
    const double fraction = (double)(code & ((1u << places) - 1)) / (1 << places);
    if (exponent == 31) {
        return fraction == 0 ? (double)INFINITY : (double)NAN;
    }
    return exponent == 0 ? ldexp(fraction, -14) : ldexp(1 + fraction, exponent - 15);
}

// The code whose value is nearest, of two the even one.
static uint32_t ufloat_code(double value, int bits)
{
    const uint32_t infinity = 31u << (bits - 5), most = infinity - 1;
    if (isnan(value)) {
        return infinity | 1u << (bits - 6);
    }
    if (isinf(value) || value <= 0) {
        return value > 0 ? infinity : 0;
    }
    uint32_t low = 0, high = most;
    while (low < high) { // the least code that is not below the value
        const uint32_t middle = (low + high) / 2;
        if (ufloat_value(middle, bits) < value) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    const double above = ufloat_value(low, bits) - value;
    const double below = low == 0 ? (double)INFINITY : value - ufloat_value(low - 1, bits);
    return above < 0 || above < below || (above == below && low % 2 == 0) ? low : low - 1;
}

static double clamped(double value, double least)
{
    return isnan(value) ? 0 : fmin(fmax(value, least), 1.0);
}

static uint32_t encode_channel(const struct texel_model *model, int channel, uint32_t written)
{
    const int bits = model->bits[channel];
    const float value = from_bits(written);
    const float number = isnan(value) ? from_bits(0x7fc00000) : value;
    const double most = ldexp(1, bits) - 1, most_signed = ldexp(1, bits - 1) - 1;
    switch (model->type) {
    case TEXEL_SRGB:
        if (channel < 3) {
            return rhw_srgb_encode(value);
        }
        return (uint32_t)rintf((float)clamped((double)value, 0) * 255.0f);
    case TEXEL_UNORM: // codes of 8 bits are rounded from a float
        return bits == 8 ? (uint32_t)rintf((float)clamped((double)value, 0) * 255.0f)
                         : (uint32_t)rint(clamped((double)value, 0) * most);
    case TEXEL_SNORM: return (uint32_t)(int32_t)rint(clamped((double)value, -1) * most_signed);
    case TEXEL_FLOAT:
        return bits == 32   ? to_bits(number)
               : bits == 16 ? rhw_half_from_float(number)
                            : ufloat_code((double)number, bits);
    default: return written;
    }
}

static uint32_t decode_channel(const struct texel_model *model, int channel, uint32_t code)
{
    const int bits = model->bits[channel];
    const double most = ldexp(1, bits) - 1, most_signed = ldexp(1, bits - 1) - 1;
    switch (model->type) {
    case TEXEL_SRGB:
        return to_bits(channel < 3 ? (float)ref_srgb_decode(code / 255.0) : (float)(code / 255.0));
    case TEXEL_UNORM: return to_bits((float)(code / most));
    case TEXEL_SNORM: return to_bits((float)fmax(signed_field(code, bits) / most_signed, -1.0));
    case TEXEL_SINT: return (uint32_t)signed_field(code, bits);
    case TEXEL_FLOAT:
        return bits == 32   ? code
               : bits == 16 ? to_bits(rhw_half_to_float((uint16_t)code))
                            : to_bits(rhw_half_to_float((uint16_t)(code << (15 - bits))));
    default: return code;
    }
}

// The shared exponent (Vulkan 1.3 §3.9.3) --------------------------------------------------------------

static void encode_shared(const uint32_t bits[4], unsigned char *texel)
{
    double color[3], most = 0;
    for (int c = 0; c < 3; c++) {
        const double value = (double)from_bits(bits[c]);
        color[c] = isnan(value) ? 0 : fmax(0, fmin(65408, value));
        most = fmax(most, color[c]);
    }
    const int preliminary = (int)fmax(-16, most > 0 ? floor(log2(most)) : -16) + 16;
    const int exponent = preliminary + (floor(most / ldexp(1, preliminary - 24) + 0.5) == 512);
    for (int c = 0; c < 3; c++) {
        set_field(texel, 9 * c, 9, (uint32_t)floor(color[c] / ldexp(1, exponent - 24) + 0.5));
    }
    set_field(texel, 27, 5, (uint32_t)exponent);
}

// Texels -----------------------------------------------------------------------------------------------

void texel_model_decode(const struct texel_model *model, const unsigned char *texel, uint32_t bits[4])
{
    const bool is_integer = model->type == TEXEL_UINT || model->type == TEXEL_SINT;
    for (int c = 0; c < 4; c++) {
        const uint32_t code = field(texel, model->first[c], model->bits[c]);
        if (!model->has[c]) {
            bits[c] = c < 3 ? 0 : is_integer ? 1 : to_bits(1);
        } else if (model->type == TEXEL_SHARED) {
            bits[c] = to_bits((float)ldexp(code, (int)field(texel, 27, 5) - 24));
        } else {
            bits[c] = decode_channel(model, c, code);
        }
    }
}

void texel_model_encode(const struct texel_model *model, const uint32_t bits[4], unsigned char *texel)
{
    if (model->type == TEXEL_SHARED) {
        encode_shared(bits, texel);
        return;
    }
    for (int c = 0; c < 4; c++) {
        if (model->has[c]) {
            set_field(texel, model->first[c], model->bits[c], encode_channel(model, c, bits[c]));
        }
    }
}

void texel_model_mask(const struct texel_model *model, unsigned write_mask, unsigned char *texel)
{
    memset(texel, 0, (size_t)model->bytes);
    for (int c = 0; c < 4; c++) {
        if (model->has[c] && write_mask >> c & 1) {
            set_field(texel, model->first[c], model->bits[c], UINT32_MAX);
        }
    }
}
