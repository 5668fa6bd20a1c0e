// SPDX-License-Identifier: MIT
// Models of an FBX that are hidden. assimp keeps one of the two properties that hide them, and not the one that Maya
// writes, so both are looked for in the file. A model hides those below it.
#include "assimp.h"
#include "fbx_record.h"
#include "import/builder/text_lines.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

struct hidden {
    struct scene_import *import;
    struct scene_word *names; // names of models, which stay in the file's bytes
    size_t count, capacity;
};

static bool hides(struct scene_word property, double value)
{
    return value <= 0 && (scene_word_is(property, "Show") || scene_word_is(property, "Visibility"));
}

static void add(struct hidden *hidden, struct scene_word name)
{
    scene_import_reserve(hidden->import, &hidden->names, &hidden->capacity, hidden->count + 1,
                         sizeof *hidden->names);
    hidden->names[hidden->count++] = name;
}

// Binary --------------------------------------------------------------------------------------------

// Find the next record of a list that has a name, from `place` on. Return false at the end of the list.
static bool find_record(const struct scene_fbx_bytes *file, size_t *place, size_t limit, const char *name,
                        struct scene_fbx_record *record)
{
    while (scene_fbx_read_record(file, *place, limit, record) && record->end > *place) {
        *place = (size_t)record->end;
        if (scene_fbx_is_named(file, record, name)) {
            return true;
        }
    }
    return false;
}

// Read the string that is a value of a record, from 0 on. It is empty if that is none.
static struct scene_word string_of(const struct scene_fbx_bytes *file, const struct scene_fbx_record *record,
                                   int number)
{
    size_t place = record->values, length = 0;
    for (int i = 0; i < number && place != 0; i++) {
        place = scene_fbx_value_end(file, place, record->children);
    }
    const size_t start = place == 0 ? 0 : scene_fbx_string_at(file, place, record->children, &length);
    return start == 0 ? (struct scene_word){"", 0}
                      : (struct scene_word){(const char *)file->bytes + start, length};
}

// Return true if the value behind the name, the type, the label and the flags of a property is a number of 0 or less.
static bool is_zero(const struct scene_fbx_bytes *file, const struct scene_fbx_record *property)
{
    size_t place = property->values;
    for (int i = 0; i < 4 && place != 0; i++) {
        place = scene_fbx_value_end(file, place, property->children);
    }
    const size_t end = place == 0 ? 0 : scene_fbx_value_end(file, place, property->children);
    if (end == 0 || strchr("CBYILFD", file->bytes[place]) == NULL) {
        return false;
    }
    const unsigned char sign = file->bytes[end - 1] & 0x80;
    return sign != 0 || scene_fbx_number(file->bytes + place + 1, end - place - 1) == 0;
}

static void look_at_bytes(struct hidden *hidden, const struct scene_fbx_bytes *file)
{
    struct scene_fbx_record objects, model, list, property;
    size_t place = SCENE_FBX_HEADER;
    if (!find_record(file, &place, file->size, "Objects", &objects)) {
        return;
    }
    place = objects.children;
    while (find_record(file, &place, (size_t)objects.end, "Model", &model)) {
        bool is_hidden = false;
        size_t in_model = model.children;
        if (find_record(file, &in_model, (size_t)model.end, "Properties70", &list)) {
            size_t in_list = list.children;
            while (find_record(file, &in_list, (size_t)list.end, "P", &property)) {
                is_hidden =
                    is_hidden || hides(string_of(file, &property, 0), is_zero(file, &property) ? 0 : 1);
            }
        }
        if (is_hidden) {
            add(hidden, string_of(file, &model, 1));
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

// Return whether a string is the name of an object, behind its class: "DisplayLayer::Layer1".
static bool has_class(struct scene_word string)
{
    for (size_t i = 0; i + 1 < string.length; i++) {
        if (string.start[i] == ':' && string.start[i + 1] == ':') {
            return true;
        }
    }
    return false;
}

// In text a record has a line of its own, and so has a property.
static void look_at_text(struct hidden *hidden, char *bytes, size_t size)
{
    struct scene_text text = scene_text_open(hidden->import, bytes, size);
    struct scene_line line;
    struct scene_word word, name = {"", 0}, strings[4];
    while (scene_text_line(&text, false, &line)) {
        if (!scene_text_word(&line, &word)) {
            continue;
        }
        if (scene_word_is(word, "Model:")) {
            name.length = 0;
            next_string(&line, &name);
        } else if (!scene_word_is(word, "P:") && next_string(&line, &strings[0]) && has_class(strings[0])) {
            name.length = 0; // an object of another kind begins
        } else if (scene_word_is(word, "P:") && name.length > 0) {
            int count = 0;
            double value = 0;
            while (count < 4 && next_string(&line, &strings[count])) {
                count++;
            }
            line.cursor += line.cursor < line.end && *line.cursor == ',';
            if (count == 4 && scene_text_double(&line, &value) && hides(strings[0], value)) {
                add(hidden, name);
                name.length = 0;
            }
        }
    }
}

// Nodes ---------------------------------------------------------------------------------------------

static bool draws(const struct aiNode *node)
{
    bool any = node->mNumMeshes > 0;
    for (unsigned i = 0; i < node->mNumChildren && !any; i++) {
        any = draws(node->mChildren[i]);
    }
    return any;
}

// Return true if a name is that of a node from one on downward that draws something. In bytes the class stands behind
// the name, a 0 between them, and in text before it.
static bool is_drawn(const struct aiNode *node, struct scene_word name)
{
    static const char class[] = "Model::";
    const size_t skipped =
        name.length >= strlen(class) && memcmp(name.start, class, strlen(class)) == 0 ? strlen(class) : 0;
    const char *const zero = memchr(name.start, 0, name.length);
    const size_t length = (zero == NULL ? name.length : (size_t)(zero - name.start)) - skipped;
    bool found = node->mName.length == length &&
                 memcmp(node->mName.data, name.start + skipped, length) == 0 && draws(node);
    for (unsigned i = 0; i < node->mNumChildren && !found; i++) {
        found = is_drawn(node->mChildren[i], name);
    }
    return found;
}

void scene_assimp_tell_hidden(struct scene_import *import, const struct aiScene *scene)
{
    const char *problem = NULL;
    struct scene_fbx_bytes file;
    struct hidden hidden = {.import = import};
    size_t size = 0;
    char *const bytes = strcasecmp(import->ending, "fbx") == 0
                            ? scene_import_read_bytes(import->model.path, &size, &problem)
                            : NULL;
    if (bytes == NULL) {
        return;
    }
    if (scene_fbx_is_binary(bytes, size, &file)) {
        look_at_bytes(&hidden, &file);
    } else {
        look_at_text(&hidden, bytes, size);
    }
    bool any = false;
    for (size_t i = 0; i < hidden.count && !any; i++) {
        any = is_drawn(scene->mRootNode, hidden.names[i]);
    }
    if (any) {
        scene_import_unsupported(import, "hidden objects: drawn");
    }
    free(hidden.names);
    free(bytes);
}
