// SPDX-License-Identifier: MIT
// 3MF between the parts of its reader: what its XML says, and what becomes of it.
//
// Names are those of the specifications: 3MF Core 1.3, Materials and Properties 1.2 (colours, textures, metals),
// Production 1.1 (objects in other parts of the package).
#ifndef SCENE_THREEMF_H
#define SCENE_THREEMF_H

#include "import/builder/import.h"

enum scene_3mf_kind {
    SCENE_3MF_BASES,      ///< basematerials
    SCENE_3MF_COLORS,     ///< colorgroup
    SCENE_3MF_COORDS,     ///< texture2dgroup
    SCENE_3MF_COMPOSITES, ///< compositematerials
    SCENE_3MF_MULTI,      ///< multiproperties
    SCENE_3MF_METALS,     ///< pbmetallicdisplayproperties
    SCENE_3MF_SPECULARS,  ///< pbspeculardisplayproperties
    SCENE_3MF_TEXTURE     ///< texture2d
};

/// One of the properties of a group.
struct scene_3mf_property {
    /// By the kind of the group: linear RGBA, or u and v, or metallicness and roughness.
    float value[4];
    uint32_t display;    ///< id of display properties; 0 if there are none
    uint32_t list_count; ///< number of a composite's shares or a multiproperty's indices
    size_t list;         ///< first of the list, in scene_3mf.lists
};

/// A resource other than an object. Its id is one of the ids of its part of the package.
struct scene_3mf_group {
    uint32_t part, id;
    enum scene_3mf_kind kind;
    uint32_t display;        ///< id of display properties; 0 if there are none
    uint32_t refers;         ///< texid, or matid of composites
    size_t list, list_count; ///< pids of multiproperties, or indices of the materials of composites
    /// Bit k is set if layer k + 1 of multiproperties multiplies what lies below it.
    uint64_t multiplied;
    size_t first, count; ///< range of the group's properties
    const char *path;    ///< path of a texture
    enum rhw_address address_u, address_v;
    enum rhw_filter filter;
    int32_t image; ///< image of a texture; −1 until it is used
};

struct scene_3mf_triangle {
    uint32_t vertices[3];
    uint32_t pid; ///< 0 if the pid of the object holds
    uint32_t properties[3];
};

struct scene_3mf_component {
    uint32_t part, id; ///< part and id of the object
    float transform[16];
};

struct scene_3mf_object {
    uint32_t part, id, pid, pindex;
    const char *name;
    float (*positions)[3];
    size_t position_count, position_capacity;
    struct scene_3mf_triangle *triangles;
    size_t triangle_count, triangle_capacity;
    uint32_t *beams; ///< two vertices for each beam of a lattice
    size_t beam_count, beam_capacity;
    size_t first_component, component_count; ///< range in scene_3mf.components
    uint32_t first_mesh, mesh_count;         ///< range of the model's meshes, once `made`
    bool made;
};

/// What a corner of a triangle looks like.
struct scene_3mf_paint {
    bool described; ///< the file says something about the corner
    float color[4]; ///< linear
    float uv[2];
    struct scene_3mf_group *texture;
    float metallic, roughness; ///< −1 if the file does not say
    /// The texture is mixed with what lies below: another texture or NULL, and below that a colour.
    bool layered;
    struct scene_3mf_group *below;
    float ground[3];
};

/// What a material of the model was made for.
struct scene_3mf_look {
    struct scene_3mf_paint paint; ///< `color` and `uv` of it are not used
    bool blended;
    uint32_t material;
};

struct scene_3mf {
    struct scene_import *import;
    struct scene_zip *zip;
    /// Names of the parts of the package that hold models. The first part is where the build is.
    const char **parts;
    size_t part_count, part_capacity;
    struct scene_3mf_group *groups; ///< sorted by part and id when all is read
    size_t group_count, group_capacity;
    struct scene_3mf_property *properties;
    size_t property_count, property_capacity;
    double *lists;
    size_t list_count, list_capacity;
    struct scene_3mf_object *objects; ///< sorted by part and id when all is read
    size_t object_count, object_capacity;
    struct scene_3mf_component *components;
    size_t component_count, component_capacity;
    struct scene_3mf_component *items; ///< objects of the build
    size_t item_count, item_capacity;
    struct scene_3mf_look *looks;
    size_t look_count, look_capacity;
    int layered_count; ///< looks with an image of their own, made of a texture over a colour
    uint32_t placed;   ///< number of components that were followed
};

/// Read one part of the package. Parts that it names are added to the list.
void scene_3mf_read_part(struct scene_3mf *file, uint32_t part);
/// Return the number of the part with this name, new or known.
uint32_t scene_3mf_part(struct scene_3mf *file, const char *name);

struct scene_3mf_group *scene_3mf_find_group(const struct scene_3mf *file, uint32_t part, uint32_t id);
/// Return what property `index` of a group looks like. `group` may be NULL.
struct scene_3mf_paint scene_3mf_find_paint(const struct scene_3mf *file, const struct scene_3mf_group *group,
                                            uint32_t index);
/// Return the material for a triangle whose first corner looks like `paint`. `blended` says that colours are not
/// opaque.
uint32_t scene_3mf_material(struct scene_3mf *file, const struct scene_3mf_paint *paint, bool blended);

/// Add the meshes and their instances to the model.
void scene_3mf_build(struct scene_3mf *file);

#endif
