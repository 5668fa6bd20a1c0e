// SPDX-License-Identifier: MIT
// Colours of vertices and faces as files store them: sRGB, of bytes, of words, or of numbers from 0 to 1, and seldom
// with a word for which of these they are.
#ifndef SCENE_STORED_COLORS_H
#define SCENE_STORED_COLORS_H

#include "import.h"

/// The stored numbers that stand for 1.
struct scene_color_scale {
    float color, alpha;
};

/// Find the scale by the largest number. It is 1 where no number reaches 2, else 255, else 65535. Alpha has a scale of
/// its own, as files write 1 beside colours of 0 to 255.
struct scene_color_scale scene_import_color_scale(const float (*colors)[4], size_t count);
/// Make stored colours linear. What lies outside of the scale is limited to it. Alpha that is 0 everywhere means a
/// writer without alpha and becomes 1. Return true if any colour is translucent then.
bool scene_import_decode_colors(float (*colors)[4], size_t count, struct scene_color_scale scale);
/// Give each primitive of a mesh vertices of its own and one colour, which is `colors[rows[primitive]]`, or
/// `colors[primitive]` if `rows` is NULL.
void scene_import_color_primitives(struct scene_import *import, struct scene_mesh *mesh,
                                   const float (*colors)[4], const uint32_t *rows);

#endif
