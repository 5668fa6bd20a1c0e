// SPDX-License-Identifier: MIT
// Images of Collada that name no file. assimp 5.2.5 refuses the whole document for one, or aborts where the name is
// empty. The id of the image becomes its name, in the place of all that it holds, so that the image is told as one that
// is missing.
#include "assimp.h"
#include "collada_markup.h"

#include <stdlib.h>
#include <string.h>

// A document that is copied with changes. Nothing is written while `bytes` is NULL, which counts.
struct copy {
    char *bytes;
    size_t size;
};

static void add(struct copy *copy, const char *text, size_t length)
{
    if (copy->bytes != NULL) {
        memcpy(copy->bytes + copy->size, text, length);
    }
    copy->size += length;
}

// Return true for the start tag of an element whose text is a file or a picture.
static bool is_source(const char *tag)
{
    return scene_collada_is_tag(tag, "init_from") || scene_collada_is_tag(tag, "data") ||
           scene_collada_is_tag(tag, "ref") || scene_collada_is_tag(tag, "hex");
}

static bool is_blank(const char *text, const char *end)
{
    while (text < end && scene_collada_is_blank(*text)) {
        text++;
    }
    return text == end;
}

// Return the > at the end of an image whose start tag ends at `close`. Return NULL if it has none. Say whether it has a
// file or a picture.
static char *find_image_end(char *close, const char *end, bool *is_named)
{
    bool is_within = false; // the text belongs to an element that is a source
    char *text = close + 1;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(text, '<')) {
        char *const last = scene_collada_markup_end(c, end);
        const bool has_text = !is_blank(text, c) || strncmp(c, "<![CDATA[", strlen("<![CDATA[")) == 0;
        *is_named = *is_named || (is_within && has_text) || strncmp(c, "<create_", strlen("<create_")) == 0;
        if (last == NULL || scene_collada_is_end(c, "image")) {
            return last;
        }
        if (c[1] != '!' && c[1] != '?') {
            is_within = is_source(c) && last[-1] != '/';
        }
        text = last + 1;
    }
    return NULL;
}

static void add_name(struct copy *copy, struct scene_collada_value id)
{
    static const char before[] = "><init_from>", behind[] = "</init_from></image>", nameless[] = "image";
    const bool has_id = id.length > 0 && !is_blank(id.text, id.text + id.length);
    add(copy, before, sizeof before - 1);
    add(copy, has_id ? id.text : nameless, has_id ? id.length : sizeof nameless - 1);
    add(copy, behind, sizeof behind - 1);
}

// Copy a document, each image of which gets a name. Return how many had none.
static size_t copy_named(char *text, const char *end, struct copy *copy)
{
    size_t count = 0;
    char *done = text, *last;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(last, '<')) {
        char *const close = last = scene_collada_markup_end(c, end);
        const bool is_image = close != NULL && scene_collada_is_tag(c, "image");
        const bool is_single = is_image && close[-1] == '/';
        bool is_named = !is_image;
        if (is_image && !is_single) {
            last = find_image_end(close, end, &is_named);
        }
        if (last == NULL) {
            break;
        }
        if (!is_named) {
            add(copy, done, (size_t)(close - is_single - done));
            add_name(copy, scene_collada_attribute(c, close, "id"));
            done = last + 1;
            count++;
        }
    }
    add(copy, done, (size_t)(end - done));
    return count;
}

char *scene_assimp_name_images(char *text, size_t *size)
{
    struct copy copy = {0};
    if (copy_named(text, text + *size, &copy) == 0) {
        return text;
    }
    copy.bytes = malloc(copy.size + 1);
    if (copy.bytes == NULL) {
        return text;
    }
    copy.size = 0;
    copy_named(text, text + *size, &copy);
    copy.bytes[copy.size] = 0;
    *size = copy.size;
    free(text);
    return copy.bytes;
}
