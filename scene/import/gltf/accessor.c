// SPDX-License-Identifier: MIT
// Buffer views and accessors (§3.6): bytes of a glTF become floats and integers. Every range is checked here against
// the bytes that are really there. The host is little endian, as glTF is.
#include <stdlib.h>
#include <string.h>

#include "gltf.h"

enum {
    TYPE_INT8 = 5120,
    TYPE_UINT8 = 5121,
    TYPE_INT16 = 5122,
    TYPE_UINT16 = 5123,
    TYPE_UINT32 = 5125,
    TYPE_FLOAT = 5126
};

// Limits of the number of elements. An accessor without data is all zeros and costs its file nothing; a larger one than
// most_without_data is an attack.
static const int64_t most_without_data = 1 << 24;
static const int64_t most_elements = UINT32_MAX - 1;

struct accessor {
    int64_t index;
    const unsigned char *bytes; // NULL if all elements are zeros
    size_t stride;
    uint32_t count;
    int type, components;
    bool normalized;
    const json_t *sparse; // NULL if no elements are replaced
};

// Views -------------------------------------------------------------------------------------------

// Find EXT_meshopt_compression, or what became of it at Khronos under equal terms.
static const json_t *find_compression(struct scene_gltf *gltf, const json_t *view)
{
    const json_t *extension = scene_gltf_extension(gltf, view, "EXT_meshopt_compression");
    return extension != NULL ? extension : scene_gltf_extension(gltf, view, "KHR_meshopt_compression");
}

const unsigned char *scene_gltf_view(struct scene_gltf *gltf, int64_t index, size_t *size, size_t *stride)
{
    const json_t *view = scene_gltf_item(gltf, "bufferViews", index);
    const json_t *compression = find_compression(gltf, view);
    if (compression != NULL) {
        struct scene_gltf_decoded *decoded = &gltf->views[index];
        if (decoded->bytes == NULL) {
            *decoded = scene_gltf_meshopt(gltf, index, compression);
        }
        *size = decoded->size;
        *stride = decoded->stride;
        return decoded->bytes;
    }
    char what[40];
    snprintf(what, sizeof what, "bufferViews[%lld]", (long long)index);
    const int64_t step = scene_gltf_integer(gltf, view, "byteStride", 0);
    if (step > 252) {
        scene_import_fail(gltf->import, "%s: byteStride must be 4 to 252", what);
    }
    *stride = (size_t)step;
    return scene_gltf_range(gltf, view, what, size);
}

// Accessors -----------------------------------------------------------------------------------------

static size_t component_size(int type)
{
    return type == TYPE_INT8 || type == TYPE_UINT8     ? 1
           : type == TYPE_INT16 || type == TYPE_UINT16 ? 2
           : type == TYPE_UINT32 || type == TYPE_FLOAT ? 4
                                                       : 0;
}

static int component_count(const char *name)
{
    static const struct {
        const char *name;
        int components;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    for (size_t i = 0; name != NULL && i < sizeof types / sizeof types[0]; i++) {
        if (strcmp(types[i].name, name) == 0) {
            return types[i].components;
        }
    }
    return 0;
}

// Return `count` elements of `element` bytes in a view, from `offset` on.
static const unsigned char *elements(struct scene_gltf *gltf, const struct accessor *accessor,
                                     const json_t *object, uint32_t count, size_t element, size_t *stride)
{
    size_t size = 0, step = 0;
    const int64_t view = scene_gltf_integer(gltf, object, "bufferView", -1);
    const int64_t offset = scene_gltf_integer(gltf, object, "byteOffset", 0);
    const unsigned char *bytes = scene_gltf_view(gltf, view, &size, &step);
    *stride = step > 0 ? step : element;
    const uint64_t last = (uint64_t)(count - 1) * *stride + element; // `last` is below 2^32·2^8
    if ((uint64_t)offset > size || last > size - (uint64_t)offset) {
        scene_import_fail(gltf->import, "accessors[%lld] reaches past the end of bufferViews[%lld]",
                          (long long)accessor->index, (long long)view);
    }
    return bytes + offset;
}

static struct accessor open_accessor(struct scene_gltf *gltf, int64_t index)
{
    const json_t *object = scene_gltf_item(gltf, "accessors", index);
    struct accessor accessor = {.index = index};
    const long long number = index;
    const int64_t count = scene_gltf_integer(gltf, object, "count", -1);
    const int64_t type = scene_gltf_integer(gltf, object, "componentType", -1);
    const char *shape = scene_gltf_text(gltf, object, "type");
    accessor.components = component_count(shape);
    accessor.type = type > 0 && type <= TYPE_FLOAT ? (int)type : 0;
    accessor.normalized = scene_gltf_flag(gltf, object, "normalized", false);
    accessor.sparse = scene_gltf_object(gltf, object, "sparse");
    const size_t element = component_size(accessor.type) * (size_t)accessor.components;
    if (element == 0) {
        scene_import_fail(gltf->import, "accessors[%lld] has a type or componentType that does not exist",
                          number);
    }
    if (count < 1 || count > most_elements) {
        scene_import_fail(gltf->import, "accessors[%lld]: its count must be 1 to %lld", number,
                          (long long)most_elements);
    }
    accessor.count = (uint32_t)count;
    const struct scene_gltf_decoded *decoded = &gltf->accessors[index];
    if (decoded->bytes != NULL) {
        accessor.bytes = decoded->bytes;
        accessor.stride = decoded->stride;
        accessor.count = decoded->count;
        accessor.type = decoded->type;
        if (component_size(accessor.type) * (size_t)accessor.components != decoded->stride) {
            scene_import_fail(gltf->import, "accessors[%lld] stands for indices and for an attribute",
                              number);
        }
    } else if (json_object_get(object, "bufferView") != NULL) {
        accessor.bytes = elements(gltf, &accessor, object, accessor.count, element, &accessor.stride);
    } else if (count > most_without_data) {
        scene_import_fail(gltf->import, "accessors[%lld] has %lld elements and no data", number,
                          (long long)count);
    }
    return accessor;
}

static float read_component(const unsigned char *bytes, int type, bool normalized)
{
    uint16_t word;
    uint32_t integer;
    float value;
    switch (type) {
    case TYPE_INT8:
        value = (float)(int8_t)bytes[0];
        return !normalized ? value : value < -127 ? -1 : value / 127;
    case TYPE_UINT8: return normalized ? (float)bytes[0] / 255 : (float)bytes[0];
    case TYPE_INT16:
        memcpy(&word, bytes, sizeof word);
        value = (float)(int16_t)word;
        return !normalized ? value : value < -32767 ? -1 : value / 32767;
    case TYPE_UINT16:
        memcpy(&word, bytes, sizeof word);
        return normalized ? (float)word / 65535 : (float)word;
    case TYPE_UINT32: memcpy(&integer, bytes, sizeof integer); return (float)integer;
    default: memcpy(&value, bytes, sizeof value); return value;
    }
}

static uint32_t read_integer(const unsigned char *bytes, int type)
{
    uint16_t word;
    uint32_t integer;
    if (type == TYPE_UINT8) {
        return bytes[0];
    }
    if (type == TYPE_UINT16) {
        memcpy(&word, bytes, sizeof word);
        return word;
    }
    memcpy(&integer, bytes, sizeof integer);
    return integer;
}

static void read_element(const struct accessor *accessor, const unsigned char *bytes, float *values)
{
    const size_t size = component_size(accessor->type);
    for (int c = 0; c < accessor->components; c++) {
        values[c] = read_component(bytes + (size_t)c * size, accessor->type, accessor->normalized);
    }
}

// Replace the elements that a sparse accessor lists (§3.6.2.3).
static void apply_sparse(struct scene_gltf *gltf, const struct accessor *accessor, float *values, int width)
{
    const json_t *sparse = accessor->sparse;
    const int64_t count = scene_gltf_integer(gltf, sparse, "count", -1);
    const json_t *places = scene_gltf_object(gltf, sparse, "indices");
    const json_t *contents = scene_gltf_object(gltf, sparse, "values");
    const long long number = accessor->index;
    if (count < 1 || count > accessor->count || places == NULL || contents == NULL) {
        scene_import_fail(gltf->import, "accessors[%lld]: its sparse part is not valid", number);
    }
    const int64_t type = scene_gltf_integer(gltf, places, "componentType", -1);
    if (type != TYPE_UINT8 && type != TYPE_UINT16 && type != TYPE_UINT32) {
        scene_import_fail(gltf->import, "accessors[%lld]: sparse indices must be unsigned integers", number);
    }
    const size_t element = component_size(accessor->type) * (size_t)accessor->components;
    size_t place_stride = 0, content_stride = 0;
    const unsigned char *place =
        elements(gltf, accessor, places, (uint32_t)count, component_size((int)type), &place_stride);
    const unsigned char *content =
        elements(gltf, accessor, contents, (uint32_t)count, element, &content_stride);
    for (int64_t i = 0; i < count; i++) {
        const uint32_t target = read_integer(place, (int)type);
        if (target >= accessor->count) {
            scene_import_fail(gltf->import, "accessors[%lld]: sparse index %u is outside its %u elements",
                              number, target, accessor->count);
        }
        read_element(accessor, content, values + (size_t)target * (size_t)width);
        place += place_stride;
        content += content_stride;
    }
}

float *scene_gltf_read_floats(struct scene_gltf *gltf, int64_t index, int least, int width, uint32_t *count)
{
    const struct accessor accessor = open_accessor(gltf, index);
    if (accessor.components < least || accessor.components > width) {
        scene_import_fail(gltf->import, "accessors[%lld] has %d components where %d are needed",
                          (long long)index, accessor.components, width);
    }
    float *values = scene_import_allocate(gltf->import, accessor.count, (size_t)width * sizeof *values);
    const unsigned char *bytes = accessor.bytes;
    for (uint32_t i = 0; i < accessor.count; i++) {
        float *element = values + (size_t)i * (size_t)width;
        for (int c = accessor.components; c < width; c++) {
            element[c] = 1;
        }
        if (bytes == NULL) {
            continue;
        }
        if (accessor.type == TYPE_FLOAT) {
            memcpy(element, bytes, (size_t)accessor.components * sizeof *element);
        } else {
            read_element(&accessor, bytes, element);
        }
        bytes += accessor.stride;
    }
    if (accessor.sparse != NULL) {
        apply_sparse(gltf, &accessor, values, width);
    }
    *count = accessor.count;
    return values;
}

uint32_t *scene_gltf_read_integers(struct scene_gltf *gltf, int64_t index, int width, uint32_t *count)
{
    const struct accessor accessor = open_accessor(gltf, index);
    const bool is_unsigned =
        accessor.type == TYPE_UINT8 || accessor.type == TYPE_UINT16 || accessor.type == TYPE_UINT32;
    if (accessor.components != width || !is_unsigned || accessor.sparse != NULL) {
        scene_import_fail(gltf->import, "accessors[%lld] must hold %d unsigned integer%s per element",
                          (long long)index, width, width == 1 ? "" : "s");
    }
    const size_t size = component_size(accessor.type);
    uint32_t *values = scene_import_allocate(gltf->import, accessor.count, (size_t)width * sizeof *values);
    for (uint32_t i = 0; i < accessor.count && accessor.bytes != NULL; i++) {
        for (int c = 0; c < width; c++) {
            values[(size_t)i * (size_t)width + (size_t)c] =
                read_integer(accessor.bytes + (size_t)i * accessor.stride + (size_t)c * size, accessor.type);
        }
    }
    *count = accessor.count;
    return values;
}
