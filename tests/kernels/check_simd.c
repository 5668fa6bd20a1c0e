// SPDX-License-Identifier: MIT
// The wrappers of simd.h that are written anew for an instruction set; compiled with RHW_ISA_SUFFIX = baseline, ...
#include "base/simd.h"

#include "kernel_folders.h"

// What wrappers are given: 8 lanes of everything, of which each reads what it takes.
struct lane_input {
    float f[2][8];
    int32_t i[2][8];
    double d[2][8];
};

static i32x8 ints(const struct lane_input *lanes, int which)
{
    return i32x8_load(lanes->i[which]);
}

static f32x8 floats(const struct lane_input *lanes, int which)
{
    return f32x8_load(lanes->f[which]);
}

static f64x8 doubles(const struct lane_input *lanes, int which)
{
    f64x8 v;
    memcpy(&v, lanes->d[which], sizeof v);
    return v;
}

static void store_doubles(void *result, f64x8 v)
{
    memcpy(result, &v, sizeof v);
}

static void make_lanes(struct kernel_random *random, void *input)
{
    struct lane_input *const lanes = input;
    random_floats(random, lanes->f[0], 16);
    random_ints(random, lanes->i[0], 16, INT32_MIN, INT32_MAX);
    random_doubles(random, lanes->d[0], 16);
    if (random_one_in(random, 2)) { // equal lanes are what comparisons and minima differ by
        lanes->f[1][0] = lanes->f[0][0];
        lanes->d[1][0] = lanes->d[0][0];
    }
}

static void make_bytes(struct kernel_random *random, void *input)
{
    struct lane_input *const lanes = input;
    random_ints(random, lanes->i[0], 16, 0, 255);
}

static void make_exponents(struct kernel_random *random, void *input)
{
    struct lane_input *const lanes = input;
    random_ints(random, lanes->i[0], 16, 0, 30);
}

// i[0]: a mask in every lane.
static void make_mask(struct kernel_random *random, void *input)
{
    struct lane_input *const lanes = input;
    make_lanes(random, input);
    random_ints(random, lanes->i[0], 8, -1, 0);
}

static void make_roundable(struct kernel_random *random, void *input)
{
    struct lane_input *const lanes = input;
    for (int i = 0; i < 8; i++) {
        lanes->d[0][i] = random_one_in(random, 2) ? (double)random_int(random, INT32_MIN, INT32_MAX) * 0.5
                                                  : random_finite_double(random, 51);
    }
}

static void run_f32x8_min(const void *input, void *result)
{
    f32x8_store(result, f32x8_min(floats(input, 0), floats(input, 1)));
}

static void run_f32x8_max(const void *input, void *result)
{
    f32x8_store(result, f32x8_max(floats(input, 0), floats(input, 1)));
}

static void run_f32x8_select(const void *input, void *result)
{
    f32x8_store(result, f32x8_select(ints(input, 0), floats(input, 0), floats(input, 1)));
}

static f32x4 floats4(const struct lane_input *lanes, int which)
{
    f32x4 v;
    memcpy(&v, lanes->f[which], sizeof v);
    return v;
}

static void run_f32x4_select(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const f32x4 selected = f32x4_select(i32x4_load(lanes->i[0]), floats4(input, 0), floats4(input, 1));
    memcpy(result, &selected, sizeof selected);
}

static void run_i32x4_sign_bits(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const unsigned bits = i32x4_sign_bits(i32x4_load(lanes->i[0]));
    memcpy(result, &bits, sizeof bits);
}

static void run_i32x4_from_bits(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const i32x4 mask = i32x4_from_bits((unsigned)lanes->i[0][0]);
    memcpy(result, &mask, sizeof mask);
}

static void run_f32x4_from_f64x4(const void *input, void *result)
{
    const f32x4 rounded = f32x4_from_f64x4(doubles(input, 0).lo);
    memcpy(result, &rounded, sizeof rounded);
}

static void run_i32x8_min(const void *input, void *result)
{
    i32x8_store(result, i32x8_min(ints(input, 0), ints(input, 1)));
}

static void run_i32x8_max(const void *input, void *result)
{
    i32x8_store(result, i32x8_max(ints(input, 0), ints(input, 1)));
}

static void run_i32x8_sign_bits(const void *input, void *result)
{
    const unsigned bits = i32x8_sign_bits(ints(input, 0));
    memcpy(result, &bits, sizeof bits);
}

static void run_i32x8_sign_bits_of_rows(const void *input, void *result)
{
    i32x8 row[8];
    for (int i = 0; i < 8; i++) {
        row[i] = ints(input, i % 2) ^ i32x8_splat((int32_t)(0x96696996u << i)); // every row its own signs
    }
    const uint64_t bits = i32x8_sign_bits_of_rows(row);
    memcpy(result, &bits, sizeof bits);
}

static void run_count_bytes_of_rows(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    uint64_t bits;
    uint8_t bytes[2][8 * 11];
    memcpy(&bits, lanes->i[1], sizeof bits);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 8 * 11; k++) {
            bytes[i][k] = (uint8_t)(lanes->i[0][k % 8] >> (k % 4 * 8));
        }
        count_bytes_of_rows(bytes[i], 11, bits, i == 0);
    }
    memcpy(result, bytes, sizeof bytes);
}

static void run_i32x8_load_bytes(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    i32x8_store(result, i32x8_load_bytes((const uint8_t *)lanes->i[0]));
}

static void run_i32x8_to_bytes(const void *input, void *result)
{
    const uint64_t bytes = i32x8_to_bytes(ints(input, 0));
    memcpy(result, &bytes, sizeof bytes);
}

static void run_i32x8_power2(const void *input, void *result)
{
    i32x8_store(result, i32x8_power2(ints(input, 0)));
}

static void run_i32x8_from_bits(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    i32x8_store(result, i32x8_from_bits((unsigned)lanes->i[0][0]));
}

static void run_f64x4_less(const void *input, void *result)
{
    const i64x4 less = f64x4_less(doubles(input, 0).lo, doubles(input, 1).lo);
    memcpy(result, &less, sizeof less);
}

static void run_f64x4_min_max(const void *input, void *result)
{
    const f64x8 a = doubles(input, 0), b = doubles(input, 1);
    store_doubles(result, (f64x8){f64x4_min(a.lo, b.lo), f64x4_max(a.lo, b.lo)});
}

static void run_f64x4_select(const void *input, void *result)
{
    const f64x8 a = doubles(input, 0), b = doubles(input, 1);
    const i64x4 mask = f64x4_less(a.hi, b.hi);
    store_doubles(result, (f64x8){f64x4_select(mask, a.lo, b.lo), f64x4_keep(f64x4_abs(a.lo), mask)});
}

static void run_f64x4_from_i32x4(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const f64x4 wide = f64x4_from_i32x4(i32x4_load(lanes->i[0]));
    memcpy(result, &wide, sizeof wide);
}

static void run_f64x8_from_f32x8(const void *input, void *result)
{
    store_doubles(result, f64x8_from_f32x8(floats(input, 0)));
}

static void run_f64x8_from_i32x8(const void *input, void *result)
{
    store_doubles(result, f64x8_from_i32x8(ints(input, 0)));
}

static void run_f64x8_operators(const void *input, void *result)
{
    const f64x8 a = doubles(input, 0), b = doubles(input, 1);
    store_doubles(result, f64x8_div(f64x8_sub(a, f64x8_mul(a, b)), f64x8_add(f64x8_splat(3.0), b)));
}

static void run_f32x8_from_f64x8(const void *input, void *result)
{
    f32x8_store(result, f32x8_from_f64x8(doubles(input, 0)));
}

static void run_i32x8_round_f64x8(const void *input, void *result)
{
    i32x8_store(result, i32x8_round_f64x8(doubles(input, 0)));
}

static void run_f64x8_clamp(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    store_doubles(result, f64x8_clamp(doubles(input, 0), 0.0, __builtin_fabs((double)lanes->i[0][0])));
}

enum { WORDS = 8 * 4, DOUBLES = 8 * 8 }; // bytes of 8 lanes

static const struct kernel_check checks[] = {
    {"f32x8_min", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_f32x8_min},
    {"f32x8_max", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_f32x8_max},
    {"f32x8_select", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_mask, run_f32x8_select},
    {"f32x4_select", sizeof(struct lane_input), WORDS / 2, KERNEL_BITS, make_mask, run_f32x4_select},
    {"f32x4_from_f64x4", sizeof(struct lane_input), WORDS / 2, KERNEL_FLOATS, make_lanes,
     run_f32x4_from_f64x4},
    {"i32x4_sign_bits", sizeof(struct lane_input), sizeof(unsigned), KERNEL_BITS, make_lanes,
     run_i32x4_sign_bits},
    {"i32x4_from_bits", sizeof(struct lane_input), WORDS / 2, KERNEL_BITS, make_bytes, run_i32x4_from_bits},
    {"i32x8_min", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_i32x8_min},
    {"i32x8_max", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_i32x8_max},
    {"i32x8_sign_bits", sizeof(struct lane_input), sizeof(unsigned), KERNEL_BITS, make_lanes,
     run_i32x8_sign_bits},
    {"i32x8_sign_bits_of_rows", sizeof(struct lane_input), sizeof(uint64_t), KERNEL_BITS, make_lanes,
     run_i32x8_sign_bits_of_rows},
    {"count_bytes_of_rows", sizeof(struct lane_input), 2 * 8 * 11, KERNEL_BITS, make_lanes,
     run_count_bytes_of_rows},
    {"i32x8_load_bytes", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_i32x8_load_bytes},
    {"i32x8_to_bytes", sizeof(struct lane_input), sizeof(uint64_t), KERNEL_BITS, make_bytes,
     run_i32x8_to_bytes},
    {"i32x8_power2", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_exponents, run_i32x8_power2},
    {"i32x8_from_bits", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_bytes, run_i32x8_from_bits},
    {"f64x4_less", sizeof(struct lane_input), DOUBLES / 2, KERNEL_BITS, make_lanes, run_f64x4_less},
    {"f64x4_min_max", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_f64x4_min_max},
    {"f64x4_select", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_f64x4_select},
    {"f64x4_from_i32x4", sizeof(struct lane_input), DOUBLES / 2, KERNEL_BITS, make_lanes,
     run_f64x4_from_i32x4},
    {"f64x8_from_f32x8", sizeof(struct lane_input), DOUBLES, KERNEL_DOUBLES, make_lanes,
     run_f64x8_from_f32x8},
    {"f64x8_from_i32x8", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_f64x8_from_i32x8},
    {"f64x8_operators", sizeof(struct lane_input), DOUBLES, KERNEL_DOUBLES, make_lanes, run_f64x8_operators},
    {"f32x8_from_f64x8", sizeof(struct lane_input), WORDS, KERNEL_FLOATS, make_lanes, run_f32x8_from_f64x8},
    {"i32x8_round_f64x8", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_roundable,
     run_i32x8_round_f64x8},
    {"f64x8_clamp", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_f64x8_clamp},
};

const struct kernel_folder RHW_ISA_NAME(check_simd) = {"simd", checks, sizeof checks / sizeof *checks};
