// SPDX-License-Identifier: MIT
// See scene_input.h.
#include "scene_input.h"

#include <math.h>

#include "pipeline/blend_state.h"
#include "resource/clear_texel.h"
#include "base/constants.h"

// What the vertices of a scene are drawn around, and how.
struct style {
    struct rhw_viewport viewport;
    int32_t center_x, center_y; // 24.8; in the tile
    // One around the other; triangles of a mesh; W is 1; targets are replaced; depth is tested as it mostly is.
    bool near, mesh, affine, opaque, plain;
    enum rhw_compare compare;
};

static int pick(struct kernel_random *random, int low, int high)
{
    return (int)random_int(random, low, high);
}

// Vertices -------------------------------------------------------------------------------------------

// Within 1/256 pixel or, where W is a power of two and so are the viewport's sides, at (x, y).
static void put_vertex(float vertex[4], const struct rhw_viewport *v, int32_t x, int32_t y, float w)
{
    const float half_width = v->width / 2, half_height = v->height / 2;
    vertex[0] = ((float)x / RHW_SUBPIXEL - v->x - half_width) / half_width * w;
    vertex[1] = (v->y + half_height - (float)y / RHW_SUBPIXEL) / half_height * w;
    vertex[3] = w;
}

static float make_w(struct kernel_random *random, const struct style *style)
{
    if (style->affine) {
        return 1.0f;
    }
    if (style->mesh) {
        return random_float_in(random, 1.0f, 4.0f);
    }
    return random_one_in(random, 2) ? ldexpf(1.0f, pick(random, -3, 3))
                                    : random_float_in(random, 0x1p-20f, 0x1p20f);
}

// Flat in depth, often as deep as others; steep; or beyond the view volume.
static void make_depths(struct kernel_random *random, float triangle[3][16])
{
    const int kind = pick(random, 0, 7);
    const float flat = (float)pick(random, 1, 7) / 8;
    for (int i = 0; i < 3; i++) {
        const float depth = kind == 0   ? random_float_in(random, -0.5f, 1.5f)
                            : kind == 1 ? random_float_in(random, 0.0f, 1.0f)
                            : kind <= 4 ? flat
                                        : random_float_in(random, 0.125f, 0.875f);
        triangle[i][2] = depth * triangle[i][3];
    }
}

// -reach .. reach, none more often than others.
static int32_t anywhere(struct kernel_random *random, int32_t reach)
{
    return (int32_t)(random_bits(random) % (uint64_t)(2 * reach + 1)) - reach;
}

// Within a tile and beside it.
static void make_place(struct kernel_random *random, const struct style *style, int32_t *x, int32_t *y)
{
    const int32_t reach = style->near ? 0 : RHW_TILE * RHW_SUBPIXEL / 2;
    *x = style->center_x + anywhere(random, reach);
    *y = style->center_y + anywhere(random, reach);
}

// Hostile ones, or one as meshes have them, of a few pixels to half a tile.
static void make_corners(struct kernel_random *random, const struct style *style, int32_t xs[3],
                         int32_t ys[3])
{
    int32_t x, y;
    make_place(random, style, &x, &y);
    random_triangle(random, x, y, xs, ys);
    if (style->mesh) {
        const int32_t reach_x = pick(random, 1, 20) * RHW_SUBPIXEL,
                      reach_y = pick(random, 1, 20) * RHW_SUBPIXEL;
        for (int i = 0; i < 3; i++) {
            xs[i] = x + anywhere(random, reach_x);
            ys[i] = y + anywhere(random, reach_y);
        }
    }
}

static void make_triangle(struct kernel_random *random, const struct style *style, float triangle[3][16])
{
    int32_t xs[3], ys[3];
    make_corners(random, style, xs, ys);
    if (random_one_in(random, 6)) { // all of the target, and more
        const int32_t far = 4 * SCENE_SIZE * RHW_SUBPIXEL;
        xs[0] = xs[1] = ys[0] = ys[2] = -far / 2;
        ys[1] = xs[2] = far;
    }
    for (int i = 0; i < 3; i++) {
        put_vertex(triangle[i], &style->viewport, xs[i], ys[i], make_w(random, style));
    }
    make_depths(random, triangle);
    for (int i = 0; i < 3 && random_one_in(random, style->mesh ? 64 : 8);
         i++) { // behind the eye, not finite, of W next to 0
        random_clip_position(random, triangle[i]);
    }
}

static void make_vertices(struct kernel_random *random, const struct style *style, struct scene_input *in)
{
    for (int i = 0; i < SCENE_VERTICES; i += 3) {
        make_triangle(random, style, &in->vertices[i]);
    }
    for (int i = 0; i < SCENE_VERTICES; i++) {
        for (int c = 4; c < 16; c++) {
            in->vertices[i][c] =
                random_one_in(random, 16) ? random_finite(random) : random_float_in(random, -0.25f, 1.0f);
        }
    }
    for (int i = 0; i < SCENE_INDICES; i++) {
        const bool any = random_one_in(random, 12);
        in->indices[i] = any ? (uint32_t)pick(random, 0, SCENE_VERTICES) : (uint32_t)i % SCENE_VERTICES;
        in->indices[i] = random_one_in(random, 100) ? UINT32_MAX : in->indices[i]; // restarts
    }
}

// Draws ----------------------------------------------------------------------------------------------

static struct rhw_blend_component make_component(struct kernel_random *random)
{
    return (struct rhw_blend_component){
        .src = (enum rhw_blend_factor)pick(random, RHW_BLEND_ZERO, RHW_BLEND_ONE_MINUS_CONSTANT),
        .dst = (enum rhw_blend_factor)pick(random, RHW_BLEND_ZERO, RHW_BLEND_ONE_MINUS_CONSTANT),
        .operation = (enum rhw_blend_operation)pick(random, RHW_BLEND_ADD, RHW_BLEND_MAX)};
}

static struct rhw_color_target make_target(struct kernel_random *random, const struct style *style,
                                           enum rhw_format format)
{
    struct rhw_color_target target = {.format = format, .write_mask = 15};
    if (style->opaque) {
        return target;
    }
    target.blend =
        rhw_format_has_role(rhw_format_info(format), RHW_ROLE_BLENDED_TARGET) && random_one_in(random, 2);
    target.color = make_component(random);
    target.alpha = make_component(random);
    if (random_one_in(random, 2)) {
        target.color = target.alpha = (struct rhw_blend_component){
            .src = random_one_in(random, 2) ? RHW_BLEND_ONE : RHW_BLEND_SRC_ALPHA,
            .dst = RHW_BLEND_ONE_MINUS_SRC_ALPHA};
    }
    target.write_mask = random_one_in(random, 4) ? (uint8_t)pick(random, 0, 15) : 15;
    return target;
}

// Often what any 8 fragments can carry, or nothing.
static void make_program(struct kernel_random *random, struct scene_draw *draw)
{
    const uint32_t scattered = RHW_USE_DISCARD | RHW_USE_DEPTH | RHW_USE_FACING | RHW_USE_IDS;
    const bool any = random_one_in(random, 4);
    draw->shades = !random_one_in(random, 8);
    draw->varying_count = random_one_in(random, 8) ? 0 : pick(random, 1, SCENE_VARYINGS);
    for (int i = 0; i < draw->varying_count; i++) {
        draw->varyings[i] = (struct rhw_varying){
            .components = pick(random, 1, SCENE_COMPONENTS / SCENE_VARYINGS),
            .qualifier = any ? (enum rhw_qualifier)pick(random, RHW_SMOOTH, RHW_FLAT) : RHW_SMOOTH,
            .derivatives = random_one_in(random, 3)};
    }
    switch (pick(random, 0, 5)) {
    case 0: draw->uses = (uint32_t)pick(random, 0, 127); break;
    case 1: draw->uses = (uint32_t)pick(random, 0, 127) & scattered; break;
    case 2: draw->uses = random_one_in(random, 2) ? RHW_USE_DISCARD : RHW_USE_DEPTH; break;
    default: break;
    }
}

static void make_scissor(struct kernel_random *random, const struct scene_input *in, struct scene_draw *draw)
{
    struct rhw_rect *const scissor = &draw->scissor;
    *scissor = (struct rhw_rect){0, 0, in->width, in->height};
    if (random_one_in(random, 4)) {
        scissor->x = pick(random, 0, in->width - 1);
        scissor->y = pick(random, 0, in->height - 1);
        scissor->width = pick(random, 1, in->width - scissor->x);
        scissor->height = pick(random, 1, in->height - scissor->y);
    }
}

static void make_depth_state(struct kernel_random *random, const struct style *style, struct scene_draw *draw)
{
    draw->depth_test = !random_one_in(random, 4);
    draw->depth_write = !random_one_in(random, 4);
    draw->depth_compare = pick(random, RHW_COMPARE_NEVER, RHW_COMPARE_ALWAYS);
    if (style->plain) {
        draw->depth_write = 1;
        draw->depth_compare = (int32_t)style->compare;
    } else if (random_one_in(random, 2)) {
        draw->depth_compare = random_one_in(random, 2) ? RHW_COMPARE_GREATER_EQUAL : RHW_COMPARE_GREATER;
    }
}

static void make_states(struct kernel_random *random, const struct style *style, const struct scene_input *in,
                        struct scene_draw *draw)
{
    make_depth_state(random, style, draw);
    make_scissor(random, in, draw);
    draw->viewport = style->viewport;
    if (random_one_in(random, 4)) {
        draw->viewport.depth_min = random_float_in(random, 0.0f, 1.0f);
        draw->viewport.depth_max = random_float_in(random, 0.0f, 1.0f);
    }
    for (int t = 0; t < in->target_count; t++) {
        draw->targets[t] = make_target(random, style, (enum rhw_format)in->formats[t]);
    }
    for (int i = 0; i < 4; i++) {
        draw->constant[i] = random_float_in(random, -0.25f, 1.25f);
        draw->uniforms[i] = random_float_in(random, 0.0f, 0.5f);
    }
    draw->provoking = pick(random, RHW_PROVOKING_FIRST, RHW_PROVOKING_LAST);
    draw->cull = random_one_in(random, 4) ? pick(random, RHW_CULL_FRONT, RHW_CULL_BACK) : RHW_CULL_NONE;
    draw->front = pick(random, RHW_COUNTER_CLOCKWISE, RHW_CLOCKWISE);
    draw->depth_range = random_one_in(random, 4) ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
}

static void make_draw(struct kernel_random *random, const struct style *style, struct scene_input *in,
                      struct scene_draw *draw)
{
    const struct scene_draw *const before = draw > in->draws ? draw - 1 : NULL;
    if (before && random_one_in(random, 2)) { // the state of the one before
        *draw = *before;
    } else {
        make_program(random, draw);
        make_states(random, style, in, draw);
    }
    draw->topology =
        random_one_in(random, 4) ? pick(random, RHW_TRIANGLE_STRIP, RHW_TRIANGLE_FAN) : RHW_TRIANGLE_LIST;
    draw->restarts = random_one_in(random, 2);
    draw->indexed = random_one_in(random, 2);
    draw->index_type = before ? before->index_type : pick(random, RHW_INDEX_UINT8, RHW_INDEX_UINT32);
    draw->first = (uint32_t)pick(random, 0, SCENE_INDICES / 3) * 3;
    draw->count = (uint32_t)pick(random, 0, SCENE_INDICES - (int)draw->first);
    draw->base_vertex = random_one_in(random, 4) ? (uint32_t)pick(random, 0, 3) : 0;
    draw->instances = random_one_in(random, 4) ? 2 : 1;
}

// Targets --------------------------------------------------------------------------------------------

// The first of 8 bytes a texel at most, others of 4: what a check compares stays in the cache.
static enum rhw_format make_format(struct kernel_random *random, int size)
{
    enum rhw_format format;
    do {
        format = random_one_in(random, 2)
                     ? RHW_FORMAT_RGBA8_UNORM
                     : (enum rhw_format)pick(random, RHW_FORMAT_NONE + 1, RHW_PLAIN_FORMAT_COUNT - 1);
    } while (!rhw_format_has_role(rhw_format_info(format), RHW_ROLE_COLOR_TARGET) ||
             rhw_format_info(format)->size > size);
    return format;
}

static void make_attachments(struct kernel_random *random, struct scene_input *in)
{
    in->width = pick(random, 1, SCENE_SIZE);
    in->height = pick(random, 1, SCENE_SIZE);
    const int tiles_x = (in->width + RHW_TILE - 1) / RHW_TILE,
              tiles_y = (in->height + RHW_TILE - 1) / RHW_TILE;
    in->tile = pick(random, 0, tiles_x * tiles_y - 1);
    in->entries_most = random_one_in(random, 8) ? (uint32_t)(tiles_x * tiles_y) : 1u << 20;
    in->target_count = random_one_in(random, 4) ? pick(random, 0, SCENE_TARGETS) : 1;
    for (int t = 0; t < in->target_count; t++) {
        in->formats[t] = (int32_t)make_format(random, t == 0 ? 8 : 4);
        const struct rhw_format_info *const info = rhw_format_info((enum rhw_format)in->formats[t]);
        for (int i = 0; i < RHW_CLEAR_BYTES; i += info->size) {
            float clear[4];
            for (int c = 0; c < 4; c++) {
                clear[c] = random_float_in(random, -0.25f, 1.25f);
            }
            rhw_clear_texel(info, clear, &in->clear[t][i]);
        }
    }
    const bool is_far = random_one_in(random, 2);
    for (size_t i = 0; i < sizeof in->clear_depth / sizeof *in->clear_depth; i++) {
        in->clear_depth[i] = is_far ? 1.0f : random_float_in(random, 0.0f, 1.0f);
    }
}

void make_scene(struct kernel_random *random, void *input)
{
    static const enum rhw_compare ordering[] = {RHW_COMPARE_LESS, RHW_COMPARE_LESS_EQUAL, RHW_COMPARE_GREATER,
                                                RHW_COMPARE_GREATER_EQUAL};
    struct scene_input *const in = input;
    make_attachments(random, in);
    const int tiles_x = (in->width + RHW_TILE - 1) / RHW_TILE;
    const float side = random_one_in(random, 4) ? random_float_in(random, 16.0f, 300.0f) : 128.0f;
    const struct style style = {
        .viewport = {.width = side, .height = side, .depth_max = 1.0f},
        .center_x = (in->tile % tiles_x * RHW_TILE + pick(random, 0, RHW_TILE)) * RHW_SUBPIXEL,
        .center_y = (in->tile / tiles_x * RHW_TILE + pick(random, 0, RHW_TILE)) * RHW_SUBPIXEL,
        .near = random_one_in(random, 2),
        .mesh = !random_one_in(random, 3),
        .affine = random_one_in(random, 4),
        .opaque = random_one_in(random, 2),
        .plain = random_one_in(random, 2),
        .compare = ordering[pick(random, 0, 3)],
    };
    make_vertices(random, &style, in);
    in->draw_count = pick(random, 1, SCENE_DRAWS);
    for (int d = 0; d < in->draw_count; d++) {
        make_draw(random, &style, in, &in->draws[d]);
    }
    in->split = random_one_in(random, 2) ? UINT32_MAX : (uint32_t)pick(random, 1, 24);
}
