// SPDX-License-Identifier: MIT
// What a pass draws into, writes and samples is told apart by level and layer: others of the same texture are free, in the
// same pass, and the same ones are not, by any name.
#include "harness.h"

#include <string.h>

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
    const rhw_texture texture = make(
        &rig, (struct rhw_texture_def){
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
            make_view(&rig, (struct rhw_texture_view_def){.texture = texture, .level = level - 1, .levels = 1}),
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
    const rhw_texture two = make_view(
        &rig, (struct rhw_texture_view_def){.texture = texture, .level = LEVELS - 2, .levels = 2});
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, two, sampler);
    rig_expect_misuse(&rig, "is an attachment of this pass, or has a level and layer of one; sample a view of others");
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
    rig_expect_misuse(&rig, "level 2 of texture 2 is sampled in this pass, or has a layer that is");
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_levels), cmocka_unit_test(test_layers),
                                       cmocka_unit_test(test_images), cmocka_unit_test(test_renewed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
