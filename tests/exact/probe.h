// SPDX-License-Identifier: MIT
// Draws a scene with librhw through its public headers alone and reads back every number a fragment has.
#ifndef EXACT_PROBE_H
#define EXACT_PROBE_H

#include "rhw/rhw.h"
#include "scene.h"

// One pixel of a target with four channels.
typedef float probe_pixel[4];

// What was drawn, row after row from the top. A field that was not measured is NULL.
struct probe_image {
    int width, height;
    const probe_pixel *smooth, *noperspective; // the four values of the scene
    const probe_pixel *flat;      // two flat values, 1 + number of the triangle, 1 front or 2 back facing
    const probe_pixel *space;     // a, b, c, 1/W
    const probe_pixel *screen;    // r, s, t, depth
    const probe_pixel *ddx, *ddy; // of `smooth`, per pixel
    const float *count;           // fragments that landed here
    const float *depth;           // the depth attachment
};

struct probe;

// NULL when the context cannot be created.
struct probe *probe_create(int threads, enum rhw_isa isa);
void probe_destroy(struct probe *probe);
const char *probe_isa_name(const struct probe *probe);
// Valid until the next draw.
const struct probe_image *probe_draw(struct probe *probe, const struct scene *scene);

#endif
