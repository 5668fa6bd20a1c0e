// SPDX-License-Identifier: MIT
// Lists of numbers are split at blanks and commas.
#include "x3d_lists.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

// Return where the next number begins, or `end` where there is none. Set the end of it.
static const char *next_number(const char *text, const char *end, const char **number_end)
{
    static const char blanks[] = ", \t\r\n";
    while (text < end && strchr(blanks, *text) != NULL) {
        text++;
    }
    *number_end = text;
    while (*number_end < end && strchr(blanks, **number_end) == NULL) {
        (*number_end)++;
    }
    return text;
}

struct scene_x3d_numbers scene_x3d_read_numbers(struct scene_import *import, struct scene_collada_value text)
{
    struct scene_x3d_numbers numbers = {0};
    size_t capacity = 0;
    if (text.text == NULL) {
        return numbers;
    }
    const char *const end = text.text + text.length, *number_end;
    for (const char *number = next_number(text.text, end, &number_end); number < end;
         number = next_number(number_end, end, &number_end)) {
        scene_import_reserve(import, &numbers.list, &capacity, numbers.count + 1, sizeof *numbers.list);
        numbers.list[numbers.count++] =
            (struct scene_collada_value){(char *)(uintptr_t)number, (size_t)(number_end - number)};
    }
    return numbers;
}

struct scene_x3d_indices scene_x3d_read_indices(struct scene_import *import, struct scene_collada_value text)
{
    const struct scene_x3d_numbers numbers = scene_x3d_read_numbers(import, text);
    struct scene_x3d_indices indices = {
        .list = scene_import_allocate(import, numbers.count + 1, sizeof *indices.list),
        .count = numbers.count};
    for (size_t i = 0; i < numbers.count; i++) {
        indices.list[i] = strtoll(numbers.list[i].text, NULL, 10);
    }
    free(numbers.list);
    return indices;
}

struct scene_x3d_indices scene_x3d_count_up(struct scene_import *import, struct scene_collada_value counts,
                                            size_t points)
{
    const struct scene_x3d_indices sizes = scene_x3d_read_indices(import, counts);
    struct scene_x3d_indices indices = {
        .list = scene_import_allocate(import, points + sizes.count + 1, sizeof *indices.list)};
    size_t next = 0;
    for (size_t i = 0; i < sizes.count; i++) {
        for (int64_t k = 0; k < sizes.list[i] && next < points; k++) {
            indices.list[indices.count++] = (int64_t)next++;
        }
        indices.list[indices.count++] = -1;
    }
    while (sizes.count == 0 && next < points) {
        indices.list[indices.count++] = (int64_t)next++;
    }
    free(sizes.list);
    return indices;
}

size_t scene_x3d_index_at(const struct scene_x3d_indices *indices, size_t place)
{
    return place < indices->count && indices->list[place] >= 0 ? (size_t)indices->list[place] : SIZE_MAX;
}

bool scene_x3d_same_indices(const struct scene_x3d_indices *a, const struct scene_x3d_indices *b)
{
    bool is_same = a->count == b->count;
    for (size_t i = 0; i < a->count && is_same; i++) {
        is_same = a->list[i] == b->list[i] || (a->list[i] < 0 && b->list[i] < 0);
    }
    return is_same;
}

// Faces ---------------------------------------------------------------------------------------------

// What is under way while corners are found.
struct work {
    struct scene_import *import;
    struct scene_x3d_corners *corners;
    size_t capacity, face_capacity;
    size_t face; // the number of the next one
    bool is_turned;
};

static void add_corner(struct work *work, size_t corner)
{
    struct scene_x3d_corners *const corners = work->corners;
    scene_import_reserve(work->import, &corners->list, &work->capacity, corners->count + 1,
                         sizeof *corners->list);
    corners->list[corners->count++] = corner;
}

// End a face of this number.
static void keep_face(struct work *work, size_t face)
{
    struct scene_x3d_corners *const corners = work->corners;
    add_corner(work, SIZE_MAX);
    scene_import_reserve(work->import, &corners->faces, &work->face_capacity, corners->face_count + 1,
                         sizeof *corners->faces);
    corners->faces[corners->face_count++] = face;
}

// End a face whose corners begin at `first`. One of fewer than three is taken away.
static void end_face(struct work *work, size_t first)
{
    struct scene_x3d_corners *const corners = work->corners;
    const size_t count = corners->count - first;
    if (count < 3) {
        corners->has_short = corners->has_short || count > 0;
        corners->count = first;
    } else {
        for (size_t i = 0; work->is_turned && i < count / 2; i++) {
            size_t *const a = &corners->list[first + i], *const b = &corners->list[corners->count - 1 - i];
            const size_t kept = *a;
            *a = *b;
            *b = kept;
        }
        keep_face(work, work->face);
    }
    work->face++;
}

static void add_triangle(struct work *work, size_t a, size_t b, size_t c)
{
    const size_t first = work->corners->count;
    add_corner(work, a);
    add_corner(work, b);
    add_corner(work, c);
    end_face(work, first);
}

// Add the pieces of a line, all as one face.
static void add_line(struct work *work, size_t start, size_t end)
{
    struct scene_x3d_corners *const corners = work->corners;
    const size_t face = work->face;
    for (size_t i = start; i + 1 < end; i++) {
        add_corner(work, i);
        add_corner(work, i + 1);
        keep_face(work, face);
    }
    corners->has_short = corners->has_short || end - start == 1;
    work->face = face + 1;
}

// Add the faces of one run of indices without one below 0.
static void add_run(struct work *work, enum scene_x3d_order order, size_t start, size_t end)
{
    const size_t each = order == SCENE_X3D_TRIANGLES ? 3 : order == SCENE_X3D_QUADS ? 4 : end - start;
    if (order == SCENE_X3D_LINES) {
        add_line(work, start, end);
        return;
    }
    if (order == SCENE_X3D_FANS || order == SCENE_X3D_STRIPS) {
        work->corners->has_short = work->corners->has_short || (end > start && end - start < 3);
        for (size_t i = start; i + 2 < end; i++) {
            const bool is_odd = order == SCENE_X3D_STRIPS && (i - start) % 2 == 1;
            const size_t first = order == SCENE_X3D_FANS ? start : i;
            add_triangle(work, first, is_odd ? i + 2 : i + 1, is_odd ? i + 1 : i + 2);
        }
        return;
    }
    work->corners->has_short = work->corners->has_short || (end > start && (end - start) % each > 0);
    for (size_t i = start; i < end && end - i >= each; i += each) {
        const size_t first = work->corners->count;
        for (size_t k = i; k < i + each; k++) {
            add_corner(work, k);
        }
        end_face(work, first);
    }
}

enum scene_x3d_found scene_x3d_find_corners(struct scene_import *import,
                                            const struct scene_x3d_indices *indices,
                                            enum scene_x3d_order order, bool is_turned, size_t points,
                                            struct scene_x3d_corners *corners)
{
    struct work work = {.import = import, .corners = corners, .is_turned = is_turned};
    size_t start = 0;
    for (size_t i = 0; i <= indices->count; i++) {
        if (i < indices->count && indices->list[i] >= (int64_t)points) {
            scene_import_fail(import, "a %s refers to vertex %" PRId64 " of %zu",
                              order == SCENE_X3D_LINES ? "line" : "face", indices->list[i], points);
        }
        if (i == indices->count || indices->list[i] < 0) {
            add_run(&work, order, start, i);
            start = i + 1;
        }
    }
    return corners->count == 0 ? SCENE_X3D_NOTHING : SCENE_X3D_FACES;
}
