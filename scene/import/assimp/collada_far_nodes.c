// SPDX-License-Identifier: MIT
// Nodes of Collada that are far from their parents. The transforms of a node are multiplied here in double. assimp gets
// the transforms without their translations, and a mark in the place of the first translation.
#include "collada_far.h"

#include <stdlib.h>
#include <string.h>

#include "collada_markup.h"
#include "elementary.h"

enum { MOST_TRANSFORMS = 64, DEEPEST = 4096 };

enum kind { TRANSLATE, ROTATE, SCALE, MATRIX, OTHER };

struct transform {
    enum kind kind;
    char *tag, *text, *end; // its start tag, and where its numbers begin and end
    double numbers[16];
    const char *ends[16][2]; // where each number begins and ends
};

// A node that is open, and its transforms.
struct node {
    struct scene_collada_value id;
    size_t depth; // number of elements that are open around its children
    size_t first; // the number of its first transform
};

struct nodes {
    struct scene_import *import;
    struct scene_assimp_exact *exact;
    const char *start, *end;
    struct scene_edits *edits;
    struct node *open;
    size_t open_count, open_capacity;
    struct transform *transforms; // all nodes that are open have theirs here
    size_t count, capacity;
    struct scene_hash_table moved; // nodes that an animation moves, by their ids
    struct scene_collada_value *ids;
    size_t id_count, id_capacity;
};

// Transforms ----------------------------------------------------------------------------------------

static const struct {
    const char *name;
    size_t numbers;
} kinds[] = {
    [TRANSLATE] = {"translate", 3}, [ROTATE] = {"rotate", 4}, [SCALE] = {"scale", 3}, [MATRIX] = {"matrix", 16}};

static enum kind kind_of(const char *tag)
{
    enum kind kind = TRANSLATE;
    while (kind < OTHER && !scene_collada_is_tag(tag, kinds[kind].name)) {
        kind++;
    }
    return kind;
}

static bool is_transform(const char *tag)
{
    return kind_of(tag) < OTHER || scene_collada_is_tag(tag, "lookat") || scene_collada_is_tag(tag, "skew");
}

// Write the matrix of a transform, as assimp makes it. A row of Collada's matrix is a row of ours.
static void find_matrix(const struct transform *transform, double m[16])
{
    const double *const n = transform->numbers;
    for (int i = 0; i < 16; i++) {
        m[i] = transform->kind == MATRIX ? n[i % 4 * 4 + i / 4] : i % 5 == 0;
    }
    for (int c = 0; c < 3; c++) {
        m[12 + c] = transform->kind == TRANSLATE ? n[c] : m[12 + c];
        m[5 * c] = transform->kind == SCALE ? n[c] : m[5 * c];
    }
    if (transform->kind == ROTATE) {
        double s, c;
        scene_sin_cos_degrees(n[3], &s, &c);
        for (int column = 0; column < 3; column++) {
            for (int row = 0; row < 3; row++) {
                m[4 * column + row] = n[row] * n[column] * (1 - c) + (row == column ? c : 0);
            }
            const int next = (column + 1) % 3, last = (column + 2) % 3;
            m[4 * column + next] += n[last] * s;
            m[4 * column + last] -= n[next] * s;
        }
    }
}

static bool is_affine(const struct transform *transform)
{
    const double *const last = transform->numbers + 12;
    return transform->kind != MATRIX || (last[0] == 0 && last[1] == 0 && last[2] == 0 && last[3] == 1);
}

static bool is_narrow(const double matrix[16])
{
    bool is_narrow = true;
    for (int i = 0; i < 16; i++) {
        is_narrow = is_narrow && (double)(float)matrix[i] == matrix[i];
    }
    return is_narrow;
}

// Find the matrix of a node. Return false if assimp's floats may have all of it.
static bool find_product(const struct transform *transforms, size_t count, double product[16])
{
    double matrix[16];
    bool is_wide = false, is_good = count > 0;
    find_matrix(&(struct transform){.kind = OTHER}, product);
    for (size_t i = 0; i < count && is_good; i++) {
        is_good = transforms[i].kind != OTHER && is_affine(&transforms[i]);
        find_matrix(&transforms[i], matrix);
        is_wide =
            is_wide || transforms[i].kind == ROTATE || scene_assimp_is_way(matrix + 12) || !is_narrow(matrix);
        scene_import_multiply_exact(product, matrix, product);
    }
    for (int i = 0; i < 16; i++) {
        is_good = is_good && product[i] < 1e30 && product[i] > -1e30;
    }
    return is_wide && is_good;
}

// Edits ---------------------------------------------------------------------------------------------

static void replace(struct nodes *nodes, const char *from, const char *to, const char *text)
{
    scene_edits_add_string(nodes->import, nodes->edits, (size_t)(from - nodes->start), (size_t)(to - from),
                           text);
}

// Put three numbers in the place of a transform's translation.
static void set_translation(struct nodes *nodes, const struct transform *transform, const double numbers[3])
{
    for (int c = 0; c < 3; c++) {
        char text[32];
        const int place = transform->kind == MATRIX ? 4 * c + 3 : c;
        scene_assimp_write_number(text, numbers[c]);
        replace(nodes, transform->ends[place][0], transform->ends[place][1], text);
    }
}

static void mark_node(struct nodes *nodes, const struct transform *transforms, size_t count,
                      const double matrix[16])
{
    static const double zeros[3] = {0, 0, 0};
    double mark[3];
    scene_assimp_mark_matrix(nodes->import, nodes->exact, SCENE_ASSIMP_NODES, matrix, mark);
    const bool is_first = transforms[0].kind == TRANSLATE || transforms[0].kind == MATRIX;
    if (!is_first) {
        char text[160] = "<translate>";
        for (int c = 0; c < 3; c++) {
            scene_assimp_write_number(text + strlen(text), mark[c]);
            strcat(text, c < 2 ? " " : "</translate>");
        }
        replace(nodes, transforms[0].tag, transforms[0].tag, text);
    }
    for (size_t i = 0; i < count; i++) {
        if (transforms[i].kind == TRANSLATE || transforms[i].kind == MATRIX) {
            set_translation(nodes, &transforms[i], i == 0 ? mark : zeros);
        }
    }
}

// Nodes ---------------------------------------------------------------------------------------------

static bool is_moved(const struct nodes *nodes, struct scene_collada_value id)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = scene_hash_bytes(id.text, id.length);
    uint32_t index =
        nodes->moved.count == 0 || id.length == 0 ? UINT32_MAX : scene_hash_next(&nodes->moved, hash, &place);
    while (index != UINT32_MAX && (nodes->ids[index].length != id.length ||
                                   memcmp(nodes->ids[index].text, id.text, id.length) != 0)) {
        index = scene_hash_next(&nodes->moved, hash, &place);
    }
    return index != UINT32_MAX;
}

// Keep the id of the node that a channel of an animation moves: what comes before the slash of its target.
static void read_channel(struct nodes *nodes, char *tag, char *close)
{
    struct scene_collada_value id = scene_collada_attribute(tag, close, "target");
    const char *const slash = id.length == 0 ? NULL : memchr(id.text, '/', id.length);
    if (slash == NULL) {
        return;
    }
    id.length = (size_t)(slash - id.text);
    scene_import_reserve(nodes->import, &nodes->ids, &nodes->id_capacity, nodes->id_count + 1,
                         sizeof *nodes->ids);
    nodes->ids[nodes->id_count] = id;
    scene_hash_add(nodes->import, &nodes->moved, scene_hash_bytes(id.text, id.length),
                   (uint32_t)nodes->id_count++);
}

static void find_moved(struct nodes *nodes, char *text)
{
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, nodes->end);
        if (close == NULL) {
            return;
        }
        if (scene_collada_is_tag(c, "channel")) {
            read_channel(nodes, c, close);
        }
        c = close;
    }
}

static void open_node(struct nodes *nodes, char *tag, char *close, size_t depth)
{
    scene_import_reserve(nodes->import, &nodes->open, &nodes->open_capacity, nodes->open_count + 1,
                         sizeof *nodes->open);
    nodes->open[nodes->open_count++] =
        (struct node){scene_collada_attribute(tag, close, "id"), depth, nodes->count};
}

static void close_node(struct nodes *nodes)
{
    const struct node *const node = &nodes->open[--nodes->open_count];
    const struct transform *const transforms = nodes->transforms + node->first;
    const size_t count = nodes->count - node->first;
    double matrix[16];
    if (find_product(transforms, count, matrix) && !is_moved(nodes, node->id)) {
        mark_node(nodes, transforms, count, matrix);
    }
    nodes->count = node->first;
}

static void read_transform(struct nodes *nodes, char *tag, char *close)
{
    const struct node *const node = &nodes->open[nodes->open_count - 1];
    struct transform transform = {
        .kind = kind_of(tag), .tag = tag, .text = close + 1, .end = strchr(close, '<')};
    const size_t wanted = transform.kind < OTHER ? kinds[transform.kind].numbers : 0;
    const char *text = transform.text;
    const bool is_good =
        close[-1] != '/' && transform.end != NULL && transform.end[1] == '/' && wanted > 0 &&
        scene_collada_numbers(&text, transform.end, transform.numbers, transform.ends, wanted) == wanted;
    transform.kind = is_good ? transform.kind : OTHER;
    if (nodes->count - node->first < MOST_TRANSFORMS) {
        scene_import_reserve(nodes->import, &nodes->transforms, &nodes->capacity, nodes->count + 1,
                             sizeof *nodes->transforms);
        nodes->transforms[nodes->count++] = transform;
    } else {
        nodes->transforms[nodes->count - 1].kind = OTHER; // too many, which nobody writes
    }
}

static void read_nodes(struct nodes *nodes, char *text)
{
    size_t depth = 0;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, nodes->end);
        if (close == NULL) {
            return;
        }
        const bool is_start = c[1] != '/' && c[1] != '!' && c[1] != '?',
                   is_empty = is_start && close[-1] == '/';
        const bool is_child = nodes->open_count > 0 && nodes->open[nodes->open_count - 1].depth == depth;
        if (c[1] == '/') {
            if (is_child && scene_collada_is_end(c, "node")) {
                close_node(nodes);
            }
            depth -= depth > 0;
        } else if (is_start && is_child && is_transform(c)) {
            read_transform(nodes, c, close);
        } else if (is_start && !is_empty && scene_collada_is_tag(c, "node")) {
            if (nodes->open_count == DEEPEST) {
                return;
            }
            open_node(nodes, c, close, depth + 1);
        }
        depth += is_start && !is_empty;
        c = close;
    }
}

void scene_collada_edit_nodes(struct scene_import *import, struct scene_assimp_exact *exact, char *text,
                              size_t size, struct scene_edits *edits)
{
    struct nodes nodes = {
        .import = import, .exact = exact, .start = text, .end = text + size, .edits = edits};
    if (exact->moved.count > 0) {
        find_moved(&nodes, text);
    }
    read_nodes(&nodes, text);
    free(nodes.open);
    free(nodes.transforms);
    free(nodes.ids);
    free(nodes.moved.entries);
}
