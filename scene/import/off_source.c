// SPDX-License-Identifier: MIT
// The keyword and the numbers of an OFF, in text and binary.
#include "off.h"

#include <string.h>
#include <strings.h>

// Keyword -------------------------------------------------------------------------------------------

// Read one prefix. Return its length, or 0 if there is none. Geomview has an order for prefixes, which other programs
// do not keep. An S alone asks for smooth normals, which are made anyway.
static size_t read_prefix(const char *text, size_t length, struct off_layout *layout)
{
    if (length >= 2 && text[0] == 'S' && text[1] == 'T') {
        layout->has_uv = true;
        return 2;
    }
    switch (length > 0 ? text[0] : 0) {
    case 'C': layout->color_count = 4; return 1;
    case 'N': layout->has_normal = true; return 1;
    case '4': layout->has_w = true; return 1;
    case 'S': return 1;
    case 'n': layout->dimension = 0; return 1; // the number follows
    default: return 0;
    }
}

size_t scene_off_keyword(struct scene_word word, struct off_layout *layout)
{
    size_t used = 0;
    *layout = (struct off_layout){.dimension = 3};
    for (;;) {
        const size_t left = word.length - used;
        if (left >= 3 &&
            (memcmp(word.start + used, "OFF", 3) == 0 || memcmp(word.start + used, "off", 3) == 0)) {
            layout->w_first = layout->has_w && layout->dimension == 0;
            return used + 3;
        }
        const size_t prefix = read_prefix(word.start + used, left, layout);
        if (prefix == 0) {
            return 0;
        }
        used += prefix;
    }
}

// Text ----------------------------------------------------------------------------------------------

// Read the next line, up to its comment.
static bool next_line(struct off_source *source)
{
    if (!scene_text_line(&source->text, false, &source->line)) {
        return false;
    }
    const struct scene_line line = source->line;
    const char *comment = memchr(line.cursor, '#', (size_t)(line.end - line.cursor));
    source->line.end = comment != NULL ? comment : line.end;
    return true;
}

bool scene_off_word_of_line(struct off_source *source, struct scene_word *word)
{
    return scene_text_word(&source->line, word);
}

bool scene_off_word(struct off_source *source, struct scene_word *word)
{
    while (!scene_text_word(&source->line, word)) {
        if (!next_line(source)) {
            return false;
        }
    }
    return true;
}

// Count the words of the next line that has any, and read it.
static int count_words(struct off_source *source)
{
    struct scene_word word;
    int count = scene_off_word(source, &word) ? 1 : 0;
    while (count > 0 && scene_text_word(&source->line, &word)) {
        count++;
    }
    return count;
}

int scene_off_next_line_words(const struct off_source *source)
{
    struct off_source ahead = *source;
    return count_words(&ahead);
}

int scene_off_words_per_line(const struct off_source *source, uint32_t lines, uint32_t more)
{
    struct off_source ahead = *source;
    const int words = lines > 0 ? count_words(&ahead) : 0;
    for (uint32_t i = 1; i < lines; i++) {
        if (count_words(&ahead) != words) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < more; i++) {
        if (count_words(&ahead) == 0) {
            return 0;
        }
    }
    return words;
}

// Fail the import, with the place that is being read in front of the problem.
_Noreturn static void refuse(struct off_source *source, const char *problem)
{
    if (source->count == 0) {
        scene_import_fail(source->import, "its %s %s", source->part, problem);
    }
    scene_import_fail(source->import, "%s %u of %u %s", source->part, source->index + 1, source->count,
                      problem);
}

double scene_off_value(struct off_source *source, struct scene_word word)
{
    double value = 0;
    size_t length = 0;
    if (!scene_word_number(word, &value, &length) || length != word.length) {
        scene_import_fail(source->import, "line %u: \"%s\" is not a number", source->text.line,
                          scene_word_string(source->import, word));
    }
    return value;
}

// Binary --------------------------------------------------------------------------------------------

// Read 32 bits. Return false at the end of the data.
static bool read_32(struct off_source *source, uint32_t *value)
{
    if (source->end - source->cursor < 4) {
        return false;
    }
    const unsigned char *b = source->cursor;
    *value = source->big_endian
                 ? (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | (uint32_t)b[3]
                 : (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | (uint32_t)b[0];
    source->cursor += 4;
    return true;
}

// Skip as many numbers. Return false at the end of the data.
static bool skip(struct off_source *source, uint64_t numbers)
{
    if (numbers > (uint64_t)(source->end - source->cursor) / 4) {
        return false;
    }
    source->cursor += 4 * numbers;
    return true;
}

// Walk over the data. Return true if they end where the file ends.
static bool fits(struct off_source source, const struct off_layout *layout, bool dimension_follows)
{
    uint32_t dimension = (uint32_t)layout->dimension, vertices, faces, edges, numbers;
    if ((dimension_follows && !read_32(&source, &dimension)) || !read_32(&source, &vertices) ||
        !read_32(&source, &faces) || !read_32(&source, &edges)) {
        return false;
    }
    const uint64_t width = (uint64_t)dimension + layout->has_w + (layout->has_normal ? 3 : 0) +
                           (unsigned)layout->color_count + (layout->has_uv ? 2 : 0);
    if (width > 1024 || !skip(&source, width * vertices)) {
        return false;
    }
    for (uint32_t i = 0; i < faces; i++) {
        if (!read_32(&source, &numbers) || !skip(&source, numbers) ||
            (source.counts_colors && (!read_32(&source, &numbers) || !skip(&source, numbers)))) {
            return false;
        }
    }
    return source.cursor == source.end;
}

void scene_off_find_order(struct off_source *source, struct off_layout *layout, bool dimension_follows)
{
    for (int way = 0; way < 4; way++) {
        source->big_endian = way % 2 == 0;
        source->counts_colors = way < 2;
        if (fits(*source, layout, dimension_follows)) {
            return;
        }
    }
    source->big_endian = source->counts_colors = true;
}

// Both ----------------------------------------------------------------------------------------------

double scene_off_real(struct off_source *source)
{
    if (!source->binary) {
        struct scene_word word;
        if (!scene_off_word(source, &word)) {
            refuse(source, "is cut: the file ends there");
        }
        return scene_off_value(source, word);
    }
    uint32_t bits;
    float value;
    if (!read_32(source, &bits)) {
        refuse(source, "is cut: the file ends there");
    }
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

uint32_t scene_off_whole(struct off_source *source)
{
    uint32_t bits = 0;
    if (source->binary && !read_32(source, &bits)) {
        refuse(source, "is cut: the file ends there");
    }
    const double value = source->binary ? (double)bits : scene_off_real(source);
    if (!(value >= 0 && value < UINT32_MAX) || value != (double)(uint32_t)value) {
        char problem[80];
        snprintf(problem, sizeof problem, "has %.9g where a whole number from 0 on must be", value);
        refuse(source, problem);
    }
    return (uint32_t)value;
}
