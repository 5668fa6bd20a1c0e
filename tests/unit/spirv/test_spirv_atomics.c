// SPDX-License-Identifier: MIT
// Storage: images of every kind and format, and atomics on images, buffers and the memory of a workgroup, give the bits of
// the functions of rhw/shader_binding.h, which do the same with a second set of things.
#include "../binding/bound_things.h"
#include "spirv_run.h"

#include "atomics_comp.h"
#include "formats_comp.h"
#include "storage_comp.h"

enum { LANES = 24, GROUPS = LANES / 8 };

static struct rhw_binding bind_image(const struct rig *rig, rhw_texture texture)
{
    struct rhw_binding binding;
    assert_int_equal(rhw_binding_of_image(rig->context, texture, 0, false, &binding), RHW_OK);
    return binding;
}

static struct rhw_binding bind_texels(void *texels, size_t size, enum rhw_format format)
{
    struct rhw_binding binding;
    assert_true(rhw_binding_of_texel_memory(RHW_ISA_BASELINE, texels, size, format, false, &binding));
    return binding;
}

static void expect_equal_textures(const struct rig *rig, rhw_texture a, rhw_texture b)
{
    static unsigned char bytes[2][1 << 14];
    for (int layer = 0; layer < rhw_texture_layers(rig->context, a) * rhw_texture_depth(rig->context, a, 0);
         layer++) {
        assert_int_equal(rhw_texture_read_layer(rig->context, a, 0, layer, bytes[0], 0), RHW_OK);
        assert_int_equal(rhw_texture_read_layer(rig->context, b, 0, layer, bytes[1], 0), RHW_OK);
        assert_memory_equal(bytes[0], bytes[1], sizeof *bytes);
    }
}

static rhw_int numbers_of(int group)
{
    return rhw_lane_numbers() + rhw_splat_int(8 * group);
}

// Lane i has number i % n.
static rhw_int remainder_of(rhw_int i, int n)
{
    for (int lane = 0; lane < 8; lane++) {
        i[lane] %= n;
    }
    return i;
}

// Atomics --------------------------------------------------------------------------------------------

enum thing { WORDS, PLANES, LINE, TEXELS, FLOATS, CUBES, THINGS };

struct words {
    uint32_t words[16];
    int32_t signed_words[8];
    float numbers[4];
};

struct things {
    struct rhw_binding set[THINGS];
    rhw_texture textures[THINGS];
    struct words words;
    uint32_t texels[7];
};

static void make_things(const struct rig *rig, struct things *things)
{
    static const struct rhw_texture_def defs[THINGS] = {
        [PLANES] = {.format = RHW_FORMAT_R32_UINT, .width = 3, .height = 3, .layers = 2},
        [LINE] = {.kind = RHW_TEXTURE_1D, .format = RHW_FORMAT_R32_SINT, .width = 4},
        [FLOATS] = {.format = RHW_FORMAT_R32_FLOAT, .width = 2, .height = 2},
        [CUBES] =
            {.kind = RHW_TEXTURE_CUBE, .format = RHW_FORMAT_R32_UINT, .width = 4, .height = 4, .layers = 2},
    };
    *things = (struct things){
        .words = {.words = {0, 1000, 0, UINT32_MAX}, .signed_words = {5, -5}, .numbers = {-1}}};
    things->set[WORDS] = spirv_memory(&things->words, sizeof things->words);
    things->set[TEXELS] = bind_texels(things->texels, sizeof things->texels, RHW_FORMAT_R32_UINT);
    for (int i = 0; i < THINGS; i++) {
        if (defs[i].width != 0) {
            things->textures[i] = make_texture(rig, &defs[i]);
            things->set[i] = bind_image(rig, things->textures[i]);
        }
    }
}

// Do one atomic of the shader for 8 invocations. Return what was there.
static rhw_int change(struct things *things, enum thing thing, enum rhw_storage_operation operation,
                      const rhw_int *index, rhw_int value, rhw_int comparand)
{
    const struct rhw_storage_request request = {
        .operation = operation, .index = index, .value = &value, .comparand = &comparand};
    const bool is_image = thing != WORDS;
    rhw_int before;
    (is_image ? rhw_binding_image_atomic : rhw_binding_storage_access)(&things->set[thing], &request,
                                                                       &before);
    return before;
}

static rhw_int change_word(struct things *things, rhw_int word, enum rhw_storage_operation operation,
                           rhw_int value, rhw_int comparand)
{
    return change(things, WORDS, operation, &word, value, comparand);
}

// The atomics of the shader up to its barrier, by number.
enum { STEPS = 19 };

static rhw_int step(struct things *things, int number, rhw_int i)
{
    const rhw_int value = 3 * i + 1, zero = 0 * i, bit = (rhw_int)((rhw_uint)(zero + 1) << (rhw_uint)i);
    const rhw_int plane[3] = {remainder_of(i, 3), i >> 3, i & 1}, five = remainder_of(i, 5),
                  seven = remainder_of(i, 7), cube[3] = {zero + 1, zero + 2, remainder_of(i, 13)},
                  corner[3] = {i & 1, zero + 1, zero};
    switch (number) {
    case 0: return change_word(things, zero, RHW_STORAGE_ADD, value, zero);
    case 1: return change_word(things, zero + 1, RHW_STORAGE_MIN_UNSIGNED, value ^ 5, zero);
    case 2: return change_word(things, zero + 2, RHW_STORAGE_MAX_UNSIGNED, value ^ 9, zero);
    case 3: return change_word(things, zero + 3, RHW_STORAGE_AND, ~bit, zero);
    case 4: return change_word(things, zero + 4, RHW_STORAGE_OR, bit, zero);
    case 5: return change_word(things, zero + 5, RHW_STORAGE_XOR, value, zero);
    case 6: return change_word(things, 6 + (i & 1), RHW_STORAGE_EXCHANGE, value, zero);
    case 7: return change_word(things, zero + 8, RHW_STORAGE_COMPARE_EXCHANGE, (i >> 2) + 1, i >> 2);
    case 8: return change_word(things, zero + 16, RHW_STORAGE_MIN, 7 - value, zero);
    case 9: return change_word(things, zero + 17, RHW_STORAGE_MAX, value - 40, zero);
    case 10: return change_word(things, 16 + (i & 7), RHW_STORAGE_ADD, -i, zero);
    case 11:
        return change_word(things, 24 + (i & 3), RHW_STORAGE_EXCHANGE,
                           rhw_bits_from_float(rhw_float_from_int(i)), zero);
    case 12: return change(things, PLANES, RHW_STORAGE_ADD, plane, value, zero);
    case 13: return change(things, PLANES, RHW_STORAGE_MAX_UNSIGNED, plane, value * 2, zero);
    case 14: return change(things, PLANES, RHW_STORAGE_COMPARE_EXCHANGE, plane, value, zero + 2);
    case 15: return change(things, LINE, RHW_STORAGE_MIN, &five, 3 - i, zero);
    case 16: return change(things, TEXELS, RHW_STORAGE_XOR, &seven, value, zero);
    case 17: return change(things, CUBES, RHW_STORAGE_OR, cube, bit, zero);
    default:
        return change(things, FLOATS, RHW_STORAGE_EXCHANGE, corner,
                      rhw_bits_from_float(rhw_float_from_int(i) + 0.5f), zero);
    }
}

static void expect_results(const uint32_t *results, int group, rhw_int expected, int number)
{
    for (int lane = 0; lane < 8; lane++) {
        if (results[8 * group + lane] != (uint32_t)expected[lane]) {
            fail_msg("result %d, lane %d: %08x for %08x", number, 8 * group + lane, results[8 * group + lane],
                     (uint32_t)expected[lane]);
        }
    }
}

static void test_atomics_take_their_turns(void **state)
{
    (void)state;
    static uint32_t results[(STEPS + 2) * LANES];
    static struct things things, own;
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(atomics_comp, RHW_SHADER_COMPUTE));
    assert_true(rhw_shader_program_get_compute(program)->uses_atomic_results);
    struct rig rig;
    rig_open(&rig, 4, 4);
    make_things(&rig, &things);
    make_things(&rig, &own);
    const struct rhw_binding memory = spirv_memory(results, sizeof results);
    assert_int_equal(
        spirv_dispatch(&rig, program, &(struct rhw_shader_frame){.sets = {things.set, &memory}}, 1), RHW_OK);
    for (int number = 0; number < STEPS; number++) {
        for (int group = 0; group < GROUPS; group++) {
            expect_results(&results[number * LANES], group, step(&own, number, numbers_of(group)), number);
        }
    }
    assert_memory_equal(&things.words, &own.words, sizeof own.words);
    assert_memory_equal(things.texels, own.texels, sizeof own.texels);
    for (int i = 0; i < THINGS; i++) {
        if (things.textures[i].index != 0) {
            expect_equal_textures(&rig, things.textures[i], own.textures[i]);
        }
    }
    assert_int_equal(results[18 * LANES + 3], 0x3fc00000); // 1.5, of lane 1
    // Together, words have their number and three values, of numbers 8 apart; each of two is lessened 12 times.
    for (int group = 0; group < GROUPS; group++) {
        const rhw_int i = numbers_of(group), word = (i + 1) & 7;
        expect_results(&results[STEPS * LANES], group, word + 3 * (3 * word + 1) + 3 * 24, STEPS);
        expect_results(&results[(STEPS + 1) * LANES], group, -3 * (i >> 1), STEPS + 1);
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

// Images ---------------------------------------------------------------------------------------------

enum image {
    STORED_LINE,
    STORED_LINES,
    PLANE,
    STORED_PLANES,
    VOLUME,
    CUBE,
    STORED_CUBES,
    BUFFER,
    TABLE,
    IMAGES = TABLE + 3
};

struct images {
    struct rhw_binding set[IMAGES];
    rhw_texture textures[IMAGES];
    uint32_t texels[9];
};

static void make_images(const struct rig *rig, struct images *images)
{
    static const struct rhw_texture_def defs[IMAGES] = {
        [STORED_LINE] = {.kind = RHW_TEXTURE_1D, .width = 5},
        [STORED_LINES] = {.kind = RHW_TEXTURE_1D, .width = 6, .layers = 3},
        [PLANE] = {.width = 6, .height = 7},
        [STORED_PLANES] = {.width = 5, .height = 6, .layers = 4},
        [VOLUME] = {.kind = RHW_TEXTURE_3D, .width = 6, .height = 4, .depth = 5},
        [CUBE] = {.kind = RHW_TEXTURE_CUBE, .width = 6, .height = 6},
        [STORED_CUBES] = {.kind = RHW_TEXTURE_CUBE, .width = 6, .height = 6, .layers = 2},
        [TABLE] = {.width = 6, .height = 3},
        [TABLE + 1] = {.width = 3, .height = 6},
        [TABLE + 2] = {.width = 6, .height = 6},
    };
    memset(images, 0, sizeof *images);
    for (int i = 0; i < IMAGES; i++) {
        if (i == BUFFER) {
            images->set[i] = bind_texels(images->texels, sizeof images->texels, RHW_FORMAT_RGBA8_UNORM);
            continue;
        }
        struct rhw_texture_def def = defs[i];
        def.format = i % 2 == 0 ? RHW_FORMAT_RGBA8_UNORM : RHW_FORMAT_RGBA16_FLOAT;
        images->textures[i] = make_texture(rig, &def);
        images->set[i] = bind_image(rig, images->textures[i]);
    }
}

// What lanes store to and load from an image, and where.
struct access {
    enum image image;
    int first[3]; // components of `at`
    bool adds;    // the first two
};

static const struct access stores[] = {
    {STORED_LINE, {0, 0, 0}, false},   {STORED_LINES, {0, 1, 0}, false}, {PLANE, {0, 1, 0}, false},
    {STORED_PLANES, {0, 1, 2}, false}, {VOLUME, {0, 1, 2}, false},       {CUBE, {0, 1, 2}, false},
    {STORED_CUBES, {0, 1, 3}, false},  {BUFFER, {0, 0, 0}, true},
};
static const struct access loads[] = {
    {STORED_LINE, {0, 0, 0}, false},   {STORED_LINES, {1, 2, 0}, false}, {PLANE, {2, 3, 0}, false},
    {STORED_PLANES, {0, 1, 2}, false}, {VOLUME, {0, 1, 2}, false},       {CUBE, {0, 1, 2}, false},
    {STORED_CUBES, {0, 1, 3}, false},  {BUFFER, {0, 0, 0}, true},
};
enum { ACCESSES = sizeof loads / sizeof *loads };

// 8 lanes of a group.
struct lanes {
    rhw_float p[4];
    rhw_int at[4];
};

static struct lanes lanes_of(const float points[LANES][4], int group)
{
    struct lanes lanes;
    for (int c = 0; c < 4; c++) {
        for (int lane = 0; lane < 8; lane++) {
            lanes.p[c][lane] = points[8 * group + lane][c];
        }
        lanes.at[c] = rhw_int_from_float(rhw_floor(lanes.p[c] * 6));
    }
    return lanes;
}

static void find_place(const struct access *access, const struct lanes *lanes, rhw_int at[3])
{
    for (int c = 0; c < 3; c++) {
        at[c] = lanes->at[access->first[c]];
    }
    at[0] += access->adds ? lanes->at[1] : rhw_splat_int(0);
}

static void expect_texels(const uint32_t (*results)[4], int group, int number, const rhw_float texel[4])
{
    for (int lane = 0; lane < 8; lane++) {
        for (int c = 0; c < 4; c++) {
            const uint32_t found = results[number * LANES + 8 * group + lane][c];
            if (found != (uint32_t)rhw_bits_from_float(texel[c])[lane]) {
                fail_msg("result %d, lane %d, component %d: %08x for %08x", number, 8 * group + lane, c,
                         found, (uint32_t)rhw_bits_from_float(texel[c])[lane]);
            }
        }
    }
}

// Lane i of the table's image (i + step) % 4, of which there are 3.
static void use_table(struct images *images, const struct lanes *lanes, int group, int step,
                      bool stores_texel, rhw_float texel[4])
{
    const rhw_int i = (numbers_of(group) + step) & 3;
    for (int lane = 0; lane < 8; lane++) {
        const rhw_int mask = rhw_equal_int(rhw_lane_numbers(), rhw_splat_int(lane));
        const struct rhw_binding *const image = i[lane] < 3 ? &images->set[TABLE + i[lane]] : NULL;
        rhw_float own[4];
        if (stores_texel) {
            rhw_binding_image_store(image, lanes->at, &mask, lanes->p);
            continue;
        }
        rhw_binding_image_load(image, lanes->at, own);
        for (int c = 0; c < 4; c++) {
            texel[c][lane] = own[c][lane];
        }
    }
}

static void test_images_are_stored_and_loaded(void **state)
{
    (void)state;
    static const int32_t sizes[5][4] = {{5, 6, 3, 9}, {6, 7, 6, 6}, {5, 6, 4, 1}, {6, 4, 5, 1}, {6, 6, 2, 1}};
    static uint32_t results[32 * LANES][4];
    static float points[LANES][4];
    static struct images images, own;
    uint64_t random = 11;
    for (int i = 0; i < LANES * 4; i++) {
        points[i / 4][i % 4] = rig_random_float(&random, -0.2f, 1.1f);
    }
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(storage_comp, RHW_SHADER_COMPUTE));
    struct rig rig;
    rig_open(&rig, 4, 4);
    make_images(&rig, &images);
    make_images(&rig, &own);
    const struct rhw_binding memory[2] = {spirv_memory(points, sizeof points),
                                          spirv_memory(results, sizeof results)};
    assert_int_equal(
        spirv_dispatch(&rig, program, &(struct rhw_shader_frame){.sets = {images.set, memory}}, 1), RHW_OK);
    for (int a = 0; a <= ACCESSES; a++) {
        for (int group = 0; group < GROUPS; group++) {
            const struct lanes lanes = lanes_of((const float(*)[4])points, group);
            rhw_int at[3];
            if (a == ACCESSES) {
                use_table(&own, &lanes, group, 0, true, NULL);
            } else {
                find_place(&stores[a], &lanes, at);
                rhw_binding_image_store(&own.set[stores[a].image], at, NULL, lanes.p);
            }
        }
    }
    for (int group = 0; group < GROUPS; group++) {
        const struct lanes lanes = lanes_of((const float(*)[4])points, group);
        rhw_float texel[4];
        for (int a = 0; a < ACCESSES; a++) {
            rhw_int at[3];
            find_place(&loads[a], &lanes, at);
            rhw_binding_image_load(&own.set[loads[a].image], at, texel);
            expect_texels((const uint32_t(*)[4])results, group, a, texel);
        }
        use_table(&own, &lanes, group, 1, false, texel);
        expect_texels((const uint32_t(*)[4])results, group, ACCESSES, texel);
    }
    for (int i = 0; i < 5; i++) {
        for (int lane = 0; lane < LANES; lane++) {
            assert_memory_equal(results[(ACCESSES + 1 + i) * LANES + lane], sizes[i], sizeof *sizes);
        }
    }
    assert_memory_equal(images.texels, own.texels, sizeof own.texels);
    for (int i = 0; i < IMAGES; i++) {
        if (i != BUFFER) {
            expect_equal_textures(&rig, images.textures[i], own.textures[i]);
        }
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static void check_format(const struct rig *rig, const rhw_shader_program *program, enum rhw_format format)
{
    static uint32_t results[2 * LANES][4];
    static const float points[LANES][4] = {
        {0, 0.3f, -0.2f, 1}, {1e-3f, 7, 0.5f, 0.25f}, {-3, 2, 1, 0}, {70000, 1e30f, -1e-30f, 0.999f}};
    const struct rhw_texture_def def = {.format = format, .width = 5, .height = 4};
    rhw_texture textures[2][2];
    struct rhw_binding sets[2][2];
    for (int i = 0; i < 4; i++) {
        textures[i / 2][i % 2] = make_texture(rig, &def);
        sets[i / 2][i % 2] = bind_image(rig, textures[i / 2][i % 2]);
    }
    const struct rhw_binding memory[2] = {spirv_memory((void *)points, sizeof points),
                                          spirv_memory(results, sizeof results)};
    assert_int_equal(spirv_dispatch(rig, program, &(struct rhw_shader_frame){.sets = {sets[0], memory}}, 1),
                     RHW_OK);
    for (int number = 0; number < 2; number++) {
        for (int group = 0; group < GROUPS; group++) {
            const struct lanes lanes = lanes_of(points, group);
            rhw_int at[2] = {remainder_of(numbers_of(group), 5), numbers_of(group)};
            rhw_float texel[4];
            for (int lane = 0; lane < 8; lane++) {
                at[1][lane] /= 5;
            }
            rhw_binding_image_store(&sets[1][number], at, NULL, lanes.p);
            rhw_binding_image_load(&sets[1][number], at, texel);
            expect_texels((const uint32_t(*)[4])results, group, number, texel);
        }
        expect_equal_textures(rig, textures[0][number], textures[1][number]);
    }
    for (int i = 0; i < 4; i++) {
        rhw_texture_destroy(rig->context, textures[i / 2][i % 2]);
    }
}

static void test_images_of_all_formats_need_none(void **state)
{
    (void)state;
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(formats_comp, RHW_SHADER_COMPUTE));
    struct rig rig;
    int count = 0;
    rig_open(&rig, 4, 4);
    for (int format = 0; format < RHW_FORMAT_COUNT; format++) {
        if (rhw_format_features((enum rhw_format)format) & RHW_FEATURE_STORAGE_IMAGE) {
            check_format(&rig, program, (enum rhw_format)format);
            count++;
        }
    }
    assert_true(count > 20);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_atomics_take_their_turns),
    cmocka_unit_test(test_images_are_stored_and_loaded),
    cmocka_unit_test(test_images_of_all_formats_need_none),
};

const struct unit_tests test_spirv_atomics = UNIT_TESTS(tests, NULL, NULL);
