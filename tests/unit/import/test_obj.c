// SPDX-License-Identifier: MIT
// OBJ and MTL beyond their specification: the PBR extension and its maps, options of textures, factors beside textures,
// and files that are cut.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"

// A picture of 2×1 texels, RGB.
static void write_picture(const char *name, const unsigned char texels[6])
{
    unsigned char bytes[24] = {[2] = 2, [12] = 2, [14] = 1, [16] = 24};
    for (int i = 0; i < 2; i++) {
        for (int c = 0; c < 3; c++) {
            bytes[18 + 3 * i + c] = texels[3 * i + 2 - c]; // TGA has blue first
        }
    }
    write_bytes(name, bytes, sizeof bytes);
}

static struct scene_model *load_material(const char *lines)
{
    write_format("m.mtl", "newmtl m\n%s", lines);
    return load_text("m.obj", "mtllib m.mtl\n" TRIANGLE);
}

static const struct scene_material *material_of(const struct scene_model *model)
{
    return &model->materials[model->meshes[0].material];
}

// Roughness from the green channel of one file, metallic from the other: each takes the place of its number.
static void test_surface_maps(void **state)
{
    (void)state;
    write_picture("rough.tga", (const unsigned char[]){1, 64, 2, 3, 128, 4});
    write_picture("metal.tga", (const unsigned char[]){200, 5, 6, 100, 7, 8});
    struct scene_model *model =
        load_material("Pr 0.2\nPm 0.3\nmap_Pr -s 2 2 1 -imfchan g rough.tga\nmap_Pm metal.tga\n");
    assert_int_equal(model->warning_count, 0);
    const struct scene_material *material = material_of(model);
    const struct scene_texture_slot *slot = &material->slots[SCENE_SLOT_METALLIC_ROUGHNESS];
    assert_floats(&material->roughness, (const float[]){1}, 1, 0);
    assert_floats(&material->metallic, (const float[]){1}, 1, 0);
    assert_floats(slot->transform, (const float[]){2, 0, 0, 0, 2, -1}, 6, 0);
    const struct scene_image *image = &model->images[slot->image];
    assert_int_equal(image->width, 2);
    assert_memory_equal(image->texels, ((const uint8_t[]){255, 64, 200, 255, 255, 128, 100, 255}), 8);
    assert_true(image->used_as_data);
    scene_model_free(model);
}

// Coats, sheen and anisotropy; a map takes the place of its number.
static void test_layers(void **state)
{
    (void)state;
    struct scene_model *model =
        load_material("Ps 0.5\nPc 0.25\nPcr 0.125\nmap_Pc metal.tga\naniso 0.75\nanisor 0.25\n");
    const struct scene_material *material = material_of(model);
    const struct scene_layers *layers = &material->layers;
    assert_true(layers->used);
    assert_floats(&layers->clearcoat, (const float[]){1}, 1, 0);
    assert_floats(&layers->clearcoat_roughness, (const float[]){0.125f}, 1, 0);
    assert_floats(layers->sheen_color, (const float[]){0.5f, 0.5f, 0.5f}, 3, 0);
    assert_floats(&layers->anisotropy, (const float[]){0.75f}, 1, 0);
    assert_floats(layers->anisotropy_direction, (const float[]){0, 1}, 2, 1e-6f);
    assert_true(material->slots[SCENE_SLOT_CLEARCOAT].image >= 0);
    scene_model_free(model);
    model = load_material("Pr 0.5\nmap_Ps metal.tga\n");
    assert_false(material_of(model)->layers.used);
    assert_true(is_unsupported(model, "sheen textures"));
    scene_model_free(model);
}

// One of the two: the other stays a number.
static void test_one_surface_map(void **state)
{
    (void)state;
    struct scene_model *model = load_material("Pr 0.2\nPm 0.3\nmap_Pm metal.tga\n");
    const struct scene_material *material = material_of(model);
    const struct scene_image *image = &model->images[material->slots[SCENE_SLOT_METALLIC_ROUGHNESS].image];
    assert_floats(&material->roughness, (const float[]){0.2f}, 1, 0);
    assert_floats(&material->metallic, (const float[]){1}, 1, 0);
    assert_memory_equal(image->texels, ((const uint8_t[]){255, 255, 200, 255, 255, 255, 100, 255}), 8);
    scene_model_free(model);
}

static void test_missing_surface_map(void **state)
{
    (void)state;
    struct scene_model *model = load_material("Pr 0.25\nmap_Pr none.tga\n");
    assert_true(has_warning(model, "texture \"none.tga\": No such file or directory; left out"));
    assert_int_equal(material_of(model)->slots[SCENE_SLOT_METALLIC_ROUGHNESS].image, -1);
    assert_floats(&material_of(model)->roughness, (const float[]){0.25f}, 1, 0);
    scene_model_free(model);
}

static void test_emission_and_relief(void **state)
{
    (void)state;
    struct scene_model *model = load_material("Ke 0.5 0 1\nmap_Ke metal.tga\nnorm -bm 2.5 rough.tga\n");
    const struct scene_material *material = material_of(model);
    assert_floats(material->emissive, (const float[]){0.21404114f, 0, 1}, 3, 1e-6f);
    assert_true(material->slots[SCENE_SLOT_EMISSIVE].image >= 0);
    assert_true(material->slots[SCENE_SLOT_NORMAL].image >= 0);
    assert_floats(&material->normal_scale, (const float[]){2.5f}, 1, 0);
    scene_model_free(model);
}

// A cut-out in an opacity map needs no blending, and no mask where all of it is there. The map stands before the base
// colour's image, or is it.
static void test_opacity_maps(void **state)
{
    (void)state;
    write_picture("base.tga", (const unsigned char[]){200, 0, 0, 0, 100, 0});
    write_picture("holes.tga", (const unsigned char[]){255, 255, 255, 0, 0, 0});
    write_picture("half.tga", (const unsigned char[]){255, 255, 255, 128, 128, 128});
    write_picture("full.tga", (const unsigned char[]){255, 255, 255, 255, 255, 255});
    static const struct {
        const char *lines;
        enum scene_alpha_mode mode;
        uint8_t texels[8];
    } cases[] = {
        {"map_Kd base.tga\nmap_d holes.tga\n", SCENE_ALPHA_MASK, {200, 0, 0, 255, 0, 100, 0, 0}},
        {"map_d holes.tga\n", SCENE_ALPHA_MASK, {255, 255, 255, 255, 255, 255, 255, 0}},
        {"map_Kd base.tga\nmap_d half.tga\n", SCENE_ALPHA_BLEND, {200, 0, 0, 255, 0, 100, 0, 128}},
        {"map_Kd base.tga\nmap_d full.tga\n", SCENE_ALPHA_OPAQUE, {200, 0, 0, 255, 0, 100, 0, 255}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_material(cases[i].lines);
        const struct scene_material *const material = material_of(model);
        assert_int_equal(material->alpha_mode, cases[i].mode);
        const struct scene_image *const image = &model->images[material->slots[SCENE_SLOT_BASE_COLOR].image];
        assert_memory_equal(image->texels, cases[i].texels, 8);
        scene_model_free(model);
    }
}

// Write a DDS of two texels of floats.
static void write_floats(const char *name, const float texels[8])
{
    uint32_t head[32] = {0x20534444, 124, 0x1007, 1, 2};
    head[19] = 32;
    head[20] = 4;   // a code
    head[21] = 116; // of R32G32B32A32
    head[27] = 0x1000;
    unsigned char bytes[sizeof head + 8 * sizeof *texels];
    memcpy(bytes, head, sizeof head);
    memcpy(bytes + sizeof head, texels, 8 * sizeof *texels);
    write_bytes(name, bytes, sizeof bytes);
}

// Return a value of an image, of which 255 is the whole.
static float value_of(const struct scene_image *image, size_t place)
{
    return image->type == SCENE_IMAGE_RGBA8 ? ((const uint8_t *)image->texels)[place]
                                            : 255 * ((const float *)image->texels)[place];
}

// The alpha of a colour's texture is none of the material's, unless the file says so, also where the material lets
// light through. It is so in images of floats too.
static void test_alpha_of_colors(void **state)
{
    (void)state;
    const unsigned char bytes[26] = {[2] = 2, [12] = 2, [14] = 1, [16] = 32, [17] = 8, [18] = 3, 2,
                                     1,       128,      6,        5,         4,        0};
    write_bytes("clear.tga", bytes, sizeof bytes);
    write_floats("clear.dds", (const float[]){1, 2, 3, 128 / 255.0f, 4, 5, 6, 0});
    write_floats("grey.dds", (const float[]){128 / 255.0f, 0.5f, 0.5f, 1, 0, -1, 0, 1});
    static const struct {
        const char *lines;
        enum scene_alpha_mode mode;
        float opacity, alphas[2], red;
    } cases[] = {
        {"d 0.5\nmap_Kd clear.tga\n", SCENE_ALPHA_BLEND, 0.5f, {255, 255}, 4},
        {"d 0.5\nmap_Kd clear.tga\nmap_d clear.tga\n", SCENE_ALPHA_BLEND, 0.5f, {128, 0}, 4},
        {"map_Kd clear.tga\n", SCENE_ALPHA_OPAQUE, 1, {128, 0}, 4},
        {"d 0.5\nmap_Kd clear.dds\n", SCENE_ALPHA_BLEND, 0.5f, {255, 255}, 4 * 255},
        {"map_Kd clear.tga\nmap_d clear.dds\n", SCENE_ALPHA_BLEND, 1, {128, 0}, 4},
        {"map_Kd clear.dds\nmap_d grey.dds\n", SCENE_ALPHA_BLEND, 1, {128, 0}, 4 * 255},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *const model = load_material(cases[i].lines);
        const struct scene_material *const material = material_of(model);
        const struct scene_image *const image = &model->images[material->slots[SCENE_SLOT_BASE_COLOR].image];
        assert_int_equal(material->alpha_mode, cases[i].mode);
        assert_floats(&material->base_color[3], &cases[i].opacity, 1, 0);
        assert_float_equal(value_of(image, 3), cases[i].alphas[0], 1e-4f);
        assert_float_equal(value_of(image, 7), cases[i].alphas[1], 0);
        assert_float_equal(value_of(image, 4), cases[i].red, 0);
        scene_model_free(model);
    }
}

// Images of floats are roughness, metal and heights as others are.
static void test_maps_of_floats(void **state)
{
    (void)state;
    write_floats("map.dds", (const float[]){200 / 255.0f, 0, 0, 1, 2, -1, 0, 1});
    struct scene_model *model = load_material("map_Pm map.dds\n");
    const struct scene_image *image =
        &model->images[material_of(model)->slots[SCENE_SLOT_METALLIC_ROUGHNESS].image];
    assert_memory_equal(image->texels, ((const uint8_t[]){255, 255, 200, 255, 255, 255, 255, 255}), 8);
    scene_model_free(model);
    write_floats("heights.dds", (const float[]){1, 1, 1, 1, 1, 1, 1, 1});
    model = load_material("map_bump heights.dds\n");
    image = &model->images[material_of(model)->slots[SCENE_SLOT_NORMAL].image];
    assert_memory_equal(image->texels, ((const uint8_t[]){128, 128, 255, 255, 128, 128, 255, 255}), 8);
    scene_model_free(model);
}

// Heights become normals by central differences, around the edges too: 255 stands for 4 texels. Normals stay what they are.
static void test_heights(void **state)
{
    (void)state;
    enum { WIDTH = 4, HEIGHT = 2 };
    static const uint8_t heights[WIDTH * HEIGHT] = {0, 0, 255, 0,
                                                    0, 0, 255, 0}; // the same from below and above
    unsigned char bytes[18 + 3 * WIDTH * HEIGHT] = {[2] = 2, [12] = WIDTH, [14] = HEIGHT, [16] = 24};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        memset(bytes + 18 + 3 * i, heights[i], 3);
    }
    write_bytes("heights.tga", bytes, sizeof bytes);
    struct scene_model *model = load_material("map_bump heights.tga\n");
    const struct scene_image *image = &model->images[material_of(model)->slots[SCENE_SLOT_NORMAL].image];
    // A slope of 2 is (2, 0, 1) / √5: 0.894427 and 0.447214, of 127.5 around 128.
    static const uint8_t row[WIDTH * 4] = {128, 128, 255, 255, 13,  128, 185, 255,
                                           128, 128, 255, 255, 242, 128, 185, 255};
    for (int y = 0; y < HEIGHT; y++) {
        assert_memory_equal((const uint8_t *)image->texels + sizeof row * (size_t)y, row, sizeof row);
    }
    assert_false(image->has_alpha);
    scene_model_free(model);
    bytes[18] = 90; // not grey
    write_bytes("heights.tga", bytes, sizeof bytes);
    model = load_material("map_bump heights.tga\n");
    image = &model->images[material_of(model)->slots[SCENE_SLOT_NORMAL].image];
    assert_memory_equal(image->texels, ((const uint8_t[]){0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255}),
                        12);
    scene_model_free(model);
}

// Grey beside a texture is what exporters write; a colour is meant.
static void test_factors(void **state)
{
    (void)state;
    static const struct {
        const char *lines;
        float color[4];
    } cases[] = {
        {"Kd 0.588 0.588 0.588\nmap_Kd metal.tga\n", {1, 1, 1, 1}},
        {"Kd 0 0 0\nmap_Kd metal.tga\n", {1, 1, 1, 1}},
        {"map_Kd metal.tga\n", {1, 1, 1, 1}},
        {"Kd 1 0.5 0\nmap_Kd metal.tga\n", {1, 0.21404114f, 0, 1}},
        {"Kd 0.5 0.5 0.5\n", {0.21404114f, 0.21404114f, 0.21404114f, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_material(cases[i].lines);
        assert_floats(material_of(model)->base_color, cases[i].color, 4, 1e-6f);
        scene_model_free(model);
    }
}

// A # that stands alone begins a comment; one in a name does not.
static void test_comments(void **state)
{
    (void)state;
    write_text("a b.mtl", "newmtl _Material #25 # of 3ds Max\nKd 1 0 0 # red\n");
    struct scene_model *model = load_text(
        "m.obj",
        "mtllib a b.mtl # beside\nv 0 0 0 # here\nv 1 0 0\nv 0 1 0\nusemtl _Material #25 #\nf 1 2 3 # all\n");
    assert_int_equal(model->warning_count, 0);
    assert_string_equal(material_of(model)->name, "_Material #25");
    assert_floats(material_of(model)->base_color, (const float[]){1, 0, 0, 1}, 4, 0);
    scene_model_free(model);
}

static void test_cut(void **state)
{
    (void)state;
    struct scene_model *model = load_text("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3");
    assert_true(
        has_warning(model, "may be cut: it ends within line 6, and 1 of its 4 vertices are in no face"));
    assert_true(has_warning(model, "1 faces of fewer than three corners are left out"));
    scene_model_free(model);
    write_text("x.obj", "v 0 0 0\nv 1 0");
    expect_refused("x.obj", "line 2, where the file ends or is cut: a vertex needs three numbers");
    // Whole ones without a last line end, and with vertices nobody uses.
    model = load_text("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    assert_int_equal(model->warning_count, 0);
    scene_model_free(model);
    model = load_text("x.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 2 2\nf 1 2 3\n");
    assert_int_equal(model->warning_count, 0);
    scene_model_free(model);
}

#define FACE "f 1 2 3\n"

// Colours of 0 to 1, of 0 to 255, behind a weight, and of ZBrush's comments. 128 of 255 is 0.21586 linear.
static void test_vertex_colors(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "v 0 0 0 1 0.50196078 0\nv 1 0 0 1 0.50196078 0\nv 0 1 0 1 0.50196078 0\n" FACE,
        "v 0 0 0 255 128 0\nv 1 0 0 255 128 0\nv 0 1 0 255 128 0\n" FACE,
        "v 0 0 0 1.0 255 128 0\nv 1 0 0 1.0 255 128 0\nv 0 1 0 1.0 255 128 0\n" FACE,
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB ffff8000FFFF8000\n#MRGB 00ff8000\n" FACE,
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct scene_model *model = load_text("c.obj", texts[i]);
        assert_int_equal(model->warning_count + model->unsupported_count, 0);
        for (uint32_t v = 0; v < 3; v++) {
            assert_floats(model->meshes[0].colors[v], (const float[]){1, 0.2158605f, 0, 1}, 4, 1e-6f);
        }
        assert_floats(material_of(model)->base_color, (const float[]){1, 1, 1, 1}, 4, 0);
        scene_model_free(model);
    }
    // A vertex without a colour is white, and the black of bytes stays black.
    struct scene_model *model = load_text("c.obj", "v 0 0 0\nv 1 0 0 0 0 1\nv 0 1 0 255 0 0\n" FACE);
    assert_floats(model->meshes[0].colors[0], (const float[]){1, 1, 1, 1}, 4, 0);
    assert_floats(model->meshes[0].colors[1], (const float[]){0, 0, 0.0003035f, 1}, 4, 1e-6f);
    scene_model_free(model);
}

// What is not drawn is told, each by its name.
static void test_told(void **state)
{
    (void)state;
    static const char *const materials[][2] = {
        {"map_Ka other.tga\nmap_Kd rough.tga\n", "ambient textures"},
        {"map_Tr rough.tga\n", "textures of map_Tr (MTL)"},
        {"map_Ks rough.tga\n", "specular textures"},
        {"map_Ns rough.tga\n", "shininess textures"},
        {"refl -type sphere rough.tga\n", "reflection textures"},
        {"disp rough.tga\n", "displacement textures"},
        {"decal rough.tga\n", "decal textures"},
        {"Kd spectral curve.rfl\n", "colours as \"spectral\""},
        {"d -halo 0.5\n", "d -halo"},
        {"Ks 1 0.9 0.5\n", "coloured highlights: drawn white"},
        {"Tf 1 0.5 0.5\n", "colours of transmitted light (Tf)"},
        {"map_Kd -mm 0.25 1 rough.tga\n", "-mm of textures (MTL)"},
        {"map_Kd -t 0.5 rough.tga\n", "-t of textures (MTL)"},
        {"map_Kd -type sphere rough.tga\n", "-type of textures (MTL)"},
        {"map_Kd -boost 2 rough.tga\n", "-boost of textures (MTL)"},
        {"map_Kd -cc on rough.tga\n", "-cc of textures (MTL)"},
        {"map_Kd -blendu off rough.tga\n", "-blendu of textures (MTL)"},
        {"map_Kd -imfchan r rough.tga\n", "-imfchan of textures (MTL)"},
        {"map_Pcr -imfchan b rough.tga\n", "-imfchan of textures (MTL)"},
        {"map_Kd -colorspace linear rough.tga\n", "-colorspace of textures (MTL)"},
        {"map_Pr -colorspace sRGB rough.tga\n", "-colorspace of textures (MTL)"},
        {"Kz 1\n", "\"Kz\" has no meaning (MTL): its lines are left out"},
    };
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++) {
        struct scene_model *model = load_material(materials[i][0]);
        if (!is_unsupported(model, materials[i][1]) || model->unsupported_count > 2) {
            fail_msg("%s: %u lines", materials[i][1], model->unsupported_count);
        }
        scene_model_free(model);
    }
    struct scene_model *model = load_material(
        "Ka 1 1 1\nKs 0.5 0.51 0.5\nNi 1.5\nillum 2\nsharpness 60\nTf 1 1 1\nmap_aat on\n"
        "map_Kd -mm 0 1 -t 0 0 0 -cc off -blendv on -texres 512 -clamp on -colorspace srgb rough.tga\n"
        "map_Ka rough.tga\nmap_Pr -imfchan g -colorspace linear rough.tga\nbump -imfchan l rough.tga\n");
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
    static const char *const without_highlights[] = {"illum 1\n", "illum 0\n", "Pm 1\n"};
    for (size_t i = 0; i < sizeof without_highlights / sizeof without_highlights[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "Ks 1 0.9 0.5\n%s", without_highlights[i]);
        model = load_material(text);
        assert_int_equal(model->unsupported_count, 0);
        scene_model_free(model);
    }
    static const char *const numbers[][2] = {
        {"Kd red\n", "\"Kd red\" (MTL) is no number: left out"},
        {"Ns\n", "\"Ns \" (MTL) is no number: left out"},
        {"Ke nan 0 0\n", "\"Ke nan 0 0\" (MTL) is no number: left out"},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        model = load_material(numbers[i][0]);
        assert_true(has_warning(model, numbers[i][1]));
        scene_model_free(model);
    }
    write_text("m.mtl", "Kd 1 0 0\nnewmtl m\n");
    model = load_text("m.obj", "mtllib m.mtl\n" TRIANGLE);
    assert_true(is_unsupported(model, "what stands before the first newmtl (MTL): not used"));
    scene_model_free(model);
}

// Statements that are not drawn are told, and words that mean nothing, each by its name and once; those beyond the
// eighth share a line.
static void test_statements(void **state)
{
    (void)state;
    static const char *const statements[][2] = {
        {"call other.obj", "other files, which call names: not drawn"},
        {"csh ls", "commands (csh): not drawn"},
        {"cstype bezier\nvp 1\ncurv 0 1 1 2\nend", "free-form curves and surfaces: not drawn"},
        {"surf 0 1 0 1 1 2 3", "free-form curves and surfaces: not drawn"},
        {"bzp 1 2 3", "free-form curves and surfaces: not drawn"},
        {"usemap a", "texture maps (usemap): not drawn"},
        {"shadow_obj a.obj", "other objects for shadows (shadow_obj): not drawn"},
        {"trace_obj a.obj", "other objects for reflections (trace_obj): not drawn"},
        {"d_interp on", "d_interp (OBJ): not used"},
        {"lod 3", "lod (OBJ): not used"},
        {"#MRGB ffff8000", "1 colours in comments (#MRGB): not drawn, as it has another number of vertices"},
        {"vt 0 0 0.5", "texture coordinates of three numbers: the third is not used"},
        {"vt 0 0 0.5 # third", "texture coordinates of three numbers: the third is not used"},
        {"vc 1 0 0\nvc 0 1 0", "\"vc\" has no meaning (OBJ): its lines are left out"},
    };
    for (size_t i = 0; i < sizeof statements / sizeof statements[0]; i++) {
        write_format("t.obj", TRIANGLE "%s\n", statements[i][0]);
        struct scene_model *const model = load("t.obj");
        if (!is_unsupported(model, statements[i][1]) || model->unsupported_count != 1) {
            fail_msg("%s: %u lines", statements[i][0], model->unsupported_count);
        }
        scene_model_free(model);
    }
    struct scene_model *model = load_text("t.obj", "v 0 0 0 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1\nl\n");
    assert_true(has_warning(model, "two numbers behind a vertex, which OBJ gives no meaning, are ignored"));
    assert_true(has_warning(model, "2 lines of fewer than two corners are left out"));
    scene_model_free(model);
    model = load_text("t.obj", TRIANGLE "vt 0 0 0\nmg 1 1\nbevel off\nc_interp off\nlod 0\ns off\n# \ng\n");
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
    model = load_text("t.obj", TRIANGLE "w1\nw2\nw3\nw4\nw5\nw6\nw7\nw8\nw9\nw10\nw1\nw9\n");
    assert_true(is_unsupported(model, "more words without a meaning (OBJ): their lines are left out"));
    assert_int_equal(model->unsupported_count, 9);
    scene_model_free(model);
}

// Check the normal that a mesh has at a corner of a triangle.
static void assert_normal(const struct scene_model *model, uint32_t corner, const float expected[3])
{
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_floats(mesh->normals[mesh->indices[corner]], expected, 3, 1e-4f);
}

// A quad that is folded by 55° keeps its fold, and one that is folded by 20°, as round surfaces have it, is smooth. OFF
// and PLY do as OBJ does.
static void test_folded_quads(void **state)
{
    (void)state;
    static const char *const names[] = {"q.obj", "q.off", "q.ply"};
    write_text("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 -1\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n");
    write_text("q.off", "OFF 6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 -1\n2 0 0\n2 1 0\n4 0 1 2 3\n4 1 4 5 2\n");
    write_text("q.ply",
               "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
               "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0\n1 0 0\n1 1 0\n0 1 -1\n2 0 0\n2 1 0\n4 0 1 2 3\n4 1 4 5 2\n");
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        struct scene_model *model = load(names[i]);
        for (uint32_t corner = 0; corner < 12; corner++) {
            const bool up = corner < 3 || corner >= 6;
            assert_normal(model, corner,
                          up ? (const float[]){0, 0, 1} : (const float[]){-0.57735f, 0.57735f, 0.57735f});
        }
        scene_model_free(model);
    }
    struct scene_model *model = load_text("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 -0.25\nf 1 2 3 4\n");
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_int_equal(mesh->vertex_count, 4);
    scene_model_free(model);
}

// Many materials take time by their number, not by its square, which would be more than the limit.
static void test_many_materials(void **state)
{
    (void)state;
    enum { COUNT = 40000, LINE = 32 };
    char *text = malloc(COUNT * LINE + 64), error[256] = "", *end = text;
    end += sprintf(end, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for (int i = 0; i < COUNT; i++) {
        end += sprintf(end, "usemtl m%d\nf 1 2 3\n", i);
    }
    write_bytes("many.obj", text, (size_t)(end - text));
    free(text);
    const struct scene_model_options options = {.seconds = 8};
    struct scene_model *model = scene_model_load(path_of("many.obj"), &options, error, sizeof error);
    assert_string_equal(error, "");
    assert_non_null(model);
    assert_int_equal(model->material_count, COUNT);
    assert_int_equal(model->mesh_count, COUNT);
    scene_model_free(model);
}

// Lines that are read in one pass mean what they mean with a comment behind them, which makes them go the long way.
static void test_plain_lines(void **state)
{
    (void)state;
    static const char *const bodies[] = {
        "v 0 0 0\nv 1 0 0.5\nv\t1 1e0 -.25\nv 0 1 12345678.125 1\nf 1 2 3 4\nf -4 -3 -1\n",
        "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 1 0 0 1\nf 1 2 3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5\nvt 1 0.25\nvt 0 1 0\nf 1/1 2/2 3/3\nf 3/-1 2/-2 1/-3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nvn 0 0 1\nvn 0 1 1\nf 1//1 2//2 3//1\nf 1/1/1 2/1/2 3/1/2\n",
        ("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nv -1 1 0\nv -2 1 0\nv -3 .5 0\nv -2 .1 0\n"
         "f 1 2 3 4 5 6 7 8 9\nf 1 2 3 4 5 6 7 8\nf 1  2\t3 \n"),
    };
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++) {
        for (int ending = 0; ending < 3; ending++) {
            char plain[1024], remarked[1024], *p = plain, *r = remarked;
            for (const char *c = bodies[i]; *c != 0; c++) {
                const char *const end = ending == 0 ? "\n" : ending == 1 ? "\r\n" : "\r";
                char line_end[4], letter[2] = {*c, 0};
                snprintf(line_end, sizeof line_end, "%s", end);
                p += sprintf(p, "%s", *c == '\n' ? line_end : letter);
                r += *c == '\n' ? sprintf(r, " #%s", line_end) : sprintf(r, "%s", letter);
            }
            struct scene_model *const a = load_text("plain.obj", plain), *const b =
                                                                             load_text("odd.obj", remarked);
            assert_same_meshes(a, b);
            scene_model_free(a);
            scene_model_free(b);
        }
    }
}

// A line may name several libraries, and their names may have blanks.
static void test_libraries(void **state)
{
    (void)state;
    static const struct {
        const char *line, *warning;
        float red;
    } cases[] = {
        {"a b one.mtl", NULL, 1},
        {"a b one.mtl a b two.mtl", NULL, 1},
        {"a b two.mtl a b one.mtl", NULL, 1},
        {"plain.mtl a b one.mtl", NULL, 1},
        {"a b three.mtl", "material library \"a b three.mtl\"", 0},
        {"gone plain.mtl", "material library \"gone\"", 0.5f},
        {"plain plain.mtl", NULL, 0.5f},
    };
    write_text("a b one.mtl", "newmtl m\nKd 1 0 0\n");
    write_text("a b two.mtl", "newmtl n\nKd 0 1 0\n");
    write_text("plain.mtl", "newmtl m\nKd 0.735357 0 0\n");
    write_text("plain", "newmtl m\nKd 0 0 0\n");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_format("l.obj", "mtllib %s\n" TRIANGLE, cases[i].line);
        struct scene_model *const model = load("l.obj");
        if (model->warning_count != (cases[i].warning != NULL) ||
            (cases[i].warning != NULL && !has_warning(model, cases[i].warning))) {
            fail_msg("case %zu: %u warnings, %s", i, model->warning_count,
                     model->warning_count > 0 ? model->warnings[0] : "");
        }
        const float red = material_of(model)->base_color[0];
        if (cases[i].warning == NULL && (red < cases[i].red - 0.01f || red > cases[i].red + 0.01f)) {
            fail_msg("case %zu: %g", i, (double)red);
        }
        scene_model_free(model);
    }
    char line[2 * 70 + 16] = ""; // too many words for one name
    for (int i = 0; i < 70; i++) {
        strcat(line, "w ");
    }
    write_format("l.obj", "mtllib %sgone.mtl\n" TRIANGLE, line);
    struct scene_model *const model = load("l.obj");
    assert_true(has_warning(model, "material library \"w\""));
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_surface_maps),
    cmocka_unit_test(test_layers),
    cmocka_unit_test(test_one_surface_map),
    cmocka_unit_test(test_missing_surface_map),
    cmocka_unit_test(test_emission_and_relief),
    cmocka_unit_test(test_opacity_maps),
    cmocka_unit_test(test_alpha_of_colors),
    cmocka_unit_test(test_maps_of_floats),
    cmocka_unit_test(test_heights),
    cmocka_unit_test(test_factors),
    cmocka_unit_test(test_comments),
    cmocka_unit_test(test_cut),
    cmocka_unit_test(test_vertex_colors),
    cmocka_unit_test(test_told),
    cmocka_unit_test(test_statements),
    cmocka_unit_test(test_folded_quads),
    cmocka_unit_test(test_many_materials),
    cmocka_unit_test(test_plain_lines),
    cmocka_unit_test(test_libraries),
};

const struct unit_tests test_obj = UNIT_TESTS(tests, make_directory, remove_directory);
