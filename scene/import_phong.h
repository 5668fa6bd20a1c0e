// SPDX-License-Identifier: MIT
// Materials of formats older than glTF: a diffuse and a specular colour, a few textures.
#ifndef RHW_SCENE_IMPORT_PHONG_H
#define RHW_SCENE_IMPORT_PHONG_H

#include "import.h"

/// One texture of such a material.
struct rhw_phong_texture {
    const char *name; ///< NULL: there is none
    struct rhw_import_source source;
    struct rhw_texture_slot slot; ///< `image` is not set
};

/// What the file says. Start from rhw_phong_default.
struct rhw_phong {
    const char *name;
    bool described;                             ///< `diffuse` is from the file
    bool colored;                               ///< the mesh has vertex colours
    float diffuse[3], specular[3], emissive[3]; ///< sRGB
    float opacity;
    float shininess;           ///< Phong's exponent; 0: not said
    float metallic, roughness; ///< −1: not said
    bool dull;                 ///< the file asks for no highlights
    bool unlit;
    struct rhw_phong_texture color, opacity_map, normal, height, occlusion, emissive_map;
};

struct rhw_phong rhw_phong_default(void);
struct rhw_phong_texture rhw_phong_texture_default(void);
/// Adds the material, converted to metallic-roughness, and its images. Returns its index.
uint32_t rhw_phong_add(struct rhw_import *import, const struct rhw_phong *phong);

#endif
