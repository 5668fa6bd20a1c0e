// SPDX-License-Identifier: MIT
// See fbx_record.h.
#include "fbx_record.h"

#include <string.h>

static const char magic[] = "Kaydara FBX Binary  "; // with the 0 at its end
enum { VERSION_AT = 23, WIDE_SINCE = 7500 };

uint64_t scene_fbx_number(const unsigned char *bytes, size_t size)
{
    uint64_t number = 0;
    for (size_t i = size; i > 0; i--) {
        number = number << 8 | bytes[i - 1];
    }
    return number;
}

bool scene_fbx_has_mark(const char *bytes, size_t size)
{
    return size >= sizeof magic && memcmp(bytes, magic, sizeof magic) == 0;
}

bool scene_fbx_is_binary(const char *bytes, size_t size, struct scene_fbx_bytes *file)
{
    if (size <= SCENE_FBX_HEADER || !scene_fbx_has_mark(bytes, size)) {
        return false;
    }
    *file = (struct scene_fbx_bytes){.bytes = (const void *)bytes, .size = size};
    file->word = scene_fbx_number(file->bytes + VERSION_AT, 4) >= WIDE_SINCE ? 8 : 4;
    return true;
}

size_t scene_fbx_head(const struct scene_fbx_bytes *file)
{
    return 3 * file->word + 1;
}

bool scene_fbx_is_named(const struct scene_fbx_bytes *file, const struct scene_fbx_record *record,
                        const char *name)
{
    return record->name_length == strlen(name) &&
           memcmp(file->bytes + record->name, name, record->name_length) == 0;
}

bool scene_fbx_read_record(const struct scene_fbx_bytes *file, size_t place, size_t limit,
                           struct scene_fbx_record *record)
{
    const size_t word = file->word, head = scene_fbx_head(file);
    if (place > limit || limit - place < head) {
        return false;
    }
    const unsigned char *const bytes = file->bytes + place;
    const uint64_t length = scene_fbx_number(bytes + 2 * word, word);
    record->end = scene_fbx_number(bytes, word);
    record->count = scene_fbx_number(bytes + word, word);
    record->name = place + head;
    record->name_length = bytes[3 * word];
    record->values = record->name + record->name_length;
    if (record->values > limit) {
        return false;
    }
    if (record->end == 0) {
        return true;
    }
    if (record->end > limit || record->values > record->end || length > record->end - record->values) {
        return false;
    }
    record->children = record->values + (size_t)length;
    return true;
}

size_t scene_fbx_value_end(const struct scene_fbx_bytes *file, size_t place, size_t limit)
{
    if (place >= limit) {
        return 0;
    }
    const char type = (char)file->bytes[place++];
    const size_t left = limit - place;
    const bool is_array = strchr("fdlicb", type) != NULL && type != 0, is_long = type == 'S' || type == 'R';
    uint64_t size = type == 'C' || type == 'B'   ? 1
                    : type == 'Y'                ? 2
                    : type == 'I' || type == 'F' ? 4
                    : type == 'D' || type == 'L' ? 8
                    : is_long && left >= 4       ? 4 + scene_fbx_number(file->bytes + place, 4)
                    : is_array && left >= 12     ? 12 + scene_fbx_number(file->bytes + place + 8, 4)
                                                 : UINT64_MAX;
    return size > left ? 0 : place + (size_t)size;
}

size_t scene_fbx_string_at(const struct scene_fbx_bytes *file, size_t place, size_t limit, size_t *length)
{
    if (scene_fbx_value_end(file, place, limit) == 0 || file->bytes[place] != 'S') {
        return 0;
    }
    *length = (size_t)scene_fbx_number(file->bytes + place + 1, 4);
    return place + 5;
}
