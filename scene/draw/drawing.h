// SPDX-License-Identifier: MIT
// What the files of a draw share: draw.c has the order of things, color_band.c the colour passes, data.c the data
// passes, band.c how both go through the picture.
#ifndef SCENE_DRAWING_H
#define SCENE_DRAWING_H

#include "draw.h"
#include "ground.h"
#include "guide.h"
#include "light.h"
#include "material_program.h"
#include "panorama.h"
#include "shadow.h"
#include "surface.h"
#include "render_target.h"
#include "vicinity.h"

enum { TARGET_COUNT = SCENE_DATA_OUTPUTS + 6 };

// What exact transparency is made of, kept from draw to draw. Zeroed: nothing.
struct scene_peel {
    struct scene_target colors[3]; // by the target of the band that they become
    struct scene_target layers[2], depths[2];
    rhw_query any;
};

// What is seen through surfaces that light passes through, kept from draw to draw. Zeroed: nothing.
struct scene_seen_through {
    struct scene_target picture; // light, with a chain of levels
    struct scene_target layer, depths[2];
    rhw_sampler sampler;
    rhw_query any;
};

struct scene {
    struct scene_upload upload;
    struct scene_vicinity vicinity; // the model as it was drawn last from another origin
    struct scene_surface_pipelines pipelines;
    struct scene_target targets[TARGET_COUNT];
    struct scene_guide guide;
    struct scene_guide solid_guide; // what is nearest without surfaces that light passes through
    struct scene_ground ground;     // with view.ground
    struct scene_shadows shadows;
    struct scene_surroundings surroundings;
    struct scene_seen_through backdrop;
    struct scene_peel peel;
    struct scene_program_draws program_draws; // with view.program
    struct scene_triangle_order order;        // order of triangles of the draw under way
    rhw_sampler nearest;
    double upload_ms;
};

// Which of scene.targets is what.
enum {
    TARGET_SAMPLES,        // colours that become 8 bits
    TARGET_LINEAR_SAMPLES, // light before tone mapping
    TARGET_WIDE_SAMPLES,   // colours of more than 8 bits
    TARGET_COLOR,
    TARGET_LINEAR,
    TARGET_DISPLAY,
    TARGET_DATA
};

// Everything one call of scene_draw works with.
struct draw {
    struct scene *scene;
    const struct scene_view *view;
    struct scene_pictures *pictures;
    struct scene_draw_stats stats;
    struct scene_lighting lighting;
    struct scene_frame frame;
    double view_projection[16];
    int side;                         // side of the sample grid
    int band_rows, first_row;         // rows of the picture
    int color_targets[2];             // targets of displayed colour and of light
    enum rhw_format color_formats[2]; // their formats
    int color_count;                  // number of them that are drawn to
    bool is_wide;                     // the colours under way are of more than 8 bits
    uint32_t data_pass;               // the outputs of the data pass under way
};

double scene_milliseconds(void);

// band.c
enum rhw_result scene_draw_target(struct draw *draw, int which, enum rhw_format format, int width,
                                  int height);
// Rows of a band when a row of the picture takes `row_bytes` of targets.
int scene_band_rows(int height, size_t row_bytes);
enum rhw_result scene_draw_bands(struct draw *draw, enum rhw_result (*draw_band)(struct draw *));
// Rows of the picture in this band: the last one may have fewer than its targets.
int scene_band_height(const struct draw *draw);
// Memory for all pictures that the view asks for. False without it.
bool scene_pictures_allocate(const struct draw *draw);
void scene_band_read(struct draw *draw, int target, void *picture);
// The viewport of the whole picture, moved so that the band's first row is the target's.
void scene_band_viewport(const struct draw *draw, rhw_pass pass, int side);
// Sizes that depend on the pixels drawn along the side of one of the picture.
void scene_draw_set_samples(struct draw *draw, int side);
void scene_draw_add_stats(struct draw *draw, const struct rhw_stats *pass);

// prepare_light.c: what light needs of the whole picture. A step that the view does not want does nothing.
enum rhw_result scene_draw_surround(struct draw *draw); // a panorama takes the studio's place
enum rhw_result scene_draw_ground(struct draw *draw);   // makes it, to be drawn with the surfaces
enum rhw_result scene_draw_guide(struct draw *draw);    // distances and normals of what is nearest
enum rhw_result scene_draw_occlusion(
    struct draw *draw); // how much of the surroundings' light arrives, by the guide
enum rhw_result scene_draw_shadows(struct draw *draw); // maps of the lights, fitted to the guide

// background.c
struct scene_background_pass {
    struct scene_backdrop gradient; // its top is what colour 0 is to be cleared to
    struct scene_panorama_pass panorama;
};
// For `side` pixels drawn along that of one of the picture, from that row of the picture on.
void scene_background_set(const struct draw *draw, int side, int first_row,
                          struct scene_background_pass *background);
// Whether it takes more than a clear.
bool scene_background_is_drawn(const struct draw *draw);
// Records the background as colour 0 of a pass that has these formats, as it is displayed or as light. The background
// must live until the pass ends.
enum rhw_result scene_background_record(const struct draw *draw, rhw_pass pass, bool as_light,
                                        const enum rhw_format *formats, int format_count,
                                        const struct scene_background_pass *background);

// backdrop.c: what is seen through surfaces that light passes through.
bool scene_backdrop_wanted(const struct draw *draw);
enum rhw_result scene_draw_backdrop(struct draw *draw);
void scene_backdrop_destroy(rhw_context *context, struct scene_seen_through *backdrop);

// peel.c: samples of the band whose transparent surfaces lie as they do, whatever their order.
bool scene_peel_wanted(const struct draw *draw);
// Return the bytes that a pixel of the samples takes.
size_t scene_peel_bytes(const struct draw *draw, int format_count);
enum rhw_result scene_peel_opaque(struct draw *draw);  // background, ground, opaque surfaces
enum rhw_result scene_peel_blended(struct draw *draw); // above them, from the farthest layer to the nearest
void scene_peel_destroy(rhw_context *context, struct scene_peel *peel);

// work.c: what the work on the tiles of a colour pass is.
struct scene_work {
    struct rhw_tile_report *reports; // NULL: the view does not want to know
    int count;
};
// False without memory, where the pass must not be ended with success.
bool scene_work_begin(const struct draw *draw, rhw_pass pass, struct scene_work *work);
// Into the pictures, of a band that is drawn.
void scene_work_end(const struct draw *draw, struct scene_work *work);

// color_record.c: what a colour pass says of its surfaces.
void scene_color_surfaces(const struct draw *draw, const enum rhw_format *formats, int format_count,
                          struct scene_surface_pass *surfaces);
// Records them, above the ground where there is one.
enum rhw_result scene_color_record(const struct draw *draw, const struct scene_surface_pass *surfaces,
                                   rhw_pass pass);

// color_band.c: a band of the colour outputs.
int scene_color_rows(const struct draw *draw);
enum rhw_result scene_color_begin(struct draw *draw);
// Background, ground, opaque surfaces from front to back, blended ones from back to front; notes the work on the tiles.
enum rhw_result scene_color_draw(struct draw *draw);
// Makes the band of the pictures from what was drawn.
enum rhw_result scene_color_end(struct draw *draw);

// data.c: those of `outputs` that the view asks for, in one pass for all.
enum rhw_result scene_draw_data(struct draw *draw, uint32_t outputs);

#endif
