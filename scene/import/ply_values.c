// SPDX-License-Identifier: MIT
// The numbers of a PLY in its three encodings, and the colours among them.
#include <string.h>

#include "import/builder/stored_colors.h"
#include "ply_load.h"

size_t scene_ply_type_size(enum type type)
{
    static const size_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

_Noreturn static void end_of_file(struct ply *ply)
{
    const char *name = scene_word_string(ply->import, ply->element->name);
    scene_import_fail(ply->import, "is truncated: it ends in %s %lld of %lld", name, (long long)ply->row,
                      (long long)ply->element->count);
}

static double read_ascii(struct ply *ply)
{
    struct scene_word word;
    double value = 0;
    while (!scene_text_double(&ply->line, &value)) {
        if (scene_text_word(&ply->line, &word)) {
            scene_import_fail(ply->import, "line %u: \"%s\" is not a number", ply->text.line,
                              scene_word_string(ply->import, word));
        }
        if (!scene_text_line(&ply->text, false, &ply->line)) {
            end_of_file(ply);
        }
    }
    return value;
}

static double read_binary(struct ply *ply, enum type type)
{
    const size_t size = scene_ply_type_size(type);
    if ((size_t)(ply->end - ply->cursor) < size) {
        end_of_file(ply);
    }
    const double value = scene_ply_load(ply->cursor, type, ply->encoding == BIG_ENDIAN_BINARY);
    ply->cursor += size;
    return value;
}

double scene_ply_number(struct ply *ply, enum type type)
{
    return ply->encoding == ASCII ? read_ascii(ply) : read_binary(ply, type);
}

int64_t scene_ply_count(struct ply *ply, const struct property *property)
{
    const double count = scene_ply_number(ply, property->count_type);
    if (!(count >= 0 && count < UINT32_MAX)) {
        scene_import_fail(ply->import, "%s %lld has a list of no valid length",
                          scene_word_string(ply->import, ply->element->name), (long long)ply->row);
    }
    return (int64_t)count;
}

void scene_ply_skip(struct ply *ply, const struct property *property)
{
    const int64_t count = property->count_type == TYPE_NONE ? 1 : scene_ply_count(ply, property);
    for (int64_t i = 0; i < count; i++) {
        scene_ply_number(ply, property->type);
    }
}

// Colours -------------------------------------------------------------------------------------------

void scene_ply_find_colors(const struct element *element, struct ply_colors *colors)
{
    unsigned found = 0;
    for (int i = 0; i < element->property_count; i++) {
        const struct property *property = &element->properties[i];
        const enum target target = scene_ply_target(property);
        if (target == ALPHA) {
            colors->alpha_type = property->type;
        } else if (target >= RED && target <= BLUE) {
            colors->type = property->type;
            found |= 1u << (target - RED);
        }
    }
    colors->present = found == 7;
}

void scene_ply_add_color(struct ply *ply, struct ply_colors *colors, const float *values)
{
    scene_import_reserve(ply->import, &colors->rows, &colors->capacity, colors->count + 1,
                         sizeof *colors->rows);
    float *color = colors->rows[colors->count++];
    memcpy(color, values + RED, 3 * sizeof *color);
    color[3] = colors->alpha_type == TYPE_NONE ? 1 : values[ALPHA];
}

// Return the stored number that stands for 1. Bytes leave no doubt. Words of 16 bits and all other numbers may hold
// what was a byte, which the largest of them tells.
static float full_of(enum type type, float found)
{
    return type == TYPE_UINT8 ? 255 : type == TYPE_UINT16 && found != 255 ? 65535 : found;
}

bool scene_ply_decode_colors(struct ply_colors *colors)
{
    struct scene_color_scale scale = scene_import_color_scale((const float(*)[4])colors->rows, colors->count);
    scale.color = full_of(colors->type, scale.color);
    scale.alpha = colors->alpha_type == TYPE_NONE ? 1 : full_of(colors->alpha_type, scale.alpha);
    return scene_import_decode_colors(colors->rows, colors->count, scale);
}
