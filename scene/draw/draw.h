// SPDX-License-Identifier: MIT
// How a model becomes pictures with librhw. Upload once (scene_create), draw as often as you like.
//
// Two kinds of passes make the outputs; draw.c has the order of all steps. The colour pass runs on a grid of samples
// per pixel. The data pass (depth, normal, ids, ...) runs once per pixel, at its centre, so that what it gives does not
// depend on the number of samples and is never a mixture of two surfaces.
#ifndef SCENE_DRAW_H
#define SCENE_DRAW_H

#include "rhw/rhw.h"
#include "output_table.h"
#include "scene_view.h"

struct scene_draw_stats {
    double upload_ms; ///< time that scene_create took for buffers, textures and mip chains
    double light_ms;  ///< wall time of what stands before the colours: light, shadows, sorting
    double color_ms, data_ms, resolve_ms; ///< wall time of the passes
    double read_ms;                       ///< copying the pictures out
    /// Sums over the colour and data passes; peaks and tiles: the largest. The triangle of the background
    /// is not counted, its fragments are.
    struct rhw_stats pipeline;
};

struct scene; ///< an uploaded model

/// Uploads `model`, which must outlive the scene. The scene belongs to the context; destroy it first.
enum rhw_result scene_create(rhw_context *context, const struct scene_model *model, struct scene **scene);
void scene_destroy(struct scene *scene);
/// Draws another pose of the model from now on: its meshes and instances, with the materials and images that are
/// uploaded. `pose` has as many materials and images, and must outlive the scene or live until the next pose is set. On
/// failure destroy the scene.
enum rhw_result scene_set_pose(struct scene *scene, const struct scene_model *pose);

/// Draws a view that scene_view_check accepts. `stats` may be NULL. On failure `*pictures` is zeroed. Meanwhile the
/// context asks the view whether to go on (rhw_context_set_goes_on); afterwards it asks nobody.
enum rhw_result scene_draw(struct scene *scene, const struct scene_view *view,
                           struct scene_pictures *pictures, struct scene_draw_stats *stats);

/// The panorama whose light the scene has in memory, which no draw but one by another panorama, or by none, makes anew:
/// as long as it is this one, no other may lie at its address. NULL: none.
const struct scene_panorama *scene_lit_by(const struct scene *scene);

#endif
