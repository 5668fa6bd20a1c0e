// SPDX-License-Identifier: MIT
// How the instances of a model become draws of a pass: their order, their uniforms, their pipelines.
#ifndef SCENE_SURFACE_H
#define SCENE_SURFACE_H

#include "scene_view.h"
#include "explain_sample.h"
#include "triangle_order.h"
#include "upload.h"

struct scene_lighting;
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

/// Sets what a frame has from the camera and the lights, which must outlive it, and `view_projection` for a
/// picture of that aspect. Light goes to attachment 0 as it is displayed, and nowhere before tone mapping.
void scene_frame_look(struct scene_frame *frame, const struct scene_camera *camera, double aspect,
                      const struct scene_lighting *lighting, double view_projection[16]);

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

/// Pipelines made so far. Zeroed: none.
struct scene_surface_pipelines {
    struct scene_surface_key *keys;
    rhw_pipeline *ids;
    uint32_t count, capacity;
};

/// Records all instances: opaque ones from front to back, which lets the depth test save work, then blended
/// ones from back to front. A data pass takes both alike.
enum rhw_result scene_surfaces_record(const struct scene_upload *upload,
                                      struct scene_surface_pipelines *pipelines,
                                      const struct scene_surface_pass *def, rhw_pass pass);
void scene_surface_pipelines_destroy(rhw_context *context, struct scene_surface_pipelines *pipelines);

/// One instance in drawing order.
struct scene_surface_item {
    uint32_t instance;
    bool blended;
    double distance; ///< distance of the middle of its box along the view
};

/// The instances of the model that draw anything, in drawing order: opaque ones from front to back, then
/// blended ones (none where `blends` is false: they count as opaque) from back to front. `items` has room
/// for all instances. Returns how many there are.
size_t scene_surface_items_list(const struct scene_model *model, const struct scene_frame *frame, bool blends,
                                struct scene_surface_item *items);

/// Puts items into drawing order; equal ones keep the order of their instances.
void scene_surface_items_sort(struct scene_surface_item *items, size_t count);

#endif
