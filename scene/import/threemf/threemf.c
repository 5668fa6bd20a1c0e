// SPDX-License-Identifier: MIT
// 3MF, what printers are given. assimp 5.2.5 keeps its shapes alone: colours, textures, components of components and
// objects in other parts of the package are lost, so it is read here: minizip opens the package, expat reads its XML.
#include "threemf.h"

#include <stdlib.h>
#include <string.h>

#include "import/builder/readers.h"
#include "import/builder/zip.h"

// The value of an attribute in the element that ends at `end`: NULL where it has none.
static const char *find_value(struct scene_import *import, const char *element, const char *end,
                              const char *name)
{
    const size_t length = strlen(name);
    for (const char *c = element; c + length + 2 < end; c++) {
        if (strncmp(c, name, length) == 0 && c[length] == '=' &&
            (c[length + 1] == '"' || c[length + 1] == '\'')) {
            const char *value = c + length + 2, *close = memchr(value, c[length + 1], (size_t)(end - value));
            return close == NULL ? NULL : scene_import_string(import, value, (size_t)(close - value));
        }
    }
    return NULL;
}

// Return the next element of a name, or NULL if there is none.
static const char *find_element(const char *text, const char *start)
{
    const size_t length = strlen(start);
    const char *element = strstr(text, start);
    while (element != NULL && strchr(" \t\r\n", element[length]) == NULL) {
        element = strstr(element + 1, start);
    }
    return element;
}

// Return the part that the package's relationships name as its model. There is to be one (Core, 2.1).
static const char *find_root(struct scene_3mf *file)
{
    static const char start[] = "<Relationship";
    size_t size;
    const char *const text = scene_zip_read_all(file->zip, "_rels/.rels", &size), *root = NULL;
    const char *const first = text == NULL ? NULL : find_element(text, start);
    for (const char *element = first; element != NULL; element = find_element(element + 1, start)) {
        const char *end = strchr(element, '>');
        const char *type = end == NULL ? NULL : find_value(file->import, element, end, "Type");
        if (type == NULL || strstr(type, "/3dmodel") == NULL) {
            continue;
        }
        const char *const target = find_value(file->import, element, end, "Target");
        if (root != NULL && target != NULL && strcmp(root, target) != 0) {
            scene_import_unsupported(file->import, "several models in the package: the first alone is drawn");
        }
        root = root != NULL ? root : target;
    }
    return root;
}

static int compare_groups(const void *left, const void *right)
{
    const struct scene_3mf_group *a = left, *b = right;
    return a->part != b->part ? (a->part > b->part) - (a->part < b->part) : (a->id > b->id) - (a->id < b->id);
}

static int compare_objects(const void *left, const void *right)
{
    const struct scene_3mf_object *a = left, *b = right;
    return a->part != b->part ? (a->part > b->part) - (a->part < b->part) : (a->id > b->id) - (a->id < b->id);
}

// After sorting: ids of a part are those of one thing each (Core, 3.4), else which one is meant is left to chance.
static void check_ids(const struct scene_3mf *file)
{
    for (uint32_t i = 1; i < file->group_count; i++) {
        if (compare_groups(&file->groups[i - 1], &file->groups[i]) == 0) {
            scene_import_fail(file->import, "has two groups of properties with id %u", file->groups[i].id);
        }
    }
    for (uint32_t i = 1; i < file->object_count; i++) {
        if (compare_objects(&file->objects[i - 1], &file->objects[i]) == 0) {
            scene_import_fail(file->import, "has two objects with id %u", file->objects[i].id);
        }
    }
}

// Say why there is nothing to draw, where the package tells it.
static void check_drawn(const struct scene_3mf *file)
{
    struct scene_import *import = file->import;
    const struct scene_model *model = &import->model;
    if (model->instance_count > 0) {
        return;
    }
    if (model->unsupported_count > 0) {
        scene_import_fail(import, "has nothing that can be drawn: %s", model->unsupported[0]);
    }
    if (scene_zip_find_ending(file->zip, ".gcode") != NULL) {
        scene_import_fail(import, "holds G-code for a printer, and no model");
    }
}

void scene_import_3mf(struct scene_import *import)
{
    struct scene_3mf file = {.import = import, .zip = scene_zip_open(import)};
    import->model.format = "3D Manufacturing Format (3MF)";
    import->model.up = SCENE_AXIS_Z;
    const char *root = find_root(&file);
    if (root == NULL) {
        root = scene_zip_find_ending(file.zip, ".model");
    }
    if (root == NULL) {
        scene_import_fail(import, "is a ZIP archive without a 3MF model in it");
    }
    scene_3mf_part(&file, root);
    for (uint32_t part = 0; part < file.part_count; part++) {
        scene_3mf_read_part(&file, part);
    }
    scene_3mf_read_slicer(&file);
    scene_3mf_sort_volumes(&file);
    if (file.group_count > 0) {
        qsort(file.groups, file.group_count, sizeof *file.groups, compare_groups);
    }
    if (file.object_count > 0) {
        qsort(file.objects, file.object_count, sizeof *file.objects, compare_objects);
    }
    check_ids(&file);
    scene_3mf_build(&file);
    check_drawn(&file);
}
