// SPDX-License-Identifier: MIT
// Golden scene of storage: every fragment of glass shards goes into a list of its pixel, which a last draw of the same
// pass blends from the farthest to the nearest. Which node of memory a fragment gets differs from run to run; the picture
// does not.
#include "golden_scenes.h"

#include <rhw/shader.h>

#include <stdlib.h>

enum { SIDE = 112, SHARDS = 40, NODES = SIDE * SIDE * 24, NODE_WORDS = 4 };

// Image slots: fragments of each pixel; the picture in a mirror.
enum { IMAGE_COUNTS, IMAGE_MIRROR };

// Slots: how many nodes there are; the first node of each pixel's list, 0: none; nodes: the next one, depth, colour, and
// which vertex was met how often.
enum { SLOT_COUNT, SLOT_HEADS, SLOT_NODES, SLOT_VERTICES, SLOTS };

static void place(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        rhw_storage_atomic(v->bindings, SLOT_VERTICES, RHW_STORAGE_ADD, v->vertex_index, rhw_splat_int(1),
                           v->mask);
        for (int c = 0; c < 4; c++) {
            v->position[c] = v->attribute[0][c];
            v->varying[c] = v->attribute[1][c];
        }
    }
}

static rhw_int pixel_of(const struct rhw_fragment *f)
{
    return rhw_int_from_float(f->coord[1]) * SIDE + rhw_int_from_float(f->coord[0]);
}

static void list(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const struct rhw_bindings *const t = f->bindings;
        const rhw_int at[2] = {rhw_int_from_float(f->coord[0]), rhw_int_from_float(f->coord[1])};
        const rhw_int one = rhw_splat_int(1);
        const struct rhw_storage_request request = {
            .operation = RHW_STORAGE_ADD, .mask = &f->mask, .index = at, .value = &one};
        rhw_image_atomic(t, IMAGE_COUNTS, &request, NULL);
        const rhw_int node =
            rhw_storage_atomic(t, SLOT_COUNT, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1), f->mask);
        const rhw_int next =
            rhw_storage_atomic(t, SLOT_HEADS, RHW_STORAGE_EXCHANGE, pixel_of(f), node, f->mask);
        rhw_int color = rhw_splat_int(0);
        for (int c = 0; c < 4; c++) {
            color |= rhw_int_from_float(rhw_saturate(f->varying[c]) * 255.0f) << (8 * c);
            f->color[0][c] = f->varying[c];
        }
        rhw_storage_store(t, SLOT_NODES, node * NODE_WORDS, next, f->mask);
        rhw_storage_store(t, SLOT_NODES, node * NODE_WORDS + 1, rhw_bits_from_float(f->coord[2]), f->mask);
        rhw_storage_store(t, SLOT_NODES, node * NODE_WORDS + 2, color, f->mask);
    }
}

// The farthest node that lies before `before`, of those of equal depth the first in the list; 0: none.
static uint32_t farthest(const struct rhw_bindings *bindings, uint32_t head, float before, float *depth)
{
    uint32_t found = 0;
    *depth = -1;
    while (head != 0) {
        const float z = rhw_float_from_bits1(rhw_storage_load1(bindings, SLOT_NODES, head * NODE_WORDS + 1));
        if (z < before && z > *depth) {
            *depth = z;
            found = head;
        }
        head = (uint32_t)rhw_storage_load1(bindings, SLOT_NODES, head * NODE_WORDS);
    }
    return found;
}

static void blend1(struct rhw_fragment1 *f)
{
    const uint32_t pixel = (uint32_t)f->coord[1] * SIDE + (uint32_t)f->coord[0];
    const uint32_t head = (uint32_t)rhw_storage_load1(f->bindings, SLOT_HEADS, pixel);
    float color[3] = {0.1f, 0.2f, 0.3f}, before = 2, depth;
    uint32_t node;
    while ((node = farthest(f->bindings, head, before, &depth)) != 0) {
        const uint32_t glass = (uint32_t)rhw_storage_load1(f->bindings, SLOT_NODES, node * NODE_WORDS + 2);
        const float alpha = (float)(glass >> 24) / 255;
        for (int c = 0; c < 3; c++) {
            color[c] += ((float)(glass >> 8 * c & 255) / 255 - color[c]) * alpha;
        }
        before = depth;
    }
    for (int c = 0; c < 3; c++) {
        f->color[0][c] = color[c];
    }
    f->color[0][3] = 1;
    const int32_t at[2] = {SIDE - 1 - (int32_t)f->coord[0], (int32_t)f->coord[1]};
    rhw_image_store1(f->bindings, IMAGE_MIRROR, at, f->color[0]);
}

static void make_shards(float shards[3 * SHARDS][8])
{
    uint64_t random = 16;
    for (int i = 0; i < 3 * SHARDS; i++) {
        const float w = golden_random(&random, 0.5f, 2);
        for (int c = 0; c < 2; c++) {
            shards[i][c] = golden_random(&random, -1.1f, 1.1f) * w;
        }
        shards[i][2] = golden_random(&random, 0, 1) * w;
        shards[i][3] = w;
        for (int c = 4; c < 8; c++) {
            shards[i][c] = golden_random(&random, 0.1f, 0.9f);
        }
    }
}

static struct rhw_pipeline_def pipeline_def(void)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = {place},
                                       .fragment = {list},
                                       .varyings = {{.components = 4}},
                                       .varying_count = 1,
                                       .uses = RHW_USE_EFFECTS | RHW_USE_COORD,
                                       .vertex_effects = true};
    for (int a = 0; a < 2; a++) {
        def.attributes[a] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, 16 * (uint32_t)a};
    }
    def.attribute_count = 2;
    def.buffer_count = 1;
    return def;
}

void golden_storage_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    static const float screen[3][8] = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
    static const size_t sizes[SLOTS] = {4, 4 * SIDE * SIDE, 4 * NODE_WORDS * NODES, 4 * 3 * SHARDS};
    const enum rhw_format format = RHW_FORMAT_RGBA8_UNORM;
    const uint32_t first_node = 1;
    float shards[3 * SHARDS][8];
    struct golden_board board;
    golden_board_make(&board, context, SIDE, SIDE, &format, 1);
    golden_board_begin(&board);
    make_shards(shards);
    rhw_buffer buffers[SLOTS];
    for (int i = 0; i < SLOTS; i++) {
        buffers[i] = golden_buffer(context, i == SLOT_COUNT ? &first_node : NULL, sizes[i]);
        rhw_pass_set_storage_buffer(context, board.pass, i, buffers[i], 0, 0);
    }
    const rhw_texture counted = golden_texture(context, RHW_FORMAT_R32_UINT, SIDE, SIDE, 1),
                      mirror = golden_texture(context, RHW_FORMAT_RGBA16_FLOAT, SIDE, SIDE, 1);
    rhw_pass_set_storage_image(context, board.pass, IMAGE_COUNTS, counted, 0);
    rhw_pass_set_storage_image(context, board.pass, IMAGE_MIRROR, mirror, 0);
    struct rhw_pipeline_def def = pipeline_def();
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, shards, sizeof shards), 0);
    rhw_pass_draw(context, board.pass, 0, 3 * SHARDS, 0, 2);
    def.program.fragment[0] = NULL;
    def.program.fragment1 = blend1;
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, screen, sizeof screen), 0);
    rhw_pass_draw(context, board.pass, 0, 3, 0, 1);
    golden_board_end(&board);
    golden_board_keep(&board, images);
    golden_keep(images, context, counted);
    golden_keep(images, context, mirror);
    uint32_t *const counts = malloc(sizes[SLOT_VERTICES] + 4);
    golden_check(rhw_buffer_read(context, buffers[SLOT_VERTICES], 0, counts, sizes[SLOT_VERTICES]),
                 "vertices");
    golden_check(rhw_buffer_read(context, buffers[SLOT_COUNT], 0, counts + 3 * SHARDS, 4), "nodes");
    golden_give(images, RHW_FORMAT_R32_UINT, 3 * SHARDS + 1, 1, counts);
}
