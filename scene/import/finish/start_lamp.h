// SPDX-License-Identifier: MIT
// The lamp that every new file of Blender has.
#ifndef SCENE_IMPORT_START_LAMP_H
#define SCENE_IMPORT_START_LAMP_H

#include "import/builder/import.h"

/// Leave out the lamp of Blender's start file where the file's first camera gives way at 16:9, and tell it. Both were
/// there before the model was, and light and show a cube of 2 units.
void scene_import_drop_start_lamp(struct scene_import *import);

#endif
