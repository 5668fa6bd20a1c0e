// SPDX-License-Identifier: MIT
// A fountain: its drops are computed anew for every frame and written into one buffer, which was made once. Prints a
// number made of the last picture.
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture_hash.h"

enum { DROPS = 2000, FRAMES = 60, SIZE = 400 };

struct drop_vertex {
    float x, y, blue;
};

static void place(struct rhw_vertex1 *v)
{
    memcpy(v->position, v->attribute[0], 4 * sizeof(float)); // what the format lacks is 0, 0, 0, 1
    v->varying[0] = v->attribute[1][0];
}

static void paint(struct rhw_fragment1 *f)
{
    const float color[4] = {0.1f, 0.4f, f->varying[0], 1};
    memcpy(f->color[0], color, sizeof color);
}

// A triangle for each drop that is in the air; returns how many vertices those are.
static uint32_t move_drops(struct drop_vertex *vertices, int frame)
{
    uint32_t count = 0;
    for (int i = 0; i < DROPS; i++) {
        const float time = (float)(frame - i % FRAMES) / FRAMES;
        if (time < 0) {
            continue;
        }
        const float x = (float)(i * 7919 % 2000 - 1000) * 0.0008f * time;
        const float y = (2.6f + (float)(i % 13) * 0.03f) * time - 2.5f * time * time - 0.9f;
        vertices[count++] = (struct drop_vertex){x, y + 0.015f, 1};
        vertices[count++] = (struct drop_vertex){x - 0.01f, y, 0.5f};
        vertices[count++] = (struct drop_vertex){x + 0.01f, y, 0.5f};
    }
    return count;
}

static enum rhw_result make_pipeline(rhw_context *context, rhw_pipeline *pipeline)
{
    const struct rhw_pipeline_def def = {
        .program = {.vertex1 = place, .fragment1 = paint, .varyings = {{.components = 1}}, .varying_count = 1},
        .attributes = {{.format = RHW_VERTEX_FLOAT2},
                       {.format = RHW_VERTEX_FLOAT1, .offset = offsetof(struct drop_vertex, blue)}},
        .attribute_count = 2,
        .buffer_count = 1, // its stride of 0 is up to the end of the last attribute: 12 bytes
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}},
        .target_count = 1,
    };
    return rhw_pipeline_create(context, &def, pipeline);
}

static enum rhw_result draw_frame(rhw_context *context, rhw_pipeline pipeline, rhw_texture picture,
                                  rhw_buffer buffer, int frame)
{
    static struct drop_vertex vertices[3 * DROPS];
    const uint32_t count = move_drops(vertices, frame);
    const size_t size = count * sizeof vertices[0];
    enum rhw_result result = rhw_buffer_write(context, buffer, 0, vertices, size);
    if (result != RHW_OK) {
        return result;
    }
    struct rhw_pass_def def = {.color_count = 1};
    def.colors[0].texture = picture;
    rhw_pass pass;
    result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer_range(context, pass, 0, buffer, 0, size); // of this frame alone
    rhw_pass_draw(context, pass, 0, count, 0, 1);
    return rhw_pass_end(context, pass, NULL); // all is drawn when it returns: the buffer is free again
}

int main(void)
{
    const struct rhw_context_def def = {0};
    const struct rhw_buffer_def buffer_def = {.size = 3 * DROPS * sizeof(struct drop_vertex)};
    const struct rhw_texture_def picture_def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = SIZE, .height = SIZE};
    rhw_context *context;
    rhw_pipeline pipeline;
    rhw_buffer buffer;
    rhw_texture picture;
    bool good = rhw_context_create(&def, &context) == RHW_OK &&
                rhw_buffer_create(context, &buffer_def, &buffer) == RHW_OK &&
                rhw_texture_create(context, &picture_def, &picture) == RHW_OK &&
                make_pipeline(context, &pipeline) == RHW_OK;
    for (int frame = 0; good && frame < FRAMES; frame++) {
        good = draw_frame(context, pipeline, picture, buffer, frame) == RHW_OK;
    }
    if (good) {
        printf("%016llx\n", (unsigned long long)hash_picture(context, picture));
    }
    rhw_context_destroy(context); // NULL where it could not be created
    return good ? 0 : 1;
}
