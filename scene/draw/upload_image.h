// SPDX-License-Identifier: MIT
// Images of a model as textures with mip chains: one for each way that materials read them, as colour and as data, and
// one for both where a material reads occlusion and roughness from two images at the same place. Channels are filtered
// apart, so that sampling the one texture gives the bits of the two.
#ifndef SCENE_UPLOAD_IMAGE_H
#define SCENE_UPLOAD_IMAGE_H

#include "model.h"
#include "rhw/rhw.h"

struct scene_uploaded_image {
    rhw_texture color, data; // sRGB decoded / as it is; null where no slot reads it so
};

/// Occlusion in red, roughness in green, metalness in blue.
struct scene_combined_image {
    int32_t rough, occlusion; // images of the model
    bool mips;
    rhw_texture texture;
};

/// Room for one of every material.
struct scene_combined_images {
    struct scene_combined_image *images;
    uint32_t count;
};

/// Where a material's occlusion comes from.
enum scene_occlusion {
    SCENE_OCCLUSION_APART,    ///< its own texture, if any
    SCENE_OCCLUSION_SHARED,   ///< the image that has roughness, at the same place
    SCENE_OCCLUSION_COMBINED, ///< another image of the same size, at the same place
};

enum scene_occlusion scene_occlusion_of(const struct scene_model *model,
                                        const struct scene_material *material);

/// What the materials want of each image; `uploaded` has a place for every one of the model.
enum rhw_result scene_upload_images(rhw_context *context, const struct scene_model *model,
                                    struct scene_uploaded_image *uploaded);

/// The texture of a material with SCENE_OCCLUSION_COMBINED, new or of an earlier one; it belongs to `combined`.
enum rhw_result scene_upload_combined(rhw_context *context, const struct scene_model *model,
                                      const struct scene_material *material,
                                      struct scene_combined_images *combined, rhw_texture *texture);

#endif
