// SPDX-License-Identifier: MIT
// Stencil: every comparison and operation against a model in whole numbers, on both facings, before and after the
// fragment function; masks, references, clearing, keeping, and what is refused.
#include "harness.h"

#include <string.h>

enum { SIZE = 72, LAYERS = 12 }; // two tiles each way

struct layer {
    int x0, y0, x1, y1;
    float depth, color[4];
    bool back, depth_test, depth_read_only, late;
    enum rhw_compare depth_compare;
    struct rhw_stencil_face face[2];
    uint8_t reference[2];
    bool has_masks; // set in the pass
    struct rhw_stencil_masks masks;
};

struct model {
    float color[SIZE * SIZE], depth[SIZE * SIZE];
    uint8_t stencil[SIZE * SIZE];
};

// Keeps even columns.
static void discarding_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].mask &= rhw_equal_int(rhw_int_from_float(groups[g].coord[0]) & 1, rhw_splat_int(0));
    }
}

static bool holds(enum rhw_compare compare, double a, double b)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return false;
    case RHW_COMPARE_LESS: return a < b;
    case RHW_COMPARE_EQUAL: return a == b;
    case RHW_COMPARE_LESS_EQUAL: return a <= b;
    case RHW_COMPARE_GREATER: return a > b;
    case RHW_COMPARE_NOT_EQUAL: return a != b;
    case RHW_COMPARE_GREATER_EQUAL: return a >= b;
    case RHW_COMPARE_ALWAYS: return true;
    }
    return false;
}

static int operate(enum rhw_stencil_operation operation, int value, int reference)
{
    switch (operation) {
    case RHW_STENCIL_KEEP: return value;
    case RHW_STENCIL_ZERO: return 0;
    case RHW_STENCIL_REPLACE: return reference;
    case RHW_STENCIL_INCREMENT_CLAMP: return value == 255 ? 255 : value + 1;
    case RHW_STENCIL_DECREMENT_CLAMP: return value == 0 ? 0 : value - 1;
    case RHW_STENCIL_INVERT: return 255 - value;
    case RHW_STENCIL_INCREMENT_WRAP: return value == 255 ? 0 : value + 1;
    case RHW_STENCIL_DECREMENT_WRAP: return value == 0 ? 255 : value - 1;
    }
    return value;
}

static int mask_bits(uint16_t mask)
{
    return mask == 0 ? 255 : mask == RHW_STENCIL_NO_BITS ? 0 : mask;
}

static void model_fragment(struct model *model, const struct layer *layer, int at)
{
    const struct rhw_stencil_face *const face = &layer->face[layer->back];
    const int reference = layer->reference[layer->back], stencil = model->stencil[at];
    const struct rhw_stencil_masks *const set = &layer->masks;
    const int read = !layer->has_masks ? mask_bits(face->read_mask)
                     : layer->back     ? set->read_back
                                       : set->read_front;
    const int write = !layer->has_masks ? mask_bits(face->write_mask)
                      : layer->back     ? set->write_back
                                        : set->write_front;
    const bool passes_stencil = !face->compares || holds(face->compare, reference & read, stencil & read);
    const bool passes_depth =
        !layer->depth_test || holds(layer->depth_compare, (double)layer->depth, (double)model->depth[at]);
    const enum rhw_stencil_operation operation = !passes_stencil ? face->fail
                                                 : !passes_depth ? face->depth_fail
                                                                 : face->pass;
    const int result = operate(operation, stencil, reference);
    model->stencil[at] = (uint8_t)((stencil & ~write) | (result & write));
    if (passes_stencil && passes_depth) {
        model->color[at] = layer->color[0];
        if (layer->depth_test && !layer->depth_read_only) {
            model->depth[at] = layer->depth;
        }
    }
}

static void model_layer(struct model *model, const struct layer *layer)
{
    for (int y = layer->y0; y < layer->y1; y++) {
        for (int x = layer->x0; x < layer->x1; x++) {
            if (!layer->late || x % 2 == 0) {
                model_fragment(model, layer, y * SIZE + x);
            }
        }
    }
}

static struct rhw_stencil_face random_face(uint64_t *random)
{
    struct rhw_stencil_face face = {.compares = rig_random_int(random, 4) != 0};
    face.compare = face.compares ? (enum rhw_compare)rig_random_int(random, 8) : 0;
    face.fail = (enum rhw_stencil_operation)rig_random_int(random, 8);
    face.depth_fail = (enum rhw_stencil_operation)rig_random_int(random, 8);
    face.pass = (enum rhw_stencil_operation)rig_random_int(random, 8);
    const uint16_t masks[] = {0, RHW_STENCIL_NO_BITS, 0x0f, 0xfe, 0x81};
    face.read_mask = masks[rig_random_int(random, 5)];
    face.write_mask = masks[rig_random_int(random, 5)];
    return face;
}

static struct layer random_layer(uint64_t *random)
{
    struct layer layer = {.color = {(float)rig_random_int(random, 1000), 0, 0, 1}};
    layer.x0 = rig_random_int(random, SIZE);
    layer.y0 = rig_random_int(random, SIZE);
    layer.x1 = layer.x0 + 1 + rig_random_int(random, SIZE - layer.x0);
    layer.y1 = layer.y0 + 1 + rig_random_int(random, SIZE - layer.y0);
    layer.depth = (float)rig_random_int(random, 5) / 4;
    layer.back = rig_random_int(random, 2);
    layer.depth_test = rig_random_int(random, 3) != 0;
    layer.depth_read_only = rig_random_int(random, 3) == 0;
    layer.late = rig_random_int(random, 2);
    layer.depth_compare = (enum rhw_compare)rig_random_int(random, 8);
    layer.face[0] = random_face(random);
    layer.face[1] = random_face(random);
    layer.reference[0] = (uint8_t)rig_random_int(random, 256);
    layer.reference[1] = (uint8_t)rig_random_int(random, 256);
    layer.has_masks = rig_random_int(random, 3) == 0;
    layer.masks = (struct rhw_stencil_masks){
        .read_front = (uint8_t)rig_random_int(random, 256),
        .read_back = rig_random_int(random, 2) ? 0 : 0xf0,
        .write_front = rig_random_int(random, 2) ? 0 : (uint8_t)rig_random_int(random, 256),
        .write_back = (uint8_t)rig_random_int(random, 256)};
    return layer;
}

static void draw_layer(struct rig *rig, const struct layer *layer)
{
    struct rig_vertex vertices[6];
    rig_rectangle(rig, (float)layer->x0, (float)layer->y0, (float)layer->x1, (float)layer->y1, layer->depth,
                  layer->color, vertices);
    for (int i = 0; i < 6 && layer->back; i += 3) {
        const struct rig_vertex swap = vertices[i];
        vertices[i] = vertices[i + 1];
        vertices[i + 1] = swap;
    }
    rig->pipeline.depth_test = layer->depth_test;
    rig->pipeline.depth_read_only = layer->depth_read_only;
    rig->pipeline.depth_compare = layer->depth_compare;
    rig->pipeline.stencil_test = true;
    rig->pipeline.stencil_front = layer->face[0];
    rig->pipeline.stencil_back = layer->face[1];
    rig->pipeline.program.uses = layer->late ? RHW_USE_DISCARD | RHW_USE_COORD : 0;
    rig_set_program(rig, rig_vertex_pass, layer->late ? discarding_fragment : rig_fragment_pass);
    rhw_pass_set_stencil_reference(rig->context, rig->recording, layer->reference[0], layer->reference[1]);
    rhw_pass_set_stencil_masks(rig->context, rig->recording, layer->has_masks ? &layer->masks : NULL);
    rig_draw(rig, vertices, 6);
}

// Gives the depth attachment a texture of that format.
static void set_format(struct rig *rig, enum rhw_format format)
{
    rig_set_depth(rig);
    rhw_texture_destroy(rig->context, rig->pass.depth.texture);
    const struct rhw_texture_def def = {.format = format, .width = SIZE, .height = SIZE};
    assert_int_equal(rhw_texture_create(rig->context, &def, &rig->pass.depth.texture), RHW_OK);
}

static const uint8_t *read_stencil(struct rig *rig)
{
    static uint8_t stencil[SIZE * SIZE];
    assert_int_equal(rhw_texture_read_stencil(rig->context, rig->pass.depth.texture, 0, stencil, 0), RHW_OK);
    return stencil;
}

static void expect_model(struct rig *rig, const struct model *model)
{
    const float(*const pixels)[4] = rig_read_float4(rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(pixels[i][0] == model->color[i]);
    }
    assert_memory_equal(read_stencil(rig), model->stencil, sizeof model->stencil);
    assert_memory_equal(rig_read_depth(rig), model->depth, sizeof model->depth);
}

static void compare_with_model(enum rhw_paths paths, uint64_t seed)
{
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    set_format(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT);
    static struct model model;
    uint64_t random = seed;
    for (int scene = 0; scene < 60; scene++) {
        rig.pass.depth.stencil_clear = (uint8_t)rig_random_int(&random, 256);
        rig.pass.depth.clear = 0.5f;
        memset(&model, 0, sizeof model);
        memset(model.stencil, rig.pass.depth.stencil_clear, sizeof model.stencil);
        for (int i = 0; i < SIZE * SIZE; i++) {
            model.depth[i] = 0.5f;
        }
        rig_begin(&rig);
        for (int i = 0; i < LAYERS; i++) {
            const struct layer layer = random_layer(&random);
            draw_layer(&rig, &layer);
            model_layer(&model, &layer);
        }
        rig_end(&rig);
        expect_model(&rig, &model);
    }
    rig_close(&rig);
}

static void test_every_rule_against_a_model(void **state)
{
    (void)state;
    compare_with_model(RHW_PATHS_ALL, 1);
    compare_with_model(RHW_PATHS_GENERAL, 2);
}

// One-sided REPLACE, then what is drawn where it is EQUAL, with a stencil that stays from one pass to the next and has
// no depth beside it.
static void test_a_mask_from_another_pass(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    set_format(&rig, RHW_FORMAT_S8_UINT);
    struct layer layer = {10, 3, 50, 70, 0.5f, {1, 0, 0, 1}, .reference = {7, 9}};
    layer.face[0].pass = layer.face[1].pass = RHW_STENCIL_REPLACE;
    rig_begin(&rig);
    draw_layer(&rig, &layer);
    rig_end(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const bool inside = i % SIZE >= 10 && i % SIZE < 50 && i / SIZE >= 3 && i / SIZE < 70;
        assert_int_equal(read_stencil(&rig)[i], inside ? 7 : 0);
    }
    layer = (struct layer){0, 0, SIZE, SIZE, 0.5f, {2, 0, 0, 1}, .reference = {7, 7}};
    layer.face[0] = (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_EQUAL};
    layer.face[1] = layer.face[0];
    rig.pass.depth.stencil_load = RHW_LOAD_LOAD;
    rig_begin(&rig);
    draw_layer(&rig, &layer);
    rig_end(&rig);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(pixels[i][0] == (read_stencil(&rig)[i] == 7 ? 2.0f : 0.0f));
    }
    rig_close(&rig);
}

// Without a texture, in waves: what the first leaves the next finds.
static void test_stencil_without_memory_in_waves(void **state)
{
    (void)state;
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .bin_memory = 1});
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true,
                                                   .format = RHW_FORMAT_D24_UNORM_S8_UINT,
                                                   .store = RHW_STORE_DISCARD,
                                                   .stencil_store = RHW_STORE_DISCARD};
    struct layer layer = {10, 3, 50, 70, 0.5f, {1, 0, 0, 1}, .reference = {5, 5}};
    layer.face[0].pass = layer.face[1].pass = RHW_STENCIL_INCREMENT_WRAP;
    rig_begin(&rig);
    for (int i = 0; i < 5; i++) {
        draw_layer(&rig, &layer);
    }
    layer = (struct layer){0, 0, SIZE, SIZE, 0.5f, {2, 0, 0, 1}, .reference = {5, 5}};
    layer.face[0] = (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_EQUAL};
    layer.face[1] = layer.face[0];
    draw_layer(&rig, &layer);
    rig_end(&rig);
    assert_true(rig.stats.flushes > 0);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const bool inside = i % SIZE >= 10 && i % SIZE < 50 && i / SIZE >= 3 && i / SIZE < 70;
        assert_true(pixels[i][0] == (inside ? 2.0f : 0.0f));
    }
    rig_close(&rig);
}

// Where the stencil keeps what fails, blocks behind the tile's bounds are skipped; where it counts them, none may be.
static void test_what_is_hidden_is_counted(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    set_format(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.25f, (const float[4]){1, 0, 0, 1}, all);
    struct layer behind = {0, 0, SIZE, SIZE, 0.75f, {2, 0, 0, 1}, .depth_test = true};
    behind.face[0].depth_fail = behind.face[1].depth_fail = RHW_STENCIL_INCREMENT_CLAMP;
    rig_begin(&rig);
    rig_draw(&rig, all, 6);
    draw_layer(&rig, &behind);
    rig_end(&rig);
    const float(*const seen)[4] = rig_read_float4(&rig);
    const uint8_t *const stencil = read_stencil(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_int_equal(stencil[i], 1);
        assert_true(seen[i][0] == 1);
    }
    rig_close(&rig);
}

static void test_written_stencil_is_read_back(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    set_format(&rig, RHW_FORMAT_D24_UNORM_S8_UINT);
    uint8_t stencil[SIZE * SIZE];
    for (int i = 0; i < SIZE * SIZE; i++) {
        stencil[i] = (uint8_t)(i * 7);
    }
    const rhw_texture texture = rig.pass.depth.texture;
    assert_int_equal(rhw_texture_write_stencil(rig.context, texture, 0, stencil, 0), RHW_OK);
    rig.pass.depth.stencil_load = RHW_LOAD_LOAD;
    rig_begin(&rig);
    rig_end(&rig);
    assert_memory_equal(read_stencil(&rig), stencil, sizeof stencil);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rhw_pipeline_def *const def = &rig.pipeline;
    rhw_pipeline pipeline;
    uint8_t stencil[SIZE * SIZE];
    def->stencil_front.compare = RHW_COMPARE_EQUAL;
    assert_int_equal(rhw_pipeline_create(rig.context, def, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "stencil_front.compare is 2 and compares is false");
    def->stencil_front = (struct rhw_stencil_face){.pass = (enum rhw_stencil_operation)8};
    assert_int_equal(rhw_pipeline_create(rig.context, def, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "not all are stencil operations, 0..7 (enum rhw_stencil_operation)");
    def->stencil_front = (struct rhw_stencil_face){.write_mask = 0x101};
    assert_int_equal(rhw_pipeline_create(rig.context, def, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "RHW_STENCIL_NO_BITS alone");
    def->stencil_front = (struct rhw_stencil_face){0};
    def->stencil_test = true;
    rig_set_depth(&rig);
    def->depth_test = false;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_end(&rig);
    rig_expect_misuse(&rig, "tests stencil; the pass has no stencil attachment");
    const rhw_texture depth = rig.pass.depth.texture;
    assert_int_equal(rhw_texture_read_stencil(rig.context, depth, 0, stencil, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "that has no stencil");
    rhw_pass pass;
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .format = RHW_FORMAT_S8_UINT};
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "set depth.stencil_store = RHW_STORE_DISCARD");
    rhw_texture_destroy(rig.context, depth);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_every_rule_against_a_model),      cmocka_unit_test(test_a_mask_from_another_pass),
    cmocka_unit_test(test_stencil_without_memory_in_waves), cmocka_unit_test(test_what_is_hidden_is_counted),
    cmocka_unit_test(test_written_stencil_is_read_back),    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_stencil = UNIT_TESTS(tests, NULL, NULL);
