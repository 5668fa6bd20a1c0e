// SPDX-License-Identifier: MIT
// Storage images and texel buffers: what is written, read back and changed by atomics, in every format, kind and level,
// and what lies outside.
#include "format/format.h"
#include "harness.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 19, HEIGHT = 11 };

static rhw_texture make_texture(struct rig *rig, const struct rhw_texture_def *def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, def, &texture), RHW_OK);
    return texture;
}

static rhw_texture make_plain(struct rig *rig, enum rhw_format format)
{
    const struct rhw_texture_def def = {
        .format = format, .width = WIDTH, .height = HEIGHT, .label = "canvas"};
    return make_texture(rig, &def);
}

static void pixel_of(const struct rhw_fragment *f, rhw_int at[3])
{
    at[0] = rhw_int_from_float(f->coord[0]);
    at[1] = rhw_int_from_float(f->coord[1]);
    at[2] = rhw_splat_int(0);
}

// Draws with a fragment function over the whole target.
static void draw(struct rig *rig, rhw_fragment_function *function, rhw_fragment1_function *one, uint32_t uses)
{
    struct rig_vertex vertices[6];
    rig_set_program(rig, rig_vertex_pass, function);
    if (one) {
        memset(rig->pipeline.program.fragment, 0, sizeof rig->pipeline.program.fragment);
    }
    rig->pipeline.program.fragment1 = one;
    rig->pipeline.program.uses = uses;
    rig_cover(rig, 0.5f, (const float[4]){0}, vertices);
    rig_draw(rig, vertices, 6);
}

// Formats ----------------------------------------------------------------------------------------------

// Values of a pixel, the same as colour and as texel; the bits are those of whole numbers too.
static void values_of(const struct rhw_fragment *f, rhw_float value[4])
{
    for (int c = 0; c < 4; c++) {
        value[c] = f->coord[0] * (0.03f * (float)(c + 1)) + f->coord[1] * 0.11f - 0.3f;
    }
}

static void write_values(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_int at[3];
        pixel_of(&groups[g], at);
        values_of(&groups[g], groups[g].color[0]);
        rhw_image_store(groups[g].textures, 3, at, &groups[g].mask, groups[g].color[0]);
    }
}

static void write_value1(struct rhw_fragment1 *f)
{
    const int32_t at[2] = {(int32_t)f->coord[0], (int32_t)f->coord[1]};
    for (int c = 0; c < 4; c++) {
        f->color[0][c] = f->coord[0] * (0.03f * (float)(c + 1)) + f->coord[1] * 0.11f - 0.3f;
    }
    rhw_image_store1(f->textures, 3, at, f->color[0]);
}

static void read_values(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_int at[3], size[3];
        pixel_of(&groups[g], at);
        rhw_image_load(groups[g].textures, 3, at, groups[g].color[0]);
        rhw_image_size(groups[g].textures, 3, size);
        const rhw_int right =
            rhw_equal_int(size[0], WIDTH) & rhw_equal_int(size[1], HEIGHT) & rhw_equal_int(size[2], 1);
        groups[g].color[0][0] = rhw_select(right, groups[g].color[0][0], rhw_splat(-99));
    }
}

static void read_value1(struct rhw_fragment1 *f)
{
    const int32_t at[2] = {(int32_t)f->coord[0], (int32_t)f->coord[1]};
    int32_t size[3];
    rhw_image_load1(f->textures, 3, at, f->color[0]);
    rhw_image_size1(f->textures, 3, size);
    if (size[0] != WIDTH || size[1] != HEIGHT || size[2] != 1) {
        f->color[0][0] = -99;
    }
}

// What is stored in a format are the bytes of a target of that format; loaded again, its values by a target of floats are
// those that sampling fetches.
static void check_format(enum rhw_format format, bool one, const struct rhw_context_def *def)
{
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, def);
    const rhw_texture image = make_plain(&rig, format);
    rig_set_target(&rig, 0, format);
    rig_begin(&rig);
    rhw_pass_set_storage_image(rig.context, rig.recording, 3, image, 0);
    draw(&rig, write_values, one ? write_value1 : NULL, RHW_USE_EFFECTS | RHW_USE_COORD);
    rig_end(&rig);
    unsigned char drawn[WIDTH * HEIGHT * 16], stored[WIDTH * HEIGHT * 16];
    const size_t size = WIDTH * HEIGHT * rhw_format_size(format);
    rhw_texture_read(rig.context, rig.pass.colors[0].texture, 0, drawn, 0);
    rhw_texture_read(rig.context, image, 0, stored, 0);
    assert_memory_equal(drawn, stored, size);

    rig_set_target(&rig, 0, RHW_FORMAT_RGBA32_FLOAT);
    rig_begin(&rig);
    rhw_pass_set_storage_image(rig.context, rig.recording, 3, image, 0);
    draw(&rig, read_values, one ? read_value1 : NULL, RHW_USE_COORD);
    rig_end(&rig);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    const int last = WIDTH * HEIGHT - 1;
    if (format == RHW_FORMAT_RGBA32_FLOAT) {
        assert_memory_equal(pixels, drawn, size);
    } else if (format == RHW_FORMAT_RGBA8_UNORM) {
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            for (int c = 0; c < 4; c++) {
                assert_true(pixels[i][c] == (float)stored[4 * i + c] / 255.0f);
            }
        }
    } else if (format == RHW_FORMAT_R32_FLOAT || format == RHW_FORMAT_R32_UINT) {
        assert_memory_equal(&pixels[last][0], stored + 4 * (size_t)last, 4);
        const uint32_t whole_one = 1; // of integers
        const float one_float = 1;
        const bool is_float = format == RHW_FORMAT_R32_FLOAT;
        assert_true(pixels[last][1] == 0 && pixels[last][2] == 0);
        assert_memory_equal(&pixels[last][3], is_float ? (const void *)&one_float : &whole_one, 4);
    }
    rhw_texture_destroy(rig.context, image);
    rig_close(&rig);
}

static void formats(void **state)
{
    (void)state;
    int count = 0;
    for (int f = 1; f < RHW_PLAIN_FORMAT_COUNT; f++) {
        if (!rhw_format_has_role(rhw_format_info((enum rhw_format)f), RHW_ROLE_COLOR_TARGET)) {
            continue;
        }
        for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
            const struct rhw_context_def def = {.threads = 3, .isa_limit = rhw_isa_up_to((enum rhw_isa)isa)};
            if (rhw_isa_supported((enum rhw_isa)isa)) {
                check_format((enum rhw_format)f, false, &def);
                check_format((enum rhw_format)f, true, &def);
            }
        }
        count++;
    }
    assert_true(count >= 6);
}

// Kinds ------------------------------------------------------------------------------------------------

// In the last of its layers or slices, and at coordinates around it, the number of the pixel plus 1.
static void write_numbers(struct rhw_fragment *groups, int count)
{
    const int32_t *const layer = groups->uniforms;
    for (int g = 0; g < count; g++) {
        rhw_int at[3];
        pixel_of(&groups[g], at);
        const rhw_float number = rhw_float_from_int(at[1] * 100 + at[0] + 1);
        at[2] = rhw_splat_int(layer[0]);
        if (layer[1]) {
            at[1] = at[2]; // of 1D: the layer, or nothing
        }
        at[0] -= 2; // some lie left of the level and some, in a larger target, right of it
        const rhw_float texel[4] = {number, number, number, number};
        rhw_image_store(groups[g].textures, 0, at, &groups[g].mask, texel);
        rhw_image_load(groups[g].textures, 0, at, groups[g].color[0]);
    }
}

static void check_kind(const struct rhw_texture_def *def, int level, int layers, int width, int height)
{
    const bool is_1d = def->kind == RHW_TEXTURE_1D;
    float texels[16 * 16];
    for (int layer = -1; layer <= layers; layer++) {
        struct rig rig;
        rig_open(&rig, 24, is_1d ? 1 : 24);
        const rhw_texture texture = make_texture(&rig, def);
        const int32_t uniforms[2] = {layer, is_1d};
        rig.pipeline.program.uniform_size = sizeof uniforms;
        rig_begin(&rig);
        rhw_pass_set_uniforms(rig.context, rig.recording, uniforms, sizeof uniforms);
        rhw_pass_set_storage_image(rig.context, rig.recording, 0, texture, level);
        draw(&rig, write_numbers, NULL, RHW_USE_EFFECTS | RHW_USE_COORD);
        rig_end(&rig);
        const bool exists = layer >= 0 && layer < layers;
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < 24 * (is_1d ? 1 : 24); i++) {
            const int x = i % 24 - 2, y = i / 24;
            const bool inside = exists && x >= 0 && x < width && y < height;
            assert_true(pixels[i][0] == (inside ? (float)(100 * y + x + 3) : 0.0f));
        }
        for (int other = 0; other < layers; other++) {
            rhw_texture_read_layer(rig.context, texture, level, other, texels, 0);
            for (int i = 0; i < width * height; i++) {
                const float expected = other == layer ? (float)(100 * (i / width) + i % width + 3) : 0.0f;
                assert_true(texels[i] == expected);
            }
        }
        rhw_texture_destroy(rig.context, texture);
        rig_close(&rig);
    }
}

static void kinds(void **state)
{
    (void)state;
    const enum rhw_format format = RHW_FORMAT_R32_FLOAT;
    check_kind(
        &(struct rhw_texture_def){.format = format, .width = 30, .height = 22, .mip_levels = 3, .layers = 3},
        1, 3, 15, 11);
    check_kind(
        &(struct rhw_texture_def){
            .format = format, .width = 12, .height = 12, .kind = RHW_TEXTURE_CUBE, .mip_levels = 2},
        1, 6, 6, 6);
    check_kind(
        &(struct rhw_texture_def){
            .format = format, .width = 9, .height = 7, .depth = 5, .kind = RHW_TEXTURE_3D, .mip_levels = 2},
        0, 5, 9, 7);
    check_kind(&(struct rhw_texture_def){.format = format, .width = 13, .kind = RHW_TEXTURE_1D, .layers = 2},
               0, 2, 13, 1);
}

// Atomics ----------------------------------------------------------------------------------------------

static void count_columns(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_int at[3], before, outside;
        pixel_of(&groups[g], at);
        at[1] = rhw_splat_int(2);
        at[2] = rhw_splat_int(1);
        const rhw_int one = rhw_splat_int(1);
        const struct rhw_storage_request request = {
            .operation = RHW_STORAGE_ADD, .mask = &groups[g].mask, .index = at, .value = &one};
        rhw_image_atomic(groups[g].textures, 0, &request, &before);
        at[1] = rhw_splat_int(HEIGHT);
        rhw_image_atomic(groups[g].textures, 0, &request, &outside);
        rhw_image_atomic(groups[g].textures, 1, &request, &before); // of another format
        groups[g].color[0][0] = groups[g].color[0][1] = groups[g].color[0][2] = groups[g].color[0][3] =
            rhw_float_from_int(before | outside);
    }
}

static void count_column1(struct rhw_fragment1 *f)
{
    int32_t at[3] = {(int32_t)f->coord[0], 2, 1};
    rhw_image_atomic1(f->textures, 0, RHW_STORAGE_ADD, at, 1, 0);
    at[1] = HEIGHT;
    const int32_t outside = rhw_image_atomic1(f->textures, 0, RHW_STORAGE_ADD, at, 1, 0);
    const int32_t before = rhw_image_atomic1(f->textures, 1, RHW_STORAGE_ADD, at, 1, 0);
    for (int c = 0; c < 4; c++) {
        f->color[0][c] = (float)(before | outside);
    }
}

static void atomics(void **state)
{
    (void)state;
    for (int one = 0; one < 2; one++) {
        struct rig rig;
        uint32_t counts[WIDTH * HEIGHT];
        rig_open(&rig, WIDTH, HEIGHT);
        const rhw_texture floats = make_plain(&rig, RHW_FORMAT_R32_FLOAT),
                          image = make_texture(&rig,
                                               &(struct rhw_texture_def){.format = one ? RHW_FORMAT_R32_SINT
                                                                                       : RHW_FORMAT_R32_UINT,
                                                                         .width = WIDTH,
                                                                         .height = HEIGHT,
                                                                         .layers = 2});
        rig_begin(&rig);
        rhw_pass_set_storage_image(rig.context, rig.recording, 0, image, 0);
        rhw_pass_set_storage_image(rig.context, rig.recording, 1, floats, 0);
        for (int i = 0; i < 3; i++) {
            draw(&rig, count_columns, one ? count_column1 : NULL, RHW_USE_EFFECTS | RHW_USE_COORD);
        }
        rig_end(&rig);
        rhw_texture_read_layer(rig.context, image, 0, 1, counts, 0);
        const float(*const seen)[4] = rig_read_float4(&rig);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            assert_int_equal(counts[i], i / WIDTH == 2 ? 3 * HEIGHT : 0);
            assert_true(seen[i][0] == 0);
        }
        rhw_texture_destroy(rig.context, image);
        rhw_texture_destroy(rig.context, floats);
        rig_close(&rig);
    }
}

// Reading alone ----------------------------------------------------------------------------------------

// Tries to write texel 1, 1 of slot 0 in every way, and shows what that gave, and the texel.
static void write_in_vain(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int one = rhw_splat_int(1), at[2] = {one, one};
        const rhw_float texel[4] = {rhw_splat(0), rhw_splat(0), rhw_splat(0), rhw_splat(0)};
        const struct rhw_storage_request request = {
            .operation = RHW_STORAGE_ADD, .mask = &f->mask, .index = at, .value = &one};
        rhw_int before;
        rhw_float found[4];
        rhw_image_store(f->textures, 0, at, &f->mask, texel);
        rhw_image_atomic(f->textures, 0, &request, &before);
        rhw_image_load(f->textures, 0, at, found);
        f->color[0][0] = rhw_float_from_int(before);
        f->color[0][1] = rhw_float_from_int(rhw_bits_from_float(found[0]));
        f->color[0][2] = f->color[0][3] = rhw_splat(1);
    }
}

static void write_in_vain1(struct rhw_fragment1 *f)
{
    const int32_t at[2] = {1, 1};
    const float none[4] = {0};
    float found[4];
    int32_t bits;
    rhw_image_store1(f->textures, 0, at, none);
    f->color[0][0] = (float)rhw_image_atomic1(f->textures, 0, RHW_STORAGE_ADD, at, 1, 0);
    rhw_image_load1(f->textures, 0, at, found);
    memcpy(&bits, found, sizeof bits);
    f->color[0][1] = (float)bits;
    f->color[0][2] = f->color[0][3] = 1;
}

// Writing and atomics do nothing and give 0; under validation they are told.
static void read_only(void **state)
{
    (void)state;
    uint32_t texels[WIDTH * HEIGHT], found[WIDTH * HEIGHT];
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        texels[i] = (uint32_t)i;
    }
    for (int n = 0; n < 4; n++) {
        const bool validates = n & 1, one = n & 2;
        struct rig rig;
        rig_open_with(&rig, WIDTH, HEIGHT,
                      &(struct rhw_context_def){.validate = validates ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF});
        const rhw_texture image = make_plain(&rig, RHW_FORMAT_R32_UINT);
        assert_int_equal(rhw_texture_write(rig.context, image, 0, texels, 0), RHW_OK);
        rig_begin(&rig);
        rhw_pass_set_read_only_storage_image(rig.context, rig.recording, 0, image, 0);
        draw(&rig, write_in_vain, one ? write_in_vain1 : NULL, RHW_USE_EFFECTS);
        rhw_pass_end(rig.context, rig.recording, &rig.stats);
        if (validates) {
            rig_expect_misuse(&rig, "writes to image slot 0, which is set for reading alone");
        }
        assert_int_equal(rhw_texture_read(rig.context, image, 0, found, 0), RHW_OK);
        assert_memory_equal(found, texels, sizeof texels);
        const float *const pixel = rig_read_float4(&rig)[100];
        assert_true(pixel[0] == 0 && pixel[1] == WIDTH + 1 && pixel[3] == 1);
        rhw_texture_destroy(rig.context, image);
        rig_close(&rig);
    }
}

// Texel buffers ----------------------------------------------------------------------------------------

// Reads texel x − 1 of slot 0 and writes it to texel 2·x of slot 1.
static void copy_texels(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_int at[3];
        pixel_of(&groups[g], at);
        const rhw_int from = at[0] - 1, to = at[0] * 2;
        rhw_image_load(groups[g].textures, 0, &from, groups[g].color[0]);
        rhw_image_store(groups[g].textures, 1, &to, &groups[g].mask, groups[g].color[0]);
    }
}

static void texel_buffers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 1);
    // RGBA8 from byte 4 on, 5 texels and a half; R32_FLOAT, 9 texels of 10.
    static const unsigned char bytes[28] = {9, 9, 9, 9, 255, 0, 51,  102, 1, 2, 3,  4,  0,  0,
                                            0, 0, 4, 5, 6,   7, 254, 3,   2, 1, 77, 77, 77, 77};
    float floats[10] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    rhw_buffer from, to;
    rhw_buffer_create(rig.context, &(struct rhw_buffer_def){.size = sizeof bytes, .data = bytes}, &from);
    rhw_buffer_create(rig.context, &(struct rhw_buffer_def){.size = sizeof floats, .data = floats}, &to);
    rig_begin(&rig);
    rhw_pass_set_texel_buffer(rig.context, rig.recording, 0, from, RHW_FORMAT_RGBA8_UNORM, 4, 22);
    rhw_pass_set_texel_buffer(rig.context, rig.recording, 1, to, RHW_FORMAT_R32_FLOAT, 4, 0);
    draw(&rig, copy_texels, NULL, RHW_USE_EFFECTS | RHW_USE_COORD);
    rig_end(&rig);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int x = 0; x < 8; x++) {
        for (int c = 0; c < 4; c++) {
            const bool inside = x >= 1 && x <= 5;
            assert_true(pixels[x][c] == (inside ? (float)bytes[4 * x + c] / 255.0f : 0.0f));
        }
    }
    rhw_buffer_read(rig.context, to, 0, floats, sizeof floats);
    for (int i = 0; i < 10; i++) { // texel 2·x stands at 2·x + 1
        const bool written = i % 2 == 1;
        assert_true(floats[i] == (written ? pixels[i / 2][0] : -1.0f));
    }
    rhw_buffer_destroy(rig.context, from);
    rhw_buffer_destroy(rig.context, to);
    rig_close(&rig);
}

// Misuse -----------------------------------------------------------------------------------------------

static void misuse(void **state)
{
    (void)state;
    struct rig rig;
    unsigned char bytes[64] = {0};
    const struct rhw_sampler_def plain = {.mip_filter = RHW_MIP_FILTER_NONE};
    rhw_sampler sampler;
    rhw_buffer buffer;
    rig_open(&rig, WIDTH, HEIGHT);
    rhw_context *const context = rig.context;
    rhw_sampler_create(context, &plain, &sampler);
    rhw_buffer_create(context, &(struct rhw_buffer_def){.size = 64, .data = bytes}, &buffer);
    const rhw_texture image = make_plain(&rig, RHW_FORMAT_RGBA8_UNORM),
                      sampled = make_plain(&rig, RHW_FORMAT_RGBA8_UNORM),
                      depth = make_plain(&rig, RHW_FORMAT_D32_FLOAT),
                      blocks = make_plain(&rig, RHW_FORMAT_BC1_RGB_UNORM);
    const rhw_texture samples = make_texture(
        &rig, &(struct rhw_texture_def){
                  .format = RHW_FORMAT_RGBA8_UNORM, .width = WIDTH, .height = HEIGHT, .samples = 4});
    rig_begin(&rig);
    const rhw_pass pass = rig.recording;
    rhw_pass_set_storage_image(context, pass, RHW_MAX_STORAGE_IMAGES, image, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_storage_image: slot is 16; it is in 0..15");
    rhw_pass_set_storage_image(context, pass, 0, image, 1);
    rig_expect_misuse(&rig, "level is 1; texture 2 \"canvas\" has levels 0..0");
    rhw_pass_set_storage_image(context, pass, 0, depth, 0);
    rig_expect_misuse(&rig, "is RHW_FORMAT_D32_FLOAT; it must be a format that can be drawn into as colour");
    rhw_pass_set_storage_image(context, pass, 0, blocks, 0);
    rig_expect_misuse(&rig, "is RHW_FORMAT_BC1_RGB_UNORM; it must be");
    rhw_pass_set_storage_image(context, pass, 0, samples, 0);
    rig_expect_misuse(&rig, "has 4 samples; it must have one");
    rhw_pass_set_storage_image(context, pass, 0, rig.pass.colors[0].texture, 0);
    rig_expect_misuse(&rig, "is an attachment of this pass");
    rhw_pass_set_read_only_storage_image(context, pass, RHW_MAX_STORAGE_IMAGES, image, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_read_only_storage_image: slot is 16; it is in 0..15");
    rhw_pass_set_read_only_storage_image(context, pass, 0, depth, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_read_only_storage_image: texture 4 \"canvas\" is RHW_FORMAT_D32");
    rhw_pass_set_texture(context, pass, 0, sampled, sampler);
    rhw_pass_set_storage_image(context, pass, 0, sampled, 0);
    rig_expect_misuse(&rig, "is sampled in this pass");
    rhw_pass_set_storage_image(context, pass, 0, image, 0);
    rhw_pass_set_storage_image(context, pass, 1, image, 0); // the same in two slots
    rhw_pass_set_texture(context, pass, 1, image, sampler);
    rig_expect_misuse(&rig, "for slot 1, is a storage image of this pass");
    rhw_texture_write(context, image, 0, bytes, 0);
    rig_expect_misuse(&rig, "is an attachment of the pass being recorded");
    rhw_pass_set_texel_buffer(context, pass, 0, buffer, RHW_FORMAT_RGBA16_FLOAT, 4, 0);
    rig_expect_misuse(&rig, "offset is 4; it must be a multiple of the 8 bytes of a texel of");
    rhw_pass_set_texel_buffer(context, pass, 0, buffer, RHW_FORMAT_D16_UNORM, 0, 0);
    rig_expect_misuse(&rig, "format is RHW_FORMAT_D16_UNORM; it must be of colour, and not compressed");
    rhw_pass_set_texel_buffer(context, pass, 0, buffer, RHW_FORMAT_RGBA8_UNORM, 0, 65);
    rig_expect_misuse(&rig, "offset is 0 and size is 65");
    rhw_pass_cancel(context, pass);
    const rhw_texture textures[] = {image, sampled, depth, blocks, samples};
    for (int i = 0; i < 5; i++) {
        rhw_texture_destroy(context, textures[i]);
    }
    rhw_buffer_destroy(context, buffer);
    rhw_sampler_destroy(context, sampler);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(formats),   cmocka_unit_test(kinds),
                                          cmocka_unit_test(atomics),   cmocka_unit_test(texel_buffers),
                                          cmocka_unit_test(read_only), cmocka_unit_test(misuse)};

const struct unit_tests test_storage_image = UNIT_TESTS(tests, NULL, NULL);
