// SPDX-License-Identifier: MIT
// In place of scene_model.c, scene_pbr.c, scene_process.c and scene_translation.c where a build reads no model files.
#include "scene_model.h"
#include "scene_pbr.h"
#include "scene_process.h"
#include "scene_translation.h"

#include <stdio.h>

static bool refuse(char *why, size_t why_size)
{
    snprintf(why, why_size, "this build reads no model files");
    return false;
}

bool bench_make_model(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size)
{
    (void)entry, (void)scene, (void)width, (void)height;
    return refuse(why, why_size);
}

bool bench_make_pbr(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                    char *why, size_t why_size)
{
    (void)entry, (void)scene, (void)width, (void)height;
    return refuse(why, why_size);
}

bool bench_make_translation(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                            int height, char *why, size_t why_size)
{
    (void)entry, (void)scene, (void)width, (void)height;
    return refuse(why, why_size);
}

bool bench_translate(rhw_context *context)
{
    (void)context;
    return false;
}

bool bench_make_process(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                        int height, char *why, size_t why_size)
{
    (void)entry, (void)scene, (void)width, (void)height;
    return refuse(why, why_size);
}

void bench_files_remove(struct bench_files *files)
{
    (void)files; // there are none
}

void bench_surfaces_free(struct bench_surfaces *surfaces)
{
    (void)surfaces; // there are none
}
