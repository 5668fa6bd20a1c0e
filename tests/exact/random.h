// SPDX-License-Identifier: MIT
// The random numbers of the exactness tests: SplitMix64 (Steele, Lea and Flood 2014), because its whole state
// is one number that a command line can name.
#ifndef EXACT_RANDOM_H
#define EXACT_RANDOM_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

struct random {
    uint64_t state;
};

static inline uint64_t random_bits(struct random *r)
{
    uint64_t z = r->state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

// A stream of its own for every triple of numbers.
static inline struct random random_start(uint64_t a, uint64_t b, uint64_t c)
{
    struct random r = {a};
    r.state = random_bits(&r) ^ b;
    r.state = random_bits(&r) ^ c;
    return r;
}

// 0 .. count − 1.
static inline int random_below(struct random *r, int count)
{
    return (int)((random_bits(r) >> 32) * (uint64_t)count >> 32);
}

static inline bool random_chance(struct random *r, double probability)
{
    return (double)(random_bits(r) >> 11) * 0x1p-53 < probability;
}

static inline double random_between(struct random *r, double low, double high)
{
    return low + (high - low) * (double)(random_bits(r) >> 11) * 0x1p-53;
}

// Every power of two between the ends is as likely as any other.
static inline double random_scale(struct random *r, double low_log2, double high_log2)
{
    return exp2(random_between(r, low_log2, high_log2));
}

static inline double random_sign(struct random *r)
{
    return random_bits(r) >> 63 ? 1 : -1;
}

#endif
