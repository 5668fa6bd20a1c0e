// SPDX-License-Identifier: MIT
// Samples of textures of every kind: each instruction set and both forms of shader functions give the same bits, which
// the model agrees with (kind_model.h).
#include "isa_support.h"
#include "kind_model.h"

#include <math.h>
#include <string.h>

#include "binding/binding.h"
#include "context/context.h"
#include "context/lookup.h"
#include "resource/sampler.h"

enum { SLOT = 5, KINDS = 7 };

static const struct rhw_texture_def kinds[KINDS] = {
    {.width = 13, .kind = RHW_TEXTURE_1D},
    {.width = 16, .kind = RHW_TEXTURE_1D, .layers = 3},
    {.width = 9, .height = 14},
    {.width = 12, .height = 7, .layers = 4},
    {.width = 10, .height = 6, .depth = 7, .kind = RHW_TEXTURE_3D},
    {.width = 8, .height = 8, .kind = RHW_TEXTURE_CUBE},
    {.width = 5, .height = 5, .kind = RHW_TEXTURE_CUBE, .layers = 2},
};

static int components_of(const struct rhw_texture_def *def)
{
    return (def->kind == RHW_TEXTURE_1D ? 1 : def->kind == RHW_TEXTURE_2D ? 2 : 3) + (def->layers > 0);
}

static void bind(struct rhw_bindings *bindings, enum rhw_isa isa, const struct rig *rig, rhw_texture texture,
                 const struct rhw_sampler_data *sampler)
{
    const struct rhw_kernels *const kernels = rhw_kernels_for(isa);
    rhw_bindings_init(bindings, kernels);
    bindings->slot[SLOT] =
        rhw_binding_of(kernels, RHW_PATHS_ALL, rhw_context_texture(rig->context, texture, "test"), sampler);
}

// A request for 8 lanes, and what holds it.
struct lanes {
    rhw_float coordinates[4], lod;
    rhw_int offset[3];
};

static struct rhw_sample_request request_of(const struct lanes *lanes, bool shifts)
{
    return (struct rhw_sample_request){
        .coordinates = lanes->coordinates, .lod = &lanes->lod, .offset = shifts ? lanes->offset : NULL};
}

static void random_lanes(uint64_t *random, const struct rhw_texture_def *def, struct lanes *lanes)
{
    const int components = components_of(def);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        for (int i = 0; i < 4; i++) { // clear of texel edges, where a rounding would decide
            lanes->coordinates[i][lane] = ((float)rig_random_int(random, 4096 * 3) + 0.375f) / 4096.0f - 1.0f;
        }
        for (int i = 0; i < 3; i++) {
            lanes->offset[i][lane] = rig_random_int(random, 24) - 12;
        }
        if (def->layers > 0) {
            lanes->coordinates[components - 1][lane] = (float)rig_random_int(random, 14) / 2.0f - 1.0f;
        }
        lanes->lod[lane] = ((float)rig_random_int(random, 80) + 0.25f) / 16.0f - 0.5f;
    }
}

static struct rhw_sampler_def random_sampler(uint64_t *random)
{
    struct rhw_sampler_def def = {.lod_bias = (float)rig_random_int(random, 3) / 8.0f};
    def.min_filter = (enum rhw_filter)rig_random_int(random, 2);
    def.mag_filter = (enum rhw_filter)rig_random_int(random, 2);
    def.mip_filter = (enum rhw_mip_filter)rig_random_int(random, 3);
    def.address_u = (enum rhw_address)rig_random_int(random, 5);
    def.address_v = (enum rhw_address)rig_random_int(random, 5);
    def.address_w = (enum rhw_address)rig_random_int(random, 5);
    for (int c = 0; c < 4; c++) {
        def.border[c] = rig_random_float(random, -1, 1);
    }
    return def;
}

// The same bits of every instruction set and of the form for one at a time.
static void expect_same_everywhere(const struct rig *rig, rhw_texture texture,
                                   const struct rhw_sampler_data *sampler, const struct lanes *lanes,
                                   bool shifts, const rhw_float expected[4])
{
    const struct rhw_sample_request request = request_of(lanes, shifts);
    struct rhw_bindings bindings;
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (isa_is_there((enum rhw_isa)isa)) {
            rhw_float texel[4];
            bind(&bindings, (enum rhw_isa)isa, rig, texture, sampler);
            rhw_sample(&bindings, SLOT, &request, texel);
            assert_memory_equal(texel, expected, sizeof texel);
        }
    }
    bind(&bindings, RHW_ISA_BASELINE, rig, texture, sampler);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        float at[4], texel[4];
        int32_t offset[3];
        for (int i = 0; i < 4; i++) {
            at[i] = lanes->coordinates[i][lane];
        }
        for (int i = 0; i < 3; i++) {
            offset[i] = lanes->offset[i][lane];
        }
        const float lod = lanes->lod[lane];
        const struct rhw_sample_request1 one = {
            .coordinates = at, .lod = &lod, .offset = shifts ? offset : NULL};
        rhw_sample1(&bindings, SLOT, &one, texel);
        for (int c = 0; c < 4; c++) {
            assert_true(texel[c] == expected[c][lane]);
        }
    }
}

static void expect_model(const struct rhw_texture_data *texture, const struct rhw_sampler_def *def,
                         const struct lanes *lanes, bool shifts, const rhw_float texel[4])
{
    for (int lane = 0; lane < RHW_LANES; lane++) {
        struct kind_request request = {.lod = (double)lanes->lod[lane]};
        double expected[4];
        for (int i = 0; i < 4; i++) {
            request.coordinates[i] = (double)lanes->coordinates[i][lane];
        }
        for (int i = 0; i < 3 && shifts; i++) {
            request.offset[i] = lanes->offset[i][lane];
        }
        kind_model_sample(texture, def, &request, expected);
        for (int c = 0; c < 4; c++) {
            if (!(fabs((double)texel[c][lane] - expected[c]) <= 1.5e-4)) {
                fail_msg("kind %d: channel %d is %g, not %g", (int)texture->shape.kind, c,
                         (double)texel[c][lane], expected[c]);
            }
        }
    }
}

static void test_every_kind_by_the_model(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_R32_FLOAT,
                                              RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB,
                                              RHW_FORMAT_RG8_UNORM};
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 7;
    for (int n = 0; n < 280; n++) {
        struct rhw_texture_def def = kinds[n % KINDS];
        def.format = formats[n / KINDS % 5];
        def.mip_levels = RHW_MIP_LEVELS_ALL;
        // Plain 2D textures of 8 bits are filtered in fixed point, which test_sample.c looks at.
        const bool shifts = n % KINDS == 2 || n % 3 == 0;
        const bool is_cube = def.kind == RHW_TEXTURE_CUBE;
        const rhw_texture texture = kind_model_texture(rig.context, &def, &random);
        const struct rhw_sampler_def sampler_def = random_sampler(&random);
        struct rhw_sampler_data sampler;
        rhw_sampler_data_init(&sampler, &sampler_def);
        struct rhw_bindings bindings;
        for (int i = 0; i < 8; i++) {
            struct lanes lanes;
            rhw_float texel[4];
            random_lanes(&random, &def, &lanes);
            const struct rhw_sample_request request = request_of(&lanes, shifts);
            bind(&bindings, RHW_ISA_BASELINE, &rig, texture, &sampler);
            rhw_sample(&bindings, SLOT, &request, texel);
            expect_model(rhw_context_texture(rig.context, texture, "test"), &sampler_def, &lanes,
                         shifts && !is_cube, texel);
            expect_same_everywhere(&rig, texture, &sampler, &lanes, shifts, texel);
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static rhw_texture numbered(struct rig *rig, struct rhw_texture_def def)
{
    rhw_texture texture;
    def.format = RHW_FORMAT_R32_FLOAT;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    const int slices =
        rhw_texture_depth(rig->context, texture, 0) * rhw_texture_layers(rig->context, texture);
    for (int slice = 0; slice < slices; slice++) {
        float texels[64];
        for (int i = 0; i < 64; i++) {
            texels[i] = (float)(100 * slice + i);
        }
        assert_int_equal(rhw_texture_write_layer(rig->context, texture, 0, slice, texels, 0), RHW_OK);
    }
    return texture;
}

static float sample_one(const struct rhw_bindings *bindings, const float *at)
{
    float texel[4];
    rhw_sample_lod1(bindings, SLOT, at, 0, texel);
    assert_true(texel[1] == 0 && texel[2] == 0 && texel[3] == 1);
    return texel[0];
}

// Rounded to nearest, ties to even, and held within the array.
static void test_layers_are_rounded(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture texture =
        numbered(&rig, (struct rhw_texture_def){.width = 1, .height = 1, .layers = 5});
    const struct rhw_sampler_def def = {.min_filter = RHW_FILTER_NEAREST};
    struct rhw_sampler_data sampler;
    struct rhw_bindings bindings;
    rhw_sampler_data_init(&sampler, &def);
    bind(&bindings, RHW_ISA_BASELINE, &rig, texture, &sampler);
    static const float cases[][2] = {{0, 0},    {0.5f, 0}, {0.75f, 1}, {1.5f, 2},  {2.5f, 2},
                                     {3.5f, 4}, {-7, 0},   {4.4f, 4},  {1e30f, 4}, {NAN, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float at[3] = {0.5f, 0.5f, cases[i][0]};
        assert_true(sample_one(&bindings, at) == 100 * cases[i][1]);
    }
    rig_close(&rig);
}

// A cube of one texel a face: directions name faces; between two, three and at a corner the average.
static void test_faces_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def cube = {.width = 1, .height = 1, .kind = RHW_TEXTURE_CUBE};
    const rhw_texture texture = numbered(&rig, cube);
    const struct rhw_sampler_def linear = {0};
    struct rhw_sampler_data sampler;
    struct rhw_bindings bindings;
    rhw_sampler_data_init(&sampler, &linear);
    bind(&bindings, RHW_ISA_BASELINE, &rig, texture, &sampler);
    static const float axes[6][3] = {{9, 0, 0}, {-9, 0, 0}, {0, 9, 0}, {0, -9, 0}, {0, 0, 9}, {0, 0, -9}};
    for (int face = 0; face < 6; face++) {
        assert_true(sample_one(&bindings, axes[face]) == 100 * (float)face);
    }
    const float edge[3] = {1, 0, 1}, corner[3] = {2, -2, 2}, zero[3] = {0, 0, 0};
    assert_true(sample_one(&bindings, edge) == (0 + 400) / 2);
    // +z, and beside it +x and −y; the fourth texel of the footprint is the average of these three.
    assert_true(fabsf(sample_one(&bindings, corner) - (0 + 300 + 400) / 3.0f) < 1e-4f);
    const float anywhere = sample_one(&bindings, zero);
    assert_true(anywhere >= 0 && anywhere <= 500);
    rig_close(&rig);
}

// Where two faces meet nothing jumps: a step of 1e-4 changes numbers within ±4 by less than a hundredth.
static void test_no_seam(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 3;
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA32_FLOAT, .width = 4, .height = 4, .kind = RHW_TEXTURE_CUBE};
    const rhw_texture texture = kind_model_texture(rig.context, &def, &random);
    const struct rhw_sampler_def linear = {0};
    struct rhw_sampler_data sampler;
    struct rhw_bindings bindings;
    rhw_sampler_data_init(&sampler, &linear);
    bind(&bindings, RHW_ISA_BASELINE, &rig, texture, &sampler);
    for (int n = 0; n < 600; n++) {
        float near[3], far[3], a[4], b[4];
        const int axis = n % 3, other = (n + 1) % 3;
        const float sign = n / 3 % 2 ? 1.0f : -1.0f, other_sign = n / 6 % 2 ? 1.0f : -1.0f;
        near[axis] = sign;
        near[other] = other_sign * 0.99995f;
        near[3 - axis - other] = rig_random_float(&random, -1, 1);
        memcpy(far, near, sizeof far);
        far[other] = other_sign * 1.00005f;
        rhw_sample_lod1(&bindings, SLOT, near, 0, a);
        rhw_sample_lod1(&bindings, SLOT, far, 0, b);
        for (int c = 0; c < 4; c++) {
            assert_true(fabsf(a[c] - b[c]) < 1e-2f);
        }
    }
    rig_close(&rig);
}

// The level of detail of a direction is that of its coordinates on the face, by differences.
static void test_gradients(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 12;
    const struct rhw_sampler_def def = {.lod_bias = 0.25f};
    struct rhw_sampler_data sampler;
    struct rhw_bindings bindings;
    rhw_sampler_data_init(&sampler, &def);
    const struct rhw_texture_def cube = {.width = 8, .height = 8, .mip_levels = 4, .kind = RHW_TEXTURE_CUBE};
    const struct rhw_texture_def volume = {
        .width = 8, .height = 4, .depth = 2, .mip_levels = 4, .kind = RHW_TEXTURE_3D};
    const rhw_texture cube_texture = numbered(&rig, cube), volume_texture = numbered(&rig, volume);
    for (int n = 0; n < 200; n++) {
        double at[3], change[6], size[3] = {8, 4, 2}, longest = 0;
        float at1[3], change1[6], lod[2];
        for (int i = 0; i < 6; i++) {
            change1[i] = rig_random_float(&random, -0.2f, 0.2f);
            change[i] = (double)change1[i];
            at1[i % 3] = rig_random_float(&random, -1, 1);
        }
        for (int i = 0; i < 3; i++) {
            at[i] = (double)at1[i];
        }
        for (int way = 0; way < 2; way++) {
            double near[3], far[3], st[2][2], sum = 0;
            for (int i = 0; i < 3; i++) {
                near[i] = at[i] - 1e-6 * change[3 * way + i];
                far[i] = at[i] + 1e-6 * change[3 * way + i];
            }
            if (n % 2) {
                kind_model_face(near, st[0]);
                kind_model_face(far, st[1]);
                sum = pow(8 * (st[1][0] - st[0][0]) / 2e-6, 2) + pow(8 * (st[1][1] - st[0][1]) / 2e-6, 2);
            }
            for (int i = 0; i < 3 && n % 2 == 0; i++) {
                sum += pow(size[i] * change[3 * way + i], 2);
            }
            longest = fmax(longest, sqrt(sum));
        }
        const struct rhw_sample_request1 request = {.coordinates = at1, .gradient = change1};
        bind(&bindings, RHW_ISA_BASELINE, &rig, n % 2 ? cube_texture : volume_texture, &sampler);
        rhw_sample_query_lod1(&bindings, SLOT, &request, lod);
        const double expected = log2(longest) + 0.25;
        assert_true(fabs((double)lod[1] - expected) < 1e-3);
        assert_true(fabs((double)lod[0] - fmin(fmax(expected, 0), 3)) < 1e-3);
    }
    rig_close(&rig);
}

// Every lane of a group by rhw_sample_groups1.
static void expect_one_at_a_time(const struct rhw_fragment *group, int components, int at,
                                 const rhw_float texel[4])
{
    for (int lane = 0; lane < RHW_LANES; lane++) {
        float varying[6], ddx[6], ddy[6], texels[SLOT + 1][4];
        for (int i = 0; i < components; i++) {
            varying[i] = group->varying[i][lane];
            ddx[i] = group->ddx[i][lane];
            ddy[i] = group->ddy[i][lane];
        }
        const struct rhw_fragment1 one = {
            .varying = varying, .ddx = ddx, .ddy = ddy, .bindings = group->bindings};
        rhw_sample_groups1(&one, 1u << SLOT, at, texels);
        for (int c = 0; c < 4; c++) {
            assert_int_equal(rhw_bits_from_float1(texels[SLOT][c]), rhw_bits_from_float1(texel[c][lane]));
        }
    }
}

// rhw_sample_groups takes as many varyings as the slot's texture asks for; anisotropic samplers come to the same too, and
// so does a fragment at a time.
static void test_groups(void **state)
{
    (void)state;
    enum { GROUPS = 3 };
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 21;
    for (int n = 0; n < KINDS * 2; n++) {
        struct rhw_texture_def def = kinds[n % KINDS];
        def.format = RHW_FORMAT_RGBA8_UNORM;
        def.mip_levels = RHW_MIP_LEVELS_ALL;
        const rhw_texture texture = kind_model_texture(rig.context, &def, &random);
        const int components = components_of(&def) - (def.layers > 0);
        const struct rhw_sampler_def sampler_def = {.max_anisotropy = n < KINDS ? 0 : 8};
        struct rhw_sampler_data sampler;
        struct rhw_bindings bindings;
        rhw_sampler_data_init(&sampler, &sampler_def);
        bind(&bindings, RHW_ISA_BASELINE, &rig, texture, &sampler);
        rhw_float varyings[GROUPS][6], ddx[GROUPS][6], ddy[GROUPS][6], texels[GROUPS][8][4];
        struct rhw_fragment groups[GROUPS] = {0};
        for (int g = 0; g < GROUPS; g++) {
            for (int lane = 0; lane < RHW_LANES * 6; lane++) {
                varyings[g][lane / RHW_LANES][lane % RHW_LANES] = rig_random_float(&random, -1, 2);
                ddx[g][lane / RHW_LANES][lane % RHW_LANES] = rig_random_float(&random, -0.2f, 0.2f);
                ddy[g][lane / RHW_LANES][lane % RHW_LANES] = rig_random_float(&random, -0.02f, 0.02f);
            }
            groups[g] = (struct rhw_fragment){
                .varying = varyings[g], .ddx = ddx[g], .ddy = ddy[g], .bindings = &bindings};
        }
        rhw_sample_groups(groups, GROUPS, 1u << SLOT, 1, texels[0], 8);
        for (int g = 0; g < GROUPS; g++) {
            rhw_float gradient[6], texel[4];
            memcpy(gradient, ddx[g] + 1, (size_t)components * sizeof *gradient);
            memcpy(gradient + components, ddy[g] + 1, (size_t)components * sizeof *gradient);
            rhw_sample_grad(&bindings, SLOT, varyings[g] + 1, gradient, texel);
            assert_memory_equal(texels[g][SLOT], texel, sizeof texel);
            expect_one_at_a_time(&groups[g], 6, 1, texel);
        }
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_every_kind_by_the_model),
    cmocka_unit_test(test_layers_are_rounded),
    cmocka_unit_test(test_faces_by_hand),
    cmocka_unit_test(test_no_seam),
    cmocka_unit_test(test_gradients),
    cmocka_unit_test(test_groups),
};

const struct unit_tests test_texture_kinds = UNIT_TESTS(tests, NULL, NULL);
