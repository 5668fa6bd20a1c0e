// SPDX-License-Identifier: MIT
// Whether two renderers drew the same picture, so that no speed is won by drawing less.
#ifndef BENCH_AGREEMENT_H
#define BENCH_AGREEMENT_H

#include "renderer.h"

struct bench_agreement {
    bool agrees;
    bool is_equal; // no byte differs
    uint64_t pixels;
    uint64_t coverage; // pixels that only one image covers
    uint64_t outliers; // pixels covered by both that differ by more than the tolerance
    int color;         // largest difference of a channel, 1/255, where both cover
    double depth;      // largest difference, where both cover
    double mean;       // of all channels (1/255) or depths
};

// Compares images of the same size and kind. A pixel is covered where its alpha (without colour: its depth)
// is not 0 (1). They agree when the pixels that differ by more than the tolerance, in one image
// alone included, are no more than its outliers allow.
struct bench_agreement bench_agree(const struct bench_image *a, const struct bench_image *b,
                                   const struct bench_tolerance *tolerance);

#endif
