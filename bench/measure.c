// SPDX-License-Identifier: MIT
// See measure.h.
#include "measure.h"

#include <stdlib.h>
#include <time.h>

// Before every frame, outside its time. Workers of rhw spin for 80 µs after their work; a renderer that shared
// the cores with them would look slower than it is.
static const long pause_ns = 500000;

double bench_now_ms(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

static int compare(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

struct bench_time bench_time_of(double *samples, int count)
{
    qsort(samples, (size_t)count, sizeof *samples, compare);
    return (struct bench_time){
        .median = samples[(count - 1) / 2], .least = samples[0], .most = samples[count - 1]};
}

bool bench_measure(struct bench_renderer *renderers, int count, int frames, struct bench_time *times,
                   int *failed)
{
    double *const samples = malloc((size_t)count * (size_t)frames * sizeof *samples);
    *failed = 0;
    for (int f = -BENCH_WARM_UP; samples && f < frames; f++) {
        for (int i = 0; i < count; i++) {
            nanosleep(&(struct timespec){.tv_nsec = pause_ns}, NULL);
            const double start = bench_now_ms();
            if (!renderers[i].frame(&renderers[i])) {
                *failed = i;
                free(samples);
                return false;
            }
            if (f >= 0) {
                samples[i * frames + f] = bench_now_ms() - start;
            }
        }
    }
    for (int i = 0; samples && i < count; i++) {
        times[i] = bench_time_of(&samples[i * frames], frames);
    }
    free(samples);
    return samples != NULL;
}
