// SPDX-License-Identifier: MIT
// A texture as an attachment of a pass: the part of it that is attached, checked against the pass and the attachments
// before it, and taken.
#ifndef RHW_ATTACHED_TEXTURE_H
#define RHW_ATTACHED_TEXTURE_H

#include "rhw/types.h"

struct rhw_attachment;
struct rhw_mip;
struct rhw_encoder;

// What of a texture is attached; layer_count is not 0.
struct rhw_attached_part {
    int layer, level, layer_count;
};

// Fills what an attachment with a texture has; the first gives the pass its size, where that is not set. `name`: of the
// member of rhw_pass_def, as "colors[0]" or "depth". Misuse is reported as that of rhw_pass_begin.
enum rhw_result rhw_pass_attach_texture(struct rhw_encoder *encoder, rhw_texture id,
                                        struct rhw_attached_part part, const char *name,
                                        struct rhw_attachment *attachment);

// What samples that have a texture of their own are resolved into besides. `name`: as above.
enum rhw_result rhw_pass_attach_resolve(struct rhw_encoder *encoder, rhw_texture id, const char *name,
                                        struct rhw_attachment *attachment);

// The plane of stencil of a level as a level of its own in `plane`; NULL of NULL.
const struct rhw_mip *rhw_stencil_plane_of(const struct rhw_mip *mip, struct rhw_mip *plane);

#endif
