// SPDX-License-Identifier: MIT
// Poses of animated glTF files against values worked out by hand: every interpolation, every path, before the first key and
// after the last; skins and morph targets follow; what is wrong is told by name.
#include "draco_encode.h"
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { KEYS = 3 };

// A triangle on node 1, a child of node 0; `channels` and `samplers` as JSON. Accessors: 0 positions, 1 times 1, 2, 4,
// 2 the values as VEC3, 3 as VEC4, 4 as scalars, 5 deltas of a morph target, 6 joints, 7 weights of joints, 8 normals.
static void write_file(const char *name, const float *values, int value_count, const char *samplers,
                       const char *channels)
{
    static const float times[KEYS] = {1, 2, 4};
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, deltas[9] = {0, 0, 1, 0, 0, 2, 0, 0, 4};
    static const uint8_t joints[12] = {0};
    static const float joint_weights[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    static const float normals[9] = {0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f};
    unsigned char bytes[1024] = {0};
    const size_t value_size = (size_t)value_count * sizeof *values;
    memcpy(bytes, positions, 36);
    memcpy(bytes + 36, deltas, 36);
    memcpy(bytes + 72, times, 12);
    memcpy(bytes + 84, joints, 12);
    memcpy(bytes + 96, joint_weights, 48);
    memcpy(bytes + 144, normals, 36);
    memcpy(bytes + 180, values, value_size);
    const size_t size = 180 + value_size;
    write_format(
        name,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,2]}],"
        "\"nodes\":[{\"children\":[1]},{\"name\":\"leaf\",\"mesh\":0,\"translation\":[5,0,0]},"
        "{\"name\":\"skinned\",\"mesh\":1,\"skin\":0},{\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],"
        "\"skins\":[{\"joints\":[0]}],"
        "\"meshes\":[{\"weights\":[0.5],\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{"
        "\"POSITION\":5}]}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":8,\"JOINTS_0\":6,\"WEIGHTS_0\":7}}]}],"
        "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":12}"
        ","
        "{\"buffer\":0,\"byteOffset\":180,\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":"
        "36},"
        "{\"buffer\":0,\"byteOffset\":84,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":96,\"byteLength\":"
        "48},{\"buffer\":0,\"byteOffset\":144,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\",\"min\":[1],\"max\":[4]},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":\"VEC4\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":\"SCALAR\"},"
        "{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":4,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},"
        "{\"bufferView\":5,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"},"
        "{\"bufferView\":6,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"animations\":[{\"name\":\"rest\",\"samplers\":[],\"channels\":[]},"
        "{\"name\":\"move\",\"samplers\":[%s],\"channels\":[%s]}]}",
        size, data_uri(bytes, size), value_size, value_count / 3, value_count / 4, value_count, samplers,
        channels);
}

static struct scene_model *pose_of(const char *name, const char *animation, double time)
{
    const struct scene_model_options options = {.is_posed = true, .animation = animation, .time = time};
    char error[512] = "";
    struct scene_model *model = scene_model_load(path_of(name), &options, error, sizeof error);
    if (model == NULL) {
        fail_msg("%s: %s", name, error);
    }
    return model;
}

static void expect_refused_pose(const char *name, const char *animation, const char *cause)
{
    const struct scene_model_options options = {.is_posed = true, .animation = animation};
    char error[512] = "";
    assert_null(scene_model_load(path_of(name), &options, error, sizeof error));
    if (strstr(error, cause) == NULL) {
        fail_msg("\"%s\" does not hold \"%s\"", error, cause);
    }
}

// Where the leaf is at a time.
static void assert_place(const char *name, double time, float x, float y, float z)
{
    struct scene_model *model = pose_of(name, "move", time);
    const float expected[3] = {x, y, z};
    assert_string_equal(model->instances[0].name, "leaf");
    assert_floats(model->instances[0].world + 12, expected, 3, 1e-6f);
    scene_model_free(model);
}

static void test_translation(void **state)
{
    (void)state;
    static const float values[9] = {0, 0, 0, 2, 0, 0, 2, 8, 0};
    static const char *const channel = "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}}";
    write_file("t.gltf", values, 9, "{\"input\":1,\"output\":2}", channel);
    assert_place("t.gltf", -3, 0, 0, 0);
    assert_place("t.gltf", 1, 0, 0, 0);
    assert_place("t.gltf", 1.25, 0.5f, 0, 0);
    assert_place("t.gltf", 2, 2, 0, 0);
    assert_place("t.gltf", 3.5, 2, 6, 0);
    assert_place("t.gltf", 4, 2, 8, 0);
    assert_place("t.gltf", 100, 2, 8, 0);
    write_file("t.gltf", values, 9, "{\"input\":1,\"output\":2,\"interpolation\":\"STEP\"}", channel);
    assert_place("t.gltf", 1.99, 0, 0, 0);
    assert_place("t.gltf", 3.99, 2, 0, 0);
    // At rest where it is not asked for, with a line that says so.
    struct scene_model *model = load("t.gltf");
    assert_true(model->instances[0].world[12] == 5.0f);
    assert_int_equal(model->animation_count, 2);
    assert_string_equal(model->animations[1].name, "move");
    assert_true(model->animations[1].seconds == 4.0f && model->animations[0].seconds == 0.0f);
    assert_int_equal(model->animations[1].channel_count, 1);
    assert_int_equal(model->unsupported_count, 1);
    scene_model_free(model);
}

// Keys with tangents: from 0 to 6 within one second, leaving at speed 3 and arriving at speed 0; then 2 seconds.
static void test_cubic(void **state)
{
    (void)state;
    static const float values[27] = {0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 6, 0,
                                     0, 0, 0, 0, 0, 0, 0, 6, 0, 0, 0, 0, 0};
    write_file("c.gltf", values, 27, "{\"input\":1,\"output\":2,\"interpolation\":\"CUBICSPLINE\"}",
               "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}}");
    assert_place("c.gltf", 1, 0, 0, 0);
    // t = 1/2: 3·(1/8 − 1/2 + 1/2) + 6·(3/4 − 1/4)
    assert_place("c.gltf", 1.5, 3.0f * 0.125f + 3.0f, 0, 0);
    assert_place("c.gltf", 2, 6, 0, 0);
    assert_place("c.gltf", 3, 6, 0, 0);
}

// A quarter turn about z, the second key by the long way round: −q is the same turn.
static void test_rotation(void **state)
{
    (void)state;
    const float half = (float)sqrt(0.5);
    const float values[12] = {0, 0, 0, 1, 0, 0, -half, -half, 0, 0, 0, 1};
    write_file("r.gltf", values, 12, "{\"input\":1,\"output\":3}",
               "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"rotation\"}}");
    for (int i = 0; i <= 8; i++) {
        const double angle = 1.5707963267948966 * i / 8.0;
        struct scene_model *model = pose_of("r.gltf", "move", 1.0 + i / 8.0);
        const float expected[3] = {(float)(5.0 * cos(angle)), (float)(5.0 * sin(angle)), 0};
        assert_floats(model->instances[0].world + 12, expected, 3, 3e-6f);
        // The skin's joint is the node that turns: vertex 1 was at 1, 0, 0.
        const float turned[3] = {(float)cos(angle), (float)sin(angle), 0};
        assert_string_equal(model->instances[1].name, "skinned");
        assert_floats(model->meshes[model->instances[1].mesh].positions[1], turned, 3, 1e-6f);
        scene_model_free(model);
    }
}

static void test_scale_and_weights(void **state)
{
    (void)state;
    static const float scales[9] = {1, 1, 1, 3, 1, 1, 3, 2, 1};
    write_file("s.gltf", scales, 9, "{\"input\":1,\"output\":2}",
               "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"scale\"}}");
    assert_place("s.gltf", 1.5, 10, 0, 0);
    // The skinned triangle is three times as wide, and its normals lean a third as much.
    struct scene_model *model = pose_of("s.gltf", "move", 2);
    const float length = sqrtf(0.2f * 0.2f + 0.8f * 0.8f), upright[3] = {0.2f / length, 0, 0.8f / length};
    assert_floats(model->meshes[model->instances[1].mesh].normals[0], upright, 3, 1e-6f);
    scene_model_free(model);
    static const float weights[3] = {0, 1, -1};
    write_file("w.gltf", weights, 3, "{\"input\":1,\"output\":4}",
               "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"weights\"}}");
    static const double times[4] = {1, 1.25, 2, 3.5};
    static const float expected[4] = {0, 0.25f, 1, -0.5f};
    for (int i = 0; i < 4; i++) {
        model = pose_of("w.gltf", "1", times[i]);
        const float(*const p)[3] = (const float(*)[3])model->meshes[model->instances[0].mesh].positions;
        assert_true(p[0][2] == expected[i] && p[1][2] == 2 * expected[i] && p[2][2] == 4 * expected[i]);
        scene_model_free(model);
    }
    model = pose_of("w.gltf", NULL, 2); // the first one, which moves nothing
    assert_true(model->meshes[model->instances[0].mesh].positions[0][2] == 0.5f);
    scene_model_free(model);
}

#define UNMOVED "1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;;"

// A file that assimp reads: keys at ticks 0 and 4, four of them a second; a bone that moves two of three vertices.
static void test_other_formats(void **state)
{
    (void)state;
    write_text("move.x", "xof 0303txt 0032\n"
                         "AnimTicksPerSecond { 4; }\n"
                         "Frame leaf { FrameTransformMatrix { "
                         "1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; }\n"
                         " Mesh m { 3; 0.0;0.0;0.0;, 1.0;0.0;0.0;, 0.0;1.0;0.0;; 1; 3;0,1,2;;\n"
                         "  XSkinMeshHeader { 1; 1; 1; }\n"
                         "  SkinWeights { \"bone\"; 2; 1, 2; 1.0, 0.5; "
                         "1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; } } }\n"
                         "Frame bone { FrameTransformMatrix { "
                         "1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; } }\n"
                         "AnimationSet S { Animation A { {bone} AnimationKey { 2; 2; 0;3;0.0,0.0,0.0;;, "
                         "4;3;8.0,2.0,0.0;;; } } }\n");
    struct scene_model *model = load("move.x");
    assert_int_equal(model->animation_count, 1);
    assert_true(model->animations[0].seconds == 1.0f);
    assert_int_equal(model->unsupported_count, 2); // at rest, and its skin as stored
    scene_model_free(model);
    static const double times[4] = {-1, 0.5, 0.75, 3};
    static const float moved[4] = {0, 4, 6, 8};
    for (int i = 0; i < 4; i++) {
        model = pose_of("move.x", "S", times[i]);
        assert_int_equal(model->unsupported_count, 0);
        const struct scene_mesh *const mesh = &model->meshes[0];
        int found = 0;
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            const float *const p = mesh->positions[v];
            // 0, 0, 0 has no bone; 1, 0, 0 and 0, 1, 0, whose weight is made 1, go with it.
            const bool still = p[0] == 0.0f && p[1] == 0.0f;
            const bool first = p[0] == 1.0f + moved[i] && p[1] == moved[i] / 4;
            const bool second = p[0] == moved[i] && p[1] == 1.0f + moved[i] / 4;
            found |= (still ? 1 : 0) | (first ? 2 : 0) | (second ? 4 : 0);
        }
        assert_int_equal(found, 7);
        scene_model_free(model);
    }
    expect_refused_pose("move.x", "walk", "has no animation 'walk'");
}

// A bone changes the three axes for each other, or stretches one of them and mirrors another. The normals, which are
// equal to the positions, stay upright on their surface.
static void test_skinned_normals(void **state)
{
    (void)state;
#define CORNERS                                                                                        \
    "3; 0.333333;0.666667;0.666667;, 0.666667;0.333333;-0.666667;, -0.666667;0.666667;-0.333333;; 1; " \
    "3;0,1,2;;"
    static const char *const keys[] = {"0; 1; 0;4;0.5,0.5,0.5,0.5;;;", "1; 1; 0;3;2.0,1.0,-1.0;;;"};
    for (int i = 0; i < 2; i++) {
        write_format("turn.x",
                     "xof 0303txt 0032\nAnimTicksPerSecond { 1; }\n"
                     "Frame leaf { FrameTransformMatrix { " UNMOVED " }\n"
                     " Mesh m { " CORNERS " MeshNormals { " CORNERS " }\n  XSkinMeshHeader { 1; 1; 1; }\n"
                     "  SkinWeights { \"bone\"; 3; 0, 1, 2; 1.0, 1.0, 1.0; " UNMOVED " } } }\n"
                     "Frame bone { FrameTransformMatrix { " UNMOVED " } }\n"
                     "AnimationSet S { Animation A { {bone} AnimationKey { %s } } }\n",
                     keys[i]);
        struct scene_model *rest = load("turn.x"), *model = pose_of("turn.x", "S", 0);
        const struct scene_mesh *const mesh = &model->meshes[0];
        const float stretch = i == 0 ? 1 : 2, side = i == 0 ? 1 : -1; // corners run the other way in a mirror
        for (uint32_t v = 0; v < 3; v++) {
            const float *const p = mesh->positions[v];
            const float upright[3] = {p[0] / stretch / stretch, p[1], p[2]};
            const float length = side * sqrtf(upright[0] * upright[0] + p[1] * p[1] + p[2] * p[2]);
            const float normal[3] = {upright[0] / length, p[1] / length, p[2] / length};
            assert_floats(mesh->normals[v], normal, 3, 1e-5f);
            assert_memory_not_equal(p, rest->meshes[0].positions[v], sizeof *mesh->positions);
        }
        scene_model_free(rest);
        scene_model_free(model);
    }
}

// What shows nothing at rest is drawn as the first animation has it that shows something: at its beginning, or where it
// grows in its middle.
static void test_nothing_at_rest(void **state)
{
    (void)state;
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, times[2] = {1, 3};
    for (int grows = 0; grows < 2; grows++) {
        for (int is_flat = 0; is_flat < 2; is_flat++) { // flat scales leave no area either
            const float least = grows ? 0 : 2, scales[6] = {least, least, least, 4, 4, 4};
            unsigned char bytes[68];
            memcpy(bytes, positions, 36);
            memcpy(bytes + 36, times, 8);
            memcpy(bytes + 44, scales, 24);
            write_format(
                "grow.gltf",
                "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,"
                "\"scale\":[0,%d,%d]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                "\"buffers\":[{\"byteLength\":68,\"uri\":\"%s\"}],"
                "\"bufferViews\":[{\"buffer\":0,\"byteLength\":68}],"
                "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
                "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":2,"
                "\"type\":\"SCALAR\",\"min\":[1],\"max\":[3]},"
                "{\"bufferView\":0,\"byteOffset\":44,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}],"
                "\"animations\":[{\"name\":\"1\",\"samplers\":[],\"channels\":[]},{\"name\":\"grow\","
                "\"samplers\":[{\"input\":1,\"output\":2}],\"channels\":[{\"sampler\":0,"
                "\"target\":{\"node\":0,\"path\":\"scale\"}}]}]}",
                is_flat, is_flat, data_uri(bytes, sizeof bytes));
            struct scene_model *model = load("grow.gltf");
            // In the middle of 3 s, a quarter of the way between the keys at 1 s and 3 s.
            const float width = grows ? 1 : 2;
            assert_floats(&model->bounds_max[0], &width, 1, 1e-6f);
            assert_true(!model->instances[0].unseen && model->animation_count == 2);
            assert_true(has_warning(model, grows ? "animation 1 \"grow\" has it at 1.5 s"
                                                 : "animation 1 \"grow\" has it at 0 s"));
            scene_model_free(model);
            model = pose_of("grow.gltf", "1", 1); // who asks gets it, by its name and not the second
            assert_true(model->bounds_max[0] == 0 && !has_warning(model, "nothing is seen"));
            scene_model_free(model);
        }
    }
}

static void test_bad_files(void **state)
{
    (void)state;
    static const float values[9] = {0, 0, 0, 2, 0, 0, 2, 8, 0};
    static const char *const good = "{\"input\":1,\"output\":2}";
    static const struct {
        const char *samplers, *channels, *cause;
    } bad[] = {
        {"", "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"scale\"}}", "its sampler does not exist"},
        {"{\"input\":0,\"output\":2}", "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"scale\"}}",
         "components"},
        {"{\"input\":1,\"output\":2,\"interpolation\":\"CUBICSPLINE\"}",
         "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"scale\"}}",
         "another number of values than of keys"},
        {"{\"input\":4,\"output\":2}", "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"scale\"}}",
         "another number of values than of keys"},
        {good, "{\"sampler\":0,\"target\":{\"node\":9,\"path\":\"scale\"}}", "nodes[9]"},
        {good, "{\"sampler\":0,\"target\":{\"node\":3,\"path\":\"scale\"}}",
         "moves a node that has a matrix"},
        {"{\"input\":1,\"output\":77}", "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"scale\"}}",
         "accessors[77]"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        write_file("bad.gltf", values, 9, bad[i].samplers, bad[i].channels);
        expect_refused_pose("bad.gltf", "move", bad[i].cause);
        struct scene_model *model = load("bad.gltf"); // at rest it is as good as any
        scene_model_free(model);
    }
    write_file("bad.gltf", values, 9, "{\"input\":4,\"output\":4}",
               "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"weights\"}}");
    expect_refused_pose("bad.gltf", "move", "the times of its keys do not rise");
    expect_refused_pose("bad.gltf", "dance", "has no animation 'dance'");
    expect_refused_pose("bad.gltf", "2", "has no animation '2'");
    write_file("bad.gltf", values, 9, good, "{\"sampler\":0,\"target\":{\"path\":\"pointer\"}}");
    struct scene_model *model = pose_of("bad.gltf", "move", 2);
    assert_int_equal(model->unsupported_count, 1);
    assert_string_equal(model->unsupported[0], "animations of \"pointer\": left as at rest");
    scene_model_free(model);
    write_text("still.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_refused_pose("still.obj", NULL, "has no animations that can be played");
}

// COLLADA2GLTF gives indices of joints to Draco as floats, which come back a little off: each corner has its own joint,
// which moves it up by a step of its own.
static void test_joints_of_draco(void **state)
{
    (void)state;
    static const float positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const float joints[3][4] = {{0, 0, 0, 0}, {3, 0, 0, 0}, {4, 0, 0, 0}};
    static const uint8_t weights[3][4] = {{255}, {255}, {255}};
    const struct draco_soup soup = {
        .triangles = 1, .positions = positions, .colors = weights, .joints = joints, .joint_bits = 8};
    unsigned char bytes[4096];
    const size_t size = draco_encode(&soup, bytes, sizeof bytes);
    assert_true(size > 0);
    for (int type = 5121; type <= 5123; type += 2) {
        write_format(
            "d.gltf",
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,"
            "\"skin\":0},{},{},{},{\"translation\":[0,0,10]},{\"translation\":[0,0,20]}],\"skins\":[{"
            "\"joints\":[1,2,3,4,5]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
            "\"WEIGHTS_0\":1,\"JOINTS_0\":2},\"extensions\":{\"KHR_draco_mesh_compression\":{"
            "\"bufferView\":0,\"attributes\":{\"POSITION\":0,\"WEIGHTS_0\":3,\"JOINTS_0\":4}}}}]}],"
            "\"accessors\":[{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{"
            "\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":\"VEC4\"},{"
            "\"componentType\":%d,\"count\":3,\"type\":\"VEC4\"}],\"bufferViews\":[{\"buffer\":0,"
            "\"byteLength\":%zu}],\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"}]}",
            type, size, size, data_uri(bytes, size));
        struct scene_model *const model = load("d.gltf");
        assert_int_equal(model->meshes[0].vertex_count, 3);
        for (int v = 0; v < 3; v++) {
            const float *const position = model->meshes[0].positions[v];
            assert_true(position[2] == 10 * position[0] + 20 * position[1]);
        }
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_translation),     cmocka_unit_test(test_cubic),
    cmocka_unit_test(test_rotation),        cmocka_unit_test(test_scale_and_weights),
    cmocka_unit_test(test_other_formats),   cmocka_unit_test(test_bad_files),
    cmocka_unit_test(test_nothing_at_rest), cmocka_unit_test(test_skinned_normals),
    cmocka_unit_test(test_joints_of_draco),
};

const struct unit_tests test_animation = UNIT_TESTS(tests, make_directory, remove_directory);
