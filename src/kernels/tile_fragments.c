// SPDX-License-Identifier: MIT
// Groups are made of fragments. This file is compiled once per instruction set, and RHW_ISA_SUFFIX names the set.
#include "tile_units.h"
#include "kernels/fragment/scattered_groups.h"
#include "kernels/fragment/whole_tile.h"

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

void RHW_ISA_NAME(rhw_release_collected)(struct tile_work *work, struct triangle_work *triangle)
{
    release_collected(work, triangle);
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
