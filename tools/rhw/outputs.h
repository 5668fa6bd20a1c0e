// SPDX-License-Identifier: MIT
// What `render --output` names, and how each output becomes the samples of a PNG or PPM and the channels of
// an EXR. Data has no colours of its own: the mappings below are those that --help states.
#ifndef RHW_OUTPUTS_H
#define RHW_OUTPUTS_H

#include "draw.h"
#include "image_write.h"

enum rhw_output_kind {
    RHW_KIND_COLOR,
    RHW_KIND_DEPTH,
    RHW_KIND_DISTANCE,
    RHW_KIND_NORMAL,
    RHW_KIND_POSITION,
    RHW_KIND_UV,
    RHW_KIND_OBJECT,
    RHW_KIND_TRIANGLE,
    RHW_KIND_BARY,
    RHW_KIND_COUNT
};

/// "color", "depth", ...
const char *rhw_output_name(enum rhw_output_kind kind);

/// "color,depth" or "all" to a set of 1 << kind. False when a name is unknown; `*bad` is that name's start.
bool rhw_outputs_parse(const char *list, unsigned *kinds, const char **bad);

/// What has to be drawn (enum rhw_output) for those kinds in that format with that many bits, 0 the default.
uint32_t rhw_outputs_needed(unsigned kinds, enum rhw_picture_format format, int bits);

/// A picture of one output as a raster; must live while the raster is written.
struct rhw_output_raster {
    struct rhw_raster raster;
    const struct rhw_pictures *pictures;
    const float *floats; // [stride] per pixel
    const uint32_t *ids;
    int stride;
    float low[3], scale[3]; // sample = (value − low) · scale
};

/// `bits` 0: 16 for depth and distance, else 8. `bounds` are those of the model, for positions.
void rhw_output_rasterize(struct rhw_output_raster *output, const struct rhw_pictures *pictures,
                          enum rhw_output_kind kind, int bits, bool transparent, const float bounds_min[3],
                          const float bounds_max[3]);

enum { RHW_EXR_CHANNELS_MAX = 32 };

/// The channels of all `kinds`; returns their number.
int rhw_outputs_exr_channels(const struct rhw_pictures *pictures, unsigned kinds,
                             struct rhw_exr_channel channels[RHW_EXR_CHANNELS_MAX]);

#endif
