// SPDX-License-Identifier: MIT
// An extrusion is a curve in a plane, its section, which moves along a spine (ISO/IEC 19775-1 13.3.5). At each point of
// the spine the plane stands across it, as the standard's rules for its axes say. What they leave open is decided by
// the next points that stand elsewhere, and a straight spine that goes down is one that goes up, turned around x.
// Points are the same, and segments on one line, as far as files with six digits tell. Where edges are to be smooth,
// the normals are made here, so that the caps at the ends stay flat.
#include "x3d_made.h"

#include "import/builder/numbers.h"
#include "import/builder/smooth.h"
#include "import/builder/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A few spines and sections that are long would be of any size.
enum { MOST_POINTS = 1 << 17 };

static const double same = 1e-6, straight = 1e-5; // a part of the spine's size, and the sine of a turn

struct list {
    double *values;
    size_t count; // the number of its tuples
};

struct extrusion {
    struct list spine, section, scales, turns;
    size_t section_corners; // without a last point that is the first one again
};

// A plane across the spine, which is upright on y.
struct plane {
    double x[3], y[3], z[3];
};

// The points of a spine that stand apart from those before them, and the last one not where the first is.
struct track {
    double (*points)[3];
    size_t *of_spine; // the number of each point of the spine among them
    size_t count;
    bool is_closed;
};

static struct list read_list(struct scene_import *import, char *tag, char *close, const char *name,
                             const char *usual, size_t width)
{
    struct list list;
    list.values = scene_x3d_numbers_of(import, tag, close, name, usual, &list.count);
    list.count /= width;
    return list;
}

// Return a tuple of a list, of which the last one counts for all that follow.
static const double *tuple_of(const struct list *list, size_t width, size_t number)
{
    return list->values + width * (number < list->count ? number : list->count - 1);
}

// The track of a spine ------------------------------------------------------------------------------

static double distance(const double *a, const double *b, size_t width)
{
    double square = 0;
    for (size_t c = 0; c < width; c++) {
        square += (a[c] - b[c]) * (a[c] - b[c]);
    }
    return sqrt(square);
}

static struct track find_track(struct scene_import *import, const struct list *spine)
{
    struct track track = {.points = scene_import_allocate(import, spine->count, sizeof *track.points),
                          .of_spine = scene_import_allocate(import, spine->count, sizeof *track.of_spine)};
    double size = 0;
    for (size_t i = 0; i < spine->count; i++) {
        size = fmax(size, distance(spine->values, spine->values + 3 * i, 3));
    }
    for (size_t i = 0; i < spine->count; i++) {
        const double *const point = spine->values + 3 * i;
        if (i == 0 || distance(track.points[track.count - 1], point, 3) > same * size) {
            memcpy(track.points[track.count++], point, sizeof *track.points);
        }
        track.of_spine[i] = track.count - 1;
    }
    track.is_closed =
        track.count > 1 && distance(track.points[0], track.points[track.count - 1], 3) <= same * size;
    track.count -= track.is_closed;
    for (size_t i = 0; i < spine->count; i++) {
        track.of_spine[i] %= track.count;
    }
    return track;
}

// Set the ways from a point to the one before it and to the one behind it, 0 where there is none.
static void find_ways(const struct track *track, size_t number, double before[3], double after[3])
{
    const size_t last = track->count - 1;
    const size_t previous = number > 0 ? number - 1 : track->is_closed ? last : 0;
    const size_t next = number < last ? number + 1 : track->is_closed ? 0 : last;
    for (int c = 0; c < 3; c++) {
        before[c] = track->points[previous][c] - track->points[number][c];
        after[c] = track->points[next][c] - track->points[number][c];
    }
}

// Set what a track turns around at a point. Return false where it is straight.
static bool find_turn(const struct track *track, size_t number, double z[3])
{
    double before[3], after[3];
    find_ways(track, number, before, after);
    scene_vector_unit(before);
    scene_vector_unit(after);
    scene_cross(after, before, z);
    const bool is_turn = scene_dot(z, z) > straight * straight;
    scene_vector_unit(z);
    return is_turn;
}

// Set where a track goes at a point, along the ways to and from it. Where it turns back it goes on.
static void find_direction(const struct track *track, size_t number, double y[3])
{
    double before[3], after[3];
    find_ways(track, number, before, after);
    const double between[3] = {after[0] - before[0], after[1] - before[1], after[2] - before[2]};
    const bool is_back = scene_dot(between, between) <= same * same * scene_dot(after, after);
    for (int c = 0; c < 3; c++) {
        y[c] = is_back ? -before[c] : between[c];
    }
    scene_vector_unit(y);
}

// Return the plane y = 0, turned as a vector along y is turned to where a straight track begins to go.
static struct plane find_straight_plane(const struct track *track)
{
    struct plane plane = {.x = {1, 0, 0}, .y = {0, 1, 0}};
    if (track->count > 1) {
        double before[3];
        find_ways(track, 0, before, plane.y);
        scene_vector_unit(plane.y);
    }
    const double *const y = plane.y;
    if (1 + y[1] > same * same) {
        memcpy(plane.x, (double[3]){1 - y[0] * y[0] / (1 + y[1]), -y[0], -y[0] * y[2] / (1 + y[1])},
               sizeof plane.x);
    }
    scene_cross(plane.x, plane.y, plane.z);
    return plane;
}

// Return the planes at the points of a track.
static struct plane *find_planes(struct scene_import *import, const struct track *track)
{
    struct plane *const planes = scene_import_allocate(import, track->count, sizeof *planes);
    double last[3] = {0, 0, 0};
    size_t first = 0;
    while (first < track->count && !find_turn(track, first, last)) {
        first++;
    }
    const struct plane plane = find_straight_plane(track);
    for (size_t i = 0; i < track->count; i++) {
        double z[3];
        planes[i] = plane;
        if (first == track->count) {
            continue;
        }
        if (find_turn(track, i, z)) {
            const double side = scene_dot(z, last) < 0 ? -1 : 1;
            for (int c = 0; c < 3; c++) {
                last[c] = side * z[c];
            }
        }
        find_direction(track, i, planes[i].y);
        scene_cross(planes[i].y, last, planes[i].x);
        scene_vector_unit(planes[i].x);
        scene_cross(planes[i].x, planes[i].y, planes[i].z);
    }
    return planes;
}

// Points --------------------------------------------------------------------------------------------

// The section at a point of the spine: where its origin is, and where its x and z go.
struct row {
    double at[3], x[3], z[3];
};

// Turn a vector by three numbers of an axis and an angle.
static void rotate(const double turn[4], double vector[3])
{
    double axis[3] = {turn[0], turn[1], turn[2]}, across[3];
    const double sine = scene_sin(turn[3]), cosine = scene_cos(turn[3]);
    scene_vector_unit(axis);
    if (scene_dot(axis, axis) > 0) {
        const double along = scene_dot(axis, vector);
        scene_cross(axis, vector, across);
        for (int c = 0; c < 3; c++) {
            vector[c] = vector[c] * cosine + across[c] * sine + axis[c] * along * (1 - cosine);
        }
    }
}

static struct row find_row(const struct extrusion *extrusion, const struct plane *plane, size_t number)
{
    const double *const scale = tuple_of(&extrusion->scales, 2, number);
    double x[3] = {scale[0], 0, 0}, z[3] = {0, 0, scale[1]};
    struct row row;
    rotate(tuple_of(&extrusion->turns, 4, number), x);
    rotate(tuple_of(&extrusion->turns, 4, number), z);
    for (int c = 0; c < 3; c++) {
        row.at[c] = extrusion->spine.values[3 * number + (size_t)c];
        row.x[c] = x[0] * plane->x[c] + x[1] * plane->y[c] + x[2] * plane->z[c];
        row.z[c] = z[0] * plane->x[c] + z[1] * plane->y[c] + z[2] * plane->z[c];
    }
    return row;
}

static void place(const struct extrusion *extrusion, const struct row *row, size_t number, float point[3])
{
    const double *const at = extrusion->section.values + 2 * number;
    for (int c = 0; c < 3; c++) {
        point[c] = (float)(row->at[c] + at[0] * row->x[c] + at[1] * row->z[c]);
    }
}

// Sides ---------------------------------------------------------------------------------------------

// Add a triangle, unless it has no area as two of its corners are at one place.
static void add_triangle(struct scene_mesh *mesh, const uint32_t corners[3])
{
    bool is_thin = false;
    for (int k = 0; k < 3; k++) {
        const float *const a = mesh->positions[corners[k]], *const b = mesh->positions[corners[(k + 1) % 3]];
        is_thin = is_thin || (a[0] == b[0] && a[1] == b[1] && a[2] == b[2]);
    }
    for (int k = 0; k < 3 && !is_thin; k++) {
        mesh->indices[mesh->index_count++] = corners[k];
    }
}

// Make the sides, with normals where these are smooth. The texture goes by the number of the point, as in grids.
static void make_sides(struct scene_import *import, const struct extrusion *extrusion, const struct row *rows,
                       double crease_angle, struct scene_mesh *mesh)
{
    const size_t columns = extrusion->section.count, count = extrusion->spine.count * columns;
    *mesh = (struct scene_mesh){.vertex_count = (uint32_t)count,
                                .positions = scene_import_allocate(import, count, sizeof *mesh->positions),
                                .uvs[0] = scene_import_allocate(import, count, sizeof *mesh->uvs[0]),
                                .indices = scene_import_allocate(import, 6 * count, sizeof *mesh->indices)};
    for (size_t i = 0; i < count; i++) {
        place(extrusion, &rows[i / columns], i % columns, mesh->positions[i]);
        mesh->uvs[0][i][0] = (float)(i % columns) / (float)(columns - 1);
        mesh->uvs[0][i][1] = (float)(i / columns) / (float)(extrusion->spine.count - 1);
    }
    for (uint32_t i = 0; i + columns < count; i++) {
        const uint32_t above = i + (uint32_t)columns;
        if (i % columns + 1 < columns) {
            add_triangle(mesh, (uint32_t[3]){i, i + 1, above + 1});
            add_triangle(mesh, (uint32_t[3]){i, above + 1, above});
        }
    }
    if (crease_angle > 0 && mesh->index_count > 0 && scene_import_finite(mesh->positions[0], 3 * count)) {
        const bool has_creases = import->has_creases;
        const double cosine = import->crease_cosine;
        import->has_creases = true;
        import->crease_cosine = scene_x3d_crease_cosine(crease_angle);
        scene_import_make_smooth(import, mesh, NULL, false);
        import->has_creases = has_creases;
        import->crease_cosine = cosine;
    }
}

// Caps ----------------------------------------------------------------------------------------------

// Set the place of the texture's origin in the section, and how large the texture is, which is no larger.
static void frame_section(const struct list *section, double origin[2], double *size)
{
    *size = 0;
    for (size_t c = 0; c < 2; c++) {
        double end = origin[c] = section->values[c];
        for (size_t i = 0; i < section->count; i++) {
            origin[c] = fmin(origin[c], section->values[2 * i + c]);
            end = fmax(end, section->values[2 * i + c]);
        }
        *size = fmax(*size, end - origin[c]);
    }
}

// Add a cap, unless its plane has shrunk to less. The first one shows its back to the last one.
static void add_cap(const struct extrusion *extrusion, const struct row *row, bool is_first,
                    struct scene_x3d_vertices *whole, struct scene_x3d_made *made)
{
    const size_t corners = extrusion->section_corners;
    double y[3], origin[2], size;
    scene_cross(row->z, row->x, y);
    scene_vector_unit(y);
    frame_section(&extrusion->section, origin, &size);
    if (!(scene_dot(y, y) > 0 && size > 0 && corners >= 3)) {
        return;
    }
    for (size_t i = 0; i < corners; i++) {
        const size_t number = is_first ? corners - 1 - i : i, vertex = whole->count++;
        place(extrusion, row, number, whole->points[vertex]);
        for (size_t c = 0; c < 3; c++) {
            whole->normals[vertex][c] = (float)(is_first ? -y[c] : y[c]);
        }
        for (size_t c = 0; c < 2; c++) {
            const double at = extrusion->section.values[2 * number + c];
            whole->places[vertex][c] = (float)((at - origin[c]) / size);
        }
        scene_x3d_add_index(made, vertex);
    }
    scene_x3d_end_face(made);
}

// Make a set of the sides and the caps.
static void make_set(struct scene_import *import, const struct extrusion *extrusion,
                     const struct scene_mesh *sides, const struct row caps[2], const bool has_caps[2],
                     struct scene_x3d_made *made)
{
    const size_t count = sides->vertex_count, most = count + 2 * extrusion->section.count;
    struct scene_x3d_vertices whole = scene_x3d_allocate_vertices(import, most);
    whole.count = count;
    memcpy(whole.points, sides->positions, count * sizeof *whole.points);
    memcpy(whole.places, sides->uvs[0], count * sizeof *whole.places);
    if (sides->normals != NULL) {
        memcpy(whole.normals, sides->normals, count * sizeof *whole.normals);
    }
    made->index.list = scene_import_allocate(import, sides->index_count / 3 * 4 + 2 * (most - count) + 2,
                                             sizeof *made->index.list);
    for (size_t i = 0; i < sides->index_count; i++) {
        scene_x3d_add_index(made, sides->indices[i]);
        if (i % 3 == 2) {
            scene_x3d_end_face(made);
        }
    }
    for (int i = 0; i < 2; i++) {
        if (has_caps[i]) {
            add_cap(extrusion, &caps[i], i == 0, &whole, made);
        }
    }
    scene_x3d_write_vertices(import, &whole, sides->normals != NULL, made);
}

// Entry ---------------------------------------------------------------------------------------------

// Return the section at each point of the spine.
static struct row *find_rows(struct scene_import *import, const struct extrusion *extrusion)
{
    struct row *const rows = scene_import_allocate(import, extrusion->spine.count, sizeof *rows);
    const struct track track = find_track(import, &extrusion->spine);
    struct plane *const planes = find_planes(import, &track);
    for (size_t i = 0; i < extrusion->spine.count; i++) {
        rows[i] = find_row(extrusion, &planes[track.of_spine[i]], i);
    }
    free(track.points);
    free(track.of_spine);
    free(planes);
    return rows;
}

bool scene_x3d_make_extrusion(struct scene_import *import, char *tag, char *close,
                              struct scene_x3d_made *made)
{
    struct extrusion extrusion = {
        .spine = read_list(import, tag, close, "spine", "0 0 0 0 1 0", 3),
        .section = read_list(import, tag, close, "crossSection", "1 1 1 -1 -1 -1 -1 1 1 1", 2),
        .scales = read_list(import, tag, close, "scale", "1 1", 2),
        .turns = read_list(import, tag, close, "orientation", "0 0 1 0", 4)};
    const struct list *const section = &extrusion.section;
    const size_t rows_count = extrusion.spine.count, columns = section->count;
    if (rows_count >= 2 && columns >= 2 && extrusion.scales.count > 0 && extrusion.turns.count > 0 &&
        rows_count <= MOST_POINTS / columns) {
        const bool has_caps[2] = {!scene_x3d_is_false(tag, close, "beginCap"),
                                  !scene_x3d_is_false(tag, close, "endCap")};
        const bool is_round = distance(section->values, section->values + 2 * (columns - 1), 2) == 0;
        extrusion.section_corners = columns - is_round;
        struct row *const rows = find_rows(import, &extrusion);
        struct scene_mesh sides;
        make_sides(import, &extrusion, rows, scene_x3d_number_of(tag, close, "creaseAngle", 0), &sides);
        make_set(import, &extrusion, &sides, (const struct row[2]){rows[0], rows[rows_count - 1]}, has_caps,
                 made);
        free(sides.positions);
        free(sides.normals);
        free(sides.uvs[0]);
        free(sides.indices);
        free(rows);
    }
    free(extrusion.spine.values);
    free(section->values);
    free(extrusion.scales.values);
    free(extrusion.turns.values);
    return made->index.count > 0;
}
