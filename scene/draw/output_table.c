// SPDX-License-Identifier: MIT
// The rows of the table of outputs. Whoever adds an output begins here.
#include "output_table.h"

#include <stdlib.h>
#include <string.h>

const struct scene_output_row scene_outputs[SCENE_KIND_COUNT] = {
    [SCENE_KIND_COLOR] =
        {
            .name = "color",
            .word = "color",
            .output = SCENE_OUTPUT_COLOR,
            .format = RHW_FORMAT_RGBA8_SRGB,
            .member = offsetof(struct scene_pictures, color),
            .meaning = "sRGB, straight alpha",
            .shown = "the picture, sRGB encoded; with alpha on a transparent background",
        },
    [SCENE_KIND_DEPTH] =
        {
            .name = "depth",
            .word = "depth",
            .output = SCENE_OUTPUT_DEPTH,
            .format = RHW_FORMAT_R32_FLOAT,
            .empty = 1.0f,
            .member = offsetof(struct scene_pictures, depth),
            .layer = {"depth.Z"},
            .meaning = "of a depth buffer, 0 near to 1 far; 1 where nothing is",
            .shown = "0 near to 1 far, linear on the screen; nearest white, farthest dark grey, 16 bits",
        },
    [SCENE_KIND_DISTANCE] =
        {
            .name = "distance",
            .word = "distance",
            .output = SCENE_OUTPUT_DISTANCE,
            .format = RHW_FORMAT_R32_FLOAT,
            .empty = __builtin_inff(),
            .member = offsetof(struct scene_pictures, distance),
            .layer = {"distance.Z"},
            .meaning = "along the view (Z, not the ray) in the model's unit; infinity where nothing is",
            .shown = "along the view, in the model's units; shown as depth is",
        },
    [SCENE_KIND_NORMAL] =
        {
            .name = "normal",
            .word = "normal",
            .output = SCENE_OUTPUT_NORMAL,
            .format = RHW_FORMAT_RGBA32_FLOAT,
            .member = offsetof(struct scene_pictures, normal),
            .layer = {"normal.X", "normal.Y", "normal.Z", "normal.A"},
            .meaning = "in the world, turned to the viewer; 0 where nothing is",
            .shown = "in the world, 0.5 + 0.5 n",
        },
    [SCENE_KIND_POSITION] =
        {
            .name = "position",
            .word = "position",
            .output = SCENE_OUTPUT_POSITION,
            .format = RHW_FORMAT_RGBA32_FLOAT,
            .member = offsetof(struct scene_pictures, position),
            .layer = {"position.X", "position.Y", "position.Z", "position.A"},
            .meaning = "in the world; 0 where nothing is",
            .shown = "in the world, 0..1 from one end of the model's bounding box to the other",
        },
    [SCENE_KIND_UV] =
        {
            .name = "uv",
            .word = "uv",
            .output = SCENE_OUTPUT_UV,
            .format = RHW_FORMAT_RGBA32_FLOAT,
            .member = offsetof(struct scene_pictures, uv),
            .layer = {"uv.U", "uv.V"},
            .meaning = "texture coordinates; 0 where nothing is",
            .shown = "first texture coordinates without their integer part, in red and green",
        },
    [SCENE_KIND_OBJECT] =
        {
            .name = "object",
            .word = "object",
            .output = SCENE_OUTPUT_OBJECT,
            .format = RHW_FORMAT_R32_UINT,
            .member = offsetof(struct scene_pictures, object),
            .layer = {"object.id"},
            .meaning = "the number of the node that is seen; 0 where nothing is",
            .shown = "a colour for each node that draws",
        },
    [SCENE_KIND_TRIANGLE] =
        {
            .name = "triangle",
            .word = "triangle",
            .output = SCENE_OUTPUT_TRIANGLE,
            .format = RHW_FORMAT_R32_UINT,
            .member = offsetof(struct scene_pictures, triangle),
            .layer = {"triangle.id"},
            .meaning = "1 + its number, nodes in their order; 0 where nothing is",
            .shown = "a colour for each triangle",
        },
    [SCENE_KIND_BARYCENTRIC] =
        {
            .name = "barycentric",
            .word = "bary",
            .output = SCENE_OUTPUT_BARYCENTRIC,
            .format = RHW_FORMAT_RGBA32_FLOAT,
            .member = offsetof(struct scene_pictures, barycentric),
            .layer = {"bary.a", "bary.b", "bary.c"},
            .meaning = "weights of the triangle's vertices; 0 where nothing is",
            .shown = "the weights a, b, c of the three vertices in red, green and blue; also barycentric",
        },
    [SCENE_KIND_OVERDRAW] =
        {
            .name = "overdraw",
            .word = "overdraw",
            .output = SCENE_OUTPUT_OVERDRAW,
            .format = RHW_FORMAT_R32_FLOAT,
            .is_of_work = true,
            .member = offsetof(struct scene_pictures, overdraw),
            .layer = {"overdraw.count"},
            .meaning = "surfaces above each other, seen or not",
            .shown = "how many surfaces lie above each other, seen or not",
        },
    [SCENE_KIND_TILES] =
        {
            .name = "tiles",
            .word = "tiles",
            .output = SCENE_OUTPUT_TILES,
            .format = RHW_FORMAT_R32_UINT,
            .is_of_work = true,
            .member = offsetof(struct scene_pictures, tiles),
            .layer = {"tiles.triangles"},
            .meaning = "triangles of the pixel's tile",
            .shown = "triangles of the pixel's tile of 64x64, over the picture in grey",
        },
    [SCENE_KIND_PLAN] =
        {
            .name = "plan",
            .word = "plan",
            .output = SCENE_OUTPUT_PLAN,
            .format = RHW_FORMAT_R32_UINT,
            .is_of_work = true,
            .member = offsetof(struct scene_pictures, plan),
            .layer = {"plan.bits"},
            .meaning = "or-ed rhw_tile_order of the tile",
            .shown =
                "how hidden surfaces are left out there: blue in order, orange depth first, green backwards",
        },
    [SCENE_KIND_LINEAR] =
        {
            .name = "linear",
            .output = SCENE_OUTPUT_LINEAR,
            .format = RHW_FORMAT_RGBA32_FLOAT,
            .member = offsetof(struct scene_pictures, linear),
            .layer = {"R", "G", "B", "A"},
            .meaning = "light before tone mapping, premultiplied, without background",
        },
    [SCENE_KIND_DISPLAY] =
        {
            .name = "display",
            .output = SCENE_OUTPUT_DISPLAY,
            .format = RHW_FORMAT_RGBA32_FLOAT,
            .member = offsetof(struct scene_pictures, display),
            .meaning = "color before it is encoded and rounded",
        },
};

void *scene_picture_get(const struct scene_pictures *pictures, enum scene_output_kind kind)
{
    void *picture;
    memcpy(&picture, (const char *)pictures + scene_outputs[kind].member, sizeof picture);
    return picture;
}

void scene_picture_set(struct scene_pictures *pictures, enum scene_output_kind kind, void *picture)
{
    memcpy((char *)pictures + scene_outputs[kind].member, &picture, sizeof picture);
}

int scene_output_channels(enum scene_output_kind kind)
{
    const enum rhw_format format = scene_outputs[kind].format;
    return format == RHW_FORMAT_R32_FLOAT || format == RHW_FORMAT_R32_UINT ? 1 : 4;
}

enum scene_element scene_output_element(enum scene_output_kind kind)
{
    switch (scene_outputs[kind].format) {
    case RHW_FORMAT_RGBA8_SRGB: return SCENE_ELEMENT_UINT8;
    case RHW_FORMAT_R32_UINT: return SCENE_ELEMENT_UINT32;
    default: return SCENE_ELEMENT_FLOAT;
    }
}

void scene_pictures_free(struct scene_pictures *pictures)
{
    for (int kind = 0; kind < SCENE_KIND_COUNT; kind++) {
        free(scene_picture_get(pictures, (enum scene_output_kind)kind));
    }
    *pictures = (struct scene_pictures){0};
}
