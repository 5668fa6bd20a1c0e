// SPDX-License-Identifier: MIT
// Every one of the 2^32 floats through every function of one argument that shaders have, a large stratified sample
// through those of two, on every instruction set this CPU has. Fails where an error is larger than the docstring states
// or where two instruction sets differ; writes the table of docs/exactness.md.
//
// The reference is the C library in double. A double carries 2^29 times the precision of a float, so an error of a few
// ULP there is below 10^-8 ULP here and cannot be seen in the table. That the library is so good is not assumed:
// MPFR with 60 bits checks one argument of 4096, and every worst case is measured again with MPFR.
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

#include "document.h"
#include "float_bits.h"
#include "math_reference.h"
#include "progress.h"
#include "random.h"

enum { BATCH = 4096, TASK = 1 << 20, MAX_JOBS = 64 };
enum { TASKS_OF_ONE = 4096, TASKS_OF_TWO = 1024 }; // 2^32 floats, 2^30 pairs

// Bit-equal to C, and measured with one argument.
static const struct plain_function {
    enum isa_function function;
    const char *name;
} plain_functions[] = {
    {ISA_FLOOR, "floor"}, {ISA_CEIL, "ceil"}, {ISA_TRUNC, "trunc"},       {ISA_ROUND, "round"},
    {ISA_FRACT, "fract"}, {ISA_SIGN, "sign"}, {ISA_SATURATE, "saturate"}, {ISA_TO_INT, "to_int"},
};
enum { PLAIN_FUNCTIONS = sizeof plain_functions / sizeof plain_functions[0] };

// Rows of the table, in order: of one argument, of two, plain.
enum {
    FIRST_OF_TWO = MATH_FUNCTIONS,
    FIRST_PLAIN = FIRST_OF_TWO + MATH_FUNCTIONS2,
    ROWS = FIRST_PLAIN + PLAIN_FUNCTIONS
};

static const double libm_tolerance = 1e-7; // ULP of float

struct row_result {
    uint64_t count;
    uint64_t nearest;    // results that are the correctly rounded ones
    double worst;        // ULP, against the C library
    float a, b, got;     // the worst
    uint64_t wrong_bits; // results that differ between instruction sets, or from C where that is promised
    float wrong_a, wrong_b;
    double libm_worst; // ULP of float: the C library against MPFR
};

struct worker {
    pthread_t thread;
    struct row_result rows[ROWS];
};

static struct worker workers[MAX_JOBS];
static atomic_int next_task, done_tasks;
static int end_task;                                         // one past the last
static const struct isa_templates *templates[RHW_ISA_COUNT]; // NULL where this CPU lacks it

// Bits of a NaN are unspecified, everything else is not.
static bool same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

// math_ulp_error with a truth that a double holds.
static double ulp_error(float got, double want)
{
    if (isnan(want) || isnan(got)) {
        return isnan(want) && isnan(got) ? 0 : (double)INFINITY;
    }
    if (want == 0 || isinf(want)) {
        return (double)got == want && !signbit(got) == !signbit(want) ? 0 : (double)INFINITY;
    }
    if (isinf(got) && got == (float)want) {
        return 0;
    }
    uint64_t bits;
    memcpy(&bits, &want, sizeof bits);
    const int exponent = (int)(bits >> 52 & 0x7ff) - 1023, lowest = exponent < -126 ? -126 : exponent;
    const uint64_t per_ulp_bits = (uint64_t)(1023 + 23 - lowest) << 52; // 2^(23 - exponent)
    double per_ulp;
    memcpy(&per_ulp, &per_ulp_bits, sizeof per_ulp);
    // An infinity is as good as the next float after the largest.
    return fabs((isinf(got) ? copysign(0x1p128, (double)got) : (double)got) - want) * per_ulp;
}

static void note(struct row_result *r, float a, float b, float got, double want)
{
    const double error = ulp_error(got, want);
    r->nearest += got == (float)want || (isnan(got) && isnan(want));
    if (error > r->worst) {
        r->worst = error;
        r->a = a;
        r->b = b;
        r->got = got;
    }
}

static void wrong(struct row_result *r, float a, float b)
{
    if (r->wrong_bits++ == 0) {
        r->wrong_a = a;
        r->wrong_b = b;
    }
}

// Results of the baseline; every other instruction set has to give them too.
static void apply_all(enum isa_function function, const float *a, const float *b, float *got,
                      struct row_result *r)
{
    templates[RHW_ISA_BASELINE]->apply(function, a, b, got, BATCH);
    for (int isa = RHW_ISA_BASELINE + 1; isa < RHW_ISA_COUNT; isa++) {
        float result[BATCH];
        if (templates[isa]) {
            templates[isa]->apply(function, a, b, result, BATCH);
        }
        if (!templates[isa] || memcmp(result, got, sizeof result) == 0) {
            continue;
        }
        for (int i = 0; i < BATCH; i++) {
            if (!same(result[i], got[i])) {
                wrong(r, a[i], b[i]);
            }
        }
    }
    r->count += BATCH;
}

static double libm_error(double libm, mpfr_t exact, float got)
{
    // Both errors of the same float; their difference is the library's.
    const double ours = ulp_error(got, libm), truth = math_ulp_error(got, exact);
    return isinf(ours) && isinf(truth) ? 0 : fabs(ours - truth);
}

static void measure_one(const struct math_function *f, const float *a, struct row_result *r)
{
    float got[BATCH];
    apply_all(f->function, a, a, got, r);
    for (int i = 0; i < BATCH; i++) {
        note(r, a[i], 0, got[i], f->libm((double)a[i]));
    }
    mpfr_t exact;
    mpfr_init2(exact, 60);
    const int sample = (int)(r->count / BATCH * 2654435761u % BATCH);
    mpfr_set_flt(exact, a[sample], MPFR_RNDN);
    f->exact(exact, exact, MPFR_RNDN);
    r->libm_worst = fmax(r->libm_worst, libm_error(f->libm((double)a[sample]), exact, got[sample]));
    mpfr_clear(exact);
}

static void measure_two(const struct math_function2 *f, const float *a, const float *b, struct row_result *r)
{
    float got[BATCH];
    apply_all(f->function, a, b, got, r);
    for (int i = 0; i < BATCH; i++) {
        note(r, a[i], b[i], got[i], f->libm((double)a[i], (double)b[i]));
    }
    mpfr_t x, y;
    mpfr_init2(x, 60);
    mpfr_init2(y, 24);
    const int sample = (int)(r->count / BATCH * 2654435761u % BATCH);
    mpfr_set_flt(x, a[sample], MPFR_RNDN);
    mpfr_set_flt(y, b[sample], MPFR_RNDN);
    f->exact(x, x, y, MPFR_RNDN);
    const double libm = f->libm((double)a[sample], (double)b[sample]);
    r->libm_worst = fmax(r->libm_worst, libm_error(libm, x, got[sample]));
    mpfr_clears(x, y, (mpfr_ptr)0);
}

static void measure_plain(enum isa_function function, const float *a, struct row_result *r)
{
    float got[BATCH];
    apply_all(function, a, a, got, r);
    const bool number = function < ISA_TO_INT; // else any bits, and those of a NaN count
    for (int i = 0; i < BATCH; i++) {
        const float want = math_plain(function, a[i], a[i]);
        if (number ? !same(got[i], want) : memcmp(&got[i], &want, sizeof want) != 0) {
            wrong(r, a[i], a[i]);
        } else {
            r->nearest++;
        }
    }
}

static float any_float(struct random *r)
{
    return from_bits((uint32_t)(random_bits(r) >> 32));
}

static float special_float(struct random *r)
{
    static const uint32_t bits[] = {0,          1,          0x007fffff, 0x00800000, 0x3effffff, 0x3f000000,
                                    0x3f7fffff, 0x3f800000, 0x3f800001, 0x40000000, 0x40400000, 0x4b7fffff,
                                    0x4b800000, 0x7f7fffff, 0x7f800000, 0x7fc00000};
    return from_bits(bits[random_below(r, 16)] | (uint32_t)random_below(r, 2) << 31);
}

// Strata in equal parts; see the cases.
static void fill_pairs(enum isa_function function, float *a, float *b, struct random *r)
{
    for (int i = 0; i < BATCH; i++) {
        const double base = random_scale(r, -140, 120);
        switch (i % 6) {
        case 0: // all bits
            a[i] = any_float(r);
            b[i] = any_float(r);
            break;
        case 1: // results all over the range, over- and underflow; or all angles
            a[i] = (float)base;
            b[i] = function == ISA_POW ? (float)(random_between(r, -152, 130) / log2((double)a[i]))
                                       : (float)(random_sign(r) * base * random_scale(r, -26, 26));
            break;
        case 2: // what shading asks for; or points of a square
            a[i] = (float)random_between(r, function == ISA_POW ? 0 : -1, 1);
            b[i] = (float)(function == ISA_POW ? random_scale(r, -2, 10) : random_between(r, -1, 1));
            break;
        case 3: // whole exponents, negative bases
            a[i] = (float)random_between(r, -4, 4);
            b[i] = (float)(random_below(r, 121) - 60);
            break;
        case 4: // bases near 1, large exponents; points near the diagonals
            a[i] = (float)(1 + random_sign(r) * random_scale(r, -24, -6));
            b[i] = (float)(function == ISA_POW
                               ? random_sign(r) * random_scale(r, 0, 30)
                               : random_sign(r) * (1 + random_sign(r) * random_scale(r, -24, -6)));
            break;
        default: // special cases, with each other and with anything
            a[i] = random_chance(r, 0.5) ? special_float(r) : any_float(r);
            b[i] = random_chance(r, 0.5) ? special_float(r) : any_float(r);
            break;
        }
    }
}

// Tasks of a row stand together, rows in the order of the table.
static int first_task(int row)
{
    return row <= FIRST_OF_TWO  ? row * TASKS_OF_ONE
           : row <= FIRST_PLAIN ? FIRST_OF_TWO * TASKS_OF_ONE + (row - FIRST_OF_TWO) * TASKS_OF_TWO
                                : first_task(FIRST_PLAIN) + (row - FIRST_PLAIN) * TASKS_OF_ONE;
}

static void run_task(int task, struct row_result *rows)
{
    float a[BATCH], b[BATCH];
    int row = 0;
    while (first_task(row + 1) <= task) {
        row++;
    }
    const uint32_t block = (uint32_t)(task - first_task(row));
    for (uint32_t batch = 0; batch < TASK / BATCH; batch++) {
        for (uint32_t i = 0; i < BATCH; i++) {
            a[i] = from_bits(block * TASK + batch * BATCH + i);
        }
        if (row < FIRST_OF_TWO) {
            measure_one(&math_functions[row], a, &rows[row]);
        } else if (row >= FIRST_PLAIN) {
            measure_plain(plain_functions[row - FIRST_PLAIN].function, a, &rows[row]);
        } else {
            const struct math_function2 *const f = &math_functions2[row - FIRST_OF_TWO];
            struct random random = random_start(f->function, block, batch);
            fill_pairs(f->function, a, b, &random);
            measure_two(f, a, b, &rows[row]);
        }
    }
}

static void *work(void *argument)
{
    struct worker *const w = argument;
    for (int task; (task = atomic_fetch_add(&next_task, 1)) < end_task;) {
        run_task(task, w->rows);
        atomic_fetch_add(&done_tasks, 1);
    }
    mpfr_free_cache();
    return NULL;
}

// Of equals the one of least bits wins, so that the table does not depend on who measured what.
static bool worse(const struct row_result *a, const struct row_result *b)
{
    return a->worst != b->worst ? a->worst > b->worst : memcmp(&a->a, &b->a, sizeof a->a) < 0;
}

static void merge(struct row_result *into, const struct row_result *from)
{
    struct row_result sum = worse(from, into) ? *from : *into;
    sum.count = into->count + from->count;
    sum.nearest = into->nearest + from->nearest;
    const struct row_result *const first_wrong = into->wrong_bits ? into : from;
    sum.wrong_a = first_wrong->wrong_a;
    sum.wrong_b = first_wrong->wrong_b;
    sum.wrong_bits = into->wrong_bits + from->wrong_bits;
    sum.libm_worst = fmax(into->libm_worst, from->libm_worst);
    *into = sum;
}

static const char *name_of(int row)
{
    return row < FIRST_OF_TWO  ? math_functions[row].name
           : row < FIRST_PLAIN ? math_functions2[row - FIRST_OF_TWO].name
                               : plain_functions[row - FIRST_PLAIN].name;
}

static double stated_of(int row)
{
    return row < FIRST_OF_TWO  ? math_functions[row].stated
           : row < FIRST_PLAIN ? math_functions2[row - FIRST_OF_TWO].stated
                               : 0;
}

// The worst case again, in 60 bits.
static double exact_worst(int row, const struct row_result *r)
{
    mpfr_t x, y;
    mpfr_init2(x, 60);
    mpfr_init2(y, 24);
    mpfr_set_flt(x, r->a, MPFR_RNDN);
    mpfr_set_flt(y, r->b, MPFR_RNDN);
    if (row < FIRST_OF_TWO) {
        math_functions[row].exact(x, x, MPFR_RNDN);
    } else {
        math_functions2[row - FIRST_OF_TWO].exact(x, x, y, MPFR_RNDN);
    }
    const double error = math_ulp_error(r->got, x);
    mpfr_clears(x, y, (mpfr_ptr)0);
    return error;
}

static bool row_holds(int row, struct row_result *r)
{
    bool good = true;
    if (r->wrong_bits != 0) {
        printf("FAILED: %s: %llu results differ between instruction sets or from C, first at %a, %a\n",
               name_of(row), (unsigned long long)r->wrong_bits, (double)r->wrong_a, (double)r->wrong_b);
        good = false;
    }
    if (row >= FIRST_PLAIN) {
        return good;
    }
    if (!(r->libm_worst < libm_tolerance)) {
        printf("FAILED: %s: the C library is %g ULP off, no reference\n", name_of(row), r->libm_worst);
        good = false;
    }
    r->worst = exact_worst(row, r);
    if (!(r->worst <= stated_of(row))) {
        printf("FAILED: %s(%a, %a) = %a is %.3f ULP off; its docstring states %g\n", name_of(row),
               (double)r->a, (double)r->b, (double)r->got, r->worst, stated_of(row));
        good = false;
    }
    return good;
}

static const char *const begin_marker = "<!-- maths table: written by script/exactness maths -->\n";
static const char *const end_marker = "<!-- end of maths table -->\n";

static void print_table(FILE *out, const void *argument)
{
    const struct row_result *const rows = argument;
    fprintf(out, "| function | arguments | stated, ULP | worst, ULP | at | correctly rounded |\n"
                 "|---|---|---:|---:|---|---:|\n");
    for (int row = 0; row < FIRST_PLAIN; row++) {
        const struct row_result *const r = &rows[row];
        if (r->count == 0) {
            continue; // not asked for
        }
        const double share = 100 * (double)r->nearest / (double)r->count;
        fprintf(out, "| %s | %s | %g | %.4f | %a", name_of(row),
                row < FIRST_OF_TWO ? "every float" : "2^30 pairs", stated_of(row), r->worst, (double)r->a);
        if (row >= FIRST_OF_TWO) {
            fprintf(out, ", %a", (double)r->b);
        }
        fprintf(out, " | %.1f %% |\n", share);
    }
    fprintf(out, "| ");
    for (int row = FIRST_PLAIN; row < ROWS; row++) {
        fprintf(out, "%s%s", name_of(row), row + 1 < ROWS ? ", " : "");
    }
    fprintf(out, " | every float | 0 | 0 | | 100 %% |\n\n");
}

static int usage(void)
{
    fprintf(stderr, "usage: shader_math_full [--jobs N] [--function NAME | --table FILE]\n");
    return 2;
}

struct options {
    int jobs, first_row, end_row;
    const char *table;
};

static bool parse(struct options *o, int argc, char **argv)
{
    *o = (struct options){.jobs = 1, .end_row = ROWS};
    for (int i = 1; i < argc; i += 2) {
        const char *const value = argv[i + 1]; // argv ends with NULL
        if (!value) {
            return false;
        }
        if (strcmp(argv[i], "--jobs") == 0) {
            o->jobs = atoi(value);
        } else if (strcmp(argv[i], "--table") == 0) {
            o->table = value;
        } else if (strcmp(argv[i], "--function") == 0) {
            for (o->first_row = 0; o->first_row < ROWS && strcmp(name_of(o->first_row), value) != 0;) {
                o->first_row++;
            }
            o->end_row = o->first_row + 1;
        } else {
            return false;
        }
    }
    return o->jobs >= 1 && o->jobs <= MAX_JOBS && o->first_row < ROWS &&
           (!o->table || o->end_row - o->first_row == ROWS);
}

// Runs the tasks of the wanted rows; the sums are in `rows`.
static bool measure(const struct options *o, struct row_result *rows)
{
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        templates[isa] = isa_templates_for((enum rhw_isa)isa);
    }
    const int start = first_task(o->first_row);
    end_task = first_task(o->end_row);
    atomic_store(&next_task, start);
    for (int i = 0; i < o->jobs; i++) {
        if (pthread_create(&workers[i].thread, NULL, work, &workers[i]) != 0) {
            fprintf(stderr, "shader_math_full: out of threads\n");
            return false;
        }
    }
    struct progress progress;
    progress_start(&progress, "maths");
    for (int done; (done = atomic_load(&done_tasks)) < end_task - start;) {
        progress_say(&progress, (double)done / (end_task - start));
        thrd_sleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    }
    progress_end(&progress);
    for (int i = 0; i < o->jobs; i++) {
        pthread_join(workers[i].thread, NULL);
        for (int row = 0; row < ROWS; row++) {
            merge(&rows[row], &workers[i].rows[row]);
        }
    }
    return true;
}

int main(int argc, char **argv)
{
    static struct row_result rows[ROWS];
    struct options o;
    if (!parse(&o, argc, argv)) {
        return usage();
    }
    if (!measure(&o, rows)) {
        return 1;
    }
    bool good = true;
    for (int row = o.first_row; row < o.end_row; row++) {
        good = row_holds(row, &rows[row]) && good;
    }
    print_table(stdout, rows);
    if (o.table) {
        good = document_replace(o.table, begin_marker, end_marker, print_table, rows) && good;
    }
    return good ? 0 : 1;
}
