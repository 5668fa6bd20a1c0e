// SPDX-License-Identifier: MIT
// The backdrop is what is seen through surfaces that light passes through, as light before tone mapping, with a
// chain of levels, of which rough surfaces read the blurred ones.
//
// All that light does not pass through is drawn first, without blended surfaces before the nearest glass. The
// layers of glass behind the nearest follow, from the farthest on, as peel.c peels blended ones. Each layer reads
// the picture that the layers behind it are in. The nearest layer of a pixel is left to the picture itself. Of
// more layers than MOST_LAYERS the nearer ones are not seen through the nearest.
#include "drawing.h"

#include "screen.h"

#include <string.h>

enum { LARGEST_SIDE = 2048, SAMPLES = 4, MOST_LAYERS = 16 };

static const enum rhw_format light_format = RHW_FORMAT_RGBA16_FLOAT;

static bool any_instance(const struct scene_model *model, bool (*is)(const struct scene_material *))
{
    bool found = false;
    for (uint32_t i = 0; i < model->instance_count && !found; i++) {
        found = is(&model->materials[model->meshes[model->instances[i].mesh].material]);
    }
    return found;
}

static bool blends(const struct scene_material *material)
{
    return material->alpha_mode == SCENE_ALPHA_BLEND && !scene_material_transmits(material);
}

// Textures ------------------------------------------------------------------------------------------

static enum rhw_result get_textures(struct scene_seen_through *backdrop, rhw_context *context, int width,
                                    int height)
{
    enum rhw_result result =
        scene_target_get_levels(context, &backdrop->picture, light_format, width, height);
    if (result == RHW_OK) {
        result = scene_target_get(context, &backdrop->layer, light_format, width, height);
    }
    for (int i = 0; i < 2 && result == RHW_OK; i++) {
        result = scene_target_get_samples(context, &backdrop->depths[i], RHW_FORMAT_D32_FLOAT, width, height,
                                          SAMPLES);
    }
    if (result == RHW_OK && !backdrop->sampler.generation) {
        struct rhw_sampler_def def = rhw_sampler_def_default();
        def.address_u = def.address_v = RHW_ADDRESS_CLAMP;
        result = rhw_sampler_create(context, &def, &backdrop->sampler);
    }
    if (result == RHW_OK && !backdrop->any.generation) {
        const struct rhw_query_def def = {.kind = RHW_QUERY_ANY_PASSED, .label = "glass"};
        result = rhw_query_create(context, &def, &backdrop->any);
    }
    return result;
}

void scene_backdrop_destroy(rhw_context *context, struct scene_seen_through *backdrop)
{
    scene_target_destroy(context, &backdrop->picture);
    scene_target_destroy(context, &backdrop->layer);
    scene_target_destroy(context, &backdrop->depths[0]);
    scene_target_destroy(context, &backdrop->depths[1]);
    if (backdrop->sampler.generation) {
        rhw_sampler_destroy(context, backdrop->sampler);
    }
    if (backdrop->any.generation) {
        rhw_query_destroy(context, backdrop->any);
    }
    *backdrop = (struct scene_seen_through){0};
}

// Passes --------------------------------------------------------------------------------------------

// The frame of the picture as if it had the size of the backdrop: its pixels are as many of this one's.
static struct scene_frame frame_of(const struct draw *draw)
{
    const struct scene_target *picture = &draw->scene->backdrop.picture;
    struct scene_frame frame = draw->frame;
    frame.display_slot = -1;
    frame.linear_slot = 0;
    frame.samples = (float)picture->width / (float)draw->view->width;
    frame.first_row = 0.0f;
    frame.pixel[0] = 2.0f / (float)picture->width;
    frame.pixel[1] = 2.0f / (float)picture->height;
    return frame;
}

// The frame with the guide of what light does not pass through.
static struct scene_frame solid_frame_of(const struct draw *draw)
{
    struct scene_frame frame = frame_of(draw);
    if (frame.guide.distance) {
        frame.guide = scene_guide_lookup(&draw->scene->solid_guide, draw->view);
    }
    return frame;
}

static struct scene_surface_pass surfaces_of(const struct draw *draw, const struct scene_frame *frame,
                                             enum scene_surface_part part)
{
    struct scene *scene = draw->scene;
    struct scene_surface_pass surfaces = {.frame = frame,
                                          .solid = true,
                                          .part = part,
                                          .order = &scene->order,
                                          .program = &scene->program_draws,
                                          .interpolate = draw->view->interpolate,
                                          .formats = {light_format},
                                          .format_count = 1,
                                          .environment = scene->surroundings.cube,
                                          .environment_sampler = scene->surroundings.cube_sampler,
                                          .backdrop_sampler = scene->backdrop.sampler,
                                          .peeled_sampler = scene->nearest};
    memcpy(surfaces.view_projection, draw->view_projection, sizeof surfaces.view_projection);
    return surfaces;
}

static struct rhw_pass_def pass_def(const struct scene_target *color, const struct scene_target *depth,
                                    enum rhw_load load)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = color ? 1 : 0;
    if (color) {
        def.colors[0] = (struct rhw_color_attachment){.texture = color->texture, .load = load};
    }
    def.depth = (struct rhw_depth_attachment){.enabled = true, .texture = depth->texture, .load = load};
    def.samples = SAMPLES;
    return def;
}

static enum rhw_result record_and_end(struct draw *draw, rhw_pass pass,
                                      const struct scene_surface_pass *surfaces)
{
    struct scene *scene = draw->scene;
    const enum rhw_result result = scene_surfaces_record(&scene->upload, &scene->pipelines, surfaces, pass);
    return scene_pass_end(scene->upload.context, pass, result, NULL);
}

// Draw the background, the ground and opaque surfaces.
static enum rhw_result draw_opaque(struct draw *draw, const struct scene_target *depth)
{
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    const struct scene_frame frame = solid_frame_of(draw);
    const struct scene_surface_pass surfaces = surfaces_of(draw, &frame, SCENE_SURFACES_OPAQUE);
    struct scene_background_pass background;
    scene_background_set(draw, 1, 0, &background);
    background.gradient.smooth = 1; // light is in floats, whatever the picture is in
    background.gradient.inverse_side *= 1.0f / frame.samples;
    for (int i = 0; i < 2; i++) {
        background.panorama.scale[i] *= 1.0f / frame.samples;
    }
    struct rhw_pass_def def = pass_def(&scene->backdrop.picture, depth, RHW_LOAD_CLEAR);
    memcpy(def.colors[0].clear, background.gradient.top, sizeof background.gradient.top);
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    result = scene_background_record(draw, pass, true, &light_format, 1, &background);
    if (result == RHW_OK) {
        result = scene_color_record(draw, &surfaces, pass);
    }
    return scene_pass_end(context, pass, result, NULL);
}

// Draw the depth of the nearest glass.
static enum rhw_result draw_nearest(struct draw *draw, const struct scene_target *depth)
{
    const struct scene_frame frame = frame_of(draw);
    struct scene_surface_pass surfaces = surfaces_of(draw, &frame, SCENE_SURFACES_GLASS);
    surfaces.shadow = true;
    surfaces.format_count = 0;
    const struct rhw_pass_def def = pass_def(NULL, depth, RHW_LOAD_CLEAR);
    rhw_pass pass;
    const enum rhw_result result = rhw_pass_begin(draw->scene->upload.context, &def, &pass);
    return result != RHW_OK ? result : record_and_end(draw, pass, &surfaces);
}

// Draw blended surfaces over opaque ones where they are not before the nearest glass.
static enum rhw_result draw_blended(struct draw *draw, const struct scene_target *depth,
                                    const struct scene_target *nearest)
{
    struct scene_frame frame = solid_frame_of(draw);
    frame.peel_samples = SAMPLES;
    frame.peel_behind = 1;
    struct scene_surface_pass surfaces = surfaces_of(draw, &frame, SCENE_SURFACES_BLENDED);
    surfaces.peeled = nearest->texture;
    const struct rhw_pass_def def = pass_def(&draw->scene->backdrop.picture, depth, RHW_LOAD_LOAD);
    rhw_pass pass;
    const enum rhw_result result = rhw_pass_begin(draw->scene->upload.context, &def, &pass);
    return result != RHW_OK ? result : record_and_end(draw, pass, &surfaces);
}

// Draw the farthest glass that is nearer than `behind` and farther than the nearest, whose depth is `depth` before and
// the layer's afterwards. `any` tells whether there is some.
static enum rhw_result draw_layer(struct draw *draw, const struct scene_target *behind,
                                  const struct scene_target *depth, bool *any)
{
    struct scene_seen_through *backdrop = &draw->scene->backdrop;
    rhw_context *context = draw->scene->upload.context;
    struct scene_frame frame = frame_of(draw);
    frame.peel_samples = SAMPLES;
    struct scene_surface_pass surfaces = surfaces_of(draw, &frame, SCENE_SURFACES_GLASS);
    surfaces.backdrop = backdrop->picture.texture;
    surfaces.peeled = behind->texture;
    struct rhw_pass_def def = pass_def(&backdrop->layer, depth, RHW_LOAD_LOAD);
    def.colors[0].load = RHW_LOAD_CLEAR;
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    rhw_pass_begin_query(context, pass, backdrop->any);
    result = scene_surfaces_record(&draw->scene->upload, &draw->scene->pipelines, &surfaces, pass);
    rhw_pass_end_query(context, pass, backdrop->any);
    result = scene_pass_end(context, pass, result, NULL);
    struct rhw_query_counts counts = {0};
    if (result == RHW_OK) {
        result = rhw_query_read(context, backdrop->any, &counts);
    }
    *any = counts.any_passed;
    return result;
}

static enum rhw_result lay_over(struct draw *draw)
{
    struct scene_seen_through *backdrop = &draw->scene->backdrop;
    rhw_context *context = draw->scene->upload.context;
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 1;
    def.colors[0] =
        (struct rhw_color_attachment){.texture = backdrop->picture.texture, .load = RHW_LOAD_LOAD};
    def.depth = (struct rhw_depth_attachment){.enabled = false};
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result == RHW_OK) {
        const struct scene_layer layer = {.samples = 1, .count = 1};
        rhw_pass_set_texture(context, pass, 0, backdrop->layer.texture, draw->scene->nearest);
        result = scene_screen_lay(context, pass, &light_format, 1, &layer);
        result = scene_pass_end(context, pass, result, NULL);
    }
    return result == RHW_OK ? rhw_texture_generate_mips(context, backdrop->picture.texture) : result;
}

static enum rhw_result draw_surfaces(struct draw *draw)
{
    struct scene *scene = draw->scene;
    struct scene_target *const depths = scene->backdrop.depths;
    enum rhw_result result = draw_opaque(draw, &depths[0]);
    if (result == RHW_OK) {
        result = draw_nearest(draw, &depths[1]);
    }
    if (result == RHW_OK && any_instance(scene->upload.model, blends)) {
        result = draw_blended(draw, &depths[0], &depths[1]);
    }
    if (result == RHW_OK) {
        result = rhw_texture_generate_mips(scene->upload.context, scene->backdrop.picture.texture);
    }
    bool any = true;
    for (int layer = 0; layer < MOST_LAYERS && any && result == RHW_OK; layer++) {
        struct scene_target *const behind = &depths[layer % 2], *const depth = &depths[(layer + 1) % 2];
        result = layer > 0 ? draw_nearest(draw, depth) : RHW_OK;
        if (result == RHW_OK) {
            result = draw_layer(draw, behind, depth, &any);
        }
        if (result == RHW_OK && any) {
            result = lay_over(draw);
        }
    }
    return result;
}

bool scene_backdrop_wanted(const struct draw *draw)
{
    return !draw->frame.plain && any_instance(draw->scene->upload.model, scene_material_transmits);
}

enum rhw_result scene_draw_backdrop(struct draw *draw)
{
    struct scene *scene = draw->scene;
    const struct scene_view *view = draw->view;
    if (!scene_backdrop_wanted(draw)) {
        return RHW_OK;
    }
    const int longer = view->width > view->height ? view->width : view->height;
    const double part = longer > LARGEST_SIDE ? (double)LARGEST_SIDE / longer : 1.0;
    const int width = (int)(view->width * part + 0.5), height = (int)(view->height * part + 0.5);
    const int least_width = width > 0 ? width : 1, least_height = height > 0 ? height : 1;
    int levels = 0;
    for (int side = least_width > least_height ? least_width : least_height; side > 1; side /= 2) {
        levels++;
    }
    draw->frame.backdrop_levels = (float)levels;
    const enum rhw_result result =
        get_textures(&scene->backdrop, scene->upload.context, least_width, least_height);
    return result == RHW_OK ? draw_surfaces(draw) : result;
}
