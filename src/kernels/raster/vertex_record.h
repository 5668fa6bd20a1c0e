// SPDX-License-Identifier: MIT
// This file finds the record of a vertex in its segment.
#ifndef RHW_VERTEX_RECORD_H
#define RHW_VERTEX_RECORD_H

#include "draw/draw_list.h"

static inline const struct rhw_vertex_record *record_at(const struct rhw_segment *segment, uint32_t slot)
{
    return (const struct rhw_vertex_record *)(const void *)(segment->vertices +
                                                            (size_t)slot * (size_t)segment->vertex_stride);
}

#endif
