// SPDX-License-Identifier: MIT
#include "dxf_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

bool scene_dxf_read_pair(struct scene_text *text, struct scene_dxf_pair *pair)
{
    struct scene_line line;
    struct scene_word word;
    if (!scene_text_line(text, false, &line)) {
        return false;
    }
    char digits[16] = "";
    if (scene_text_word(&line, &word) && word.length < sizeof digits) {
        memcpy(digits, word.start, word.length);
    }
    char *end;
    pair->code = strtol(digits, &end, 10);
    pair->code = end == digits ? -1 : pair->code;
    if (!scene_text_line(text, false, &line)) {
        return false;
    }
    pair->line = (struct scene_word){line.cursor, (size_t)(line.end - line.cursor)};
    while (pair->line.length > 0 && is_blank(pair->line.start[0])) {
        pair->line.start++;
        pair->line.length--;
    }
    while (pair->line.length > 0 && is_blank(pair->line.start[pair->line.length - 1])) {
        pair->line.length--;
    }
    if (!scene_text_word(&line, &pair->value)) {
        pair->value = (struct scene_word){"", 0};
    }
    return true;
}

bool scene_dxf_begins(const struct scene_dxf_pair *pair, const char *name)
{
    return pair->code == 0 && scene_word_is(pair->value, name);
}

void scene_dxf_write(struct scene_dxf_writer *writer, const char *bytes, size_t size)
{
    scene_import_reserve(writer->import, &writer->bytes, &writer->capacity, writer->size + size + 1, 1);
    memcpy(writer->bytes + writer->size, bytes, size);
    writer->size += size;
    writer->bytes[writer->size] = 0;
}

void scene_dxf_write_number(struct scene_dxf_writer *writer, int code, double value)
{
    char text[64];
    const int length = snprintf(text, sizeof text, "%d\n%.17g\n", code, value);
    scene_dxf_write(writer, text, (size_t)length);
}

void scene_dxf_write_text(struct scene_dxf_writer *writer, const char *text)
{
    scene_dxf_write(writer, text, strlen(text));
}

void scene_dxf_find_axes(const double extrusion[3], double axes[3][3])
{
    const double length =
        sqrt(extrusion[0] * extrusion[0] + extrusion[1] * extrusion[1] + extrusion[2] * extrusion[2]);
    double z[3] = {0, 0, 1};
    for (int c = 0; c < 3 && length > 0; c++) {
        z[c] = extrusion[c] / length;
    }
    const bool is_near_z = fabs(z[0]) < 1.0 / 64 && fabs(z[1]) < 1.0 / 64;
    double x[3] = {is_near_z ? z[2] : -z[1], is_near_z ? 0 : z[0], is_near_z ? -z[0] : 0};
    const double size = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int c = 0; c < 3; c++) {
        axes[0][c] = x[c] / size;
        axes[2][c] = z[c];
    }
    for (int c = 0; c < 3; c++) {
        const int u = (c + 1) % 3, v = (c + 2) % 3;
        axes[1][c] = z[u] * axes[0][v] - z[v] * axes[0][u];
    }
}
