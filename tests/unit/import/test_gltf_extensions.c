// SPDX-License-Identifier: MIT
// Extensions of glTF: compressed geometry and images, written here by the encoders of the libraries that read them;
// instances, visibility and variants.
#include "draco_encode.h"
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <meshoptimizer.h>
#include <webp/encode.h>

static uint32_t random_state = 7;

static uint32_t next_random(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

static int random_between(int least, int most)
{
    return least + (int)(next_random() % (uint32_t)(most - least + 1));
}

// EXT_meshopt_compression ---------------------------------------------------------------------------

enum { POINTS = 64 };

// A file with points in one compressed view.
static void write_points(const char *extension, const char *filter, int type, int stride, const void *bytes,
                         size_t size)
{
    write_format(
        "points.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"%s\"],\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"mode\":0,\"attributes\":{\"POSITION\":"
        "0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":%d,\"normalized\":%s,\"count\":%d,"
        "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":1,\"byteLength\":%d,\"byteStride\":%d,"
        "\"extensions\":{\"%s\":{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":%d,\"count\":%d,"
        "\"mode\":\"ATTRIBUTES\",\"filter\":\"%s\"}}}],\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"},"
        "{\"byteLength\":%d,\"extensions\":{\"%s\":{\"fallback\":true}}}]}",
        extension, type, type == 5126 ? "false" : "true", POINTS, POINTS * stride, stride, extension, size,
        stride, POINTS, filter, size, data_uri(bytes, size), POINTS * stride, extension);
}

// Numbers as the filter takes them.
static void make_element(const char *filter, int stride, unsigned char *element)
{
    const bool is_octahedron = strcmp(filter, "OCTAHEDRAL") == 0;
    if (strcmp(filter, "EXPONENTIAL") == 0 || strcmp(filter, "NONE") == 0) {
        for (int c = 0; c < 3; c++) {
            const float value = (float)random_between(-1000, 1000) / 8;
            const uint32_t word = (uint32_t)random_between(-40, 40) << 24 | (next_random() & 0xffffff);
            memcpy(element + 4 * c, strcmp(filter, "NONE") == 0 ? (const void *)&value : &word, 4);
        }
        return;
    }
    const int one = is_octahedron ? (stride == 4 ? 127 : 2047) : 4095;
    for (int c = 0; c < 4; c++) {
        int value = c == 2 && is_octahedron ? one : random_between(-one, one);
        if (is_octahedron && c == 1 && random_between(0, 9) == 0) {
            value = 0;
        }
        if (!is_octahedron) {
            value = c == 3 ? (one & ~3) | random_between(0, 3) : value / 2;
        }
        const int16_t word = (int16_t)value;
        memcpy(element + c * stride / 4, &word, (size_t)stride / 4);
    }
}

// What the octahedral filter of the specification gives for an element, before it is rounded: components of a unit vector
// times the greatest number.
static void unfold(const unsigned char *element, int stride, double v[3])
{
    int16_t words[4];
    for (int c = 0; c < 3; c++) {
        memcpy(&words[c], element + 2 * c, 2);
        words[c] = stride == 4 ? (int8_t)element[c] : words[c];
    }
    v[0] = (double)words[0] / words[2];
    v[1] = (double)words[1] / words[2];
    v[2] = 1 - fabs(v[0]) - fabs(v[1]);
    const double below = v[2] < 0 ? v[2] : 0;
    v[0] -= copysign(below, v[0]);
    v[1] -= copysign(below, v[1]);
    const double scale = (stride == 4 ? 127 : 32767) / sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int c = 0; c < 3; c++) {
        v[c] *= scale;
    }
}

static float component_of(const unsigned char *element, int stride, int c)
{
    float value;
    int16_t word;
    memcpy(&value, element + 4 * c * (stride == 12), 4);
    memcpy(&word, element + 2 * c, 2);
    return stride == 12 ? value : stride == 8 ? (float)word : (float)(int8_t)element[c];
}

// Filters give what the library's give, though they are computed by other means: to one unit, because the library takes
// the processor's estimate of 1/√x, which is not the same on every machine. Octahedral ones round what the specification
// says.
static void test_meshopt_filters(void **state)
{
    (void)state;
    static const struct {
        const char *extension, *filter;
        int type, stride;
        void (*expected)(void *buffer, size_t count, size_t stride);
    } cases[] = {
        {"EXT_meshopt_compression", "NONE", 5126, 12, NULL},
        {"EXT_meshopt_compression", "OCTAHEDRAL", 5120, 4, meshopt_decodeFilterOct},
        {"EXT_meshopt_compression", "OCTAHEDRAL", 5122, 8, meshopt_decodeFilterOct},
        {"KHR_meshopt_compression", "QUATERNION", 5122, 8, meshopt_decodeFilterQuat},
        {"EXT_meshopt_compression", "EXPONENTIAL", 5126, 12, meshopt_decodeFilterExp},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const int stride = cases[i].stride;
        const bool is_octahedron = strcmp(cases[i].filter, "OCTAHEDRAL") == 0;
        unsigned char elements[POINTS * 12], filtered[POINTS * 12], bytes[4096];
        for (int p = 0; p < POINTS; p++) {
            make_element(cases[i].filter, stride, elements + p * stride);
        }
        const size_t size = meshopt_encodeVertexBuffer(bytes, sizeof bytes, elements, POINTS, (size_t)stride);
        assert_true(size > 0);
        write_points(cases[i].extension, cases[i].filter, cases[i].type, stride, bytes, size);
        memcpy(filtered, elements, sizeof filtered);
        if (cases[i].expected != NULL) {
            cases[i].expected(filtered, POINTS, (size_t)stride);
        }
        struct scene_model *model = load("points.gltf");
        assert_int_equal(model->meshes[0].vertex_count, POINTS);
        const float most = stride == 12 ? 1 : stride == 8 ? 32767 : 127;
        for (int p = 0; p < POINTS; p++) {
            double exact[3];
            unfold(elements + p * stride, stride, exact);
            for (int c = 0; c < 3; c++) {
                const float value = model->meshes[0].positions[p][c] * most;
                const float expected = component_of(filtered + p * stride, stride, c);
                assert_float_equal(value, expected, stride == 12 ? 0 : 1.01f);
                assert_true(!is_octahedron || fabs((double)value - exact[c]) < 0.51);
            }
        }
        scene_model_free(model);
    }
}

// Indices of 2 and 4 bytes, as triangles and as a sequence.
static void test_meshopt_indices(void **state)
{
    (void)state;
    enum { TRIANGLES = 40, VERTICES = 30 };
    float positions[VERTICES][3];
    unsigned indices[3 * TRIANGLES];
    for (int i = 0; i < VERTICES; i++) {
        positions[i][0] = (float)i, positions[i][1] = (float)(i * i), positions[i][2] = 1;
    }
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        indices[i] = i % 3 == 0 ? (unsigned)i / 3 % (VERTICES - 2) : indices[i - 1] + 1;
    }
    for (int variant = 0; variant < 4; variant++) {
        const bool is_sequence = variant % 2 == 1;
        const int width = variant / 2 == 0 ? 2 : 4;
        unsigned char bytes[1024];
        const size_t size = is_sequence
                                ? meshopt_encodeIndexSequence(bytes, sizeof bytes, indices, 3 * TRIANGLES)
                                : meshopt_encodeIndexBuffer(bytes, sizeof bytes, indices, 3 * TRIANGLES);
        assert_true(size > 0);
        write_format(
            "indices.gltf",
            "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},"
            "{\"bufferView\":1,\"componentType\":%d,\"count\":%d,\"type\":\"SCALAR\"}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu},{\"buffer\":1,\"byteLength\":%d,"
            "\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":1,\"byteLength\":%zu,"
            "\"byteStride\":%d,\"count\":%d,\"mode\":\"%s\"}}}],"
            "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"},{\"byteLength\":%zu,\"uri\":\"%s\"}]}",
            VERTICES, width == 2 ? 5123 : 5125, 3 * TRIANGLES, sizeof positions, 3 * TRIANGLES * width, size,
            width, 3 * TRIANGLES, is_sequence ? "INDICES" : "TRIANGLES", sizeof positions,
            data_uri(positions, sizeof positions), size, data_uri(bytes, size));
        struct scene_model *model = load("indices.gltf");
        const struct scene_mesh *mesh = &model->meshes[0];
        assert_int_equal(mesh->index_count, 3 * TRIANGLES);
        for (int t = 0; t < TRIANGLES; t++) { // the codec may begin with another corner
            float sum = 0, product = 1, sum_of = 0, product_of = 1;
            for (int k = 0; k < 3; k++) {
                sum += mesh->positions[mesh->indices[3 * t + k]][1];
                product *= mesh->positions[mesh->indices[3 * t + k]][0] + 1;
                sum_of += positions[indices[3 * t + k]][1];
                product_of *= positions[indices[3 * t + k]][0] + 1;
            }
            assert_true(sum == sum_of && product == product_of);
        }
        scene_model_free(model);
    }
}

static void test_meshopt_refused(void **state)
{
    (void)state;
    unsigned char elements[POINTS * 12] = {0}, bytes[4096];
    const size_t size = meshopt_encodeVertexBuffer(bytes, sizeof bytes, elements, POINTS, 12);
    write_points("EXT_meshopt_compression", "COLOR", 5126, 12, bytes, size);
    expect_refused("points.gltf", "\"COLOR\" is no mode or filter");
    write_points("EXT_meshopt_compression", "QUATERNION", 5126, 12, bytes, size);
    expect_refused("points.gltf", "do not go together");
    write_points("EXT_meshopt_compression", "NONE", 5126, 12, bytes, size - 1);
    expect_refused("points.gltf", "bufferViews[0]: its meshopt data is damaged");
    bytes[0] = 0;
    write_points("EXT_meshopt_compression", "NONE", 5126, 12, bytes, size);
    expect_refused("points.gltf", "damaged");
    write_text(
        "bomb.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":36,\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteLength\":3,"
        "\"byteStride\":256,\"count\":4000000000,\"mode\":\"ATTRIBUTES\"}}}],"
        "\"buffers\":[{\"byteLength\":3,\"uri\":\"data:a/b;base64,AAAA\"}]}");
    expect_refused("bomb.gltf", "do not go together");
}

// KHR_draco_mesh_compression ------------------------------------------------------------------------

enum { SIDE = 9, CORNERS = SIDE * SIDE * 6 };

static float soup_positions[CORNERS][3], soup_normals[CORNERS][3], soup_uvs[CORNERS][2];
static uint8_t soup_colors[CORNERS][4];

// A curved sheet.
static struct draco_soup make_soup(void)
{
    static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (int i = 0; i < CORNERS; i++) {
        const float x = (float)(i / 6 % SIDE + corners[i % 6][0]) / SIDE;
        const float y = (float)(i / 6 / SIDE + corners[i % 6][1]) / SIDE;
        const float length = sqrtf(1 + x * x + y * y);
        soup_positions[i][0] = 4 * x - 1, soup_positions[i][1] = 3 * y, soup_positions[i][2] = x * y;
        soup_normals[i][0] = -x / length, soup_normals[i][1] = y / length;
        soup_normals[i][2] = (i / 6 % 2 == 0 ? 1 : -1) / length;
        soup_uvs[i][0] = x, soup_uvs[i][1] = 1 - y;
        for (int c = 0; c < 4; c++) {
            soup_colors[i][c] = (uint8_t)(20 * c + (int)(100 * x));
        }
    }
    return (struct draco_soup){.triangles = CORNERS / 3,
                               .positions = (const float(*)[3])soup_positions,
                               .normals = (const float(*)[3])soup_normals,
                               .uvs = (const float(*)[2])soup_uvs,
                               .colors = (const uint8_t(*)[4])soup_colors};
}

static int draco_indices = 4; // the accessor

static void write_draco(const void *bytes, size_t size, int color_type, int mode)
{
    write_format(
        "draco.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],"
        "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"mode\":%d,"
        "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,\"COLOR_0\":3},\"indices\":%d,"
        "\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,\"attributes\":{\"POSITION\":0,"
        "\"NORMAL\":1,\"TEXCOORD_0\":2,\"COLOR_0\":3}}}}]}],"
        "\"accessors\":[{\"componentType\":5126,\"count\":9,\"type\":\"VEC3\"},"
        "{\"componentType\":5126,\"count\":9,\"type\":\"VEC3\"},{\"componentType\":5126,\"count\":9,\"type\":"
        "\"VEC2\"},{\"componentType\":%d,\"normalized\":true,\"count\":9,\"type\":\"VEC4\"},"
        "{\"componentType\":5123,\"count\":9,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"}"
        "]}",
        mode, draco_indices, color_type, size, size, data_uri(bytes, size));
}

// The corner of the soup that has this position and, as there are two of each, this normal.
static int find_corner(const float position[3], const float normal[3])
{
    int best = 0;
    float least = 1e9f;
    for (int i = 0; i < CORNERS; i++) {
        float distance = 0;
        for (int c = 0; c < 3; c++) {
            distance += fabsf(soup_positions[i][c] - position[c]) + fabsf(soup_normals[i][c] - normal[c]);
        }
        if (distance < least) {
            least = distance;
            best = i;
        }
    }
    return best;
}

static void check_draco(const struct scene_mesh *mesh, float position, float normal, float uv)
{
    assert_int_equal(mesh->index_count, CORNERS);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const uint32_t v = mesh->indices[i];
        const int corner = find_corner(mesh->positions[v], mesh->normals[v]);
        assert_floats(mesh->positions[v], soup_positions[corner], 3, position);
        assert_floats(mesh->normals[v], soup_normals[corner], 3, normal);
        assert_floats(mesh->uvs[0][v], soup_uvs[corner], 2, uv);
        for (int c = 0; c < 4; c++) {
            assert_true(mesh->colors[v][c] == (float)soup_colors[corner][c] / 255);
        }
    }
    double area = 0; // of the sheet's shadow: every triangle is there once, counter-clockwise
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const float *a = mesh->positions[mesh->indices[i]], *b = mesh->positions[mesh->indices[i + 1]],
                    *c = mesh->positions[mesh->indices[i + 2]];
        area += 0.5 * (double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    assert_float_equal(area, 12, 1e-3);
}

static void test_draco(void **state)
{
    (void)state;
    unsigned char bytes[12000];
    struct draco_soup soup = make_soup();
    size_t size = draco_encode(&soup, bytes, sizeof bytes); // floats as they are
    assert_true(size > 0);
    write_draco(bytes, size, 5121, 4);
    struct scene_model *model = load("draco.gltf");
    check_draco(&model->meshes[0], 0, 1e-7f, 0); // normals get the length 1 again
    scene_model_free(model);
    soup.position_bits = 14, soup.normal_bits = 10, soup.uv_bits = 12;
    size = draco_encode(&soup, bytes, sizeof bytes);
    assert_true(size > 0);
    write_draco(bytes, size, 5121, 5); // a strip, which Draco made a list of
    model = load("draco.gltf");
    check_draco(&model->meshes[0], 0.5001f * 4 / ((1 << 14) - 1), 4.0f / (1 << 10),
                0.5001f / ((1 << 12) - 1));
    scene_model_free(model);
}

static void test_draco_refused(void **state)
{
    (void)state;
    unsigned char bytes[12000];
    struct draco_soup soup = make_soup();
    size_t size = draco_encode(&soup, bytes, sizeof bytes);
    write_draco(bytes, size / 2, 5121, 4);
    expect_refused("draco.gltf", "meshes[0].primitives[0]: its Draco data cannot be read");
    write_draco("DRACO nothing", 13, 5121, 4);
    expect_refused("draco.gltf", "its Draco data cannot be read");
    write_draco(bytes, size, 5130, 4);
    expect_refused("draco.gltf", "has no attribute COLOR_0 of the shape its accessor says");
    draco_indices = 0; // that of positions
    write_draco(bytes, size, 5121, 4);
    expect_refused("draco.gltf", "accessors[0] stands for indices and for an attribute");
    draco_indices = 4;
    soup.uvs = NULL;
    size = draco_encode(&soup, bytes, sizeof bytes);
    write_draco(bytes, size, 5121, 4);
    expect_refused("draco.gltf", "has no attribute TEXCOORD_0");
}

// EXT_texture_webp ----------------------------------------------------------------------------------

static void write_textured(const char *name, const char *texture, const void *image, size_t size)
{
    write_bytes("image.webp", image, size);
    write_format(name,
                 "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                 "\"accessors\":[{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
                 "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
                 "\"textures\":[%s],\"images\":[{\"uri\":\"nothing.png\"},{\"uri\":\"image.webp\"}]}",
                 texture);
}

static void test_webp(void **state)
{
    (void)state;
    enum { WIDTH = 5, HEIGHT = 3 };
    uint8_t texels[HEIGHT][WIDTH][4], *encoded = NULL;
    for (size_t i = 0; i < sizeof texels; i++) {
        (&texels[0][0][0])[i] = i % 4 == 3 ? 255 : (uint8_t)next_random();
    }
    texels[1][2][3] = 90;
    const size_t size = WebPEncodeLosslessRGBA(texels[0][0], WIDTH, HEIGHT, 4 * WIDTH, &encoded);
    assert_true(size > 0);
    write_textured("webp.gltf", "{\"source\":0,\"extensions\":{\"EXT_texture_webp\":{\"source\":1}}}",
                   encoded, size);
    struct scene_model *model = load("webp.gltf");
    const struct scene_image *image = &model->images[model->materials[0].slots[SCENE_SLOT_BASE_COLOR].image];
    assert_int_equal(image->width, WIDTH);
    assert_int_equal(image->height, HEIGHT);
    assert_true(image->has_alpha && !image->missing);
    assert_memory_equal(image->texels, texels, sizeof texels);
    scene_model_free(model);
    write_textured("webp.gltf", "{\"source\":1}", encoded, size / 2);
    model = load("webp.gltf");
    assert_true(has_warning(model, "image.webp\": damaged WebP"));
    assert_true(model->images[0].missing);
    scene_model_free(model);
    WebPFree(encoded);
}

// Images of other formats count where there is no other one.
static void test_other_images(void **state)
{
    (void)state;
    const uint8_t texel[21] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24};
    static const char *const names[] = {"EXT_texture_avif", "MSFT_texture_dds"};
    for (int i = 0; i < 2; i++) {
        for (int beside = 0; beside < 2; beside++) {
            char texture[160];
            snprintf(texture, sizeof texture, "{%s\"extensions\":{\"%s\":{\"source\":%d}}}",
                     beside ? "\"source\":1," : "", names[i], beside ? 0 : 1);
            write_textured("other.gltf", texture, texel, sizeof texel);
            struct scene_model *model = load("other.gltf");
            assert_int_equal(model->images[0].width, 1);
            assert_false(model->images[0].missing);
            scene_model_free(model);
        }
    }
}

// Nodes ---------------------------------------------------------------------------------------------

#define TRIANGLE                                                                                     \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0,\"extensions\":{"  \
    "\"KHR_materials_variants\":{\"mappings\":[{\"material\":1,\"variants\":[0,2]},{\"material\":2," \
    "\"variants\":[1]}]}}}]}],\"materials\":[{\"name\":\"plain\"},{\"name\":\"red\"},{\"name\":\"blue\"}],"

static void write_nodes(const char *name, const char *nodes, const char *roots)
{
    const struct {
        float positions[3][3], moves[4][3], turns[4][4], scales[4][3];
    } data = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
              {{0, 0, 0}, {1, 2, 3}, {4, 0, 0}, {0, 5, 0}},
              {{0, 0, 0, 1}, {0, 0, 0.70710678f, 0.70710678f}, {0, 0, 0, 1}, {0, 0, 0, 1}},
              {{1, 1, 1}, {2, 2, 2}, {1, 1, 1}, {1, 3, 1}}};
    write_format(
        name,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[%s]}],\"nodes\":[%s]," TRIANGLE
        "\"extensions\":{\"KHR_materials_variants\":{\"variants\":[{\"name\":\"rust\"},{\"name\":\"sea\"},"
        "{\"name\":\"old\"},{\"name\":\"bare\"}]}},"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":84,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"},"
        "{\"bufferView\":0,\"byteOffset\":148,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":196}],"
        "\"buffers\":[{\"byteLength\":196,\"uri\":\"%s\"}]}",
        roots, nodes, data_uri(&data, sizeof data));
}

static void test_instancing(void **state)
{
    (void)state;
    write_nodes(
        "many.gltf",
        "{\"mesh\":0,\"translation\":[10,0,0],\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
        "\"TRANSLATION\":1,\"ROTATION\":2,\"SCALE\":3}}}}",
        "0");
    struct scene_model *model = load("many.gltf");
    assert_int_equal(model->instance_count, 4);
    assert_int_equal(model->triangles_drawn, 4);
    for (uint32_t i = 0; i < 4; i++) {
        assert_int_equal(model->instances[i].object, i + 1);
        assert_int_equal(model->instances[i].mesh, 0);
    }
    const float turned[16] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 11, 2, 3, 1};
    assert_floats(model->instances[1].world, turned, 16, 1e-6f);
    const float stretched[16] = {1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 10, 5, 0, 1};
    assert_floats(model->instances[3].world, stretched, 16, 0);
    scene_model_free(model);
    write_nodes("many.gltf",
                "{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":1,"
                "\"SCALE\":0}}}}",
                "0");
    expect_refused("many.gltf", "EXT_mesh_gpu_instancing: SCALE has 3 elements where others have 4");
}

static void test_visibility(void **state)
{
    (void)state;
    write_nodes("hidden.gltf",
                "{\"children\":[1,2]},{\"mesh\":0,\"children\":[3],\"extensions\":{\"KHR_node_visibility\":{"
                "\"visible\":false}}},{\"name\":\"seen\",\"mesh\":0,\"extensions\":{\"KHR_node_visibility\":{"
                "\"visible\":true}}},{\"mesh\":0}",
                "0");
    struct scene_model *model = load("hidden.gltf");
    assert_int_equal(model->instance_count, 1);
    assert_string_equal(model->instances[0].name, "seen");
    scene_model_free(model);
}

// Avatars of VRM 0 look towards −z, those of VRM 1 towards +z.
static void test_avatars(void **state)
{
    (void)state;
    for (int version = 0; version < 2; version++) {
        write_format(
            "avatar.gltf",
            "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"%s\"],\"scenes\":[{\"nodes\":[0]}],"
            "\"nodes\":[{\"name\":\"a\"}]}",
            version == 0 ? "VRM" : "VRMC_vrm");
        struct scene_model *const model = load("avatar.gltf");
        assert_true(model->faces_back == (version == 0));
        scene_model_free(model);
    }
}

// Against the rules, but drawn elsewhere: once, with a warning.
static void test_root_and_child(void **state)
{
    (void)state;
    write_nodes("both.gltf", "{\"translation\":[1,0,0],\"children\":[1]},{\"mesh\":0}", "1,0");
    struct scene_model *model = load("both.gltf");
    assert_int_equal(model->instance_count, 1);
    assert_true(model->instances[0].world[12] == 1);
    assert_true(has_warning(model, "nodes[1] is a root of the scene and a child of nodes[0]"));
    scene_model_free(model);
}

static const char *material_of(const char *variant)
{
    static char name[32];
    char error[512] = "";
    const struct scene_model_options options = {.variant = variant};
    struct scene_model *model = scene_model_load(path_of("variants.gltf"), &options, error, sizeof error);
    assert_non_null(model);
    assert_int_equal(model->variant_count, 4);
    assert_string_equal(model->variants[1], "sea");
    snprintf(name, sizeof name, "%s", model->materials[model->meshes[0].material].name);
    scene_model_free(model);
    return name;
}

static void test_variants(void **state)
{
    (void)state;
    write_nodes("variants.gltf", "{\"mesh\":0}", "0");
    assert_string_equal(material_of(NULL), "plain");
    assert_string_equal(material_of("rust"), "red");
    assert_string_equal(material_of("sea"), "blue");
    assert_string_equal(material_of("old"), "red");
    assert_string_equal(material_of("bare"), "plain");
    char error[512] = "";
    const struct scene_model_options unknown = {.variant = "gold"};
    assert_null(scene_model_load(path_of("variants.gltf"), &unknown, error, sizeof error));
    assert_string_equal(error, "has no variant 'gold'; it has 'rust', 'sea', 'old', 'bare'");
    write_text("none.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_null(scene_model_load(path_of("none.obj"), &unknown, error, sizeof error));
    assert_string_equal(error, "has no variants of its materials");
}

// Rules that other viewers forgive, and what is left out.
static void test_forgiven(void **state)
{
    (void)state;
    struct scene_model *model =
        load_text("number.gltf",
                  "{\"asset\":{\"version\":2},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":\"a\"}]}");
    assert_true(has_warning(model, "asset.version is the number 2; it must be the string \"2.0\""));
    scene_model_free(model);
    // An extension that is used and not listed; one that says nothing about the picture.
    const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    write_format(
        "used.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_xmp_json_ld\",\"OMI_physics_body\","
        "\"VRMC_springBone\",\"EXT_feature_metadata\"],"
        "\"extensionsRequired\":[\"EXT_feature_metadata\"],\"scenes\":[{"
        "\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"material\":0,\"attributes\":{"
        "\"POSITION\":0}}]}],"
        "\"materials\":[{\"extensions\":{\"EXT_glow\":{}}}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]}",
        data_uri(triangle, sizeof triangle));
    model = load("used.gltf");
    assert_int_equal(model->unsupported_count, 1);
    assert_string_equal(model->unsupported[0], "glTF extension EXT_glow: ignored");
    scene_model_free(model);
}

// A triangle with one material, its `members` besides the name.
static struct scene_model *load_material(const char *members)
{
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    char error[512] = "";
    write_format(
        "material.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"material\":0,\"attributes\":{\"POSITION\":0}}]}],"
        "\"materials\":[{\"name\":\"m\",%s}],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"no.png\"}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]}",
        members, data_uri(corners, sizeof corners));
    struct scene_model *model = scene_model_load(path_of("material.gltf"), NULL, error, sizeof error);
    if (model == NULL) {
        fail_msg("%s", error);
    }
    return model;
}

static void assert_near(float value, double expected)
{
    if (!(fabs((double)value - expected) < 1e-6)) {
        fail_msg("%g instead of %g", (double)value, expected);
    }
}

static void test_layers(void **state)
{
    (void)state;
    struct scene_model *model = load_material("\"doubleSided\":true");
    const struct scene_layers *l = &model->materials[0].layers;
    assert_false(l->used);
    scene_model_free(model);
    model = load_material(
        "\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.5,\"clearcoatRoughnessFactor\":0."
        "25},"
        "\"KHR_materials_sheen\":{\"sheenColorFactor\":[1,0.5,0],\"sheenRoughnessFactor\":0.75},"
        "\"KHR_materials_specular\":{\"specularFactor\":0.125,\"specularColorFactor\":[2,1,0]},"
        "\"KHR_materials_ior\":{\"ior\":1.25},\"KHR_materials_transmission\":{\"transmissionFactor\":0.875},"
        "\"KHR_materials_volume\":{\"thicknessFactor\":3,\"attenuationDistance\":2,\"attenuationColor\":[0.5,"
        "1,0]},"
        "\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0.5,\"anisotropyRotation\":1.5707963267948966},"
        "\"KHR_materials_iridescence\":{\"iridescenceFactor\":1,\"iridescenceIor\":1.5,"
        "\"iridescenceThicknessMinimum\":50,\"iridescenceThicknessMaximum\":60},"
        "\"KHR_materials_dispersion\":{\"dispersion\":0.5}}");
    l = &model->materials[0].layers;
    assert_true(l->used && !l->glossy && scene_material_transmits(&model->materials[0]));
    assert_near(l->clearcoat, 0.5);
    assert_near(l->clearcoat_roughness, 0.25);
    assert_near(l->clearcoat_normal_scale, 1);
    assert_near(l->sheen_color[1], 0.5);
    assert_near(l->sheen_roughness, 0.75);
    assert_near(l->specular, 0.125);
    assert_near(l->specular_color[0], 2);
    assert_near(l->ior, 1.25);
    assert_near(l->transmission, 0.875);
    assert_near(l->thickness, 3);
    assert_near(l->attenuation_distance, 2);
    assert_near(l->attenuation_color[0], 0.5);
    assert_near(l->anisotropy, 0.5);
    assert_near(l->anisotropy_direction[0], 0);
    assert_near(l->anisotropy_direction[1], 1);
    assert_near(l->iridescence, 1);
    assert_near(l->iridescence_ior, 1.5);
    assert_near(l->iridescence_thickness[0], 50);
    assert_near(l->iridescence_thickness[1], 60);
    assert_near(l->dispersion, 0.5);
    assert_int_equal(model->unsupported_count, 0);
    scene_model_free(model);
    // The older model wins over what stands in for it.
    model = load_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]},\"extensions\":{"
                          "\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":[0.5,1,1,1],"
                          "\"specularFactor\":[0.25,0,0],\"glossinessFactor\":0.5}}");
    l = &model->materials[0].layers;
    assert_true(l->used && l->glossy);
    assert_near(model->materials[0].base_color[0], 0.5);
    assert_near(l->gloss_specular[0], 0.25);
    assert_near(l->glossiness, 0.5);
    scene_model_free(model);
    // Nonsense is held to what there is.
    model = load_material("\"extensions\":{\"KHR_materials_ior\":{\"ior\":-3},\"KHR_materials_clearcoat\":"
                          "{\"clearcoatFactor\":7},\"KHR_materials_volume\":{\"attenuationDistance\":-1},"
                          "\"KHR_materials_transmission\":{\"transmissionFactor\":-2}}");
    l = &model->materials[0].layers;
    assert_near(l->ior, 1.5);
    assert_near(l->clearcoat, 1);
    assert_true(l->attenuation_distance > 1e30f);
    assert_false(scene_material_transmits(&model->materials[0]));
    scene_model_free(model);
    model = load_material("\"extensions\":{\"KHR_materials_ior\":{\"ior\":0}}"); // everything is mirrored
    assert_near(model->materials[0].layers.ior, 1000);
    scene_model_free(model);
}

// A property of a name that is nearly glTF's is told, and none that is another's or stands beside the right one.
static void test_misspelt(void **state)
{
    (void)state;
    static const struct {
        const char *members, *told;
    } cases[] = {
        {"\"pbrMetallicRoughness\":{\"basecolorFactor\":[1,0,0,1]}",
         "the property \"basecolorFactor\" (glTF), which should be \"baseColorFactor\": not used"},
        {"\"pbrMetalicRoughness\":{}", "\"pbrMetalicRoughness\""},
        {"\"alphamode\":\"BLEND\"", "\"alphamode\""},
        {"\"doubelSided\":true", "\"doubelSided\""},
        {"\"emissiveTexture\":{\"index\":0,\"texCord\":1}", "\"texCord\""},
        {"\"normalTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"ofset\":[0,0]}}}",
         "\"ofset\""},
        {"\"extensions\":{\"KHR_materials_clearcoat\":{\"clearCoatFactor\":1}}", "\"clearCoatFactor\""},
        {"\"extras\":{\"alphamode\":1,\"doubleSide\":true}", NULL},
        {"\"alphaMode\":\"BLEND\",\"alphamode\":\"BLEND\"", NULL},
        {"\"technique\":3,\"shading\":{\"alphamode\":1}", NULL},
        {"\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1},\"KHR_materials_ior\":{\"ior\":"
         "2}}",
         NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *model = load_material(cases[i].members);
        if (model->unsupported_count != (cases[i].told != NULL) ||
            (cases[i].told != NULL && !is_unsupported(model, cases[i].told))) {
            fail_msg("%zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
}

// What is not drawn is told: other scenes, morph targets of colours, and extensions that the file does not list, of a
// primitive and of a texture.
static void test_told(void **state)
{
    (void)state;
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    write_format(
        "told.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":1,\"scenes\":[{},{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}"
        "],"
        "\"meshes\":[{\"weights\":[1],\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0,"
        "\"targets\":[{\"COLOR_0\":0}],\"extensions\":{\"EXT_of_primitives\":{}}}]}],"
        "\"materials\":[{\"emissiveTexture\":{\"index\":0}}],\"textures\":[{\"extensions\":{\"EXT_of_"
        "textures\":{}}}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]"
        "}",
        data_uri(positions, sizeof positions));
    struct scene_model *model = load("told.gltf");
    assert_true(is_unsupported(model, "scenes[1] alone is drawn, of 2 scenes"));
    assert_true(is_unsupported(model, "morph targets of colours and texture coordinates: left as at rest"));
    assert_true(is_unsupported(model, "EXT_of_primitives"));
    assert_true(is_unsupported(model, "EXT_of_textures"));
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_forgiven),
    cmocka_unit_test(test_meshopt_filters),
    cmocka_unit_test(test_meshopt_indices),
    cmocka_unit_test(test_meshopt_refused),
    cmocka_unit_test(test_draco),
    cmocka_unit_test(test_draco_refused),
    cmocka_unit_test(test_webp),
    cmocka_unit_test(test_other_images),
    cmocka_unit_test(test_instancing),
    cmocka_unit_test(test_visibility),
    cmocka_unit_test(test_avatars),
    cmocka_unit_test(test_root_and_child),
    cmocka_unit_test(test_variants),
    cmocka_unit_test(test_layers),
    cmocka_unit_test(test_misspelt),
    cmocka_unit_test(test_told),
};

const struct unit_tests test_gltf_extensions = UNIT_TESTS(tests, make_directory, remove_directory);
