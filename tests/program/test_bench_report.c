// SPDX-License-Identifier: MIT
// The JSON of rhw bench, read back by another library.
#include "bench_job.h"

#include <jansson.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const struct bench_scene_entry fill = {.name = "fill"}, sphere = {.name = "sphere"};

static json_t *print_and_read(const struct cli_bench_report *report)
{
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    assert_non_null(stream);
    cli_bench_print_json(stream, report);
    fclose(stream);
    json_error_t error;
    json_t *const root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    if (!root) {
        fail_msg("%s in: %s", error.text, text);
    }
    free(text);
    return root;
}

static double number(const json_t *object, const char *key)
{
    const json_t *const value = json_object_get(object, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static void test_json_with_a_peer(void **state)
{
    (void)state;
    const struct cli_bench_job job = {.width = 64, .height = 32, .frames = 5, .peer = "llvmpipe"};
    static struct cli_bench_report report = {
        .cpu = "A \"CPU\"\\", .peer_name = "llvmpipe, 256 bits", .cores = 4};
    report.job = &job;
    report.result_count = 2;
    report.results[0] = (struct cli_bench_result){.entry = &fill,
                                                  .work = 1e6,
                                                  .all = {.median = 2.0, .least = 1.0, .most = 3.0},
                                                  .one = {.median = 4.0, .least = 3.0, .most = 5.0},
                                                  .peer = {.median = 8.0, .least = 7.0, .most = 9.0},
                                                  .has_one = true,
                                                  .has_peer = true,
                                                  .agreement = {.agrees = true, .pixels = 2048}};
    report.results[1] =
        (struct cli_bench_result){.entry = &sphere, .all = {.median = 0.5, .least = 0.25, .most = 1.0}};
    json_t *const root = print_and_read(&report);
    assert_string_equal(json_string_value(json_object_get(root, "cpu")), "A \"CPU\"\\");
    const json_t *const scenes = json_object_get(root, "scenes");
    assert_int_equal(json_array_size(scenes), 2);
    const json_t *const first = json_array_get(scenes, 0);
    assert_string_equal(json_string_value(json_object_get(first, "name")), "fill");
    assert_true(number(first, "rhw_ms") == 2.0);
    assert_true(number(first, "rhw_1_thread_ms") == 4.0);
    assert_true(number(first, "rate") == 500.0);
    const json_t *const peer = json_object_get(json_object_get(first, "peers"), "llvmpipe");
    assert_true(number(peer, "ms") == 8.0);
    assert_true(number(peer, "ratio") == 4.0);
    assert_true(json_is_true(json_object_get(peer, "agrees")));
    const json_t *const second = json_array_get(scenes, 1);
    assert_true(number(second, "rhw_ms") == 0.5);
    assert_int_equal(json_object_size(json_object_get(second, "peers")), 0);
    json_decref(root);
}

static void test_json_of_nothing(void **state)
{
    (void)state;
    const struct cli_bench_job job = {0};
    static struct cli_bench_report report;
    report.job = &job;
    json_t *const root = print_and_read(&report);
    assert_int_equal(json_array_size(json_object_get(root, "scenes")), 0);
    json_decref(root);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_json_with_a_peer),
        cmocka_unit_test(test_json_of_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
