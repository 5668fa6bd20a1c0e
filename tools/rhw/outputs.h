// SPDX-License-Identifier: MIT
// What `render --output` names, and how each output becomes the samples of a PNG or PPM and the channels of
// an EXR. Data has no colours of its own: the mappings below are those that --help states.
#ifndef CLI_OUTPUTS_H
#define CLI_OUTPUTS_H

#include "draw/draw.h"
#include "image_write.h"

enum {
    CLI_OUTPUT_KINDS = SCENE_KIND_LINEAR
}; ///< those with a word of their own, the first of enum scene_output_kind

/// "color,depth" or "all" to a set of 1 << kind. False when a name is unknown; `*bad` is that name's start.
bool cli_outputs_parse(const char *list, unsigned *kinds, const char **bad);

/// What has to be drawn (enum scene_output) for those kinds in that format with that many bits, 0 the default.
uint32_t cli_outputs_needed(unsigned kinds, enum cli_picture_format format, int bits);

/// A picture of one output as a raster; must live while the raster is written.
struct cli_output_raster {
    struct cli_raster raster;
    const struct scene_pictures *pictures;
    const float *floats; // [stride] per pixel
    const uint32_t *ids;
    int stride;
    float low[3], scale[3]; // sample = (value − low) · scale
};

/// `bits` 0: 16 for depth and distance, else 8. `bounds` are those of the model, for positions,
/// and count from the origin of the pictures.
void cli_output_rasterize(struct cli_output_raster *output, const struct scene_pictures *pictures,
                          enum scene_output_kind kind, int bits, bool transparent, const float bounds_min[3],
                          const float bounds_max[3]);

enum { CLI_EXR_CHANNELS_MAX = 36 };

/// The channels of all `kinds`; returns their number. Positions of a model far from the origin are made in the
/// coordinates of the file, and stand beside those that are counted from the origin: free `positions` when the file is
/// written. Returns 0 where there is not enough memory.
int cli_outputs_exr_channels(const struct scene_pictures *pictures, unsigned kinds,
                             struct cli_exr_channel channels[CLI_EXR_CHANNELS_MAX], float **positions);

/// The camera, and the names of the ids of objects, which live as long as the model; free `about->objects`. `origin` is
/// that of the pictures. False: there is not enough memory.
bool cli_outputs_exr_describe(const struct scene_model *model, const struct scene_camera *camera,
                              double aspect, const double origin[3], struct cli_exr_about *about);

#endif
