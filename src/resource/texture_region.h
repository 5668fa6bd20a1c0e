// SPDX-License-Identifier: MIT
// A box of texels of one level of a texture, as rhw_texture_region names it, checked and written out.
#ifndef RHW_TEXTURE_REGION_H
#define RHW_TEXTURE_REGION_H

#include "rhw/transfer.h"
#include "texture.h"

struct rhw_region {
    struct rhw_texture_data *texture; // NULL: the call was misuse
    rhw_texture id;
    int level, x, y, z, width, height, depth, sample;
    bool is_stencil;
    size_t texel; // bytes of a texel
};

// Return what a caller's region says of the texture. Report what is not there, and an attachment of the pass being
// recorded. `name` is what messages call the region. `region` may be NULL.
struct rhw_region rhw_region_check(struct rhw_context *context, rhw_texture id,
                                   const struct rhw_texture_region *region, const char *name,
                                   const char *where);

// Report textures with several samples, where a call is about all of them or none.
bool rhw_region_check_single(const struct rhw_context *context, const struct rhw_region *region,
                             const char *where);

// Report a compressed format, whose texels are decoded from blocks and not written, and texels that cannot be written
// now.
bool rhw_region_check_writable(const struct rhw_context *context, const struct rhw_region *region,
                               const char *where);

// Report a sample that is named where all are meant. `region` may be NULL.
bool rhw_region_check_no_sample(const struct rhw_context *context, const struct rhw_texture_region *region,
                                const char *name, const char *where);

// Return the place that `from` is copied to, with the sizes of `from`. The sizes of `to`, which may be NULL, are 0 or
// equal to those.
struct rhw_region rhw_region_check_place(struct rhw_context *context, rhw_texture id,
                                         const struct rhw_texture_region *to, const struct rhw_region *from,
                                         const char *where);

// Report regions that have texels in common.
bool rhw_region_check_apart(const struct rhw_context *context, const struct rhw_region *from,
                            const struct rhw_region *to, const char *where);

// Make the region's texture one that can be written now. Return false when out of memory.
bool rhw_region_to_write(struct rhw_context *context, struct rhw_region *region);

// Return the first byte of row y of slice z, both counted within the region.
unsigned char *rhw_region_row(const struct rhw_region *region, int y, int z);

// Return the bytes of a row.
static inline size_t rhw_region_row_size(const struct rhw_region *region)
{
    return (size_t)region->width * region->texel;
}

// Return the texels of one sample and of the aspect that the region lies in, as a level of their own.
struct rhw_mip rhw_region_aspect(const struct rhw_region *region, int sample);

#endif
