// SPDX-License-Identifier: MIT
// What is nearest in a picture, once per pixel: how far away it is and how it is turned. Ambient occlusion is made from
// it, and shadow maps are fitted to it.
#ifndef SCENE_GUIDE_H
#define SCENE_GUIDE_H

#include "draw/shading/scene_shaders.h"
#include "surface.h"
#include "render_target.h"
#include "scene_view.h"

/// Zeroed: none.
struct scene_guide {
    int width, height; ///< the picture's, or where that is large a whole part of it
    struct scene_plane distance, occlusion, scratch;
    struct scene_target normal; ///< normals of mesh and facet in the world, folded by guide_normal.h
};

/// Draws the guide of a view, with `solid` without what light passes through. `frame` and `view_projection` are those
/// of scene_frame_look. `ground` may be NULL.
enum rhw_result scene_guide_draw(struct scene_guide *guide, const struct scene_upload *upload,
                                 const struct scene_upload *ground, struct scene_surface_pipelines *pipelines,
                                 const struct scene_view *view, const struct scene_frame *frame, bool solid,
                                 const double view_projection[16]);

/// Fills the plane of ambient occlusion: the part of its hemisphere that a pixel's surface sees open within `radius`
/// units of the world, weighted by the cosine; 1 where nothing is.
enum rhw_result scene_guide_occlude(struct scene_guide *guide, rhw_context *context, rhw_sampler nearest,
                                    const struct scene_view *view, double radius);

/// Where texels lie in the world. The centre of one, (x, y), at distance d is eye + right·(x ray[0] + ray[1])·d +
/// up·(y ray[2] + ray[3])·d + ahead·d; of an orthographic camera only the last is multiplied by d.
struct scene_guide_rays {
    double eye[3], axes[3][3]; ///< right, up, back
    double ray[4];
    bool orthographic;
};

struct scene_guide_rays scene_guide_rays(const struct scene_view *view);
void scene_guide_place(const struct scene_guide_rays *rays, double x, double y, double distance,
                       double place[3]);

/// How shaders look into it.
struct scene_guide_lookup scene_guide_lookup(const struct scene_guide *guide, const struct scene_view *view);

void scene_guide_destroy(rhw_context *context, struct scene_guide *guide);

#endif
