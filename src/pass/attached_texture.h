// SPDX-License-Identifier: MIT
// A pass takes a part of a texture as an attachment. The part is checked against the pass and the earlier attachments.
#ifndef RHW_ATTACHED_TEXTURE_H
#define RHW_ATTACHED_TEXTURE_H

#include <stdbool.h>

#include "rhw/types.h"

struct rhw_attachment;
struct rhw_clean_tiles;
struct rhw_context;
struct rhw_encoder;
struct rhw_mip;
struct rhw_target;
struct rhw_texture_data;

// This part of a texture is attached. layer_count is not 0.
struct rhw_attached_part {
    int layer, level, layer_count;
};

// A recording looks up the record of an attachment's clean tiles whenever it runs.
struct rhw_clean_part {
    struct rhw_clean_part *next;
    struct rhw_texture_data *const *texture; // in the context's pool
    struct rhw_attached_part part;
    struct rhw_clean_tiles **clean; // member of an attachment
};

// Note that the pass under way writes a part of a texture, and give the record of its clean tiles in `clean`. Several
// layers and a part of a level have no record: `clean` is NULL, and what the texture recorded is forgotten. Return
// false when out of memory.
bool rhw_attached_part_take(struct rhw_context *context, const struct rhw_target *target,
                            struct rhw_texture_data *texture, struct rhw_attached_part part,
                            struct rhw_clean_tiles **clean);

// Set the members of an attachment that follow from its texture. The first attachment gives the pass its size, where it
// has none. `name` is the member of rhw_pass_def, as "colors[0]" or "depth". Misuse is reported as misuse of
// rhw_pass_begin.
enum rhw_result rhw_pass_attach_texture(struct rhw_encoder *encoder, rhw_texture id,
                                        struct rhw_attached_part part, const char *name,
                                        struct rhw_attachment *attachment);

// Set what an attachment whose samples have a texture of their own is resolved into besides. `name` is the member of
// rhw_pass_def, as "colors[0]" or "depth". Misuse is reported as misuse of rhw_pass_begin.
enum rhw_result rhw_pass_attach_resolve(struct rhw_encoder *encoder, rhw_texture id, const char *name,
                                        struct rhw_attachment *attachment);

// Make `aspect` the stencil aspect of a level, as a level of its own, and return `aspect`. Return NULL where the level
// is NULL.
const struct rhw_mip *rhw_stencil_aspect_of(const struct rhw_mip *mip, struct rhw_mip *aspect);

#endif
