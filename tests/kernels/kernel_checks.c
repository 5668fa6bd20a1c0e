// SPDX-License-Identifier: MIT
// Compares the kernels of every instruction set that this machine runs with the baseline's, function by function, and
// times them: see kernel_check.h. usage: kernel_checks [quick] [--count N] [--seed N] [NAME...]
//   quick      10,000 inputs for each function, as ctest asks for; without it 1,000,000
//   --count N  this many; of functions whose result is large, fewer (inputs_of)
//   --seed N   the first of them; a difference is reported with its seed, and --count 1 --seed that one shows it again
//              with the bytes of its input
//   NAME       functions, or folders, to check; the beginning of FOLDER/FUNCTION stands for all of them
// Prints nanoseconds per call, wrapper and call included; exit status 1 when something differs.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "kernel_folders.h"
#include "rhw/rhw.h"

enum { GUARD = 64, TIMED_INPUTS = 64, TAKES = 5 };

static const struct kernel_folders *const folders_by_isa[RHW_ISA_COUNT] = RHW_ISA_TABLE(&kernel_folders);

// NULL where this build or this machine does not have it.
static const struct kernel_folder *const *folders_of(enum rhw_isa isa)
{
    return folders_by_isa[isa] && rhw_isa_supported(isa) ? folders_by_isa[isa]->folders : NULL;
}

// One function, as every instruction set has it.
struct subject {
    char name[96];                                   // FOLDER/FUNCTION
    const struct kernel_check *check[RHW_ISA_COUNT]; // NULL: not here
};

struct options {
    uint64_t seed, count;
    char *const *names;
    int name_count;
};

static void *allocate(size_t size)
{
    const size_t whole = (size + KERNEL_ALIGNMENT - 1) / KERNEL_ALIGNMENT * KERNEL_ALIGNMENT;
    void *const memory = aligned_alloc(KERNEL_ALIGNMENT, whole);
    if (!memory) {
        fprintf(stderr, "kernel_checks: out of memory\n");
        exit(2);
    }
    return memory;
}

// Comparing -----------------------------------------------------------------------------------------

static bool is_nan_float(const unsigned char *bytes)
{
    float value;
    memcpy(&value, bytes, sizeof value);
    return value != value;
}

static bool is_nan_double(const unsigned char *bytes)
{
    double value;
    memcpy(&value, bytes, sizeof value);
    return value != value;
}

// Where two results differ first; `size` when they do not.
static size_t difference(enum kernel_result kind, const unsigned char *a, const unsigned char *b, size_t size)
{
    const size_t step = kind == KERNEL_DOUBLES ? sizeof(double) : kind == KERNEL_FLOATS ? sizeof(float) : 1;
    for (size_t i = 0; i < size; i += step) {
        const size_t length = size - i < step ? size - i : step;
        const bool both_nan = (kind == KERNEL_FLOATS && is_nan_float(a + i) && is_nan_float(b + i)) ||
                              (kind == KERNEL_DOUBLES && is_nan_double(a + i) && is_nan_double(b + i));
        if (!both_nan && memcmp(a + i, b + i, length) != 0) {
            return i;
        }
    }
    return size;
}

enum { ROW = 32 }; // bytes of a printed line

static void print_bytes(const char *title, const unsigned char *bytes, size_t first, size_t end)
{
    for (size_t row = first; row < end; row += ROW) {
        printf("  %-8s %5zu:", title, row);
        for (size_t i = row; i < end && i < row + ROW; i++) {
            printf("%s%02x", i % 4 == 0 ? " " : "", bytes[i]);
        }
        printf("\n");
    }
}

static void run(const struct kernel_check *check, const void *input, unsigned char *result)
{
    memset(result, 0xa5, check->result_size + GUARD);
    check->run(input, result);
}

static bool wrote_behind(const unsigned char *result, size_t size)
{
    for (size_t i = size; i < size + GUARD; i++) {
        if (result[i] != 0xa5) {
            return true;
        }
    }
    return false;
}

static void make_input(const struct kernel_check *check, const struct subject *subject, uint64_t seed,
                       void *input)
{
    struct kernel_random random = kernel_random_start(subject->name, seed);
    memset(input, 0, check->input_size);
    check->make(&random, input);
}

// Whether both halves of a result are the same; says where not.
static bool same_halves(const struct subject *subject, const char *isa, uint64_t seed,
                        const unsigned char *result)
{
    const size_t half = subject->check[RHW_ISA_BASELINE]->result_size / 2;
    const size_t at = difference(KERNEL_BITS, result, result + half, half);
    if (at == half) {
        return true;
    }
    printf("%s: the two ways of %s differ at byte %zu of %zu, seed %" PRIu64 "\n", subject->name, isa, at,
           half, seed);
    const size_t row = at / ROW * ROW, end = row + ROW < half ? row + ROW : half;
    print_bytes("one way", result, row, end);
    print_bytes("other", result + half, row, end);
    return false;
}

// Compares one input; says what differs.
static bool same(const struct subject *subject, uint64_t seed, const void *input, unsigned char *expected,
                 unsigned char *result)
{
    const struct kernel_check *const baseline = subject->check[RHW_ISA_BASELINE];
    bool all_same = true;
    run(baseline, input, expected);
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        if (!subject->check[isa]) {
            continue;
        }
        run(subject->check[isa], input, result);
        if (wrote_behind(result, baseline->result_size)) {
            printf("%s: %s writes behind its result, seed %" PRIu64 "\n", subject->name,
                   rhw_isa_name((enum rhw_isa)isa), seed);
            all_same = false;
        }
        const size_t at = difference(baseline->result, expected, result, baseline->result_size);
        if (at < baseline->result_size) {
            printf("%s: %s differs from the baseline at byte %zu of %zu, seed %" PRIu64 "\n", subject->name,
                   rhw_isa_name((enum rhw_isa)isa), at, baseline->result_size, seed);
            const size_t row = at / ROW * ROW;
            const size_t end = row + ROW < baseline->result_size ? row + ROW : baseline->result_size;
            print_bytes("baseline", expected, row, end);
            print_bytes("differs", result, row, end);
            all_same = false;
        }
        if (baseline->result == KERNEL_HALVES) {
            all_same &= same_halves(subject, rhw_isa_name((enum rhw_isa)isa), seed, result);
        }
    }
    return all_same;
}

// What fills many pages takes long: of it there are fewer inputs.
static uint64_t inputs_of(const struct kernel_check *check, uint64_t count)
{
    enum { PAGES = 16384 };
    return (count + check->result_size / PAGES) / (1 + check->result_size / PAGES);
}

static bool compare(const struct subject *subject, const struct options *options)
{
    const struct kernel_check *const baseline = subject->check[RHW_ISA_BASELINE];
    void *const input = allocate(baseline->input_size);
    unsigned char *const expected = allocate(baseline->result_size + GUARD);
    unsigned char *const result = allocate(baseline->result_size + GUARD);
    bool all_same = true;
    const uint64_t count = inputs_of(baseline, options->count);
    for (uint64_t i = 0; all_same && i < count; i++) {
        make_input(baseline, subject, options->seed + i, input);
        all_same = same(subject, options->seed + i, input, expected, result);
    }
    if (options->count == 1) {
        print_bytes("input", input, 0, baseline->input_size);
        print_bytes("result", expected, 0, baseline->result_size);
    }
    free(result);
    free(expected);
    free(input);
    return all_same;
}

// Timing --------------------------------------------------------------------------------------------

static double now_ns(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e9 + (double)time.tv_nsec;
}

// The least of a few takes, each over the same inputs.
static double nanoseconds(const struct kernel_check *check, const unsigned char *inputs, size_t stride,
                          void *result)
{
    double least = 1e30;
    for (int take = 0; take < TAKES; take++) {
        const double start = now_ns();
        for (int i = 0; i < TIMED_INPUTS; i++) {
            check->run(inputs + (size_t)i * stride, result);
        }
        const double each = (now_ns() - start) / TIMED_INPUTS;
        least = each < least ? each : least;
    }
    return least;
}

static void print_times(const struct subject *subject, const struct options *options)
{
    const struct kernel_check *const baseline = subject->check[RHW_ISA_BASELINE];
    const size_t stride = (baseline->input_size + KERNEL_ALIGNMENT - 1) / KERNEL_ALIGNMENT * KERNEL_ALIGNMENT;
    unsigned char *const inputs = allocate(stride * TIMED_INPUTS);
    void *const result = allocate(baseline->result_size);
    for (int i = 0; i < TIMED_INPUTS; i++) {
        make_input(baseline, subject, options->seed + (uint64_t)i, inputs + (size_t)i * stride);
    }
    printf("%-36s", subject->name);
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        if (subject->check[isa]) {
            printf(" %9.1f", nanoseconds(subject->check[isa], inputs, stride, result));
        }
    }
    printf("\n");
    free(result);
    free(inputs);
}

// All of them ---------------------------------------------------------------------------------------

static bool is_wanted(const struct subject *subject, const struct options *options)
{
    for (int i = 0; i < options->name_count; i++) {
        if (strncmp(subject->name, options->names[i], strlen(options->names[i])) == 0) {
            return true;
        }
    }
    return options->name_count == 0;
}

static struct subject find_subject(int folder, int number)
{
    struct subject subject;
    const struct kernel_folder *const first = folders_of(RHW_ISA_BASELINE)[folder];
    snprintf(subject.name, sizeof subject.name, "%s/%s", first->name, first->checks[number].name);
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        const struct kernel_folder *const *const folders = folders_of((enum rhw_isa)isa);
        subject.check[isa] = folders ? &folders[folder]->checks[number] : NULL;
    }
    return subject;
}

static int check_all(const struct options *options)
{
    int checked = 0, failed = 0;
    printf("%-36s", "ns per call");
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        if (folders_of((enum rhw_isa)isa)) {
            printf(" %9s", rhw_isa_name((enum rhw_isa)isa));
        }
    }
    printf("\n");
    for (int folder = 0; folders_of(RHW_ISA_BASELINE)[folder]; folder++) {
        for (int number = 0; number < folders_of(RHW_ISA_BASELINE)[folder]->count; number++) {
            const struct subject subject = find_subject(folder, number);
            if (!is_wanted(&subject, options)) {
                continue;
            }
            checked++;
            if (compare(&subject, options)) {
                print_times(&subject, options);
            } else {
                failed++;
            }
        }
    }
    printf("%d functions, %" PRIu64 " inputs each at most: %d differ\n", checked, options->count, failed);
    return failed || checked == 0;
}

// A number behind an option.
static uint64_t number_of(const char *text)
{
    char *end;
    const unsigned long long number = text ? strtoull(text, &end, 0) : 0;
    if (!text || *text == '\0' || *end != '\0') {
        fprintf(stderr, "usage: kernel_checks [quick] [--count N] [--seed N] [NAME...]\n");
        exit(2);
    }
    return number;
}

int main(int argc, char **argv)
{
    struct options options = {.count = 1000000};
    int i = 1;
    for (; i < argc; i++) {
        if (strcmp(argv[i], "quick") == 0) {
            options.count = 10000;
        } else if (strcmp(argv[i], "--count") == 0) {
            options.count = number_of(argv[++i]);
        } else if (strcmp(argv[i], "--seed") == 0) {
            options.seed = number_of(argv[++i]);
        } else {
            break;
        }
    }
    options.names = argv + i;
    options.name_count = argc - i;
    return check_all(&options);
}
