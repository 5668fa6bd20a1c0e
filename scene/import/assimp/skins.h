// SPDX-License-Identifier: MIT
// Skins that lie beside a model.
#ifndef SCENE_IMPORT_SKINS_H
#define SCENE_IMPORT_SKINS_H

#include "import/builder/import.h"

/// Return true for formats whose skins are chosen by a game.
bool scene_assimp_has_skins(const struct scene_import *import);
/// Find the skin of a model in place of the one called `name`, which is not there, or NULL. Return false if there is
/// none.
bool scene_assimp_find_skin(struct scene_import *import, const char *name,
                            struct scene_import_source *source);

#endif
