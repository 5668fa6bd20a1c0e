// SPDX-License-Identifier: MIT
// Sampling against texture_model.h. Samples are taken through the kernel table, so that every instruction set is judged
// by itself and against the baseline.
#include "float_bits.h"
#include "isa_support.h"
#include "texture_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "binding/binding.h"
#include "context/context.h"
#include "format/format.h"
#include "base/half.h"
#include "kernels/kernels.h"
#include "context/lookup.h"
#include "reference.h"
#include "resource/srgb_texture.h"

// What the tests sample -----------------------------------------------------------------------------

static struct rhw_sampler_def default_sampler(void)
{
    return rhw_sampler_def_default();
}

// Textures are linearized, as rhw_pass_set_texture does; samplers go with the context.
static struct rhw_binding_data bind(rhw_context *context, rhw_texture texture,
                                    const struct rhw_sampler_def *sampler, enum rhw_isa isa,
                                    enum rhw_paths paths)
{
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, "test");
    assert_int_equal(rhw_texture_linearize(context, data), RHW_OK);
    rhw_sampler made;
    assert_int_equal(rhw_sampler_create(context, sampler, &made), RHW_OK);
    return rhw_binding_of(rhw_kernels_for(isa), paths, data, rhw_context_sampler(context, made, "test"));
}

// How far a filtered sample may be off: 8-bit formats are filtered with 15-bit weights, and coordinates
// carry 24 bits, of which a level 64 texels wide takes 6.
static double tolerance(enum rhw_format format)
{
    return format < RHW_FORMAT_RGBA16_FLOAT ? 1e-4 : 4e-5;
}

// Coordinates whose products with the test's sizes are exact in float and stay clear of texel edges and
// centres, where a rounding would decide.
static float clear_coordinate(uint64_t *random)
{
    return ((float)rig_random_int(random, 4096 * 6) + 0.375f) / 4096.0f - 3.0f;
}

// From one lane to the next: up to 2 texels of the widest texture, either way.
static float clear_step(uint64_t *random)
{
    return (float)(rig_random_int(random, 257) - 128) / 4096.0f;
}

static float clear_lod(uint64_t *random)
{
    return ((float)rig_random_int(random, 9 * 16) + 0.25f) / 16.0f - 1.5f;
}

// Every isa's result on every path, which must be the same bits, in `texel`.
static void sample_all_isas(struct rhw_binding_data *binding, const rhw_float uv[2], const rhw_float grad[4],
                            const rhw_float *lod, rhw_float texel[4])
{
    const struct rhw_sample_request request = {.coordinates = uv, .gradient = grad, .lod = lod};
    *binding =
        rhw_binding_of(rhw_kernels_for(RHW_ISA_BASELINE), RHW_PATHS_ALL, binding->texture, binding->sampler);
    binding->sample(binding, &request, texel);
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        for (int paths = RHW_PATHS_ALL; paths <= RHW_PATHS_GENERAL && isa_is_there((enum rhw_isa)isa);
             paths++) {
            rhw_float other[4];
            *binding = rhw_binding_of(rhw_kernels_for((enum rhw_isa)isa), (enum rhw_paths)paths,
                                      binding->texture, binding->sampler);
            binding->sample(binding, &request, other);
            assert_memory_equal(other, texel, sizeof other);
        }
    }
}

static void random_sampler(uint64_t *random, struct rhw_sampler_def *sampler)
{
    *sampler = default_sampler();
    if (rig_random_int(random, 3) == 0) { // the fixed-point path stays well used
        sampler->address_u = (enum rhw_address)rig_random_int(random, 3);
        sampler->address_v = (enum rhw_address)rig_random_int(random, 3);
        return;
    }
    sampler->min_filter = (enum rhw_filter)rig_random_int(random, 2);
    sampler->mag_filter = (enum rhw_filter)rig_random_int(random, 2);
    sampler->mip_filter = (enum rhw_mip_filter)rig_random_int(random, 3);
    sampler->address_u = (enum rhw_address)rig_random_int(random, 4);
    sampler->address_v = (enum rhw_address)rig_random_int(random, 4);
    for (int c = 0; c < 4; c++) {
        sampler->border[c] = rig_random_float(random, -1, 1);
    }
    sampler->lod_bias = (float)rig_random_int(random, 5) - 2.0f;
    sampler->lod_min = rig_random_int(random, 4) == 0 ? 0.6875f : -1000.0f;
    sampler->lod_max = rig_random_int(random, 4) == 0 ? 1.8125f : 1000.0f;
}

static void expect_sample(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler,
                          float u, float v, double lod, const rhw_float texel[4], int lane, double allowed)
{
    double expected[4];
    model_sample(texture, sampler, (double)u, (double)v, lod, expected);
    for (int c = 0; c < 4; c++) {
        if (!(fabs((double)texel[c][lane] - expected[c]) <= allowed)) {
            fail_msg(
                "format %d, %dx%d, min %d mag %d mip %d, address %d %d, at %g %g lod %g: channel %d is %.9g, "
                "not %.9g",
                (int)texture->format, texture->mip[0].width, texture->mip[0].height, (int)sampler->min_filter,
                (int)sampler->mag_filter, (int)sampler->mip_filter, (int)sampler->address_u,
                (int)sampler->address_v, (double)u, (double)v, lod, c, (double)texel[c][lane], expected[c]);
        }
    }
}

// Tests -----------------------------------------------------------------------------------

// The order of sizes matters to nothing: some are powers of two, some odd, some have a side of 1.
static const int sizes[][2] = {{64, 64}, {16, 32}, {8, 8},   {4, 1}, {1, 8},
                               {2, 2},   {1, 1},   {48, 20}, {5, 3}, {33, 1}};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static void test_samples_follow_the_model(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 1;
    for (int n = 0; n < 16 * SAMPLED_FORMATS * SIZES; n++) {
        const enum rhw_format format = sampled_formats[n % SAMPLED_FORMATS];
        const int *const size = sizes[n / SAMPLED_FORMATS % SIZES];
        const rhw_texture texture = model_random_texture(rig.context, format, size[0], size[1],
                                                         n & 1 ? 1 : RHW_MIP_LEVELS_ALL, &random);
        struct rhw_sampler_def sampler;
        random_sampler(&random, &sampler);
        struct rhw_binding_data binding =
            bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
        for (int repeat = 0; repeat < 8; repeat++) {
            rhw_float uv[2], lod, texel[4];
            const float common = clear_lod(&random);
            const float du = clear_step(&random), dv = repeat & 4 ? clear_step(&random) : 0.0f;
            for (int i = 0; i < RHW_LANES; i++) { // lanes on a line, often a row of texels, or anywhere
                uv[0][i] = i == 0 || repeat & 1 ? clear_coordinate(&random) : uv[0][i - 1] + du;
                uv[1][i] = i == 0 || repeat & 1 ? clear_coordinate(&random) : uv[1][i - 1] + dv;
                lod[i] = repeat & 2 ? clear_lod(&random) : common;
            }
            sample_all_isas(&binding, uv, NULL, &lod, texel);
            for (int i = 0; i < RHW_LANES; i++) {
                expect_sample(binding.texture, &sampler, uv[0][i], uv[1][i], (double)lod[i], texel, i,
                              tolerance(format));
            }
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static void test_derivatives_choose_the_level(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 2;
    for (int n = 0; n < 400; n++) {
        const enum rhw_format format = n & 1 ? RHW_FORMAT_RGBA8_UNORM : RHW_FORMAT_RGBA32_FLOAT;
        const rhw_texture texture =
            model_random_texture(rig.context, format, 64, n & 2 ? 16 : 64, RHW_MIP_LEVELS_ALL, &random);
        struct rhw_sampler_def sampler = default_sampler();
        sampler.lod_bias = n & 4 ? 0.5f : 0.0f;
        struct rhw_binding_data binding =
            bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
        const struct rhw_texture_data *const data = binding.texture;
        rhw_float uv[2], grad[4], texel[4];
        const float scale = exp2f(rig_random_float(&random, -7, 1));
        for (int i = 0; i < RHW_LANES; i++) {
            uv[0][i] = clear_coordinate(&random);
            uv[1][i] = clear_coordinate(&random);
            for (int g = 0; g < 4; g++) {
                grad[g][i] = rig_random_float(&random, -scale, scale);
            }
        }
        sample_all_isas(&binding, uv, grad, NULL, texel);
        for (int i = 0; i < RHW_LANES; i++) {
            const double w = data->mip[0].width, h = data->mip[0].height;
            const double dx = hypot((double)grad[0][i] * w, (double)grad[1][i] * h);
            const double dy = hypot((double)grad[2][i] * w, (double)grad[3][i] * h);
            expect_sample(data, &sampler, uv[0][i], uv[1][i], log2(fmax(dx, dy)), texel, i,
                          format == RHW_FORMAT_RGBA8_UNORM ? 1.5e-4 : 6e-4); // texels differ by up to 8
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// What an sRGB code may become where it is filtered: 1/20 of a code off, except at the ends.
static void expect_filtered_srgb(float value, int code)
{
    const double error = ref_srgb_encode((double)value) * 255 - code;
    assert_true(fabs(error) <= 0.05);
    assert_true((code != 0 && code != 255) || (double)value == ref_srgb_decode(code / 255.0));
}

// At a texel's centre the sample is the texel: UNORM codes as the float nearest to c/255, sRGB codes as the
// float nearest to the formula where nothing is filtered or a border may be met, else as above.
static void test_texel_centres_are_exact(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    unsigned char codes[16][16][4];
    for (int i = 0; i < 256; i++) {
        const unsigned char code = (unsigned char)i;
        memcpy(codes[i / 16][i % 16], (unsigned char[4]){code, code, code, code}, 4);
    }
    for (int n = 0; n < 16; n++) {
        struct rhw_texture_def def = rhw_texture_def_default();
        def.format = n & 1 ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA8_UNORM;
        def.width = def.height = 16;
        def.mip_levels = n & 2 ? RHW_MIP_LEVELS_ALL : 1;
        struct rhw_sampler_def sampler = default_sampler();
        sampler.min_filter = sampler.mag_filter = n & 4 ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR;
        sampler.address_u = n & 8 ? RHW_ADDRESS_BORDER : RHW_ADDRESS_REPEAT;
        rhw_texture texture;
        assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
        rhw_texture_write(rig.context, texture, 0, codes, 0);
        struct rhw_binding_data binding =
            bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
        const bool linear_copy = (n & 1) && !(n & 4) && !(n & 8);
        float previous = -1;
        for (int first = 0; first < 256; first += RHW_LANES) { // eight texels of a row at once
            rhw_float uv[2] = {rhw_splat(0), rhw_splat(((float)(first / 16) + 0.5f) / 16)}, texel[4];
            for (int lane = 0; lane < RHW_LANES; lane++) {
                uv[0][lane] = ((float)((first + lane) % 16) + 0.5f) / 16;
            }
            const rhw_float lod = rhw_splat(0.0f);
            sample_all_isas(&binding, uv, NULL, &lod, texel);
            for (int lane = 0; lane < RHW_LANES; lane++) {
                const int code = first + lane;
                const float linear = (float)(code / 255.0), decoded = (float)ref_srgb_decode(code / 255.0);
                for (int c = 0; c < 4; c++) {
                    if (linear_copy && c < 3) {
                        expect_filtered_srgb(texel[c][lane], code);
                    } else {
                        assert_true(texel[c][lane] == (n & 1 && c < 3 ? decoded : linear));
                    }
                }
                assert_true(texel[0][lane] > previous);
                previous = texel[0][lane];
            }
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// All 65536 halves come out as the float they are: denormals, infinities and (quiet) NaN too.
static void test_every_half_is_converted_exactly(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA16_FLOAT;
    def.width = def.height = 128;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    uint16_t *const halves = malloc(65536 * sizeof *halves);
    for (int i = 0; i < 65536; i++) {
        halves[i] = (uint16_t)i;
    }
    rhw_texture_write(rig.context, texture, 0, halves, 0);
    struct rhw_sampler_def sampler = default_sampler();
    sampler.min_filter = sampler.mag_filter = RHW_FILTER_NEAREST;
    struct rhw_binding_data binding = bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
    for (int i = 0; i < 65536 / 4; i += RHW_LANES) { // eight texels of a row at once
        rhw_float uv[2] = {rhw_splat(0), rhw_splat(((float)(i / 128) + 0.5f) / 128)}, texel[4];
        for (int lane = 0; lane < RHW_LANES; lane++) {
            uv[0][lane] = ((float)((i + lane) % 128) + 0.5f) / 128;
        }
        const rhw_float lod = rhw_splat(0.0f);
        sample_all_isas(&binding, uv, NULL, &lod, texel);
        for (int n = 0; n < 4 * RHW_LANES; n++) {
            const float expected = rhw_half_to_float(halves[4 * i + n]), value = texel[n % 4][n / 4];
            assert_memory_equal(&value, &expected, sizeof value);
        }
    }
    free(halves);
    rhw_texture_destroy(rig.context, texture);
    rig_close(&rig);
}

// A texture of one colour has that colour everywhere, to the bit, at any level of detail.
static void test_one_colour_stays_one_colour(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 3;
    for (int code = 0; code < 256; code++) {
        struct rhw_texture_def def = rhw_texture_def_default();
        def.width = 16;
        def.height = 7;
        def.mip_levels = RHW_MIP_LEVELS_ALL;
        def.format = code & 1 ? RHW_FORMAT_RGBA8_UNORM : RHW_FORMAT_RGBA8_SRGB;
        rhw_texture texture;
        assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
        unsigned char texels[16 * 7 * 4];
        memset(texels, code, sizeof texels);
        rhw_texture_write(rig.context, texture, 0, texels, 0);
        rhw_texture_generate_mips(rig.context, texture);
        const struct rhw_sampler_def sampler = default_sampler();
        struct rhw_binding_data binding =
            bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
        float srgb = 0;
        for (int n = 0; n < 16; n++) {
            rhw_float uv[2], lod, texel[4];
            for (int i = 0; i < RHW_LANES; i++) {
                uv[0][i] = rig_random_float(&random, -3, 3);
                uv[1][i] = rig_random_float(&random, -3, 3);
                lod[i] = rig_random_float(&random, -1, 5);
            }
            sample_all_isas(&binding, uv, NULL, &lod, texel);
            const float linear = (float)(code / 255.0);
            for (int i = 0; i < RHW_LANES; i++) {
                if (code & 1) {
                    assert_true(texel[0][i] == linear);
                } else {
                    expect_filtered_srgb(texel[0][i], code);
                    assert_true(n == 0 || texel[0][i] == srgb);
                    srgb = texel[0][i];
                }
                assert_true(texel[3][i] == linear);
            }
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// Coordinates and gradients within one level or across some, inside the texture or over its edges.
static void random_footprint(uint64_t *random, rhw_float uv[2], rhw_float grad[4])
{
    const float spread = rig_random_int(random, 4) == 0 ? 1.0f : 0.01f;
    const bool even = rig_random_int(random, 3) != 0;
    const float size = rig_random_float(random, 0.001f, 0.2f);
    const float u = rig_random_float(random, -2, 2), v = rig_random_float(random, -2, 2);
    for (int i = 0; i < RHW_LANES; i++) {
        uv[0][i] = u + spread * rig_random_float(random, -1, 1);
        uv[1][i] = v + spread * rig_random_float(random, -1, 1);
        for (int k = 0; k < 4; k++) {
            grad[k][i] = size * (even ? 1.0f + 0.001f * (float)i : rig_random_float(random, -1, 1));
        }
    }
}

enum { SLOTS = 6 };

enum { GROUPS = 16, VARYINGS = 5 };

// What rhw_sample_groups1 gives each lane of a group, slots that it does not name included.
static void sample_one_at_a_time(const struct rhw_fragment *group, uint32_t slots, int at,
                                 rhw_float texels[SLOTS + 1][4])
{
    for (int lane = 0; lane < RHW_LANES; lane++) {
        float varying[VARYINGS], ddx[VARYINGS], ddy[VARYINGS], one[SLOTS + 1][4];
        memset(one, 0x5a, sizeof one);
        for (int i = 0; i < VARYINGS; i++) {
            varying[i] = group->varying[i][lane];
            ddx[i] = group->ddx[i][lane];
            ddy[i] = group->ddy[i][lane];
        }
        rhw_sample_groups1(
            &(struct rhw_fragment1){.varying = varying, .ddx = ddx, .ddy = ddy, .bindings = group->bindings},
            slots, at, one);
        for (int i = 0; i < (SLOTS + 1) * 4; i++) {
            texels[i / 4][i % 4][lane] = one[i / 4][i % 4];
        }
    }
}

// Every subset of the slots gives each of its textures the bits that it has alone, for any number of groups, at any
// varyings, and leaves the others be; one fragment at a time too.
static void expect_groups_as_alone(const struct rhw_bindings *bindings, uint64_t *random)
{
    static rhw_float varying[GROUPS][VARYINGS], ddx[GROUPS][VARYINGS], ddy[GROUPS][VARYINGS];
    static rhw_float texels[GROUPS][SLOTS + 1][4];
    const uint32_t slots = 1 + (uint32_t)rig_random_int(random, (1 << SLOTS) - 1);
    const int count = 1 + rig_random_int(random, GROUPS), at = rig_random_int(random, VARYINGS - 1);
    struct rhw_fragment groups[GROUPS];
    memset(groups, 0, sizeof groups);
    memset(texels, 0x5a, sizeof texels);
    for (int g = 0; g < count; g++) {
        rhw_float grad[4];
        random_footprint(random, &varying[g][at], grad);
        ddx[g][at] = grad[0];
        ddx[g][at + 1] = grad[1];
        ddy[g][at] = grad[2];
        ddy[g][at + 1] = grad[3];
        groups[g].varying = varying[g];
        groups[g].ddx = ddx[g];
        groups[g].ddy = ddy[g];
        groups[g].bindings = bindings;
    }
    rhw_sample_groups(groups, count, slots, at, texels[0], SLOTS + 1);
    for (int g = 0; g < count; g++) {
        rhw_float one_at_a_time[SLOTS + 1][4];
        sample_one_at_a_time(&groups[g], slots, at, one_at_a_time);
        assert_memory_equal(one_at_a_time, texels[g], sizeof one_at_a_time);
    }
    for (int g = 0; g < GROUPS; g++) {
        for (int i = 0; i < SLOTS + 1; i++) {
            rhw_float alone[4];
            memset(alone, 0x5a, sizeof alone);
            if (g < count && slots >> i & 1) {
                const rhw_float grad[4] = {ddx[g][at], ddx[g][at + 1], ddy[g][at], ddy[g][at + 1]};
                rhw_sample_grad(bindings, i, &varying[g][at], grad, alone);
            }
            assert_memory_equal(texels[g][i], alone, sizeof alone);
        }
    }
}

// Textures of one size and of others, of every kind of format, with equal samplers and other ones, and none.
static void test_slots_sampled_at_once(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB,
                                              RHW_FORMAT_RGBA16_FLOAT};
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 11;
    for (int round = 0; round < 45; round++) {
        const enum rhw_isa isa = (enum rhw_isa)(round % RHW_ISA_COUNT);
        const enum rhw_paths paths = round % 4 == 0 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL;
        struct rhw_sampler_def samplers[SLOTS];
        struct rhw_bindings bindings;
        rhw_texture textures[SLOTS];
        if (!isa_is_there(isa)) {
            continue;
        }
        rhw_bindings_init(&bindings, rhw_kernels_for(isa));
        random_sampler(&random, &samplers[0]);
        for (int i = 0; i < SLOTS; i++) {
            const bool other = rig_random_int(&random, 5) == 0;
            textures[i] = model_random_texture(rig.context, formats[rig_random_int(&random, other ? 3 : 2)],
                                               other ? 32 : 64, 64, RHW_MIP_LEVELS_ALL, &random);
            samplers[i] = samplers[0];
            samplers[i].lod_bias += rig_random_int(&random, 6) == 0 ? 1.0f : 0.0f;
            samplers[i].max_anisotropy = rig_random_int(&random, 6) == 0 ? 8.0f : samplers[i].max_anisotropy;
            bindings.slot[i] = bind(rig.context, textures[i], &samplers[i], isa, paths);
            if (rig_random_int(&random, 12) == 0) {
                bindings.slot[i] = rhw_binding_of(rhw_kernels_for(isa), paths, NULL, NULL);
            }
        }
        for (int n = 0; n < 100; n++) {
            expect_groups_as_alone(&bindings, &random);
        }
        for (int i = 0; i < SLOTS; i++) {
            rhw_texture_destroy(rig.context, textures[i]);
        }
    }
    rig_close(&rig);
}

static void texture_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_sample_lod(groups[g].bindings, 0, groups[g].varying, rhw_splat(0.0f), groups[g].color[0]);
    }
}

// The first pixel of a pass that samples `texture` with coordinates 0.5, 0.5.
static float sampled_by_pass(struct rig *rig, rhw_texture texture, rhw_sampler sampler)
{
    const float center[4] = {0.5f, 0.5f, 0, 0};
    struct rig_vertex vertices[6];
    rig_cover(rig, 0.5f, center, vertices);
    rig_set_program(rig, rig_vertex_pass, texture_fragment);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, texture, sampler);
    rig_draw(rig, vertices, 6);
    rig_end(rig);
    return rig_read_float4(rig)[0][0];
}

// Whatever changes the texels of an sRGB texture, the next pass that samples it sees them: writing, generated
// levels, drawing.
static void test_the_linear_copy_follows_the_texels(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const struct rhw_sampler_def sampler_def = default_sampler();
    rhw_sampler sampler, top;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    struct rhw_sampler_def top_def = sampler_def;
    top_def.lod_min = 3; // the last level
    assert_int_equal(rhw_sampler_create(rig.context, &top_def, &top), RHW_OK);
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_SRGB;
    def.width = def.height = 8;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    expect_filtered_srgb(sampled_by_pass(&rig, texture, sampler), 0);
    unsigned char texels[8 * 8 * 4];
    memset(texels, 90, sizeof texels);
    rhw_texture_write(rig.context, texture, 0, texels, 0);
    expect_filtered_srgb(sampled_by_pass(&rig, texture, sampler), 90);
    expect_filtered_srgb(sampled_by_pass(&rig, texture, top), 0);
    rhw_texture_generate_mips(rig.context, texture);
    expect_filtered_srgb(sampled_by_pass(&rig, texture, top), 90);
    struct rhw_pass_def pass = rhw_pass_def_default();
    pass.color_count = 1;
    pass.colors[0].texture = texture;
    pass.colors[0].clear[0] = 1;
    rhw_pass recording;
    assert_int_equal(rhw_pass_begin(rig.context, &pass, &recording), RHW_OK);
    assert_int_equal(rhw_pass_end(rig.context, recording, NULL), RHW_OK);
    expect_filtered_srgb(sampled_by_pass(&rig, texture, sampler), 255);
    rig_close(&rig);
}

// What a lane gets does not depend on its neighbours, and the one-at-a-time form gives the same bits.
static void test_lanes_are_independent(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 4;
    for (int n = 0; n < 600; n++) {
        const rhw_texture texture = model_random_texture(rig.context, sampled_formats[n % SAMPLED_FORMATS],
                                                         32, 32, RHW_MIP_LEVELS_ALL, &random);
        struct rhw_sampler_def sampler;
        random_sampler(&random, &sampler);
        struct rhw_binding_data binding =
            bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
        rhw_float uv[2], grad[4], lod, texel[4];
        for (int i = 0; i < RHW_LANES; i++) {
            uv[0][i] = rig_random_float(&random, -2, 2);
            uv[1][i] = rig_random_float(&random, -2, 2);
            lod[i] = n & 8 ? (float)rig_random_int(&random, 7) : rig_random_float(&random, -2, 8);
            for (int g = 0; g < 4; g++) {
                grad[g][i] = rig_random_float(&random, -0.1f, 0.1f);
            }
        }
        sample_all_isas(&binding, uv, n & 1 ? grad : NULL, &lod, texel);
        struct rhw_bindings bindings;
        rhw_bindings_init(&bindings, rhw_kernels_for(RHW_ISA_BASELINE));
        bindings.slot[3] = binding;
        for (int i = 0; i < RHW_LANES; i++) {
            const float at[2] = {uv[0][i], uv[1][i]};
            const float slope[4] = {grad[0][i], grad[1][i], grad[2][i], grad[3][i]};
            float single[4];
            if (n & 1) {
                rhw_sample_grad1(&bindings, 3, at, slope, single);
            } else {
                rhw_sample_lod1(&bindings, 3, at, lod[i], single);
            }
            for (int c = 0; c < 4; c++) {
                const float lane = texel[c][i];
                assert_memory_equal(&single[c], &lane, sizeof lane);
            }
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// Any bits as coordinates, slopes and levels: nothing outside the texture is read (a sanitizer sees that),
// and what comes out lies between the texels.
static void test_hostile_coordinates(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    static const float special[] = {NAN,    INFINITY,    -INFINITY, 3e38f,         -3e38f,
                                    1e-45f, -1e-45f,     0.0f,      -0.0f,         1.0f,
                                    -1.0f,  0.99999994f, 2.0f,      2147483648.0f, 16777217.0f};
    uint64_t random = 5;
    for (int n = 0; n < 300; n++) {
        const int *const size = sizes[n % SIZES];
        const enum rhw_format format = n & 1 ? RHW_FORMAT_RGBA8_UNORM : sampled_formats[n / 2 % 4];
        const rhw_texture texture =
            model_random_texture(rig.context, format, size[0], size[1], RHW_MIP_LEVELS_ALL, &random);
        struct rhw_sampler_def sampler;
        random_sampler(&random, &sampler);
        memset(sampler.border, 0, sizeof sampler.border);
        struct rhw_binding_data binding =
            bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
        for (int repeat = 0; repeat < 20; repeat++) {
            rhw_float in[7], texel[4];
            for (int j = 0; j < 7; j++) {
                for (int i = 0; i < RHW_LANES; i++) {
                    const float value = from_bits((uint32_t)rig_random(&random));
                    in[j][i] = rig_random_int(&random, 3) ? value : special[rig_random_int(&random, 15)];
                }
            }
            sample_all_isas(&binding, in, repeat & 1 ? in + 2 : NULL, repeat & 2 ? &in[6] : NULL, texel);
            for (int i = 0; i < RHW_LANES; i++) {
                for (int c = 0; c < 4; c++) {
                    assert_true(texel[c][i] >= 0.0f && texel[c][i] <= 1.0f);
                }
            }
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// Slopes that are not numbers, of either sign, mean the last level, as endless ones do.
static void test_a_nan_slope_means_the_last_level(void **state)
{
    (void)state;
    static const uint32_t slopes[] = {0x7fc00000, 0xffc00000, 0x7f800001, 0xffffffff, 0x7f800000, 0xff800000};
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 9;
    for (int n = 0; n < 2; n++) {
        const enum rhw_format format = n ? RHW_FORMAT_RGBA8_UNORM : RHW_FORMAT_RGBA32_FLOAT;
        const rhw_texture texture =
            model_random_texture(rig.context, format, 64, 64, RHW_MIP_LEVELS_ALL, &random);
        const struct rhw_sampler_def sampler = default_sampler();
        struct rhw_binding_data binding =
            bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
        for (size_t i = 0; i < sizeof slopes / sizeof slopes[0]; i++) {
            const rhw_float uv[2] = {rhw_splat(0.3f), rhw_splat(0.8f)}, lod = rhw_splat(6.0f);
            const rhw_float slope = rhw_float_from_bits(rhw_splat_int((int32_t)slopes[i]));
            const rhw_float grad[4] = {slope, slope, slope, slope};
            rhw_float texel[4], last[4];
            sample_all_isas(&binding, uv, grad, NULL, texel);
            sample_all_isas(&binding, uv, NULL, &lod, last);
            assert_memory_equal(texel, last, sizeof last);
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// Outside, a format has the channels of the border that it has of texels (Vulkan 1.3, "Texel Replacement").
static void test_a_border_has_the_channels_of_the_format(void **state)
{
    (void)state;
    static const struct {
        enum rhw_format format;
        float outside[4];
    } cases[] = {
        {RHW_FORMAT_R8_UNORM, {0.25f, 0, 0, 1}},
        {RHW_FORMAT_RG16_FLOAT, {0.25f, 0.5f, 0, 1}},
        {RHW_FORMAT_R32_FLOAT, {0.25f, 0, 0, 1}},
        {RHW_FORMAT_RGB565_UNORM, {0.25f, 0.5f, 0.75f, 1}},
        {RHW_FORMAT_D32_FLOAT, {0.25f, 0, 0, 1}},
        {RHW_FORMAT_RG11B10_FLOAT, {0.25f, 0.5f, 0.75f, 1}},
        {RHW_FORMAT_RGBA8_UNORM, {0.25f, 0.5f, 0.75f, 0}},
        {RHW_FORMAT_BGRA8_UNORM, {0.25f, 0.5f, 0.75f, 0}},
        {RHW_FORMAT_R8_UINT, {5, 0, 0, 1}},
        {RHW_FORMAT_RG32_SINT, {5, 6, 0, 1}},
        {RHW_FORMAT_RGBA16_UINT, {5, 6, 7, 8}},
    };
    struct rig rig;
    rig_open(&rig, 8, 8);
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        struct rhw_texture_def def = rhw_texture_def_default();
        def.format = cases[n].format;
        def.width = def.height = 4;
        rhw_texture texture;
        assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
        const bool is_integer = rhw_format_is_integer(rhw_format_info(def.format));
        // Filters, of integers the nearest, along one axis and both, and an anisotropic one.
        for (int mode = is_integer; mode < 4; mode += 1 + is_integer) {
            const struct rhw_sampler_def sampler = {
                .min_filter = mode % 2 ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR,
                .mag_filter = mode % 2 ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR,
                .address_u = RHW_ADDRESS_BORDER,
                .address_v = mode / 2 ? RHW_ADDRESS_BORDER : RHW_ADDRESS_REPEAT,
                .border = {0.25f, 0.5f, 0.75f, 0},
                .border_integer = {5, 6, 7, 8},
                .max_anisotropy = mode == 2 ? 4 : 0};
            struct rhw_binding_data binding =
                bind(rig.context, texture, &sampler, RHW_ISA_BASELINE, RHW_PATHS_ALL);
            const rhw_float uv[2] = {rhw_splat(-2.5f), rhw_splat(0.5f)}, lod = rhw_splat(0.0f);
            rhw_float texel[4];
            sample_all_isas(&binding, uv, NULL, &lod, texel);
            for (int c = 0; c < 4; c++) {
                const float seen = is_integer ? (float)((rhw_int)texel[c])[3] : texel[c][3];
                assert_true(seen == cases[n].outside[c]);
            }
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static void test_an_unbound_slot_samples_opaque_black(void **state)
{
    (void)state;
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (isa_is_there((enum rhw_isa)isa)) {
            struct rhw_bindings bindings;
            rhw_bindings_init(&bindings, rhw_kernels_for((enum rhw_isa)isa));
            const float uv[2] = {0.3f, NAN}, expected[4] = {0, 0, 0, 1};
            float texel[4];
            rhw_sample_lod1(&bindings, 5, uv, 2.0f, texel);
            assert_memory_equal(texel, expected, sizeof texel);
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_samples_follow_the_model),
    cmocka_unit_test(test_derivatives_choose_the_level),
    cmocka_unit_test(test_texel_centres_are_exact),
    cmocka_unit_test(test_every_half_is_converted_exactly),
    cmocka_unit_test(test_one_colour_stays_one_colour),
    cmocka_unit_test(test_slots_sampled_at_once),
    cmocka_unit_test(test_the_linear_copy_follows_the_texels),
    cmocka_unit_test(test_lanes_are_independent),
    cmocka_unit_test(test_hostile_coordinates),
    cmocka_unit_test(test_a_nan_slope_means_the_last_level),
    cmocka_unit_test(test_a_border_has_the_channels_of_the_format),
    cmocka_unit_test(test_an_unbound_slot_samples_opaque_black),
};

const struct unit_tests test_sample = UNIT_TESTS(tests, NULL, NULL);
