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

static i8 lanes_a(const struct layout_input *lanes)
{
    return i8_load(lanes->a);
}

static i8 lanes_b(const struct layout_input *lanes)
{
    return i8_load(lanes->b);
}

static void run_f4_transpose(const void *input, void *result)
{
    f4 rows[4];
    memcpy(rows, input, sizeof rows);
    f4_transpose(rows);
    memcpy(result, rows, sizeof rows);
}

static void run_f4_columns(const void *input, void *result)
{
    f4 rows[8];
    f8 columns[4];
    memcpy(rows, input, sizeof rows);
    f4_columns(rows, columns);
    memcpy(result, columns, sizeof columns);
}

static void run_f4_rows(const void *input, void *result)
{
    f4 rows[8];
    f8 columns[4];
    memcpy(columns, input, sizeof columns);
    f4_rows(columns, rows);
    memcpy(result, rows, sizeof rows);
}

static void run_f8_load_columns(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    const void *places[8];
    f8 columns[4];
    for (int i = 0; i < 8; i++) {
        places[i] = &lanes->f[7 - i][i % 5];
    }
    f8_load_columns(places, columns);
    memcpy(result, columns, sizeof columns);
}

static void run_d4_transpose(const void *input, void *result)
{
    d4 m[4];
    memcpy(m, input, sizeof m);
    d4_transpose(m);
    memcpy(result, m, sizeof m);
}

static void run_f8_transpose(const void *input, void *result)
{
    f8 m[8];
    memcpy(m, input, sizeof m);
    f8_transpose(m);
    memcpy(result, m, sizeof m);
}

static void run_i8_bytes_from_small_f8(const void *input, void *result)
{
    f8 channels[4];
    memcpy(channels, input, sizeof channels);
    i8_store(result, i8_bytes_from_small_f8(channels));
}

static void run_i8_bytes_from_f8(const void *input, void *result)
{
    f8 channels[4];
    memcpy(channels, input, sizeof channels);
    i8_store(result, i8_bytes_from_f8(channels));
}

static void run_f8_from_half(const void *input, void *result)
{
    f8_store(result, f8_from_half(lanes_a(input)));
}

static void run_f8_from_halves(const void *input, void *result)
{
    i4 halves;
    memcpy(&halves, input, sizeof halves);
    f8_store(result, f8_from_halves(halves));
}

static void run_i8_half_from_f8(const void *input, void *result)
{
    i8_store(result, i8_half_from_f8(f8_load(input)));
}

static void run_s16_scale(const void *input, void *result)
{
    const s16 product = s16_scale((s16)lanes_a(input), (s16)lanes_b(input));
    memcpy(result, &product, sizeof product);
}

static void run_i8_dot_halves(const void *input, void *result)
{
    i8_store(result, i8_dot_halves(lanes_a(input), lanes_b(input)));
}

static void run_i8_halve_lower(const void *input, void *result)
{
    i8_store(result, i8_halve_lower(lanes_a(input)));
}

static void run_i8_join_upper(const void *input, void *result)
{
    i8_store(result, i8_join_upper(lanes_a(input), lanes_b(input)));
}

static void run_i8_over_halves(const void *input, void *result)
{
    i8_store(result, i8_over_halves(lanes_a(input), lanes_b(input)));
}

static void run_i8_any(const void *input, void *result)
{
    const unsigned char any[2] = {i8_any_bit(lanes_a(input)), i8_any_of(lanes_a(input), lanes_b(input))};
    memcpy(result, any, sizeof any);
}

// Where I8_WIDENS_NEGATED says so, halves have the other sign.
static void run_i8_widen(const void *input, void *result)
{
    const s16 sign = (s16)i8_splat(I8_WIDENS_NEGATED ? -1 : 0x00010001);
    const s16 wide[2] = {(s16)i8_widen_lower(lanes_a(input)) * sign,
                         (s16)i8_widen_upper(lanes_a(input)) * sign};
    memcpy(result, wide, sizeof wide);
}

static void run_i8_permute(const void *input, void *result)
{
    i8_store(result, i8_permute(lanes_a(input), lanes_b(input)));
}

static void run_i8_splat_ends(const void *input, void *result)
{
    const i8 ends[2] = {i8_splat_first(lanes_a(input)), i8_splat_last(lanes_a(input))};
    memcpy(result, ends, sizeof ends);
}

static void run_i8_gather(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    i8_store(result, i8_gather(lanes->words, i8_load(lanes->at)));
}

static void run_i8_load_pairs(const void *input, void *result)
{
    const struct layout_input *const lanes = input;
    i8 pair[2];
    i8_load_pairs((const unsigned char *)lanes->words, lanes->at, &pair[0], &pair[1]);
    memcpy(result, pair, sizeof pair);
}

enum { WORDS = 8 * 4 }; // bytes of 8 lanes

static const struct kernel_check checks[] = {
    {"f4_transpose", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_floats, run_f4_transpose},
    {"f4_columns", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats, run_f4_columns},
    {"f4_rows", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats, run_f4_rows},
    {"f8_load_columns", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats,
     run_f8_load_columns},
    {"d4_transpose", sizeof(struct layout_input), 4 * WORDS, KERNEL_BITS, make_floats, run_d4_transpose},
    {"f8_transpose", sizeof(struct layout_input), 8 * WORDS, KERNEL_BITS, make_floats, run_f8_transpose},
    {"i8_bytes_from_small_f8", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_small_floats,
     run_i8_bytes_from_small_f8},
    {"i8_bytes_from_f8", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_floats, run_i8_bytes_from_f8},
    {"f8_from_half", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_halves, run_f8_from_half},
    {"f8_from_halves", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_f8_from_halves},
    {"i8_half_from_f8", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_floats, run_i8_half_from_f8},
    {"s16_scale", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_factors, run_s16_scale},
    {"i8_dot_halves", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_counts, run_i8_dot_halves},
    {"i8_halve_lower", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i8_halve_lower},
    {"i8_join_upper", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i8_join_upper},
    {"i8_over_halves", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i8_over_halves},
    {"i8_any", sizeof(struct layout_input), 2, KERNEL_BITS, make_ints, run_i8_any},
    {"i8_widen", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_ints, run_i8_widen},
    {"i8_permute", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_ints, run_i8_permute},
    {"i8_splat_ends", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_ints, run_i8_splat_ends},
    {"i8_gather", sizeof(struct layout_input), WORDS, KERNEL_BITS, make_table, run_i8_gather},
    {"i8_load_pairs", sizeof(struct layout_input), 2 * WORDS, KERNEL_BITS, make_table, run_i8_load_pairs},
};

const struct kernel_folder RHW_ISA_NAME(check_simd_layout) = {"simd_layout", checks,
                                                              sizeof checks / sizeof *checks};
