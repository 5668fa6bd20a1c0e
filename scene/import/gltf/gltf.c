// SPDX-License-Identifier: MIT
// glTF 2.0: the container (JSON or GLB), the version and the variants.
#include "gltf.h"

#include "import/builder/readers.h"
#include "import/builder/text_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { GLB_MAGIC = 0x46546c67, GLB_JSON = 0x4e4f534a, GLB_BIN = 0x004e4942, GLB_HEADER = 12, GLB_CHUNK = 8 };

// Container -----------------------------------------------------------------------------------------

bool scene_import_is_gltf(const char *path, const unsigned char *start, size_t size)
{
    if (size >= 4 && memcmp(start, "glTF", 4) == 0) {
        return true;
    }
    const char *dot = strrchr(path, '.');
    return dot != NULL &&
           (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0 || strcasecmp(dot, ".vrm") == 0);
}

static uint32_t little_endian(const unsigned char *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static void parse_json(struct scene_gltf *gltf, const unsigned char *text, size_t size)
{
    json_error_t error;
    const size_t marks = scene_text_marks(text, size);
    text += marks;
    size -= marks;
    // Some files have zeros where the padding should be spaces.
    while (size > 0 && text[size - 1] == 0) {
        size--;
    }
    gltf->root = json_loadb((const char *)text, size, JSON_ALLOW_NUL, &error);
    if (gltf->root == NULL) {
        scene_import_fail(gltf->import, "is not valid JSON: line %d: %s", error.line, error.text);
    }
    if (!json_is_object(gltf->root)) {
        scene_import_fail(gltf->import, "is no glTF: its JSON is not an object");
    }
}

static bool is_binary_chunk(const unsigned char *bytes, size_t size, size_t at)
{
    return at <= size && size - at >= GLB_CHUNK && little_endian(bytes + at + 4) == GLB_BIN;
}

// Parse a GLB: a header of 12 bytes, a JSON chunk, and an optional BIN chunk (§4.4).
static void parse_binary(struct scene_gltf *gltf, const unsigned char *bytes, size_t size)
{
    if (size < GLB_HEADER + GLB_CHUNK) {
        scene_import_fail(gltf->import, "is truncated: a GLB of %zu bytes", size);
    }
    const uint32_t version = little_endian(bytes + 4), length = little_endian(bytes + 8);
    if (version != 2) {
        scene_import_fail(gltf->import, "is glTF %u.0, which is not supported; only 2.0 is", version);
    }
    if (length > size) {
        scene_import_fail(gltf->import, "is truncated: its header says %u bytes, it has %zu", length, size);
    }
    const size_t json_size = little_endian(bytes + GLB_HEADER);
    const size_t json_start = GLB_HEADER + GLB_CHUNK;
    if (little_endian(bytes + GLB_HEADER + 4) != GLB_JSON) {
        scene_import_fail(gltf->import, "the first chunk of the GLB is not JSON");
    }
    if (json_size > size - json_start) {
        scene_import_fail(gltf->import, "the JSON chunk of the GLB is longer than the file");
    }
    parse_json(gltf, bytes + json_start, json_size);
    size_t next = json_start + json_size;
    if (json_size % 4 != 0) {
        scene_import_warn(gltf->import, "the JSON chunk of the GLB has %zu bytes, which is no multiple of 4",
                          json_size);
        next = is_binary_chunk(bytes, size, next) ? next : json_start + (json_size + 3) / 4 * 4;
    }
    if (!is_binary_chunk(bytes, size, next)) {
        return;
    }
    const size_t binary_size = little_endian(bytes + next);
    if (binary_size > size - next - GLB_CHUNK) {
        scene_import_fail(gltf->import, "the binary chunk of the GLB is longer than the file");
    }
    gltf->binary = bytes + next + GLB_CHUNK;
    gltf->binary_size = binary_size;
}

static void check_version(struct scene_gltf *gltf)
{
    const json_t *asset = scene_gltf_object(gltf, gltf->root, "asset");
    const json_t *number = json_object_get(asset, "version"); // glTF 1.0 allowed a number
    if (json_is_number(number) && json_number_value(number) == 2) {
        scene_import_warn(
            gltf->import,
            "asset.version is the number 2; it must be the string \"2.0\", as which it is read");
        return;
    }
    if (json_is_number(number)) {
        scene_import_fail(gltf->import, "is glTF %.1f, which is not supported; only 2.0 is",
                          json_number_value(number));
    }
    const char *version = asset == NULL ? NULL : scene_gltf_text(gltf, asset, "version");
    const char *least = asset == NULL ? NULL : scene_gltf_text(gltf, asset, "minVersion");
    if (version == NULL || version[0] == 0) {
        scene_import_fail(gltf->import, "is no glTF 2.0: it has no asset version");
    }
    if (strncmp(version, "2.", 2) != 0) {
        scene_import_fail(gltf->import, "is glTF %s, which is not supported; only 2.0 is", version);
    }
    if (least != NULL && strcmp(least, "2.0") != 0) {
        scene_import_fail(gltf->import, "asks for at least glTF %s; 2.0 is supported", least);
    }
}

// Read the names of the variants (KHR_materials_variants) for the model, and find the number of the variant that is
// wanted.
static void read_variants(struct scene_gltf *gltf)
{
    struct scene_import *import = gltf->import;
    const json_t *extension = scene_gltf_extension(gltf, gltf->root, "KHR_materials_variants");
    const json_t *list = scene_gltf_array(gltf, extension, "variants");
    const size_t count = json_array_size(list);
    char names[256] = "";
    size_t i;
    json_t *variant;
    import->model.variants = scene_import_allocate(import, count, sizeof *import->model.variants);
    import->model.variant_count = (uint32_t)count;
    gltf->variant = -1;
    json_array_foreach(list, i, variant)
    {
        const char *name = scene_gltf_name(gltf, variant);
        import->model.variants[i] = name;
        if (import->variant != NULL && gltf->variant < 0 && strcmp(name, import->variant) == 0) {
            gltf->variant = (int64_t)i;
        }
        const size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, "%s'%s'", i > 0 ? ", " : "", name);
    }
    if (import->variant != NULL && gltf->variant < 0 && count > 0) {
        scene_import_fail(import, "has no variant '%s'; it has %s", import->variant, names);
    }
}

static int32_t *none_made(struct scene_gltf *gltf, const char *list)
{
    const size_t count = scene_gltf_count(gltf, list);
    int32_t *indices = scene_import_allocate(gltf->import, count, sizeof *indices);
    for (size_t i = 0; i < count; i++) {
        indices[i] = -1;
    }
    return indices;
}

void scene_import_gltf(struct scene_import *import)
{
    struct scene_gltf gltf = {.import = import, .default_material = -1};
    const char *problem = NULL;
    size_t size = 0;
    const unsigned char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes == NULL) {
        scene_import_fail(import, "cannot be read: %s", problem);
    }
    if (size >= 4 && little_endian(bytes) == GLB_MAGIC) {
        parse_binary(&gltf, bytes, size);
    } else {
        parse_json(&gltf, bytes, size);
    }
    check_version(&gltf);
    scene_gltf_check_extensions(&gltf);
    scene_gltf_tell_misspelt(&gltf);
    import->model.format = "glTF 2.0";
    import->model.unit = "metre"; // glTF's unit of length (§3.4)
    gltf.buffers = scene_import_allocate(import, scene_gltf_count(&gltf, "buffers"), sizeof *gltf.buffers);
    gltf.views = scene_import_allocate(import, scene_gltf_count(&gltf, "bufferViews"), sizeof *gltf.views);
    gltf.accessors =
        scene_import_allocate(import, scene_gltf_count(&gltf, "accessors"), sizeof *gltf.accessors);
    gltf.nodes = scene_import_allocate(import, scene_gltf_count(&gltf, "nodes"), sizeof *gltf.nodes);
    gltf.meshes = scene_import_allocate(import, scene_gltf_count(&gltf, "meshes"), sizeof *gltf.meshes);
    gltf.materials = none_made(&gltf, "materials");
    gltf.images = none_made(&gltf, "images");
    read_variants(&gltf);
    scene_gltf_animate(&gltf);
    scene_gltf_scene(&gltf);
}
