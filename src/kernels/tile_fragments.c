// SPDX-License-Identifier: MIT
// What becomes of fragments: groups of them are made, shaded, tested late and blended. Compiled once per instruction set,
// with RHW_ISA_SUFFIX naming it.
#include "tile_units.h"
#include "kernels/fragment/constant_color.h"
#include "kernels/fragment/scattered_groups.h"
#include "kernels/fragment/whole_tile.h"

void RHW_ISA_NAME(rhw_shade_queue)(struct tile_work *work)
{
    shade_queue(work);
}

void RHW_ISA_NAME(rhw_flush)(struct tile_work *work)
{
    flush(work);
}

void RHW_ISA_NAME(rhw_pack_group)(struct tile_work *work)
{
    pack_group(work, 0xff);
}

void RHW_ISA_NAME(rhw_release_partial)(struct tile_work *work)
{
    release_partial(work);
}

void RHW_ISA_NAME(rhw_make_room)(struct tile_work *work, struct triangle_work *triangle)
{
    make_room(work, triangle);
}

void RHW_ISA_NAME(rhw_release_gathered)(struct tile_work *work, struct triangle_work *triangle)
{
    release_gathered(work, triangle);
}

void RHW_ISA_NAME(rhw_queue_block)(struct tile_work *work, struct triangle_work *triangle,
                                   const struct block *block)
{
    queue_rows(work, triangle, block, &all_rows);
}

void RHW_ISA_NAME(rhw_queue_some_rows)(struct tile_work *work, struct triangle_work *triangle,
                                       const struct block *block, uint64_t mask)
{
    queue_some_rows(work, triangle, block, mask);
}

void RHW_ISA_NAME(rhw_queue_tile)(struct tile_work *work, struct triangle_work *triangle)
{
    flush(work);
    queue_tile(work, triangle);
}

void RHW_ISA_NAME(rhw_blend_constant)(struct tile_work *work, int x, int y, uint64_t mask)
{
    blend_constant(work, x, y, mask);
}

void RHW_ISA_NAME(rhw_blend_constant_samples)(struct tile_work *work, int x, int y,
                                              const uint64_t mask[RHW_MAX_SAMPLES])
{
    blend_constant_samples(work, x, y, mask);
}
