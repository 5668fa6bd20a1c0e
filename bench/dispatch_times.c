// SPDX-License-Identifier: MIT
// Times dispatches: what one costs that does nothing, and a blur of 960 × 540 texels beside the same blur as a pass, on
// one thread. Prints "WHAT MICROSECONDS", the least of some. valgrind counts the instructions of each:
//   dispatch_times WHAT   does one thing alone, 10 times: nothing, many, dispatch or pass
#include "dispatch_blur.h"
#include "times.h"

#include <string.h>

enum { WIDTH = 960, HEIGHT = 540, TIMES = 10, SIDE = 8 };

struct bench {
    rhw_context *context;
    rhw_texture from, to;
    rhw_sampler sampler;
    rhw_pipeline pipeline;
};

static void open_bench(struct bench *bench)
{
    const struct rhw_context_def def = {.threads = 1};
    const struct rhw_texture_def texture = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = WIDTH, .height = HEIGHT};
    const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST};
    const struct rhw_pipeline_def pipeline = {.program = {.vertex = RHW_ISA_TABLE(bench_cover),
                                                          .fragment = RHW_ISA_TABLE(bench_blur_fragments),
                                                          .uses = RHW_USE_COORD},
                                              .targets = {{.format = RHW_FORMAT_RGBA8_UNORM}},
                                              .target_count = 1};
    static unsigned char texels[4 * WIDTH * HEIGHT];
    for (size_t i = 0; i < sizeof texels; i++) {
        texels[i] = (unsigned char)(i * 2654435761u >> 24);
    }
    must(rhw_context_create(&def, &bench->context));
    must(rhw_texture_create(bench->context, &texture, &bench->from));
    must(rhw_texture_create(bench->context, &texture, &bench->to));
    must(rhw_texture_write(bench->context, bench->from, 0, texels, 0));
    must(rhw_sampler_create(bench->context, &nearest, &bench->sampler));
    must(rhw_pipeline_create(bench->context, &pipeline, &bench->pipeline));
}

static void dispatch_nothing(const struct bench *bench, uint32_t workgroups)
{
    const struct rhw_dispatch_def def = {.program = {.workgroup = RHW_ISA_TABLE(bench_do_nothing)}};
    must(rhw_dispatch(bench->context, &def, workgroups, 1, 1));
}

static void blur_by_dispatch(const struct bench *bench)
{
    const struct rhw_dispatch_def def = {
        .program = {.workgroup = RHW_ISA_TABLE(bench_blur_workgroup), .size = {4 * SIDE, SIDE}},
        .textures = {{bench->from, bench->sampler}},
        .images = {{.texture = bench->to}}};
    must(rhw_dispatch(bench->context, &def, WIDTH / (4 * SIDE), (HEIGHT + SIDE - 1) / SIDE, 1));
}

static void blur_by_pass(const struct bench *bench)
{
    const struct rhw_pass_def def = {.colors = {{.texture = bench->to, .load = RHW_LOAD_DISCARD}},
                                     .color_count = 1};
    rhw_pass pass;
    must(rhw_pass_begin(bench->context, &def, &pass));
    rhw_pass_set_pipeline(bench->context, pass, bench->pipeline);
    rhw_pass_set_texture(bench->context, pass, 0, bench->from, bench->sampler);
    rhw_pass_draw(bench->context, pass, 0, 3, 0, 1);
    must(rhw_pass_end(bench->context, pass, NULL));
}

static void run(const struct bench *bench, const char *what)
{
    if (strcmp(what, "nothing") == 0) {
        dispatch_nothing(bench, 1);
    } else if (strcmp(what, "many") == 0) {
        dispatch_nothing(bench, 1000);
    } else if (strcmp(what, "dispatch") == 0) {
        blur_by_dispatch(bench);
    } else {
        blur_by_pass(bench);
    }
}

int main(int argc, char **argv)
{
    static const char *const all[] = {"nothing", "many", "dispatch", "pass"};
    struct bench bench;
    open_bench(&bench);
    for (int i = 0; i < 4; i++) {
        double least = 1e9;
        if (argc > 1 && strcmp(argv[1], all[i]) != 0) {
            continue;
        }
        for (int time = 0; time < TIMES; time++) {
            const double start = now_us();
            run(&bench, all[i]);
            const double took = now_us() - start;
            least = took < least ? took : least;
        }
        printf("%s %.2f\n", all[i], least);
    }
    rhw_context_destroy(bench.context);
    return 0;
}
