// SPDX-License-Identifier: MIT
// Points, 8 at a time. A point is a square of its size around its snapped position. It covers the pixel centres in the
// square, including those on its left and top edges (Vulkan 1.3 §28.8; the top-left rule). So it covers a rectangle of
// pixels; a point of size 1 covers exactly one pixel. Tiles draw a triangle that contains the square, with its right
// angle in the square's top left corner and legs of twice the square's side, cut down to the rectangle: the triangle's
// third edge touches the square in the corner that is not covered anyway. All three vertices are the point's one
// vertex, so that nothing varies.
//
// A point whose centre is outside the view, or cut off by a clip distance, is not drawn. Of other points, only the
// scissor cuts off parts.
#ifndef RHW_POINT_SETUP_H
#define RHW_POINT_SETUP_H

#include "pipeline/pipeline.h"
#include "kernels/raster/vertex_record.h"
#include "triangle_words.h"

// 8 points side by side.
struct points8 {
    i32x8 x, y;  // 24.8
    i32x8 flags; // flags of the points' triangles
    i32x8 vertex, primitive, segment;
};

// Return sizes in 1/256 pixel.
static i32x8 point_sizes8(const struct rhw_geometry_scratch *scratch,
                          const struct rhw_pipeline_data *pipeline, const struct points8 *p, unsigned live)
{
    if (!pipeline->def.program.writes_point_size) {
        return i32x8_splat(RHW_SUBPIXEL);
    }
    f32x8 size = f32x8_splat(1);
    for (unsigned left = live; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const struct rhw_segment *const segment = &scratch->segments[p->segment[lane]];
        size[lane] = record_at(segment, (uint32_t)p->vertex[lane])->varyings[pipeline->point_size_component];
    }
    size = f32x8_min(f32x8_max(size, f32x8_splat(1)),
                     f32x8_splat(RHW_MAX_POINT_SIZE)); // 1 where the size is no number
    return i32x8_round_f64x8(f64x8_mul(f64x8_from_f32x8(size), f64x8_splat(RHW_SUBPIXEL)));
}

// Add the points of 8 that are `live` and not outside the scissor. Return their bits.
static unsigned add_points8(struct rhw_geometry_scratch *scratch, const struct rhw_draw_state *state,
                            const struct points8 *p, unsigned live, struct rhw_triangle_list *list)
{
    const i32x8 size = point_sizes8(scratch, state->pipeline, p, live), legs = size + size;
    const i32x8 x = p->x - (size >> 1), y = p->y - (size >> 1);
    const struct rhw_rect *const scissor = &state->scissor;
    const struct triangle8 t = {.x = {x, x + legs, x}, .y = {y, y, y + legs}};
    const i32x8 end_x = x + size - i32x8_splat(1),
                end_y = y + size - i32x8_splat(1); // the last positions inside
    const i32x8 first = i32x8_splat(state->first_step), past = i32x8_splat(state->past_step);
    const struct pixel_rect8 pixels = {
        i32x8_max(pixel_of_step8(x, first), i32x8_splat(scissor->x)),
        i32x8_max(pixel_of_step8(y, first), i32x8_splat(scissor->y)),
        i32x8_min(pixel_of_step8(end_x, past), i32x8_splat(scissor->x + scissor->width)),
        i32x8_min(pixel_of_step8(end_y, past), i32x8_splat(scissor->y + scissor->height))};
    const i32x8 small = rhw_less_int(legs, i32x8_splat(RHW_TILE * RHW_SUBPIXEL));
    const i32x8 unclamped = rhw_equal_int(p->flags & i32x8_splat(RHW_TRIANGLE_CLAMP), i32x8_splat(0));
    const i32x8 flags = p->flags | i32x8_splat(RHW_TRIANGLE_RECTANGLE) |
                        (small & unclamped & i32x8_splat(RHW_TRIANGLE_SMALL));
    const struct triangle_names8 names = {
        .vertex = {p->vertex, p->vertex, p->vertex}, .primitive = p->primitive, .segment = p->segment};
    struct rhw_tile_range ranges[8];
    struct triangle_words words;
    const unsigned drawn =
        live & i32x8_sign_bits(rhw_less_int(pixels.x0, pixels.x1) & rhw_less_int(pixels.y0, pixels.y1));
    fill_words(&words, &t, &pixels, flags, &names);
    tile_ranges8(ranges, pixels.x0, pixels.y0, pixels.x1, pixels.y1);
    for (unsigned left = drawn; left != 0; left &= left - 1) {
        add_words(list, &words, ranges, __builtin_ctz(left));
    }
    return drawn;
}

// Return the bits of the points that may be seen, and count the others. `flags` are those of the vertices.
static unsigned seen_points8(struct rhw_geometry_scratch *scratch, i32x8 flags, unsigned live)
{
    const unsigned lost = live & flagged8(flags, RHW_VERTEX_NOT_FINITE);
    const unsigned outside = live & ~lost & flagged8(flags, RHW_VERTEX_OUTSIDE | RHW_VERTEX_UNSNAPPED);
    scratch->counters.dropped += (unsigned)__builtin_popcount(lost);
    scratch->counters.culled += (unsigned)__builtin_popcount(outside);
    return live & ~lost & ~outside;
}

// Set up 8 points of a run.
static __attribute__((noinline)) void setup_points8(struct rhw_geometry_scratch *scratch,
                                                    const struct run_slice *slice,
                                                    struct rhw_triangle_list *list)
{
    const struct rhw_run *const run = &scratch->runs[slice->run];
    const struct rhw_draw_state *const state = scratch->segments[slice->run].draw->state;
    const struct triangle8 t = load_triangle8(run->vertices, run->first_slot, slice->indices);
    const struct triangle_names8 names = names_of_slice(slice, run->first_slot);
    const unsigned seen = seen_points8(scratch, t.flags_any, slice->live);
    if (seen != 0) {
        const struct points8 points = {.x = t.x[0],
                                       .y = t.y[0],
                                       .flags = clamp_flags8(state, t.depth_min, t.depth_min),
                                       .vertex = names.vertex[0],
                                       .primitive = names.primitive,
                                       .segment = names.segment};
        const unsigned drawn = add_points8(scratch, state, &points, seen, list);
        scratch->counters.culled += (unsigned)__builtin_popcount(seen & ~drawn);
        scratch->counters.rasterized += (unsigned)__builtin_popcount(drawn);
    }
}

#endif
