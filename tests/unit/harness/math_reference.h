// SPDX-License-Identifier: MIT
// What the functions of shader_math.h and shader_vector.h are measured against, and the errors that their docstrings
// state: asserted on samples by test_shader_math.c and on every float by tests/exact/shader_math_full.c.
#ifndef TEST_MATH_REFERENCE_H
#define TEST_MATH_REFERENCE_H

#include "isa_templates.h"

#include <mpfr.h>

struct math_function {
    enum isa_function function;
    const char *name;
    double stated; // ULP of the exact result
    int (*exact)(mpfr_t result, const mpfr_t a, mpfr_rnd_t rounding);
    double (*libm)(double a);
    float low, high; // where samples lie dense
};

struct math_function2 {
    enum isa_function function;
    const char *name;
    double stated;
    int (*exact)(mpfr_t result, const mpfr_t a, const mpfr_t b, mpfr_rnd_t rounding);
    double (*libm)(double a, double b);
};

enum { MATH_FUNCTIONS = 18, MATH_FUNCTIONS2 = 2 };
extern const struct math_function math_functions[MATH_FUNCTIONS];
extern const struct math_function2 math_functions2[MATH_FUNCTIONS2];

/// Distance of `got` from the exact `want` in units in the last place of `want`; where `want` is 0, not finite or NaN,
/// 0 for the one right answer and infinity for all others.
double math_ulp_error(float got, const mpfr_t want);

/// ISA_FLOOR to ISA_TO_INT and ISA_MIN to ISA_EQUAL, which give the bits that C gives.
float math_plain(enum isa_function function, float a, float b);

#endif
