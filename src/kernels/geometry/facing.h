// SPDX-License-Identifier: MIT
// Which way triangles face, and which ways a pipeline culls: masks with a bit for each of up to 8 triangles.
#ifndef RHW_FACING_H
#define RHW_FACING_H

#include "pipeline/pipeline.h"

// Return the bits of the triangles that face away, from the bits of those that turn the negative way. On the screen y
// points down, so a triangle that is counter-clockwise with y up has a negative area.
static inline unsigned facing_back(const struct rhw_pipeline_def *def, unsigned negative)
{
    return def->front == RHW_COUNTER_CLOCKWISE ? ~negative : negative;
}

// Return the bits of the triangles that the pipeline culls for where they face.
static inline unsigned culled_facing(const struct rhw_pipeline_def *def, unsigned back)
{
    switch (def->cull) {
    case RHW_CULL_NONE: return 0;
    case RHW_CULL_BACK: return back;
    case RHW_CULL_FRONT: return ~back;
    default: return ~0u;
    }
}

#endif
