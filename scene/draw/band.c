// SPDX-License-Identifier: MIT
// A large picture is drawn in bands of rows, so that its samples never take more than BAND_BYTES. Bands do not show,
// because the pipeline promises that moving a triangle by whole pixels changes nothing.
#include "drawing.h"

#include "rhw/transfer.h"

#include <stdlib.h>
#include <time.h>

enum {
    BAND_BYTES = 1 << 28,
    BAND_ROWS = 64 // bands are cut at multiples: tiles stay whole
};

double scene_milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

enum rhw_result scene_draw_target(struct draw *draw, int which, enum rhw_format format, int width, int height)
{
    struct scene *scene = draw->scene;
    return scene_target_get(scene->upload.context, &scene->targets[which], format, width, height);
}

static uint64_t larger(uint64_t a, uint64_t b)
{
    return a > b ? a : b;
}

void scene_draw_add_stats(struct draw *draw, const struct rhw_stats *pass)
{
    struct rhw_stats *sum = &draw->stats.pipeline;
    sum->record_ms += pass->record_ms;
    sum->front_ms += pass->front_ms;
    sum->back_ms += pass->back_ms;
    sum->front_busy_ms += pass->front_busy_ms;
    sum->back_busy_ms += pass->back_busy_ms;
    sum->vertex_busy_ms += pass->vertex_busy_ms;
    sum->setup_busy_ms += pass->setup_busy_ms;
    sum->bin_busy_ms += pass->bin_busy_ms;
    sum->draws += pass->draws;
    sum->vertices_shaded += pass->vertices_shaded;
    sum->triangles_in += pass->triangles_in;
    sum->triangles_dropped += pass->triangles_dropped;
    sum->triangles_clipped += pass->triangles_clipped;
    sum->triangles_culled += pass->triangles_culled;
    sum->triangles_rasterized += pass->triangles_rasterized;
    sum->bin_entries += pass->bin_entries;
    sum->fragments_shaded += pass->fragments_shaded;
    sum->fragment_groups += pass->fragment_groups;
    sum->flushes += pass->flushes;
    sum->memory_peak = larger(pass->memory_peak, sum->memory_peak);
    sum->geometry_peak = larger(pass->geometry_peak, sum->geometry_peak);
    sum->tiles = pass->tiles > sum->tiles ? pass->tiles : sum->tiles;
    sum->threads = pass->threads;
    sum->isa = pass->isa;
}

// Sizes that depend on the pixels drawn along the side of one of the picture.
void scene_draw_set_samples(struct draw *draw, int side)
{
    draw->frame.samples = (float)side;
    draw->frame.pixel[0] = (float)(2.0 / ((double)draw->view->width * side));
    draw->frame.pixel[1] = (float)(2.0 / ((double)draw->view->height * side));
    draw->frame.line_half_width = 0.65f * (float)side;
}

// The viewport of the whole picture, moved so that the band's first row is the target's.
void scene_band_viewport(const struct draw *draw, rhw_pass pass, int side)
{
    const struct rhw_viewport viewport = {.x = 0.0f,
                                          .y = -(float)(draw->first_row * side),
                                          .width = (float)(draw->view->width * side),
                                          .height = (float)(draw->view->height * side),
                                          .depth_min = 0.0f,
                                          .depth_max = 1.0f};
    rhw_pass_set_viewport(draw->scene->upload.context, pass, &viewport);
}

void scene_band_read(struct draw *draw, int target, void *picture)
{
    const struct scene_target *t = &draw->scene->targets[target];
    const size_t row = (size_t)t->width * rhw_format_size(t->format);
    const struct rhw_texture_region band = {.height = scene_band_height(draw)};
    rhw_texture_read_region(draw->scene->upload.context, t->texture, &band,
                            (unsigned char *)picture + (size_t)draw->first_row * row, row, 0);
}

int scene_band_rows(int height, size_t row_bytes)
{
    const size_t fit = (size_t)BAND_BYTES / row_bytes / BAND_ROWS * BAND_ROWS;
    const size_t rows = fit > 0 ? fit : BAND_ROWS;
    return rows >= (size_t)height ? height : (int)rows;
}

int scene_band_height(const struct draw *draw)
{
    const int left = draw->view->height - draw->first_row;
    return left < draw->band_rows ? left : draw->band_rows;
}

enum rhw_result scene_draw_bands(struct draw *draw, enum rhw_result (*draw_band)(struct draw *))
{
    enum rhw_result result = RHW_OK;
    for (draw->first_row = 0; draw->first_row < draw->view->height && result == RHW_OK;
         draw->first_row += draw->band_rows) {
        draw->frame.first_row = (float)draw->first_row;
        const bool goes_on = !draw->view->goes_on || draw->view->goes_on(draw->view->user);
        result = goes_on ? draw_band(draw) : RHW_ERROR_GIVEN_UP;
    }
    return result;
}

bool scene_pictures_allocate(const struct draw *draw)
{
    const uint64_t pixels = (uint64_t)draw->view->height * (uint64_t)draw->view->width;
    bool allocated = true;
    for (int kind = 0; kind < SCENE_KIND_COUNT && allocated; kind++) {
        const uint64_t size = pixels * rhw_format_size(scene_outputs[kind].format);
        if (!(draw->view->outputs & scene_outputs[kind].output)) {
            continue;
        }
        allocated = size < SIZE_MAX; // not 4 GiB and more where addresses have 32 bits
        void *(*const allocate)(size_t) = draw->view->allocate ? draw->view->allocate : malloc;
        void *const picture = allocated ? allocate((size_t)size) : NULL;
        scene_picture_set(draw->pictures, (enum scene_output_kind)kind, picture);
        allocated = picture != NULL;
    }
    return allocated;
}
