// SPDX-License-Identifier: MIT
// Entities of drawings for assimp. assimp 5.2.5 reads the 3DFACE, LINE and POLYLINE of a DXF alone, and of a POLYLINE
// that is no mesh every second line. POLYLINE, LWPOLYLINE, CIRCLE, ARC and ELLIPSE become LINE, and SOLID and TRACE
// become 3DFACE.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "assimp.h"
#include "dxf_text.h"
#include "elementary.h"

// Lines of a circle, and of one in a large file, which many circles would make a hundred times larger.
enum { STEPS = 64, FEW_STEPS = 24, LARGE = 1 << 21 };
enum { CORNERS = 4 }; // points that an entity but a polyline has

static const double pi = 3.14159265358979324;

enum kind {
    KIND_NONE,
    KIND_POLYLINE,
    KIND_LWPOLYLINE,
    KIND_CIRCLE,
    KIND_ARC,
    KIND_ELLIPSE,
    KIND_SOLID,
    KIND_VERTEX,
    KIND_SEQEND
};

enum { FLAG_CLOSED = 1, FLAG_IN_SPACE = 8, FLAG_MESH = 16, FLAG_FACES = 64, VERTEX_OF_FRAME = 16 };

// A corner of a polyline, and the tangent of a quarter of the angle of the arc from it to the next one.
struct corner {
    double place[3], bulge;
};

struct entity {
    enum kind kind;
    double points[CORNERS][3]; // the values of 10 to 13, 20 to 23 and 30 to 33
    double numbers[3];         // the values of 40 to 42
    double angles[2];          // the values of 50 and 51
    double elevation;          // height of all corners of an LWPOLYLINE
    double extrusion[3];
    double axes[3][3]; // axes of the plane that the extrusion stands on
    long flags, color;
    bool has_color;
    struct corner *corners;
    size_t corner_count, corner_capacity;
};

struct writer {
    struct scene_dxf_writer text;
    double first[3], last[3]; // ends of what was written of a polyline
    bool has_last;
    int steps; // lines of a circle
};

static void to_world(const struct entity *entity, const double place[3], double world[3])
{
    const double(*const axes)[3] = entity->axes;
    for (int c = 0; c < 3; c++) {
        world[c] = place[0] * axes[0][c] + place[1] * axes[1][c] + place[2] * axes[2][c];
    }
}

static void write_line(struct writer *writer, const struct entity *entity, const double from[3],
                       const double to[3])
{
    scene_dxf_write_text(&writer->text, "0\nLINE\n");
    if (entity->has_color) {
        scene_dxf_write_number(&writer->text, 62, (double)entity->color);
    }
    for (int c = 0; c < 3; c++) {
        scene_dxf_write_number(&writer->text, 10 * (c + 1), from[c]);
        scene_dxf_write_number(&writer->text, 10 * (c + 1) + 1, to[c]);
    }
}

static void begin_polyline(struct writer *writer)
{
    writer->has_last = false;
}

static void write_vertex(struct writer *writer, const struct entity *entity, const double world[3])
{
    if (writer->has_last) {
        write_line(writer, entity, writer->last, world);
    } else {
        memcpy(writer->first, world, sizeof writer->first);
    }
    memcpy(writer->last, world, sizeof writer->last);
    writer->has_last = true;
}

static void end_polyline(struct writer *writer, const struct entity *entity, bool is_closed)
{
    if (is_closed && writer->has_last) {
        write_line(writer, entity, writer->last, writer->first);
    }
}

static void write_flat(struct writer *writer, const struct entity *entity, double x, double y, double z)
{
    double world[3];
    to_world(entity, (const double[3]){x, y, z}, world);
    write_vertex(writer, entity, world);
}

// Write what lies between two corners on an arc.
static void write_bulge(struct writer *writer, const struct entity *entity, const struct corner *from,
                        const double to[2])
{
    const double bulge = from->bulge, angle = 4 * scene_atan(bulge);
    const int steps = (int)ceil(fabs(angle) / (2 * pi) * writer->steps - 1e-6);
    const double along[2] = {to[0] - from->place[0], to[1] - from->place[1]};
    const double offset = (1 / bulge - bulge) / 4;
    const double middle[2] = {(from->place[0] + to[0]) / 2 - along[1] * offset,
                              (from->place[1] + to[1]) / 2 + along[0] * offset};
    const double arm[2] = {from->place[0] - middle[0], from->place[1] - middle[1]};
    for (int i = 1; i < steps; i++) {
        const double c = scene_cos(angle * i / steps), s = scene_sin(angle * i / steps);
        write_flat(writer, entity, middle[0] + c * arm[0] - s * arm[1], middle[1] + s * arm[0] + c * arm[1],
                   from->place[2]);
    }
}

static void write_polyline(struct writer *writer, struct entity *entity)
{
    const bool is_closed = (entity->flags & FLAG_CLOSED) != 0;
    begin_polyline(writer);
    for (size_t i = 0; i < entity->corner_count; i++) {
        struct corner *const corner = &entity->corners[i];
        const bool has_next = is_closed || i + 1 < entity->corner_count;
        corner->place[2] = entity->kind == KIND_LWPOLYLINE ? entity->elevation : corner->place[2];
        write_flat(writer, entity, corner->place[0], corner->place[1], corner->place[2]);
        if (has_next && fabs(corner->bulge) > 1e-9) {
            write_bulge(writer, entity, corner, entity->corners[(i + 1) % entity->corner_count].place);
        }
    }
    end_polyline(writer, entity, is_closed);
}

// Write a circle, an arc or an ellipse from one angle to another: middle + cos(angle) major + sin(angle) minor.
static void write_arc(struct writer *writer, const struct entity *entity, const double major[3],
                      const double minor[3], const double middle[3], double first, double last)
{
    const bool is_closed = last - first > 2 * pi - 1e-6;
    const int most = (int)ceil((last - first) / (2 * pi) * writer->steps - 1e-6), steps = most > 1 ? most : 1;
    begin_polyline(writer);
    for (int i = 0; i < steps + !is_closed; i++) {
        const double angle = first + (last - first) * i / steps;
        const double c = scene_cos(angle), s = scene_sin(angle);
        double world[3];
        for (int k = 0; k < 3; k++) {
            world[k] = middle[k] + c * major[k] + s * minor[k];
        }
        write_vertex(writer, entity, world);
    }
    end_polyline(writer, entity, is_closed);
}

static void write_round(struct writer *writer, const struct entity *entity)
{
    const bool is_ellipse = entity->kind == KIND_ELLIPSE;
    const double(*const axes)[3] = entity->axes;
    double major[3], minor[3], middle[3];
    double first = is_ellipse ? entity->numbers[1] : entity->angles[0] * pi / 180;
    double last = is_ellipse ? entity->numbers[2] : entity->angles[1] * pi / 180;
    for (int c = 0; c < 3; c++) {
        const int u = (c + 1) % 3, v = (c + 2) % 3;
        const double *const m = entity->points[1];
        major[c] = is_ellipse ? m[c] : entity->numbers[0] * axes[0][c];
        minor[c] = is_ellipse ? entity->numbers[0] * (axes[2][u] * m[v] - axes[2][v] * m[u])
                              : entity->numbers[0] * axes[1][c];
    }
    if (is_ellipse) {
        memcpy(middle, entity->points[0], sizeof middle);
    } else {
        to_world(entity, entity->points[0], middle);
    }
    if (entity->kind == KIND_CIRCLE || !(fabs(first) < 1e6 && fabs(last) < 1e6)) {
        first = 0;
        last = 2 * pi;
    }
    last += last <= first ? 2 * pi * (floor((first - last) / (2 * pi)) + 1) : 0;
    write_arc(writer, entity, major, minor, middle, first, last - first > 2 * pi ? first + 2 * pi : last);
}

// The third and the fourth corner of a SOLID are those of a 3DFACE the other way round.
static void write_solid(struct writer *writer, const struct entity *entity)
{
    static const int order[CORNERS] = {0, 1, 3, 2};
    scene_dxf_write_text(&writer->text, "0\n3DFACE\n");
    if (entity->has_color) {
        scene_dxf_write_number(&writer->text, 62, (double)entity->color);
    }
    for (int i = 0; i < CORNERS; i++) {
        double world[3];
        to_world(entity, entity->points[order[i]], world);
        for (int c = 0; c < 3; c++) {
            scene_dxf_write_number(&writer->text, 10 * (c + 1) + i, world[c]);
        }
    }
}

static void write_entity(struct writer *writer, struct entity *entity)
{
    const bool is_in_space = entity->kind == KIND_POLYLINE && (entity->flags & FLAG_IN_SPACE) != 0;
    scene_dxf_find_axes(is_in_space ? (const double[3]){0, 0, 1} : entity->extrusion, entity->axes);
    switch (entity->kind) {
    case KIND_POLYLINE:
    case KIND_LWPOLYLINE: write_polyline(writer, entity); break;
    case KIND_SOLID: write_solid(writer, entity); break;
    case KIND_CIRCLE:
    case KIND_ARC:
    case KIND_ELLIPSE: write_round(writer, entity); break;
    default: break;
    }
}

// Reading -------------------------------------------------------------------------------------------

static enum kind find_kind(struct scene_dxf_pair pair)
{
    static const struct {
        const char *name;
        enum kind kind;
    } kinds[] = {
        {"POLYLINE", KIND_POLYLINE},     {"VERTEX", KIND_VERTEX}, {"SEQEND", KIND_SEQEND},
        {"LWPOLYLINE", KIND_LWPOLYLINE}, {"CIRCLE", KIND_CIRCLE}, {"ARC", KIND_ARC},
        {"ELLIPSE", KIND_ELLIPSE},       {"SOLID", KIND_SOLID},   {"TRACE", KIND_SOLID},
    };
    for (size_t i = 0; pair.code == 0 && i < sizeof kinds / sizeof *kinds; i++) {
        if (scene_word_is(pair.value, kinds[i].name)) {
            return kinds[i].kind;
        }
    }
    return KIND_NONE;
}

static void add_corner(struct writer *writer, struct entity *entity, double x)
{
    scene_import_reserve(writer->text.import, &entity->corners, &entity->corner_capacity,
                         entity->corner_count + 1, sizeof *entity->corners);
    entity->corners[entity->corner_count++] = (struct corner){.place = {x, 0}};
}

static void take_corner(struct writer *writer, struct entity *entity, long code, double value)
{
    if (code == 10) {
        add_corner(writer, entity, value);
    } else if (code == 20 && entity->corner_count > 0) {
        entity->corners[entity->corner_count - 1].place[1] = value;
    } else if (code == 42 && entity->corner_count > 0) {
        entity->corners[entity->corner_count - 1].bulge = value;
    }
}

static void take(struct writer *writer, struct entity *entity, struct scene_dxf_pair pair)
{
    double value = 0;
    size_t length;
    if (!scene_word_number(pair.value, &value, &length) || !(fabs(value) < 1e30)) {
        return;
    }
    const long tens = pair.code / 10, ones = pair.code % 10;
    if (entity->kind == KIND_LWPOLYLINE) {
        take_corner(writer, entity, pair.code, value);
    }
    if (tens >= 1 && tens <= 3 && ones < CORNERS) {
        entity->points[ones][tens - 1] = value;
    } else if (tens == 4 && ones < 3) {
        entity->numbers[ones] = value;
    } else if (pair.code == 50 || pair.code == 51) {
        entity->angles[ones] = value;
    } else if (pair.code >= 210 && pair.code <= 230 && ones == 0) {
        entity->extrusion[tens - 21] = value;
    } else if (pair.code == 70 && fabs(value) < 1e9) {
        entity->flags = (long)value;
    } else if (pair.code == 62 && fabs(value) < 1e9) {
        entity->color = (long)value;
        entity->has_color = true;
    }
    entity->elevation = pair.code == 38 ? value : entity->elevation;
    const bool is_width =
        entity->kind == KIND_LWPOLYLINE && (pair.code == 40 || pair.code == 41 || pair.code == 43);
    if (fabs(value) > 0 && is_width) {
        scene_import_unsupported(writer->text.import, "the width of polylines (DXF): drawn as lines");
    } else if (fabs(value) > 0 && pair.code == 39) {
        scene_import_unsupported(writer->text.import, "the thickness of entities (DXF): drawn without");
    }
}

// Read the corners of a POLYLINE, which are entities behind it up to a SEQEND. Return false for a mesh.
static bool read_vertices(struct writer *writer, struct scene_text *text, struct entity *entity)
{
    struct scene_text next = *text;
    struct scene_dxf_pair pair;
    if ((entity->flags & (FLAG_MESH | FLAG_FACES)) != 0) {
        return false;
    }
    while (scene_dxf_read_pair(&next, &pair) && find_kind(pair) == KIND_VERTEX) {
        struct entity vertex = {.kind = KIND_VERTEX};
        *text = next;
        while (scene_dxf_read_pair(&next, &pair) && pair.code != 0) {
            take(writer, &vertex, pair);
            *text = next;
        }
        if ((vertex.flags & VERTEX_OF_FRAME) == 0) {
            add_corner(writer, entity, 0);
            struct corner *const corner = &entity->corners[entity->corner_count - 1];
            memcpy(corner->place, vertex.points[0], sizeof corner->place);
            corner->bulge = vertex.numbers[2];
        }
        next = *text;
    }
    return true;
}

// Read what belongs to an entity, up to the next one, and write it as assimp knows it. A triangle has three corners.
// Return false for an entity that stays as it is.
static bool replace_entity(struct writer *writer, struct scene_text *text, struct entity *entity)
{
    struct scene_text next = *text;
    struct scene_dxf_pair pair;
    bool has_fourth = false;
    while (scene_dxf_read_pair(&next, &pair) && pair.code != 0) {
        take(writer, entity, pair);
        has_fourth = has_fourth || pair.code == 13;
        *text = next;
    }
    if (!has_fourth) {
        memcpy(entity->points[3], entity->points[2], sizeof entity->points[3]);
    }
    if (entity->kind == KIND_POLYLINE && !read_vertices(writer, text, entity)) {
        return false;
    }
    write_entity(writer, entity);
    return true;
}

char *scene_assimp_flatten_dxf(struct scene_import *import, char *bytes, size_t *size)
{
    struct writer writer = {.text = {.import = import}, .steps = *size > LARGE ? FEW_STEPS : STEPS};
    struct entity entity = {.kind = KIND_NONE};
    struct scene_text text = scene_text_open(import, bytes, *size);
    const char *kept = text.cursor;
    struct scene_dxf_pair pair;
    for (const char *start = text.cursor; scene_dxf_read_pair(&text, &pair); start = text.cursor) {
        const enum kind kind = find_kind(pair);
        if (kind == KIND_NONE || kind == KIND_VERTEX || kind == KIND_SEQEND) {
            continue;
        }
        entity = (struct entity){.kind = kind,
                                 .extrusion = {0, 0, 1},
                                 .numbers = {0, 0, kind == KIND_ELLIPSE ? 2 * pi : 0},
                                 .corners = entity.corners,
                                 .corner_capacity = entity.corner_capacity};
        scene_dxf_write(&writer.text, kept, (size_t)(start - kept));
        kept = replace_entity(&writer, &text, &entity) ? text.cursor : start;
    }
    scene_dxf_write(&writer.text, kept, (size_t)(text.end - kept));
    free(entity.corners);
    free(bytes);
    *size = writer.text.size;
    return writer.text.bytes;
}
