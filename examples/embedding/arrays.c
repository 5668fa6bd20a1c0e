// SPDX-License-Identifier: MIT
// Stars drawn from arrays of the program: no buffer is made and nothing is copied. Prints a number made of the picture.
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture_hash.h"

enum { STARS = 12, WIDTH = 600, HEIGHT = 200 };

struct star {
    float x, y, size;
    float color[3];
};

// Ten corners around a centre, as pairs of floats, and the triangles between them.
static const float corners[11][2] = {{0, 0},           {0, 1},           {-0.22f, 0.31f}, {-0.95f, 0.31f},
                                     {-0.36f, -0.12f}, {-0.59f, -0.81f}, {0, -0.38f},     {0.59f, -0.81f},
                                     {0.36f, -0.12f},  {0.95f, 0.31f},   {0.22f, 0.31f}};
static const uint8_t triangles[10][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5},  {0, 5, 6},
                                         {0, 6, 7}, {0, 7, 8}, {0, 8, 9}, {0, 9, 10}, {0, 10, 1}};

static void place(struct rhw_vertex1 *v)
{
    const struct star *const star = v->uniforms;
    v->position[0] = (star->x + star->size * v->attribute[0][0]) / 3;
    v->position[1] = star->y + star->size * v->attribute[0][1];
    v->position[2] = 0;
    v->position[3] = 1;
}

static void paint(struct rhw_fragment1 *f)
{
    const struct star *const star = f->uniforms;
    memcpy(f->color[0], star->color, sizeof star->color);
    f->color[0][3] = 1;
}

static enum rhw_result make_pipeline(rhw_context *context, rhw_pipeline *pipeline)
{
    const struct rhw_pipeline_def def = {
        .program = {.vertex1 = place, .fragment1 = paint, .uniform_size = sizeof(struct star)},
        .attributes = {{.format = RHW_VERTEX_FLOAT2}},
        .attribute_count = 1,
        .buffer_count = 1,
        .targets = {{.format = RHW_FORMAT_RGBA8_SRGB}},
        .target_count = 1,
    };
    return rhw_pipeline_create(context, &def, pipeline);
}

static enum rhw_result draw(rhw_context *context, rhw_pipeline pipeline, rhw_texture picture,
                            const struct star *stars)
{
    struct rhw_pass_def def = {.color_count = 1};
    def.colors[0].texture = picture;
    rhw_pass pass;
    const enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_memory(context, pass, 0, corners, sizeof corners);
    rhw_pass_set_index_memory(context, pass, triangles, RHW_INDEX_UINT8, sizeof triangles);
    for (int i = 0; i < STARS; i++) {
        rhw_pass_set_uniform_memory(context, pass, &stars[i], sizeof stars[i]);
        rhw_pass_draw_indexed(context, pass, 0, sizeof triangles, 0, 0, 1);
    }
    return rhw_pass_end(context, pass, NULL); // until here the arrays stay as they are
}

int main(void)
{
    const struct rhw_context_def def = {0};
    const struct rhw_texture_def picture_def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = WIDTH, .height = HEIGHT};
    struct star stars[STARS];
    for (int i = 0; i < STARS; i++) {
        const float part = (float)i / STARS;
        stars[i] =
            (struct star){6 * part - 2.75f, (float)(i * 5 % 7 - 3) / 6, 0.2f + part / 4, {1, part, 1 - part}};
    }
    rhw_context *context;
    rhw_pipeline pipeline;
    rhw_texture picture;
    const bool good = rhw_context_create(&def, &context) == RHW_OK &&
                      rhw_texture_create(context, &picture_def, &picture) == RHW_OK &&
                      make_pipeline(context, &pipeline) == RHW_OK &&
                      draw(context, pipeline, picture, stars) == RHW_OK;
    if (good) {
        printf("%016llx\n", (unsigned long long)hash_picture(context, picture));
    }
    rhw_context_destroy(context); // NULL where it could not be created
    return good ? 0 : 1;
}
