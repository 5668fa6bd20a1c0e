// SPDX-License-Identifier: MIT
// See scene_format.h.
#include "scene_format.h"

#include "scene_floor.h"

// How far apart two roundings to a format may be, in steps of 1/255: a step of its coarsest channel but alpha.
static int step_of(enum bench_format format)
{
    switch (format) {
    case BENCH_RGBA4: return 17;
    case BENCH_RGB565:
    case BENCH_RGB5A1: return 9;
    case BENCH_RG11B10F: return 5; // 5 bits of fraction at 1/2
    case BENCH_RGBA8S: return 3;
    default: return 1;
    }
}

static int alpha_step_of(enum bench_format format)
{
    return format == BENCH_RGB5A1 ? 255 : format == BENCH_RGB10A2 ? 86 : step_of(format);
}

// Each of 8 layers that are blended may be rounded to either of two steps; later layers cover most of that.
static int tolerance_of(int step, enum bench_format_variant variant)
{
    return variant == BENCH_FORMAT_BLEND ? 2 * step + 2 : step + 1;
}

bool bench_make_format(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                       int height, char *why, size_t why_size)
{
    static const enum bench_floor_variant floors[] = {[BENCH_FORMAT_FLAT] = BENCH_FLOOR_FLAT,
                                                      [BENCH_FORMAT_STORE] = BENCH_FLOOR_COLOR,
                                                      [BENCH_FORMAT_BLEND] = BENCH_FLOOR_BLEND};
    const enum bench_format_variant variant = (enum bench_format_variant)(entry->variant % 3);
    const struct bench_scene_entry floor = {entry->name, entry->what, bench_make_floor, (int)floors[variant]};
    scene->picture = (enum bench_format)(entry->variant / 3);
    const bool made = bench_make_floor(&floor, scene, width, height, why, why_size);
    scene->tolerance.color = tolerance_of(step_of(scene->picture), variant);
    scene->tolerance.alpha = tolerance_of(alpha_step_of(scene->picture), variant);
    // An alpha of one or two bits may be blended down to the value that tells what is not covered.
    scene->tolerance.outliers =
        scene->picture == BENCH_RGB10A2 || scene->picture == BENCH_RGB5A1 ? 1e-3 : 0.0;
    return made;
}
