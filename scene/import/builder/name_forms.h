// SPDX-License-Identifier: MIT
// The forms of a file's name: what a model says may be quoted, encoded or of another machine.
#ifndef SCENE_NAME_FORMS_H
#define SCENE_NAME_FORMS_H

#include "import.h"

/// Names, the likeliest first, each of them once. Start from zeros.
struct scene_name_forms {
    char **names;
    size_t count, capacity;
};

/// Add the name as it is, without quotation marks, without the query or the fragment of a URI, with percent signs
/// decoded, and each of them with slashes for backslashes.
void scene_name_forms_add(struct scene_import *import, struct scene_name_forms *forms, const char *name);
/// Add the forms of a name that has bytes beyond ASCII, if it or the file's name is in a code page of DOS or Windows
/// instead of UTF-8, or was taken for one when an archive was unpacked.
void scene_name_forms_add_code_pages(struct scene_import *import, struct scene_name_forms *forms,
                                     const char *name);
/// Add the forms of a name whose accents are joined to their letters in the file's name and parted from them in this
/// one, or the other way round.
void scene_name_forms_add_accents(struct scene_import *import, struct scene_name_forms *forms,
                                  const char *name);
/// Decode what is written by percent signs in a name. Return the name.
char *scene_name_decode_percent(char *text);
void scene_name_forms_free(struct scene_name_forms *forms);

#endif
