// SPDX-License-Identifier: MIT
// One block of a compressed format through the library.
#ifndef TEST_DECODED_BLOCK_H
#define TEST_DECODED_BLOCK_H

#include "harness.h"

static inline rhw_texture make_texture(struct rig *rig, enum rhw_format format, int width, int height,
                                       int levels)
{
    const struct rhw_texture_def def = {
        .format = format, .width = width, .height = height, .mip_levels = levels};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

// The texels of one whole block, of 12 × 12 at most as the rig is.
static inline const void *decode(struct rig *rig, enum rhw_format format, const unsigned char *block)
{
    const rhw_texture texture =
        make_texture(rig, format, rhw_format_block_width(format), rhw_format_block_height(format), 1);
    assert_int_equal(rhw_texture_write(rig->context, texture, 0, block, 0), RHW_OK);
    const void *const texels = rig_read(rig, texture);
    rhw_texture_destroy(rig->context, texture);
    return texels;
}

#endif
