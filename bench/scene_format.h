// SPDX-License-Identifier: MIT
// The fill scenes with pictures of other formats than RGBA8: what a format costs beside its neighbour.
#ifndef BENCH_SCENE_FORMAT_H
#define BENCH_SCENE_FORMAT_H

#include "bench_scene.h"

// What is drawn: the floors of fill_flat, fill_color or fill_blend, which are the neighbours.
enum bench_format_variant { BENCH_FORMAT_FLAT, BENCH_FORMAT_STORE, BENCH_FORMAT_BLEND };

// A variant of a format of the picture, for bench_scene_entry.
#define BENCH_FORMAT_VARIANT(format, variant) (3 * (int)(format) + (int)(variant))

bool bench_make_format(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                       int height, char *why, size_t why_size);

#endif
