// SPDX-License-Identifier: MIT
// Small scenes drawn twice, by the library and by the OpenGL ES of this machine (llvmpipe), which stands on nothing that
// the library stands on. A unit is a step of the target's format. A scene fails where more pixels differ by more than one
// unit, or any by more units, than its rule explains.
// usage: differential [--peer DRIVER] [--write FILE] [--pixels] [SCENE]...; exit status 77 where there is no peer.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "renderers.h"
#include "scenes.h"
#include "texel_pair.h"

enum { EXIT_SKIPPED = 77, SHOWN = 4 };

struct difference {
    long pixels; // by more than one unit; numbers count as pixels
    long compared;
    double most;             // units
    int worst_target, worst; // where
};

static struct {
    rhw_context *context;
    struct peer *peer;
    struct frame frame;
    struct drawn here, there;
    bool shows;
} all;

static void show(int target, int at, const double *here, const double *there)
{
    printf("    target %d pixel %d, %d: here %.9g %.9g %.9g %.9g, there %.9g %.9g %.9g %.9g\n", target,
           at % all.frame.width, at / all.frame.width, here[0], here[1], here[2], here[3], there[0], there[1],
           there[2], there[3]);
}

static void compare_pixel(struct difference *d, const struct texel_pair *pair, int target, int at)
{
    const double *const here = all.here.targets[target][at], *const there = all.there.targets[target][at];
    double most = 0;
    for (int c = 0; c < pair->channels; c++) {
        most = fmax(most, texel_difference(pair, c, here[c], there[c]));
    }
    d->pixels += most > 1;
    d->compared++;
    if (most > d->most) {
        d->most = most;
        d->worst_target = target;
        d->worst = at;
    }
    if (most > 1 && all.shows && d->pixels <= SHOWN) {
        show(target, at, here, there);
    }
}

static struct difference compare(void)
{
    struct difference d = {0};
    for (int target = 0; target < all.frame.target_count; target++) {
        const struct texel_pair *const pair = texel_pair_find(all.frame.formats[target]);
        for (int at = 0; at < all.frame.width * all.frame.height; at++) {
            compare_pixel(&d, pair, target, at);
        }
    }
    if (all.shows && d.most > 1) {
        show(d.worst_target, d.worst, all.here.targets[d.worst_target][d.worst],
             all.there.targets[d.worst_target][d.worst]);
    }
    for (int i = 0; i < all.frame.number_count; i++) {
        const double here = all.here.numbers[i], there = all.there.numbers[i];
        d.pixels += here != there;
        d.compared++;
        if (here != there && all.shows && d.pixels <= SHOWN) {
            printf("    number %d: here %.9g, there %.9g\n", i, here, there);
        }
    }
    return d;
}

// Whether there is anything to compare: a picture of one colour, or equal numbers, could be of nothing.
static bool shows_something(void)
{
    const int pixels = all.frame.width * all.frame.height;
    bool differs = false, counts = all.frame.number_count == 0;
    for (int at = 1; at < pixels; at++) {
        differs =
            differs || memcmp(all.here.targets[0][at], all.here.targets[0][0], sizeof *all.here.targets[0]);
    }
    for (int i = 1; i < all.frame.number_count; i++) {
        counts = counts || all.here.numbers[i] != all.here.numbers[0];
    }
    return differs && counts;
}

// NULL, or what went wrong, of the scene that is described.
static const char *run(const struct scene *scene, struct difference *d)
{
    memset(&all.here, 0, sizeof all.here);
    memset(&all.there, 0, sizeof all.there);
    if (!draw_here(all.context, &all.frame, &all.here)) {
        return "not drawn here";
    }
    if (!draw_there(all.peer, &all.frame, &all.there)) {
        return "not drawn there";
    }
    *d = compare();
    if (!shows_something()) {
        return "nothing to be seen";
    }
    return d->pixels > scene->pixels || (scene->why ? d->most > scene->most : d->most > 1) ? "too different"
                                                                                           : NULL;
}

static bool is_wanted(const char *name, char *const *names, int count)
{
    for (int i = 0; i < count; i++) {
        if (strstr(name, names[i])) {
            return true;
        }
    }
    return count == 0;
}

static void write_head(FILE *file)
{
    fprintf(file,
            "# The same scenes by OpenGL ES\n\n"
            "Each scene is drawn by rhw and by a peer, %s,\n"
            "and their pixels are compared, by `differential --write docs/differential.md` "
            "(tests/differential).\n"
            "A unit is a step of the target's format: of half floats one of the larger value, or of 1/4 "
            "where both\n"
            "are less, and likewise of smaller ones; of 32-bit floats 2^-16. Numbers of queries, transform "
            "feedback\n"
            "and storage count as pixels and are equal. The test fails where more differs than is "
            "explained.\n\n"
            "| scene | pixels | off by more than 1 | largest, units | why |\n|---|---:|---:|---:|---|\n",
            peer_name(all.peer));
}

static int run_all(FILE *file, char *const *names, int name_count)
{
    const struct scene_list lists[] = {raster_scenes(), primitive_scenes(), test_scenes(),
                                       output_scenes(), texture_scenes(),   shadow_scenes(),
                                       filter_scenes(), sample_scenes(),    storage_scenes()};
    int failed = 0;
    printf("%s\n%-36s %8s %8s %8s\n", peer_name(all.peer), "scene", "pixels", "over 1", "most");
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        for (int k = 0; k < lists[i].count; k++) {
            const struct scene *const scene = &lists[i].scenes[k];
            if (!is_wanted(scene->name, names, name_count)) {
                continue;
            }
            scene->describe(&all.frame);
            const char *const lacks = peer_lacks(all.peer, &all.frame);
            if (lacks) {
                printf("%-36s skipped: %s\n", scene->name, lacks);
                if (file) {
                    fprintf(file, "| %s | – | – | – | skipped: %s |\n", scene->name, lacks);
                }
                continue;
            }
            struct difference d = {0};
            const char *const wrong = run(scene, &d);
            failed += wrong != NULL;
            printf("%-36s %8ld %8ld %8.4g %s%s%s\n", scene->name, d.compared, d.pixels, d.most,
                   wrong ? "FAILED: " : "", wrong ? wrong : "", !wrong && scene->why ? scene->why : "");
            fflush(stdout);
            if (file) {
                fprintf(file, "| %s | %ld | %ld | %.*g | %s |\n", scene->name, d.compared, d.pixels,
                        d.most < 1000 ? 3 : 4, d.most, scene->why ? scene->why : "");
            }
        }
    }
    return failed;
}

int main(int argument_count, char **arguments)
{
    const struct rhw_context_def def = {.threads = 2};
    const char *why = NULL, *path = NULL, *driver = "llvmpipe";
    int at = 1;
    for (; at < argument_count && arguments[at][0] == '-'; at++) {
        if (!strcmp(arguments[at], "--write") && at + 1 < argument_count) {
            path = arguments[++at];
        } else if (!strcmp(arguments[at], "--peer") && at + 1 < argument_count) {
            driver = arguments[++at];
        } else if (!strcmp(arguments[at], "--pixels")) {
            all.shows = true;
        } else {
            fprintf(stderr, "usage: differential [--peer DRIVER] [--write FILE] [--pixels] [SCENE]...\n");
            return EXIT_FAILURE;
        }
    }
    all.peer = peer_open(driver, &why);
    if (!all.peer) {
        printf("no peer: %s\n", why);
        return EXIT_SKIPPED;
    }
    if (rhw_context_create(&def, &all.context) != RHW_OK) {
        return EXIT_FAILURE;
    }
    FILE *const file = path ? fopen(path, "w") : NULL;
    if (path && !file) {
        fprintf(stderr, "differential: cannot write %s\n", path);
        return EXIT_FAILURE;
    }
    if (file) {
        write_head(file);
    }
    const int failed = run_all(file, arguments + at, argument_count - at);
    if (file) {
        fclose(file);
    }
    printf("%d failed\n", failed);
    rhw_context_destroy(all.context);
    peer_close(all.peer);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
