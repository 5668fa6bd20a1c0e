// SPDX-License-Identifier: MIT
// A PNM is a header in text, of a width, a height and the largest sample, and the samples, row by row from the top.
// stb_image 2.27 reads beyond samples of two bytes, and takes the largest sample for 255 or 65535.
#include "pnm.h"

#include <stdlib.h>

struct pnm {
    uint32_t width, height, largest;
    size_t channels, place; // the samples are behind this many bytes
};

static bool is_blank(unsigned char byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

// Read a number behind blanks and comments. Return false if there is none, or a large one.
static bool read_number(const unsigned char *bytes, size_t size, size_t *place, uint32_t *number)
{
    const uint32_t large = 1u << 24;
    size_t at = *place;
    for (bool is_comment = false; at < size && (is_comment || bytes[at] == '#' || is_blank(bytes[at]));
         at++) {
        is_comment = (is_comment || bytes[at] == '#') && bytes[at] != '\n' && bytes[at] != '\r';
    }
    const size_t start = at;
    for (*number = 0; at < size && bytes[at] >= '0' && bytes[at] <= '9' && *number < large; at++) {
        *number = *number * 10 + (bytes[at] - (uint32_t)'0');
    }
    *place = at;
    return at > start && *number < large;
}

static bool read_header(const unsigned char *bytes, size_t size, struct pnm *pnm)
{
    *pnm = (struct pnm){.channels = size > 1 && bytes[1] == '6' ? 3 : 1, .place = 2};
    const bool is_whole = read_number(bytes, size, &pnm->place, &pnm->width) &&
                          read_number(bytes, size, &pnm->place, &pnm->height) &&
                          read_number(bytes, size, &pnm->place, &pnm->largest) && pnm->place < size &&
                          is_blank(bytes[pnm->place]);
    pnm->place++;
    return is_whole && pnm->largest >= 1 && pnm->largest <= UINT16_MAX;
}

bool scene_pnm_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    struct pnm pnm;
    const bool is_whole = read_header(bytes, size, &pnm);
    *width = pnm.width;
    *height = pnm.height;
    return is_whole;
}

// Return a share of the largest sample as a share of `full`, rounded. A sample that is larger counts as the largest.
static uint32_t scale(uint32_t sample, uint32_t largest, uint32_t full)
{
    return ((sample < largest ? sample : largest) * full + largest / 2) / largest;
}

const char *scene_image_decode_pnm(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct pnm pnm;
    if (!read_header(bytes, size, &pnm)) {
        return "damaged PNM image";
    }
    const size_t count = (size_t)pnm.width * pnm.height, depth = pnm.largest > UINT8_MAX ? 2 : 1;
    if ((size - pnm.place) / (depth * pnm.channels) < count) {
        return "the file ends too early";
    }
    void *const texels = malloc(count * 4 * depth);
    if (texels == NULL) {
        return "outofmem";
    }
    const unsigned char *const samples = bytes + pnm.place;
    for (size_t i = 0; i < 4 * count; i++) {
        const size_t channel = i % 4, s = i / 4 * pnm.channels + (pnm.channels == 3 ? channel : 0);
        if (depth == 1) {
            ((uint8_t *)texels)[i] =
                channel == 3 ? UINT8_MAX : (uint8_t)scale(samples[s], pnm.largest, UINT8_MAX);
        } else {
            ((uint16_t *)texels)[i] =
                channel == 3 ? UINT16_MAX
                             : (uint16_t)scale((uint32_t)samples[2 * s] << 8 | samples[2 * s + 1],
                                               pnm.largest, UINT16_MAX);
        }
    }
    image->type = depth == 1 ? SCENE_IMAGE_RGBA8 : SCENE_IMAGE_RGBA16;
    image->width = pnm.width;
    image->height = pnm.height;
    image->size = count * 4 * depth;
    image->texels = texels;
    return NULL;
}
