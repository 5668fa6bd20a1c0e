// SPDX-License-Identifier: MIT
// The XML of 3MF, read by expat as it is inflated: a model of a gigabyte is never in memory as text.
//
// Elements are known by their local names and by what they stand in; prefixes are not resolved, as files of the
// standard's own consortium use some that they do not declare. What stands where nothing is known is passed over.
#include "xml.h"

#include "import/builder/zip.h"

#include <string.h>

// Where the reader is.
enum place {
    OUTSIDE,
    MODEL,
    RESOURCES,
    BUILD,
    GROUP, // a group of properties
    OBJECT,
    MESH,
    VERTICES,
    TRIANGLES,
    COMPONENTS,
    LATTICE,
    BEAMS,
    SETTINGS, // settings of Cura
    VOLUMES,  // volumes of Slic3r
    VOLUME,
    CURA_SETTING,
    LEAF
};

static enum rhw_address read_tile_style(const char **attributes, const char *name)
{
    const char *style = scene_3mf_attribute(attributes, name);
    return style == NULL                  ? RHW_ADDRESS_REPEAT
           : strcmp(style, "mirror") == 0 ? RHW_ADDRESS_MIRROR
           : strcmp(style, "clamp") == 0  ? RHW_ADDRESS_CLAMP
           : strcmp(style, "none") == 0   ? RHW_ADDRESS_BORDER
                                          : RHW_ADDRESS_REPEAT;
}

static void read_multiplied(const char *methods, uint64_t *multiplied)
{
    const char *word = methods == NULL ? "" : methods;
    for (int i = 0; i < 64 && *word != 0; i++) {
        word += strspn(word, " \t\n\r");
        const size_t length = strcspn(word, " \t\n\r");
        *multiplied |= (uint64_t)(length == 8 && memcmp(word, "multiply", 8) == 0) << i;
        word += length;
    }
}

static void begin_group(struct scene_3mf_xml *xml, enum scene_3mf_kind kind, const char **attributes)
{
    struct scene_3mf *file = xml->file;
    scene_import_reserve(xml->file->import, &file->groups, &file->group_capacity, file->group_count + 1,
                         sizeof *file->groups);
    struct scene_3mf_group *group = &file->groups[file->group_count++];
    *group = (struct scene_3mf_group){
        .part = xml->part,
        .id = scene_3mf_index(xml, attributes, "id", 0),
        .kind = kind,
        .display = scene_3mf_index(xml, attributes, "displaypropertiesid", 0),
        .refers = scene_3mf_index(xml, attributes, kind == SCENE_3MF_COMPOSITES ? "matid" : "texid", 0),
        .first = file->property_count,
        .image = -1,
    };
    if (kind == SCENE_3MF_MULTI) {
        read_multiplied(scene_3mf_attribute(attributes, "blendmethods"), &group->multiplied);
    }
    if (kind == SCENE_3MF_MULTI || kind == SCENE_3MF_COMPOSITES) {
        scene_3mf_list(xml, scene_3mf_attribute(attributes, kind == SCENE_3MF_MULTI ? "pids" : "matindices"),
                       &group->list, &group->list_count);
    }
    if (kind == SCENE_3MF_TEXTURE) {
        const char *filter = scene_3mf_attribute(attributes, "filter");
        group->path = scene_3mf_string(xml, attributes, "path", "");
        group->address_u = read_tile_style(attributes, "tilestyleu");
        group->address_v = read_tile_style(attributes, "tilestylev");
        group->filter =
            filter != NULL && strcmp(filter, "nearest") == 0 ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR;
    }
}

static void add_property(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf *file = xml->file;
    struct scene_3mf_group *group = &file->groups[file->group_count - 1];
    struct scene_3mf_property property = {
        .value = {1, 1, 1, 1}, .display = scene_3mf_index(xml, attributes, "displaypropertiesid", 0)};
    size_t count = 0;
    switch (group->kind) {
    case SCENE_3MF_BASES:
        if (!scene_3mf_color(scene_3mf_attribute(attributes, "displaycolor"), property.value)) {
            scene_3mf_refuse(xml, "a displaycolor must be #RRGGBB or #RRGGBBAA");
        }
        break;
    case SCENE_3MF_COLORS:
        if (!scene_3mf_color(scene_3mf_attribute(attributes, "color"), property.value)) {
            scene_3mf_refuse(xml, "a color must be #RRGGBB or #RRGGBBAA");
        }
        break;
    case SCENE_3MF_COORDS:
        property.value[0] = scene_3mf_number(xml, attributes, "u", 0);
        property.value[1] = scene_3mf_number(xml, attributes, "v", 0);
        break;
    case SCENE_3MF_METALS:
        property.value[0] = scene_3mf_number(xml, attributes, "metallicness", 0);
        property.value[1] = scene_3mf_number(xml, attributes, "roughness", 1);
        break;
    case SCENE_3MF_SPECULARS:
        property.value[1] = 1 - scene_3mf_number(xml, attributes, "glossiness", 0);
        break;
    case SCENE_3MF_COMPOSITES:
        scene_3mf_list(xml, scene_3mf_attribute(attributes, "values"), &property.list, &count);
        break;
    case SCENE_3MF_MULTI:
        scene_3mf_list(xml, scene_3mf_attribute(attributes, "pindices"), &property.list, &count);
        break;
    case SCENE_3MF_TEXTURE: return;
    }
    property.list_count = (uint32_t)count;
    scene_import_reserve(xml->file->import, &file->properties, &file->property_capacity,
                         file->property_count + 1, sizeof *file->properties);
    file->properties[file->property_count++] = property;
    group->count++;
}

// Objects -------------------------------------------------------------------------------------------

static struct scene_3mf_object *current_object(const struct scene_3mf_xml *xml)
{
    return &xml->file->objects[xml->file->object_count - 1];
}

static void begin_object(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf *file = xml->file;
    const char *type = scene_3mf_attribute(attributes, "type");
    scene_import_reserve(xml->file->import, &file->objects, &file->object_capacity, file->object_count + 1,
                         sizeof *file->objects);
    file->objects[file->object_count++] = (struct scene_3mf_object){
        .part = xml->part,
        .id = scene_3mf_index(xml, attributes, "id", 0),
        .pid = scene_3mf_index(xml, attributes, "pid", 0),
        .pindex = scene_3mf_index(xml, attributes, "pindex", 0),
        .name = scene_3mf_string(xml, attributes, "name", ""),
        .first_component = file->component_count,
        .role = type != NULL && strcmp(type, "other") == 0 ? SCENE_3MF_OTHER : SCENE_3MF_PRINTED,
    };
}

static void add_vertex(struct scene_3mf_xml *xml, const char **attributes)
{
    static const char *const names[] = {"x", "y", "z"};
    struct scene_3mf_object *object = current_object(xml);
    scene_import_reserve(xml->file->import, &object->read_positions, &object->position_capacity,
                         object->position_count + 1, sizeof *object->read_positions);
    for (int c = 0; c < 3; c++) {
        const char *text = scene_3mf_attribute(attributes, names[c]);
        double *const value = &object->read_positions[object->position_count][c];
        if (text == NULL || !scene_3mf_next_number(&text, value)) {
            scene_3mf_refuse(xml, "a vertex needs x, y and z");
        }
    }
    object->position_count++;
}

// Return the index of what a slicer painted on a triangle. Return 0 if none did. Neighbours often have the same.
static uint32_t add_painting(struct scene_3mf_xml *xml, const char **attributes)
{
    enum { VERTICES_ALONE = 6 }; // names and values of v1, v2 and v3
    struct scene_3mf *file = xml->file;
    if (XML_GetSpecifiedAttributeCount(xml->parser) <= VERTICES_ALONE) {
        return 0;
    }
    const char *bambu = scene_3mf_attribute(attributes, "paint_color");
    const char *text = bambu != NULL ? bambu : scene_3mf_attribute(attributes, "mmu_segmentation");
    if (text == NULL || text[0] == 0) {
        return 0;
    }
    if (file->painting_count > 0 && strcmp(file->paintings[file->painting_count - 1], text) == 0) {
        return (uint32_t)file->painting_count;
    }
    if (file->painting_count == UINT32_MAX) {
        scene_3mf_refuse(xml, "too many triangles are painted");
    }
    scene_import_reserve(file->import, &file->paintings, &file->painting_capacity, file->painting_count + 1,
                         sizeof *file->paintings);
    file->paintings[file->painting_count++] = scene_import_string(file->import, text, strlen(text));
    return (uint32_t)file->painting_count;
}

static void add_triangle(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf_object *object = current_object(xml);
    const uint32_t none = UINT32_MAX;
    const uint32_t p1 = scene_3mf_index(xml, attributes, "p1", none);
    const struct scene_3mf_triangle triangle = {
        .vertices = {scene_3mf_index(xml, attributes, "v1", none),
                     scene_3mf_index(xml, attributes, "v2", none),
                     scene_3mf_index(xml, attributes, "v3", none)},
        .pid = p1 == none ? 0 : scene_3mf_index(xml, attributes, "pid", object->pid),
        .properties = {p1, scene_3mf_index(xml, attributes, "p2", p1),
                       scene_3mf_index(xml, attributes, "p3", p1)},
        .painting = add_painting(xml, attributes),
    };
    for (int k = 0; k < 3; k++) {
        if (triangle.vertices[k] >= object->position_count) {
            scene_3mf_refuse(xml, "a triangle's v1, v2 and v3 must be vertices of its mesh");
        }
    }
    scene_import_reserve(xml->file->import, &object->triangles, &object->triangle_capacity,
                         object->triangle_count + 1, sizeof *object->triangles);
    object->triangles[object->triangle_count++] = triangle;
}

// Beam Lattice, 2: drawn as the line in its middle.
static void add_beam(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf_object *object = current_object(xml);
    scene_import_reserve(xml->file->import, &object->beams, &object->beam_capacity, object->beam_count + 2,
                         sizeof *object->beams);
    for (int k = 0; k < 2; k++) {
        const uint32_t vertex = scene_3mf_index(xml, attributes, k == 0 ? "v1" : "v2", UINT32_MAX);
        if (vertex >= object->position_count) {
            scene_3mf_refuse(xml, "a beam's v1 and v2 must be vertices of its mesh");
        }
        object->beams[object->beam_count++] = vertex;
    }
    scene_import_unsupported(xml->file->import, "the thickness of beams (3MF): drawn as lines");
}

static struct scene_3mf_component read_component(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf_component component = {.part = xml->part,
                                            .id = scene_3mf_index(xml, attributes, "objectid", 0)};
    const char *path = scene_3mf_attribute(attributes, "path");
    if (path != NULL) {
        component.part = scene_3mf_part(xml->file, path);
    }
    component.transform = scene_3mf_transform(xml, attributes);
    return component;
}

static void add_component(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf *file = xml->file;
    const struct scene_3mf_component component = read_component(xml, attributes);
    scene_import_reserve(xml->file->import, &file->components, &file->component_capacity,
                         file->component_count + 1, sizeof *file->components);
    file->components[file->component_count++] = component;
    current_object(xml)->component_count++;
}

static void add_item(struct scene_3mf_xml *xml, const char **attributes)
{
    struct scene_3mf *file = xml->file;
    if (xml->part != 0) {
        return; // only the first part's is what is built (Production, 2)
    }
    const struct scene_3mf_component item = read_component(xml, attributes);
    scene_import_reserve(xml->file->import, &file->items, &file->item_capacity, file->item_count + 1,
                         sizeof *file->items);
    file->items[file->item_count++] = item;
}

// Tell of an extension that the file requires and that is not known. Its prefix stands for its name.
static void check_required(const struct scene_3mf_xml *xml, const char **attributes, const char *prefix,
                           size_t length)
{
    static const char *const known[] = {
        "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
        "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
        "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
        "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02",
    };
    for (int i = 0; attributes[i] != NULL; i += 2) {
        const char *name = attributes[i], *uri = attributes[i + 1];
        if (strncmp(name, "xmlns:", 6) != 0 || strlen(name + 6) != length ||
            memcmp(name + 6, prefix, length) != 0) {
            continue;
        }
        bool is_known = false;
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
            is_known = is_known || strcmp(uri, known[k]) == 0;
        }
        if (!is_known) {
            scene_import_unsupported(xml->file->import, "the extension \"%s\" (3MF), which the file requires",
                                     uri);
        }
    }
}

static void begin_model(struct scene_3mf_xml *xml, const char **attributes)
{
    const char *required = scene_3mf_attribute(attributes, "requiredextensions");
    for (const char *word = required == NULL ? "" : required; *word != 0;) {
        word += strspn(word, " \t\n\r");
        const size_t length = strcspn(word, " \t\n\r");
        check_required(xml, attributes, word, length);
        word += length;
    }
    if (xml->part == 0) {
        xml->file->import->model.unit = scene_3mf_string(xml, attributes, "unit", "millimeter");
    }
}

// Elements ------------------------------------------------------------------------------------------

struct rule {
    enum place in;
    const char *name;
    enum place to;
    void (*act)(struct scene_3mf_xml *xml, const char **attributes); // NULL: nothing but going there
    enum scene_3mf_kind kind;                                        // in RESOURCES, to GROUP
};

static const struct rule rules[] = {
    {VERTICES, "vertex", LEAF, add_vertex, 0},
    {TRIANGLES, "triangle", LEAF, add_triangle, 0},
    {OUTSIDE, "model", MODEL, begin_model, 0},
    {MODEL, "resources", RESOURCES, NULL, 0},
    {MODEL, "build", BUILD, NULL, 0},
    {BUILD, "item", LEAF, add_item, 0},
    {RESOURCES, "object", OBJECT, begin_object, 0},
    {OBJECT, "mesh", MESH, NULL, 0},
    {OBJECT, "components", COMPONENTS, NULL, 0},
    {COMPONENTS, "component", LEAF, add_component, 0},
    {OBJECT, "metadatagroup", SETTINGS, NULL, 0},
    {OBJECT, "settings", SETTINGS, NULL, 0},
    {SETTINGS, "metadata", CURA_SETTING, scene_3mf_begin_cura_setting, 0},
    {SETTINGS, "setting", CURA_SETTING, scene_3mf_begin_cura_setting, 0},
    {MESH, "volumes", VOLUMES, NULL, 0},
    {VOLUMES, "volume", VOLUME, scene_3mf_begin_slic3r_volume, 0},
    {VOLUME, "metadata", LEAF, scene_3mf_read_slic3r_setting, 0},
    {MESH, "vertices", VERTICES, NULL, 0},
    {MESH, "triangles", TRIANGLES, NULL, 0},
    {MESH, "beamlattice", LATTICE, NULL, 0},
    {LATTICE, "beams", BEAMS, NULL, 0},
    {BEAMS, "beam", LEAF, add_beam, 0},
    {RESOURCES, "basematerials", GROUP, NULL, SCENE_3MF_BASES},
    {RESOURCES, "colorgroup", GROUP, NULL, SCENE_3MF_COLORS},
    {RESOURCES, "texture2dgroup", GROUP, NULL, SCENE_3MF_COORDS},
    {RESOURCES, "compositematerials", GROUP, NULL, SCENE_3MF_COMPOSITES},
    {RESOURCES, "multiproperties", GROUP, NULL, SCENE_3MF_MULTI},
    {RESOURCES, "pbmetallicdisplayproperties", GROUP, NULL, SCENE_3MF_METALS},
    {RESOURCES, "pbspeculardisplayproperties", GROUP, NULL, SCENE_3MF_SPECULARS},
    {RESOURCES, "texture2d", GROUP, NULL, SCENE_3MF_TEXTURE},
};

// What is passed over and would have been seen.
static void note_unused(struct scene_3mf_xml *xml, const char *name)
{
    static const struct {
        const char *name, *what;
    } elements[] = {
        {"translucentdisplayproperties", "translucent display properties (3MF)"},
        {"pbmetallictexturedisplayproperties", "textures of metallicness and roughness (3MF)"},
        {"pbspeculartexturedisplayproperties", "textures of specular colour and glossiness (3MF)"},
        {"displacementmesh", "displacement meshes (3MF)"},
        {"levelset", "implicit and volumetric shapes (3MF)"},
        {"volumedata", "colours and materials of volumes (3MF)"},
        {"booleans", "boolean shapes (3MF)"},
        {"booleanshape", "boolean shapes (3MF)"},
        {"slicestack", "slices (3MF)"},
        {"balls", "balls of lattices (3MF)"},
    };
    for (size_t i = 0; i < sizeof elements / sizeof elements[0]; i++) {
        if (strcmp(name, elements[i].name) == 0) {
            scene_import_unsupported(xml->file->import, "%s: not drawn", elements[i].what);
        }
    }
}

static void XMLCALL start_element(void *user, const XML_Char *full, const XML_Char **attributes)
{
    struct scene_3mf_xml *xml = user;
    const char *name = scene_3mf_local_name(full);
    const enum place here = (enum place)xml->places[xml->depth];
    if (xml->skipped > 0 || here == LEAF) {
        xml->skipped++;
        return;
    }
    if (here == GROUP) {
        add_property(xml, attributes);
        xml->places[++xml->depth] = LEAF;
        return;
    }
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        const struct rule *rule = &rules[i];
        if (rule->in != here || strcmp(rule->name, name) != 0) {
            continue;
        }
        if (rule->to == GROUP) {
            begin_group(xml, rule->kind, attributes);
        } else if (rule->act != NULL) {
            rule->act(xml, attributes);
        }
        xml->places[++xml->depth] = (int)rule->to;
        return;
    }
    if (here == OUTSIDE) {
        scene_3mf_refuse(xml, "the outermost element must be \"model\"");
    }
    note_unused(xml, name);
    xml->skipped++;
}

static void XMLCALL end_element(void *user, const XML_Char *name)
{
    struct scene_3mf_xml *xml = user;
    (void)name;
    if (xml->skipped > 0) {
        xml->skipped--;
        return;
    }
    if (xml->places[xml->depth] == CURA_SETTING) {
        scene_3mf_end_cura_setting(xml);
    }
    xml->depth--;
}

// A document type can define what its text means, a gigabyte of it in a line. The specification forbids document types
// (Core, 2.3.3).
static void XMLCALL start_doctype(void *user, const XML_Char *name, const XML_Char *system,
                                  const XML_Char *public, int subset)
{
    (void)name, (void)system, (void)public, (void)subset;
    scene_3mf_refuse(user, "a document type is not allowed");
}

void scene_3mf_read_part(struct scene_3mf *file, uint32_t part)
{
    enum { STEP = 1 << 16 };
    static const char sealed[] = "%3McF"; // as an encrypted part begins (Secure Content, 3.1)
    bool is_first = true;
    struct scene_3mf_xml xml = {.file = file, .part = part, .parser = XML_ParserCreate(NULL)};
    size_t size;
    if (xml.parser == NULL) {
        scene_import_fail(file->import, "needs more memory than there is");
    }
    if (!scene_zip_enter(file->zip, file->parts[part], &size)) {
        scene_import_fail(file->import, "the archive has no \"%s\"", file->parts[part]);
    }
    XML_SetUserData(xml.parser, &xml);
    XML_SetElementHandler(xml.parser, start_element, end_element);
    XML_SetStartDoctypeDeclHandler(xml.parser, start_doctype);
    for (size_t count = 1; count > 0;) {
        void *buffer = XML_GetBuffer(xml.parser, STEP);
        if (buffer == NULL) {
            scene_import_fail(file->import, "needs more memory than there is");
        }
        count = scene_zip_read(file->zip, buffer, STEP);
        if (is_first && count >= strlen(sealed) && memcmp(buffer, sealed, strlen(sealed)) == 0) {
            scene_import_fail(file->import, "\"%s\" in the archive is encrypted", file->parts[part]);
        }
        is_first = false;
        if (XML_ParseBuffer(xml.parser, (int)count, count == 0) != XML_STATUS_OK) {
            scene_3mf_refuse(&xml, XML_ErrorString(XML_GetErrorCode(xml.parser)));
        }
    }
    XML_ParserFree(xml.parser);
}
