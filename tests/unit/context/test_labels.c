// SPDX-License-Identifier: MIT
// Messages name what they are about: labels and ids, the draw that was being recorded, its debug groups and the pass.
#include "harness.h"

#include <string.h>

static const struct rig_vertex corner = {{0}, {0}};

static void test_messages_name_label_and_id(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const struct rhw_buffer_def buffer_def = {.size = 4, .label = "teapot vertices"};
    const struct rhw_texture_def texture_def = {
        .format = RHW_FORMAT_D32_FLOAT, .width = 8, .height = 8, .label = "shadow map"};
    rhw_buffer buffer;
    rhw_texture texture;
    assert_int_equal(rhw_buffer_create(rig.context, &buffer_def, &buffer), RHW_OK);
    assert_int_equal(rhw_texture_create(rig.context, &texture_def, &texture), RHW_OK);
    rhw_buffer_write(rig.context, buffer, 0, &corner, 8);
    rig_expect_misuse(&rig, "must stay within the 4 bytes of buffer 1 \"teapot vertices\"");
    rhw_texture_read(rig.context, texture, 1, &buffer, 0);
    rig_expect_misuse(&rig, "level is 1; texture 2 \"shadow map\" has levels 0..0");
    struct rhw_pass_def pass_def = rig.pass;
    pass_def.colors[0].texture = texture;
    rhw_pass pass;
    rhw_pass_begin(rig.context, &pass_def, &pass);
    rig_expect_misuse(
        &rig,
        "colors[0] is texture 2 \"shadow map\", which is RHW_FORMAT_D32_FLOAT; that is no colour target");
    rig.pipeline.label = "paint";
    rig.pipeline.program.uniform_size = 16;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, &corner, sizeof corner);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    rig_expect_misuse(&rig,
                      "0 bytes of uniforms are set; the program of pipeline 1 \"paint\" reads 16 [draw 0]");
    rig_end(&rig);
    rig_close(&rig);
}

// A label is copied, cut before the character that does not fit; an empty one is none.
static void test_labels_are_copied(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    char label[101];
    memset(label, 'a', 61);
    strcpy(label + 61, "\xe2\x82\xac and more"); // a euro sign would end at byte 64, where the zero stands
    struct rhw_buffer_def def = {.size = 4, .label = label};
    rhw_buffer named, unnamed;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &named), RHW_OK);
    memset(label, 'b', 61);
    def.label = "";
    assert_int_equal(rhw_buffer_create(rig.context, &def, &unnamed), RHW_OK);
    rhw_buffer_write(rig.context, named, 0, NULL, 1);
    rig_expect_misuse(&rig, "data is NULL");
    rhw_buffer_write(rig.context, named, 5, "", 1);
    rig_expect_misuse(&rig, "of buffer 1 \"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\"");
    rhw_buffer_write(rig.context, unnamed, 5, "", 1);
    rig_expect_misuse(&rig, "of buffer 2");
    assert_null(strchr(rig.message, '"'));
    rhw_buffer_destroy(rig.context, named);
    assert_int_equal(rhw_buffer_create(rig.context, &def, &named), RHW_OK); // in its place, without its label
    rhw_buffer_write(rig.context, named, 5, "", 1);
    rig_expect_misuse(&rig, "of buffer 1");
    assert_null(strchr(rig.message, '"'));
    rig_close(&rig);
}

// Bytes that are no UTF-8: there is no character to cut before.
static void test_labels_are_any_bytes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    char label[100];
    memset(label, '\x80', sizeof label);
    label[sizeof label - 1] = 0;
    const struct rhw_buffer_def def = {.size = 4, .label = label};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    rhw_buffer_write(rig.context, buffer, 5, "", 1);
    rig_expect_misuse(&rig, "of buffer 1");
    rig_close(&rig);
}

static void test_messages_name_the_place(void **state)
{
    (void)state;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.label = "thumbnails";
    struct rig rig;
    rig_open_with(&rig, 8, 8, &def);
    rig.pass.label = "main";
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, &corner, sizeof corner);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    rhw_pass_push_debug_group(rig.context, rig.recording, "forest");
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    rhw_pass_push_debug_group(rig.context, rig.recording, "trees");
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 19, (rhw_buffer){0}, 0);
    rig_expect_misuse(
        &rig,
        "slot is 19; it is in 0..15 [draw 2 in forest / trees of pass \"main\", context \"thumbnails\"]");
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, 3, 0, 0, 1);
    rig_expect_misuse(&rig, "no index buffer is set [draw 2 in forest / trees of pass \"main\"");
    rhw_pass_pop_debug_group(rig.context, rig.recording);
    rhw_buffer_write(rig.context, (rhw_buffer){0}, 0, "",
                     1); // a draw that was misuse does not count, as for shaders
    rig_expect_misuse(&rig, "the buffer id is null [draw 2 in forest of pass \"main\"");
    rhw_pass_pop_debug_group(rig.context, rig.recording);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 19, (rhw_buffer){0}, 0);
    rig_expect_misuse(&rig, "[draw 2 of pass \"main\"");
    rig_end(&rig);
    rhw_buffer_write(rig.context, (rhw_buffer){0}, 0, "", 1);
    rig_expect_misuse(&rig, "the buffer id is null [context \"thumbnails\"]");
    rig_close(&rig);
}

static void test_groups_are_popped(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_begin(&rig);
    rhw_pass_pop_debug_group(rig.context, rig.recording);
    rig_expect_misuse(&rig, "rhw_pass_pop_debug_group: no group was pushed");
    rhw_pass_push_debug_group(rig.context, rig.recording, NULL);
    rig_expect_misuse(&rig, "rhw_pass_push_debug_group: label is NULL");
    rhw_pass_push_debug_group(rig.context, rig.recording, "open");
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_end: a debug group was pushed and not popped [draw 0 in open]");
    rig_close(&rig);
}

// Of many groups, as where a loop forgets to pop, the innermost are named.
static void test_groups_are_many(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_begin(&rig);
    for (int i = 0; i < 300000; i++) {
        rhw_pass_push_debug_group(rig.context, rig.recording, "tree");
    }
    rhw_pass_push_debug_group(rig.context, rig.recording, "leaf");
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "[draw 0 in ... / tree / tree / tree / tree / tree / tree / tree / leaf]");
    rig_close(&rig);
}

// What was no misuse is drawn, and the end tells. The next pass begins anew.
static void test_misuse_in_a_pass_is_its_result(void **state)
{
    (void)state;
    static const float red[4] = {1, 0, 0, 1};
    struct rig rig;
    rig_open(&rig, 8, 8);
    struct rig_vertex all[6];
    rig_cover(&rig, 0, red, all);
    rig_begin(&rig);
    rig_draw(&rig, all, 6);
    rhw_pass_set_uniforms(rig.context, rig.recording, NULL, 1);
    rig_expect_misuse(&rig, "rhw_pass_set_uniforms");
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, &rig.stats), RHW_ERROR_MISUSE);
    assert_int_equal(rig.stats.draws, 1);
    assert_memory_equal(rig_read_float4(&rig)[0], red, sizeof red);
    rig_begin(&rig);
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_OK);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_messages_name_label_and_id),
    cmocka_unit_test(test_labels_are_copied),
    cmocka_unit_test(test_labels_are_any_bytes),
    cmocka_unit_test(test_messages_name_the_place),
    cmocka_unit_test(test_groups_are_popped),
    cmocka_unit_test(test_groups_are_many),
    cmocka_unit_test(test_misuse_in_a_pass_is_its_result),
};

const struct unit_tests test_labels = UNIT_TESTS(tests, NULL, NULL);
