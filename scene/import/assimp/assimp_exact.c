// SPDX-License-Identifier: MIT
#include "assimp_exact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "assimp.h"
#include "import/builder/origin.h"

// The first and the last number of a mark, and what the one between them counts from. They have 24 bits, as many as
// floats hold, so that no one writes them by chance, nor does an animation pass them.
static const double first_mark = 13421773, middle_mark = 1 << 23, last_mark = 11184811;
enum { MOST_PLACES = 1 << 23 };

// What begins the names, behind that of a model in an FBX, of the nodes that assimp makes of it.
static const char chain_tag[] = "_$AssimpFbx$_";

bool scene_assimp_is_way(const double numbers[3])
{
    bool is_way = false, is_usable = true;
    for (int c = 0; c < 3; c++) {
        is_usable = is_usable && fabs(numbers[c]) < 1e30; // false for NaN
        is_way = is_way || numbers[c] != 0;
    }
    return is_way && is_usable;
}

static bool has_hash(const struct scene_hash_table *table, uint32_t hash)
{
    size_t place = SIZE_MAX;
    return scene_hash_next(table, hash, &place) != UINT32_MAX;
}

// assimp puts numbers behind the names of nodes that would have one name, so that what comes before digits counts too.
void scene_assimp_keep_moved(struct scene_import *import, struct scene_assimp_exact *exact, const char *name)
{
    const char *const tail = strstr(name, chain_tag);
    size_t length = tail != NULL ? (size_t)(tail - name) : strlen(name);
    bool is_digit = true;
    while (is_digit) {
        const uint32_t hash = scene_hash_bytes(name, length);
        if (!has_hash(&exact->moved, hash)) {
            scene_hash_add(import, &exact->moved, hash, 0);
        }
        is_digit = length > 0 && name[length - 1] >= '0' && name[length - 1] <= '9';
        length -= is_digit;
    }
}

bool scene_assimp_may_move(const struct scene_assimp_exact *exact, const char *name, size_t length)
{
    return has_hash(&exact->moved, scene_hash_bytes(name, length));
}

bool scene_assimp_find_offset(struct scene_import *import, const double (*points)[3], size_t count,
                              double offset[3])
{
    const struct scene_import_spread spread = scene_import_spread_find(import, points, count);
    memcpy(offset, spread.middle, sizeof spread.middle);
    return spread.is_far;
}

static void mark(struct scene_import *import, struct scene_assimp_exact *exact,
                 const struct scene_assimp_marked *marked, double numbers[3])
{
    memcpy(numbers, marked->matrix + 12, 3 * sizeof *numbers);
    if (exact->place_count + 1 >= MOST_PLACES) {
        return;
    }
    scene_import_reserve(import, &exact->places, &exact->place_capacity, exact->place_count + 1,
                         sizeof *exact->places);
    exact->places[exact->place_count++] = *marked;
    numbers[0] = first_mark;
    numbers[1] = middle_mark + (double)exact->place_count;
    numbers[2] = last_mark;
}

void scene_assimp_mark_matrix(struct scene_import *import, struct scene_assimp_exact *exact,
                              enum scene_assimp_mark kind, const double matrix[16], double numbers[3])
{
    struct scene_assimp_marked marked = {.kind = kind};
    memcpy(marked.matrix, matrix, sizeof marked.matrix);
    mark(import, exact, &marked, numbers);
}

void scene_assimp_mark_way(struct scene_import *import, struct scene_assimp_exact *exact, const double way[3],
                           double numbers[3])
{
    struct scene_import_place place = scene_import_place_identity();
    memcpy(place.exact + 12, way, 3 * sizeof *way);
    scene_assimp_mark_matrix(import, exact, SCENE_ASSIMP_WAY, place.exact, numbers);
}

size_t scene_assimp_keep_offset(struct scene_import *import, struct scene_assimp_exact *exact,
                                const double offset[3])
{
    const size_t number = exact->offset_count++;
    scene_import_reserve(import, &exact->offsets, &exact->offset_capacity, number + 1,
                         sizeof *exact->offsets);
    exact->offsets[number] = (struct scene_assimp_offset){.offset = {offset[0], offset[1], offset[2]}};
    return number;
}

// Return the offset of a name. Return NULL if it has none.
static const struct scene_assimp_offset *find_name(const struct scene_assimp_exact *exact, const char *name,
                                                   size_t length)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = scene_hash_bytes(name, length);
    while (exact->names.count > 0) {
        const uint32_t index = scene_hash_next(&exact->names, hash, &place);
        const struct scene_assimp_offset *const found = index == UINT32_MAX ? NULL : &exact->offsets[index];
        if (found == NULL || (found->length == length && memcmp(found->name, name, length) == 0)) {
            return found;
        }
    }
    return NULL;
}

bool scene_assimp_name_offset(struct scene_import *import, struct scene_assimp_exact *exact, const char *name,
                              size_t length, const double offset[3])
{
    if (find_name(exact, name, length) != NULL) {
        return false;
    }
    char *const copy = scene_import_allocate(import, length, 1);
    memcpy(copy, name, length);
    const size_t number = scene_assimp_keep_offset(import, exact, offset);
    exact->offsets[number].name = copy;
    exact->offsets[number].length = length;
    scene_hash_add(import, &exact->names, scene_hash_bytes(name, length), (uint32_t)number);
    return true;
}

size_t scene_assimp_write_number(char text[32], double number)
{
    const int length = snprintf(text, 32, "%.9g", number);
    char *const comma = strchr(text, ','); // the point of some locales
    if (comma != NULL) {
        *comma = '.';
    }
    return (size_t)length;
}

void scene_assimp_edit_points(struct scene_import *import, struct scene_edits *edits, size_t at,
                              size_t length, char between, const double (*points)[3], size_t count,
                              const double offset[3])
{
    char *written = NULL;
    size_t capacity = 0, size = 0;
    for (size_t i = 0; i < 3 * count; i++) {
        scene_import_reserve(import, &written, &capacity, size + 33, 1);
        written[size] = between;
        size += i > 0;
        size += scene_assimp_write_number(written + size, points[i / 3][i % 3] - offset[i % 3]);
    }
    scene_edits_add(import, edits, (struct scene_edit){at, length, written, size});
}

// Return what a matrix has a mark of, and the sign of it: the inverse of a way has the mark turned around. Return NULL
// if there is no mark.
static const struct scene_assimp_marked *find_place(const struct scene_assimp_exact *exact,
                                                    const double matrix[16], double *sign)
{
    *sign = matrix[12] < 0 ? -1 : 1;
    const double number = *sign * matrix[13] - middle_mark;
    const bool is_mark = *sign * matrix[12] == first_mark && *sign * matrix[14] == last_mark && number >= 1 &&
                         number <= (double)exact->place_count;
    return is_mark ? &exact->places[(size_t)number - 1] : NULL;
}

static void set_floats(const struct aiMatrix4x4 *matrix, double floats[16])
{
    float m[16];
    scene_assimp_matrix(matrix, m);
    for (int i = 0; i < 16; i++) {
        floats[i] = (double)m[i];
    }
}

// Write the inverse of an affine matrix. That of one without a volume is the identity.
static void invert(const double m[16], double inverse[16])
{
    const double *const a = m, *const b = m + 4, *const c = m + 8;
    const double rows[3][3] = {
        {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]},
        {c[1] * a[2] - c[2] * a[1], c[2] * a[0] - c[0] * a[2], c[0] * a[1] - c[1] * a[0]},
        {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]},
    };
    const double volume = a[0] * rows[0][0] + a[1] * rows[0][1] + a[2] * rows[0][2];
    const bool has_volume = volume < 0 || volume > 0;
    for (int i = 0; i < 16; i++) {
        inverse[i] = i % 4 == 3 || i >= 12 || !has_volume ? i % 5 == 0 : rows[i % 4][i / 4] / volume;
    }
    for (int row = 0; row < 3 && has_volume; row++) {
        inverse[12 + row] = -(inverse[row] * m[12] + inverse[4 + row] * m[13] + inverse[8 + row] * m[14]);
    }
}

static bool is_inverse(const struct aiNode *node)
{
    const size_t length = strlen(node->mName.data), tail = strlen("Inverse");
    return length > tail && strcmp(node->mName.data + length - tail, "Inverse") == 0;
}

// Return true for a node that assimp makes of a turn or a factor of a model in an FBX. Another one of the nodes of the
// model has a mark, which stands for all: the first of them, but the last of those of an inverse.
static bool is_in_mark(const struct scene_assimp_exact *exact, const struct aiNode *node)
{
    const bool looks_down = is_inverse(node);
    const struct aiNode *other = node;
    while (exact->place_count > 0 && other != NULL && strstr(other->mName.data, chain_tag) != NULL &&
           is_inverse(other) == looks_down) {
        double sign, matrix[16];
        set_floats(&other->mTransformation, matrix);
        const struct scene_assimp_marked *const marked = find_place(exact, matrix, &sign);
        if (marked != NULL) {
            return other != node && marked->kind == SCENE_ASSIMP_NODES;
        }
        other = !looks_down ? other->mParent : other->mNumChildren == 1 ? other->mChildren[0] : NULL;
    }
    return false;
}

// Return the place of a matrix of assimp's. `has_mark` says whether a mark in it stood for more than its floats.
static struct scene_import_place unmark(const struct scene_assimp_exact *exact,
                                        const struct aiMatrix4x4 *matrix, bool *has_mark)
{
    float m[16];
    double sign;
    scene_assimp_matrix(matrix, m);
    struct scene_import_place place = scene_import_place_of(m);
    const struct scene_assimp_marked *const marked = find_place(exact, place.exact, &sign);
    if (marked != NULL && marked->kind == SCENE_ASSIMP_WAY) {
        for (int c = 0; c < 3; c++) {
            place.exact[12 + c] = sign * marked->matrix[12 + c];
        }
    } else if (marked != NULL && sign < 0) {
        invert(marked->matrix, place.exact);
    } else if (marked != NULL) {
        memcpy(place.exact, marked->matrix, sizeof place.exact);
    }
    for (int c = 0; c < 3 && marked != NULL; c++) {
        place.world[12 + c] = (float)place.exact[12 + c];
    }
    *has_mark = marked != NULL;
    return place;
}

struct scene_import_place scene_assimp_exact_place(const struct scene_assimp_exact *exact,
                                                   const struct aiNode *node)
{
    bool has_mark;
    struct scene_import_place place = unmark(exact, &node->mTransformation, &has_mark);
    if (!has_mark && is_in_mark(exact, node)) {
        const struct scene_import_place identity = scene_import_place_identity();
        memcpy(place.exact, identity.exact, sizeof place.exact);
    }
    for (int i = 0; i < 12 && node->mParent == NULL && exact->unit > 0; i++) {
        const double sign = place.world[i] < 0 ? -1 : 1;
        place.exact[i] =
            sign * place.exact[i] == (double)(float)exact->unit ? sign * exact->unit : place.exact[i];
    }
    return place;
}

struct scene_import_place scene_assimp_exact_bone(const struct scene_assimp_exact *exact,
                                                  const struct aiBone *bone)
{
    bool has_mark;
    return unmark(exact, &bone->mOffsetMatrix, &has_mark);
}

void scene_assimp_unmark_way(const struct scene_assimp_exact *exact, const struct aiNode *node, double way[3])
{
    double matrix[16], sign;
    set_floats(&node->mTransformation, matrix);
    const struct scene_assimp_marked *const marked = find_place(exact, matrix, &sign);
    for (int c = 0; c < 3 && marked != NULL; c++) {
        way[c] = way[c] == matrix[12 + c] ? sign * marked->matrix[12 + c] : way[c];
    }
}

struct scene_import_place scene_assimp_settled(const struct scene_assimp_exact *exact,
                                               struct scene_import_place place, const double offset[3])
{
    for (int i = 0; i < 12 && (exact->bytes != NULL || exact->place_count > 0); i++) {
        const double turn = (double)place.world[i];
        if (i % 4 < 3) {
            place.exact[12 + i % 4] += (place.exact[i] - turn) * offset[i / 4];
        }
        place.exact[i] = turn;
    }
    return place;
}

void scene_assimp_float_place(const struct scene_assimp_exact *exact, const struct aiNode *node,
                              double place[16])
{
    double sign;
    set_floats(&node->mTransformation, place);
    const struct scene_assimp_marked *const marked = find_place(exact, place, &sign);
    const bool is_rounded = exact->bytes == NULL || (exact->rounds_movements && marked != NULL &&
                                                     marked->kind == SCENE_ASSIMP_MATRIX);
    for (int c = 0; c < 3 && marked != NULL; c++) {
        place[12 + c] = is_rounded ? sign * marked->matrix[12 + c] : 0;
    }
}

// Find the number in the mark of a name, and what follows the mark. Return false if it has none.
static bool find_number(const struct scene_assimp_exact *exact, const char *name, const char **mark,
                        const char **end, size_t *number)
{
    static const char text[] = SCENE_ASSIMP_NAME_MARK;
    *mark = exact->bytes == NULL ? NULL : strstr(name, text);
    if (*mark == NULL) {
        return false;
    }
    char *after;
    *number = (size_t)strtoul(*mark + strlen(text), &after, 10);
    *end = after + strlen(text);
    return strncmp(after, text, strlen(text)) == 0 && *number < exact->offset_count;
}

const double *scene_assimp_exact_offset(const struct scene_assimp_exact *exact, const struct aiMesh *mesh)
{
    static const double none[3] = {0, 0, 0};
    const double *const others = exact->bytes == NULL ? none : exact->common;
    const char *const name = mesh->mName.data, *mark, *end;
    size_t number;
    if (find_number(exact, name, &mark, &end, &number)) {
        return exact->offsets[number].offset;
    }
    const struct scene_assimp_offset *const found = find_name(exact, name, strlen(name));
    return found == NULL ? others : found->offset;
}

const char *scene_assimp_exact_name(struct scene_import *import, const struct scene_assimp_exact *exact,
                                    const struct aiScene *scene, unsigned index)
{
    struct aiString name = scene->mMeshes[index]->mName;
    const char *mark, *end;
    size_t number;
    if (find_number(exact, name.data, &mark, &end, &number)) {
        const size_t before = (size_t)(mark - name.data);
        memmove(name.data + before, end, strlen(end) + 1);
        name.length = (ai_uint32)strlen(name.data);
        // assimp names a mesh that has no name by its node.
        const struct aiNode *const holder = name.length == 0 && scene->mRootNode != NULL
                                                ? scene_assimp_holder(scene->mRootNode, index)
                                                : NULL;
        name = holder != NULL ? holder->mName : name;
    }
    return scene_assimp_string(import, &name);
}

// Return true if bytes have the mark of a name already.
static bool has_mark(const char *bytes, size_t size)
{
    static const char mark[] = SCENE_ASSIMP_NAME_MARK;
    const size_t length = strlen(mark);
    const char *place = bytes, *const end = bytes + size;
    while (place != NULL && (size_t)(end - place) >= length && memcmp(place, mark, length) != 0) {
        place = memchr(place + 1, mark[0], (size_t)(end - place) - 1);
    }
    return place != NULL && (size_t)(end - place) >= length;
}

// Rewrite a file of another format than Collada, which is told by its ending.
static char *rewrite_other(struct scene_import *import, struct scene_assimp_exact *exact, size_t *size)
{
    const char *problem = NULL;
    const bool is_dxf = strcasecmp(import->ending, "dxf") == 0;
    const bool may_be_fbx = import->ending[0] == 0 || strcasecmp(import->ending, "fbx") == 0;
    char *bytes = is_dxf ? scene_assimp_dxf(import, size) : scene_assimp_fbx(import, size);
    if (bytes == NULL && may_be_fbx) {
        bytes = scene_import_read_file(import, import->model.path, size, &problem);
    }
    char *rewritten = NULL;
    if (bytes != NULL && is_dxf) {
        rewritten = scene_assimp_rewrite_dxf(import, exact, bytes, size);
    } else if (bytes != NULL && !has_mark(bytes, *size)) {
        rewritten = scene_assimp_rewrite_fbx(import, exact, bytes, size);
        rewritten = rewritten != NULL ? rewritten : scene_assimp_rewrite_fbx_text(import, exact, bytes, size);
    }
    free(bytes);
    return rewritten;
}

bool scene_assimp_rewrite(struct scene_import *import, struct scene_assimp_exact *exact)
{
    size_t size = 0;
    char *const collada = scene_assimp_collada(import, &size);
    char *const bytes = collada != NULL ? scene_assimp_rewrite_collada(import, exact, collada, &size)
                                        : rewrite_other(import, exact, &size);
    free(collada);
    exact->bytes = bytes;
    exact->size = size;
    return bytes != NULL;
}
