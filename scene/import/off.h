// SPDX-License-Identifier: MIT
// What the two files of the OFF reader share: what the keyword says, and the numbers behind it.
#ifndef SCENE_OFF_H
#define SCENE_OFF_H

#include "import/builder/import.h"
#include "import/builder/text_lines.h"

/// The numbers of a vertex, in their order.
struct off_layout {
    int dimension;      ///< coordinates, of which the first three are drawn
    bool has_w;         ///< a homogeneous coordinate more
    bool w_first;       ///< it is the first of them, not the last
    bool has_normal;    ///< three numbers
    int color_count;    ///< 0, 3 or 4 numbers
    bool has_uv;        ///< two numbers
    int ignored;        ///< numbers of a line that nothing says the meaning of
    bool color_guessed; ///< the keyword does not say that there are colours
};

struct off_source {
    struct scene_import *import;
    struct scene_text text;
    struct scene_line line;
    bool binary, big_endian, counts_colors; ///< counts_colors: a face says how many numbers its colour has
    const unsigned char *cursor, *end;      ///< binary data
    const char *part;                       ///< what is being read, and which of how many, for messages
    uint32_t index, count;
};

/// Return the bytes of the keyword at the start of a word, and what it says. Return 0 if there is none.
size_t scene_off_keyword(struct scene_word word, struct off_layout *layout);
/// Read the next word of a text. Return false at its end.
bool scene_off_word(struct off_source *source, struct scene_word *word);
/// Read the next word of the line. Return false at its end, or at a comment.
bool scene_off_word_of_line(struct off_source *source, struct scene_word *word);
/// Return the number that a word is.
double scene_off_value(struct off_source *source, struct scene_word word);
/// Read a number of a text or of binary data.
double scene_off_real(struct off_source *source);
/// Read a whole number from 0 on, below 2^32 − 1.
uint32_t scene_off_whole(struct off_source *source);
/// Return how many words the next line has, without reading it.
int scene_off_next_line_words(const struct off_source *source);
/// Return how many words each of the next lines has, without reading them. Return 0 if they have not all as many, or if
/// fewer than `more` lines follow them.
int scene_off_words_per_line(const struct off_source *source, uint32_t lines, uint32_t more);
/// Find the byte order of binary data, and whether faces count the numbers of their colours. Geomview has big ends and
/// counts; other programs write what their machine has, and no counts.
void scene_off_find_order(struct off_source *source, struct off_layout *layout, bool dimension_follows);

#endif
