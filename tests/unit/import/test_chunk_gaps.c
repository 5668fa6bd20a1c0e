// SPDX-License-Identifier: MIT
// What LightWave and Blitz3D say of surfaces and is not drawn is told. The files are made here chunk by chunk.
#include "model_files.h"

#include <string.h>

struct chunks {
    unsigned char bytes[1024];
    size_t size;
};

static void put(struct chunks *chunks, const void *bytes, size_t size)
{
    assert_true(chunks->size + size <= sizeof chunks->bytes);
    memcpy(chunks->bytes + chunks->size, bytes, size);
    chunks->size += size;
}

static void put_floats(struct chunks *chunks, bool is_big, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        unsigned char bytes[4], turned[4];
        memcpy(bytes, &values[i], sizeof bytes);
        for (int k = 0; k < 4; k++) {
            turned[k] = bytes[3 - k];
        }
        put(chunks, is_big ? turned : bytes, sizeof bytes);
    }
}

// LightWave: lengths of 4 bytes, or of 2 within other chunks, the first byte being the greatest.

static size_t begin(struct chunks *chunks, const char *name, size_t width)
{
    put(chunks, name, 4);
    put(chunks, "\0\0\0", width);
    return chunks->size;
}

static void end(struct chunks *chunks, size_t place)
{
    const size_t size = chunks->size - place;
    chunks->bytes[place - 2] = (unsigned char)(size >> 8);
    chunks->bytes[place - 1] = (unsigned char)size;
    put(chunks, "", size % 2);
}

static void put_chunk(struct chunks *chunks, const char *name, const void *bytes, size_t size)
{
    const size_t place = begin(chunks, name, 2);
    put(chunks, bytes, size);
    end(chunks, place);
}

struct lwo {
    bool has_texture, is_negated, has_negated_image, is_second, is_additive, has_patches;
    unsigned char operation, projection;
    float brightness;
};

static void put_texture(struct chunks *chunks, const struct lwo *lwo)
{
    const size_t block = begin(chunks, "BLOK", 2), map = begin(chunks, "IMAP", 2);
    put(chunks, "\x80", 2);
    put_chunk(chunks, "CHAN", "COLR", 4);
    const size_t opacity = begin(chunks, "OPAC", 2);
    put(chunks, (const unsigned char[]){0, lwo->operation}, 2);
    put_floats(chunks, true, (const float[]){1}, 1);
    put(chunks, "\0", 2);
    end(chunks, opacity);
    put_chunk(chunks, "NEGA", (const unsigned char[]){0, lwo->is_negated}, 2);
    end(chunks, map);
    put_chunk(chunks, "PROJ", (const unsigned char[]){0, lwo->projection}, 2);
    put_chunk(chunks, "IMAG", "\0\1", 2);
    end(chunks, block);
}

static void put_surface(struct chunks *chunks, const struct lwo *lwo)
{
    const size_t surface = begin(chunks, "SURF", 4);
    put(chunks, "s\0\0", 4); // its name, and none of another that it is made of
    if (lwo->is_additive) {
        const size_t transparency = begin(chunks, "ADTR", 2);
        put_floats(chunks, true, (const float[]){0.5f}, 1);
        put(chunks, "\0", 2);
        end(chunks, transparency);
    }
    for (int i = 0; i < lwo->has_texture + lwo->is_second; i++) {
        put_texture(chunks, lwo);
    }
    end(chunks, surface);
}

static struct scene_model *load_lwo(const struct lwo *lwo)
{
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, pivot[3];
    struct chunks chunks = {.size = 0};
    const size_t file = begin(&chunks, "FORM", 4);
    put(&chunks, "LWO2", 4);
    const size_t tags = begin(&chunks, "TAGS", 4);
    put(&chunks, "s", 2);
    end(&chunks, tags);
    const size_t layer = begin(&chunks, "LAYR", 4);
    put(&chunks, "\0\0\0", 4);
    put_floats(&chunks, true, pivot, 3);
    put(&chunks, "l", 2);
    end(&chunks, layer);
    const size_t points = begin(&chunks, "PNTS", 4);
    put_floats(&chunks, true, positions, 9);
    end(&chunks, points);
    const size_t polygons = begin(&chunks, "POLS", 4);
    put(&chunks, lwo->has_patches ? "PTCH" : "FACE", 4);
    put(&chunks, (const unsigned char[]){0, 3, 0, 0, 0, 1, 0, 2}, 8);
    end(&chunks, polygons);
    const size_t parts = begin(&chunks, "PTAG", 4);
    put(&chunks, "SURF\0\0\0", 8);
    end(&chunks, parts);
    const size_t clip = begin(&chunks, "CLIP", 4);
    put(&chunks, "\0\0\0\1", 4);
    put_chunk(&chunks, "STIL", "a.png", 6);
    put_chunk(&chunks, "NEGA", (const unsigned char[]){0, lwo->has_negated_image}, 2);
    const size_t bright = begin(&chunks, "BRIT", 2);
    put_floats(&chunks, true, &lwo->brightness, 1);
    put(&chunks, "\0", 2);
    end(&chunks, bright);
    end(&chunks, clip);
    put_surface(&chunks, lwo);
    end(&chunks, file);
    write_bytes("a.png", "P6\n1 1\n255\n\x10\x20\x30", 14);
    write_bytes("x.lwo", chunks.bytes, chunks.size);
    return load("x.lwo");
}

static void test_lightwave(void **state)
{
    (void)state;
    static const struct {
        struct lwo lwo;
        const char *told;
    } cases[] = {
        {{.has_texture = false}, NULL},
        {{.has_texture = true}, NULL}, // assimp makes coordinates of a plane
        {{.has_texture = true, .is_negated = true}, "inverted textures: drawn as they are"},
        {{.has_texture = true, .has_negated_image = true}, "inverted textures: drawn as they are"},
        {{.has_texture = true, .brightness = 0.5f}, "images of changed colours (LightWave): drawn as they"},
        {{.has_texture = true, .operation = 1}, "textures that are added or subtracted: multiplied"},
        {{.has_texture = true, .is_second = true}, "textures above each other: the first alone is used"},
        {{.is_additive = true}, "additive blending: drawn as ordinary blending"},
        {{.has_patches = true}, "subdivision surfaces: drawn as their cages"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene_model *const model = load_lwo(&cases[i].lwo);
        assert_int_equal(model->triangles_drawn, 1);
        if (model->unsupported_count != (cases[i].told != NULL) ||
            (cases[i].told != NULL && !is_unsupported(model, cases[i].told))) {
            fail_msg("%zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
    // A projection that assimp does not know, which its log says as well.
    struct scene_model *const model = load_lwo(&(const struct lwo){.has_texture = true, .projection = 4});
    assert_true(is_unsupported(model, "textures without coordinates: not mapped as they are meant"));
    assert_true(is_unsupported(model, "Unsupported texture mapping: FrontProjection"));
    scene_model_free(model);
}

// Blitz3D: lengths of 4 bytes, the first byte being the least.

static size_t begin_little(struct chunks *chunks, const char *name)
{
    put(chunks, name, 4);
    put(chunks, "\0\0\0", 4);
    return chunks->size;
}

static void end_little(struct chunks *chunks, size_t place)
{
    const size_t size = chunks->size - place;
    chunks->bytes[place - 4] = (unsigned char)size;
    chunks->bytes[place - 3] = (unsigned char)(size >> 8);
}

static void put_numbers(struct chunks *chunks, const uint32_t *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint32_t n = numbers[i];
        put(chunks,
            (const unsigned char[]){(unsigned char)n, (unsigned char)(n >> 8), (unsigned char)(n >> 16),
                                    (unsigned char)(n >> 24)},
            4);
    }
}

struct b3d {
    uint32_t texture_flags, texture_blend, blend, effects, textures;
    float turn;
};

static struct scene_model *load_b3d(const struct b3d *b3d)
{
    static const float place[] = {0, 0, 0, 1, 1, 1, 1, 0, 0, 0}, positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0},
                       color[] = {1, 1, 1, 1, 0};
    const float of_texture[] = {0, 0, 1, 1, b3d->turn};
    struct chunks chunks = {.size = 0};
    const size_t file = begin_little(&chunks, "BB3D");
    put_numbers(&chunks, (const uint32_t[]){1}, 1);
    const size_t textures = begin_little(&chunks, "TEXS");
    put(&chunks, "a.png", 6);
    put_numbers(&chunks, (const uint32_t[]){b3d->texture_flags, b3d->texture_blend}, 2);
    put_floats(&chunks, false, of_texture, 5);
    end_little(&chunks, textures);
    const size_t materials = begin_little(&chunks, "BRUS");
    put_numbers(&chunks, &b3d->textures, 1);
    put(&chunks, "m", 2);
    put_floats(&chunks, false, color, 5);
    put_numbers(&chunks, (const uint32_t[]){b3d->blend, b3d->effects, 0, 0}, 2 + (size_t)b3d->textures);
    end_little(&chunks, materials);
    const size_t node = begin_little(&chunks, "NODE");
    put(&chunks, "n", 2);
    put_floats(&chunks, false, place, 10);
    const size_t mesh = begin_little(&chunks, "MESH");
    put_numbers(&chunks, (const uint32_t[]){0}, 1);
    const size_t vertices = begin_little(&chunks, "VRTS");
    put_numbers(&chunks, (const uint32_t[]){0, 0, 0}, 3);
    put_floats(&chunks, false, positions, 9);
    end_little(&chunks, vertices);
    const size_t triangles = begin_little(&chunks, "TRIS");
    put_numbers(&chunks, (const uint32_t[]){0, 0, 1, 2}, 4);
    end_little(&chunks, triangles);
    end_little(&chunks, mesh);
    end_little(&chunks, node);
    end_little(&chunks, file);
    write_bytes("x.b3d", chunks.bytes, chunks.size);
    return load("x.b3d");
}

static void test_blitz(void **state)
{
    (void)state;
    static const struct {
        struct b3d b3d;
        const char *told;
    } cases[] = {
        {{1, 2, 1, 0, 1, 0}, NULL},
        {{0x31, 2, 1, 0, 1, 0}, "textures that are not repeated (B3D): repeated"},
        {{0x41, 2, 1, 0, 1, 0}, "textures of what is around (B3D): drawn by the coordinates"},
        {{0x10001, 2, 1, 0, 1, 0}, "texture coordinate set 1 (B3D): set 0 is read instead"},
        {{1, 3, 1, 0, 1, 0}, "textures that are added or subtracted: multiplied"},
        {{1, 2, 1, 0, 1, 1}, "textures that are moved, scaled or turned (B3D): drawn as they are"},
        {{1, 2, 2, 0, 1, 0}, "multiplied blending: drawn as ordinary blending"},
        {{1, 2, 3, 0, 1, 0}, "additive blending: drawn as ordinary blending"},
        {{1, 2, 1, 1, 1, 0}, "surfaces that are not lit (B3D): lit"},
        {{1, 2, 1, 0, 2, 0}, "textures above each other: the first alone is used"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene_model *const model = load_b3d(&cases[i].b3d);
        if (model->unsupported_count != (cases[i].told != NULL) ||
            (cases[i].told != NULL && !is_unsupported(model, cases[i].told))) {
            fail_msg("%zu: %u lines", i, model->unsupported_count);
        }
        scene_model_free(model);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_lightwave),
    cmocka_unit_test(test_blitz),
};

const struct unit_tests test_chunk_gaps = UNIT_TESTS(tests, make_directory, remove_directory);
