// SPDX-License-Identifier: MIT
#include "shadow.h"

#include "draw/camera/camera_math.h"
#include "draw/camera/subject.h"
#include "screen.h"
#include "draw/shading/shade_shadow.h"

#include <string.h>

// What a light sees: axes to the right and up in its picture, and ahead.
struct frame {
    double origin[3], right[3], up[3], ahead[3];
};

struct box2 {
    double low[2], high[2];
};

// Frames --------------------------------------------------------------------------------------------

static void normalize(double v[3])
{
    const double length = __builtin_sqrt(scene_dot(v, v));
    for (int c = 0; c < 3; c++) {
        v[c] /= length;
    }
}

// `upward` need not be perpendicular; where it is parallel another is taken.
static struct frame look(const double ahead[3], const double upward[3])
{
    struct frame f = {.ahead = {ahead[0], ahead[1], ahead[2]}};
    normalize(f.ahead);
    scene_cross(f.ahead, upward, f.right);
    if (scene_dot(f.right, f.right) < 1e-6 * scene_dot(upward, upward)) {
        const double other[3] = {f.ahead[1], f.ahead[2], -f.ahead[0]};
        scene_cross(f.ahead, other, f.right);
    }
    normalize(f.right);
    scene_cross(f.right, f.ahead, f.up);
    return f;
}

static void set_row(struct scene_shadow_map *map, int row, const double axis[3], double scale, double offset)
{
    for (int c = 0; c < 3; c++) {
        map->rows[row][c] = (float)(axis[c] * scale);
    }
    map->rows[row][3] = (float)offset;
}

static void set_parallel(struct scene_shadow_map *map, const struct frame *f, const struct box2 *seen,
                         double near, double far)
{
    const double margin = (double)scene_shadow_widest + 2.0, size = map->size;
    const double width = seen->high[0] - seen->low[0], height = seen->high[1] - seen->low[1];
    const double unit = (size - 2.0 * margin) / (width > height ? width : height);
    const double middle[2] = {0.5 * (seen->low[0] + seen->high[0]), 0.5 * (seen->low[1] + seen->high[1])};
    static const double none[3] = {0.0, 0.0, 0.0};
    set_row(map, 0, f->right, unit, 0.5 * size - unit * middle[0]);
    set_row(map, 1, f->up, -unit, 0.5 * size + unit * middle[1]);
    set_row(map, 2, f->ahead, -1.0 / (far - near), far / (far - near));
    set_row(map, 3, none, 0.0, 1.0);
    map->perspective = 0;
    map->unit = (float)unit;
    map->range = (float)(far - near);
}

// `spread`: the tangent of half the angle that is seen.
static void set_perspective(struct scene_shadow_map *map, const struct frame *f, double spread, double near)
{
    const double half = 0.5 * map->size, unit = half / spread;
    double across[3], down[3];
    for (int c = 0; c < 3; c++) {
        across[c] = half * f->ahead[c] + unit * f->right[c];
        down[c] = half * f->ahead[c] - unit * f->up[c];
    }
    static const double none[3] = {0.0, 0.0, 0.0};
    set_row(map, 0, across, 1.0, -scene_dot(across, f->origin));
    set_row(map, 1, down, 1.0, -scene_dot(down, f->origin));
    set_row(map, 2, none, 0.0, near);
    set_row(map, 3, f->ahead, 1.0, -scene_dot(f->ahead, f->origin));
    map->perspective = 1;
    map->unit = (float)unit;
    map->range = (float)near;
}

// Fitting -------------------------------------------------------------------------------------------

static void extend(struct box2 *box, const struct frame *f, const double p[3])
{
    const double at[2] = {scene_dot(f->right, p), scene_dot(f->up, p)};
    for (int i = 0; i < 2; i++) {
        box->low[i] = at[i] < box->low[i] ? at[i] : box->low[i];
        box->high[i] = at[i] > box->high[i] ? at[i] : box->high[i];
    }
}

// Extend a box by where the light sees the corners of another.
static void extend_by_corners(struct box2 *box, const struct frame *f, const struct scene_box *by)
{
    for (int i = 0; i < 8; i++) {
        double corner[3];
        scene_box_corner(by, i, corner);
        extend(box, f, corner);
    }
}

// Extend a box by where the light sees what is in the picture. Every other texel of the guide will do, since the map
// has a margin.
static void extend_by_seen(struct box2 *box, const struct scene_guide *guide, const struct scene_view *view,
                           const struct frame *f)
{
    enum { STEP = 2 };
    const struct scene_guide_rays rays = scene_guide_rays(view);
    for (int y = 0; y < guide->height; y += STEP) {
        const float *row = &guide->distance.texels[(size_t)y * (size_t)guide->distance.pitch];
        for (int x = 0; x < guide->width; x += STEP) {
            if (row[x] < 1e30f) {
                double p[3];
                scene_guide_place(&rays, x + 0.5, y + 0.5, (double)row[x], p);
                extend(box, f, p);
            }
        }
    }
}

// Find the box of what casts shadows. Specks that are hundreds of times as far away as the model is large would leave
// no precision to it.
static struct scene_box find_casters(const struct scene_model *model)
{
    const struct scene_box frame = scene_subject_frame(model);
    const double reach = 100.0 * scene_box_diagonal(&frame);
    struct scene_box box;
    for (int c = 0; c < 3; c++) {
        const double low = (double)model->bounds_min[c], high = (double)model->bounds_max[c];
        box.low[c] = low > frame.low[c] - reach ? low : frame.low[c] - reach;
        box.high[c] = high < frame.high[c] + reach ? high : frame.high[c] + reach;
    }
    return box;
}

// Find the box of what casts shadows into a part of the map. Of a model that is scattered it is the box of the
// instances that the light sees there, as the others may be too far away for the map's precision.
static struct scene_box find_casters_over(const struct scene_model *model, const struct frame *f,
                                          const struct box2 *seen)
{
    struct scene_box casters = scene_box_empty();
    for (uint32_t i = 0; i < model->instance_count && model->is_scattered; i++) {
        const struct scene_box own = scene_subject_box(model, i);
        struct box2 across = {{1e300, 1e300}, {-1e300, -1e300}};
        extend_by_corners(&across, f, &own);
        if (across.low[0] <= seen->high[0] && across.high[0] >= seen->low[0] &&
            across.low[1] <= seen->high[1] && across.high[1] >= seen->low[1]) {
            scene_box_extend(&casters, &own);
        }
    }
    return casters.low[0] <= casters.high[0] ? casters : find_casters(model);
}

// Where casters begin and end along the light, with some room.
static void find_range(const struct scene_box *casters, const struct frame *f, double *near, double *far)
{
    *near = 1e300;
    *far = -1e300;
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        scene_box_corner(casters, corner, p);
        const double along = scene_dot(f->ahead, p);
        *near = along < *near ? along : *near;
        *far = along > *far ? along : *far;
    }
    // A millionth, or less for a model so small that this would be most of the map's depth.
    const double some = 1e-6, part = 0.01 * scene_box_diagonal(casters);
    const double room = 0.01 * (*far - *near) + (part > 0.0 && part < some ? part : some);
    *near -= room;
    *far += room;
}

// Drawing -------------------------------------------------------------------------------------------

// From the rows of the map, whose columns and rows are those of the viewport.
void scene_shadow_projection(const struct scene_shadow_map *map, double m[16])
{
    for (int c = 0; c < 4; c++) {
        const double w = (double)map->rows[3][c], scale = 2.0 / map->size;
        m[4 * c] = scale * (double)map->rows[0][c] - w;
        m[4 * c + 1] = w - scale * (double)map->rows[1][c];
        m[4 * c + 2] = (double)map->rows[2][c];
        m[4 * c + 3] = w;
    }
}

enum rhw_result scene_shadow_draw(const struct scene_upload *upload,
                                  struct scene_surface_pipelines *pipelines, const struct scene_frame *frame,
                                  const struct scene_shadow_map *map, const struct scene_plane *plane,
                                  struct rhw_stats *stats)
{
    struct scene_surface_pass surfaces = {.frame = frame, .shadow = true};
    scene_shadow_projection(map, surfaces.view_projection);
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 0;
    def.depth =
        (struct rhw_depth_attachment){.enabled = true, .texture = plane->texture, .load = RHW_LOAD_CLEAR};
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(upload->context, &def, &pass);
    if (result == RHW_OK) {
        result = scene_surfaces_record(upload, pipelines, &surfaces, pass);
        result = scene_pass_end(upload->context, pass, result, stats);
    }
    return result;
}

static enum rhw_result draw_map(const struct scene_upload *upload, struct scene_surface_pipelines *pipelines,
                                const struct scene_frame *frame, const struct frame *light,
                                const struct scene_shadow_map *map, const struct scene_plane *plane)
{
    struct scene_frame own = *frame;
    own.orthographic = !map->perspective;
    for (int c = 0; c < 3; c++) {
        own.eye[c] = (float)light->origin[c];
        own.forward[c] = (float)light->ahead[c];
    }
    return scene_shadow_draw(upload, pipelines, &own, map, plane, NULL);
}

// Sets a map, gives it a plane and draws it.
static enum rhw_result add_map(struct scene_shadows *shadows, const struct scene_upload *upload,
                               struct scene_surface_pipelines *pipelines, const struct scene_frame *frame,
                               const struct frame *light, const struct scene_shadow_map *set)
{
    const int number = shadows->count;
    struct scene_plane *plane = &shadows->planes[number];
    enum rhw_result result = RHW_OK;
    if (!plane->texels) {
        result = scene_plane_create(upload->context, RHW_FORMAT_D32_FLOAT, set->size, set->size, plane);
    }
    if (result == RHW_OK) {
        struct scene_shadow_map *map = &shadows->maps[number];
        *map = *set;
        map->depth = plane->texels;
        map->pitch = plane->pitch;
        shadows->count++;
        result = draw_map(upload, pipelines, frame, light, map, plane);
    }
    return result;
}

static int maps_needed(const struct scene_shader_light *light)
{
    return light->type == SCENE_LIGHT_POINT ? 6 : 1;
}

// Its maps are the next ones.
static enum rhw_result cast(struct scene_shadows *shadows, const struct scene_upload *upload,
                            struct scene_surface_pipelines *pipelines, const struct scene_view *view,
                            const struct scene_guide *const guides[2], const struct scene_frame *frame,
                            struct scene_shader_light *light)
{
    static const double faces[6][2][3] = {{{1, 0, 0}, {0, 1, 0}}, {{-1, 0, 0}, {0, 1, 0}},
                                          {{0, 1, 0}, {0, 0, 1}}, {{0, -1, 0}, {0, 0, 1}},
                                          {{0, 0, 1}, {0, 1, 0}}, {{0, 0, -1}, {0, 1, 0}}};
    struct scene_shadow_map map = {.size = SCENE_SHADOW_SIZE, .softness = light->softness};
    const struct scene_box subject = scene_subject_frame(upload->model);
    const double nearest = 1e-3 * scene_box_diagonal(&subject);
    const double sign = light->type == SCENE_LIGHT_DIRECTIONAL ? -1.0 : 1.0;
    const double along[3] = {sign * (double)light->direction[0], sign * (double)light->direction[1],
                             sign * (double)light->direction[2]};
    const double position[3] = {(double)light->position[0], (double)light->position[1],
                                (double)light->position[2]};
    const int first = shadows->count, count = maps_needed(light);
    enum rhw_result result = RHW_OK;
    for (int m = 0; m < count && result == RHW_OK; m++) {
        struct frame f = count == 6 ? look(faces[m][0], faces[m][1]) : look(along, view->camera.up);
        memcpy(f.origin, position, sizeof f.origin);
        if (light->type == SCENE_LIGHT_DIRECTIONAL) {
            struct box2 seen = {{1e300, 1e300}, {-1e300, -1e300}};
            extend_by_seen(&seen, guides[0], view, &f);
            extend_by_seen(&seen, guides[1], view, &f);
            if (!(seen.low[0] < seen.high[0] && seen.low[1] < seen.high[1])) {
                return RHW_OK; // nothing to shade
            }
            const struct scene_box casters = find_casters_over(upload->model, &f, &seen);
            double near, far;
            find_range(&casters, &f, &near, &far);
            for (int c = 0; c < 3; c++) {
                f.origin[c] = f.ahead[c] * near;
            }
            set_parallel(&map, &f, &seen, near, far);
        } else {
            // A cube's faces overlap by as much as the widest filter takes.
            const double margin = map.size / (map.size - 2.0 * ((double)scene_shadow_widest + 2.0));
            set_perspective(&map, &f, count == 6 ? margin : (double)light->spread * margin, nearest);
        }
        result = add_map(shadows, upload, pipelines, frame, &f, &map);
    }
    light->maps = &shadows->maps[first];
    light->map_count = result == RHW_OK ? count : 0;
    return result;
}

struct scene_shadow_map scene_shadow_cover(const struct scene_model *model,
                                           const struct scene_shader_light *light, const double up[3])
{
    struct scene_shadow_map map = {.size = SCENE_SHADOW_SIZE, .softness = light->softness};
    const double ahead[3] = {-(double)light->direction[0], -(double)light->direction[1],
                             -(double)light->direction[2]};
    const struct frame f = look(ahead, up);
    const struct scene_box casters = find_casters(model);
    struct box2 box = {{1e300, 1e300}, {-1e300, -1e300}};
    extend_by_corners(&box, &f, &casters);
    double near, far;
    find_range(&casters, &f, &near, &far);
    set_parallel(&map, &f, &box, near, far);
    return map;
}

enum rhw_result scene_shadows_draw(struct scene_shadows *shadows, const struct scene_upload *upload,
                                   struct scene_surface_pipelines *pipelines, const struct scene_view *view,
                                   const struct scene_guide *const guides[2], const struct scene_frame *frame,
                                   struct scene_lighting *lighting)
{
    enum rhw_result result = RHW_OK;
    shadows->count = 0;
    for (uint32_t i = 0; i < lighting->count && result == RHW_OK; i++) {
        struct scene_shader_light *light = &lighting->lights[i];
        light->map_count = 0;
        if (light->casts && shadows->count + maps_needed(light) <= SCENE_SHADOW_MAPS) {
            result = cast(shadows, upload, pipelines, view, guides, frame, light);
        }
    }
    return result;
}

void scene_shadows_destroy(rhw_context *context, struct scene_shadows *shadows)
{
    for (int i = 0; i < SCENE_SHADOW_MAPS; i++) {
        scene_plane_destroy(context, &shadows->planes[i]);
    }
    *shadows = (struct scene_shadows){0};
}
