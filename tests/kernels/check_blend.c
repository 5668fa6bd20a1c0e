// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/fragment and texel: blending and the texels of every format; compiled with
// RHW_ISA_SUFFIX = baseline, avx2, ...
#include "kernels/fragment/blend.h"
#include "kernels/texel/texel_codec.h"

#include "kernel_folders.h"

enum { ROW_BYTES = 8 * RHW_TEXEL_BYTES };

// 8 fragments, and the texels that they are blended into.
struct blend_input {
    unsigned char texels[ROW_BYTES];
    float color[4][8], constant[4];
    int32_t mask[8];
    struct rhw_color_target target;
};

// Whole texels of the format, so that floats in them are often special.
static void make_texels(struct kernel_random *random, const struct rhw_format_info *format,
                        unsigned char *texels)
{
    for (int i = 0; i < ROW_BYTES; i += 8) {
        const uint64_t bits = random_bits(random);
        memcpy(&texels[i], &bits, sizeof bits);
    }
    for (int i = 0; i < ROW_BYTES && format->codec == RHW_CODEC_FLOAT32; i += 4) {
        const float value = random_float(random);
        memcpy(&texels[i], &value, sizeof value);
    }
}

static struct rhw_blend_component make_component(struct kernel_random *random)
{
    return (struct rhw_blend_component){
        .src = (enum rhw_blend_factor)random_int(random, RHW_BLEND_ZERO, RHW_BLEND_ONE_MINUS_CONSTANT),
        .dst = (enum rhw_blend_factor)random_int(random, RHW_BLEND_ZERO, RHW_BLEND_ONE_MINUS_CONSTANT),
        .operation = (enum rhw_blend_operation)random_int(random, RHW_BLEND_ADD, RHW_BLEND_MAX)};
}

static void make_blend(struct kernel_random *random, void *input)
{
    struct blend_input *const in = input;
    const struct rhw_format_info *format;
    do {
        in->target.format =
            (enum rhw_format)random_int(random, RHW_FORMAT_NONE + 1, RHW_PLAIN_FORMAT_COUNT - 1);
        format = rhw_format_info(in->target.format);
    } while (!rhw_format_has_role(format, RHW_ROLE_COLOR_TARGET));
    make_texels(random, format, in->texels);
    in->target.blend = rhw_format_has_role(format, RHW_ROLE_BLENDED_TARGET) && random_one_in(random, 2);
    in->target.color = make_component(random);
    in->target.alpha = make_component(random);
    if (random_one_in(random, 4)) { // the usual blending, which has a path of its own
        in->target.color = in->target.alpha = (struct rhw_blend_component){
            .src = random_one_in(random, 2) ? RHW_BLEND_ONE : RHW_BLEND_SRC_ALPHA,
            .dst = RHW_BLEND_ONE_MINUS_SRC_ALPHA};
    }
    in->target.write_mask = random_one_in(random, 2) ? 15 : (uint8_t)random_int(random, 0, 15);
    for (int i = 0; i < 4; i++) {
        in->constant[i] = random_finite(random);
        for (int lane = 0; lane < 8; lane++) {
            in->color[i][lane] =
                random_one_in(random, 4) ? random_float(random) : random_float_in(random, 0.0f, 1.0f);
        }
    }
    const bool all = random_one_in(random, 2);
    for (int lane = 0; lane < 8; lane++) {
        in->mask[lane] = all || random_one_in(random, 2) ? -1 : 0;
    }
}

static void run_blend(const void *input, void *result)
{
    const struct blend_input *const in = input;
    struct rhw_blend_state state;
    f32x8 color[4];
    rhw_blend_state_init(&state, &in->target, RHW_LOGIC_OFF, in->constant);
    memcpy(color, in->color, sizeof color);
    memcpy(result, in->texels, sizeof in->texels);
    blend_group(&state, color, i32x8_load(in->mask), result);
}

struct decode_input {
    unsigned char texels[ROW_BYTES];
    int32_t format;
};

static void make_decode(struct kernel_random *random, void *input)
{
    struct decode_input *const in = input;
    in->format = (int32_t)random_int(random, RHW_FORMAT_NONE + 1, RHW_PLAIN_FORMAT_COUNT - 1);
    make_texels(random, rhw_format_info((enum rhw_format)in->format), in->texels);
}

static void run_decode(const void *input, void *result)
{
    const struct decode_input *const in = input;
    const struct rhw_format_info *const format = rhw_format_info((enum rhw_format)in->format);
    struct raw_texels raw;
    f32x8 value[4];
    load_texel_row(format->size, in->texels, &raw);
    decode_texels(format, &raw, value);
    memcpy(result, value, sizeof value);
}

static const struct kernel_check checks[] = {
    {"blend_group", sizeof(struct blend_input), ROW_BYTES, KERNEL_BITS, make_blend, run_blend},
    {"decode_texels", sizeof(struct decode_input), 4 * sizeof(f32x8), KERNEL_BITS, make_decode, run_decode},
};

const struct kernel_folder RHW_ISA_NAME(check_blend) = {"fragment", checks, sizeof checks / sizeof *checks};
