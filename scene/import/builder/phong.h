// SPDX-License-Identifier: MIT
// Materials of formats older than glTF: a diffuse and a specular colour, a few textures.
#ifndef SCENE_IMPORT_PHONG_H
#define SCENE_IMPORT_PHONG_H

#include "import.h"

/// One texture of such a material.
struct scene_phong_texture {
    const char *name; ///< NULL: there is none
    struct scene_import_source source;
    struct scene_texture_slot slot; ///< `image` is not set
    int channel;                    ///< 0..3, of one that gives a number: red, green, blue or alpha
};

/// What the file says. Start from scene_phong_default.
struct scene_phong {
    const char *name;
    bool described;                             ///< `diffuse` is from the file
    bool colored;                               ///< the mesh has vertex colours
    float diffuse[3], specular[3], emissive[3]; ///< sRGB
    float opacity;
    float shininess;           ///< Phong's exponent; 0: not said
    float metallic, roughness; ///< −1: not said
    bool dull;                 ///< the file asks for no highlights
    bool unlit;
    struct scene_phong_texture color, opacity_map, normal, height, occlusion, emissive_map, roughness_map,
        metallic_map;
    float normal_scale;                                                        ///< of `normal` or `height`
    float clearcoat, clearcoat_roughness, sheen, anisotropy, anisotropy_turns; ///< 0: none
    struct scene_phong_texture clearcoat_map, clearcoat_roughness_map;
};

struct scene_phong scene_phong_default(void);
struct scene_phong_texture scene_phong_texture_default(void);
/// Adds the material, converted to metallic-roughness, and its images. Returns its index.
uint32_t scene_phong_add(struct scene_import *import, const struct scene_phong *phong);

#endif
