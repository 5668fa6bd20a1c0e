// SPDX-License-Identifier: MIT
// The lengths of lines are measured in integers, so that a phase does not depend on the instruction set.
#include "strip_stipple.h"

#include <string.h>

#include "base/arena.h"
#include "draw/assembly.h"
#include "base/constants.h"
#include "kernels/geometry/line_columns.h"
#include "draw/recorded_pass.h"
#include "pipeline/pipeline.h"
#include "vertex_sharing.h"

bool rhw_strip_stipple_needed(const struct rhw_draw *draw)
{
    const enum rhw_topology topology = draw->state->pipeline->def.topology;
    return draw->state->stipple.factor != 0 &&
           (topology == RHW_LINE_STRIP || topology == RHW_LINE_STRIP_ADJACENCY || topology == RHW_LINE_LOOP);
}

bool rhw_strip_stipple_prepare(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena)
{
    const size_t lines = draw->triangles_per_instance;
    if (lines == 0 || draw->instances == 0) {
        return true;
    }
    if (lines > SIZE_MAX / sizeof(int32_t) / draw->instances) {
        return false;
    }
    struct rhw_strip_stipple *const strip = rhw_arena_alloc(arena, sizeof *strip, RHW_CACHE_LINE);
    uint8_t *const begins = rhw_arena_alloc(arena, lines, RHW_CACHE_LINE);
    int32_t *const phases = rhw_arena_alloc(arena, lines * draw->instances * sizeof *phases, RHW_CACHE_LINE);
    if (!strip || !begins || !phases) {
        return false;
    }
    memset(begins, 0, lines);
    rhw_assembly_mark_strips(draw, count, begins);
    *strip = (struct rhw_strip_stipple){begins, phases};
    draw->strip_stipple = strip;
    return true;
}

// Return √n, rounded to the nearest, digit by digit in integers. 0 <= n < 2^50
static int64_t rounded_root(int64_t n)
{
    int64_t root = 0, rest = n; // rest = n − root²
    for (int64_t bit = INT64_C(1) << 24; bit != 0; bit >>= 1) {
        const int64_t step = (2 * root + bit) * bit; // (root + bit)² − root²
        if (step <= rest) {
            rest -= step;
            root += bit;
        }
    }
    return rest > root ? root + 1 : root;
}

// Return how many places of the stipple lie between the beginning of a line and that of the next line in its strip.
static int64_t places_of(const struct rhw_draw_state *state, const struct rhw_snapped_vertex *a,
                         const struct rhw_snapped_vertex *b)
{
    const int32_t x[2] = {a->x_24_8, b->x_24_8}, y[2] = {a->y_24_8, b->y_24_8};
    if ((a->flags | b->flags) & (RHW_VERTEX_UNSNAPPED | RHW_VERTEX_NOT_FINITE) ||
        (x[0] == x[1] && y[0] == y[1])) {
        return 0;
    }
    if (state->pipeline->def.line_mode != RHW_LINE_BRESENHAM) {
        const int64_t dx = x[1] - x[0], dy = y[1] - y[0];
        return rounded_root(dx * dx + dy * dy);
    }
    const struct line_ends line = line_ends_of(x, y, state->line_pixels);
    const struct pixel_range columns = major_pixels(&line);
    return columns.end > columns.first ? columns.end - columns.first : 0;
}

static void measure_instance(const struct rhw_draw *draw, uint32_t instance)
{
    const struct rhw_pipeline_data *const pipeline = draw->state->pipeline;
    const struct rhw_snapped_vertex *const vertices = draw->shared[instance].snapped;
    int32_t *const phases = draw->strip_stipple->phases + (size_t)instance * draw->triangles_per_instance;
    const int unit = pipeline->def.line_mode == RHW_LINE_BRESENHAM ? 1 : RHW_SUBPIXEL;
    const int64_t pattern = 16 * (int64_t)draw->state->stipple.factor * unit;
    int64_t place = 0;
    for (uint32_t i = 0; i < draw->triangles_per_instance; i++) {
        place = draw->strip_stipple->begins[i] ? 0 : place;
        phases[i] = (int32_t)place;
        const uint32_t *const slots = draw->expanded[i];
        place = (place + places_of(draw->state, &vertices[slots[0]], &vertices[slots[1]])) % pattern;
    }
}

void rhw_strip_stipple_measure(const struct rhw_recorded_pass *pass)
{
    for (uint32_t d = 0; d < pass->draws.count; d++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(&pass->draws, d);
        for (uint32_t i = 0; draw->strip_stipple && i < draw->instances; i++) {
            measure_instance(draw, i);
        }
    }
}
