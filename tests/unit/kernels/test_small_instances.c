// SPDX-License-Identifier: MIT
// Instances of few triangles, of which the front end takes several at once: each triangle has the vertices, the attributes
// and the ids of its own instance, also where a chunk ends within one and where clipping makes vertices. Many layers of
// them, over each other, hide each other and add up as if they were drawn one by one.
#include "harness.h"

#include <math.h>
#include <string.h>

// Three triangles each, so that chunks of 8192 end within an instance; triangle n of all covers pixel n.
enum { SIZE = 256, EACH = 3, INSTANCES = SIZE * SIZE / EACH, FIRST = 5, STEP = 4, BASE = 2 };

// Vertices are corners 0, 1, 2 of triangles 0, 1, 2 of an instance, `BASE` before the first.
static void place(struct rhw_vertex *vertex)
{
    const rhw_int number = vertex->vertex_index - BASE;
    const rhw_int pixel = (vertex->instance_index - FIRST) * EACH + number / 3, corner = number % 3;
    const rhw_float column = rhw_float_from_int(pixel % SIZE), row = rhw_float_from_int(pixel / SIZE);
    // Corners at (0.25, 0.25), (0.25, 1), (1, 0.25) of the pixel.
    const rhw_float x =
        column + rhw_select(rhw_equal_int(corner, rhw_splat_int(2)), rhw_splat(1), rhw_splat(0.25f));
    const rhw_float y =
        row + rhw_select(rhw_equal_int(corner, rhw_splat_int(1)), rhw_splat(1), rhw_splat(0.25f));
    vertex->position[0] = x * (2.0f / SIZE) - 1.0f;
    vertex->position[1] = 1.0f - y * (2.0f / SIZE);
    vertex->position[2] = rhw_splat(0);
    vertex->position[3] = rhw_splat(1);
    vertex->varying[0] = vertex->attribute[0][0];
    vertex->varying[1] = vertex->attribute[1][0];
}

static void place_groups(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        place(&groups[g]);
    }
}

// Cuts a corner off every triangle of odd instances, but not the pixel's centre.
static void place_clipped(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        place(&groups[g]);
        const rhw_int corner = (groups[g].vertex_index - BASE) % 3;
        const rhw_int cut = rhw_equal_int(corner, rhw_splat_int(2)) &
                            rhw_equal_int(groups[g].instance_index & 1, rhw_splat_int(1));
        groups[g].clip_distance[0] = rhw_select(cut, rhw_splat(-0.1f), rhw_splat(1));
    }
}

static void tell(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = rhw_float_from_int(groups[g].instance);
        groups[g].color[0][1] = rhw_float_from_int(groups[g].primitive);
        groups[g].color[0][2] = groups[g].varying[0];
        groups[g].color[0][3] = groups[g].varying[1];
    }
}

// Attribute 0 steps with the instances, attribute 1 with STEP of them.
static void open_rig(struct rig *rig)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, place_groups, tell);
    rig->pipeline.program.uses = RHW_USE_IDS;
    rig->pipeline.program.varyings[0] = (struct rhw_varying){.components = 2, .qualifier = RHW_FLAT};
    rig->pipeline.program.varying_count = 1;
    for (int i = 0; i < 2; i++) {
        rig->pipeline.attributes[i] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT1, .buffer = i};
        rig->pipeline.buffers[i] = (struct rhw_vertex_layout){.stride = 4, .per_instance = true};
    }
    rig->pipeline.buffers[1].instance_step = STEP;
    rig->pipeline.attribute_count = rig->pipeline.buffer_count = 2;
}

static void begin(struct rig *rig)
{
    static float numbers[FIRST + INSTANCES];
    for (int i = 0; i < FIRST + INSTANCES; i++) {
        numbers[i] = (float)i * 0.5f;
    }
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, numbers, sizeof numbers);
    rig_use_vertices(rig, 1, numbers, sizeof numbers);
}

static void check_pixels(struct rig *rig)
{
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int n = 0; n < INSTANCES * EACH; n++) {
        const int instance = n / EACH;
        const float expected[4] = {(float)(FIRST + instance), (float)(n % EACH),
                                   (float)(FIRST + instance) * 0.5f, (float)(FIRST + instance / STEP) * 0.5f};
        if (memcmp(pixels[n], expected, sizeof expected) != 0) {
            fail_msg("pixel %d has %g %g %g %g, not %g %g %g %g", n, (double)pixels[n][0],
                     (double)pixels[n][1], (double)pixels[n][2], (double)pixels[n][3], (double)expected[0],
                     (double)expected[1], (double)expected[2], (double)expected[3]);
        }
    }
}

static void test_lists(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    begin(&rig);
    rhw_pass_draw(rig.context, rig.recording, BASE, 3 * EACH, FIRST, INSTANCES);
    rig_end(&rig);
    assert_int_equal(rig.stats.triangles_in, INSTANCES * EACH);
    check_pixels(&rig);
    rig_close(&rig);
}

// In an order of their own, and far apart, so that they are found by a table.
static void test_indices(void **state)
{
    (void)state;
    static const uint16_t orders[2][3 * EACH] = {{1, 2, 0, 3, 4, 5, 8, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7, 8}};
    for (int i = 0; i < 2; i++) {
        struct rig rig;
        open_rig(&rig);
        begin(&rig);
        rig_use_indices(&rig, RHW_INDEX_UINT16, orders[i], sizeof orders[i]);
        rhw_pass_draw_indexed(rig.context, rig.recording, 0, 3 * EACH, BASE, FIRST, INSTANCES);
        rig_end(&rig);
        check_pixels(&rig);
        rig_close(&rig);
    }
}

static void test_clipped(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig_set_program(&rig, place_clipped, tell);
    rig.pipeline.program.clip_distance_count = 1;
    begin(&rig);
    rhw_pass_draw(rig.context, rig.recording, BASE, 3 * EACH, FIRST, INSTANCES);
    rig_end(&rig);
    assert_true(rig.stats.triangles_clipped > 0);
    check_pixels(&rig);
    rig_close(&rig);
}

enum { LAYERS = 100000 };

// A square of whole pixels, of 1 to 8 each way, at a depth of its own.
struct layer {
    float corners[4], depth, amount; // x0, y0, x1, y1
};

// A corner of a layer, which the number of the vertex in a strip chooses.
static void place_layer(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const vertex = &groups[g];
        for (int axis = 0; axis < 2; axis++) {
            const rhw_int far = (vertex->vertex_index >> axis & 1) == 1;
            const rhw_float at = rhw_select(far, vertex->attribute[0][2 + axis], vertex->attribute[0][axis]);
            vertex->position[axis] = (at * (2.0f / SIZE) - 1.0f) * (axis == 0 ? 1.0f : -1.0f);
        }
        vertex->position[2] = vertex->varying[0] = vertex->attribute[1][0];
        vertex->position[3] = rhw_splat(1);
        vertex->varying[1] = vertex->attribute[1][1];
    }
}

static void tell_layer(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].varying[0];
        groups[g].color[0][1] = groups[g].varying[1];
        groups[g].color[0][2] = groups[g].color[0][3] = rhw_splat(1);
    }
}

struct expected {
    float depth, nearest, sum, number; // `depth` and `nearest` are those of the nearest layer
};

static void make_layer(int number, uint64_t *random, struct layer *layer)
{
    layer->depth = (float)(number * 7919 % LAYERS) / (1 << 17); // 7919 is a prime: all differ
    layer->amount = (float)rig_random_int(random, 256);
    for (int axis = 0; axis < 2; axis++) {
        layer->corners[axis] = (float)rig_random_int(random, SIZE - 8);
        layer->corners[2 + axis] = layer->corners[axis] + (float)(1 + rig_random_int(random, 8));
    }
}

static void expect_layer(const struct layer *layer, struct expected pixels[SIZE * SIZE])
{
    for (int y = (int)layer->corners[1]; y < (int)layer->corners[3]; y++) {
        for (int x = (int)layer->corners[0]; x < (int)layer->corners[2]; x++) {
            struct expected *const pixel = &pixels[y * SIZE + x];
            if (pixel->number == 0 || layer->depth < pixel->depth) {
                pixel->depth = layer->depth;
                pixel->nearest = layer->amount;
            }
            pixel->sum += layer->amount;
            pixel->number++;
        }
    }
}

static void open_rig_of_layers(struct rig *rig, bool adds)
{
    const struct rhw_blend_component add = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, place_layer, tell_layer);
    struct rhw_pipeline_def *const def = &rig->pipeline;
    def->program.varyings[0] = (struct rhw_varying){.components = 2, .qualifier = RHW_FLAT};
    def->program.varying_count = 1;
    def->attributes[0] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT4};
    def->attributes[1] =
        (struct rhw_attribute){.format = RHW_VERTEX_FLOAT2, .offset = offsetof(struct layer, depth)};
    def->buffers[0] = (struct rhw_vertex_layout){.stride = sizeof(struct layer), .per_instance = true};
    def->attribute_count = 2;
    def->buffer_count = 1;
    def->topology = RHW_TRIANGLE_STRIP;
    if (adds) {
        def->targets[0].blend = true;
        def->targets[0].color = def->targets[0].alpha = add;
    } else {
        rig_set_depth(rig);
    }
}

// The nearest layer of each pixel with a depth test; without one the sum of all, which is exact, and their number.
static void test_layers(void **state)
{
    (void)state;
    static struct layer layers[LAYERS];
    static struct expected expected[SIZE * SIZE];
    uint64_t random = 1;
    for (int i = 0; i < LAYERS; i++) {
        make_layer(i, &random, &layers[i]);
        expect_layer(&layers[i], expected);
    }
    for (int adds = 0; adds < 2; adds++) {
        struct rig rig;
        open_rig_of_layers(&rig, adds);
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, layers, sizeof layers);
        rhw_pass_draw(rig.context, rig.recording, 0, 4, 0, LAYERS);
        rig_end(&rig);
        assert_int_equal(rig.stats.draws, 1);
        assert_int_equal(rig.stats.triangles_in, 2 * LAYERS);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const bool is_seen = expected[p].number > 0;
            assert_true(pixels[p][1] == (adds ? expected[p].sum : expected[p].nearest));
            assert_true(pixels[p][2] == (adds ? expected[p].number : is_seen ? 1.0f : 0.0f));
            assert_true(adds || !is_seen || pixels[p][0] == expected[p].depth);
        }
        rig_close(&rig);
    }
}

// Puts an instance into the column that the two low bits of its number say.
static void place_by_low_bits(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int corner = groups[g].vertex_index;
        const rhw_float column = rhw_float_from_int(groups[g].instance_index & 3);
        const rhw_float right =
            rhw_select(rhw_equal_int(corner, rhw_splat_int(2)), rhw_splat(1), rhw_splat(0.25f));
        const rhw_float down =
            rhw_select(rhw_equal_int(corner, rhw_splat_int(1)), rhw_splat(1), rhw_splat(0.25f));
        groups[g].position[0] = (column + right) * (2.0f / SIZE) - 1.0f;
        groups[g].position[1] = 1.0f - down * (2.0f / SIZE);
        groups[g].position[2] = rhw_splat(0);
        groups[g].position[3] = rhw_splat(1);
    }
}

static void tell_low_bits(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = rhw_float_from_int(groups[g].instance & 7);
        groups[g].color[0][1] = groups[g].color[0][2] = groups[g].color[0][3] = rhw_splat(1);
    }
}

// The numbers of instances are counted modulo 2^32: after 2^31 − 1 comes −2^31.
static void test_numbers_wrap(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_program(&rig, place_by_low_bits, tell_low_bits);
    rig.pipeline.program.uses = RHW_USE_IDS;
    rig.pipeline.program.varying_count = rig.pipeline.attribute_count = rig.pipeline.buffer_count = 0;
    memset(rig.pipeline.program.varyings, 0, sizeof rig.pipeline.program.varyings);
    memset(rig.pipeline.attributes, 0, sizeof rig.pipeline.attributes);
    memset(rig.pipeline.buffers, 0, sizeof rig.pipeline.buffers);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, INT32_MAX - 1, 3);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    static const float expected[4][2] = {{0, 1}, {0, 0}, {6, 1}, {7, 1}};
    for (int column = 0; column < 4; column++) {
        assert_float_equal(pixels[column][0], expected[column][0], 0);
        assert_float_equal(pixels[column][1], expected[column][1], 0);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_lists),  cmocka_unit_test(test_indices),      cmocka_unit_test(test_clipped),
    cmocka_unit_test(test_layers), cmocka_unit_test(test_numbers_wrap),
};

const struct unit_tests test_small_instances = UNIT_TESTS(tests, NULL, NULL);
