// SPDX-License-Identifier: MIT
// See golden_board.h.
#include "golden_board.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void ignore(void *user, enum rhw_log_level level, const char *message)
{
    (void)user, (void)level, (void)message;
}

struct rhw_context_def golden_context_def(const struct rhw_context_def *def)
{
    struct rhw_context_def golden = *def;
    golden.log = ignore;
    if (golden.validate == RHW_VALIDATE_DEFAULT) {
        golden.validate = RHW_VALIDATE_OFF;
    }
    return golden;
}

void golden_check(enum rhw_result result, const char *what)
{
    // The assert hook decides about misuse; the usual one has ended the program.
    if (result != RHW_OK && result != RHW_ERROR_MISUSE) {
        fprintf(stderr, "golden: %s: %s\n", what, rhw_result_string(result));
        exit(2);
    }
}

rhw_texture golden_texture(rhw_context *context, enum rhw_format format, int width, int height, int levels)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.mip_levels = levels;
    rhw_texture texture;
    golden_check(rhw_texture_create(context, &def, &texture), "texture");
    return texture;
}

rhw_buffer golden_buffer(rhw_context *context, const void *data, size_t size)
{
    const struct rhw_buffer_def def = {.size = size, .data = data};
    rhw_buffer buffer;
    golden_check(rhw_buffer_create(context, &def, &buffer), "buffer");
    return buffer;
}

rhw_pipeline golden_pipeline(rhw_context *context, const struct rhw_pipeline_def *def)
{
    rhw_pipeline pipeline;
    golden_check(rhw_pipeline_create(context, def, &pipeline), "pipeline");
    return pipeline;
}

void golden_give(struct golden_images *images, enum rhw_format format, int width, int height, void *pixels)
{
    if (images->count == GOLDEN_MAX_IMAGES || pixels == NULL) {
        golden_check(RHW_ERROR_OUT_OF_MEMORY, "images");
    }
    images->image[images->count++] = (struct golden_image){format, width, height, pixels};
}

void golden_keep(struct golden_images *images, rhw_context *context, rhw_texture texture)
{
    const enum rhw_format format = rhw_texture_format(context, texture);
    const int width = rhw_texture_width(context, texture, 0),
              height = rhw_texture_height(context, texture, 0);
    golden_give(images, format, width, height,
                malloc(rhw_format_size(format) * (size_t)width * (size_t)height));
    rhw_texture_read(context, texture, 0, images->image[images->count - 1].pixels, 0);
}

void golden_images_free(struct golden_images *images)
{
    for (int i = 0; i < images->count; i++) {
        free(images->image[i].pixels);
    }
    images->count = 0;
}

float golden_random(uint64_t *state, float low, float high)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return low + (high - low) * ((float)((z ^ (z >> 31)) >> 40) / 16777216.0f);
}

void golden_cell(rhw_context *context, rhw_pass pass, int column, int row, int width, int height)
{
    const struct rhw_rect scissor = {column * width, row * height, width, height};
    const struct rhw_viewport viewport = {
        (float)scissor.x, (float)scissor.y, (float)width, (float)height, 0, 1};
    rhw_pass_set_viewport(context, pass, &viewport);
    rhw_pass_set_scissor(context, pass, &scissor);
}

void golden_board_make(struct golden_board *board, rhw_context *context, int width, int height,
                       const enum rhw_format *formats, int count)
{
    *board = (struct golden_board){
        .context = context, .width = width, .height = height, .count = count, .def = rhw_pass_def_default()};
    for (int i = 0; i < count; i++) {
        board->targets[i] = golden_texture(context, formats[i], width, height, 1);
        if (formats[i] == RHW_FORMAT_D32_FLOAT) {
            board->def.depth = (struct rhw_depth_attachment){true, board->targets[i], .clear = 1};
        } else {
            board->def.colors[i] = (struct rhw_color_attachment){.texture = board->targets[i]};
            if (rhw_format_features(formats[i]) & RHW_FEATURE_BLENDED) { // integers start at 0
                memcpy(board->def.colors[i].clear, (const float[4]){0.0625f, 0.125f, 0.25f, 1}, 16);
            }
            board->def.color_count = i + 1;
        }
    }
}

void golden_board_begin(struct golden_board *board)
{
    golden_check(rhw_pass_begin(board->context, &board->def, &board->pass), "pass");
}

void golden_board_end(struct golden_board *board)
{
    golden_check(rhw_pass_end(board->context, board->pass, NULL), "pass");
}

void golden_board_keep(const struct golden_board *board, struct golden_images *images)
{
    for (int i = 0; i < board->count; i++) {
        golden_keep(images, board->context, board->targets[i]);
    }
}
