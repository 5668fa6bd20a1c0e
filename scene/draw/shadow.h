// SPDX-License-Identifier: MIT
// Shadow maps of a scene's lights.
//
// A directional light's map covers what is in the picture and nothing else, so that its texels are as fine as they can
// be (A. Lauritzen, M. Salvi, A. Lefohn, "Sample distribution shadow maps", I3D 2011). A spot has one map in
// perspective, a point light has six. What casts a shadow is what a camera in the light's place would see: faces that
// are culled cast none.
#ifndef SCENE_SHADOW_H
#define SCENE_SHADOW_H

#include "guide.h"
#include "light.h"

enum { SCENE_SHADOW_MAPS = 12, SCENE_SHADOW_SIZE = 1024 };

/// Zeroed: none.
struct scene_shadows {
    int count;
    struct scene_shadow_map maps[SCENE_SHADOW_MAPS];
    struct scene_plane planes[SCENE_SHADOW_MAPS];
};

/// Draws the maps of as many lights, in their order, as there are maps, and gives them to the lights; the shadows must
/// outlive their use. `guides` have the view's distances. The second has those of what is seen through surfaces, or is
/// zeroed.
enum rhw_result scene_shadows_draw(struct scene_shadows *shadows, const struct scene_upload *upload,
                                   struct scene_surface_pipelines *pipelines, const struct scene_view *view,
                                   const struct scene_guide *const guides[2], const struct scene_frame *frame,
                                   struct scene_lighting *lighting);
/// A map of a directional light, of `size` texels each way, that covers all of the model; it has no plane yet.
struct scene_shadow_map scene_shadow_cover(const struct scene_model *model,
                                           const struct scene_shader_light *light, const double up[3]);
/// World to clip coordinates of a map, with reversed depth.
void scene_shadow_projection(const struct scene_shadow_map *map, double matrix[16]);
/// Draws a map into its plane. `frame` looks as the light does. `stats` of the pass, or NULL.
enum rhw_result scene_shadow_draw(const struct scene_upload *upload,
                                  struct scene_surface_pipelines *pipelines, const struct scene_frame *frame,
                                  const struct scene_shadow_map *map, const struct scene_plane *plane,
                                  struct rhw_stats *stats);
void scene_shadows_destroy(rhw_context *context, struct scene_shadows *shadows);

#endif
