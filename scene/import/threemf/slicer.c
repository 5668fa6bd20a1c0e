// SPDX-License-Identifier: MIT
// What slicers say of objects and their parts in XML of their own: PrusaSlicer and SuperSlicer of ranges of triangles,
// Bambu Studio and OrcaSlicer of components. What they say of the print is passed over.
#include <expat.h>
#include <stdlib.h>
#include <string.h>

#include "threemf.h"
#include "xml.h"
#include "import/builder/zip.h"

struct reader {
    struct scene_3mf_xml xml;
    struct scene_3mf_volume object, volume; ///< the object and the part that are open
    bool in_object, in_volume;
    bool in_filament_option; ///< an option of a range of layers is open that sets its filament
};

// Volumes -------------------------------------------------------------------------------------------

void scene_3mf_add_volume(struct scene_3mf *file, const struct scene_3mf_volume *volume)
{
    scene_import_reserve(file->import, &file->volumes, &file->volume_capacity, file->volume_count + 1,
                         sizeof *file->volumes);
    file->volumes[file->volume_count++] = *volume;
}

static int compare_volumes(const void *left, const void *right)
{
    const struct scene_3mf_volume *a = left, *b = right;
    return a->object != b->object ? (a->object > b->object) - (a->object < b->object)
           : a->kind != b->kind   ? (a->kind > b->kind) - (a->kind < b->kind)
           : a->first != b->first ? (a->first > b->first) - (a->first < b->first)
                                  : (a->last > b->last) - (a->last < b->last);
}

void scene_3mf_sort_volumes(struct scene_3mf *file)
{
    if (file->volume_count > 0) {
        qsort(file->volumes, file->volume_count, sizeof *file->volumes, compare_volumes);
    }
}

const struct scene_3mf_volume *scene_3mf_find_volume(const struct scene_3mf *file, uint32_t object, int kind,
                                                     uint32_t number)
{
    const struct scene_3mf_volume key = {
        .object = object, .kind = (unsigned)kind, .first = number, .last = UINT32_MAX};
    size_t low = 0, high = file->volume_count; // find the last one that begins at `number` or before
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (compare_volumes(&file->volumes[middle], &key) <= 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    const struct scene_3mf_volume *volume = low > 0 ? &file->volumes[low - 1] : NULL;
    const bool fits = volume != NULL && volume->object == object && volume->kind == (unsigned)kind &&
                      volume->first <= number && volume->last >= number;
    return fits ? volume : NULL;
}

bool scene_3mf_leave_out(struct scene_3mf *file, enum scene_3mf_role role)
{
    static const char *const names[] = {
        [SCENE_3MF_MODIFIER] = "modifiers of slicers",
        [SCENE_3MF_NEGATIVE] = "negative volumes of slicers, which are cut out of others,",
        [SCENE_3MF_SUPPORT] = "enforcers and blockers of supports",
        [SCENE_3MF_OTHER] = "objects of type \"other\"",
    };
    if (role == SCENE_3MF_PRINTED) {
        return false;
    }
    scene_import_unsupported(file->import, "%s (3MF): left out", names[role]);
    return true;
}

// Elements ------------------------------------------------------------------------------------------

static bool is_one_of(const char *text, const char *const *names, size_t count)
{
    bool found = false;
    for (size_t i = 0; i < count && text != NULL; i++) {
        found = found || strcmp(text, names[i]) == 0;
    }
    return found;
}

static enum scene_3mf_role find_role(const char *type)
{
    static const char *const negative[] = {"NegativeVolume", "negative_part"};
    static const char *const modifier[] = {"ParameterModifier", "modifier_part", "SeamPosition", "BrimPatch"};
    static const char *const support[] = {"SupportEnforcer", "SupportBlocker", "support_enforcer",
                                          "support_blocker"};
    return is_one_of(type, negative, 2)   ? SCENE_3MF_NEGATIVE
           : is_one_of(type, modifier, 4) ? SCENE_3MF_MODIFIER
           : is_one_of(type, support, 4)  ? SCENE_3MF_SUPPORT
                                          : SCENE_3MF_PRINTED;
}

// Return a whole number. Return 0 where there is none.
static uint32_t find_number(const char **attributes, const char *name)
{
    const char *text = scene_3mf_attribute(attributes, name);
    const unsigned long value = text == NULL || text[0] == '-' ? 0 : strtoul(text, NULL, 10);
    return value <= INT32_MAX ? (uint32_t)value : 0;
}

static void begin_volume(struct reader *reader, const char **attributes)
{
    reader->in_volume = true;
    reader->volume = (struct scene_3mf_volume){.object = reader->object.object};
    if (scene_3mf_attribute(attributes, "firstid") != NULL) {
        reader->volume.kind = SCENE_3MF_TRIANGLES;
        reader->volume.first = find_number(attributes, "firstid");
        reader->volume.last = find_number(attributes, "lastid");
    } else {
        reader->volume.kind = SCENE_3MF_COMPONENT;
        reader->volume.first = reader->volume.last = find_number(attributes, "id");
    }
    reader->volume.role = find_role(scene_3mf_attribute(attributes, "subtype"));
}

static void read_metadata(struct reader *reader, const char **attributes)
{
    struct scene_3mf_volume *volume = reader->in_volume ? &reader->volume : &reader->object;
    const char *key = scene_3mf_attribute(attributes, "key"),
               *value = scene_3mf_attribute(attributes, "value");
    if (key == NULL || value == NULL || !reader->in_object) {
        return;
    }
    if (strcmp(key, "extruder") == 0) {
        volume->filament = find_number(attributes, "value");
    } else if (strcmp(key, "volume_type") == 0 && reader->in_volume) {
        volume->role = find_role(value);
    } else if (strcmp(key, "modifier") == 0 && reader->in_volume && strcmp(value, "1") == 0 &&
               volume->role == SCENE_3MF_PRINTED) {
        volume->role = SCENE_3MF_MODIFIER;
    }
}

// Tell of filaments that change on the way up.
static void note_changes(struct reader *reader)
{
    scene_import_unsupported(reader->xml.file->import, "changes of the filament by height (3MF): not drawn");
}

// A change of G-code at a height: one of colour (0) or tool (2), or in older files what the printer is told.
static void read_change(struct reader *reader, const char **attributes)
{
    static const char *const types[] = {"0", "2"}, *const codes[] = {"M600", "tool_change"};
    const char *type = scene_3mf_attribute(attributes, "type");
    if (type != NULL ? is_one_of(type, types, 2)
                     : is_one_of(scene_3mf_attribute(attributes, "gcode"), codes, 2)) {
        note_changes(reader);
    }
}

static void XMLCALL start_element(void *user, const XML_Char *full, const XML_Char **attributes)
{
    struct reader *reader = user;
    const char *name = scene_3mf_local_name(full);
    if (strcmp(name, "object") == 0) {
        reader->object =
            (struct scene_3mf_volume){.object = find_number(attributes, "id"), .kind = SCENE_3MF_WHOLE};
        reader->in_object = true;
    } else if ((strcmp(name, "volume") == 0 || strcmp(name, "part") == 0) && reader->in_object) {
        begin_volume(reader, attributes);
    } else if (strcmp(name, "metadata") == 0) {
        read_metadata(reader, attributes);
    } else if (strcmp(name, "filament") == 0) {
        scene_3mf_set_filament(reader->xml.file, find_number(attributes, "id"),
                               scene_3mf_attribute(attributes, "color"));
    } else if (strcmp(name, "code") == 0 || strcmp(name, "layer") == 0) {
        read_change(reader, attributes);
    } else if (strcmp(name, "option") == 0) {
        const char *key = scene_3mf_attribute(attributes, "opt_key");
        reader->in_filament_option = key != NULL && strcmp(key, "extruder") == 0;
    }
}

static void XMLCALL end_element(void *user, const XML_Char *full)
{
    struct reader *reader = user;
    const char *name = scene_3mf_local_name(full);
    reader->in_filament_option = false;
    if (reader->in_volume && (strcmp(name, "volume") == 0 || strcmp(name, "part") == 0)) {
        scene_3mf_add_volume(reader->xml.file, &reader->volume);
        reader->in_volume = false;
    } else if (reader->in_object && strcmp(name, "object") == 0) {
        scene_3mf_add_volume(reader->xml.file, &reader->object);
        reader->in_object = false;
    }
}

static void XMLCALL read_text(void *user, const XML_Char *text, int length)
{
    struct reader *reader = user;
    if (reader->in_filament_option && length > 0 && *text >= '1' && *text <= '9') {
        note_changes(reader);
    }
}

// A document type can define what its text means, a gigabyte of it in a line.
static void XMLCALL start_doctype(void *user, const XML_Char *name, const XML_Char *system,
                                  const XML_Char *public, int subset)
{
    struct reader *reader = user;
    (void)name, (void)system, (void)public, (void)subset;
    XML_StopParser(reader->xml.parser, XML_FALSE);
}

static void read_settings(struct scene_3mf *file, const char *name)
{
    size_t size;
    char *text = scene_zip_read_all(file->zip, name, &size);
    struct reader reader = {.xml = {.file = file, .parser = text == NULL ? NULL : XML_ParserCreate(NULL)}};
    if (text == NULL) {
        return;
    }
    if (reader.xml.parser == NULL) {
        scene_import_fail(file->import, "needs more memory than there is");
    }
    XML_SetUserData(reader.xml.parser, &reader);
    XML_SetElementHandler(reader.xml.parser, start_element, end_element);
    XML_SetCharacterDataHandler(reader.xml.parser, read_text);
    XML_SetStartDoctypeDeclHandler(reader.xml.parser, start_doctype);
    if (size > INT32_MAX || XML_Parse(reader.xml.parser, text, (int)size, 1) != XML_STATUS_OK) {
        scene_import_warn(file->import,
                          "\"%s\" in the archive, line %lu: %s: what the slicer says there is left out", name,
                          (unsigned long)XML_GetCurrentLineNumber(reader.xml.parser),
                          XML_ErrorString(XML_GetErrorCode(reader.xml.parser)));
    }
    XML_ParserFree(reader.xml.parser);
    free(text);
}

void scene_3mf_read_slicer(struct scene_3mf *file)
{
    static const char *const names[] = {
        "Metadata/Slic3r_PE_model.config",     "Metadata/SuperSlicer_model.config",
        "Metadata/model_settings.config",      "Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml",
        "Metadata/custom_gcode_per_layer.xml", "Metadata/Prusa_Slicer_layer_config_ranges.xml",
        "Metadata/layer_config_ranges.xml",
    };
    scene_3mf_read_filaments(file);
    if (scene_zip_find_ending(file->zip, ".fdm_material") != NULL) {
        scene_import_unsupported(file->import, "colours of Cura's materials (3MF): not drawn");
    }
    if (file->filament_count == 0) {
        read_settings(file, "Metadata/slice_info.config");
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        read_settings(file, names[i]);
    }
}
