// SPDX-License-Identifier: MIT
// Viewports and layers that the vertex function names: what is drawn is what one draw for each primitive draws, with that
// viewport and scissor set and that layer attached.
#include "harness.h"

#include <string.h>

enum { WIDTH = 150, HEIGHT = 100, LAYERS = 5, VERTICES = 3 * 120 };

// Values 2 and 3 are the viewport and the layer.
static void routing_vertex(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].viewport_index = rhw_int_from_float(groups[g].attribute[1][2]);
        groups[g].layer = rhw_int_from_float(groups[g].attribute[1][3]);
    }
}

static void routing_vertex1(struct rhw_vertex1 *vertex)
{
    memcpy(vertex->position, vertex->attribute[0], sizeof vertex->position);
    memcpy(vertex->varying, vertex->attribute[1], 4 * sizeof(float));
    vertex->viewport_index = (int32_t)vertex->attribute[1][2];
    vertex->layer = (int32_t)vertex->attribute[1][3];
}

static void pass_fragment1(struct rhw_fragment1 *fragment)
{
    memcpy(fragment->color[0], fragment->varying, 4 * sizeof(float));
}

static void route_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = rhw_float_from_int(groups[g].layer) + 1.0f;
        groups[g].color[0][1] = rhw_float_from_int(groups[g].viewport_index) + 1.0f;
        groups[g].color[0][2] = groups[g].color[0][3] = rhw_splat(1);
    }
}

static void make_vertices(struct rig_vertex *vertices, int viewports, int layers, uint64_t seed)
{
    for (int i = 0; i < VERTICES; i++) {
        const float w = i % 17 == 5 ? -0.5f : rig_random_float(&seed, 0.5f, 2);
        vertices[i].position[0] = rig_random_float(&seed, -1.3f, 1.3f) * w;
        vertices[i].position[1] = rig_random_float(&seed, -1.3f, 1.3f) * w;
        vertices[i].position[2] = rig_random_float(&seed, -0.1f, 1.1f) * w;
        vertices[i].position[3] = w;
        vertices[i].value[0] = rig_random_float(&seed, 0, 1);
        vertices[i].value[1] = rig_random_float(&seed, 0, 1);
        vertices[i].value[2] = (float)(viewports > 0 ? rig_random_int(&seed, viewports + 2) - 1 : 0);
        vertices[i].value[3] = (float)(layers > 0 ? rig_random_int(&seed, layers + 2) - 1 : 0);
    }
}

static void make_views(struct rhw_viewport views[RHW_MAX_VIEWPORTS],
                       struct rhw_rect scissors[RHW_MAX_VIEWPORTS])
{
    uint64_t seed = 3;
    for (int i = 0; i < RHW_MAX_VIEWPORTS; i++) {
        views[i] = (struct rhw_viewport){.x = rig_random_float(&seed, -20, 100),
                                         .y = rig_random_float(&seed, -20, 60),
                                         .width = rig_random_float(&seed, 10, 90),
                                         .height = rig_random_float(&seed, 10, 90),
                                         .depth_min = rig_random_float(&seed, 0, 1),
                                         .depth_max = rig_random_float(&seed, 0.1f, 1)};
        scissors[i] = (struct rhw_rect){rig_random_int(&seed, 40), rig_random_int(&seed, 30), 90, 60};
    }
}

// Kinds of primitives and of draws; the numbers of vertices of a primitive, and of the provoking one.
struct kind {
    enum rhw_topology topology;
    enum rhw_provoking provoking;
    enum rhw_polygon_mode mode;
    int corners, corner;
};
static const struct kind kinds[] = {
    {RHW_TRIANGLE_LIST, RHW_PROVOKING_FIRST, RHW_POLYGON_FILL, 3, 0},
    {RHW_TRIANGLE_LIST, RHW_PROVOKING_LAST, RHW_POLYGON_FILL, 3, 2},
    {RHW_TRIANGLE_LIST, RHW_PROVOKING_LAST, RHW_POLYGON_LINE, 3, 2},
    {RHW_TRIANGLE_LIST, RHW_PROVOKING_FIRST, RHW_POLYGON_POINT, 3, 0},
    {RHW_LINE_LIST, RHW_PROVOKING_FIRST, RHW_POLYGON_FILL, 2, 0},
    {RHW_LINE_LIST, RHW_PROVOKING_LAST, RHW_POLYGON_FILL, 2, 1},
    {RHW_POINT_LIST, RHW_PROVOKING_LAST, RHW_POLYGON_FILL, 1, 0},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void set_kind(struct rig *rig, const struct kind *kind)
{
    rig->pipeline.topology = kind->topology;
    rig->pipeline.provoking = kind->provoking;
    rig->pipeline.polygon_mode = kind->mode;
    rig->pipeline.program.varyings[0].qualifier = kind->mode == RHW_POLYGON_LINE ? RHW_FLAT : RHW_SMOOTH;
    rig->pipeline.targets[0].blend = true; // what order shows in
    rig->pipeline.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE_MINUS_SRC, RHW_BLEND_ADD};
}

static void route(struct rig *rig, bool viewport, bool layer)
{
    rig->pipeline.program.writes_viewport_index = viewport;
    rig->pipeline.program.writes_layer = layer;
}

static void test_viewports(void **state)
{
    (void)state;
    struct rhw_viewport views[RHW_MAX_VIEWPORTS];
    struct rhw_rect scissors[RHW_MAX_VIEWPORTS];
    static struct rig_vertex vertices[VERTICES];
    make_views(views, scissors);
    make_vertices(vertices, RHW_MAX_VIEWPORTS, 0, 8);
    for (int n = 0; n < 2 * KINDS; n++) {
        const struct kind *const kind = &kinds[n % KINDS];
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = 2;
        def.paths = n < KINDS ? RHW_PATHS_ALL : RHW_PATHS_GENERAL;
        struct rig rig;
        rig_open_with(&rig, WIDTH, HEIGHT, &def);
        rig_set_depth(&rig);
        set_kind(&rig, kind);
        // Primitive by primitive.
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, vertices, sizeof vertices);
        for (int i = 0; i + kind->corners <= VERTICES; i += kind->corners) {
            const int view = (int)vertices[i + kind->corner].value[2];
            if (view >= 0 && view < RHW_MAX_VIEWPORTS) {
                rhw_pass_set_viewport(rig.context, rig.recording, &views[view]);
                rhw_pass_set_scissor(rig.context, rig.recording, &scissors[view]);
                rhw_pass_draw(rig.context, rig.recording, (uint32_t)i, (uint32_t)kind->corners, 0, 1);
            }
        }
        rig_end(&rig);
        static float expected[WIDTH * HEIGHT][4];
        memcpy(expected, rig_read_float4(&rig), sizeof expected);
        const uint64_t depth = rig_hash_bytes(1, rig_read_depth(&rig), sizeof(float[WIDTH * HEIGHT]));
        // All at once.
        rig_set_program(&rig, routing_vertex, rig_fragment_pass);
        route(&rig, true, false);
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, vertices, sizeof vertices);
        rhw_pass_set_viewports(rig.context, rig.recording, 0, 5, views);
        rhw_pass_set_viewports(rig.context, rig.recording, 5, RHW_MAX_VIEWPORTS - 5, views + 5);
        rhw_pass_set_scissors(rig.context, rig.recording, 0, RHW_MAX_VIEWPORTS, scissors);
        rhw_pass_draw(rig.context, rig.recording, 0, VERTICES, 0, 1);
        rig_end(&rig);
        assert_memory_equal(rig_read_float4(&rig), expected, sizeof expected);
        assert_true(rig_hash_bytes(1, rig_read_depth(&rig), sizeof(float[WIDTH * HEIGHT])) == depth);
        rig_close(&rig);
    }
}

static rhw_texture make_layers(const struct rig *rig, int samples)
{
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA32_FLOAT,
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .layers = LAYERS + 2,
                                        .samples = samples};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void read_layers(const struct rig *rig, rhw_texture texture, float out[][WIDTH * HEIGHT][4])
{
    for (int layer = 0; layer < LAYERS + 2; layer++) {
        assert_int_equal(rhw_texture_read_layer(rig->context, texture, 0, layer, out[layer], 0), RHW_OK);
    }
}

// Layers 1 .. LAYERS of a texture: in one pass, and in one for each. `bin_memory`: little of it makes waves, in which depth
// without a texture is kept.
static void compare_layers(const struct kind *kind, size_t bin_memory, int samples)
{
    static struct rig_vertex vertices[VERTICES], one[VERTICES];
    static float expected[LAYERS + 2][WIDTH * HEIGHT][4], read[LAYERS + 2][WIDTH * HEIGHT][4];
    make_vertices(vertices, 0, LAYERS, 21);
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    def.bin_memory = bin_memory;
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &def);
    const rhw_texture layers = make_layers(&rig, 1);
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .clear = 1, .store = RHW_STORE_DISCARD};
    rig.pipeline.depth_test = true;
    rig.pass.samples = samples;
    rig.pass.colors[0].texture = layers;
    rig.pass.colors[0].clear[2] = 0.5f;
    set_kind(&rig, kind);
    for (int layer = 0; layer < LAYERS; layer++) {
        int count = 0;
        for (int i = 0; i + kind->corners <= VERTICES; i += kind->corners) {
            if (vertices[i + kind->corner].value[3] == (float)layer) {
                memcpy(one + count, vertices + i, (size_t)kind->corners * sizeof *one);
                count += kind->corners;
            }
        }
        rig.pass.colors[0].layer = 1 + layer;
        rig_draw_once(&rig, one, count);
    }
    read_layers(&rig, layers, expected);
    rig_set_program(&rig, routing_vertex, rig_fragment_pass);
    route(&rig, false, true);
    rig.pass.colors[0].layer = 1;
    rig.pass.colors[0].layer_count = LAYERS;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    rhw_pass_draw(rig.context, rig.recording, 0, VERTICES, 0, 1);
    rig_end(&rig);
    assert_int_equal(rig.stats.tiles, 3 * 2 * LAYERS);
    assert_true(bin_memory == 0 || rig.stats.flushes > 0);
    read_layers(&rig, layers, read);
    assert_memory_equal(read, expected, sizeof expected);
    rhw_texture_destroy(rig.context, layers);
    rig_close(&rig);
}

static void test_layers(void **state)
{
    (void)state;
    for (int n = 0; n < KINDS; n++) {
        compare_layers(&kinds[n], 0, 1);
    }
    compare_layers(&kinds[0], 1, 1);
    compare_layers(&kinds[1], 0, 4);
    compare_layers(&kinds[0], 1, 4);
}

// A layer that was cleared, drawn into with others and cleared again.
static void test_clean_tiles_are_forgotten(void **state)
{
    (void)state;
    static float read[LAYERS + 2][WIDTH * HEIGHT][4];
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    const rhw_texture layers = make_layers(&rig, 1);
    rig.pass.colors[0].texture = layers;
    rig_begin(&rig);
    rig_end(&rig);
    struct rig_vertex cover[6];
    rig_cover(&rig, 0.5f, (float[]){1, 1, 0, 0}, cover);
    rig.pass.colors[0].layer_count = 2;
    rig_draw_once(&rig, cover, 6);
    rig.pass.colors[0].layer_count = 0;
    rig_begin(&rig);
    rig_end(&rig);
    read_layers(&rig, layers, read);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(read[0][i][0] == 0);
    }
    rhw_texture_destroy(rig.context, layers);
    rig_close(&rig);
}

// The fragment function and the one-at-a-time form, each primitive in a viewport and a layer.
static void test_builtins(void **state)
{
    (void)state;
    static float read[LAYERS + 2][WIDTH * HEIGHT][4];
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    const rhw_texture layers = make_layers(&rig, 1);
    rig_set_program(&rig, routing_vertex, route_fragment);
    rig.pipeline.program.uses = RHW_USE_LAYER;
    route(&rig, true, true);
    rig.pass.colors[0].texture = layers;
    rig.pass.colors[0].layer_count = LAYERS;
    struct rig_vertex cover[2][6];
    rig_cover(&rig, 0.5f, (float[]){7, 0, 0, 2}, cover[0]);
    rig_cover(&rig, 0.5f, (float[]){8, 0, 9, 4}, cover[1]);
    const struct rhw_viewport half = {.x = 0, .y = 0, .width = WIDTH / 2, .height = HEIGHT};
    for (int form = 0; form < 2; form++) {
        if (form == 1) {
            memset(rig.pipeline.program.vertex, 0, sizeof rig.pipeline.program.vertex);
            memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
            rig.pipeline.program.vertex1 = routing_vertex1;
            rig.pipeline.program.fragment1 = pass_fragment1;
        }
        rig_begin(&rig);
        rhw_pass_set_viewports(rig.context, rig.recording, 9, 1, &half);
        rig_draw(&rig, cover[0], 12);
        rig_end(&rig);
        read_layers(&rig, layers, read);
        for (int layer = 0; layer < LAYERS; layer++) {
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                const bool is_half = layer == 4 && i % WIDTH < WIDTH / 2;
                const float by_layer[2] = {layer == 2 ? 3.0f
                                           : is_half  ? 5.0f
                                                      : 0,
                                           layer == 2 ? 7.0f
                                           : is_half  ? 8.0f
                                                      : 0};
                const float by_view[2] = {layer == 2 ? 1.0f : is_half ? 10.0f : 0, 0};
                assert_true(read[layer][i][0] == by_layer[form]);
                assert_true(read[layer][i][1] == by_view[form]);
            }
        }
    }
    rhw_texture_destroy(rig.context, layers);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    const rhw_texture layers = make_layers(&rig, 1), more = make_layers(&rig, 1);
    struct rhw_pass_def def = {.color_count = 2, .colors = {{.texture = layers}, {.texture = more}}};
    rhw_pass pass;
    def.colors[0].layer_count = 3;
    assert_int_equal(rhw_pass_begin(rig.context, &def, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[1].layer_count is 1; the first attachment has 3");
    def.color_count = 1;
    def.colors[0].layer = LAYERS;
    assert_int_equal(rhw_pass_begin(rig.context, &def, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "has 3 layers from 5 on; level 0 of");
    def.colors[0].layer_count = -1;
    assert_int_equal(rhw_pass_begin(rig.context, &def, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].layer_count is -1; it is 0..2048");
    const struct rhw_viewport views[2] = {{.width = 4, .height = 4}, {.width = 0, .height = 4}};
    const struct rhw_rect scissors[1] = {{0, 0, -1, 1}};
    def.colors[0].layer = def.colors[0].layer_count = 0;
    assert_int_equal(rhw_pass_begin(rig.context, &def, &pass), RHW_OK);
    rhw_pass_set_viewports(rig.context, pass, 15, 2, views);
    rig_expect_misuse(&rig, "rhw_pass_set_viewports: first is 15 and count 2; there are 16");
    rhw_pass_set_viewports(rig.context, pass, 0, 2, views);
    rig_expect_misuse(&rig, "rhw_pass_set_viewports: the size is 0x4");
    rhw_pass_set_viewports(rig.context, pass, 0, 1, NULL);
    rig_expect_misuse(&rig, "rhw_pass_set_viewports: viewports is NULL");
    rhw_pass_set_scissors(rig.context, pass, -1, 1, scissors);
    rig_expect_misuse(&rig, "rhw_pass_set_scissors: first is -1 and count 1; there are 16");
    rhw_pass_set_scissors(rig.context, pass, 3, 1, scissors);
    rig_expect_misuse(&rig, "rhw_pass_set_scissors: the size is -1x1");
    assert_int_equal(rhw_pass_end(rig.context, pass, NULL), RHW_ERROR_MISUSE);
    rhw_texture_destroy(rig.context, layers);
    rhw_texture_destroy(rig.context, more);
    rig_close(&rig);
}

// Validation: what is written and not declared, and the other way round.
static void test_declarations(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.validate = RHW_VALIDATE_ON;
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &def);
    struct rig_vertex cover[6];
    rig_cover(&rig, 0.5f, (float[]){1, 1, 0, 0}, cover);
    rig_set_program(&rig, routing_vertex, rig_fragment_pass);
    rig_draw_once(&rig, cover, 6);
    rig_expect_misuse(&rig, "writes viewport_index; its program's writes_viewport_index is false");
    route(&rig, true, true);
    rig_draw_once(&rig, cover, 6);
    assert_int_equal(rig.misuses, 0);
    rig_set_program(&rig, rig_vertex_pass, rig_fragment_pass);
    route(&rig, false, true);
    rig_draw_once(&rig, cover, 6);
    rig_expect_misuse(&rig, "does not write layer; its program's writes_layer is true");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_viewports),
    cmocka_unit_test(test_layers),
    cmocka_unit_test(test_clean_tiles_are_forgotten),
    cmocka_unit_test(test_builtins),
    cmocka_unit_test(test_misuse),
    cmocka_unit_test(test_declarations),
};

const struct unit_tests test_routing = UNIT_TESTS(tests, NULL, NULL);
