// SPDX-License-Identifier: MIT
#include "edits.h"

#include <stdlib.h>
#include <string.h>

void scene_edits_add(struct scene_import *import, struct scene_edits *edits, struct scene_edit edit)
{
    scene_import_reserve(import, &edits->list, &edits->capacity, edits->count + 1, sizeof *edits->list);
    edits->list[edits->count++] = edit;
}

void scene_edits_add_string(struct scene_import *import, struct scene_edits *edits, size_t at, size_t length,
                            const char *text)
{
    const size_t size = strlen(text);
    char *const copy = scene_import_allocate(import, size, 1);
    memcpy(copy, text, size);
    scene_edits_add(import, edits, (struct scene_edit){at, length, copy, size});
}

static int compare(const void *a, const void *b)
{
    const struct scene_edit *const x = a, *const y = b;
    // What is inserted at a place stands before what replaces the bytes there.
    return x->at != y->at ? (x->at > y->at) - (x->at < y->at)
                          : (x->length > y->length) - (x->length < y->length);
}

// Return the size of a text after all changes. Return SIZE_MAX if they are in each other's way.
static size_t find_size(const struct scene_edits *edits, size_t size)
{
    size_t result = size, done = 0;
    for (size_t i = 0; i < edits->count; i++) {
        const struct scene_edit *const edit = &edits->list[i];
        if (edit->at < done || edit->at > size || edit->length > size - edit->at) {
            return SIZE_MAX;
        }
        done = edit->at + edit->length;
        result += edit->size - edit->length;
    }
    return result;
}

char *scene_edits_apply(struct scene_import *import, struct scene_edits *edits, const char *bytes,
                        size_t *size)
{
    if (edits->count > 0) {
        qsort(edits->list, edits->count, sizeof *edits->list, compare);
    }
    const size_t result = find_size(edits, *size);
    char *const text = result < SIZE_MAX ? scene_import_allocate(import, result + 1, 1) : NULL;
    char *out = text;
    size_t done = 0;
    for (size_t i = 0; i < edits->count; i++) {
        const struct scene_edit *const edit = &edits->list[i];
        if (text != NULL) {
            memcpy(out, bytes + done, edit->at - done);
            memcpy(out + edit->at - done, edit->text, edit->size);
            out += edit->at - done + edit->size;
            done = edit->at + edit->length;
        }
        free(edit->text);
    }
    if (text != NULL) {
        memcpy(out, bytes + done, *size - done);
        *size = result;
    }
    free(edits->list);
    *edits = (struct scene_edits){0};
    return text;
}

char *scene_edits_replace(struct scene_import *import, struct scene_edits *edits, char *text, size_t *size)
{
    char *const changed = edits->count > 0 ? scene_edits_apply(import, edits, text, size) : NULL;
    if (changed != NULL) {
        free(text);
    }
    return changed != NULL ? changed : text;
}
