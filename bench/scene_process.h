// SPDX-License-Identifier: MIT
// The program from a file to a picture, as a process of its own: a row for each kind of file.
#ifndef BENCH_SCENE_PROCESS_H
#define BENCH_SCENE_PROCESS_H

#include "bench_scene.h"

enum bench_process_variant {
    BENCH_PROCESS_OBJ,
    BENCH_PROCESS_PLY,
    BENCH_PROCESS_STL,
    BENCH_PROCESS_GLB,
    BENCH_PROCESS_MTL
};

bool bench_make_process(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                        int height, char *why, size_t why_size);

// Removes the files that were made for a row. NULL has none.
void bench_files_remove(struct bench_files *files);

#endif
