// SPDX-License-Identifier: MIT
// A fitted camera as users ask for it: from an angle, through a lens, with a margin.
#ifndef SCENE_CAMERA_FRAME_H
#define SCENE_CAMERA_FRAME_H

#include "camera.h"

struct scene_framing {
    struct scene_orbit orbit;
    double yfov;       ///< radians; 0: the default
    bool orthographic; ///< then `yfov` has no say
    double zoom;       ///< above 0: what is seen is so many times as large, from the same place
    double margin;     ///< part of the picture on each side of the model, below 0.5; negative: the default
};

struct scene_camera scene_camera_frame(const struct scene_model *model, const struct scene_framing *framing,
                                       double aspect);

#endif
