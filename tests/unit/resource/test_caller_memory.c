// SPDX-License-Identifier: MIT
// Textures and buffers on memory of the program's: where their texels lie, what each side sees of the other, and what is
// refused.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

static rhw_texture make(const struct rig *rig, const struct rhw_texture_def *def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, def, &texture), RHW_OK);
    return texture;
}

// Filled with ones.
static unsigned char *memory_of(size_t size)
{
    unsigned char *const memory = aligned_alloc(RHW_MEMORY_ALIGNMENT, (size + 127) / 64 * 64);
    assert_non_null(memory);
    memset(memory, 1, (size + 127) / 64 * 64);
    return memory;
}

static void test_layout(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct rhw_texture_layout layout;
    // Rows of 17 texels of 4 bytes take 128 bytes; 8, 64; 4 and below 64.
    const struct rhw_texture_def array = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = 17, .height = 5, .layers = 3, .mip_levels = 3};
    assert_int_equal(rhw_texture_query_layout(rig.context, &array, &layout), RHW_OK);
    assert_int_equal(layout.alignment, 64);
    assert_int_equal(layout.levels, 3);
    static const size_t rows[] = {128, 64, 64}, slices[] = {640, 128, 64}, offsets[] = {0, 1920, 2304};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(layout.level[i].offset, offsets[i]);
        assert_int_equal(layout.level[i].row_pitch, rows[i]);
        assert_int_equal(layout.level[i].slice_pitch, slices[i]);
        assert_int_equal(layout.level[i].stencil_row_pitch, 0);
    }
    assert_int_equal(layout.size, 2304 + 3 * 64 + RHW_MEMORY_PADDING);
    // A plane of depth, one of stencil, and the same for each sample.
    const struct rhw_texture_def both = {
        .format = RHW_FORMAT_D32_FLOAT_S8_UINT, .width = 20, .height = 6, .samples = 4, .row_pitch = 192};
    assert_int_equal(rhw_texture_query_layout(rig.context, &both, &layout), RHW_OK);
    assert_int_equal(layout.level[0].row_pitch, 192);
    assert_int_equal(layout.level[0].stencil_offset, 6 * 192);
    assert_int_equal(layout.level[0].stencil_row_pitch, 64);
    assert_int_equal(layout.level[0].stencil_slice_pitch, 6 * 64);
    assert_int_equal(layout.sample_stride, 6 * 256);
    assert_int_equal(layout.size, 4 * 6 * 256 + RHW_MEMORY_PADDING);
    rhw_texture_query_layout(rig.context, NULL, &layout);
    rig_expect_misuse(&rig, "rhw_texture_query_layout: def is NULL");
    rhw_texture_query_layout(rig.context, &array, NULL);
    rig_expect_misuse(&rig, "layout is NULL");
    rig_close(&rig);
}

// Texel (x, y) of slice z of a level is where the layout says, for every way to it.
static void test_where_texels_are(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct rhw_texture_def def = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 17, .height = 5, .layers = 3, .mip_levels = 3};
    struct rhw_texture_layout layout;
    assert_int_equal(rhw_texture_query_layout(rig.context, &def, &layout), RHW_OK);
    unsigned char *const memory = memory_of(layout.size);
    def.memory = memory;
    def.memory_size = layout.size;
    const rhw_texture texture = make(&rig, &def);
    for (int level = 0; level < 3; level++) {
        const int width = rhw_texture_width(rig.context, texture, level),
                  height = rhw_texture_height(rig.context, texture, level);
        for (int z = 0; z < 3; z++) {
            float texels[17 * 5];
            // What the memory holds is what the texture holds.
            assert_int_equal(rhw_texture_read_layer(rig.context, texture, level, z, texels, 0), RHW_OK);
            static const unsigned char ones[4] = {1, 1, 1, 1};
            assert_memory_equal(&texels[width * height - 1], ones, 4);
            for (int i = 0; i < width * height; i++) {
                texels[i] = (float)(1000 * level + 100 * z + i);
            }
            assert_int_equal(rhw_texture_write_layer(rig.context, texture, level, z, texels, 0), RHW_OK);
        }
        const struct rhw_level_layout *const at = &layout.level[level];
        for (int z = 0; z < 3; z++) {
            for (int i = 0; i < width * height; i++) {
                float texel;
                memcpy(&texel,
                       memory + at->offset + (size_t)z * at->slice_pitch +
                           (size_t)(i / width) * at->row_pitch + (size_t)(i % width) * 4,
                       sizeof texel);
                assert_true(texel == (float)(1000 * level + 100 * z + i));
            }
        }
    }
    rhw_texture_destroy(rig.context, texture);
    assert_int_equal(memory[layout.size - RHW_MEMORY_PADDING], 1);
    rig_close(&rig);
    free(memory);
}

static const float red[4] = {1, 0, 0, 1}, zero[4];

// A pass draws into the memory, with its row pitch; what the program writes there meanwhile the next one sees: also where it
// would clear to what its tiles held.
static void test_drawn_into(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 70, 40);
    struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = 70, .height = 40, .row_pitch = 1280};
    struct rhw_texture_layout layout;
    assert_int_equal(rhw_texture_query_layout(rig.context, &def, &layout), RHW_OK);
    assert_int_equal(layout.size, 1280 * 40 + RHW_MEMORY_PADDING);
    float *const memory = (float *)memory_of(layout.size);
    def.memory = memory;
    def.memory_size = layout.size;
    rig.pass.colors[0].texture = make(&rig, &def);
    struct rig_vertex vertices[6];
    rig_rectangle(&rig, 0, 0, 70, 20, 0, red, vertices);
    rig_draw_once(&rig, vertices, 6);
    for (int y = 0; y < 40; y++) {
        for (int x = 0; x < 70; x++) {
            assert_memory_equal(memory + 320 * y + 4 * x, y < 20 ? red : zero, sizeof red);
        }
        uint32_t behind;
        memcpy(&behind, memory + 320 * y + 4 * 70, sizeof behind);
        assert_int_equal(behind, 0x01010101);
    }
    for (int round = 0; round < 2; round++) {
        memory[320 * 39 + 4 * 69] = 5;
        rig_begin(&rig);
        rig_end(&rig);
        assert_true(memory[320 * 39 + 4 * 69] == 0);
    }
    rig.pass.colors[0].load = RHW_LOAD_LOAD;
    memory[320 * 39 + 4 * 69] = 6;
    rig_draw_once(&rig, vertices, 6);
    assert_true(memory[320 * 39 + 4 * 69] == 6 && memory[0] == 1);
    rig_close(&rig);
    free(memory);
}

static void sample_middle(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float at[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
        rhw_sample_lod(groups[g].bindings, 0, at, rhw_splat(0), groups[g].color[0]);
    }
}

// Two textures whose rows take turns, as halves of one picture, are told apart.
static void test_side_by_side(void **state)
{
    (void)state;
    enum { SIDE = 16, ROW = SIDE * 4, PITCH = 2 * ROW };
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    unsigned char *const memory = memory_of(SIDE * PITCH + ROW + RHW_MEMORY_PADDING);
    for (int i = 0; i < 2; i++) {
        const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_UNORM,
                                            .width = SIDE,
                                            .height = SIDE,
                                            .row_pitch = PITCH,
                                            .memory = memory + i * ROW,
                                            .memory_size = SIDE * PITCH + RHW_MEMORY_PADDING};
        rig_set_target(&rig, i, RHW_FORMAT_RGBA8_UNORM);
        rig.pass.colors[i] = (struct rhw_color_attachment){.texture = make(&rig, &def)};
        rig.pass.colors[i].clear[i] = 1;
    }
    rig_begin(&rig);
    rig_end(&rig);
    for (int i = 0; i < SIDE * PITCH; i += 4) {
        assert_int_equal(memory[i], i % PITCH < ROW ? 255 : 0);
        assert_int_equal(memory[i + 1], i % PITCH < ROW ? 0 : 255);
    }
    rig_close(&rig);
    free(memory);
}

// Every pass sees what the program has written since the last one, also in the linear copy of an sRGB texture.
static void test_sampled(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB};
    for (int n = 0; n < 2; n++) {
        struct rig rig;
        rig_open(&rig, 8, 8);
        rig_set_program(&rig, rig_vertex_pass, sample_middle);
        struct rhw_texture_def def = {.format = formats[n], .width = 16, .height = 16};
        struct rhw_texture_layout layout;
        assert_int_equal(rhw_texture_query_layout(rig.context, &def, &layout), RHW_OK);
        unsigned char *const memory = memory_of(layout.size);
        def.memory = memory;
        def.memory_size = layout.size;
        const rhw_texture texture = make(&rig, &def);
        const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_LINEAR};
        rhw_sampler sampler;
        assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
        struct rig_vertex vertices[6];
        rig_cover(&rig, 0, zero, vertices);
        for (int round = 0; round < 3; round++) {
            memset(memory, round % 2 ? 255 : 0, 16 * 64);
            rig_begin(&rig);
            rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
            rig_draw(&rig, vertices, 6);
            const uint32_t word = 0;
            rhw_texture_write_region(rig.context, texture,
                                     &(struct rhw_texture_region){.width = 1, .height = 1}, &word, 0, 0);
            rig_expect_misuse(&rig,
                              "stands on memory of the program, and the pass being recorded samples them");
            assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
            assert_true(rig_read_float4(&rig)[0][1] == (float)(round % 2));
        }
        rig_close(&rig);
        free(memory);
    }
}

static void test_buffers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rig_vertex *const memory = (struct rig_vertex *)memory_of(6 * sizeof *memory);
    struct rhw_buffer_def def = {
        .size = 6 * sizeof *memory, .memory = memory, .memory_size = 6 * sizeof *memory, .label = "own"};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    uint32_t word;
    memcpy(&word, memory, sizeof word);
    assert_int_equal(word, 0x01010101);
    void *bytes;
    assert_int_equal(rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ, &bytes), RHW_OK);
    assert_ptr_equal(bytes, memory);
    rhw_buffer_unmap(rig.context, buffer);
    for (int round = 0; round < 2; round++) {
        rig_cover(&rig, 0, round ? zero : red, memory); // by the program
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
        if (round) {
            rhw_buffer_fill(rig.context, buffer, 0, 0, 0);
            rig_expect_misuse(&rig,
                              "rhw_buffer_fill: buffer 1 \"own\" stands on memory of the program and the "
                              "pass being recorded reads some of bytes 0 to 192; end that first");
            assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
        } else {
            rig_end(&rig);
        }
        assert_memory_equal(rig_read_float4(&rig)[63], round ? zero : red, sizeof red);
    }
    assert_int_equal(rhw_buffer_fill(rig.context, buffer, 4, 4, 0x12345678), RHW_OK);
    memcpy(&word, (unsigned char *)memory + 4, sizeof word);
    assert_int_equal(word, 0x12345678);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer_range(rig.context, rig.recording, 0, buffer, 0, 3 * sizeof *memory);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    assert_int_equal(rhw_buffer_fill(rig.context, buffer, 3 * sizeof *memory, 0, 7), RHW_OK); // beside them
    memcpy(&word, memory + 3, sizeof word);
    assert_int_equal(word, 7);
    rig_end(&rig);
    rhw_buffer_destroy(rig.context, buffer);
    static const unsigned char three[3] = {7, 8, 9};
    memset(memory, 1, 128);
    def.size = def.memory_size = 3;
    def.data = three;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    assert_memory_equal(memory, "\7\10\11\1\1\1\1", 7); // what stands behind it is the program's
    rig_close(&rig);
    free(memory);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    static _Alignas(64) unsigned char memory[1024];
    const struct rhw_texture_def plain = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 16, .height = 2};
    rhw_texture texture;
    struct rhw_texture_def def = plain;
    def.memory = memory;
    def.memory_size = 191; // two rows of 64 bytes, and 64
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_ERROR_MISUSE);
    rig_expect_misuse(
        &rig,
        "rhw_texture_create: memory_size is 191; the texture takes 192 bytes (rhw_texture_query_layout)");
    def.memory = memory + 32;
    def.memory_size = 512;
    rhw_texture_create(rig.context, &def, &texture);
    rig_expect_misuse(&rig, "its address must be a multiple of 64");
    def.memory = NULL;
    rhw_texture_create(rig.context, &def, &texture);
    rig_expect_misuse(&rig, "memory_size is 512 and memory is NULL; it must be 0 then");
    static const struct {
        size_t row_pitch;
        int levels;
        const char *message;
    } pitches[] = {{32, 0, "row_pitch is 32; it is 0, or a multiple of 64 in 64..65536"},
                   {96, 0, "row_pitch is 96; it is 0, or a multiple of 64 in 64..65536"},
                   {65600, 0, "row_pitch is 65600; it is 0, or a multiple of 64 in 64..65536"},
                   {128, 2, "row_pitch is set and mip_levels is 2; with one level alone"}};
    for (size_t i = 0; i < sizeof pitches / sizeof *pitches; i++) {
        def = plain;
        def.row_pitch = pitches[i].row_pitch;
        def.mip_levels = pitches[i].levels;
        rhw_texture_create(rig.context, &def, &texture);
        rig_expect_misuse(&rig, pitches[i].message);
    }
    struct rhw_buffer_def buffer_def = {.size = 64, .memory = memory, .memory_size = 63};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &buffer_def, &buffer), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_buffer_create: memory_size is 63; it must be at least size, which is 64");
    buffer_def.memory = memory + 1;
    rhw_buffer_create(rig.context, &buffer_def, &buffer);
    rig_expect_misuse(&rig, "its address must be a multiple of 64");
    rig_close(&rig);
}

// A texture of two levels of one colour each on `memory`, which tells what it writes.
static rhw_texture make_told(const struct rig *rig, unsigned char **memory, struct rhw_texture_layout *layout)
{
    struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = 16, .height = 16, .mip_levels = 2, .memory_is_told = true};
    assert_int_equal(rhw_texture_query_layout(rig->context, &def, layout), RHW_OK);
    *memory = memory_of(layout->size);
    memset(*memory, 0, layout->size);
    def.memory = *memory;
    def.memory_size = layout->size;
    return make(rig, &def);
}

static void sample_levels(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float at[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
        rhw_float texel[4];
        for (int level = 0; level < 2; level++) {
            rhw_sample_lod(groups[g].bindings, 0, at, rhw_splat((float)level), texel);
            groups[g].color[0][level] = texel[0];
        }
        groups[g].color[0][2] = groups[g].color[0][3] = rhw_splat(0);
    }
}

// Draw, and want what the sampler finds in the middle of both levels.
static void expect_levels(struct rig *rig, rhw_texture texture, rhw_sampler sampler, float first,
                          float second)
{
    struct rig_vertex vertices[6];
    rig_cover(rig, 0, zero, vertices);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, texture, sampler);
    rig_draw(rig, vertices, 6);
    rhw_texture_changed(rig->context, texture, 0, 0, 0);
    rig_expect_misuse(rig,
                      "rhw_texture_changed: texture 2 shares its texels with views or stands on memory of "
                      "the program, and the pass being recorded samples them; end that first");
    assert_int_equal(rhw_pass_end(rig->context, rig->recording, NULL), RHW_ERROR_MISUSE);
    assert_true(rig_read_float4(rig)[0][0] == first);
    assert_true(rig_read_float4(rig)[0][1] == second);
}

// The linear copy of a told texture is kept from pass to pass; a level that was told is decoded again, and no other.
static void test_told_levels(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_program(&rig, rig_vertex_pass, sample_levels);
    unsigned char *memory;
    struct rhw_texture_layout layout;
    const rhw_texture texture = make_told(&rig, &memory, &layout);
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &(struct rhw_sampler_def){.lod_bias = 0}, &sampler),
                     RHW_OK);
    expect_levels(&rig, texture, sampler, 0, 0);
    memset(memory, 255, layout.size);
    expect_levels(&rig, texture, sampler, 0, 0); // nobody told
    assert_int_equal(rhw_texture_changed(rig.context, texture, 1, 0, 0), RHW_OK);
    expect_levels(&rig, texture, sampler, 0, 1);
    assert_int_equal(rhw_texture_changed(rig.context, texture, 0, 0, 1), RHW_OK);
    expect_levels(&rig, texture, sampler, 1, 1);
    // What the library writes needs not be told.
    static const unsigned char black[16 * 16 * 4];
    assert_int_equal(rhw_texture_write(rig.context, texture, 0, black, 0), RHW_OK);
    expect_levels(&rig, texture, sampler, 0, 1);
    // What is told of a view holds for the texture.
    rhw_texture view;
    const struct rhw_texture_view_def def = {.texture = texture, .level = 1};
    assert_int_equal(rhw_texture_view_create(rig.context, &def, &view), RHW_OK);
    memset(memory + layout.level[1].offset, 0, 64 * 8);
    expect_levels(&rig, texture, sampler, 0, 1);
    assert_int_equal(rhw_texture_changed(rig.context, view, 0, 0, 0), RHW_OK);
    expect_levels(&rig, texture, sampler, 0, 0);
    rig_close(&rig);
    free(memory);
}

// A pass clears tiles of a told texture anew where they were told, layer by layer.
static void test_told_layers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 70, 40);
    struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = 70, .height = 40, .layers = 3, .memory_is_told = true};
    struct rhw_texture_layout layout;
    assert_int_equal(rhw_texture_query_layout(rig.context, &def, &layout), RHW_OK);
    float *const memory = (float *)memory_of(layout.size);
    def.memory = memory;
    def.memory_size = layout.size;
    const rhw_texture texture = make(&rig, &def);
    rig.pass.colors[0].texture = texture;
    const size_t slice = layout.level[0].slice_pitch / sizeof *memory;
    for (int told = -1; told < 4; told++) {
        for (int layer = 0; layer < 3; layer++) {
            rig.pass.colors[0].layer = layer;
            rig_begin(&rig);
            rhw_texture_changed(rig.context, texture, 0, 0, 0);
            rig_expect_misuse(&rig,
                              "rhw_texture_changed: texture 2 is an attachment of the pass being recorded");
            assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
        }
        for (int layer = 0; layer < 3; layer++) {
            // The first passes clear all; those of the second and third round miss a change that nobody told.
            const bool is_stale = told > 0 && told < 3 && layer != told && layer != 0;
            assert_true(memory[(size_t)layer * slice] == (is_stale ? 5.0f : 0.0f));
            memory[(size_t)layer * slice] = 5;
        }
        const int next = told + 1;
        if (next < 3) {
            assert_int_equal(rhw_texture_changed(rig.context, texture, 0, next, 1), RHW_OK);
            assert_int_equal(rhw_texture_changed(rig.context, texture, 0, 0, next == 0 ? 0 : 1), RHW_OK);
        } else {
            assert_int_equal(rhw_texture_changed(rig.context, texture, 0, 0, 3), RHW_OK);
        }
    }
    rig_close(&rig);
    free(memory);
}

static void test_told_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 16, .height = 2, .layers = 2};
    const rhw_texture own = make(&rig, &def);
    static _Alignas(64) unsigned char memory[1024];
    def.memory = memory;
    def.memory_size = sizeof memory;
    const rhw_texture texture = make(&rig, &def);
    static const struct {
        int level, layer, count;
        const char *message;
    } wrong[] = {{1, 0, 0, "rhw_texture_changed: level is 1; texture 3 has levels 0..0"},
                 {-1, 0, 0, "rhw_texture_changed: level is -1; texture 3 has levels 0..0"},
                 {0, 2, 0, "rhw_texture_changed: layer is 2; level 0 of texture 3 has 0..1"},
                 {0, -1, 0, "rhw_texture_changed: layer is -1; level 0 of texture 3 has 0..1"},
                 {0, 1, 2, "layer is 1 and layer_count is 2; level 0 of texture 3 has 0..1"},
                 {0, 0, -1, "layer is 0 and layer_count is -1; level 0 of texture 3 has 0..1"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(
            rhw_texture_changed(rig.context, texture, wrong[i].level, wrong[i].layer, wrong[i].count),
            RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, wrong[i].message);
    }
    assert_int_equal(rhw_texture_changed(rig.context, texture, 0, 1, 1),
                     RHW_OK); // needless without memory_is_told
    rhw_texture_changed(rig.context, own, 0, 0, 0);
    rig_expect_misuse(&rig,
                      "texture 2 stands on memory of the library; it must stand on memory of the program");
    def.memory = NULL;
    def.memory_size = 0;
    def.memory_is_told = true;
    rhw_texture refused;
    rhw_texture_create(rig.context, &def, &refused);
    rig_expect_misuse(&rig, "memory_is_told is true and memory is NULL; it must be false then");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_told_levels),      cmocka_unit_test(test_told_layers),
    cmocka_unit_test(test_told_misuse),      cmocka_unit_test(test_layout),
    cmocka_unit_test(test_where_texels_are), cmocka_unit_test(test_drawn_into),
    cmocka_unit_test(test_side_by_side),     cmocka_unit_test(test_sampled),
    cmocka_unit_test(test_buffers),          cmocka_unit_test(test_misuse),
};

const struct unit_tests test_caller_memory = UNIT_TESTS(tests, NULL, NULL);
