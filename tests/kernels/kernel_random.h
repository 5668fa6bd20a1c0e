// SPDX-License-Identifier: MIT
// Input of the kernel checks: numbers that are often at the end of what a function allows, or the ones that
// floating-point code gets wrong. The same seed gives the same numbers everywhere.
#ifndef KERNEL_RANDOM_H
#define KERNEL_RANDOM_H

#include <stdbool.h>
#include <stdint.h>

struct kernel_random {
    uint64_t state;
};

// `name` and `seed` choose the sequence.
struct kernel_random kernel_random_start(const char *name, uint64_t seed);

uint64_t random_bits(struct kernel_random *random);
bool random_one_in(struct kernel_random *random, int n);

// low .. high, both inclusive: one of the ends, next to one, zero, a power of two or next to one, or anything.
int64_t random_int(struct kernel_random *random, int64_t low, int64_t high);
void random_ints(struct kernel_random *random, int32_t *values, int count, int32_t low, int32_t high);

// Any float: zeros, denormals, infinities, NaN, halves between integers, neighbours of 1, any bits, any magnitude.
float random_float(struct kernel_random *random);
float random_finite(struct kernel_random *random);
// low .. high, often the ends and their neighbours.
float random_float_in(struct kernel_random *random, float low, float high);
void random_floats(struct kernel_random *random, float *values, int count);

// The same for doubles; finite ones are of magnitude 0 or 2^-limit .. 2^limit.
double random_double(struct kernel_random *random);
double random_finite_double(struct kernel_random *random, int limit);
void random_doubles(struct kernel_random *random, double *values, int count);

// A triangle in 24.8 fixed point near `x`, `y` (1/256 pixel), within the guard band: of any size, of a pixel, a sliver,
// without area, with edges through pixel centres, or far away.
void random_triangle(struct kernel_random *random, int32_t x, int32_t y, int32_t xs[3], int32_t ys[3]);

// Homogeneous clip coordinates of a vertex: in view, on a plane of the view volume, far outside, behind the eye, with W
// of any magnitude, next to 0 and 0.
void random_clip_position(struct kernel_random *random, float position[4]);

#endif
