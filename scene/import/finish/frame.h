// SPDX-License-Identifier: MIT
// The box that a picture of a model is about.
#ifndef SCENE_FRAME_H
#define SCENE_FRAME_H

#include "import/builder/import.h"
#include "seen.h"

/// Set the model's frame: the bounds without what is not seen, and without specks far away. Specks are left out where
/// a gap of 16 times the size of all else lies before them, nothing of them is longer than a tenth of it, and they make
/// up no more than a fiftieth of all area and of all lines and points. A warning tells of them.
void scene_frame_find(struct scene_import *import, const struct scene_seen_mesh *seen);

#endif
