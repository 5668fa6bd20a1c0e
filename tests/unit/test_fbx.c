// SPDX-License-Identifier: MIT
// FBX files that are cut, which assimp would draw as far as they go.
#include "model_files.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const unsigned char end_mark[16] = {0xf8, 0x5a, 0x8c, 0x6a, 0xde, 0xf5, 0xd9, 0x7e,
                                           0xec, 0xe9, 0x0c, 0xe3, 0x75, 0x8f, 0x29, 0x0b};

// A file of one empty record, the null record and the footer, in both widths of its numbers. Returns its size.
static size_t make_binary(unsigned char bytes[256], int version)
{
    const size_t word = version >= 7500 ? 8 : 4, record = 3 * word + 1;
    memset(bytes, 0, 256);
    memcpy(bytes, "Kaydara FBX Binary  \0\x1a", 22);
    memcpy(bytes + 23, &version, 4);
    bytes[27] = (unsigned char)(27 + record + 4); // where it ends
    bytes[27 + record - 1] = 4;
    memcpy(bytes + 27 + record, "Test", 4);
    const size_t footer = 27 + record + 4 + record;
    memcpy(bytes + footer + 120, end_mark, sizeof end_mark);
    return footer + 120 + sizeof end_mark;
}

// A whole one is no model, which is what is said of it then; what is cut is told by the byte.
static void test_binary(void **state)
{
    (void)state;
    unsigned char bytes[256];
    for (int version = 7400; version <= 7500; version += 100) {
        const size_t word = version >= 7500 ? 8 : 4, end = 27 + 3 * word + 1 + 4;
        const size_t size = make_binary(bytes, version);
        char cause[128];
        write_bytes("x.fbx", bytes, size);
        expect_refused("x.fbx", "cannot be read");
        snprintf(cause, sizeof cause, "is cut: a part of it should end at byte %zu; it has %zu", end,
                 end - 1);
        write_bytes("x.fbx", bytes, end - 1);
        expect_refused("x.fbx", cause);
        snprintf(cause, sizeof cause, "is cut: a part of it should begin at byte %zu; it has %zu", end,
                 end + 3);
        write_bytes("x.fbx", bytes, end + 3);
        expect_refused("x.fbx", cause);
    }
}

static void test_text(void **state)
{
    (void)state;
    write_text("x.fbx", "; FBX 7.5.0 project file { {\nA: \"{\" {\n}\n");
    expect_refused("x.fbx", "cannot be read");
    write_text("x.fbx", "; FBX 7.5.0 project file\nA: \"}\" {\n B: {\n");
    expect_refused("x.fbx", "is cut: 2 of its sections are open where it ends");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_binary),
        cmocka_unit_test(test_text),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
