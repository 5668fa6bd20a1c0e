// SPDX-License-Identifier: MIT
// Every function of the shader kit on every instruction set gives the bits of its twin for one at a time, lane by lane;
// what matrices and tables give, against plain C.
#include "float_bits.h"
#include "harness.h"
#include "isa_kit.h"

#include <float.h>
#include <math.h>
#include <string.h>

// Numbers of everyday use, of any size, and special ones.
static float random_input(uint64_t *random)
{
    static const float special[] = {0.0f, -0.0f,   1.0f,    -1.0f,   INFINITY, -INFINITY, NAN,
                                    0.5f, FLT_MIN, FLT_MAX, -1e-45f, 3.0f,     15.0f,     16.0f};
    switch (rig_random_int(random, 4)) {
    case 0: return special[rig_random_int(random, sizeof special / sizeof special[0])];
    case 1: return from_bits((uint32_t)rig_random(random));
    case 2: return rig_random_float(random, -20, 20);
    default: return rig_random_float(random, 0, 1);
    }
}

static void compare(const struct kit_function *function, uint64_t *random)
{
    rhw_float input[KIT_INPUTS], result[KIT_RESULTS];
    memset(result, 0, sizeof result);
    for (int i = 0; i < KIT_INPUTS; i++) {
        for (int lane = 0; lane < RHW_LANES; lane++) {
            input[i][lane] = random_input(random);
        }
    }
    function->lanes(input, result);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        float plain[KIT_INPUTS], one[KIT_RESULTS] = {0};
        for (int i = 0; i < KIT_INPUTS; i++) {
            plain[i] = input[i][lane];
        }
        function->one(plain, one);
        for (int i = 0; i < KIT_RESULTS; i++) {
            // Bits of a NaN are unspecified; a mask of true is one.
            if (to_bits(one[i]) != to_bits(result[i][lane]) && !(isnan(one[i]) && isnan(result[i][lane]))) {
                fail_msg("%s of %a, %a, %a: result %d is %a in a lane, %a one at a time", function->name,
                         (double)plain[0], (double)plain[1], (double)plain[2], i, (double)result[i][lane],
                         (double)one[i]);
            }
        }
    }
}

static void compare_all(const struct kit_table *table)
{
    for (int f = 0; table != NULL && f < table->count; f++) {
        uint64_t random = (uint64_t)f;
        for (int round = 0; round < 400; round++) {
            compare(&table->functions[f], &random);
        }
    }
}

static void test_one_at_a_time_gives_the_bits_of_a_lane(void **state)
{
    (void)state;
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        for (int part = 0; part < KIT_PARTS; part++) {
            compare_all(kit_table_for((enum kit_part)part, (enum rhw_isa)isa));
        }
    }
}

static void test_gather_stays_within_the_table(void **state)
{
    (void)state;
    const float table[3] = {5, 6, 7};
    const int32_t integers[3] = {-5, 6, INT32_MAX};
    const rhw_int index = {0, 2, 3, -1, INT32_MIN, INT32_MAX, 1, 0x40000000};
    const rhw_float floats = rhw_gather(table, 3, index);
    const rhw_int ints = rhw_gather_int(integers, 3, index), none = rhw_gather_int(NULL, 0, index);
    static const float expected[RHW_LANES] = {5, 7, 0, 0, 0, 0, 6, 0};
    static const int32_t expected_int[RHW_LANES] = {-5, INT32_MAX, 0, 0, 0, 0, 6, 0};
    for (int i = 0; i < RHW_LANES; i++) {
        assert_true(floats[i] == expected[i]);
        assert_int_equal(ints[i], expected_int[i]);
        assert_int_equal(none[i], 0);
    }
}

// Column by column: the translation is the last four.
static void test_matrices_stand_column_by_column(void **state)
{
    (void)state;
    static const float m4[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
    static const float m3[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    const rhw_float v[4] = {rhw_splat(1), rhw_splat(10), rhw_splat(100), rhw_splat(1000)};
    rhw_float whole[4], point[4], direction[3], three[3];
    rhw_mat4_mul_vec4(m4, v, whole);
    rhw_mat4_mul_point(m4, v, point);
    rhw_mat4_mul_direction(m4, v, direction);
    rhw_mat3_mul_vec3(m3, v, three);
    for (int r = 0; r < 4; r++) {
        const float sum = m4[r] + 10 * m4[4 + r] + 100 * m4[8 + r];
        assert_true(whole[r][r] == sum + 1000 * m4[12 + r]);
        assert_true(point[r][r] == sum + m4[12 + r]);
        if (r < 3) {
            assert_true(direction[r][r] == sum);
            assert_true(three[r][r] == m3[r] + 10 * m3[3 + r] + 100 * m3[6 + r]);
        }
    }
    rhw_float own[4] = {v[0], v[1], v[2], v[3]};
    rhw_mat4_mul_vec4(m4, own, own);
    assert_memory_equal(own, whole, sizeof own);
}

static void test_vectors_of_two_and_four(void **state)
{
    (void)state;
    const rhw_float a[4] = {rhw_splat(3), rhw_splat(-4), rhw_splat(12), rhw_splat(84)};
    rhw_float unit[4];
    assert_true(rhw_length2(a)[1] == 5 && rhw_length3(a)[2] == 13 && rhw_length4(a)[3] == 85);
    rhw_normalize2(a, unit);
    assert_true(fabsf(unit[0][0] - 0.6f) < 1e-7f && fabsf(unit[1][7] + 0.8f) < 1e-7f);
    rhw_normalize4(a, unit);
    assert_true(fabsf(unit[3][0] - 84.0f / 85) < 1e-7f);
    const rhw_float up[2] = {rhw_splat(0), rhw_splat(1)};
    rhw_reflect2(a, up, unit);
    assert_true(unit[0][4] == 3 && unit[1][4] == 4);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_one_at_a_time_gives_the_bits_of_a_lane),
    cmocka_unit_test(test_gather_stays_within_the_table),
    cmocka_unit_test(test_matrices_stand_column_by_column),
    cmocka_unit_test(test_vectors_of_two_and_four),
};

const struct unit_tests test_shader_kit = UNIT_TESTS(tests, NULL, NULL);
