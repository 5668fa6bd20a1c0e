// SPDX-License-Identifier: MIT
// 3MF between the parts of its reader: what its XML says, and what becomes of it.
//
// Names are those of the specifications: 3MF Core 1.3, Materials and Properties 1.2 (colours, textures, metals),
// Production 1.1 (objects in other parts of the package). What slicers add in files of their own is called a volume and
// a filament, as PrusaSlicer does.
#ifndef SCENE_THREEMF_H
#define SCENE_THREEMF_H

#include "import/builder/clusters.h"
#include "import/builder/place.h"

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
    uint32_t painting; ///< index into scene_3mf.paintings; 0 if no slicer painted it
};

/// What an object or a part of it is for.
enum scene_3mf_role {
    SCENE_3MF_PRINTED,
    SCENE_3MF_MODIFIER, ///< where it is, settings are others
    SCENE_3MF_NEGATIVE, ///< what is cut out of the others
    SCENE_3MF_SUPPORT,  ///< where there are supports, and where there are none
    SCENE_3MF_OTHER     ///< by its type (Core, 4.1)
};

/// What a slicer says of an object, or of a part of it.
struct scene_3mf_volume {
    uint32_t object; ///< id of the object, which is in the first part of the package
    enum {
        SCENE_3MF_WHOLE,     ///< the object
        SCENE_3MF_TRIANGLES, ///< some of its triangles
        SCENE_3MF_COMPONENT  ///< one of its components
    } kind;
    uint32_t first, last; ///< the triangles from first to last; of a component both are its object's id
    enum scene_3mf_role role;
    uint32_t filament; ///< from 1; 0 if that of what is around it holds
};

/// What holds for an object where it is built.
struct scene_3mf_setting {
    uint32_t object; ///< id of the item's object, which volumes are looked for by; 0 if there is none
    uint32_t filament;
};

struct scene_3mf_component {
    uint32_t part, id; ///< part and id of the object
    struct scene_import_place transform;
};

/// The meshes that an object became.
struct scene_3mf_shape {
    struct scene_3mf_setting setting; ///< what held for it
    uint32_t first_mesh, mesh_count;  ///< range of the model's meshes
};

struct scene_3mf_object {
    uint32_t part, id, pid, pindex;
    const char *name;
    double (*read_positions)[3]; ///< until the object is made
    float (*positions)[3];
    struct scene_import_clusters clusters; ///< clusters of the vertices
    double (*origins)[3];                  ///< what was subtracted from the positions of each cluster
    size_t position_count, position_capacity;
    struct scene_3mf_triangle *triangles;
    size_t triangle_count, triangle_capacity;
    uint32_t *beams; ///< two vertices for each beam of a lattice
    size_t beam_count, beam_capacity;
    size_t first_component, component_count; ///< range in scene_3mf.components
    enum scene_3mf_role role;
    struct scene_3mf_shape *shapes;
    size_t shape_count, shape_capacity;
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

/// A corner of a triangle that is drawn.
struct scene_3mf_corner {
    float position[3], color[4], uv[2];
};

/// A piece of a triangle.
struct scene_3mf_piece {
    struct scene_3mf_corner corners[3];
    uint32_t filament; ///< 0 if it is not painted
};

struct scene_3mf_pieces {
    struct scene_3mf_piece *items;
    size_t count, capacity;
};

/// A set of edges (edges.c).
struct scene_3mf_edges {
    struct scene_3mf_edge *items;
    size_t count, capacity;
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
    const char **paintings;
    size_t painting_count, painting_capacity;
    float (*filaments)[4]; ///< linear colours; alpha −1 where the file names none
    size_t filament_count, filament_capacity;
    struct scene_3mf_volume *volumes; ///< sorted by object, kind and first when all is read
    size_t volume_count, volume_capacity;
    struct scene_3mf_pieces pieces; ///< pieces of the triangle under way
    struct scene_3mf_edges edges;   ///< edges of the object under way that paintings cut
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

/// Read what slicers add in files of their own: colours of filaments, and roles and filaments of parts.
void scene_3mf_read_slicer(struct scene_3mf *file);
/// Read the colours of filaments.
void scene_3mf_read_filaments(struct scene_3mf *file);
/// Set the colour of a filament, which counts from 1. Nothing happens where `text` is no colour.
void scene_3mf_set_filament(struct scene_3mf *file, uint32_t filament, const char *text);
/// Return what a filament looks like.
struct scene_3mf_paint scene_3mf_filament_paint(struct scene_3mf *file, uint32_t filament);
void scene_3mf_add_volume(struct scene_3mf *file, const struct scene_3mf_volume *volume);
void scene_3mf_sort_volumes(struct scene_3mf *file);
/// Return the volume of an object that holds triangle `number`, or the component whose object has this id. Return NULL
/// if there is none.
const struct scene_3mf_volume *scene_3mf_find_volume(const struct scene_3mf *file, uint32_t object, int kind,
                                                     uint32_t number);
/// Tell of what is left out for its role. Return false if it is printed, and drawn.
bool scene_3mf_leave_out(struct scene_3mf *file, enum scene_3mf_role role);

/// Cut a triangle into the pieces that a slicer painted. They are in file->pieces then. Return false if the painting is
/// damaged.
bool scene_3mf_cut(struct scene_3mf *file, const char *painting, const struct scene_3mf_corner corners[3]);
/// Add the edges that a painting cuts to file->edges.
void scene_3mf_find_cuts(struct scene_3mf *file, const char *painting,
                         const struct scene_3mf_corner corners[3]);
struct scene_3mf_corner scene_3mf_middle(const struct scene_3mf_corner *a, const struct scene_3mf_corner *b);

void scene_3mf_add_edge(struct scene_3mf *file, const float a[3], const float b[3]);
bool scene_3mf_has_edge(const struct scene_3mf *file, const float a[3], const float b[3]);
void scene_3mf_clear_edges(struct scene_3mf *file);

/// Add the meshes and their instances to the model.
void scene_3mf_build(struct scene_3mf *file);

#endif
