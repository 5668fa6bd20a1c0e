// SPDX-License-Identifier: MIT
// A pass of many squares is recorded once and run for each frame. The squares turn, because each run reads the angle
// that stands in the program's memory. Prints a number made of the picture for each frame.
#include <stdio.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture_hash.h"

enum { ROWS = 20, COLUMNS = 30, SIZE = 12 };

// What the squares see of a frame: the cosine and the sine of their angle.
struct frame {
    float turn[2];
};

static void place(struct rhw_vertex1 *v)
{
    const struct frame *const frame = v->uniforms;
    const float x = v->vertex_index & 1 ? 0.7f : -0.7f, y = v->vertex_index & 2 ? 0.7f : -0.7f;
    const int column = v->instance_index % COLUMNS, row = v->instance_index / COLUMNS;
    v->position[0] =
        ((float)column + 0.5f + 0.5f * (x * frame->turn[0] - y * frame->turn[1])) * 2 / COLUMNS - 1;
    v->position[1] = ((float)row + 0.5f + 0.5f * (x * frame->turn[1] + y * frame->turn[0])) * 2 / ROWS - 1;
    v->position[2] = 0;
    v->position[3] = 1;
    v->varying[0] = (float)column / COLUMNS;
    v->varying[1] = (float)row / ROWS;
}

static void paint(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->varying[0];
    f->color[0][1] = f->varying[1];
    f->color[0][2] = 0.5f;
    f->color[0][3] = 1;
}

static enum rhw_result make_pipeline(rhw_context *context, rhw_pipeline *pipeline)
{
    const struct rhw_pipeline_def def = {
        .program = {.vertex1 = place,
                    .fragment1 = paint,
                    .varyings = {{.components = 2, .qualifier = RHW_FLAT}},
                    .varying_count = 1,
                    .uniform_size = sizeof(struct frame)},
        .topology = RHW_TRIANGLE_STRIP,
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}},
        .target_count = 1,
    };
    return rhw_pipeline_create(context, &def, pipeline);
}

// Record the squares, each a draw of its own. `frame` stays where it is as long as the recording is run.
static enum rhw_result record(rhw_context *context, rhw_pipeline pipeline, rhw_texture picture,
                              const struct frame *frame, rhw_recording **recording)
{
    struct rhw_pass_def def = {.color_count = 1};
    def.colors[0].texture = picture;
    rhw_context *recorder;
    rhw_pass pass;
    enum rhw_result result = rhw_recorder_create(context, &recorder);
    if (result != RHW_OK) {
        return result;
    }
    result = rhw_pass_begin(recorder, &def, &pass);
    if (result == RHW_OK) {
        rhw_pass_set_pipeline(recorder, pass, pipeline);
        rhw_pass_set_uniform_memory(recorder, pass, frame, sizeof *frame);
        for (uint32_t i = 0; i < ROWS * COLUMNS; i++) {
            rhw_pass_draw(recorder, pass, 0, 4, i, 1);
        }
        result = rhw_pass_keep(recorder, pass, NULL, recording);
    }
    rhw_context_destroy(recorder);
    return result;
}

int main(void)
{
    static const struct frame frames[] = {{{1, 0}}, {{0.8f, 0.6f}}, {{0.6f, 0.8f}}, {{1, 0}}};
    const struct rhw_context_def def = {0};
    const struct rhw_texture_def picture_def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = COLUMNS * SIZE, .height = ROWS * SIZE};
    struct frame frame = frames[0];
    rhw_context *context;
    rhw_pipeline pipeline;
    rhw_texture picture;
    rhw_recording *recording = NULL;
    bool good = rhw_context_create(&def, &context) == RHW_OK &&
                rhw_texture_create(context, &picture_def, &picture) == RHW_OK &&
                make_pipeline(context, &pipeline) == RHW_OK &&
                record(context, pipeline, picture, &frame, &recording) == RHW_OK;
    for (size_t i = 0; good && i < sizeof frames / sizeof *frames; i++) {
        frame = frames[i];
        good = rhw_recording_run(context, recording, NULL) == RHW_OK;
        if (good) {
            printf("%016llx\n", (unsigned long long)hash_picture(context, picture));
        }
    }
    rhw_recording_destroy(recording);
    rhw_context_destroy(context); // NULL where it could not be created
    return good ? 0 : 1;
}
