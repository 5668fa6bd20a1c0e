// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/raster: the depth test, open pixels and hierarchical depth; compiled with
// RHW_ISA_SUFFIX = baseline, avx2, ...
#include "kernels/depth/depth_test.h"
#include "kernels/depth/hiz.h"
#include "kernels/depth/open_pixels.h"

#include "kernel_folders.h"

enum { PIXELS = RHW_BLOCK * RHW_BLOCK };

// Fragments of a block of a tile, and what the tile has there.
struct test_input {
    float z[PIXELS], stored[PIXELS];
    uint64_t mask, open[RHW_BLOCK];
    int32_t x, y, name, compare, write, open_rule;
    int32_t column[RHW_BLOCK]; // of a fragment in each row
};

struct test_result {
    float stored[PIXELS];
    uint64_t open[RHW_BLOCK], passed, open_count, marked;
};

static void make_test(struct kernel_random *random, void *input)
{
    struct test_input *const in = input;
    random_floats(random, in->z, PIXELS);
    for (int i = 0; i < PIXELS; i++) { // often equal, or next to it
        in->stored[i] = random_one_in(random, 2) ? in->z[i] : random_float(random);
    }
    const uint64_t masks[] = {0, ~(uint64_t)0, random_bits(random),
                              random_bits(random) & random_bits(random)};
    in->mask = masks[random_int(random, 0, 3)];
    for (int row = 0; row < RHW_BLOCK; row++) {
        in->open[row] = random_bits(random);
        in->column[row] = (int32_t)random_int(random, 0, RHW_BLOCK - 1);
    }
    in->x = (int32_t)random_int(random, 0, RHW_TILE / RHW_BLOCK - 1) * RHW_BLOCK;
    in->y = (int32_t)random_int(random, 0, RHW_TILE - RHW_BLOCK);
    in->name = (int32_t)random_int(random, 0, RHW_RULE_ANY);
    in->compare = (int32_t)random_int(random, RHW_COMPARE_LESS, RHW_COMPARE_ALWAYS);
    in->write = random_one_in(random, 2);
    in->open_rule = (int32_t)random_int(random, RHW_OPEN_IGNORED, RHW_OPEN_CLOSE);
}

static void set_block(struct tile_depth *depth, const struct test_input *in)
{
    for (int row = 0; row < RHW_BLOCK; row++) {
        memcpy(depth_texels(depth, in->x, in->y + row), &in->stored[row * RHW_BLOCK],
               RHW_BLOCK * sizeof(float));
    }
    memcpy(&depth->open[in->y], in->open, sizeof in->open);
    depth->open_count = RHW_TILE * RHW_TILE;
    depth->marked = false;
}

static void store_block(struct test_result *out, struct tile_depth *depth, const struct test_input *in,
                        uint64_t passed)
{
    for (int row = 0; row < RHW_BLOCK; row++) {
        memcpy(&out->stored[row * RHW_BLOCK], depth_texels(depth, in->x, in->y + row),
               RHW_BLOCK * sizeof(float));
    }
    memcpy(out->open, &depth->open[in->y], sizeof out->open);
    out->passed = passed;
    out->open_count = (uint64_t)depth->open_count;
    out->marked = depth->marked;
}

static void run_test_early(const void *input, void *result)
{
    const struct test_input *const in = input;
    const struct rhw_draw_plan plan = {
        .early_name = (enum rhw_rule_name)in->name,
        .early = {(enum rhw_compare)in->compare, in->write != 0, (enum rhw_open_rule)in->open_rule}};
    struct tile_depth depth;
    f32x8 z[RHW_BLOCK];
    memcpy(z, in->z, sizeof z);
    set_block(&depth, in);
    store_block(result, &depth, in, test_block_early(&depth, z, in->x, in->y, in->mask, &plan));
}

static void run_test_row_late(const void *input, void *result)
{
    const struct test_input *const in = input;
    const struct rhw_depth_rule rule = {(enum rhw_compare)in->compare, in->write != 0,
                                        (enum rhw_open_rule)in->open_rule};
    struct tile_depth depth;
    set_block(&depth, in);
    const unsigned passed = test_row_late(&depth, in->x, in->y, f32x8_load(in->z), in->mask & 0xff, rule);
    store_block(result, &depth, in, passed);
}

static void run_test_texels_late(const void *input, void *result)
{
    const struct test_input *const in = input;
    const struct rhw_depth_rule rule = {(enum rhw_compare)in->compare, in->write != 0,
                                        (enum rhw_open_rule)in->open_rule};
    struct tile_depth depth;
    int32_t texels[8];
    for (int i = 0; i < 8; i++) {
        texels[i] = (in->y + i) * RHW_TILE + in->x + in->column[i];
    }
    set_block(&depth, in);
    store_block(result, &depth, in,
                test_texels_late(&depth, texels, f32x8_load(in->z), in->mask & 0xff, rule));
}

static void run_claim(const void *input, void *result)
{
    const struct test_input *const in = input;
    struct tile_depth depth;
    set_block(&depth, in);
    store_block(result, &depth, in, claim_backwards(&depth, in->x, in->y, in->mask));
}

// A tile whose depth repeats some numbers, and a plane of depth.
enum { DEPTHS = 97 };

struct hiz_input {
    double at, dx, dy;
    float depths[DEPTHS];
    int32_t direction, anchor_x, anchor_y, x, y, width, height, samples;
};

struct hiz_result {
    float bounds[HIZ_BLOCKS * HIZ_BLOCKS], covered;
    uint32_t hidden[HIZ_BLOCKS], has_bounds, hides;
};

static void make_hiz(struct kernel_random *random, void *input)
{
    struct hiz_input *const in = input;
    const bool odd = random_one_in(random, 2); // depths no target of 24 bits has
    for (int i = 0; i < DEPTHS; i++) {
        in->depths[i] = odd ? random_float(random) : random_float_in(random, 0.0f, 1.0f);
    }
    in->at = random_one_in(random, 8) ? random_double(random) : (double)random_float_in(random, 0.0f, 1.0f);
    in->dx = random_one_in(random, 8) ? random_double(random) : random_finite_double(random, 12) / 4096.0;
    in->dy = random_one_in(random, 8) ? random_double(random) : random_finite_double(random, 12) / 4096.0;
    in->direction = random_one_in(random, 2) ? 1 : -1;
    in->anchor_x = (int32_t)random_int(random, -RHW_GUARD_BAND, RHW_GUARD_BAND);
    in->anchor_y = (int32_t)random_int(random, -RHW_GUARD_BAND, RHW_GUARD_BAND);
    in->x = (int32_t)random_int(random, 0, HIZ_BLOCKS - 1) * RHW_BLOCK;
    in->y = (int32_t)random_int(random, 0, HIZ_BLOCKS - 1) * RHW_BLOCK;
    in->width = (int32_t)random_int(random, 1, RHW_BLOCK);
    in->height = (int32_t)random_int(random, 1, RHW_BLOCK);
    in->samples = (int32_t)random_int(random, 1, 2);
}

static void run_hiz(const void *input, void *result)
{
    const struct hiz_input *const in = input;
    struct hiz_result *const out = result;
    const struct plane z = {in->at, in->dx, in->dy};
    const double reach = in->samples == 1 ? 0 : 0.5;
    struct tile_depth depth, other; // in the first sample of each pixel, and in another
    depth.direction = in->direction;
    depth.least = 0.0f;
    depth.most = 1.0f;
    for (int i = 0, from = 0; i < RHW_TILE * RHW_TILE; i++, from = from + 1 == DEPTHS ? 0 : from + 1) {
        depth.texels[i] = in->depths[from];
        other.texels[i] = in->depths[DEPTHS - 1 - from];
    }
    struct tile_depth *const planes[] = {&depth, &other};
    hiz_refresh(planes, in->samples);
    for (int i = 0; i < HIZ_BLOCKS; i++) {
        out->hidden[i] = hiz_hidden(&depth, z, in->anchor_x, in->anchor_y, i * RHW_BLOCK, reach);
    }
    const struct hiz_rect rect = {in->x, in->y, in->x + in->width, in->y + in->height};
    out->hides = hiz_hides(&depth, z, in->anchor_x, in->anchor_y, &rect, reach);
    out->has_bounds = hiz_has_bounds(&depth, in->y);
    memcpy(out->bounds, depth.bounds, sizeof out->bounds);
    hiz_cover(&depth, z, in->anchor_x, in->anchor_y, in->x, in->y, reach);
    out->covered = depth.bounds[in->y / RHW_BLOCK * HIZ_BLOCKS + in->x / RHW_BLOCK];
}

static const struct kernel_check checks[] = {
    {"test_block_early", sizeof(struct test_input), sizeof(struct test_result), KERNEL_BITS, make_test,
     run_test_early},
    {"test_row_late", sizeof(struct test_input), sizeof(struct test_result), KERNEL_BITS, make_test,
     run_test_row_late},
    {"test_texels_late", sizeof(struct test_input), sizeof(struct test_result), KERNEL_BITS, make_test,
     run_test_texels_late},
    {"claim_backwards", sizeof(struct test_input), sizeof(struct test_result), KERNEL_BITS, make_test,
     run_claim},
    {"hiz", sizeof(struct hiz_input), sizeof(struct hiz_result), KERNEL_BITS, make_hiz, run_hiz},
};

const struct kernel_folder RHW_ISA_NAME(check_depth) = {"raster", checks, sizeof checks / sizeof *checks};
