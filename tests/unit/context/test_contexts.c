// SPDX-License-Identifier: MIT
// Contexts: what they are created with, several at once on several threads, many one after the other, and
// what they say about themselves.
#include "harness.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#if defined(__unix__)
#include <sys/wait.h>
#include <unistd.h>
#endif

static void test_version(void **state)
{
    (void)state;
    char expected[32];
    snprintf(expected, sizeof expected, "%d.%d.%d", RHW_VERSION_MAJOR, RHW_VERSION_MINOR, RHW_VERSION_PATCH);
    assert_string_equal(rhw_version(), expected);
}

static void test_results_are_sentences(void **state)
{
    (void)state;
    const char *seen[5];
    for (int result = RHW_OK; result <= RHW_ERROR_MISUSE; result++) {
        seen[result] = rhw_result_string((enum rhw_result)result);
        const size_t length = strlen(seen[result]);
        assert_true(length > 1 && length < 100);
        assert_int_not_equal(seen[result][length - 1], '.');
        for (int other = 0; other < result; other++) {
            assert_string_not_equal(seen[result], seen[other]);
        }
    }
    assert_non_null(rhw_result_string((enum rhw_result)99));
}

static void test_instruction_sets(void **state)
{
    (void)state;
    assert_string_equal(rhw_isa_name(RHW_ISA_BASELINE), "baseline");
    assert_string_equal(rhw_isa_name(RHW_ISA_AVX2), "avx2");
    assert_string_equal(rhw_isa_name(RHW_ISA_AVX512), "avx512");
    assert_true(rhw_isa_supported(RHW_ISA_BASELINE));
    int best = RHW_ISA_BASELINE;
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (rhw_isa_supported((enum rhw_isa)isa)) {
            best = isa;
        }
        struct rhw_context_def def = rhw_context_def_default();
        def.isa_limit = rhw_isa_up_to((enum rhw_isa)isa);
        def.threads = 1;
        rhw_context *context = NULL;
        // `isa_limit` is the highest to use: one the CPU lacks gives the best below it.
        assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
        assert_int_equal(rhw_context_isa(context), best);
        rhw_context_destroy(context);
    }
    // Left open, it is AVX2 at most, whatever else the CPU has.
    struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context = NULL;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(rhw_context_isa(context), best > RHW_ISA_AVX2 ? RHW_ISA_AVX2 : best);
    rhw_context_destroy(context);
}

static void test_thread_counts(void **state)
{
    (void)state;
    for (int threads = 0; threads <= RHW_MAX_THREADS; threads += threads < 4 ? 1 : 20) {
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = threads;
        rhw_context *context = NULL;
        assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
        if (threads == 0) {
            assert_true(rhw_context_threads(context) >= 1 && rhw_context_threads(context) <= RHW_MAX_THREADS);
        } else {
            assert_int_equal(rhw_context_threads(context), threads);
        }
        rhw_context_destroy(context);
    }
    rhw_context_destroy(NULL);
}

static atomic_int vertex_calls_elsewhere;
static pthread_t caller;

static void caller_vertex(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    if (!pthread_equal(pthread_self(), caller)) {
        atomic_fetch_add(&vertex_calls_elsewhere, 1);
    }
}

static void caller_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    if (!pthread_equal(pthread_self(), caller)) {
        atomic_fetch_add(&vertex_calls_elsewhere, 1);
    }
}

static void test_one_thread_is_the_callers(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    struct rig rig;
    rig_open_with(&rig, 300, 300, &def);
    caller = pthread_self();
    vertex_calls_elsewhere = 0;
    rig_set_program(&rig, caller_vertex, caller_fragment);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, all);
    rig_draw_once(&rig, all, 6);
    assert_int_equal(vertex_calls_elsewhere, 0);
    rig_close(&rig);
}

static atomic_int log_lines;

static void count_log(void *user, enum rhw_log_level level, const char *message)
{
    (void)user;
    assert_true(level == RHW_LOG_INFO || level == RHW_LOG_WARNING);
    assert_null(strchr(message, '\n'));
    atomic_fetch_add(&log_lines, 1);
}

static void test_log(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.log = count_log;
    rhw_context *context = NULL;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    rhw_context_destroy(context);
    assert_true(log_lines >= 1);
}

static int copy_lines;

static void keep_copies(void *user, enum rhw_log_level level, const char *message)
{
    if (strstr(message, " no copy for ") != NULL) {
        assert_int_equal(level, RHW_LOG_INFO);
        assert_non_null(strstr(message, user));
        copy_lines++;
    }
}

// A program that lacks the copy of its functions for the context's instruction set is told when its pipeline is made,
// once, and one that has it is not.
static void test_missing_copies_are_told(void **state)
{
    (void)state;
    static const struct {
        bool vertex, fragment; // has a copy
        char said[64];
    } cases[] = {{false, false, "program.vertex and program.fragment have no copy"},
                 {true, false, ": program.fragment has no copy"},
                 {false, true, ": program.vertex has no copy"},
                 {true, true, ""}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct rhw_context_def def = rhw_context_def_default();
        char said[64];
        memcpy(said, cases[i].said, sizeof said);
        def.log = keep_copies;
        def.user = said;
        rhw_context *context = NULL;
        assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
        const enum rhw_isa isa = rhw_context_isa(context);
        struct rhw_pipeline_def pipeline_def = rhw_pipeline_def_default();
        pipeline_def.program.vertex[RHW_ISA_BASELINE] = rig_vertex_pass;
        pipeline_def.program.fragment[RHW_ISA_BASELINE] = rig_fragment_pass;
        pipeline_def.program.vertex[isa] = cases[i].vertex || isa == 0 ? rig_vertex_pass : NULL;
        pipeline_def.program.fragment[isa] = cases[i].fragment || isa == 0 ? rig_fragment_pass : NULL;
        pipeline_def.program.varying_count = 1;
        pipeline_def.program.varyings[0].components = 4;
        pipeline_def.attribute_count = 2;
        pipeline_def.attributes[0].format = pipeline_def.attributes[1].format = RHW_VERTEX_FLOAT4;
        pipeline_def.attributes[1].offset = 16;
        pipeline_def.buffer_count = 1;
        pipeline_def.target_count = 1;
        pipeline_def.targets[0].format = RHW_FORMAT_RGBA8_UNORM;
        rhw_pipeline pipeline;
        copy_lines = 0;
        assert_int_equal(rhw_pipeline_create(context, &pipeline_def, &pipeline), RHW_OK);
        assert_int_equal(copy_lines, isa != RHW_ISA_BASELINE && i < 3);
        rhw_context_destroy(context);
    }
}

struct job {
    int seed;
    uint64_t hash;
    const char *error;
};

// cmocka's asserts belong to the main thread: a job only reports.
static void *run_job(void *argument)
{
    struct job *job = argument;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1 + job->seed % 3;
    rhw_context *context = NULL;
    struct rhw_texture_def target_def = rhw_texture_def_default();
    target_def.width = 160;
    target_def.height = 120;
    struct rhw_pipeline_def pipeline_def = rhw_pipeline_def_default();
    pipeline_def.program.vertex[0] = rig_vertex_pass;
    pipeline_def.program.fragment[0] = rig_fragment_pass;
    pipeline_def.program.varyings[0].components = 4;
    pipeline_def.program.varying_count = 1;
    pipeline_def.attributes[0].format = pipeline_def.attributes[1].format = RHW_VERTEX_FLOAT4;
    pipeline_def.attributes[1].offset = 16;
    pipeline_def.attribute_count = 2;
    pipeline_def.buffers[0].stride = 32;
    pipeline_def.buffer_count = 1;
    struct rig_vertex vertices[300];
    uint64_t random = (uint64_t)(job->seed % 4);
    for (int i = 0; i < 300; i++) {
        for (int c = 0; c < 4; c++) {
            vertices[i].position[c] = c == 3 ? 1 : rig_random_float(&random, -1, 1);
            vertices[i].value[c] = rig_random_float(&random, 0, 1);
        }
    }
    struct rhw_buffer_def buffer_def = {.size = sizeof vertices, .data = vertices};
    rhw_texture target;
    rhw_pipeline pipeline;
    rhw_buffer buffer;
    if (rhw_context_create(&def, &context) != RHW_OK ||
        rhw_texture_create(context, &target_def, &target) != RHW_OK ||
        rhw_pipeline_create(context, &pipeline_def, &pipeline) != RHW_OK ||
        rhw_buffer_create(context, &buffer_def, &buffer) != RHW_OK) {
        job->error = "creation failed";
        return NULL;
    }
    static const size_t size = 160 * 120 * 4;
    unsigned char pixels[160 * 120 * 4];
    for (int n = 0; n < 20; n++) {
        struct rhw_pass_def pass_def = rhw_pass_def_default();
        pass_def.colors[0].texture = target;
        pass_def.color_count = 1;
        pass_def.depth.enabled = false;
        rhw_pass pass;
        if (rhw_pass_begin(context, &pass_def, &pass) != RHW_OK) {
            job->error = "begin failed";
            break;
        }
        rhw_pass_set_pipeline(context, pass, pipeline);
        rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
        rhw_pass_draw(context, pass, 0, 300, 0, 1);
        if (rhw_pass_end(context, pass, NULL) != RHW_OK) {
            job->error = "end failed";
        }
        rhw_texture_read(context, target, 0, pixels, 0);
        const uint64_t hash = rig_hash_bytes(1, pixels, size);
        if (n > 0 && hash != job->hash) {
            job->error = "a pass drew other bytes";
        }
        job->hash = hash;
    }
    rhw_context_destroy(context);
    return NULL;
}

static void test_contexts_run_in_parallel(void **state)
{
    (void)state;
    enum { JOBS = 12 };
    struct job jobs[JOBS] = {0};
    pthread_t threads[JOBS];
    for (int i = 0; i < JOBS; i++) {
        jobs[i].seed = i;
        assert_int_equal(pthread_create(&threads[i], NULL, run_job, &jobs[i]), 0);
    }
    for (int i = 0; i < JOBS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
    for (int i = 0; i < JOBS; i++) {
        if (jobs[i].error != NULL) {
            fail_msg("context %d: %s", i, jobs[i].error);
        }
        assert_true(jobs[i].hash == jobs[i % 4].hash);
    }
    assert_true(jobs[0].hash != jobs[1].hash);
}

static void test_many_contexts_one_after_the_other(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        struct rig rig;
        rig_open(&rig, 16, 16);
        if (i % 4 == 0) { // a pass is given up
            rig_begin(&rig);
            rig_use_pipeline(&rig);
            rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
            rig_expect_misuse(&rig, "no vertex buffer is set");
            rhw_pass_cancel(rig.context, rig.recording);
        }
        rig_close(&rig);
    }
}

static void test_ids_of_many_objects(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    enum { COUNT = 3000 };
    static rhw_buffer buffers[COUNT];
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < COUNT; i++) {
            const struct rhw_buffer_def def = {.size = 16, .data = NULL};
            assert_int_equal(rhw_buffer_create(rig.context, &def, &buffers[i]), RHW_OK);
            assert_true(buffers[i].index != 0 || buffers[i].generation != 0);
        }
        // Out of order, so that free places are reused in another order.
        for (int i = 0; i < COUNT; i++) {
            rhw_buffer_destroy(rig.context, buffers[(i * 7 + round) % COUNT]);
        }
        rhw_buffer_destroy(rig.context, buffers[round]);
        rig_expect_misuse(&rig, "rhw_buffer_destroy");
    }
    rig_close(&rig);
}

#if defined(__unix__) && !defined(__EMSCRIPTEN__)
// A child that fork made has none of the context's workers: it draws the same on its own, and destroys what it got.
static void test_a_child_draws_and_destroys(void **state)
{
    (void)state;
    static const float value[4] = {1, 2, 3, 4};
    struct rig rig;
    rig_open(&rig, 300, 200);
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0.5f, value, vertices);
    rig_draw_once(&rig, vertices, 6);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        static const float other[4] = {5, 6, 7, 8};
        bool is_drawn = true;
        alarm(20);
        rig_cover(&rig, 0.5f, other, vertices);
        rig_draw_once(&rig, vertices, 6);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < 300 * 200; i++) {
            is_drawn = is_drawn && memcmp(pixels[i], other, sizeof other) == 0;
        }
        rhw_context_destroy(rig.context);
        _exit(is_drawn ? 0 : 1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    rig_close(&rig);
}
#endif

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_version),
    cmocka_unit_test(test_results_are_sentences),
    cmocka_unit_test(test_instruction_sets),
    cmocka_unit_test(test_thread_counts),
    cmocka_unit_test(test_one_thread_is_the_callers),
    cmocka_unit_test(test_log),
    cmocka_unit_test(test_missing_copies_are_told),
    cmocka_unit_test(test_contexts_run_in_parallel),
    cmocka_unit_test(test_many_contexts_one_after_the_other),
    cmocka_unit_test(test_ids_of_many_objects),
#if defined(__unix__) && !defined(__EMSCRIPTEN__)
    cmocka_unit_test(test_a_child_draws_and_destroys),
#endif
};

const struct unit_tests test_contexts = UNIT_TESTS(tests, NULL, NULL);
