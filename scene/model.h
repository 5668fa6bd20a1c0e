// SPDX-License-Identifier: MIT
// A model as the renderer wants it: plain structs and arrays in one allocation. The import has checked every index in
// it, so code that draws a model needs no test of its own. The import has also filled in what the file left out.
//
// The conventions are these. Space is right-handed, and units are glTF's. Matrices are column major and multiply column
// vectors. Texture coordinate u points right and v points down, as rhw_sample takes them. Colours are linear unless an
// image says otherwise. Front faces are counter-clockwise before the world matrix is applied; a mirroring matrix turns
// them.
#ifndef SCENE_MODEL_H
#define SCENE_MODEL_H

#include "rhw/types.h"

enum scene_primitive { SCENE_PRIMITIVE_TRIANGLES, SCENE_PRIMITIVE_LINES, SCENE_PRIMITIVE_POINTS };

enum { SCENE_UV_SETS = 2 };

/// A mesh has one kind of primitive and one material. Its arrays have `vertex_count` elements, and its positions are
/// finite.
struct scene_mesh {
    const char *name; ///< "" if the file names none
    enum scene_primitive primitive;
    uint32_t material; ///< index into scene_model.materials, always valid
    uint32_t vertex_count;
    /// 3, 2 or 1 indices for each primitive of a list: the model has no strips, fans or loops. Every index is below
    /// vertex_count.
    uint32_t index_count;
    uint32_t *indices;
    float (*positions)[3];
    /// Unit vectors. Triangles always have them; for lines and points the pointer may be NULL.
    float (*normals)[3];
    /// A unit vector in xyz, and w = ±1: bitangent = w · cross(normal, tangent). NULL if the material needs no
    /// tangents.
    float (*tangents)[4];
    float (*uvs[SCENE_UV_SETS])[2];     ///< NULL if the set is absent and reads as 0,0
    float (*colors)[4];                 ///< linear RGBA, which multiplies the base colour; NULL for 1,1,1,1
    float bounds_min[3], bounds_max[3]; ///< bounds of the vertices that indices use
    /// The radius of the disc that a point is drawn as, in the units of the positions. It is 0 where single points are
    /// drawn, a few pixels wide.
    float point_radius;
    /// The positions in double while a model is read, where they stand in parts far from each other (import/builder/
    /// pieces.h). NULL in a whole model.
    double (*exact)[3];
};

/// Return how many indices a primitive of the mesh has.
static inline uint32_t scene_mesh_corners(const struct scene_mesh *mesh)
{
    return mesh->primitive == SCENE_PRIMITIVE_TRIANGLES ? 3
           : mesh->primitive == SCENE_PRIMITIVE_LINES   ? 2
                                                        : 1;
}

enum scene_image_type {
    SCENE_IMAGE_RGBA8,  ///< 4 bytes
    SCENE_IMAGE_RGBA16, ///< 4 uint16_t, 65535 is 1
    SCENE_IMAGE_RGBA32F ///< 4 floats, always linear
};

/// An image has tightly packed rows from top to bottom. Texels of 8 and 16 bits are sRGB encoded where a colour slot
/// (base colour, emissive) reads them, and linear where another slot does. Alpha is always linear.
struct scene_image {
    const char *name; ///< file name or the name inside the model
    enum scene_image_type type;
    uint32_t width, height;           ///< 1..RHW_MAX_TARGET_SIZE
    bool missing;                     ///< the image could not be read, and this is the checkered stand-in
    bool lacks_end;                   ///< the file has no mark at its end, and was read all the same
    bool used_as_color, used_as_data; ///< the kinds of slot that read it; both may be set
    bool has_alpha;                   ///< at least one texel is not opaque
    size_t size;                      ///< bytes that `texels` points to
    void *texels;
};

enum scene_slot {
    SCENE_SLOT_BASE_COLOR,
    SCENE_SLOT_METALLIC_ROUGHNESS, ///< roughness in G, metallic in B
    SCENE_SLOT_NORMAL,             ///< tangent space, +Y up (against v)
    SCENE_SLOT_OCCLUSION,          ///< R
    SCENE_SLOT_EMISSIVE,
    SCENE_BASE_SLOTS,
    // The slots from here on belong to scene_layers.
    SCENE_SLOT_CLEARCOAT = SCENE_BASE_SLOTS, ///< R
    SCENE_SLOT_CLEARCOAT_ROUGHNESS,          ///< G
    SCENE_SLOT_CLEARCOAT_NORMAL,
    SCENE_SLOT_SHEEN_COLOR,
    SCENE_SLOT_SHEEN_ROUGHNESS, ///< A
    SCENE_SLOT_SPECULAR,        ///< A
    SCENE_SLOT_SPECULAR_COLOR,
    SCENE_SLOT_TRANSMISSION,          ///< R
    SCENE_SLOT_THICKNESS,             ///< G
    SCENE_SLOT_ANISOTROPY,            ///< direction in R and G, strength in B
    SCENE_SLOT_IRIDESCENCE,           ///< R
    SCENE_SLOT_IRIDESCENCE_THICKNESS, ///< G
    SCENE_SLOT_GLOSS,                 ///< specular colour in RGB, glossiness in A
    SCENE_SLOT_COUNT
};

/// Return true if images are read in this slot as colours, decoded from sRGB. Return false if they are read as data.
static inline bool scene_slot_is_color(enum scene_slot slot)
{
    return slot == SCENE_SLOT_BASE_COLOR || slot == SCENE_SLOT_EMISSIVE || slot == SCENE_SLOT_SHEEN_COLOR ||
           slot == SCENE_SLOT_SPECULAR_COLOR || slot == SCENE_SLOT_GLOSS;
}

/// Where and how a material reads an image.
struct scene_texture_slot {
    int32_t image;   ///< −1 if there is no texture and the factor stands alone
    uint32_t uv_set; ///< 0..SCENE_UV_SETS − 1
    /// The matrix is u' = t[0]·u + t[1]·v + t[2], v' = t[3]·u + t[4]·v + t[5], as of KHR_texture_transform and its
    /// like.
    float transform[6];
    enum rhw_address address_u, address_v;
    enum rhw_filter min_filter, mag_filter;
    enum rhw_mip_filter mip_filter;
    float border[4]; ///< what RHW_ADDRESS_BORDER reads outside of the image, linear, 0..1
};

enum scene_alpha_mode { SCENE_ALPHA_OPAQUE, SCENE_ALPHA_MASK, SCENE_ALPHA_BLEND };

/// What glTF's extensions add to the metallic-roughness model, each as its specification has it
/// (KHR_materials_clearcoat, _sheen, _specular, _ior, _transmission, _volume, _dispersion, _anisotropy, _iridescence,
/// _pbrSpecularGlossiness).
struct scene_layers {
    bool used; ///< false if the material has no layers and nothing else of this struct is read
    float clearcoat, clearcoat_roughness, clearcoat_normal_scale;
    float sheen_color[3], sheen_roughness;
    float specular, specular_color[3], ior;
    float transmission;
    float thickness;            ///< thickness in the mesh's space; 0 for a thin wall
    float attenuation_distance; ///< +infinity if nothing is absorbed
    float attenuation_color[3];
    float dispersion;                          ///< 20 over the Abbe number
    float anisotropy, anisotropy_direction[2]; ///< strength; cosine and sine of the rotation
    float iridescence, iridescence_ior;
    /// Nanometres where the texture is 0 and where it is 1. Without a texture the second one holds.
    float iridescence_thickness[2];
    /// base_color is a diffuse colour, and gloss_specular and glossiness take the place of metallic and roughness.
    bool glossy;
    float gloss_specular[3], glossiness;
};

/// A material is metallic-roughness as glTF 2.0 §3.9 defines it. Other models of shading are converted on import.
struct scene_material {
    const char *name;
    float base_color[4];
    float metallic, roughness;
    float emissive[3]; ///< factor times strength of the extension
    float normal_scale, occlusion_strength;
    enum scene_alpha_mode alpha_mode;
    float alpha_cutoff; ///< limit of MASK: fragments whose alpha is below it are discarded
    bool unlit, double_sided;
    bool is_ground; ///< the material shows nothing but the shadow on it; no file has one
    struct scene_layers layers;
    struct scene_texture_slot slots[SCENE_SLOT_COUNT];
};

/// Return true if light passes through the material, so that what is behind it shows.
static inline bool scene_material_transmits(const struct scene_material *material)
{
    return material->layers.used && material->layers.transmission > 0.0f && !material->unlit;
}

/// An instance is a mesh somewhere in the world. A node whose mesh has several materials gives several instances with
/// one object id.
struct scene_instance {
    const char *name; ///< name of the node
    uint32_t mesh;
    uint32_t object; ///< counts from 1, one number for each node that draws
    float world[16];
    /// Where `world` moves its origin to, as exactly as it is known. Zeros say that `world` is all that there is.
    double place[3];
    bool mirrored; ///< the determinant of `world` is negative
    bool unseen;   ///< nothing of it is seen from anywhere: its surfaces have no area or an alpha of 0
};

/// A camera looks along its own −Z with +Y up.
struct scene_model_camera {
    const char *name;
    float world[16];
    bool orthographic;
    float yfov;        ///< radians, for perspective
    float aspect;      ///< width / height; 0 for that of the picture
    float xmag, ymag;  ///< half width and half height, for orthographic
    float znear, zfar; ///< zfar is 0 if the view is infinitely deep
    double place[3];   ///< where it stands, as exactly as it is known, or zeros
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

/// Lights are those of KHR_lights_punctual.
struct scene_model_light {
    const char *name;
    enum scene_light_type type;
    float position[3];
    float direction[3];         ///< unit vector, the way the light travels
    float color[3];             ///< linear
    float intensity;            ///< lux of a directional light, candela of the others
    float range;                ///< 0 if the light reaches without limit
    float inner_cos, outer_cos; ///< cosines of the half angles of a spot's cone; inner_cos > outer_cos
    double place[3];            ///< the position, as exactly as it is known, or zeros
};

/// An animation is a movement that the file has. scene_model_options chooses the moment that is shown.
struct scene_model_animation {
    const char *name;
    float seconds; ///< time of its last key
    uint32_t channel_count;
};

/// An extension of the format that the file uses.
struct scene_model_extension {
    const char *name;
    bool is_required, is_drawn; ///< is_drawn is also set if the extension is not about the picture
};

struct scene_model {
    const char *path;   ///< path as the caller gave it
    const char *format; ///< for example "glTF 2.0" or "Stanford Polygon Library (PLY)"
    /// The unit of lengths, for example "metre" or "25 mm", as the file or its format says. "" where neither says one.
    const char *unit;
    /// The direction that the format says. Where the format says little, the side that the model stands on tells it.
    enum scene_axis up;
    bool up_guessed;
    /// With y up, the model faces −z, as avatars of VRM 0 do.
    bool faces_back;
    bool doubts_cameras; ///< the format is one whose cameras are often wrong
    /// Every instance is of triangles, and no triangle has an area. A warning says so.
    bool lacks_area;
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
    /// Where the origin of the world is in the coordinates of the file: 0,0,0 unless the model stands so far away that
    /// floats would not tell its parts apart. The places of instances, cameras, lights and bounds are counted from it.
    /// Cameras of scene_view.h, the output of positions and all that users read are in the coordinates of the file.
    double origin[3];
    /// Instances stand many times their size from the origin (SCENE_REMOTE), so that floats do not hold all of their
    /// places, and pictures of such a part are drawn from a place nearby (draw/vicinity.h).
    bool is_scattered;
    /// The bounds of all instances in the world. The minimum exceeds the maximum if there is nothing to draw.
    float bounds_min[3], bounds_max[3];
    /// The bounds hold more than what a picture is about: parts that are never seen, or specks far away. The frame is
    /// the box of the rest. Without `is_framed` the bounds are the frame, and nothing else of this is read.
    bool is_framed;
    float frame_min[3], frame_max[3];
    uint64_t triangles_stored, triangles_drawn; ///< triangles in the meshes, and triangles of all instances
    uint32_t warning_count, unsupported_count, variant_count;
    const char **warnings;    ///< what was wrong with the file and how it was met, one line each
    const char **unsupported; ///< what the file has that is not drawn, one line each
    const char **variants;    ///< names of the choices of materials that the file offers
    size_t size;              ///< bytes of the one allocation that holds the whole model
};

/// Return true if the places of a model with this origin are not those of its file.
static inline bool scene_origin_is_far(const double origin[3])
{
    return origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0;
}

/// What is so many times its size from the origin shows in a picture that floats have steps.
enum { SCENE_REMOTE = 4096 };

/// Write a place that floats have, as exactly as it is known: `exact`, unless it is zeros.
static inline void scene_exact_place(const float floats[3], const double exact[3], double place[3])
{
    for (int c = 0; c < 3; c++) {
        place[c] = scene_origin_is_far(exact) ? exact[c] : (double)floats[c];
    }
}

/// How far an import is. Another thread may read it by the __atomic built-ins while the import is under way. The caller
/// zeroes it before, in memory that forked processes share (system_child_share).
struct scene_progress {
    /// The number of images to be decoded, which is 0 until decoding begins, and the number of images that are done.
    uint32_t image_count, images;
};

/// What to import, and its limits. A zeroed struct asks for the defaults.
struct scene_model_options {
    unsigned seconds; ///< seconds of CPU time; 0 for 60
    size_t memory;    ///< bytes of address space; 0 for 3/4 of the machine's memory, at most 16 GiB
    /// What the file is called. The ending of the name tells the format where nothing in the file does, and files that
    /// the model names are looked for beside it. NULL if the path is the name.
    const char *name;
    /// The name of the variant of the materials (KHR_materials_variants). NULL for the materials that hold without a
    /// variant.
    const char *variant;
    bool is_posed; ///< the model is shown as an animation has it at `time`, not at rest
    /// The animation's name, or its number where none has that name. NULL for the first animation.
    const char *animation;
    /// Seconds. The model stands still before the first key and after the last.
    double time;
    bool without_images; ///< images are not read, and a single white texel stands for each
    /// Images that are longer are halved until they are not. 0 for images of any length.
    uint32_t texture_side;
    /// A folder. Files that the model names are read only inside of it. NULL if they may be anywhere.
    const char *confine;
    /// NULL if nobody asks. Windows keeps no time for an import that has one (system/child.h).
    struct scene_progress *progress;
    /// The thread that waits calls this several times a second. The import is given up when it returns false. NULL if
    /// nobody is to be asked.
    bool (*goes_on)(void *user);
    void *user;
};

/// Return the name of the format that the ending of a file's name stands for, if it is a format of models that nothing
/// here reads. Return NULL for all other names.
const char *scene_model_unread_format(const char *name);

/// Read a model file and its textures in a child process, so that no file can take the caller down. Return NULL on
/// failure, with one line in `error` that names the cause; the path is not in it. `options` may be NULL. The caller
/// frees the model with scene_model_free.
struct scene_model *scene_model_load(const char *path, const struct scene_model_options *options, char *error,
                                     size_t error_size);
void scene_model_free(struct scene_model *model);

#endif
