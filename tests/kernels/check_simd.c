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

static i8 ints(const struct lane_input *lanes, int which)
{
    return i8_load(lanes->i[which]);
}

static f8 floats(const struct lane_input *lanes, int which)
{
    return f8_load(lanes->f[which]);
}

static d8 doubles(const struct lane_input *lanes, int which)
{
    d8 v;
    memcpy(&v, lanes->d[which], sizeof v);
    return v;
}

static void store_doubles(void *result, d8 v)
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

static void run_f8_min(const void *input, void *result)
{
    f8_store(result, f8_min(floats(input, 0), floats(input, 1)));
}

static void run_f8_max(const void *input, void *result)
{
    f8_store(result, f8_max(floats(input, 0), floats(input, 1)));
}

static void run_f8_select(const void *input, void *result)
{
    f8_store(result, f8_select(ints(input, 0), floats(input, 0), floats(input, 1)));
}

static f4 floats4(const struct lane_input *lanes, int which)
{
    f4 v;
    memcpy(&v, lanes->f[which], sizeof v);
    return v;
}

static void run_f4_select(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const f4 selected = f4_select(i4_load(lanes->i[0]), floats4(input, 0), floats4(input, 1));
    memcpy(result, &selected, sizeof selected);
}

static void run_i4_sign_bits(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const unsigned bits = i4_sign_bits(i4_load(lanes->i[0]));
    memcpy(result, &bits, sizeof bits);
}

static void run_i4_from_bits(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const i4 mask = i4_from_bits((unsigned)lanes->i[0][0]);
    memcpy(result, &mask, sizeof mask);
}

static void run_f4_from_d4(const void *input, void *result)
{
    const f4 rounded = f4_from_d4(doubles(input, 0).lo);
    memcpy(result, &rounded, sizeof rounded);
}

static void run_i8_min(const void *input, void *result)
{
    i8_store(result, i8_min(ints(input, 0), ints(input, 1)));
}

static void run_i8_max(const void *input, void *result)
{
    i8_store(result, i8_max(ints(input, 0), ints(input, 1)));
}

static void run_i8_sign_bits(const void *input, void *result)
{
    const unsigned bits = i8_sign_bits(ints(input, 0));
    memcpy(result, &bits, sizeof bits);
}

static void run_i8_sign_bits_of_rows(const void *input, void *result)
{
    i8 row[8];
    for (int i = 0; i < 8; i++) {
        row[i] = ints(input, i % 2) ^ i8_splat((int32_t)(0x96696996u << i)); // every row its own signs
    }
    const uint64_t bits = i8_sign_bits_of_rows(row);
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

static void run_i8_load_bytes(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    i8_store(result, i8_load_bytes((const uint8_t *)lanes->i[0]));
}

static void run_i8_to_bytes(const void *input, void *result)
{
    const uint64_t bytes = i8_to_bytes(ints(input, 0));
    memcpy(result, &bytes, sizeof bytes);
}

static void run_i8_power2(const void *input, void *result)
{
    i8_store(result, i8_power2(ints(input, 0)));
}

static void run_i8_from_bits(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    i8_store(result, i8_from_bits((unsigned)lanes->i[0][0]));
}

static void run_d4_less(const void *input, void *result)
{
    const l4 less = d4_less(doubles(input, 0).lo, doubles(input, 1).lo);
    memcpy(result, &less, sizeof less);
}

static void run_d4_min_max(const void *input, void *result)
{
    const d8 a = doubles(input, 0), b = doubles(input, 1);
    store_doubles(result, (d8){d4_min(a.lo, b.lo), d4_max(a.lo, b.lo)});
}

static void run_d4_select(const void *input, void *result)
{
    const d8 a = doubles(input, 0), b = doubles(input, 1);
    const l4 mask = d4_less(a.hi, b.hi);
    store_doubles(result, (d8){d4_select(mask, a.lo, b.lo), d4_keep(d4_abs(a.lo), mask)});
}

static void run_d4_from_i4(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    const d4 wide = d4_from_i4(i4_load(lanes->i[0]));
    memcpy(result, &wide, sizeof wide);
}

static void run_d8_from_f8(const void *input, void *result)
{
    store_doubles(result, d8_from_f8(floats(input, 0)));
}

static void run_d8_from_i8(const void *input, void *result)
{
    store_doubles(result, d8_from_i8(ints(input, 0)));
}

static void run_d8_operators(const void *input, void *result)
{
    const d8 a = doubles(input, 0), b = doubles(input, 1);
    store_doubles(result, d8_div(d8_sub(a, d8_mul(a, b)), d8_add(d8_splat(3.0), b)));
}

static void run_f8_from_d8(const void *input, void *result)
{
    f8_store(result, f8_from_d8(doubles(input, 0)));
}

static void run_i8_round_d8(const void *input, void *result)
{
    i8_store(result, i8_round_d8(doubles(input, 0)));
}

static void run_d8_clamp(const void *input, void *result)
{
    const struct lane_input *const lanes = input;
    store_doubles(result, d8_clamp(doubles(input, 0), 0.0, __builtin_fabs((double)lanes->i[0][0])));
}

enum { WORDS = 8 * 4, DOUBLES = 8 * 8 }; // bytes of 8 lanes

static const struct kernel_check checks[] = {
    {"f8_min", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_f8_min},
    {"f8_max", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_f8_max},
    {"f8_select", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_mask, run_f8_select},
    {"f4_select", sizeof(struct lane_input), WORDS / 2, KERNEL_BITS, make_mask, run_f4_select},
    {"f4_from_d4", sizeof(struct lane_input), WORDS / 2, KERNEL_FLOATS, make_lanes, run_f4_from_d4},
    {"i4_sign_bits", sizeof(struct lane_input), sizeof(unsigned), KERNEL_BITS, make_lanes, run_i4_sign_bits},
    {"i4_from_bits", sizeof(struct lane_input), WORDS / 2, KERNEL_BITS, make_bytes, run_i4_from_bits},
    {"i8_min", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_i8_min},
    {"i8_max", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_i8_max},
    {"i8_sign_bits", sizeof(struct lane_input), sizeof(unsigned), KERNEL_BITS, make_lanes, run_i8_sign_bits},
    {"i8_sign_bits_of_rows", sizeof(struct lane_input), sizeof(uint64_t), KERNEL_BITS, make_lanes,
     run_i8_sign_bits_of_rows},
    {"count_bytes_of_rows", sizeof(struct lane_input), 2 * 8 * 11, KERNEL_BITS, make_lanes,
     run_count_bytes_of_rows},
    {"i8_load_bytes", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_lanes, run_i8_load_bytes},
    {"i8_to_bytes", sizeof(struct lane_input), sizeof(uint64_t), KERNEL_BITS, make_bytes, run_i8_to_bytes},
    {"i8_power2", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_exponents, run_i8_power2},
    {"i8_from_bits", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_bytes, run_i8_from_bits},
    {"d4_less", sizeof(struct lane_input), DOUBLES / 2, KERNEL_BITS, make_lanes, run_d4_less},
    {"d4_min_max", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_d4_min_max},
    {"d4_select", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_d4_select},
    {"d4_from_i4", sizeof(struct lane_input), DOUBLES / 2, KERNEL_BITS, make_lanes, run_d4_from_i4},
    {"d8_from_f8", sizeof(struct lane_input), DOUBLES, KERNEL_DOUBLES, make_lanes, run_d8_from_f8},
    {"d8_from_i8", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_d8_from_i8},
    {"d8_operators", sizeof(struct lane_input), DOUBLES, KERNEL_DOUBLES, make_lanes, run_d8_operators},
    {"f8_from_d8", sizeof(struct lane_input), WORDS, KERNEL_FLOATS, make_lanes, run_f8_from_d8},
    {"i8_round_d8", sizeof(struct lane_input), WORDS, KERNEL_BITS, make_roundable, run_i8_round_d8},
    {"d8_clamp", sizeof(struct lane_input), DOUBLES, KERNEL_BITS, make_lanes, run_d8_clamp},
};

const struct kernel_folder RHW_ISA_NAME(check_simd) = {"simd", checks, sizeof checks / sizeof *checks};
