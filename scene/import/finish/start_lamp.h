// SPDX-License-Identifier: MIT
// The lamp that every new file of Blender has.
#ifndef SCENE_IMPORT_START_LAMP_H
#define SCENE_IMPORT_START_LAMP_H

#include "import/builder/import.h"

/// Leave out the lamps of Blender's start file where the file's first camera gives way at 16:9, and tell it. They were
/// there before the model was, and light and show a cube of 2 units. What was put together of several files has the
/// lamp of each.
void scene_import_drop_start_lamp(struct scene_import *import);

#endif
