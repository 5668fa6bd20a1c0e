// SPDX-License-Identifier: MIT
// DXF that stands far from the origin, as assimp is to read it: all places of its entities are counted from one among
// them. What blocks have is among them by then.
#include "assimp_exact.h"
#include "edits.h"
#include "import/builder/text_lines.h"

#include <stdlib.h>
#include <string.h>

enum { CORNERS = 4 }; // corners of an entity, which have a number in the last digit of their codes

// A number of the file.
struct number {
    struct scene_word word; // without a start where the entity has none
    double value;
};

struct entity {
    bool has_places, is_vertex;
    bool is_face; // a face of a polyface mesh, whose place means nothing
    struct number places[CORNERS][3];
};

struct reader {
    struct scene_import *import;
    const char *start;
    bool is_within; // the section of entities is being read
    struct entity entity;
    double (*points)[3]; // the places of all entities
    size_t count, capacity;
    bool is_absent[3], is_odd; // an entity is without a coordinate on an axis
    // Where changes are collected; NULL while places are.
    struct scene_edits *edits;
    double offset[3];
};

static struct entity entity_of(struct scene_word name)
{
    static const char *const names[] = {"3DFACE", "LINE", "3DLINE", "VERTEX"};
    struct entity entity = {.is_vertex = scene_word_is(name, "VERTEX")};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        entity.has_places = entity.has_places || scene_word_is(name, names[i]);
    }
    return entity;
}

static void read_value(struct reader *reader, int code, struct scene_word word)
{
    struct entity *const entity = &reader->entity;
    const int corner = code % 10, axis = code / 10 - 1;
    size_t length;
    struct number *const number =
        code >= 10 && code < 40 && corner < CORNERS ? &entity->places[corner][axis] : NULL;
    double flags;
    if (entity->is_vertex && code == 70 && scene_word_number(word, &flags, &length)) {
        entity->is_face = flags > 127.5 && flags < 128.5;
    }
    if (number != NULL && entity->has_places) {
        reader->is_odd = reader->is_odd || !scene_word_number(word, &number->value, &length);
        number->word = word;
    }
}

static void edit_place(struct reader *reader, const struct number *number, double offset)
{
    char text[32];
    scene_assimp_write_number(text, number->value - offset);
    scene_edits_add_string(reader->import, reader->edits, (size_t)(number->word.start - reader->start),
                           number->word.length, text);
}

static void end_place(struct reader *reader, const struct number place[3])
{
    double point[3];
    for (int axis = 0; axis < 3; axis++) {
        point[axis] = place[axis].word.start != NULL ? place[axis].value : 0;
        reader->is_absent[axis] = reader->is_absent[axis] || place[axis].word.start == NULL;
        if (reader->edits != NULL && place[axis].word.start != NULL && reader->offset[axis] != 0) {
            edit_place(reader, &place[axis], reader->offset[axis]);
        }
    }
    if (reader->edits == NULL) {
        scene_import_reserve(reader->import, &reader->points, &reader->capacity, reader->count + 1,
                             sizeof *reader->points);
        memcpy(reader->points[reader->count++], point, sizeof point);
    }
}

static void end_entity(struct reader *reader)
{
    const bool counts = reader->is_within && reader->entity.has_places && !reader->entity.is_face;
    for (int i = 0; i < CORNERS && counts; i++) {
        const struct number *const place = reader->entity.places[i];
        if (place[0].word.start != NULL || place[1].word.start != NULL || place[2].word.start != NULL) {
            end_place(reader, place);
        }
    }
    reader->entity = (struct entity){.has_places = false};
}

// Read all entities. A file is pairs of lines: a code, and a value.
static void read_entities(struct reader *reader, char *bytes, size_t size)
{
    struct scene_text text = {.cursor = bytes, .end = bytes + size};
    struct scene_line line;
    struct scene_word word, value;
    double code;
    size_t length;
    bool is_section = false;
    while (scene_text_line(&text, false, &line)) {
        const bool is_code = scene_text_word(&line, &word) && scene_word_number(word, &code, &length);
        if (!scene_text_line(&text, false, &line) || !is_code || !scene_text_word(&line, &value)) {
            continue;
        }
        if (is_section && code == 2) {
            reader->is_within = scene_word_is(value, "ENTITIES");
        } else if (code == 0) {
            end_entity(reader);
            reader->is_within = reader->is_within && !scene_word_is(value, "ENDSEC");
            reader->entity = entity_of(value);
        } else if (code > 0 && code < 100) {
            read_value(reader, (int)code, value);
        }
        is_section = code == 0 && scene_word_is(value, "SECTION");
    }
    end_entity(reader);
}

char *scene_assimp_rewrite_dxf(struct scene_import *import, struct scene_assimp_exact *exact, char *bytes,
                               size_t *size)
{
    struct scene_edits edits = {.count = 0};
    struct reader reader = {.import = import, .start = bytes};
    read_entities(&reader, bytes, *size);
    const bool is_far = !reader.is_odd && scene_assimp_find_offset(import, (const double(*)[3])reader.points,
                                                                   reader.count, reader.offset);
    free(reader.points);
    if (!is_far) {
        return NULL;
    }
    for (int axis = 0; axis < 3; axis++) {
        reader.offset[axis] = reader.is_absent[axis] ? 0 : reader.offset[axis];
        exact->common[axis] = reader.offset[axis];
    }
    reader.edits = &edits;
    reader.is_within = false;
    read_entities(&reader, bytes, *size);
    return scene_edits_apply(import, &edits, bytes, size);
}
