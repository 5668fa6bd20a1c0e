// SPDX-License-Identifier: MIT
// What each output becomes in a PNG or PPM, held to the formulas that rhw render --help states, on pictures
// of a few pixels made by hand.
#include "outputs.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 3, HEIGHT = 2, PIXELS = WIDTH * HEIGHT };

static const float bounds_min[3] = {-1.0f, 0.0f, 10.0f}, bounds_max[3] = {3.0f, 0.0f, 20.0f};

// The samples of a whole picture as 16 bit numbers, whatever it has.
static void rasterize(const struct scene_pictures *pictures, enum scene_output_kind kind, int bits,
                      bool transparent, struct cli_output_raster *output, uint16_t *samples)
{
    cli_output_rasterize(output, pictures, kind, bits, transparent, bounds_min, bounds_max);
    const struct cli_raster *raster = &output->raster;
    assert_int_equal(raster->width, WIDTH);
    assert_int_equal(raster->height, HEIGHT);
    uint16_t row[WIDTH * 4];
    for (int y = 0; y < HEIGHT; y++) {
        raster->row(raster->user, y, row);
        for (int i = 0; i < WIDTH * raster->channels; i++) {
            *samples++ = raster->bits == 8 ? ((const uint8_t *)row)[i] : row[i];
        }
    }
}

static void test_color(void **state)
{
    (void)state;
    uint8_t color[PIXELS][4];
    for (int i = 0; i < PIXELS * 4; i++) {
        color[i / 4][i % 4] = (uint8_t)(i * 10);
    }
    struct scene_pictures pictures = {.width = WIDTH, .height = HEIGHT, .color = color[0]};
    struct cli_output_raster output;
    uint16_t samples[PIXELS * 4];
    rasterize(&pictures, SCENE_KIND_COLOR, 0, false, &output, samples);
    assert_int_equal(output.raster.channels, 3);
    assert_int_equal(output.raster.bits, 8);
    assert_true(output.raster.srgb);
    for (int i = 0; i < PIXELS * 3; i++) {
        assert_int_equal(samples[i], color[i / 3][i % 3]);
    }
    rasterize(&pictures, SCENE_KIND_COLOR, 8, true, &output, samples);
    assert_int_equal(output.raster.channels, 4);
    for (int i = 0; i < PIXELS * 4; i++) {
        assert_int_equal(samples[i], color[i / 4][i % 4]);
    }
}

// Against IEC 61966-2-1 in double; the last pixel of an odd row stands alone in its vector.
static void test_fine_color(void **state)
{
    (void)state;
    float display[PIXELS][4];
    for (int i = 0; i < PIXELS * 4; i++) {
        display[i / 4][i % 4] = (float)(i * i) / 500.0f; // 0 .. 1.058, dark values dense
    }
    const struct scene_pictures pictures = {.width = WIDTH, .height = HEIGHT, .display = display[0]};
    struct cli_output_raster output;
    uint16_t samples[PIXELS * 4];
    rasterize(&pictures, SCENE_KIND_COLOR, 16, true, &output, samples);
    assert_int_equal(output.raster.bits, 16);
    for (int i = 0; i < PIXELS * 4; i++) {
        const double linear = fmin((double)display[i / 4][i % 4], 1.0);
        const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
        const double expected = (i % 4 == 3 ? linear : encoded) * 65535.0;
        assert_true(fabs(samples[i] - expected) <= 0.51);
    }
    uint16_t opaque[PIXELS * 3];
    rasterize(&pictures, SCENE_KIND_COLOR, 16, false, &output, opaque);
    for (int i = 0; i < PIXELS * 3; i++) {
        assert_int_equal(opaque[i], samples[i / 3 * 4 + i % 3]);
    }
}

static void test_depth_and_distance(void **state)
{
    (void)state;
    float depth[PIXELS] = {0.25f, 0.5f, 0.75f, 1.0f, 0.375f, 0.25f};
    float distance[PIXELS] = {2.0f, 3.0f, 4.0f, INFINITY, 2.5f, 2.0f};
    const struct scene_pictures pictures = {
        .width = WIDTH, .height = HEIGHT, .depth = depth, .distance = distance};
    // 1 at the nearest, 0.1 at the farthest, linear between; 0 where nothing is.
    const double expected[PIXELS] = {1.0, 0.55, 0.1, 0.0, 0.775, 1.0};
    const enum scene_output_kind kinds[2] = {SCENE_KIND_DEPTH, SCENE_KIND_DISTANCE};
    for (int k = 0; k < 2; k++) {
        struct cli_output_raster output;
        uint16_t samples[PIXELS];
        rasterize(&pictures, kinds[k], 0, false, &output, samples);
        assert_int_equal(output.raster.channels, 1);
        assert_int_equal(output.raster.bits, 16);
        assert_false(output.raster.srgb);
        for (int i = 0; i < PIXELS; i++) {
            assert_true(fabs(samples[i] - expected[i] * 65535.0) <= 0.51);
        }
        assert_non_null(strstr(output.raster.comment, k == 0 ? "white is 0.25" : "white is 2,"));
        assert_non_null(strstr(output.raster.comment, k == 0 ? "one tenth is 0.75" : "one tenth is 4,"));
        rasterize(&pictures, kinds[k], 8, false, &output, samples);
        for (int i = 0; i < PIXELS; i++) {
            assert_true(fabs(samples[i] - expected[i] * 255.0) <= 0.51);
        }
    }
}

static void test_depth_of_nothing_and_of_one_plane(void **state)
{
    (void)state;
    float depth[PIXELS] = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    const struct scene_pictures pictures = {.width = WIDTH, .height = HEIGHT, .depth = depth};
    struct cli_output_raster output;
    uint16_t samples[PIXELS];
    rasterize(&pictures, SCENE_KIND_DEPTH, 0, false, &output, samples);
    for (int i = 0; i < PIXELS; i++) {
        assert_int_equal(samples[i], 0);
    }
    depth[2] = depth[4] = 0.5f;
    rasterize(&pictures, SCENE_KIND_DEPTH, 0, false, &output, samples);
    for (int i = 0; i < PIXELS; i++) {
        assert_int_equal(samples[i], i == 2 || i == 4 ? 65535 : 0);
    }
}

static void test_vectors(void **state)
{
    (void)state;
    float vectors[PIXELS][4] = {{-1.0f, 0.0f, 1.0f, 1.0f}, {0.5f, -0.5f, 0.0f, 1.0f},
                                {0.0f, 0.0f, 0.0f, 0.0f},  {3.0f, 5.0f, 20.0f, 1.0f},
                                {1.0f, 0.0f, 15.0f, 1.0f}, {NAN, NAN, NAN, 1.0f}};
    const struct scene_pictures pictures = {.width = WIDTH,
                                            .height = HEIGHT,
                                            .normal = vectors[0],
                                            .position = vectors[0],
                                            .barycentric = vectors[0]};
    struct cli_output_raster output;
    uint16_t samples[PIXELS][3];
    rasterize(&pictures, SCENE_KIND_NORMAL, 0, false, &output, samples[0]);
    assert_int_equal(output.raster.bits, 8);
    const uint16_t normals[3][3] = {{0, 128, 255}, {191, 64, 128}, {0, 0, 0}};
    assert_memory_equal(samples, normals, sizeof normals);
    // x −1..3, y without extent, z 10..20
    rasterize(&pictures, SCENE_KIND_POSITION, 0, false, &output, samples[0]);
    const uint16_t positions[3][3] = {{255, 0, 255}, {128, 0, 128}, {0, 0, 0}};
    assert_memory_equal(samples[3], positions, sizeof positions);
    rasterize(&pictures, SCENE_KIND_BARYCENTRIC, 0, false, &output, samples[0]);
    const uint16_t weights[3][3] = {{0, 0, 255}, {128, 0, 0}, {0, 0, 0}};
    assert_memory_equal(samples, weights, sizeof weights);
}

static void test_uv(void **state)
{
    (void)state;
    float uv[PIXELS][4] = {{0.2f, 0.4f, 0, 1},  {1.2f, -0.6f, 0, 1},   {0.2f, 0.4f, 0, 0},
                           {-3.0f, 7.0f, 0, 1}, {NAN, INFINITY, 0, 1}, {0.999999f, 0.5f, 0, 1}};
    const struct scene_pictures pictures = {.width = WIDTH, .height = HEIGHT, .uv = uv[0]};
    struct cli_output_raster output;
    uint16_t samples[PIXELS][3];
    rasterize(&pictures, SCENE_KIND_UV, 0, false, &output, samples[0]);
    const uint16_t expected[PIXELS][3] = {{51, 102, 0}, {51, 102, 0}, {0, 0, 0},
                                          {0, 0, 0},    {0, 0, 0},    {255, 128, 0}};
    assert_memory_equal(samples, expected, sizeof expected);
}

// Distinct colours, none of them near the black of nothing, and the same ones for ever.
static void test_ids(void **state)
{
    (void)state;
    static uint32_t ids[PIXELS] = {0, 1, 2, 3, 1, UINT32_MAX};
    const struct scene_pictures pictures = {.width = WIDTH, .height = HEIGHT, .object = ids, .triangle = ids};
    struct cli_output_raster output;
    uint16_t objects[PIXELS][3], triangles[PIXELS][3];
    rasterize(&pictures, SCENE_KIND_OBJECT, 0, false, &output, objects[0]);
    rasterize(&pictures, SCENE_KIND_TRIANGLE, 0, false, &output, triangles[0]);
    assert_memory_equal(objects, triangles, sizeof objects);
    const uint16_t expected[4][3] = {{0, 0, 0}, {205, 167, 162}, {156, 80, 69}, {228, 237, 244}};
    assert_memory_equal(objects, expected, sizeof expected);
    assert_memory_equal(objects[4], objects[1], sizeof objects[1]);
    for (int i = 0; i < 3; i++) {
        assert_in_range(objects[5][i], 55, 255);
    }
}

// None is black, the most is white, and more is lighter.
static void test_overdraw(void **state)
{
    (void)state;
    float overdraw[PIXELS] = {0, 1, 2, 3, 8, 5};
    const struct scene_pictures pictures = {.width = WIDTH, .height = HEIGHT, .overdraw = overdraw};
    struct cli_output_raster output;
    uint16_t samples[PIXELS][3];
    rasterize(&pictures, SCENE_KIND_OVERDRAW, 0, false, &output, samples[0]);
    const uint16_t ends[2][3] = {{0, 0, 0}, {255, 255, 255}}, quarter[3] = {89, 26, 128};
    assert_memory_equal(samples[0], ends[0], sizeof ends[0]);
    assert_memory_equal(samples[4], ends[1], sizeof ends[1]);
    assert_memory_equal(samples[2], quarter, sizeof quarter);
    static const int rising[PIXELS] = {0, 1, 2, 3, 5, 4};
    for (int i = 1; i < PIXELS; i++) {
        const uint16_t *const less = samples[rising[i - 1]], *const more = samples[rising[i]];
        assert_true(less[0] + 2 * less[1] < more[0] + 2 * more[1]);
    }
    assert_non_null(strstr(output.raster.comment, "white is 8"));
}

// 0.65 of the tile's colour and 0.35 of the grey of the picture, which is r + 2 g + b.
static void test_tiles_and_plans(void **state)
{
    (void)state;
    uint32_t tiles[PIXELS] = {0, 4, 8, 0, 0, 16}, plan[PIXELS] = {0, 1, 2, 4, 3, 0};
    uint8_t color[PIXELS][4] = {{0}, {0}, {0}, {0}, {0}, {100, 200, 20, 255}};
    const struct scene_pictures pictures = {
        .width = WIDTH, .height = HEIGHT, .color = color[0], .tiles = tiles, .plan = plan};
    struct cli_output_raster output;
    uint16_t samples[PIXELS][3];
    rasterize(&pictures, SCENE_KIND_TILES, 0, false, &output, samples[0]);
    const uint16_t of_tiles[PIXELS][3] = {{0, 0, 0}, {58, 17, 83}, {141, 33, 41},
                                          {0, 0, 0}, {0, 0, 0},    {211, 211, 211}};
    assert_memory_equal(samples, of_tiles, sizeof of_tiles);
    assert_non_null(strstr(output.raster.comment, "white is 16"));
    rasterize(&pictures, SCENE_KIND_PLAN, 0, false, &output, samples[0]);
    const uint16_t of_plans[PIXELS][3] = {{0, 0, 0},     {41, 83, 166}, {166, 91, 17},
                                          {33, 133, 50}, {104, 87, 91}, {46, 46, 46}};
    assert_memory_equal(samples, of_plans, sizeof of_plans);
}

static void test_names_and_needs(void **state)
{
    (void)state;
    unsigned kinds = 99;
    const char *bad = NULL;
    assert_true(cli_outputs_parse("color,depth,depth", &kinds, &bad));
    assert_int_equal(kinds, 1u << SCENE_KIND_COLOR | 1u << SCENE_KIND_DEPTH);
    assert_int_equal(cli_outputs_needed(kinds, CLI_PICTURE_PNG, 0), SCENE_OUTPUT_COLOR | SCENE_OUTPUT_DEPTH);
    assert_int_equal(cli_outputs_needed(kinds, CLI_PICTURE_PPM, 16),
                     SCENE_OUTPUT_DISPLAY | SCENE_OUTPUT_DEPTH);
    assert_int_equal(cli_outputs_needed(kinds, CLI_PICTURE_EXR, 0), SCENE_OUTPUT_LINEAR | SCENE_OUTPUT_DEPTH);
    assert_int_equal(cli_outputs_needed(1u << SCENE_KIND_PLAN, CLI_PICTURE_PNG, 0),
                     SCENE_OUTPUT_PLAN | SCENE_OUTPUT_COLOR);
    assert_int_equal(cli_outputs_needed(1u << SCENE_KIND_PLAN, CLI_PICTURE_EXR, 0), SCENE_OUTPUT_PLAN);
    assert_false(cli_outputs_parse("color,dept", &kinds, &bad));
    assert_string_equal(bad, "dept");
    assert_false(cli_outputs_parse("color,", &kinds, &bad));
    assert_false(cli_outputs_parse("", &kinds, &bad));
    assert_true(cli_outputs_parse("all", &kinds, &bad));
    assert_int_equal(kinds, (1u << SCENE_KIND_OVERDRAW) - 1); // what is of the work is asked for by name
    for (int kind = 0; kind < CLI_OUTPUT_KINDS; kind++) {
        assert_true(cli_outputs_parse(scene_outputs[kind].word, &kinds, &bad));
        assert_int_equal(kinds, 1u << kind);
    }
}

// A row of the table says of the picture what its memory is.
static void test_table(void **state)
{
    (void)state;
    struct scene_pictures pictures = {0};
    uint32_t outputs = 0;
    for (int i = 0; i < SCENE_KIND_COUNT; i++) {
        const enum scene_output_kind kind = (enum scene_output_kind)i;
        const size_t element = scene_output_element(kind) == SCENE_ELEMENT_UINT8 ? 1 : 4;
        assert_int_equal((size_t)scene_output_channels(kind) * element,
                         rhw_format_size(scene_outputs[kind].format));
        assert_null(scene_picture_get(&pictures, kind)); // no two rows have one member
        scene_picture_set(&pictures, kind, &pictures);
        assert_ptr_equal(scene_picture_get(&pictures, kind), &pictures);
        assert_false(outputs & scene_outputs[kind].output);
        outputs |= scene_outputs[kind].output;
        assert_int_equal(scene_outputs[kind].is_of_work,
                         (scene_outputs[kind].output & SCENE_OUTPUT_WORK) != 0);
        assert_int_equal(scene_outputs[kind].word != NULL, scene_outputs[kind].shown != NULL);
    }
    assert_int_equal(outputs, SCENE_OUTPUT_ALL | SCENE_OUTPUT_WORK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_color),
        cmocka_unit_test(test_fine_color),
        cmocka_unit_test(test_depth_and_distance),
        cmocka_unit_test(test_depth_of_nothing_and_of_one_plane),
        cmocka_unit_test(test_vectors),
        cmocka_unit_test(test_uv),
        cmocka_unit_test(test_ids),
        cmocka_unit_test(test_overdraw),
        cmocka_unit_test(test_table),
        cmocka_unit_test(test_tiles_and_plans),
        cmocka_unit_test(test_names_and_needs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
