// SPDX-License-Identifier: MIT
// Reading the XML of a 3MF: the state of its reader, and what stands in attributes, which are names and values in turn.
#ifndef SCENE_IMPORT_3MF_XML_H
#define SCENE_IMPORT_3MF_XML_H

#include <expat.h>

#include "threemf.h"

enum { SCENE_3MF_DEEPEST = 8 }; // a vertex is the fifth below the outermost

struct scene_3mf_xml {
    struct scene_3mf *file;
    XML_Parser parser;
    uint32_t part; ///< being read
    int depth;
    int places[SCENE_3MF_DEEPEST]; ///< where the reader is: `enum place` of threemf/xml.c
    unsigned skipped;              ///< elements open below what is passed over
};

_Noreturn void scene_3mf_refuse(const struct scene_3mf_xml *xml, const char *problem);
/// A name without its prefix.
const char *scene_3mf_local_name(const char *name);

/// The text of an attribute; NULL where it is not there. Those below give what is named last instead.
const char *scene_3mf_attribute(const char **attributes, const char *name);
float scene_3mf_number(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                       float otherwise);
uint32_t scene_3mf_index(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                         uint32_t otherwise);
const char *scene_3mf_string(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                             const char *otherwise);
/// Reads a number at *text and moves on; false where there is none.
bool scene_3mf_next_number(const char **text, double *value);
/// Appends a list of numbers to the file's.
void scene_3mf_list(struct scene_3mf_xml *xml, const char *text, size_t *first, size_t *count);
/// #RRGGBB or #RRGGBBAA, sRGB.
bool scene_3mf_color(const char *text, float color[4]);
void scene_3mf_transform(const struct scene_3mf_xml *xml, const char **attributes, float matrix[16]);

#endif
