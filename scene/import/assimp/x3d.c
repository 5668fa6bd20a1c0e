// SPDX-License-Identifier: MIT
// X3D for assimp, which 5.2.5 reads otherwise than it is written. It refuses a file for any node that it does not know,
// so it gets the file without it. Texts of metadata it takes for numbers, so it gets no metadata, which is about no
// picture.
#include "assimp.h"
#include "collada_markup.h"
#include "edits.h"
#include "x3d_document.h"
#include "x3d_faces.h"
#include "x3d_groups.h"
#include "x3d_materials.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// Write a tag of metadata, which holds nothing but others of its kind, as a text. Return false if it is another.
static bool write_metadata(struct scene_import *import, struct scene_edits *edits, const char *text,
                           const char *tag, const char *close)
{
    static const char start[] = "Metadata";
    const bool is_end = tag[1] == '/';
    if (strncmp(tag + 1 + is_end, start, strlen(start)) != 0) {
        return false;
    }
    scene_edits_add_string(import, edits, (size_t)(tag - text), (size_t)(close - tag) + 1,
                           is_end ? "" : SCENE_X3D_FILLER);
    return true;
}

// Return how long a reference to a blank is, such as &#10; or &#xA;. Return 0 for another one, and for other text.
static size_t blank_reference(const char *text)
{
    const bool is_hexadecimal = text[0] == '&' && text[1] == '#' && text[2] == 'x';
    const char *const digits = text + 2 + is_hexadecimal;
    if (text[0] != '&' || text[1] != '#' || !isxdigit((unsigned char)*digits)) {
        return 0;
    }
    char *end;
    const unsigned long code = strtoul(digits, &end, is_hexadecimal ? 16 : 10);
    const bool is_blank = *end == ';' && code < 128 && scene_collada_is_blank((char)code);
    return is_blank ? (size_t)(end + 1 - text) : 0;
}

// Write references to blanks, between which numbers of lists may stand, as blanks.
static void write_blanks(char *text, size_t *size)
{
    size_t length = 0, i = 0;
    while (i < *size) {
        const size_t reference = blank_reference(text + i);
        text[length++] = reference > 0 ? ' ' : text[i];
        i += reference > 0 ? reference : 1;
    }
    text[length] = 0;
    *size = length;
}

static char *write_tags(struct scene_import *import, const struct scene_x3d_document *document, char *source,
                        size_t *size)
{
    write_blanks(source, size);
    char *const text = scene_assimp_repeat_groups(import, scene_assimp_hide_proxies(import, source, size),
                                                  size, document->outer != NULL);
    struct scene_edits edits = {0};
    // Many sets may use one list of points, which is read for each, and which each may have all of.
    const size_t per_byte = 8;
    document->room->sets.largest += per_byte * *size;
    document->room->sets.most_read += *size;
    struct scene_x3d_faces faces = {.room = &document->room->sets};
    struct scene_x3d_materials materials = {0};
    char *close;
    for (char *tag = strchr(text, '<'); tag != NULL; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, text + *size);
        if (close == NULL) {
            break;
        }
        scene_x3d_write_appearance(import, &edits, &materials, text, tag, close);
        if (strncmp(tag, "<!---->", 7) == 0) { // a comment that assimp takes for a node
            scene_edits_add_string(import, &edits, (size_t)(tag + 4 - text), 0, SCENE_X3D_FILLER);
        } else if (!write_metadata(import, &edits, text, tag, close) &&
                   !scene_assimp_write_faces(import, &edits, &faces, text, tag, close, text + *size) &&
                   !scene_assimp_write_material(import, &edits, &materials,
                                                &(struct scene_x3d_tag){text, text + *size, tag, &close}) &&
                   !scene_assimp_write_group(import, &edits, text, tag, close) &&
                   !scene_x3d_write_inline(import, &edits, document, text, tag, close)) {
            scene_x3d_write_address(import, &edits, document, text, tag, close);
            scene_x3d_write_texture_transform(import, &edits, text, tag, close);
        }
    }
    scene_x3d_free_faces(&faces);
    char *const written = scene_edits_apply(import, &edits, text, size);
    if (written == NULL) {
        return text;
    }
    free(text);
    return written;
}

// Write blanks over the nodes of a name within those of another.
static void blank_nodes(char *text, size_t size, const struct scene_assimp_unknown *unknown)
{
    enum { DEEPEST = 256 };
    const char *open[DEEPEST];  // the tags that are open
    char *close, *first = NULL; // the first tag of what is blanked
    size_t depth = 0, first_depth = 0;
    for (char *tag = strchr(text, '<'); tag != NULL; tag = strchr(close + 1, '<')) {
        close = scene_collada_markup_end(tag, text + size);
        if (close == NULL || depth == DEEPEST) {
            return;
        }
        const bool is_node = tag[1] != '!' && tag[1] != '?', is_end = tag[1] == '/';
        if (first == NULL && is_node && !is_end && depth > 0 && scene_collada_is_tag(tag, unknown->node) &&
            scene_collada_is_tag(open[depth - 1], unknown->parent)) {
            first = tag;
            first_depth = depth;
        }
        depth -= is_end && depth > 0;
        if (first != NULL && is_node && depth == first_depth && (is_end || close[-1] == '/')) {
            memset(first, ' ', (size_t)(close - first) + 1);
            memcpy(first, SCENE_X3D_FILLER, strlen(SCENE_X3D_FILLER)); // a group may have nothing else
            first = NULL;
        } else if (is_node && !is_end && close[-1] != '/') {
            open[depth++] = tag;
        }
    }
}

char *scene_x3d_read_document(struct scene_import *import, const struct scene_x3d_document *document,
                              size_t *size)
{
    const char *problem = NULL;
    char *const text = scene_import_read_bytes(document->path, size, &problem);
    if (text == NULL || strncmp(text, "\xff\xfe", 2) == 0 || strncmp(text, "\xfe\xff", 2) == 0) {
        free(text);
        return NULL;
    }
    const size_t counted = document->outer == NULL ? 0 : *size;
    document->room->read -= counted < document->room->read ? counted : document->room->read;
    return write_tags(import, document, text, size);
}

static bool is_light(const char *tag)
{
    return scene_collada_is_tag(tag, "DirectionalLight") || scene_collada_is_tag(tag, "PointLight") ||
           scene_collada_is_tag(tag, "SpotLight");
}

// Take the name of each light that has that of another one, as assimp puts all lights of a name in one place.
static char *drop_names(struct scene_import *import, char *text, size_t *size)
{
    struct scene_edits edits = {0};
    struct scene_x3d_names lights = {0};
    char *close;
    for (char *tag = strchr(text, '<'); tag != NULL; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, text + *size);
        if (close == NULL) {
            break;
        }
        const struct scene_collada_value name = is_light(tag) ? scene_collada_attribute(tag, close, "DEF")
                                                              : (struct scene_collada_value){NULL, 0};
        if (name.text != NULL && scene_x3d_find_name(&lights, name) != NULL) {
            scene_edits_add_string(import, &edits, (size_t)(name.text - text), name.length, "");
        }
        scene_x3d_add_name(import, &lights, (struct scene_x3d_name){.name = name});
    }
    scene_x3d_free_names(&lights);
    return scene_edits_replace(import, &edits, text, size);
}

char *scene_assimp_x3d(struct scene_import *import, struct scene_assimp_unknowns *unknowns, size_t *size)
{
    struct scene_x3d_room room = {
        .shown = (size_t)1 << 25,
        .read = (size_t)1 << 28,
        .sets = {.largest = (size_t)1 << 25, .most_read = (size_t)1 << 28},
    };
    const struct scene_x3d_document document = {import->model.path, "", NULL, &room};
    if (unknowns->text == NULL && strcasecmp(import->ending, "x3d") == 0) {
        char *const text = scene_x3d_read_document(import, &document, &unknowns->size);
        unknowns->text = text == NULL ? NULL : drop_names(import, text, &unknowns->size);
    }
    while (unknowns->text != NULL && unknowns->blanked < unknowns->count) {
        // assimp names the parents of nodes as they are written
        blank_nodes(unknowns->text, unknowns->size, &unknowns->list[unknowns->blanked++]);
    }
    *size = unknowns->size;
    return unknowns->text;
}

bool scene_assimp_leave_out(struct scene_import *import, const char *error,
                            struct scene_assimp_unknowns *unknowns)
{
    struct scene_assimp_unknown *const unknown = &unknowns->list[unknowns->count];
    if (strcasecmp(import->ending, "x3d") != 0 || unknowns->count == SCENE_ASSIMP_UNKNOWNS ||
        sscanf(error, "Unknown node \"%63[^\"]\" in %63[^.].", unknown->node, unknown->parent) != 2) {
        return false;
    }
    for (unsigned i = 0; i < unknowns->count; i++) {
        if (strcmp(unknowns->list[i].node, unknown->node) == 0 &&
            strcmp(unknowns->list[i].parent, unknown->parent) == 0) {
            return false; // it is still there
        }
    }
    unknowns->count++;
    scene_import_unsupported(import, "nodes %s in %s (X3D): not drawn", unknown->node, unknown->parent);
    return true;
}
