// SPDX-License-Identifier: MIT
// Skins that lie beside a model.
#ifndef SCENE_IMPORT_SKINS_H
#define SCENE_IMPORT_SKINS_H

#include "import/builder/import.h"

/// Return true for formats whose skins are chosen by a game.
bool scene_assimp_has_skins(const struct scene_import *import);
/// Find the skin of a model in place of one that is not there, or not named. Return false if there is none.
bool scene_assimp_find_skin(struct scene_import *import, struct scene_import_source *source);

#endif
