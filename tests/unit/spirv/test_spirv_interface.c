// SPDX-License-Identifier: MIT
// What stages pass on and where fragments take it: qualifiers, other places, samples, attachments, the second source.
#include "spirv_run.h"

#include <math.h>
#include <stddef.h>

#include "apart_frag.h"
#include "apart_vert.h"
#include "attachment_frag.h"
#include "dual_frag.h"
#include "given_vert.h"
#include "interface_frag.h"
#include "interface_vert.h"
#include "kept_blocks_vert.h"
#include "kept_many_vert.h"
#include "kept_size_vert.h"
#include "places_frag.h"
#include "places_sample_frag.h"
#include "places_vert.h"
#include "sample_frag.h"

enum { WIDTH = 16, HEIGHT = 8, PIXELS = WIDTH * HEIGHT };

// Open a rig with as many float targets as a fragment shader has, and its program.
static rhw_shader_program *open_rig(struct rig *rig, const rhw_shader *vertex, const rhw_shader *fragment,
                                    int targets)
{
    rhw_shader_program *const program = spirv_link((rhw_shader *)vertex, (rhw_shader *)fragment, NULL);
    rig_open(rig, WIDTH, HEIGHT);
    for (int i = 1; i < targets; i++) {
        rig_set_target(rig, i, RHW_FORMAT_RGBA32_FLOAT);
    }
    rig->pipeline.program = *rhw_shader_program_get(program);
    return program;
}

// Draw triangles with a frame.
static void draw_triangles(struct rig *rig, const void *vertices, size_t size, uint32_t count,
                           const struct rhw_shader_frame *frame)
{
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, size);
    rhw_pass_set_uniforms(rig->context, rig->recording, frame, sizeof *frame);
    rhw_pass_draw(rig->context, rig->recording, 0, 3 * count, 0, 1);
    rig_end(rig);
}

static void draw(struct rig *rig, const void *vertices, size_t size, const struct rhw_shader_frame *frame)
{
    draw_triangles(rig, vertices, size, 1, frame);
}

static void close_rig(struct rig *rig, rhw_shader_program *program)
{
    rig_close(rig);
    rhw_shader_program_destroy(program);
}

static void read_target(struct rig *rig, int target, float pixels[PIXELS][4])
{
    memcpy(pixels, rig_read(rig, rig->pass.colors[target].texture), sizeof(float[PIXELS][4]));
}

// A triangle over the whole target, in pixels, with its W.
static const double corners[3][2] = {{-20, -10}, {60, -10}, {-20, 50}}, corner_w[3] = {1, 2, 4};

// The weights of the corners at a place on the screen, or in space.
static void find_weights(double x, double y, bool in_space, double weights[3])
{
    weights[1] = (x + 20) / 80;
    weights[2] = (y + 10) / 60;
    weights[0] = 1 - weights[1] - weights[2];
    double sum = 0;
    for (int i = 0; i < 3 && in_space; i++) {
        weights[i] /= corner_w[i];
        sum += weights[i];
    }
    for (int i = 0; i < 3 && in_space; i++) {
        weights[i] /= sum;
    }
}

static double weighted(const double weights[3], double a, double b, double c)
{
    return weights[0] * a + weights[1] * b + weights[2] * c;
}

static void expect_near(const char *what, float value, double expected)
{
    if (!(fabs((double)value - expected) <= 1e-4 * (1 + fabs(expected)))) {
        fail_msg("%s is %g, not %g", what, (double)value, expected);
    }
}

// Qualifiers -----------------------------------------------------------------------------------------

struct interface_vertex {
    float position[4];
    int32_t whole[2];
    uint32_t positive;
    float matrix[2][2];
    float values[2];
};

// Two attributes of a matrix, and two of an array, take a number each.
static void set_interface_attributes(struct rig *rig)
{
    static const size_t offsets[7] = {
        offsetof(struct interface_vertex, position),   offsetof(struct interface_vertex, whole),
        offsetof(struct interface_vertex, positive),   offsetof(struct interface_vertex, matrix),
        offsetof(struct interface_vertex, matrix) + 8, offsetof(struct interface_vertex, values),
        offsetof(struct interface_vertex, values) + 4};
    static const enum rhw_vertex_format formats[7] = {
        RHW_VERTEX_FLOAT4, RHW_VERTEX_SINT32X2, RHW_VERTEX_UINT32X1, RHW_VERTEX_FLOAT2,
        RHW_VERTEX_FLOAT2, RHW_VERTEX_FLOAT1,   RHW_VERTEX_FLOAT1};
    for (int i = 0; i < 7; i++) {
        rig->pipeline.attributes[i] = (struct rhw_attribute){formats[i], 0, (uint32_t)offsets[i]};
    }
    rig->pipeline.attribute_count = 7;
    rig->pipeline.buffers[0].stride = sizeof(struct interface_vertex);
}

static void test_varyings_keep_their_qualifiers(void **state)
{
    (void)state;
    struct rig rig;
    rhw_shader_program *const program = open_rig(&rig, SPIRV_CREATE(interface_vert, RHW_SHADER_VERTEX),
                                                 SPIRV_CREATE(interface_frag, RHW_SHADER_FRAGMENT), 5);
    assert_true(rhw_shader_program_get(program)->writes_point_size);
    const struct rhw_shader_frame frame = {.push_size = 0};
    // The first triangle lies where no clip distance is positive.
    struct interface_vertex vertices[6] = {
        {.position = {0, 0, 0, -1}}, {.position = {1, 0, 0, -1}}, {.position = {0, 1, 0, -1}}};
    struct interface_vertex *const v = &vertices[3];
    set_interface_attributes(&rig);
    for (int i = 0; i < 3; i++) {
        v[i] = (struct interface_vertex){.whole = {-5 - i, 7 * i + 3},
                                         .positive = 11 + (uint32_t)i,
                                         .matrix = {{1, (float)(3 * i)}, {(float)i, (float)(i * i)}},
                                         .values = {(float)(2 - i), (float)(5 * i - 1)}};
        rig_place(&rig, (float)corners[i][0], (float)corners[i][1], 0.5f, (float)corner_w[i], v[i].position);
    }
    draw_triangles(&rig, vertices, sizeof vertices, 2, &frame);
    float pixels[5][PIXELS][4];
    for (int t = 0; t < 5; t++) {
        read_target(&rig, t, pixels[t]);
    }
    for (int p = 0; p < PIXELS; p++) {
        double space[3], screen[3];
        find_weights(p % WIDTH + 0.5, p / WIDTH + 0.5, true, space);
        find_weights(p % WIDTH + 0.5, p / WIDTH + 0.5, false, screen);
        double x[3], y[3];
        for (int i = 0; i < 3; i++) {
            x[i] = (double)v[i].position[0];
            y[i] = (double)v[i].position[1];
        }
        const double at_y = weighted(space, y[0], y[1], y[2]);
        expect_near("first.x", pixels[0][p][0], weighted(space, x[0], x[1], x[2]));
        expect_near("first.y", pixels[0][p][1], at_y);
        expect_near("second", pixels[0][p][2], weighted(screen, x[0], x[1], x[2]));
        expect_near("gl_ClipDistance[1]", pixels[0][p][3], 100 + weighted(space, x[0], x[1], x[2]));
        assert_memory_equal(pixels[1][p], ((const float[4]){-5, 3, -11, 11}), sizeof pixels[1][p]);
        expect_near("pair.a.y", pixels[2][p][0], weighted(space, 0, 3, 6));
        expect_near("pair.b[1]", pixels[2][p][1], weighted(space, -1, 4, 9));
        expect_near("block.plain", pixels[2][p][2], weighted(space, 0 + 2, 1 + 1, 4 + 0));
        expect_near("block.behind.y", pixels[2][p][3], at_y);
        assert_true(pixels[3][p][0] == 11 && pixels[3][p][1] == 0);
        expect_near("turned", pixels[3][p][2], weighted(space, 0, 3, 6) + weighted(space, x[0], x[1], x[2]));
        assert_true(pixels[4][p][0] == 1 && pixels[4][p][1] == 0);
        expect_near("gl_CullDistance[0]", pixels[4][p][3], 2 * weighted(space, 1, 2, 4));
        expect_near("list", pixels[3][p][3], p % WIDTH % 3 * at_y);
    }
    close_rig(&rig, program);
}

// Places ---------------------------------------------------------------------------------------------

// A triangle whose values are places in pixels, where W is 1.
static void make_places(const struct rig *rig, const double at[3][2], struct rig_vertex vertices[3])
{
    for (int i = 0; i < 3; i++) {
        const float x = (float)at[i][0], y = (float)at[i][1];
        rig_place(rig, x, y, 0.5f, 1, vertices[i].position);
        memcpy(vertices[i].value, (const float[4]){x, y, 0, 1}, sizeof vertices[i].value);
    }
}

static void test_inputs_are_taken_at_other_places(void **state)
{
    (void)state;
    struct rig rig;
    rhw_shader_program *const program = open_rig(&rig, SPIRV_CREATE(places_vert, RHW_SHADER_VERTEX),
                                                 SPIRV_CREATE(places_frag, RHW_SHADER_FRAGMENT), 4);
    const struct rhw_shader_frame frame = {.samples = 4};
    struct rig_vertex vertices[3];
    rig.pass.samples = 4;
    make_places(&rig, corners, vertices);
    draw(&rig, vertices, sizeof vertices, &frame);
    float pixels[4][PIXELS][4], position[4][2];
    for (int t = 0; t < 4; t++) {
        read_target(&rig, t, pixels[t]);
        assert_true(rhw_sample_position(4, t, position[t]));
    }
    for (int p = 0; p < PIXELS; p++) {
        const int x = p % WIDTH, y = p / WIDTH;
        static const double offsets[4] = {0.25, -0.5, -0.25, 0.5};
        for (int c = 0; c < 4; c++) {
            const double sample = (double)position[c < 2 ? 1 : x % 4][c % 2] - 0.5;
            assert_true(fabs((double)pixels[0][p][c] - offsets[c]) < 1e-4);
            assert_true(fabs((double)pixels[1][p][c] - sample) < 1e-4);
            assert_true(fabs((double)pixels[2][p][c]) < 1e-4);
        }
        assert_true(pixels[3][p][0] == vertices[0].value[0]);
        expect_near("dFdx", pixels[3][p][1], 1);
        expect_near("dFdx", pixels[3][p][2], 0);
        expect_near("by index", pixels[3][p][3], (y & 1 ? y : x) + 0.5);
    }
    close_rig(&rig, program);
}

static void test_samples_look_at_other_places(void **state)
{
    (void)state;
    struct rig rig;
    rhw_shader_program *const program = open_rig(&rig, SPIRV_CREATE(places_vert, RHW_SHADER_VERTEX),
                                                 SPIRV_CREATE(places_sample_frag, RHW_SHADER_FRAGMENT), 2);
    const struct rhw_shader_frame frame = {.samples = 4};
    struct rig_vertex vertices[3];
    rig.pass.samples = 4;
    make_places(&rig, corners, vertices);
    draw(&rig, vertices, sizeof vertices, &frame);
    float pixels[2][PIXELS][4], position[2];
    read_target(&rig, 0, pixels[0]);
    read_target(&rig, 1, pixels[1]);
    assert_true(rhw_sample_position(4, 1, position));
    const double expected[2][4] = {{0.25, -0.5, 0, 0},
                                   {(double)position[0] - 0.5, (double)position[1] - 0.5, 0, 0}};
    for (int i = 0; i < PIXELS * 8; i++) {
        const int t = i / (PIXELS * 4), p = i / 4 % PIXELS, c = i % 4;
        assert_true(fabs((double)pixels[t][p][c] - expected[t][c]) < 1e-4);
    }
    close_rig(&rig, program);
}

// Varyings are split where derivatives of some components alone are asked for, unless they become more than there may be.
static void test_derivatives_stand_apart(void **state)
{
    (void)state;
    struct rig rig;
    rhw_shader_program *const program = open_rig(&rig, SPIRV_CREATE(apart_vert, RHW_SHADER_VERTEX),
                                                 SPIRV_CREATE(apart_frag, RHW_SHADER_FRAGMENT), 1);
    const struct rhw_program *linked = rhw_shader_program_get(program);
    assert_int_equal(linked->varying_count, 6);
    assert_false(linked->writes_point_size); // it is 1
    for (int i = 0; i < 6; i++) {
        assert_int_equal(linked->varyings[i].components, i % 3 == 2 ? 2 : 1);
        assert_int_equal(linked->varyings[i].derivatives, i % 3 == 1);
    }
    const struct rhw_shader_frame frame = {.push_size = 0};
    struct rig_vertex vertices[3];
    make_places(&rig, corners, vertices);
    for (int i = 0; i < 3; i++) {
        const float x = vertices[i].value[0], y = vertices[i].value[1];
        memcpy(vertices[i].value, (const float[4]){y, 5 * x + y, x, 1}, sizeof vertices[i].value);
    }
    draw(&rig, vertices, sizeof vertices, &frame);
    float pixels[PIXELS][4];
    read_target(&rig, 0, pixels);
    for (int p = 0; p < PIXELS; p++) {
        const double x = p % WIDTH + 0.5, y = p / WIDTH + 0.5;
        expect_near("the first", pixels[p][0], 3 * y);
        expect_near("the second", pixels[p][1], 3 * (5 * x + y));
        expect_near("the third", pixels[p][2], 3 * x);
        expect_near("the derivative", pixels[p][3], 3 + 100 * 3 * 5);
    }
    const struct rhw_shader_constant many = {0, 31};
    rhw_shader_program *const whole =
        spirv_link(SPIRV_CREATE(apart_vert, RHW_SHADER_VERTEX),
                   spirv_specialize(apart_frag, sizeof apart_frag, RHW_SHADER_FRAGMENT, &many, 1), NULL);
    linked = rhw_shader_program_get(whole);
    assert_int_equal(linked->varying_count, 31);
    for (int i = 0; i < 31; i++) {
        assert_true(linked->varyings[i].components == 4 && linked->varyings[i].derivatives);
    }
    rhw_shader_program_destroy(whole);
    close_rig(&rig, program);
}

// Where a triangle covers a part of a pixel, values at its centroid are those of one of the samples, and offsets go
// from the centre. The constant tells how much of the pixel is covered.
static void test_centroids_lie_within_the_triangle(void **state)
{
    (void)state;
    static const double slope[3][2] = {{-20, -10}, {16, -10}, {-2, 50}};
    struct rig rig;
    rhw_shader_program *const program = open_rig(&rig, SPIRV_CREATE(places_vert, RHW_SHADER_VERTEX),
                                                 SPIRV_CREATE(places_frag, RHW_SHADER_FRAGMENT), 4);
    const struct rhw_shader_frame frame = {.samples = 4};
    struct rig_vertex vertices[3];
    rig.pass.samples = 4;
    make_places(&rig, slope, vertices);
    draw(&rig, vertices, sizeof vertices, &frame);
    float pixels[PIXELS][4];
    float offsets[PIXELS][4], others[PIXELS][4];
    read_target(&rig, 2, pixels);
    read_target(&rig, 0, offsets);
    read_target(&rig, 3, others);
    int moved = 0;
    for (int p = 0; p < PIXELS; p++) {
        static const float from_center[4] = {0.25f, -0.5f, -0.25f, 0.5f};
        const float covered = others[p][0] / vertices[0].value[0];
        assert_true(fabsf(pixels[p][0] - pixels[p][2]) < 1e-4f && fabsf(pixels[p][1] - pixels[p][3]) < 1e-4f);
        for (int c = 0; c < 4; c++) {
            assert_true(fabsf(offsets[p][c] - covered * from_center[c]) < 1e-4f);
        }
        moved += fabsf(pixels[p][0]) > 0.01f;
    }
    assert_in_range(moved, 4, 40);
    close_rig(&rig, program);
}

// Samples and attachments ----------------------------------------------------------------------------

static rhw_texture make_target(const struct rig *rig, int samples)
{
    rhw_texture texture;
    const struct rhw_texture_def def = {
        .width = WIDTH, .height = HEIGHT, .format = RHW_FORMAT_RGBA32_FLOAT, .samples = samples};
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void test_attachments_are_read_at_the_pixel(void **state)
{
    (void)state;
    struct rig rig;
    rhw_shader_program *const first = open_rig(&rig, SPIRV_CREATE(given_vert, RHW_SHADER_VERTEX),
                                               SPIRV_CREATE(sample_frag, RHW_SHADER_FRAGMENT), 1);
    rhw_shader_program *const second = spirv_link(SPIRV_CREATE(given_vert, RHW_SHADER_VERTEX),
                                                  SPIRV_CREATE(attachment_frag, RHW_SHADER_FRAGMENT), NULL);
    const rhw_texture target = rig.pass.colors[0].texture, parts = make_target(&rig, 4),
                      whole = make_target(&rig, 1);
    float texels[HEIGHT][WIDTH][4];
    for (int i = 0; i < PIXELS * 4; i++) {
        texels[i / 4 / WIDTH][i / 4 % WIDTH][i % 4] = (float)(i * i % 97);
    }
    assert_int_equal(rhw_texture_write(rig.context, whole, 0, texels, 0), RHW_OK);
    struct rig_vertex vertices[3];
    struct rhw_binding set[2];
    const struct rhw_shader_frame frame = {.sets = {set}, .samples = 4};
    make_places(&rig, corners, vertices);
    for (int i = 0; i < 3; i++) {
        memcpy(vertices[i].value, (const float[4]){2, 2, 2, 2}, sizeof vertices[i].value);
    }
    // Each sample gets its number, its place, and the mask of samples that it finds.
    rig.pass.samples = 4;
    rig.pass.colors[0].texture = parts;
    draw(&rig, vertices, sizeof vertices, &frame);
    assert_int_equal(rhw_binding_of_texture(rig.context, whole, (rhw_sampler){0}, &set[0]), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(rig.context, parts, (rhw_sampler){0}, &set[1]), RHW_OK);
    rig.pass.samples = 1;
    rig.pass.colors[0].texture = target;
    for (int t = 1; t < 4; t++) {
        rig_set_target(&rig, t, RHW_FORMAT_RGBA32_FLOAT);
    }
    rig.pipeline.program = *rhw_shader_program_get(second);
    draw(&rig, vertices, sizeof vertices, &frame);
    float pixels[4][PIXELS][4], position[2];
    for (int t = 0; t < 4; t++) {
        read_target(&rig, t, pixels[t]);
    }
    assert_true(rhw_sample_position(4, 2, position));
    for (int p = 0; p < PIXELS; p++) {
        const int x = p % WIDTH, y = p / WIDTH, even = x & ~1;
        const float third[4] = {4, position[0] + 2, position[1] + 2, 4 + 2};
        assert_memory_equal(pixels[1][p], third, sizeof third);
        assert_memory_equal(pixels[3][p], ((const float[4]){0}), sizeof third); // the shader masked it
        for (int c = 0; c < 4; c++) {
            assert_true(pixels[0][p][c] == 2 * texels[y][x][c]);
            assert_true(pixels[2][p][c] == texels[y][even + 1][c] - texels[y][even][c]);
        }
    }
    rhw_texture_destroy(rig.context, parts);
    rhw_texture_destroy(rig.context, whole);
    rhw_shader_program_destroy(second);
    close_rig(&rig, first);
}

// Blending -------------------------------------------------------------------------------------------

static void test_second_source_blends(void **state)
{
    (void)state;
    struct rig rig;
    rhw_shader *const fragment = SPIRV_CREATE(dual_frag, RHW_SHADER_FRAGMENT);
    const struct rhw_shader_info *const info = rhw_shader_get_info(fragment);
    assert_int_equal(info->output_count, 2);
    assert_int_equal(info->outputs[0].index, 0);
    assert_int_equal(info->outputs[1].index, 1);
    assert_int_equal(info->outputs[1].location, 0);
    rhw_shader_program *const program =
        open_rig(&rig, SPIRV_CREATE(given_vert, RHW_SHADER_VERTEX), fragment, 1);
    const struct rhw_shader_frame frame = {.push_size = 0};
    struct rig_vertex vertices[3];
    make_places(&rig, corners, vertices);
    for (int i = 0; i < 3; i++) {
        memcpy(vertices[i].value, (const float[4]){8, 8, 8, 8}, sizeof vertices[i].value);
    }
    struct rhw_color_target *const target = &rig.pipeline.targets[0];
    target->blend = true;
    target->color = target->alpha =
        (struct rhw_blend_component){RHW_BLEND_SRC1, RHW_BLEND_ONE_MINUS_SRC1, RHW_BLEND_ADD};
    draw(&rig, vertices, sizeof vertices, &frame);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int p = 0; p < PIXELS; p++) {
        assert_memory_equal(pixels[p], ((const float[4]){2, 4, 6, 8}), sizeof pixels[p]);
    }
    close_rig(&rig, program);
}

// Refusals -------------------------------------------------------------------------------------------

static void test_an_input_that_is_not_written_is_named(void **state)
{
    (void)state;
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *const vertex = SPIRV_CREATE(given_vert, RHW_SHADER_VERTEX);
    rhw_shader *const fragment = SPIRV_CREATE(interface_frag, RHW_SHADER_FRAGMENT);
    rhw_shader_program *program;
    const struct rhw_shader_program_def def = {.vertex = vertex, .fragment = fragment};
    assert_int_equal(rhw_shader_program_create(&def, &program, message), RHW_ERROR_MISUSE);
    assert_non_null(strstr(message, "location 1, component 0"));
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
}

// Want an output of transform feedback at a place.
static void expect_kept(const struct rhw_feedback_output *output, int target, uint32_t offset, int count)
{
    assert_int_equal(output->target, target);
    assert_int_equal(output->offset, offset);
    assert_int_equal(output->component_count, count);
}

static void test_many_components_are_kept(void **state)
{
    (void)state;
    rhw_shader_program *const program =
        spirv_link(SPIRV_CREATE(kept_many_vert, RHW_SHADER_VERTEX), NULL, NULL);
    const struct rhw_shader_feedback *const kept = rhw_shader_program_get_feedback(program);
    assert_int_equal(rhw_shader_program_get(program)->varying_count, 17);
    assert_int_equal(kept->output_count, 17);
    for (int i = 0; i < 16; i++) {
        expect_kept(&kept->outputs[i], 0, 16 * (uint32_t)i, 4);
    }
    expect_kept(&kept->outputs[16], 1, 0, 4);
    rhw_shader_program_destroy(program);
}

static void test_blocks_of_an_array_are_kept_apart(void **state)
{
    (void)state;
    rhw_shader_program *const program =
        spirv_link(SPIRV_CREATE(kept_blocks_vert, RHW_SHADER_VERTEX), NULL, NULL);
    const struct rhw_shader_feedback *const kept = rhw_shader_program_get_feedback(program);
    assert_int_equal(kept->output_count, 4);
    for (int i = 0; i < 2; i++) {
        expect_kept(&kept->outputs[2 * i], i + 1, 0, 4);
        expect_kept(&kept->outputs[2 * i + 1], i + 1, 20, 1);
        assert_int_equal(kept->strides[i + 1], 32);
    }
    rhw_shader_program_destroy(program);
}

static void test_a_point_size_of_1_is_kept(void **state)
{
    (void)state;
    struct rig rig;
    rhw_shader_program *const program =
        open_rig(&rig, SPIRV_CREATE(kept_size_vert, RHW_SHADER_VERTEX), NULL, 1);
    const struct rhw_shader_feedback *const kept = rhw_shader_program_get_feedback(program);
    assert_int_equal(kept->output_count, 1);
    rig.pipeline.targets[0].write_mask = RHW_WRITE_NONE;
    rig.pipeline.feedback_outputs[0] = kept->outputs[0];
    rig.pipeline.feedback_output_count = 1;
    rig.pipeline.feedback_strides[0] = kept->strides[0];
    const struct rhw_shader_frame frame = {.push_size = 0};
    struct rig_vertex vertices[3];
    make_places(&rig, corners, vertices);
    float sizes[4] = {0};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    rhw_pass_set_uniforms(rig.context, rig.recording, &frame, sizeof frame);
    rhw_pass_begin_transform_feedback(
        rig.context, rig.recording, &(struct rhw_feedback_target){.memory = sizes, .size = sizeof sizes}, 1);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    rhw_pass_end_transform_feedback(rig.context, rig.recording, NULL);
    rig_end(&rig);
    assert_memory_equal(sizes, ((const float[4]){1, 1, 1, 0}), sizeof sizes);
    close_rig(&rig, program);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_varyings_keep_their_qualifiers),
    cmocka_unit_test(test_inputs_are_taken_at_other_places),
    cmocka_unit_test(test_samples_look_at_other_places),
    cmocka_unit_test(test_derivatives_stand_apart),
    cmocka_unit_test(test_centroids_lie_within_the_triangle),
    cmocka_unit_test(test_attachments_are_read_at_the_pixel),
    cmocka_unit_test(test_second_source_blends),
    cmocka_unit_test(test_an_input_that_is_not_written_is_named),
    cmocka_unit_test(test_many_components_are_kept),
    cmocka_unit_test(test_blocks_of_an_array_are_kept_apart),
    cmocka_unit_test(test_a_point_size_of_1_is_kept),
};

const struct unit_tests test_spirv_interface = UNIT_TESTS(tests, NULL, NULL);
