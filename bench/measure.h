// SPDX-License-Identifier: MIT
// Times renderers against each other: frame by frame in turn, so that whatever else the machine does falls on
// all of them alike.
#ifndef BENCH_MEASURE_H
#define BENCH_MEASURE_H

#include "renderer.h"

enum { BENCH_WARM_UP = 3, BENCH_FRAMES_MAX = 10000 };

struct bench_time {
    double median, least, most; // milliseconds
    struct bench_stages stages; // means of the frames that count, where the renderer measures them
};

// Draws BENCH_WARM_UP frames that nobody counts and then `frames` that count, with each of the renderers, which
// have taken a scene. False when one fails to draw; *failed is then its number.
bool bench_measure(struct bench_renderer *renderers, int count, int frames, struct bench_time *times,
                   int *failed);

// Median (of an even number: the lower of the middle two), least and most. Sorts the samples.
struct bench_time bench_time_of(double *samples, int count);

double bench_now_ms(void);

#endif
