// SPDX-License-Identifier: MIT
// Words that lines of a text begin with and that its format has no meaning for.
#ifndef SCENE_IMPORT_UNKNOWN_WORDS_H
#define SCENE_IMPORT_UNKNOWN_WORDS_H

#include "text_lines.h"

enum { SCENE_UNKNOWN_WORDS = 8 }; ///< the words that are named at most

/// The words that were told, which stay where the text has them.
struct scene_unknown_words {
    const char *format;
    struct scene_word words[SCENE_UNKNOWN_WORDS];
    size_t count;
};

/// Tell of a word by its name, once. Of a text that has many, which is of another kind, the first are named.
void scene_unknown_words_tell(struct scene_import *import, struct scene_unknown_words *unknown,
                              struct scene_word word);

#endif
