// SPDX-License-Identifier: MIT
// The front end over one chunk: assembly, vertex reuse, culling and setup of 8 triangles at a time, clipping,
// binning. Template: compiled once per instruction set.

#include "../assembly.h"
#include "../clip.h"
#include "scratch.h"
#include "vertex_tmpl.h"

// Turns the vertex indices in scratch->corners into slots and lists each slot's index in scratch->unique.
static uint32_t find_unique(struct rhw_front_scratch *scratch, uint32_t triangles)
{
    if (++scratch->epoch == 0) { // every 2^32 segments the epochs start anew
        memset(scratch->cache, 0, sizeof scratch->cache);
        scratch->epoch = 1;
    }
    const uint32_t epoch = scratch->epoch;
    uint32_t *const corners = &scratch->corners[0][0];
    uint32_t count = 0;
    for (uint32_t i = 0; i < 3 * triangles; i++) {
        const uint32_t index = corners[i];
        struct rhw_cache_entry *const entry = &scratch->cache[index % RHW_VERTEX_CACHE];
        if (entry->index != index || entry->epoch != epoch) {
            *entry = (struct rhw_cache_entry){index, count, epoch};
            scratch->unique[count++] = index;
        }
        corners[i] = entry->slot;
    }
    return count;
}

static const struct rhw_vertex_record *record_at(const struct rhw_segment *segment, uint32_t slot)
{
    return (const struct rhw_vertex_record *)(const void *)(segment->vertices +
                                                            (size_t)slot * (size_t)segment->vertex_stride);
}

// The pixels between two snapped coordinates whose centres lie between them: first, and one past the last.
static int first_center(int32_t low_24_8)
{
    return (low_24_8 + RHW_SUBPIXEL / 2 - 1) >> RHW_SUBPIXEL_BITS;
}

static int past_center(int32_t high_24_8)
{
    return (high_24_8 + RHW_SUBPIXEL / 2) >> RHW_SUBPIXEL_BITS;
}

static int min_int(int a, int b)
{
    return a < b ? a : b;
}

static int max_int(int a, int b)
{
    return a > b ? a : b;
}

// Area and winding decide whether a triangle is drawn. On the screen y points down, so a triangle that is
// counter-clockwise with y up has a negative area.
static bool facing(const struct rhw_pipeline_def *def, bool negative, uint16_t *flags)
{
    const bool back = negative != (def->front == RHW_COUNTER_CLOCKWISE);
    *flags |= (uint16_t)((back ? RHW_TRIANGLE_BACK : 0) | (negative ? RHW_TRIANGLE_NEGATIVE : 0));
    return !(back ? def->cull == RHW_CULL_BACK : def->cull == RHW_CULL_FRONT);
}

// The road of a triangle that a plane cuts or that has a vertex that cannot be snapped. Counts what it
// refuses.
static bool setup_clipped(struct rhw_front_scratch *scratch, struct rhw_counters *counters,
                          const struct rhw_segment *segment, const uint32_t slots[3],
                          struct rhw_triangle *triangle)
{
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_vertex_record *v[3];
    uint32_t any = 0, all = ~0u;
    for (int i = 0; i < 3; i++) {
        v[i] = record_at(segment, slots[i]);
        any |= v[i]->flags;
        all &= v[i]->flags;
    }
    if (any & RHW_VERTEX_NOT_FINITE) {
        counters->dropped++;
        return false;
    }
    // Corners that are cut are snapped on their own: a triangle without area can leave a polygon with one.
    const int64_t x1 = v[1]->x_24_8 - v[0]->x_24_8, y1 = v[1]->y_24_8 - v[0]->y_24_8;
    const int64_t x2 = v[2]->x_24_8 - v[0]->x_24_8, y2 = v[2]->y_24_8 - v[0]->y_24_8;
    const bool empty = !(any & RHW_VERTEX_UNSNAPPED) && x1 * y2 == x2 * y1;
    struct rhw_polygon *const polygon = &scratch->polygons[scratch->polygon_count];
    if (empty || (all & RHW_VERTEX_OUTSIDE) || !rhw_clip_triangle(state, v, polygon)) {
        counters->culled++;
        return false;
    }
    counters->clipped++;
    const int64_t area = rhw_polygon_area(polygon);
    triangle->flags = (uint16_t)(RHW_TRIANGLE_POLYGON | RHW_TRIANGLE_CLAMP |
                                 (any & RHW_VERTEX_UNSNAPPED ? RHW_TRIANGLE_UNSNAPPED : 0));
    int32_t low_x = polygon->x_24_8[0], high_x = low_x, low_y = polygon->y_24_8[0], high_y = low_y;
    for (int i = 1; i < polygon->count; i++) {
        low_x = min_int(low_x, polygon->x_24_8[i]);
        high_x = max_int(high_x, polygon->x_24_8[i]);
        low_y = min_int(low_y, polygon->y_24_8[i]);
        high_y = max_int(high_y, polygon->y_24_8[i]);
    }
    const struct rhw_rect *const scissor = &state->scissor;
    const int px0 = max_int(first_center(low_x), scissor->x);
    const int py0 = max_int(first_center(low_y), scissor->y);
    const int px1 = min_int(past_center(high_x), scissor->x + scissor->width);
    const int py1 = min_int(past_center(high_y), scissor->y + scissor->height);
    if (area == 0 || !facing(&state->pipeline->def, area < 0, &triangle->flags) || px0 >= px1 || py0 >= py1) {
        counters->culled++;
        return false;
    }
    triangle->x0 = (int16_t)px0;
    triangle->y0 = (int16_t)py0;
    triangle->x1 = (int16_t)px1;
    triangle->y1 = (int16_t)py1;
    triangle->polygon = (uint32_t)scratch->polygon_count++;
    for (int i = 0; i < 3; i++) {
        triangle->x_24_8[i] = v[i]->x_24_8;
        triangle->y_24_8[i] = v[i]->y_24_8;
    }
    return true;
}

// 8 triangles side by side.
struct corner_lanes {
    i8 x[3], y[3], flags_any, flags_all;
    f8 depth_min, depth_max;
};

static struct corner_lanes load_corners(const struct rhw_segment *segment, const uint32_t (*slots)[3],
                                        int count)
{
    struct corner_lanes lanes;
    for (int corner = 0; corner < 3; corner++) {
        f8 header[8];
        for (int lane = 0; lane < 8; lane++) {
            // Lanes past the end repeat the last triangle; they are masked away below.
            header[lane] = f8_load(record_at(segment, slots[lane < count ? lane : count - 1][corner]));
        }
        f8_transpose(header);
        lanes.x[corner] = (i8)header[0];
        lanes.y[corner] = (i8)header[1];
        const i8 flags = (i8)header[3];
        lanes.flags_any = corner == 0 ? flags : lanes.flags_any | flags;
        lanes.flags_all = corner == 0 ? flags : lanes.flags_all & flags;
        lanes.depth_min = corner == 0 ? header[2] : f8_min(lanes.depth_min, header[2]);
        lanes.depth_max = corner == 0 ? header[2] : f8_max(lanes.depth_max, header[2]);
    }
    return lanes;
}

static i8 i8_min(i8 a, i8 b)
{
    return i8_select(a < b, a, b);
}

static i8 i8_max(i8 a, i8 b)
{
    return i8_select(a > b, a, b);
}

// Signs of twice the areas of 8 snapped triangles: bits of the negative and of the nonzero ones. Differences
// are below 2^24 and products below 2^48: exact in double.
static void area_signs(const struct corner_lanes *lanes, unsigned *negative, unsigned *nonzero)
{
    const d8 ax = d8_from_i8(lanes->x[1] - lanes->x[0]), ay = d8_from_i8(lanes->y[1] - lanes->y[0]);
    const d8 bx = d8_from_i8(lanes->x[2] - lanes->x[0]), by = d8_from_i8(lanes->y[2] - lanes->y[0]);
    const f8 area = f8_from_d8(d8_sub(d8_mul(ax, by), d8_mul(bx, ay))); // a nonzero integer stays nonzero
    *negative = i8_sign_bits(area < f8_splat(0));
    *nonzero = i8_sign_bits((area < f8_splat(0)) | (area > f8_splat(0)));
}

static unsigned popcount(unsigned bits)
{
    return (unsigned)__builtin_popcount(bits);
}

static void setup8(struct rhw_front_scratch *scratch, struct rhw_counters *counters, uint32_t segment_index,
                   uint32_t first, int count, uint32_t first_primitive)
{
    const struct rhw_segment *const segment = &scratch->segments[segment_index];
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const uint32_t(*const slots)[3] = (const uint32_t(*)[3]) & scratch->corners[first];
    const struct corner_lanes lanes = load_corners(segment, slots, count);
    const unsigned live = 0xffu >> (8 - count);
    const unsigned hard =
        live & ~i8_sign_bits((lanes.flags_any & i8_splat(RHW_VERTEX_CLIP | RHW_VERTEX_NOT_FINITE)) == 0);
    const unsigned outside = ~i8_sign_bits((lanes.flags_all & i8_splat(RHW_VERTEX_OUTSIDE)) == 0);

    unsigned negative, nonzero;
    area_signs(&lanes, &negative, &nonzero);
    const unsigned back = def->front == RHW_COUNTER_CLOCKWISE ? ~negative : negative;
    const unsigned facing_away = def->cull == RHW_CULL_NONE ? 0 : def->cull == RHW_CULL_BACK ? back : ~back;

    const struct rhw_rect *const s = &state->scissor;
    const i8 half = i8_splat(RHW_SUBPIXEL / 2), one = i8_splat(1);
    const i8 x0 =
        i8_max((i8_min(i8_min(lanes.x[0], lanes.x[1]), lanes.x[2]) + half - one) >> RHW_SUBPIXEL_BITS,
               i8_splat(s->x));
    const i8 y0 =
        i8_max((i8_min(i8_min(lanes.y[0], lanes.y[1]), lanes.y[2]) + half - one) >> RHW_SUBPIXEL_BITS,
               i8_splat(s->y));
    const i8 x1 = i8_min((i8_max(i8_max(lanes.x[0], lanes.x[1]), lanes.x[2]) + half) >> RHW_SUBPIXEL_BITS,
                         i8_splat(s->x + s->width));
    const i8 y1 = i8_min((i8_max(i8_max(lanes.y[0], lanes.y[1]), lanes.y[2]) + half) >> RHW_SUBPIXEL_BITS,
                         i8_splat(s->y + s->height));
    const unsigned covers = i8_sign_bits((x0 < x1) & (y0 < y1));

    const unsigned easy = live & ~hard;
    const unsigned drawn = easy & ~outside & nonzero & ~facing_away & covers;
    counters->culled += popcount(easy & ~drawn);

    // A rounding may carry interpolated depth past the viewport's range, where a vertex is next to its ends.
    const float margin = 0x1p-20f;
    const unsigned clamp = i8_sign_bits((lanes.depth_min < f8_splat(state->depth_least + margin)) |
                                        (lanes.depth_max > f8_splat(state->depth_most - margin)));
    // Submission order is kept: easy and hard lanes are stored as they come.
    for (unsigned left = drawn | hard; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        struct rhw_triangle *const t = &scratch->triangles[scratch->triangle_count];
        if (hard >> lane & 1) {
            if (!setup_clipped(scratch, counters, segment, slots[lane], t)) {
                continue;
            }
        } else {
            for (int i = 0; i < 3; i++) {
                t->x_24_8[i] = lanes.x[i][lane];
                t->y_24_8[i] = lanes.y[i][lane];
            }
            t->x0 = (int16_t)x0[lane];
            t->y0 = (int16_t)y0[lane];
            t->x1 = (int16_t)x1[lane];
            t->y1 = (int16_t)y1[lane];
            t->flags = (uint16_t)((back >> lane & 1 ? RHW_TRIANGLE_BACK : 0) |
                                  (negative >> lane & 1 ? RHW_TRIANGLE_NEGATIVE : 0) |
                                  (clamp >> lane & 1 ? RHW_TRIANGLE_CLAMP : 0));
            t->polygon = 0;
        }
        memcpy(t->vertex, slots[lane], sizeof t->vertex);
        t->primitive = first_primitive + (uint32_t)lane;
        t->segment = segment_index;
        scratch->triangle_count++;
    }
}

// `first_primitive`: of the segment's first triangle in its draw and instance.
static bool run_segment(struct rhw_front_scratch *scratch, struct rhw_worker *worker,
                        const struct rhw_draw *draw, uint32_t instance, uint32_t first_primitive,
                        uint32_t count)
{
    const uint32_t segment_index = (uint32_t)scratch->segment_count++;
    struct rhw_segment *const segment = &scratch->segments[segment_index];
    rhw_assembly_fetch(draw, first_primitive, count, scratch->corners);
    const uint32_t vertices = find_unique(scratch, count);
    const int stride = rhw_vertex_stride(draw->state->pipeline->varying_components);
    const size_t size = (size_t)((vertices + 7) & ~7u) * (size_t)stride * sizeof(float);
    *segment =
        (struct rhw_segment){draw, instance, stride, rhw_arena_alloc(&worker->arena, size, RHW_CACHE_LINE)};
    if (!segment->vertices) {
        return false;
    }
    shade_vertices(scratch, segment, vertices);
    worker->counters.vertices_shaded += vertices;
    for (uint32_t i = 0; i < count; i += 8) {
        setup8(scratch, &worker->counters, segment_index, i, (int)(count - i < 8 ? count - i : 8),
               first_primitive + i);
    }
    return true;
}

// Copies what the chunk made out of the scratch, into memory that lasts until its tiles are drawn.
static void *keep(struct rhw_arena *arena, const void *from, size_t size)
{
    void *const to = rhw_arena_alloc(arena, size, RHW_CACHE_LINE);
    if (to && size != 0) {
        memcpy(to, from, size);
    }
    return to;
}

struct tile_span {
    int x0, y0, x1, y1; // inclusive
};

static struct tile_span span_of(const struct rhw_triangle *t)
{
    return (struct tile_span){t->x0 >> RHW_TILE_LOG2, t->y0 >> RHW_TILE_LOG2, (t->x1 - 1) >> RHW_TILE_LOG2,
                              (t->y1 - 1) >> RHW_TILE_LOG2};
}

// Counting sort of triangles by tile: counts, sums, then entries. offsets[i] runs from the start of bin i to
// its end while entries are placed, which is where bin i + 1 starts; hence the shift by one.
static bool bin(struct rhw_chunk *chunk, int triangle_count, struct rhw_arena *arena)
{
    struct tile_span all = {1 << 20, 1 << 20, -1, -1};
    for (int t = 0; t < triangle_count; t++) {
        const struct tile_span s = span_of(&chunk->triangles[t]);
        all = (struct tile_span){min_int(all.x0, s.x0), min_int(all.y0, s.y0), max_int(all.x1, s.x1),
                                 max_int(all.y1, s.y1)};
    }
    chunk->tile_x0 = all.x0;
    chunk->tile_y0 = all.y0;
    chunk->tile_x1 = all.x1 + 1;
    chunk->tile_y1 = all.y1 + 1;
    if (triangle_count == 0) {
        return true;
    }
    const int width = all.x1 - all.x0 + 1;
    const size_t tiles = (size_t)width * (size_t)(all.y1 - all.y0 + 1);
    uint32_t *const offsets = rhw_arena_alloc(arena, (tiles + 2) * sizeof *offsets, RHW_CACHE_LINE);
    if (!offsets) {
        return false;
    }
    memset(offsets, 0, (tiles + 2) * sizeof *offsets);
    for (int t = 0; t < triangle_count; t++) {
        const struct tile_span s = span_of(&chunk->triangles[t]);
        for (int y = s.y0; y <= s.y1; y++) {
            for (int x = s.x0; x <= s.x1; x++) {
                offsets[(y - all.y0) * width + x - all.x0 + 2]++;
            }
        }
    }
    for (size_t i = 2; i < tiles + 2; i++) {
        offsets[i] += offsets[i - 1];
    }
    chunk->entries = rhw_arena_alloc(arena, offsets[tiles + 1] * sizeof *chunk->entries, RHW_CACHE_LINE);
    if (!chunk->entries) {
        return false;
    }
    for (int t = 0; t < triangle_count; t++) {
        const struct tile_span s = span_of(&chunk->triangles[t]);
        for (int y = s.y0; y <= s.y1; y++) {
            for (int x = s.x0; x <= s.x1; x++) {
                chunk->entries[offsets[(y - all.y0) * width + x - all.x0 + 1]++] = (uint16_t)t;
            }
        }
    }
    chunk->offsets = offsets;
    return true;
}

static bool run_chunk(struct rhw_pass_state *pass, struct rhw_chunk *chunk, int worker_index)
{
    struct rhw_worker *const worker = &pass->workers[worker_index];
    struct rhw_front_scratch *const scratch = worker->front;
    scratch->triangle_count = scratch->segment_count = scratch->polygon_count = 0;
    uint64_t at = chunk->first;
    const uint64_t end = chunk->first + chunk->count;
    for (uint32_t d = chunk->first_draw; at < end; d++) {
        const struct rhw_draw *const draw = rhw_pass_draw_at(pass, d);
        const uint64_t draw_end =
            draw->first_triangle + (uint64_t)draw->triangles_per_instance * draw->instances;
        while (at < end && at < draw_end) {
            const uint64_t in_draw = at - draw->first_triangle;
            const uint32_t instance = (uint32_t)(in_draw / draw->triangles_per_instance);
            const uint32_t first = (uint32_t)(in_draw % draw->triangles_per_instance);
            uint32_t count = draw->triangles_per_instance - first;
            count = end - at < count ? (uint32_t)(end - at) : count;
            if (!run_segment(scratch, worker, draw, instance, first, count)) {
                return false;
            }
            at += count;
        }
    }
    struct rhw_arena *const arena = &worker->arena;
    chunk->segments =
        keep(arena, scratch->segments, (size_t)scratch->segment_count * sizeof *chunk->segments);
    chunk->triangles =
        keep(arena, scratch->triangles, (size_t)scratch->triangle_count * sizeof *chunk->triangles);
    chunk->polygons =
        keep(arena, scratch->polygons, (size_t)scratch->polygon_count * sizeof *chunk->polygons);
    worker->counters.rasterized += (uint64_t)scratch->triangle_count;
    return chunk->segments && chunk->triangles && chunk->polygons &&
           bin(chunk, scratch->triangle_count, arena);
}
