// SPDX-License-Identifier: MIT
// Subgroups are 8 invocations that follow one another. Each operation is held to a sum, a shuffle or a vote that is done
// here one lane after the other.
#include "spirv_run.h"

#include "elected_frag.h"
#include "plain_vert.h"
#include "subgroups_comp.h"

enum { LANES = 21, ROW = 24, BUILT_INS = 6, MAX_RESULTS = 64 };

static uint32_t source[LANES], results[MAX_RESULTS * ROW];

static uint32_t bits_of(float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static float float_of(uint32_t bits)
{
    float number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static float number_of(int i)
{
    const float product = (float)source[i] * 0.37f;
    return product - 9.0f;
}

static bool takes_part(int i)
{
    return i >= 0 && i < LANES && (source[i] & 3) != 1;
}

// Return the value in a lane of the subgroup of `i`, or 0 where that takes no part.
static uint32_t in_lane(int i, unsigned lane)
{
    const int other = (i & ~7) + (int)lane;
    return lane < 8 && takes_part(other) ? source[other] : 0;
}

static uint32_t add_float(uint32_t a, uint32_t b)
{
    return bits_of(float_of(a) + float_of(b));
}
static uint32_t multiply_float(uint32_t a, uint32_t b)
{
    return bits_of(float_of(a) * float_of(b));
}
static uint32_t least_float(uint32_t a, uint32_t b)
{
    return float_of(b) < float_of(a) ? b : a;
}
static uint32_t greatest_float(uint32_t a, uint32_t b)
{
    return float_of(a) < float_of(b) ? b : a;
}
static uint32_t add(uint32_t a, uint32_t b)
{
    return a + b;
}
static uint32_t multiply(uint32_t a, uint32_t b)
{
    return a * b;
}
static uint32_t least_int(uint32_t a, uint32_t b)
{
    return (int32_t)b < (int32_t)a ? b : a;
}
static uint32_t greatest_int(uint32_t a, uint32_t b)
{
    return (int32_t)a < (int32_t)b ? b : a;
}
static uint32_t least(uint32_t a, uint32_t b)
{
    return b < a ? b : a;
}
static uint32_t greatest(uint32_t a, uint32_t b)
{
    return a < b ? b : a;
}
static uint32_t all_bits(uint32_t a, uint32_t b)
{
    return a & b;
}
static uint32_t any_bits(uint32_t a, uint32_t b)
{
    return a | b;
}
static uint32_t odd_bits(uint32_t a, uint32_t b)
{
    return a ^ b;
}

enum value { VALUE, SIGNED, NUMBER };

static uint32_t value_of(enum value value, int i)
{
    return value == VALUE ? source[i] : value == SIGNED ? source[i] - 50 : bits_of(number_of(i));
}

// Scans in the order of the shader: all lanes, those up to the lane, those before it, or those of a cluster.
static const struct scan {
    uint32_t (*operation)(uint32_t a, uint32_t b);
    enum value value;
    int reach; // 0, 1 or 2
    int cluster;
    uint32_t none; // what the first lane gets of those before it
} scans[] = {
    {add_float, NUMBER, 0, 8, 0},
    {multiply_float, NUMBER, 0, 8, 0},
    {least_float, NUMBER, 0, 8, 0},
    {greatest_float, NUMBER, 0, 8, 0},
    {add, VALUE, 0, 8, 0},
    {multiply, VALUE, 0, 8, 0},
    {least_int, SIGNED, 0, 8, 0},
    {greatest_int, SIGNED, 0, 8, 0},
    {least, VALUE, 0, 8, 0},
    {greatest, VALUE, 0, 8, 0},
    {all_bits, VALUE, 0, 8, 0},
    {any_bits, VALUE, 0, 8, 0},
    {odd_bits, VALUE, 0, 8, 0},
    {add_float, NUMBER, 1, 8, 0},
    {multiply, VALUE, 1, 8, 0},
    {least_float, NUMBER, 1, 8, 0},
    {add, VALUE, 2, 8, 0},
    {multiply_float, NUMBER, 2, 8, 0x3f800000}, // 1
    {least_float, NUMBER, 2, 8, 0x7f800000},    // infinity
    {greatest_float, NUMBER, 2, 8, 0xff800000}, // −infinity
    {least_int, SIGNED, 2, 8, INT32_MAX},
    {greatest_int, SIGNED, 2, 8, 0x80000000},
    {least, VALUE, 2, 8, UINT32_MAX},
    {greatest, VALUE, 2, 8, 0},
    {all_bits, VALUE, 2, 8, UINT32_MAX},
    {add, VALUE, 0, 4, 0},
    {add_float, NUMBER, 0, 2, 0},
    {greatest, VALUE, 0, 1, 0},
    {odd_bits, VALUE, 0, 8, 0},
};
enum { SCANS = sizeof scans / sizeof *scans };

static uint32_t do_scan(const struct scan *scan, int i)
{
    uint32_t result = scan->none;
    bool has_any = false;
    const int first = i - i % scan->cluster,
              end = scan->reach == 0 ? first + scan->cluster : i + (scan->reach == 1);
    for (int other = first; other < end; other++) {
        if (takes_part(other)) {
            const uint32_t value = value_of(scan->value, other);
            result = has_any ? scan->operation(result, value) : value;
            has_any = true;
        }
    }
    return result;
}

static void expect(int *row, int i, uint32_t expected)
{
    if (results[*row * ROW + i] != expected) {
        fail_msg("result %d of invocation %d: %08x for %08x", *row, i, results[*row * ROW + i], expected);
    }
    (*row)++;
}

static void check_built_ins(int i)
{
    const uint32_t lane = (uint32_t)i & 7, own = 1u << lane, from = 0xffu << lane & 0xff;
    int row = 0;
    expect(&row, i, 8);
    expect(&row, i, 3);
    expect(&row, i, (uint32_t)i / 8);
    expect(&row, i, lane);
    expect(&row, i, own | from << 8 | (from & ~own) << 16);
    expect(&row, i, (~from & 0xff) | own | (~from & 0xff) << 8);
}

// What lanes vote: `holds` has a bit for each that says yes.
static void check_ballots(int i, int *row)
{
    uint32_t holds = 0, all = 1, any = 0, equal = 1, first = 8;
    for (int lane = 7; lane >= 0; lane--) {
        const int other = (i & ~7) + lane;
        if (takes_part(other)) {
            holds |= (source[other] & 4) != 0 ? 1u << lane : 0;
            all = all && source[other] > 5;
            any = any || source[other] > 95;
            equal = equal && bits_of(number_of(other)) == bits_of(number_of(i));
            first = (uint32_t)lane;
        }
    }
    const uint32_t lane = (uint32_t)i & 7, before = holds & ((1u << lane) - 1);
    const uint32_t own = holds >> lane & 1;
    expect(row, i, lane == first);
    expect(row, i, all);
    expect(row, i, any);
    expect(row, i, 1);
    expect(row, i, equal);
    expect(row, i, holds);
    expect(row, i, own);
    expect(row, i, own);
    expect(row, i, (uint32_t)__builtin_popcount(holds));
    expect(row, i, (uint32_t)__builtin_popcount(before) + own);
    expect(row, i, (uint32_t)__builtin_popcount(before));
    expect(row, i, holds ? (uint32_t)__builtin_ctz(holds) : UINT32_MAX);
    expect(row, i, holds ? 31u - (uint32_t)__builtin_clz(holds) : UINT32_MAX);
    expect(row, i, in_lane(i, 3));
    expect(row, i, bits_of(number_of((i & ~7) + (int)first)));
}

static void check_shuffles(int i, int *row)
{
    const unsigned lane = (unsigned)i & 7;
    expect(row, i, in_lane(i, source[i] >> 1 & 7));
    expect(row, i, in_lane(i, lane ^ 5));
    expect(row, i, in_lane(i, lane - 2));
    expect(row, i, in_lane(i, lane + 1));
    expect(row, i, in_lane(i, (lane & 4) + 2));
    expect(row, i, in_lane(i, lane ^ 1));
    expect(row, i, in_lane(i, lane ^ 2));
    expect(row, i, in_lane(i, lane ^ 3));
}

static void test_lanes_of_a_subgroup_work_together(void **state)
{
    (void)state;
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(subgroups_comp, RHW_SHADER_COMPUTE));
    const struct rhw_binding set[2] = {spirv_memory(source, sizeof source),
                                       spirv_memory(results, sizeof results)};
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 3;
    for (int turn = 0; turn < 20; turn++) {
        for (int i = 0; i < LANES; i++) {
            source[i] = turn == 0 ? 4 : (uint32_t)rig_random_int(&random, 100);
        }
        memset(results, 0xcc, sizeof results);
        assert_int_equal(spirv_dispatch(&rig, program, &(struct rhw_shader_frame){.sets = {set}}, 1), RHW_OK);
        for (int i = 0; i < LANES; i++) {
            int row = BUILT_INS;
            check_built_ins(i);
            if (!takes_part(i)) {
                expect(&row, i, 0xcccccccc);
                continue;
            }
            check_ballots(i, &row);
            check_shuffles(i, &row);
            for (int s = 0; s < SCANS; s++) {
                expect(&row, i, do_scan(&scans[s], i));
            }
        }
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_fragments_have_elect(void **state)
{
    (void)state;
    rhw_shader_program *const program = spirv_link(SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX),
                                                   SPIRV_CREATE(elected_frag, RHW_SHADER_FRAGMENT), NULL);
    static const struct rig_vertex triangle[3] = {
        {{-1, -1, 0, 1}, {0}}, {{5, -1, 0, 1}, {0}}, {{-1, 5, 0, 1}, {0}}};
    uint32_t counts[2] = {0, 0};
    const struct rhw_binding binding = spirv_memory(counts, sizeof counts);
    const float scale = 1;
    const struct rhw_shader_frame frame = {
        .sets = {&binding}, .push_constants = &scale, .push_size = sizeof scale};
    struct rig rig;
    rig_open(&rig, 16, 16);
    spirv_draw(&rig, program, triangle, 3, &frame);
    assert_int_equal(counts[1], 256);
    assert_in_range(counts[0], 32, 256);
    for (int i = 0; i < 256; i++) {
        const float *const pixel = rig_read_float4(&rig)[i];
        assert_true(pixel[0] == 8 && pixel[1] >= 0 && pixel[1] < 8);
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_lanes_of_a_subgroup_work_together),
    cmocka_unit_test(test_fragments_have_elect),
};

const struct unit_tests test_spirv_groups = UNIT_TESTS(tests, NULL, NULL);
