// SPDX-License-Identifier: MIT
// The golden scenes by subject; golden.c lists them with their names. Each draws into a fresh context; `number`
// tells variants of one scene apart.
#ifndef GOLDEN_SCENES_H
#define GOLDEN_SCENES_H

#include "golden_board.h"

typedef void golden_draw_function(rhw_context *context, int number, struct golden_images *images);

/// Solids, floors, shards. The name is NULL beyond the last.
const char *golden_shape_name(int number);
golden_draw_function golden_shape_draw;

// golden_output.c
golden_draw_function golden_blend_draw;      ///< all factors with all operations, on all formats that blend
golden_draw_function golden_write_mask_draw; ///< all masks, replacing and blending
golden_draw_function golden_formats_draw; ///< eight targets at once; infinities, NaN, denormals, what overflows
golden_draw_function golden_passes_draw; ///< load and store operations over four passes

// golden_targets.c
golden_draw_function golden_targets_draw; ///< eight colour formats at once; masks, logic operations, blending

// golden_raster.c
golden_draw_function golden_depth_draw; ///< comparisons, writing or not, both depth ranges, reversed viewports
golden_draw_function golden_culling_draw;  ///< culling, windings, orientations, the facing builtin
golden_draw_function golden_topology_draw; ///< lists, strips, fans, restart, provoking vertex, index types
golden_draw_function golden_viewport_draw; ///< viewports off the grid and off the target, scissors
golden_draw_function golden_clipping_draw; ///< each plane, behind the eye, far outside; by qualifier

// golden_samples.c
golden_draw_function golden_stencil_draw; ///< operations, masks, bias, clamping, bounds; by the format of depth
golden_draw_function
    golden_samples_draw; ///< 2 << number samples; sampling, masks, alpha, early and late, lines

// golden_areas.c
golden_draw_function
    golden_areas_draw; ///< render areas, line loops; samples kept and resolved, depth and stencil too

// golden_stencil_views.c
golden_draw_function golden_stencil_views_draw; ///< stencil of every format that a pass left, sampled as bytes

// golden_primitives.c
golden_draw_function
    golden_primitives_draw; ///< points, lines, polygon modes, adjacency, clip and cull distances

// golden_routing.c
golden_draw_function
    golden_routing_draw; ///< one pass draws six faces of a cube, in four viewports; sampled again

// golden_queries.c
golden_draw_function
    golden_queries_draw; ///< counts, and vertices kept and drawn again; 1 or 4 samples by number

// golden_vertices.c
golden_draw_function golden_vertex_format_draw; ///< vertex formats, odd strides and offsets
golden_draw_function golden_instances_draw;     ///< per-instance attributes, first instance, ids

// golden_textures.c
golden_draw_function golden_sampler_draw; ///< addresses, filters, mip filters, level bounds, bias, border
golden_draw_function
    golden_texel_draw; ///< every sampled format and every level of odd sizes; mirrored, mirrored once
golden_draw_function golden_chain_draw; ///< what one pass draws, the next samples

// golden_blocks.c
golden_draw_function
    golden_blocks_draw; ///< every compressed format, in levels that end within a block; 1: in parts
// golden_kinds.c
golden_draw_function golden_kinds_draw; ///< textures of every kind, asked in every way
golden_draw_function
    golden_layers_draw; ///< layers, faces and slices drawn into, their levels, and sampled again

golden_draw_function golden_views_draw; ///< views of every kind, sampled and drawn into

// golden_transfers.c
golden_draw_function
    golden_transfers_draw; ///< texels scaled, converted, resolved, cleared and copied without passes

// golden_fragments.c
golden_draw_function golden_builtins_draw; ///< coordinates, weights, derivatives, ids as floats and integers
golden_draw_function golden_offsets_draw;  ///< rhw_interpolate_at; centres, centroids and samples
golden_draw_function golden_heights_draw;  ///< fragment depth, discard, derivatives
golden_draw_function golden_maths_draw; ///< shader maths; 0: ordinary arguments, 1: the whole range of floats
golden_draw_function golden_single_draw; ///< the one-at-a-time form of vertex and fragment functions

// golden_storage.c
golden_draw_function golden_storage_draw; ///< lists of fragments by atomics, vertices counted

// golden_dispatch.c
golden_draw_function golden_dispatch_draw; ///< workgroups, and what they and draws get of atomics

// golden_glsl.c
golden_draw_function
    golden_glsl_draw; ///< translated shaders; 0: a sphere, 1: four targets and lights, 2: a dispatch

// golden_gallery.c: models as `rhw render` draws them, with all its outputs
golden_draw_function golden_gallery_draw; ///< every kind of material and light; numbers are views
golden_draw_function golden_model_draw;   ///< real models that stand in models/; numbers are models

/// Where models/ stands; set before the first draw.
void golden_models_at(const char *folder);

#endif
