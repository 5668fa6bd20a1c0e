// SPDX-License-Identifier: MIT
// What is left out of a DXF, and what is drawn that its author has hidden. A DXF is pairs of lines, a code and a value;
// an entity is a pair of code 0 in the sections of entities and of blocks, with the pairs that follow.
#include "assimp.h"
#include "import/builder/text_lines.h"

#include <stdlib.h>
#include <string.h>

enum { LAYERS = 256 }; // the names of layers that are off are kept, so many at most

enum section { OTHER, TABLES, BLOCKS, ENTITIES };

struct look {
    struct scene_import *import;
    enum section section;
    bool is_section, is_layer; // the pair of code 0 that was read last
    bool is_sheet;             // it is a window of a sheet, which is no part of the model
    struct scene_word layer;   // its name, if it is a layer
    struct scene_word off[LAYERS];
    size_t off_count;
};

// Tell of an entity by its name, unless it is drawn or is nothing to be seen.
static void tell_of_entity(const struct look *look, struct scene_word name)
{
    static const char *const others[] = {
        "3DFACE", "SOLID",  "TRACE",   "LINE",  "POLYLINE", "VERTEX", "SEQEND", "LWPOLYLINE", "CIRCLE",
        "ARC",    "INSERT", "ELLIPSE", "BLOCK", "ENDBLK",   "ENDSEC", "ATTDEF", "VIEWPORT",
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (scene_word_is(name, others[i])) {
            return;
        }
    }
    scene_import_unsupported(look->import, "entities %.*s (DXF): not drawn",
                             name.length < 40 ? (int)name.length : 40, name.start);
}

static void begin_record(struct look *look, struct scene_word name)
{
    look->is_section = scene_word_is(name, "SECTION");
    look->is_layer = look->section == TABLES && scene_word_is(name, "LAYER");
    look->is_sheet = scene_word_is(name, "VIEWPORT");
    if (scene_word_is(name, "ENDSEC")) {
        look->section = OTHER;
    }
    if (look->section >= BLOCKS) {
        tell_of_entity(look, name);
    }
}

static void name_record(struct look *look, struct scene_word name)
{
    if (look->is_section) {
        look->section = scene_word_is(name, "ENTITIES") ? ENTITIES
                        : scene_word_is(name, "BLOCKS") ? BLOCKS
                        : scene_word_is(name, "TABLES") ? TABLES
                                                        : OTHER;
        look->is_section = false;
    }
    if (look->is_layer) {
        look->layer = name;
    }
}

static void turn_layer_off(struct look *look)
{
    if (look->off_count < LAYERS && look->layer.length > 0) {
        look->off[look->off_count++] = look->layer;
    }
}

static bool is_off(const struct look *look, struct scene_word layer)
{
    for (size_t i = 0; i < look->off_count; i++) {
        if (look->off[i].length == layer.length &&
            memcmp(look->off[i].start, layer.start, layer.length) == 0) {
            return true;
        }
    }
    return false;
}

static void read_pair(struct look *look, int code, struct scene_word value)
{
    double number = 0;
    size_t length;
    const bool is_number = scene_word_number(value, &number, &length), is_drawn = look->section == ENTITIES;
    if (code == 0) {
        begin_record(look, value);
    } else if (code == 2) {
        name_record(look, value);
    } else if (look->is_layer && is_number &&
               ((code == 62 && number < 0) ||
                (code == 70 && number >= 0 && number < 65536 && (int)number % 2 == 1))) {
        turn_layer_off(look);
    } else if (is_drawn && code == 8 && look->off_count > 0 && is_off(look, value)) {
        scene_import_unsupported(look->import, "layers that are off or frozen (DXF): drawn");
    } else if (is_drawn && code == 60 && number == 1) {
        scene_import_unsupported(look->import, "hidden objects: drawn");
    } else if (is_drawn && code == 67 && number == 1 && !look->is_sheet) {
        scene_import_unsupported(look->import, "entities of sheets (DXF): drawn among those of the model");
    }
}

void scene_assimp_look_at_dxf(struct scene_import *import, char *bytes, size_t size)
{
    struct look *const look = scene_import_allocate(import, 1, sizeof *look);
    struct scene_text text = scene_text_open(import, bytes, size);
    struct scene_line line;
    struct scene_word word;
    look->import = import;
    while (scene_text_line(&text, false, &line)) {
        double code = -1;
        const bool is_code = scene_text_double(&line, &code);
        if (!scene_text_line(&text, false, &line)) {
            break;
        }
        word = scene_text_rest(line);
        if (is_code && code >= 0 && code < 10000 && word.length > 0) {
            read_pair(look, (int)code, word);
        }
    }
    free(look);
}
