// SPDX-License-Identifier: MIT
// What shaders ask of textures beside filtered samples, and filters that do not average: by hand, on few texels.
#include "harness.h"

#include <math.h>
#include <string.h>

#include "binding/binding.h"
#include "context/context.h"
#include "context/lookup.h"
#include "resource/sampler.h"

enum { SLOT = 0 };

// Texel x, y of level l and slice s holds 1000·l + 100·s + 10·y + x.
static rhw_texture numbered(struct rig *rig, struct rhw_texture_def def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    for (int level = 0; level < rhw_texture_mip_levels(rig->context, texture); level++) {
        const int width = rhw_texture_width(rig->context, texture, level),
                  height = rhw_texture_height(rig->context, texture, level);
        const int slices =
            rhw_texture_depth(rig->context, texture, level) * rhw_texture_layers(rig->context, texture);
        for (int slice = 0; slice < slices; slice++) {
            float texels[256];
            for (int i = 0; i < width * height; i++) {
                texels[i] = (float)(1000 * level + 100 * slice + 10 * (i / width) + i % width);
            }
            assert_int_equal(rhw_texture_write_layer(rig->context, texture, level, slice, texels, 0), RHW_OK);
        }
    }
    return texture;
}

struct bound {
    struct rhw_sampler_data sampler;
    struct rhw_bindings bindings;
};

static void bind(struct bound *bound, struct rig *rig, rhw_texture texture, const struct rhw_sampler_def *def)
{
    const struct rhw_kernels *const kernels = rhw_kernels_for(RHW_ISA_BASELINE);
    rhw_sampler_data_init(&bound->sampler, def);
    rhw_bindings_init(&bound->bindings, kernels);
    bound->bindings.slot[SLOT] = rhw_binding_of(
        kernels, RHW_PATHS_ALL, rhw_context_texture(rig->context, texture, "test"), &bound->sampler);
}

static void expect_fetch(const struct bound *bound, const int32_t *at, int32_t level, float red)
{
    float texel[4];
    rhw_sample_fetch1(&bound->bindings, SLOT, at, level, texel);
    assert_true(texel[0] == red && texel[1] == 0 && texel[2] == 0 && texel[3] == 1);
}

// Without a level plain textures are fetched from level 0 by a way of their own: 8 texels about (x, y), inside and out.
static void expect_plain_fetch(const struct bound *bound, int x, int y, int width, int height)
{
    rhw_int at[2];
    rhw_float texel[4];
    for (int lane = 0; lane < RHW_LANES; lane++) {
        at[0][lane] = (int32_t)((uint32_t)x + (uint32_t)lane % 3 - 1); // beyond the last number as well
        at[1][lane] = (int32_t)((uint32_t)y + (uint32_t)lane / 3 - 1);
    }
    rhw_sample_fetch(&bound->bindings, SLOT, at, NULL, texel);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const int column = at[0][lane], row = at[1][lane];
        const bool inside = column >= 0 && column < width && row >= 0 && row < height;
        assert_true(texel[0][lane] == (inside ? (float)(10 * row + column) : 0));
        assert_true(texel[1][lane] == 0 && texel[2][lane] == 0 && texel[3][lane] == 1);
    }
}

static void test_fetch(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    const struct rhw_sampler_def def = {0};
    const struct rhw_texture_def plain = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 5, .height = 3, .mip_levels = 3};
    bind(&bound, &rig, numbered(&rig, plain), &def);
    static const struct {
        int32_t at[2], level;
        float red;
    } cases[] = {{{4, 2}, 0, 24},       {{1, 0}, 1, 1001}, {{0, 0}, 2, 2000},      {{5, 2}, 0, 0},
                 {{-1, 0}, 0, 0},       {{0, 3}, 0, 0},    {{0, -1}, 0, 0},        {{2, 0}, 1, 0},
                 {{0, 0}, 3, 0},        {{0, 0}, -1, 0},   {{INT32_MAX, 0}, 0, 0}, {{0, INT32_MIN}, 0, 0},
                 {{0, 0}, INT32_MAX, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        expect_fetch(&bound, cases[i].at, cases[i].level, cases[i].red);
    }
    const struct rhw_texture_def wide = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 16, .height = 3}; // no padding
    const int32_t edges[][2] = {{0, 0}, {15, 0}, {0, 2}, {15, 2}, {INT32_MAX - 1, 1}, {2, INT32_MIN + 1}};
    bind(&bound, &rig, numbered(&rig, wide), &def);
    for (size_t i = 0; i < sizeof edges / sizeof *edges; i++) {
        expect_plain_fetch(&bound, edges[i][0], edges[i][1], wide.width, wide.height);
    }
    const struct rhw_texture_def volume = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 4, .height = 4, .depth = 3, .kind = RHW_TEXTURE_3D};
    bind(&bound, &rig, numbered(&rig, volume), &def);
    expect_fetch(&bound, (const int32_t[]){3, 1, 2}, 0, 213);
    expect_fetch(&bound, (const int32_t[]){3, 1, 3}, 0, 0);
    const struct rhw_texture_def cubes = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 2, .height = 2, .layers = 2, .kind = RHW_TEXTURE_CUBE};
    bind(&bound, &rig, numbered(&rig, cubes), &def);
    expect_fetch(&bound, (const int32_t[]){1, 0, 11}, 0, 1101);
    const struct rhw_texture_def lines = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 6, .layers = 2, .kind = RHW_TEXTURE_1D};
    bind(&bound, &rig, numbered(&rig, lines), &def);
    expect_fetch(&bound, (const int32_t[]){5, 1}, 0, 105);
    // Channels that the format has are 0 outside, alpha with them.
    const struct rhw_texture_def rgba = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 1, .height = 1};
    float texel[4];
    bind(&bound, &rig, numbered(&rig, rgba), &def);
    rhw_sample_fetch1(&bound.bindings, SLOT, (const int32_t[]){0, 1}, 0, texel);
    assert_true(texel[0] == 0 && texel[3] == 0);
    rhw_sample_fetch1(&bound.bindings, SLOT + 1, (const int32_t[]){0, 0}, 0, texel);
    assert_true(texel[0] == 0 && texel[3] == 1);
    rig_close(&rig);
}

static void test_sizes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    const struct rhw_sampler_def def = {0};
    const struct rhw_texture_def volume = {.format = RHW_FORMAT_R32_FLOAT,
                                           .width = 10,
                                           .height = 4,
                                           .depth = 6,
                                           .mip_levels = RHW_MIP_LEVELS_ALL,
                                           .kind = RHW_TEXTURE_3D};
    const struct rhw_texture_def cubes = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 4, .height = 4, .layers = 3, .kind = RHW_TEXTURE_CUBE};
    int32_t size[3];
    bind(&bound, &rig, numbered(&rig, volume), &def);
    assert_int_equal(rhw_sample_levels(&bound.bindings, SLOT), 4);
    assert_int_equal(rhw_sample_levels(&bound.bindings, SLOT + 1), 0);
    rhw_sample_size1(&bound.bindings, SLOT, 1, size);
    assert_true(size[0] == 5 && size[1] == 2 && size[2] == 3);
    rhw_sample_size1(&bound.bindings, SLOT, 3, size);
    assert_true(size[0] == 1 && size[1] == 1 && size[2] == 1);
    rhw_sample_size1(&bound.bindings, SLOT, 4, size);
    assert_true(size[0] == 0 && size[1] == 0 && size[2] == 0);
    bind(&bound, &rig, numbered(&rig, cubes), &def);
    rhw_sample_size1(&bound.bindings, SLOT, 0, size);
    assert_true(size[0] == 4 && size[1] == 4 && size[2] == 18);
    rig_close(&rig);
}

// What there is of a multisampled array, which is not sampled.
static void test_samples(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    const struct rhw_sampler_def def = {0};
    for (int samples = 1; samples <= 16; samples *= 2) {
        const struct rhw_texture_def layers = {
            .format = RHW_FORMAT_R32_FLOAT, .width = 7, .height = 5, .layers = 3, .samples = samples};
        rhw_texture texture;
        assert_int_equal(rhw_texture_create(rig.context, &layers, &texture), RHW_OK);
        bind(&bound, &rig, texture, &def);
        assert_int_equal(rhw_sample_samples(&bound.bindings, SLOT), samples);
        assert_int_equal(rhw_sample_levels(&bound.bindings, SLOT), 1);
        int32_t size[3];
        rhw_sample_size1(&bound.bindings, SLOT, 0, size);
        assert_true(size[0] == 7 && size[1] == 5 && size[2] == 3);
        rhw_sample_size1(&bound.bindings, SLOT, 1, size);
        assert_true(size[0] == 0 && size[1] == 0 && size[2] == 0);
    }
    assert_int_equal(rhw_sample_samples(&bound.bindings, SLOT + 1), 0);
    assert_int_equal(rhw_sample_samples(&bound.bindings, -1), 0);
    assert_int_equal(rhw_sample_samples(&bound.bindings, RHW_MAX_TEXTURES), 0);
    rig_close(&rig);
}

static void expect_four(const struct bound *bound, const struct rhw_sample_request1 *request, int channel,
                        float a, float b, float c, float d)
{
    float texel[4];
    rhw_sample_gather1(&bound->bindings, SLOT, request, channel, texel);
    assert_true(texel[0] == a && texel[1] == b && texel[2] == c && texel[3] == d);
}

static void test_gather(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST, .address_v = RHW_ADDRESS_CLAMP};
    const struct rhw_texture_def plain = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 4, .height = 4, .layers = 2};
    const rhw_texture texture = numbered(&rig, plain);
    const float at[3] = {0.5f, 0.5f, 1}, edge[3] = {0, 0, 0}, reference = 111;
    const int32_t offset[2] = {1, -5};
    struct rhw_sample_request1 request = {.coordinates = at};
    bind(&bound, &rig, texture, &def);
    expect_four(&bound, &request, 0, 121, 122, 112, 111);
    expect_four(&bound, &request, 1, 0, 0, 0, 0);
    expect_four(&bound, &request, 3, 1, 1, 1, 1); // which the format lacks
    request.offset = offset;
    expect_four(&bound, &request, 0, 102, 103, 103, 102);
    request = (struct rhw_sample_request1){.coordinates = edge}; // u repeats
    expect_four(&bound, &request, 0, 3, 0, 0, 3);
    def.compares = true;
    def.compare = RHW_COMPARE_GREATER_EQUAL;
    bind(&bound, &rig, texture, &def);
    request = (struct rhw_sample_request1){.coordinates = at, .reference = &reference};
    expect_four(&bound, &request, 2, 0, 0, 0, 1);
    // Three texels around a corner of a cube, and their average.
    const struct rhw_texture_def cube = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 1, .height = 1, .kind = RHW_TEXTURE_CUBE};
    const struct rhw_sampler_def linear = {0};
    const float corner[3] = {-0.9f, -0.9f, 1};
    bind(&bound, &rig, numbered(&rig, cube), &linear);
    request = (struct rhw_sample_request1){.coordinates = corner};
    expect_four(&bound, &request, 0, (100 + 300 + 400) / 3.0f, 300, 400, 100);
    rig_close(&rig);
}

static float sample_red(const struct bound *bound, const float *at, float lod)
{
    float texel[4];
    rhw_sample_lod1(&bound->bindings, SLOT, at, lod, texel);
    return texel[0];
}

static void test_reductions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    struct rhw_sampler_def def = {.reduction = RHW_REDUCTION_MIN};
    const struct rhw_texture_def plain = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 4, .height = 4, .mip_levels = 2};
    const rhw_texture texture = numbered(&rig, plain);
    const float middle[2] = {0.5f, 0.5f}, center[2] = {0.375f, 0.5f};
    bind(&bound, &rig, texture, &def);
    assert_true(sample_red(&bound, middle, 0) == 11);
    assert_true(sample_red(&bound, center, 0) == 11);
    assert_true(sample_red(&bound, middle, 0.5f) == 11);
    def.reduction = RHW_REDUCTION_MAX;
    bind(&bound, &rig, texture, &def);
    assert_true(sample_red(&bound, middle, 0) == 22);
    assert_true(sample_red(&bound, center, 0) == 21); // the texels to the right have no weight
    assert_true(sample_red(&bound, middle, 0.5f) == 1011);
    rig_close(&rig);
}

// The level that a sample is from: numbered() has it in the thousands.
static int level_of(const struct bound *bound, const struct rhw_sample_request1 *request)
{
    float texel[4];
    rhw_sample1(&bound->bindings, SLOT, request, texel);
    return (int)(texel[0] / 1000);
}

// Gradients of two texels of level 0 ask for level 1.
static void test_bias(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    static const struct {
        enum rhw_texture_kind kind;
        int layers;
        float gradient[6];
    } cases[] = {{RHW_TEXTURE_1D, 0, {0.25f}},
                 {RHW_TEXTURE_2D, 0, {0.25f, 0, 0, 0.125f}},
                 {RHW_TEXTURE_2D, 2, {0.125f, 0, 0, 0.25f}},
                 {RHW_TEXTURE_3D, 0, {0, 0, 0, 0, 0, 0.25f}},
                 {RHW_TEXTURE_CUBE, 0, {0, 0, 0, 0, 0.5f, 0}}}; // a face is 2 wide
    static const float at[4] = {1, 0.1f, 0.1f, 0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const bool is_line = cases[i].kind == RHW_TEXTURE_1D, is_volume = cases[i].kind == RHW_TEXTURE_3D;
        const struct rhw_texture_def def = {.format = RHW_FORMAT_R32_FLOAT,
                                            .kind = cases[i].kind,
                                            .layers = cases[i].layers,
                                            .width = 8,
                                            .height = is_line ? 1 : 8,
                                            .depth = is_volume ? 8 : 0,
                                            .mip_levels = 4};
        const rhw_texture texture = numbered(&rig, def);
        for (int way = 0; way < 3; way++) {
            const bool by_sampler = way == 1, anisotropic = way == 2;
            const struct rhw_sampler_def sampler = {.mip_filter = RHW_MIP_FILTER_NEAREST,
                                                    .min_filter = RHW_FILTER_NEAREST,
                                                    .mag_filter = RHW_FILTER_NEAREST,
                                                    .lod_bias = by_sampler ? 1 : 0,
                                                    .lod_max = by_sampler ? 2 : 0,
                                                    .max_anisotropy = anisotropic ? 4 : 0};
            bind(&bound, &rig, texture, &sampler);
            // Four samples along the one axis there is have a quarter of its length each.
            const bool is_long = anisotropic && cases[i].kind != RHW_TEXTURE_2D;
            const int own = by_sampler ? 2 : is_long ? -1 : anisotropic ? 0 : 1;
            for (float bias = -3; bias <= 4; bias++) {
                const int wanted = own + (int)bias, most = by_sampler ? 2 : 3;
                const int expected = wanted < 0 ? 0 : wanted > most ? most : wanted;
                const struct rhw_sample_request1 along = {
                    .coordinates = at, .gradient = cases[i].gradient, .bias = &bias};
                assert_int_equal(level_of(&bound, &along), expected);
                float texel[4];
                rhw_sample_bias1(&bound.bindings, SLOT, at, cases[i].gradient, bias, texel);
                assert_int_equal((int)(texel[0] / 1000), expected);
                float lods[2];
                rhw_sample_query_lod1(&bound.bindings, SLOT, &along, lods);
                assert_true((int)lods[0] == expected && lods[1] == (float)wanted);
                // A level that is given is biased as well; an offset is kept.
                const float one = is_long ? -1 : anisotropic ? 0 : 1;
                const int32_t offset[3] = {0, 0, 0};
                const struct rhw_sample_request1 given = {
                    .coordinates = at, .lod = &one, .bias = &bias, .offset = offset};
                assert_int_equal(level_of(&bound, &given), expected);
            }
        }
    }
    // Nothing is bound: no texel, whatever the bias.
    rhw_bindings_init(&bound.bindings, rhw_kernels_for(RHW_ISA_BASELINE));
    float texel[4];
    rhw_sample_bias1(&bound.bindings, SLOT, at, cases[1].gradient, 1, texel);
    assert_true(texel[0] == 0 && texel[3] == 1);
    rig_close(&rig);
}

// The fast paths of 8 bits take a biased level as they take one that is given.
static void test_bias_of_bytes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    const struct rhw_sampler_def sampler = {0};
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = 16, .height = 16, .mip_levels = RHW_MIP_LEVELS_ALL};
    rhw_texture texture;
    uint8_t texels[16 * 16 * 4];
    for (size_t i = 0; i < sizeof texels; i++) {
        texels[i] = (uint8_t)(i * i * 7 + i / 64 * 31);
    }
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    assert_int_equal(rhw_texture_write(rig.context, texture, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_texture_generate_mips(rig.context, texture), RHW_OK);
    bind(&bound, &rig, texture, &sampler);
    const rhw_float lanes = rhw_float_from_int(rhw_lane_numbers());
    const rhw_float coordinates[2] = {lanes * 0.11f, lanes * 0.07f};
    const rhw_float gradient[4] = {rhw_splat(0.0625f), rhw_splat(0), rhw_splat(0), rhw_splat(0.0625f)};
    const rhw_float bias = lanes * 0.37f - 0.5f;
    rhw_float biased[4], given[4];
    rhw_sample_bias(&bound.bindings, SLOT, coordinates, gradient, bias, biased);
    rhw_sample_lod(&bound.bindings, SLOT, coordinates, bias, given);
    assert_memory_equal(biased, given, sizeof given);
    rig_close(&rig);
}

static void test_coordinates_in_texels(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST,
                                  .mag_filter = RHW_FILTER_NEAREST,
                                  .mip_filter = RHW_MIP_FILTER_NONE,
                                  .address_u = RHW_ADDRESS_CLAMP,
                                  .address_v = RHW_ADDRESS_BORDER,
                                  .border = {-5, 0, 0, 0},
                                  .unnormalized = true};
    const struct rhw_texture_def plain = {.format = RHW_FORMAT_R32_FLOAT, .width = 7, .height = 5};
    const rhw_texture texture = numbered(&rig, plain);
    bind(&bound, &rig, texture, &def);
    assert_true(sample_red(&bound, (const float[]){3.9f, 2.1f}, 0) == 23);
    assert_true(sample_red(&bound, (const float[]){-40, 4.5f}, 0) == 40);
    assert_true(sample_red(&bound, (const float[]){2, 5}, 0) == -5);
    assert_true(sample_red(&bound, (const float[]){2, NAN}, 0) == -5);
    def.min_filter = def.mag_filter = RHW_FILTER_LINEAR;
    bind(&bound, &rig, texture, &def);
    assert_true(sample_red(&bound, (const float[]){3, 2}, 0) == (12 + 13 + 22 + 23) / 4.0f);
    rig_close(&rig);
}

static void test_mirror_once(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct bound bound;
    struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST,
                                  .mag_filter = RHW_FILTER_NEAREST,
                                  .address_u = RHW_ADDRESS_MIRROR_ONCE};
    const struct rhw_texture_def plain = {.format = RHW_FORMAT_R32_FLOAT, .width = 4, .height = 1};
    const rhw_texture texture = numbered(&rig, plain);
    static const struct {
        float u, nearest, linear; // the plane's texels: … 3, 3, 2, 1, 0 | 0, 1, 2, 3, 3 …
    } cases[] = {{0.625f, 2, 2},  {1.375f, 3, 3}, {0, 0, 0},       {-0.25f, 0, 0.5f}, {-0.375f, 1, 1},
                 {-0.875f, 3, 3}, {-1, 3, 3},     {-1.625f, 3, 3}, {-9, 3, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float at[2] = {cases[i].u, 0.5f};
        def.min_filter = def.mag_filter = RHW_FILTER_NEAREST;
        bind(&bound, &rig, texture, &def);
        assert_true(sample_red(&bound, at, 0) == cases[i].nearest);
        def.min_filter = def.mag_filter = RHW_FILTER_LINEAR;
        bind(&bound, &rig, texture, &def);
        assert_true(sample_red(&bound, at, 0) == cases[i].linear);
    }
    const float middle[2] = {-0.375f, 0.5f};
    const struct rhw_sample_request1 request = {.coordinates = middle};
    expect_four(&bound, &request, 0, 1, 0, 0, 1);
    rig_close(&rig);
}

static void expect_refused(struct rig *rig, const struct rhw_sampler_def *def, const char *part)
{
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, def, &sampler), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, part);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_sampler_def cases[] = {
        {.max_anisotropy = 17},
        {.max_anisotropy = NAN},
        {.reduction = (enum rhw_reduction)3},
        {.address_w = (enum rhw_address)5},
        {.reduction = RHW_REDUCTION_MAX, .compares = true},
        {.unnormalized = true, .mag_filter = RHW_FILTER_NEAREST},
        {.unnormalized = true},
        {.unnormalized = true, .address_u = RHW_ADDRESS_CLAMP, .address_v = RHW_ADDRESS_CLAMP},
        {.unnormalized = true,
         .address_u = RHW_ADDRESS_CLAMP,
         .address_v = RHW_ADDRESS_CLAMP,
         .mip_filter = RHW_MIP_FILTER_NONE,
         .max_anisotropy = 2},
    };
    static const char *const parts[] = {"max_anisotropy is 17; it must be 0..16",
                                        "max_anisotropy is",
                                        "reduction is 3",
                                        "address_w is 5",
                                        "reduction is 2 and compares is true",
                                        "min_filter LINEAR and mag_filter NEAREST; they must be equal",
                                        "address_u REPEAT and address_v REPEAT; they must be CLAMP or BORDER",
                                        "mip_filter LINEAR; it must be NONE",
                                        "they must be off"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        expect_refused(&rig, &cases[i], parts[i]);
    }
    struct rhw_sampler_def good = cases[8];
    good.max_anisotropy = 0;
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &good, &sampler), RHW_OK);
    const struct rhw_texture_def array = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 2, .height = 2, .layers = 1, .label = "shelf"};
    const rhw_texture texture = numbered(&rig, array);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
    rig_expect_misuse(&rig, "kind 0, layers 1; it must be 1D or 2D and no array");
    rig_end(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_fetch),         cmocka_unit_test(test_samples),
    cmocka_unit_test(test_sizes),         cmocka_unit_test(test_gather),
    cmocka_unit_test(test_reductions),    cmocka_unit_test(test_bias),
    cmocka_unit_test(test_bias_of_bytes), cmocka_unit_test(test_coordinates_in_texels),
    cmocka_unit_test(test_mirror_once),   cmocka_unit_test(test_misuse),
};

const struct unit_tests test_texel_query = UNIT_TESTS(tests, NULL, NULL);
