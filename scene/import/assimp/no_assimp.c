// SPDX-License-Identifier: MIT
// In the place of the assimp reader where assimp is not built in: says what the others read.
#include "import/builder/readers.h"

void scene_import_check_fbx(struct scene_import *import)
{
    scene_import_fail(import, "is FBX, which is not read here; glTF, OBJ, PLY, STL and 3MF are");
}

void scene_import_assimp(struct scene_import *import)
{
    scene_import_fail(import, "is of no format that is read here: glTF, OBJ, PLY, STL or 3MF");
}
