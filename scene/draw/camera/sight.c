// SPDX-License-Identifier: MIT
// What a camera has in its picture.
#include "camera.h"
#include "coverage.h"
#include "subject.h"

// The model may cover so many times fewer pixels than it covers when it is fitted. In a thumbnail of 128 pixels, it is
// then as large as an icon of 32. Cameras that were made for their model show more of it, and Blender's factory camera,
// which stands in the files of small parts, mostly less.
static const uint32_t largest_ratio = 16;
// Who asks for a camera may want a model that is small in its picture, but hardly a dot.
static const uint32_t largest_ratio_asked = 256;

static bool is_inside(const struct scene_model *model, const struct scene_camera *camera)
{
    const struct scene_box frame = scene_subject_frame(model);
    const struct scene_camera own = scene_camera_from_origin(camera, model->origin);
    return scene_box_surrounds(&frame, own.eye);
}

// Return true if the matrix puts a point into the view volume.
static bool is_seen(const double matrix[16], const float p[3])
{
    double clip[4];
    for (int i = 0; i < 4; i++) {
        clip[i] = matrix[i] * (double)p[0] + matrix[4 + i] * (double)p[1] + matrix[8 + i] * (double)p[2] +
                  matrix[12 + i];
    }
    return clip[0] >= -clip[3] && clip[0] <= clip[3] && clip[1] >= -clip[3] && clip[1] <= clip[3] &&
           clip[2] >= 0 && clip[2] <= clip[3];
}

// Return the part of the vertices that the camera has in its picture, 0..1.
static double seen_share(const struct scene_model *model, const struct scene_camera *camera, double aspect)
{
    double view[16], projection[16], both[16];
    const struct scene_camera own = scene_camera_from_origin(camera, model->origin);
    scene_camera_view(&own, view);
    scene_camera_projection(camera, aspect, projection);
    scene_matrix_multiply(projection, view, both);
    uint64_t seen = 0, all = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *const instance = &model->instances[i];
        const struct scene_mesh *const mesh = &model->meshes[instance->mesh];
        double world[16], matrix[16];
        if (instance->unseen) {
            continue;
        }
        for (int k = 0; k < 16; k++) {
            world[k] = (double)instance->world[k];
        }
        scene_exact_place(instance->world + 12, instance->place, world + 12);
        scene_matrix_multiply(both, world, matrix);
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            seen += is_seen(matrix, mesh->positions[v]);
        }
        all += mesh->vertex_count;
    }
    return all == 0 ? 1 : (double)seen / (double)all;
}

int scene_camera_digits(const double eye[3], const double target[3])
{
    const double far = 1000.0;
    double distance2 = 0.0, eye2 = 0.0;
    for (int i = 0; i < 3; i++) {
        distance2 += (eye[i] - target[i]) * (eye[i] - target[i]);
        eye2 += eye[i] * eye[i];
    }
    return eye2 > far * far * distance2 ? 15 : 9;
}

bool scene_camera_shows_most(const struct scene_model *model, const struct scene_camera *camera,
                             double aspect)
{
    return !is_inside(model, camera) && seen_share(model, camera, aspect) >= 0.5;
}

bool scene_camera_is_believable(const struct scene_model *model, const struct scene_camera *camera,
                                double aspect)
{
    return seen_share(model, camera, aspect) >= (is_inside(model, camera) ? 0.2 : 0.01);
}

// Return what a camera that gives way sees. `covered` is a number of pixels of the model.
static enum scene_sight poor_sight(const struct scene_model *model, const struct scene_camera *camera,
                                   double aspect, uint32_t covered)
{
    return covered > 0 || seen_share(model, camera, aspect) > 0 ? SCENE_SIGHT_NEXT_TO_NOTHING
                                                                : SCENE_SIGHT_NOTHING;
}

// Return true if a fitted model would cover more than `ratio` times as many pixels as it does in a camera's picture.
// Write how many it covers there to `*covered`, which is exact in that case.
static bool is_dwarfed(const struct scene_model *model, const struct scene_camera *camera, double aspect,
                       uint32_t ratio, uint32_t *covered)
{
    // A model covers a whole picture at most.
    const uint32_t ample = scene_coverage_cells(aspect) / ratio + 1;
    *covered = scene_coverage_count(model, camera, aspect, ample);
    if (*covered >= ample) {
        return false;
    }
    const struct scene_camera fitted = scene_camera_fit(model, scene_camera_default_orbit(model, model->up),
                                                        scene_camera_default_yfov(), aspect);
    const uint32_t much = *covered * ratio + 1;
    return scene_coverage_count(model, &fitted, aspect, much) >= much;
}

enum scene_sight scene_camera_sight(const struct scene_model *model, const struct scene_camera *camera,
                                    double aspect)
{
    if (model->doubts_cameras && !scene_camera_is_believable(model, camera, aspect)) {
        return poor_sight(model, camera, aspect, scene_coverage_count(model, camera, aspect, 1));
    }
    uint32_t covered;
    return is_dwarfed(model, camera, aspect, largest_ratio, &covered)
               ? poor_sight(model, camera, aspect, covered)
               : SCENE_SIGHT_ENOUGH;
}

bool scene_camera_shows_a_dot(const struct scene_model *model, const struct scene_camera *camera,
                              double aspect)
{
    uint32_t covered;
    return is_dwarfed(model, camera, aspect, largest_ratio_asked, &covered);
}
