// SPDX-License-Identifier: MIT
// If the fragment function is called for every sample, a group is a row of pixels at one of their samples.
#ifndef RHW_ROW_SAMPLE_H
#define RHW_ROW_SAMPLE_H

#include "kernels/tile_work.h"

// Return the sample of group g. Some lane of a group is live when it is queued.
RHW_INLINE int sample_of_group(const struct fragment_queue *queue, int g)
{
    return __builtin_ctz((unsigned)queue->samples[g][__builtin_ctz(queue->live[g])]);
}

#endif
