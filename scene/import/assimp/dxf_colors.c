// SPDX-License-Identifier: MIT
// Colours of a DXF. assimp 5.2.5 knows those of entities alone, none of their layers, by numbers that mean other
// colours in a DXF. So each entity gets the number by which assimp has the nearest of its sixteen.
#include "assimp.h"
#include "dxf_text.h"
#include "edits.h"
#include "x3d_names.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The number of what is seen on any background, of the layer's colour, and of the first that assimp has, which is not
// 0 here: that is the colour of the insertion that an entity is drawn by.
enum { FOREGROUND = 7, BY_LAYER = 256, FIRST = 16 };

// What assimp makes of the numbers from 0 on, and again from 16 on. The first is the foreground.
static const double known[][3] = {
    {0.6, 0.6, 0.6}, {1, 0, 0}, {0, 1, 0},   {0, 0, 1},     {0.3, 1, 0.3}, {0.3, 0.3, 1},
    {1, 0.3, 0.3},   {1, 0, 1}, {1, 0.6, 0}, {0.6, 0.3, 0}, {1, 1, 0},     {0.3, 0.3, 0.3},
    {0.8, 0.8, 0.8}, {0, 0, 0}, {1, 1, 1},   {0.6, 0, 1},
};

// What a record says of its colour.
struct record {
    bool is_layer, is_drawn;
    struct scene_word name, number; // its name or its layer's, and the colour's number as it is written
    const char *behind;             // where its first pair ends; NULL where that is no end of a line
    long color, true_color;         // −1 where it has none
};

struct work {
    struct scene_import *import;
    struct scene_edits edits;
    struct scene_x3d_names layers; // `at` is the number for assimp
    const char *text;
    bool is_section, is_tables, is_entities, is_blocks; // entities stand in blocks as well
    struct record record;
};

// Find red, green and blue of a number of DXF from 1 to 255.
static void color_of(long number, double color[3])
{
    static const double first[][3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0},       {0, 1, 1},         {0, 0, 1},
                                      {1, 0, 1}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.75, 0.75, 0.75}};
    static const double values[] = {1, 0.74, 0.5, 0.4, 0.3};
    enum { FIRST_HUE = 10, FIRST_GREY = 250 };
    if (number < FIRST_HUE) {
        memcpy(color, first[number - 1], sizeof first[0]);
        return;
    }
    for (int c = 0; c < 3; c++) {
        if (number >= FIRST_GREY) {
            color[c] = 0.2 + 0.16 * (double)(number - FIRST_GREY);
            continue;
        }
        // Twenty-four hues from red on, of which one component falls and rises within two thirds of the circle.
        const double hue = (double)(number / 10 - 1) / 4, away = fabs(fmod(hue - 2 * c + 9, 6) - 3);
        const double full = away < 1 ? 1 : away < 2 ? 2 - away : 0;
        color[c] = values[number % 10 / 2] * (number % 2 == 1 ? 0.5 + 0.5 * full : full);
    }
}

// Return the number by which assimp has the nearest colour.
static size_t nearest(struct scene_import *import, const double color[3])
{
    const double seen = 0.02;
    size_t found = 0;
    double least = INFINITY;
    for (size_t i = 1; i < sizeof known / sizeof known[0]; i++) {
        double distance = 0;
        for (int c = 0; c < 3; c++) {
            distance += (known[i][c] - color[c]) * (known[i][c] - color[c]);
        }
        if (distance < least) {
            least = distance;
            found = i;
        }
    }
    if (least > seen) {
        scene_import_unsupported(import, "colours (DXF): drawn in the nearest of sixteen");
    }
    return found;
}

// Find the number for assimp of what a record says. Return false where it has no colour of its own.
static bool number_of(const struct work *work, size_t *number)
{
    const struct record *const record = &work->record;
    double color[3];
    if (record->true_color >= 0) {
        for (int c = 0; c < 3; c++) {
            color[c] = (double)(record->true_color >> (16 - 8 * c) & 255) / 255;
        }
        *number = nearest(work->import, color);
        return true;
    }
    *number = record->color == 0 ? 0 : FIRST;
    if (record->color <= 0 || record->color >= BY_LAYER) {
        return record->color == 0;
    }
    if (record->color != FOREGROUND) {
        color_of(record->color, color);
        *number = nearest(work->import, color);
    }
    return true;
}

static struct scene_collada_value name_of(struct scene_word word)
{
    return (struct scene_collada_value){(char *)(uintptr_t)word.start, word.length};
}

static void end_entity(struct work *work)
{
    const struct record *const record = &work->record;
    const bool is_of_insertion =
        work->is_blocks && (record->name.length == 0 || scene_word_is(record->name, "0"));
    size_t number = FIRST;
    const bool has_own = number_of(work, &number);
    if (!has_own && is_of_insertion) {
        number = 0;
    } else if (!has_own && record->name.length > 0) {
        const struct scene_x3d_name *const layer = scene_x3d_find_name(&work->layers, name_of(record->name));
        number = layer == NULL ? FIRST : layer->at;
    }
    char text[32];
    if (record->number.length > 0) {
        snprintf(text, sizeof text, "%zu", number);
        scene_edits_add_string(work->import, &work->edits, (size_t)(record->number.start - work->text),
                               record->number.length, text);
    } else if (number < FIRST && record->behind != NULL) {
        snprintf(text, sizeof text, "62\n%zu\n", number);
        scene_edits_add_string(work->import, &work->edits, (size_t)(record->behind - work->text), 0, text);
    }
}

static void end_record(struct work *work)
{
    size_t number = 0;
    if (work->record.is_drawn) {
        end_entity(work);
    } else if (work->record.is_layer && work->record.name.length > 0 && number_of(work, &number)) {
        scene_x3d_add_name(work->import, &work->layers,
                           (struct scene_x3d_name){.name = name_of(work->record.name), .at = number});
    }
}

// Begin a record behind whose first pair `behind` is.
static void begin_record(struct work *work, const struct scene_dxf_pair *pair, const char *behind)
{
    static const char *const drawn[] = {"LINE", "3DFACE",  "POLYLINE", "LWPOLYLINE", "CIRCLE",
                                        "ARC",  "ELLIPSE", "SOLID",    "TRACE",      "INSERT"};
    end_record(work);
    work->is_section = scene_dxf_begins(pair, "SECTION");
    if (scene_dxf_begins(pair, "ENDSEC")) {
        work->is_tables = work->is_entities = work->is_blocks = false;
    }
    work->record = (struct record){.is_layer = work->is_tables && scene_dxf_begins(pair, "LAYER"),
                                   .behind = behind[-1] == '\n' || behind[-1] == '\r' ? behind : NULL,
                                   .color = -1,
                                   .true_color = -1};
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0] && work->is_entities; i++) {
        work->record.is_drawn = work->record.is_drawn || scene_dxf_begins(pair, drawn[i]);
    }
}

// Read a pair behind which `behind` is.
static void read_pair(struct work *work, const struct scene_dxf_pair *pair, const char *behind)
{
    enum { NAME = 2, LAYER = 8, COLOR = 62, TRUE_COLOR = 420 };
    struct record *const record = &work->record;
    if (pair->code == 0) {
        begin_record(work, pair, behind);
    } else if (pair->code == NAME && work->is_section) {
        work->is_tables = scene_word_is(pair->value, "TABLES");
        work->is_blocks = scene_word_is(pair->value, "BLOCKS");
        work->is_entities = work->is_blocks || scene_word_is(pair->value, "ENTITIES");
        work->is_section = false;
    } else if ((pair->code == NAME && record->is_layer) || (pair->code == LAYER && record->is_drawn)) {
        record->name = pair->line;
    } else if (pair->code == COLOR && (record->is_layer || record->is_drawn)) {
        record->number = pair->value;
        const long color = strtol(pair->value.start, NULL, 10);
        record->color = color < 0 && color > -BY_LAYER ? -color : color; // below 0 for a layer that is off
    } else if (pair->code == TRUE_COLOR) {
        record->true_color = strtol(pair->value.start, NULL, 10) & 0xffffff;
    }
}

char *scene_assimp_write_dxf_colors(struct scene_import *import, char *text, size_t *size)
{
    struct scene_text lines = scene_text_open(import, text, *size);
    if (lines.end != text + *size) { // UTF-16, which was converted
        free(text);
        text = lines.cursor;
        *size = (size_t)(lines.end - lines.cursor);
    }
    struct work work = {.import = import, .text = text};
    struct scene_dxf_pair pair;
    work.record.color = work.record.true_color = -1;
    while (scene_dxf_read_pair(&lines, &pair)) {
        read_pair(&work, &pair, lines.cursor);
    }
    end_record(&work);
    scene_x3d_free_names(&work.layers);
    return scene_edits_replace(import, &work.edits, text, size);
}
