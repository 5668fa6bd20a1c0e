// SPDX-License-Identifier: MIT
#ifndef SCENE_IMPORT_BLENDER_GAPS_H
#define SCENE_IMPORT_BLENDER_GAPS_H

struct scene_import;
struct scene_blender_file;

/// Tell the user what assimp leaves out of a file, and what of it is drawn that is hidden.
void scene_blender_tell_gaps(struct scene_import *import, const struct scene_blender_file *file);

#endif
