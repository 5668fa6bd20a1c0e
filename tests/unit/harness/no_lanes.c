// SPDX-License-Identifier: MIT
// Compiled with RHW_NO_LANES.
#include "no_lanes.h"
#include "one_at_a_time.h"

float no_lanes_math(int number, float a, float b)
{
    return one_math(number, a, b);
}

void no_lanes_vertex(struct rhw_vertex1 *vertex)
{
    one_vertex(vertex);
}

void no_lanes_fragment(struct rhw_fragment1 *fragment)
{
    one_fragment(fragment);
}
