// SPDX-License-Identifier: MIT
// The wrappers of simd_layout.h; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "base/simd_layout.h"

#include "kernel_folders.h"

enum { TABLE_WORDS = 256 };

// What wrappers are given: 8 lanes of everything, of which each reads what it takes.
struct layout_input {
    float f[8][8];
    int32_t a[8], b[8];
    uint32_t at[8];
    int32_t words[TABLE_WORDS];
};

static void make_floats(struct kernel_random *random, void *input)
{
    struct layout_input *const lanes = input;
    random_floats(random, lanes->f[0], 64);
}

// Below 2^31, and no NaN.
static void make_small_floats(struct kernel_random *random, void *input)
{
    struct layout_input *const lanes = input;
    for (int i = 0; i < 64; i++) {
        const float value = random_float(random);
        lanes->f[i / 8][i % 8] = value < 0x1p31f ? value : 127.5f;
    }
}

static void make_ints(struct kernel_random *random, void *input)
{
    struct layout_input *const lanes = input;
    random_ints(random, lanes->a, 8, INT32_MIN, INT32_MAX);
    random_ints(random, lanes->b, 8, INT32_MIN, INT32_MAX);
    if (random_one_in(random, 2)) {
        memset(random_one_in(random, 2) ? lanes->a : lanes->b, 0, sizeof lanes->a);
    }
}

static int32_t pair_of_halves(struct kernel_random *random, int32_t low, int32_t high)
{
    const uint32_t lower = (uint16_t)random_int(random, low, high);
    return (int32_t)(lower | (uint32_t)random_int(random, low, high) << 16);
}

// Halves of 16 bits: of `b` none is negative.
static void make_factors(struct kernel_random *random, void *input)
{
    struct layout_input *const lanes = input;
    for (int i = 0; i < 8; i++) {
        lanes->a[i] = pair_of_halves(random, INT16_MIN, INT16_MAX);
        lanes->b[i] = pair_of_halves(random, 0, INT16_MAX);
    }
}

// Nor of `a`.
static void make_counts(struct kernel_random *random, void *input)
{
    struct layout_input *const lanes = input;
    make_factors(random, input);
    for (int i = 0; i < 8; i++) {
        lanes->a[i] &= 0x7fff7fff;
    }
}

static void make_halves(struct kernel_random *random, void *input)
{
    struct layout_input *const lanes = input;
    random_ints(random, lanes->a, 8, 0, UINT16_MAX);
}

// Numbers of words of the table, of which the next one can be read too.
static void make_table(struct kernel_random *random, void *input)
{
    struct layout_input *const lanes = input;
    make_ints(random, input);
    random_ints(random, lanes->words, TABLE_WORDS, INT32_MIN, INT32_MAX);
    for (int i = 0; i < 8; i++) {
        lanes->at[i] = (uint32_t)random_int(random, 0, TABLE_WORDS - 2);
    }
}

static i32x8 lanes_a(const struct layout_input *lanes)
{
    return i32x8_load(lanes->a);
}

static i32x8 lanes_b(const struct layout_input *lanes)
{
    return i32x8_load(lanes->b);
}

static void run_f32x4_transpose(const void *input, void *result)
{
    f32x4 rows[4];
    memcpy(rows, input, sizeof rows);
    f32x4_transpose(rows);
    memcpy(result, rows, sizeof rows);
}

static void run_f32x4_columns(const void *input, void *result)
{
    f32x4 rows[8];
    f32x8 columns[4];
    memcpy(rows, input, sizeof rows);
    f32x4_columns(rows, columns);
    memcpy(result, columns, sizeof columns);
}

static void run_f32x8_columns(const void *input, void *result)
{
    f32x8 rows[4], columns[4];
    memcpy(rows, input, sizeof rows);
    f32x8_columns(rows, columns);
    memcpy(result, columns, sizeof columns);
}

static void run_f32x8_join(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    const f32x8 a = f32x8_load(lanes->f[0]), b = f32x8_load(lanes->f[1]);
    const f32x8 joined[2] = {f32x8_join_low(a, b), f32x8_join_high(a, b)};
    memcpy(result, joined, sizeof joined);
}

static void run_f32x8_spread(const void *input, void *result)
{
    f32x8 spread[4];
    f32x8_spread(f32x8_load(input), spread);
    memcpy(result, spread, sizeof spread);
}

static void run_f32x4_rows(const void *input, void *result)
{
    f32x4 rows[8];
    f32x8 columns[4];
    memcpy(columns, input, sizeof columns);
    f32x4_rows(columns, rows);
    memcpy(result, rows, sizeof rows);
}

static void run_f32x8_load_columns(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    const void *places[8];
    f32x8 columns[4];
    for (int i = 0; i < 8; i++) {
        places[i] = &lanes->f[7 - i][i % 5];
    }
    f32x8_load_columns(places, columns);
    memcpy(result, columns, sizeof columns);
}

static void run_f64x4_transpose(const void *input, void *result)
{
    f64x4 m[4];
    memcpy(m, input, sizeof m);
    f64x4_transpose(m);
    memcpy(result, m, sizeof m);
}

static void run_f32x8_transpose(const void *input, void *result)
{
    f32x8 m[8];
    memcpy(m, input, sizeof m);
    f32x8_transpose(m);
    memcpy(result, m, sizeof m);
}

static void run_i32x8_bytes_from_small_f32x8(const void *input, void *result)
{
    f32x8 channels[4];
    memcpy(channels, input, sizeof channels);
    i32x8_store(result, i32x8_bytes_from_small_f32x8(channels));
}

static void run_i32x8_bytes_from_f32x8(const void *input, void *result)
{
    f32x8 channels[4];
    memcpy(channels, input, sizeof channels);
    i32x8_store(result, i32x8_bytes_from_f32x8(channels));
}

static void run_f32x8_from_half(const void *input, void *result)
{
    f32x8_store(result, f32x8_from_half(lanes_a(input)));
}

static void run_f32x8_from_halves(const void *input, void *result)
{
    i32x4 halves;
    memcpy(&halves, input, sizeof halves);
    f32x8_store(result, f32x8_from_halves(halves));
}

static void run_i32x8_half_from_f32x8(const void *input, void *result)
{
    i32x8_store(result, i32x8_half_from_f32x8(f32x8_load(input)));
}

static void run_i16x16_scale(const void *input, void *result)
{
    const i16x16 product = i16x16_scale((i16x16)lanes_a(input), (i16x16)lanes_b(input));
    memcpy(result, &product, sizeof product);
}

static void run_i32x8_dot_halves(const void *input, void *result)
{
    i32x8_store(result, i32x8_dot_halves(lanes_a(input), lanes_b(input)));
}

static void run_i32x8_halve_lower(const void *input, void *result)
{
    i32x8_store(result, i32x8_halve_lower(lanes_a(input)));
}

static void run_i32x8_join_upper(const void *input, void *result)
{
    i32x8_store(result, i32x8_join_upper(lanes_a(input), lanes_b(input)));
}

static void run_i32x8_over_halves(const void *input, void *result)
{
    i32x8_store(result, i32x8_over_halves(lanes_a(input), lanes_b(input)));
}

static void run_i32x8_any(const void *input, void *result)
{
    const unsigned char any[2] = {i32x8_any_bit(lanes_a(input)),
                                  i32x8_any_of(lanes_a(input), lanes_b(input))};
    memcpy(result, any, sizeof any);
}

// Where I8_WIDENS_NEGATED says so, halves have the other sign.
static void run_i32x8_widen(const void *input, void *result)
{
    const i16x16 sign = (i16x16)i32x8_splat(I8_WIDENS_NEGATED ? -1 : 0x00010001);
    const i16x16 wide[2] = {(i16x16)i32x8_widen_lower(lanes_a(input)) * sign,
                            (i16x16)i32x8_widen_upper(lanes_a(input)) * sign};
    memcpy(result, wide, sizeof wide);
}

static void run_i32x8_permute(const void *input, void *result)
{
    i32x8_store(result, i32x8_permute(lanes_a(input), lanes_b(input)));
}

static void run_i32x8_permute_two(const void *input, void *result)
{
    i32x8_store(result, i32x8_permute_two(lanes_a(input), lanes_b(input), lanes_b(input) & 15));
}

static void run_i32x8_splat_ends(const void *input, void *result)
{
    const i32x8 ends[2] = {i32x8_splat_first(lanes_a(input)), i32x8_splat_last(lanes_a(input))};
    memcpy(result, ends, sizeof ends);
}

static void run_i32x8_gather(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    i32x8_store(result, i32x8_gather(lanes->words, i32x8_load(lanes->at)));
}

static void run_i32x8_look_up(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    i32x8_store(result, i32x8_look_up(lanes->words, i32x8_load(lanes->at)));
}

static void run_i32x8_load_pairs(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    i32x8 pair[2];
    i32x8_load_pairs((const unsigned char *)lanes->words, lanes->at, &pair[0], &pair[1]);
    memcpy(result, pair, sizeof pair);
}

enum { WORDS = 8 * 4 }; // bytes of 8 lanes

static const struct kernel_check checks[] = {
    {"f32x4_transpose", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_floats,
     run_f32x4_transpose},
    {"f32x4_columns", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats, run_f32x4_columns},
    {"f32x8_columns", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats, run_f32x8_columns},
    {"f32x8_join", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_floats, run_f32x8_join},
    {"f32x8_spread", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats, run_f32x8_spread},
    {"f32x4_rows", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats, run_f32x4_rows},
    {"f32x8_load_columns", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats,
     run_f32x8_load_columns},
    {"f64x4_transpose", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats,
     run_f64x4_transpose},
    {"f32x8_transpose", sizeof(struct layout_input), 8 * WORDS, KERNEL_BITS, make_floats,
     run_f32x8_transpose},
    {"i32x8_bytes_from_small_f32x8", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_small_floats,
     run_i32x8_bytes_from_small_f32x8},
    {"i32x8_bytes_from_f32x8", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_floats,
     run_i32x8_bytes_from_f32x8},
    {"f32x8_from_half", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_halves, run_f32x8_from_half},
    {"f32x8_from_halves", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_f32x8_from_halves},
    {"i32x8_half_from_f32x8", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_floats,
     run_i32x8_half_from_f32x8},
    {"i16x16_scale", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_factors, run_i16x16_scale},
    {"i32x8_dot_halves", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_counts, run_i32x8_dot_halves},
    {"i32x8_halve_lower", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i32x8_halve_lower},
    {"i32x8_join_upper", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i32x8_join_upper},
    {"i32x8_over_halves", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i32x8_over_halves},
    {"i32x8_any", sizeof(struct layout_input), 2, KERNEL_BITS, make_ints, run_i32x8_any},
    {"i32x8_widen", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_ints, run_i32x8_widen},
    {"i32x8_permute", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i32x8_permute},
    {"i32x8_permute_two", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i32x8_permute_two},
    {"i32x8_splat_ends", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_ints,
     run_i32x8_splat_ends},
    {"i32x8_gather", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_table, run_i32x8_gather},
    {"i32x8_look_up", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_table, run_i32x8_look_up},
    {"i32x8_load_pairs", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_table,
     run_i32x8_load_pairs},
};

const struct kernel_folder RHW_ISA_NAME(check_simd_layout) = {"simd_layout", checks,
                                                              sizeof checks / sizeof *checks};
