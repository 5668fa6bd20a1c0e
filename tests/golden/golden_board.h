// SPDX-License-Identifier: MIT
// What golden scenes are made with: resources that cannot fail, the images a scene gives, cells of a grid.
#ifndef GOLDEN_BOARD_H
#define GOLDEN_BOARD_H

#include <rhw/rhw.h>

enum { GOLDEN_MAX_IMAGES = 24 };

struct golden_image {
    enum rhw_format format;
    int width, height;
    void *pixels;
};

/// What a scene has drawn; all of it is hashed, in order.
struct golden_images {
    int count;
    struct golden_image image[GOLDEN_MAX_IMAGES];
};

/// Ends the program where `result` is no success.
/// The definition with what golden scenes ask for: without optimization too they are validated where it says so alone, as
/// some read outside their buffers, and warnings about what they do on purpose are left out.
struct rhw_context_def golden_context_def(const struct rhw_context_def *def);

void golden_check(enum rhw_result result, const char *what);

rhw_texture golden_texture(rhw_context *context, enum rhw_format format, int width, int height, int levels);
rhw_buffer golden_buffer(rhw_context *context, const void *data, size_t size);
rhw_pipeline golden_pipeline(rhw_context *context, const struct rhw_pipeline_def *def);

/// Copies level 0 of a texture to the images.
void golden_keep(struct golden_images *images, rhw_context *context, rhw_texture texture);
/// The image takes over `pixels`, which were malloced.
void golden_give(struct golden_images *images, enum rhw_format format, int width, int height, void *pixels);
void golden_images_free(struct golden_images *images);

/// The next of a sequence of floats within low..high.
float golden_random(uint64_t *state, float low, float high);

/// Viewport and scissor become the cell at a column and row of a grid.
void golden_cell(rhw_context *context, rhw_pass pass, int column, int row, int width, int height);

/// A pass over new textures of these formats, D32 among them at most once and last; they are in `targets`.
struct golden_board {
    rhw_context *context;
    int width, height, count;
    rhw_texture targets[RHW_MAX_COLOR_ATTACHMENTS + 1];
    struct rhw_pass_def def; ///< clears to a dark blue and depth 1
    rhw_pass pass;
};

void golden_board_make(struct golden_board *board, rhw_context *context, int width, int height,
                       const enum rhw_format *formats, int count);
/// Begins a pass of board->def.
void golden_board_begin(struct golden_board *board);
void golden_board_end(struct golden_board *board);
/// Copies all targets to the images.
void golden_board_keep(const struct golden_board *board, struct golden_images *images);

#endif
