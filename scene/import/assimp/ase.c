// SPDX-License-Identifier: MIT
// The indices of an ASE, the text of 3ds Max. assimp 5.2.5 reads beside its arrays where a face refers to a vertex, a
// texture coordinate or a colour that is not there, or to none where the mesh has some, and where a face is missing.
#include "assimp.h"
#include "import/builder/text_lines.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { VERTICES, COORDINATES, COLORS, LISTS };

// The numbers of the faces that are there: those whose marks are that of the mesh.
struct numbers {
    uint32_t *marks, mesh;
    size_t capacity, most; // there are fewer faces than bytes in the file
};

// What faces refer to: how many there are, the greatest index of a face, and how many faces are said to be and are.
struct list {
    const char *name;
    struct numbers numbers;
    double count, worst, face;
    double said, faces;
    unsigned line;
    bool has_count, has_said;
    bool is_begun; // assimp reads faces in their list alone
};

// Refuse the file if a face refers to what is not there, or is not there itself. `faces` are those that the mesh should
// have, by its list of vertices.
static void check(struct scene_import *import, const struct list *list, bool is_vertices, double faces)
{
    if (list->line > 0 && !(list->worst >= 0 && list->worst < list->count)) {
        scene_import_fail(import, "line %u: face %.0f refers to %s %.0f; the mesh has %.0f, counted from 0",
                          list->line, list->face, list->name, list->worst, list->count);
    }
    if (is_vertices && list->faces < faces) {
        scene_import_fail(import, "a mesh should have %.0f faces and has %.0f", faces, list->faces);
    }
    if (!is_vertices && list->count > 0 && list->faces < faces) {
        scene_import_fail(import, "a mesh has %.0f faces, of which %.0f say their %ss", faces, list->faces,
                          list->name);
    }
}

// Look at what a mesh has, and begin with another one.
static void end_mesh(struct scene_import *import, struct list lists[LISTS], int first, int last)
{
    const double faces = lists[VERTICES].said;
    for (int i = last; i >= first; i--) {
        check(import, &lists[i], i == VERTICES, faces);
        lists[i] = (struct list){.name = lists[i].name, .numbers = lists[i].numbers};
        lists[i].numbers.mesh++;
    }
}

// Take a face for one that is there, or for none. assimp leaves out one whose number is not below that of all faces.
static void mark_face(struct scene_import *import, struct list *list, uint32_t face, bool is_there)
{
    struct numbers *const numbers = &list->numbers;
    const size_t before = numbers->capacity;
    if (!(face < list->said) || face >= numbers->most) {
        return;
    }
    scene_import_reserve(import, &numbers->marks, &numbers->capacity, (size_t)face + 1,
                         sizeof *numbers->marks);
    memset(numbers->marks + before, 0, (numbers->capacity - before) * sizeof *numbers->marks);
    if (is_there != (numbers->marks[face] == numbers->mesh)) {
        list->faces += is_there ? 1 : -1;
    }
    numbers->marks[face] = is_there ? numbers->mesh : 0;
}

static bool is_worse(const struct list *list, double index)
{
    const bool is_good = list->worst >= 0;
    return is_good && (index > list->worst || !(index >= 0) || list->line == 0);
}

// Return the next letter of a line, or 0 at its end.
static char next_letter(struct scene_line *line)
{
    while (line->cursor < line->end && (*line->cursor == ' ' || *line->cursor == '\t')) {
        line->cursor++;
    }
    return line->cursor < line->end ? *line->cursor : 0;
}

// Pass a letter, in any case, if it is the next. Return false if it is not.
static bool pass_letter(struct scene_line *line, char letter)
{
    const bool is_next = toupper((unsigned char)next_letter(line)) == letter;
    line->cursor += is_next;
    return is_next;
}

// Read the next digits as assimp does, to 32 bits. Return false if there are none.
static bool read_digits(struct scene_line *line, uint32_t *number)
{
    const bool has_some = isdigit((unsigned char)next_letter(line));
    *number = 0;
    while (line->cursor < line->end && isdigit((unsigned char)*line->cursor)) {
        *number = 10 * *number + (uint32_t)(*line->cursor++ - '0');
    }
    return has_some;
}

// Read what a corner refers to. Before it stands A:, B: or C: where faces name their corners. Return false if it is not
// there, or if the corner is one of `named`, to which it is added.
static bool read_corner(struct scene_line *line, bool has_names, unsigned *named, double *index)
{
    uint32_t number;
    if (has_names) {
        const int name = pass_letter(line, 'A')   ? 0
                         : pass_letter(line, 'B') ? 1
                         : pass_letter(line, 'C') ? 2
                                                  : 3;
        if (name == 3 || (*named >> name & 1) != 0 || !pass_letter(line, ':')) {
            return false;
        }
        *named |= 1u << name;
    }
    const bool is_negative = pass_letter(line, '-'), is_there = read_digits(line, &number);
    *index = is_negative ? -(double)number : number;
    return is_there;
}

// Read the corners of a face: its number, and three numbers behind it. assimp takes what is in its memory for corners
// that are not there, so a face without them is none.
static void read_face(struct scene_import *import, struct list *list, struct scene_line line, unsigned number,
                      bool has_names)
{
    uint32_t face;
    double index;
    unsigned named = 0;
    bool is_there = read_digits(&line, &face);
    pass_letter(&line, ':');
    for (int corner = 0; corner < 3 && is_there; corner++) {
        is_there = read_corner(&line, has_names, &named, &index);
        if (is_there && is_worse(list, index)) {
            list->worst = index;
            list->face = face;
            list->line = number;
        }
    }
    mark_face(import, list, face, is_there);
}

// Read a number of a mesh. assimp makes room by the one that stands before the list, and one more might be another.
static void read_count(struct scene_import *import, const struct list *list, struct scene_line line,
                       unsigned number, double *count, bool *has_count)
{
    double value = 0;
    if (!scene_text_double(&line, &value)) {
        return;
    }
    if (*has_count && value != *count) {
        scene_import_fail(import, "line %u: a mesh says two numbers of its %s list", number, list->name);
    }
    *count = value;
    *has_count = true;
}

static void read_line(struct scene_import *import, struct list lists[LISTS], struct scene_word word,
                      struct scene_line line, unsigned number)
{
    static const char *const counts[LISTS] = {"*MESH_NUMVERTEX", "*MESH_NUMTVERTEX", "*MESH_NUMCVERTEX"};
    static const char *const said[LISTS] = {"*MESH_NUMFACES", "*MESH_NUMTVFACES", "*MESH_NUMCVFACES"};
    static const char *const begins[LISTS] = {"*MESH_FACE_LIST", "*MESH_TFACELIST", "*MESH_CFACELIST"};
    static const char *const faces[LISTS] = {"*MESH_FACE", "*MESH_TFACE", "*MESH_CFACE"};
    const bool is_mesh = scene_word_is(word, "*MESH");
    if (is_mesh) {
        end_mesh(import, lists, VERTICES, COLORS);
    } else if (scene_word_is(word, "*MESH_MAPPINGCHANNEL")) {
        end_mesh(import, lists, COORDINATES, COORDINATES);
    }
    for (int i = 0; i < LISTS; i++) {
        if (scene_word_is(word, counts[i])) {
            read_count(import, &lists[i], line, number, &lists[i].count, &lists[i].has_count);
        } else if (scene_word_is(word, said[i])) {
            read_count(import, &lists[i], line, number, &lists[i].said, &lists[i].has_said);
        } else if (scene_word_is(word, begins[i])) {
            lists[i].is_begun = true;
        } else if (lists[i].is_begun && scene_word_is(word, faces[i])) {
            read_face(import, &lists[i], line, number, i == VERTICES);
        }
    }
}

// Return true if assimp takes a file for an ASE: by its ending, or by what stands near its beginning.
static bool is_ase(const struct scene_import *import, const char *bytes, size_t size)
{
    enum { LOOKED_AT = 512 };
    static const char head[] = "*3dsmax_asciiexport";
    bool is = strcasecmp(import->ending, "ase") == 0 || strcasecmp(import->ending, "ask") == 0;
    for (size_t i = 0; !is && i < LOOKED_AT && i + sizeof head <= size; i++) {
        is = strncasecmp(bytes + i, head, sizeof head - 1) == 0;
    }
    return is;
}

// Read the parts of a line that begin with asterisks: assimp finds these anywhere.
static void read_parts(struct scene_import *import, struct list lists[LISTS], struct scene_line line,
                       unsigned number)
{
    struct scene_word word;
    const char *star = memchr(line.cursor, '*', (size_t)(line.end - line.cursor));
    while (star != NULL) {
        const char *const next = memchr(star + 1, '*', (size_t)(line.end - star - 1));
        struct scene_line part = {star, next == NULL ? line.end : next};
        if (scene_text_word(&part, &word)) {
            read_line(import, lists, word, part, number);
        }
        star = next;
    }
}

void scene_assimp_look_at_ase(struct scene_import *import, char *bytes, size_t size)
{
    if (!is_ase(import, bytes, size)) {
        return;
    }
    struct scene_text text = scene_text_open(import, bytes, size);
    struct list lists[LISTS] = {{.name = "vertex"}, {.name = "texture coordinate"}, {.name = "colour"}};
    struct scene_line line;
    for (int i = 0; i < LISTS; i++) {
        lists[i].numbers = (struct numbers){.mesh = 1, .most = size};
    }
    while (scene_text_line(&text, false, &line)) {
        read_parts(import, lists, line, text.line);
    }
    end_mesh(import, lists, VERTICES, COLORS);
    for (int i = 0; i < LISTS; i++) {
        free(lists[i].numbers.marks);
    }
}
