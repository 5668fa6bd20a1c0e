// SPDX-License-Identifier: MIT
// The tags of a Collada document, which is changed as text before assimp reads it.
#ifndef SCENE_IMPORT_COLLADA_MARKUP_H
#define SCENE_IMPORT_COLLADA_MARKUP_H

/// Return the end of a tag, which is the > at its end, outside of quotation marks. Return NULL if it has none.
char *scene_collada_tag_end(char *tag, const char *end);
/// Return the > at the end of what begins at `start`: a comment, a declaration, or a tag. Return NULL if it has none.
char *scene_collada_markup_end(char *start, const char *end);

#endif
