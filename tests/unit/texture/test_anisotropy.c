// SPDX-License-Identifier: MIT
// Anisotropic filtering against a direct reading of Vulkan's formulas, and what it is for: a floor that comes closer to the
// truth than trilinear filtering does.
#include "isa_support.h"
#include "kind_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "binding/binding.h"
#include "context/context.h"
#include "context/lookup.h"
#include "resource/sampler.h"

enum { SLOT = 2 };

static void bind(struct rhw_bindings *bindings, enum rhw_isa isa, enum rhw_paths paths, const struct rig *rig,
                 rhw_texture texture, const struct rhw_sampler_data *sampler)
{
    const struct rhw_kernels *const kernels = rhw_kernels_for(isa);
    rhw_bindings_init(bindings, kernels);
    bindings->slot[SLOT] =
        rhw_binding_of(kernels, paths, rhw_context_texture(rig->context, texture, "test"), sampler);
}

// The squared length in texels of a change per pixel: of a cube by differences on the face.
static double length_of(const struct rhw_texture_data *texture, const double at[3], const double *change)
{
    const struct rhw_texture_shape *const shape = &texture->shape;
    const double size[3] = {shape->width, shape->height, shape->depth};
    double sum = 0;
    if (shape->kind == RHW_TEXTURE_CUBE) {
        double near[3], far[3], st[2][2];
        for (int i = 0; i < 3; i++) {
            near[i] = at[i] - 1e-6 * change[i];
            far[i] = at[i] + 1e-6 * change[i];
        }
        kind_model_face(near, st[0]);
        kind_model_face(far, st[1]);
        return hypot(st[1][0] - st[0][0], st[1][1] - st[0][1]) * size[0] / 2e-6;
    }
    const int components = shape->kind == RHW_TEXTURE_2D ? 2 : 3;
    for (int i = 0; i < components; i++) {
        sum += change[i] * change[i] * size[i] * size[i];
    }
    return sqrt(sum);
}

// False where the number of samples hangs on a rounding.
static bool model_anisotropic(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler,
                              const double at[4], const double *gradient, double value[4])
{
    const int components = texture->shape.kind == RHW_TEXTURE_2D ? 2 : 3;
    const double x = length_of(texture, at, gradient), y = length_of(texture, at, gradient + components);
    const double *const longer = x >= y ? gradient : gradient + components;
    const double ratio = fmax(x, y) / fmin(x, y);
    const double eta = fmin(ratio, (double)sampler->max_anisotropy);
    const int count = (int)ceil(eta);
    if (fabs(ratio - nearbyint(ratio)) < 1e-3 || fabs(x - y) < 1e-3 * x) {
        return false;
    }
    memset(value, 0, 4 * sizeof *value);
    for (int i = 1; i <= count; i++) {
        struct kind_request request = {.lod = log2(fmax(x, y) / eta)};
        double sample[4];
        memcpy(request.coordinates, at, sizeof request.coordinates);
        for (int c = 0; c < components; c++) {
            request.coordinates[c] += longer[c] * (i / (count + 1.0) - 0.5);
        }
        kind_model_sample(texture, sampler, &request, sample);
        for (int c = 0; c < 4; c++) {
            value[c] += sample[c] / count;
        }
    }
    return true;
}

static const struct rhw_texture_def defs[] = {
    {.format = RHW_FORMAT_RGBA32_FLOAT, .width = 32, .height = 16},
    {.format = RHW_FORMAT_RGBA8_UNORM, .width = 32, .height = 32},
    {.format = RHW_FORMAT_RGBA8_SRGB, .width = 16, .height = 64},
    {.format = RHW_FORMAT_RGBA32_FLOAT, .width = 32, .height = 16, .layers = 3},
    {.format = RHW_FORMAT_RGBA32_FLOAT, .width = 8, .height = 16, .depth = 8, .kind = RHW_TEXTURE_3D},
    {.format = RHW_FORMAT_RGBA32_FLOAT, .width = 16, .height = 16, .kind = RHW_TEXTURE_CUBE},
};
enum { DEFS = sizeof defs / sizeof *defs };

struct lanes {
    rhw_float coordinates[4], gradient[6];
};

static void random_lanes(uint64_t *random, struct lanes *lanes)
{
    for (int lane = 0; lane < RHW_LANES; lane++) {
        const float along = rig_random_float(random, 0, 0.3f), across = rig_random_float(random, 0, 0.05f);
        for (int i = 0; i < 6; i++) {
            lanes->gradient[i][lane] = rig_random_float(random, -1, 1) * (i < 3 ? along : across);
            lanes->coordinates[i % 4][lane] = rig_random_float(random, -1, 1);
        }
    }
}

// Put lanes side by side, as those of a floor that is not turned: up to 2.5 texels of 32 apart, from left to right or from
// right to left, with footprints that are long along y or along x.
static void row_of_lanes(uint64_t *random, struct lanes *lanes)
{
    const float step = rig_random_float(random, -0.08f, 0.08f), along = rig_random_float(random, 0.02f, 0.4f);
    const float u = rig_random_float(random, -1, 1), v = rig_random_float(random, -1, 1);
    random_lanes(random, lanes);
    for (int i = 0; i < 6; i++) {
        lanes->gradient[i] = rhw_splat(i == 0 ? step : i == 3 ? along : 0.003f);
    }
    for (int lane = 0; lane < RHW_LANES; lane++) {
        lanes->coordinates[0][lane] = u + step * (float)lane;
        lanes->coordinates[1][lane] = v;
    }
}

static int compare_with_model(const struct rig *rig, rhw_texture texture,
                              const struct rhw_sampler_data *sampler, const struct rhw_sampler_def *def,
                              bool in_row, uint64_t *random)
{
    const struct rhw_texture_data *const data = rhw_context_texture(rig->context, texture, "test");
    const double tolerance =
        rhw_format_size(data->format) == 4 ? 1e-3 : 5e-4; // weights and texels of 15 bits
    struct lanes lanes;
    (in_row ? row_of_lanes : random_lanes)(random, &lanes);
    const struct rhw_sample_request request = {.coordinates = lanes.coordinates, .gradient = lanes.gradient};
    struct rhw_bindings bindings;
    rhw_float texel[4], other[4];
    int compared = 0;
    bind(&bindings, RHW_ISA_BASELINE, RHW_PATHS_ALL, rig, texture, sampler);
    rhw_sample(&bindings, SLOT, &request, texel);
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        for (int paths = 0; paths <= RHW_PATHS_GENERAL && isa_is_there((enum rhw_isa)isa); paths++) {
            bind(&bindings, (enum rhw_isa)isa, (enum rhw_paths)paths, rig, texture, sampler);
            rhw_sample(&bindings, SLOT, &request, other);
            assert_memory_equal(other, texel, sizeof texel);
        }
    }
    for (int lane = 0; lane < RHW_LANES; lane++) {
        double at[4], gradient[6], expected[4];
        float at1[4], gradient1[6], texel1[4];
        for (int i = 0; i < 6; i++) {
            gradient1[i] = lanes.gradient[i][lane];
            gradient[i] = (double)gradient1[i];
            at1[i % 4] = lanes.coordinates[i % 4][lane];
            at[i % 4] = (double)at1[i % 4];
        }
        rhw_sample_grad1(&bindings, SLOT, at1, gradient1, texel1);
        const bool is_clear = model_anisotropic(data, def, at, gradient, expected);
        compared += is_clear;
        for (int c = 0; c < 4; c++) {
            assert_true(texel1[c] == texel[c][lane]);
            assert_true(!is_clear || fabs((double)texel1[c] - expected[c]) < tolerance);
        }
    }
    return compared;
}

static void test_the_formula(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 4;
    int compared = 0;
    for (int n = 0; n < DEFS * 24; n++) {
        struct rhw_texture_def def = defs[n % DEFS];
        def.mip_levels = RHW_MIP_LEVELS_ALL;
        const rhw_texture texture = kind_model_texture(rig.context, &def, &random);
        // The decoded copy of sRGB textures is made when a pass binds them.
        rhw_sampler id;
        struct rhw_sampler_def sampler_def = {.max_anisotropy = (float)(n % 5 == 0 ? 16 : 2 + n % 3 * 3)};
        sampler_def.address_u = (enum rhw_address)(n % 3);
        assert_int_equal(rhw_sampler_create(rig.context, &sampler_def, &id), RHW_OK);
        rig_begin(&rig);
        rhw_pass_set_texture(rig.context, rig.recording, 0, texture, id);
        rig_end(&rig);
        const struct rhw_sampler_data *const sampler = rhw_context_sampler(rig.context, id, "test");
        for (int i = 0; i < 16; i++) {
            compared += compare_with_model(&rig, texture, sampler, &sampler_def, i % 2, &random);
        }
        rhw_sampler_destroy(rig.context, id);
        rhw_texture_destroy(rig.context, texture);
    }
    assert_true(compared > DEFS * 24 * 16 * RHW_LANES / 2);
    rig_close(&rig);
}

// The floor ------------------------------------------------------------------------------------------
// An eye above an endless floor of a fine pattern; pixel rows down from the horizon see it ever nearer.
enum { SIZE = 64, COLUMNS = 48, ROWS = 40 };

// Where the ray through a point of the screen meets the floor, in textures.
static void floor_at(double x, double y, double uv[2])
{
    uv[1] = 30 / (y + 3);
    uv[0] = (x - COLUMNS / 2.0) * uv[1] * 0.008;
}

static float pattern(int x, int y)
{
    return (x / 4 + y / 4) % 2 || (x * y) % 11 == 3 ? 0.9f : 0.1f;
}

static double truth(int column, int row)
{
    enum { GRID = 64 };
    double sum = 0;
    for (int i = 0; i < GRID * GRID; i++) {
        double uv[2];
        floor_at(column + (i % GRID + 0.5) / GRID, row + (i / GRID + 0.5) / GRID, uv);
        const double u = uv[0] - floor(uv[0]), v = uv[1] - floor(uv[1]);
        sum += (double)pattern((int)(u * SIZE) % SIZE, (int)(v * SIZE) % SIZE);
    }
    return sum / (GRID * GRID);
}

// The root of the mean squared difference from the truth.
static double floor_error(const struct rig *rig, rhw_texture texture, float max_anisotropy,
                          double expected[ROWS][COLUMNS])
{
    const struct rhw_sampler_def def = {.max_anisotropy = max_anisotropy};
    struct rhw_sampler_data sampler;
    struct rhw_bindings bindings;
    double sum = 0;
    rhw_sampler_data_init(&sampler, &def);
    bind(&bindings, RHW_ISA_BASELINE, RHW_PATHS_ALL, rig, texture, &sampler);
    for (int row = 0; row < ROWS; row++) {
        for (int column = 0; column < COLUMNS; column++) {
            const double x = column + 0.5, y = row + 0.5;
            double at[2], right[2], below[2];
            float uv[2], gradient[4], texel[4];
            floor_at(x, y, at);
            floor_at(x + 1e-4, y, right);
            floor_at(x, y + 1e-4, below);
            for (int i = 0; i < 2; i++) {
                uv[i] = (float)at[i];
                gradient[i] = (float)((right[i] - at[i]) / 1e-4);
                gradient[2 + i] = (float)((below[i] - at[i]) / 1e-4);
            }
            rhw_sample_grad1(&bindings, SLOT, uv, gradient, texel);
            sum += pow((double)texel[0] - expected[row][column], 2);
        }
    }
    return sqrt(sum / (ROWS * COLUMNS));
}

static void test_the_floor_comes_closer_to_the_truth(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    static double expected[ROWS][COLUMNS];
    static unsigned char texels[SIZE][SIZE];
    for (int row = 0; row < ROWS; row++) {
        for (int column = 0; column < COLUMNS; column++) {
            expected[row][column] = truth(column, row);
        }
    }
    for (int i = 0; i < SIZE * SIZE; i++) {
        texels[i / SIZE][i % SIZE] = (unsigned char)(pattern(i % SIZE, i / SIZE) * 255 + 0.5f);
    }
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_R8_UNORM, .width = SIZE, .height = SIZE, .mip_levels = RHW_MIP_LEVELS_ALL};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    rhw_texture_write(rig.context, texture, 0, texels, 0);
    rhw_texture_generate_mips(rig.context, texture);
    const double off = floor_error(&rig, texture, 0, expected), one = floor_error(&rig, texture, 1, expected),
                 four = floor_error(&rig, texture, 4, expected),
                 sixteen = floor_error(&rig, texture, 16, expected);
    print_message("from the truth: trilinear %.4f, 4 samples %.4f, 16 samples %.4f\n", off, four, sixteen);
    assert_true(one == off);
    assert_true(four < 0.75 * off);
    assert_true(sixteen < 0.6 * off && sixteen < four);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_the_formula),
    cmocka_unit_test(test_the_floor_comes_closer_to_the_truth),
};

const struct unit_tests test_anisotropy = UNIT_TESTS(tests, NULL, NULL);
