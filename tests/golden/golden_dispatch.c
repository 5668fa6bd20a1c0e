// SPDX-License-Identifier: MIT
// Golden scene of dispatches: waves computed into an image, floats added up along its rows in shared memory, a blur of
// the sums with one invocation at a time, and numbers that workgroups, vertices and fragments took from atomics.
#include "golden_scenes.h"

#include <rhw/shader.h>

#include <stdlib.h>

enum { WIDTH = 100, HEIGHT = 60, GROUPS = (WIDTH + RHW_LANES - 1) / RHW_LANES, SHARDS = 60 };

// The grid is larger than the image; what lies outside is not written.
static void waves(struct rhw_workgroup *w)
{
    for (int g = 0; g < w->count; g++) {
        const struct rhw_invocations *const i = &w->groups[g];
        const rhw_float x = rhw_float_from_int(i->id[0]), y = rhw_float_from_int(i->id[1]);
        const rhw_float texel[4] = {rhw_sin(x * 0.21f + y * 0.13f), rhw_cos(x * 0.05f - y * 0.4f),
                                    rhw_exp2(rhw_sin(x * y * 0.01f)), rhw_splat(1)};
        rhw_image_store(w->bindings, 0, i->id, &i->mask, texel);
    }
}

static void add_rows(struct rhw_workgroup *w)
{
    float *const sums = w->shared;
    rhw_float before[GROUPS];
    for (int g = 0; g < w->count; g++) {
        const rhw_int at[2] = {w->groups[g].index, rhw_splat_int(w->id[0])};
        rhw_float texel[4];
        rhw_image_load(w->bindings, 0, at, texel);
        rhw_store(&sums[g * RHW_LANES], texel[0] * texel[2] + texel[1]);
    }
    for (int reach = 1; reach < WIDTH; reach *= 2) {
        for (int g = 0; g < w->count; g++) {
            before[g] = rhw_gather(sums, WIDTH, w->groups[g].index - reach);
        }
        for (int g = 0; g < w->count; g++) {
            rhw_store(&sums[g * RHW_LANES], rhw_load(&sums[g * RHW_LANES]) + before[g]);
        }
    }
    for (int g = 0; g < w->count; g++) {
        const rhw_int at[2] = {w->groups[g].index, rhw_splat_int(w->id[0])};
        const rhw_float sum = rhw_load(&sums[g * RHW_LANES]);
        const rhw_float texel[4] = {sum, sum * 0.5f, rhw_splat(0), rhw_splat(1)};
        rhw_image_store(w->bindings, 1, at, &w->groups[g].mask, texel);
    }
}

// The mean of 9 samples, which invocations of a workgroup hand on in shared memory: first along rows, then along columns.
static bool blur1(struct rhw_invocation1 *i)
{
    float(*const mean)[4] = i->shared;
    float *const own = mean[i->index];
    if (i->step == 0) {
        for (int n = -1; n <= 1; n++) {
            const float at[2] = {((float)(i->id[0] + n) + 0.25f) / WIDTH, ((float)i->id[1] + 0.5f) / HEIGHT};
            float texel[4];
            rhw_sample_lod1(i->bindings, 0, at, 0, texel);
            for (int c = 0; c < 4; c++) {
                own[c] += texel[c] / 3;
            }
        }
        return true;
    }
    float sum[4] = {0};
    for (int n = -1; n <= 1; n++) {
        const int y = i->local[1] + n;
        const float *const other = mean[y >= 0 && y < i->size[1] ? i->index + n * i->size[0] : i->index];
        for (int c = 0; c < 4; c++) {
            sum[c] += other[c] / 3;
        }
    }
    rhw_image_store1(i->bindings, 0, i->id, sum);
    return false;
}

static void take_number(struct rhw_workgroup *w)
{
    const int32_t number = rhw_storage_atomic1(w->bindings, 0, RHW_STORAGE_ADD, 0, 1 + w->id[0] % 3);
    rhw_storage_store1(w->bindings, 1, (uint32_t)(w->id[1] * WIDTH + w->id[0]), number);
}

static void number_vertices(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        const rhw_int number =
            rhw_storage_atomic(v->bindings, 0, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1), v->mask);
        for (int c = 0; c < 4; c++) {
            v->position[c] = v->attribute[0][c];
        }
        v->varying[0] = rhw_float_from_int(number);
    }
}

static void number_fragments(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        const rhw_int number =
            rhw_storage_atomic(f->bindings, 0, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1), f->mask);
        f->color[0][0] = rhw_float_from_int(number);
        f->color[0][1] = f->varying[0];
        f->color[0][2] = f->color[0][3] = rhw_splat(1);
    }
}

static void draw_numbers(rhw_context *context, rhw_buffer counter, struct golden_images *images)
{
    const enum rhw_format format = RHW_FORMAT_RGBA32_FLOAT;
    float shards[3 * SHARDS][4];
    uint64_t random = 21;
    for (int i = 0; i < 3 * SHARDS; i++) {
        const float w = golden_random(&random, 0.5f, 2);
        for (int c = 0; c < 2; c++) {
            shards[i][c] = golden_random(&random, -1.1f, 1.1f) * w;
        }
        shards[i][2] = 0;
        shards[i][3] = w;
    }
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = {number_vertices},
                                       .fragment = {number_fragments},
                                       .varyings = {{.components = 1}},
                                       .varying_count = 1,
                                       .uses = RHW_USE_EFFECTS,
                                       .vertex_effects = true,
                                       .uses_atomic_results = true};
    def.attributes[0] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT4};
    def.attribute_count = 1;
    def.buffer_count = 1;
    def.targets[0].format = format;
    struct golden_board board;
    golden_board_make(&board, context, 2 * WIDTH, 2 * HEIGHT, &format, 1);
    golden_board_begin(&board);
    rhw_pass_set_storage_buffer(context, board.pass, 0, counter, 0, 0);
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, shards, sizeof shards), 0);
    rhw_pass_draw(context, board.pass, 0, 3 * SHARDS, 0, 1);
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_dispatch_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    static const uint32_t counts[3] = {HEIGHT, 1, 1};
    const struct rhw_sampler_def sampler_def = {.address_u = RHW_ADDRESS_MIRROR};
    const rhw_texture waved = golden_texture(context, RHW_FORMAT_RGBA32_FLOAT, WIDTH, HEIGHT, 1),
                      summed = golden_texture(context, RHW_FORMAT_RGBA16_FLOAT, WIDTH, HEIGHT, 1),
                      blurred = golden_texture(context, RHW_FORMAT_RGBA8_SRGB, WIDTH, HEIGHT, 1);
    const rhw_buffer numbers = golden_buffer(context, NULL, sizeof(int32_t) * WIDTH * HEIGHT),
                     counter = golden_buffer(context, NULL, 4),
                     indirect = golden_buffer(context, counts, sizeof counts);
    rhw_sampler sampler;
    golden_check(rhw_sampler_create(context, &sampler_def, &sampler), "sampler");
    struct rhw_dispatch_def def = {.program = {.workgroup = {waves}, .size = {16, 3}},
                                   .images = {{.texture = waved}}};
    golden_check(rhw_dispatch(context, &def, 7, 21, 1), "waves");
    def = (struct rhw_dispatch_def){.program = {.workgroup = {add_rows},
                                                .size = {WIDTH},
                                                .shared_size = GROUPS * RHW_LANES * sizeof(float)},
                                    .images = {{.texture = waved, .read_only = true}, {.texture = summed}}};
    golden_check(rhw_dispatch_indirect(context, &def, indirect, 0), "sums");
    def = (struct rhw_dispatch_def){
        .program = {.invocation1 = blur1, .size = {10, 6}, .shared_size = 60 * 4 * sizeof(float)},
        .textures = {{summed, sampler}},
        .images = {{.texture = blurred}}};
    golden_check(rhw_dispatch(context, &def, WIDTH / 10, HEIGHT / 6, 1), "blur");
    def = (struct rhw_dispatch_def){.program = {.workgroup = {take_number}, .uses_atomic_results = true},
                                    .buffers = {{.buffer = counter}, {.buffer = numbers}}};
    golden_check(rhw_dispatch(context, &def, WIDTH, HEIGHT, 1), "numbers");
    golden_keep(images, context, waved);
    golden_keep(images, context, summed);
    golden_keep(images, context, blurred);
    int32_t *const taken = malloc(sizeof *taken * WIDTH * HEIGHT);
    golden_check(rhw_buffer_read(context, numbers, 0, taken, sizeof *taken * WIDTH * HEIGHT), "numbers");
    golden_give(images, RHW_FORMAT_R32_UINT, WIDTH, HEIGHT, taken);
    draw_numbers(context, counter, images);
}
