// SPDX-License-Identifier: MIT
// Stereolithography, text and binary. assimp draws a file that is cut as if it were whole, and knows one of the two
// conventions for colours in the 16 bits that follow each facet of a binary file.
//
// Facets are flat where the file gives their normals. Many files write zeros instead. Their normals are made from the
// corners, and curved surfaces look smooth.
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/import.h"
#include "import/builder/numbers.h"
#include "import/builder/pieces.h"
#include "import/builder/phong.h"
#include "import/builder/place.h"
#include "import/builder/readers.h"
#include "import/builder/text_lines.h"
#include "import/builder/unknown_words.h"

enum { HEADER = 84, FACET = 50 }; // bytes of a binary file's head with its count, and bytes of a facet

// The facets of one solid.
struct solid {
    const char *name;
    double (*positions)[3];            // NULL if the file is binary
    float (*floats)[3];                // NULL if the file is text
    float (*normals)[3], (*colors)[4]; // for each corner, as positions; colors may be NULL
    size_t corners, position_capacity, normal_capacity;
    bool has_normals; // at least one facet has a normal
};

static bool is_normal(const float v[3])
{
    const float square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return square > 1e-12f && square < 1e12f; // false for NaN too
}

// Set the normal of a triangle. It is (0, 0, 1) where the triangle has no area. Return true unless the triangle is so
// narrow that rounding of its corners may turn it.
static bool find_normal(const double corners[3][3], float normal[3])
{
    double along[2][3], cross[3], square = 0.0, lengths = 0.0;
    for (int c = 0; c < 3; c++) {
        along[0][c] = corners[1][c] - corners[0][c];
        along[1][c] = corners[2][c] - corners[0][c];
    }
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        cross[c] = along[0][d] * along[1][e] - along[0][e] * along[1][d];
        square += cross[c] * cross[c];
        lengths += along[0][c] * along[0][c] + along[1][c] * along[1][c];
    }
    const bool has_area = square > 0.0 && square < 1e300;
    for (int c = 0; c < 3; c++) {
        normal[c] = has_area ? (float)(cross[c] / __builtin_sqrt(square)) : c == 2 ? 1.0f : 0.0f;
    }
    return has_area && square > 1e-8 * lengths * lengths;
}

// Keep the normal of a facet for its three corners, which are there. Programs write zeros for facets without an area.
static void set_normal(struct solid *solid, size_t first, const float given[3])
{
    const bool good = is_normal(given);
    solid->has_normals = solid->has_normals || good;
    for (size_t k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) {
            solid->normals[first + k][c] = good ? given[c] : 0;
        }
    }
}

// Return true if a normal is more than 60 degrees from both sides of the plane whose normal is `plane`.
static bool leans(const float normal[3], const float plane[3])
{
    const float dot = normal[0] * plane[0] + normal[1] * plane[1] + normal[2] * plane[2];
    const float square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    return 4 * dot * dot < square;
}

// Make the normals of the corners that the file does not give, and those that cannot be their facet's: programs turn a
// model and leave its normals.
static void complete_normals(struct scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i += 3) {
        float plane[3];
        double corners[3][3];
        for (uint32_t k = 0; k < 9; k++) {
            const uint32_t vertex = i + k / 3;
            corners[k / 3][k % 3] =
                mesh->exact != NULL ? mesh->exact[vertex][k % 3] : (double)mesh->positions[vertex][k % 3];
        }
        const bool is_sure = find_normal((const double(*)[3])corners, plane);
        if (!is_normal(mesh->normals[i]) || (is_sure && leans(mesh->normals[i], plane))) {
            memcpy(mesh->normals[i], plane, sizeof plane);
            memcpy(mesh->normals[i + 1], mesh->normals[i], sizeof mesh->normals[i]);
            memcpy(mesh->normals[i + 2], mesh->normals[i], sizeof mesh->normals[i]);
        }
    }
}

static void settle(struct scene_import *import, struct solid *solid, struct scene_mesh *mesh)
{
    double origin[3] = {0, 0, 0};
    if (solid->floats != NULL &&
        scene_import_stay_floats(import, (const float(*)[3])solid->floats, solid->corners)) {
        mesh->positions = solid->floats;
    } else {
        double(*const points)[3] = solid->floats != NULL
                                       ? scene_import_widen(import, solid->floats, solid->corners)
                                       : solid->positions;
        scene_import_settle_mesh(import, mesh, points, origin);
    }
    scene_import_place_mesh(import, origin);
}

static void add_solid(struct scene_import *import, struct solid *solid)
{
    if (solid->corners > UINT32_MAX) {
        scene_import_fail(import, "has too many facets");
    }
    struct scene_phong phong = scene_phong_default();
    phong.colored = solid->colors != NULL;
    struct scene_mesh *mesh = scene_import_add_mesh(import);
    mesh->name = solid->name;
    mesh->vertex_count = mesh->index_count = (uint32_t)solid->corners;
    mesh->indices = scene_import_allocate_any(import, solid->corners, sizeof *mesh->indices);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = i;
    }
    settle(import, solid, mesh);
    mesh->normals = solid->has_normals ? solid->normals : NULL;
    mesh->colors = solid->colors;
    if (solid->has_normals) {
        complete_normals(mesh);
    }
    mesh->material = scene_phong_add(import, &phong);
    struct scene_instance *instance = scene_import_add_instance(import);
    instance->name = solid->name;
    instance->mesh = import->model.mesh_count - 1;
    instance->object = import->model.instance_count;
    scene_import_identity(instance->world);
    scene_import_complete_mesh(import, instance->mesh, SCENE_IMPORT_SMOOTH, solid->corners > 3);
}

// Binary --------------------------------------------------------------------------------------------

static uint32_t read_32(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static const unsigned char *facet_of(const unsigned char *bytes, size_t facet)
{
    return bytes + HEADER + facet * FACET;
}

static void read_vector(const unsigned char *bytes, float vector[3])
{
    for (int c = 0; c < 3; c++) {
        const uint32_t word = read_32(bytes + 4 * c);
        memcpy(&vector[c], &word, sizeof word);
    }
}

// What the 16 bits after a facet mean. They mean nothing unless a facet says that its colour is valid (VisCAM,
// SolidView), or the head names the colour of the other facets (Materialise Magics). MeshLab writes the head and the
// order of Magics, and always one grey; its highest bit says, as that of VisCAM, that a colour is valid. Autodesk's
// programs write the words of Magics, but that colour in the head of some files alone.
struct palette {
    bool colored;
    bool begins_with_red;
    bool is_bare;   // a black facet has no colour
    unsigned valid; // the highest bit of a facet that has a colour
    float common[4];
};

static bool is_head_of_meshlab(const unsigned char *bytes)
{
    static const char head[] = "COLOR=\x7f\x7f\x7f MATERIAL=\x7f\x7f\x7f \x7f\x7f\x7f \x7f\x7f\x7f ";
    return memcmp(bytes, head, sizeof head - 1) == 0;
}

// Tell of what the head of Materialise Magics says beside its colour.
static void tell_of_head(struct scene_import *import, const unsigned char *bytes)
{
    static const char color[] = "COLOR=", material[] = "MATERIAL=";
    if (is_head_of_meshlab(bytes)) {
        return;
    }
    for (size_t i = 0; i + sizeof material <= 80; i++) {
        const unsigned char alpha = bytes[i + sizeof color - 1 + 3];
        if (memcmp(bytes + i, material, sizeof material - 1) == 0) {
            scene_import_unsupported(import,
                                     "the material in its head (STL): its colours of facets alone are drawn");
        }
        if (memcmp(bytes + i, color, sizeof color - 1) == 0 && alpha > 0 && alpha < 255) {
            scene_import_unsupported(import, "the translucency in its head (STL): drawn opaque");
        }
    }
}

static unsigned read_word(const unsigned char *bytes, size_t facet)
{
    const unsigned char *const word = facet_of(bytes, facet) + 48;
    return word[0] | (unsigned)word[1] << 8;
}

// What the facets of a file have.
struct survey {
    unsigned words;  // bits that are set in the word of any facet
    bool has_normal; // at least one facet has a normal
};

static struct survey survey_facets(const unsigned char *bytes, size_t facets)
{
    struct survey survey = {.words = 0};
    for (size_t i = 0; i < facets; i++) {
        survey.words |= read_word(bytes, i);
        if (!survey.has_normal) {
            float normal[3];
            read_vector(facet_of(bytes, i), normal);
            survey.has_normal = is_normal(normal);
        }
    }
    return survey;
}

static bool is_head_of_autodesk(const unsigned char *bytes)
{
    static const char head[] = "STLB ATF ";
    return memcmp(bytes, head, sizeof head - 1) == 0;
}

// Take the head of Magics, if it is there and the facets have words. Words that are all 0 would be a black model.
static void take_head(struct palette *palette, const unsigned char *bytes, bool has_words)
{
    const char key[] = "COLOR=";
    for (int i = 0; i + 10 <= 80 && !palette->colored; i++) {
        palette->colored = memcmp(bytes + i, key, strlen(key)) == 0;
        for (int c = 0; c < 3 && palette->colored; c++) {
            palette->common[c] = scene_import_from_srgb((float)bytes[i + 6 + c] / 255);
        }
    }
    palette->begins_with_red = palette->colored || is_head_of_autodesk(bytes);
    palette->valid = palette->begins_with_red && has_words ? 0 : 0x8000;
}

// Return true for a file of Meshmixer that nobody has painted. Meshmixer writes all facets white, and those with which
// it has filled a hole black.
static bool is_unpainted_meshmixer(const unsigned char *bytes, size_t facets)
{
    static const char head[] = "MESHMIXER-STL-BINARY-FORMAT";
    bool is_unpainted = memcmp(bytes, head, sizeof head - 1) == 0, has_white = false;
    for (size_t i = 0; i < facets && is_unpainted; i++) {
        const unsigned word = read_word(bytes, i);
        has_white = has_white || word == 0xffff;
        is_unpainted = word == 0xffff || word == 0x8000;
    }
    return is_unpainted && has_white;
}

static struct palette find_palette(struct scene_import *import, const unsigned char *bytes, size_t facets,
                                   unsigned words)
{
    // Facets without a colour take the colour of a model that has none.
    struct palette palette = {.valid = 0x8000, .common = {0.6f, 0.6f, 0.6f, 1}};
    if (is_unpainted_meshmixer(bytes, facets)) {
        return (struct palette){.colored = true, .is_bare = true, .valid = 0x8000, .common = {1, 1, 1, 1}};
    }
    palette.begins_with_red = is_head_of_meshlab(bytes);
    if (!palette.begins_with_red) {
        take_head(&palette, bytes, words != 0);
    }
    const unsigned bits_of_color = palette.valid == 0 ? 0x7fff : 0x8000;
    palette.colored = palette.colored || (words & bits_of_color) != 0;
    if (words != 0 && !palette.colored && palette.valid != 0) {
        scene_import_unsupported(import, "attributes of facets that are no colours (STL): not drawn");
    }
    return palette;
}

// Read a colour, which has five bits for each of red, green and blue. Magics begins with red, other programs end
// with it.
static void read_color(const struct palette *palette, unsigned word, float color[4])
{
    const bool own = (word & 0x8000) == palette->valid && !(palette->is_bare && word == 0x8000);
    memcpy(color, palette->common, sizeof palette->common);
    for (int c = 0; c < 3 && own; c++) {
        const unsigned bits = word >> (palette->begins_with_red ? 5 * c : 10 - 5 * c) & 31;
        color[c] = scene_import_from_srgb((float)bits / 31);
    }
}

// Return how many facets there are. The file says their number, but a writer that cannot go back leaves 0 or −1 there.
static size_t count_facets(struct scene_import *import, const unsigned char *bytes, size_t size)
{
    const uint32_t said = read_32(bytes + 80);
    const size_t whole = (size - HEADER) / FACET, rest = (size - HEADER) % FACET;
    if ((said == 0 || said == UINT32_MAX) && whole > 0 && rest == 0) {
        scene_import_warn(import, "says that it has %u facets; the %zu that it has are drawn", said, whole);
        return whole;
    }
    if (said > whole) {
        scene_import_fail(import, "is cut: it ends after %zu of %u facets", whole, said);
    }
    if (size > HEADER + (size_t)said * FACET) {
        scene_import_warn(import, "%zu bytes after its last facet are ignored",
                          size - HEADER - (size_t)said * FACET);
    }
    return said;
}

static struct solid read_binary(struct scene_import *import, const unsigned char *bytes, size_t size)
{
    if (size < HEADER) {
        scene_import_fail(import, "is cut: it has %zu bytes, and the head of a binary STL has %d", size,
                          HEADER);
    }
    const size_t count = count_facets(import, bytes, size);
    const struct survey survey = survey_facets(bytes, count);
    const struct palette palette = find_palette(import, bytes, count, survey.words);
    tell_of_head(import, bytes);
    struct solid solid = {.name = "", .corners = 3 * count};
    solid.floats = scene_import_allocate_any(import, solid.corners, sizeof *solid.floats);
    if (survey.has_normal) { // many programs write zeros alone
        solid.normals = scene_import_allocate_any(import, solid.corners, sizeof *solid.normals);
    }
    if (palette.colored) {
        solid.colors = scene_import_allocate_any(import, solid.corners, sizeof *solid.colors);
    }
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < 3; k++) {
            read_vector(facet_of(bytes, i) + 12 + 12 * k, solid.floats[3 * i + k]);
        }
        if (solid.normals != NULL) {
            float normal[3];
            read_vector(facet_of(bytes, i), normal);
            set_normal(&solid, 3 * i, normal);
        }
        for (size_t k = 0; k < 3 && palette.colored; k++) {
            read_color(&palette, read_word(bytes, i), solid.colors[3 * i + k]);
        }
    }
    return solid;
}

// Text ----------------------------------------------------------------------------------------------

struct reader {
    struct scene_import *import;
    struct scene_text text;
    struct solid solid;
    float normal[3];
    double corners[3][3];
    int corner_count; // corners of the facet that is open; a facet may have more than 3
    bool in_solid, in_facet;
    size_t facets;
    struct scene_unknown_words unknown;
};

static bool key_is(struct scene_word word, const char *key)
{
    return strlen(key) == word.length && strncasecmp(word.start, key, word.length) == 0;
}

_Noreturn static void refuse(const struct reader *reader, const char *problem)
{
    scene_import_fail(reader->import, "line %u: %s", reader->text.line, problem);
}

static void add_facet(struct reader *reader)
{
    struct solid *solid = &reader->solid;
    const size_t first = solid->corners;
    scene_import_reserve(reader->import, &solid->positions, &solid->position_capacity, first + 3,
                         sizeof *solid->positions);
    scene_import_reserve(reader->import, &solid->normals, &solid->normal_capacity, first + 3,
                         sizeof *solid->normals);
    memcpy(solid->positions + first, reader->corners, sizeof reader->corners);
    set_normal(solid, first, reader->normal);
    solid->corners += 3;
}

// Read a corner. The fourth corner and each after it make a triangle with the first corner and the one before.
static void read_vertex(struct reader *reader, struct scene_line line)
{
    double position[3];
    if (scene_text_doubles(&line, position, 3) < 3) {
        refuse(reader, "a vertex needs three numbers");
    }
    if (reader->corner_count >= 3) {
        memcpy(reader->corners[1], reader->corners[2], sizeof position);
    }
    const int place = reader->corner_count < 3 ? reader->corner_count : 2;
    memcpy(reader->corners[place], position, sizeof position);
    if (++reader->corner_count >= 3) {
        add_facet(reader);
    }
}

static void end_solid(struct reader *reader)
{
    if (reader->solid.corners > 0) {
        add_solid(reader->import, &reader->solid);
    }
    reader->solid = (struct solid){.name = ""};
    reader->in_solid = false;
}

static void read_line(struct reader *reader, struct scene_word key, struct scene_line line)
{
    struct scene_word word;
    if (key_is(key, "vertex")) {
        if (!reader->in_facet) {
            refuse(reader, "a vertex stands outside of a facet");
        }
        read_vertex(reader, line);
    } else if (key_is(key, "facet")) {
        reader->in_facet = true;
        reader->corner_count = 0;
        memset(reader->normal, 0, sizeof reader->normal);
        if (scene_text_word(&line, &word) && key_is(word, "normal")) {
            scene_text_numbers(&line, reader->normal, 3);
        }
    } else if (key_is(key, "endfacet")) {
        if (reader->corner_count < 3) {
            refuse(reader, "a facet needs three vertices");
        }
        reader->in_facet = false;
        reader->facets++;
    } else if (key_is(key, "solid")) {
        end_solid(reader);
        reader->solid.name = scene_word_string(reader->import, scene_text_rest(line));
        reader->in_solid = true;
    } else if (key_is(key, "endsolid")) {
        end_solid(reader);
    } else if (key_is(key, "color")) {
        scene_import_unsupported(reader->import, "colours in text (STL): not drawn");
    } else if (!key_is(key, "outer") && !key_is(key, "endloop")) {
        scene_unknown_words_tell(reader->import, &reader->unknown, key);
    }
}

static void read_text(struct scene_import *import, char *bytes, size_t size)
{
    struct reader reader = {.import = import,
                            .text = scene_text_open(import, bytes, size),
                            .solid = {.name = ""},
                            .unknown = {.format = "STL"}};
    struct scene_line line;
    struct scene_word key;
    while (scene_text_line(&reader.text, false, &line)) {
        if (scene_text_word(&line, &key)) {
            read_line(&reader, key, line);
        }
    }
    if (reader.in_facet) {
        scene_import_fail(import, "is cut: it ends in facet %zu", reader.facets + 1);
    }
    if (reader.in_solid) {
        scene_import_warn(import, "has no \"endsolid\" after facet %zu: it may be cut", reader.facets);
    }
    end_solid(&reader);
    if (reader.facets == 0) {
        scene_import_fail(import, "is no STL model: it has no facets");
    }
}

// Return true if a line of a text begins with "solid". Marks of UTF-8 and blanks may stand before it.
static bool has_solid(const char *text, const char *end)
{
    text += scene_text_marks(text, (size_t)(end - text));
    bool found = false;
    while (text < end && *text != 0 && !found) {
        text += strspn(text, " \t\r\n");
        found = text < end && strncasecmp(text, "solid", 5) == 0;
        text += strcspn(text, "\r\n");
    }
    return found;
}

// Return true if the file is text. One of its first lines begins with "solid". So do heads of binary files, but these
// have the length that they say, or bytes that are no text.
static bool is_text(const char *bytes, size_t size)
{
    enum { LOOKED_AT = 512 };
    const size_t end = size < LOOKED_AT ? size : LOOKED_AT;
    if (size >= 4 && (memcmp(bytes, "\xff\xfes\0", 4) == 0 || memcmp(bytes, "\xfe\xff\0s", 4) == 0)) {
        return true; // UTF-16
    }
    if (!has_solid(bytes, bytes + end)) {
        return false;
    }
    if (size >= HEADER && size == HEADER + (uint64_t)FACET * read_32((const unsigned char *)bytes + 80)) {
        return false;
    }
    for (size_t i = 0; i < end; i++) {
        if (bytes[i] == 0) {
            return false;
        }
    }
    return true;
}

void scene_import_stl(struct scene_import *import)
{
    const char *problem = NULL;
    size_t size = 0;
    char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes == NULL) {
        scene_import_fail(import, "cannot be read: %s", problem);
    }
    import->model.format = "Stereolithography (STL)";
    // The format says nothing, but its models are for printers, whose z points up.
    import->model.up = SCENE_AXIS_Z;
    import->up_is_open = true;
    if (is_text(bytes, size)) {
        read_text(import, bytes, size);
        free(bytes);
        return;
    }
    struct solid solid = read_binary(import, (const unsigned char *)bytes, size);
    free(bytes); // its memory serves the mesh
    add_solid(import, &solid);
}
