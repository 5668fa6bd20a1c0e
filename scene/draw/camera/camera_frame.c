// SPDX-License-Identifier: MIT
#include "camera_frame.h"

#include "camera_math.h"
#include "elementary.h"

static const double degree = 3.14159265358979323846 / 180.0;

// Change the lens as a zoom does: what is seen changes, the place from which it is seen does not.
static void zoom(struct scene_camera *camera, double factor)
{
    if (camera->orthographic) {
        camera->ymag /= factor;
    } else {
        camera->yfov = 2.0 * scene_atan(scene_tan(0.5 * camera->yfov) / factor);
    }
}

// Return a camera with so narrow an angle of view that there is no perspective to speak of, moved to the model.
static struct scene_camera fit_orthographic(const struct scene_model *model, struct scene_orbit orbit,
                                            double aspect)
{
    const double narrow = 0.1 * degree;
    struct scene_camera camera = scene_camera_fit(model, orbit, narrow, aspect);
    double ahead[3];
    for (int c = 0; c < 3; c++) {
        ahead[c] = camera.target[c] - camera.eye[c];
    }
    const double distance = __builtin_sqrt(scene_dot(ahead, ahead));
    camera.orthographic = true;
    camera.ymag = distance * scene_tan(0.5 * narrow);
    for (int c = 0; c < 3; c++) {
        camera.eye[c] = camera.target[c] - ahead[c] / distance * 4.0 * camera.ymag;
    }
    if (orbit.turns) {
        scene_camera_enclose_turn(&camera, model, &orbit);
    } else {
        scene_camera_enclose(&camera, model);
    }
    return camera;
}

struct scene_camera scene_camera_frame(const struct scene_model *model, const struct scene_framing *framing,
                                       double aspect)
{
    const double yfov = framing->yfov > 0.0 ? framing->yfov : scene_camera_default_yfov();
    struct scene_camera camera = framing->orthographic
                                     ? fit_orthographic(model, framing->orbit, aspect)
                                     : scene_camera_fit(model, framing->orbit, yfov, aspect);
    const double usual = scene_camera_fit_margin(), margin = framing->margin < 0.0 ? usual : framing->margin;
    const double factor = framing->zoom * (1.0 - 2.0 * margin) / (1.0 - 2.0 * usual);
    if (factor < 1.0 || factor > 1.0) {
        zoom(&camera, factor);
    }
    return camera;
}
