// SPDX-License-Identifier: MIT
// What slicers write into an object of the model itself: Slic3r writes ranges of triangles, Cura settings. A setting of
// Cura is an attribute and a text, and what it says holds for the whole object.
#include <string.h>
#include <strings.h>

#include "xml.h"

void scene_3mf_begin_slic3r_volume(struct scene_3mf_xml *xml, const char **attributes)
{
    const struct scene_3mf *file = xml->file;
    const char *modifier = scene_3mf_attribute(attributes, "modifier");
    const struct scene_3mf_volume volume = {
        .object = file->objects[file->object_count - 1].id,
        .kind = SCENE_3MF_TRIANGLES,
        .first = scene_3mf_index(xml, attributes, "ts", 0),
        .last = scene_3mf_index(xml, attributes, "te", 0),
        .role = modifier != NULL && strcmp(modifier, "1") == 0 ? SCENE_3MF_MODIFIER : SCENE_3MF_PRINTED,
    };
    if (xml->part == 0) {
        scene_3mf_add_volume(xml->file, &volume);
    }
}

void scene_3mf_read_slic3r_setting(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf *file = xml->file;
    const char *type = scene_3mf_attribute(attributes, "type");
    const char *name = type == NULL ? "" : strrchr(type, '.') == NULL ? type : strrchr(type, '.') + 1;
    if (xml->part == 0 && file->volume_count > 0 && strcmp(name, "extruder") == 0) {
        file->volumes[file->volume_count - 1].filament = scene_3mf_index(xml, attributes, "config", 0);
    }
}

// Cura ----------------------------------------------------------------------------------------------

static void XMLCALL read_text(void *user, const XML_Char *text, int length)
{
    struct scene_3mf_xml *xml = user;
    const size_t used = strlen(xml->text), left = sizeof xml->text - 1 - used;
    const size_t count = (size_t)length < left ? (size_t)length : left;
    memcpy(xml->text + used, text, count);
    xml->text[used + count] = 0;
}

void scene_3mf_begin_cura_setting(struct scene_3mf_xml *xml, const char **attributes)
{
    const char *name = scene_3mf_attribute(attributes, "name"), *key = scene_3mf_attribute(attributes, "key");
    const char *full = name != NULL ? name : key != NULL ? key : "";
    snprintf(xml->setting, sizeof xml->setting, "%s", scene_3mf_local_name(full));
    xml->text[0] = 0;
    XML_SetCharacterDataHandler(xml->parser, read_text);
}

void scene_3mf_end_cura_setting(struct scene_3mf_xml *xml)
{
    static const struct {
        const char *name;
        enum scene_3mf_role role;
    } roles[] = {
        {"infill_mesh", SCENE_3MF_MODIFIER},
        {"cutting_mesh", SCENE_3MF_MODIFIER},
        {"anti_overhang_mesh", SCENE_3MF_SUPPORT},
        {"support_mesh", SCENE_3MF_SUPPORT},
    };
    struct scene_3mf *file = xml->file;
    const bool is_true = strcasecmp(xml->text, "true") == 0 || strcmp(xml->text, "1") == 0;
    for (size_t i = 0; i < sizeof roles / sizeof roles[0]; i++) {
        if (is_true && strcmp(xml->setting, roles[i].name) == 0) {
            file->objects[file->object_count - 1].role = roles[i].role;
        }
    }
    if (strcmp(xml->setting, "extruder_nr") == 0 && xml->text[0] >= '1' && xml->text[0] <= '9') {
        scene_import_unsupported(file->import, "colours of Cura's materials (3MF): not drawn");
    }
    XML_SetCharacterDataHandler(xml->parser, NULL);
}
