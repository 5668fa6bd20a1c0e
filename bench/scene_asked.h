// SPDX-License-Identifier: MIT
// What a fragment function may ask for or do beside receiving smooth varyings: what it costs beside the function that
// does not, on the floors of fill_color and on a mesh of small triangles.
#ifndef BENCH_SCENE_ASKED_H
#define BENCH_SCENE_ASKED_H

#include "bench_scene.h"

// A variant for bench_scene_entry: a shader from BENCH_SHADER_COLOR on that draws colours, on floors or on a mesh.
enum bench_asked_stage {
    BENCH_ASKED_FILL,
    BENCH_ASKED_MESH,
    BENCH_ASKED_FILL_SAMPLES, // 4 a pixel
    BENCH_ASKED_MESH_SAMPLES,
    BENCH_ASKED_STAGES
};
#define BENCH_ASKED_VARIANT(shader, stage) (BENCH_ASKED_STAGES * (int)(shader) + (int)(stage))

bool bench_make_asked(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size);

#endif
