// SPDX-License-Identifier: MIT
// The container (KTX 2.0): a header, an index of levels, a descriptor that names formats which Vulkan has not, pairs of
// keys and values, and the global data of BasisLZ. Everything is little endian and lies where the file says, so every
// place is checked before it is read. KTXorientation does not move texels: it says how the image was meant to be looked
// at.
#include "ktx2.h"

#include <stdlib.h>
#include <string.h>
#include <zstd.h>

#include "etc1s.h"
#include "uastc.h"
#include "vulkan_format.h"

enum { IDENTIFIER = 12, HEADER = 80, LEVEL = 24, GLOBAL_HEADER = 20, SLICES = 20, DESCRIPTOR = 44 };
enum { SCHEME_NONE, SCHEME_BASIS_LZ, SCHEME_ZSTANDARD };
enum { MODEL_ETC1S = 163, MODEL_UASTC = 166 };
enum { MOST_LEVELS = 32, PREDICTED_FRAME = 2 };

static const char damaged[] = "damaged KTX2";

struct ktx2 {
    struct scene_span file;
    uint32_t format; // VkFormat; 0 for the format that the descriptor says
    uint32_t width, height, levels, scheme;
    struct scene_span level; // bytes of the first level
    uint64_t level_bytes;    // bytes of the first level, unpacked
    struct scene_span descriptor, pairs, global;
    // The descriptor's model, its number of samples, and the channels that its first two samples hold.
    uint32_t model, samples, channel[2];
};

// Reading ------------------------------------------------------------------------------------------------

static uint32_t read_32(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static uint64_t read_64(const uint8_t *bytes)
{
    return read_32(bytes) | (uint64_t)read_32(bytes + 4) << 32;
}

// Cut a part out of a whole. Return false if it is not within the whole.
static bool cut(struct scene_span whole, uint64_t offset, uint64_t size, struct scene_span *part)
{
    if (offset > whole.size || size > whole.size - offset) {
        return false;
    }
    *part = (struct scene_span){whole.bytes + offset, (size_t)size};
    return true;
}

bool scene_ktx2_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    if (size < HEADER) {
        return false;
    }
    *width = read_32(bytes + IDENTIFIER + 8);
    *height = read_32(bytes + IDENTIFIER + 12);
    return true;
}

// Read the descriptor. Only its first block counts. Samples of 16 bytes stand behind 28 bytes that say what they have
// in common.
static bool read_descriptor(struct ktx2 *ktx2)
{
    const struct scene_span descriptor = ktx2->descriptor;
    if (descriptor.size < DESCRIPTOR) {
        return false;
    }
    const uint32_t block = read_32(descriptor.bytes + 8) >> 16;
    if (block < DESCRIPTOR - 4 || block > descriptor.size - 4) {
        return false;
    }
    ktx2->model = descriptor.bytes[12];
    ktx2->samples = (block - 24) / 16;
    for (uint32_t i = 0; i < ktx2->samples && i < 2; i++) {
        ktx2->channel[i] = descriptor.bytes[28 + 16 * i + 3] & 15;
    }
    return true;
}

static const char *open_file(struct scene_span file, struct ktx2 *ktx2)
{
    if (file.size < HEADER + LEVEL) {
        return damaged;
    }
    const uint8_t *const header = file.bytes + IDENTIFIER;
    *ktx2 = (struct ktx2){.file = file,
                          .format = read_32(header),
                          .width = read_32(header + 8),
                          .height = read_32(header + 12),
                          .levels = read_32(header + 28),
                          .scheme = read_32(header + 32)};
    const uint32_t depth = read_32(header + 16), layers = read_32(header + 20), faces = read_32(header + 24);
    if (depth > 0 || layers > 1 || faces != 1) {
        return "a KTX2 file of several layers, faces or slices";
    }
    const uint8_t *const index = file.bytes + 48, *const level = file.bytes + HEADER;
    const bool inside = ktx2->levels <= MOST_LEVELS &&
                        cut(file, read_64(level), read_64(level + 8), &ktx2->level) &&
                        cut(file, read_32(index), read_32(index + 4), &ktx2->descriptor) &&
                        cut(file, read_32(index + 8), read_32(index + 12), &ktx2->pairs) &&
                        cut(file, read_64(index + 16), read_64(index + 24), &ktx2->global);
    ktx2->level_bytes = read_64(level + 16);
    return inside && read_descriptor(ktx2) ? NULL : damaged;
}

// Texels -------------------------------------------------------------------------------------------------

static const char *make_rgba8(struct scene_image *image)
{
    image->type = SCENE_IMAGE_RGBA8;
    image->size = (size_t)image->width * image->height * 4;
    image->texels = malloc(image->size);
    return image->texels != NULL ? NULL : "outofmem";
}

static const char *decode_uastc(const uint8_t *blocks, struct scene_image *image)
{
    const char *const problem = make_rgba8(image);
    if (problem != NULL) {
        return problem;
    }
    uint8_t(*const texels)[4] = image->texels;
    for (uint32_t y = 0; y < image->height; y += 4) {
        for (uint32_t x = 0; x < image->width; x += 4) {
            uint8_t block[16][4];
            scene_uastc_decode(blocks, block);
            blocks += SCENE_UASTC_BLOCK;
            const size_t columns = image->width - x < 4 ? image->width - x : 4;
            for (uint32_t row = 0; row < 4 && row < image->height - y; row++) {
                memcpy(texels[(size_t)(y + row) * image->width + x], block[4 * row], 4 * columns);
            }
        }
    }
    return NULL;
}

// Decode from the global data. It says where in the level the slices of the first image are: colours, and the colours
// of a second channel.
static const char *decode_etc1s(const struct ktx2 *ktx2, struct scene_image *image)
{
    const struct scene_span global = ktx2->global;
    struct scene_span colors = {NULL, 0}, second = {NULL, 0}, part[3];
    if (ktx2->scheme != SCHEME_BASIS_LZ || global.size < GLOBAL_HEADER + SLICES) {
        return damaged;
    }
    const uint8_t *const slices = global.bytes + GLOBAL_HEADER;
    const uint32_t endpoints = read_32(global.bytes) & 0xffff, selectors = read_32(global.bytes) >> 16;
    uint64_t at = GLOBAL_HEADER + (uint64_t)SLICES * (ktx2->levels > 0 ? ktx2->levels : 1);
    bool inside = endpoints > 0 && selectors > 0 && (read_32(slices) & PREDICTED_FRAME) == 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t size = read_32(global.bytes + 4 + 4 * i);
        inside = inside && cut(global, at, size, &part[i]);
        at += size;
    }
    if (!inside || !cut(ktx2->level, read_32(slices + 4), read_32(slices + 8), &colors) ||
        !cut(ktx2->level, read_32(slices + 12), read_32(slices + 16), &second)) {
        return damaged;
    }
    struct scene_etc1s *codebooks;
    const char *problem = scene_etc1s_open(endpoints, selectors, part[0], part[1], part[2], &codebooks);
    if (problem == NULL) {
        problem = make_rgba8(image);
    }
    if (problem == NULL) {
        problem = scene_etc1s_decode(codebooks, colors, image->width, image->height, false, image->texels);
    }
    if (problem == NULL && second.size > 0) {
        problem = scene_etc1s_decode(codebooks, second, image->width, image->height, true, image->texels);
    }
    scene_etc1s_free(codebooks);
    return problem;
}

// Decode the first level, which has as many bytes as its texels take.
static const char *decode_level(const struct ktx2 *ktx2, const uint8_t *bytes, struct scene_image *image)
{
    return ktx2->format != 0 ? scene_vulkan_decode(ktx2->format, bytes, image) : decode_uastc(bytes, image);
}

static const char *unpack_level(const struct ktx2 *ktx2, size_t size, struct scene_image *image)
{
    if (ktx2->scheme == SCHEME_NONE) {
        return ktx2->level.size < size ? damaged : decode_level(ktx2, ktx2->level.bytes, image);
    }
    uint8_t *const bytes = ktx2->level_bytes == size ? malloc(size) : NULL;
    if (bytes == NULL) {
        return ktx2->level_bytes == size ? "outofmem" : damaged;
    }
    const bool whole = ZSTD_decompress(bytes, size, ktx2->level.bytes, ktx2->level.size) == size;
    const char *const problem = whole ? decode_level(ktx2, bytes, image) : damaged;
    free(bytes);
    return problem;
}

static const char *decode_first_level(const struct ktx2 *ktx2, struct scene_image *image)
{
    if (ktx2->scheme > SCHEME_ZSTANDARD) {
        return "a KTX2 file whose compression is neither BasisLZ nor Zstandard";
    }
    if (ktx2->format == 0 && ktx2->model == MODEL_ETC1S) {
        return decode_etc1s(ktx2, image);
    }
    size_t size = scene_vulkan_size(ktx2->format, image->width, image->height);
    if (ktx2->format == 0 && ktx2->model == MODEL_UASTC) {
        size = (size_t)((image->width + 3) / 4) * ((image->height + 3) / 4) * SCENE_UASTC_BLOCK;
    }
    if (size == 0) {
        return "a KTX2 file of a format that is not read";
    }
    return ktx2->scheme == SCHEME_BASIS_LZ ? damaged : unpack_level(ktx2, size, image);
}

// Channels -----------------------------------------------------------------------------------------------

// Give each channel of all texels another one's value, 0 or 1, as four characters of "rgba01" say.
static void swizzle(struct scene_image *image, const char *channels)
{
    static const uint8_t zero[4];
    static const uint8_t byte_one = UINT8_MAX;
    static const uint16_t short_one = UINT16_MAX;
    static const float float_one = 1;
    const size_t bytes = image->type == SCENE_IMAGE_RGBA8 ? 1 : image->type == SCENE_IMAGE_RGBA16 ? 2 : 4;
    const void *const one = bytes == 1   ? (const void *)&byte_one
                            : bytes == 2 ? (const void *)&short_one
                                         : &float_one;
    uint8_t *texel = image->texels;
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        uint8_t before[16];
        memcpy(before, texel, 4 * bytes);
        for (int c = 0; c < 4; c++) {
            const char *const from = strchr("rgba", channels[c]);
            const void *const constant = channels[c] == '1' ? one : zero;
            memcpy(texel, from != NULL ? before + bytes * (size_t)(from - "rgba") : constant, bytes);
            texel += bytes;
        }
    }
}

// Return how the channels are to be moved. Basis Universal moves the channels of images that have only one or two of
// them, which compresses better.
static const char *basis_channels(const struct ktx2 *ktx2)
{
    enum { UASTC_RRRG = 5, UASTC_RG = 6, ETC1S_GGG = 4 };
    const bool etc1s = ktx2->model == MODEL_ETC1S;
    if (ktx2->format != 0) {
        return NULL;
    }
    if (etc1s ? ktx2->samples > 1 && ktx2->channel[1] == ETC1S_GGG : ktx2->channel[0] == UASTC_RRRG) {
        return "ra01";
    }
    return !etc1s && ktx2->channel[0] == UASTC_RG ? "rg01" : NULL;
}

// Return the value of KTXswizzle. Return NULL if there is none.
static const char *find_swizzle(struct scene_span pairs)
{
    static const char key[] = "KTXswizzle";
    enum { VALUE = sizeof key, LENGTH = VALUE + 4 };
    for (size_t at = 0; pairs.size - at >= 4;) {
        const size_t length = read_32(pairs.bytes + at);
        const char *const pair = (const char *)pairs.bytes + at + 4;
        if (length > pairs.size - at - 4) {
            return NULL;
        }
        if (length >= LENGTH && memcmp(pair, key, sizeof key) == 0) {
            bool legal = true;
            for (int i = 0; i < 4; i++) {
                legal = legal && pair[VALUE + i] != 0 && strchr("rgba01", pair[VALUE + i]) != NULL;
            }
            return legal ? pair + VALUE : NULL;
        }
        const size_t padded = (length + 3) / 4 * 4;
        at = padded > pairs.size - at - 4 ? pairs.size : at + 4 + padded;
    }
    return NULL;
}

const char *scene_image_decode_ktx2(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct ktx2 ktx2;
    const char *problem = open_file((struct scene_span){bytes, size}, &ktx2);
    if (problem != NULL) {
        return problem;
    }
    struct scene_image made = *image;
    made.width = ktx2.width;
    made.height = ktx2.height;
    made.texels = NULL;
    problem = decode_first_level(&ktx2, &made);
    if (problem != NULL) {
        free(made.texels);
        return problem;
    }
    const char *const moved = basis_channels(&ktx2), *const wanted = find_swizzle(ktx2.pairs);
    if (moved != NULL) {
        swizzle(&made, moved);
    }
    if (wanted != NULL && memcmp(wanted, "rgba", 4) != 0) {
        swizzle(&made, wanted);
    }
    *image = made;
    return NULL;
}
