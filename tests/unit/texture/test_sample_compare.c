// SPDX-License-Identifier: MIT
// Samplers that compare. A comparison comes before the filter, so a sample is that of a texture whose texels are the
// outcomes, 0 and 1, by a sampler that does not compare: the model of texture_model.h draws it.
#include "isa_support.h"
#include "texture_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "binding/binding.h"
#include "context/context.h"
#include "context/lookup.h"

enum { WIDTH = 16, HEIGHT = 8, LEVELS = 4 };

// By the words of the specification, not by the library's.
static bool holds(enum rhw_compare compare, float reference, float texel)
{
    switch (compare) {
    case RHW_COMPARE_LESS: return reference < texel;
    case RHW_COMPARE_NEVER: return false;
    case RHW_COMPARE_EQUAL: return reference == texel;
    case RHW_COMPARE_LESS_EQUAL: return reference <= texel;
    case RHW_COMPARE_GREATER: return reference > texel;
    case RHW_COMPARE_NOT_EQUAL: return reference != texel;
    case RHW_COMPARE_GREATER_EQUAL: return reference >= texel;
    default: return true;
    }
}

// A texture of the same size in floats: what comparing `texture` gives.
static rhw_texture make_outcome(rhw_context *context, rhw_texture texture, enum rhw_compare compare,
                                float reference)
{
    const enum rhw_format format = rhw_texture_format(context, texture);
    const size_t size = rhw_format_size(format);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_R32_FLOAT, .width = WIDTH, .height = HEIGHT, .mip_levels = LEVELS};
    rhw_texture outcome;
    assert_int_equal(rhw_texture_create(context, &def, &outcome), RHW_OK);
    for (int level = 0; level < LEVELS; level++) {
        const int count = (WIDTH >> level) * (HEIGHT >> level);
        unsigned char texels[WIDTH * HEIGHT * 16];
        float bits[WIDTH * HEIGHT];
        assert_int_equal(rhw_texture_read(context, texture, level, texels, 0), RHW_OK);
        for (int i = 0; i < count; i++) {
            double value[4];
            model_decode(format, texels + (size_t)i * size, value);
            bits[i] = holds(compare, reference, (float)value[0]) ? 1 : 0;
        }
        assert_int_equal(rhw_texture_write(context, outcome, level, bits, 0), RHW_OK);
    }
    return outcome;
}

static rhw_float sample_with(const struct rhw_kernels *kernels, enum rhw_paths paths,
                             const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler,
                             const rhw_float uv[2], float reference, float lod)
{
    struct rhw_bindings bindings;
    rhw_bindings_init(&bindings, kernels);
    bindings.slot[3] = rhw_binding_of(kernels, paths, texture, sampler);
    return rhw_sample_compare_lod(&bindings, 3, uv, rhw_splat(reference), rhw_splat(lod));
}

// One texture, one sampler: every instruction set and path gives the same bits, which the model agrees with.
static void compare_with_model(rhw_context *context, rhw_texture texture, struct rhw_sampler_def def,
                               float reference, uint64_t *random)
{
    const bool normalized = rhw_texture_format(context, texture) < RHW_FORMAT_RGBA16_FLOAT;
    const float held = normalized ? fminf(fmaxf(reference, 0), 1) : reference;
    const rhw_texture outcome = make_outcome(context, texture, def.compare, held);
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(context, &def, &sampler), RHW_OK);
    const struct rhw_texture_data *const data = rhw_context_texture(context, texture, "test");
    const struct rhw_texture_data *const outcome_data = rhw_context_texture(context, outcome, "test");
    const struct rhw_sampler_data *const sampler_data = rhw_context_sampler(context, sampler, "test");
    struct rhw_sampler_def plain = def;
    plain.lod_max = 1000;
    plain.border[0] = holds(def.compare, held, def.border[0]) ? 1 : 0;
    for (int n = 0; n < 20; n++) {
        rhw_float uv[2];
        for (int lane = 0; lane < RHW_LANES; lane++) { // clear of texel edges, where a rounding would decide
            uv[0][lane] = ((float)rig_random_int(random, 4096 * 3) + 0.375f) / 4096.0f - 1.0f;
            uv[1][lane] = ((float)rig_random_int(random, 4096 * 3) + 0.375f) / 4096.0f - 1.0f;
        }
        const float lod = ((float)rig_random_int(random, 64) + 0.25f) / 16.0f - 0.5f;
        const rhw_float result = sample_with(rhw_kernels_for(RHW_ISA_BASELINE), RHW_PATHS_ALL, data,
                                             sampler_data, uv, reference, lod);
        for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
            for (int paths = 0; paths <= RHW_PATHS_GENERAL && isa_is_there((enum rhw_isa)isa); paths++) {
                const rhw_float other = sample_with(rhw_kernels_for((enum rhw_isa)isa), (enum rhw_paths)paths,
                                                    data, sampler_data, uv, reference, lod);
                assert_memory_equal(&other, &result, sizeof result);
            }
        }
        for (int lane = 0; lane < RHW_LANES; lane++) {
            double expected[4];
            model_sample(outcome_data, &plain, (double)uv[0][lane], (double)uv[1][lane], (double)lod,
                         expected);
            assert_true(fabs((double)result[lane] - expected[0]) <= 4e-5);
        }
    }
    rhw_sampler_destroy(context, sampler);
    rhw_texture_destroy(context, outcome);
}

static void test_comparisons_come_before_the_filter(void **state)
{
    (void)state;
    const enum rhw_format formats[] = {RHW_FORMAT_D32_FLOAT, RHW_FORMAT_R32_FLOAT, RHW_FORMAT_R8_UNORM,
                                       RHW_FORMAT_RGBA8_UNORM};
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 16;
    for (int n = 0; n < 160; n++) {
        const enum rhw_format format = formats[n % 4];
        const rhw_texture texture = model_random_texture(rig.context, format, WIDTH, HEIGHT, LEVELS, &random);
        struct rhw_sampler_def def = {.compares = true, .compare = (enum rhw_compare)(n / 4 % 8)};
        def.min_filter = (enum rhw_filter)rig_random_int(&random, 2);
        def.mag_filter = (enum rhw_filter)rig_random_int(&random, 2);
        def.mip_filter = (enum rhw_mip_filter)rig_random_int(&random, 3);
        def.address_u = (enum rhw_address)rig_random_int(&random, 4);
        def.address_v = (enum rhw_address)rig_random_int(&random, 4);
        def.border[0] = rig_random_float(&random, -1, 1);
        // Sometimes the very number of a texel, sometimes beyond what the format holds.
        const float reference =
            n % 3 == 0 ? (float)rig_random_int(&random, 256) / 255.0f : rig_random_float(&random, -2, 2);
        compare_with_model(rig.context, texture, def, reference, &random);
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// Coordinates near each other, inside or at an edge; sometimes far outside, or no numbers at all.
static rhw_float wild_coordinates(uint64_t *random)
{
    static const float wild[] = {0, 1, -1e-8f, 0.99999994f, -7.25f, 1e9f, INFINITY, -INFINITY, NAN};
    const float middle = rig_random_float(random, 0, 1);
    rhw_float at;
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const int kind = rig_random_int(random, 400);
        at[lane] = kind < 9 ? wild[kind] : middle + rig_random_float(random, -0.06f, 0.06f);
    }
    return at;
}

// The path of shadow maps against the general one, bit for bit, in maps so small that edges are everywhere.
static void compare_paths(rhw_context *context, int width, int height, const struct rhw_sampler_def *def,
                          uint64_t *random)
{
    const struct rhw_texture_def texture_def = {
        .format = RHW_FORMAT_D32_FLOAT, .width = width, .height = height};
    rhw_texture texture;
    rhw_sampler sampler;
    float texels[32];
    assert_int_equal(rhw_texture_create(context, &texture_def, &texture), RHW_OK);
    for (int i = 0; i < width * height; i++) {
        texels[i] = rig_random_float(random, 0, 1);
    }
    assert_int_equal(rhw_texture_write(context, texture, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_sampler_create(context, def, &sampler), RHW_OK);
    const struct rhw_texture_data *const data = rhw_context_texture(context, texture, "test");
    const struct rhw_sampler_data *const sampler_data = rhw_context_sampler(context, sampler, "test");
    for (int n = 0; n < 100; n++) {
        const rhw_float uv[2] = {wild_coordinates(random), wild_coordinates(random)};
        const float reference = n % 2 ? texels[0] : rig_random_float(random, 0, 1);
        const rhw_float result = sample_with(rhw_kernels_for(RHW_ISA_BASELINE), RHW_PATHS_GENERAL, data,
                                             sampler_data, uv, reference, 0);
        for (int isa = 0; isa < RHW_ISA_COUNT && isa_is_there((enum rhw_isa)isa); isa++) {
            const rhw_float special = sample_with(rhw_kernels_for((enum rhw_isa)isa), RHW_PATHS_ALL, data,
                                                  sampler_data, uv, reference, 0);
            assert_memory_equal(&special, &result, sizeof result);
        }
    }
    rhw_sampler_destroy(context, sampler);
    rhw_texture_destroy(context, texture);
}

static void test_shadow_maps_give_the_bytes_of_the_general_path(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 17;
    for (int n = 0; n < 8 * 9; n++) {
        const struct rhw_sampler_def def = {.compares = true,
                                            .compare = (enum rhw_compare)(n % 8),
                                            .address_u = (enum rhw_address)(n / 8 % 3),
                                            .address_v = (enum rhw_address)(n / 24)};
        compare_paths(rig.context, 1, 1, &def, &random);
        compare_paths(rig.context, 2, 3, &def, &random);
        compare_paths(rig.context, 8, 4, &def, &random);
    }
    rig_close(&rig);
}

// One window of a binding in slot 3, against its footprints one by one with the offsets that it stands for, of lanes and of
// one at a time.
static void compare_window(const struct rhw_bindings *bindings, const struct rhw_sample_request *request,
                           int columns, int rows)
{
    enum { MOST = 8 };
    rhw_float parts[MOST * MOST];
    float parts1[MOST * MOST];
    const float uv1[2] = {request->coordinates[0][0], request->coordinates[1][0]},
                reference1 = (*request->reference)[0], bias1 = request->bias ? (*request->bias)[0] : 0;
    const int32_t offset1[2] = {request->offset ? request->offset[0][0] : 0,
                                request->offset ? request->offset[1][0] : 0};
    const struct rhw_sample_request1 request1 = {.coordinates = uv1,
                                                 .reference = &reference1,
                                                 .offset = request->offset ? offset1 : NULL,
                                                 .bias = request->bias ? &bias1 : NULL};
    rhw_sample_compare_window(bindings, 3, request, columns, rows, parts);
    rhw_sample_compare_window1(bindings, 3, &request1, columns, rows, parts1);
    for (int i = 0; i < columns * rows; i++) {
        struct rhw_sample_request one = *request;
        rhw_int offset[2] = {rhw_splat_int(i % columns), rhw_splat_int(i / columns)};
        for (int axis = 0; request->offset && axis < 2; axis++) {
            offset[axis] = offset[axis] + request->offset[axis];
        }
        one.offset = offset;
        rhw_float texel[4];
        rhw_sample(bindings, 3, &one, texel);
        assert_memory_equal(&parts[i], &texel[0], sizeof texel[0]);
        assert_memory_equal(&parts1[i], &texel[0], sizeof parts1[i]); // of the first lane
    }
}

// Windows in maps that have room for them, and in others.
static void compare_windows(rhw_context *context, const struct rhw_texture_def *map,
                            const struct rhw_sampler_def *def, uint64_t *random)
{
    const rhw_texture texture =
        model_random_texture(context, map->format, map->width, map->height, map->mip_levels, random);
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(context, def, &sampler), RHW_OK);
    for (int n = 0; n < 60; n++) {
        const rhw_float uv[2] = {wild_coordinates(random), wild_coordinates(random)},
                        reference = rhw_splat(rig_random_float(random, 0, 1)), bias = rhw_splat(0.5f);
        rhw_int offset[2];
        for (int lane = 0; lane < RHW_LANES; lane++) {
            offset[0][lane] = rig_random_int(random, 100) == 0 ? 40000 : rig_random_int(random, 7) - 3;
            offset[1][lane] = rig_random_int(random, 100) == 0 ? -33000 : rig_random_int(random, 3) - 1;
        }
        const struct rhw_sample_request request = {.coordinates = uv,
                                                   .reference = &reference,
                                                   .offset = n % 3 ? offset : NULL,
                                                   .bias = n % 16 ? NULL : &bias};
        const int columns = 1 + rig_random_int(random, 5), rows = 1 + rig_random_int(random, 5);
        for (int isa = 0; isa < RHW_ISA_COUNT && isa_is_there((enum rhw_isa)isa); isa++) {
            struct rhw_bindings bindings;
            rhw_bindings_init(&bindings, rhw_kernels_for((enum rhw_isa)isa));
            bindings.slot[3] =
                rhw_binding_of(bindings.kernels, RHW_PATHS_ALL, rhw_context_texture(context, texture, "test"),
                               rhw_context_sampler(context, sampler, "test"));
            compare_window(&bindings, &request, columns, rows);
        }
    }
    rhw_sampler_destroy(context, sampler);
    rhw_texture_destroy(context, texture);
}

static void test_windows_are_their_footprints(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 18;
    const struct rhw_texture_def maps[] = {
        {.format = RHW_FORMAT_D32_FLOAT, .width = 64, .height = 48, .mip_levels = 1},
        {.format = RHW_FORMAT_D32_FLOAT, .width = 5, .height = 7, .mip_levels = 1},
        {.format = RHW_FORMAT_D32_FLOAT, .width = 16, .height = 16, .mip_levels = 3},
        {.format = RHW_FORMAT_R8_UNORM, .width = 32, .height = 32, .mip_levels = 1}};
    for (int n = 0; n < 4 * 8 * 4; n++) {
        const struct rhw_sampler_def def = {.compares = true,
                                            .compare = (enum rhw_compare)(n / 4 % 8),
                                            .max_anisotropy = n % 11 == 0 ? 4 : 0,
                                            .address_u = (enum rhw_address)(n / 32),
                                            .address_v = (enum rhw_address)(n % 3)};
        compare_windows(rig.context, &maps[n % 4], &def, &random);
    }
    // A slot without a texture lets no light through.
    struct rhw_bindings none;
    rhw_bindings_init(&none, rhw_kernels_for(RHW_ISA_BASELINE));
    const rhw_float uv[2] = {rhw_splat(0.5f), rhw_splat(0.5f)}, one = rhw_splat(1), zero = rhw_splat(0);
    const struct rhw_sample_request request = {.coordinates = uv, .reference = &zero};
    for (int slot = -1; slot <= RHW_MAX_TEXTURES; slot++) {
        rhw_float parts[2] = {one, one};
        rhw_sample_compare_window(&none, slot, &request, 1, 2, parts);
        assert_memory_equal(&parts[0], &zero, sizeof zero);
        assert_memory_equal(&parts[1], &zero, sizeof zero);
    }
    rig_close(&rig);
}

// Four texels by hand: 0.25 and 0.75 above 0.5 and 1, looked at from the middle of all four.
static void test_a_footprint_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {.format = RHW_FORMAT_D32_FLOAT, .width = 2, .height = 2};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    const float texels[4] = {0.25f, 0.75f, 0.5f, 1};
    assert_int_equal(rhw_texture_write(rig.context, texture, 0, texels, 0), RHW_OK);
    const struct rhw_sampler_def sampler_def = {
        .compares = true, .address_u = RHW_ADDRESS_CLAMP, .address_v = RHW_ADDRESS_CLAMP};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &sampler), RHW_OK);
    const struct rhw_kernels *const kernels = rhw_kernels_for(RHW_ISA_BASELINE);
    struct rhw_bindings bindings;
    rhw_bindings_init(&bindings, kernels);
    bindings.slot[0] =
        rhw_binding_of(kernels, RHW_PATHS_ALL, rhw_context_texture(rig.context, texture, "test"),
                       rhw_context_sampler(rig.context, sampler, "test"));
    const float middle[2] = {0.5f, 0.5f}, right[2] = {0.75f, 0.5f}, flat[4] = {0};
    assert_true(rhw_sample_compare_lod1(&bindings, 0, middle, 0.1f, 0) == 1);
    assert_true(rhw_sample_compare_lod1(&bindings, 0, middle, 0.3f, 0) == 0.75f);
    assert_true(rhw_sample_compare_lod1(&bindings, 0, middle, 0.5f, 0) == 0.5f); // LESS: equal is no less
    assert_true(rhw_sample_compare_grad1(&bindings, 0, right, 0.8f, flat) == 0.5f);
    assert_true(rhw_sample_compare_lod1(&bindings, 0, middle, 1, 0) == 0);
    assert_true(rhw_sample_compare_lod1(&bindings, 9, middle, 0.1f, 0) == 0); // nothing is bound there
    float texel[4];
    rhw_sample_lod1(&bindings, 0, middle, 0, texel); // without a reference it is 0
    assert_true(texel[0] == 1 && texel[1] == 0 && texel[2] == 0 && texel[3] == 1);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    rhw_sampler sampler;
    const struct rhw_sampler_def beyond = {.compares = true, .compare = (enum rhw_compare)8};
    assert_int_equal(rhw_sampler_create(rig.context, &beyond, &sampler), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "compare is 8; it must be 0..7 (enum rhw_compare)");
    const struct rhw_sampler_def unused = {.compare = RHW_COMPARE_GREATER};
    assert_int_equal(rhw_sampler_create(rig.context, &unused, &sampler), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "compare is 4 and compares is false");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_comparisons_come_before_the_filter),
    cmocka_unit_test(test_shadow_maps_give_the_bytes_of_the_general_path),
    cmocka_unit_test(test_windows_are_their_footprints),
    cmocka_unit_test(test_a_footprint_by_hand),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_sample_compare = UNIT_TESTS(tests, NULL, NULL);
