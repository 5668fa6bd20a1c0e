// SPDX-License-Identifier: MIT
// The header of a PLY, which says what its data are.
#include <math.h>

#include "ply.h"

static enum type parse_type(struct scene_word word)
{
    static const struct {
        const char *name;
        enum type type;
    } names[] = {
        {"char", TYPE_INT8},   {"uchar", TYPE_UINT8},   {"short", TYPE_INT16},   {"ushort", TYPE_UINT16},
        {"int", TYPE_INT32},   {"uint", TYPE_UINT32},   {"float", TYPE_FLOAT},   {"double", TYPE_DOUBLE},
        {"int8", TYPE_INT8},   {"uint8", TYPE_UINT8},   {"int16", TYPE_INT16},   {"uint16", TYPE_UINT16},
        {"int32", TYPE_INT32}, {"uint32", TYPE_UINT32}, {"float32", TYPE_FLOAT}, {"float64", TYPE_DOUBLE},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (scene_word_is(word, names[i].name)) {
            return names[i].type;
        }
    }
    return TYPE_NONE;
}

_Noreturn static void refuse_header(struct ply *ply, unsigned line, const char *problem)
{
    scene_import_fail(ply->import, "line %u of the PLY header: %s", line, problem);
}

static void parse_element(struct ply *ply, struct scene_line line, unsigned number)
{
    struct scene_word word;
    double count = 0;
    size_t length = 0;
    if (ply->element_count == MOST_ELEMENTS) {
        refuse_header(ply, number, "has too many elements");
    }
    struct element *element = &ply->elements[ply->element_count++];
    if (!scene_text_word(&line, &element->name) || !scene_text_word(&line, &word) ||
        !scene_word_number(word, &count, &length) || !(count >= 0 && count < UINT32_MAX) ||
        count != floor(count)) {
        refuse_header(ply, number, "an element needs a name and a count");
    }
    element->count = (int64_t)count;
    element->properties = scene_import_allocate(ply->import, MOST_PROPERTIES, sizeof *element->properties);
}

static void parse_property(struct ply *ply, struct scene_line line, unsigned number)
{
    struct scene_word word;
    struct property property = {.count_type = TYPE_NONE};
    if (ply->element_count == 0 || ply->elements[ply->element_count - 1].property_count == MOST_PROPERTIES) {
        refuse_header(ply, number, "has a property without an element, or too many");
    }
    struct element *element = &ply->elements[ply->element_count - 1];
    bool good = scene_text_word(&line, &word);
    const bool list = good && scene_word_is(word, "list");
    if (list) {
        good = scene_text_word(&line, &word);
        property.count_type = good ? parse_type(word) : TYPE_NONE;
        good = property.count_type != TYPE_NONE && property.count_type < TYPE_FLOAT &&
               scene_text_word(&line, &word);
    }
    property.type = good ? parse_type(word) : TYPE_NONE;
    if (property.type == TYPE_NONE || !scene_text_word(&line, &property.name)) {
        refuse_header(ply, number, "a property needs a type and a name");
    }
    element->properties[element->property_count++] = property;
}

static void parse_format(struct ply *ply, struct scene_line line, unsigned number)
{
    struct scene_word word;
    scene_text_word(&line, &word);
    if (scene_word_is(word, "ascii")) {
        ply->encoding = ASCII;
    } else if (scene_word_is(word, "binary_little_endian")) {
        ply->encoding = LITTLE_ENDIAN_BINARY;
    } else if (scene_word_is(word, "binary_big_endian")) {
        ply->encoding = BIG_ENDIAN_BINARY;
    } else {
        refuse_header(ply, number, "the format must be ascii, binary_little_endian or binary_big_endian");
    }
}

static void add_texture(struct ply *ply, struct scene_word name)
{
    if (ply->texture_count == MOST_TEXTURES) {
        scene_import_unsupported(ply->import, "textures after the first %d (PLY): not drawn", MOST_TEXTURES);
        return;
    }
    ply->textures[ply->texture_count++] = name;
}

void scene_ply_read_header(struct ply *ply)
{
    struct scene_text *text = &ply->text;
    struct scene_line line;
    struct scene_word word;
    while (scene_text_line(text, false, &line)) {
        if (!scene_text_word(&line, &word)) {
            continue;
        }
        if (scene_word_is(word, "end_header")) {
            return;
        }
        if (scene_word_is(word, "format")) {
            parse_format(ply, line, text->line);
        } else if (scene_word_is(word, "element")) {
            parse_element(ply, line, text->line);
        } else if (scene_word_is(word, "property")) {
            parse_property(ply, line, text->line);
        } else if (scene_word_is(word, "comment")) {
            if (scene_text_word(&line, &word) && scene_word_is(word, "TextureFile")) {
                add_texture(ply, scene_text_rest(line));
            }
        } // "ply", "obj_info" and words that exporters have invented say nothing
    }
    scene_import_fail(ply->import, "the PLY header has no end_header");
}

enum target scene_ply_target(const struct property *property)
{
    static const struct {
        const char *name;
        enum target target;
    } names[] = {
        {"x", X},
        {"y", Y},
        {"z", Z},
        {"nx", NX},
        {"ny", NY},
        {"nz", NZ},
        {"u", U},
        {"v", V},
        {"s", U},
        {"t", V},
        {"texture_u", U},
        {"texture_v", V},
        {"red", RED},
        {"green", GREEN},
        {"blue", BLUE},
        {"alpha", ALPHA},
        {"r", RED},
        {"g", GREEN},
        {"b", BLUE},
        {"a", ALPHA},
        {"diffuse_red", RED},
        {"diffuse_green", GREEN},
        {"diffuse_blue", BLUE},
        {"diffuse_alpha", ALPHA},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0] && property->count_type == TYPE_NONE; i++) {
        if (scene_word_is(property->name, names[i].name)) {
            return names[i].target;
        }
    }
    return UNUSED;
}
