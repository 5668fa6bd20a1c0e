// SPDX-License-Identifier: MIT
// One renderer under measurement: rhw with some number of threads, or a peer. A frame is clear, draw and the
// finished image in memory; nothing is read back while the clock runs.
#ifndef BENCH_RENDERER_H
#define BENCH_RENDERER_H

#include "bench_scene.h"
#include "rhw/types.h"

// What one frame left, rows top to bottom. `color` is RGBA8, or NULL in a scene that has none; `depth` is
// 0..1, kept in scenes without colour only.
struct bench_image {
    int width, height;
    uint8_t *color;
    float *depth;
};

// Milliseconds of the passes of a frame, as struct rhw_stats has them.
struct bench_stages {
    double frame;                 // the whole of it, on the wall
    double front, back;           // on the wall
    double front_busy, back_busy; // of all threads
};

struct bench_renderer {
    char name[160];             // for people
    int threads;                // of rhw; 0: not known
    enum rhw_isa isa;           // of rhw
    uint64_t fragments;         // shaded in the last frame, where the renderer counts them
    struct bench_stages stages; // of the last frame, where the renderer measures them
    double shaders_ms;          // that `take` spent on making programs of shaders; 0 of those in C
    char why[300];              // why `take` failed, where that is a limit of the renderer; else empty
    void *state;
    // Takes a scene, which must stay until `release`. False when the renderer cannot.
    bool (*take)(struct bench_renderer *renderer, const struct bench_scene *scene, int width, int height);
    bool (*frame)(struct bench_renderer *renderer);
    // Copies out what the last frame left, into buffers of the right size.
    bool (*read)(struct bench_renderer *renderer, struct bench_image *image);
    void (*release)(struct bench_renderer *renderer);
    void (*close)(struct bench_renderer *renderer);
};

// `threads` as in rhw_context_def, `isa` the highest to use; RHW_ISA_COUNT: that of RHW_ISA_BEST.
bool bench_open_rhw(struct bench_renderer *renderer, int threads, enum rhw_isa isa, const char **why);
// rhw, with shaders that are translated from the GLSL texts which a peer gets.
enum bench_translation { BENCH_INTERPRETER, BENCH_MACHINE, BENCH_EMITTED };
bool bench_open_translated(struct bench_renderer *renderer, enum bench_translation translation, int threads,
                           enum rhw_isa isa, const char **why);
// A Mesa driver by its name, "llvmpipe" or "softpipe". One at a time.
bool bench_open_gles(struct bench_renderer *renderer, const char *driver, const char **why);

#endif
