// SPDX-License-Identifier: MIT
// How the instances of a model become draws of a pass: their order, their uniforms, their pipelines.
#ifndef SCENE_SURFACE_H
#define SCENE_SURFACE_H

#include "surface_pass.h"

struct scene_lighting;

/// Sets what a frame has from the camera and the lights, which must outlive it, and `view_projection` for a
/// picture of that aspect. Light goes to attachment 0 as it is displayed, and nowhere before tone mapping.
void scene_frame_look(struct scene_frame *frame, const struct scene_camera *camera, double aspect,
                      const struct scene_lighting *lighting, double view_projection[16]);

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
