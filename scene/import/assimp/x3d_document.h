// SPDX-License-Identifier: MIT
// An X3D that is read: the model, or a file that another one shows.
#ifndef SCENE_IMPORT_X3D_DOCUMENT_H
#define SCENE_IMPORT_X3D_DOCUMENT_H

#include "edits.h"
#include "x3d_faces.h"

/// What a model and all files that it shows may have together.
struct scene_x3d_room {
    size_t shown; ///< bytes that files which are shown may still have
    size_t read;  ///< bytes that may still be read for them, also of those that are not drawn
    struct scene_x3d_sets_room sets;
};

struct scene_x3d_document {
    const char *path;
    const char
        *folder; ///< its folder as seen from that of the model, with a slash at its end; "" for the same one
    const struct scene_x3d_document *outer; ///< the document that shows it; NULL for the model
    struct scene_x3d_room *room;
};

/// Return the text of a document as assimp can read it, a 0 behind it. Return NULL if it is no X3D.
char *scene_x3d_read_document(struct scene_import *import, const struct scene_x3d_document *document,
                              size_t *size);
/// Return the address of a tag, from the folder of the model on: the first whose file is there, and ends with `ending`
/// if that is not NULL, or else the first. Return NULL if it has none.
char *scene_x3d_choose_address(struct scene_import *import, const struct scene_x3d_document *document,
                               char *tag, char *close, const char *ending);
/// Write the address of a tag from `tag` to `close`. `text` is where the document begins.
void scene_x3d_write_address(struct scene_import *import, struct scene_edits *edits,
                             const struct scene_x3d_document *document, const char *text, char *tag,
                             char *close);
/// Write the tag of a file that is shown as a group of what the file has. Return false if it is another tag. Tell of
/// files that cannot be shown.
bool scene_x3d_write_inline(struct scene_import *import, struct scene_edits *edits,
                            const struct scene_x3d_document *document, const char *text, char *tag,
                            char *close);

#endif
