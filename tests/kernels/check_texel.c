// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/texel: the mip levels of a small texture of any format, band by band, through the table of
// kernels; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "format/format.h"
#include "kernels/kernels.h"
#include "kernels/mip_work.h"
#include "base/simd.h"
#include "resource/texture.h"

#include "kernel_folders.h"

enum {
    MOST_SIZE = 24,
    LEVEL_BYTES = MOST_SIZE * MOST_SIZE * 16,
    LEVELS_BYTES =
        MOST_SIZE * (12 * 16 + RHW_ROW_ALIGNMENT), // the ones that are made, with what rows are aligned to
    SCRATCH = 4 * 16 * (4 * MOST_SIZE)             // floats
};

struct mip_input {
    unsigned char texels[LEVEL_BYTES + MOST_SIZE * RHW_ROW_ALIGNMENT];
    int32_t format, width, height, band;
};

static void make_mip(struct kernel_random *random, void *input)
{
    struct mip_input *const in = input;
    do {
        in->format = (int32_t)random_int(random, RHW_FORMAT_NONE + 1, RHW_PLAIN_FORMAT_COUNT - 1);
    } while (!rhw_format_has_role(rhw_format_info((enum rhw_format)in->format), RHW_ROLE_SAMPLED));
    in->width = (int32_t)random_int(random, 1, MOST_SIZE);
    in->height = (int32_t)random_int(random, 1, MOST_SIZE);
    in->band = (int32_t)random_int(random, 1, 4);
    for (size_t i = 0; i < sizeof in->texels; i += 8) {
        const uint64_t bits = random_bits(random);
        memcpy(&in->texels[i], &bits, sizeof bits);
    }
}

static void run_mip(const void *input, void *result)
{
    const struct mip_input *const in = input;
    _Alignas(RHW_ROW_ALIGNMENT) unsigned char above[sizeof in->texels];
    _Alignas(32) float scratch[SCRATCH] = {0};
    struct rhw_texture_data texture;
    memcpy(above, in->texels, sizeof above);
    memset(result, 0, LEVELS_BYTES);
    const struct rhw_texture_shape shape =
        rhw_texture_shape_2d(in->width, in->height, rhw_mip_chain_length(in->width, in->height, 1));
    rhw_texture_data_init(&texture, (enum rhw_format)in->format, &shape);
    texture.mip[0].texels = above;
    unsigned char *next = result;
    const int last = texture.levels - 1 < RHW_MIP_STEPS ? texture.levels - 1 : RHW_MIP_STEPS;
    if (last == 0) {
        return;
    }
    for (int i = 1; i <= last; i++) {
        texture.mip[i].texels = next;
        next += texture.mip[i].row_pitch * (size_t)texture.mip[i].height;
    }
    const struct rhw_mip_job job = {
        .texture = &texture, .last = last, .band = in->band, .scratch = scratch, .scratch_size = SCRATCH};
    for (int i = 0; i * in->band < texture.mip[last].height; i++) {
        RHW_ISA_NAME(rhw_kernels).mip_band(&job, i, 0);
    }
}

static const struct kernel_check checks[] = {
    {"mip_band", sizeof(struct mip_input), LEVELS_BYTES, KERNEL_BITS, make_mip, run_mip},
};

const struct kernel_folder RHW_ISA_NAME(check_texel) = {"texel", checks, sizeof checks / sizeof *checks};
