// SPDX-License-Identifier: MIT
// Single samples of multisampled textures in shader functions: those that rhw_texture_read_sample reads.
#include "harness.h"
#include "isa_support.h"

#include <string.h>

enum { SIDE = 37, SAMPLES = 4 };

// Each lane reads another sample, from −1 to 4; `uniforms` is added to it.
static rhw_int sample_of(const struct rhw_fragment *f)
{
    const int32_t *const offset = f->uniforms;
    return (rhw_int_from_float(f->coord[0]) + *offset) % (SAMPLES + 2) - 1;
}

static void fetch(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float(f->coord[0]), rhw_int_from_float(f->coord[1])};
        const rhw_int sample = sample_of(f);
        rhw_sample_fetch_sample(f->bindings, 2, at, &sample, f->color[0]);
        rhw_sample_lod(f->bindings, 2, f->coord, rhw_splat(0), f->color[1]);
    }
}

static void fetch1(struct rhw_fragment1 *f)
{
    const int32_t *const offset = f->uniforms;
    const int32_t at[2] = {(int32_t)f->coord[0], (int32_t)f->coord[1]};
    const int32_t sample = (at[0] + *offset) % (SAMPLES + 2) - 1;
    rhw_sample_fetch_sample1(f->bindings, 2, at, sample, f->color[0]);
    rhw_sample_lod1(f->bindings, 2, f->coord, 0, f->color[1]);
}

static void draw_samples(struct rig *rig, rhw_texture texture)
{
    struct rig_vertex vertices[3];
    static const float corners[3][2] = {{2, 3}, {35, 9}, {11, 36}};
    for (int i = 0; i < 3; i++) {
        rig_place(rig, corners[i][0], corners[i][1], 0.5f, 1, vertices[i].position);
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = (float)(i + c + 1) * 0.125f;
        }
    }
    const struct rhw_pass_def pass = rig->pass;
    rig->pass.colors[0] = (struct rhw_color_attachment){.texture = texture, .clear = {0.75f, 0.5f, 0.25f, 1}};
    rig->pipeline.targets[0].format = rhw_texture_format(rig->context, texture);
    rig->pass.color_count = rig->pipeline.target_count = 1;
    rig_draw_once(rig, vertices, 3);
    rig->pass = pass;
    rig->pipeline.targets[0].format = RHW_FORMAT_RGBA32_FLOAT;
}

// The bytes of a texel as the function gives them, in the formats below.
static bool is_texel(enum rhw_format format, const unsigned char *bytes, const float value[4])
{
    float floats[4] = {0, 0, 0, 1};
    if (format == RHW_FORMAT_RGBA8_UNORM) {
        for (int c = 0; c < 4; c++) {
            floats[c] = (float)bytes[c] / 255.0f;
        }
    } else {
        memcpy(floats, bytes, rhw_format_size(format));
    }
    return memcmp(floats, value, sizeof floats) == 0;
}

static void check_format(enum rhw_format format, bool one, const struct rhw_context_def *def)
{
    static unsigned char texels[SAMPLES][SIDE * SIDE * 16];
    struct rig rig;
    struct rig_vertex vertices[6];
    rhw_texture texture;
    rhw_sampler sampler;
    rig_open_with(&rig, SIDE, SIDE, def);
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    rhw_sampler_create(rig.context, &sampler_def, &sampler);
    const struct rhw_texture_def texture_def = {
        .format = format, .width = SIDE, .height = SIDE, .samples = SAMPLES};
    assert_int_equal(rhw_texture_create(rig.context, &texture_def, &texture), RHW_OK);
    draw_samples(&rig, texture);
    for (int s = 0; s < SAMPLES; s++) {
        rhw_texture_read_sample(rig.context, texture, s, texels[s], 0);
    }
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA32_FLOAT);
    rig_set_target(&rig, 1, RHW_FORMAT_RGBA32_FLOAT);
    rig_set_program(&rig, rig_vertex_pass, fetch);
    if (one) {
        memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
        rig.pipeline.program.fragment1 = fetch1;
    }
    rig.pipeline.program.uses = RHW_USE_COORD;
    rig.pipeline.program.uniform_size = 4;
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    for (int32_t offset = 0; offset < SAMPLES + 2; offset++) {
        rig_begin(&rig);
        rhw_pass_set_uniforms(rig.context, rig.recording, &offset, sizeof offset);
        rhw_pass_set_texture(rig.context, rig.recording, 2, texture, sampler);
        rig_draw(&rig, vertices, 6);
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int sample = (i % SIDE + offset) % (SAMPLES + 2) - 1;
            const size_t size = rhw_format_size(format);
            static const unsigned char nothing[16];
            const bool exists = sample >= 0 && sample < SAMPLES;
            assert_true(is_texel(format, exists ? texels[sample] + (size_t)i * size : nothing, pixels[i]));
        }
        const float(*const sampled)[4] = (const float(*)[4])rig_read(&rig, rig.pass.colors[1].texture);
        assert_memory_equal(sampled[SIDE], ((const float[4]){0, 0, 0, 1}), sizeof sampled[SIDE]);
    }
    rhw_texture_destroy(rig.context, texture);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

static void fetch_first(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int zero[2] = {rhw_splat_int(0), rhw_splat_int(0)};
        rhw_sample_fetch_sample(groups[g].bindings, 2, zero, &zero[0], groups[g].color[0]);
    }
}

// A view's swizzle stands between samples and the function too.
static void swizzles(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    rhw_texture texture, view;
    rhw_sampler sampler;
    rig_open(&rig, SIDE, SIDE);
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    rhw_sampler_create(rig.context, &sampler_def, &sampler);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = SIDE, .height = SIDE, .samples = SAMPLES};
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    const struct rhw_texture_view_def view_def = {
        .texture = texture,
        .swizzle = {RHW_SWIZZLE_ALPHA, RHW_SWIZZLE_ONE, RHW_SWIZZLE_ZERO, RHW_SWIZZLE_RED}};
    assert_int_equal(rhw_texture_view_create(rig.context, &view_def, &view), RHW_OK);
    draw_samples(&rig, texture); // whose clear value is 0.75, 0.5, 0.25, 1
    rig_set_program(&rig, rig_vertex_pass, fetch_first);
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 2, view, sampler);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig)[100], ((const float[4]){1, 1, 0, 0.75f}), 4 * sizeof(float));
    rhw_texture_destroy(rig.context, view);
    rhw_texture_destroy(rig.context, texture);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

// Lanes of other layers and samples side by side; layers −1 and 3 do not exist.
static void fetch_layer(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int x = rhw_int_from_float(groups[g].coord[0]);
        const rhw_int at[3] = {x, rhw_int_from_float(groups[g].coord[1]), x / SAMPLES % 5 - 1};
        const rhw_int sample = x % SAMPLES;
        rhw_sample_fetch_sample(groups[g].bindings, 2, at, &sample, groups[g].color[0]);
    }
}

static void fetch_layer1(struct rhw_fragment1 *f)
{
    const int32_t x = (int32_t)f->coord[0], at[3] = {x, (int32_t)f->coord[1], x / SAMPLES % 5 - 1};
    rhw_sample_fetch_sample1(f->bindings, 2, at, x % SAMPLES, f->color[0]);
}

static void expect_layers(struct rig *rig, rhw_texture texture, rhw_sampler sampler, int first, int layers)
{
    struct rig_vertex vertices[6];
    rig_cover(rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 2, texture, sampler);
    rig_draw(rig, vertices, 6);
    rig_end(rig);
    const float(*const pixels)[4] = rig_read_float4(rig);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int x = i % SIDE, layer = x / SAMPLES % 5 - 1;
        const bool exists = layer >= 0 && layer < layers;
        const int value = exists ? 10000 * (first + layer) + 2000 * (x % SAMPLES) + i : 0;
        assert_true(pixels[i][0] == (float)value && pixels[i][3] == 1);
    }
}

// An array, a part of it as an array of its own, and one layer of it as an array.
static void arrays(void **state)
{
    (void)state;
    static float texels[SIDE * SIDE];
    struct rig rig;
    rhw_texture texture, views[2];
    rhw_sampler sampler;
    rig_open(&rig, SIDE, SIDE);
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    rhw_sampler_create(rig.context, &sampler_def, &sampler);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_R32_FLOAT, .width = SIDE, .height = SIDE, .layers = 3, .samples = SAMPLES};
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    for (int n = 0; n < 3 * SAMPLES; n++) {
        for (int i = 0; i < SIDE * SIDE; i++) {
            texels[i] = (float)(10000 * (n / SAMPLES) + 2000 * (n % SAMPLES) + i);
        }
        const struct rhw_texture_region region = {.z = n / SAMPLES, .depth = 1, .sample = n % SAMPLES};
        assert_int_equal(rhw_texture_write_region(rig.context, texture, &region, texels, 0, 0), RHW_OK);
    }
    for (int i = 0; i < 2; i++) {
        const struct rhw_texture_view_def view = {.texture = texture, .layer = 1, .layers = 2 - i};
        assert_int_equal(rhw_texture_view_create(rig.context, &view, &views[i]), RHW_OK);
    }
    for (int one = 0; one < 2; one++) {
        rig_set_program(&rig, rig_vertex_pass, fetch_layer);
        if (one) {
            memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
            rig.pipeline.program.fragment1 = fetch_layer1;
        }
        rig.pipeline.program.uses = RHW_USE_COORD;
        expect_layers(&rig, texture, sampler, 0, 3);
        expect_layers(&rig, views[0], sampler, 1, 2);
        expect_layers(&rig, views[1], sampler, 1, 1);
    }
    rig_close(&rig);
}

static void formats(void **state)
{
    (void)state;
    static const enum rhw_format of[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_R32_FLOAT,
                                         RHW_FORMAT_RGBA32_FLOAT};
    for (int i = 0; i < 3; i++) {
        for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
            const struct rhw_context_def def = {
                .threads = 2, .isa_limit = rhw_isa_up_to((enum rhw_isa)isa), .validate = RHW_VALIDATE_OFF};
            if (isa_is_there((enum rhw_isa)isa)) {
                check_format(of[i], false, &def);
                check_format(of[i], true, &def);
            }
        }
    }
}

static void plain_sampling(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_sample_lod(groups[g].bindings, 2, groups[g].varying, rhw_splat(0), groups[g].color[0]);
    }
}

static void single_sampling(struct rhw_fragment *groups, int count)
{
    const rhw_int at[2] = {rhw_splat_int(0), rhw_splat_int(0)};
    for (int g = 0; g < count; g++) {
        rhw_sample_fetch_sample(groups[g].bindings, 2, at, &at[0], groups[g].color[0]);
    }
}

static void validation(void **state)
{
    (void)state;
    for (int samples = 1; samples <= 4; samples += 3) {
        struct rig rig;
        struct rig_vertex vertices[6];
        rhw_texture texture;
        rhw_sampler sampler;
        rig_open_with(&rig, SIDE, SIDE, &(struct rhw_context_def){.validate = RHW_VALIDATE_ON});
        rhw_sampler_create(rig.context, &(struct rhw_sampler_def){.lod_bias = 0}, &sampler);
        const struct rhw_texture_def def = {
            .format = RHW_FORMAT_RGBA8_UNORM, .width = SIDE, .height = SIDE, .samples = samples};
        rhw_texture_create(rig.context, &def, &texture);
        rig_set_program(&rig, rig_vertex_pass, samples > 1 ? plain_sampling : single_sampling);
        rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
        rig_begin(&rig);
        rhw_pass_set_texture(rig.context, rig.recording, 2, texture, sampler);
        rig_draw(&rig, vertices, 6);
        rhw_pass_end(rig.context, rig.recording, NULL);
        rig_expect_misuse(&rig, samples > 1 ? "samples slot 2, whose texture is multisampled; "
                                              "rhw_sample_fetch_sample reads it"
                                            : "samples slot 2, whose texture is not multisampled");
        rhw_texture_destroy(rig.context, texture);
        rhw_sampler_destroy(rig.context, sampler);
        rig_close(&rig);
    }
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(formats), cmocka_unit_test(swizzles),
                                          cmocka_unit_test(arrays), cmocka_unit_test(validation)};

const struct unit_tests test_fetch_sample = UNIT_TESTS(tests, NULL, NULL);
