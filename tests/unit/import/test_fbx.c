// SPDX-License-Identifier: MIT
// FBX files that are cut, which assimp would draw as far as they go, and what assimp takes for something else.
#include "model_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

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

// Numbers of the other byte order would be places behind the end of the file.
static void test_order(void **state)
{
    (void)state;
    unsigned char bytes[256];
    const size_t size = make_binary(bytes, 7400);
    bytes[22] = 1;
    memcpy(bytes + 23, (const unsigned char[]){0, 0, 0x1c, 0xe8, 0, 0, 0, 44}, 8);
    write_bytes("x.fbx", bytes, size);
    expect_refused("x.fbx", "is a binary FBX in big-endian order, which is not supported");
}

static void test_text(void **state)
{
    (void)state;
    write_text("x.fbx", "; FBX 7.5.0 project file { {\nA: \"{\" {\n}\n");
    expect_refused("x.fbx", "cannot be read");
    write_text("x.fbx", "; FBX 7.5.0 project file\nA: \"}\" {\n B: {\n");
    expect_refused("x.fbx", "is cut: 2 of its sections are open where it ends");
}

// A light shines along its -Y, which its post-rotation of -90 degrees about X turns to -Z: it is applied backward.
static void test_light(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "light.fbx",
        "; FBX 7.4.0 project file\n"
        "FBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
        "Objects:  {\n"
        "\tGeometry: 10, \"Geometry::\", \"Mesh\" {\n"
        "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
        "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n"
        "\tModel: 11, \"Model::mesh\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n"
        "\tNodeAttribute: 20, \"NodeAttribute::\", \"Light\" {\n\t\tProperties70:  {\n"
        "\t\t\tP: \"LightType\", \"enum\", \"\", \"\",1\n\t\t}\n\t\tTypeFlags: \"Light\"\n\t}\n"
        "\tModel: 21, \"Model::lamp\", \"Light\" {\n\t\tVersion: 232\n\t\tProperties70:  {\n"
        "\t\t\tP: \"RotationActive\", \"bool\", \"\", \"\",1\n"
        "\t\t\tP: \"PostRotation\", \"Vector3D\", \"Vector\", \"\",-90,0,0\n\t\t}\n\t}\n"
        "}\n"
        "Connections:  {\n\tC: \"OO\",11,0\n\tC: \"OO\",10,11\n\tC: \"OO\",21,0\n\tC: \"OO\",20,21\n}\n");
    assert_int_equal(model->light_count, 1);
    assert_int_equal(model->lights[0].type, SCENE_LIGHT_DIRECTIONAL);
    assert_floats(model->lights[0].direction, (const float[]){0, 0, -1}, 3, 1e-6f);
    scene_model_free(model);
}

// Faces that do not say which of their model's materials they have have the first one. Words in strings and comments
// are no records.
static void test_first_material(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("first.fbx", "; FBX 7.4.0 project file LayerElementMaterial: {\n"
                               "FBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\n"
                               "Objects:  {\n"
                               "\tGeometry: 10, \"Geometry::LayerElementMaterial: }\", \"Mesh\" {\n"
                               "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
                               "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n"
                               "\tModel: 11, \"Model::mesh\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n"
                               "\tMaterial: 12, \"Material::first\", \"\" {\n\t\tVersion: 102\n\t}\n"
                               "\tMaterial: 13, \"Material::second\", \"\" {\n\t\tVersion: 102\n\t}\n"
                               "}\n"
                               "Connections:  {\n\tC: \"OO\",11,0\n\tC: \"OO\",10,11\n"
                               "\tC: \"OO\",12,11\n\tC: \"OO\",13,11\n}\n");
    assert_string_equal(model->materials[model->meshes[0].material].name, "first");
    scene_model_free(model);
}

// Exporters say how opaque a surface is in several ways.
static void test_opacity(void **state)
{
    (void)state;
#define NUMBER(name, value) "\t\t\tP: \"" name "\", \"Number\", \"\", \"A\"," value "\n"
#define COLOR(value)        "\t\t\tP: \"TransparentColor\", \"Color\", \"\", \"A\"," value "," value "," value "\n"
    static const struct {
        const char *properties;
        float opacity;
    } materials[] = {
        {"", 1},
        {NUMBER("Opacity", "0.75"), 0.75f},
        {NUMBER("TransparencyFactor", "0.25"), 0.75f},
        {COLOR("0.8") NUMBER("TransparencyFactor", "0.25"), 0.75f}, // as Blender writes it
        {COLOR("0") NUMBER("TransparencyFactor", "0.25"), 0.75f},
        {COLOR("0.25") NUMBER("TransparencyFactor", "1") NUMBER("Opacity", "0.75"), 0.75f}, // Maya
        {COLOR("1") NUMBER("TransparencyFactor", "0") NUMBER("Opacity", "0.75"), 0.75f},    // 3ds Max
        {COLOR("0.25"), 0.75f},
        {NUMBER("TransparencyFactor", "0.25") NUMBER("Opacity", "1"), 0.75f},
        {NUMBER("TransparencyFactor", "0"), 1},
        {NUMBER("TransparencyFactor", "1"), 1},
        {COLOR("1") NUMBER("TransparencyFactor", "0"), 1},
    };
#undef NUMBER
#undef COLOR
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++) {
        char text[2048];
        snprintf(
            text, sizeof text,
            "; FBX 7.4.0 project file\n"
            "FBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
            "Objects:  {\n"
            "\tGeometry: 10, \"Geometry::\", \"Mesh\" {\n"
            "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
            "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t\tGeometryVersion: 124\n"
            "\t\tLayerElementMaterial: 0 {\n\t\t\tMappingInformationType: \"AllSame\"\n"
            "\t\t\tReferenceInformationType: \"IndexToDirect\"\n"
            "\t\t\tMaterials: *1 {\n\t\t\t\ta: 0\n\t\t\t}\n\t\t}\n"
            "\t\tLayer: 0 {\n\t\t\tLayerElement:  {\n\t\t\t\tType: \"LayerElementMaterial\"\n"
            "\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t}\n\t}\n"
            "\tModel: 11, \"Model::mesh\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n"
            "\tMaterial: 12, \"Material::m\", \"\" {\n\t\tShadingModel: \"phong\"\n\t\tProperties70:  {\n"
            "\t\t\tP: \"DiffuseColor\", \"Color\", \"\", \"A\",0.8,0.2,0.1\n%s\t\t}\n\t}\n}\n"
            "Connections:  {\n\tC: \"OO\",11,0\n\tC: \"OO\",10,11\n\tC: \"OO\",12,11\n}\n",
            materials[i].properties);
        struct scene_model *const model = load_text("opacity.fbx", text);
        const struct scene_material *const material =
            &model->materials[model->meshes[model->instances[0].mesh].material];
        assert_true(material->base_color[3] == materials[i].opacity);
        assert_int_equal(material->alpha_mode,
                         materials[i].opacity < 1 ? SCENE_ALPHA_BLEND : SCENE_ALPHA_OPAQUE);
        scene_model_free(model);
    }
}

// Write a triangle with more objects, and their connections.
static void write_triangle(const char *objects, const char *connections)
{
    write_format("told.fbx",
                 "; FBX 7.4.0 project file\n"
                 "FBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\n"
                 "Objects:  {\n"
                 "\tGeometry: 10, \"Geometry::\", \"Mesh\" {\n"
                 "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
                 "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n"
                 "\tModel: 11, \"Model::mesh\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n%s}\n"
                 "Connections:  {\n\tC: \"OO\",11,0\n\tC: \"OO\",10,11\n%s}\n",
                 objects, connections);
}

// A morph target that a movement turns on, and a bone: at rest, and at a moment.
static void test_moved_meshes(void **state)
{
    (void)state;
    static const char *const told[][2] = {
        {"1 animation: drawn at rest", "skins: drawn in the pose the meshes are stored in"},
        {"animations of meshes and morph targets: left as at rest", NULL},
    };
    write_triangle(
        "\tDeformer: 20, \"Deformer::\", \"BlendShape\" {\n\t\tVersion: 100\n\t}\n"
        "\tDeformer: 21, \"SubDeformer::smile\", \"BlendShapeChannel\" {\n\t\tDeformPercent: 0\n"
        "\t\tFullWeights: *1 {\n\t\t\ta: 100\n\t\t}\n\t}\n"
        "\tGeometry: 22, \"Geometry::smile\", \"Shape\" {\n\t\tIndexes: *1 {\n\t\t\ta: 0\n\t\t}\n"
        "\t\tVertices: *3 {\n\t\t\ta: 0,0,1\n\t\t}\n\t\tNormals: *3 {\n\t\t\ta: 0,0,0\n\t\t}\n\t}\n"
        "\tAnimationStack: 30, \"AnimStack::move\", \"\" {\n\t}\n"
        "\tAnimationLayer: 31, \"AnimLayer::\", \"\" {\n\t}\n"
        "\tAnimationCurveNode: 32, \"AnimCurveNode::\", \"\" {\n\t\tProperties70:  {\n\t\t}\n\t}\n"
        "\tAnimationCurve: 33, \"AnimCurve::\", \"\" {\n\t\tKeyTime: *2 {\n\t\t\ta: 0,46186158000\n\t\t}\n"
        "\t\tKeyValueFloat: *2 {\n\t\t\ta: 0,100\n\t\t}\n\t}\n"
        "\tModel: 40, \"Model::bone\", \"LimbNode\" {\n\t\tVersion: 232\n\t}\n"
        "\tDeformer: 41, \"Deformer::\", \"Skin\" {\n\t\tVersion: 101\n\t}\n"
        "\tDeformer: 42, \"SubDeformer::\", \"Cluster\" {\n\t\tVersion: 100\n"
        "\t\tIndexes: *1 {\n\t\t\ta: 0\n\t\t}\n\t\tWeights: *1 {\n\t\t\ta: 1\n\t\t}\n"
        "\t\tTransform: *16 {\n\t\t\ta: 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n\t\t}\n"
        "\t\tTransformLink: *16 {\n\t\t\ta: 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1\n\t\t}\n\t}\n",
        "\tC: \"OO\",20,10\n\tC: \"OO\",21,20\n\tC: \"OO\",22,21\n\tC: \"OO\",31,30\n\tC: \"OO\",32,31\n"
        "\tC: \"OP\",32,21,\"DeformPercent\"\n\tC: \"OP\",33,32,\"d|DeformPercent\"\n"
        "\tC: \"OO\",40,0\n\tC: \"OO\",41,10\n\tC: \"OO\",42,41\n\tC: \"OO\",40,42\n");
    for (int i = 0; i < 2; i++) {
        const struct scene_model_options options = {.is_posed = i == 1, .time = 0.5};
        char error[512] = "";
        struct scene_model *const model =
            scene_model_load(path_of("told.fbx"), &options, error, sizeof error);
        assert_string_equal(error, "");
        assert_true(is_unsupported(model, "morph targets: drawn at rest"));
        assert_true(is_unsupported(model, told[i][0]));
        assert_true(told[i][1] == NULL || is_unsupported(model, told[i][1]));
        assert_int_equal(model->unsupported_count, told[i][1] == NULL ? 2 : 3);
        scene_model_free(model);
    }
}

// A material with two images for its colour, one as each of two programs calls it; a movement that is in another file.
static void test_told(void **state)
{
    (void)state;
    write_triangle("\tMaterial: 12, \"Material::m\", \"\" {\n\t\tVersion: 102\n\t}\n"
                   "\tTexture: 13, \"Texture::a\", \"\" {\n\t\tFileName: \"a.png\"\n"
                   "\t\tRelativeFilename: \"a.png\"\n\t}\n"
                   "\tTexture: 14, \"Texture::b\", \"\" {\n\t\tFileName: \"b.png\"\n"
                   "\t\tRelativeFilename: \"b.png\"\n\t}\n"
                   "\tDeformer: 15, \"Deformer::\", \"VertexCacheDeformer\" {\n\t}\n",
                   "\tC: \"OO\",12,11\n\tC: \"OP\",13,12,\"DiffuseColor\"\n"
                   "\tC: \"OP\",14,12,\"Maya|baseColor\"\n");
    struct scene_model *const model = load("told.fbx");
    assert_true(is_unsupported(model, "textures for one purpose: the first alone is used"));
    assert_true(is_unsupported(model, "movements of vertices that are in a file beside it: not drawn"));
    assert_int_equal(model->unsupported_count, 2);
    scene_model_free(model);
}

// Binary ---------------------------------------------------------------------------------------------

// A text of FBX as bytes: each record has where it ends, its values, and its own records.
struct binary {
    unsigned char bytes[8192];
    size_t size;
    bool is_packed; // floats are packed by zlib
};

static void put(struct binary *binary, const void *bytes, size_t size)
{
    assert_true(binary->size + size <= sizeof binary->bytes);
    memcpy(binary->bytes + binary->size, bytes, size);
    binary->size += size;
}

static void put_word(struct binary *binary, uint32_t word)
{
    const unsigned char bytes[4] = {(unsigned char)word, (unsigned char)(word >> 8),
                                    (unsigned char)(word >> 16), (unsigned char)(word >> 24)};
    put(binary, bytes, sizeof bytes);
}

static void set_word(struct binary *binary, size_t place, size_t word)
{
    const size_t size = binary->size;
    binary->size = place;
    put_word(binary, (uint32_t)word);
    binary->size = size;
}

// Put a string. In bytes a class stands behind a name.
static const char *put_string(struct binary *binary, const char *text)
{
    const char *const end = strchr(text, '"');
    const char *const class = strstr(text, "::");
    put(binary, "S", 1);
    put_word(binary, (uint32_t)(end - text));
    if (class == NULL || class > end) {
        put(binary, text, (size_t)(end - text));
    } else {
        put(binary, class + 2, (size_t)(end - class - 2));
        put(binary, "\0\1", 2);
        put(binary, text, (size_t)(class - text));
    }
    return end + 1;
}

// Put the numbers up to a brace as an array. What they are the name of the record says.
static const char *put_array(struct binary *binary, const char *text, const char *name)
{
    const char type = strncmp(name, "Vertices", 8) == 0   ? 'd'
                      : strncmp(name, "KeyValue", 8) == 0 ? 'f'
                      : strncmp(name, "KeyTime", 7) == 0  ? 'l'
                                                          : 'i';
    const char *c = strchr(text, ':') + 1;
    const size_t head = binary->size;
    uint32_t count = 0;
    put(binary, &type, 1);
    put(binary, "\0\0\0\0\0\0\0\0\0\0\0\0", 12);
    for (; c[strspn(c, " ,\n\t")] != '}'; count++) {
        char *end;
        const double number = strtod(c + strspn(c, " ,\n\t"), &end);
        const float narrow = (float)number;
        const int64_t wide = (int64_t)number;
        const int32_t whole = (int32_t)number;
        put(binary,
            type == 'd'   ? (const void *)&number
            : type == 'f' ? (const void *)&narrow
            : type == 'l' ? (const void *)&wide
                          : &whole,
            type == 'd' || type == 'l' ? 8 : 4);
        c = end;
    }
    if (type == 'f' && binary->is_packed) {
        unsigned char packed[256];
        uLongf size = sizeof packed;
        assert_int_equal(compress(packed, &size, binary->bytes + head + 13, binary->size - head - 13), Z_OK);
        binary->size = head + 13;
        put(binary, packed, size);
        set_word(binary, head + 5, 1);
    }
    set_word(binary, head + 1, count);
    set_word(binary, head + 9, binary->size - head - 13);
    return strchr(c, '}') + 1;
}

static const char *put_records(struct binary *binary, const char *text);

static const char *put_record(struct binary *binary, const char *text)
{
    const size_t start = binary->size, length = strcspn(text, ":");
    const bool has_ids = strncmp(text, "P:", 2) != 0 && strncmp(text, "FBX", 3) != 0;
    const char *const name = text;
    uint32_t values = 0;
    put(binary, "\0\0\0\0\0\0\0\0\0\0\0\0", 12);
    put(binary, &(unsigned char){(unsigned char)length}, 1);
    put(binary, text, length);
    const size_t first = binary->size;
    for (text += length + 1; text += strspn(text, " ,"), *text != '\n' && *text != '{'; values++) {
        char *end = (char *)(uintptr_t)text;
        if (*text == '"') {
            end = (char *)(uintptr_t)put_string(binary, text + 1);
        } else if (*text == '*') {
            end = (char *)(uintptr_t)put_array(binary, text, name);
        } else {
            const int64_t number = strtoll(text, &end, 10);
            put(binary, has_ids ? "L" : "I", 1);
            put(binary, &number, has_ids ? 8 : 4);
        }
        text = end;
    }
    set_word(binary, start + 4, values);
    set_word(binary, start + 8, binary->size - first);
    if (*text == '{') {
        text = put_records(binary, text + 1);
        put(binary, "\0\0\0\0\0\0\0\0\0\0\0\0", 13);
    }
    set_word(binary, start, binary->size);
    return text;
}

// Put records up to a brace or the end. Return what follows them.
static const char *put_records(struct binary *binary, const char *text)
{
    while (text += strspn(text, " \t\n"), *text != 0 && *text != '}') {
        text = *text == ';' ? strchr(text, '\n') : put_record(binary, text);
    }
    return text + (*text == '}');
}

// Write a text of FBX as a binary file of version 7.4, whose curves are packed or not.
static void write_binary(const char *name, const char *text, bool is_packed)
{
    struct binary binary = {.is_packed = is_packed};
    put(&binary, "Kaydara FBX Binary  \0\x1a\0", 23);
    put_word(&binary, 7400);
    put_records(&binary, text);
    put(&binary, "\0\0\0\0\0\0\0\0\0\0\0\0", 13);
    binary.size += 120;
    put(&binary, end_mark, sizeof end_mark);
    write_bytes(name, binary.bytes, binary.size);
}

// What hides objects in an FBX: two properties, groups above them, layers, and movements; and what does not.
static void test_hidden(void **state)
{
    (void)state;
#define SHOW(name, value) "\t\t\tP: \"" name "\", \"bool\", \"\", \"\"," value "\n"
#define FOUR(text)        text text text text
#define MORE(head)        "\t\t}\n\t}\n\t" head " {\n\t\tProperties70:  {\n"
#define LAYER             MORE("CollectionExclusive: 13, \"DisplayLayer::l\", \"DisplayLayer\"")
#define CURVE(keys)                                                                                          \
    MORE("AnimationCurveNode: 14, \"AnimCurveNode::v\", \"\"")                                               \
    "\t\t}\n\t}\n\tAnimationCurve: 15, \"AnimCurve::\", \"\" {\n\t\tKeyTime: *2 {\n\t\t\ta: 0,46186158000\n" \
    "\t\t}\n\t\tKeyValueFloat: *2 {\n\t\t\ta: " keys "\n\t\t}\n\t}\n"                                        \
    "\tAnimationCurveNode: 17, \"AnimCurveNode::w\", \"\" {\n\t}\n"                                          \
    "\tModel: 16, \"Model::other\", \"Null\" {\n\t\tProperties70:  {\n"
    static const char hidden[] = "hidden objects: drawn", layers[] = "hidden layers (FBX): drawn",
                      moved[] = "objects that are hidden for a while: drawn all the time";
    static const char in[] = "\tC: \"OO\",11,12\n";
    static const struct {
        const char *own, *group, *connections, *told;
    } cases[] = {
        {"", SHOW("Visibility", "1"), in, NULL},
        {"", SHOW("Visibility", "0"), in, hidden},
        {SHOW("Visibility", "0"), "", in, hidden},
        {"", SHOW("Show", "0"), in, hidden},
        {"", SHOW("Show", "0"), "\tC: \"OO\",11,0\n", NULL},
        {SHOW("Visibility Inheritance", "0"), SHOW("Show", "0"), in, NULL},
        {SHOW("Visibility Inheritance", "1"), SHOW("Show", "0"), in, hidden},
        {"", LAYER SHOW("Show", "0"), in, NULL},
        {"", LAYER SHOW("Show", "0"), "\tC: \"OO\",11,12\n\tC: \"OO\",12,13\n", layers},
        {"", LAYER SHOW("Show", "1"), "\tC: \"OO\",11,12\n\tC: \"OO\",12,13\n", NULL},
        {"", SHOW("Hidden", "0"), in, NULL},
        {"", CURVE("1,0"),
         "\tC: \"OO\",11,12\n\tC: \"OP\",14,12,\"Visibility\"\n\tC: \"OP\",15,14,\"d|Visibility\"\n", moved},
        {"", CURVE(FOUR(FOUR(FOUR(FOUR(FOUR("1,"))))) "0"),
         "\tC: \"OO\",11,12\n\tC: \"OP\",14,12,\"Visibility\"\n\tC: \"OP\",15,14,\"d|Visibility\"\n", moved},
        {"", CURVE("1,1"),
         "\tC: \"OO\",11,12\n\tC: \"OP\",14,12,\"Visibility\"\n\tC: \"OP\",15,14,\"d|Visibility\"\n", NULL},
        {"", CURVE("1,0"),
         "\tC: \"OO\",11,12\n\tC: \"OP\",14,12,\"Lcl Scaling\"\n\tC: \"OP\",15,14,\"d|X\"\n", NULL},
        {"", CURVE("1,0"),
         "\tC: \"OO\",11,0\n\tC: \"OP\",14,12,\"Visibility\"\n\tC: \"OP\",15,14,\"d|Visibility\"\n", NULL},
        {"", CURVE("1,0"),
         "\tC: \"OO\",11,0\n\tC: \"OP\",14,16,\"Visibility\"\n\tC: \"OP\",15,14,\"d|Visibility\"\n"
         "\tC: \"OP\",17,11,\"Visibility\"\n\tC: \"OP\",15,17,\"d|Visibility\"\n",
         moved},
    };
    for (size_t i = 0; i < 3 * (sizeof cases / sizeof cases[0]); i++) {
        const char *const told = cases[i / 3].told;
        char text[8192];
        snprintf(text, sizeof text,
                 "; FBX 7.4.0 project file\n"
                 "FBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\n"
                 "Objects:  {\n"
                 "\tGeometry: 10, \"Geometry::\", \"Mesh\" {\n"
                 "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
                 "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n"
                 "\tModel: 11, \"Model::mesh\", \"Mesh\" {\n\t\tProperties70:  {\n%s\t\t}\n\t}\n"
                 "\tModel: 12, \"Model::group\", \"Null\" {\n"
                 "\t\tProperties70:  {\n%s\t\t}\n\t}\n}\n"
                 "Connections:  {\n\tC: \"OO\",12,0\n\tC: \"OO\",10,11\n%s}\n",
                 cases[i / 3].own, cases[i / 3].group, cases[i / 3].connections);
        if (i % 3 == 0) {
            write_text("hidden.fbx", text);
        } else {
            write_binary("hidden.fbx", text, i % 3 == 2);
        }
        struct scene_model *const model = load("hidden.fbx");
        if (model->unsupported_count != (told != NULL) || (told != NULL && !is_unsupported(model, told))) {
            fail_msg("case %zu: %u lines, such as %s", i, model->unsupported_count,
                     model->unsupported_count > 0 ? model->unsupported[0] : "none");
        }
        scene_model_free(model);
    }
#undef SHOW
#undef MORE
#undef LAYER
#undef CURVE
#undef FOUR
}

// The values of a curve are looked at once, and not for each of many links, which would take more than the limit.
static void test_many_links(void **state)
{
    (void)state;
    enum { KEYS = 400000, LINKS = 20000, LINE = 64 };
    char *const text = malloc(2 * KEYS + LINKS * LINE + 1024), error[256] = "", *end = text;
    end += sprintf(end,
                   "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\nObjects:  {\n"
                   "\tGeometry: 10, \"Geometry::\", \"Mesh\" {\n"
                   "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,1,0\n\t\t}\n"
                   "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n"
                   "\tModel: 11, \"Model::mesh\", \"Mesh\" {\n\t}\n"
                   "\tAnimationCurveNode: 14, \"AnimCurveNode::v\", \"\" {\n\t}\n"
                   "\tAnimationCurve: 15, \"AnimCurve::\", \"\" {\n\t\tKeyValueFloat: *%d {\n\t\t\ta: 1",
                   KEYS);
    for (int i = 1; i < KEYS; i++) {
        end += sprintf(end, ",1");
    }
    end += sprintf(end, "\n\t\t}\n\t}\n}\nConnections:  {\n\tC: \"OO\",11,0\n\tC: \"OO\",10,11\n"
                        "\tC: \"OP\",14,11,\"Visibility\"\n");
    for (int i = 0; i < LINKS; i++) {
        end += sprintf(end, "\tC: \"OP\",15,14,\"d|Visibility\"\n");
    }
    end += sprintf(end, "}\n");
    write_bytes("links.fbx", text, (size_t)(end - text));
    free(text);
    const struct scene_model_options options = {.seconds = 8};
    struct scene_model *const model = scene_model_load(path_of("links.fbx"), &options, error, sizeof error);
    assert_string_equal(error, "");
    assert_non_null(model);
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_binary),         cmocka_unit_test(test_order), cmocka_unit_test(test_text),
    cmocka_unit_test(test_first_material), cmocka_unit_test(test_light), cmocka_unit_test(test_opacity),
    cmocka_unit_test(test_hidden),         cmocka_unit_test(test_told),  cmocka_unit_test(test_moved_meshes),
    cmocka_unit_test(test_many_links),
};

const struct unit_tests test_fbx = UNIT_TESTS(tests, make_directory, remove_directory);
