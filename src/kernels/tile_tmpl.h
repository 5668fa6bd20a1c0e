// SPDX-License-Identifier: MIT
// One tile: load or clear, draw the triangles binned for it in submission order, store.
// Template: compiled once per instruction set.

#include "coverage_tmpl.h"
#include "shade_tmpl.h"

// 8 rows of a block: depth, then what survives is collected for shading.
static void draw_block(struct tile_work *work, const struct rhw_segment *segment, const struct rhw_triangle *t,
                       const struct planes *planes, struct triangle_values *values, int x, int y, uint64_t mask)
{
    struct lanes at = {.dx = d8_from_i8(i8_splat(work->x + x - planes->anchor_x) + rhw_lane_index)};
    const bool needs_depth = work->depth_mode != DEPTH_NONE || work->pipeline->def.program.uses & (RHW_USE_COORD | RHW_USE_DEPTH);
    for (int row = __builtin_ctzll(mask) / 8; row < RHW_BLOCK; row++) {
        unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        if (bits == 0) {
            continue;
        }
        at.dy = (double)(work->y + y + row - planes->anchor_y);
        f8 z = f8_splat(0);
        if (needs_depth) {
            z = depth_at(planes, at);
            if (t->flags & RHW_TRIANGLE_CLAMP) {
                z = viewport_clamp(work->state, z);
            }
        }
        if (work->depth_mode == DEPTH_EARLY) {
            bits = i8_sign_bits(depth_test_and_write(work, x, y + row, z, i8_from_bits(bits)));
        } else if (work->depth_mode == DEPTH_EARLY_REJECT) {
            bits &= i8_sign_bits(depth_passes(work->pipeline->def.depth_compare, z, f8_load(depth_row(work, x, y + row))));
        }
        if (bits == 0 || !work->shades) {
            continue;
        }
        if (!values->ready) {
            prepare_values(work, segment, t, values);
        }
        add_group(work, segment, t, planes, values, at, (struct rhw_group_place){x, y + row, bits}, z);
    }
}

static void draw_triangle(struct tile_work *work, const struct rhw_chunk *chunk, const struct rhw_triangle *t)
{
    const struct rhw_segment *const segment = &chunk->segments[t->segment];
    if (segment->draw != work->draw) {
        set_draw(work, segment->draw);
    }
    // In the tile, and within what was covered.
    const int x0 = max_int(t->x0 - work->x, 0), x1 = min_int(t->x1 - work->x, RHW_TILE);
    const int y0 = max_int(t->y0 - work->y, 0), y1 = min_int(t->y1 - work->y, RHW_TILE);
    struct coverage coverage;
    coverage_setup(&coverage, chunk, t, work->x, work->y);
    if (coverage.count == 0) {
        return;
    }
    struct planes planes;
    struct triangle_values values;
    values.provoking = NULL;
    bool planes_ready = false;
    values.ready = false;
    for (int y = y0 & -RHW_BLOCK; y < y1; y += RHW_BLOCK) {
        const int row0 = max_int(y0 - y, 0), row1 = min_int(y1 - y, RHW_BLOCK);
        for (int x = x0 & -RHW_BLOCK; x < x1; x += RHW_BLOCK) {
            const uint64_t mask = coverage_mask(&coverage, x, y, row0, row1) & rect_mask(x, y, x0, y0, x1, y1);
            if (mask == 0) {
                continue;
            }
            if (!planes_ready) {
                for (int i = 0; i < 3; i++) {
                    values.v[i] = record_at(segment, t->vertex[i]);
                }
                if (t->flags & RHW_TRIANGLE_UNSNAPPED) {
                    planes_homogeneous(&planes, work->state, values.v);
                } else {
                    planes_snapped(&planes, t, values.v);
                }
                planes_ready = true;
            }
            draw_block(work, segment, t, &planes, &values, x, y, mask);
        }
    }
}

static void fill_texels(unsigned char *texels, const unsigned char *texel, size_t size)
{
    memcpy(texels, texel, size);
    for (size_t done = size; done < RHW_TILE * RHW_TILE * size; done *= 2) {
        const size_t all = RHW_TILE * RHW_TILE * size;
        memcpy(texels + done, texels, done < all - done ? done : all - done);
    }
}

// `tile`: the attachment's storage in the scratch, RHW_TILE texels per row.
static void load_attachment(const struct tile_work *work, const struct rhw_attachment *attachment, unsigned char *tile,
                            int width, int height)
{
    static const unsigned char zero[16] = {0};
    const size_t size = attachment->texel_size;
    const enum rhw_load load = work->pass->first_wave ? attachment->load : RHW_LOAD_LOAD;
    if (load != RHW_LOAD_LOAD) {
        // What DISCARD leaves is undefined to the user and still the same bytes on every run.
        fill_texels(tile, load == RHW_LOAD_CLEAR ? attachment->clear : zero, size);
        return;
    }
    const struct rhw_mip *const mip = attachment->target;
    for (int y = 0; y < height; y++) {
        const unsigned char *const from =
            mip->texels + (size_t)(work->y + y) * mip->row_pitch + (size_t)work->x * size;
        memcpy(tile + (size_t)y * RHW_TILE * size, from, (size_t)width * size);
    }
}

static void store_attachment(const struct tile_work *work, const struct rhw_attachment *attachment,
                             const unsigned char *tile, int width, int height)
{
    const struct rhw_mip *const mip = attachment->target;
    const size_t size = attachment->texel_size;
    if (!mip || (work->pass->last_wave && attachment->store == RHW_STORE_DISCARD)) {
        return;
    }
    for (int y = 0; y < height; y++) {
        unsigned char *const to = mip->texels + (size_t)(work->y + y) * mip->row_pitch + (size_t)work->x * size;
        memcpy(to, tile + (size_t)y * RHW_TILE * size, (size_t)width * size);
    }
}

static void run_tile(struct rhw_pass_state *pass, int tile, int worker)
{
    const int tile_x = tile % pass->tiles_x, tile_y = tile / pass->tiles_x;
    struct rhw_tile_scratch *const scratch = pass->workers[worker].tile;
    struct tile_work work = {.pass = pass,
                             .scratch = scratch,
                             .counters = &pass->workers[worker].counters,
                             .x = tile_x * RHW_TILE,
                             .y = tile_y * RHW_TILE};
    const int width = min_int(pass->width - work.x, RHW_TILE), height = min_int(pass->height - work.y, RHW_TILE);
    for (int i = 0; i < pass->color_count; i++) {
        load_attachment(&work, &pass->colors[i], scratch->color[i], width, height);
    }
    if (pass->has_depth) {
        load_attachment(&work, &pass->depth, (unsigned char *)scratch->depth, width, height);
    }
    for (int i = 0; i < pass->chunk_count; i++) {
        const struct rhw_chunk *const chunk = &pass->chunks[i];
        if (tile_x < chunk->tile_x0 || tile_x >= chunk->tile_x1 || tile_y < chunk->tile_y0 || tile_y >= chunk->tile_y1) {
            continue;
        }
        const int bin = (tile_y - chunk->tile_y0) * (chunk->tile_x1 - chunk->tile_x0) + tile_x - chunk->tile_x0;
        for (uint32_t e = chunk->offsets[bin]; e < chunk->offsets[bin + 1]; e++) {
            draw_triangle(&work, chunk, &chunk->triangles[chunk->entries[e]]);
        }
    }
    flush(&work);
    for (int i = 0; i < pass->color_count; i++) {
        store_attachment(&work, &pass->colors[i], scratch->color[i], width, height);
    }
    if (pass->has_depth) {
        store_attachment(&work, &pass->depth, (const unsigned char *)scratch->depth, width, height);
    }
}
