// SPDX-License-Identifier: MIT
// EXT_meshopt_compression: buffer views as meshoptimizer's codecs wrote them. The library undoes the codecs, which are
// about integers. The filters after them are about numbers, so they are computed here, equally on every machine.
#include <string.h>

#include <meshoptimizer.h>

#include "gltf.h"

enum mode { MODE_ATTRIBUTES, MODE_TRIANGLES, MODE_INDICES };

enum filter { FILTER_NONE, FILTER_OCTAHEDRAL, FILTER_QUATERNION, FILTER_EXPONENTIAL };

struct compressed {
    const unsigned char *bytes;
    size_t size, count, stride;
    enum mode mode;
    enum filter filter;
};

// Return the number of a name in a list. Fail the import if the name is not in it.
static int choose(struct scene_gltf *gltf, const char *what, const char *name, const char *const *names,
                  int count)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(name, names[i]) == 0) {
            return i;
        }
    }
    scene_import_fail(gltf->import, "%s: \"%s\" is no mode or filter of EXT_meshopt_compression", what, name);
}

// Return true if the extension allows this stride and count with this mode and filter.
static bool is_valid(const struct compressed *c)
{
    const bool fits[] = {
        [FILTER_NONE] = true,
        [FILTER_OCTAHEDRAL] = c->stride == 4 || c->stride == 8,
        [FILTER_QUATERNION] = c->stride == 8,
        [FILTER_EXPONENTIAL] = c->stride % 4 == 0,
    };
    if (c->mode == MODE_ATTRIBUTES) {
        return c->stride % 4 == 0 && c->stride >= 4 && c->stride <= 256 && fits[c->filter];
    }
    return (c->stride == 2 || c->stride == 4) && c->filter == FILTER_NONE &&
           (c->mode != MODE_TRIANGLES || c->count % 3 == 0);
}

static struct compressed open_view(struct scene_gltf *gltf, const json_t *extension, const char *what)
{
    static const char *const modes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
    static const char *const filters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    struct compressed compressed = {.size = 0};
    const char *mode = scene_gltf_text(gltf, extension, "mode");
    const char *filter = scene_gltf_text(gltf, extension, "filter");
    const int64_t count = scene_gltf_integer(gltf, extension, "count", 0);
    const int64_t stride = scene_gltf_integer(gltf, extension, "byteStride", 0);
    compressed.bytes = scene_gltf_range(gltf, extension, what, &compressed.size);
    compressed.mode = (enum mode)choose(gltf, what, mode == NULL ? "" : mode, modes, 3);
    compressed.filter = (enum filter)choose(gltf, what, filter == NULL ? "NONE" : filter, filters, 4);
    compressed.count = (size_t)count;
    compressed.stride = stride <= 256 ? (size_t)stride : 0;
    // A byte of a vertex takes at least 2 bits for 16 vertices, an index takes at least a third of a byte.
    if (count < 1 || count > UINT32_MAX || !is_valid(&compressed) ||
        (uint64_t)count * compressed.stride > ((uint64_t)compressed.size + 64) * 64) {
        scene_import_fail(gltf->import, "%s: its meshopt count, stride, mode and filter do not go together",
                          what);
    }
    return compressed;
}

// Filters -------------------------------------------------------------------------------------------

static int nearest(float value)
{
    return (int)(value + (value >= 0 ? 0.5f : -0.5f));
}

static int read_signed(const unsigned char *bytes, size_t size)
{
    int16_t word;
    if (size == 1) {
        return (int8_t)bytes[0];
    }
    memcpy(&word, bytes, sizeof word);
    return word;
}

static void write_signed(unsigned char *bytes, size_t size, int value)
{
    const int16_t word = (int16_t)value;
    memcpy(bytes, &word, size); // the host is little endian, so the low byte comes first
}

// Make a unit vector of one that is folded onto an octahedron: x, y, what stands for 1, and a component that stays.
static void unfold(unsigned char *element, size_t size)
{
    const float scale = size == 1 ? 127 : 32767;
    const int one = read_signed(element + 2 * size, size);
    const float unit = one != 0 ? (float)one : 1;
    float v[3] = {(float)read_signed(element, size) / unit, (float)read_signed(element + size, size) / unit,
                  0};
    v[2] = 1 - __builtin_fabsf(v[0]) - __builtin_fabsf(v[1]);
    const float below = v[2] < 0 ? v[2] : 0;
    v[0] += v[0] >= 0 ? below : -below;
    v[1] += v[1] >= 0 ? below : -below;
    const float length = __builtin_sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (size_t c = 0; c < 3; c++) {
        write_signed(element + c * size, size, length > 0 ? nearest(v[c] / length * scale) : 0);
    }
}

// Make a quaternion of one without its largest component, which the others tell. The range of the others is ±1/√2. The
// fourth number is what stands for 1, with the place of the largest component in its low bits.
static void complete(unsigned char *element)
{
    int16_t words[4], out[4];
    memcpy(words, element, sizeof words);
    const float scale = 0.70710678f / (float)(words[3] | 3);
    const int largest = words[3] & 3;
    float v[3], square = 1;
    for (int c = 0; c < 3; c++) {
        v[c] = (float)words[c] * scale;
        square -= v[c] * v[c];
    }
    for (int c = 0; c < 3; c++) {
        out[(largest + 1 + c) & 3] = (int16_t)nearest(v[c] * 32767);
    }
    out[largest] = (int16_t)nearest(__builtin_sqrtf(square > 0 ? square : 0) * 32767);
    memcpy(element, out, sizeof out);
}

// Make a float of 2^e·m, with 8 bits of e above 24 of m, both signed.
static void expand(unsigned char *element)
{
    uint32_t word, bits;
    memcpy(&word, element, sizeof word);
    const int exponent = (int8_t)(word >> 24);
    const int mantissa = (int32_t)(word << 8) / 256;
    // The bits are those of 2^e. 2^−128 and 2^−127 are no normal floats.
    bits = (uint32_t)(exponent + 127) << 23;
    float power;
    memcpy(&power, &bits, sizeof power);
    const float value = exponent > -127 ? power * (float)mantissa : 0;
    memcpy(element, &value, sizeof value);
}

static void apply_filter(const struct compressed *compressed, unsigned char *elements)
{
    const size_t size = compressed->count * compressed->stride;
    switch (compressed->filter) {
    case FILTER_OCTAHEDRAL:
        for (size_t at = 0; at < size; at += compressed->stride) {
            unfold(elements + at, compressed->stride / 4);
        }
        break;
    case FILTER_QUATERNION:
        for (size_t at = 0; at < size; at += compressed->stride) {
            complete(elements + at);
        }
        break;
    case FILTER_EXPONENTIAL:
        for (size_t at = 0; at < size; at += 4) {
            expand(elements + at);
        }
        break;
    default: break;
    }
}

// Entry ---------------------------------------------------------------------------------------------

static int undo(const struct compressed *c, unsigned char *elements)
{
    switch (c->mode) {
    case MODE_TRIANGLES: return meshopt_decodeIndexBuffer(elements, c->count, c->stride, c->bytes, c->size);
    case MODE_INDICES: return meshopt_decodeIndexSequence(elements, c->count, c->stride, c->bytes, c->size);
    default: return meshopt_decodeVertexBuffer(elements, c->count, c->stride, c->bytes, c->size);
    }
}

struct scene_gltf_decoded scene_gltf_meshopt(struct scene_gltf *gltf, int64_t view, const json_t *extension)
{
    char what[40];
    snprintf(what, sizeof what, "bufferViews[%lld]", (long long)view);
    const struct compressed compressed = open_view(gltf, extension, what);
    unsigned char *elements = scene_import_allocate(gltf->import, compressed.count, compressed.stride);
    if (undo(&compressed, elements) != 0) {
        scene_import_fail(gltf->import, "%s: its meshopt data is damaged", what);
    }
    apply_filter(&compressed, elements);
    const size_t stride = compressed.mode == MODE_ATTRIBUTES ? compressed.stride : 0;
    return (struct scene_gltf_decoded){
        .bytes = elements, .size = compressed.count * compressed.stride, .stride = stride};
}
