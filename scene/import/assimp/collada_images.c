// SPDX-License-Identifier: MIT
// Images of Collada that name no file. assimp 5.2.5 refuses the whole document for one, or aborts where the name is
// empty. The id of the image becomes its name, so that the image is told as one that is missing.
#include "assimp.h"
#include "collada_markup.h"

#include <stdlib.h>
#include <string.h>

static const char before_name[] = "<init_from>", behind_name[] = "</init_from>", behind_image[] = "</image>";

// The image that is being read.
struct image {
    struct scene_collada_value id;
    bool is_open, is_named;
};

// A document that is copied with more in it. Nothing is written while `bytes` is NULL, which counts.
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

static void add_name(struct copy *copy, const struct image *image)
{
    const bool has_id = image->id.length > 0;
    add(copy, before_name, sizeof before_name - 1);
    add(copy, has_id ? image->id.text : "image", has_id ? image->id.length : strlen("image"));
    add(copy, behind_name, sizeof behind_name - 1);
}

// Return the end of an <init_from> that is empty, at `tag`. Return NULL if it is not.
static char *find_end_of_empty(char *tag, char *close, const char *end)
{
    char *text = close + 1;
    while (scene_collada_is_blank(*text)) {
        text++;
    }
    const bool ends = strncmp(text, "</init_from", strlen("</init_from")) == 0;
    return !scene_collada_is_tag(tag, "init_from") ? NULL
           : close[-1] == '/'                      ? close
           : ends                                  ? scene_collada_tag_end(text, end)
                                                   : NULL;
}

// Copy a document, each image of which gets a name. Return how many had none.
static size_t copy_named(char *text, const char *end, struct copy *copy)
{
    struct image image = {0};
    size_t count = 0;
    char *done = text;
    for (char *c = strchr(text, '<'), *close; c != NULL; c = strchr(close, '<')) {
        close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            break;
        }
        char *const empty = image.is_open ? find_end_of_empty(c, close, end) : NULL;
        const bool is_single = scene_collada_is_tag(c, "image") && close[-1] == '/';
        const bool ends = strncmp(c, "</image", 7) == 0 && image.is_open && !image.is_named;
        if (scene_collada_is_tag(c, "image")) {
            image = (struct image){scene_collada_attribute(c, close, "id"), !is_single, false};
        } else if (c[1] != '/' && c[1] != '!' && empty == NULL) {
            image.is_named = true; // a file, or the picture itself
        }
        if (empty != NULL || ends || is_single) {
            char *const until = is_single ? close - 1 : c;
            add(copy, done, (size_t)(until - done));
            done = empty != NULL ? empty + 1 : is_single ? close + 1 : c;
            close = empty != NULL ? empty : close;
        }
        if (is_single) {
            add(copy, ">", 1);
        }
        if (ends || is_single) {
            add_name(copy, &image);
            count++;
        }
        if (is_single) {
            add(copy, behind_image, sizeof behind_image - 1);
        }
        image.is_open = image.is_open && strncmp(c, "</image", 7) != 0;
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
