// SPDX-License-Identifier: MIT
// A test by golden hashes: draws every scene, and compares the number made of its bytes with the one that golden.txt
// has. Where they differ it says so and writes the picture, to be looked at.
// usage: golden FILE [--update]: --update writes FILE anew
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "cube.h"
#include "picture_hash.h"
#include "target.h"

struct scene {
    const char *name;
    int width, height;
    float angle;
};

static const struct scene scenes[] = {
    {"front", 160, 120, 0}, {"corner", 160, 120, 0.8f}, {"tall", 90, 200, 0.3f}};

// The number that a line `NAME HASH` of the file has; 0 without such a line.
static uint64_t golden_hash(FILE *file, const char *name)
{
    char found[32];
    uint64_t hash;
    rewind(file);
    while (fscanf(file, "%31s %" SCNx64, found, &hash) == 2) {
        if (strcmp(found, name) == 0) {
            return hash;
        }
    }
    return 0;
}

static void write_ppm(rhw_context *context, const struct scene *scene, rhw_texture picture)
{
    char path[64];
    snprintf(path, sizeof path, "%s.ppm", scene->name);
    const size_t count = (size_t)scene->width * (size_t)scene->height;
    unsigned char(*pixels)[4] = malloc(count * 4);
    FILE *const file = pixels ? fopen(path, "wb") : NULL;
    if (file) {
        rhw_texture_read(context, picture, 0, pixels, 0);
        fprintf(file, "P6 %d %d 255\n", scene->width, scene->height);
        for (size_t i = 0; i < count; i++) {
            fwrite(pixels[i], 1, 3, file);
        }
        fclose(file);
    }
    free(pixels);
}

// Draws a scene and compares it with the file, or writes it there; true when it is as it should be.
static bool check(rhw_context *context, rhw_pipeline pipeline, const struct scene *scene, FILE *file,
                  bool update)
{
    struct target target = {0};
    if (target_fit(context, &target, scene->width, scene->height) != RHW_OK ||
        cube_draw(context, pipeline, target.texture, scene->angle) != RHW_OK) {
        printf("%s: out of memory\n", scene->name);
        return false;
    }
    const uint64_t hash = hash_picture(context, target.texture);
    bool same = true;
    if (update) {
        fprintf(file, "%s %016" PRIx64 "\n", scene->name, hash);
    } else {
        const uint64_t golden = golden_hash(file, scene->name);
        same = hash == golden;
        if (!same) {
            printf("%s: %016" PRIx64 ", golden is %016" PRIx64 "; see %s.ppm\n", scene->name, hash, golden,
                   scene->name);
            write_ppm(context, scene, target.texture);
        }
    }
    rhw_texture_destroy(context, target.texture);
    return same;
}

int main(int argc, char **argv)
{
    const bool update = argc == 3 && strcmp(argv[2], "--update") == 0;
    const struct rhw_context_def def = {0};
    rhw_context *context;
    rhw_pipeline pipeline;
    if (argc < 2 || (argc > 2 && !update)) {
        fprintf(stderr, "usage: golden FILE [--update]\n");
        return 2;
    }
    FILE *const file = fopen(argv[1], update ? "w" : "r");
    if (!file) {
        perror(argv[1]);
        return 2;
    }
    if (rhw_context_create(&def, &context) != RHW_OK || cube_pipeline(context, &pipeline) != RHW_OK) {
        return 2;
    }
    int failed = 0;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        failed += !check(context, pipeline, &scenes[i], file, update);
    }
    rhw_context_destroy(context);
    if (fclose(file) != 0) {
        perror(argv[1]);
        return 2;
    }
    return failed != 0;
}
