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

static void add_stages(struct bench_stages *sum, const struct bench_stages *frame, double weight)
{
    sum->frame += weight * frame->frame;
    sum->front += weight * frame->front;
    sum->back += weight * frame->back;
    sum->front_busy += weight * frame->front_busy;
    sum->back_busy += weight * frame->back_busy;
}

bool bench_measure(struct bench_renderer *renderers, int count, int frames, struct bench_time *times,
                   int *failed)
{
    double *const samples = malloc((size_t)count * (size_t)frames * sizeof *samples);
    struct bench_stages *const stages = calloc((size_t)count, sizeof *stages);
    bool works = samples && stages;
    *failed = 0;
    for (int f = -BENCH_WARM_UP; works && f < frames; f++) {
        for (int i = 0; works && i < count; i++) {
            nanosleep(&(struct timespec){.tv_nsec = pause_ns}, NULL);
            const double start = bench_now_ms();
            works = renderers[i].frame(&renderers[i]);
            *failed = i;
            if (f >= 0) {
                samples[i * frames + f] = renderers[i].stages.frame = bench_now_ms() - start;
                add_stages(&stages[i], &renderers[i].stages, 1.0 / frames);
            }
        }
    }
    for (int i = 0; works && i < count; i++) {
        times[i] = bench_time_of(&samples[i * frames], frames);
        times[i].stages = stages[i];
    }
    free(stages);
    free(samples);
    return works;
}
