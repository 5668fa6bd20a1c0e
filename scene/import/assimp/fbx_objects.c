// SPDX-License-Identifier: MIT
// In bytes a record has values and then records of its own; in text it has a line of its own, and so has a property.
#include "fbx_objects.h"
#include "fbx_record.h"
#include "import/builder/text_lines.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static struct scene_fbx_object *add_object(struct scene_import *import, struct scene_fbx_objects *all,
                                           struct scene_fbx_object object)
{
    scene_import_reserve(import, &all->objects, &all->capacity, all->count + 1, sizeof *all->objects);
    all->objects[all->count] = object;
    return &all->objects[all->count++];
}

static void add_link(struct scene_import *import, struct scene_fbx_objects *all, struct scene_fbx_link link)
{
    scene_import_reserve(import, &all->links, &all->link_capacity, all->link_count + 1, sizeof *all->links);
    all->links[all->link_count++] = link;
}

static bool is_visibility(struct scene_word property)
{
    return scene_word_is(property, "Show") || scene_word_is(property, "Visibility");
}

// Return what a record among the objects is. `kind` is the last of its strings.
static enum scene_fbx_class class_of(struct scene_word name, struct scene_word kind)
{
    static const struct {
        const char *name, *kind;
        enum scene_fbx_class class;
    } classes[] = {
        {"Model", NULL, SCENE_FBX_CLASS_MODEL},
        {"Geometry", "Mesh", SCENE_FBX_CLASS_SHAPE},
        {"Geometry", "Line", SCENE_FBX_CLASS_SHAPE},
        {"CollectionExclusive", "DisplayLayer", SCENE_FBX_CLASS_LAYER},
        {"AnimationCurveNode", NULL, SCENE_FBX_CLASS_CURVE_NODE},
        {"AnimationCurve", NULL, SCENE_FBX_CLASS_CURVE},
    };
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++) {
        if (scene_word_is(name, classes[i].name) &&
            (classes[i].kind == NULL || scene_word_is(kind, classes[i].kind))) {
            return classes[i].class;
        }
    }
    return SCENE_FBX_OTHER_CLASS;
}

// Note a property of an object. The programs that write FBX hide a model by either of two.
static void set_property(struct scene_fbx_object *object, struct scene_word name, bool is_zero)
{
    const bool is_default = scene_word_is(name, "d|Visibility") || scene_word_is(name, "d|Show");
    object->is_hidden = object->is_hidden || (is_zero && (is_visibility(name) || is_default));
    object->is_apart = object->is_apart || (is_zero && scene_word_is(name, "Visibility Inheritance"));
}

// Bytes ---------------------------------------------------------------------------------------------

// Read the next record of a list that ends at `limit`, from `place` on. Return false at its end.
static bool next_record(const struct scene_fbx_bytes *file, size_t *place, size_t limit,
                        struct scene_fbx_record *record)
{
    if (!scene_fbx_read_record(file, *place, limit, record) || record->end <= *place) {
        return false;
    }
    *place = (size_t)record->end;
    return true;
}

// Return where a value of a record stands, from 0 on. Return 0 if there is none.
static size_t find_value(const struct scene_fbx_bytes *file, const struct scene_fbx_record *record,
                         int number)
{
    size_t place = record->values;
    for (int i = 0; i < number && place != 0; i++) {
        place = scene_fbx_value_end(file, place, record->children);
    }
    return place != 0 && scene_fbx_value_end(file, place, record->children) != 0 ? place : 0;
}

static struct scene_word string_of(const struct scene_fbx_bytes *file, const struct scene_fbx_record *record,
                                   int number)
{
    size_t length = 0;
    const size_t place = find_value(file, record, number);
    const size_t start = place == 0 ? 0 : scene_fbx_string_at(file, place, record->children, &length);
    return start == 0 ? (struct scene_word){"", 0}
                      : (struct scene_word){(const char *)file->bytes + start, length};
}

static int64_t id_of(const struct scene_fbx_bytes *file, const struct scene_fbx_record *record, int number)
{
    const size_t place = find_value(file, record, number);
    const bool is_id = place != 0 && file->bytes[place] == 'L';
    return is_id ? (int64_t)scene_fbx_number(file->bytes + place + 1, 8) : 0;
}

// Return true if the value behind the name, the type, the label and the flags of a property is a number of 0 or less.
static bool is_zero(const struct scene_fbx_bytes *file, const struct scene_fbx_record *property)
{
    const size_t place = find_value(file, property, 4);
    const size_t end = place == 0 ? 0 : scene_fbx_value_end(file, place, property->children);
    if (end == 0 || strchr("CBYILFD", file->bytes[place]) == NULL) {
        return false;
    }
    const bool is_negative = (file->bytes[end - 1] & 0x80) != 0;
    return is_negative || scene_fbx_number(file->bytes + place + 1, end - place - 1) == 0;
}

static void read_properties(const struct scene_fbx_bytes *file, const struct scene_fbx_record *list,
                            struct scene_fbx_object *object)
{
    struct scene_fbx_record property;
    size_t place = list->children;
    while (next_record(file, &place, (size_t)list->end, &property)) {
        if (scene_fbx_is_named(file, &property, "P")) {
            set_property(object, string_of(file, &property, 0), is_zero(file, &property));
        }
    }
}

static void read_object(struct scene_import *import, const struct scene_fbx_bytes *file,
                        const struct scene_fbx_record *record, struct scene_fbx_objects *all)
{
    struct scene_fbx_record child;
    const struct scene_word name = {(const char *)file->bytes + record->name, record->name_length};
    const enum scene_fbx_class class = class_of(name, string_of(file, record, 2));
    if (class == SCENE_FBX_OTHER_CLASS) {
        return;
    }
    struct scene_fbx_object *const object =
        add_object(import, all, (struct scene_fbx_object){.id = id_of(file, record, 0), .class = class});
    size_t place = record->children;
    while (class != SCENE_FBX_CLASS_SHAPE && next_record(file, &place, (size_t)record->end, &child)) {
        if (scene_fbx_is_named(file, &child, "Properties70")) {
            read_properties(file, &child, object);
        } else if (scene_fbx_is_named(file, &child, "KeyValueFloat")) {
            object->keys = find_value(file, &child, 0);
        }
    }
}

static void read_bytes(struct scene_import *import, const struct scene_fbx_bytes *file,
                       struct scene_fbx_objects *all)
{
    struct scene_fbx_record list, record;
    size_t in_file = SCENE_FBX_HEADER;
    while (next_record(file, &in_file, file->size, &list)) {
        const bool has_objects = scene_fbx_is_named(file, &list, "Objects");
        const bool has_links = scene_fbx_is_named(file, &list, "Connections");
        size_t place = list.children;
        while ((has_objects || has_links) && next_record(file, &place, (size_t)list.end, &record)) {
            if (has_objects) {
                read_object(import, file, &record, all);
            } else {
                add_link(import, all,
                         (struct scene_fbx_link){id_of(file, &record, 1), id_of(file, &record, 2),
                                                 is_visibility(string_of(file, &record, 3))});
            }
        }
    }
}

// Text ----------------------------------------------------------------------------------------------

// Read the next string in quotation marks of a line. Return false if there is none.
static bool next_string(struct scene_line *line, struct scene_word *string)
{
    const size_t left = (size_t)(line->end - line->cursor);
    const char *const start = left == 0 ? NULL : memchr(line->cursor, '"', left);
    const char *const end = start == NULL ? NULL : memchr(start + 1, '"', (size_t)(line->end - start - 1));
    if (end == NULL) {
        return false;
    }
    *string = (struct scene_word){start + 1, (size_t)(end - start - 1)};
    line->cursor = end + 1;
    return true;
}

// Read a whole number, and pass the comma behind it. A 0 follows the text.
static int64_t next_id(struct scene_line *line)
{
    char *end;
    const int64_t id = strtoll(line->cursor, &end, 10);
    line->cursor = end < line->end ? end : line->end;
    line->cursor += line->cursor < line->end && *line->cursor == ',';
    return id;
}

static bool begins_as_number(struct scene_line line)
{
    struct scene_word word;
    return scene_text_word(&line, &word) &&
           ((*word.start >= '0' && *word.start <= '9') || (*word.start == '-' && word.length > 1));
}

// Read the line of an object: its number, its name behind its class, and its kind. Return false if it is none.
static bool read_head(struct scene_import *import, struct scene_line line, struct scene_word name,
                      struct scene_fbx_objects *all, bool *is_known)
{
    struct scene_word string, kind = {"", 0};
    if (!begins_as_number(line)) {
        return false;
    }
    const int64_t id = next_id(&line);
    if (!next_string(&line, &string)) {
        return false;
    }
    next_string(&line, &kind);
    name.length--; // the colon
    const enum scene_fbx_class class = class_of(name, kind);
    *is_known = class != SCENE_FBX_OTHER_CLASS;
    if (*is_known) {
        add_object(import, all, (struct scene_fbx_object){.id = id, .class = class});
    }
    return true;
}

static void read_text_property(struct scene_line line, struct scene_fbx_object *object)
{
    struct scene_word strings[4];
    int count = 0;
    double value = 1;
    while (count < 4 && next_string(&line, &strings[count])) {
        count++;
    }
    line.cursor += line.cursor < line.end && *line.cursor == ',';
    if (count == 4 && scene_text_double(&line, &value)) {
        set_property(object, strings[0], value <= 0);
    }
}

static void read_text_link(struct scene_import *import, struct scene_line line, struct scene_fbx_objects *all)
{
    struct scene_word type, property = {"", 0};
    struct scene_fbx_link link;
    if (!next_string(&line, &type)) {
        return;
    }
    line.cursor += line.cursor < line.end && *line.cursor == ',';
    link.child = next_id(&line);
    link.parent = next_id(&line);
    next_string(&line, &property);
    link.is_visibility = is_visibility(property);
    add_link(import, all, link);
}

static void read_text(struct scene_import *import, char *bytes, size_t size, struct scene_fbx_objects *all)
{
    struct scene_text text = scene_text_open(import, bytes, size);
    struct scene_line line;
    struct scene_word word;
    bool is_known = false;                              // the object whose lines these are is among all
    const bool is_converted = text.end != bytes + size; // keys are found in the file's own bytes
    while (scene_text_line(&text, false, &line)) {
        if (!scene_text_word(&line, &word) || word.start[word.length - 1] != ':') {
            continue;
        }
        if (scene_word_is(word, "P:")) {
            if (is_known) {
                read_text_property(line, &all->objects[all->count - 1]);
            }
        } else if (scene_word_is(word, "C:")) {
            read_text_link(import, line, all);
        } else if (scene_word_is(word, "KeyValueFloat:") && is_known && !is_converted) {
            all->objects[all->count - 1].keys = (size_t)(line.cursor - bytes);
        } else {
            read_head(import, line, word, all, &is_known);
        }
    }
}

// Curves --------------------------------------------------------------------------------------------

// Return true if one of the floats that stand at `bytes` is 0 or less.
static bool has_low(const unsigned char *bytes, size_t size)
{
    for (; size >= sizeof(float); bytes += sizeof(float), size -= sizeof(float)) {
        float value;
        memcpy(&value, bytes, sizeof value);
        if (value <= 0) {
            return true;
        }
    }
    return false;
}

// Return true if one of the floats that zlib has packed is 0 or less. Stored bytes may stand for a thousand times as
// many, so these are made piece by piece. `size` is how many there are.
static bool has_packed_low(const unsigned char *stored, size_t stored_size, size_t size)
{
    unsigned char piece[4096];
    z_stream stream = {.next_in = (Bytef *)(uintptr_t)stored, .avail_in = (uInt)stored_size};
    int status = inflateInit(&stream);
    if (status != Z_OK) {
        return false;
    }
    bool found = false;
    while (status == Z_OK && !found && size > 0) {
        stream.next_out = piece;
        stream.avail_out = (uInt)(size < sizeof piece ? size : sizeof piece);
        status = inflate(&stream, Z_NO_FLUSH);
        const size_t made = (size_t)(stream.next_out - piece);
        found = has_low(piece, made);
        size -= made;
    }
    inflateEnd(&stream);
    return found;
}

// Return true if a float of an array in a binary file is 0 or less.
static bool has_zero(const struct scene_fbx_bytes *file, size_t place)
{
    enum { HEAD = 13 };
    const size_t end = scene_fbx_value_end(file, place, file->size);
    if (end == 0 || file->bytes[place] != 'f') {
        return false;
    }
    const unsigned char *const head = file->bytes + place + 1, *const values = file->bytes + place + HEAD;
    const uint64_t count = scene_fbx_number(head, 4), encoding = scene_fbx_number(head + 4, 4);
    const size_t stored = end - place - HEAD, size = (size_t)count * sizeof(float);
    return encoding == 0   ? size == stored && has_low(values, size)
           : encoding == 1 ? has_packed_low(values, stored, size)
                           : false;
}

// Return true if a number of an array in text, up to the brace at its end, is 0 or less. A string stands in the head of
// the next object, so that arrays without an end do not all go on to the end of the file.
static bool has_text_zero(const char *text)
{
    const char *const last = strpbrk(text, "}\""), *place = NULL;
    double value;
    for (const char *c = text; last != NULL && c < last && place == NULL; c++) {
        place = *c == ':' ? c + 1 : NULL; // "a:" stands before the numbers
    }
    while (place != NULL && place < last) {
        place += strspn(place, ", \t\r\n");
        place = scene_number_read(place, last, ", \t\r\n", &value);
        if (place != NULL && value <= 0) {
            return true;
        }
    }
    return false;
}

bool scene_fbx_reaches_zero(const char *bytes, size_t size, size_t keys)
{
    struct scene_fbx_bytes file;
    return scene_fbx_is_binary(bytes, size, &file) ? has_zero(&file, keys) : has_text_zero(bytes + keys);
}

struct scene_fbx_objects scene_fbx_read_objects(struct scene_import *import, char *bytes, size_t size)
{
    struct scene_fbx_objects all = {.count = 0};
    struct scene_fbx_bytes file;
    if (scene_fbx_is_binary(bytes, size, &file)) {
        read_bytes(import, &file, &all);
    } else {
        read_text(import, bytes, size, &all);
    }
    return all;
}
