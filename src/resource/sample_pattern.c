// SPDX-License-Identifier: MIT
// The tables of sample_pattern.h.
#include "sample_pattern.h"

#include "base/constants.h"
#include "rhw/rhw.h"

#define AT(sixteenths) ((sixteenths)*RHW_SUBPIXEL / 16)

// The patterns are those of Vulkan 1.3 §27.5, table "Standard sample locations", and Direct3D 11.3 §19.2.4.1.
static const struct rhw_sample_pattern patterns[] = {
    {1, {AT(8)}, {AT(8)}, AT(8), AT(8)},
    {2, {AT(12), AT(4)}, {AT(12), AT(4)}, AT(4), AT(12)},
    {4, {AT(6), AT(14), AT(2), AT(10)}, {AT(2), AT(6), AT(10), AT(14)}, AT(2), AT(14)},
    {8,
     {AT(9), AT(7), AT(13), AT(5), AT(3), AT(1), AT(11), AT(15)},
     {AT(5), AT(11), AT(9), AT(3), AT(13), AT(7), AT(15), AT(1)},
     AT(1),
     AT(15)},
    {16,
     {AT(9), AT(7), AT(5), AT(12), AT(3), AT(10), AT(13), AT(11), AT(6), AT(8), AT(4), AT(2), AT(0), AT(15),
      AT(14), AT(1)},
     {AT(9), AT(5), AT(10), AT(7), AT(6), AT(13), AT(11), AT(3), AT(14), AT(1), AT(2), AT(12), AT(8), AT(4),
      AT(15), AT(0)},
     AT(0),
     AT(15)},
};

const struct rhw_sample_pattern *rhw_sample_pattern_of(int samples)
{
    int i = 0;
    while (patterns[i].count != samples) {
        i++;
    }
    return &patterns[i];
}

bool rhw_sample_position(int samples, int sample, float position[2])
{
    const bool valid = rhw_sample_count_valid(samples) && sample >= 0 && sample < samples;
    const struct rhw_sample_pattern *const pattern = rhw_sample_pattern_of(valid ? samples : 1);
    position[0] = (float)pattern->x_0_8[valid ? sample : 0] / RHW_SUBPIXEL;
    position[1] = (float)pattern->y_0_8[valid ? sample : 0] / RHW_SUBPIXEL;
    return valid;
}
