// SPDX-License-Identifier: MIT
// Blocks of a DXF, which insertions draw. assimp 5.2.5 moves a block before it scales it, turns none, and leaves out
// those in others. The entities of blocks are therefore written in the place of the insertions, each where it is drawn.
#include "assimp.h"
#include "dxf_text.h"
#include "elementary.h"
#include "import/builder/hash_table.h"
#include "import/builder/place.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CORNERS = 4, DEEPEST = 16, MOST_COPIES = 1 << 16 };
static const size_t most_written = (size_t)1 << 26; // bytes of insertions, beside 16 for each of the file
// Bytes of blocks that insertions read, for each byte that they may write, and what a copy of a block counts as.
enum { READ_OF_WRITTEN = 4, COPY = 512 };

struct block {
    struct scene_word name;
    double base[3];
    char *start, *end; // its entities
};

struct drawing {
    struct scene_import *import;
    struct block *blocks;
    size_t count, capacity;
    struct scene_hash_table names; // the table finds blocks by their names
    struct scene_dxf_writer out;
    size_t most, read; // bytes that may be written, and bytes that insertions have read
    unsigned depth;    // number of insertions that are in each other
    bool is_too_much;  // more is inserted than is written
};

// What is read of an entity or an insertion.
struct entity {
    struct scene_word block;
    double points[CORNERS][3], factors[3], angle, extrusion[3], spacing[2];
    bool has_point[CORNERS];
    long flags, counts[2]; // the values of 70 and 71, which of an insertion are columns and rows
    long color;
    bool has_color;
};

static struct entity entity_default(void)
{
    return (struct entity){.factors = {1, 1, 1}, .extrusion = {0, 0, 1}, .counts = {1, 1}};
}

static void take(struct entity *entity, const struct scene_dxf_pair *pair)
{
    const long tens = pair->code / 10, ones = pair->code % 10;
    double value;
    size_t length;
    if (pair->code == 2) {
        entity->block = pair->line;
    }
    if (!scene_word_number(pair->value, &value, &length) || !(fabs(value) < 1e30)) {
        return;
    }
    if (tens >= 1 && tens <= 3 && ones < CORNERS) {
        entity->points[ones][tens - 1] = value;
        entity->has_point[ones] = true;
    } else if (pair->code >= 41 && pair->code <= 43) {
        entity->factors[pair->code - 41] = value;
    } else if (pair->code == 44 || pair->code == 45) {
        entity->spacing[pair->code - 44] = value;
    } else if (pair->code == 50) {
        entity->angle = value;
    } else if (pair->code == 62 && fabs(value) < 1e9) {
        entity->color = (long)value;
        entity->has_color = true;
    } else if ((pair->code == 70 || pair->code == 71) && fabs(value) < 1e9) {
        entity->flags = pair->code == 70 ? (long)value : entity->flags;
        entity->counts[pair->code - 70] = (long)value;
    } else if (pair->code >= 210 && pair->code <= 230 && ones == 0) {
        entity->extrusion[tens - 21] = value;
    }
}

// Read on up to the next pair with the code 0, which stays in the text.
static struct entity read_entity(struct scene_text *text)
{
    struct entity entity = entity_default();
    struct scene_text next = *text;
    struct scene_dxf_pair pair;
    while (scene_dxf_read_pair(&next, &pair) && pair.code != 0) {
        take(&entity, &pair);
        *text = next;
    }
    return entity;
}

// Insertions ----------------------------------------------------------------------------------------

// Find the matrix from a block to where an insertion draws one of its copies.
static void find_matrix(const struct entity *insertion, const struct block *block, long column, long row,
                        double matrix[16])
{
    double axes[3][3], sine, cosine, turn[16], scale[16];
    scene_dxf_find_axes(insertion->extrusion, axes);
    scene_sin_cos_degrees(insertion->angle, &sine, &cosine);
    scene_import_identity_exact(matrix);
    scene_import_identity_exact(turn);
    scene_import_identity_exact(scale);
    for (int i = 0; i < 9; i++) {
        matrix[i / 3 * 4 + i % 3] = axes[i / 3][i % 3];
    }
    turn[0] = turn[5] = cosine;
    turn[1] = sine;
    turn[4] = -sine;
    const double steps[3] = {(double)column * insertion->spacing[0], (double)row * insertion->spacing[1], 0};
    for (int c = 0; c < 3; c++) {
        const double along = turn[c] * steps[0] + turn[4 + c] * steps[1];
        turn[12 + c] = insertion->points[0][c] + along;
        scale[5 * c] = insertion->factors[c];
        scale[12 + c] = -insertion->factors[c] * block->base[c];
    }
    scene_import_multiply_exact(matrix, turn, matrix);
    scene_import_multiply_exact(matrix, scale, matrix);
}

static const struct block *find_block(const struct drawing *drawing, struct scene_word name)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = scene_hash_bytes(name.start, name.length);
    for (uint32_t i = scene_hash_next(&drawing->names, hash, &place); i != UINT32_MAX;
         i = scene_hash_next(&drawing->names, hash, &place)) {
        const struct scene_word other = drawing->blocks[i].name;
        if (other.length == name.length && memcmp(other.start, name.start, name.length) == 0) {
            return &drawing->blocks[i];
        }
    }
    return NULL;
}

// Write the pairs of an entity as they are, but for its places and a colour that is the insertion's (0).
static void copy_pairs(struct drawing *drawing, struct scene_text text, const char *end, bool has_places,
                       const struct entity *insertion)
{
    struct scene_dxf_pair pair;
    for (char *start = text.cursor; start < end && scene_dxf_read_pair(&text, &pair); start = text.cursor) {
        const bool is_place = has_places && pair.code >= 10 && pair.code < 40 && pair.code % 10 < CORNERS;
        if (pair.code == 62 && scene_word_is(pair.value, "0") && insertion->has_color) {
            scene_dxf_write_number(&drawing->out, 62, (double)insertion->color);
        } else if (!is_place) {
            scene_dxf_write(&drawing->out, start, (size_t)(text.cursor - start));
        }
    }
}

// Write an entity whose name begins at `start`, and behind which `text` is, where a matrix brings it.
static void write_entity(struct drawing *drawing, char *start, struct scene_text *text, const char *name,
                         const struct entity *insertion, const double matrix[16])
{
    enum { FLAG_FACE = 128, FLAG_OF_MESH = 64 };
    struct scene_text pairs = {.cursor = start, .end = text->end};
    const struct entity entity = read_entity(text);
    const bool is_face = (entity.flags & FLAG_FACE) != 0 && (entity.flags & FLAG_OF_MESH) == 0;
    const bool is_list = strcmp(name, "POLYLINE") == 0 || strcmp(name, "SEQEND") == 0;
    const bool has_places = !is_list && !(strcmp(name, "VERTEX") == 0 && is_face);
    copy_pairs(drawing, pairs, text->cursor, has_places, insertion);
    for (int i = 0; i < CORNERS && has_places; i++) {
        double world[3];
        scene_import_transform_exact(matrix, entity.points[i], world);
        for (int c = 0; c < 3 && entity.has_point[i]; c++) {
            scene_dxf_write_number(&drawing->out, 10 * (c + 1) + i, world[c]);
        }
    }
}

// Count bytes that an insertion reads. What is never written is limited, too, as blocks may have nothing to draw.
static void count_read(struct drawing *drawing, size_t size)
{
    drawing->read += size;
    drawing->is_too_much = drawing->is_too_much || drawing->out.size > drawing->most ||
                           drawing->read / READ_OF_WRITTEN > drawing->most;
}

// Give an insertion within a block its colour, which may be that of the insertion of the block (0).
static void inherit_color(struct entity *inner, const struct entity *insertion)
{
    if (inner->has_color && inner->color == 0) {
        inner->color = insertion->color;
        inner->has_color = insertion->has_color;
    }
}

static void insert(struct drawing *drawing, const struct entity *insertion, const double outer[16]);

// Write the entities of a block where a matrix brings them.
static void write_block(struct drawing *drawing, const struct block *block, const struct entity *insertion,
                        const double matrix[16])
{
    static const char *const names[] = {"3DFACE", "LINE", "3DLINE", "POLYLINE", "VERTEX", "SEQEND"};
    struct scene_text text = {.cursor = block->start, .end = block->end};
    struct scene_dxf_pair pair;
    for (char *start = text.cursor; !drawing->is_too_much && scene_dxf_read_pair(&text, &pair);
         start = text.cursor) {
        if (scene_dxf_begins(&pair, "INSERT")) {
            struct entity inner = read_entity(&text);
            inherit_color(&inner, insertion);
            insert(drawing, &inner, matrix);
        }
        for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
            if (scene_dxf_begins(&pair, names[i])) {
                write_entity(drawing, start, &text, names[i], insertion, matrix);
                break;
            }
        }
        count_read(drawing, (size_t)(text.cursor - start));
    }
}

// Write what an insertion draws, within a block whose matrix is `outer`.
static void insert(struct drawing *drawing, const struct entity *insertion, const double outer[16])
{
    const struct block *const block = find_block(drawing, insertion->block);
    const long columns = insertion->counts[0] > 1 ? insertion->counts[0] : 1,
               rows = insertion->counts[1] > 1 ? insertion->counts[1] : 1;
    if (block == NULL) {
        scene_import_unsupported(drawing->import, "insertions of a block that there is not (DXF): left out");
        return;
    }
    drawing->is_too_much = drawing->is_too_much || drawing->depth == DEEPEST || columns > MOST_COPIES ||
                           rows > MOST_COPIES || columns * rows > MOST_COPIES;
    drawing->depth++;
    for (long i = 0; i < columns * rows && !drawing->is_too_much; i++) {
        double matrix[16];
        find_matrix(insertion, block, i % columns, i / columns, matrix);
        scene_import_multiply_exact(outer, matrix, matrix);
        count_read(drawing, COPY);
        write_block(drawing, block, insertion, matrix);
    }
    drawing->depth--;
}

// Reading -------------------------------------------------------------------------------------------

// Read a block, whose first pair was read, up to its end.
static void read_block(struct drawing *drawing, struct scene_text *text)
{
    const struct entity head = read_entity(text);
    struct block block = {.name = head.block, .start = text->cursor, .end = text->cursor};
    struct scene_dxf_pair pair;
    memcpy(block.base, head.points[0], sizeof block.base);
    while (scene_dxf_read_pair(text, &pair) && !scene_dxf_begins(&pair, "ENDBLK") &&
           !scene_dxf_begins(&pair, "ENDSEC")) {
        block.end = text->cursor;
    }
    if (block.name.length > 0) {
        scene_import_reserve(drawing->import, &drawing->blocks, &drawing->capacity, drawing->count + 1,
                             sizeof *drawing->blocks);
        scene_hash_add(drawing->import, &drawing->names,
                       scene_hash_bytes(block.name.start, block.name.length), (uint32_t)drawing->count);
        drawing->blocks[drawing->count++] = block;
    }
}

// Read the section of the blocks behind its name.
static void read_blocks(struct drawing *drawing, struct scene_text *text)
{
    struct scene_dxf_pair pair;
    while (scene_dxf_read_pair(text, &pair) && !scene_dxf_begins(&pair, "ENDSEC")) {
        if (scene_dxf_begins(&pair, "BLOCK")) {
            read_block(drawing, text);
        }
    }
}

// Copy the section of the entities behind its name, with what insertions draw.
static void copy_entities(struct drawing *drawing, struct scene_text *text)
{
    struct scene_dxf_pair pair = {.code = -1};
    double identity[16];
    scene_import_identity_exact(identity);
    for (char *start = text->cursor; !scene_dxf_begins(&pair, "ENDSEC") && scene_dxf_read_pair(text, &pair);
         start = text->cursor) {
        if (scene_dxf_begins(&pair, "INSERT")) {
            const struct entity insertion = read_entity(text);
            insert(drawing, &insertion, identity);
        } else {
            scene_dxf_write(&drawing->out, start, (size_t)(text->cursor - start));
        }
    }
}

// Go through all sections. Read the blocks, or with `copies` copy the others.
static void go_through(struct drawing *drawing, char *bytes, size_t size, bool copies)
{
    struct scene_text text = {.cursor = bytes, .end = bytes + size};
    struct scene_dxf_pair pair;
    bool is_section = false, is_within_blocks = false;
    for (char *start = bytes; scene_dxf_read_pair(&text, &pair); start = text.cursor) {
        const bool is_named = is_section && pair.code == 2;
        is_section = scene_dxf_begins(&pair, "SECTION");
        is_within_blocks = is_within_blocks && !scene_dxf_begins(&pair, "ENDSEC");
        if (copies && !is_within_blocks) {
            scene_dxf_write(&drawing->out, start, (size_t)(text.cursor - start));
        }
        if (is_named && copies) {
            is_within_blocks = scene_word_is(pair.value, "BLOCKS");
        }
        if (is_named && copies && scene_word_is(pair.value, "ENTITIES")) {
            copy_entities(drawing, &text);
        } else if (is_named && !copies && scene_word_is(pair.value, "BLOCKS")) {
            read_blocks(drawing, &text);
        }
    }
}

char *scene_assimp_insert_blocks(struct scene_import *import, char *bytes, size_t *size)
{
    struct drawing drawing = {.import = import, .out = {.import = import}, .most = most_written + 16 * *size};
    go_through(&drawing, bytes, *size, false);
    if (drawing.count > 0) {
        go_through(&drawing, bytes, *size, true);
    }
    free(drawing.blocks);
    free(drawing.names.entries);
    if (drawing.is_too_much) {
        scene_import_fail(import, "inserts blocks into each other more often than a drawing would be drawn");
    }
    if (drawing.out.bytes == NULL) {
        return bytes;
    }
    free(bytes);
    *size = drawing.out.size;
    return drawing.out.bytes;
}
