// SPDX-License-Identifier: MIT
// Times the scenes that need no file with one thread on each instruction set of this build, so that builds which have
// no program, WebAssembly for one, can be compared: script/isas does. Prints "ISA SCENE MILLISECONDS" for each, the
// least of some frames: what else the machine does only adds to it.
//   isa_times         frames of 1920×1080
//   isa_times quick   frames of 64×36: a test that all scenes are drawn
#include "measure.h"
#include "rhw/rhw.h"
#include "scene_floor.h"
#include "scene_sphere.h"

#include <stdio.h>
#include <string.h>

enum { FRAMES = 5 };

struct size {
    int width, height;
};

static bool fail(const char *scene, const char *why)
{
    fprintf(stderr, "isa_times: %s: %s\n", scene, why);
    return false;
}

static bool time_frames(struct bench_renderer *renderer, const struct bench_scene *scene, const char *name,
                        struct size size)
{
    struct bench_time time;
    int failed;
    if (!renderer->take(renderer, scene, size.width, size.height)) {
        return fail(name, "the scene could not be taken");
    }
    const bool drawn = bench_measure(renderer, 1, FRAMES, &time, &failed);
    renderer->release(renderer);
    if (!drawn) {
        return fail(name, "a frame could not be drawn");
    }
    printf("%s %s %.1f\n", rhw_isa_name(renderer->isa), name, time.least);
    fflush(stdout);
    return true;
}

static bool time_scene(const struct bench_scene_entry *entry, enum rhw_isa isa, struct size size)
{
    struct bench_renderer renderer = {0};
    struct bench_scene scene;
    char why_scene[200] = "";
    const char *why;
    if (!bench_scene_make(entry, &scene, size.width, size.height, why_scene, sizeof why_scene)) {
        return fail(entry->name, why_scene);
    }
    bool timed = false;
    if (bench_open_rhw(&renderer, 1, isa, &why)) {
        timed = time_frames(&renderer, &scene, entry->name, size);
        renderer.close(&renderer);
    } else {
        fail(entry->name, why);
    }
    bench_scene_free(&scene);
    return timed;
}

int main(int argc, char **argv)
{
    const bool quick = argc == 2 && strcmp(argv[1], "quick") == 0;
    if (argc > 1 && !quick) {
        fputs("usage: isa_times [quick]\n", stderr);
        return 2;
    }
    const struct size size = quick ? (struct size){64, 36} : (struct size){1920, 1080};
    bool timed = true;
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa)) {
            continue;
        }
        for (int i = 0; i < bench_scene_entry_count; i++) {
            const struct bench_scene_entry *const entry = &bench_scene_entries[i];
            if (entry->make == bench_make_floor || entry->make == bench_make_sphere) {
                timed = time_scene(entry, (enum rhw_isa)isa, size) && timed;
            }
        }
    }
    return timed ? 0 : 1;
}
