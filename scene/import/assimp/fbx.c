// SPDX-License-Identifier: MIT
// Whether an FBX is whole. assimp reads what there is of one that was cut, and says nothing. Numbers of the other byte
// order, which no reader here knows, would look like places behind the end.
#include <stdlib.h>
#include <string.h>

#include "fbx_record.h"
#include "import/builder/readers.h"

enum { ORDER_AT = 22, END_MARK = 16 };

// A record begins with the place where it ends; an empty one, whose place is 0, is the last. What follows ends with a
// mark that is the same in all files.
static void check_binary(struct scene_import *import, const struct scene_fbx_bytes *file)
{
    static const unsigned char end_mark[END_MARK] = {0xf8, 0x5a, 0x8c, 0x6a, 0xde, 0xf5, 0xd9, 0x7e,
                                                     0xec, 0xe9, 0x0c, 0xe3, 0x75, 0x8f, 0x29, 0x0b};
    const size_t size = file->size, word = file->word;
    uint64_t place = SCENE_FBX_HEADER;
    for (;;) {
        if (size < word || place > size - word) {
            scene_import_fail(import, "is cut: a part of it should begin at byte %llu; it has %zu",
                              (unsigned long long)place, size);
        }
        const uint64_t end = scene_fbx_number(file->bytes + place, word);
        if (end == 0) {
            break;
        }
        if (end > size) {
            scene_import_fail(import, "is cut: a part of it should end at byte %llu; it has %zu",
                              (unsigned long long)end, size);
        }
        if (end <= place) {
            return; // not cut but damaged, which its reader will tell
        }
        place = end;
    }
    if (size < END_MARK || memcmp(file->bytes + size - END_MARK, end_mark, END_MARK) != 0) {
        scene_import_warn(import, "has no mark at its end: it may be cut");
    }
}

// Every brace that is opened outside of comments and strings must be closed.
static void check_text(struct scene_import *import, const char *text, size_t size)
{
    size_t depth = 0;
    bool quoted = false, comment = false;
    for (size_t i = 0; i < size; i++) {
        const char c = text[i];
        comment = c != '\n' && (comment || (c == ';' && !quoted));
        quoted = comment ? quoted : quoted != (c == '"');
        if (!comment && !quoted) {
            depth += c == '{';
            depth -= c == '}' && depth > 0;
        }
    }
    if (depth > 0 || quoted) {
        scene_import_fail(import, "is cut: %zu of its sections are open where it ends", depth);
    }
}

void scene_import_check_fbx(struct scene_import *import)
{
    const char *problem = NULL;
    size_t size = 0;
    char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes == NULL) {
        scene_import_fail(import, "cannot be read: %s", problem);
    }
    struct scene_fbx_bytes file = {.bytes = (const void *)bytes, .size = size, .word = 4};
    if (scene_fbx_has_mark(bytes, size)) {
        if (size > ORDER_AT && bytes[ORDER_AT] == 1) {
            scene_import_fail(import, "is a binary FBX in big-endian order, which is not supported");
        }
        scene_fbx_is_binary(bytes, size, &file);
        check_binary(import, &file);
    } else if (strncmp(bytes, "Kaydara FBX Binary", 18) != 0 && memchr(bytes, 0, size) == NULL) {
        check_text(import, bytes, size);
    }
    free(bytes);
}
