// SPDX-License-Identifier: MIT
// Kernel checks of words that translated shaders read from buffers (rhw/shader_spirv.h); compiled with RHW_ISA_SUFFIX =
// baseline, avx2, ...
#include "rhw/shader_spirv.h"

#include "kernel_folders.h"

enum { COUNT = 64 };

struct words_input {
    uint32_t words[COUNT];
    int32_t index[8], mask[8];
    uint32_t count;
};

// Rows, one word for all lanes, or any words; some of them lie outside.
static void make_words(struct kernel_random *random, void *input)
{
    struct words_input *const in = input;
    const int32_t first = (int32_t)random_int(random, -9, COUNT + 9);
    const int32_t step = random_one_in(random, 2) ? 1 : (int32_t)random_int(random, -1, 3);
    const bool is_any = random_one_in(random, 4);
    random_ints(random, (int32_t *)in->words, COUNT, INT32_MIN, INT32_MAX);
    for (int lane = 0; lane < 8; lane++) {
        in->index[lane] = is_any ? (int32_t)random_int(random, -3, COUNT + 3) : first + lane * step;
        in->index[lane] = random_one_in(random, 64) ? INT32_MAX : in->index[lane];
        in->mask[lane] = random_one_in(random, 4) ? 0 : -1;
    }
    in->count = (uint32_t)random_int(random, 0, COUNT);
}

static void run_load(const void *input, void *result)
{
    const struct words_input *const in = input;
    const struct rhw_spirv_words words = {in->count > 0 ? in->words : NULL, in->count};
    const rhw_int loaded[2] = {rhw_spirv_load(words, rhw_load_int(in->index), rhw_load_int(in->mask)),
                               rhw_spirv_gather(words, rhw_load_int(in->index))};
    memcpy(result, loaded, sizeof loaded);
}

static const struct kernel_check checks[] = {
    {"spirv_load", sizeof(struct words_input), 2 * sizeof(rhw_int), KERNEL_BITS, make_words, run_load},
};

const struct kernel_folder RHW_ISA_NAME(check_words) = {"words", checks, sizeof checks / sizeof *checks};
