// SPDX-License-Identifier: MIT
// Groups of an X3D. assimp 5.2.5 drops those of some kinds in silence, which get the names of those that it reads, and
// crashes at those that are used again, which it gets as often as they are drawn.
#include "x3d_groups.h"

#include "collada_markup.h"
#include "import/builder/import.h"
#include "x3d_set.h"

#include <stdlib.h>
#include <string.h>

// What groups are called, and what assimp reads them by, at their beginning and their end. Of levels of detail the
// first is the finest.
static const char *const groups[][3] = {{"Group", "Group", "Group"},
                                        {"StaticGroup", "StaticGroup", "StaticGroup"},
                                        {"Transform", "Transform", "Transform"},
                                        {"Switch", "Switch", "Switch"},
                                        {"Collision", "Group", "Group"},
                                        {"Anchor", "Group", "Group"},
                                        {"Billboard", "Group", "Group"},
                                        {"PickableGroup", "Group", "Group"},
                                        {"LayoutGroup", "Group", "Group"},
                                        {"ScreenGroup", "Group", "Group"},
                                        {"CADLayer", "Group", "Group"},
                                        {"CADAssembly", "Group", "Group"},
                                        {"CADFace", "Group", "Group"},
                                        {"CADPart", "Transform", "Transform"},
                                        {"EspduTransform", "Transform", "Transform"},
                                        {"LOD", "Switch whichChoice=\"0\"", "Switch"}};

// Return true if an element ends without content. One that is used again has none, or comments.
static bool is_bare(char *tag, char *close)
{
    return close[-1] == '/' || strncmp(close + 1 + strspn(close + 1, " \t\r\n"), "</", 2) == 0 ||
           scene_collada_attribute(tag, close, "USE").text != NULL;
}

// Write a group without content, at which assimp crashes, as one with a text, of which it takes no notice.
static void write_bare(struct scene_import *import, struct scene_edits *edits, const char *text, char *tag,
                       char *close, const char *name)
{
    char written[64];
    if (close[-1] == '/') {
        snprintf(written, sizeof written, "<%s>" SCENE_X3D_FILLER "</%s>", name, name);
    } else {
        snprintf(written, sizeof written, "<%s>" SCENE_X3D_FILLER, name);
    }
    scene_edits_add_string(import, edits, (size_t)(tag - text), (size_t)(close - tag) + 1, written);
    if (scene_collada_attribute(tag, close, "USE").text != NULL) {
        scene_import_unsupported(import, "some groups that are used again (X3D): not drawn");
    }
}

// Find the row of a group by its tag. Return NULL if it is no group.
static const char *const *find_group(const char *tag)
{
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++) {
        if (scene_collada_is_tag(tag, groups[i][0])) {
            return groups[i];
        }
    }
    return NULL;
}

bool scene_assimp_write_group(struct scene_import *import, struct scene_edits *edits, const char *text,
                              char *tag, char *close)
{
    char *const name = tag + (tag[1] == '/');
    const char *const *const group = find_group(name);
    if (group == NULL) {
        return false;
    }
    const char *const written = group[name == tag ? 1 : 2];
    if (name == tag && is_bare(tag, close)) {
        write_bare(import, edits, text, tag, close, group[2]);
    } else if (strcmp(written, group[0]) != 0) {
        scene_edits_add_string(import, edits, (size_t)(name + 1 - text), strlen(group[0]), written);
    }
    return true;
}

// An element that is open. Its name is NULL where it has none, or is no group.
struct element {
    struct scene_collada_value name;
    size_t at; // in the text that is written
};

struct work {
    struct scene_import *import;
    char *from; // what is read from here on is not written yet
    char *out;  // the text that is written
    size_t size, capacity, largest;
    bool repeats_sets;
    struct element *open;
    size_t open_count, open_capacity;
    struct scene_x3d_names
        named; // groups, in the text that is written; the names stand in the one that is read
};

// Write a text. It may be in what is written.
static void write_text(struct work *work, const char *text, size_t length)
{
    const size_t own = work->out != NULL && text >= work->out && text < work->out + work->size
                           ? (size_t)(text - work->out)
                           : SIZE_MAX;
    scene_import_reserve(work->import, &work->out, &work->capacity, work->size + length + 1, 1);
    memcpy(work->out + work->size, own == SIZE_MAX ? text : work->out + own, length);
    work->size += length;
}

// Where what is read will be written.
static size_t place_of(const struct work *work, const char *text)
{
    return work->size + (size_t)(text - work->from);
}

// Keep a group that ends before `end`.
static void keep(struct work *work, struct element element, const char *end)
{
    scene_x3d_add_name(work->import, &work->named,
                       (struct scene_x3d_name){element.name, element.at, place_of(work, end) - element.at});
}

// Return the end of an element that is used again, which has comments at most in it. Return NULL if it has more.
static char *end_of_use(char *close, const char *end)
{
    char *tag = close[-1] == '/' ? NULL : strchr(close, '<');
    while (tag != NULL && strncmp(tag, "<!--", 4) == 0) {
        close = scene_collada_markup_end(tag, end);
        tag = close == NULL ? NULL : strchr(close, '<');
    }
    return tag == NULL ? close : tag[1] == '/' ? scene_collada_markup_end(tag, end) : NULL;
}

// Write a node again, in this field of the one around it, or in that where it belongs if there is none.
static void write_copy(struct work *work, const struct scene_x3d_name *node, struct scene_collada_value field)
{
    static const char attribute[] = "containerField";
    char *const tag = work->out + node->at;
    char *const close = scene_collada_markup_end(tag, tag + node->size);
    const struct scene_collada_value old = scene_collada_attribute(tag, close, attribute);
    const size_t head = strcspn(tag, " \t\r\n/>"), length = strlen(attribute);
    const size_t begin = old.text == NULL ? head : (size_t)(scene_collada_name_end(old) - tag) - length,
                 end = old.text == NULL ? head : (size_t)(old.text - tag) + old.length + 1;
    write_text(work, work->out + node->at, head);
    if (field.text != NULL) {
        write_text(work, " containerField=", 1 + length + 1);
        write_text(work, field.text - 1, field.length + 2); // with its quotation marks
    }
    write_text(work, work->out + node->at + head, begin - head);
    write_text(work, work->out + node->at + end, node->size - end);
}

// Write the group that a tag uses again. Return the > at the end of the tag's element, or NULL if it does not, or
// where all would become too large.
static char *write_use(struct work *work, char *tag, char *close, const char *end)
{
    const struct scene_collada_value use = scene_collada_attribute(tag, close, "USE");
    const struct scene_x3d_name *const named =
        use.text == NULL ? NULL : scene_x3d_find_name(&work->named, use);
    char *const last = named == NULL ? NULL : end_of_use(close, end);
    if (last == NULL || named->size > work->largest || place_of(work, tag) > work->largest - named->size) {
        return NULL;
    }
    write_text(work, work->from, (size_t)(tag - work->from));
    write_copy(work, named, scene_collada_attribute(tag, close, "containerField"));
    work->from = last + 1;
    return last;
}

// Return true for the tag of a node that is written as often as it is used: groups, solids, which are made with a
// texture or without one, and what assimp would search all nodes of the document for at each use.
static bool is_written_again(const char *tag)
{
    static const char *const nodes[] = {
        "Shape", "Appearance", "Material", "ImageTexture", "TextureTransform", "Inline",
        "Box",   "Sphere",     "Cone",     "Cylinder",     "Rectangle2D",      "Disk2D"};
    bool is_node = find_group(tag) != NULL;
    for (size_t i = 0; i < sizeof nodes / sizeof nodes[0]; i++) {
        is_node = is_node || scene_collada_is_tag(tag, nodes[i]);
    }
    return is_node;
}

// Look at a tag. Return the > at its end, or at that of its element where it stands for another one.
static char *repeat(struct work *work, char *tag, char *close, const char *end)
{
    if (tag[1] == '/') {
        if (work->open_count > 0) {
            keep(work, work->open[--work->open_count], close + 1);
        }
        return close;
    }
    if (tag[1] == '!' || tag[1] == '?') {
        return close;
    }
    const bool is_repeated =
        is_written_again(tag) || (work->repeats_sets && scene_x3d_find_kind(tag) != NULL);
    char *const last = is_repeated ? write_use(work, tag, close, end) : NULL;
    if (last != NULL) {
        return last;
    }
    struct element element = {.at = place_of(work, tag)};
    if (is_repeated) {
        element.name = scene_collada_attribute(tag, close, "DEF");
    }
    if (close[-1] == '/') {
        keep(work, element, close + 1);
    } else {
        scene_import_reserve(work->import, &work->open, &work->open_capacity, work->open_count + 1,
                             sizeof *work->open);
        work->open[work->open_count++] = element;
    }
    return close;
}

char *scene_assimp_repeat_groups(struct scene_import *import, char *text, size_t *size, bool has_own_names)
{
    // A few groups in each other, of two uses each, would be of any size.
    const size_t room = (size_t)1 << 23, per_byte = 8;
    struct work work = {
        .import = import, .from = text, .largest = room + per_byte * *size, .repeats_sets = has_own_names};
    const char *const end = text + *size;
    char *close;
    for (char *tag = strchr(text, '<'); tag != NULL; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, end);
        if (close == NULL) {
            break;
        }
        close = repeat(&work, tag, close, end);
    }
    if (work.out != NULL) {
        write_text(&work, work.from, (size_t)(end - work.from));
        work.out[work.size] = 0;
        *size = work.size;
        free(text);
    }
    free(work.open);
    scene_x3d_free_names(&work.named);
    return work.out == NULL ? text : work.out;
}
