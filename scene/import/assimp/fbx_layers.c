// SPDX-License-Identifier: MIT
// Geometries of an FBX that do not say which of their model's materials they have. By the convention of the programs
// that read FBX all of their faces have the first one. assimp 5.2.5 gives them none, so it gets the file with a layer
// that says so.
#include "assimp.h"
#include "edits.h"
#include "fbx_record.h"
#include "import/builder/text_lines.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { DEEPEST = 64 };
static const char layer_name[] = "LayerElementMaterial";

// Binary --------------------------------------------------------------------------------------------

struct layers {
    struct scene_import *import;
    struct scene_fbx_bytes file;
    size_t *places; // where the layers of each geometry are put, in order
    size_t place_count, place_capacity;
    unsigned char *out;
    size_t written, capacity;
    size_t added; // bytes of the layers of a geometry
};

static void put(struct layers *layers, const void *bytes, size_t size)
{
    scene_import_reserve(layers->import, &layers->out, &layers->capacity, layers->written + size, 1);
    memcpy(layers->out + layers->written, bytes, size);
    layers->written += size;
}

static void set_number(struct layers *layers, size_t place, uint64_t number, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        layers->out[place + i] = (unsigned char)(number >> 8 * i);
    }
}

static void put_number(struct layers *layers, char type, uint32_t number)
{
    const unsigned char bytes[5] = {(unsigned char)type, (unsigned char)number, (unsigned char)(number >> 8),
                                    (unsigned char)(number >> 16), (unsigned char)(number >> 24)};
    put(layers, bytes, sizeof bytes);
}

static void put_zeros(struct layers *layers, size_t size)
{
    static const unsigned char zeros[3 * 8 + 1] = {0};
    put(layers, zeros, size);
}

// Begin a record. Return its place.
static size_t begin(struct layers *layers, const char *name)
{
    const size_t start = layers->written, head = scene_fbx_head(&layers->file);
    put_zeros(layers, head);
    layers->out[start + head - 1] = (unsigned char)strlen(name);
    put(layers, name, strlen(name));
    return start;
}

// End the values of a record, of which there is one at most.
static void end_values(struct layers *layers, size_t start)
{
    const size_t word = layers->file.word,
                 values = start + scene_fbx_head(&layers->file) + layers->out[start + 3 * word];
    set_number(layers, start + word, layers->written > values, word);
    set_number(layers, start + 2 * word, layers->written - values, word);
}

static void end_record(struct layers *layers, size_t start)
{
    set_number(layers, start, layers->written, layers->file.word);
}

static void put_text_record(struct layers *layers, const char *name, const char *value)
{
    const size_t start = begin(layers, name);
    put_number(layers, 'S', (uint32_t)strlen(value));
    put(layers, value, strlen(value));
    end_values(layers, start);
    end_record(layers, start);
}

static size_t begin_numbered(struct layers *layers, const char *name)
{
    const size_t start = begin(layers, name);
    put_number(layers, 'I', 0);
    end_values(layers, start);
    return start;
}

static void end_list(struct layers *layers, size_t start)
{
    put_zeros(layers, scene_fbx_head(&layers->file));
    end_record(layers, start);
}

// Write a layer element that gives all faces material 0, and a layer that holds it.
static void put_layers(struct layers *layers)
{
    const size_t element = begin_numbered(layers, layer_name);
    put_text_record(layers, "MappingInformationType", "AllSame");
    put_text_record(layers, "ReferenceInformationType", "IndexToDirect");
    const size_t materials = begin(layers, "Materials");
    put_number(layers, 'i', 1); // an array of one number, which is not compressed
    put_zeros(layers, 4);
    put(layers, (const unsigned char[]){4, 0, 0, 0, 0, 0, 0, 0}, 8);
    end_values(layers, materials);
    end_record(layers, materials);
    end_list(layers, element);
    const size_t layer = begin_numbered(layers, "Layer"), entry = begin(layers, "LayerElement");
    end_values(layers, entry);
    put_text_record(layers, "Type", layer_name);
    end_record(layers, begin_numbered(layers, "TypedIndex"));
    end_list(layers, entry);
    end_list(layers, layer);
}

static bool is_mesh(const struct scene_fbx_bytes *file, const struct scene_fbx_record *geometry)
{
    size_t place = geometry->values, length = 0;
    for (int i = 0; i < 2 && place != 0; i++) { // the number and the name
        place = scene_fbx_value_end(file, place, geometry->children);
    }
    const size_t class = place == 0 ? 0 : scene_fbx_string_at(file, place, geometry->children, &length);
    return class != 0 && length == 4 && memcmp(file->bytes + class, "Mesh", 4) == 0;
}

// Note the end of a geometry's list if none of its records is a layer of materials.
static void look_at_geometry(struct layers *layers, const struct scene_fbx_record *geometry)
{
    struct scene_fbx_record record = {.end = 0};
    size_t place = geometry->children;
    bool has_layer = false;
    while (!has_layer && scene_fbx_read_record(&layers->file, place, (size_t)geometry->end, &record) &&
           record.end > place) {
        has_layer = scene_fbx_is_named(&layers->file, &record, layer_name);
        place = (size_t)record.end;
    }
    const bool ends_here = record.end == 0 && place + scene_fbx_head(&layers->file) == geometry->end;
    if (!has_layer && ends_here && is_mesh(&layers->file, geometry)) {
        scene_import_reserve(layers->import, &layers->places, &layers->place_capacity,
                             layers->place_count + 1, sizeof *layers->places);
        layers->places[layers->place_count++] = place;
    }
}

// Return how many bytes are put into the file before a place.
static size_t shift_at(const struct layers *layers, uint64_t place)
{
    size_t low = 0, high = layers->place_count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (layers->places[middle] < place) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low * layers->added;
}

// Visit the records of a list from `place` to `limit`, in order. With a copy of the file correct where each of them
// ends, else look at geometries. Return false if a record is not as it should be.
static bool visit(struct layers *layers, size_t place, size_t limit, unsigned depth)
{
    struct scene_fbx_record record;
    const bool corrects = layers->out != NULL;
    while (place < limit) {
        if (depth > DEEPEST || !scene_fbx_read_record(&layers->file, place, limit, &record) ||
            (record.end != 0 && record.end <= place)) {
            return false;
        }
        if (record.end == 0) {
            return true;
        }
        const bool is_objects = depth == 0 && scene_fbx_is_named(&layers->file, &record, "Objects");
        if (corrects) {
            set_number(layers, place + shift_at(layers, place), record.end + shift_at(layers, record.end),
                       layers->file.word);
        } else if (depth == 1 && scene_fbx_is_named(&layers->file, &record, "Geometry")) {
            look_at_geometry(layers, &record);
        }
        if ((corrects || is_objects) && !visit(layers, record.children, (size_t)record.end, depth + 1)) {
            return false;
        }
        place = (size_t)record.end;
    }
    return true;
}

static void copy_file(struct layers *layers)
{
    size_t done = 0;
    for (size_t i = 0; i < layers->place_count; i++) {
        put(layers, layers->file.bytes + done, layers->places[i] - done);
        done = layers->places[i];
        const size_t start = layers->written;
        put_layers(layers);
        layers->added = layers->written - start;
    }
    put(layers, layers->file.bytes + done, layers->file.size - done);
}

static char *add_to_binary(struct scene_import *import, const struct scene_fbx_bytes *file, size_t *size)
{
    struct layers layers = {.import = import, .file = *file};
    bool is_good = visit(&layers, SCENE_FBX_HEADER, file->size, 0) && layers.place_count > 0;
    if (is_good) {
        copy_file(&layers);
        is_good = (file->word == 8 || layers.written <= UINT32_MAX) &&
                  visit(&layers, SCENE_FBX_HEADER, file->size, 0);
    }
    free(layers.places);
    if (!is_good) {
        free(layers.out);
        return NULL;
    }
    *size = layers.written;
    put(&layers, "", 1);
    return (char *)layers.out;
}

// Text ----------------------------------------------------------------------------------------------

struct scan {
    struct scene_word name, string;          // the last name of a record, and the last string
    unsigned depth;                          // number of records that are open
    bool is_objects, is_geometry, has_layer; // what the open records are and have
};

static bool is_of_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

static void open_record(struct scan *scan)
{
    if (scan->depth == 0) {
        scan->is_objects = scene_word_is(scan->name, "Objects");
    } else if (scan->depth == 1) {
        scan->is_geometry =
            scan->is_objects && scene_word_is(scan->name, "Geometry") && scene_word_is(scan->string, "Mesh");
        scan->has_layer = false;
    }
    scan->depth++;
}

// Return true at the end of a geometry without a layer of materials.
static bool close_record(struct scan *scan)
{
    scan->depth -= scan->depth > 0;
    const bool lacks = scan->depth == 1 && scan->is_geometry && !scan->has_layer;
    scan->is_geometry = scan->is_geometry && scan->depth > 1;
    return lacks;
}

// Pass a comment, a string, or a word, which may be a name. Return where it ends, or the next place.
static const char *pass(struct scan *scan, const char *c, const char *end)
{
    const char *last = c + 1;
    if (*c == ';' || *c == '"') {
        last = memchr(last, *c == ';' ? '\n' : '"', (size_t)(end - last));
        last = last == NULL ? end : last + 1;
        scan->string = *c == '"' ? (struct scene_word){c + 1, (size_t)(last - c) - 2} : scan->string;
        return last;
    }
    while (is_of_word(*c) && last < end && is_of_word(*last)) {
        last++;
    }
    if (last < end && *last == ':') {
        scan->name = (struct scene_word){c, (size_t)(last - c)};
        scan->has_layer = scan->has_layer || (scan->depth == 2 && scene_word_is(scan->name, layer_name));
    }
    return last;
}

static char *add_to_text(struct scene_import *import, const char *bytes, size_t *size)
{
    static const char added[] =
        "LayerElementMaterial: 0 {\n MappingInformationType: \"AllSame\"\n"
        " ReferenceInformationType: \"IndexToDirect\"\n Materials: *1 {\n a: 0\n }\n}\n"
        "Layer: 0 {\n LayerElement:  {\n Type: \"LayerElementMaterial\"\n"
        " TypedIndex: 0\n }\n}\n";
    struct scene_edits edits = {0};
    struct scan scan = {.depth = 0};
    const char *const end = bytes + *size;
    for (const char *c = bytes; c < end; c = pass(&scan, c, end)) {
        if (*c == '{') {
            open_record(&scan);
        } else if (*c == '}' && close_record(&scan)) {
            scene_edits_add_string(import, &edits, (size_t)(c - bytes), 0, added);
        }
    }
    return edits.count > 0 ? scene_edits_apply(import, &edits, bytes, size) : NULL;
}

char *scene_assimp_fbx(struct scene_import *import, size_t *size)
{
    const char *problem = NULL;
    struct scene_fbx_bytes file;
    const bool may_be_fbx = import->ending[0] == 0 || strcasecmp(import->ending, "fbx") == 0;
    char *const bytes = may_be_fbx ? scene_import_read_bytes(import->model.path, size, &problem) : NULL;
    if (bytes == NULL) {
        return NULL;
    }
    char *const changed = scene_fbx_is_binary(bytes, *size, &file)      ? add_to_binary(import, &file, size)
                          : strstr(bytes, "FBXHeaderExtension") != NULL ? add_to_text(import, bytes, size)
                                                                        : NULL;
    free(bytes);
    return changed;
}
