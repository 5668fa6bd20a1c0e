// SPDX-License-Identifier: MIT
// How a model becomes pictures with librhw. Upload once (rhw_scene_create), draw as often as you like.
//
// A draw has up to two passes. The colour pass runs on a grid of samples per pixel; the data pass (depth,
// normal, ids, ...) runs once per pixel, at its centre, so what it gives does not depend on the number of
// samples and is never a mixture of two surfaces.
#ifndef RHW_SCENE_DRAW_H
#define RHW_SCENE_DRAW_H

#include "camera.h"
#include "rhw/rhw.h"

/// What a draw gives; or them together. Rows top to bottom, tightly packed. Data outputs show the nearest
/// surface; a surface of alpha mode BLEND counts where its opacity is at least one half.
enum rhw_output {
    RHW_OUTPUT_COLOR = 1,     ///< tone-mapped sRGB, RGBA8, straight alpha
    RHW_OUTPUT_LINEAR = 2,    ///< light before tone mapping, RGBA32F, premultiplied, without background
    RHW_OUTPUT_DEPTH = 4,     ///< R32F: NDC depth, 0 near to 1 far; 1 where nothing is
    RHW_OUTPUT_DISTANCE = 8,  ///< R32F: world units along the view axis; +infinity where nothing is
    RHW_OUTPUT_NORMAL = 16,   ///< RGBA32F: unit world normal as shaded, turned to the viewer; w 1; else all 0
    RHW_OUTPUT_POSITION = 32, ///< RGBA32F: world position; w as above
    RHW_OUTPUT_UV = 64,       ///< RGBA32F: first texture coordinate set u, v, then 0; w as above
    RHW_OUTPUT_OBJECT = 128,  ///< R32_UINT: rhw_instance.object; 0 where nothing is
    RHW_OUTPUT_TRIANGLE =
        256, ///< R32_UINT: 1 + number of the triangle (line, point), instances in their order
    RHW_OUTPUT_BARYCENTRIC = 512, ///< RGBA32F: perspective-correct a, b, c; w as above
    RHW_OUTPUT_DISPLAY = 1024,    ///< RGBA32F: COLOR before it is sRGB encoded and rounded to 8 bits
    RHW_OUTPUT_ALL = 2047
};

enum rhw_wireframe {
    RHW_WIREFRAME_NONE,
    RHW_WIREFRAME_OVER, ///< lines over the shaded surface
    RHW_WIREFRAME_PLAIN ///< lines over one even surface
};

enum rhw_background {
    RHW_BACKGROUND_DEFAULT, ///< a soft vertical gradient
    RHW_BACKGROUND_COLOR,
    RHW_BACKGROUND_TRANSPARENT
};

struct rhw_view {
    int width, height; ///< 1..RHW_MAX_TARGET_SIZE
    int samples;       ///< per pixel for colour: 1, 4, 9 or 16, a regular grid
    struct rhw_camera camera;
    enum rhw_qualifier interpolate; ///< of all varyings: SMOOTH; NOPERSPECTIVE shows what is wrong with it
    enum rhw_wireframe wireframe;
    enum rhw_background background;
    uint8_t background_color[3]; ///< sRGB, for RHW_BACKGROUND_COLOR
    bool default_lights;         ///< leave the lights of the file off
    double exposure;             ///< stops, added to what is chosen for the lights; −20..20
    uint32_t outputs;            ///< rhw_output, at least one
};

/// 1280×720, one sample, the whole model fitted, gradient, colour.
struct rhw_view rhw_view_default(const struct rhw_model *model);

/// False with one line in `error` when the view cannot be drawn (a usage error); names the rule.
bool rhw_view_check(const struct rhw_view *view, char *error, size_t error_size);

/// Images of one draw; NULL where not asked for. Owned by the caller, freed by rhw_pictures_free.
struct rhw_pictures {
    int width, height;
    uint8_t *color;          ///< [4]
    float *linear, *display; ///< [4]
    float *depth, *distance;
    float *normal, *position, *uv, *barycentric; ///< [4]
    uint32_t *object, *triangle;
};

void rhw_pictures_free(struct rhw_pictures *pictures);

struct rhw_draw_stats {
    double upload_ms;                     ///< of rhw_scene_create: buffers, textures, mip chains
    double color_ms, data_ms, resolve_ms; ///< wall time of the passes
    double read_ms;                       ///< copying the pictures out
    /// Sums over the colour and data passes; peaks and tiles: the largest. The triangle of the background
    /// is not counted, its fragments are.
    struct rhw_stats pipeline;
};

struct rhw_scene; ///< an uploaded model

/// Uploads `model`, which must outlive the scene. The scene belongs to the context; destroy it first.
enum rhw_result rhw_scene_create(rhw_context *context, const struct rhw_model *model,
                                 struct rhw_scene **scene);
void rhw_scene_destroy(struct rhw_scene *scene);

/// Draws a view that rhw_view_check accepts. `stats` may be NULL. On failure `*pictures` is zeroed.
enum rhw_result rhw_scene_draw(struct rhw_scene *scene, const struct rhw_view *view,
                               struct rhw_pictures *pictures, struct rhw_draw_stats *stats);

#endif
