// SPDX-License-Identifier: MIT
#include "guide.h"

#include "draw/camera/camera_math.h"
#include "screen.h"

#include <string.h>

enum { LARGEST_SIDE = 2048 };

// Of the height of the guide: what is farther on the screen does not occlude.
static const double most_reach = 0.15;

void scene_guide_destroy(rhw_context *context, struct scene_guide *guide)
{
    scene_plane_destroy(context, &guide->distance);
    scene_plane_destroy(context, &guide->occlusion);
    scene_plane_destroy(context, &guide->scratch);
    scene_target_destroy(context, &guide->normal);
    *guide = (struct scene_guide){0};
}

// Pixels of the picture along the side of a texel.
static int divisor(const struct scene_view *view)
{
    const int side = view->width > view->height ? view->width : view->height;
    return (side + LARGEST_SIDE - 1) / LARGEST_SIDE;
}

static enum rhw_result resize(struct scene_guide *guide, rhw_context *context, const struct scene_view *view)
{
    const int part = divisor(view);
    const int width = (view->width + part - 1) / part, height = (view->height + part - 1) / part;
    if (guide->width == width && guide->height == height) {
        return RHW_OK;
    }
    scene_guide_destroy(context, guide);
    guide->width = width;
    guide->height = height;
    enum rhw_result result =
        scene_plane_create(context, RHW_FORMAT_R32_FLOAT, guide->width, guide->height, &guide->distance);
    if (result == RHW_OK) {
        result = scene_target_get(context, &guide->normal, RHW_FORMAT_RGBA16_FLOAT, width, height);
    }
    if (result != RHW_OK) {
        scene_guide_destroy(context, guide);
    }
    return result;
}

// Places --------------------------------------------------------------------------------------------

struct scene_guide_rays scene_guide_rays(const struct scene_view *view)
{
    double matrix[16], projection[16];
    scene_camera_view(&view->camera, matrix);
    scene_camera_projection(&view->camera, (double)view->width / view->height, projection);
    const double part = divisor(view);
    struct scene_guide_rays rays = {.orthographic = view->camera.orthographic};
    rays.ray[0] = 2.0 * part / view->width / projection[0];
    rays.ray[1] = (-1.0 - view->camera.shift[0]) / projection[0];
    rays.ray[2] = -2.0 * part / view->height / projection[5];
    rays.ray[3] = (1.0 - view->camera.shift[1]) / projection[5];
    for (int r = 0; r < 3; r++) {
        rays.eye[r] = view->camera.eye[r];
        for (int c = 0; c < 3; c++) {
            rays.axes[r][c] = matrix[4 * c + r];
        }
    }
    return rays;
}

void scene_guide_place(const struct scene_guide_rays *rays, double x, double y, double distance,
                       double place[3])
{
    const double scale = rays->orthographic ? 1.0 : distance;
    const double right = (x * rays->ray[0] + rays->ray[1]) * scale,
                 up = (y * rays->ray[2] + rays->ray[3]) * scale;
    for (int c = 0; c < 3; c++) {
        place[c] =
            rays->eye[c] + right * rays->axes[0][c] + up * rays->axes[1][c] - distance * rays->axes[2][c];
    }
}

// Passes --------------------------------------------------------------------------------------------

enum rhw_result scene_guide_draw(struct scene_guide *guide, const struct scene_upload *upload,
                                 const struct scene_upload *ground, struct scene_surface_pipelines *pipelines,
                                 const struct scene_view *view, const struct scene_frame *frame, bool solid,
                                 const double view_projection[16])
{
    rhw_context *context = upload->context;
    enum rhw_result result = resize(guide, context, view);
    if (result != RHW_OK) {
        return result;
    }
    const int part = divisor(view);
    struct scene_frame own = *frame;
    own.samples = 1.0f;
    own.pixel[0] = (float)(2.0 * part / view->width);
    own.pixel[1] = (float)(2.0 * part / view->height);
    struct scene_surface_pass surfaces = {.frame = &own,
                                          .data_outputs = SCENE_OUTPUT_DISTANCE | SCENE_OUTPUT_NORMAL,
                                          .guide = true,
                                          .solid = solid,
                                          .formats = {RHW_FORMAT_R32_FLOAT, guide->normal.format},
                                          .format_count = 2};
    memcpy(surfaces.view_projection, view_projection, sizeof surfaces.view_projection);
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 2;
    def.colors[0] =
        (struct rhw_color_attachment){.texture = guide->distance.texture, .clear = {__builtin_inff()}};
    def.colors[1] = (struct rhw_color_attachment){.texture = guide->normal.texture};
    def.depth =
        (struct rhw_depth_attachment){.enabled = true, .load = RHW_LOAD_CLEAR, .store = RHW_STORE_DISCARD};
    rhw_pass pass;
    result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    const struct rhw_viewport viewport = {.width = (float)((double)view->width / part),
                                          .height = (float)((double)view->height / part),
                                          .depth_max = 1.0f};
    rhw_pass_set_viewport(context, pass, &viewport);
    result = ground ? scene_surfaces_record(ground, pipelines, &surfaces, pass) : RHW_OK;
    if (result == RHW_OK) {
        result = scene_surfaces_record(upload, pipelines, &surfaces, pass);
    }
    return scene_pass_end(context, pass, result, NULL);
}

static bool is_seen(float distance)
{
    return distance < 1e30f;
}

// Return the first texel of a row, from `first` on, that a surface is seen in, or `end`.
static int find_seen(const float *row, int first, int end)
{
    while (first < end && !is_seen(row[first])) {
        first++;
    }
    return first;
}

// Find a rectangle of whole blocks around all texels that surfaces are seen in. It has one texel where there are none.
static struct rhw_rect seen_rectangle(const struct scene_guide *guide)
{
    enum { BLOCK = 8 };
    int left = guide->width, right = 0, top = guide->height, bottom = 0;
    for (int y = 0; y < guide->height; y++) {
        const float *const row = &guide->distance.texels[(size_t)y * (size_t)guide->distance.pitch];
        const int first = find_seen(row, 0, guide->width);
        if (first == guide->width) {
            continue;
        }
        int last = guide->width - 1;
        while (last >= right && !is_seen(row[last])) {
            last--;
        }
        left = first < left ? first : left;
        right = last + 1 > right ? last + 1 : right;
        top = y < top ? y : top;
        bottom = y + 1;
    }
    if (left >= right) {
        return (struct rhw_rect){0, 0, 1, 1};
    }
    left -= left % BLOCK;
    top -= top % BLOCK;
    return (struct rhw_rect){left, top, (right - left + BLOCK - 1) / BLOCK * BLOCK,
                             (bottom - top + BLOCK - 1) / BLOCK * BLOCK};
}

// Draw a plane of occlusion. All is open where nothing is seen, so that only the rectangle `seen` is shaded.
static enum rhw_result draw_plane(const struct scene_guide *guide, rhw_context *context, rhw_sampler nearest,
                                  enum scene_screen_kind kind, const struct scene_ambient *uniforms,
                                  const struct rhw_rect *seen, const struct scene_plane *plane)
{
    static const enum rhw_format format = RHW_FORMAT_R32_FLOAT;
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 1;
    def.colors[0] = (struct rhw_color_attachment){.texture = plane->texture, .clear = {1.0f}};
    def.depth = (struct rhw_depth_attachment){.enabled = false};
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result == RHW_OK) {
        rhw_pass_set_scissor(context, pass, seen);
        rhw_pass_set_texture(context, pass, 0, guide->normal.texture, nearest);
        result = scene_screen_record(context, pass, kind, &format, 1, uniforms);
        result = scene_pass_end(context, pass, result, NULL);
    }
    return result;
}

static struct scene_ambient occlusion_uniforms(const struct scene_guide *guide, const struct scene_view *view,
                                               double radius)
{
    const struct scene_guide_rays rays = scene_guide_rays(view);
    const float unit = scene_unit_for(radius);
    struct scene_ambient o = {.distance = guide->distance.texels,
                              .width = guide->width,
                              .height = guide->height,
                              .pitch = guide->distance.pitch,
                              .orthographic = rays.orthographic,
                              .unit = unit,
                              .radius = (float)(radius * (double)unit),
                              .texels = (float)(-radius / rays.ray[2]),
                              .most_texels = (float)(most_reach * guide->height)};
    for (int i = 0; i < 4; i++) {
        o.ray[i] = (float)rays.ray[i];
    }
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            o.axes[r][c] = (float)rays.axes[r][c];
        }
    }
    return o;
}

enum rhw_result scene_guide_occlude(struct scene_guide *guide, rhw_context *context, rhw_sampler nearest,
                                    const struct scene_view *view, double radius)
{
    enum rhw_result result = RHW_OK;
    if (!guide->occlusion.texels) {
        result =
            scene_plane_create(context, RHW_FORMAT_R32_FLOAT, guide->width, guide->height, &guide->occlusion);
        if (result == RHW_OK) {
            result = scene_plane_create(context, RHW_FORMAT_R32_FLOAT, guide->width, guide->height,
                                        &guide->scratch);
        }
    }
    struct scene_ambient uniforms = occlusion_uniforms(guide, view, radius);
    const struct rhw_rect seen = seen_rectangle(guide);
    if (result == RHW_OK) {
        result =
            draw_plane(guide, context, nearest, SCENE_SCREEN_OCCLUSION, &uniforms, &seen, &guide->occlusion);
    }
    uniforms.source = guide->occlusion.texels;
    uniforms.step = 1;
    if (result == RHW_OK) {
        result = draw_plane(guide, context, nearest, SCENE_SCREEN_OCCLUSION_BLUR, &uniforms, &seen,
                            &guide->scratch);
    }
    uniforms.source = guide->scratch.texels;
    uniforms.step = guide->distance.pitch;
    if (result == RHW_OK) {
        result = draw_plane(guide, context, nearest, SCENE_SCREEN_OCCLUSION_BLUR, &uniforms, &seen,
                            &guide->occlusion);
    }
    return result;
}

struct scene_guide_lookup scene_guide_lookup(const struct scene_guide *guide, const struct scene_view *view)
{
    return (struct scene_guide_lookup){.distance = guide->distance.texels,
                                       .occlusion = view->ambient_occlusion ? guide->occlusion.texels : NULL,
                                       .width = guide->width,
                                       .height = guide->height,
                                       .pitch = guide->distance.pitch,
                                       .scale = 1.0f / (float)divisor(view)};
}
