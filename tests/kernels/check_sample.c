// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/sample: a sample of a small texture of any format, by any sampler and on each path, through
// the table of kernels; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "binding/binding.h"
#include "format/format.h"
#include "kernels/kernels.h"
#include "resource/sampler.h"
#include "base/simd.h"
#include "resource/srgb_texture.h"
#include "resource/texture.h"

#include "kernel_folders.h"

enum {
    MOST_SIZE = 16,
    LEVEL_BYTES = MOST_SIZE * MOST_SIZE * 16,
    // Rows of the lower levels are shorter than what they are aligned to.
    TEXTURE_BYTES = LEVEL_BYTES + 2 * MOST_SIZE * RHW_ROW_ALIGNMENT * 2 + RHW_TEXEL_PADDING
};

struct sample_input {
    unsigned char texels[TEXTURE_BYTES];
    float uv[2][8], gradient[4][8], lod[8];
    struct rhw_sampler_def sampler;
    int32_t format, width, height, levels, asks, paths;
};

enum { ASKS_NOTHING, ASKS_GRADIENT, ASKS_LOD, ASKS_COUNT };

static struct rhw_sampler_def make_sampler(struct kernel_random *random)
{
    struct rhw_sampler_def def = {.lod_max = 1000.0f};
    if (random_one_in(random, 2)) { // what the fixed-point path asks for
        def.min_filter = def.mag_filter = RHW_FILTER_LINEAR;
        def.mip_filter = random_one_in(random, 4) ? RHW_MIP_FILTER_NONE : RHW_MIP_FILTER_LINEAR;
        def.address_u = (enum rhw_address)random_int(random, RHW_ADDRESS_REPEAT, RHW_ADDRESS_CLAMP);
        def.address_v = (enum rhw_address)random_int(random, RHW_ADDRESS_REPEAT, RHW_ADDRESS_CLAMP);
    } else {
        def.min_filter = (enum rhw_filter)random_int(random, RHW_FILTER_LINEAR, RHW_FILTER_NEAREST);
        def.mag_filter = (enum rhw_filter)random_int(random, RHW_FILTER_LINEAR, RHW_FILTER_NEAREST);
        def.mip_filter = (enum rhw_mip_filter)random_int(random, RHW_MIP_FILTER_LINEAR, RHW_MIP_FILTER_NONE);
        def.address_u = (enum rhw_address)random_int(random, RHW_ADDRESS_REPEAT, RHW_ADDRESS_BORDER);
        def.address_v = (enum rhw_address)random_int(random, RHW_ADDRESS_REPEAT, RHW_ADDRESS_BORDER);
    }
    for (int i = 0; i < 4; i++) {
        def.border[i] = random_finite(random);
    }
    def.lod_bias = random_one_in(random, 2) ? 0.0f : random_finite(random);
    if (random_one_in(random, 4)) {
        def.lod_min = random_float_in(random, -1.0f, 3.0f);
        def.lod_max = def.lod_min + random_float_in(random, 0.0f, 3.0f);
    }
    return def;
}

// Coordinates of 8 pixels in a row, or any.
static void make_coordinates(struct kernel_random *random, struct sample_input *in)
{
    const bool in_a_row = random_one_in(random, 2);
    const float u = random_float_in(random, -1.0f, 2.0f), v = random_float_in(random, -1.0f, 2.0f);
    const float step = random_float_in(random, 0.0f, 0.125f);
    for (int lane = 0; lane < 8; lane++) {
        in->uv[0][lane] = in_a_row ? u + (float)lane * step : random_float(random);
        in->uv[1][lane] = in_a_row ? v : random_float(random);
        for (int i = 0; i < 4; i++) {
            in->gradient[i][lane] = in_a_row ? (i == 0 ? step : 0.0f) : random_float(random);
        }
        in->lod[lane] = random_one_in(random, 2) ? random_float_in(random, 0.0f, 5.0f) : random_float(random);
    }
}

static void make_sample(struct kernel_random *random, void *input)
{
    struct sample_input *const in = input;
    do {
        in->format = (int32_t)random_int(random, RHW_FORMAT_NONE + 1, RHW_PLAIN_FORMAT_COUNT - 1);
        in->format = random_one_in(random, 4)   ? RHW_FORMAT_RGBA8_UNORM
                     : random_one_in(random, 4) ? RHW_FORMAT_RGBA8_SRGB
                                                : in->format;
    } while (!rhw_format_has_role(rhw_format_info((enum rhw_format)in->format), RHW_ROLE_SAMPLED));
    in->width = (int32_t)random_int(random, 1, MOST_SIZE);
    in->height = (int32_t)random_int(random, 1, MOST_SIZE);
    in->levels = random_one_in(random, 4) ? 1 : rhw_mip_chain_length(in->width, in->height, 1);
    in->asks = (int32_t)random_int(random, 0, ASKS_COUNT - 1);
    in->paths = random_one_in(random, 4) ? RHW_PATHS_GENERAL : RHW_PATHS_ALL;
    for (int i = 0; i < TEXTURE_BYTES; i += 8) {
        const uint64_t bits = random_bits(random);
        memcpy(&in->texels[i], &bits, sizeof bits);
    }
    in->sampler = make_sampler(random);
    make_coordinates(random, in);
}

// A texture whose levels lie in `texels` and, linear, in `linear`.
static void set_texture(struct rhw_texture_data *texture, const struct sample_input *in,
                        unsigned char *texels, unsigned char *linear)
{
    enum { SCALE = RHW_LINEAR_TEXEL / 4 };
    const struct rhw_texture_shape shape = rhw_texture_shape_2d(in->width, in->height, in->levels);
    rhw_texture_data_init(texture, (enum rhw_format)in->format, &shape);
    memcpy(texels, in->texels, TEXTURE_BYTES);
    for (int i = 0; i < TEXTURE_BYTES; i++) { // any numbers up to RHW_LINEAR_ONE
        const uint16_t number = (uint16_t)(in->texels[i] << 7);
        memcpy(linear + 2 * i, &number, sizeof number);
    }
    for (int i = 0; i < texture->levels; i++) {
        struct rhw_mip *const mip = &texture->mip[i];
        const size_t size = mip->row_pitch * (size_t)mip->height;
        mip->texels = texels;
        mip->linear = linear;
        texels += size;
        linear += SCALE * size;
    }
}

static void run_sample(const void *input, void *result)
{
    const struct sample_input *const in = input;
    _Alignas(RHW_ROW_ALIGNMENT) unsigned char texels[TEXTURE_BYTES], linear[2 * TEXTURE_BYTES];
    struct rhw_texture_data texture;
    struct rhw_sampler_data sampler;
    rhw_float uv[2], gradient[4], texel[4];
    const rhw_float lod = f32x8_load(in->lod);
    set_texture(&texture, in, texels, linear);
    rhw_sampler_data_init(&sampler, &in->sampler);
    const struct rhw_binding_data binding =
        rhw_binding_of(&RHW_ISA_NAME(rhw_kernels), (enum rhw_paths)in->paths, &texture, &sampler);
    memcpy(uv, in->uv, sizeof uv);
    memcpy(gradient, in->gradient, sizeof gradient);
    const struct rhw_sample_request request = {.coordinates = uv,
                                               .gradient = in->asks == ASKS_GRADIENT ? gradient : NULL,
                                               .lod = in->asks == ASKS_LOD ? &lod : NULL};
    binding.sample(&binding, &request, texel);
    memcpy(result, texel, sizeof texel);
}

// Several textures at one place, for several groups --------------------------------------------------------

enum { SLOTS = 3, GROUPS = 9, AT = 1, VARYINGS = AT + 2 }; // more groups than are sampled together

struct groups_input {
    struct sample_input slots[SLOTS]; // what else each asks for is not used
    _Alignas(32) float varyings[GROUPS][VARYINGS][8], ddx[GROUPS][VARYINGS][8], ddy[GROUPS][VARYINGS][8];
    uint32_t chosen;
    int32_t count;
};

// Mostly alike, and RGBA8 with a sampler that allows fixed point, as those of a material are.
static void make_slots(struct kernel_random *random, struct groups_input *in)
{
    const bool alike = !random_one_in(random, 4);
    for (int i = 0; i < SLOTS; i++) {
        struct sample_input *const slot = &in->slots[i];
        make_sample(random, slot);
        if (alike) {
            slot->width = in->slots[0].width;
            slot->height = in->slots[0].height;
            slot->levels = in->slots[0].levels;
            slot->sampler = random_one_in(random, 8) ? slot->sampler : in->slots[0].sampler;
            slot->format = random_one_in(random, 2) ? RHW_FORMAT_RGBA8_UNORM : RHW_FORMAT_RGBA8_SRGB;
        }
    }
}

static void make_groups(struct kernel_random *random, void *input)
{
    struct groups_input *const in = input;
    make_slots(random, in);
    in->chosen =
        random_one_in(random, 2) ? (1u << SLOTS) - 1 : (uint32_t)random_int(random, 1, (1 << SLOTS) - 1);
    in->count = (int32_t)random_int(random, 1, GROUPS);
    struct sample_input *const from = &in->slots[0];
    for (int g = 0; g < in->count; g++) {
        make_coordinates(random, from);
        for (int i = 0; i < 2; i++) {
            memcpy(in->varyings[g][AT + i], from->uv[i], sizeof from->uv[i]);
            memcpy(in->ddx[g][AT + i], from->gradient[i], sizeof from->gradient[i]);
            memcpy(in->ddy[g][AT + i], from->gradient[2 + i], sizeof from->gradient[i]);
        }
    }
}

// By group and slot.
struct groups_result {
    f32x8 together[GROUPS][SLOTS][4], alone[GROUPS][SLOTS][4];
};

struct bound_slot {
    _Alignas(RHW_ROW_ALIGNMENT) unsigned char texels[TEXTURE_BYTES], linear[2 * TEXTURE_BYTES];
    struct rhw_texture_data texture;
    struct rhw_sampler_data sampler;
};

static void bind_slots(const struct bound_slot bound[SLOTS], enum rhw_paths paths,
                       struct rhw_bindings *bindings)
{
    rhw_bindings_init(bindings, &RHW_ISA_NAME(rhw_kernels));
    for (int i = 0; i < SLOTS; i++) {
        bindings->slot[i] =
            rhw_binding_of(&RHW_ISA_NAME(rhw_kernels), paths, &bound[i].texture, &bound[i].sampler);
    }
}

// By the general path, slot by slot.
static void sample_alone(const struct rhw_bindings *bindings, const struct rhw_fragment *groups,
                         const struct groups_input *in, struct groups_result *out)
{
    for (int g = 0; g < in->count; g++) {
        const f32x8 gradient[4] = {groups[g].ddx[AT], groups[g].ddx[AT + 1], groups[g].ddy[AT],
                                   groups[g].ddy[AT + 1]};
        const struct rhw_sample_request request = {.coordinates = &groups[g].varying[AT],
                                                   .gradient = gradient};
        for (int i = 0; i < SLOTS; i++) {
            if (in->chosen >> i & 1) {
                bindings->slot[i].sample(&bindings->slot[i], &request, out->alone[g][i]);
            }
        }
    }
}

static void run_groups(const void *input, void *result)
{
    const struct groups_input *const in = input;
    struct groups_result *const out = result;
    struct bound_slot bound[SLOTS];
    struct rhw_bindings together, alone;
    struct rhw_fragment groups[GROUPS];
    memset(out, 0, sizeof *out);
    for (int i = 0; i < SLOTS; i++) {
        set_texture(&bound[i].texture, &in->slots[i], bound[i].texels, bound[i].linear);
        rhw_sampler_data_init(&bound[i].sampler, &in->slots[i].sampler);
    }
    bind_slots(bound, RHW_PATHS_ALL, &together);
    bind_slots(bound, RHW_PATHS_GENERAL, &alone);
    for (int g = 0; g < in->count; g++) {
        groups[g].varying = (const f32x8 *)(const void *)in->varyings[g];
        groups[g].ddx = (const f32x8 *)(const void *)in->ddx[g];
        groups[g].ddy = (const f32x8 *)(const void *)in->ddy[g];
        groups[g].bindings = &together;
    }
    together.kernels->sample_groups(together.slot, groups, in->count, in->chosen, AT, out->together[0],
                                    SLOTS);
    sample_alone(&alone, groups, in, out);
    unify_nans(out, sizeof *out / sizeof(float));
}

static const struct kernel_check checks[] = {
    {"sample", sizeof(struct sample_input), 4 * sizeof(f32x8), KERNEL_FLOATS, make_sample, run_sample},
    {"sample_groups", sizeof(struct groups_input), sizeof(struct groups_result), KERNEL_HALVES, make_groups,
     run_groups},
};

const struct kernel_folder RHW_ISA_NAME(check_sample) = {"sample", checks, sizeof checks / sizeof *checks};
