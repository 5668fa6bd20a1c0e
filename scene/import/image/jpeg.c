// SPDX-License-Identifier: MIT
// Markers are those of ITU-T T.81, annex B. Between segments, and in the data of a scan, every byte that is no marker
// is skipped, as stb_image skips some of them.
#include "jpeg.h"

enum { FILL = 0xff, START = 0xd8, HUFFMAN_TABLES = 0xc4, MOST_CODES = 256, TABLE_HEADER = 17 };

// Go to what follows the next marker that a segment belongs to. Return the marker, or −1 at the end.
static int next_marker(const unsigned char *bytes, size_t size, size_t *at)
{
    while (*at < size) {
        if (bytes[(*at)++] != FILL) {
            continue;
        }
        while (*at < size && bytes[*at] == FILL) {
            ++*at;
        }
        const int marker = *at < size ? bytes[(*at)++] : 0;
        const bool stands_alone = marker <= 1 || (marker >= 0xd0 && marker <= 0xd9);
        if (!stands_alone) {
            return marker;
        }
    }
    return -1;
}

// Return true if the tables of a segment have no more codes than they may. What the last table has beyond the segment
// counts, because stb_image reads all of it. It reads zeros behind the end of the file.
static bool check_tables(const unsigned char *bytes, size_t length, size_t left)
{
    for (size_t at = 2; at < length && at < left;) {
        unsigned codes = 0;
        for (size_t i = 1; i < TABLE_HEADER && at + i < left; i++) {
            codes += bytes[at + i];
        }
        if (codes > MOST_CODES) {
            return false;
        }
        at += TABLE_HEADER + codes;
    }
    return true;
}

const char *scene_jpeg_problem(const unsigned char *bytes, size_t size)
{
    size_t at = 0;
    while (at < size && bytes[at] == FILL) {
        at++;
    }
    if (at == 0 || at == size || bytes[at] != START) {
        return NULL;
    }
    for (int marker = next_marker(bytes, size, &at); marker >= 0; marker = next_marker(bytes, size, &at)) {
        const size_t left = size - at, length = left < 2 ? left : (size_t)bytes[at] << 8 | bytes[at + 1];
        if (marker == HUFFMAN_TABLES && !check_tables(bytes + at, length, left)) {
            return "damaged JPEG: a Huffman table of more than 256 codes";
        }
        at += length < left ? length : left;
    }
    return NULL;
}

size_t scene_jpeg_tails(const unsigned char *bytes, size_t size, size_t most, size_t *places)
{
    enum { FIRST = 0xc0, FIRST_RESTART = 0xd0, LAST_RESTART = 0xd7, SCAN = 0xda };
    size_t at = 0, count = 0;
    int marker = 0;
    while (marker != SCAN && marker >= 0) {
        marker = next_marker(bytes, size, &at);
    }
    for (; at + 3 < size && count < most; at++) {
        const unsigned next = bytes[at + 3];
        const bool is_end = next >= FIRST && next != FILL && (next < FIRST_RESTART || next > LAST_RESTART);
        if (bytes[at] == FILL && bytes[at + 1] == 0 && bytes[at + 2] == FILL && is_end) {
            places[count++] = at;
        }
    }
    return count;
}

bool scene_jpeg_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    // Frames begin by these markers, but for three that stand among them (table B.1).
    enum { FIRST_FRAME = 0xc0, LAST_FRAME = 0xcf, EXTENSIONS = 0xc8, CONDITIONING = 0xcc, FRAME_HEADER = 7 };
    size_t at = 0;
    for (int marker = next_marker(bytes, size, &at); marker >= 0; marker = next_marker(bytes, size, &at)) {
        const bool is_frame = marker >= FIRST_FRAME && marker <= LAST_FRAME && marker != HUFFMAN_TABLES &&
                              marker != EXTENSIONS && marker != CONDITIONING;
        const size_t left = size - at, length = left < 2 ? left : (size_t)bytes[at] << 8 | bytes[at + 1];
        if (is_frame && left >= FRAME_HEADER) {
            *height = (uint32_t)bytes[at + 3] << 8 | bytes[at + 4];
            *width = (uint32_t)bytes[at + 5] << 8 | bytes[at + 6];
            return true;
        }
        at += length < left ? length : left;
    }
    return false;
}
