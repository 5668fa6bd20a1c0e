// SPDX-License-Identifier: MIT
// Times the scenes that need no file with one thread on each instruction set of this build, so that builds which have
// no program, WebAssembly for one, can be compared: script/isas does. Prints "ISA SCENE MILLISECONDS" for each.
#include "measure.h"
#include "rhw/rhw.h"
#include "scene_floor.h"
#include "scene_sphere.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = 1920, HEIGHT = 1080, FRAMES = 5 };

// The least of some frames: what else the machine does only adds to it.
static bool time_scene(const struct bench_scene_entry *entry, enum rhw_isa isa)
{
    struct bench_renderer renderer = {0};
    struct bench_scene scene;
    struct bench_time time;
    char why_not[200] = "";
    const char *why = why_not;
    int failed;
    const bool drawn = bench_scene_make(entry, &scene, WIDTH, HEIGHT, why_not, sizeof why_not) &&
                       bench_open_rhw(&renderer, 1, isa, &why) &&
                       renderer.take(&renderer, &scene, WIDTH, HEIGHT) &&
                       bench_measure(&renderer, 1, FRAMES, &time, &failed);
    if (!drawn) {
        fprintf(stderr, "isa_times: %s: %s\n", entry->name, why);
        return false;
    }
    printf("%s %s %.1f\n", rhw_isa_name(renderer.isa), entry->name, time.least);
    fflush(stdout);
    renderer.release(&renderer);
    renderer.close(&renderer);
    bench_scene_free(&scene);
    return true;
}

int main(void)
{
    bool drawn = true;
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        for (int i = 0; rhw_isa_supported((enum rhw_isa)isa) && i < bench_scene_entry_count; i++) {
            const struct bench_scene_entry *const entry = &bench_scene_entries[i];
            if (entry->make == bench_make_floor || entry->make == bench_make_sphere) {
                drawn = time_scene(entry, (enum rhw_isa)isa) && drawn;
            }
        }
    }
    return drawn ? 0 : 1;
}
