// SPDX-License-Identifier: MIT
// The front end: vertices that chunks share; and over one chunk: assembly, vertex reuse, culling and setup of 8
// triangles at a time, clipping, binning. Template: compiled once per instruction set.

#include <stddef.h>

#include "../assembly.h"
#include "../clip.h"
#include "../shared_vertices.h"
#include "../thread.h"
#include "raster/coverage.h"
#include "vertex_tmpl.h"

// The least and the greatest index of a run.
static void index_range(const struct rhw_run *run, uint32_t *low, uint32_t *high)
{
    const uint32_t *const corners = &run->corners[0][0];
    uint32_t least = UINT32_MAX, most = 0;
    for (uint32_t i = 0; i < 3 * run->count; i++) { // compilers make this 8 lanes wide
        least = corners[i] < least ? corners[i] : least;
        most = corners[i] > most ? corners[i] : most;
    }
    *low = least;
    *high = most;
}

// Gives each vertex a slot at its first use, through a direct-mapped table. An entry counts when this run made it:
// its stamp is this run's first plus the slot.
static uint32_t look_up_slots(struct rhw_front_scratch *scratch, struct rhw_run *run, uint32_t base_vertex,
                              uint32_t (*slots)[3])
{
    if (scratch->stamp > UINT32_MAX - 3 * RHW_CHUNK_TRIANGLES) { // every 2^32 vertices the stamps start anew
        memset(scratch->cache, 0, sizeof scratch->cache);
        scratch->stamp = 1;
    }
    const uint32_t first_stamp = scratch->stamp;
    const uint32_t *const corners = &run->corners[0][0];
    uint32_t *const out = &slots[0][0];
    uint32_t count = 0;
    for (uint32_t i = 0; i < 3 * run->count; i++) {
        const uint32_t index = corners[i];
        struct rhw_cache_entry *const entry = &scratch->cache[index % RHW_VERTEX_CACHE];
        if (entry->index != index || entry->stamp < first_stamp) {
            *entry = (struct rhw_cache_entry){index, first_stamp + count};
            scratch->unique[count++] = index + base_vertex;
        }
        out[i] = entry->stamp - first_stamp;
    }
    scratch->stamp = first_stamp + count;
    run->corners = (const uint32_t(*)[3])slots;
    run->first_slot = 0;
    return count;
}

// Lists the vertices that a run shades in scratch->unique, in the order of their slots. Where the indices lie close
// together, as a mesh's mostly do, every vertex between the least and the greatest is shaded and no table is needed:
// a closed mesh has a vertex for every two triangles, so that few are shaded in vain. Small ones, which may have hard
// edges and several vertices at a point, lose little, 6 groups of 8 vertices at most; a draw of a cube gains an eighth.
static uint32_t list_vertices(struct rhw_front_scratch *scratch, struct rhw_run *run,
                              const struct rhw_draw *draw, uint32_t (*slots)[3])
{
    uint32_t low, high;
    index_range(run, &low, &high);
    enum { SMALL = 16 }; // triangles
    const bool is_closed = draw->indexed && run->count > SMALL;
    if (high - low >= (is_closed ? 3 * run->count / 4 : 3 * run->count)) {
        return look_up_slots(scratch, run, draw->base_vertex, slots);
    }
    run->first_slot = low;
    const uint32_t count = high - low + 1;
    for (uint32_t i = 0; i < count; i++) {
        scratch->unique[i] = low + draw->base_vertex + i;
    }
    return count;
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

// Area and winding decide whether a triangle is drawn. On the screen y points down, so a triangle that is
// counter-clockwise with y up has a negative area.
static bool facing(const struct rhw_pipeline_def *def, bool negative, uint16_t *flags)
{
    const bool back = negative != (def->front == RHW_COUNTER_CLOCKWISE);
    *flags |= (uint16_t)((back ? RHW_TRIANGLE_BACK : 0) | (negative ? RHW_TRIANGLE_NEGATIVE : 0));
    return !(back ? def->cull == RHW_CULL_BACK : def->cull == RHW_CULL_FRONT);
}

// The determinant of the vertices' (X, Y, W): above 0 where they turn counter-clockwise with y up.
static double homogeneous_turn(const struct rhw_vertex_record *const v[3])
{
    const float *const a = v[0]->position, *const b = v[1]->position, *const c = v[2]->position;
    return (double)a[3] * ((double)b[0] * (double)c[1] - (double)b[1] * (double)c[0]) +
           (double)b[3] * ((double)c[0] * (double)a[1] - (double)c[1] * (double)a[0]) +
           (double)c[3] * ((double)a[0] * (double)b[1] - (double)a[1] * (double)b[0]);
}

// The winding on the screen. Corners that are cut are snapped on their own: a triangle without area may leave a polygon
// with one, and a thin polygon may cross itself, so that its halves turn opposite ways and their areas add up to
// nothing. So the triangle is asked first, then the polygon, then the triangle before it was snapped.
static bool turns_negative(const struct rhw_vertex_record *const v[3], bool snapped,
                           const struct rhw_polygon *polygon)
{
    const int64_t x1 = v[1]->x_24_8 - v[0]->x_24_8, y1 = v[1]->y_24_8 - v[0]->y_24_8;
    const int64_t x2 = v[2]->x_24_8 - v[0]->x_24_8, y2 = v[2]->y_24_8 - v[0]->y_24_8;
    int64_t area = snapped ? x1 * y2 - x2 * y1 : 0;
    if (area == 0) {
        area = rhw_polygon_area(polygon);
    }
    return area != 0 ? area < 0 : homogeneous_turn(v) > 0;
}

// The road of a triangle that a plane cuts or that has a vertex that cannot be snapped. Counts what it
// refuses. Corners and vertices of `triangle` are set, the rest is found here.
static bool setup_clipped(struct rhw_front_scratch *scratch, const struct rhw_segment *segment,
                          struct rhw_triangle *triangle)
{
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_vertex_record *v[3];
    uint32_t any = 0, all = ~0u;
    for (int i = 0; i < 3; i++) {
        v[i] = record_at(segment, triangle->vertex[i]);
        any |= v[i]->flags;
        all &= v[i]->flags;
    }
    if (any & RHW_VERTEX_NOT_FINITE) {
        scratch->counters.dropped++;
        return false;
    }
    struct rhw_polygon *const polygon = &scratch->polygons[scratch->polygon_count];
    if ((all & RHW_VERTEX_OUTSIDE) || !rhw_clip_triangle(state, v, polygon)) {
        scratch->counters.culled++;
        return false;
    }
    scratch->counters.clipped++;
    const bool negative = turns_negative(v, !(any & RHW_VERTEX_UNSNAPPED), polygon);
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
    if (rhw_polygon_is_flat(polygon) || !facing(&state->pipeline->def, negative, &triangle->flags) ||
        px0 >= px1 || py0 >= py1) {
        scratch->counters.culled++;
        return false;
    }
    triangle->x0 = (int16_t)px0;
    triangle->y0 = (int16_t)py0;
    triangle->x1 = (int16_t)px1;
    triangle->y1 = (int16_t)py1;
    triangle->polygon = (uint32_t)scratch->polygon_count++;
    return true;
}

struct tile_span {
    int x0, y0, x1, y1; // inclusive
};

// The tiles that the pixels of a triangle lie in, a byte for each of x0, y0, x1, y1.
static uint32_t span_of(const struct rhw_triangle *t)
{
    return (uint32_t)(t->x0 >> RHW_TILE_LOG2) | (uint32_t)(t->y0 >> RHW_TILE_LOG2) << 8 |
           (uint32_t)((t->x1 - 1) >> RHW_TILE_LOG2) << 16 | (uint32_t)((t->y1 - 1) >> RHW_TILE_LOG2) << 24;
}

// 8 triangles side by side.
struct corner_lanes {
    i8 x[3], y[3], flags_any, flags_all;
    f8 depth_min, depth_max;
};

static struct corner_lanes load_corners(const struct rhw_corner *vertices, uint32_t first,
                                        const uint32_t (*corners)[3])
{
    struct corner_lanes lanes;
    for (int corner = 0; corner < 3; corner++) {
        const void *places[8];
        f8 column[4];
        for (int lane = 0; lane < 8; lane++) {
            places[lane] = &vertices[corners[lane][corner] - first];
        }
        f8_load_columns(places, column);
        lanes.x[corner] = (i8)column[0];
        lanes.y[corner] = (i8)column[1];
        const i8 flags = (i8)column[3];
        lanes.flags_any = corner == 0 ? flags : lanes.flags_any | flags;
        lanes.flags_all = corner == 0 ? flags : lanes.flags_all & flags;
        lanes.depth_min = corner == 0 ? column[2] : f8_min(lanes.depth_min, column[2]);
        lanes.depth_max = corner == 0 ? column[2] : f8_max(lanes.depth_max, column[2]);
    }
    return lanes;
}

static i8 i8_min3(const i8 v[3])
{
    return i8_min(i8_min(v[0], v[1]), v[2]);
}

static i8 i8_max3(const i8 v[3])
{
    return i8_max(i8_max(v[0], v[1]), v[2]);
}

// Signs of twice the areas of 8 snapped triangles: bits of the negative and of the nonzero ones.
static void area_signs(const struct corner_lanes *lanes, unsigned *negative, unsigned *nonzero)
{
    const i8 ax = lanes->x[1] - lanes->x[0], ay = lanes->y[1] - lanes->y[0];
    const i8 bx = lanes->x[2] - lanes->x[0], by = lanes->y[2] - lanes->y[0];
    const i8 size = (ax ^ ax >> 31) | (ay ^ ay >> 31) | (bx ^ bx >> 31) | (by ^ by >> 31);
    if (i8_sign_bits(rhw_less_int(i8_splat(INT16_MAX), size)) == 0) {
        // Differences fit 16 bits: the products stay within 2^30, and their difference is 2^31 only if all four
        // factors are -2^15 and one of them 2^15.
        const i8 area = ax * by - bx * ay;
        *negative = i8_sign_bits(area);
        *nonzero = ~i8_sign_bits(rhw_equal_int(area, i8_splat(0)));
        return;
    }
    // Differences are below 2^24 and products below 2^48: exact in double.
    const f8 area = f8_from_d8(d8_sub(d8_mul(d8_from_i8(ax), d8_from_i8(by)),   //
                                      d8_mul(d8_from_i8(bx), d8_from_i8(ay)))); // not 0 stays not 0
    *negative = i8_sign_bits(rhw_less(area, f8_splat(0)));
    *nonzero = ~i8_sign_bits(rhw_equal(area, f8_splat(0)));
}

static unsigned popcount(unsigned bits)
{
    return (unsigned)__builtin_popcount(bits);
}

// The pixels that 8 triangles may cover, within the scissor; x1 and y1 exclusive.
struct pixel_lanes {
    i8 x0, y0, x1, y1;
};

static struct pixel_lanes pixels_of(const struct corner_lanes *lanes, const struct rhw_rect *scissor)
{
    const i8 half = i8_splat(RHW_SUBPIXEL / 2), less = i8_splat(RHW_SUBPIXEL / 2 - 1);
    return (struct pixel_lanes){
        i8_max((i8_min3(lanes->x) + less) >> RHW_SUBPIXEL_BITS, i8_splat(scissor->x)),
        i8_max((i8_min3(lanes->y) + less) >> RHW_SUBPIXEL_BITS, i8_splat(scissor->y)),
        i8_min((i8_max3(lanes->x) + half) >> RHW_SUBPIXEL_BITS, i8_splat(scissor->x + scissor->width)),
        i8_min((i8_max3(lanes->y) + half) >> RHW_SUBPIXEL_BITS, i8_splat(scissor->y + scissor->height))};
}

// Those with RHW_TRIANGLE_SMALL by their size.
static i8 small_lanes(const struct corner_lanes *lanes)
{
    const i8 size = i8_splat(RHW_TILE * RHW_SUBPIXEL);
    return (i8_max3(lanes->x) - i8_min3(lanes->x) < size) & (i8_max3(lanes->y) - i8_min3(lanes->y) < size);
}

// Bits of those triangles that cover none of the few pixels in their rectangle: one of nine, where triangles are of the
// size of pixels. Rectangles of more than 3×3 pixels are not looked at. Unsigned, see edge_lanes.
static unsigned uncovered(const struct corner_lanes *lanes, const struct pixel_lanes *pixels,
                          unsigned negative)
{
    enum { MOST = 3 };
    const i8 most = i8_splat(MOST), width = pixels->x1 - pixels->x0, height = pixels->y1 - pixels->y0;
    const unsigned few =
        ~i8_sign_bits(rhw_less_int(most, width) | rhw_less_int(most, height) | ~small_lanes(lanes));
    if ((few & 0xff) == 0) {
        return 0;
    }
    const i8 turn = i8_from_bits(negative), half = i8_splat(RHW_SUBPIXEL / 2);
    const i8 x = (i8)((u8)pixels->x0 << RHW_SUBPIXEL_BITS) + half,
             y = (i8)((u8)pixels->y0 << RHW_SUBPIXEL_BITS) + half;
    u8 row[3], right[3], down[3];
    for (int i = 0; i < 3; i++) {
        const struct edge_lanes edge = edge_lanes(lanes->x, lanes->y, i, turn, x, y);
        row[i] = (u8)edge.e;
        right[i] = (u8)edge.a << RHW_SUBPIXEL_BITS;
        down[i] = (u8)edge.b << RHW_SUBPIXEL_BITS;
    }
    i8 outside = i8_splat(-1);
    for (int dy = 0; dy < MOST; dy++) {
        u8 e[3] = {row[0], row[1], row[2]};
        for (int dx = 0; dx < MOST; dx++) {
            outside &= (i8)(e[0] | e[1] | e[2]);
            for (int i = 0; i < 3; i++) {
                e[i] += right[i];
            }
        }
        for (int i = 0; i < 3; i++) {
            row[i] += down[i];
        }
    }
    return few & i8_sign_bits(outside);
}

// As span_of. A target has at most 256 tiles each way.
static i8 spans_of(const struct pixel_lanes *p)
{
    const i8 one = i8_splat(1);
    return (p->x0 >> RHW_TILE_LOG2) | (p->y0 >> RHW_TILE_LOG2) << 8 | ((p->x1 - one) >> RHW_TILE_LOG2) << 16 |
           ((p->y1 - one) >> RHW_TILE_LOG2) << 24;
}

// 8 struct rhw_triangle in two halves: first word by word, then triangle by triangle.
struct triangle_words {
    f8 low[8], high[8];
};

_Static_assert(offsetof(struct rhw_triangle, y_24_8) == 12 && offsetof(struct rhw_triangle, vertex) == 24 &&
                   offsetof(struct rhw_triangle, primitive) == 36 &&
                   offsetof(struct rhw_triangle, segment) == 40 &&
                   offsetof(struct rhw_triangle, polygon) == 44 &&
                   offsetof(struct rhw_triangle, flags) == 48 && offsetof(struct rhw_triangle, x0) == 50 &&
                   offsetof(struct rhw_triangle, y0) == 52 && offsetof(struct rhw_triangle, x1) == 54 &&
                   offsetof(struct rhw_triangle, y1) == 56 && sizeof(struct rhw_triangle) == 64,
               "fill_words writes struct rhw_triangle word by word");

static void fill_words(struct triangle_words *words, const struct corner_lanes *lanes,
                       const struct pixel_lanes *pixels, i8 flags, const uint32_t (*corners)[3],
                       uint32_t first_slot, uint32_t first_primitive, uint32_t segment)
{
    const void *places[8];
    for (int lane = 0; lane < 8; lane++) {
        places[lane] = corners[lane];
    }
    f8 vertex[4], *const low = words->low, *const high = words->high;
    f8_load_columns(places, vertex);
    for (int i = 0; i < 3; i++) {
        vertex[i] = (f8)((i8)vertex[i] - i8_splat((int32_t)first_slot));
        low[i] = (f8)lanes->x[i];
        low[3 + i] = (f8)lanes->y[i];
    }
    low[6] = vertex[0];
    low[7] = vertex[1];
    high[0] = vertex[2];
    high[1] = (f8)(i8_splat((int32_t)first_primitive) + rhw_lane_index);
    high[2] = (f8)i8_splat((int32_t)segment);
    high[3] = high[7] = f8_splat(0);
    high[4] = (f8)(flags | pixels->x0 << 16); // little-endian, as every machine with these lanes is
    high[5] = (f8)(pixels->y0 | pixels->x1 << 16);
    high[6] = (f8)pixels->y1;
    f8_transpose(low);
    f8_transpose(high);
}

// Where the triangles of a chunk go: room for all of them.
struct output {
    struct rhw_triangle *triangles;
    int count;
};

// Culls 8 triangles and adds what is left to `out`, in submission order. Reads one triangle more of `corners`.
static void setup8(struct rhw_front_scratch *scratch, uint32_t run_index, const uint32_t (*corners)[3],
                   uint32_t first_primitive, unsigned live, struct output *out)
{
    const struct rhw_run *const run = &scratch->runs[run_index];
    const struct rhw_segment *const segment = &scratch->segments[run_index];
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const struct corner_lanes lanes = load_corners(run->vertices, run->first_slot, corners);
    unsigned negative, nonzero;
    area_signs(&lanes, &negative, &nonzero);
    const unsigned back = def->front == RHW_COUNTER_CLOCKWISE ? ~negative : negative;
    const unsigned facing_away = def->cull == RHW_CULL_NONE ? 0 : def->cull == RHW_CULL_BACK ? back : ~back;
    const unsigned outside =
        ~i8_sign_bits(rhw_equal_int(lanes.flags_all & i8_splat(RHW_VERTEX_OUTSIDE), i8_splat(0)));
    const unsigned hard =
        live & ~i8_sign_bits(rhw_equal_int(
                   lanes.flags_any & i8_splat(RHW_VERTEX_CLIP | RHW_VERTEX_NOT_FINITE), i8_splat(0)));
    const unsigned easy = live & ~hard;
    unsigned drawn = easy & ~outside & nonzero & ~facing_away;
    if ((drawn | hard) == 0) {
        scratch->counters.culled += popcount(easy);
        return;
    }
    const struct pixel_lanes pixels = pixels_of(&lanes, &state->scissor);
    drawn &= i8_sign_bits(rhw_less_int(pixels.x0, pixels.x1) & rhw_less_int(pixels.y0, pixels.y1));
    if (drawn != 0) {
        drawn &= ~uncovered(&lanes, &pixels, negative);
    }
    scratch->counters.culled += popcount(easy & ~drawn);
    if ((drawn | hard) == 0) {
        return;
    }
    // A rounding may carry interpolated depth past the viewport's range, where a vertex is next to its ends.
    const float margin = 0x1p-20f;
    const i8 clamp = rhw_less(lanes.depth_min, f8_splat(state->depth_least + margin)) |
                     rhw_less(f8_splat(state->depth_most - margin), lanes.depth_max);
    const i8 flags = (i8_from_bits(back) & i8_splat(RHW_TRIANGLE_BACK)) |
                     (i8_from_bits(negative) & i8_splat(RHW_TRIANGLE_NEGATIVE)) |
                     (clamp & i8_splat(RHW_TRIANGLE_CLAMP)) |
                     (small_lanes(&lanes) & ~clamp & i8_splat(RHW_TRIANGLE_SMALL));
    struct triangle_words words;
    fill_words(&words, &lanes, &pixels, flags, corners, run->first_slot, first_primitive, run_index);
    uint32_t spans[8];
    i8_store(spans, spans_of(&pixels));
    for (unsigned left = drawn | hard; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        struct rhw_triangle *const t = &out->triangles[out->count];
        memcpy(t, &words.low[lane], 32);
        memcpy((unsigned char *)t + 32, &words.high[lane], 32);
        scratch->spans[out->count] = spans[lane];
        if (hard >> lane & 1) {
            if (!setup_clipped(scratch, segment, t)) {
                continue;
            }
            scratch->spans[out->count] = span_of(t);
        }
        out->count++;
    }
}

static void setup_run(struct rhw_front_scratch *scratch, uint32_t run_index, struct output *out)
{
    const struct rhw_run *const run = &scratch->runs[run_index];
    uint32_t i = 0;
    for (; i + 8 < run->count; i += 8) {
        setup8(scratch, run_index, run->corners + i, run->first_primitive + i, 0xff, out);
    }
    // The last ones are repeated, so that setup8 reads nothing else behind them.
    uint32_t corners[9][3];
    const uint32_t left = run->count - i;
    for (uint32_t lane = 0; lane < 9; lane++) {
        memcpy(corners[lane], run->corners[i + (lane < left ? lane : left - 1)], sizeof *corners);
    }
    setup8(scratch, run_index, (const uint32_t(*)[3])corners, run->first_primitive + i, 0xffu >> (8 - left),
           out);
}

// Takes the vertices of a run from those that its draw shares. False where it does not, or where the run names others.
static bool take_shared(struct rhw_run *run, struct rhw_segment *segment, const struct rhw_draw *draw,
                        uint32_t instance)
{
    uint32_t low, high;
    if (!draw->shared) {
        return false;
    }
    const struct rhw_shared_vertices *const shared = &draw->shared[instance];
    index_range(run, &low, &high);
    if (high >= shared->count) {
        return false;
    }
    run->first_slot = 0;
    run->vertices = shared->corners;
    *segment = shared->segment;
    return true;
}

// Assembles and shades. `first_primitive`: of the run's first triangle in its draw and instance.
static bool start_run(struct rhw_front_scratch *scratch, struct rhw_worker *worker,
                      const struct rhw_draw *draw, uint32_t instance, uint32_t first_primitive,
                      uint32_t count)
{
    struct rhw_segment *const segment = &scratch->segments[scratch->run_count];
    struct rhw_run *const run = &scratch->runs[scratch->run_count];
    uint32_t(*const corners)[3] = scratch->corners + scratch->corner_count;
    *run = (struct rhw_run){.corners = rhw_assembly_fetch(draw, first_primitive, count, corners),
                            .count = count,
                            .first_primitive = first_primitive};
    scratch->run_count++;
    scratch->corner_count += count;
    if (take_shared(run, segment, draw, instance)) {
        return true;
    }
    struct rhw_corner *const shaded = scratch->vertices + scratch->vertex_count;
    const uint32_t vertices = list_vertices(scratch, run, draw, corners);
    const uint32_t room = (vertices + 7) & ~7u;
    const int stride = rhw_vertex_stride(draw->state->pipeline->varying_components);
    const size_t size = (size_t)room * (size_t)stride * sizeof(float);
    run->vertices = shaded;
    *segment =
        (struct rhw_segment){draw, instance, stride, rhw_arena_alloc(&worker->arena, size, RHW_CACHE_LINE)};
    if (!segment->vertices) {
        return false;
    }
    shade_vertices(scratch, segment, shaded, vertices);
    scratch->counters.vertices_shaded += vertices;
    scratch->vertex_count += room;
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

static struct tile_span unpack(uint32_t span)
{
    return (struct tile_span){(int)(span & 0xff), (int)(span >> 8 & 0xff), (int)(span >> 16 & 0xff),
                              (int)(span >> 24)};
}

// The tiles that some of the spans meet. Bytes are compared 32 at a time; the array has room for that.
static struct tile_span unite(uint32_t *spans, int count)
{
    enum { STEP = 8 };
    unsigned char least[4 * STEP], most[4 * STEP];
    memset(least, 0xff, sizeof least);
    memset(most, 0, sizeof most);
    for (int i = count; i < ((count + STEP - 1) & -STEP); i++) {
        spans[i] = spans[count - 1];
    }
    for (int t = 0; t < count; t += STEP) {
        const unsigned char *const bytes = (const unsigned char *)(spans + t);
        for (int i = 0; i < 4 * STEP; i++) {
            least[i] = bytes[i] < least[i] ? bytes[i] : least[i];
            most[i] = bytes[i] > most[i] ? bytes[i] : most[i];
        }
    }
    struct tile_span all = {255, 255, 0, 0};
    for (int i = 0; i < 4 * STEP; i += 4) {
        all = (struct tile_span){min_int(all.x0, least[i]), min_int(all.y0, least[i + 1]),
                                 max_int(all.x1, most[i + 2]), max_int(all.y1, most[i + 3])};
    }
    return all;
}

static void bound_bins(struct rhw_chunk *chunk, uint32_t *spans, int triangle_count)
{
    chunk->tile_x0 = chunk->tile_y0 = chunk->tile_x1 = chunk->tile_y1 = 0;
    if (triangle_count != 0) {
        const struct tile_span all = unite(spans, triangle_count);
        chunk->tile_x0 = all.x0;
        chunk->tile_y0 = all.y0;
        chunk->tile_x1 = all.x1 + 1;
        chunk->tile_y1 = all.y1 + 1;
    }
}

static size_t tiles_of(const struct rhw_chunk *chunk)
{
    return (size_t)(chunk->tile_x1 - chunk->tile_x0) * (size_t)(chunk->tile_y1 - chunk->tile_y0);
}

// How many triangles, from the first on, have at most `most` entries in the bins. One always has.
static int triangles_that_fit(const struct rhw_chunk *chunk, const uint32_t *spans, int triangle_count,
                              uint32_t most)
{
    if ((size_t)triangle_count * tiles_of(chunk) <= most) {
        return triangle_count;
    }
    uint32_t entries = 0; // below 2^13 triangles · 2^16 tiles
    for (int t = 0; t < triangle_count; t++) {
        const struct tile_span s = unpack(spans[t]);
        entries += (uint32_t)((s.x1 - s.x0 + 1) * (s.y1 - s.y0 + 1));
        if (entries > most) {
            return t;
        }
    }
    return triangle_count;
}

// Counting sort of triangles by tile: counts, sums, then entries. offsets[i] runs from the start of bin i to
// its end while entries are placed, which is where bin i + 1 starts; hence the shift by one. Most triangles lie in
// one tile.
static bool bin(struct rhw_chunk *chunk, const uint32_t *spans, int triangle_count, struct rhw_arena *arena)
{
    const int width = chunk->tile_x1 - chunk->tile_x0, origin = chunk->tile_y0 * width + chunk->tile_x0;
    const size_t tiles = tiles_of(chunk);
    uint32_t *const offsets = rhw_arena_alloc(arena, (tiles + 2) * sizeof *offsets, RHW_CACHE_LINE);
    if (!offsets) {
        return false;
    }
    memset(offsets, 0, (tiles + 2) * sizeof *offsets);
    for (int t = 0; t < triangle_count; t++) {
        const struct tile_span s = unpack(spans[t]);
        uint32_t *const count = offsets + (s.y0 * width + s.x0 - origin + 2);
        if ((spans[t] & 0xffff) == spans[t] >> 16) {
            ++*count;
            continue;
        }
        for (int y = 0; y <= s.y1 - s.y0; y++) {
            for (int x = 0; x <= s.x1 - s.x0; x++) {
                count[y * width + x]++;
            }
        }
    }
    for (size_t i = 2; i < tiles + 2; i++) {
        offsets[i] += offsets[i - 1];
    }
    chunk->counters.entries = offsets[tiles + 1];
    uint16_t *const entries =
        rhw_arena_alloc(arena, (size_t)chunk->counters.entries * sizeof *chunk->entries, RHW_CACHE_LINE);
    if (!entries) {
        return false;
    }
    for (int t = 0; t < triangle_count; t++) {
        const struct tile_span s = unpack(spans[t]);
        uint32_t *const end = offsets + (s.y0 * width + s.x0 - origin + 1);
        if ((spans[t] & 0xffff) == spans[t] >> 16) {
            entries[(*end)++] = (uint16_t)t;
            continue;
        }
        for (int y = 0; y <= s.y1 - s.y0; y++) {
            for (int x = 0; x <= s.x1 - s.x0; x++) {
                entries[end[y * width + x]++] = (uint16_t)t;
            }
        }
    }
    chunk->offsets = offsets;
    chunk->entries = entries;
    return true;
}

// Assembles and shades what the chunk has of each instance of each draw.
static bool start_runs(const struct rhw_pass_state *pass, const struct rhw_chunk *chunk,
                       struct rhw_worker *worker)
{
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
            if (!start_run(worker->front, worker, draw, instance, first, count)) {
                return false;
            }
            at += count;
        }
    }
    return true;
}

// How the chunk may be drawn: as its draws may, where they agree.
static struct rhw_hidden_rule shared_hidden_rule(const struct rhw_front_scratch *scratch)
{
    const struct rhw_hidden_rule first = scratch->segments[0].draw->state->hidden;
    for (int i = 1; i < scratch->run_count; i++) {
        if (!rhw_hidden_rule_equal(scratch->segments[i].draw->state->hidden, first)) {
            return (struct rhw_hidden_rule){RHW_HIDDEN_IN_ORDER, RHW_COMPARE_NEVER};
        }
    }
    return first;
}

// Where a triangle of the chunk stands in the line of all triangles.
static uint64_t place_in_line(const struct rhw_front_scratch *scratch, const struct rhw_triangle *t)
{
    const struct rhw_segment *const segment = &scratch->segments[t->segment];
    const struct rhw_draw *const draw = segment->draw;
    return draw->first_triangle + (uint64_t)segment->instance * draw->triangles_per_instance + t->primitive;
}

_Static_assert(RHW_SHARED_PART % RHW_LANES == 0 && RHW_SHARED_PART <= 3 * RHW_CHUNK_TRIANGLES,
               "a part is whole groups, and fits the scratch");

// See rhw_kernels.
static void shade_part(struct rhw_pass_state *pass, const struct rhw_shared_part *part, int worker)
{
    struct rhw_front_scratch *const scratch = pass->workers[worker].front;
    const uint64_t start = rhw_time_ns();
    struct rhw_segment segment = part->shared->segment;
    segment.vertices += (size_t)part->first * (size_t)segment.vertex_stride;
    for (uint32_t i = 0; i < part->count; i++) {
        scratch->unique[i] = segment.draw->base_vertex + part->first + i;
    }
    shade_vertices(scratch, &segment, part->shared->corners + part->first, part->count);
    pass->workers[worker].counters.vertex_ns += rhw_time_ns() - start;
}

// Vertices and triangles of a chunk. False when out of memory.
static bool make_triangles(const struct rhw_pass_state *pass, const struct rhw_chunk *chunk,
                           struct rhw_worker *worker, struct output *out)
{
    struct rhw_front_scratch *const scratch = worker->front;
    scratch->run_count = scratch->polygon_count = 0;
    scratch->corner_count = scratch->vertex_count = 0;
    scratch->counters = (struct rhw_front_counters){0};
    const uint64_t start = rhw_time_ns();
    if (!start_runs(pass, chunk, worker)) {
        return false;
    }
    const uint64_t shaded = rhw_time_ns();
    // Room for all triangles; what culling leaves of it goes back.
    out->count = 0;
    out->triangles =
        rhw_arena_alloc(&worker->arena, (size_t)chunk->count * sizeof *out->triangles, RHW_CACHE_LINE);
    if (!out->triangles) {
        return false;
    }
    for (int i = 0; i < scratch->run_count; i++) {
        setup_run(scratch, (uint32_t)i, out);
    }
    rhw_arena_trim(&worker->arena, out->triangles + out->count);
    scratch->counters.rasterized = (uint64_t)out->count;
    worker->counters.vertex_ns += shaded - start;
    worker->counters.setup_ns += rhw_time_ns() - shaded;
    return true;
}

static bool make_chunk(struct rhw_pass_state *pass, struct rhw_chunk *chunk, int worker_index)
{
    struct rhw_worker *const worker = &pass->workers[worker_index];
    struct rhw_arena *const arena = &worker->arena;
    struct rhw_front_scratch *const scratch = worker->front;
    struct output out;
    if (!make_triangles(pass, chunk, worker, &out)) {
        return false;
    }
    // Large triangles on a large target: the chunk ends where its bins are full. Doing it again costs nothing beside
    // drawing that many entries, and its counters stay those of the triangles it has.
    bound_bins(chunk, scratch->spans, out.count);
    const int fit = triangles_that_fit(chunk, scratch->spans, out.count, pass->entries_most);
    if (fit < out.count) {
        chunk->count = place_in_line(scratch, &out.triangles[fit]) - chunk->first;
        if (!make_triangles(pass, chunk, worker, &out)) {
            return false;
        }
        bound_bins(chunk, scratch->spans, out.count);
    }
    const uint64_t start = rhw_time_ns();
    chunk->counters = scratch->counters;
    chunk->hidden = shared_hidden_rule(scratch);
    chunk->triangles = out.triangles;
    chunk->segments = keep(arena, scratch->segments, (size_t)scratch->run_count * sizeof *chunk->segments);
    chunk->polygons =
        keep(arena, scratch->polygons, (size_t)scratch->polygon_count * sizeof *chunk->polygons);
    const bool binned = chunk->segments && chunk->polygons && bin(chunk, scratch->spans, out.count, arena);
    worker->counters.bin_ns += rhw_time_ns() - start;
    return binned;
}
