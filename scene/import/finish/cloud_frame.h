// SPDX-License-Identifier: MIT
// The box that a picture of a cloud of points is about.
#ifndef SCENE_CLOUD_FRAME_H
#define SCENE_CLOUD_FRAME_H

#include "draw/camera/subject.h"

/// Leave stray points out of the frame of a model of points alone, as reconstructions from photographs and scanners
/// have them: at most 2 of 1000 at each end of an axis, where all else is less than 0.6 times as long, and so again of
/// what is left, up to four times. A cloud of fewer than 1000 points is left alone. Return true if there were any.
bool scene_cloud_frame_trim(const struct scene_model *model, struct scene_box *frame);

#endif
