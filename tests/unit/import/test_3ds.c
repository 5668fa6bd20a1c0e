// SPDX-License-Identifier: MIT
// 3DS files, which are made here chunk by chunk.
#include "model_files.h"

#include <string.h>

struct chunks {
    unsigned char bytes[2048];
    size_t size;
};

static void put(struct chunks *chunks, const void *bytes, size_t size)
{
    assert_true(chunks->size + size <= sizeof chunks->bytes);
    memcpy(chunks->bytes + chunks->size, bytes, size);
    chunks->size += size;
}

static void put_short(struct chunks *chunks, unsigned number)
{
    put(chunks, (const unsigned char[]){(unsigned char)number, (unsigned char)(number >> 8)}, 2);
}

// Begin a chunk. Return its place.
static size_t begin(struct chunks *chunks, unsigned kind)
{
    put_short(chunks, kind);
    put(chunks, "\0\0\0", 4);
    return chunks->size - 6;
}

static void end(struct chunks *chunks, size_t place)
{
    const size_t size = chunks->size - place;
    chunks->bytes[place + 2] = (unsigned char)size;
    chunks->bytes[place + 3] = (unsigned char)(size >> 8);
}

static void put_text(struct chunks *chunks, unsigned kind, const char *text)
{
    const size_t place = begin(chunks, kind);
    put(chunks, text, strlen(text) + 1);
    end(chunks, place);
}

// An empty chunk: what it says, it says by being there.
static void put_mark(struct chunks *chunks, unsigned kind)
{
    if (kind != 0) {
        end(chunks, begin(chunks, kind));
    }
}

static void put_material(struct chunks *chunks, const unsigned char color[3], unsigned shading,
                         unsigned tiling, unsigned mark)
{
    const size_t material = begin(chunks, 0xafff);
    put_text(chunks, 0xa000, "m");
    const size_t shade = begin(chunks, 0xa100);
    put_short(chunks, shading);
    end(chunks, shade);
    const size_t diffuse = begin(chunks, 0xa020), rgb = begin(chunks, 0x11);
    put(chunks, color, 3);
    end(chunks, rgb);
    end(chunks, diffuse);
    const size_t map = begin(chunks, 0xa200);
    put_text(chunks, 0xa300, "a.png");
    const size_t flags = begin(chunks, 0xa351);
    put_short(chunks, tiling);
    end(chunks, flags);
    end(chunks, map);
    put_mark(chunks, mark);
    end(chunks, material);
}

static void put_triangle(struct chunks *chunks, unsigned mark)
{
    static const float positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                       uvs[3][2] = {{0, 0}, {4, 0}, {0, 4}};
    const size_t object = begin(chunks, 0x4000);
    put(chunks, "o", 2);
    const size_t mesh = begin(chunks, 0x4100), vertices = begin(chunks, 0x4110);
    put_short(chunks, 3);
    put(chunks, positions, sizeof positions);
    end(chunks, vertices);
    const size_t faces = begin(chunks, 0x4120);
    for (unsigned i = 0; i < 5; i++) {
        put_short(chunks, i == 0 ? 1 : i == 4 ? 7 : i - 1); // a count, three corners, edges
    }
    const size_t group = begin(chunks, 0x4130);
    put(chunks, "m", 2);
    put_short(chunks, 1);
    put_short(chunks, 0);
    end(chunks, group);
    end(chunks, faces);
    const size_t coordinates = begin(chunks, 0x4140);
    put_short(chunks, 3);
    put(chunks, uvs, sizeof uvs);
    end(chunks, coordinates);
    end(chunks, mesh);
    put_mark(chunks, mark);
    end(chunks, object);
}

static void put_light(struct chunks *chunks, unsigned mark)
{
    static const float place[3] = {0, 0, 9};
    const size_t object = begin(chunks, 0x4000);
    put(chunks, "l", 2);
    const size_t light = begin(chunks, 0x4600);
    put(chunks, place, sizeof place);
    put_mark(chunks, mark);
    end(chunks, light);
    end(chunks, object);
}

enum { WIRE = 0, PHONG = 3 }; // shading

// What the file has beside a material and a triangle: kinds of chunks, 0 for none.
struct marks {
    unsigned material, object, light, editor;
};

static struct scene_model *make_marked(const unsigned char color[3], unsigned shading, unsigned tiling,
                                       const struct marks *marks)
{
    struct chunks chunks = {.size = 0};
    const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d);
    put_material(&chunks, color, shading, tiling, marks->material);
    put_triangle(&chunks, marks->object);
    put_light(&chunks, marks->light);
    put_mark(&chunks, marks->editor);
    end(&chunks, editor);
    end(&chunks, file);
    write_bytes("a.png", "P6\n1 1\n255\n\x10\x20\x30", 14);
    write_bytes("x.3ds", chunks.bytes, chunks.size);
    return load("x.3ds");
}

static struct scene_model *make_model(const unsigned char color[3], unsigned shading, unsigned tiling)
{
    return make_marked(color, shading, tiling, &(const struct marks){0});
}

// Beside a decal the material's own colour shows: under a grey that gives way to the texture it is that grey, and a
// colour tints both.
static void test_decal(void **state)
{
    (void)state;
    static const struct {
        unsigned char color[3];
        unsigned tiling;
        enum rhw_address address;
        float factor[3], border[4];
    } cases[] = {
        {{188, 188, 188}, 0x10, RHW_ADDRESS_BORDER, {1, 1, 1}, {0.502887f, 0.502887f, 0.502887f, 1}},
        {{188, 0, 0}, 0x11, RHW_ADDRESS_BORDER, {0.502887f, 0, 0}, {1, 1, 1, 1}},
        {{188, 188, 188}, 0, RHW_ADDRESS_REPEAT, {1, 1, 1}, {0.502887f, 0.502887f, 0.502887f, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *const model = make_model(cases[i].color, PHONG, cases[i].tiling);
        const struct scene_material *const material = &model->materials[model->meshes[0].material];
        const struct scene_texture_slot *const slot = &material->slots[SCENE_SLOT_BASE_COLOR];
        assert_true(slot->image >= 0);
        assert_int_equal(slot->address_u, cases[i].address);
        assert_int_equal(slot->address_v, cases[i].address);
        assert_floats(material->base_color, cases[i].factor, 3, 1e-5f);
        assert_floats(slot->border, cases[i].border, 4, 1e-5f);
        scene_model_free(model);
    }
}

static void test_wires(void **state)
{
    (void)state;
    for (unsigned shading = WIRE; shading <= PHONG; shading++) {
        struct scene_model *const model = make_model((const unsigned char[]){9, 9, 9}, shading, 0);
        assert_true(is_unsupported(model, "wire frames: drawn as surfaces") == (shading == WIRE));
        scene_model_free(model);
    }
}

// What assimp passes over without a word.
static void test_told(void **state)
{
    (void)state;
    static const struct {
        unsigned tiling;
        struct marks marks;
        const char *told;
    } cases[] = {
        {0, {0}, NULL},
        {4, {0}, "inverted textures: drawn as they are"},
        {0x80, {0}, "tinted textures: drawn as they are"},
        {0x200, {0}, "tinted textures: drawn as they are"},
        {0x40, {0}, "textures that are the alpha of their image: drawn as its colours"},
        {0, {.material = 0xa33a}, "textures above each other: the first alone is used"},
        {0, {.material = 0xa33e}, "masks of textures: not used"},
        {0, {.material = 0xa310}, "reflections of what is around (3DS): not drawn"},
        {0, {.material = 0xa083}, "additive blending: drawn as ordinary blending"},
        {0, {.material = 0xa085}, "wire frames: drawn as surfaces"},
        {0, {.material = 0xa088}, "textures on each face (3DS): drawn by the coordinates"},
        {0, {.object = 0x4010}, "hidden objects: drawn"},
        {0, {.light = 0x4620}, "lights that are off: drawn as if they were on"},
        {0, {.editor = 0x1201}, "the background: not drawn"},
        {0, {.editor = 0x2201}, "fog: not drawn"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene_model *const model =
            make_marked((const unsigned char[]){9, 9, 9}, PHONG, cases[i].tiling, &cases[i].marks);
        assert_int_equal(model->light_count, 1);
        if (model->unsupported_count != (cases[i].told != NULL) ||
            (cases[i].told != NULL && !is_unsupported(model, cases[i].told))) {
            fail_msg("%zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
}

// Put a triangle that has a matrix with a translation.
static void put_placed(struct chunks *chunks, const char *name, float translation)
{
    const float positions[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                matrix[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, translation, 0, 0};
    const size_t object = begin(chunks, 0x4000);
    put(chunks, name, 2);
    const size_t mesh = begin(chunks, 0x4100), vertices = begin(chunks, 0x4110);
    put_short(chunks, 3);
    put(chunks, positions, sizeof positions);
    end(chunks, vertices);
    const size_t faces = begin(chunks, 0x4120);
    for (unsigned i = 0; i < 5; i++) {
        put_short(chunks, i == 0 ? 1 : i == 4 ? 7 : i - 1);
    }
    end(chunks, faces);
    const size_t place = begin(chunks, 0x4160);
    put(chunks, matrix, sizeof matrix);
    end(chunks, place);
    end(chunks, mesh);
    end(chunks, object);
}

// Put a node of an object with a pivot and a place.
static void put_node(struct chunks *chunks, const char *name, float pivot, float place)
{
    const float pivots[3] = {pivot, 0, 0}, places[3] = {place, 0, 0};
    const size_t node = begin(chunks, 0xb002), head = begin(chunks, 0xb010);
    put(chunks, name, 2);
    put(chunks, "\0\0\0\0\xff\xff", 6);
    end(chunks, head);
    const size_t center = begin(chunks, 0xb013);
    put(chunks, pivots, sizeof pivots);
    end(chunks, center);
    const size_t track = begin(chunks, 0xb020);
    put(chunks, "\0\0\0\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\0\0", 20);
    put(chunks, places, sizeof places);
    end(chunks, track);
    end(chunks, node);
}

// Meshes whose matrices are those of the origin, with pivots that say otherwise, stay where their vertices are. With
// matrices, or without pivots, keys move them.
static void test_lost_places(void **state)
{
    (void)state;
    static const struct {
        float translation, pivot, width;
        bool is_lost;
    } cases[] = {{0, 3, 1, true}, {0, 0, 6, false}, {2, 3, 6, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct chunks chunks = {.size = 0};
        const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d);
        put_placed(&chunks, "a", cases[i].translation);
        put_placed(&chunks, "b", 0);
        end(&chunks, editor);
        const size_t keys = begin(&chunks, 0xb000);
        put_node(&chunks, "a", cases[i].pivot, 5 + cases[i].translation + cases[i].pivot);
        put_node(&chunks, "b", 0, 0);
        end(&chunks, keys);
        end(&chunks, file);
        write_bytes("l.3ds", chunks.bytes, chunks.size);
        struct scene_model *const model = load("l.3ds");
        assert_true(has_warning(model, "has meshes that say nothing of their places: drawn without keys") ==
                    cases[i].is_lost);
        const float width = model->bounds_max[0] - model->bounds_min[0];
        assert_floats(&width, &cases[i].width, 1, 1e-5f);
        scene_model_free(model);
    }
}

// Put two triangles that meet at an edge, of which the second leans by `slope`. `groups` are those of the first ones.
// `zeros` are bytes behind these that are no chunk.
static void put_fold(struct chunks *chunks, float slope, const uint32_t groups[2], unsigned count,
                     unsigned zeros)
{
    const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, -slope}};
    static const unsigned faces[] = {2, 0, 1, 2, 7, 1, 0, 3, 7}; // a count, then corners and edges
    const size_t object = begin(chunks, 0x4000);
    put(chunks, "o", 2);
    const size_t mesh = begin(chunks, 0x4100), vertices = begin(chunks, 0x4110);
    put_short(chunks, 4);
    put(chunks, points, sizeof points);
    end(chunks, vertices);
    const size_t list = begin(chunks, 0x4120);
    for (size_t i = 0; i < sizeof faces / sizeof faces[0]; i++) {
        put_short(chunks, faces[i]);
    }
    if (count > 0) {
        const size_t smoothing = begin(chunks, 0x4150);
        put(chunks, groups, count * sizeof groups[0]);
        end(chunks, smoothing);
    }
    put(chunks, (const char[16]){0}, zeros);
    end(chunks, list);
    end(chunks, mesh);
    end(chunks, object);
}

// Faces are smooth where they have a group in common. A face in none is flat, but where a mesh has no groups at all,
// its faces are smooth except across creases. Bytes behind them that are no chunk change nothing.
static void test_smoothing(void **state)
{
    (void)state;
    static const struct {
        float slope;
        unsigned count; // faces that have groups
        bool is_smooth;
        uint32_t groups[2];
    } cases[] = {
        {0.5f, 0, true, {0}},     {3, 0, false, {0}},       {0.5f, 2, false, {0, 0}},
        {0.5f, 2, false, {2, 0}}, {0.5f, 2, false, {0, 1}}, {3, 2, true, {3, 6}},
        {0.5f, 2, false, {1, 2}}, {0.5f, 1, true, {1}},     {3, 1, false, {1}},
    };
    enum { CASES = sizeof cases / sizeof cases[0] };
    static const unsigned zeros[] = {0, 2, 5, 6, 13};
    for (size_t k = 0; k < 5 * CASES; k++) {
        const size_t i = k % CASES;
        struct chunks chunks = {.size = 0};
        const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d);
        put_fold(&chunks, cases[i].slope, cases[i].groups, cases[i].count, zeros[k / CASES]);
        put_light(&chunks, 0); // behind what has become longer
        end(&chunks, editor);
        end(&chunks, file);
        write_bytes("s.3ds", chunks.bytes, chunks.size);
        struct scene_model *const model = load("s.3ds");
        assert_int_equal(model->triangles_drawn, 2);
        assert_int_equal(model->light_count, 1);
        assert_int_equal(model->warning_count + model->unsupported_count, 0);
        const struct scene_mesh *const mesh = &model->meshes[0];
        if ((mesh->vertex_count == 4) != cases[i].is_smooth) { // corners that share a normal are one vertex
            fail_msg("case %zu: %u vertices", k, mesh->vertex_count);
        }
        scene_model_free(model);
    }
}

// Put a mesh without groups, of `count` points and some faces.
static void put_faces(struct chunks *chunks, const float (*points)[3], unsigned count,
                      const unsigned (*faces)[3], unsigned face_count)
{
    const size_t object = begin(chunks, 0x4000);
    put(chunks, "o", 2);
    const size_t mesh = begin(chunks, 0x4100), vertices = begin(chunks, 0x4110);
    put_short(chunks, count);
    put(chunks, points, count * sizeof points[0]);
    end(chunks, vertices);
    const size_t list = begin(chunks, 0x4120);
    put_short(chunks, face_count);
    for (unsigned i = 0; i < 4 * face_count; i++) {
        put_short(chunks, i % 4 == 3 ? 7 : faces[i / 4][i % 4]);
    }
    end(chunks, list);
    end(chunks, mesh);
    end(chunks, object);
}

// Faces that meet at a point and at no edge are parts of their own, each with its normal there. Those of a part need not
// follow each other.
static void test_parts_without_groups(void **state)
{
    (void)state;
    static const float tie[][3] = {{0, 0, 0}, {1, 1, 0.3f}, {1, -1, 0.3f}, {-1, -1, 0.3f}, {-1, 1, 0.3f}};
    static const float folds[][3] = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0}, {1, -1, -0.5f},
                                     {9, 0, 0}, {10, 0, 0}, {9, 1, 0}, {10, -1, -0.5f}};
    static const unsigned tied[][3] = {{0, 2, 1}, {0, 4, 3}},
                          folded[][3] = {{0, 1, 2}, {4, 5, 6}, {1, 0, 3}, {5, 4, 7}};
    for (int i = 0; i < 2; i++) {
        struct chunks chunks = {.size = 0};
        const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d);
        put_faces(&chunks, folds, 8, folded, 0); // one that has none
        if (i == 0) {
            put_faces(&chunks, tie, 5, tied, 2);
        } else {
            put_faces(&chunks, folds, 8, folded, 4);
        }
        end(&chunks, editor);
        end(&chunks, file);
        write_bytes("p.3ds", chunks.bytes, chunks.size);
        struct scene_model *const model = load("p.3ds");
        assert_int_equal(model->triangles_drawn, i == 0 ? 2 : 4);
        assert_int_equal(model->meshes[model->mesh_count - 1].vertex_count, i == 0 ? 6 : 8);
        scene_model_free(model);
    }
}

// Faces without a material are as light as those of other formats.
static void test_no_material(void **state)
{
    (void)state;
    static const float points[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    struct chunks chunks = {.size = 0};
    const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d);
    put_faces(&chunks, points, 3, (const unsigned[][3]){{0, 1, 2}}, 1);
    end(&chunks, editor);
    end(&chunks, file);
    write_bytes("n.3ds", chunks.bytes, chunks.size);
    struct scene_model *const model = load("n.3ds");
    assert_floats(model->materials[model->meshes[0].material].base_color,
                  (const float[]){0.6f, 0.6f, 0.6f, 1}, 4, 0);
    scene_model_free(model);
}

// A camera looks at its target. Its axes have length 1 and stand upright on each other.
static void test_camera(void **state)
{
    (void)state;
    static const float numbers[8] = {3, 4,  12, 1,
                                     2, 10, 20, 50}; // where it is, what it looks at, its roll and its lens
    struct chunks chunks = {.size = 0};
    const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d);
    put_triangle(&chunks, 0);
    const size_t object = begin(&chunks, 0x4000);
    put(&chunks, "c", 2);
    const size_t camera = begin(&chunks, 0x4700);
    put(&chunks, numbers, sizeof numbers);
    end(&chunks, camera);
    end(&chunks, object);
    end(&chunks, editor);
    end(&chunks, file);
    write_bytes("c.3ds", chunks.bytes, chunks.size);
    struct scene_model *const model = load("c.3ds");
    assert_int_equal(model->camera_count, 1);
    const float *const world = model->cameras[0].world;
    const float back = 0.577350269f; // in x, y and z, which is up in the file and turned to y
    assert_floats(world + 8, (const float[]){back, back, -back}, 3, 1e-6f);
    assert_floats(world + 12, (const float[]){3, 12, -4}, 3, 1e-5f);
    for (int i = 0; i < 9; i++) {
        const float *const a = world + 4 * (i / 3), *const b = world + 4 * (i % 3);
        const float product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2], one = i / 3 == i % 3;
        assert_floats(&product, &one, 1, 1e-5f);
    }
    const float right = world[5] * world[10] - world[6] * world[9];
    assert_floats(&right, world, 1, 1e-5f);
    scene_model_free(model);
}

// There are 32 groups. Of more faces around a point some share one, which are far from each other.
static void test_many_flat_faces(void **state)
{
    (void)state;
    enum { FACES = 40 };
    struct chunks chunks = {.size = 0};
    const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d),
                 object = begin(&chunks, 0x4000);
    put(&chunks, "o", 2);
    const size_t mesh = begin(&chunks, 0x4100), vertices = begin(&chunks, 0x4110);
    put_short(&chunks, FACES + 2);
    for (int i = 0; i < FACES + 2; i++) {
        put(&chunks, (const float[]){i == 0 ? 0 : 1, (float)i, (float)(i * i)}, 3 * sizeof(float));
    }
    end(&chunks, vertices);
    const size_t list = begin(&chunks, 0x4120);
    put_short(&chunks, FACES);
    for (unsigned i = 0; i < FACES; i++) {
        put(&chunks,
            (const unsigned char[]){0, 0, (unsigned char)(i + 1), 0, (unsigned char)(i + 2), 0, 7, 0}, 8);
    }
    const size_t smoothing = begin(&chunks, 0x4150);
    for (unsigned i = 0; i < FACES; i++) {
        put(&chunks, "\0\0\0", 4);
    }
    end(&chunks, smoothing);
    end(&chunks, list);
    end(&chunks, mesh);
    end(&chunks, object);
    end(&chunks, editor);
    end(&chunks, file);
    write_bytes("f.3ds", chunks.bytes, chunks.size);
    struct scene_model *const model = load("f.3ds");
    assert_int_equal(model->triangles_drawn, FACES);
    assert_true(model->meshes[0].vertex_count >= 3 * FACES - 2 * (FACES - 32));
    scene_model_free(model);
}

// End a chunk, or the file where `place` is SIZE_MAX, behind zeros if it is the one whose turn it is. Count on.
static void end_filled(struct chunks *chunks, size_t place, unsigned zeros, int *turn)
{
    static const char zero[300];
    if ((*turn)-- == 0) {
        put(chunks, zero, zeros);
    }
    if (place != SIZE_MAX) {
        end(chunks, place);
    }
}

// Zeros behind the last chunk of a file, and of every chunk that holds others, change nothing.
static void test_zeros(void **state)
{
    (void)state;
    static const float points[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const float camera_numbers[8] = {3, 4, 12, 1, 2, 10, 0, 50};
    write_bytes("a.png", "P6\n1 1\n255\n\x10\x20\x30", 14);
    enum { TURNS = 12, MOST = 14 };
    for (int i = 0; i < TURNS * MOST; i++) {
        const unsigned zeros = i % MOST == MOST - 1 ? 300 : (unsigned)i % MOST;
        int turn = i / MOST;
        struct chunks chunks = {.size = 0};
        const size_t file = begin(&chunks, 0x4d4d), editor = begin(&chunks, 0x3d3d);
        const size_t material = begin(&chunks, 0xafff);
        put_text(&chunks, 0xa000, "m");
        const size_t map = begin(&chunks, 0xa200);
        put_text(&chunks, 0xa300, "a.png");
        end_filled(&chunks, map, zeros, &turn);
        end_filled(&chunks, material, zeros, &turn);
        const size_t lamp = begin(&chunks, 0x4000);
        put(&chunks, "l", 2);
        const size_t light = begin(&chunks, 0x4600);
        put(&chunks, points[0], sizeof points[0]);
        end_filled(&chunks, light, zeros, &turn);
        end(&chunks, lamp);
        const size_t taker = begin(&chunks, 0x4000);
        put(&chunks, "c", 2);
        const size_t camera = begin(&chunks, 0x4700);
        put(&chunks, camera_numbers, sizeof camera_numbers);
        end_filled(&chunks, camera, zeros, &turn);
        end(&chunks, taker);
        const size_t object = begin(&chunks, 0x4000);
        put(&chunks, "o", 2);
        const size_t mesh = begin(&chunks, 0x4100), vertices = begin(&chunks, 0x4110);
        put_short(&chunks, 3);
        put(&chunks, points, sizeof points);
        end(&chunks, vertices);
        const size_t places = begin(&chunks, 0x4140);
        put_short(&chunks, 3);
        put(&chunks, points, 6 * sizeof(float)); // of two numbers each
        end(&chunks, places);
        const size_t faces = begin(&chunks, 0x4120);
        for (unsigned k = 0; k < 5; k++) {
            put_short(&chunks, k == 0 ? 1 : k == 4 ? 7 : k - 1);
        }
        const size_t group = begin(&chunks, 0x4130);
        put(&chunks, "m\0\1\0\0", 6);
        end(&chunks, group);
        end_filled(&chunks, faces, zeros, &turn);
        end_filled(&chunks, mesh, zeros, &turn);
        end_filled(&chunks, object, zeros, &turn);
        end_filled(&chunks, editor, zeros, &turn);
        const size_t keys = begin(&chunks, 0xb000), node = begin(&chunks, 0xb002);
        const size_t head = begin(&chunks, 0xb010);
        put(&chunks, "o\0\0\0\0\0\xff\xff", 8);
        end(&chunks, head);
        end_filled(&chunks, node, zeros, &turn);
        end_filled(&chunks, keys, zeros, &turn);
        end_filled(&chunks, file, zeros, &turn);
        end_filled(&chunks, SIZE_MAX, zeros, &turn);
        write_bytes("z.3ds", chunks.bytes, chunks.size);
        struct scene_model *const model = load("z.3ds");
        if (model->triangles_drawn != 1 || model->warning_count + model->unsupported_count > 0) {
            fail_msg("%u zeros in turn %d", zeros, i / MOST);
        }
        assert_string_equal(model->materials[model->meshes[0].material].name, "m");
        assert_true(model->light_count == 1 && model->camera_count == 1 && model->image_count == 1);
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_lost_places),     cmocka_unit_test(test_smoothing),
    cmocka_unit_test(test_many_flat_faces), cmocka_unit_test(test_told),
    cmocka_unit_test(test_wires),           cmocka_unit_test(test_decal),
    cmocka_unit_test(test_zeros),           cmocka_unit_test(test_parts_without_groups),
    cmocka_unit_test(test_camera),          cmocka_unit_test(test_no_material),
};

const struct unit_tests test_3ds = UNIT_TESTS(tests, make_directory, remove_directory);
