// SPDX-License-Identifier: MIT
// Colours of a DXF: those of entities, of their layers and of insertions, by number and true ones.
#include "model_files.h"

#define SECTION(name, pairs) "0\nSECTION\n2\n" name "\n" pairs "0\nENDSEC\n"
#define FACE(pairs)                                                                                         \
    "0\n3DFACE\n" pairs "10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32\n0\n13\n0\n23\n1\n33\n" \
    "0\n"
#define LAYER(pairs) SECTION("TABLES", "0\nTABLE\n2\nLAYER\n0\nLAYER\n2\na l\n" pairs "0\nENDTAB\n")

static const char near[] = "colours (DXF): drawn in the nearest of sixteen";

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
        {SECTION("BLOCKS", "0\nBLOCK\n2\nb\n10\n0\n20\n0\n30\n0\n" FACE("8\n0\n62\n0\n") "0\nENDBLK\n")
             SECTION("ENTITIES", "0\nINSERT\n2\nb\n8\n0\n62\n6\n10\n0\n20\n0\n30\n0\n"),
         {1, 0, 1},
         false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("c.dxf", "%s0\nEOF\n", cases[i].text);
        struct scene_model *const model = load("c.dxf");
        const struct scene_mesh *const mesh = &model->meshes[model->instances[0].mesh];
        assert_non_null(mesh->colors);
        for (int c = 0; c < 3; c++) {
            const float difference = mesh->colors[0][c] - cases[i].color[c];
            if (difference > 1e-3f || difference < -1e-3f) {
                fail_msg("case %zu: %d is %g", i, c, (double)mesh->colors[0][c]);
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
