// SPDX-License-Identifier: MIT
// The bytes of buffers (§3.6.1), from the file itself, from other files, and from data URIs.
#include "gltf.h"

#include <string.h>

#include "import/builder/find_file.h"

static int base64_digit(int c)
{
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+' || c == '-' ? 62
           : c == '/' || c == '_' ? 63
                                  : -1;
}

unsigned char *scene_gltf_data_uri(struct scene_gltf *gltf, const char *uri, size_t *size)
{
    const char *comma = strchr(uri, ',');
    if (comma == NULL || comma - uri < 7 || memcmp(comma - 7, ";base64", 7) != 0) {
        return NULL;
    }
    const char *digits = comma + 1;
    unsigned char *bytes = scene_import_allocate(gltf->import, strlen(digits) / 4 * 3 + 3, 1);
    uint32_t bits = 0;
    int held = 0;
    *size = 0;
    for (; *digits != 0 && *digits != '='; digits++) {
        const int digit = base64_digit((unsigned char)*digits);
        if (digit < 0) {
            return NULL;
        }
        bits = bits << 6 | (uint32_t)digit;
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes[(*size)++] = (unsigned char)(bits >> held);
        }
    }
    return bytes;
}

static void load_buffer(struct scene_gltf *gltf, int64_t index, struct scene_gltf_buffer *buffer)
{
    struct scene_import *import = gltf->import;
    const json_t *object = scene_gltf_item(gltf, "buffers", index);
    const int64_t length = scene_gltf_integer(gltf, object, "byteLength", -1);
    const char *uri = scene_gltf_text(gltf, object, "uri");
    const int number = (int)index;
    if (length < 0) {
        scene_import_fail(import, "buffers[%d] has no byteLength", number);
    }
    if (uri == NULL) {
        if (index != 0 || gltf->binary == NULL) {
            scene_import_fail(import, "buffers[%d] has neither a URI nor a binary chunk", number);
        }
        buffer->bytes = gltf->binary;
        buffer->size = gltf->binary_size;
    } else if (strncmp(uri, "data:", 5) == 0) {
        buffer->bytes = scene_gltf_data_uri(gltf, uri, &buffer->size);
        if (buffer->bytes == NULL) {
            scene_import_fail(import, "buffers[%d]: its data URI is not valid base64", number);
        }
    } else {
        const char *path = scene_import_find_file(import, uri);
        const char *problem = import->missing;
        if (path != NULL) {
            buffer->bytes = scene_import_read_file(import, path, &buffer->size, &problem);
        }
        if (buffer->bytes == NULL) {
            scene_import_fail(import, "buffers[%d]: \"%.200s\": %s", number, uri, problem);
        }
    }
    if (buffer->size < (uint64_t)length) {
        scene_import_fail(import, "buffers[%d] should have %lld bytes but has %zu", number, (long long)length,
                          buffer->size);
    }
    buffer->size = (size_t)length;
}

const unsigned char *scene_gltf_range(struct scene_gltf *gltf, const json_t *object, const char *what,
                                      size_t *size)
{
    const int64_t number = scene_gltf_integer(gltf, object, "buffer", -1);
    const int64_t offset = scene_gltf_integer(gltf, object, "byteOffset", 0);
    const int64_t length = scene_gltf_integer(gltf, object, "byteLength", -1);
    scene_gltf_item(gltf, "buffers", number);
    struct scene_gltf_buffer *buffer = &gltf->buffers[number];
    if (buffer->bytes == NULL) {
        load_buffer(gltf, number, buffer);
    }
    if (length < 0) {
        scene_import_fail(gltf->import, "%s has no byteLength", what);
    }
    if ((uint64_t)offset > buffer->size || (uint64_t)length > buffer->size - (uint64_t)offset) {
        scene_import_fail(gltf->import, "%s reaches past the end of its buffer", what);
    }
    *size = (size_t)length;
    return buffer->bytes + offset;
}
