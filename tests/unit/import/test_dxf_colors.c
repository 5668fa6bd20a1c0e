// SPDX-License-Identifier: MIT
// Colours of a DXF: those of entities, of their layers and of insertions, by number and true ones.
#include <stdio.h>
#include <string.h>

#include "model_files.h"

#define SECTION(name, pairs) "0\nSECTION\n2\n" name "\n" pairs "0\nENDSEC\n"
#define FACE(pairs)                                                                                         \
    "0\n3DFACE\n" pairs "10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32\n0\n13\n0\n23\n1\n33\n" \
    "0\n"
#define LAYER(pairs) SECTION("TABLES", "0\nTABLE\n2\nLAYER\n0\nLAYER\n2\na l\n" pairs "0\nENDTAB\n")
#define LAYERS       LAYER("62\n2\n0\nLAYER\n2\n0\n62\n1\n")

#define BLOCK(entity) SECTION("BLOCKS", "0\nBLOCK\n2\nb\n10\n0\n20\n0\n30\n0\n" entity "0\nENDBLK\n")
#define INSERT(pairs) SECTION("ENTITIES", "0\nINSERT\n2\nb\n" pairs "10\n0\n20\n0\n30\n0\n")

static const char near[] = "colours (DXF): drawn in the nearest of sixteen";

enum spelling { WITH_FEEDS, WITH_RETURNS, WITH_BOTH, LITTLE_UTF_16, BIG_UTF_16, SPELLINGS };

// Write a drawing whose lines end as one of many programs writes them, or in words of two bytes behind a mark.
static void write_spelled(const char *text, enum spelling spelling)
{
    char bytes[4096];
    size_t size = 0;
    const bool is_wide = spelling == LITTLE_UTF_16 || spelling == BIG_UTF_16;
    assert_true(2 * strlen(text) + 2 < sizeof bytes);
    if (is_wide) {
        bytes[size++] = spelling == BIG_UTF_16 ? '\xfe' : '\xff';
        bytes[size++] = spelling == BIG_UTF_16 ? '\xff' : '\xfe';
    }
    for (const char *c = text; *c != 0; c++) {
        if (*c == '\n' && (spelling == WITH_RETURNS || spelling == WITH_BOTH)) {
            bytes[size++] = '\r';
        }
        if (spelling == BIG_UTF_16) {
            bytes[size++] = 0;
        }
        if (*c != '\n' || spelling != WITH_RETURNS) {
            bytes[size++] = *c;
        }
        if (spelling == LITTLE_UTF_16) {
            bytes[size++] = 0;
        }
    }
    write_bytes("c.dxf", bytes, size);
}

static void test_colors(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        float color[3];
        bool is_near;
    } cases[] = {
        {SECTION("ENTITIES", FACE("8\n0\n62\n1\n")), {1, 0, 0}, false},
        {SECTION("ENTITIES", FACE("8\n0\n 62\n     2\n")), {1, 1, 0}, false},
        {SECTION("ENTITIES", FACE("62\n3\n8\n0\n")), {0, 1, 0}, false},
        {SECTION("ENTITIES", FACE("8\n0\n62\n4\n")), {0.0732f, 1, 0.0732f}, true},
        {SECTION("ENTITIES", FACE("8\n0\n62\n5\n")), {0, 0, 1}, false},
        {SECTION("ENTITIES", FACE("8\n0\n62\n170\n")), {0, 0, 1}, false},
        {SECTION("ENTITIES", FACE("8\n0\n62\n6\n")), {1, 0, 1}, false},
        {SECTION("ENTITIES", FACE("8\n0\n62\n7\n")), {0.3185f, 0.3185f, 0.3185f}, false},
        {SECTION("ENTITIES", FACE("8\n0\n")), {0.3185f, 0.3185f, 0.3185f}, false},
        {SECTION("ENTITIES", FACE("8\n0\n62\n30\n")), {1, 0.3185f, 0}, false},
        {SECTION("ENTITIES", FACE("8\n0\n62\n255\n")), {1, 1, 1}, false},
        {SECTION("ENTITIES", FACE("8\n0\n62\n7\n420\n16776960\n")), {1, 1, 0}, false},
        {LAYER("62\n2\n") SECTION("ENTITIES", FACE("8\na l\n")), {1, 1, 0}, false},
        {LAYER("62\n2\n420\n255\n") SECTION("ENTITIES", FACE("8\na l\n")), {0, 0, 1}, false},
        {LAYER("62\n2\n") SECTION("ENTITIES", FACE("8\na l\n62\n256\n")), {1, 1, 0}, false},
        {LAYER("62\n2\n") SECTION("ENTITIES", FACE("8\na l\n62\n3\n")), {0, 1, 0}, false},
        {LAYER("62\n2\n") SECTION("ENTITIES", FACE("8\nother\n")), {0.3185f, 0.3185f, 0.3185f}, false},
        {LAYER("62\n2\n") SECTION("ENTITIES", "0\nCIRCLE\n8\na l\n10\n0\n20\n0\n30\n0\n40\n2\n"),
         {1, 1, 0},
         false},
        {BLOCK(FACE("8\n0\n62\n0\n")) INSERT("8\n0\n62\n6\n"), {1, 0, 1}, false},
        {LAYERS BLOCK(FACE("8\n0\n")) INSERT("8\na l\n"), {1, 1, 0}, false},
        {LAYERS BLOCK(FACE("8\n0\n62\n256\n")) INSERT("8\na l\n62\n6\n"), {1, 0, 1}, false},
        {LAYERS BLOCK(FACE("")) INSERT("8\na l\n"), {1, 1, 0}, false},
        {LAYERS BLOCK(FACE("8\n0\n62\n3\n")) INSERT("8\na l\n"), {0, 1, 0}, false},
        {LAYERS BLOCK(FACE("8\na l\n")) INSERT("8\n0\n62\n6\n"), {1, 1, 0}, false},
        {LAYERS BLOCK(FACE("8\n0\n")) INSERT("8\n0\n"), {1, 0, 0}, false},
        {LAYERS BLOCK(FACE("8\n0\n")) INSERT("8\nother\n"), {0.3185f, 0.3185f, 0.3185f}, false},
    };
    const size_t count = sizeof cases / sizeof cases[0];
    for (size_t each = 0; each < count * SPELLINGS; each++) {
        const size_t i = each / SPELLINGS;
        char text[2048];
        snprintf(text, sizeof text, "%s0\nEOF\n", cases[i].text);
        write_spelled(text, (enum spelling)(each % SPELLINGS));
        struct scene_model *const model = load("c.dxf");
        const struct scene_mesh *const mesh = &model->meshes[model->instances[0].mesh];
        assert_non_null(mesh->colors);
        for (int c = 0; c < 3; c++) {
            const float difference = mesh->colors[0][c] - cases[i].color[c];
            if (difference > 1e-3f || difference < -1e-3f) {
                fail_msg("case %zu, spelling %zu: %d is %g", i, each % SPELLINGS, c,
                         (double)mesh->colors[0][c]);
            }
        }
        assert_int_equal(model->unsupported_count, cases[i].is_near);
        assert_true(is_unsupported(model, near) == cases[i].is_near);
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_colors),
};

const struct unit_tests test_dxf_colors = UNIT_TESTS(tests, make_directory, remove_directory);
