// SPDX-License-Identifier: MIT
// A distribution of errors in ULP: how many, median, 99th percentile, worst, and where the worst was.
#ifndef EXACT_TALLY_H
#define EXACT_TALLY_H

#include <stdint.h>

// Bins are 1/64 of a power of two wide, from 2^-12 to 2^36 ULP: a percentile is right to 1.6 %.
enum {
    TALLY_LOWEST = -12,
    TALLY_HIGHEST = 36,
    TALLY_PER_OCTAVE = 64,
    TALLY_BINS = (TALLY_HIGHEST - TALLY_LOWEST) * TALLY_PER_OCTAVE
};

// Names one number of one fragment; see scene.h for family, seed and index.
struct tally_place {
    int family, triangle, x, y, component;
    uint64_t seed, index;
};

struct tally {
    uint64_t count;
    uint64_t bin[TALLY_BINS];
    double worst;
    struct tally_place at;
};

void tally_add(struct tally *t, double error, const struct tally_place *at);
void tally_merge(struct tally *into, const struct tally *from);
// The error that `part` (0..1) of all errors do not exceed.
double tally_percentile(const struct tally *t, double part);

#endif
