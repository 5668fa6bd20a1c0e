// SPDX-License-Identifier: MIT
// What assimp leaves out of NFF and AC3D without a word. Each line of these begins with a word, or has numbers alone.
#include "assimp.h"
#include "import/builder/unknown_words.h"

#include <string.h>
#include <strings.h>

static bool is_one_of(struct scene_word word, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (scene_word_is(word, words[i])) {
            return true;
        }
    }
    return false;
}

static bool is_number(struct scene_word word)
{
    double number;
    size_t length;
    return scene_word_number(word, &number, &length);
}

// Neutral File Format, of which assimp knows a few words beyond Haines' own.
static void look_at_nff(struct scene_import *import, struct scene_text *text)
{
    static const char *const known[] = {
        "v", "from", "at", "up",  "angle", "hither", "resolution", "l",   "f",   "p", "pp",   "tpp",
        "s", "c",    "pn", "pnn", "pb",    "dod",    "oct",        "tet", "hex", "b", "tess", "shader"};
    struct scene_unknown_words unknown = {.format = "NFF"};
    struct scene_line line;
    struct scene_word word;
    while (scene_text_line(text, false, &line)) {
        if (!scene_text_word(&line, &word) || word.start[0] == '#' || is_number(word)) {
            continue;
        }
        if (scene_word_is(word, "nff")) {
            return; // the NFF of WorldToolKit is another format
        }
        if (scene_word_is(word, "b")) {
            scene_import_unsupported(import, "the background: not drawn");
        }
        if (!is_one_of(word, known, sizeof known / sizeof *known)) {
            scene_unknown_words_tell(import, &unknown, word);
        }
    }
}

// The materials of an AC3D file, and the number of a surface that is the greatest, or none at all.
struct numbers {
    unsigned count;
    double worst;
    unsigned line; // where that stands
};

static void look_at_number(struct numbers *numbers, const struct scene_text *text, double number)
{
    const bool is_worse = number > numbers->worst || !(number >= 0);
    if (numbers->worst >= 0 && is_worse) {
        *numbers = (struct numbers){numbers->count, number, text->line};
    }
}

// Refuse a surface whose material is not there, at which assimp 5.2.5 crashes. Where a file has none, assimp makes one.
static void check_numbers(struct scene_import *import, const struct numbers *numbers)
{
    const double count = numbers->count > 0 ? numbers->count : 1;
    if (!(numbers->worst >= 0 && numbers->worst < count)) {
        scene_import_fail(import, "line %u: a surface has material %.0f; the file has %u, counted from 0",
                          numbers->line, numbers->worst, numbers->count);
    }
}

static void look_at_ac3d(struct scene_import *import, struct scene_text *text)
{
    static const char *const known[] = {"MATERIAL", "OBJECT", "kids",   "name",   "data",    "texture",
                                        "texrep",   "texoff", "rot",    "loc",    "url",     "mat",
                                        "subdiv",   "crease", "hidden", "locked", "numvert", "numsurf",
                                        "SURF",     "refs",   "folded"};
    struct scene_unknown_words unknown = {.format = "AC3D"};
    struct scene_line line;
    struct scene_word word;
    struct numbers numbers = {0};
    bool is_textured = false;
    while (scene_text_line(text, false, &line)) {
        if (!scene_text_word(&line, &word) || is_number(word) || strncmp(word.start, "AC3D", 4) == 0) {
            continue;
        }
        const bool is_texture = scene_word_is(word, "texture");
        if (scene_word_is(word, "hidden")) {
            scene_import_unsupported(import, "hidden objects: drawn");
        } else if (is_texture && is_textured) {
            scene_import_unsupported(import, "textures above each other: the last alone is used");
        } else if (scene_word_is(word, "data")) {
            scene_text_line(text, false, &line); // a text of the author's
        } else if (!is_one_of(word, known, sizeof known / sizeof *known)) {
            scene_unknown_words_tell(import, &unknown, word);
        }
        numbers.count += scene_word_is(word, "MATERIAL");
        double number;
        if (scene_word_is(word, "mat") && scene_text_double(&line, &number)) {
            look_at_number(&numbers, text, number);
        }
        is_textured = is_texture || (is_textured && !scene_word_is(word, "OBJECT"));
    }
    check_numbers(import, &numbers);
}

void scene_assimp_look_at_text(struct scene_import *import, char *bytes, size_t size)
{
    struct scene_text text = scene_text_open(import, bytes, size);
    if (strcasecmp(import->ending, "nff") == 0 || strcasecmp(import->ending, "enff") == 0) {
        look_at_nff(import, &text);
    } else if (strcasecmp(import->ending, "ac") == 0 || strcasecmp(import->ending, "ac3d") == 0 ||
               strcasecmp(import->ending, "acc") == 0) {
        look_at_ac3d(import, &text);
    }
}
