// SPDX-License-Identifier: MIT
// Duals: the value has the bits of the plain function, and the change is the directional derivative of the formula in
// long double, found by central differences; a texture sampled at computed coordinates gets the level of detail that
// the gradient worked out by hand gives.
#include "harness.h"
#include "isa_kit.h"

#include <rhw/shader_dual.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_INPUTS = 8 };

typedef long double formula(const long double *a);

static long double f_neg(const long double *a)
{
    return -a[0];
}
static long double f_add(const long double *a)
{
    return a[0] + a[1];
}
static long double f_sub(const long double *a)
{
    return a[0] - a[1];
}
static long double f_mul(const long double *a)
{
    return a[0] * a[1];
}
static long double f_div(const long double *a)
{
    return a[0] / a[1];
}
static long double f_abs(const long double *a)
{
    return fabsl(a[0]);
}
static long double f_min(const long double *a)
{
    return fminl(a[0], a[1]);
}
static long double f_max(const long double *a)
{
    return fmaxl(a[0], a[1]);
}
static long double f_clamp(const long double *a)
{
    return fminl(fmaxl(a[0], a[1]), a[2]);
}
static long double f_saturate(const long double *a)
{
    return fminl(fmaxl(a[0], 0), 1);
}
static long double f_fract(const long double *a)
{
    return a[0] - floorl(a[0]);
}
static long double f_mix(const long double *a)
{
    return a[0] + (a[1] - a[0]) * a[2];
}
static long double f_sqrt(const long double *a)
{
    return sqrtl(a[0]);
}
static long double f_rsqrt(const long double *a)
{
    return 1 / sqrtl(a[0]);
}
static long double f_exp2(const long double *a)
{
    return exp2l(a[0]);
}
static long double f_exp(const long double *a)
{
    return expl(a[0]);
}
static long double f_log2(const long double *a)
{
    return log2l(a[0]);
}
static long double f_log(const long double *a)
{
    return logl(a[0]);
}
static long double f_pow(const long double *a)
{
    return powl(a[0], a[1]);
}
static long double f_sin(const long double *a)
{
    return sinl(a[0]);
}
static long double f_cos(const long double *a)
{
    return cosl(a[0]);
}
static long double f_tan(const long double *a)
{
    return tanl(a[0]);
}
static long double f_atan2(const long double *a)
{
    return atan2l(a[0], a[1]);
}
static long double f_atan(const long double *a)
{
    return atanl(a[0]);
}
static long double f_asin(const long double *a)
{
    return asinl(a[0]);
}
static long double f_acos(const long double *a)
{
    return acosl(a[0]);
}

static long double f_smoothstep(const long double *a)
{
    const long double t = fminl(fmaxl((a[2] - a[0]) / (a[1] - a[0]), 0), 1);
    return t * t * (3 - 2 * t);
}

static long double dot(int count, const long double *a, const long double *b)
{
    long double sum = 0;
    for (int i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

static long double f_dot2(const long double *a)
{
    return dot(2, a, a + 2);
}
static long double f_dot3(const long double *a)
{
    return dot(3, a, a + 3);
}
static long double f_dot4(const long double *a)
{
    return dot(4, a, a + 4);
}
static long double f_length2(const long double *a)
{
    return sqrtl(dot(2, a, a));
}
static long double f_length3(const long double *a)
{
    return sqrtl(dot(3, a, a));
}
static long double f_length4(const long double *a)
{
    return sqrtl(dot(4, a, a));
}
// The first component of vectors.
static long double f_normalize2(const long double *a)
{
    return a[0] / sqrtl(dot(2, a, a));
}
static long double f_normalize3(const long double *a)
{
    return a[0] / sqrtl(dot(3, a, a));
}
static long double f_normalize4(const long double *a)
{
    return a[0] / sqrtl(dot(4, a, a));
}
static long double f_cross(const long double *a)
{
    return a[1] * a[5] - a[2] * a[4];
}
static long double f_reflect2(const long double *a)
{
    return a[0] - 2 * dot(2, a, a + 2) * a[2];
}
static long double f_reflect3(const long double *a)
{
    return a[0] - 2 * dot(3, a, a + 3) * a[3];
}

static const struct {
    const char *name; ///< in the kit's table
    formula *exact;
    int inputs;
    float low, high; ///< of all inputs
} rows[] = {
    {"dual_neg", f_neg, 1, -9, 9},
    {"dual_add", f_add, 2, -9, 9},
    {"dual_sub", f_sub, 2, -9, 9},
    {"dual_mul", f_mul, 2, -9, 9},
    {"dual_div", f_div, 2, 0.1f, 9},
    {"dual_abs", f_abs, 1, -9, 9},
    {"dual_min", f_min, 2, -9, 9},
    {"dual_max", f_max, 2, -9, 9},
    {"dual_clamp", f_clamp, 3, -9, 9},
    {"dual_saturate", f_saturate, 1, -1, 2},
    {"dual_fract", f_fract, 1, -9, 9},
    {"dual_mix", f_mix, 3, -9, 9},
    {"dual_sqrt", f_sqrt, 1, 0.01f, 9},
    {"dual_rsqrt", f_rsqrt, 1, 0.01f, 9},
    {"dual_exp2", f_exp2, 1, -20, 20},
    {"dual_exp", f_exp, 1, -20, 20},
    {"dual_log2", f_log2, 1, 0.01f, 99},
    {"dual_log", f_log, 1, 0.01f, 99},
    {"dual_pow", f_pow, 2, 0.1f, 5},
    {"dual_sincos", f_sin, 1, -9, 9},
    {"dual_sin", f_sin, 1, -9, 9},
    {"dual_cos", f_cos, 1, -9, 9},
    {"dual_tan", f_tan, 1, -1.5f, 1.5f},
    {"dual_atan2", f_atan2, 2, -9, 9},
    {"dual_atan", f_atan, 1, -9, 9},
    {"dual_asin", f_asin, 1, -0.999f, 0.999f},
    {"dual_acos", f_acos, 1, -0.999f, 0.999f},
    {"dual_smoothstep", f_smoothstep, 3, -2, 2},
    {"dual_dot2", f_dot2, 4, -9, 9},
    {"dual_dot3", f_dot3, 6, -9, 9},
    {"dual_dot4", f_dot4, 8, -9, 9},
    {"dual_length2", f_length2, 2, -9, 9},
    {"dual_length3", f_length3, 3, -9, 9},
    {"dual_length4", f_length4, 4, -9, 9},
    {"dual_normalize2", f_normalize2, 2, -9, 9},
    {"dual_normalize3", f_normalize3, 3, -9, 9},
    {"dual_normalize4", f_normalize4, 4, -9, 9},
    {"dual_cross", f_cross, 6, -9, 9},
    {"dual_reflect2", f_reflect2, 4, -1, 1},
    {"dual_reflect3", f_reflect3, 6, -1, 1},
};

static const struct kit_function *find(const char *name)
{
    for (int part = 0; part < KIT_PARTS; part++) {
        const struct kit_table *const table = kit_table_for((enum kit_part)part, RHW_ISA_BASELINE);
        for (int i = 0; i < table->count; i++) {
            if (strcmp(table->functions[i].name, name) == 0) {
                return &table->functions[i];
            }
        }
    }
    fail_msg("%s is in no table", name);
    return NULL;
}

// d/dt of exact(a + t · along) at 0; NaN within reach of a corner or a jump, where both sides differ.
static long double directional(formula *exact, int inputs, const long double *a, const long double *along)
{
    const long double step = 0x1p-22L;
    long double side[2], points[3];
    for (int i = -1; i <= 1; i++) {
        long double moved[MOST_INPUTS];
        for (int k = 0; k < inputs; k++) {
            moved[k] = a[k] + (long double)i * step * along[k];
        }
        points[i + 1] = exact(moved);
    }
    side[0] = (points[1] - points[0]) / step;
    side[1] = (points[2] - points[1]) / step;
    const long double middle = (side[0] + side[1]) / 2;
    return fabsl(side[0] - side[1]) > 0.01L * (1 + fabsl(middle)) ? (long double)NAN : middle;
}

// The worst error of a row, in units of 2^-24 of the largest of the terms that its derivative is the sum of.
static double measure(int row, int *compared)
{
    const struct kit_function *const function = find(rows[row].name);
    uint64_t random = (uint64_t)row;
    double worst = 0;
    for (int round = 0; round < 4000; round++) {
        float input[KIT_INPUTS] = {0}, result[KIT_RESULTS] = {0};
        long double a[MOST_INPUTS], along[2][MOST_INPUTS];
        for (int k = 0; k < rows[row].inputs; k++) {
            input[3 * k] = rig_random_float(&random, rows[row].low, rows[row].high);
            for (int axis = 0; axis < 2; axis++) {
                input[3 * k + 1 + axis] = rig_random_float(&random, -1, 1);
                along[axis][k] = (long double)input[3 * k + 1 + axis];
            }
            a[k] = (long double)input[3 * k];
        }
        function->one(input, result);
        for (int axis = 0; axis < 2; axis++) {
            const long double truth = directional(rows[row].exact, rows[row].inputs, a, along[axis]);
            long double scale = fabsl(truth);
            for (int k = 0; k < rows[row].inputs; k++) {
                long double alone[MOST_INPUTS] = {0};
                alone[k] = along[axis][k];
                const long double part = fabsl(directional(rows[row].exact, rows[row].inputs, a, alone));
                scale = part > scale ? part : scale;
            }
            if (isnan(truth) || isnan(scale)) {
                continue;
            }
            (*compared)++;
            const double error = (double)(fabsl((long double)result[1 + axis] - truth) / (scale + 1e-7L));
            worst = error > worst ? error : worst;
        }
    }
    return worst * 0x1p24;
}

static void test_changes_are_the_derivatives(void **state)
{
    (void)state;
    int failures = 0;
    for (size_t row = 0; row < sizeof rows / sizeof rows[0]; row++) {
        int compared = 0;
        const double worst = measure((int)row, &compared);
        print_message("%-16s %6.2f · 2^-24 of the largest term\n", rows[row].name, worst);
        // Near its upper edge 1 − t has lost digits of t.
        const double limit = rows[row].exact == f_smoothstep ? 1000 : 16;
        failures += !(worst < limit) || compared < 6000;
    }
    assert_int_equal(failures, 0);
}

// The value of rhw_dual_name has the bits of rhw_name: the rows that both tables have with the same inputs.
static void test_values_have_the_bits_of_the_plain_function(void **state)
{
    (void)state;
    static const char *const names[] = {
        "abs",  "min", "max", "clamp", "saturate", "fract", "mix",   "sqrt", "rsqrt", "exp2", "exp",
        "log2", "log", "pow", "sin",   "cos",      "tan",   "atan2", "atan", "asin",  "acos", "smoothstep"};
    for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
        char dual_name[32];
        snprintf(dual_name, sizeof dual_name, "dual_%s", names[n]);
        const struct kit_function *const one = find(names[n]), *const dual = find(dual_name);
        uint64_t random = n;
        for (int round = 0; round < 2000; round++) {
            float input[KIT_INPUTS] = {0}, duals[KIT_INPUTS] = {0};
            float expected[KIT_RESULTS] = {0}, result[KIT_RESULTS] = {0};
            for (int k = 0; k < 3; k++) {
                input[k] = duals[3 * k] = rig_random_float(&random, -2, 2);
                duals[3 * k + 1] = rig_random_float(&random, -2, 2);
            }
            one->one(input, expected);
            dual->one(duals, result);
            if (memcmp(&expected[0], &result[0], sizeof(float)) != 0 &&
                !(isnan(expected[0]) && isnan(result[0]))) {
                fail_msg("%s(%a, %a, %a) is %a, as a dual %a", names[n], (double)input[0], (double)input[1],
                         (double)input[2], (double)expected[0], (double)result[0]);
            }
        }
    }
}

static void test_constant_exponents_allow_any_base(void **state)
{
    (void)state;
    const struct rhw_dual1 minus = rhw_dual_make1(-3, 2, 0), nothing = rhw_dual_make1(0, 5, -1);
    assert_true(rhw_dual_pow1(minus, 2.0f).ddx == -12);
    assert_true(rhw_dual_pow1(nothing, 2.0f).ddx == 0 && rhw_dual_pow1(nothing, 1.0f).ddy == -1);
    assert_true(rhw_dual_pow1(nothing, 0.0f).value == 1 && rhw_dual_pow1(nothing, 0.0f).ddx == 0);
}

// Texture coordinates ----------------------------------------------------------------------------------

// u = x² + y, v = x · y / (2 + x) of the varyings x, y, and their derivatives by hand.
static void sample_by_hand(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float x = f->varying[0], y = f->varying[1], below = 2.0f + x;
        const rhw_float uv[2] = {x * x + y, x * y / below};
        const rhw_float v = uv[1], *const dx = f->ddx, *const dy = f->ddy;
        const rhw_float grad[4] = {
            (dx[0] * x + x * dx[0]) + dx[1], (dx[0] * y + x * dx[1] - v * dx[0]) / below,
            (dy[0] * x + x * dy[0]) + dy[1], (dy[0] * y + x * dy[1] - v * dy[0]) / below};
        rhw_sample_grad(f->bindings, 0, uv, grad, f->color[0]);
    }
}

static void sample_by_duals(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const struct rhw_dual x = rhw_dual_varying(f, 0), y = rhw_dual_varying(f, 1);
        const struct rhw_dual uv[2] = {rhw_dual_add(rhw_dual_mul(x, x), y),
                                       rhw_dual_div(rhw_dual_mul(x, y), rhw_dual_offset(x, 2.0f))};
        rhw_sample_dual(f->bindings, 0, uv, f->color[0]);
    }
}

static void sample_one_at_a_time(struct rhw_fragment1 *f)
{
    const struct rhw_dual1 x = rhw_dual_varying1(f, 0), y = rhw_dual_varying1(f, 1);
    const struct rhw_dual1 uv[2] = {rhw_dual_add1(rhw_dual_mul1(x, x), y),
                                    rhw_dual_div1(rhw_dual_mul1(x, y), rhw_dual_offset1(x, 2.0f))};
    rhw_sample_dual1(f->bindings, 0, uv, f->color[0]);
}

static rhw_texture make_noise(struct rig *rig)
{
    static unsigned char texels[64][64][4];
    uint64_t random = 3;
    for (int i = 0; i < 64 * 64; i++) {
        const uint64_t bits = rig_random(&random);
        memcpy(texels[i / 64][i % 64], &bits, 4);
    }
    struct rhw_texture_def def = rhw_texture_def_default();
    def.width = def.height = 64;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    rhw_texture_write(rig->context, texture, 0, texels, 0);
    assert_int_equal(rhw_texture_generate_mips(rig->context, texture), RHW_OK);
    return texture;
}

static void draw_sampled(rhw_fragment_function *fragment, rhw_fragment1_function *fragment1,
                         float result[64 * 64][4])
{
    static const struct rig_vertex triangle[3] = {
        {{-1, -1, 0, 1}, {0, 0, 0, 0}}, {{3, -1, 0, 1}, {4, 0.5f, 0, 0}}, {{-4, 12, 0, 4}, {-1, 6, 0, 0}}};
    struct rig rig;
    rig_open(&rig, 64, 64);
    rig.pipeline.program.varyings[0].derivatives = true;
    memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
    rig.pipeline.program.fragment[0] = fragment;
    rig.pipeline.program.fragment1 = fragment1;
    const struct rhw_sampler_def def = rhw_sampler_def_default();
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &def, &sampler), RHW_OK);
    const rhw_texture noise = make_noise(&rig);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, noise, sampler);
    rig_draw(&rig, triangle, 3);
    rig_end(&rig);
    memcpy(result, rig_read_float4(&rig), sizeof(float[64 * 64][4]));
    rig_close(&rig);
}

static void test_a_texture_gets_the_gradient_made_by_hand(void **state)
{
    (void)state;
    static float by_hand[64 * 64][4], by_duals[64 * 64][4], one[64 * 64][4];
    draw_sampled(sample_by_hand, NULL, by_hand);
    draw_sampled(sample_by_duals, NULL, by_duals);
    draw_sampled(NULL, sample_one_at_a_time, one);
    assert_true(by_hand[64 * 40 + 8][0] > 0 && by_hand[64 * 40 + 8][0] != by_hand[64 * 40 + 9][0]);
    assert_memory_equal(by_hand, by_duals, sizeof by_hand);
    assert_memory_equal(by_hand, one, sizeof by_hand);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_changes_are_the_derivatives),
    cmocka_unit_test(test_values_have_the_bits_of_the_plain_function),
    cmocka_unit_test(test_constant_exponents_allow_any_base),
    cmocka_unit_test(test_a_texture_gets_the_gradient_made_by_hand),
};

const struct unit_tests test_shader_dual = UNIT_TESTS(tests, NULL, NULL);
