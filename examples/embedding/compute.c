// SPDX-License-Identifier: MIT
// Counts what a pass drew, by a dispatch: how many pixels of a picture have each of 8 lightnesses. The counts stand in
// memory of the program. Prints them.
#include <stdio.h>

#include "cube.h"
#include "target.h"

enum { STEPS = 8, WIDTH = 640, HEIGHT = 480 };

struct counts {
    _Alignas(RHW_MEMORY_ALIGNMENT) int32_t pixels[STEPS];
    unsigned char padding[RHW_MEMORY_PADDING]; // the library's
};

// One pixel. Pixels of all workgroups add to the counts at once, hence by atomics; what those return is not used.
static bool count(struct rhw_invocation1 *i)
{
    float texel[4];
    rhw_sample_fetch1(i->bindings, 0, i->id, 0, texel);
    const float light = 0.2126f * texel[0] + 0.7152f * texel[1] + 0.0722f * texel[2];
    const int32_t step = rhw_min_int1(rhw_int_from_float1(rhw_sqrt1(light) * STEPS), STEPS - 1);
    rhw_storage_atomic1(i->bindings, 0, RHW_STORAGE_ADD, (uint32_t)step, 1);
    return false; // no barrier
}

static enum rhw_result count_pixels(rhw_context *context, rhw_texture picture, struct counts *counts)
{
    const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST};
    const struct rhw_buffer_def memory = {
        .size = sizeof counts->pixels, .memory = counts, .memory_size = sizeof *counts};
    rhw_sampler sampler;
    rhw_buffer buffer;
    enum rhw_result result = rhw_sampler_create(context, &nearest, &sampler);
    if (result == RHW_OK) {
        result = rhw_buffer_create(context, &memory, &buffer);
    }
    if (result != RHW_OK) {
        return result;
    }
    const struct rhw_dispatch_def def = {.program = {.invocation1 = count, .size = {16, 16}},
                                         .textures = {{picture, sampler}},
                                         .buffers = {{.buffer = buffer}}};
    return rhw_dispatch(context, &def, WIDTH / 16, HEIGHT / 16, 1); // all is counted when it returns
}

int main(void)
{
    static struct counts counts;
    const struct rhw_context_def def = {0};
    struct target target = {0};
    rhw_context *context;
    rhw_pipeline pipeline;
    if (rhw_context_create(&def, &context) != RHW_OK) {
        return 1;
    }
    enum rhw_result result = cube_pipeline(context, &pipeline);
    if (result == RHW_OK) {
        result = target_fit(context, &target, WIDTH, HEIGHT);
    }
    if (result == RHW_OK) {
        result = cube_draw(context, pipeline, target.texture, 0.5f);
    }
    if (result == RHW_OK) {
        result = count_pixels(context, target.texture, &counts);
    }
    rhw_context_destroy(context);
    if (result != RHW_OK) {
        fprintf(stderr, "compute: %s\n", rhw_result_string(result));
        return 1;
    }
    for (int i = 0; i < STEPS; i++) {
        printf("%d/%d %d\n", i, STEPS, (int)counts.pixels[i]);
    }
    return 0;
}
