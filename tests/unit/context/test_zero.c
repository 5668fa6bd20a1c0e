// SPDX-License-Identifier: MIT
// Zero is safe: a definition struct of which only what a program needs was set draws what one from `*_def_default`
// does, or the call says what is missing. Every member, and what zero means there:
//
// | struct           | default                                         | a message                                    |
// | ---------------- | ----------------------------------------------- | -------------------------------------------- |
// | each *_def       | label: none                                     |                                              |
// | context_def      | threads: cores; isa_limit: best; paths: all;    | one of the allocator's two functions         |
// |                  | validate: as the program is compiled;           |                                              |
// |                  | bin_memory: 512 MiB; allocator: malloc; log:    |                                              |
// |                  | none; assert_: print and abort; user: NULL      |                                              |
// | buffer_def       | data: zeroed                                    | size                                         |
// | texture_def      | mip_levels: 1                                   | format, width, height                        |
// | sampler_def      | filters: linear; addresses: repeat; border: 0;  |                                              |
// |                  | lod_bias, lod_min: 0; lod_max: no limit         |                                              |
// | program          | uses: nothing; uniform_size: 0; user: NULL;     | vertex and vertex1; varying_count with       |
// |                  | fragment, fragment1: depth alone                | varyings[0] set                              |
// | varying          | qualifier: smooth; derivatives: none            | components                                   |
// | attribute        | format: FLOAT1; buffer: the first; offset: 0    | a buffer that is not counted                 |
// | vertex_layout    | stride: tightly packed; per_instance, constant: |                                              |
// |                  | each vertex its own element                     |                                              |
// | pipeline_def     | topology: list; primitive_restart: off;         | attribute_count with attributes[0] set;      |
// |                  | provoking: first; cull: none; front: counter-   | buffer_count with an attribute;              |
// |                  | clockwise; depth_range: 0..1; depth_test: off;  | target_count where the pass has a colour     |
// |                  | depth_compare: less; depth_read_only: writes    |                                              |
// | color_target     | blend: off; color, alpha: the source replaces;  | format                                       |
// |                  | write_mask: all channels                        |                                              |
// | blend_component  | src: ONE; dst: ZERO; operation: add             |                                              |
// | pass_def         | width, height: of the first attachment; depth:  | color_count without depth, or with           |
// |                  | none                                            | colors[0].texture set                        |
// | color_attachment | load: clears; store: keeps; clear: 0            | texture                                      |
// | depth_attachment | load: clears; store: keeps; clear: 1            | texture, unless cleared and discarded; clear |
// |                  |                                                 | where the first draw asks for greater depth  |
// | viewport         | depth_min, depth_max: 0..1                      | width, height                                |
#include "harness.h"

#include <string.h>

enum { SIZE = 64, TEXELS = 64 };

struct corner {
    float position[4], uv[2];
};

// Samples with the derivatives of its varying, so that filters and levels count; half transparent.
static void fragment1(struct rhw_fragment1 *f)
{
    const float grad[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
    rhw_sample_grad1(f->bindings, 0, f->varying, grad, f->color[0]);
    f->color[0][3] = 0.5f;
}

static void vertex1(struct rhw_vertex1 *v)
{
    memcpy(v->position, v->attribute[0], 4 * sizeof(float));
    memcpy(v->varying, v->attribute[1], 2 * sizeof(float));
}

// Where a scene starts from, and what it sets beyond the least.
struct scene {
    bool zeroed;
    bool blend, depth_test, viewport;
    bool levels; // of the texture
    bool write_nothing, read_only, constant, top_level;
    bool strides;                      // given
    float depth_max;                   // of the viewport
    struct rhw_depth_attachment depth; // beyond `enabled` and the texture; load DEFAULT: as it comes
    enum rhw_compare compare;          // LESS: as it comes
};

struct drawing {
    rhw_context *context;
    rhw_texture color, depth;
    float pixels[SIZE * SIZE][4], depths[SIZE * SIZE];
    uint64_t hash;
};

static rhw_texture make_texture(struct drawing *d, const struct scene *scene, enum rhw_format format,
                                int size, int levels)
{
    struct rhw_texture_def def = {0};
    if (!scene->zeroed) {
        def = rhw_texture_def_default();
    }
    def.format = format;
    def.width = def.height = size;
    if (levels != 1) {
        def.mip_levels = levels;
    }
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(d->context, &def, &texture), RHW_OK);
    assert_int_equal(rhw_texture_mip_levels(d->context, texture), levels == RHW_MIP_LEVELS_ALL ? 7 : 1);
    return texture;
}

static rhw_texture make_checker(struct drawing *d, const struct scene *scene)
{
    static unsigned char texels[TEXELS][TEXELS][4];
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        const unsigned char value = (i / TEXELS / 3 + i % TEXELS / 3) % 2 ? 230 : 20;
        memcpy(texels[i / TEXELS][i % TEXELS],
               (unsigned char[4]){value, (unsigned char)i, (unsigned char)(i / TEXELS * 4), 255}, 4);
    }
    const rhw_texture texture =
        make_texture(d, scene, RHW_FORMAT_RGBA8_UNORM, TEXELS, scene->levels ? RHW_MIP_LEVELS_ALL : 1);
    rhw_texture_write(d->context, texture, 0, texels, 0);
    assert_int_equal(rhw_texture_generate_mips(d->context, texture), RHW_OK);
    return texture;
}

static rhw_sampler make_sampler(struct drawing *d, const struct scene *scene)
{
    struct rhw_sampler_def def = {0};
    if (!scene->zeroed) {
        def = rhw_sampler_def_default();
    }
    if (scene->top_level) {
        def.lod_max = -1;
    }
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(d->context, &def, &sampler), RHW_OK);
    return sampler;
}

static rhw_pipeline make_pipeline(struct drawing *d, const struct scene *scene)
{
    struct rhw_pipeline_def def = {0};
    if (!scene->zeroed) {
        def = rhw_pipeline_def_default();
    }
    def.program.vertex1 = vertex1;
    def.program.fragment1 = fragment1;
    def.program.varyings[0] = (struct rhw_varying){.components = 2, .derivatives = true};
    def.program.varying_count = 1;
    def.attributes[0] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT4};
    def.attributes[1] = (struct rhw_attribute){
        .format = RHW_VERTEX_FLOAT2, .offset = offsetof(struct corner, uv), .buffer = scene->constant};
    def.attribute_count = 2;
    def.buffer_count = 1 + scene->constant;
    def.buffers[0].stride = scene->strides || scene->constant ? sizeof(struct corner) : 0;
    def.buffers[1].constant = scene->constant;
    def.target_count = 1;
    def.targets[0].format = RHW_FORMAT_RGBA32_FLOAT;
    def.targets[0].blend = scene->blend;
    if (scene->blend) { // and alpha as it comes
        def.targets[0].color.src = RHW_BLEND_SRC_ALPHA;
        def.targets[0].color.dst = RHW_BLEND_ONE_MINUS_SRC_ALPHA;
    }
    if (scene->write_nothing) {
        def.targets[0].write_mask = RHW_WRITE_NONE;
    }
    def.depth_test = scene->depth_test;
    def.depth_read_only = scene->read_only;
    if (scene->compare != RHW_COMPARE_LESS) {
        def.depth_compare = scene->compare;
    }
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(d->context, &def, &pipeline), RHW_OK);
    return pipeline;
}

static rhw_pass begin(struct drawing *d, const struct scene *scene)
{
    struct rhw_pass_def def = {0};
    if (!scene->zeroed) {
        def = rhw_pass_def_default();
    }
    def.colors[0].texture = d->color;
    def.color_count = 1;
    def.depth.enabled = scene->depth_test;
    def.depth.texture = d->depth;
    if (scene->depth.load != RHW_LOAD_DEFAULT) {
        def.depth.load = scene->depth.load;
        def.depth.clear = scene->depth.clear;
    }
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(d->context, &def, &pass), RHW_OK);
    return pass;
}

// Two rectangles that lean through each other; the second lies behind the first at the left.
static void draw(struct drawing *d, const struct scene *scene)
{
    static const struct corner corners[12] = {
        {{-1, -1, 0.2f, 1}, {0, 0}},    {{3, -3, 2.7f, 3}, {5, 0}},    {{-1, 1, 0.2f, 1}, {0, 5}},
        {{-1, 1, 0.2f, 1}, {0, 5}},     {{3, -3, 2.7f, 3}, {5, 0}},    {{3, 3, 2.7f, 3}, {5, 5}},
        {{-0.8f, -1, 0.6f, 1}, {1, 0}}, {{1, -0.8f, 0.4f, 1}, {0, 1}}, {{-1, 0.7f, 0.6f, 1}, {1, 1}},
        {{-1, 0.7f, 0.6f, 1}, {1, 1}},  {{1, -0.8f, 0.4f, 1}, {0, 1}}, {{0.9f, 0.9f, 0.4f, 1}, {2, 2}}};
    struct rhw_context_def context_def = {0};
    if (!scene->zeroed) {
        context_def = rhw_context_def_default();
    }
    assert_int_equal(rhw_context_create(&context_def, &d->context), RHW_OK);
    d->color = make_texture(d, scene, RHW_FORMAT_RGBA32_FLOAT, SIZE, 1);
    d->depth = make_texture(d, scene, RHW_FORMAT_D32_FLOAT, SIZE, 1);
    struct rhw_buffer_def buffer_def = {0};
    if (!scene->zeroed) {
        buffer_def = rhw_buffer_def_default();
    }
    buffer_def.size = sizeof corners;
    buffer_def.data = corners;
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(d->context, &buffer_def, &buffer), RHW_OK);

    const rhw_pass pass = begin(d, scene);
    rhw_pass_set_pipeline(d->context, pass, make_pipeline(d, scene));
    rhw_pass_set_vertex_buffer(d->context, pass, 0, buffer, 0);
    if (scene->constant) {
        rhw_pass_set_vertex_buffer(d->context, pass, 1, buffer, sizeof *corners * 11);
    }
    rhw_pass_set_texture(d->context, pass, 0, make_checker(d, scene), make_sampler(d, scene));
    if (scene->viewport) {
        const struct rhw_viewport viewport = {
            .x = 4, .y = 8, .width = 50, .height = 40, .depth_max = scene->depth_max};
        rhw_pass_set_viewport(d->context, pass, &viewport);
    }
    rhw_pass_draw(d->context, pass, 0, 12, 0, 1);
    assert_int_equal(rhw_pass_end(d->context, pass, NULL), RHW_OK);
    rhw_texture_read(d->context, d->color, 0, d->pixels, 0);
    rhw_texture_read(d->context, d->depth, 0, d->depths, 0);
    d->hash = rig_hash_bytes(rig_hash_bytes(1, d->pixels, sizeof d->pixels), d->depths, sizeof d->depths);
    rhw_context_destroy(d->context);
}

static struct drawing drawings[2];

static uint64_t hash_of(struct scene scene)
{
    draw(&drawings[0], &scene);
    return drawings[0].hash;
}

static void test_zeroed_is_default(void **state)
{
    (void)state;
    uint64_t hashes[64];
    for (int n = 0; n < 64; n++) {
        struct scene scene = {.blend = n & 1,
                              .depth_test = n & 2,
                              .viewport = n & 4,
                              .levels = n & 8,
                              .read_only = n & 16,
                              .strides = n & 32};
        draw(&drawings[0], &scene);
        scene.zeroed = true;
        draw(&drawings[1], &scene);
        if (drawings[0].hash != drawings[1].hash) {
            fail_msg("scene %d differs where its definitions were zeroed", n);
        }
        hashes[n] = drawings[0].hash;
        // Each choice but a stride that says what is computed shows in the picture, read_only where depth is tested.
        for (int bit = 1; bit < 32; bit *= 2) {
            if (n & bit && (bit != 16 || n & 2)) {
                assert_true(hashes[n] != hashes[n & ~bit]);
            }
        }
        assert_true((n & 32) == 0 || hashes[n] == hashes[n & ~32]);
    }
}

static void test_a_context_takes_the_best(void **state)
{
    (void)state;
    const struct rhw_context_def zeroed = {0};
    const struct rhw_context_def def = rhw_context_def_default();
    rhw_context *contexts[2];
    assert_int_equal(rhw_context_create(&zeroed, &contexts[0]), RHW_OK);
    assert_int_equal(rhw_context_create(&def, &contexts[1]), RHW_OK);
    assert_int_equal(rhw_context_isa(contexts[0]), rhw_context_isa(contexts[1]));
    assert_int_equal(rhw_context_threads(contexts[0]), rhw_context_threads(contexts[1]));
    for (int isa = (int)rhw_context_isa(contexts[0]) + 1; isa <= RHW_ISA_AVX2; isa++) {
        assert_false(rhw_isa_supported((enum rhw_isa)isa));
    }
    rhw_context_destroy(contexts[0]);
    rhw_context_destroy(contexts[1]);

    assert_int_equal(rhw_isa_up_to(RHW_ISA_BASELINE), RHW_ISA_UP_TO_BASELINE);
    assert_int_equal(rhw_isa_up_to(RHW_ISA_AVX2), RHW_ISA_UP_TO_AVX2);
    assert_int_equal(rhw_isa_up_to(RHW_ISA_AVX512), RHW_ISA_UP_TO_AVX512);
    assert_int_equal(rhw_isa_up_to(RHW_ISA_COUNT), RHW_ISA_BEST);
}

// What zero cannot say.
static void test_asked_for_by_name(void **state)
{
    (void)state;
    const struct drawing *const d = &drawings[0];
    const float zero[SIZE * SIZE][4] = {{0}};
    hash_of((struct scene){.zeroed = true, .write_nothing = true});
    assert_memory_equal(d->pixels, zero, sizeof zero);

    // Depth cleared to 0: nothing is less, everything at all is greater or equal.
    hash_of((struct scene){.zeroed = true, .depth_test = true, .depth = {.load = RHW_LOAD_CLEAR}});
    assert_memory_equal(d->pixels, zero, sizeof zero);
    hash_of((struct scene){.zeroed = true,
                           .depth_test = true,
                           .depth = {.load = RHW_LOAD_CLEAR},
                           .compare = RHW_COMPARE_GREATER});
    assert_true(d->pixels[SIZE * SIZE / 2][3] == 0.5f && d->depths[SIZE * SIZE / 2] > 0);

    // All of the viewport at depth 0.
    hash_of((struct scene){.zeroed = true, .depth_test = true, .viewport = true, .depth_max = -1});
    assert_true(d->depths[20 * SIZE + 20] == 0 && d->depths[0] == 1);
    hash_of((struct scene){.zeroed = true, .depth_test = true, .viewport = true});
    assert_true(d->depths[20 * SIZE + 20] > 0);

    // Level 0 alone is the picture of a texture that has no other.
    const struct scene top = {.zeroed = true, .levels = true, .top_level = true};
    assert_true(hash_of(top) == hash_of((struct scene){.zeroed = true}));

    // Every vertex reads the last corner's texture coordinates: one texel.
    hash_of((struct scene){.zeroed = true, .constant = true});
    for (int i = 1; i < SIZE; i++) {
        assert_memory_equal(d->pixels[i * SIZE], d->pixels[0], sizeof d->pixels[0]);
    }
    assert_true(d->pixels[0][3] == 0.5f);
}

// A stride that is not given is that of the attributes of its buffer, in whatever order they are named.
static void test_computed_strides(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 16);
    struct rig_vertex corners[6];
    rig_cover(&rig, 0.5f, (const float[4]){0.25f, 0.5f, 0.75f, 1}, corners);
    corners[0].value[0] = 1;
    const struct rhw_attribute attributes[2] = {rig.pipeline.attributes[0], rig.pipeline.attributes[1]};
    uint64_t hashes[4];
    for (int n = 0; n < 4; n++) {
        for (int i = 0; i < 2; i++) {
            rig.pipeline.attributes[i] = attributes[n % 2 ? 1 - i : i];
        }
        rig.pipeline.buffers[0].stride = n < 2 ? 0 : sizeof(struct rig_vertex);
        rig_draw_once(&rig, corners, 6);
        hashes[n] = rig_hash(&rig, 0);
    }
    assert_true(hashes[0] == hashes[2] && hashes[1] == hashes[3] && hashes[0] != hashes[1]);
    rig_close(&rig);
}

static void refuse_pipeline(struct rig *rig, const struct rhw_pipeline_def *def, const char *message)
{
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig->context, def, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, message);
}

static void test_what_is_missing_is_told(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 16);
    const struct rhw_pipeline_def good = rig.pipeline;
    struct rhw_pipeline_def def = good;
    refuse_pipeline(&rig, &(struct rhw_pipeline_def){0}, "program.vertex and program.vertex1 are NULL");
    def.attribute_count = 0;
    def.attributes[0] = def.attributes[1];
    refuse_pipeline(&rig, &def, "attributes[0] is set and attribute_count is 0");
    def = good;
    def.program.varying_count = 0;
    refuse_pipeline(&rig, &def, "program.varyings[0] is set and program.varying_count is 0");
    def = good;
    def.buffer_count = 0;
    refuse_pipeline(&rig, &def, "buffer_count");
    def = good;
    def.targets[0] = (struct rhw_color_target){0};
    refuse_pipeline(&rig, &def, "targets[0].format");
    def = good;
    def.buffers[0] = (struct rhw_vertex_layout){.constant = true, .per_instance = true, .instance_step = 2};
    refuse_pipeline(&rig, &def, "buffers[0].instance_step is 2; it must be 0 in a buffer that is constant");
    def.buffers[0] = (struct rhw_vertex_layout){.constant = true, .stride = 32};
    refuse_pipeline(&rig, &def, "buffers[0].stride is 32");
    def = good;
    def.buffers[0].stride = 0;
    def.attributes[1].offset = UINT32_MAX - 8;
    refuse_pipeline(&rig, &def, "attributes[1].offset");

    rhw_texture texture;
    assert_int_equal(
        rhw_texture_create(rig.context, &(struct rhw_texture_def){.width = 4, .height = 4}, &texture),
        RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "format is not set (RHW_FORMAT_NONE)");
    assert_int_equal(
        rhw_texture_create(rig.context, &(struct rhw_texture_def){.format = RHW_FORMAT_D32_FLOAT}, &texture),
        RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "width is 0");
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &(struct rhw_buffer_def){0}, &buffer), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "size is 0");

    // A pass whose colour was not counted, with and without depth, and a pipeline whose target was not.
    rhw_pass pass;
    struct rhw_pass_def pass_def = {.colors = {{.texture = rig.pass.colors[0].texture}}};
    assert_int_equal(rhw_pass_begin(rig.context, &pass_def, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].texture is set and color_count is 0");
    pass_def.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD};
    assert_int_equal(rhw_pass_begin(rig.context, &pass_def, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].texture is set and color_count is 0");
    // Reversed depth, which DEFAULT did not clear for: nothing is seen, and nothing wrong without validation.
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD};
    rig.pipeline.depth_test = true;
    rig.pipeline.depth_compare = RHW_COMPARE_GREATER;
    struct rig_vertex corners[6];
    rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, corners);
    rig_draw_once(&rig, corners, 6);
    assert_true(rig_read_float4(&rig)[0][0] == 0);
    rig.pass.depth.load = RHW_LOAD_CLEAR;
    rig_draw_once(&rig, corners, 6);
    assert_true(rig_read_float4(&rig)[0][0] == 1);
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = false};

    def = good;
    def.target_count = 0;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig.context, &def, &pipeline), RHW_OK);
    rig_begin(&rig);
    rhw_pass_set_pipeline(rig.context, rig.recording, pipeline);
    rig_expect_misuse(&rig, "has 0 targets (targets[0] is set and target_count is 0); the pass has 1");
    rig_end(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_zeroed_is_default),       cmocka_unit_test(test_a_context_takes_the_best),
    cmocka_unit_test(test_asked_for_by_name),       cmocka_unit_test(test_computed_strides),
    cmocka_unit_test(test_what_is_missing_is_told),
};

const struct unit_tests test_zero = UNIT_TESTS(tests, NULL, NULL);
