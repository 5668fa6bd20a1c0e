// SPDX-License-Identifier: MIT
// Images and samplers of Collada 1.5. assimp 5.2.5 looks for the address of an image in the tag of its sampler, and for
// the name of a file in any element of an image but <init_from>, in which it stands, and refuses the documents.
#include "assimp.h"
#include "collada_markup.h"
#include "edits.h"

#include <stdio.h>
#include <string.h>

struct work {
    struct scene_import *import;
    struct scene_edits edits;
    const char *text;
    char *sampler;           // the > of the tag of a sampler that is open and has no address; else NULL
    char *source;            // the <init_from> that is open in an image; else NULL
    bool is_image, is_named; // within an image; within its <init_from> stands an element that has a file
};

static void bind_sampler(struct work *work, char *tag, char *close)
{
    const struct scene_collada_value url = scene_collada_attribute(tag, close, "url");
    if (url.text != NULL) {
        const size_t size = sizeof " url=" - 1 + url.length + 2;
        char *const address = scene_import_allocate_any(work->import, size + 1, 1);
        snprintf(address, size + 1, " url=%.*s", (int)url.length + 2, url.text - 1);
        scene_edits_add(work->import, &work->edits,
                        (struct scene_edit){(size_t)(work->sampler - work->text), 0, address, size});
    }
    work->sampler = NULL;
}

static void look_at_sampler(struct work *work, char *tag, char *close)
{
    if (scene_collada_is_tag(tag, "sampler2D")) {
        const bool is_open = close[-1] != '/' && scene_collada_attribute(tag, close, "url").text == NULL;
        work->sampler = is_open ? close : NULL;
    } else if (scene_collada_is_end(tag, "sampler2D")) {
        work->sampler = NULL;
    } else if (work->sampler != NULL && scene_collada_is_tag(tag, "instance_image")) {
        bind_sampler(work, tag, close);
    }
}

// Write another name for an element, by its < or by the / of its end.
static void rename_source(struct work *work, const char *tag)
{
    scene_edits_add_string(work->import, &work->edits, (size_t)(tag + 1 - work->text), strlen("init_from"),
                           "file");
}

// Rename <init_from> where it holds an element that has a file.
static void look_at_image(struct work *work, char *tag, char *close)
{
    if (scene_collada_is_tag(tag, "image")) {
        work->is_image = close[-1] != '/';
    } else if (scene_collada_is_end(tag, "image")) {
        work->is_image = false;
        work->source = NULL;
    } else if (work->is_image && scene_collada_is_tag(tag, "init_from") && close[-1] != '/') {
        work->source = tag;
        work->is_named = false;
    } else if (scene_collada_is_tag(tag, "ref") || scene_collada_is_tag(tag, "hex")) {
        work->is_named = true;
    } else if (work->source != NULL && scene_collada_is_end(tag, "init_from")) {
        if (work->is_named) {
            rename_source(work, work->source);
            rename_source(work, tag + 1);
        }
        work->source = NULL;
    }
}

char *scene_assimp_write_samplers(struct scene_import *import, char *text, size_t *size)
{
    struct work work = {.import = import, .text = text};
    char *last;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(last, '<')) {
        last = scene_collada_markup_end(c, text + *size);
        if (last == NULL) {
            break;
        }
        look_at_sampler(&work, c, last);
        look_at_image(&work, c, last);
    }
    return scene_edits_replace(import, &work.edits, text, size);
}
