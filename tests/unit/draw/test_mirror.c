// SPDX-License-Identifier: MIT
// RHW_ADDRESS_MIRROR against Vulkan 1.3, "Texel Coordinate Systems", wrapping operation: texel i of n is (n − 1) −
// mirror((i mod 2n) − n), with mirror(k) = k, or −1 − k below 0. Coordinates are multiples of 1/256, so that all is exact,
// texel edges and centres at negative coordinates included. The special samplers and the general one have the same.
#include "harness.h"
#include "isa_support.h"

#include <math.h>

#include "binding/binding.h"
#include "context/context.h"
#include "kernels/kernels.h"
#include "context/lookup.h"
#include "resource/sampler.h"
#include "resource/texture.h"

enum { MAX_SIZE = 64, STEPS = 256, PERIODS = 5 };

static int64_t floor_div(int64_t a, int64_t b)
{
    return a / b - (a % b < 0);
}

static int mirrored(int64_t i, int n)
{
    const int64_t k = i - floor_div(i, 2 * n) * 2 * n - n;
    return (int)(n - 1 - (k >= 0 ? k : -1 - k));
}

// The texel at x, and of neighbours a dyadic weight that is exact in float.
static float expected(enum rhw_filter filter, int64_t u_256, int n)
{
    if (filter == RHW_FILTER_NEAREST) {
        return (float)mirrored(floor_div(u_256 * n, STEPS), n);
    }
    const int64_t at_512 = 2 * u_256 * n - STEPS, low = floor_div(at_512, 2 * STEPS);
    const float weight = (float)(at_512 - low * 2 * STEPS) / (2 * STEPS);
    return (float)mirrored(low, n) * (1 - weight) + (float)mirrored(low + 1, n) * weight;
}

static rhw_texture make_ramp(rhw_context *context, int n, bool along_u)
{
    float texels[MAX_SIZE];
    struct rhw_texture_def def = rhw_texture_def_default();
    rhw_texture texture;
    for (int i = 0; i < n; i++) {
        texels[i] = (float)i;
    }
    def.width = along_u ? n : 1;
    def.height = along_u ? 1 : n;
    def.mip_levels = 1;
    def.format = RHW_FORMAT_R32_FLOAT;
    assert_int_equal(rhw_texture_create(context, &def, &texture), RHW_OK);
    rhw_texture_write(context, texture, 0, texels, 0);
    return texture;
}

// Samples 8 coordinates on every instruction set, by the special paths, without them, and by the general sampler.
static void compare(struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler, bool along_u,
                    int n, int64_t first)
{
    rhw_float uv[2] = {rhw_splat(0.25f), rhw_splat(0.25f)};
    const rhw_float lod = rhw_splat(0);
    const struct rhw_sample_request request = {.coordinates = uv, .lod = &lod};
    for (int lane = 0; lane < 8; lane++) {
        uv[!along_u][lane] = (float)(first + lane) / STEPS;
    }
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        for (int way = 0; way < 3 && isa_is_there((enum rhw_isa)isa); way++) {
            const struct rhw_kernels *const kernels = rhw_kernels_for((enum rhw_isa)isa);
            const struct rhw_binding_data binding =
                rhw_binding_of(kernels, way == 0 ? RHW_PATHS_ALL : RHW_PATHS_GENERAL, texture, sampler);
            rhw_float texel[4];
            (way == 2 ? kernels->sample_general : binding.sample)(&binding, &request, texel);
            for (int lane = 0; lane < 8; lane++) {
                const float right = expected(sampler->def.mag_filter, first + lane, n);
                if (texel[0][lane] != right) {
                    fail_msg("%s, way %d, filter %d, %d texels, at %d/256: %g, not %g",
                             rhw_isa_name((enum rhw_isa)isa), way, sampler->def.mag_filter, n,
                             (int)(first + lane), (double)texel[0][lane], (double)right);
                }
            }
        }
    }
}

static void test_every_texel_and_edge(void **state)
{
    (void)state;
    static const int sizes[] = {1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 33, 64};
    rhw_context *context;
    struct rhw_context_def def = rhw_context_def_default();
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    for (int filter = RHW_FILTER_LINEAR; filter <= RHW_FILTER_NEAREST; filter++) {
        struct rhw_sampler_def sampler = rhw_sampler_def_default();
        rhw_sampler made;
        sampler.address_u = sampler.address_v = RHW_ADDRESS_MIRROR;
        sampler.min_filter = sampler.mag_filter = (enum rhw_filter)filter;
        assert_int_equal(rhw_sampler_create(context, &sampler, &made), RHW_OK);
        for (size_t i = 0; i < 2 * sizeof sizes / sizeof *sizes; i++) {
            const int n = sizes[i / 2];
            const rhw_texture texture = make_ramp(context, n, i % 2);
            struct rhw_texture_data *const data = rhw_context_texture(context, texture, "test");
            for (int64_t first = -PERIODS * STEPS; first < PERIODS * STEPS; first += 8) {
                compare(data, rhw_context_sampler(context, made, "test"), i % 2, n, first);
            }
            rhw_texture_destroy(context, texture);
        }
    }
    rhw_context_destroy(context);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_texel_and_edge)};

const struct unit_tests test_mirror = UNIT_TESTS(tests, NULL, NULL);
