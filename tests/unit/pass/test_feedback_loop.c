// SPDX-License-Identifier: MIT
// What a pass draws into, writes and reads is told apart by level and layer: others of the same texture are free, in
// the same pass, and the same ones are not, by any name.
#include "harness.h"

#include <string.h>

#include "base/constants.h"

static rhw_texture make(const struct rig *rig, struct rhw_texture_def def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static rhw_texture make_view(const struct rig *rig, struct rhw_texture_view_def def)
{
    rhw_texture view;
    assert_int_equal(rhw_texture_view_create(rig->context, &def, &view), RHW_OK);
    return view;
}

static rhw_sampler make_sampler(const struct rig *rig)
{
    const struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST,
                                        .mag_filter = RHW_FILTER_NEAREST,
                                        .mip_filter = RHW_MIP_FILTER_NONE};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, &def, &sampler), RHW_OK);
    return sampler;
}

// The sum of the four texels of slot 0 that lie in the pixel.
static void sum4(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int x = rhw_int_from_float(f->coord[0]) * 2, y = rhw_int_from_float(f->coord[1]) * 2;
        for (int i = 0; i < 4; i++) {
            const rhw_int at[2] = {x + i % 2, y + i / 2};
            rhw_float texel[4];
            rhw_sample_fetch(f->textures, 0, at, NULL, texel);
            for (int c = 0; c < 4; c++) {
                f->color[0][c] = i == 0 ? texel[c] : f->color[0][c] + texel[c];
            }
        }
    }
}

// The texel of slot 0 at the pixel, and one more.
static void add_one(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float(f->coord[0]), rhw_int_from_float(f->coord[1])};
        rhw_sample_fetch(f->textures, 0, at, NULL, f->color[0]);
        f->color[0][0] += 1;
    }
}

// The same texel is written to image 0.
static void copy_to_image(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float(f->coord[0]), rhw_int_from_float(f->coord[1])};
        rhw_float texel[4];
        rhw_sample_fetch(f->textures, 0, at, NULL, texel);
        rhw_image_store(f->textures, 0, at, &f->mask, texel);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = rhw_splat(0);
        }
    }
}

static void draw_cover(struct rig *rig)
{
    static const float zero[4];
    struct rig_vertex vertices[6];
    rig_cover(rig, 0, zero, vertices);
    rig_draw(rig, vertices, 6);
}

// A mip chain, each level drawn from the one before.
static void test_levels(void **state)
{
    (void)state;
    enum { SIDE = 128, LEVELS = 4 };
    static float texels[SIDE * SIDE], found[SIDE * SIDE];
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    rig_set_program(&rig, rig_vertex_pass, sum4);
    rig.pipeline.program.uses = RHW_USE_COORD;
    rig.pipeline.targets[0].format = RHW_FORMAT_R32_FLOAT;
    const rhw_sampler sampler = make_sampler(&rig);
    const rhw_texture texture =
        make(&rig, (struct rhw_texture_def){
                       .format = RHW_FORMAT_R32_FLOAT, .width = SIDE, .height = SIDE, .mip_levels = LEVELS});
    for (int i = 0; i < SIDE * SIDE; i++) {
        texels[i] = (float)(i * 7 % 1000);
    }
    assert_int_equal(rhw_texture_write(rig.context, texture, 0, texels, 0), RHW_OK);
    for (int level = 1; level < LEVELS; level++) {
        rig.pass.colors[0].texture = texture;
        rig.pass.colors[0].level = level;
        rig_begin(&rig);
        rhw_pass_set_texture(
            rig.context, rig.recording, 0,
            make_view(&rig,
                      (struct rhw_texture_view_def){.texture = texture, .level = level - 1, .levels = 1}),
            sampler);
        draw_cover(&rig);
        rig_end(&rig);
        const int side = SIDE >> level;
        for (int y = 0; y < side; y++) { // in place: what is read lies behind what is written
            for (int x = 0; x < side; x++) {
                const float *const from = &texels[2 * y * 2 * side + 2 * x];
                texels[y * side + x] = from[0] + from[1] + from[2 * side] + from[2 * side + 1];
            }
        }
        assert_int_equal(rhw_texture_read(rig.context, texture, level, found, 0), RHW_OK);
        assert_memory_equal(found, texels, (size_t)side * (size_t)side * sizeof found[0]);
    }
    // A view that has the level as well, and the texture itself.
    const rhw_texture two =
        make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .level = LEVELS - 2, .levels = 2});
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, two, sampler);
    rig_expect_misuse(
        &rig, "is an attachment of this pass, or has a level and layer of one; sample a view of others");
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
    rig_expect_misuse(&rig, "is an attachment of this pass");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

// Of an array, a cube and a 3D texture: layer after layer, by passes of one and of two layers.
static void test_layers(void **state)
{
    (void)state;
    static const struct rhw_texture_def defs[] = {
        {.format = RHW_FORMAT_R32_FLOAT, .width = 8, .height = 8, .layers = 6},
        {.format = RHW_FORMAT_R32_FLOAT, .width = 8, .height = 8, .kind = RHW_TEXTURE_CUBE},
        {.format = RHW_FORMAT_R32_FLOAT, .width = 8, .height = 8, .kind = RHW_TEXTURE_3D, .depth = 6}};
    for (int d = 0; d < 3; d++) {
        struct rig rig;
        float texels[64];
        rig_open(&rig, 8, 8);
        rig_set_program(&rig, rig_vertex_pass, add_one);
        rig.pipeline.program.uses = RHW_USE_COORD;
        rig.pipeline.targets[0].format = RHW_FORMAT_R32_FLOAT;
        const rhw_sampler sampler = make_sampler(&rig);
        const rhw_texture texture = make(&rig, defs[d]);
        rhw_texture layer[6];
        for (int i = 0; i < 6; i++) {
            layer[i] = make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .layer = i});
        }
        for (int i = 1; i < 6; i++) {
            rig.pass.colors[0].texture = i % 2 ? texture : layer[i];
            rig.pass.colors[0].layer = i % 2 ? i : 0;
            rig_begin(&rig);
            rhw_pass_set_texture(rig.context, rig.recording, 0, layer[i], sampler);
            rig_expect_misuse(&rig, "for slot 0, is an attachment of this pass");
            rhw_pass_set_texture(rig.context, rig.recording, 0, layer[i - 1], sampler);
            draw_cover(&rig);
            rig_end(&rig);
            rhw_texture_read_layer(rig.context, texture, 0, i, texels, 0);
            assert_true(texels[0] == (float)i && texels[63] == (float)i);
        }
        rig.pass.colors[0] = (struct rhw_color_attachment){.texture = texture, .layer = 2, .layer_count = 2};
        rig_begin(&rig);
        for (int i = 0; i < 6; i++) {
            rhw_pass_set_texture(rig.context, rig.recording, 0, layer[i], sampler);
            if (i == 2 || i == 3) {
                rig_expect_misuse(&rig, "is an attachment of this pass");
            }
        }
        rhw_pass_cancel(rig.context, rig.recording);
        rig_close(&rig);
    }
}

// One level is written as an image, one sampled, one drawn into, in one pass.
static void test_images(void **state)
{
    (void)state;
    enum { SIDE = 8 };
    struct rig rig;
    float texels[SIDE * SIDE], found[SIDE * SIDE];
    rig_open(&rig, SIDE, SIDE);
    rhw_context *const context = rig.context;
    rig_set_program(&rig, rig_vertex_pass, copy_to_image);
    rig.pipeline.program.uses = RHW_USE_COORD | RHW_USE_EFFECTS;
    rig.pipeline.targets[0].format = RHW_FORMAT_R32_FLOAT;
    const rhw_sampler sampler = make_sampler(&rig);
    const rhw_texture texture = make(
        &rig, (struct rhw_texture_def){
                  .format = RHW_FORMAT_R32_FLOAT, .width = 4 * SIDE, .height = 4 * SIDE, .mip_levels = 4});
    rhw_texture level[4];
    for (int i = 0; i < 4; i++) {
        level[i] =
            make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .level = i, .levels = 1});
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        texels[i] = (float)(i + 1);
    }
    assert_int_equal(rhw_texture_write(context, texture, 2, texels, 0), RHW_OK);
    rig.pass.colors[0] = (struct rhw_color_attachment){.texture = level[3]};
    rig_begin(&rig);
    const rhw_pass pass = rig.recording;
    rhw_pass_set_texture(context, pass, 0, level[2], sampler);
    rhw_pass_set_storage_image(context, pass, 0, texture, 1);
    rhw_pass_set_storage_image(context, pass, 0, level[1], 0); // by another name
    draw_cover(&rig);
    rhw_pass_set_storage_image(context, pass, 1, texture, 2);
    rig_expect_misuse(&rig, "level 2 of texture 2 is sampled in this pass or set for reading alone, or has a "
                            "layer that is");
    rhw_pass_set_storage_image(context, pass, 1, texture, 3);
    rig_expect_misuse(&rig, "level 3 of texture 2 is an attachment of this pass, or has a layer of one");
    rhw_pass_set_texture(context, pass, 1, level[1], sampler);
    rig_expect_misuse(&rig, "for slot 1, is a storage image of this pass, or has a level and layer of one");
    rhw_pass_set_texture(context, pass, 1, level[3], sampler);
    rig_expect_misuse(&rig, "for slot 1, is an attachment of this pass");
    rhw_pass_set_texture(context, pass, 1, level[0], sampler);
    rhw_pass_set_storage_image(context, pass, 1, level[0], 0);
    rig_expect_misuse(&rig, "is sampled in this pass");
    rig_end(&rig);
    static float larger[4 * SIDE * SIDE];
    assert_int_equal(rhw_texture_read(context, texture, 1, larger, 0), RHW_OK);
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < 2 * SIDE; x++) { // the pass has the size of the last level
            const bool written = x < SIDE / 2 && y < SIDE / 2;
            assert_true(larger[y * 2 * SIDE + x] == (written ? texels[y * SIDE + x] : 0));
        }
    }
    assert_int_equal(rhw_texture_read(context, texture, 2, found, 0), RHW_OK);
    assert_memory_equal(found, texels, sizeof found);
    // What was set is forgotten with the pass.
    rig_begin(&rig);
    rhw_pass_set_storage_image(context, rig.recording, 1, texture, 2);
    rhw_pass_set_texture(context, rig.recording, 0, level[1], sampler);
    rhw_pass_cancel(context, rig.recording);
    rig_close(&rig);
}

// What images 1 and 2 hold at the pixel and texture 0 does: a hundredth, a tenth and all of it; that is written to
// image 0 as well.
static void add_loaded(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float(f->coord[0]), rhw_int_from_float(f->coord[1])};
        rhw_float texel[3][4];
        rhw_sample_fetch(f->textures, 0, at, NULL, texel[0]);
        rhw_image_load(f->textures, 1, at, texel[1]);
        rhw_image_load(f->textures, 2, at, texel[2]);
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = texel[0][c] * 100 + texel[1][c] * 10 + texel[2][c];
        }
        rhw_image_store(f->textures, 0, at, &f->mask, f->color[0]);
    }
}

// A level that is only loaded is sampled and loaded by another name too, while others of its texture are written and
// drawn into; it is written between draws, and each keeps what it had.
static void test_read_only_images(void **state)
{
    (void)state;
    enum { SIDE = 8 };
    struct rig rig;
    struct rig_vertex vertices[6];
    static float texels[4 * SIDE * SIDE];
    static const float zero[4];
    rig_open(&rig, SIDE, SIDE);
    rhw_context *const context = rig.context;
    rig_set_program(&rig, rig_vertex_pass, add_loaded);
    rig.pipeline.program.uses = RHW_USE_COORD | RHW_USE_EFFECTS;
    rig.pipeline.targets[0].format = RHW_FORMAT_R32_FLOAT;
    const rhw_sampler sampler = make_sampler(&rig);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_R32_FLOAT, .width = 4 * SIDE, .height = 4 * SIDE, .mip_levels = 4};
    const struct rhw_texture_def plain = {.format = RHW_FORMAT_R32_FLOAT, .width = SIDE, .height = SIDE};
    const rhw_texture texture = make(&rig, def), other = make(&rig, plain);
    const rhw_texture level2 =
        make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .level = 2, .levels = 1});
    for (int i = 0; i < SIDE * SIDE; i++) {
        texels[i] = 2;
    }
    assert_int_equal(rhw_texture_write(context, texture, 2, texels, 0), RHW_OK);
    assert_int_equal(rhw_texture_write(context, other, 0, texels, 0), RHW_OK);
    rig.pass.colors[0] = (struct rhw_color_attachment){.texture = texture, .level = 3};
    rig_begin(&rig);
    const rhw_pass pass = rig.recording;
    rhw_pass_set_storage_image(context, pass, 0, texture, 1);
    rhw_pass_set_read_only_storage_image(context, pass, 1, texture, 2);
    rhw_pass_set_read_only_storage_image(context, pass, 2, other, 0);
    rhw_pass_set_texture(context, pass, 0, level2, sampler);
    rig_rectangle(&rig, 0, 0, SIDE / 2, SIDE, 0, zero, vertices);
    rig_draw(&rig, vertices, 6);
    for (int i = 0; i < SIDE * SIDE; i++) {
        texels[i] = 3;
    }
    rhw_texture_write(context, texture, 2, texels, 0); // what views share stays as it is
    rig_expect_misuse(&rig, "is an attachment of the pass being recorded; end that first");
    assert_int_equal(rhw_texture_write(context, other, 0, texels, 0), RHW_OK);
    rig_rectangle(&rig, SIDE / 2, 0, SIDE, SIDE, 0, zero, vertices);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    for (int level = 1; level < 4; level += 2) { // a pass of 4x4 pixels
        assert_int_equal(rhw_texture_read(context, texture, level, texels, 0), RHW_OK);
        const int row = 4 * SIDE >> level;
        assert_true(texels[1] == 222 && texels[row + 2] == 223 && texels[3 * row + 3] == 223);
    }
    rig_close(&rig);
}

// It is neither attached nor written besides, in either order and by any name.
static void test_read_only_images_exclude(void **state)
{
    (void)state;
    enum { SIDE = 8 };
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    rhw_context *const context = rig.context;
    const rhw_texture texture = make(
        &rig, (struct rhw_texture_def){
                  .format = RHW_FORMAT_RGBA8_UNORM, .width = 2 * SIDE, .height = 2 * SIDE, .mip_levels = 4});
    const rhw_texture level1 =
        make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .level = 1, .levels = 1});
    rig.pass.colors[0] = (struct rhw_color_attachment){.texture = texture, .level = 1};
    rig_begin(&rig);
    const rhw_pass pass = rig.recording;
    rhw_pass_set_read_only_storage_image(context, pass, 0, level1, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_read_only_storage_image: level 0 of texture 3 is an attachment of "
                            "this pass, or has a layer of one; it must be another");
    rhw_pass_set_storage_image(context, pass, 0, texture, 2);
    rhw_pass_set_read_only_storage_image(context, pass, 1, texture, 2);
    rig_expect_misuse(&rig, "level 2 of texture 2 is a storage image of this pass, or has a layer of one");
    rhw_pass_set_storage_image(context, pass, 0, (rhw_texture){0}, 0);
    rhw_pass_set_read_only_storage_image(context, pass, 1, texture, 2); // from then on
    rig_expect_misuse(&rig, "is a storage image of this pass");
    rhw_pass_set_read_only_storage_image(context, pass, 1, texture, 0);
    rhw_pass_set_read_only_storage_image(context, pass, 2, texture, 0);
    rhw_pass_set_storage_image(context, pass, 0, texture, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_storage_image: level 0 of texture 2 is sampled in this pass or set "
                            "for reading alone, or has a layer that is; it must be another");
    rhw_pass_set_storage_image(context, pass, 0, texture, 3); // of the same texture, which is free
    assert_int_equal(rig.misuses, 0);
    rhw_pass_cancel(context, pass);
    // What was set is forgotten with the pass.
    rig_begin(&rig);
    rhw_pass_set_storage_image(context, rig.recording, 0, texture, 0);
    rhw_pass_set_read_only_storage_image(context, rig.recording, 1, texture, 2);
    assert_int_equal(rig.misuses, 0);
    rhw_pass_set_storage_image(context, rig.recording, 0, texture, 2);
    rig_expect_misuse(&rig, "for reading alone");
    rhw_pass_cancel(context, rig.recording);
    // Texels that views share are not written while draws wait to read them.
    static const unsigned char bytes[4 * SIDE * SIDE * 4];
    rig.pass.colors[0] = (struct rhw_color_attachment){
        .texture =
            make(&rig, (struct rhw_texture_def){.format = RHW_FORMAT_R32_FLOAT, .width = 8, .height = 8})};
    rig_begin(&rig);
    rhw_pass_set_read_only_storage_image(context, rig.recording, 1, level1, 0);
    rhw_texture_write(context, texture, 0, bytes, 0);
    rig_expect_misuse(&rig, "and the pass being recorded samples them; end that first");
    rhw_pass_cancel(context, rig.recording);
    rig_close(&rig);
}

// Texels that a texture got in the pass are sampled as those before.
static void test_renewed(void **state)
{
    (void)state;
    struct rig rig;
    float texels[16] = {0};
    rig_open(&rig, 4, 4);
    rig_set_program(&rig, rig_vertex_pass, add_one);
    rig.pipeline.program.uses = RHW_USE_COORD;
    const rhw_texture texture =
        make(&rig, (struct rhw_texture_def){.format = RHW_FORMAT_R32_FLOAT, .width = 4, .height = 4});
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, make_sampler(&rig));
    draw_cover(&rig);
    assert_int_equal(rhw_texture_write(rig.context, texture, 0, texels, 0), RHW_OK);
    draw_cover(&rig);
    rhw_pass_set_storage_image(rig.context, rig.recording, 0, texture, 0);
    rig_expect_misuse(&rig, "is sampled in this pass");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

// Read-only depth and stencil ---------------------------------------------------------------------------

// What sample 0 of slot 0 holds at the pixel of another tile, in red; in green that of slot 1, of stencil.
static void show_depth(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float(f->coord[0]) ^ RHW_TILE, rhw_int_from_float(f->coord[1])};
        const rhw_int sample = rhw_splat_int(0);
        const bool sampled = *(const int *)f->uniforms > 1;
        rhw_float texel[2][4];
        for (int slot = 0; slot < 2; slot++) {
            if (sampled) {
                rhw_sample_fetch_sample(f->textures, slot, at, &sample, texel[slot]);
            } else {
                rhw_sample_fetch(f->textures, slot, at, NULL, texel[slot]);
            }
        }
        f->color[0][0] = texel[0][0];
        f->color[0][1] = rhw_float_from_int(rhw_bits_from_float(texel[1][0]));
        f->color[0][2] = rhw_splat(0);
        f->color[0][3] = rhw_splat(1);
    }
}

// Columns of depth 1/4 and 3/4, and stencil 0 to 7, one column each.
static void fill_columns(struct rig *rig, rhw_texture texture, int samples, bool has_stencil)
{
    struct rig_vertex vertices[6];
    static const float zero[4];
    struct rhw_pass_def pass = {.depth = {.enabled = true, .texture = texture, .load = RHW_LOAD_CLEAR},
                                .samples = samples};
    struct rhw_pipeline_def pipeline = rig->pipeline;
    const struct rhw_stencil_face replace = {.pass = RHW_STENCIL_REPLACE};
    pipeline.depth_test = true;
    pipeline.depth_compare = RHW_COMPARE_ALWAYS;
    pipeline.target_count = 0;
    pipeline.program.fragment[RHW_ISA_BASELINE] = NULL;
    pipeline.program.uniform_size = 0;
    pipeline.program.uses = 0;
    pipeline.stencil_test = has_stencil;
    if (has_stencil) {
        pipeline.stencil_front = pipeline.stencil_back = replace;
    }
    rhw_pipeline made;
    assert_int_equal(rhw_pipeline_create(rig->context, &pipeline, &made), RHW_OK);
    assert_int_equal(rhw_pass_begin(rig->context, &pass, &rig->recording), RHW_OK);
    rhw_pass_set_pipeline(rig->context, rig->recording, made);
    for (int x = 0; x < rig->width; x++) {
        rig_rectangle(rig, (float)x, 0, (float)x + 1, (float)rig->height, x % 2 ? 0.75f : 0.25f, zero,
                      vertices);
        rhw_pass_set_stencil_reference(rig->context, rig->recording, (uint8_t)(x % 8), (uint8_t)(x % 8));
        rig_use_vertices(rig, 0, vertices, sizeof vertices);
        rhw_pass_draw(rig->context, rig->recording, 0, 6, 0, 1);
    }
    assert_int_equal(rhw_pass_end(rig->context, rig->recording, NULL), RHW_OK);
    rhw_pipeline_destroy(rig->context, made);
}

struct read_only_case {
    enum rhw_format format;
    int texture_samples, samples;
    size_t bin_memory; // 1: many waves
};

// A cover at depth 1/2 passes before 3/4, where stencil is 4 or more, and shows what it is tested against.
static void draw_read_only(const struct read_only_case *c)
{
    enum { WIDTH = 2 * RHW_TILE, HEIGHT = 70, TRIANGLES = 150 };
    const struct rhw_context_def def = {.threads = 2, .bin_memory = c->bin_memory};
    static const float zero[4];
    static struct rig_vertex vertices[6 * TRIANGLES];
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &def);
    const bool has_stencil =
        c->format == RHW_FORMAT_D24_UNORM_S8_UINT || c->format == RHW_FORMAT_D32_FLOAT_S8_UINT;
    rig_set_program(&rig, rig_vertex_pass, show_depth);
    rig.pipeline.program.uses = RHW_USE_COORD;
    rig.pipeline.program.uniform_size = sizeof(int);
    const rhw_texture texture =
        make(&rig, (struct rhw_texture_def){
                       .format = c->format, .width = WIDTH, .height = HEIGHT, .samples = c->texture_samples});
    fill_columns(&rig, texture, c->texture_samples, has_stencil);
    const float depths[2] = {c->format == RHW_FORMAT_D16_UNORM           ? 0x4000 / 65535.0f
                             : c->format == RHW_FORMAT_D24_UNORM_S8_UINT ? 0x400000 / 16777215.0f
                                                                         : 0.25f,
                             c->format == RHW_FORMAT_D16_UNORM           ? 0xbfff / 65535.0f
                             : c->format == RHW_FORMAT_D24_UNORM_S8_UINT ? 0xbfffff / 16777215.0f
                                                                         : 0.75f};
    rig.pass.samples = c->samples;
    rig.pass.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = texture, .read_only = true, .stencil_read_only = true};
    rig.pipeline.depth_test = rig.pipeline.depth_read_only = true;
    if (has_stencil) {
        rig.pipeline.stencil_test = true;
        rig.pipeline.stencil_front = rig.pipeline.stencil_back =
            (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_LESS_EQUAL};
    }
    for (int i = 0; i < TRIANGLES; i++) {
        rig_cover(&rig, 0.5f, zero, &vertices[6 * i]);
    }
    rig_begin(&rig);
    const rhw_sampler sampler = make_sampler(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
    if (has_stencil) {
        const rhw_texture stencil =
            make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .format = RHW_FORMAT_R8_UINT});
        rhw_pass_set_texture(rig.context, rig.recording, 1, stencil, sampler);
    }
    rhw_pass_set_uniforms(rig.context, rig.recording, &c->texture_samples, sizeof(int));
    rhw_pass_set_stencil_reference(rig.context, rig.recording, 4, 4);
    rig_draw(&rig, vertices, 6 * TRIANGLES);
    rig_end(&rig);
    assert_true(c->bin_memory == 0 || rig.stats.flushes > 0);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH;
        const bool passes = x % 2 && (!has_stencil || x % 8 >= 4);
        assert_true(pixels[i][0] == (passes ? depths[1] : 0));
        assert_true(pixels[i][1] == (passes && has_stencil ? (float)(x % 8) : 0));
        assert_true(pixels[i][3] == (passes ? 1 : 0));
    }
    // It is there still, for a pass that tests for equality.
    rig.pass.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = texture, .load = RHW_LOAD_LOAD, .stencil_load = RHW_LOAD_LOAD};
    rig_set_program(&rig, rig_vertex_pass, rig_fragment_pass);
    rig.pipeline.program.uses = 0;
    rig.pipeline.depth_compare = RHW_COMPARE_EQUAL;
    if (has_stencil) {
        rig.pipeline.stencil_front.compare = rig.pipeline.stencil_back.compare = RHW_COMPARE_EQUAL;
    }
    rig_begin(&rig);
    for (int x = 0; x < WIDTH; x++) {
        static const float one[4] = {1, 1, 1, 1};
        rig_rectangle(&rig, (float)x, 0, (float)x + 1, HEIGHT, x % 2 ? 0.75f : 0.25f, one, vertices);
        rhw_pass_set_uniforms(rig.context, rig.recording, &c->samples, sizeof(int));
        rhw_pass_set_stencil_reference(rig.context, rig.recording, (uint8_t)(x % 8), (uint8_t)(x % 8));
        rig_draw(&rig, vertices, 6);
    }
    rig_end(&rig);
    const float(*const equal)[4] = rig_read_float4(&rig);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(equal[i][0] == 1);
    }
    rig_close(&rig);
}

static void test_read_only(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_D32_FLOAT, RHW_FORMAT_D16_UNORM,
                                              RHW_FORMAT_D24_UNORM_S8_UINT, RHW_FORMAT_D32_FLOAT_S8_UINT};
    static const int samples[][2] = {{1, 1}, {4, 4}, {1, 4}};
    for (size_t i = 0; i < 4 * 3 * 2; i++) {
        const struct read_only_case c = {formats[i % 4], samples[i / 4 % 3][0], samples[i / 4 % 3][1],
                                         i / 12};
        draw_read_only(&c);
    }
}

static void test_read_only_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_sampler sampler = make_sampler(&rig);
    const rhw_texture texture =
        make(&rig, (struct rhw_texture_def){.format = RHW_FORMAT_D32_FLOAT_S8_UINT, .width = 4, .height = 4});
    const rhw_texture stencil =
        make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .format = RHW_FORMAT_R8_UINT});
    struct rhw_depth_attachment *const depth = &rig.pass.depth;
    *depth =
        (struct rhw_depth_attachment){.enabled = true, .read_only = true, .format = RHW_FORMAT_D32_FLOAT};
    rig_expect_refused_pass(&rig,
                            "depth.read_only is true and depth.texture is null; there is nothing to read");
    *depth = (struct rhw_depth_attachment){.enabled = true, .texture = texture, .read_only = true};
    depth->load = RHW_LOAD_CLEAR;
    rig_expect_refused_pass(&rig,
                            "depth.read_only is true, and depth.load or depth.store clears or discards");
    depth->load = RHW_LOAD_LOAD;
    depth->store = RHW_STORE_DISCARD;
    rig_expect_refused_pass(&rig,
                            "they must be RHW_LOAD_LOAD and RHW_STORE_STORE, which stores nothing then");
    depth->store = RHW_STORE_STORE;
    depth->stencil_read_only = true;
    depth->stencil_load = RHW_LOAD_DISCARD;
    rig_expect_refused_pass(&rig,
                            "depth.stencil_read_only is true, and depth.stencil_load or depth.stencil_store");
    // Depth is read, stencil written; and the other way round.
    depth->stencil_load = RHW_LOAD_DEFAULT;
    for (int i = 0; i < 2; i++) {
        depth->read_only = i == 0;
        depth->stencil_read_only = i == 1;
        rig_begin(&rig);
        rhw_pass_set_texture(rig.context, rig.recording, 0, i == 0 ? texture : stencil, sampler);
        rhw_pass_set_texture(rig.context, rig.recording, 0, i == 0 ? stencil : texture, sampler);
        rig_expect_misuse(&rig, "for slot 0, is an attachment of this pass");
        rhw_pass_clear_attachments(rig.context, rig.recording,
                                   &(struct rhw_clear){.depth = i == 0, .stencil = i == 1});
        rig_expect_misuse(&rig,
                          i == 0 ? "rhw_pass_clear_attachments: depth is true and the pass has it read_only"
                                 : "stencil is true and the pass has it read_only");
        rhw_pass_cancel(rig.context, rig.recording);
    }
    // What writes is refused; what a mask keeps from it is not.
    depth->read_only = depth->stencil_read_only = true;
    rig.pipeline.depth_test = true;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_expect_misuse(&rig, "writes depth, and the pass has it read_only; depth_read_only must be true");
    rig.pipeline.depth_read_only = true;
    rig.pipeline.stencil_test = true;
    rig.pipeline.stencil_back.depth_fail = RHW_STENCIL_INCREMENT_WRAP;
    draw_cover(&rig);
    rig_expect_misuse(&rig, "writes stencil, and the pass has it read_only; its operations must keep it");
    rhw_pass_set_stencil_masks(rig.context, rig.recording,
                               &(struct rhw_stencil_masks){.read_back = 0xff, .write_front = 0xff});
    draw_cover(&rig);
    rhw_pass_set_stencil_masks(rig.context, rig.recording, NULL);
    rig.pipeline.cull = RHW_CULL_BACK;
    draw_cover(&rig);
    rig.pipeline.cull = RHW_CULL_NONE;
    rig.pipeline.stencil_back.write_mask = RHW_STENCIL_NO_BITS;
    draw_cover(&rig);
    rig.pipeline.stencil_front.fail = RHW_STENCIL_ZERO;
    rig.pipeline.stencil_front.write_mask = 1;
    draw_cover(&rig);
    rig_expect_misuse(&rig, "writes stencil, and the pass has it read_only");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_read_only),
                                          cmocka_unit_test(test_read_only_misuse),
                                          cmocka_unit_test(test_levels),
                                          cmocka_unit_test(test_layers),
                                          cmocka_unit_test(test_images),
                                          cmocka_unit_test(test_read_only_images),
                                          cmocka_unit_test(test_read_only_images_exclude),
                                          cmocka_unit_test(test_renewed)};

const struct unit_tests test_feedback_loop = UNIT_TESTS(tests, NULL, NULL);
