// SPDX-License-Identifier: MIT
// A fitted camera as users ask for it: from an angle, through a lens, with a margin.
#ifndef SCENE_CAMERA_FRAME_H
#define SCENE_CAMERA_FRAME_H

#include "camera.h"

struct scene_framing {
    struct scene_orbit orbit;
    double yfov;       ///< radians; 0 is the default
    bool orthographic; ///< an orthographic camera takes no notice of `yfov`
    double zoom;       ///< how many times as large a thing looks, from where the camera stood; above 0
    /// Part of the picture on each side of the model, below 0.5; a negative one is the default.
    double margin;
};

struct scene_camera scene_camera_frame(const struct scene_model *model, const struct scene_framing *framing,
                                       double aspect);

#endif
