// SPDX-License-Identifier: MIT
// The pictures of a draw, and the table of outputs, in which the program, the Python package and the web read what they
// say of an output.
#ifndef SCENE_OUTPUT_TABLE_H
#define SCENE_OUTPUT_TABLE_H

#include <stddef.h>

#include "scene_view.h"

/// Images of one draw; NULL where not asked for. Owned by the caller, freed by scene_pictures_free.
struct scene_pictures {
    int width, height;
    uint8_t *color;          ///< [4]
    float *linear, *display; ///< [4]
    float *depth, *distance;
    float *normal, *position, *uv, *barycentric; ///< [4]
    uint32_t *object, *triangle;
    float *overdraw;
    uint32_t *tiles, *plan;
    /// What `position` is counted from, in the coordinates of the file: the model's origin, or where parts of it are
    /// far from each other a place among what the camera is near.
    double origin[3];
};

void scene_pictures_free(struct scene_pictures *pictures);

enum scene_output_kind {
    SCENE_KIND_COLOR,
    SCENE_KIND_DEPTH, ///< from here to OVERDRAW in the order of enum scene_data_output
    SCENE_KIND_DISTANCE,
    SCENE_KIND_NORMAL,
    SCENE_KIND_POSITION,
    SCENE_KIND_UV,
    SCENE_KIND_OBJECT,
    SCENE_KIND_TRIANGLE,
    SCENE_KIND_BARYCENTRIC,
    SCENE_KIND_OVERDRAW, ///< from here to PLAN what is of the work
    SCENE_KIND_TILES,
    SCENE_KIND_PLAN,
    SCENE_KIND_LINEAR, ///< from here on what files of COLOR are made of: the command line has no name for it
    SCENE_KIND_DISPLAY,
    SCENE_KIND_COUNT
};

enum scene_element { SCENE_ELEMENT_UINT8, SCENE_ELEMENT_UINT32, SCENE_ELEMENT_FLOAT };

struct scene_output_row {
    const char *name; ///< in the Python and the npm package; the command line knows it too
    const char *word; ///< on the command line and in names of files; NULL: none
    enum scene_output output;
    enum rhw_format format; ///< format of the picture
    float empty;            ///< the first channel where nothing is; the others are 0
    bool is_of_work;        ///< tells how the picture was drawn, not what is seen
    size_t member;          ///< offset of the picture in struct scene_pictures
    const char *layer[4];   ///< channels of an EXR, NULL after the last
    const char *meaning;    ///< meaning of the numbers
    const char *shown;      ///< what a PNG makes of them, as --help says it; NULL where there is no word
};

extern const struct scene_output_row scene_outputs[SCENE_KIND_COUNT];

/// The picture of an output; NULL where it is not drawn.
void *scene_picture_get(const struct scene_pictures *pictures, enum scene_output_kind kind);
void scene_picture_set(struct scene_pictures *pictures, enum scene_output_kind kind, void *picture);
/// Numbers of a pixel, and what they are.
int scene_output_channels(enum scene_output_kind kind);
enum scene_element scene_output_element(enum scene_output_kind kind);

#endif
