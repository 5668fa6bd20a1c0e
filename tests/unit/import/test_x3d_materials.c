// SPDX-License-Identifier: MIT
// Materials of X3D, and their textures.
#include "model_files.h"

#include <stdio.h>
#include <string.h>

#define SHAPE(appearance)                                                                  \
    "<Shape><Appearance>" appearance "</Appearance><IndexedFaceSet coordIndex='0 1 2 -1'>" \
    "<Coordinate point='0 0 0 1 0 0 0 1 0'/><TextureCoordinate point='0 0 1 0 0 "          \
    "1'/></IndexedFaceSet></Shape>"

// Writes a.tga, two texels of these alphas.
static void write_texels(const unsigned char alpha[2])
{
    const unsigned char tga[] = {0, 0, 2, 0,  0, 0,  0,  0,  0,        0,  0,   0,  2,
                                 0, 1, 0, 32, 8, 90, 90, 90, alpha[0], 10, 200, 30, alpha[1]};
    write_bytes("a.tga", tga, sizeof tga);
}

// Materials of X3D 4 keep their colours.
static void test_materials(void **state)
{
    (void)state;
    static const char told[] = "physically based materials (X3D): drawn dull, in their base colour";
    static const struct {
        const char *text;
        float color[3], emissive[3];
        bool is_unlit, is_told;
    } cases[] = {
        {"<Material diffuseColor='1 0 0'/>", {1, 0, 0}, {0, 0, 0}, false, false},
        {"<UnlitMaterial emissiveColor='0 1 0'/>", {0, 1, 0}, {0, 0, 0}, true, false},
        {"<UnlitMaterial></UnlitMaterial>", {1, 1, 1}, {0, 0, 0}, true, false},
        {"<UnlitMaterial/><ImageTexture url='\"a.tga\"'/>", {1, 1, 1}, {0, 0, 0}, true, false},
        {"<PhysicalMaterial metallic='0' baseColor='0 0 1'/>", {0, 0, 1}, {0, 0, 0}, false, true},
        {"<PhysicalMaterial DEF='baseColors' baseColor = '0 0 1'/>", {0, 0, 1}, {0, 0, 0}, false, true},
        {"<PhysicalMaterial DEF='p' emissiveColor='1 0 0'/>", {1, 1, 1}, {1, 0, 0}, false, true},
        {"<Material diffuseColor='1 0 0'><!-- none --></Material>", {1, 0, 0}, {0, 0, 0}, false, false},
    };
    write_texels((const unsigned char[]){255, 255});
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("m.x3d", "<X3D><Scene>" SHAPE("%s") "</Scene></X3D>", cases[i].text);
        struct scene_model *const model = load("m.x3d");
        const struct scene_material *const material = &model->materials[model->meshes[0].material];
        assert_floats(material->base_color, cases[i].color, 3, 0);
        assert_floats(material->emissive, cases[i].emissive, 3, 0);
        assert_int_equal(material->unlit, cases[i].is_unlit);
        assert_int_equal(is_unsupported(model, told), cases[i].is_told);
        assert_int_equal(model->unsupported_count, cases[i].is_told);
        scene_model_free(model);
    }
    struct scene_model *model = load_text(
        "l.x3d", "<X3D><Scene><Shape><Appearance><UnlitMaterial emissiveColor='1 0 0'/></Appearance>"
                 "<IndexedLineSet coordIndex='0 1 -1'><Coordinate point='0 0 0 1 0 0'/>"
                 "</IndexedLineSet></Shape></Scene></X3D>");
    assert_floats(model->materials[model->meshes[0].material].base_color, (const float[]){1, 0, 0}, 3, 0);
    scene_model_free(model);
    model = load_text("u.x3d", "<X3D><Scene>" SHAPE("<UnlitMaterial DEF='u' emissiveColor='1 0 0'/>")
                                   SHAPE("<UnlitMaterial USE='u'/>") "</Scene></X3D>");
    assert_int_equal(model->mesh_count, 2);
    for (int i = 0; i < 2; i++) {
        assert_floats(model->materials[model->meshes[i].material].base_color, (const float[]){1, 0, 0}, 3, 0);
    }
    scene_model_free(model);
}

// A shape without an appearance has no colour of another one, in front of it or behind.
static void test_shapes_without_appearance(void **state)
{
    (void)state;
    static const char points[] = "<IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate "
                                 "point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet>";
    write_format("w.x3d",
                 "<X3D><Scene><Shape DEF='s'><!-- <Appearance/> -->%s</Shape>"
                 "<Shape><Appearance><Material diffuseColor='1 0 0'/></Appearance>%s</Shape>"
                 "<Shape>%s</Shape ><Shape/><Shape USE='s'/><Shape USE='s'></Shape></Scene></X3D>",
                 points, points, points);
    struct scene_model *const model = load("w.x3d");
    unsigned red = 0;
    assert_int_equal(model->mesh_count, 5);
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        red += model->materials[model->meshes[i].material].base_color[1] == 0;
    }
    assert_int_equal(red, 1);
    assert_int_equal(model->unsupported_count + model->warning_count, 0);
    scene_model_free(model);
}

// The alpha of a texture is that of its surface, in AC3D too.
static void test_alpha_of_textures(void **state)
{
    (void)state;
    static const struct {
        unsigned char alpha[2];
        enum scene_alpha_mode mode;
    } cases[] = {
        {{255, 255}, SCENE_ALPHA_OPAQUE}, {{0, 255}, SCENE_ALPHA_MASK}, {{128, 100}, SCENE_ALPHA_BLEND}};
    write_text("a.x3d", "<X3D><Scene>" SHAPE("<ImageTexture url='\"a.tga\"'/>") "</Scene></X3D>");
    write_text(
        "a.ac",
        "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
        "OBJECT world\nkids 1\nOBJECT poly\nname \"a\"\ntexture \"a.tga\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\n"
        "numsurf 1\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids 0\n");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_texels(cases[i].alpha);
        for (int k = 0; k < 2; k++) {
            struct scene_model *const model = load(k == 0 ? "a.x3d" : "a.ac");
            assert_int_equal(model->image_count, 1);
            assert_int_equal(model->warning_count + model->unsupported_count, 0);
            if (model->materials[model->meshes[0].material].alpha_mode != cases[i].mode) {
                fail_msg("case %zu, %d: %d", i, k,
                         (int)model->materials[model->meshes[0].material].alpha_mode);
            }
            scene_model_free(model);
        }
    }
}

// Textures stand in the fields of materials. The one of the colour is drawn.
static void test_textures_of_materials(void **state)
{
    (void)state;
    static const char physical[] = "physically based materials (X3D): drawn dull, in their base colour",
                      normals[] = "textures of the field normalTexture (X3D): not used",
                      glow[] = "textures of the field emissiveTexture (X3D): not used";
    static const struct {
        const char *text;
        bool is_drawn;
        const char *told[2];
    } cases[] = {
        {"<Material><ImageTexture containerField='diffuseTexture' url='\"a.tga\"'/></Material>", true, {NULL}},
        {"<PhysicalMaterial baseColor='1 1 1'>\n<ImageTexture containerField='baseTexture' "
         "url='\"a.tga\"'></ImageTexture></PhysicalMaterial>",
         true,
         {physical}},
        {"<UnlitMaterial><ImageTexture containerField=\"emissiveTexture\" url='\"a.tga\"'/></UnlitMaterial>",
         true,
         {NULL}},
        {"<Material><ImageTexture containerField='normalTexture' url='\"b.tga\"'/>"
         "<ImageTexture containerField='emissiveTexture' url='\"b.tga\"'></ImageTexture></Material>"
         "<ImageTexture url='\"a.tga\"'/>",
         true,
         {normals, glow}},
        {"<PhysicalMaterial><ImageTexture containerField='normalTexture' "
         "url='\"b.tga\"'/></PhysicalMaterial>",
         false,
         {physical, normals}},
        // One that is left out may hold a comment, and others whose names begin as its own does.
        {"<Material><ImageTexture containerField='normalTexture' url='\"b.tga\"'><!-- c "
         "--><ImageTextureProperties>"
         "</ImageTextureProperties ><MetadataString value='m'/></ImageTexture ></Material>"
         "<ImageTexture url='\"a.tga\"'/>",
         true,
         {normals}},
        {"<Material><MultiTexture containerField='normalTexture'><ImageTexture "
         "url='\"b.tga\"'/><MultiTexture>"
         "</MultiTexture></MultiTexture><ImageTexture url='\"a.tga\"'/></Material>",
         true,
         {normals, "textures above each other: not drawn"}},
    };
    write_texels((const unsigned char[]){255, 255});
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("m.x3d", "<X3D><Scene>" SHAPE("%s") "</Scene></X3D>", cases[i].text);
        struct scene_model *const model = load("m.x3d");
        const struct scene_material *const material = &model->materials[model->meshes[0].material];
        assert_int_equal(material->slots[SCENE_SLOT_BASE_COLOR].image, cases[i].is_drawn ? 0 : -1);
        assert_int_equal(model->image_count, cases[i].is_drawn);
        assert_int_equal(model->warning_count, 0);
        for (size_t k = 0; k < 2; k++) {
            assert_true(cases[i].told[k] == NULL || is_unsupported(model, cases[i].told[k]));
        }
        assert_int_equal(model->unsupported_count, (cases[i].told[0] != NULL) + (cases[i].told[1] != NULL));
        scene_model_free(model);
    }
}

// A texture that is used again is in the field of where it is used.
static void test_textures_that_are_used_again(void **state)
{
    (void)state;
    static const struct {
        const char *first, *second;
        bool is_drawn[2];
    } cases[] = {
        {"", "containerField='normalTexture'", {true, false}},
        {"containerField='normalTexture'", "", {false, true}},
        {"containerField='diffuseTexture'", "containerField=\"emissiveTexture\"", {true, false}},
        {"containerField = \"emissiveTexture\"", "containerField='diffuseTexture'", {false, true}},
        {"containerField='diffuseTexture'", "containerField='diffuseTexture'", {true, true}},
    };
    write_texels((const unsigned char[]){255, 255});
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("u.x3d",
                     "<X3D><Scene>" SHAPE("<Material><ImageTexture DEF='t' %s url='\"a.tga\"'/></Material>")
                         SHAPE("<Material><ImageTexture USE='t' %s/></Material>") "</Scene></X3D>",
                     cases[i].first, cases[i].second);
        struct scene_model *const model = load("u.x3d");
        assert_int_equal(model->mesh_count, 2);
        for (int k = 0; k < 2; k++) {
            const struct scene_material *const material = &model->materials[model->meshes[k].material];
            assert_true((material->slots[SCENE_SLOT_BASE_COLOR].image >= 0) == cases[i].is_drawn[k]);
        }
        assert_int_equal(model->warning_count, 0);
        scene_model_free(model);
    }
}

// Textures are repeated unless the file says otherwise.
static void test_repeat(void **state)
{
    (void)state;
    static const struct {
        const char *fields;
        enum rhw_address u, v;
    } cases[] = {
        {"", RHW_ADDRESS_REPEAT, RHW_ADDRESS_REPEAT},
        {"repeatS='true' repeatT='false'", RHW_ADDRESS_REPEAT, RHW_ADDRESS_CLAMP},
        {"repeatS='false'", RHW_ADDRESS_CLAMP, RHW_ADDRESS_REPEAT},
    };
    write_texels((const unsigned char[]){255, 255});
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("r.x3d", "<X3D><Scene>" SHAPE("<ImageTexture url='\"a.tga\"' %s/>") "</Scene></X3D>",
                     cases[i].fields);
        struct scene_model *const model = load("r.x3d");
        const struct scene_texture_slot *const slot =
            &model->materials[model->meshes[0].material].slots[SCENE_SLOT_BASE_COLOR];
        assert_int_equal(slot->address_u, cases[i].u);
        assert_int_equal(slot->address_v, cases[i].v);
        scene_model_free(model);
    }
}

// Texture coordinates are moved, turned around the center, then scaled from there, as the standard multiplies these.
static void test_texture_transforms(void **state)
{
    (void)state;
    static const struct {
        const char *fields;
        float transform[6];
    } cases[] = {
        {"", {1, 0, 0, 0, 1, 0}},
        {"translation='0.25 0.125'", {1, 0, 0.25f, 0, 1, -0.125f}},
        {"DEF='t' translation='0.25 0' scale='2 4'", {2, 0, 0.5f, 0, 4, -3}},
        {"center='0.5 0.25' scale='2 4'", {2, 0, 0.5f, 0, 4, -3.75f}},
        {"translation='0.25 0.5' center='0.5 0.25' scale='2 3' rotation='1.57079633'", {0, 2, -4, -3, 0, -1}},
    };
    write_texels((const unsigned char[]){255, 255});
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        write_format(
            "t.x3d",
            "<X3D><Scene>" SHAPE("<ImageTexture url='\"a.tga\"'/><TextureTransform %s%s") "</Scene></X3D>",
            cases[i / 2].fields, i % 2 == 0 ? "/>" : "></TextureTransform>");
        struct scene_model *const model = load("t.x3d");
        const struct scene_texture_slot *const slot =
            &model->materials[model->meshes[0].material].slots[SCENE_SLOT_BASE_COLOR];
        assert_floats(slot->transform, cases[i / 2].transform, 6, 1e-5f);
        scene_model_free(model);
    }
}

// A texture lies on faces without coordinates along their longest dimension, and the second of these across.
static void test_usual_places(void **state)
{
    (void)state;
    static const struct {
        const char *set;
        float places[4][2]; // of the points in the order of the file, upward
    } cases[] = {
        {"<IndexedFaceSet coordIndex='0 1 2 3 -1' texCoordIndex='3 3 3 3 -1'><Coordinate point='1 5 0 5 5 0 "
         "5 7 0 1 "
         "7 0'/></IndexedFaceSet>",
         {{0, 0}, {1, 0}, {1, 0.5f}, {0, 0.5f}}},
        {"<QuadSet><Coordinate point='0 0 0 0 1 0 0 1 4 0 0 4'/></QuadSet>",
         {{0, 0}, {0, 0.25f}, {1, 0.25f}, {1, 0}}},
        {"<IndexedTriangleSet index='0 1 2 0 2 3'><Coordinate point='0 0 2 2 0 2 2 0 0 0 0 "
         "0'/></IndexedTriangleSet>",
         {{0, 1}, {1, 1}, {1, 0}, {0, 0}}},
    };
    write_texels((const unsigned char[]){255, 255});
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("p.x3d",
                     "<X3D><Scene><Shape><Appearance><ImageTexture "
                     "url='\"a.tga\"'/></Appearance>%s</Shape></Scene></X3D>",
                     cases[i].set);
        struct scene_model *const model = load("p.x3d");
        const struct scene_mesh *const mesh = &model->meshes[0];
        assert_int_equal(model->unsupported_count + model->warning_count, 0);
        assert_int_equal(model->triangles_drawn, 2);
        for (size_t k = 0; k < 4; k++) {
            bool found = false;
            for (uint32_t v = 0; v < mesh->vertex_count; v++) {
                found = found || (mesh->uvs[0][v][0] == cases[i].places[k][0] &&
                                  mesh->uvs[0][v][1] == 1 - cases[i].places[k][1]);
            }
            if (!found) {
                fail_msg("case %zu: point %zu is not there", i, k);
            }
        }
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_materials),
    cmocka_unit_test(test_shapes_without_appearance),
    cmocka_unit_test(test_alpha_of_textures),
    cmocka_unit_test(test_textures_of_materials),
    cmocka_unit_test(test_textures_that_are_used_again),
    cmocka_unit_test(test_repeat),
    cmocka_unit_test(test_usual_places),
    cmocka_unit_test(test_texture_transforms),
};

const struct unit_tests test_x3d_materials = UNIT_TESTS(tests, make_directory, remove_directory);
