// SPDX-License-Identifier: MIT
// See scene_translation.h.
#include "scene_translation.h"

#include <stdio.h>

#include "shaders_link.h"
#include "shaders_words.h"

bool bench_make_translation(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                            int height, char *why, size_t why_size)
{
    struct bench_words vertex, fragment;
    (void)entry, (void)width, (void)height;
    bench_shader_words(BENCH_SHADER_LIGHTS, &vertex, &fragment);
    snprintf(why, why_size, "this program was built without glslangValidator");
    scene->translates = true;
    return vertex.size > 0 && bench_scene_allocate(scene);
}

bool bench_translate(rhw_context *context)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader_program *const program = bench_link_shader(BENCH_SHADER_LIGHTS, false, message);
    if (!program) {
        return false;
    }
    const struct rhw_pipeline_def def = {
        .program = *rhw_shader_program_get(program),
        .attributes = {{.format = RHW_VERTEX_FLOAT3}, {.format = RHW_VERTEX_FLOAT3, .offset = 12}},
        .attribute_count = 2,
        .buffer_count = 1,
        .targets = {{.format = RHW_FORMAT_RGBA8_UNORM}},
        .target_count = 1};
    rhw_pipeline pipeline;
    const bool made = rhw_pipeline_create(context, &def, &pipeline) == RHW_OK;
    if (made) {
        rhw_pipeline_destroy(context, pipeline);
    }
    rhw_shader_program_destroy(program);
    return made;
}
