// SPDX-License-Identifier: MIT
// A text may have a million of such words: their time is bounded by the number of those that are named.
#include "unknown_words.h"

#include <string.h>

static bool is_same(struct scene_word a, struct scene_word b)
{
    return a.length == b.length && memcmp(a.start, b.start, a.length) == 0;
}

void scene_unknown_words_tell(struct scene_import *import, struct scene_unknown_words *unknown,
                              struct scene_word word)
{
    enum { LONGEST = 40 };
    word.length = word.length < LONGEST ? word.length : LONGEST;
    for (size_t i = 0; i < unknown->count && i < SCENE_UNKNOWN_WORDS; i++) {
        if (is_same(unknown->words[i], word)) {
            return;
        }
    }
    if (unknown->count < SCENE_UNKNOWN_WORDS) {
        unknown->words[unknown->count] = word;
        scene_import_unsupported(import, "\"%s\" has no meaning (%s): its lines are left out",
                                 scene_word_string(import, word), unknown->format);
    } else if (unknown->count == SCENE_UNKNOWN_WORDS) {
        scene_import_unsupported(import, "more words without a meaning (%s): their lines are left out",
                                 unknown->format);
    }
    unknown->count += unknown->count <= SCENE_UNKNOWN_WORDS;
}
