// SPDX-License-Identifier: MIT
// Whether an FBX is whole. assimp reads what there is of one that was cut, and says nothing. Numbers of the other byte
// order, which no reader here knows, would look like places behind the end.
#include <stdlib.h>
#include <string.h>

#include "import/builder/readers.h"

static const char magic[] = "Kaydara FBX Binary  "; // with the 0 at its end
enum { ORDER_AT = 22, VERSION_AT = 23, HEADER = 27, WIDE_SINCE = 7500, END_MARK = 16 };

static uint64_t read_number(const unsigned char *bytes, size_t size)
{
    uint64_t number = 0;
    for (size_t i = size; i > 0; i--) {
        number = number << 8 | bytes[i - 1];
    }
    return number;
}

// A record begins with the place where it ends; an empty one, whose place is 0, is the last. What follows ends with a
// mark that is the same in all files.
static void check_binary(struct scene_import *import, const unsigned char *bytes, size_t size)
{
    static const unsigned char end_mark[END_MARK] = {0xf8, 0x5a, 0x8c, 0x6a, 0xde, 0xf5, 0xd9, 0x7e,
                                                     0xec, 0xe9, 0x0c, 0xe3, 0x75, 0x8f, 0x29, 0x0b};
    const size_t word = size > HEADER && read_number(bytes + VERSION_AT, 4) >= WIDE_SINCE ? 8 : 4;
    uint64_t place = HEADER;
    for (;;) {
        if (size < word || place > size - word) {
            scene_import_fail(import, "is cut: a part of it should begin at byte %llu; it has %zu",
                              (unsigned long long)place, size);
        }
        const uint64_t end = read_number(bytes + place, word);
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
    if (size < END_MARK || memcmp(bytes + size - END_MARK, end_mark, END_MARK) != 0) {
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
    if (size >= sizeof magic && memcmp(bytes, magic, sizeof magic) == 0) {
        if (size > ORDER_AT && bytes[ORDER_AT] == 1) {
            scene_import_fail(import, "is a binary FBX in big-endian order, which is not supported");
        }
        check_binary(import, (const unsigned char *)bytes, size);
    } else if (strncmp(bytes, magic, strlen(magic)) != 0 && memchr(bytes, 0, size) == NULL) {
        check_text(import, bytes, size);
    }
    free(bytes);
}
