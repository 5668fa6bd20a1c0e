// SPDX-License-Identifier: MIT
// Images of a model as textures with mip chains: one for each way that materials read them, as colour and as data, and
// one for both where a material reads occlusion and roughness from two images at the same place. Channels are filtered
// apart, so that sampling the one texture gives the bits of the two.
#ifndef RHW_SCENE_UPLOAD_IMAGE_H
#define RHW_SCENE_UPLOAD_IMAGE_H

#include "model.h"
#include "rhw/rhw.h"

struct rhw_uploaded_image {
    rhw_texture color, data; // sRGB decoded / as it is; null where no slot reads it so
};

/// Occlusion in red, roughness in green, metalness in blue.
struct rhw_combined_image {
    int32_t rough, occlusion; // images of the model
    bool mips;
    rhw_texture texture;
};

/// Room for one of every material.
struct rhw_combined_images {
    struct rhw_combined_image *images;
    uint32_t count;
};

/// Where a material's occlusion comes from.
enum rhw_occlusion {
    RHW_OCCLUSION_APART,    ///< its own texture, if any
    RHW_OCCLUSION_SHARED,   ///< the image that has roughness, at the same place
    RHW_OCCLUSION_COMBINED, ///< another image of the same size, at the same place
};

enum rhw_occlusion rhw_occlusion_of(const struct rhw_model *model, const struct rhw_material *material);

/// What the materials want of image `i`.
enum rhw_result rhw_upload_image(rhw_context *context, const struct rhw_model *model, uint32_t i,
                                 struct rhw_uploaded_image *uploaded);

/// The texture of a material with RHW_OCCLUSION_COMBINED, new or of an earlier one; it belongs to `combined`.
enum rhw_result rhw_upload_combined(rhw_context *context, const struct rhw_model *model,
                                    const struct rhw_material *material, struct rhw_combined_images *combined,
                                    rhw_texture *texture);

#endif
