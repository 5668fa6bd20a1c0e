// SPDX-License-Identifier: MIT
// Loops without an end are given up, on any thread, and control flow goes where it has lanes.
#include "patience.h"
#include "spirv_run.h"

#include "discarded_groups_frag.h"
#include "discards_frag.h"
#include "alike_comp.h"
#include "alike_comp_small.h"
#include "alike_frag.h"
#include "changing_comp.h"
#include "constant_way_comp.h"
#include "counters_comp.h"
#include "counters_comp_small.h"
#include "endless_work_comp.h"
#include "endless_frag.h"
#include "endless_vert.h"
#include "flow_comp.h"
#include "leave_comp.h"
#include "plain_vert.h"
#include "waits_comp.h"
#include "waits_together_comp.h"

enum { LANES = 20, WORKGROUPS = 3 };

static void check_given_up(int threads)
{
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(endless_work_comp, RHW_SHADER_COMPUTE));
    uint32_t words[LANES * WORKGROUPS];
    const struct rhw_binding binding = spirv_memory(words, sizeof words);
    const struct rhw_shader_frame frame = {.sets = {&binding}};
    struct rig rig;
    rig_open_with(&rig, 4, 4, &(struct rhw_context_def){.threads = threads});
    for (int turn = 0; turn < 3; turn++) {
        for (uint32_t i = 0; i < LANES * WORKGROUPS; i++) {
            words[i] = 1 + (i & 1);
        }
        words[LANES - 1] = turn == 0 ? 1 : 0; // the other turns have a lane that never ends
        struct patience patience = {.left = WORKGROUPS + 3};
        rhw_context_set_goes_on(rig.context, goes_on, &patience);
        assert_int_equal(spirv_dispatch(&rig, program, &frame, WORKGROUPS),
                         turn == 0 ? RHW_OK : RHW_ERROR_GIVEN_UP);
        for (uint32_t i = 0; turn == 0 && i < LANES * WORKGROUPS; i++) {
            assert_int_equal(words[i], i == LANES - 1 || (i & 1) == 0 ? 100 : 101);
        }
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_a_dispatch_without_an_end_is_given_up(void **state)
{
    (void)state;
    check_given_up(1);
    check_given_up(3);
}

static enum rhw_result draw(struct rig *rig, const rhw_shader_program *program, float step)
{
    const struct rig_vertex triangle[3] = {
        {{-2, -2, 0, 1}, {0, step, 0, 1}},
        {{6, -2, 0, 1}, {0, step, 0, 1}},
        {{-2, 6, 0, 1}, {0, step, 0, 1}},
    };
    const float scale = 1;
    const struct rhw_shader_frame frame = {.push_constants = &scale, .push_size = sizeof scale};
    rig->pipeline.program = *rhw_shader_program_get(program);
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, triangle, sizeof triangle);
    rhw_pass_set_uniforms(rig->context, rig->recording, &frame, sizeof frame);
    rhw_pass_draw(rig->context, rig->recording, 0, 3, 0, 1);
    return rhw_pass_end(rig->context, rig->recording, NULL);
}

static void check_draw(rhw_shader *vertex, rhw_shader *fragment, float step_that_ends)
{
    rhw_shader_program *const program = spirv_link(vertex, fragment, NULL);
    for (int threads = 1; threads <= 3; threads += 2) {
        struct rig rig;
        rig_open_with(&rig, 200, 200, &(struct rhw_context_def){.threads = threads});
        struct patience patience = {.left = 4};
        assert_int_equal(draw(&rig, program, step_that_ends), RHW_OK);
        rhw_context_set_goes_on(rig.context, goes_on, &patience);
        assert_int_equal(draw(&rig, program, 0), RHW_ERROR_GIVEN_UP);
        rhw_context_set_goes_on(rig.context, NULL, NULL);
        assert_int_equal(draw(&rig, program, step_that_ends), RHW_OK);
        rig_close(&rig);
    }
    rhw_shader_program_destroy(program);
}

static void test_fragments_without_an_end_are_given_up(void **state)
{
    (void)state;
    check_draw(SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX), SPIRV_CREATE(endless_frag, RHW_SHADER_FRAGMENT),
               0.5f);
}

static void test_vertices_without_an_end_are_given_up(void **state)
{
    (void)state;
    check_draw(SPIRV_CREATE(endless_vert, RHW_SHADER_VERTEX), SPIRV_CREATE(endless_frag, RHW_SHADER_FRAGMENT),
               1.0f);
}

// Where lanes go -------------------------------------------------------------------------------------

enum { FLOW_LANES = 200 };

struct push {
    int which, rounds;
};

static int early(int x, int which)
{
    if (which == 3 && x > 40) {
        return -x;
    }
    return x > 90 ? 1000 : which == 2 ? x * 3 : x + 1;
}

// What the shader does for one lane.
static int flow_of(int x, struct push push)
{
    int sum = push.which == 1 ? 5 : push.which == 2 ? 9 : early(x, push.which);
    if (push.which == 2 && x % 3 == 0) {
        return -7;
    }
    for (int r = 0; r < push.rounds; r++) {
        if (r == 3 && push.which == 3) {
            continue;
        }
        if (x == r) {
            break;
        }
        for (int q = 0; q < x % 5 && !(q == 2 && push.which == 0); q++) {
            sum += q * r;
            if (sum > 300) {
                return sum;
            }
        }
        switch (x % 4 + push.which) {
        case 0: sum += 3; break;
        case 1: sum += 2; break;
        case 2: sum += push.which == 1 ? 30 : 0; break;
        default: sum = early(sum, push.which); break;
        }
    }
    return sum;
}

static void test_lanes_go_where_their_conditions_say(void **state)
{
    (void)state;
    int32_t source[FLOW_LANES], sink[FLOW_LANES];
    rhw_shader_program *const program = spirv_link(NULL, NULL, SPIRV_CREATE(flow_comp, RHW_SHADER_COMPUTE));
    const struct rhw_binding set[2] = {spirv_memory(source, sizeof source), spirv_memory(sink, sizeof sink)};
    struct rig rig;
    uint64_t random = 9;
    rig_open(&rig, 4, 4);
    for (int turn = 0; turn < 40; turn++) {
        const struct push push = {turn % 4, turn / 4};
        for (int i = 0; i < FLOW_LANES; i++) {
            // Some turns have one number in all lanes, so that all go one way.
            source[i] = turn % 3 == 0 && i > 0 ? source[0] : rig_random_int(&random, 100);
        }
        const struct rhw_shader_frame frame = {
            .sets = {set}, .push_constants = &push, .push_size = sizeof push};
        assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
        for (int i = 0; i < FLOW_LANES; i++) {
            if (sink[i] != flow_of(source[i], push)) {
                fail_msg("turn %d, number %d: %d for %d", turn, source[i], sink[i], flow_of(source[i], push));
            }
        }
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

// What counters.comp does for one lane.
static int count_of(int x)
{
    int sum = 0, n = 0, late = 5, twice = 0, other = x > 50 ? 2 : 1;
    for (int i = 0; i < 40 && i * i <= x; i++) {
        sum += (x & 3) == 1 ? 0 : i;
    }
    while (n < 40 && n * 3 < x) {
        n++;
    }
    sum += 100 * n;
    for (int i = 0; i < 6; i++) {
        const bool is_set = ((x >> i) & 1) == 1;
        sum += is_set ? late++ : 0;
        for (int j = 0; is_set && j < i && j != (x & 7); j++) {
            sum += j * i;
        }
        twice = (twice + (i == 2 ? 2 : 0)) * 2 + 1;
        sum += twice;
    }
    for (int i = 0; x > 50 && i < 5; i++) {
        sum += other * i;
        other += 3;
        if (i > (x & 3)) {
            break;
        }
    }
    return sum * 16 + other;
}

static void check_counters(rhw_shader *shader)
{
    enum { COUNTERS = 100 };
    int32_t source[COUNTERS], sink[COUNTERS];
    rhw_shader_program *const program = spirv_link(NULL, NULL, shader);
    const struct rhw_binding set[2] = {spirv_memory(source, sizeof source), spirv_memory(sink, sizeof sink)};
    const struct rhw_shader_frame frame = {.sets = {set}};
    struct rig rig;
    rig_open(&rig, 4, 4);
    for (int i = 0; i < COUNTERS; i++) {
        source[i] = i * 7 % COUNTERS;
    }
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    for (int i = 0; i < COUNTERS; i++) {
        assert_int_equal(sink[i], count_of(source[i]));
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_lanes_count_together_and_apart(void **state)
{
    (void)state;
    check_counters(SPIRV_CREATE(counters_comp, RHW_SHADER_COMPUTE));
    check_counters(SPIRV_CREATE(counters_comp_small, RHW_SHADER_COMPUTE));
}

static void check_alike(const uint32_t *words, size_t size)
{
    int32_t first[] = {1, 10, 20}, second[] = {2, 30, 40, 50}, sink[8];
    const struct rhw_shader_def def = {.stage = RHW_SHADER_COMPUTE};
    rhw_shader *shader;
    assert_int_equal(rhw_shader_create(words, size, &def, &shader, NULL), RHW_OK);
    rhw_shader_program *const program = spirv_link(NULL, NULL, shader);
    const struct rhw_binding set[3] = {spirv_memory(first, sizeof first), spirv_memory(second, sizeof second),
                                       spirv_memory(sink, sizeof sink)};
    const struct push push = {7, 3};
    const struct rhw_shader_frame frame = {.sets = {set}, .push_constants = &push, .push_size = sizeof push};
    struct rig rig;
    rig_open(&rig, 4, 4);
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    for (int i = 0; i < 8; i++) {
        assert_int_equal(sink[i], i < 4 ? 21 : 21 + 10 * 3 + 40 * 4);
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

// The covered pixels fill no whole number of groups, so that some lanes are not active.
static void test_covered_lanes_share_what_all_have_alike(void **state)
{
    (void)state;
    int32_t first[8] = {1, [5] = 30}, second[8] = {1, [5] = 160};
    uint32_t counted = 0;
    rhw_shader_program *const program = spirv_link(SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX),
                                                   SPIRV_CREATE(alike_frag, RHW_SHADER_FRAGMENT), NULL);
    const struct rig_vertex triangle[3] = {
        {{0.9f, -1, 0, 1}, {0}}, {{1, 0.8f, 0, 1}, {0}}, {{-1, 0.9f, 0, 1}, {0}}};
    const struct rhw_binding set[3] = {spirv_memory(first, sizeof first), spirv_memory(second, sizeof second),
                                       spirv_memory(&counted, sizeof counted)};
    const float scale = 1;
    const struct rhw_shader_frame frame = {
        .sets = {set}, .push_constants = &scale, .push_size = sizeof scale};
    struct rig rig;
    rig_open(&rig, 32, 32);
    spirv_draw(&rig, program, triangle, 3, &frame);
    uint32_t covered = 0;
    for (int i = 0; i < 32 * 32; i++) {
        const float *const color = rig_read_float4(&rig)[i];
        covered += color[3] == 1.0f;
        assert_true(color[3] != 1.0f || color[0] == 30 + 160);
    }
    assert_int_equal(counted, covered);
    assert_int_not_equal(covered % 8, 0);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_lanes_share_what_all_have_alike(void **state)
{
    (void)state;
    check_alike(alike_comp, sizeof alike_comp);
    check_alike(alike_comp_small, sizeof alike_comp_small);
}

static void check_waiting(rhw_shader *shader, uint32_t counted)
{
    rhw_shader_program *const program = spirv_link(NULL, NULL, shader);
    uint32_t words[2] = {0, 0};
    const struct rhw_binding binding = spirv_memory(words, sizeof words);
    const struct rhw_shader_frame frame = {.sets = {&binding}};
    struct patience patience = {.left = 100};
    struct rig rig;
    rig_open(&rig, 4, 4);
    rhw_context_set_goes_on(rig.context, goes_on, &patience);
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    assert_int_equal(words[0], 10);
    assert_int_equal(words[1], counted);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_groups_without_lanes_do_not_wait(void **state)
{
    (void)state;
    check_waiting(SPIRV_CREATE(waits_comp, RHW_SHADER_COMPUTE), 0);
    check_waiting(SPIRV_CREATE(waits_together_comp, RHW_SHADER_COMPUTE), 1);
}

static void test_discarded_lanes_do_no_more(void **state)
{
    (void)state;
    static const float limits[3][3] = {{100, 0, 0}, {5, 7, 2}, {-1, -1, 0}};
    static const uint32_t left[3] = {256, 256 - 11 * (9 + 2), 0};
    rhw_shader_program *const program = spirv_link(SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX),
                                                   SPIRV_CREATE(discards_frag, RHW_SHADER_FRAGMENT), NULL);
    const float scale = 1;
    for (int turn = 0; turn < 3; turn++) {
        const float *const l = limits[turn];
        const struct rig_vertex triangle[3] = {
            {{-1, -1, 0, 1}, {l[0], l[1], l[2], 1}},
            {{5, -1, 0, 1}, {l[0], l[1], l[2], 1}},
            {{-1, 5, 0, 1}, {l[0], l[1], l[2], 1}},
        };
        uint32_t behind = 0;
        const struct rhw_binding binding = spirv_memory(&behind, sizeof behind);
        const struct rhw_shader_frame frame = {
            .sets = {&binding}, .push_constants = &scale, .push_size = sizeof scale};
        struct rig rig;
        rig_open(&rig, 16, 16);
        spirv_draw(&rig, program, triangle, 3, &frame);
        assert_int_equal(behind, left[turn]);
        uint32_t drawn = 0;
        for (int i = 0; i < 256; i++) {
            drawn += rig_read_float4(&rig)[i][3] == 1.0f;
        }
        assert_int_equal(drawn, left[turn]);
        rig_close(&rig);
    }
    rhw_shader_program_destroy(program);
}

// The first groups of a draw have no fragment left, so that another has to say which way all go.
static void check_discarded_groups(float limit, int32_t rounds)
{
    rhw_shader_program *const program =
        spirv_link(SPIRV_CREATE(plain_vert, RHW_SHADER_VERTEX),
                   SPIRV_CREATE(discarded_groups_frag, RHW_SHADER_FRAGMENT), NULL);
    const struct rig_vertex triangle[3] = {{{-1, -1, 0, 1}, {0, limit, 0, 1}},
                                           {{5, -1, 0, 1}, {0, limit, 0, 1}},
                                           {{-1, 5, 0, 1}, {0, limit, 0, 1}}};
    uint32_t counts[2] = {0, 0};
    const struct rhw_binding binding = spirv_memory(counts, sizeof counts);
    const struct {
        float scale;
        int32_t rounds;
    } push = {1, rounds};
    const struct rhw_shader_frame frame = {
        .sets = {&binding}, .push_constants = &push, .push_size = sizeof push};
    struct rig rig;
    rig_open(&rig, 16, 16);
    spirv_draw(&rig, program, triangle, 3, &frame);
    const uint32_t left = 16 * (16 - (uint32_t)limit);
    assert_int_equal(counts[0], rounds > 3 ? left : 0);
    assert_int_equal(counts[1], rounds > 3 ? 0 : left);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void test_groups_without_fragments_decide_nothing(void **state)
{
    (void)state;
    for (int limit = 0; limit <= 16; limit += 4) {
        check_discarded_groups((float)limit, 5);
        check_discarded_groups((float)limit, 2);
    }
}

enum { NUMBERS = 2 + 64 };

static void run_rounds(rhw_shader *shader, bool is_interpreted, float numbers[NUMBERS])
{
    const struct rhw_shader_program_def def = {.compute = shader, .is_interpreted = is_interpreted};
    rhw_shader_program *program;
    assert_int_equal(rhw_shader_program_create(&def, &program, NULL), RHW_OK);
    for (int i = 0; i < NUMBERS; i++) {
        numbers[i] = i < 2 ? 0 : 0.75f * (float)i;
    }
    const int32_t rounds = 5;
    const struct rhw_binding binding = spirv_memory(numbers, NUMBERS * sizeof *numbers);
    const struct rhw_shader_frame frame = {
        .sets = {&binding}, .push_constants = &rounds, .push_size = sizeof rounds};
    struct rig rig;
    rig_open(&rig, 4, 4);
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void check_rounds(rhw_shader *shader)
{
    float numbers[NUMBERS], expected[NUMBERS];
    run_rounds(shader, false, numbers);
    run_rounds(shader, true, expected);
    assert_memory_equal(numbers, expected, sizeof expected);
    assert_true(expected[NUMBERS - 1] != 0.75f * (NUMBERS - 1));
    rhw_shader_destroy(shader);
}

static void test_rounds_of_all_groups_share_what_changes(void **state)
{
    (void)state;
    check_rounds(SPIRV_CREATE(changing_comp, RHW_SHADER_COMPUTE));
    check_rounds(SPIRV_CREATE(constant_way_comp, RHW_SHADER_COMPUTE));
}

static uint32_t leave(float which, int32_t skipped)
{
    rhw_shader_program *const program = spirv_link(NULL, NULL, SPIRV_CREATE(leave_comp, RHW_SHADER_COMPUTE));
    uint32_t words[LANES] = {0};
    const struct rhw_binding binding = spirv_memory(words, sizeof words);
    const struct {
        float which;
        int32_t skipped;
    } choices = {which, skipped};
    const struct rhw_shader_frame frame = {
        .sets = {&binding}, .push_constants = &choices, .push_size = sizeof choices};
    struct rig rig;
    rig_open(&rig, 4, 4);
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
    assert_int_equal(words[LANES - 1], words[0]);
    return words[0];
}

static void test_all_lanes_may_leave_at_once(void **state)
{
    (void)state;
    assert_int_equal(leave(1, 1), 31);
    assert_int_equal(leave(0, 1), 32);
    assert_int_equal(leave(0, 9), 42);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_dispatch_without_an_end_is_given_up),
    cmocka_unit_test(test_fragments_without_an_end_are_given_up),
    cmocka_unit_test(test_vertices_without_an_end_are_given_up),
    cmocka_unit_test(test_lanes_go_where_their_conditions_say),
    cmocka_unit_test(test_lanes_count_together_and_apart),
    cmocka_unit_test(test_lanes_share_what_all_have_alike),
    cmocka_unit_test(test_covered_lanes_share_what_all_have_alike),
    cmocka_unit_test(test_groups_without_lanes_do_not_wait),
    cmocka_unit_test(test_discarded_lanes_do_no_more),
    cmocka_unit_test(test_groups_without_fragments_decide_nothing),
    cmocka_unit_test(test_rounds_of_all_groups_share_what_changes),
    cmocka_unit_test(test_all_lanes_may_leave_at_once),
};

const struct unit_tests test_spirv_flow = UNIT_TESTS(tests, NULL, NULL);
