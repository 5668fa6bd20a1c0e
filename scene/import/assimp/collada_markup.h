// SPDX-License-Identifier: MIT
// The tags of a document of Collada, or of X3D, which is changed as text before assimp reads it.
#ifndef SCENE_IMPORT_COLLADA_MARKUP_H
#define SCENE_IMPORT_COLLADA_MARKUP_H

#include <stdbool.h>
#include <stddef.h>

struct scene_collada_value {
    char *text; ///< NULL where the tag has no attribute of the name
    size_t length;
};

/// Return the end of a tag, which is the > at its end, outside of quotation marks. Return NULL if it has none.
char *scene_collada_tag_end(char *tag, const char *end);
/// Return the > at the end of what begins at `start`: a comment, a declaration, or a tag. Return NULL if it has none.
char *scene_collada_markup_end(char *start, const char *end);
/// Return true for white space.
bool scene_collada_is_blank(char c);
/// Return true for a start tag of this name, or an empty one.
bool scene_collada_is_tag(const char *tag, const char *name);
/// Return true for an end tag of this name.
bool scene_collada_is_end(const char *tag, const char *name);
/// Return the value of an attribute of the tag that ends at `close`.
struct scene_collada_value scene_collada_attribute(char *tag, char *close, const char *name);
/// Return where the name of an attribute ends that has this value.
const char *scene_collada_name_end(struct scene_collada_value value);

#endif
