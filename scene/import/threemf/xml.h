// SPDX-License-Identifier: MIT
// Reading the XML of a 3MF: the state of its reader, and what stands in attributes. An array of attributes has names
// and values in turn.
#ifndef SCENE_IMPORT_3MF_XML_H
#define SCENE_IMPORT_3MF_XML_H

#include <expat.h>

#include "threemf.h"

enum { SCENE_3MF_DEEPEST = 8 }; // a setting of Slic3r's is the seventh

struct scene_3mf_xml {
    struct scene_3mf *file;
    XML_Parser parser;
    uint32_t part; ///< number of the part being read
    int depth;
    int places[SCENE_3MF_DEEPEST]; ///< places of the reader, as `enum place` of threemf/xml.c has them
    unsigned skipped;              ///< number of elements open below one that is passed over
    char setting[64],
        text[64]; ///< name and text of the setting of Cura that is open, cut where they are longer
};

// What slicers write into objects (setting.c).
void scene_3mf_begin_slic3r_volume(struct scene_3mf_xml *xml, const char **attributes);
void scene_3mf_read_slic3r_setting(struct scene_3mf_xml *xml, const char **attributes);
void scene_3mf_begin_cura_setting(struct scene_3mf_xml *xml, const char **attributes);
void scene_3mf_end_cura_setting(struct scene_3mf_xml *xml);

_Noreturn void scene_3mf_refuse(const struct scene_3mf_xml *xml, const char *problem);
/// Return a name without its prefix.
const char *scene_3mf_local_name(const char *name);

/// Return the text of an attribute. Return NULL if it is not there. The three functions below return their last
/// argument if it is not there.
const char *scene_3mf_attribute(const char **attributes, const char *name);
float scene_3mf_number(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                       float otherwise);
uint32_t scene_3mf_index(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                         uint32_t otherwise);
const char *scene_3mf_string(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                             const char *otherwise);
/// Read a number at *text and move on. Return false if there is none.
bool scene_3mf_next_number(const char **text, double *value);
/// Append a list of numbers to the file's.
void scene_3mf_list(struct scene_3mf_xml *xml, const char *text, size_t *first, size_t *count);
/// Read #RRGGBB or #RRGGBBAA, which are sRGB.
bool scene_3mf_color(const char *text, float color[4]);
struct scene_import_place scene_3mf_transform(const struct scene_3mf_xml *xml, const char **attributes);

#endif
