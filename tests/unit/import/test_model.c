// SPDX-License-Identifier: MIT
// What comes out of a glTF file: hierarchy, topology, attributes, materials, cameras, lights, poses.
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// A square in the plane z = 0: corners and texture coordinates, in that order in one buffer.
static const float square[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const float square_uv[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};

// A file with one mesh of the given primitive; positions are accessor 0, indices accessor 1.
static void write_primitive(const char *name, int mode, const uint8_t *indices, int count)
{
    unsigned char bytes[sizeof square + 16] = {0};
    memcpy(bytes, square, sizeof square);
    memcpy(bytes + sizeof square, indices, (size_t)count);
    write_format(
        name,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"mode\":%d}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5121,\"count\":%d,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":16}"
        "],"
        "\"buffers\":[{\"byteLength\":64,\"uri\":\"%s\"}]}",
        mode, count, data_uri(bytes, sizeof bytes));
}

// A square with texture coordinates, one material, and `extra` members at the top level.
static void write_square(const char *name, const char *material, const char *extra)
{
    unsigned char bytes[sizeof square + sizeof square_uv + 8] = {0};
    memcpy(bytes, square, sizeof square);
    memcpy(bytes + sizeof square, square_uv, sizeof square_uv);
    memcpy(bytes + sizeof square + sizeof square_uv, (const uint8_t[]){0, 1, 2, 0, 2, 3}, 6);
    write_format(
        name,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"indices\":2,"
        "\"material\":0}]}],\"materials\":[%s],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":80,\"componentType\":5121,\"count\":6,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":88}],"
        "\"buffers\":[{\"byteLength\":88,\"uri\":\"%s\"}]%s}",
        material, data_uri(bytes, sizeof bytes), extra);
}

// An image of 2×1 pixels, red and half transparent green, as TGA: no checksum to compute.
static const unsigned char tga[] = {0, 0, 2, 0,  0,  0, 0, 0,   0,   0, 0,   0, 2,
                                    0, 1, 0, 32, 40, 0, 0, 255, 255, 0, 255, 0, 128};

static void test_hierarchy(void **state)
{
    (void)state;
    const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    write_format(
        "tree.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,3]}],\"nodes\":["
        "{\"name\":\"root\",\"translation\":[10,0,0],\"scale\":[2,2,2],\"children\":[1,2]},"
        "{\"name\":\"turned\",\"rotation\":[0,0,0.70710678,0.70710678],\"mesh\":0},"
        "{\"name\":\"moved\",\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1],\"mesh\":0},"
        "{\"name\":\"mirror\",\"scale\":[-1,1,1],\"mesh\":0},{\"name\":\"outside the scene\",\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]"
        "}",
        data_uri(triangle, sizeof triangle));
    struct scene_model *model = load("tree.gltf");
    assert_int_equal(model->mesh_count, 1);
    assert_int_equal(model->instance_count, 3);
    assert_int_equal(model->triangles_stored, 1);
    assert_int_equal(model->triangles_drawn, 3);
    const float turned[16] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1};
    const float moved[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 20, 12, 14, 1};
    assert_string_equal(model->instances[0].name, "turned");
    assert_floats(model->instances[0].world, turned, 16, 1e-6f);
    assert_string_equal(model->instances[1].name, "moved");
    assert_floats(model->instances[1].world, moved, 16, 0);
    assert_false(model->instances[0].mirrored);
    assert_true(model->instances[2].mirrored);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(model->instances[i].object, i + 1);
    }
    assert_floats(model->bounds_min, (const float[]){-1, 0, 0}, 3, 1e-6f);
    assert_floats(model->bounds_max, (const float[]){22, 14, 14}, 3, 1e-6f);
    scene_model_free(model);
}

static void test_topologies(void **state)
{
    (void)state;
    static const uint8_t order[] = {0, 1, 3, 2};
    static const struct {
        int mode;
        enum scene_primitive primitive;
        int count;
        uint32_t corners[8]; // places in `order`
    } cases[] = {
        {0, SCENE_PRIMITIVE_POINTS, 4, {0, 1, 2, 3}},
        {1, SCENE_PRIMITIVE_LINES, 4, {0, 1, 2, 3}},
        {2, SCENE_PRIMITIVE_LINES, 8, {0, 1, 1, 2, 2, 3, 3, 0}},
        {3, SCENE_PRIMITIVE_LINES, 6, {0, 1, 1, 2, 2, 3}},
        {4, SCENE_PRIMITIVE_TRIANGLES, 3, {0, 1, 2}}, // the fourth index makes no triangle
        {5, SCENE_PRIMITIVE_TRIANGLES, 6, {0, 1, 2, 1, 3, 2}},
        {6, SCENE_PRIMITIVE_TRIANGLES, 6, {1, 2, 0, 2, 3, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_primitive("mode.gltf", cases[i].mode, order, 4);
        struct scene_model *model = load("mode.gltf");
        const struct scene_mesh *mesh = &model->meshes[0];
        assert_int_equal(mesh->primitive, cases[i].primitive);
        assert_int_equal(mesh->index_count, cases[i].count);
        for (int k = 0; k < cases[i].count; k++) {
            assert_floats(mesh->positions[mesh->indices[k]], square[order[cases[i].corners[k]]], 3, 0);
        }
        assert_true(mesh->primitive != SCENE_PRIMITIVE_TRIANGLES || mesh->normals != NULL);
        scene_model_free(model);
    }
}

static void test_flat_normals(void **state)
{
    (void)state;
    // Two triangles with an edge in common, folded by 90°: each needs its own normal.
    const struct {
        float positions[4][3];
        uint16_t indices[6];
    } fold = {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, {0, 2, 1, 0, 1, 3}};
    write_format(
        "fold.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60}],\"buffers\":[{\"byteLength\":60,\"uri\":\"%s\"}]"
        "}",
        data_uri(&fold, sizeof fold));
    struct scene_model *model = load("fold.gltf");
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_int_equal(mesh->vertex_count, 6);
    for (int k = 0; k < 3; k++) {
        assert_floats(mesh->normals[mesh->indices[k]], (const float[]){0, 0, 1}, 3, 1e-6f);
        assert_floats(mesh->normals[mesh->indices[3 + k]], (const float[]){1, 0, 0}, 3, 1e-6f);
    }
    scene_model_free(model);
}

static void test_attribute_formats(void **state)
{
    (void)state;
    // Interleaved: 3 floats, 2 normalized shorts, 3 normalized bytes and padding; stride 20.
    struct {
        float position[3];
        uint16_t uv[2];
        uint8_t color[4];
    } vertices[3] = {
        {{0, 0, 0}, {0, 65535}, {255, 0, 51, 9}},
        {{1, 0, 0}, {32768, 0}, {0, 102, 0, 9}},
        {{0, 1, 0}, {65535, 65535}, {255, 255, 255, 9}},
    };
    write_format(
        "packed.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_1\":1,\"COLOR_0\":2}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5123,\"normalized\":true,\"count\":3,\"type\":"
        "\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":16,\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":"
        "\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60,\"byteStride\":20}],"
        "\"buffers\":[{\"byteLength\":60,\"uri\":\"%s\"}]}",
        data_uri(vertices, sizeof vertices));
    struct scene_model *model = load("packed.gltf");
    const struct scene_mesh *mesh = &model->meshes[0];
    assert_null(mesh->uvs[0]);
    assert_non_null(mesh->uvs[1]);
    assert_floats(mesh->uvs[1][0], (const float[]){0, 1}, 2, 0);
    assert_floats(mesh->uvs[1][1], (const float[]){32768.0f / 65535, 0}, 2, 0);
    assert_floats(mesh->colors[0], (const float[]){1, 0, 0.2f, 1}, 4, 0);
    assert_floats(mesh->colors[1], (const float[]){0, 0.4f, 0, 1}, 4, 0);
    scene_model_free(model);
}

static void test_sparse(void **state)
{
    (void)state;
    const struct {
        float positions[3][3];
        uint32_t place;
        float value[3];
    } data = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2, {7, 8, 9}};
    write_format(
        "sparse.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":"
        "{\"count\":1,\"indices\":{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5125},"
        "\"values\":{\"bufferView\":0,\"byteOffset\":40}}}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":52}],\"buffers\":[{\"byteLength\":52,\"uri\":\"%s\"}]"
        "}",
        data_uri(&data, sizeof data));
    struct scene_model *model = load("sparse.gltf");
    assert_floats(model->meshes[0].positions[2], data.value, 3, 0);
    assert_floats(model->meshes[0].positions[1], data.positions[1], 3, 0);
    scene_model_free(model);
}

static void test_material(void **state)
{
    (void)state;
    char extra[1024];
    snprintf(extra, sizeof extra,
             ",\"textures\":[{\"source\":0,\"sampler\":0},{\"source\":1}],\"images\":[{\"uri\":\"%s\"},{"
             "\"uri\":\"not there.png\"}],"
             "\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648,\"magFilter\":9728,\"minFilter\":9985}]",
             data_uri(tga, sizeof tga));
    write_square(
        "material.gltf",
        "{\"name\":\"m\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,1,0.75],\"metallicFactor\":"
        "0.3,"
        "\"roughnessFactor\":0.6,\"baseColorTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":"
        "{\"offset\":[0.5,0.25],\"rotation\":1.5707963267948966,\"scale\":[2,3]}}}},"
        "\"normalTexture\":{\"index\":1,\"scale\":0.5},\"emissiveFactor\":[1,0.5,0],"
        "\"alphaMode\":\"MASK\",\"alphaCutoff\":0.3,\"doubleSided\":true,"
        "\"extensions\":{\"KHR_materials_unlit\":{},\"KHR_materials_emissive_strength\":{"
        "\"emissiveStrength\":4}}}",
        extra);
    struct scene_model *model = load("material.gltf");
    const struct scene_material *material = &model->materials[0];
    const struct scene_texture_slot *slot = &material->slots[SCENE_SLOT_BASE_COLOR];
    assert_string_equal(material->name, "m");
    assert_floats(material->base_color, (const float[]){0.5f, 0.25f, 1, 0.75f}, 4, 0);
    assert_floats(&material->metallic, (const float[]){0.3f}, 1, 0);
    assert_floats(&material->roughness, (const float[]){0.6f}, 1, 0);
    assert_floats(material->emissive, (const float[]){4, 2, 0}, 3, 0);
    assert_int_equal(material->alpha_mode, SCENE_ALPHA_MASK);
    assert_floats(&material->alpha_cutoff, (const float[]){0.3f}, 1, 0);
    assert_true(material->unlit && material->double_sided);
    assert_int_equal(slot->address_u, RHW_ADDRESS_CLAMP);
    assert_int_equal(slot->address_v, RHW_ADDRESS_MIRROR);
    assert_int_equal(slot->mag_filter, RHW_FILTER_NEAREST);
    assert_int_equal(slot->min_filter, RHW_FILTER_LINEAR);
    assert_int_equal(slot->mip_filter, RHW_MIP_FILTER_NEAREST);
    // A quarter turn counter-clockwise with v downward: (u, v) goes to (v, −u), after scaling.
    assert_floats(slot->transform, (const float[]){0, 3, 0.5f, -2, 0, 0.25f}, 6, 1e-6f);
    const struct scene_image *image = &model->images[slot->image];
    assert_int_equal(image->width, 2);
    assert_int_equal(image->height, 1);
    assert_memory_equal(image->texels, ((const unsigned char[]){255, 0, 0, 255, 0, 255, 0, 128}), 8);
    assert_true(image->has_alpha && image->used_as_color && !image->used_as_data && !image->missing);
    // A missing normal map is a warning and no normal map.
    assert_true(has_warning(model, "not there.png"));
    assert_int_equal(material->slots[SCENE_SLOT_NORMAL].image, -1);
    scene_model_free(model);
}

// The six values of minFilter, and what they say of texels and of levels.
static void test_minification_filters(void **state)
{
    (void)state;
    static const struct {
        int number;
        enum rhw_filter min;
        enum rhw_mip_filter mip;
    } filters[] = {
        {9728, RHW_FILTER_NEAREST, RHW_MIP_FILTER_NONE},    {9729, RHW_FILTER_LINEAR, RHW_MIP_FILTER_NONE},
        {9984, RHW_FILTER_NEAREST, RHW_MIP_FILTER_NEAREST}, {9985, RHW_FILTER_LINEAR, RHW_MIP_FILTER_NEAREST},
        {9986, RHW_FILTER_NEAREST, RHW_MIP_FILTER_LINEAR},  {9987, RHW_FILTER_LINEAR, RHW_MIP_FILTER_LINEAR}};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        char extra[512];
        snprintf(extra, sizeof extra,
                 ",\"textures\":[{\"source\":0,\"sampler\":0}],\"images\":[{\"uri\":\"%s\"}],"
                 "\"samplers\":[{\"minFilter\":%d}]",
                 data_uri(tga, sizeof tga), filters[i].number);
        write_square("filters.gltf", "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}",
                     extra);
        struct scene_model *const model = load("filters.gltf");
        const struct scene_texture_slot *const slot = &model->materials[0].slots[SCENE_SLOT_BASE_COLOR];
        assert_int_equal(slot->min_filter, filters[i].min);
        assert_int_equal(slot->mip_filter, filters[i].mip);
        scene_model_free(model);
    }
}

static void test_missing_texture(void **state)
{
    (void)state;
    write_square("missing.gltf", "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}",
                 ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"nowhere.png\"}]");
    struct scene_model *model = load("missing.gltf");
    const struct scene_image *image = &model->images[model->materials[0].slots[SCENE_SLOT_BASE_COLOR].image];
    const uint8_t(*texels)[4] = image->texels;
    assert_true(image->missing);
    assert_true(has_warning(model, "nowhere.png"));
    assert_memory_equal(texels[0], ((const uint8_t[]){255, 0, 255, 255}), 4);
    assert_memory_equal(texels[1], ((const uint8_t[]){96, 0, 96, 255}), 4);
    scene_model_free(model);
}

static void test_tangents(void **state)
{
    (void)state;
    char extra[512];
    snprintf(extra, sizeof extra, ",\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"%s\"}]",
             data_uri(tga, sizeof tga));
    write_square("tangents.gltf", "{\"normalTexture\":{\"index\":0}}", extra);
    struct scene_model *model = load("tangents.gltf");
    const struct scene_mesh *mesh = &model->meshes[0];
    // u grows along +x and −v along +y: the frame is right-handed.
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        assert_floats(mesh->tangents[i], (const float[]){1, 0, 0, 1}, 4, 1e-6f);
    }
    scene_model_free(model);
    write_square(
        "tangents.gltf",
        "{\"normalTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"scale\":[-1,1]}}}}",
        extra);
    model = load("tangents.gltf");
    for (uint32_t i = 0; i < model->meshes[0].vertex_count; i++) {
        assert_floats(model->meshes[0].tangents[i], (const float[]){-1, 0, 0, -1}, 4, 1e-6f);
    }
    scene_model_free(model);
}

static void test_cameras_and_lights(void **state)
{
    (void)state;
    struct scene_model *model = load_text(
        "look.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_lights_punctual\"],\"scenes\":[{"
        "\"nodes\":[0,1,2]}],"
        "\"nodes\":[{\"camera\":0,\"translation\":[1,2,3]},{\"camera\":1},"
        "{\"rotation\":[0.70710678,0,0,0.70710678],\"translation\":[0,5,0],\"extensions\":{\"KHR_lights_"
        "punctual\":{\"light\":0}}}],"
        "\"cameras\":[{\"name\":\"eye\",\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,\"znear\":0."
        "25,\"aspectRatio\":2}},"
        "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":3,\"ymag\":2,\"znear\":1,\"zfar\":9}}],"
        "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"color\":[1,0.5,0],"
        "\"intensity\":20,"
        "\"range\":7,\"spot\":{\"innerConeAngle\":0,\"outerConeAngle\":1.0471975511965976}}]}}}");
    assert_int_equal(model->camera_count, 2);
    assert_string_equal(model->cameras[0].name, "eye");
    assert_floats(&model->cameras[0].yfov, (const float[]){0.5f, 2}, 2, 0);
    assert_floats(&model->cameras[0].znear, (const float[]){0.25f, 0}, 2, 0);
    assert_floats(model->cameras[0].world + 12, (const float[]){1, 2, 3}, 3, 0);
    assert_true(model->cameras[1].orthographic);
    assert_floats(&model->cameras[1].xmag, (const float[]){3, 2, 1, 9}, 4, 0);
    const struct scene_model_light *light = &model->lights[0];
    assert_int_equal(model->light_count, 1);
    assert_int_equal(light->type, SCENE_LIGHT_SPOT);
    assert_floats(light->position, (const float[]){0, 5, 0}, 3, 0);
    assert_floats(light->direction, (const float[]){0, 1, 0}, 3, 1e-6f); // −z turned about x by 90°
    assert_floats(light->color, (const float[]){1, 0.5f, 0}, 3, 0);
    assert_floats(&light->intensity, (const float[]){20, 7, 1, 0.5f}, 4, 1e-6f);
    scene_model_free(model);
}

static void test_poses(void **state)
{
    (void)state;
    const struct {
        float positions[3][3];
        float deltas[3][3];
        uint8_t joints[3][4];
        float weights[3][4];
    } data = {
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
        {{0, 0, 0}, {0, 0, 0}, {0, 2, 0}},
        {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}},
        {{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}},
    };
    const char *uri = data_uri(&data, sizeof data);
    const char *format =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1,2]}],"
        "\"nodes\":[{\"mesh\":0,\"translation\":[100,0,0]%s},{\"translation\":[0,0,1]},{\"translation\":[0,0,"
        "3]}],"
        "\"skins\":[{\"joints\":[1,2]}],"
        "\"meshes\":[{\"weights\":[0.5],\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":2,"
        "\"WEIGHTS_0\":3},"
        "\"targets\":[{\"POSITION\":1}]}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},"
        "{\"bufferView\":0,\"byteOffset\":84,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":132}],\"buffers\":[{\"byteLength\":132,\"uri\":\"%s\"}"
        "]}";
    char text[4096];
    snprintf(text, sizeof text, format, "", uri);
    struct scene_model *model = load_text("morph.gltf", text);
    assert_floats(model->meshes[0].positions[2], (const float[]){0, 2, 0}, 3, 0);
    assert_floats(model->instances[0].world + 12, (const float[]){100, 0, 0}, 3, 0);
    scene_model_free(model);
    snprintf(text, sizeof text, format, ",\"weights\":[1],\"skin\":0", uri);
    model = load_text("skin.gltf", text);
    // The joints place the vertices; the node's own transform is ignored (§3.7.3.3).
    assert_floats(model->meshes[0].positions[0], (const float[]){0, 0, 1}, 3, 0);
    assert_floats(model->meshes[0].positions[1], (const float[]){1, 0, 3}, 3, 0);
    assert_floats(model->meshes[0].positions[2], (const float[]){0, 3, 2}, 3, 0);
    assert_floats(model->instances[0].world + 12, (const float[]){0, 0, 0}, 3, 0);
    scene_model_free(model);
}

static void test_glb_and_file_names(void **state)
{
    (void)state;
    const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const char *json =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36%s}]}";
    char text[1024] = {0};
    unsigned char glb[1200] = "glTF\2\0\0\0";
    snprintf(text, sizeof text, json, "");
    const uint32_t padded = ((uint32_t)strlen(text) + 3) / 4 * 4, total = 12 + 8 + padded + 8 + 36, size = 36;
    memset(text + strlen(text), ' ', padded - strlen(text));
    memcpy(glb + 8, &total, 4);
    memcpy(glb + 12, &padded, 4);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, text, padded);
    memcpy(glb + 20 + padded, &size, 4);
    memcpy(glb + 24 + padded, "BIN\0", 4);
    memcpy(glb + 28 + padded, triangle, size);
    write_bytes("box.glb", glb, total);
    struct scene_model *model = load("box.glb");
    assert_int_equal(model->triangles_drawn, 1);
    scene_model_free(model);
    write_bytes("cut.glb", glb, total - 1);
    expect_refused("cut.glb", "truncated");
    // Percent-encoded and not ASCII.
    write_bytes("n\xc3\xa4me with blanks.bin", triangle, sizeof triangle);
    snprintf(text, sizeof text, json, ",\"uri\":\"n%C3%A4me%20with%20blanks.bin\"");
    model = load_text("names.gltf", text);
    assert_floats(model->meshes[0].positions[1], triangle + 3, 3, 0);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_hierarchy),
    cmocka_unit_test(test_topologies),
    cmocka_unit_test(test_flat_normals),
    cmocka_unit_test(test_attribute_formats),
    cmocka_unit_test(test_sparse),
    cmocka_unit_test(test_material),
    cmocka_unit_test(test_minification_filters),
    cmocka_unit_test(test_missing_texture),
    cmocka_unit_test(test_tangents),
    cmocka_unit_test(test_cameras_and_lights),
    cmocka_unit_test(test_poses),
    cmocka_unit_test(test_glb_and_file_names),
};

const struct unit_tests test_model = UNIT_TESTS(tests, make_directory, remove_directory);
