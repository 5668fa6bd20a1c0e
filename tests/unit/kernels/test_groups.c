// SPDX-License-Identifier: MIT
// Which fragments share a group, whose groups share a call, and what path a triangle takes to them does not show:
// triangles of every size that are drawn together, blending over each other, give the picture of one after the other.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 150, TRIANGLES = 300 }; // two tiles and a part of a third each way

static void texel_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].ddx[0];
        groups[g].color[0][1] = groups[g].ddy[1];
        groups[g].color[0][2] = groups[g].varying[2];
        groups[g].color[0][3] = groups[g].varying[3];
    }
}

// Leaves out what has an odd digit, and shows the depth it was given: tested after shading.
static void masked_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        const rhw_int digit = __builtin_convertvector(groups[g].varying[0] * 8.0f, rhw_int);
        groups[g].mask &= (digit & 1) == 0;
        groups[g].color[0][1] = groups[g].depth;
    }
}

// Leaves some out, without a look at depth: tested before shading, and once more after.
static void sparse_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].mask &= groups[g].varying[1] > 0.3f;
    }
}

static void identity_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = (rhw_float)(groups[g].front_facing & 0x3f000000); // 0.5 or 0
    }
}

static void coord_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].coord[0] * 0x1p-8f;
        groups[g].color[0][1] = groups[g].coord[1] * 0x1p-8f;
        groups[g].color[0][2] = groups[g].coord[2] + groups[g].coord[3];
    }
}

// Coordinates and the instance, which is 0.
static void place_fragment(struct rhw_fragment *groups, int count)
{
    coord_fragment(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][2] += rhw_float_from_int(groups[g].instance);
    }
}

// Weights of both kinds and their derivatives.
static void weights_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        for (int c = 0; c < 3; c++) {
            groups[g].color[0][c] = f->barycentric[c] + f->barycentric_noperspective[c] * 0.5f +
                                    f->barycentric_ddx[c] - f->barycentric_ddy[c];
        }
    }
}

// Derivatives beside the depth.
static void slopes_fragment(struct rhw_fragment *groups, int count)
{
    texel_fragment(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][2] = groups[g].depth;
    }
}

enum program {
    PLAIN,
    DERIVATIVES,
    MASKED,
    SPARSE,
    IDENTITY,
    FLAT,
    SCREEN,
    SCREEN_DERIVATIVES,
    COORDINATES,
    PLACE,
    WEIGHTS,
    FLAT_DERIVATIVES,
    PROGRAMS
};

static void use_program(struct rig *rig, enum program program)
{
    static rhw_fragment_function *const fragments[PROGRAMS] = {
        [PLAIN] = rig_fragment_pass,    [DERIVATIVES] = texel_fragment,
        [MASKED] = masked_fragment,     [SPARSE] = sparse_fragment,
        [IDENTITY] = identity_fragment, [FLAT] = rig_fragment_pass,
        [SCREEN] = rig_fragment_pass,   [SCREEN_DERIVATIVES] = texel_fragment,
        [PLACE] = place_fragment,       [COORDINATES] = coord_fragment,
        [WEIGHTS] = weights_fragment,   [FLAT_DERIVATIVES] = slopes_fragment,
    };
    static const uint32_t uses[PROGRAMS] = {
        [MASKED] = RHW_USE_DISCARD | RHW_USE_DEPTH,
        [SPARSE] = RHW_USE_DISCARD,
        [IDENTITY] = RHW_USE_FACING,
        [COORDINATES] = RHW_USE_COORD,
        [PLACE] = RHW_USE_COORD | RHW_USE_IDS,
        [WEIGHTS] = RHW_USE_BARYCENTRIC | RHW_USE_BARYCENTRIC_DERIVATIVES,
        [FLAT_DERIVATIVES] = RHW_USE_DEPTH,
    };
    rig_set_program(rig, rig_vertex_pass, fragments[program]);
    struct rhw_varying *const varying = &rig->pipeline.program.varyings[0];
    varying->derivatives =
        program == DERIVATIVES || program == SCREEN_DERIVATIVES || program == FLAT_DERIVATIVES;
    varying->qualifier = program == FLAT || program == FLAT_DERIVATIVES       ? RHW_FLAT
                         : program == SCREEN || program == SCREEN_DERIVATIVES ? RHW_NOPERSPECTIVE
                                                                              : RHW_SMOOTH;
    rig->pipeline.program.uses = uses[program];
}

// Triangles of about `extent` pixels, so close together that pixels are covered many times.
static void make_triangles(const struct rig *rig, float extent, uint64_t *random,
                           struct rig_vertex vertices[3 * TRIANGLES])
{
    const float span = extent < 10 ? 3 * extent : SIZE + extent;
    for (int i = 0; i < TRIANGLES; i++) {
        const float x = 40 + rig_random_float(random, -0.3f * span, 0.7f * span);
        const float y = 30 + rig_random_float(random, -0.3f * span, 0.7f * span);
        for (int k = 0; k < 3; k++) {
            struct rig_vertex *const v = &vertices[3 * i + k];
            rig_place(rig, x + rig_random_float(random, -extent, extent),
                      y + rig_random_float(random, -extent, extent), rig_random_float(random, 0, 1),
                      rig_random_float(random, 1, 4), v->position);
            for (int c = 0; c < 4; c++) {
                v->value[c] = rig_random_float(random, 0, 1);
            }
        }
    }
}

enum { MOST_BYTES = SIZE * SIZE * 16 };

static size_t texel_size(enum rhw_format format)
{
    return format == RHW_FORMAT_RGBA8_UNORM ? 4 : 16;
}

static void draw_together(struct rig *rig, const struct rig_vertex *vertices, size_t texel,
                          unsigned char *picture)
{
    rig->pass.colors[0].load = rig->pass.depth.load = RHW_LOAD_CLEAR;
    rig_draw_once(rig, vertices, 3 * TRIANGLES);
    memcpy(picture, rig_read(rig, rig->pass.colors[0].texture), SIZE * SIZE * texel);
}

static void draw_one_by_one(struct rig *rig, const struct rig_vertex *vertices, size_t texel,
                            unsigned char *picture)
{
    rig->pass.colors[0].load = rig->pass.depth.load = RHW_LOAD_CLEAR;
    for (int i = 0; i < TRIANGLES; i++) {
        rig_draw_once(rig, &vertices[3 * i], 3);
        rig->pass.colors[0].load = rig->pass.depth.load = RHW_LOAD_LOAD;
    }
    memcpy(picture, rig_read(rig, rig->pass.colors[0].texture), SIZE * SIZE * texel);
}

// Every program, with and without a depth test, triangles of every size: pixels, blocks, parts of a tile, several
// tiles.
static void compare_paths(enum rhw_format format)
{
    static const float extents[] = {1, 2, 4, 9, 25, 70, 400};
    static struct rig_vertex vertices[3 * TRIANGLES];
    static unsigned char together[MOST_BYTES], alone[MOST_BYTES];
    const size_t texel = texel_size(format);
    uint64_t random = 71;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_target(&rig, 0, format);
    rig_set_depth(&rig);
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color = rig.pipeline.targets[0].alpha =
        (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    for (int i = 0; i < 2 * PROGRAMS; i++) {
        rig.pipeline.depth_test = i >= PROGRAMS;
        for (size_t e = 0; e < sizeof extents / sizeof *extents; e++) {
            use_program(&rig, (enum program)(i % PROGRAMS));
            make_triangles(&rig, extents[e], &random, vertices);
            draw_together(&rig, vertices, texel, together);
            draw_one_by_one(&rig, vertices, texel, alone);
            for (size_t p = 0; p < SIZE * SIZE; p++) {
                if (memcmp(together + p * texel, alone + p * texel, texel) != 0) {
                    fail_msg("program %d, triangles of %g pixels: pixel %zu,%zu differs", i % PROGRAMS,
                             (double)extents[e], p % SIZE, p / SIZE);
                }
            }
        }
    }
    rig_close(&rig);
}

static void test_together_as_one_by_one(void **state)
{
    (void)state;
    compare_paths(RHW_FORMAT_RGBA32_FLOAT);
}

static void test_the_same_in_8_bits(void **state)
{
    (void)state;
    compare_paths(RHW_FORMAT_RGBA8_UNORM);
}

// Moved by whole pixels, fragments of a triangle come to groups on other paths: their derivatives too are the same to
// the bit, and those of a constant have the same sign of zero.
static void test_moved_triangles(void **state)
{
    (void)state;
    enum { AREA = 60 };
    static float first[AREA * AREA][4];
    uint64_t random = 5;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    use_program(&rig, DERIVATIVES);
    for (int n = 0; n < 60; n++) {
        const float extent = rig_random_float(&random, 2, AREA);
        float corner[3][3];
        struct rig_vertex vertices[3];
        for (int k = 0; k < 3; k++) {
            corner[k][0] = floorf(256 * rig_random_float(&random, 0, extent)) / 256;
            corner[k][1] = floorf(256 * rig_random_float(&random, 0, extent)) / 256;
            corner[k][2] = (float)(1 << rig_random_int(&random, 4)); // so that every place is hit exactly
            for (int c = 0; c < 4; c++) {
                vertices[k].value[c] = c == 3 || n % 4 == 0 ? 0.7f : rig_random_float(&random, -1, 1);
            }
        }
        for (int place = 0; place < 6; place++) {
            const int dx = place * 37 % 83, dy = place * 29 % 67;
            for (int k = 0; k < 3; k++) {
                rig_place(&rig, corner[k][0] + (float)dx, corner[k][1] + (float)dy, 0.5f, corner[k][2],
                          vertices[k].position);
            }
            rig_draw_once(&rig, vertices, 3);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int y = 0; y < AREA; y++) {
                const float(*row)[4] = pixels + (y + dy) * SIZE + dx;
                if (place == 0) {
                    memcpy(first[y * AREA], row, AREA * sizeof *row);
                } else {
                    assert_memory_equal(first[y * AREA], row, AREA * sizeof *row);
                }
            }
        }
    }
    rig_close(&rig);
}

// Through a scissor that leaves out all but columns of the target, one after the other.
static void draw_in_columns(struct rig *rig, const struct rig_vertex *vertices, int size, int width)
{
    rig_begin(rig);
    for (int x = 0; x < size; x += width) {
        rhw_pass_set_scissor(rig->context, rig->recording, &(struct rhw_rect){x, 0, width, size});
        rig_draw(rig, vertices, 3);
    }
    rig_end(rig);
}

// A triangle over whole tiles takes a shorter path than the same triangle drawn in halves of tiles, whose blocks are
// whole, and in parts of blocks: opaque, when it is the last of its pixels and nothing before it is drawn, and blended.
// Where W is the same along a row, or everywhere, it takes a shorter one yet, but for the parts of blocks.
static void test_whole_tiles(void **state)
{
    (void)state;
    enum { TILES = 256, WHOLE = 7 };
    // The last but one leaves derivatives in the queue, which the last one has to replace.
    static const enum program programs[WHOLE] = {PLAIN,       DERIVATIVES,        MASKED,          SCREEN,
                                                 COORDINATES, SCREEN_DERIVATIVES, FLAT_DERIVATIVES};
    static float whole[TILES * TILES][4];
    static const struct {
        float corners[3][2], w[3];
    } shapes[] = {
        {{{-300, -40}, {900, -100}, {100, 1500}}, {1, 4, 7}},
        {{{-300, -40}, {900, -40}, {100, 1500}}, {1, 1, 7}},
        {{{100, -900}, {-400, 270}, {700, 270}}, {5, 1.3f, 1.3f}},
        {{{-300, -40}, {900, -100}, {100, 1500}}, {3, 3, 3}},
    };
    struct rig rig;
    rig_open(&rig, TILES, TILES);
    for (int i = 0; i < 4 * 2 * WHOLE; i++) {
        const int shape = i / (2 * WHOLE);
        struct rig_vertex vertices[3];
        for (int k = 0; k < 3; k++) {
            const float *const corner = shapes[shape].corners[k];
            const float depth = shape == 3 ? 0.5f : 0.2f + 0.2f * (float)k;
            rig_place(&rig, corner[0], corner[1], depth, shapes[shape].w[k], vertices[k].position);
            for (int c = 0; c < 4; c++) {
                vertices[k].value[c] = (float)((7 * k + 3 * c) % 5);
            }
        }
        use_program(&rig, programs[i % WHOLE]);
        rig.pipeline.targets[0].blend = i / WHOLE % 2;
        rig.pipeline.targets[0].color.dst = RHW_BLEND_ONE;
        rig_draw_once(&rig, vertices, 3);
        memcpy(whole, rig_read_float4(&rig), sizeof whole);
        draw_in_columns(&rig, vertices, TILES, 32);
        assert_memory_equal(rig_read_float4(&rig), whole, sizeof whole);
        draw_in_columns(&rig, vertices, TILES, 4);
        assert_memory_equal(rig_read_float4(&rig), whole, sizeof whole);
    }
    rig_close(&rig);
}

static void one_color_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(0.2f + 0.1f * (float)c);
        }
    }
}

static void position_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].position, groups[g].attribute[0], 4 * sizeof(rhw_float));
    }
}

// A triangle of one colour is put into whole tiles at once: opaque, blended and masked, in texels of every size. Drawn in
// parts of tiles it is put into blocks, and into parts of these.
static void test_whole_tiles_of_one_color(void **state)
{
    (void)state;
    enum { TILES = 256, FORMATS = 5 };
    static const enum rhw_format formats[FORMATS] = {RHW_FORMAT_R8_UNORM, RHW_FORMAT_RG8_UNORM,
                                                     RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA16_FLOAT,
                                                     RHW_FORMAT_RGBA32_FLOAT};
    static const float corners[3][2] = {{-300, -40}, {900, -100}, {100, 1500}};
    for (int i = 0; i < 3 * FORMATS; i++) {
        struct rig rig;
        struct rig_vertex vertices[3];
        rig_open(&rig, TILES, TILES);
        rig_set_target(&rig, 0, formats[i % FORMATS]);
        for (int k = 0; k < 3; k++) {
            rig_place(&rig, corners[k][0], corners[k][1], 0.5f, 1, vertices[k].position);
        }
        rig_set_program(&rig, position_vertex, one_color_fragment);
        memset(rig.pipeline.program.varyings, 0, sizeof rig.pipeline.program.varyings);
        rig.pipeline.program.varying_count = 0;
        rig.pipeline.targets[0].blend = i / FORMATS == 1;
        rig.pipeline.targets[0].color.dst = RHW_BLEND_ONE;
        rig.pipeline.targets[0].write_mask = i / FORMATS == 2 ? RHW_WRITE_RED : 0;
        rig_draw_once(&rig, vertices, 3);
        const uint64_t whole = rig_hash(&rig, 0);
        draw_in_columns(&rig, vertices, TILES, 32);
        assert_true(rig_hash(&rig, 0) == whole);
        draw_in_columns(&rig, vertices, TILES, 4);
        assert_true(rig_hash(&rig, 0) == whole);
        rig_close(&rig);
    }
}

static void white_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(1);
        }
    }
}

// Three triangles of one colour each: over all tiles, over some of them whole, and within one.
static uint64_t hash_of_layers(enum rhw_paths paths)
{
    enum { SIDE = 256, LAYERS = 3 };
    static const float corners[LAYERS][3][2] = {{{-300, -40}, {900, -100}, {100, 1500}},
                                                {{-100, -100}, {250, -100}, {-100, 600}},
                                                {{10, 10}, {40, 12}, {20, 50}}};
    struct rig rig;
    rig_open_with(&rig, SIDE, SIDE, &(struct rhw_context_def){.threads = 1, .paths = paths});
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_UNORM);
    rig_begin(&rig);
    for (int layer = 0; layer < LAYERS; layer++) {
        struct rig_vertex vertices[3];
        for (int k = 0; k < 3; k++) {
            rig_place(&rig, corners[layer][k][0], corners[layer][k][1], 0.5f, 1, vertices[k].position);
        }
        rig_set_program(&rig, position_vertex, layer == 1 ? white_fragment : one_color_fragment);
        memset(rig.pipeline.program.varyings, 0, sizeof rig.pipeline.program.varyings);
        rig.pipeline.program.varying_count = 0;
        rig_draw(&rig, vertices, 3);
    }
    rig_end(&rig);
    const uint64_t hash = rig_hash(&rig, 0);
    rig_close(&rig);
    return hash;
}

// What hides a tile of one colour stays in front of it, however draws are ordered.
static void test_whole_tiles_stay_behind(void **state)
{
    (void)state;
    assert_true(hash_of_layers(RHW_PATHS_ALL) == hash_of_layers(RHW_PATHS_GENERAL));
}

// Return how many lanes of a group are live, in the mean, where right triangles with legs of some pixels stand side by
// side, so that none is overtaken.
static double live_lanes(struct rig *rig, float leg)
{
    static struct rig_vertex vertices[3 * TRIANGLES];
    const int columns = (int)((float)SIZE / (leg + 2.5f)) - 1, count = columns * (columns * 3 / 4);
    uint64_t random = 3;
    for (int i = 0; i < count; i++) {
        const float x = (float)(i % columns) * (leg + 2.5f) + 3, y = (float)(i / columns) * (leg + 2.5f) + 3;
        for (int k = 0; k < 3; k++) {
            struct rig_vertex *const v = &vertices[3 * i + k];
            rig_place(rig, x + (k == 1 ? leg : 0), y + (k == 2 ? leg : 0), 0.5f, 1, v->position);
            for (int c = 0; c < 4; c++) {
                v->value[c] = rig_random_float(&random, 0, 1);
            }
        }
    }
    rig_draw_once(rig, vertices, 3 * count);
    return (double)rig->stats.fragments_shaded / (double)rig->stats.fragment_groups;
}

// Small triangles fill lanes whatever their fragments receive. Those of more than a block do so but for weights, whose
// groups are rows where these are half full.
static void test_lanes_are_full(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    for (int program = 0; program < PROGRAMS; program++) {
        use_program(&rig, (enum program)program);
        for (float leg = 4.5f; leg < 20; leg += 14) {
            const double lanes = live_lanes(&rig, leg);
            if (lanes < 7 && (leg < 8 || program != WEIGHTS)) {
                fail_msg("program %d, legs of %g: %g of 8 lanes are live", program, (double)leg, lanes);
            }
        }
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_together_as_one_by_one),   cmocka_unit_test(test_the_same_in_8_bits),
    cmocka_unit_test(test_moved_triangles),          cmocka_unit_test(test_whole_tiles),
    cmocka_unit_test(test_whole_tiles_of_one_color), cmocka_unit_test(test_whole_tiles_stay_behind),
    cmocka_unit_test(test_lanes_are_full),
};

const struct unit_tests test_groups = UNIT_TESTS(tests, NULL, NULL);
