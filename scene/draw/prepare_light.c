// SPDX-License-Identifier: MIT
// What light needs to know of the whole picture before any of it is drawn.
#include "drawing.h"

#include "draw/camera/subject.h"

// Of the subject's radius: how far things occlude each other.
static const double occlusion_reach = 0.2;

enum rhw_result scene_draw_surround(struct draw *draw)
{
    struct scene *scene = draw->scene;
    const struct scene_view *view = draw->view;
    if (!view->panorama) {
        scene_surroundings_destroy(scene->upload.context, &scene->surroundings);
        return RHW_OK;
    }
    const enum rhw_result result = scene_surroundings_make(&scene->surroundings, scene->upload.context, view);
    if (result == RHW_OK) {
        scene_lighting_surround(&draw->lighting, &scene->surroundings, view->exposure);
    }
    return result;
}

// Half the diagonal of the box around what the picture is about.
static double subject_radius(const struct scene_model *model)
{
    const struct scene_subject subject = scene_subject_find(model);
    return 0.5 * scene_box_diagonal(&subject.box);
}

enum rhw_result scene_draw_ground(struct draw *draw)
{
    struct scene *const scene = draw->scene;
    if (!draw->view->ground || draw->frame.plain) {
        scene_ground_destroy(&scene->ground);
        return RHW_OK;
    }
    return scene_ground_make(&scene->ground, scene->upload.context, scene->upload.model, draw->view->up);
}

// Whether light asks what is nearest in the picture.
static bool is_guided(const struct draw *draw)
{
    return (draw->view->ambient_occlusion || draw->view->shadows) && !draw->frame.plain;
}

// The second guide has what is seen through surfaces.
static int guide_count(const struct draw *draw)
{
    return scene_backdrop_wanted(draw) ? 2 : 1;
}

enum rhw_result scene_draw_guide(struct draw *draw)
{
    struct scene *const scene = draw->scene;
    if (!is_guided(draw)) {
        return RHW_OK;
    }
    struct scene_guide *const guides[2] = {&scene->guide, &scene->solid_guide};
    const int count = guide_count(draw);
    if (count == 1) {
        scene_guide_destroy(scene->upload.context, &scene->solid_guide); // shadow maps are fitted to both
    }
    enum rhw_result result = RHW_OK;
    for (int i = 0; i < count && result == RHW_OK; i++) {
        result =
            scene_guide_draw(guides[i], &scene->upload, scene->ground.is_made ? &scene->ground.upload : NULL,
                             &scene->pipelines, draw->view, &draw->frame, i == 1, draw->view_projection);
    }
    return result;
}

enum rhw_result scene_draw_occlusion(struct draw *draw)
{
    struct scene *const scene = draw->scene;
    if (!is_guided(draw)) {
        return RHW_OK;
    }
    struct scene_guide *const guides[2] = {&scene->guide, &scene->solid_guide};
    const double radius = occlusion_reach * subject_radius(scene->upload.model);
    const int count = draw->view->ambient_occlusion ? guide_count(draw) : 0;
    enum rhw_result result = RHW_OK;
    for (int i = 0; i < count && result == RHW_OK; i++) {
        result = scene_guide_occlude(guides[i], scene->upload.context, scene->nearest, draw->view, radius);
    }
    draw->frame.guide = scene_guide_lookup(&scene->guide, draw->view);
    return result;
}

enum rhw_result scene_draw_shadows(struct draw *draw)
{
    struct scene *const scene = draw->scene;
    const struct scene_guide *const guides[2] = {&scene->guide, &scene->solid_guide};
    return is_guided(draw) && draw->view->shadows
               ? scene_shadows_draw(&scene->shadows, &scene->upload, &scene->pipelines, draw->view, guides,
                                    &draw->frame, &draw->lighting)
               : RHW_OK;
}
