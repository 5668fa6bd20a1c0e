// SPDX-License-Identifier: MIT
// Times the recording of 10,000 draws of a pass that does not run, on one thread. Each draw has uniforms of its own, and
// beside them nothing else, a texture in one slot, textures in four slots, or a binding in its uniforms. Prints
// "WHAT MICROSECONDS", of a draw, the least of some passes.
#include "times.h"

#include <rhw/shader.h>

enum { DRAWS = 10000, TEXTURES = 64, TIMES = 40, SLOTS = 4 };

struct uniforms {
    float numbers[48];
    struct rhw_binding texture;
};

struct bench {
    rhw_context *context;
    rhw_texture target, textures[TEXTURES];
    struct rhw_binding bindings[TEXTURES];
    rhw_sampler sampler;
    rhw_pipeline pipeline;
};

// How the textures of a draw are given.
enum way { UNIFORMS, SLOT, FOUR_SLOTS, BINDING, WAYS };

static void place(struct rhw_vertex1 *v)
{
    v->position[3] = 1;
}

static void paint(struct rhw_fragment1 *f)
{
    const float uv[2] = {0.5f, 0.5f};
    rhw_sample_lod1(f->bindings, 0, uv, 0, f->color[0]);
}

static void open_bench(struct bench *bench)
{
    const struct rhw_context_def context_def = {.threads = 1};
    const struct rhw_texture_def texture_def = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 64, .height = 64};
    const struct rhw_sampler_def sampler_def = {.lod_bias = 0};
    const struct rhw_pipeline_def def = {
        .program = {.vertex1 = place, .fragment1 = paint, .uniform_size = sizeof(struct uniforms)},
        .targets = {{.format = RHW_FORMAT_RGBA8_UNORM}},
        .target_count = 1};
    must(rhw_context_create(&context_def, &bench->context));
    must(rhw_texture_create(bench->context, &texture_def, &bench->target));
    must(rhw_sampler_create(bench->context, &sampler_def, &bench->sampler));
    must(rhw_pipeline_create(bench->context, &def, &bench->pipeline));
    for (int i = 0; i < TEXTURES; i++) {
        must(rhw_texture_create(bench->context, &texture_def, &bench->textures[i]));
        must(rhw_binding_of_texture(bench->context, bench->textures[i], bench->sampler, &bench->bindings[i]));
    }
}

// Return the microseconds of a draw.
static double record(const struct bench *bench, enum way way)
{
    const struct rhw_pass_def def = {.colors = {{.texture = bench->target}}, .color_count = 1};
    const int slots = way == SLOT ? 1 : way == FOUR_SLOTS ? SLOTS : 0;
    struct uniforms uniforms = {{0}, {{0}}};
    rhw_pass pass;
    must(rhw_pass_begin(bench->context, &def, &pass));
    rhw_pass_set_pipeline(bench->context, pass, bench->pipeline);
    const double start = now_us();
    for (int i = 0; i < DRAWS; i++) {
        for (int s = 0; s < slots; s++) {
            rhw_pass_set_texture(bench->context, pass, s, bench->textures[(i + s) % TEXTURES],
                                 bench->sampler);
        }
        uniforms.texture = bench->bindings[way == BINDING ? i % TEXTURES : 0];
        rhw_pass_set_uniforms(bench->context, pass, &uniforms, sizeof uniforms);
        rhw_pass_draw(bench->context, pass, 0, 3, 0, 1);
    }
    const double took = now_us() - start;
    rhw_pass_cancel(bench->context, pass);
    return took / DRAWS;
}

int main(void)
{
    static const char *const names[WAYS] = {"uniforms", "slot", "four_slots", "binding"};
    struct bench bench;
    open_bench(&bench);
    for (int way = 0; way < WAYS; way++) {
        double least = 1e9;
        for (int time = 0; time < TIMES; time++) {
            const double took = record(&bench, (enum way)way);
            least = took < least ? took : least;
        }
        printf("%s %.3f\n", names[way], least);
    }
    rhw_context_destroy(bench.context);
    return 0;
}
