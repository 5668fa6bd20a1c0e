// SPDX-License-Identifier: MIT
#include "picture_fields.h"

#include <string.h>

void python_picture_fields(struct scene_pictures *p, struct python_picture_field fields[PYTHON_PICTURES])
{
    const struct python_picture_field all[PYTHON_PICTURES] = {
        {"color", SCENE_OUTPUT_COLOR, (void **)&p->color, "|u1", 4},
        {"linear", SCENE_OUTPUT_LINEAR, (void **)&p->linear, "<f4", 4},
        {"display", SCENE_OUTPUT_DISPLAY, (void **)&p->display, "<f4", 4},
        {"depth", SCENE_OUTPUT_DEPTH, (void **)&p->depth, "<f4", 1},
        {"distance", SCENE_OUTPUT_DISTANCE, (void **)&p->distance, "<f4", 1},
        {"normal", SCENE_OUTPUT_NORMAL, (void **)&p->normal, "<f4", 4},
        {"position", SCENE_OUTPUT_POSITION, (void **)&p->position, "<f4", 4},
        {"uv", SCENE_OUTPUT_UV, (void **)&p->uv, "<f4", 4},
        {"object", SCENE_OUTPUT_OBJECT, (void **)&p->object, "<u4", 1},
        {"triangle", SCENE_OUTPUT_TRIANGLE, (void **)&p->triangle, "<u4", 1},
        {"barycentric", SCENE_OUTPUT_BARYCENTRIC, (void **)&p->barycentric, "<f4", 4},
    };
    memcpy(fields, all, sizeof all);
}
