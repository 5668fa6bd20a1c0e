// SPDX-License-Identifier: MIT
// What slicers paint on triangles: paint_color of Bambu Studio and OrcaSlicer, mmu_segmentation of PrusaSlicer. A
// triangle's text is a tree of hexadecimal digits, which is read from its end:
//
//     ss00           a leaf that is painted with filament ss, 0 for none, if ss is below 3
//     1100 n n ...   a leaf that is painted with filament 3 + n; after n = 15 another n is added
//     kknn           a triangle that is cut at nn of its sides into nn + 1 pieces, which follow from the last to the
//                    first; kk is the corner that the sides are counted from
#include "threemf.h"

#include <string.h>

// A painting whose triangles are so small that no float tells their corners apart is damaged.
enum { DEEPEST = 32 };

enum purpose { CHECK, FIND_EDGES, MAKE_PIECES };

struct reader {
    struct scene_3mf *file;
    const char *text;
    size_t left; // digits that are not read yet
    enum purpose purpose;
};

// Return the next digit's value. Return −1 if there is none.
static int next_digit(struct reader *reader)
{
    static const char digits[] = "0123456789abcdef";
    if (reader->left == 0) {
        return -1;
    }
    const char digit = reader->text[--reader->left];
    const char *found = strchr(digits, digit >= 'A' && digit <= 'F' ? digit + 32 : digit);
    return found == NULL || digit == 0 ? -1 : (int)(found - digits);
}

struct scene_3mf_corner scene_3mf_middle(const struct scene_3mf_corner *a, const struct scene_3mf_corner *b)
{
    struct scene_3mf_corner corner;
    for (int c = 0; c < 3; c++) {
        corner.position[c] = a->position[c] * 0.5f + b->position[c] * 0.5f;
    }
    for (int c = 0; c < 4; c++) {
        corner.color[c] = (a->color[c] + b->color[c]) * 0.5f;
    }
    for (int c = 0; c < 2; c++) {
        corner.uv[c] = (a->uv[c] + b->uv[c]) * 0.5f;
    }
    return corner;
}

static bool add_leaf(struct reader *reader, const struct scene_3mf_corner corners[3], int code)
{
    uint32_t filament = (uint32_t)code >> 2;
    for (int digit = 15; filament >= 3 && digit == 15;) {
        digit = next_digit(reader);
        if (digit < 0) {
            return false;
        }
        filament += (uint32_t)digit;
    }
    if (reader->purpose != MAKE_PIECES) {
        return true;
    }
    struct scene_3mf_pieces *pieces = &reader->file->pieces;
    scene_import_reserve(reader->file->import, &pieces->items, &pieces->capacity, pieces->count + 1,
                         sizeof *pieces->items);
    struct scene_3mf_piece *piece = &pieces->items[pieces->count++];
    memcpy(piece->corners, corners, sizeof piece->corners);
    piece->filament = filament;
    return true;
}

static bool read_node(struct reader *reader, const struct scene_3mf_corner corners[3], int depth)
{
    // For each number of cut sides the corners of the pieces: 0, 1 and 2 are those of the triangle, 3, 4 and 5 the
    // middles of its sides 01, 12 and 20.
    static const uint8_t cuts[4][4][3] = {
        {{0}},
        {{0, 1, 4}, {4, 2, 0}},
        {{0, 3, 5}, {3, 1, 5}, {1, 2, 5}},
        {{0, 3, 5}, {3, 1, 4}, {4, 2, 5}, {3, 4, 5}},
    };
    static const uint8_t cut_sides[4] = {0, 1 << 1, 1 << 0 | 1 << 2,
                                         7}; // a bit each of the sides 01, 12 and 20
    const int code = next_digit(reader);
    const int sides = code & 3, first = code >> 2;
    if (code < 0 || depth > DEEPEST || (sides > 0 && first > 2)) {
        return false;
    }
    if (sides == 0) {
        return add_leaf(reader, corners, code);
    }
    struct scene_3mf_corner points[6];
    for (int k = 0; k < 3; k++) {
        points[k] = corners[(first + k) % 3];
    }
    for (int k = 0; k < 3; k++) {
        points[3 + k] = scene_3mf_middle(&points[k], &points[(k + 1) % 3]);
    }
    for (int k = 0; k < 3 && reader->purpose == FIND_EDGES; k++) {
        const float *a = points[k].position, *b = points[(k + 1) % 3].position, *m = points[3 + k].position;
        const bool has_middle = memcmp(m, a, 3 * sizeof *a) != 0 && memcmp(m, b, 3 * sizeof *b) != 0;
        if (cut_sides[sides] >> k & 1 && has_middle) {
            scene_3mf_add_edge(reader->file, a, b);
        }
    }
    for (int i = sides; i >= 0; i--) {
        const uint8_t *cut = cuts[sides][i];
        const struct scene_3mf_corner piece[3] = {points[cut[0]], points[cut[1]], points[cut[2]]};
        if (!read_node(reader, piece, depth + 1)) {
            return false;
        }
    }
    return true;
}

// Read a whole painting. Return false if it is damaged.
static bool read_painting(struct scene_3mf *file, const char *painting,
                          const struct scene_3mf_corner corners[3], enum purpose purpose)
{
    struct reader reader = {.file = file, .text = painting, .left = strlen(painting), .purpose = purpose};
    return read_node(&reader, corners, 0) && reader.left == 0;
}

void scene_3mf_find_cuts(struct scene_3mf *file, const char *painting,
                         const struct scene_3mf_corner corners[3])
{
    if (read_painting(file, painting, corners, CHECK)) {
        read_painting(file, painting, corners, FIND_EDGES);
    }
}

bool scene_3mf_cut(struct scene_3mf *file, const char *painting, const struct scene_3mf_corner corners[3])
{
    file->pieces.count = 0;
    return read_painting(file, painting, corners, MAKE_PIECES);
}
