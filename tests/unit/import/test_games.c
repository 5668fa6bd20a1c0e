// SPDX-License-Identifier: MIT
// Models for games: their frames, their skins, and what their materials send out.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Write a model of Quake II, a triangle, with this many frames and the name of its skin.
static void write_md2(const char *name, const char *skin, int32_t frames)
{
    enum {
        SKIN = 64,
        CORNERS = 3,
        FRAME = 40 + 4 * CORNERS,
        HEAD = 68,
        ST = HEAD + 64,
        FACES = ST + 4 * CORNERS
    };
    enum {
        FRAMES = FACES + 12,
        MAX_FRAMES = 2,
        SLACK = 256
    }; // assimp refuses files that end where frames do
    unsigned char bytes[FRAMES + MAX_FRAMES * FRAME + SLACK] = {0};
    const int32_t end = FRAMES + frames * FRAME;
    const int32_t head[] = {0x32504449, 8,      SKIN, SKIN, FRAME, 1,      CORNERS, CORNERS, 1,
                            0,          frames, HEAD, ST,   FACES, FRAMES, HEAD,    end};
    static const uint16_t face[] = {0, 1, 2, 0, 1, 2};
    static const float scale[3] = {1, 1, 1};
    memcpy(bytes, head, sizeof head);
    strcpy((char *)bytes + HEAD, skin);
    memcpy(bytes + FACES, face, sizeof face);
    for (int32_t i = 0; i < frames; i++) {
        unsigned char *const frame = bytes + FRAMES + i * FRAME;
        memcpy(frame, scale, sizeof scale);
        frame[40 + 4] = frame[40 + 8 + 1] = 9;
    }
    write_bytes(name, bytes, sizeof bytes);
}

static void test_frames(void **state)
{
    (void)state;
    for (int32_t frames = 1; frames <= 2; frames++) {
        write_md2("f.md2", "", frames);
        struct scene_model *const model = load("f.md2");
        assert_int_equal(model->meshes[0].vertex_count, 3);
        assert_true(is_unsupported(model, "frames after the first: not drawn") == (frames > 1));
        scene_model_free(model);
    }
}

// The skin of a model for games lies beside it where its file names none, or one that is not there.
static void test_skins(void **state)
{
    (void)state;
    static const struct {
        const char *skin, *files[2], *found;
        bool is_told; // which one is drawn, or that none is
        bool is_doubtful;
    } cases[] = {
        {"models/a/b.pcx", {"s/b.ppm"}, "b.ppm", false, false},
        {"models\\a\\b.ppm", {"b.ppm", "s/c.pgm"}, "../b.ppm", true, false},
        {"b.pcx", {"b.ppm", NULL}, NULL, true, false}, // it may be a picture, by its ending
        {"b.pcx", {"s/X.pgm", "s/c.pgm"}, "X.pgm", true, false},
        {"", {"s/x.pgm", "s/c.pgm"}, "x.pgm", true, false},
        {"b.pcx", {"s/skin.ppm", "s/c.pgm"}, "skin.ppm", true, false},
        {"b.pcx", {"skin.ppm", "s/c.pgm"}, "../skin.ppm", true, false},
        {"b.pcx", {"s/c.pgm", NULL}, "c.pgm", true, false},
        {"b.pcx", {"c.pgm", NULL}, "../c.pgm", true, false},
        {"b.pcx", {"s/c.pgm", "s/d.pgm"}, NULL, true, false},
        {"b.pcx", {"c.pgm", "d.pgm"}, NULL, true, false},
        {"", {NULL, NULL}, NULL, false, false},
        // Pictures of models that were drawn into the folder are no skins, nor do they hide one.
        {"", {"s/x.ppm", NULL}, NULL, false, true},
        {"", {"s/y.md2.png", NULL}, NULL, false, false},
        {"", {"x.webp", "s/x.exr"}, NULL, false, true},
        {"b.pcx", {"s/x.jpg", NULL}, NULL, true, true},
        {"", {"s/x.png", "s/x.pgm"}, "x.pgm", true, false},
        {"b.pcx", {"s/x.ppm", "s/c.pgm"}, "c.pgm", true, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(mkdir(path_of("g"), 0700) | mkdir(path_of("g/s"), 0700), 0);
        for (size_t k = 0; k < 2 && cases[i].files[k] != NULL; k++) {
            char path[64];
            snprintf(path, sizeof path, "g/%s", cases[i].files[k]);
            write_bytes(path, "P6\n1 1\n255\n\x10\x20\x30", 14);
        }
        write_md2("g/s/x.md2", cases[i].skin, 1);
        struct scene_model *const model = load("g/s/x.md2");
        const bool is_there = model->image_count == 1 && !model->images[0].missing;
        assert_int_equal(is_there, cases[i].found != NULL);
        assert_int_equal(model->warning_count, cases[i].is_told + cases[i].is_doubtful);
        assert_true(has_warning(model, "may be a picture of the model") == cases[i].is_doubtful);
        assert_int_equal(model->unsupported_count, cases[i].skin[0] == 0 && cases[i].found == NULL);
        if (is_there) {
            assert_string_equal(model->images[0].name, cases[i].is_told ? cases[i].found : cases[i].skin);
            char line[64];
            snprintf(line, sizeof line, "\"%s\" %s", cases[i].found,
                     cases[i].skin[0] == 0 ? "beside it is drawn" : "is drawn");
            assert_true(has_warning(model, line) == cases[i].is_told);
        }
        scene_model_free(model);
        remove_folder("g/s");
        remove_folder("g");
    }
}

// What the alpha of a skin means the game alone knows.
static void test_skin_alpha(void **state)
{
    (void)state;
    static const unsigned char head[18] = {
        [2] = 2, [12] = 1, [14] = 1, [16] = 32, [17] = 8}; // an uncompressed TGA
    for (int is_opaque = 0; is_opaque < 2; is_opaque++) {
        unsigned char bytes[sizeof head + 4] = {0};
        memcpy(bytes, head, sizeof head);
        bytes[sizeof bytes - 1] = is_opaque ? 255 : 128;
        write_bytes("a.tga", bytes, sizeof bytes);
        write_md2("a.md2", "a.tga", 1);
        struct scene_model *const model = load("a.md2");
        assert_false(model->images[0].missing);
        assert_true(is_unsupported(model, "alpha of skins: not used") != is_opaque);
        scene_model_free(model);
    }
}

// What a material sends out comes through its texture where programs multiply the sum of all light by it.
static void test_glow(void **state)
{
    (void)state;
    write_bytes("a.ppm", "P6\n1 1\n255\n\x10\x20\x30", 14);
    for (int is_textured = 0; is_textured < 2; is_textured++) {
        write_format("a.ac",
                     "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 1 1 1 spec 0 0 0 shi 0 trans 0\nOBJECT "
                     "world\nkids 1\nOBJECT poly\nname \"a\"\n%snumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\n"
                     "SURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids 0\n",
                     is_textured ? "texture \"a.ppm\"\n" : "");
        struct scene_model *const model = load("a.ac");
        const struct scene_material *const material = &model->materials[model->meshes[0].material];
        assert_int_equal(material->slots[SCENE_SLOT_EMISSIVE].image, is_textured - 1);
        assert_floats(material->emissive, (const float[]){1, 1, 1}, 3, 0);
        scene_model_free(model);
    }
}

// What is wholly transparent is meant to be, as surfaces are that are clicked: it is not drawn opaque.
static void test_clear(void **state)
{
    (void)state;
    static const char *const opacities[] = {"0", "0.75", "1"};
    for (size_t i = 0; i < sizeof opacities / sizeof opacities[0]; i++) {
        write_format("a.ac",
                     "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans %s\nOBJECT "
                     "world\nkids 1\nOBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\n"
                     "SURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids 0\n",
                     opacities[i]);
        struct scene_model *const model = load("a.ac");
        const struct scene_material *const material = &model->materials[model->meshes[0].material];
        const float alpha = 1 - strtof(opacities[i], NULL);
        assert_true(material->base_color[3] == alpha);
        assert_int_equal(material->alpha_mode, i == 0 ? SCENE_ALPHA_OPAQUE : SCENE_ALPHA_BLEND);
        assert_int_equal(model->warning_count, 0);
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_frames), cmocka_unit_test(test_skins), cmocka_unit_test(test_skin_alpha),
    cmocka_unit_test(test_glow),   cmocka_unit_test(test_clear),
};

const struct unit_tests test_games = UNIT_TESTS(tests, make_directory, remove_directory);
