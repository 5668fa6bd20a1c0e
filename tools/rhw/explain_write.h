// SPDX-License-Identifier: MIT
// How rhw explain says what it found: as a worked example to read, as JSON, and as a picture.
#ifndef CLI_EXPLAIN_WRITE_H
#define CLI_EXPLAIN_WRITE_H

#include "history.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

struct cli_explanation {
    const char *model_path;
    const struct scene_model *model;
    double origin[3]; ///< what positions count from, in the coordinates of the file
    const struct cli_history *history;
    int x, y, width, height; ///< the picture and its pixel
    int side; ///< of the grid of pixels that are drawn for one of the picture: 1 without --supersample
    int drawn_x, drawn_y, drawn_width, drawn_height; ///< the one that is explained, and all
    int sample, samples;                             ///< of each that is drawn
    const uint8_t *picture;                          ///< [height][width][4], sRGB
    bool is_orthographic;                            ///< seen without perspective: every W is 1
    bool has_nearest; ///< where the model is seen; else it is seen nowhere in the picture
    int nearest_x, nearest_y;
};

void cli_explain_text(FILE *out, const struct cli_explanation *explanation);
void cli_explain_json(const struct cli_explanation *explanation);
/// Draws the triangle of what is seen around the pixel into an SVG file. Reports failure.
bool cli_explain_picture(const struct cli_explanation *explanation, const char *path);

/// Where a texture is read.
struct cli_texture_place {
    enum rhw_address address[2]; ///< of u and v
    bool is_beyond[2];           ///< u or v lies outside of 0..1
    bool is_border;              ///< the border's colour is read
    double inside[2];            ///< in texels from the middle of the first, as the address modes have it
    enum rhw_filter filter; ///< LINEAR: the four texels around are mixed; NEAREST: the nearest of them is taken
};

struct cli_texture_place cli_texture_place(const struct scene_texture_look *look,
                                           const struct scene_texture_slot *slot);

/// P, where the values of a shaded fragment are taken, in pixels that are drawn.
static inline void cli_explained_place(const struct rhw_explained_fragment *f, double place[2])
{
    place[0] = (f->sample_x >> 8) + (double)f->place[0];
    place[1] = (f->sample_y >> 8) + (double)f->place[1];
}

/// The pixel itself, [4].
static inline const uint8_t *cli_explained_color(const struct cli_explanation *e)
{
    return e->picture + 4 * ((size_t)e->y * (size_t)e->width + (size_t)e->x);
}

#endif
