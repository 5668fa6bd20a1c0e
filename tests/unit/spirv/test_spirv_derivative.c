// SPDX-License-Identifier: MIT
// Derivatives by the rule of Vulkan's conformance suite (dEQP-VK.glsl.derivate, highp): a result may differ from the
// difference of the values of two pixels by what their subtraction cancels, and 3 bits more. The values are those of the
// suite too: 99×133 pixels, varyings from −97 to 76.
#include <math.h>

#include "derivative_frag.h"
#include "derivative_vert.h"
#include "pairs_frag.h"
#include "spirv_run.h"

enum { WIDTH = 99, HEIGHT = 133 };
enum { VARYING, LINEAR, NEAREST, SQUARE, WIDTHS, FINE, NESTED, BRANCHES, LEVELS };

static const float low[4] = {-97, 0.2f, 71, 74}, high[4] = {-13.2f, -77, 44, 76};

struct bench {
    struct rig rig;
    rhw_texture image;
    rhw_sampler sampler;
    struct rhw_binding binding;
    const float (*pixels)[4];
};

// The value of a component at a pixel, where W is `w` times as large at the right edge as at the left. The corners are
// those of a rectangle in space that is seen at an angle.
static double value_at(int x, int y, int component, double w)
{
    const double a = (x + 0.5) / WIDTH, along = a / w / (1 - a + a / w), here = 1 + along * (w - 1);
    const double down = (1 - (1 - 2 * (y + 0.5) / HEIGHT) * here / w) / 2;
    const double parts[4] = {along, down, (along + down) / 2, 1 - (along + down) / 2};
    return (double)low[component] + ((double)high[component] - (double)low[component]) * parts[component];
}

static void make_image(struct bench *bench)
{
    static float texels[HEIGHT][WIDTH][4];
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            for (int c = 0; c < 4; c++) {
                texels[y][x][c] = (float)value_at(x, y, c, 1);
            }
        }
    }
    const struct rhw_texture_def texture = {.format = RHW_FORMAT_RGBA32_FLOAT,
                                            .width = WIDTH,
                                            .height = HEIGHT,
                                            .mip_levels = RHW_MIP_LEVELS_ALL};
    struct rhw_sampler_def sampler = rhw_sampler_def_default();
    sampler.min_filter = sampler.mag_filter = RHW_FILTER_NEAREST;
    sampler.mip_filter = RHW_MIP_FILTER_NEAREST;
    rhw_context *const context = bench->rig.context;
    assert_int_equal(rhw_texture_create(context, &texture, &bench->image), RHW_OK);
    assert_int_equal(rhw_sampler_create(context, &sampler, &bench->sampler), RHW_OK);
    assert_int_equal(rhw_texture_write(context, bench->image, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_texture_generate_mips(context, bench->image), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(context, bench->image, bench->sampler, &bench->binding), RHW_OK);
}

static void open_bench(struct bench *bench)
{
    rig_open(&bench->rig, WIDTH, HEIGHT);
    bench->rig.pipeline.topology = RHW_TRIANGLE_STRIP;
    make_image(bench);
}

static void close_bench(struct bench *bench)
{
    rhw_sampler_destroy(bench->rig.context, bench->sampler);
    rhw_texture_destroy(bench->rig.context, bench->image);
    rig_close(&bench->rig);
}

static rhw_shader *create(const uint32_t *words, size_t size, enum rhw_shader_stage stage, uint32_t which,
                          bool along_y)
{
    const struct rhw_shader_constant constants[] = {{0, which}, {1, along_y ? 1 : 0}};
    const struct rhw_shader_def def = {.stage = stage, .constants = constants, .constant_count = 2};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    if (rhw_shader_create(words, size, &def, &shader, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    return shader;
}

static void draw(struct bench *bench, uint32_t which, bool along_y, float w)
{
    rhw_shader *const vertex =
        create(derivative_vert, sizeof derivative_vert, RHW_SHADER_VERTEX, which, along_y);
    rhw_shader *const fragment =
        create(derivative_frag, sizeof derivative_frag, RHW_SHADER_FRAGMENT, which, along_y);
    const struct rhw_shader_program_def def = {.vertex = vertex, .fragment = fragment};
    rhw_shader_program *program;
    assert_int_equal(rhw_shader_program_create(&def, &program, NULL), RHW_OK);
    struct rig *const rig = &bench->rig;
    struct rig_vertex corners[4];
    for (int i = 0; i < 4; i++) {
        const float x = (float)(i & 1), y = (float)(i >> 1), here = i & 1 ? w : 1;
        corners[i] = (struct rig_vertex){{(2 * x - 1) * here, (1 - 2 * y) * w, 0, here}, {x, y, 0, 0}};
    }
    const float one = 1;
    const struct rhw_shader_frame frame = {
        .sets = {&bench->binding}, .push_constants = &one, .push_size = sizeof one};
    spirv_draw(rig, program, corners, 4, &frame);
    bench->pixels = rig_read_float4(rig);
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
}

// What two values that are subtracted may lose (getDerivateThreshold of the suite).
static double threshold(double a, double b, double difference)
{
    int at_a, at_b, at;
    (void)frexp(a, &at_a);
    (void)frexp(b, &at_b);
    (void)frexp(difference, &at);
    const int most = at_a > at_b ? at_a : at_b, lost = most - (most < at ? most : at);
    const int bits = 23 - lost - 3 > 0 ? 23 - lost - 3 : 0;
    return ldexp((double)((1 << (23 - bits)) - 1) / 8388608.0, at - 1);
}

// The difference that a pixel sees in its quad, of values or of their squares.
static double difference(int x, int y, int component, bool along_y, double w, bool is_square)
{
    const bool is_odd = (along_y ? y : x) & 1;
    double here = value_at(x, y, component, w);
    double there = value_at(along_y ? x : x ^ 1, along_y ? y ^ 1 : y, component, w);
    here = is_square ? here * here : here;
    there = is_square ? there * there : there;
    return is_odd ? here - there : there - here;
}

// Every pixel whose quad is inside has that derivative.
static void expect(const struct bench *bench, uint32_t which, bool along_y, double w, bool is_square)
{
    for (int y = 0; y < HEIGHT - 1; y++) {
        for (int x = 0; x < WIDTH - 1; x++) {
            for (int c = 0; c < 4; c++) {
                const double want = difference(x, y, c, along_y, w, is_square);
                const double a = (double)low[c] * (is_square ? (double)low[c] : 1),
                             b = (double)high[c] * (is_square ? (double)high[c] : 1);
                const double got = (double)bench->pixels[y * WIDTH + x][c];
                if (!(fabs(got - want) <= threshold(a, b, want))) {
                    fail_msg("derivative %u along %s at %d, %d, component %d: %g instead of %g, threshold %g",
                             (unsigned)which, along_y ? "y" : "x", x, y, c, got, want, threshold(a, b, want));
                }
            }
        }
    }
}

static void test_differences_are_within_the_threshold(void **state)
{
    static const uint32_t linear[] = {VARYING, LINEAR, NEAREST, FINE};
    struct bench bench;
    (void)state;
    open_bench(&bench);
    for (int along_y = 0; along_y < 2; along_y++) {
        for (size_t i = 0; i < sizeof linear / sizeof *linear; i++) {
            draw(&bench, linear[i], along_y, 1);
            expect(&bench, linear[i], along_y, 1, false);
        }
        draw(&bench, SQUARE, along_y, 1);
        expect(&bench, SQUARE, along_y, 1, true);
    }
    close_bench(&bench);
}

static void test_perspective_is_within_the_threshold(void **state)
{
    struct bench bench;
    (void)state;
    open_bench(&bench);
    for (int along_y = 0; along_y < 2; along_y++) {
        draw(&bench, LINEAR, along_y, 3);
        expect(&bench, LINEAR, along_y, 3, false);
        draw(&bench, SQUARE, along_y, 3);
        expect(&bench, SQUARE, along_y, 3, true);
    }
    close_bench(&bench);
}

// fwidth is the sum of both magnitudes: without one of them, the other is left.
static void test_widths(void **state)
{
    struct bench bench;
    (void)state;
    open_bench(&bench);
    for (int along_y = 0; along_y < 2; along_y++) {
        draw(&bench, WIDTHS, along_y, 1);
        for (int i = 0; i < WIDTH * (HEIGHT - 1); i++) {
            for (int c = 0; c < 4; c++) {
                const int x = i % WIDTH, y = i / WIDTH;
                const double want = fabs(difference(x, y, c, along_y, 1, false));
                if (x < WIDTH - 1 && !(fabs((double)bench.pixels[i][c] - want) <= 2e-4)) {
                    fail_msg("width at %d, %d: %g instead of %g", x, y, (double)bench.pixels[i][c], want);
                }
            }
        }
    }
    close_bench(&bench);
}

// A derivative is one number for the quad, so its own derivative is 0. A lane that takes a branch sees its partner's
// values as they would be in that branch.
static void test_nested_and_in_branches(void **state)
{
    struct bench bench;
    (void)state;
    open_bench(&bench);
    for (int along_y = 0; along_y < 2; along_y++) {
        draw(&bench, NESTED, along_y, 1);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            assert_memory_equal(bench.pixels[i], ((const float[4]){0}), sizeof *bench.pixels);
        }
        draw(&bench, BRANCHES, along_y, 1);
        for (int i = 0; i < WIDTH * (HEIGHT - 1); i++) {
            const int x = i % WIDTH, y = i / WIDTH;
            const double part = 7 * (x + 0.5) / WIDTH - floor(7 * (x + 0.5) / WIDTH);
            const bool is_square = part <= 0.5;
            const double want = difference(x, y, 0, along_y, 1, is_square);
            if (x < WIDTH - 1 && fabs(part - 0.5) > 1e-3 &&
                !(fabs((double)bench.pixels[i][0] - want) <= 0.01)) {
                fail_msg("in a branch at %d, %d: %g instead of %g", x, y, (double)bench.pixels[i][0], want);
            }
        }
    }
    close_bench(&bench);
}

static void test_levels_follow_from_derivatives(void **state)
{
    struct bench bench;
    (void)state;
    open_bench(&bench);
    int smaller = 0;
    draw(&bench, LEVELS, false, 1);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_memory_equal(bench.pixels[i], ((const float[3]){0}), 3 * sizeof(float));
        smaller += bench.pixels[i][3] != 0;
    }
    assert_true(smaller > WIDTH * HEIGHT / 10); // where another level than the first is read
    close_bench(&bench);
}

static char printed[1 << 17];

static void keep(void *user, const char *text, size_t size)
{
    size_t *const length = user;
    assert_true(*length + size < sizeof printed);
    memcpy(printed + *length, text, size);
    *length += size;
    printed[*length] = 0;
}

// What gradients alone need is computed behind a question to the sampler: here, all that there is of partner pixels.
static void test_gradients_are_asked_for(void **state)
{
    (void)state;
    const struct rhw_shader_constant which = {0, LEVELS};
    const struct rhw_shader_def def = {
        .stage = RHW_SHADER_FRAGMENT, .constants = &which, .constant_count = 1};
    size_t length = 0;
    assert_int_equal(rhw_shader_print(derivative_frag, sizeof derivative_frag, &def, RHW_SHADER_PASSED, keep,
                                      &length, NULL),
                     RHW_OK);
    int partners = 0;
    bool is_asked = false;
    assert_non_null(strstr(printed, "= needs_gradient "));
    for (const char *line = strtok(printed, "\n"); line; line = strtok(NULL, "\n")) {
        is_asked =
            strstr(line, " if u") || strncmp(line, "if u", 4) == 0 || (is_asked && !strstr(line, "end_if"));
        const bool is_partner = strstr(line, "= input_be") || strstr(line, "gl_FragCoord");
        assert_true(is_asked || !is_partner);
        partners += is_partner;
    }
    assert_int_equal(partners, 6);
}

// A shader with many textures and samplers asks for some of their pairs, and computes the other gradients.
static void test_pairs_are_bounded(void **state)
{
    (void)state;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_FRAGMENT};
    size_t length = 0;
    assert_int_equal(
        rhw_shader_print(pairs_frag, sizeof pairs_frag, &def, RHW_SHADER_PASSED, keep, &length, NULL),
        RHW_OK);
    int pairs = 0;
    for (const char *place = strstr(printed, "= needs_gradient "); place;
         place = strstr(place + 1, "= needs_gradient ")) {
        pairs++;
    }
    assert_int_equal(pairs, 64);
}

// A sampler of one level gives the same without a gradient.
static void test_one_level_needs_no_gradient(void **state)
{
    struct bench bench;
    (void)state;
    open_bench(&bench);
    rhw_context *const context = bench.rig.context;
    const struct rhw_sampler_def def = {.mip_filter = RHW_MIP_FILTER_NONE};
    rhw_sampler plain;
    assert_int_equal(rhw_sampler_create(context, &def, &plain), RHW_OK);
    assert_true(rhw_binding_sample_needs_gradient(&bench.binding, &bench.binding));
    assert_int_equal(rhw_binding_of_texture(context, bench.image, plain, &bench.binding), RHW_OK);
    assert_false(rhw_binding_sample_needs_gradient(&bench.binding, &bench.binding));
    draw(&bench, LEVELS, false, 1);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_memory_equal(bench.pixels[i], ((const float[4]){0}), sizeof *bench.pixels);
    }
    rhw_sampler_destroy(context, plain);
    close_bench(&bench);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_differences_are_within_the_threshold),
    cmocka_unit_test(test_perspective_is_within_the_threshold),
    cmocka_unit_test(test_widths),
    cmocka_unit_test(test_nested_and_in_branches),
    cmocka_unit_test(test_levels_follow_from_derivatives),
    cmocka_unit_test(test_gradients_are_asked_for),
    cmocka_unit_test(test_pairs_are_bounded),
    cmocka_unit_test(test_one_level_needs_no_gradient),
};

const struct unit_tests test_spirv_derivative = UNIT_TESTS(tests, NULL, NULL);
