// SPDX-License-Identifier: MIT
// Views: what shaders read of them is what they read of a texture that holds the same texels; what is written by one is
// there in all; and what passes must not do to a texture they must not do to its views.
#include "harness.h"

#include <string.h>

#include "binding/binding.h"
#include "context/context.h"
#include "context/lookup.h"
#include "resource/sampler.h"
#include "resource/srgb_texture.h"

enum { SLOT = 2, MOST = 32 * 32 * 16 };

static rhw_texture make(const struct rig *rig, struct rhw_texture_def def, enum rhw_format format, int levels)
{
    rhw_texture texture;
    def.format = format;
    def.mip_levels = levels;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static rhw_texture make_view(const struct rig *rig, rhw_texture texture, struct rhw_texture_view_def def)
{
    rhw_texture view;
    def.texture = texture;
    assert_int_equal(rhw_texture_view_create(rig->context, &def, &view), RHW_OK);
    return view;
}

static int slices_of(const struct rig *rig, rhw_texture texture, int level)
{
    return rhw_texture_depth(rig->context, texture, level) * rhw_texture_layers(rig->context, texture);
}

// Small floats, whatever the format: no NaN, whose comparison is not of bits.
static void fill(const struct rig *rig, rhw_texture texture, uint64_t *random)
{
    static unsigned char bytes[MOST * 16];
    for (int level = 0; level < rhw_texture_mip_levels(rig->context, texture); level++) {
        for (size_t i = 0; i < sizeof bytes; i++) {
            bytes[i] = (unsigned char)(rig_random(random) & (i % 2 ? 0x3f : 0xff));
        }
        const struct rhw_texture_region region = {.level = level};
        assert_int_equal(rhw_texture_write_region(rig->context, texture, &region, bytes, 0, 0), RHW_OK);
    }
}

static const struct rhw_texture_def parents[] = {
    {.width = 24, .kind = RHW_TEXTURE_1D, .layers = 4},
    {.width = 20, .height = 13},
    {.width = 16, .height = 16, .layers = 14},
    {.width = 9, .height = 9, .kind = RHW_TEXTURE_CUBE, .layers = 2},
    {.width = 11, .height = 6, .depth = 8, .kind = RHW_TEXTURE_3D},
};

static const struct {
    int parent;
    struct rhw_texture_view_def def;
} views[] = {
    {0, {.kind = RHW_TEXTURE_1D, .layer = 3}},
    {0, {.kind = RHW_TEXTURE_1D, .layer = 1, .layers = 2, .level = 2}},
    {1, {.level = 0}},
    {1, {.level = 1, .levels = 2}},
    {1, {.layers = 1}},
    {2, {.layer = 5, .level = 1}},
    {2, {.layer = 2, .layers = 12}},
    {2, {.kind = RHW_TEXTURE_CUBE, .layer = 3, .levels = 3}},
    {2, {.kind = RHW_TEXTURE_CUBE, .layer = 2, .layers = 2}},
    {3, {.layer = 10, .level = 1}},
    {3, {.kind = RHW_TEXTURE_CUBE, .layer = 6}},
    {3, {.layer = 4, .layers = 5}},
    {4, {.kind = RHW_TEXTURE_3D, .level = 1}},
    {4, {.layer = 6}},
    {4, {.layer = 1, .layers = 3, .level = 1}},
};
enum { VIEWS = sizeof views / sizeof *views };

// A texture of its own with the texels that the view is of, read from the parent.
static rhw_texture make_twin(const struct rig *rig, rhw_texture parent, int n, rhw_texture view)
{
    static unsigned char bytes[32 * 32 * 16];
    const struct rhw_texture_view_def *const def = &views[n].def;
    const bool is_volume = def->kind == RHW_TEXTURE_3D;
    const struct rhw_texture_def twin_def = {.kind = def->kind,
                                             .width = rhw_texture_width(rig->context, view, 0),
                                             .height = rhw_texture_height(rig->context, view, 0),
                                             .depth =
                                                 is_volume ? rhw_texture_depth(rig->context, view, 0) : 0,
                                             .layers = def->layers};
    const int levels = rhw_texture_mip_levels(rig->context, view);
    const rhw_texture twin = make(rig, twin_def, rhw_texture_format(rig->context, view), levels);
    for (int level = 0; level < levels; level++) {
        assert_int_equal(slices_of(rig, twin, level), slices_of(rig, view, level));
        for (int slice = 0; slice < slices_of(rig, twin, level); slice++) {
            assert_int_equal(rhw_texture_read_layer(rig->context, parent, def->level + level,
                                                    def->layer + slice, bytes, 0),
                             RHW_OK);
            assert_int_equal(rhw_texture_write_layer(rig->context, twin, level, slice, bytes, 0), RHW_OK);
        }
    }
    return twin;
}

static struct rhw_texture_data *data_of(const struct rig *rig, rhw_texture texture)
{
    struct rhw_texture_data *const data = rhw_context_texture(rig->context, texture, "test");
    assert_int_equal(rhw_texture_linearize(rig->context, data), RHW_OK);
    return data;
}

static void bind(struct rhw_bindings *bindings, const struct rig *rig, enum rhw_isa isa, rhw_texture texture,
                 const struct rhw_sampler_data *sampler)
{
    const struct rhw_kernels *const kernels = rhw_kernels_for(isa);
    rhw_bindings_init(bindings, kernels);
    bindings->slot[SLOT] = rhw_binding_of(kernels, RHW_PATHS_ALL, data_of(rig, texture), sampler);
}

static void expect_same_samples(const struct rig *rig, rhw_texture a, rhw_texture b, uint64_t *random)
{
    for (int round = 0; round < 24; round++) {
        const struct rhw_sampler_def def = {.min_filter = (enum rhw_filter)(round % 2),
                                            .mag_filter = (enum rhw_filter)(round / 2 % 2),
                                            .address_u = (enum rhw_address)(round % 4),
                                            .address_v = (enum rhw_address)(round / 4 % 4),
                                            .border = {0.25f, 0.5f, 0.75f, 0.125f},
                                            .max_anisotropy = round % 3 == 2 ? 4 : 0};
        struct rhw_sampler_data sampler;
        rhw_sampler_data_init(&sampler, &def);
        rhw_float coordinates[4], gradient[6], lod;
        rhw_int at[4];
        for (int lane = 0; lane < RHW_LANES; lane++) {
            for (int i = 0; i < 4; i++) {
                coordinates[i][lane] = rig_random_float(random, -2, 3);
                at[i][lane] = rig_random_int(random, 14) - 2;
            }
            for (int i = 0; i < 6; i++) {
                gradient[i][lane] = rig_random_float(random, -0.3f, 0.3f);
            }
            lod[lane] = rig_random_float(random, -1, 4);
        }
        const struct rhw_sample_request request = {.coordinates = coordinates,
                                                   .gradient = round % 2 ? gradient : NULL,
                                                   .lod = round % 2 ? NULL : &lod};
        const rhw_int level = rhw_splat_int(round % 3);
        for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
            if (!rhw_isa_supported((enum rhw_isa)isa)) {
                continue;
            }
            struct rhw_bindings bindings[2];
            rhw_float texel[2][4];
            rhw_int size[2][3];
            bind(&bindings[0], rig, (enum rhw_isa)isa, a, &sampler);
            bind(&bindings[1], rig, (enum rhw_isa)isa, b, &sampler);
            for (int i = 0; i < 2; i++) {
                rhw_sample(&bindings[i], SLOT, &request, texel[i]);
            }
            assert_memory_equal(texel[0], texel[1], sizeof texel[0]);
            for (int i = 0; i < 2; i++) {
                rhw_sample_fetch(&bindings[i], SLOT, at, &level, texel[i]);
                rhw_sample_size(&bindings[i], SLOT, &level, size[i]);
            }
            assert_memory_equal(texel[0], texel[1], sizeof texel[0]);
            assert_memory_equal(size[0], size[1], sizeof size[0]);
            for (int i = 0; i < 2; i++) {
                rhw_sample_gather(&bindings[i], SLOT, &request, 1, texel[i]);
            }
            assert_memory_equal(texel[0], texel[1], sizeof texel[0]);
        }
    }
}

static void test_views_are_textures(void **state)
{
    (void)state;
    static const enum rhw_format formats[][2] = {{RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB},
                                                 {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_R32_FLOAT},
                                                 {RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_NONE}};
    static unsigned char read[2][MOST * 8];
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 11;
    for (int n = 0; n < VIEWS * 3; n++) {
        const rhw_texture parent =
            make(&rig, parents[views[n % VIEWS].parent], formats[n / VIEWS][0], RHW_MIP_LEVELS_ALL);
        fill(&rig, parent, &random);
        struct rhw_texture_view_def def = views[n % VIEWS].def;
        def.format = formats[n / VIEWS][1];
        const rhw_texture view = make_view(&rig, parent, def);
        assert_int_equal(rhw_texture_format(rig.context, view), formats[n / VIEWS][1] == RHW_FORMAT_NONE
                                                                    ? formats[n / VIEWS][0]
                                                                    : formats[n / VIEWS][1]);
        const rhw_texture twin = make_twin(&rig, parent, n % VIEWS, view);
        for (int level = 0; level < rhw_texture_mip_levels(rig.context, twin); level++) {
            const struct rhw_texture_region region = {.level = level};
            memset(read, 0, sizeof read);
            assert_int_equal(rhw_texture_read_region(rig.context, view, &region, read[0], 0, 0), RHW_OK);
            assert_int_equal(rhw_texture_read_region(rig.context, twin, &region, read[1], 0, 0), RHW_OK);
            assert_memory_equal(read[0], read[1], sizeof read[0]);
        }
        // The texture may go: its texels stay.
        if (n % 2 == 0) {
            rhw_texture_destroy(rig.context, parent);
        }
        expect_same_samples(&rig, view, twin, &random);
        rhw_texture_destroy(rig.context, view);
        rhw_texture_destroy(rig.context, twin);
    }
    rig_close(&rig);
}

static void test_swizzle(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {.width = 1, .height = 1};
    const rhw_texture texture = make(&rig, def, RHW_FORMAT_RGBA32_FLOAT, 1);
    static const float texel[4] = {2, 3, 5, 7};
    rhw_texture_write(rig.context, texture, 0, texel, 0);
    static const struct {
        enum rhw_swizzle swizzle[4];
        float expected[4];
    } cases[] = {
        {{RHW_SWIZZLE_IDENTITY}, {2, 3, 5, 7}},
        {{RHW_SWIZZLE_RED, RHW_SWIZZLE_GREEN, RHW_SWIZZLE_BLUE, RHW_SWIZZLE_ALPHA}, {2, 3, 5, 7}},
        {{RHW_SWIZZLE_BLUE, RHW_SWIZZLE_IDENTITY, RHW_SWIZZLE_RED}, {5, 3, 2, 7}},
        {{RHW_SWIZZLE_ALPHA, RHW_SWIZZLE_ZERO, RHW_SWIZZLE_ONE, RHW_SWIZZLE_ONE}, {7, 0, 1, 1}},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        struct rhw_texture_view_def view_def = {.level = 0};
        memcpy(view_def.swizzle, cases[n].swizzle, sizeof view_def.swizzle);
        const rhw_texture view = make_view(&rig, texture, view_def);
        for (int anisotropy = 0; anisotropy <= 4; anisotropy += 4) {
            const struct rhw_sampler_def sampler_def = {.max_anisotropy = (float)anisotropy};
            struct rhw_sampler_data sampler;
            rhw_sampler_data_init(&sampler, &sampler_def);
            struct rhw_bindings bindings;
            bind(&bindings, &rig, RHW_ISA_BASELINE, view, &sampler);
            const rhw_float at[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
            const rhw_int zero[2] = {rhw_splat_int(0), rhw_splat_int(0)};
            const struct rhw_sample_request request = {.coordinates = at},
                                            shifted = {.coordinates = at, .offset = zero};
            rhw_float sampled[4], shifted_texel[4], fetched[4];
            rhw_sample(&bindings, SLOT, &request, sampled);
            rhw_sample(&bindings, SLOT, &shifted, shifted_texel);
            rhw_sample_fetch(&bindings, SLOT, zero, NULL, fetched);
            for (int c = 0; c < 4; c++) {
                rhw_float gathered[4];
                rhw_sample_gather(&bindings, SLOT, &request, c, gathered);
                assert_true(sampled[c][3] == cases[n].expected[c]);
                assert_true(shifted_texel[c][3] == cases[n].expected[c]);
                assert_true(fetched[c][3] == cases[n].expected[c]);
                assert_true(gathered[0][3] == cases[n].expected[c] && gathered[3][0] == cases[n].expected[c]);
            }
        }
        rhw_texture_destroy(rig.context, view);
    }
    // As an attachment no channel goes elsewhere.
    struct rhw_texture_view_def red = {.swizzle = {RHW_SWIZZLE_BLUE}};
    const rhw_texture view = make_view(&rig, texture, red);
    rig.pass.colors[0].texture = view;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &rig.recording), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0] is texture 3, a view with a swizzle; attachments have none");
    rig_close(&rig);
}

// Drawn into by way of a view, and back by way of the texture.
static void test_attachments(void **state)
{
    (void)state;
    static const float value[4] = {1, 2, 3, 4}, zero[4] = {0};
    struct rig rig;
    rig_open(&rig, 70, 66);
    const struct rhw_texture_def def = {.width = 140, .height = 132, .layers = 3};
    const rhw_texture array = make(&rig, def, RHW_FORMAT_RGBA32_FLOAT, 2);
    const rhw_texture view = make_view(&rig, array, (struct rhw_texture_view_def){.level = 1, .layer = 2});
    static float texels[70 * 66][4];
    rig.pass.colors[0].texture = view;
    struct rig_vertex vertices[6];
    rig_rectangle(&rig, 0, 0, 70, 33, 0, value, vertices);
    for (int round = 0; round < 3; round++) {
        rig_begin(&rig);
        if (round != 1) {
            rig_draw(&rig, vertices, 6);
        }
        rig_end(&rig);
        for (int layer = 0; layer < 3; layer++) {
            assert_int_equal(rhw_texture_read_layer(rig.context, array, 1, layer, texels, 0), RHW_OK);
            for (int i = 0; i < 70 * 66; i++) {
                const bool drawn = layer == 2 && i < 70 * 33 && round != 1;
                assert_memory_equal(texels[i], drawn ? value : zero, sizeof zero);
            }
        }
        // A clear by the texture is seen by the view's next pass, which clears to what its tiles held.
        const struct rhw_clear_value clear = {.color = {9, 9, 9, 9}};
        if (round == 1) {
            assert_int_equal(rhw_texture_clear(rig.context, array, NULL, &clear), RHW_OK);
            rig_begin(&rig);
            rig_end(&rig);
            assert_memory_equal(rig_read_float4(&rig)[70 * 66 - 1], zero, sizeof zero);
            rhw_texture_clear(rig.context, array, NULL, &(struct rhw_clear_value){.depth = 0});
        }
    }
    rig_close(&rig);
}

static void sample_middle(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float at[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
        rhw_sample_lod(groups[g].bindings, 0, at, rhw_splat(0), groups[g].color[0]);
    }
}

// The red that a pass samples of a texture.
static float sampled_red(struct rig *rig, rhw_texture texture, rhw_sampler sampler)
{
    static const float zero[4];
    struct rig_vertex vertices[6];
    rig_cover(rig, 0, zero, vertices);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, texture, sampler);
    rig_draw(rig, vertices, 6);
    rig_end(rig);
    return rig_read_float4(rig)[0][0];
}

// The linear copy of an sRGB texture is renewed when its view of the same bits is written or drawn into.
static void test_linear_copies(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_program(&rig, rig_vertex_pass, sample_middle);
    const struct rhw_texture_def def = {.width = 8, .height = 8};
    const rhw_texture texture = make(&rig, def, RHW_FORMAT_RGBA8_SRGB, 1);
    const rhw_texture view =
        make_view(&rig, texture, (struct rhw_texture_view_def){.format = RHW_FORMAT_RGBA8_UNORM});
    const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_LINEAR};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    assert_true(sampled_red(&rig, texture, sampler) == 0);
    rhw_texture_clear(rig.context, view, NULL, &(struct rhw_clear_value){.color = {1}});
    assert_true(sampled_red(&rig, texture, sampler) == 1);
    // 188 is 0.5029 in linear light.
    struct rhw_pass_def pass = {.color_count = 1, .colors = {{.texture = view, .clear = {188 / 255.0f}}}};
    rhw_pass recording;
    assert_int_equal(rhw_pass_begin(rig.context, &pass, &recording), RHW_OK);
    assert_int_equal(rhw_pass_end(rig.context, recording, NULL), RHW_OK);
    const float red = sampled_red(&rig, texture, sampler);
    assert_true(red > 0.5027f && red < 0.5031f);
    rig_close(&rig);
}

// Views of one plane of depth and stencil.
static void test_planes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {.width = 5, .height = 3, .layers = 3};
    const rhw_texture both = make(&rig, def, RHW_FORMAT_D32_FLOAT_S8_UINT, 1);
    const struct rhw_clear_value value = {.depth = 0.25f, .stencil = 77};
    const struct rhw_texture_region layer = {.z = 1, .depth = 1},
                                    stencil_layer = {.z = 1, .depth = 1, .aspect = RHW_ASPECT_STENCIL};
    rhw_texture_clear(rig.context, both, &layer, &value);
    rhw_texture_clear(rig.context, both, &stencil_layer, &value);
    const rhw_texture depth =
        make_view(&rig, both, (struct rhw_texture_view_def){.format = RHW_FORMAT_D32_FLOAT, .layer = 1});
    const rhw_texture stencil =
        make_view(&rig, both, (struct rhw_texture_view_def){.format = RHW_FORMAT_S8_UINT, .layers = 3});
    float depths[15];
    uint8_t bytes[45];
    assert_int_equal(rhw_texture_read(rig.context, depth, 0, depths, 0), RHW_OK);
    assert_int_equal(rhw_texture_read_region(rig.context, stencil, NULL, bytes, 0, 0), RHW_OK);
    for (int i = 0; i < 45; i++) {
        assert_int_equal(bytes[i], i / 15 == 1 ? 77 : 0);
        assert_true(depths[i % 15] == 0.25f);
    }
    rhw_texture_read_stencil(rig.context, depth, 0, bytes, 0);
    rig_expect_misuse(&rig, "is RHW_FORMAT_D32_FLOAT; that has no stencil");
    rig_close(&rig);
}

// Each pixel's texel of layer 1, then of sample 1.
static void fetch_pixel(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int at[3] = {rhw_int_from_float(f->coord[0]), rhw_int_from_float(f->coord[1]),
                               rhw_splat_int(1)};
        const rhw_int level = rhw_splat_int(*(const int *)f->uniforms);
        rhw_float texel[4];
        rhw_sample_fetch(f->bindings, 0, at, &level, texel);
        f->color[0][0] = rhw_float_from_int(rhw_bits_from_float(texel[0]));
        f->color[0][1] = f->color[0][2] = f->color[0][3] = rhw_splat(0);
    }
}

static void fetch_sample(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float(f->coord[0]), rhw_int_from_float(f->coord[1])};
        const rhw_int sample = rhw_splat_int(*(const int *)f->uniforms);
        rhw_float texel[4];
        rhw_sample_fetch_sample(f->bindings, 0, at, &sample, texel);
        f->color[0][0] = rhw_float_from_int(rhw_bits_from_float(texel[0]));
        f->color[0][1] = f->color[0][2] = f->color[0][3] = rhw_splat(0);
    }
}

// What every pixel of the rig reads.
static const float (*read_everywhere(struct rig *rig, rhw_texture texture, int uniform))[4]
{
    static const float zero[4];
    const struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST,
                                        .mag_filter = RHW_FILTER_NEAREST,
                                        .mip_filter = RHW_MIP_FILTER_NONE};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, &def, &sampler), RHW_OK);
    struct rig_vertex vertices[6];
    rig_cover(rig, 0, zero, vertices);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, texture, sampler);
    rhw_pass_set_uniforms(rig->context, rig->recording, &uniform, sizeof uniform);
    rig_draw(rig, vertices, 6);
    rig_end(rig);
    return rig_read_float4(rig);
}

// Shaders read stencil through a view: of every format that has it, and of a view of its plane.
static void test_stencil_is_sampled(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_D32_FLOAT_S8_UINT, RHW_FORMAT_D24_UNORM_S8_UINT,
                                              RHW_FORMAT_S8_UINT};
    for (int i = 0; i < 4; i++) {
        struct rig rig;
        rig_open(&rig, 5, 3);
        rig_set_program(&rig, rig_vertex_pass, fetch_pixel);
        rig.pipeline.program.uses = RHW_USE_COORD;
        const struct rhw_texture_def def = {.width = 11, .height = 7, .layers = 4};
        rhw_texture texture = make(&rig, def, formats[i % 3], 2);
        // Texel x, y of level 1, layer 2, which is the second layer of the view.
        uint8_t bytes[5 * 3];
        for (int n = 0; n < 5 * 3; n++) {
            bytes[n] = (uint8_t)(250 - 10 * (n / 5) + n % 5);
        }
        const struct rhw_texture_region layer = {
            .level = 1, .z = 2, .depth = 1, .aspect = RHW_ASPECT_STENCIL};
        assert_int_equal(rhw_texture_write_region(rig.context, texture, &layer, bytes, 0, 0), RHW_OK);
        if (i == 3) {
            texture = make_view(&rig, texture,
                                (struct rhw_texture_view_def){.format = RHW_FORMAT_S8_UINT, .layers = 4});
        }
        const rhw_texture view =
            make_view(&rig, texture,
                      (struct rhw_texture_view_def){.format = RHW_FORMAT_R8_UINT, .layer = 1, .layers = 2});
        assert_int_equal(rhw_texture_format(rig.context, view), RHW_FORMAT_R8_UINT);
        const float(*const pixels)[4] = read_everywhere(&rig, view, 1);
        for (int n = 0; n < 5 * 3; n++) {
            assert_true(pixels[n][0] == (float)bytes[n]);
        }
        rhw_texture_read_stencil(rig.context, view, 0, bytes, 0);
        rig_expect_misuse(&rig, "is RHW_FORMAT_R8_UINT; that has no stencil");
        rig_close(&rig);
    }
}

static void test_samples_of_stencil_are_fetched(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {.width = 4, .height = 4, .samples = 4};
    const rhw_texture texture = make(&rig, def, RHW_FORMAT_D24_UNORM_S8_UINT, 1);
    const rhw_texture view =
        make_view(&rig, texture, (struct rhw_texture_view_def){.format = RHW_FORMAT_R8_UINT});
    const struct rhw_clear_value value = {.stencil = 200};
    const struct rhw_texture_region stencil = {.aspect = RHW_ASPECT_STENCIL};
    assert_int_equal(rhw_texture_clear(rig.context, texture, &stencil, &value), RHW_OK);
    rig_set_program(&rig, rig_vertex_pass, fetch_sample);
    rig.pipeline.program.uses = RHW_USE_COORD;
    for (int sample = 0; sample < 4; sample++) {
        assert_true(read_everywhere(&rig, view, sample)[9][0] == 200);
    }
    assert_true(read_everywhere(&rig, view, 4)[9][0] == 0);
    // Not while it is tested.
    const struct rhw_pass_def pass = {.depth = {.enabled = true, .texture = texture}, .samples = 4};
    rhw_pass recording;
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context,
                                        &(struct rhw_sampler_def){.min_filter = RHW_FILTER_NEAREST,
                                                                  .mag_filter = RHW_FILTER_NEAREST},
                                        &sampler),
                     RHW_OK);
    assert_int_equal(rhw_pass_begin(rig.context, &pass, &recording), RHW_OK);
    rhw_pass_set_texture(rig.context, recording, 0, view, sampler);
    rig_expect_misuse(&rig, "for slot 0, is an attachment of this pass");
    rhw_pass_end(rig.context, recording, NULL);
    rig_close(&rig);
}

// What has no stencil, or is stencil and seen as something else; and what is attached twice.
static void test_stencil_as_bytes_is_checked(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {.width = 4, .height = 4};
    struct rhw_texture_view_def wrong = {.texture = make(&rig, def, RHW_FORMAT_D16_UNORM, 1),
                                         .format = RHW_FORMAT_R8_UINT};
    static const char *const message = "depth with stencil the format of one of both, stencil R8_UINT";
    rhw_texture view;
    rhw_texture_view_create(rig.context, &wrong, &view);
    rig_expect_misuse(&rig, message);
    // Drawn into beside the stencil itself.
    const rhw_texture both = make(&rig, def, RHW_FORMAT_D24_UNORM_S8_UINT, 1);
    const struct rhw_pass_def twice = {
        .color_count = 1,
        .colors = {{.texture =
                        make_view(&rig, both, (struct rhw_texture_view_def){.format = RHW_FORMAT_R8_UINT})}},
        .depth = {.enabled = true, .texture = both}};
    rhw_pass recording;
    assert_int_equal(rhw_pass_begin(rig.context, &twice, &recording), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "as another attachment is; each needs its own texture or layer");
    wrong.texture = make(&rig, def, RHW_FORMAT_S8_UINT, 1);
    wrong.format = RHW_FORMAT_R8_UNORM;
    rhw_texture_view_create(rig.context, &wrong, &view);
    rig_expect_misuse(&rig, message);
    wrong.texture = make(&rig, def, RHW_FORMAT_R8_UINT, 1);
    wrong.format = RHW_FORMAT_S8_UINT;
    rhw_texture_view_create(rig.context, &wrong, &view);
    rig_expect_misuse(&rig, message);
    rig_close(&rig);
}

static void test_feedback(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_program(&rig, rig_vertex_pass, sample_middle);
    const struct rhw_texture_def def = {.width = 8, .height = 8, .layers = 2};
    const rhw_texture texture = make(&rig, def, RHW_FORMAT_RGBA8_UNORM, 1);
    const rhw_texture first = make_view(&rig, texture, (struct rhw_texture_view_def){.layer = 0}),
                      second = make_view(&rig, texture, (struct rhw_texture_view_def){.layer = 1}),
                      same = make_view(&rig, second, (struct rhw_texture_view_def){.layers = 1});
    const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_LINEAR};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    uint32_t texels[64] = {0};
    // Drawn into: neither sampled nor touched by any name.
    struct rhw_pass_def pass = {.color_count = 1, .colors = {{.texture = first}}};
    rhw_pass recording;
    assert_int_equal(rhw_pass_begin(rig.context, &pass, &recording), RHW_OK);
    rhw_pass_set_texture(rig.context, recording, 0, texture, sampler);
    rig_expect_misuse(&rig, "rhw_pass_set_texture: texture 2, for slot 0, is an attachment of this pass");
    rhw_texture_read(rig.context, texture, 0, texels, 0);
    rig_expect_misuse(&rig, "rhw_texture_read: texture 2 is an attachment of the pass being recorded");
    rhw_texture_clear(rig.context, same, NULL, &(struct rhw_clear_value){.depth = 0});
    rig_expect_misuse(&rig, "rhw_texture_clear: texture 5 is an attachment of the pass being recorded");
    rhw_pass_cancel(rig.context, recording);
    // The same texels twice.
    pass.color_count = 2;
    pass.colors[0].texture = second;
    pass.colors[1].texture = same;
    assert_int_equal(rhw_pass_begin(rig.context, &pass, &recording), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[1] is texture 5, as another attachment is");
    pass.colors[1].texture = first;
    assert_int_equal(rhw_pass_begin(rig.context, &pass, &recording), RHW_OK);
    rhw_pass_cancel(rig.context, recording);
    // Sampled: not written by any name.
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, first, sampler);
    rhw_texture_write(rig.context, second, 0, texels, 0);
    rig_expect_misuse(&rig, "rhw_texture_write: texture 4 shares its texels with views");
    rhw_texture_write_region(rig.context, texture, NULL, texels, 0, 0);
    rig_expect_misuse(&rig, "rhw_texture_write_region: texture 2 shares its texels with views");
    rhw_texture_generate_mips(rig.context, texture);
    rig_expect_misuse(&rig, "rhw_texture_generate_mips: texture 2 shares its texels with views");
    rhw_texture_copy(rig.context, first, NULL, second, NULL);
    rig_expect_misuse(&rig, "rhw_texture_copy: texture 4 shares its texels with views");
    rhw_pass_cancel(rig.context, rig.recording);
    assert_int_equal(rhw_texture_write(rig.context, second, 0, texels, 0), RHW_OK);
    rig_close(&rig);
}

// Regions that overlap do so by any name.
static void test_overlap(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {.width = 8, .height = 8, .layers = 4};
    const rhw_texture array = make(&rig, def, RHW_FORMAT_R32_FLOAT, 2);
    const rhw_texture layer = make_view(&rig, array, (struct rhw_texture_view_def){.layer = 2, .levels = 1}),
                      small = make_view(&rig, array, (struct rhw_texture_view_def){.layer = 2, .level = 1});
    const struct rhw_texture_region second = {.z = 2, .depth = 1, .width = 4, .height = 4},
                                    third = {.z = 3, .depth = 1}, quarter = {.width = 4, .height = 4},
                                    place = {.x = 4, .y = 4};
    rhw_texture_copy(rig.context, array, &second, layer, NULL);
    rig_expect_misuse(&rig, "rhw_texture_copy: the regions overlap in texture 3");
    rhw_texture_copy(rig.context, layer, &quarter, array, &second);
    rig_expect_misuse(&rig, "rhw_texture_copy: the regions overlap in texture 2");
    rhw_texture_blit(rig.context, layer, NULL, array, &(struct rhw_blit_region){.z0 = 2, .z1 = 3},
                     RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "rhw_texture_blit: the regions overlap in texture 2");
    assert_int_equal(rhw_texture_copy(rig.context, array, &second, layer, &place), RHW_OK);
    assert_int_equal(rhw_texture_copy(rig.context, array, &third, layer, NULL), RHW_OK);
    assert_int_equal(rhw_texture_copy(rig.context, small, NULL, layer, NULL), RHW_OK);
    assert_int_equal(rhw_texture_blit(rig.context, layer, NULL, small, NULL, RHW_FILTER_LINEAR), RHW_OK);
    // A blit's regions may be of two sizes: the larger one reaches into the smaller.
    rhw_texture_blit(rig.context, array, &(struct rhw_blit_region){.x1 = 8, .y1 = 8, .z1 = 1}, array,
                     &(struct rhw_blit_region){.x0 = 6, .y0 = 6, .x1 = 8, .y1 = 8, .z1 = 1},
                     RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "the regions overlap in texture 2");
    rig_close(&rig);
}

// A view that is made after draws of the texture were recorded cannot change what they read; what is destroyed lives on.
static void test_made_while_recording(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_program(&rig, rig_vertex_pass, sample_middle);
    const struct rhw_texture_def def = {.width = 8, .height = 8};
    const rhw_texture texture = make(&rig, def, RHW_FORMAT_RGBA8_UNORM, 1);
    const struct rhw_clear_value full = {.color = {1}};
    rhw_texture_clear(rig.context, texture, NULL, &full);
    const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_LINEAR};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    static const float zero[4];
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0, zero, vertices);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
    rig_draw(&rig, vertices, 6);
    const rhw_texture view = make_view(&rig, texture, (struct rhw_texture_view_def){.level = 0});
    rhw_texture_clear(rig.context, view, NULL, &(struct rhw_clear_value){.depth = 0});
    rig_expect_misuse(&rig, "and the pass being recorded samples them; end that first");
    rhw_texture_destroy(rig.context, view);
    rhw_texture_destroy(rig.context, texture);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[63][0] == 1);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def array_def = {.width = 8, .height = 4, .layers = 6},
                                 volume_def = {.width = 8, .height = 8, .depth = 4, .kind = RHW_TEXTURE_3D},
                                 samples_def = {.width = 8, .height = 8, .samples = 4},
                                 block_def = {.width = 8, .height = 8};
    const rhw_texture array = make(&rig, array_def, RHW_FORMAT_RGBA8_UNORM, 3),
                      volume = make(&rig, volume_def, RHW_FORMAT_RGBA8_UNORM, 2),
                      samples = make(&rig, samples_def, RHW_FORMAT_D24_UNORM_S8_UINT, 1),
                      block = make(&rig, block_def, RHW_FORMAT_BC1_RGB_UNORM, 1);
    const struct {
        struct rhw_texture_view_def def;
        const char *message;
    } wrong[] = {
        {{.texture = {0}}, "rhw_texture_view_create: the texture id is null"},
        {{.texture = array, .format = RHW_FORMAT_RGBA16_FLOAT},
         "format is RHW_FORMAT_RGBA16_FLOAT and texture 2 is RHW_FORMAT_RGBA8_UNORM; colour has texels of "
         "one size"},
        {{.texture = array, .format = RHW_FORMAT_D32_FLOAT}, "format is RHW_FORMAT_D32_FLOAT and texture 2"},
        {{.texture = samples, .format = RHW_FORMAT_D32_FLOAT},
         "format is RHW_FORMAT_D32_FLOAT and texture 4"},
        {{.texture = block, .format = RHW_FORMAT_RGBA8_UNORM},
         "format is RHW_FORMAT_RGBA8_UNORM and texture 5"},
        {{.texture = block, .format = RHW_FORMAT_BC3_SRGB}, "format is RHW_FORMAT_BC3_SRGB and texture 5"},
        {{.texture = array, .format = (enum rhw_format)10000}, "format is 10000; it must be"},
        {{.texture = array, .kind = (enum rhw_texture_kind)9}, "kind is 9; it must be 0..3"},
        {{.texture = array, .kind = RHW_TEXTURE_3D},
         "kind is 2 and texture 2 has kind 0; that has no such views"},
        {{.texture = volume, .kind = RHW_TEXTURE_CUBE}, "kind is 3 and texture 3 has kind 2"},
        {{.texture = array, .kind = RHW_TEXTURE_CUBE},
         "a cube of texture 2, which is 8x4; its faces must be square"},
        {{.texture = samples, .kind = RHW_TEXTURE_CUBE},
         "texture 4 has 4 samples; a multisampled texture is 2D"},
        {{.texture = array, .level = 3}, "level is 3; texture 2 has levels 0..2"},
        {{.texture = array, .level = 1, .levels = 3},
         "level is 1 and levels is 3; from there texture 2 has 1..2"},
        {{.texture = volume, .levels = 2}, "level is 0 and levels is 2; from there texture 3 has 1..1"},
        {{.texture = array, .layer = 4, .layers = 3},
         "layer is 4 and the view has 3; level 0 of texture 2 has 6"},
        {{.texture = array, .layer = 6}, "layer is 6 and the view has 1; level 0 of texture 2 has 6"},
        {{.texture = array, .layers = -1}, "layers is -1; it must be 0..2048"},
        {{.texture = volume, .kind = RHW_TEXTURE_3D, .layer = 1},
         "layer is 1 and layers is 0; a 3D view has all slices"},
        {{.texture = array, .swizzle = {0, (enum rhw_swizzle)7}}, "swizzle[1] is 7; not a swizzle"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        rhw_texture view = array;
        assert_int_equal(rhw_texture_view_create(rig.context, &wrong[i].def, &view), RHW_ERROR_MISUSE);
        assert_int_equal(view.index, 0);
        rig_expect_misuse(&rig, wrong[i].message);
    }
    rhw_texture view;
    rhw_texture_view_create(rig.context, NULL, &view);
    rig_expect_misuse(&rig, "def is NULL");
    rhw_texture_view_create(rig.context, &wrong[0].def, NULL);
    rig_expect_misuse(&rig, "view is NULL");
    make_view(&rig, block, (struct rhw_texture_view_def){.format = RHW_FORMAT_BC1_RGB_SRGB});
    make_view(&rig, samples, (struct rhw_texture_view_def){.format = RHW_FORMAT_S8_UINT});
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_views_are_textures),
    cmocka_unit_test(test_swizzle),
    cmocka_unit_test(test_attachments),
    cmocka_unit_test(test_linear_copies),
    cmocka_unit_test(test_planes),
    cmocka_unit_test(test_stencil_is_sampled),
    cmocka_unit_test(test_samples_of_stencil_are_fetched),
    cmocka_unit_test(test_stencil_as_bytes_is_checked),
    cmocka_unit_test(test_feedback),
    cmocka_unit_test(test_overlap),
    cmocka_unit_test(test_made_while_recording),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_texture_view = UNIT_TESTS(tests, NULL, NULL);
