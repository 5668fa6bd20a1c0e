// SPDX-License-Identifier: MIT
// The blend kernel by itself: conversions against MPFR and over all their inputs, the fast paths
// against plain formulas, masks byte by byte, and every instruction set against the baseline. What
// blending means per factor and operation is test_blend's subject.
#include "float_bits.h"
#include "harness.h"
#include "isa_templates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <mpfr.h>

#include "base/half.h"
#include "pipeline/blend_state.h"
#include "reference.h"
#include "resource/clear_texel.h"
#include "texel_model.h"
#include "format/srgb.h"

// sRGB ----------------------------------------------------------------------------------------------

// result = the linear value of an encoded one in 0..1 given as numerator / denominator.
static void decode_exactly(mpfr_t result, long numerator, long denominator)
{
    mpfr_set_si(result, numerator, MPFR_RNDN);
    mpfr_div_si(result, result, denominator, MPFR_RNDN);
    if (mpfr_cmp_d(result, 0.04045) <= 0) {
        mpfr_mul_si(result, result, 100, MPFR_RNDN);
        mpfr_div_si(result, result, 1292, MPFR_RNDN);
        return;
    }
    mpfr_t exponent;
    mpfr_init2(exponent, 200);
    mpfr_set_si(exponent, 12, MPFR_RNDN);
    mpfr_div_si(exponent, exponent, 5, MPFR_RNDN);
    mpfr_mul_si(result, result, 1000, MPFR_RNDN);
    mpfr_add_si(result, result, 55, MPFR_RNDN);
    mpfr_div_si(result, result, 1055, MPFR_RNDN);
    mpfr_pow(result, result, exponent, MPFR_RNDN);
    mpfr_clear(exponent);
}

static void test_srgb_decodes_every_code_correctly_rounded(void **state)
{
    (void)state;
    mpfr_t linear;
    mpfr_init2(linear, 200);
    for (int code = 0; code < 256; code++) {
        decode_exactly(linear, code, 255);
        assert_true(rhw_srgb_decode_table[code] == mpfr_get_flt(linear, MPFR_RNDN));
    }
    mpfr_clear(linear);
}

// The encoder grows with its argument, so that it is right everywhere when each code starts at the first
// float whose exact encoding is at least code − 1/2.
static void test_srgb_encodes_every_float_correctly_rounded(void **state)
{
    (void)state;
    mpfr_t threshold;
    mpfr_init2(threshold, 200);
    uint32_t next = 0x35800000; // 2^-20; bits of the first float of the code at hand
    for (int code = 1; code < 256; code++) {
        decode_exactly(threshold, 2 * code - 1, 510);
        const uint32_t first = to_bits(mpfr_get_flt(threshold, MPFR_RNDU));
        for (; next < first; next++) {
            if (rhw_srgb_encode(from_bits(next)) != code - 1) {
                fail_msg("%a encodes to %d, not %d", (double)from_bits(next),
                         rhw_srgb_encode(from_bits(next)), code - 1);
            }
        }
        assert_int_equal(rhw_srgb_encode(from_bits(first)), code);
    }
    for (uint32_t bits = 0; bits < 0x35800000; bits += 4097) {
        assert_int_equal(rhw_srgb_encode(from_bits(bits)), 0);
    }
    for (; next < 0x7f800000; next += 4097) {
        assert_int_equal(rhw_srgb_encode(from_bits(next)), 255);
    }
    assert_int_equal(rhw_srgb_encode(INFINITY), 255);
    assert_int_equal(rhw_srgb_encode(-1.0f), 0);
    assert_int_equal(rhw_srgb_encode(-INFINITY), 0);
    assert_int_equal(rhw_srgb_encode(NAN), 0);
    mpfr_clear(threshold);
}

// Half ----------------------------------------------------------------------------------------------

static void test_half_to_float_is_exact(void **state)
{
    (void)state;
    for (unsigned bits = 0; bits < 0x10000; bits++) {
        const float value = rhw_half_to_float((uint16_t)bits);
        if ((bits & 0x7c00) == 0x7c00) {
            assert_true(bits & 0x3ff ? isnan(value) : isinf(value));
            assert_int_equal(to_bits(value) >> 31, bits >> 15);
        } else {
            assert_true((double)value == ref_half((uint16_t)bits));
            assert_int_equal(to_bits(value) >> 31, bits >> 15);
        }
    }
}

// Between two neighbouring halves the nearer wins, and the even one in the middle.
static void test_half_from_float_rounds_to_nearest_even(void **state)
{
    (void)state;
    for (unsigned bits = 0; bits < 0x7c00; bits++) {
        const double low = ref_half((uint16_t)bits);
        const double high = bits + 1 < 0x7c00 ? ref_half((uint16_t)(bits + 1)) : 65536.0;
        const float middle = (float)((low + high) / 2); // exact
        const unsigned even = bits & 1 ? bits + 1 : bits;
        for (unsigned sign = 0; sign <= 0x8000; sign += 0x8000) {
            const float s = sign ? -1.0f : 1.0f;
            assert_int_equal(rhw_half_from_float(s * (float)low), bits | sign);
            assert_int_equal(rhw_half_from_float(s * middle), even | sign);
            assert_int_equal(rhw_half_from_float(s * nextafterf(middle, 0.0f)), bits | sign);
            assert_int_equal(rhw_half_from_float(s * nextafterf(middle, 1e9f)), (bits + 1) | sign);
        }
    }
    assert_int_equal(rhw_half_from_float(INFINITY), 0x7c00);
    assert_int_equal(rhw_half_from_float(-INFINITY), 0xfc00);
    assert_int_equal(rhw_half_from_float(3e38f), 0x7c00);
    assert_int_equal(rhw_half_from_float(from_bits(0x7fd56000)), 0x7eab);
    assert_int_equal(rhw_half_from_float(from_bits(0xff802000)), 0xfe01); // signalling becomes quiet
}

// Blending -------------------------------------------------------------------------------------------

static struct rhw_color_target opaque(enum rhw_format format)
{
    const struct rhw_blend_component copy = {RHW_BLEND_ONE, RHW_BLEND_ZERO, RHW_BLEND_ADD};
    return (struct rhw_color_target){.format = format, .color = copy, .alpha = copy, .write_mask = 15};
}

static const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM,  RHW_FORMAT_RGBA8_SRGB,
                                          RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_R32_FLOAT,
                                          RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_R32_UINT};
enum { FORMATS = sizeof formats / sizeof formats[0], TEXELS = 8, TEXEL_BYTES = 16 };

// Floats that are hard on conversions: any bits, near 0..1, ties, specials.
static float awkward_float(uint64_t *random)
{
    static const float special[] = {0.0f, -0.0f, 1.0f, INFINITY, -INFINITY, NAN, 0.5f, 1.5f, -1.0f, 65520.0f};
    switch (rig_random_int(random, 4)) {
    case 0: return from_bits((uint32_t)rig_random(random));
    case 1: return special[rig_random_int(random, (int)(sizeof special / sizeof special[0]))];
    case 2: return ((float)rig_random_int(random, 256) + 0.5f) / 255.0f;
    default: return rig_random_float(random, -0.1f, 1.1f);
    }
}

static void random_group(uint64_t *random, rhw_float color[4], rhw_int *mask, unsigned char *texels)
{
    for (int i = 0; i < RHW_LANES; i++) {
        for (int c = 0; c < 4; c++) {
            color[c][i] = awkward_float(random);
        }
        (*mask)[i] = -rig_random_int(random, 2);
    }
    for (int i = 0; i < TEXELS * TEXEL_BYTES; i++) {
        texels[i] = (unsigned char)rig_random(random);
    }
}

static struct rhw_color_target random_target(uint64_t *random)
{
    const enum rhw_format format = formats[rig_random_int(random, FORMATS)];
    struct rhw_color_target target = opaque(format);
    target.blend = rig_random_int(random, 2);
    target.write_mask = (uint8_t)(rig_random_int(random, 2) ? 15 : rig_random_int(random, 16));
    struct rhw_blend_component *const part[2] = {&target.color, &target.alpha};
    const bool usual = rig_random_int(random, 3) == 0;
    for (int i = 0; i < 2; i++) {
        part[i]->src = (enum rhw_blend_factor)(RHW_BLEND_ZERO + rig_random_int(random, 15));
        part[i]->dst = (enum rhw_blend_factor)(RHW_BLEND_ZERO + rig_random_int(random, 15));
        part[i]->operation = (enum rhw_blend_operation)rig_random_int(random, 5);
        if (usual) {
            part[i]->src = rig_random_int(random, 2) ? RHW_BLEND_SRC_ALPHA : RHW_BLEND_ONE;
            part[i]->dst = RHW_BLEND_ONE_MINUS_SRC_ALPHA;
            part[i]->operation = RHW_BLEND_ADD;
        }
    }
    return target;
}

// Blend a random group by `state` on every instruction set. The bytes are those that `reference` gives on the baseline.
static void expect_the_bytes_of(const struct rhw_blend_state *reference, const struct rhw_blend_state *state,
                                uint64_t *random)
{
    rhw_float color[4];
    rhw_int mask;
    unsigned char before[TEXELS * TEXEL_BYTES], expected[sizeof before], texels[sizeof before];
    random_group(random, color, &mask, before);
    memcpy(expected, before, sizeof before);
    isa_templates_for(RHW_ISA_BASELINE)->blend(reference, color, &mask, expected);
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        const struct isa_templates *const templates = isa_templates_for((enum rhw_isa)isa);
        if (templates) {
            memcpy(texels, before, sizeof before);
            templates->blend(state, color, &mask, texels);
            assert_memory_equal(texels, expected, sizeof texels);
        }
    }
}

static void test_every_isa_writes_the_same_bytes(void **state)
{
    (void)state;
    uint64_t random = 7;
    for (int n = 0; n < 30000; n++) {
        const struct rhw_color_target target = random_target(&random);
        const float constant[4] = {rig_random_float(&random, -0.5f, 1.5f), 0.25f, 1.0f,
                                   awkward_float(&random)};
        struct rhw_blend_state blend;
        rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
        expect_the_bytes_of(&blend, &blend, &random);
    }
}

// Dead lanes, channels outside the write mask, and what follows the 8 texels keep their bytes.
static void test_nothing_else_is_written(void **state)
{
    (void)state;
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    uint64_t random = 8;
    for (int n = 0; n < 4000; n++) {
        const struct rhw_color_target target = random_target(&random);
        const float constant[4] = {0.5f, 0.25f, 0.125f, 1.0f};
        struct rhw_blend_state blend;
        rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
        rhw_float color[4];
        rhw_int mask;
        unsigned char before[TEXELS * TEXEL_BYTES], texels[sizeof before];
        random_group(&random, color, &mask, before);
        memcpy(texels, before, sizeof before);
        baseline->blend(&blend, color, &mask, texels);
        const size_t size = rhw_format_size(target.format);
        const size_t channel =
            target.format == RHW_FORMAT_RGBA8_UNORM || target.format == RHW_FORMAT_RGBA8_SRGB ? 1
            : target.format == RHW_FORMAT_RGBA16_FLOAT                                        ? 2
                                                                                              : 4;
        for (size_t i = 0; i < sizeof before; i++) {
            const bool inside = i / size < TEXELS, live = inside && mask[i / size];
            if (!live || !(target.write_mask >> (i % size / channel) & 1)) {
                assert_int_equal(texels[i], before[i]);
            }
        }
    }
}

static unsigned unorm8(float value)
{
    const float clamped = !(value > 0) ? 0.0f : value > 1 ? 1.0f : value;
    return (unsigned)lrintf(clamped * 255.0f); // the default rounding: to nearest, ties to even
}

static void test_replacing_rounds_each_format(void **state)
{
    (void)state;
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    const float constant[4] = {0, 0, 0, 0};
    const rhw_int all = rhw_splat_int(-1);
    uint64_t random = 9;
    for (int n = 0; n < 4000; n++) {
        rhw_float color[4];
        rhw_int mask;
        unsigned char texels[TEXELS * TEXEL_BYTES];
        random_group(&random, color, &mask, texels);
        for (int f = 0; f < FORMATS; f++) {
            const struct rhw_color_target target = opaque(formats[f]);
            struct rhw_blend_state blend;
            rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
            baseline->blend(&blend, color, &all, texels);
            for (int i = 0; i < TEXELS; i++) {
                const unsigned char *const texel = texels + (size_t)i * rhw_format_size(formats[f]);
                const int channels =
                    formats[f] == RHW_FORMAT_R32_FLOAT || formats[f] == RHW_FORMAT_R32_UINT ? 1 : 4;
                for (int c = 0; c < channels; c++) {
                    const float value = color[c][i], number = isnan(value) ? from_bits(0x7fc00000) : value;
                    uint16_t half;
                    uint32_t word;
                    memcpy(&half, texel + 2 * c, sizeof half);
                    memcpy(&word, texel + (channels == 1 ? 0 : 4 * c) % 16, sizeof word);
                    switch (formats[f]) {
                    case RHW_FORMAT_RGBA8_UNORM: assert_int_equal(texel[c], unorm8(value)); break;
                    case RHW_FORMAT_RGBA8_SRGB:
                        assert_int_equal(texel[c], c < 3 ? rhw_srgb_encode(value) : unorm8(value));
                        break;
                    case RHW_FORMAT_RGBA16_FLOAT: assert_int_equal(half, rhw_half_from_float(number)); break;
                    case RHW_FORMAT_R32_UINT: // bits, NaN or not
                        assert_int_equal(word, to_bits(value));
                        break;
                    default: assert_int_equal(word, to_bits(number)); break;
                    }
                }
            }
        }
    }
}

// A path of its own writes what the general path writes, on every instruction set.
static void expect_the_general_path(const struct rhw_blend_state *state, uint64_t *random)
{
    struct rhw_blend_state general = *state;
    rhw_blend_state_generalize(&general);
    assert_int_equal(general.path, BLEND_GENERAL);
    expect_the_bytes_of(&general, state, random);
}

// Sums have code of their own too, which writes what the general path does, on every instruction set.
static void test_rgba8_sums_are_those_of_the_general_path(void **state)
{
    (void)state;
    const float constant[4] = {0, 0, 0, 0};
    uint64_t random = 11;
    for (int n = 0; n < 8000; n++) {
        struct rhw_color_target target = opaque(RHW_FORMAT_RGBA8_UNORM);
        target.blend = true;
        target.color.dst = target.alpha.dst = RHW_BLEND_ONE;
        target.write_mask = (uint8_t)(n % 3 ? 15 : 1 + rig_random_int(&random, 15));
        struct rhw_blend_state sum;
        rhw_blend_state_init(&sum, &target, RHW_LOGIC_OFF, constant);
        assert_int_equal(sum.path, BLEND_RGBA8_SUM);
        expect_the_general_path(&sum, &random);
    }
}

// Every normalized format that has no path of its own is replaced without being read, with the bytes of the general path,
// on every instruction set.
static void test_normalized_formats_are_replaced(void **state)
{
    (void)state;
    const float constant[4] = {0, 0, 0, 0};
    uint64_t random = 12;
    int replaced = 0;
    for (int n = 0; n < 40 * RHW_FORMAT_COUNT; n++) {
        const struct rhw_color_target target = opaque((enum rhw_format)(n % RHW_FORMAT_COUNT));
        const struct rhw_format_info *const info = rhw_format_info(target.format);
        if (!rhw_format_has_role(info, RHW_ROLE_COLOR_TARGET) || !rhw_format_is_normalized(info)) {
            continue;
        }
        struct rhw_blend_state replace;
        rhw_blend_state_init(&replace, &target, RHW_LOGIC_OFF, constant);
        assert_int_not_equal(replace.path, BLEND_GENERAL);
        replaced += replace.path == BLEND_REPLACE;
        expect_the_general_path(&replace, &random);
    }
    assert_in_range(replaced, 40 * 10, 40 * RHW_FORMAT_COUNT);
}

// Blending by the usual factors, and sums, have code of their own for every format, which writes what the general path
// writes on every instruction set.
static void test_usual_blending_of_every_format(void **state)
{
    (void)state;
    const float constant[4] = {0, 0, 0, 0};
    uint64_t random = 13;
    int over = 0, sums = 0;
    for (int n = 0; n < 60 * RHW_FORMAT_COUNT; n++) {
        struct rhw_color_target target = opaque((enum rhw_format)(n % RHW_FORMAT_COUNT));
        if (!rhw_format_has_role(rhw_format_info(target.format), RHW_ROLE_BLENDED_TARGET)) {
            continue;
        }
        const bool sum = n / RHW_FORMAT_COUNT % 3 == 0;
        target.blend = true;
        target.color.src = sum || rig_random_int(&random, 2) ? RHW_BLEND_ONE : RHW_BLEND_SRC_ALPHA;
        target.alpha.src = sum || rig_random_int(&random, 2) ? RHW_BLEND_ONE : RHW_BLEND_SRC_ALPHA;
        target.color.dst = target.alpha.dst = sum ? RHW_BLEND_ONE : RHW_BLEND_ONE_MINUS_SRC_ALPHA;
        struct rhw_blend_state blend;
        rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
        over += blend.path == BLEND_OVER;
        sums += blend.is_sum;
        if (blend.path != BLEND_RGBA8_OVER) { // which rounds once
            expect_the_general_path(&blend, &random);
        }
    }
    assert_in_range(over, 60 * 10, 60 * RHW_FORMAT_COUNT);
    assert_in_range(sums, 20 * 10, 20 * RHW_FORMAT_COUNT);
}

// The floats around every value that lies between two steps are rounded to the nearer one, and ties to even.
static void test_values_between_two_steps(void **state)
{
    (void)state;
    // Where a channel stands in the lowest bits of the texel.
    static const struct {
        enum rhw_format format;
        int channel, bits, most;
        bool has_sign;
    } channels[] = {
        {RHW_FORMAT_R16_UNORM, 0, 16, 65535, false},    {RHW_FORMAT_RGBA16_UNORM, 0, 16, 65535, false},
        {RHW_FORMAT_RGB10A2_UNORM, 0, 10, 1023, false}, {RHW_FORMAT_RGB565_UNORM, 2, 5, 31, false},
        {RHW_FORMAT_RGBA4_UNORM, 3, 4, 15, false},      {RHW_FORMAT_RGB5A1_UNORM, 3, 1, 1, false},
        {RHW_FORMAT_R8_SNORM, 0, 8, 127, true},         {RHW_FORMAT_R16_SNORM, 0, 16, 32767, true},
        {RHW_FORMAT_RGBA16_SNORM, 0, 16, 32767, true},
    };
    const float constant[4] = {0, 0, 0, 0};
    const rhw_int all = rhw_splat_int(-1);
    for (size_t k = 0; k < sizeof channels / sizeof *channels; k++) {
        const struct rhw_color_target target = opaque(channels[k].format);
        const int most = channels[k].most, least = channels[k].has_sign ? -most : 0;
        const size_t size = rhw_format_size(target.format);
        struct rhw_blend_state blend;
        rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
        for (int step = least - 1; step <= most; step += most > 1023 ? 5 : 1) {
            const float middle = (float)((step + 0.5) / most);
            rhw_float color[4] = {{0}};
            for (int lane = 0; lane < RHW_LANES; lane++) {
                color[channels[k].channel][lane] = from_bits(to_bits(middle) + (uint32_t)(lane - 3));
            }
            for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
                const struct isa_templates *const templates = isa_templates_for((enum rhw_isa)isa);
                unsigned char texels[TEXELS * TEXEL_BYTES] = {0};
                if (templates) {
                    templates->blend(&blend, color, &all, texels);
                }
                for (int lane = 0; lane < RHW_LANES && templates; lane++) {
                    const double value = (double)color[channels[k].channel][lane];
                    const double inside = fmax(channels[k].has_sign ? -1 : 0, fmin(value, 1));
                    uint32_t word = 0;
                    memcpy(&word, texels + (size_t)lane * size, size < 4 ? size : 4);
                    const uint32_t field = (1u << channels[k].bits) - 1;
                    // The product is exact in double.
                    assert_int_equal(word & field, (uint32_t)(int)nearbyint(inside * most) & field);
                }
            }
        }
    }
}

// Every code of every channel of a normalized format is read as its quotient, correctly rounded. Halves of 16 bits that
// count together give each channel all its codes, wherever it stands.
static void test_codes_are_quotients(void **state)
{
    (void)state;
    int checked = 0;
    for (int f = RHW_FORMAT_NONE + 1; f < RHW_PLAIN_FORMAT_COUNT; f++) {
        const struct rhw_format_info *const format = rhw_format_info((enum rhw_format)f);
        if (!rhw_format_has_role(format, RHW_ROLE_COLOR_TARGET) || !rhw_format_is_normalized(format)) {
            continue;
        }
        const struct texel_model model = texel_model_of(format->name);
        for (uint32_t code = 0; code < 0x10000; code += RHW_LANES) {
            unsigned char texels[TEXELS * TEXEL_BYTES];
            uint32_t expected[RHW_LANES][4];
            for (int i = 0; i < RHW_LANES * format->size; i++) {
                texels[i] =
                    (unsigned char)((code + (uint32_t)(i / format->size)) >> (i % format->size % 2 * 8));
            }
            for (int lane = 0; lane < RHW_LANES; lane++) {
                texel_model_decode(&model, texels + lane * format->size, expected[lane]);
            }
            for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
                const struct isa_templates *const templates = isa_templates_for((enum rhw_isa)isa);
                rhw_float value[4];
                if (templates) {
                    templates->decode(format, texels, value);
                }
                for (int i = 0; i < 4 * RHW_LANES && templates; i++) {
                    assert_int_equal(to_bits(value[i % 4][i / 4]), expected[i / 4][i % 4]);
                }
            }
        }
        checked++;
    }
    assert_in_range(checked, 20, RHW_PLAIN_FORMAT_COUNT);
}

// The usual blending of RGBA8 has code of its own: it may differ from the exact value by float rounding
// only, which shows where the exact value is next to a tie.
static void test_rgba8_over_against_the_formula(void **state)
{
    (void)state;
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    const float constant[4] = {0, 0, 0, 0};
    const rhw_int all = rhw_splat_int(-1);
    uint64_t random = 10;
    for (int n = 0; n < 8000; n++) {
        struct rhw_color_target target = opaque(RHW_FORMAT_RGBA8_UNORM);
        target.blend = true;
        target.color.src = n & 1 ? RHW_BLEND_ONE : RHW_BLEND_SRC_ALPHA;
        target.alpha.src = n & 2 ? RHW_BLEND_ONE : RHW_BLEND_SRC_ALPHA;
        target.color.dst = target.alpha.dst = RHW_BLEND_ONE_MINUS_SRC_ALPHA;
        struct rhw_blend_state blend;
        rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
        assert_int_equal(blend.path, BLEND_RGBA8_OVER);
        rhw_float color[4];
        rhw_int mask;
        unsigned char before[TEXELS * TEXEL_BYTES], texels[sizeof before];
        random_group(&random, color, &mask, before);
        memcpy(texels, before, sizeof before);
        baseline->blend(&blend, color, &all, texels);
        for (int i = 0; i < TEXELS; i++) {
            const double alpha = fmin(fmax((double)color[3][i], 0.0), 1.0); // fmax: NaN becomes 0
            for (int c = 0; c < 4; c++) {
                const double src = fmin(fmax((double)color[c][i], 0.0), 1.0);
                const bool one = c == 3 ? n & 2 : n & 1;
                const double exact = 255 * src * (one ? 1.0 : alpha) + before[4 * i + c] * (1 - alpha);
                assert_true(fabs(texels[4 * i + c] - fmin(exact, 255.0)) <= 0.5 + 1e-4);
            }
        }
    }
}

// Decoding a destination that blending then keeps whole must not lose a code.
static void test_blending_keeps_every_destination_code(void **state)
{
    (void)state;
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    const float constant[4] = {0, 0, 0, 0};
    const rhw_int all = rhw_splat_int(-1);
    const rhw_float transparent[4] = {rhw_splat(0.7f), rhw_splat(0.3f), rhw_splat(1.0f), rhw_splat(0.0f)};
    for (int f = 0; f < 2; f++) {
        for (int generic = 0; generic < 2; generic++) {
            struct rhw_color_target target = opaque(formats[f]);
            target.blend = true;
            target.color = target.alpha =
                (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
                                             generic ? RHW_BLEND_REVERSE_SUBTRACT : RHW_BLEND_ADD};
            struct rhw_blend_state blend;
            rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
            for (int code = 0; code < 256; code++) {
                unsigned char texels[TEXELS * TEXEL_BYTES], before[sizeof texels];
                memset(texels, code, sizeof texels);
                memcpy(before, texels, sizeof texels);
                baseline->blend(&blend, transparent, &all, texels);
                assert_memory_equal(texels, before, sizeof texels);
            }
        }
    }
}

// A cleared texel is the texel that drawing the value gives.
static void test_clear_values_are_what_drawing_writes(void **state)
{
    (void)state;
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    const float constant[4] = {0, 0, 0, 0};
    const rhw_int all = rhw_splat_int(-1);
    uint64_t random = 11;
    for (int n = 0; n < 4000; n++) {
        const enum rhw_format format = formats[n % FORMATS];
        const struct rhw_color_target target = opaque(format);
        struct rhw_blend_state blend;
        rhw_blend_state_init(&blend, &target, RHW_LOGIC_OFF, constant);
        float value[4];
        rhw_float color[4];
        for (int c = 0; c < 4; c++) {
            value[c] = awkward_float(&random);
            color[c] = rhw_splat(value[c]);
        }
        unsigned char texels[TEXELS * TEXEL_BYTES], cleared[16];
        baseline->blend(&blend, color, &all, texels);
        rhw_clear_texel(rhw_format_info(format), value, cleared);
        assert_memory_equal(cleared, texels, rhw_format_size(format));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_srgb_decodes_every_code_correctly_rounded),
    cmocka_unit_test(test_srgb_encodes_every_float_correctly_rounded),
    cmocka_unit_test(test_half_to_float_is_exact),
    cmocka_unit_test(test_half_from_float_rounds_to_nearest_even),
    cmocka_unit_test(test_every_isa_writes_the_same_bytes),
    cmocka_unit_test(test_nothing_else_is_written),
    cmocka_unit_test(test_replacing_rounds_each_format),
    cmocka_unit_test(test_rgba8_over_against_the_formula),
    cmocka_unit_test(test_rgba8_sums_are_those_of_the_general_path),
    cmocka_unit_test(test_normalized_formats_are_replaced),
    cmocka_unit_test(test_usual_blending_of_every_format),
    cmocka_unit_test(test_values_between_two_steps),
    cmocka_unit_test(test_codes_are_quotients),
    cmocka_unit_test(test_blending_keeps_every_destination_code),
    cmocka_unit_test(test_clear_values_are_what_drawing_writes),
};

const struct unit_tests test_blend_kernel = UNIT_TESTS(tests, NULL, NULL);
