// SPDX-License-Identifier: MIT
// The bytes of buffers (§3.6.1), from the file itself, from other files, and from data URIs.
#include "gltf.h"

#include "import/builder/data_uri.h"
#include "import/builder/find_file.h"

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
    } else if (scene_data_uri_is(uri)) {
        buffer->bytes = scene_data_uri_decode(import, uri, &buffer->size);
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
