// SPDX-License-Identifier: MIT
// Bindings in memory of the program in draws and dispatches: any number of them, what is written between passes is seen,
// and misuse is told.
#include "bound_things.h"

// In draws and dispatches ---------------------------------------------------------------------------------

enum { TEXTURES = 1000, SIDE = 40 };

struct table {
    const struct rhw_binding *bindings;
    const struct rhw_binding *counts; // words that count what was sampled
    int32_t count;
};

static void sample_table(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct table *const table = groups[g].uniforms;
        const rhw_float uv[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
        const rhw_int index =
            rhw_int_from_float(groups[g].coord[1]) * (int32_t)SIDE + rhw_int_from_float(groups[g].coord[0]);
        rhw_float result[4] = {rhw_splat(0), rhw_splat(0), rhw_splat(0), rhw_splat(0)};
        for (rhw_int todo = groups[g].mask, lanes; rhw_any(todo);) {
            rhw_float texel[4];
            const int32_t i = rhw_binding_next(index, &todo, &lanes);
            rhw_binding_sample_lod((uint32_t)i < (uint32_t)table->count ? &table->bindings[i] : NULL, uv,
                                   rhw_splat(0), texel);
            for (int c = 0; c < 4; c++) {
                result[c] = rhw_select(lanes, texel[c], result[c]);
            }
        }
        (void)rhw_binding_storage_atomic(table->counts, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1),
                                         groups[g].mask);
        memcpy(groups[g].color[0], result, sizeof result);
    }
}

static void sample_table1(struct rhw_fragment1 *f)
{
    const struct table *const table = f->uniforms;
    const float uv[2] = {0.5f, 0.5f};
    const int32_t i = (int32_t)f->coord[1] * SIDE + (int32_t)f->coord[0];
    rhw_binding_sample_lod1((uint32_t)i < (uint32_t)table->count ? &table->bindings[i] : NULL, uv, 0,
                            f->color[0]);
    (void)rhw_binding_storage_atomic1(table->counts, RHW_STORAGE_ADD, 0, 1);
}

static bool sum_table(struct rhw_invocation1 *i)
{
    const struct table *const table = i->uniforms;
    const int32_t at[2] = {0, 0};
    float texel[4];
    rhw_binding_sample_fetch1(&table->bindings[i->id[0]], at, 0, texel);
    (void)rhw_binding_storage_atomic1(table->counts, RHW_STORAGE_ADD, 0, (int32_t)texel[0]);
    return false;
}

static void thousands_in_draws_and_dispatches(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    static struct rhw_binding bindings[TEXTURES];
    static rhw_texture textures[TEXTURES];
    const struct rhw_texture_def def = {.format = RHW_FORMAT_R32_FLOAT, .width = 1, .height = 1};
    const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_NEAREST,
                                                .mag_filter = RHW_FILTER_NEAREST};
    const rhw_sampler sampler = make_sampler(&rig, &sampler_def);
    int32_t sum = 0;
    for (int i = 0; i < TEXTURES; i++) {
        const float value = (float)(3 * i + 1);
        textures[i] = make_texture(&rig, &def);
        rhw_texture_write(rig.context, textures[i], 0, &value, 0);
        assert_int_equal(rhw_binding_of_texture(rig.context, textures[i], sampler, &bindings[i]), RHW_OK);
        sum += 3 * i + 1;
    }
    for (int form = 0; form < 2; form++) {
        uint32_t words[2] = {0, 0};
        struct rhw_binding counts;
        assert_true(rhw_binding_of_memory(words, 4, false, &counts));
        const struct table table = {bindings, &counts, TEXTURES};
        struct rig_vertex vertices[6];
        rig_set_program(&rig, rig_vertex_pass, form == 0 ? sample_table : NULL);
        rig.pipeline.program.fragment1 = form == 0 ? NULL : sample_table1;
        rig.pipeline.program.uses = RHW_USE_COORD | RHW_USE_EFFECTS;
        rig.pipeline.program.uniform_size = sizeof table;
        rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, vertices, sizeof vertices);
        rhw_pass_set_uniforms(rig.context, rig.recording, &table, sizeof table);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
        rig_end(&rig);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIDE * SIDE; i++) {
            assert_true(pixels[i][0] == (i < TEXTURES ? (float)(3 * i + 1) : 0.0f));
        }
        assert_int_equal(words[0], SIDE * SIDE);
        const struct rhw_dispatch_def sums = {
            .program = {.invocation1 = sum_table, .uniform_size = sizeof table, .size = {8}},
            .uniforms = &table,
            .uniform_bytes = sizeof table};
        words[0] = 0;
        assert_int_equal(rhw_dispatch(rig.context, &sums, TEXTURES / 8, 1, 1), RHW_OK);
        assert_int_equal(words[0], sum);
        assert_int_equal(words[1], 0);
    }
    for (int i = 0; i < TEXTURES; i++) {
        rhw_texture_destroy(rig.context, textures[i]);
    }
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

static void sample_both_groups(struct rhw_fragment *groups, int count)
{
    const struct table *const table = groups->uniforms;
    rhw_float by_slot[RHW_MAX_GROUPS][4][4], by_binding[RHW_MAX_GROUPS][4][4];
    rhw_sample_groups(groups, count, 0xf, 0, by_slot[0], 4);
    rhw_binding_sample_groups(table->bindings, groups, count, 0xf, 0, by_binding[0], 4);
    for (int g = 0; g < count; g++) {
        rhw_int differs = rhw_splat_int(0);
        for (int i = 0; i < 16; i++) {
            differs |= (rhw_int)by_slot[g][i / 4][i % 4] != (rhw_int)by_binding[g][i / 4][i % 4];
        }
        groups[g].color[0][0] = rhw_select(differs, rhw_splat(1), rhw_splat(2));
        groups[g].color[0][1] = by_binding[g][0][0];
        groups[g].color[0][2] = by_binding[g][1][0];
        groups[g].color[0][3] = by_binding[g][2][3];
    }
}

static void groups_as_slots(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    const rhw_sampler sampler = make_sampler(&rig, &sampler_def);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = 32, .height = 32, .mip_levels = 4};
    struct rhw_binding bindings[4] = {{{0}}}; // the third is empty
    rhw_texture textures[4] = {{0}};
    for (int i = 0; i < 4; i++) {
        textures[i] = make_texture(&rig, &def);
        write_noise(&rig, textures[i], (uint64_t)i);
        if (i != 2) {
            assert_int_equal(rhw_binding_of_texture(rig.context, textures[i], sampler, &bindings[i]), RHW_OK);
        }
    }
    const struct table table = {bindings, NULL, 4};
    struct rig_vertex vertices[6];
    rig_set_program(&rig, rig_vertex_pass, sample_both_groups);
    rig.pipeline.program.varyings[0].derivatives = true;
    rig.pipeline.program.uniform_size = sizeof table;
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    for (int i = 0; i < 6; i++) {
        vertices[i].value[0] = vertices[i].position[0];
        vertices[i].value[1] = vertices[i].position[1] * 2;
    }
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    for (int i = 0; i < 4; i++) {
        rhw_pass_set_texture(rig.context, rig.recording, i, i == 2 ? (rhw_texture){0} : textures[i], sampler);
    }
    rhw_pass_set_uniforms(rig.context, rig.recording, &table, sizeof table);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIDE * SIDE; i++) {
        assert_true(pixels[i][0] == 2 && pixels[i][3] == 1);
    }
    for (int i = 0; i < 4; i++) {
        rhw_texture_destroy(rig.context, textures[i]);
    }
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

// Written between passes ------------------------------------------------------------------------------------

static void sample_center(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct table *const table = groups[g].uniforms;
        const rhw_float uv[2] = {rhw_splat(0.5f), rhw_splat(0.5f)};
        rhw_float bound[4], slot[4];
        rhw_binding_sample_lod(table->bindings, uv, rhw_splat(0), bound);
        rhw_sample_lod(groups[g].bindings, 0, uv, rhw_splat(0), slot);
        for (int c = 0; c < 2; c++) {
            groups[g].color[0][c] = bound[c];
            groups[g].color[0][2 + c] = slot[c];
        }
    }
}

// Draw what the binding gives, and expect this value. With a texture beside it the slot has to give the same.
static void expect_sampled(struct rig *rig, const struct rhw_binding *binding, rhw_texture texture,
                           rhw_sampler sampler, float red)
{
    const struct table table = {binding, NULL, 1};
    struct rig_vertex vertices[6];
    rig_set_program(rig, rig_vertex_pass, sample_center);
    rig->pipeline.program.uniform_size = sizeof table;
    rig_cover(rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, sizeof vertices);
    if (texture.index != 0) {
        rhw_pass_set_texture(rig->context, rig->recording, 0, texture, sampler);
    }
    rhw_pass_set_uniforms(rig->context, rig->recording, &table, sizeof table);
    rhw_pass_draw(rig->context, rig->recording, 0, 6, 0, 1);
    rig_end(rig);
    const float(*pixels)[4] = rig_read_float4(rig);
    assert_true(pixels[0][0] > red - 0.001f && pixels[0][0] < red + 0.001f);
    assert_true(texture.index == 0 || pixels[0][0] == pixels[0][2]);
}

static void fill(unsigned char *texels, size_t count, unsigned char code)
{
    for (size_t i = 0; i < count; i++) {
        memset(texels + 4 * i, code, 3);
        texels[4 * i + 3] = 255;
    }
}

static void clear_to(struct rig *rig, rhw_texture texture, float value)
{
    struct rhw_pass_def pass = {.color_count = 1};
    pass.colors[0].texture = texture;
    pass.colors[0].load = RHW_LOAD_CLEAR;
    pass.colors[0].clear[0] = value;
    rhw_pass id;
    assert_int_equal(rhw_pass_begin(rig->context, &pass, &id), RHW_OK);
    assert_int_equal(rhw_pass_end(rig->context, id, NULL), RHW_OK);
}

// Codes of sRGB and the linear values that they stand for.
static const unsigned char codes[4] = {0, 255, 188, 55};
static const float linears[4] = {0, 1, 0.5029f, 0.0382f};

static void srgb_is_prepared_for_each_pass(void **state)
{
    (void)state;
    enum { SIZE = 16, PITCH = 64 };
    struct rig rig;
    rig_open(&rig, 8, 8);
    _Alignas(64) static unsigned char memory[SIZE * PITCH + RHW_MEMORY_PADDING], told[sizeof memory];
    unsigned char texels[SIZE * SIZE * 4];
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    const rhw_sampler sampler = make_sampler(&rig, &sampler_def);
    struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_SRGB, .width = SIZE, .height = SIZE};
    const rhw_texture own = make_texture(&rig, &def);
    const struct rhw_texture_view_def view_def = {.texture = own, .kind = RHW_TEXTURE_2D};
    rhw_texture view;
    def.memory = memory;
    def.memory_size = sizeof memory;
    const rhw_texture unsaid = make_texture(&rig, &def);
    def.memory = told;
    def.memory_is_told = true;
    const rhw_texture said = make_texture(&rig, &def);
    struct rhw_binding of_own, of_view, of_unsaid, of_said;
    assert_int_equal(rhw_binding_of_texture(rig.context, own, sampler, &of_own), RHW_OK);
    assert_int_equal(rhw_texture_view_create(rig.context, &view_def, &view), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(rig.context, view, sampler, &of_view), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(rig.context, unsaid, sampler, &of_unsaid), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(rig.context, said, sampler, &of_said), RHW_OK);
    for (int i = 0; i < 4; i++) {
        fill(texels, SIZE * SIZE, codes[i]);
        rhw_texture_write(rig.context, i & 1 ? view : own, 0, texels, 0);
        fill(memory, SIZE * SIZE, codes[i]);
        fill(told, SIZE * SIZE, codes[i]);
        assert_int_equal(rhw_texture_changed(rig.context, said, 0, 0, 0), RHW_OK);
        expect_sampled(&rig, &of_own, i > 1 ? own : (rhw_texture){0}, sampler, linears[i]);
        expect_sampled(&rig, &of_view, (rhw_texture){0}, sampler, linears[i]);
        expect_sampled(&rig, &of_unsaid, i > 1 ? unsaid : (rhw_texture){0}, sampler, linears[i]);
        expect_sampled(&rig, &of_said, (rhw_texture){0}, sampler, linears[i]);
    }
    for (int i = 0; i < 4; i++) { // passes that draw into it
        clear_to(&rig, i & 1 ? view : own, linears[i]);
        expect_sampled(&rig, &of_own, (rhw_texture){0}, sampler, linears[i]);
        expect_sampled(&rig, &of_view, (rhw_texture){0}, sampler, linears[i]);
    }
    // What is told of one texture is nobody else's, also where the first of both is gone.
    clear_to(&rig, own, 0);
    rhw_texture_destroy(rig.context, own);
    expect_sampled(&rig, &of_view, (rhw_texture){0}, sampler, 0);
    clear_to(&rig, view, 1);
    rhw_texture_destroy(rig.context, view);
    rhw_texture_destroy(rig.context, unsaid);
    expect_sampled(&rig, &of_said, said, sampler, linears[3]);
    rhw_texture_destroy(rig.context, said);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

static bool store_one(struct rhw_invocation1 *i)
{
    const float texel[4] = {0.75f, 0, 0, 1};
    rhw_binding_image_store1(i->uniforms, i->id, texel);
    return false;
}

// A clear leaves tiles alone that hold its value. Tiles that an image binding may have written do not.
static void what_images_write_is_cleared(void **state)
{
    (void)state;
    enum { SIZE = 64 };
    struct rig rig;
    rig_open(&rig, 8, 8);
    const struct rhw_texture_def def = {.format = RHW_FORMAT_R32_FLOAT, .width = SIZE, .height = SIZE};
    const rhw_texture texture = make_texture(&rig, &def);
    struct rhw_binding image, read;
    static float texels[SIZE * SIZE];
    clear_to(&rig, texture, 0.25f);
    assert_int_equal(rhw_binding_of_image(rig.context, texture, 0, true, &read), RHW_OK);
    assert_int_equal(rhw_binding_of_image(rig.context, texture, 0, false, &image), RHW_OK);
    for (int i = 0; i < 4; i++) {
        const bool writes = i != 1; // the second dispatch has a binding for reading
        const struct rhw_dispatch_def dispatch = {
            .program = {.invocation1 = store_one, .size = {8, 8}, .uniform_size = sizeof image},
            .uniforms = writes ? &image : &read,
            .uniform_bytes = sizeof image};
        assert_int_equal(rhw_dispatch(rig.context, &dispatch, SIZE / 8, SIZE / 8, 1), RHW_OK);
        rhw_texture_read(rig.context, texture, 0, texels, 0);
        assert_true(texels[5 * SIZE + 5] == (writes ? 0.75f : 0.25f));
        clear_to(&rig, texture, 0.25f);
        rhw_texture_read(rig.context, texture, 0, texels, 0);
        assert_true(texels[5 * SIZE + 5] == 0.25f);
    }
    rhw_texture_destroy(rig.context, texture);
    rig_close(&rig);
}

// Misuse ------------------------------------------------------------------------------------------------------

static void bound_things_stay_where_they_are(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const float one = 1;
    const struct rhw_texture_def def = {.format = RHW_FORMAT_R32_FLOAT, .width = 1, .height = 1};
    const struct rhw_sampler_def sampler_def = {.min_filter = RHW_FILTER_NEAREST,
                                                .mag_filter = RHW_FILTER_NEAREST};
    const rhw_sampler sampler = make_sampler(&rig, &sampler_def);
    const rhw_texture texture = make_texture(&rig, &def);
    struct rig_vertex vertices[6];
    rhw_buffer buffer;
    const struct rhw_buffer_def buffer_def = {.size = sizeof vertices, .data = vertices};
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    assert_int_equal(rhw_buffer_create(rig.context, &buffer_def, &buffer), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    struct rhw_binding of_texture, of_buffer;
    assert_int_equal(rhw_binding_of_texture(rig.context, texture, sampler, &of_texture), RHW_OK);
    assert_int_equal(rhw_binding_of_buffer(rig.context, buffer, 0, 0, false, &of_buffer), RHW_OK);
    rhw_texture_write(rig.context, texture, 0, &one, 0);
    rig_expect_misuse(&rig, "the pass being recorded samples them");
    rhw_buffer_write(rig.context, buffer, 4, &one, 4);
    rig_expect_misuse(&rig, "has a binding and the pass being recorded reads some of bytes 4 to 8");
    rhw_pass_cancel(rig.context, rig.recording);
    rhw_texture_write(rig.context, texture, 0, &one, 0);
    rhw_buffer_write(rig.context, buffer, 4, &one, 4);
    const int32_t at[2] = {0, 0};
    float texel[4];
    rhw_binding_sample_fetch1(&of_texture, at, 0, texel);
    assert_true(texel[0] == 1);
    assert_int_equal(rhw_binding_storage_load1(&of_buffer, 1), 0x3f800000);
    assert_int_equal(rhw_binding_storage_count(&of_buffer), sizeof vertices / 4);
    rhw_texture_destroy(rig.context, texture);
    rhw_buffer_destroy(rig.context, buffer);
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

static void misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_context *const context = rig.context;
    const struct rhw_texture_def defs[] = {
        {.format = RHW_FORMAT_R32_UINT, .width = 4, .height = 4, .label = "numbers"},
        {.format = RHW_FORMAT_RGBA8_UNORM, .kind = RHW_TEXTURE_CUBE, .width = 4, .height = 4},
        {.format = RHW_FORMAT_BC1_RGB_UNORM, .width = 4, .height = 4}};
    const struct rhw_sampler_def linear_def = {.lod_bias = 0},
                                 texels_def = {.mip_filter = RHW_MIP_FILTER_NONE,
                                               .address_u = RHW_ADDRESS_CLAMP,
                                               .address_v = RHW_ADDRESS_CLAMP,
                                               .unnormalized = true};
    const rhw_texture numbers = make_texture(&rig, &defs[0]), cube = make_texture(&rig, &defs[1]),
                      blocks = make_texture(&rig, &defs[2]);
    const rhw_sampler linear = make_sampler(&rig, &linear_def), texels = make_sampler(&rig, &texels_def);
    const struct rhw_buffer_def buffer_def = {.size = 64};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(context, &buffer_def, &buffer), RHW_OK);
    struct rhw_binding b = {{1, 2, 3}}, by_linear, by_texels, alone;
    static const struct rhw_binding empty;
    assert_int_equal(rhw_binding_of_texture(context, numbers, linear, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig,
                      "rhw_binding_of_texture: texture 2 \"numbers\" is RHW_FORMAT_R32_UINT, which is not");
    assert_memory_equal(&b, &empty, sizeof b);
    assert_int_equal(rhw_binding_of_texture(context, cube, texels, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "is unnormalized and");
    assert_int_equal(rhw_binding_of_texture(context, (rhw_texture){0}, linear, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_binding_of_texture: ");
    assert_int_equal(rhw_binding_of_texture(context, cube, linear, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_binding_of_texture: binding is NULL");
    assert_int_equal(rhw_binding_of_sampler(context, (rhw_sampler){0}, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_binding_of_sampler: ");
    assert_int_equal(rhw_binding_of_image(context, numbers, 1, false, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_binding_of_image: level is 1; texture 2 \"numbers\" has levels 0..0");
    assert_int_equal(rhw_binding_of_image(context, blocks, 0, true, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "is RHW_FORMAT_BC1_RGB_UNORM; it must be");
    assert_int_equal(rhw_binding_of_buffer(context, buffer, 2, 4, false, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_binding_of_buffer: offset is 2; it must be a multiple of 4");
    assert_int_equal(rhw_binding_of_buffer(context, buffer, 60, 8, false, &b), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "offset is 60 and size is 8");
    assert_int_equal(rhw_binding_of_texels(context, buffer, RHW_FORMAT_D16_UNORM, 0, 0, true, &b),
                     RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "format is RHW_FORMAT_D16_UNORM; it must be of colour");
    assert_int_equal(rhw_binding_of_texels(context, buffer, RHW_FORMAT_RGBA16_FLOAT, 8, 0, true, &b), RHW_OK);
    rhw_int size[3];
    rhw_binding_image_size(&b, size);
    assert_int_equal(size[0][0], 7);
    assert_int_equal(rhw_binding_of_sampler(context, linear, &by_linear), RHW_OK);
    assert_int_equal(rhw_binding_of_sampler(context, texels, &by_texels), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(context, cube, (rhw_sampler){0}, &alone), RHW_OK);
    assert_false(rhw_binding_of_pair(&alone, &by_texels, &b));
    assert_memory_equal(&b, &empty, sizeof b);
    assert_int_equal(rhw_binding_of_texture(context, numbers, (rhw_sampler){0}, &b), RHW_OK);
    assert_false(rhw_binding_of_pair(&b, &by_linear, &b));
    assert_true(rhw_binding_of_pair(&alone, &by_linear, &alone)); // into one of both
    rhw_texture_destroy(context, numbers);
    rhw_texture_destroy(context, cube);
    rhw_texture_destroy(context, blocks);
    rhw_sampler_destroy(context, linear);
    rhw_sampler_destroy(context, texels);
    rhw_buffer_destroy(context, buffer);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(thousands_in_draws_and_dispatches), cmocka_unit_test(groups_as_slots),
    cmocka_unit_test(srgb_is_prepared_for_each_pass),    cmocka_unit_test(what_images_write_is_cleared),
    cmocka_unit_test(bound_things_stay_where_they_are),  cmocka_unit_test(misuse)};

const struct unit_tests test_bound_passes = UNIT_TESTS(tests, NULL, NULL);
