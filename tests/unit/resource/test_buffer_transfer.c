// SPDX-License-Identifier: MIT
// Buffers filled, copied and mapped, and what passes and writers say to a mapped one.
#include "harness.h"

#include <string.h>

enum { SIZE = 22 };

static rhw_buffer make(struct rig *rig, const char *label)
{
    unsigned char bytes[SIZE];
    for (int i = 0; i < SIZE; i++) {
        bytes[i] = (unsigned char)i;
    }
    const struct rhw_buffer_def def = {.size = SIZE, .data = bytes, .label = label};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

static void expect_bytes(struct rig *rig, rhw_buffer buffer, const char *expected)
{
    void *bytes;
    assert_int_equal(rhw_buffer_map(rig->context, buffer, 0, 0, RHW_MAP_READ, &bytes), RHW_OK);
    assert_memory_equal(bytes, expected, SIZE);
    rhw_buffer_unmap(rig->context, buffer);
}

static void test_fill(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_buffer buffer = make(&rig, "filled");
    assert_int_equal(rhw_buffer_fill(rig.context, buffer, 4, 8, 0xa1b2c3d4), RHW_OK);
    expect_bytes(&rig, buffer, "\0\1\2\3\xd4\xc3\xb2\xa1\xd4\xc3\xb2\xa1\14\15\16\17\20\21\22\23\24\25");
    // To the end: whole words, of which the last two bytes are none.
    assert_int_equal(rhw_buffer_fill(rig.context, buffer, 12, 0, 7), RHW_OK);
    expect_bytes(&rig, buffer, "\0\1\2\3\xd4\xc3\xb2\xa1\xd4\xc3\xb2\xa1\7\0\0\0\7\0\0\0\24\25");
    assert_int_equal(rhw_buffer_fill(rig.context, buffer, 20, 0, 9), RHW_OK);
    expect_bytes(&rig, buffer, "\0\1\2\3\xd4\xc3\xb2\xa1\xd4\xc3\xb2\xa1\7\0\0\0\7\0\0\0\24\25");
    rhw_buffer_fill(rig.context, buffer, 2, 4, 0);
    rig_expect_misuse(&rig, "rhw_buffer_fill: offset is 2 and size is 4; they are multiples of 4");
    rhw_buffer_fill(rig.context, buffer, 4, 3, 0);
    rig_expect_misuse(&rig, "size is 3; they are multiples of 4");
    rhw_buffer_fill(rig.context, buffer, 16, 8, 0);
    rig_expect_misuse(&rig, "together they must stay within the 22 bytes of buffer 1 \"filled\"");
    rig_close(&rig);
}

static void test_copy(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_buffer a = make(&rig, NULL), b = make(&rig, "target");
    assert_int_equal(rhw_buffer_copy(rig.context, a, 1, b, 17, 5), RHW_OK);
    expect_bytes(&rig, b, "\0\1\2\3\4\5\6\7\10\11\12\13\14\15\16\17\20\1\2\3\4\5");
    assert_int_equal(rhw_buffer_copy(rig.context, b, 17, b, 0, 3), RHW_OK);
    expect_bytes(&rig, b, "\1\2\3\3\4\5\6\7\10\11\12\13\14\15\16\17\20\1\2\3\4\5");
    assert_int_equal(rhw_buffer_copy(rig.context, b, 0, b, 3, 3), RHW_OK); // side by side
    rhw_buffer_copy(rig.context, b, 0, b, 2, 3);
    rig_expect_misuse(&rig, "bytes 0 and 2 of buffer 2 \"target\" are copied to each other, 3 of them");
    rhw_buffer_copy(rig.context, a, 20, b, 0, 3);
    rig_expect_misuse(&rig, "rhw_buffer_copy: offset is 20 and size is 3");
    rhw_buffer_copy(rig.context, a, 0, b, 22, 1);
    rig_expect_misuse(&rig, "rhw_buffer_copy: offset is 22 and size is 1");
    rig_close(&rig);
}

// Draws that were recorded keep the vertices that they were recorded with.
static void test_while_recording(void **state)
{
    (void)state;
    static const float one[] = {1, 1, 1, 1};
    for (int copies = 0; copies < 2; copies++) {
        struct rig rig;
        rig_open(&rig, 8, 8);
        struct rig_vertex vertices[6];
        rig_cover(&rig, 0, one, vertices);
        const struct rhw_buffer_def def = {.size = sizeof vertices, .data = vertices},
                                    zeros = {.size = sizeof vertices};
        rhw_buffer buffer, empty;
        assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
        assert_int_equal(rhw_buffer_create(rig.context, &zeros, &empty), RHW_OK);
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
        rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
        if (copies) {
            rhw_buffer_copy(rig.context, empty, 0, buffer, 0, sizeof vertices);
        } else {
            rhw_buffer_fill(rig.context, buffer, 0, 0, 0);
        }
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < 64; i++) {
            assert_memory_equal(pixels[i], one, sizeof one);
        }
        void *bytes;
        assert_int_equal(rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ, &bytes), RHW_OK);
        static const struct rig_vertex nothing[6];
        assert_memory_equal(bytes, nothing, sizeof nothing);
        rig_close(&rig);
    }
}

static void test_map(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    static const float value[] = {1, 2, 3, 4}, other[] = {5, 6, 7, 8};
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0, value, vertices);
    const struct rhw_buffer_def def = {.size = sizeof vertices, .label = "mapped"};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    void *bytes;
    assert_int_equal(rhw_buffer_map(rig.context, buffer, sizeof *vertices, 0, RHW_MAP_READ_WRITE, &bytes),
                     RHW_OK);
    memcpy(bytes, vertices + 1, sizeof vertices - sizeof *vertices);
    rhw_buffer_unmap(rig.context, buffer);
    assert_int_equal(rhw_buffer_write(rig.context, buffer, 0, vertices, sizeof *vertices), RHW_OK);
    // Mapped for reading, passes read it too.
    assert_int_equal(rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ, &bytes), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig)[63], value, sizeof value);
    rhw_buffer_unmap(rig.context, buffer);
    // What is written between two passes is drawn by the second.
    assert_int_equal(rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ_WRITE, &bytes), RHW_OK);
    for (int i = 0; i < 6; i++) {
        memcpy(((struct rig_vertex *)bytes)[i].value, other, sizeof other);
    }
    rhw_buffer_unmap(rig.context, buffer);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig)[0], other, sizeof other);
    rig_close(&rig);
}

static void test_misuse_of_maps(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const rhw_buffer buffer = make(&rig, "mapped");
    void *bytes = &rig, *again;
    rhw_buffer_unmap(rig.context, buffer);
    rig_expect_misuse(&rig, "rhw_buffer_unmap: buffer 1 \"mapped\" is not mapped");
    rhw_buffer_map(rig.context, buffer, 20, 4, RHW_MAP_READ, &bytes);
    rig_expect_misuse(&rig, "rhw_buffer_map: offset is 20 and size is 4");
    assert_null(bytes);
    rhw_buffer_map(rig.context, buffer, 0, 0, (enum rhw_map_access)9, &bytes);
    rig_expect_misuse(&rig, "access is 9; not an access");
    rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ, NULL);
    rig_expect_misuse(&rig, "data is NULL");
    assert_int_equal(rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ_WRITE, &bytes), RHW_OK);
    rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ, &again);
    rig_expect_misuse(&rig, "buffer 1 \"mapped\" is mapped already");
    rhw_buffer_write(rig.context, buffer, 0, "", 1);
    rig_expect_misuse(&rig, "rhw_buffer_write: buffer 1 \"mapped\" is mapped; call rhw_buffer_unmap first");
    rhw_buffer_fill(rig.context, buffer, 0, 4, 0);
    rig_expect_misuse(&rig, "rhw_buffer_fill: buffer 1 \"mapped\" is mapped");
    const rhw_buffer other = make(&rig, NULL);
    rhw_buffer_copy(rig.context, other, 0, buffer, 0, 4);
    rig_expect_misuse(&rig, "rhw_buffer_copy: buffer 1 \"mapped\" is mapped");
    rhw_texture_copy_to_buffer(rig.context, rig.pass.colors[0].texture,
                               &(struct rhw_texture_region){.width = 1, .height = 1}, buffer, NULL);
    rig_expect_misuse(&rig, "rhw_texture_copy_to_buffer: buffer 1 \"mapped\" is mapped");
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    rig_expect_misuse(&rig, "rhw_pass_set_vertex_buffer: bytes 0 to 22 of buffer 1 \"mapped\" are mapped for "
                            "writing; call rhw_buffer_unmap first");
    rhw_pass_set_index_buffer(rig.context, rig.recording, buffer, RHW_INDEX_UINT8, 0);
    rig_expect_misuse(
        &rig, "rhw_pass_set_index_buffer: bytes 0 to 22 of buffer 1 \"mapped\" are mapped for writing");
    rhw_pass_draw_indirect(rig.context, rig.recording,
                           &(struct rhw_draw_commands){.buffer = buffer, .count = 1});
    rig_expect_misuse(&rig,
                      "rhw_pass_draw_indirect: bytes 0 to 22 of buffer 1 \"mapped\" are mapped for writing");
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, other, 0);
    rhw_buffer_map(rig.context, other, 2, 3, RHW_MAP_READ_WRITE, &again);
    rig_expect_misuse(&rig,
                      "rhw_buffer_map: it writes bytes 2 to 5 of buffer 2; a vertex, index or read-only "
                      "buffer of this pass reads bytes 0 to 22");
    rhw_pass_cancel(rig.context, rig.recording);
    assert_int_equal(rhw_buffer_map(rig.context, other, 0, 0, RHW_MAP_READ_WRITE, &again), RHW_OK);
    rhw_buffer_destroy(rig.context, other);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_fill),
    cmocka_unit_test(test_copy),
    cmocka_unit_test(test_while_recording),
    cmocka_unit_test(test_map),
    cmocka_unit_test(test_misuse_of_maps),
};

const struct unit_tests test_buffer_transfer = UNIT_TESTS(tests, NULL, NULL);
