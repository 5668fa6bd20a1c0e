// SPDX-License-Identifier: MIT
// A model as the renderer wants it: plain structs and arrays in one allocation. Every index in it has been
// checked, so who draws it needs no test of his own; what a file left out has been filled in on import.
//
// Conventions: right-handed, glTF's units; matrices column major, column vectors; texture coordinates u
// right, v down, as rhw_sample takes them; colours linear unless an image says otherwise; front faces
// counter-clockwise before the world matrix (a mirroring matrix turns them).
#ifndef SCENE_MODEL_H
#define SCENE_MODEL_H

#include "rhw/types.h"

enum scene_primitive { SCENE_PRIMITIVE_TRIANGLES, SCENE_PRIMITIVE_LINES, SCENE_PRIMITIVE_POINTS };

enum { SCENE_UV_SETS = 2 };

/// One primitive kind, one material. Arrays have `vertex_count` elements; positions are finite.
struct scene_mesh {
    const char *name; ///< "" where the file names none
    enum scene_primitive primitive;
    uint32_t material; ///< always valid
    uint32_t vertex_count;
    uint32_t index_count; ///< 3, 2 or 1 per primitive; lists only, every index below vertex_count
    uint32_t *indices;
    float (*positions)[3];
    float (*normals)[3];  ///< unit; never NULL for triangles, may be NULL for lines and points
    float (*tangents)[4]; ///< unit xyz, w = ±1: bitangent = w · cross(normal, tangent); NULL: not needed
    float (*uvs[SCENE_UV_SETS])[2];     ///< NULL: the set is absent, read 0,0
    float (*colors)[4];                 ///< linear RGBA, multiplies the base colour; NULL: 1,1,1,1
    float bounds_min[3], bounds_max[3]; ///< of the vertices that indices use
    float point_radius; ///< of the disc of a point, in the units of the positions; 0: a few pixels, as single points
};

enum scene_image_type {
    SCENE_IMAGE_RGBA8,  ///< 4 bytes
    SCENE_IMAGE_RGBA16, ///< 4 uint16_t, 65535 is 1
    SCENE_IMAGE_RGBA32F ///< 4 floats, always linear
};

/// Tightly packed rows, top to bottom. 8 and 16 bit texels are sRGB encoded where a colour slot (base
/// colour, emissive) reads them and linear where another does; alpha is always linear.
struct scene_image {
    const char *name; ///< file name or the name inside the model
    enum scene_image_type type;
    uint32_t width, height;           ///< 1..RHW_MAX_TARGET_SIZE
    bool missing;                     ///< could not be read: this is the checkered stand-in
    bool used_as_color, used_as_data; ///< which kinds of slot read it; both may be set
    bool has_alpha;                   ///< some texel is not opaque
    size_t size;                      ///< bytes at texels
    void *texels;
};

enum scene_slot {
    SCENE_SLOT_BASE_COLOR,
    SCENE_SLOT_METALLIC_ROUGHNESS, ///< G roughness, B metallic
    SCENE_SLOT_NORMAL,             ///< tangent space, +Y up (against v)
    SCENE_SLOT_OCCLUSION,          ///< R
    SCENE_SLOT_EMISSIVE,
    SCENE_BASE_SLOTS,
    // Of scene_layers.
    SCENE_SLOT_CLEARCOAT = SCENE_BASE_SLOTS, ///< R
    SCENE_SLOT_CLEARCOAT_ROUGHNESS,          ///< G
    SCENE_SLOT_CLEARCOAT_NORMAL,
    SCENE_SLOT_SHEEN_COLOR,
    SCENE_SLOT_SHEEN_ROUGHNESS, ///< A
    SCENE_SLOT_SPECULAR,        ///< A
    SCENE_SLOT_SPECULAR_COLOR,
    SCENE_SLOT_TRANSMISSION,          ///< R
    SCENE_SLOT_THICKNESS,             ///< G
    SCENE_SLOT_ANISOTROPY,            ///< R, G direction, B strength
    SCENE_SLOT_IRIDESCENCE,           ///< R
    SCENE_SLOT_IRIDESCENCE_THICKNESS, ///< G
    SCENE_SLOT_GLOSS,                 ///< specular colour, A glossiness
    SCENE_SLOT_COUNT
};

/// Whether images are read there as colours, decoded from sRGB, and not as data.
static inline bool scene_slot_is_color(enum scene_slot slot)
{
    return slot == SCENE_SLOT_BASE_COLOR || slot == SCENE_SLOT_EMISSIVE || slot == SCENE_SLOT_SHEEN_COLOR ||
           slot == SCENE_SLOT_SPECULAR_COLOR || slot == SCENE_SLOT_GLOSS;
}

/// Where a material reads an image.
struct scene_texture_slot {
    int32_t image;   ///< −1: no texture, the factor alone
    uint32_t uv_set; ///< 0..SCENE_UV_SETS − 1
    /// u' = t[0]·u + t[1]·v + t[2], v' = t[3]·u + t[4]·v + t[5] (KHR_texture_transform and its like).
    float transform[6];
    enum rhw_address address_u, address_v;
    enum rhw_filter min_filter, mag_filter;
    enum rhw_mip_filter mip_filter;
};

enum scene_alpha_mode { SCENE_ALPHA_OPAQUE, SCENE_ALPHA_MASK, SCENE_ALPHA_BLEND };

/// What glTF's extensions add to the metallic-roughness model, each as its specification has it (KHR_materials_clearcoat,
/// _sheen, _specular, _ior, _transmission, _volume, _dispersion, _anisotropy, _iridescence, _pbrSpecularGlossiness).
struct scene_layers {
    bool used; ///< false: none, and nothing of this is read
    float clearcoat, clearcoat_roughness, clearcoat_normal_scale;
    float sheen_color[3], sheen_roughness;
    float specular, specular_color[3], ior;
    float transmission;
    float thickness;            ///< in the mesh's space; 0: a thin wall
    float attenuation_distance; ///< +infinity: none
    float attenuation_color[3];
    float dispersion;                          ///< 20 over the Abbe number
    float anisotropy, anisotropy_direction[2]; ///< strength; cosine and sine of the rotation
    float iridescence, iridescence_ior;
    float iridescence_thickness[2]; ///< nanometres, where the texture is 0 and 1; without one the second
    bool glossy; ///< base_color is a diffuse colour, these two take the place of metallic and roughness
    float gloss_specular[3], glossiness;
};

/// Metallic-roughness as glTF 2.0 §3.9 defines it; other models of shading are converted on import.
struct scene_material {
    const char *name;
    float base_color[4];
    float metallic, roughness;
    float emissive[3]; ///< factor times strength
    float normal_scale, occlusion_strength;
    enum scene_alpha_mode alpha_mode;
    float alpha_cutoff; ///< for MASK: fragments whose alpha is below are discarded
    bool unlit, double_sided;
    bool is_ground; ///< shows nothing but the shadow on it; of no file
    struct scene_layers layers;
    struct scene_texture_slot slots[SCENE_SLOT_COUNT];
};

/// Whether light passes through, so that what is behind shows.
static inline bool scene_material_transmits(const struct scene_material *material)
{
    return material->layers.used && material->layers.transmission > 0.0f && !material->unlit;
}

/// A mesh somewhere in the world. A node whose mesh has several materials gives several instances with
/// one object id.
struct scene_instance {
    const char *name; ///< of the node
    uint32_t mesh;
    uint32_t object; ///< 1.., one per node that draws
    float world[16];
    bool mirrored; ///< the determinant of `world` is negative
};

/// Looks along its own −Z with +Y up.
struct scene_model_camera {
    const char *name;
    float world[16];
    bool orthographic;
    float yfov;        ///< radians; perspective
    float aspect;      ///< width / height; 0: that of the picture
    float xmag, ymag;  ///< half width and half height; orthographic
    float znear, zfar; ///< zfar 0: infinitely far
};

/// Directions of the world.
enum scene_axis {
    SCENE_AXIS_Y,
    SCENE_AXIS_Z,
    SCENE_AXIS_X,
    SCENE_AXIS_MINUS_Y,
    SCENE_AXIS_MINUS_Z,
    SCENE_AXIS_MINUS_X
};

enum scene_light_type { SCENE_LIGHT_DIRECTIONAL, SCENE_LIGHT_POINT, SCENE_LIGHT_SPOT };

/// KHR_lights_punctual.
struct scene_model_light {
    const char *name;
    enum scene_light_type type;
    float position[3];
    float direction[3];         ///< unit; the way the light travels
    float color[3];             ///< linear
    float intensity;            ///< lux (directional) or candela
    float range;                ///< 0: unlimited
    float inner_cos, outer_cos; ///< cosines of the half angles of a spot's cone; inner_cos > outer_cos
};

/// A movement that the file has; scene_model_options shows a moment of it.
struct scene_model_animation {
    const char *name;
    float seconds; ///< when its last key is
    uint32_t channel_count;
};

/// An extension of the format that the file uses.
struct scene_model_extension {
    const char *name;
    bool is_required, is_drawn; ///< or is about no picture
};

struct scene_model {
    const char *path;   ///< as it was given
    const char *format; ///< for example "glTF 2.0" or "Stanford Polygon Library (PLY)"
    const char *unit; ///< of lengths, "metre" or "25 mm", as the file or its format says; "" where neither does
    enum scene_axis up; ///< what the format says, or where it says little, what the model stands on
    bool up_guessed;
    bool doubts_cameras; ///< of a format whose cameras are often wrong
    bool lacks_area;     ///< every instance is of triangles, and none has an area; a warning tells it
    uint32_t mesh_count, material_count, image_count, instance_count, camera_count, light_count,
        animation_count, extension_count;
    struct scene_mesh *meshes;
    struct scene_material *materials;
    struct scene_image *images;
    struct scene_instance *instances;
    struct scene_model_camera *cameras;
    struct scene_model_light *lights;
    struct scene_model_animation *animations;
    struct scene_model_extension *extensions;
    float bounds_min[3], bounds_max[3]; ///< of all instances, in the world; min > max: nothing to draw
    uint64_t triangles_stored, triangles_drawn; ///< in the meshes / after instancing
    uint32_t warning_count, unsupported_count, variant_count;
    const char **warnings;    ///< what was wrong with the file and how it was met; one line each
    const char **unsupported; ///< what the file has that is not drawn; one line each
    const char **variants;    ///< names of the choices of materials that the file offers
    size_t size;              ///< bytes of the one allocation that all of this lives in
};

/// How far an import is: for another thread while one is under way, which reads it by the __atomic built-ins. Zeroed before;
/// in memory that forked processes share (system_child_share).
struct scene_progress {
    uint32_t image_count, images; ///< to be decoded, 0 until that begins; of them, done
};

/// What to import, and its limits. Zeroed: the defaults.
struct scene_model_options {
    unsigned seconds; ///< of CPU time; 0: 60
    size_t memory;    ///< bytes of address space; 0: 3/4 of the machine's memory, at most 16 GiB
    /// What the file is called: its ending tells the format where nothing in it does, and files that it names are looked
    /// for beside it. NULL: the path.
    const char *name;
    const char *variant; ///< of the materials, by its name (KHR_materials_variants); NULL: as they are without
    bool is_posed;       ///< not at rest, but as an animation has it at `time`
    const char *animation; ///< its name, or its number where none has that name; NULL: the first
    double time;           ///< seconds; before the first key and after the last it stands still
    bool without_images;   ///< they are not read: a single white texel stands for each
    uint32_t texture_side; ///< images that are longer are halved until they are not; 0: none is
    const char *confine;   ///< a folder; nothing outside it is read that the file names. NULL: everything is
    /// NULL: nobody asks. Windows keeps no time for an import that has one (system/child.h).
    struct scene_progress *progress;
    /// Asked several times a second by the thread that waits; false: the import is given up. NULL: nobody is asked.
    bool (*goes_on)(void *user);
    void *user;
};

/// Reads a model file and its textures in a child process, so that no file can take the caller down.
/// Returns NULL on failure with one line in `error` that names the cause (the path is not in it).
/// `options` may be NULL. Free with scene_model_free.
struct scene_model *scene_model_load(const char *path, const struct scene_model_options *options, char *error,
                                     size_t error_size);
void scene_model_free(struct scene_model *model);

#endif
