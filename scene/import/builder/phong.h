// SPDX-License-Identifier: MIT
// Materials of formats older than glTF: a diffuse and a specular colour, a few textures.
#ifndef SCENE_IMPORT_PHONG_H
#define SCENE_IMPORT_PHONG_H

#include "import.h"

/// One texture of a material.
struct scene_phong_texture {
    const char *name; ///< NULL if there is none
    struct scene_import_source source;
    struct scene_texture_slot slot; ///< `image` is not set
    /// The channel of a texture that gives a number, 0..3: red, green, blue or alpha.
    int channel;
};

/// What the file says of a material. Start from scene_phong_default.
struct scene_phong {
    const char *name;
    bool described;                             ///< `diffuse` is from the file
    bool colored;                               ///< the mesh has vertex colours
    float diffuse[3], specular[3], emissive[3]; ///< sRGB
    float opacity;
    bool may_be_clear;         ///< an opacity of 0 is meant, and no habit of exporters
    float shininess;           ///< Phong's exponent; 0 if the file names none
    float metallic, roughness; ///< −1 if the file does not say
    bool dull;                 ///< the file asks for no highlights
    bool unlit;
    struct scene_phong_texture color, opacity_map, normal, height, occlusion, emissive_map, roughness_map,
        metallic_map;
    float normal_scale; ///< scale of `normal` or `height`
    /// Each is 0 if the material has none of it.
    float clearcoat, clearcoat_roughness, sheen, anisotropy, anisotropy_turns;
    struct scene_phong_texture clearcoat_map, clearcoat_roughness_map;
};

struct scene_phong scene_phong_default(void);
struct scene_phong_texture scene_phong_texture_default(void);
/// Add the material, converted to metallic-roughness, and its images. Return its index.
uint32_t scene_phong_add(struct scene_import *import, const struct scene_phong *phong);

#endif
