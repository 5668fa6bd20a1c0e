// SPDX-License-Identifier: MIT
// What a pass wants of every surface, and what becomes of it: the key of a pipeline.
#ifndef SCENE_SURFACE_PASS_H
#define SCENE_SURFACE_PASS_H

#include "scene_view.h"
#include "explain_sample.h"
#include "triangle_order.h"
#include "upload.h"

struct scene_program_draws;

/// A pass of PEELED draws blended surfaces without blending, of each pixel the farthest that is nearer than `peeled`. A
/// pass of GLASS draws surfaces that light passes through in the same way, and one of BLENDED draws blended surfaces.
enum scene_surface_part {
    SCENE_SURFACES_ALL,
    SCENE_SURFACES_OPAQUE,
    SCENE_SURFACES_BLENDED,
    SCENE_SURFACES_PEELED,
    SCENE_SURFACES_GLASS
};

/// What a pass wants of every surface.
struct scene_surface_pass {
    const struct scene_frame *frame; ///< must live until the pass has ended
    uint32_t data_outputs;           ///< scene_output of a data pass; 0: a colour pass
    bool shadow;                     ///< depth alone, of what casts a shadow
    bool solid;                      ///< without what light passes through
    enum scene_surface_part part;
    const struct scene_triangle_order *order; ///< order of the triangles of blended surfaces; NULL: the model's
    struct scene_draw_log *log;               ///< gets what each draw draws; NULL: nothing does
    bool guide; ///< a data pass of scene_guide: distances, and the normals of mesh and facets
    const struct scene_program_draws *program; ///< shades triangles instead of their materials; NULL: none does
    enum rhw_qualifier interpolate;
    enum scene_wireframe wireframe;
    enum rhw_format formats[RHW_MAX_COLOR_ATTACHMENTS];
    int format_count;
    double view_projection[16]; ///< depth reversed
    rhw_texture environment;    ///< with frame->environment.mapped: the cube
    rhw_sampler environment_sampler;
    rhw_texture backdrop; ///< what is seen through surfaces, with levels; null: none is
    rhw_sampler backdrop_sampler;
    rhw_texture peeled; ///< with frame->peel_samples: what fragments must be nearer than, or behind
    rhw_sampler peeled_sampler;
};

/// Everything a pipeline is made from, as plain integers without padding, so that keys compare as bytes.
struct scene_surface_key {
    int32_t vertex, fragment;
    int32_t attribute_count, stride, attributes[SCENE_MESH_ATTRIBUTES][2]; // format, offset
    int32_t varying_count, varyings[RHW_MAX_VARYINGS];                     // components
    int32_t stream_count;    // the last varyings, which need derivatives
    int32_t position_number; // 1 + that of its varying
    int32_t position_derivatives;
    int32_t interpolate, uses, cull, front, blend, peel, ground;
    int32_t counts;          // adds to the target, whatever is nearer
    int32_t program, absent; // the caller's own shades it; bits of the attributes that the mesh lacks
    int32_t format_count, formats[RHW_MAX_COLOR_ATTACHMENTS];
};

#endif
