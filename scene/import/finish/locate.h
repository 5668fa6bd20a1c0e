// SPDX-License-Identifier: MIT
// Where the model stands, when all of it is known.
#ifndef SCENE_LOCATE_H
#define SCENE_LOCATE_H

#include "import/builder/import.h"

/// Set the model's origin. If the model is far from that of the file, count the places of its instances, cameras and
/// lights from it, and the positions of meshes that are far from their own origin from a place among them.
void scene_import_locate(struct scene_import *import);
/// Set the model's origin near a place, which is given in the coordinates of the file, of something with this size.
void scene_import_locate_near(struct scene_import *import, const double middle[3], double size);

#endif
