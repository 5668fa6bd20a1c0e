// SPDX-License-Identifier: MIT
// The text of a DXF, which is pairs of lines: a number that says what the next line is, and that line. An entity begins
// with a 0 and its name.
#ifndef SCENE_IMPORT_DXF_TEXT_H
#define SCENE_IMPORT_DXF_TEXT_H

#include "import/builder/text_lines.h"

struct scene_dxf_pair {
    long code;               ///< −1 for a line that is no number
    struct scene_word value; ///< the first word of the line behind it
    struct scene_word line;  ///< all of that line but blanks at its ends
};

struct scene_dxf_writer {
    struct scene_import *import;
    char *bytes; ///< a 0 follows them
    size_t size, capacity;
};

bool scene_dxf_read_pair(struct scene_text *text, struct scene_dxf_pair *pair);
/// Return true for a pair that begins an entity, a section or a block of this name, or ends one.
bool scene_dxf_begins(const struct scene_dxf_pair *pair, const char *name);
void scene_dxf_write(struct scene_dxf_writer *writer, const char *bytes, size_t size);
void scene_dxf_write_text(struct scene_dxf_writer *writer, const char *text);
void scene_dxf_write_number(struct scene_dxf_writer *writer, int code, double value);
/// Find the axes of an entity's plane by the arbitrary axis algorithm of DXF.
void scene_dxf_find_axes(const double extrusion[3], double axes[3][3]);

#endif
