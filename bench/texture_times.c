// SPDX-License-Identifier: MIT
// Times a pass of one small triangle that reads a texture of 1024 x 1024 texels in sRGB, on one thread: the library's own,
// one on the caller's memory of which changes are told, the same after a change of all of it was told, and one on the
// caller's memory that is assumed to change. Prints "WHAT MICROSECONDS", of a pass, the least of some.
#include "times.h"

#include <rhw/shader.h>
#include <string.h>

enum { SIDE = 1024, SIZE = SIDE * SIDE * 4 + RHW_MEMORY_ALIGNMENT, TIMES = 200 };

enum kind { OWN, TOLD, TOLD_CHANGED, ASSUMED, KINDS };

static void place(struct rhw_vertex1 *v)
{
    v->position[0] = v->vertex_index == 1 ? 0.1f : 0;
    v->position[1] = v->vertex_index == 2 ? 0.1f : 0;
    v->position[3] = 1;
}

static void paint(struct rhw_fragment1 *f)
{
    const float uv[2] = {0.5f, 0.5f};
    rhw_sample_lod1(f->bindings, 0, uv, 0, f->color[0]);
}

static rhw_texture make(rhw_context *context, enum kind kind, void *memory)
{
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_SRGB,
                                        .width = SIDE,
                                        .height = SIDE,
                                        .memory = kind == OWN ? NULL : memory,
                                        .memory_size = kind == OWN ? 0 : SIZE,
                                        .memory_is_told = kind == TOLD || kind == TOLD_CHANGED};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture));
    return texture;
}

int main(void)
{
    static const char *const names[KINDS] = {"own", "told", "told_changed", "assumed"};
    const struct rhw_context_def context_def = {.threads = 1};
    const struct rhw_texture_def target_def = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 64, .height = 64};
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    const struct rhw_pipeline_def def = {.program = {.vertex1 = place, .fragment1 = paint},
                                         .targets = {{.format = RHW_FORMAT_RGBA8_UNORM}},
                                         .target_count = 1};
    rhw_context *context;
    rhw_texture target;
    rhw_sampler sampler;
    rhw_pipeline pipeline;
    void *const memory = aligned_alloc(RHW_MEMORY_ALIGNMENT, SIZE);
    if (memory == NULL) {
        must(RHW_ERROR_OUT_OF_MEMORY);
        return 1;
    }
    memset(memory, 0, SIZE);
    must(rhw_context_create(&context_def, &context));
    must(rhw_texture_create(context, &target_def, &target));
    must(rhw_sampler_create(context, &sampler_def, &sampler));
    must(rhw_pipeline_create(context, &def, &pipeline));
    for (int kind = 0; kind < KINDS; kind++) {
        const rhw_texture texture = make(context, (enum kind)kind, memory);
        double least = 1e9;
        for (int time = 0; time < TIMES; time++) {
            const struct rhw_pass_def pass_def = {.colors = {{.texture = target}}, .color_count = 1};
            rhw_pass pass;
            const double start = now_us();
            if (kind == TOLD_CHANGED) {
                must(rhw_texture_changed(context, texture, 0, 0, 0));
            }
            must(rhw_pass_begin(context, &pass_def, &pass));
            rhw_pass_set_pipeline(context, pass, pipeline);
            rhw_pass_set_texture(context, pass, 0, texture, sampler);
            rhw_pass_draw(context, pass, 0, 3, 0, 1);
            must(rhw_pass_end(context, pass, NULL));
            const double took = now_us() - start;
            least = took < least ? took : least;
        }
        printf("%s %.1f\n", names[kind], least);
        rhw_texture_destroy(context, texture);
    }
    rhw_context_destroy(context);
    free(memory);
    return 0;
}
