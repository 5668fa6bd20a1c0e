// SPDX-License-Identifier: MIT
// Opaque draws of a pass may be drawn depth first, or backwards, and shaded where they are seen. The picture is that of
// one triangle after the other: also among equal depths, next to what was loaded, and with fragment functions that
// discard.
#include "harness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Half the draws are 128 triangles, a chunk (run/run.c): runs of draws end where chunks do.
enum { SIZE = 128, DRAWS = 64, TRIANGLES = 4 };

// What a draw does besides covering its triangles.
enum kind { KIND_PLAIN, KIND_COORD, KIND_MASKED, KIND_MASKED_COORD, KIND_COUNT };

struct layer {
    enum kind kind;
    bool tests, writes; // depth
    enum rhw_compare compare;
    struct rig_vertex vertices[3 * TRIANGLES];
};

static void coord_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][2] = groups[g].coord[2];
    }
}

// Discards where the first value, which no two layers share, has an odd digit.
static void discard_some(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int digit = __builtin_convertvector(groups[g].varying[0] * 8.0f, rhw_int);
        groups[g].mask &= (digit & 1) == 0;
    }
}

static void masked_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    discard_some(groups, count);
}

static void masked_coord_fragment(struct rhw_fragment *groups, int count)
{
    coord_fragment(groups, count);
    discard_some(groups, count);
}

static void use_layer(struct rig *rig, const struct layer *layer)
{
    static const struct {
        rhw_fragment_function *fragment;
        uint32_t uses;
    } kinds[KIND_COUNT] = {
        [KIND_PLAIN] = {rig_fragment_pass, 0},
        [KIND_COORD] = {coord_fragment, RHW_USE_COORD},
        [KIND_MASKED] = {masked_fragment, RHW_USE_DISCARD},
        [KIND_MASKED_COORD] = {masked_coord_fragment, RHW_USE_DISCARD | RHW_USE_COORD},
    };
    rig_set_program(rig, rig_vertex_pass, kinds[layer->kind].fragment);
    rig->pipeline.program.uses = kinds[layer->kind].uses;
    rig->pipeline.depth_test = layer->tests;
    rig->pipeline.depth_read_only = !layer->writes;
    rig->pipeline.depth_compare = layer->compare;
}

// Large and small triangles, most of them at one of five depths, so that many fragments are equally deep.
static void make_layers(const struct rig *rig, uint64_t *random, struct layer layers[DRAWS])
{
    for (int d = 0; d < DRAWS; d++) {
        layers[d].kind = (enum kind)rig_random_int(random, KIND_COUNT);
        layers[d].tests = rig->pipeline.depth_test;
        layers[d].writes = !rig->pipeline.depth_read_only;
        layers[d].compare = rig->pipeline.depth_compare;
        for (int i = 0; i < TRIANGLES; i++) {
            const float size = rig_random_int(random, 4) == 0 ? 20 : 2.0f * SIZE,
                        flat = 0.25f * (float)rig_random_int(random, 5);
            const float x = rig_random_float(random, -20, SIZE), y = rig_random_float(random, -20, SIZE);
            const bool slanted = rig_random_int(random, 4) == 0;
            for (int k = 0; k < 3; k++) {
                struct rig_vertex *const v = &layers[d].vertices[3 * i + k];
                const float depth = slanted ? rig_random_float(random, -0.25f, 1.25f) : flat;
                rig_place(rig, x + rig_random_float(random, -size, size),
                          y + rig_random_float(random, -size, size), depth,
                          1 + (float)rig_random_int(random, 3), v->position);
                for (int c = 0; c < 4; c++) {
                    v->value[c] = rig_random_float(random, 0, 1);
                }
            }
        }
    }
}

struct picture {
    float color[SIZE * SIZE][4], depth[SIZE * SIZE];
    uint64_t shaded;
};

static void keep(struct rig *rig, struct picture *picture)
{
    memcpy(picture->color, rig_read_float4(rig), sizeof picture->color);
    memcpy(picture->depth, rig_read_depth(rig), sizeof picture->depth);
}

// `depth`: what is there before, or NULL: the clear value.
static void start(struct rig *rig, const float *depth)
{
    rig->pass.colors[0].load = RHW_LOAD_CLEAR;
    rig->pass.depth.load = depth ? RHW_LOAD_LOAD : RHW_LOAD_CLEAR;
    if (depth) {
        rhw_texture_write(rig->context, rig->pass.depth.texture, 0, depth, 0);
    }
}

static void draw_together_over(struct rig *rig, const struct layer layers[DRAWS], const float *depth,
                               struct picture *picture)
{
    start(rig, depth);
    rig_begin(rig);
    for (int d = 0; d < DRAWS; d++) {
        use_layer(rig, &layers[d]);
        rig_draw(rig, layers[d].vertices, 3 * TRIANGLES);
    }
    rig_end(rig);
    picture->shaded = rig->stats.fragments_shaded;
    keep(rig, picture);
}

// A pass for every triangle: nothing can be put off.
static void draw_one_by_one_over(struct rig *rig, const struct layer layers[DRAWS], const float *depth,
                                 struct picture *picture)
{
    start(rig, depth);
    picture->shaded = 0;
    for (int i = 0; i < DRAWS * TRIANGLES; i++) {
        use_layer(rig, &layers[i / TRIANGLES]);
        rig_draw_once(rig, &layers[i / TRIANGLES].vertices[3 * (i % TRIANGLES)], 3);
        picture->shaded += rig->stats.fragments_shaded;
        rig->pass.colors[0].load = rig->pass.depth.load = RHW_LOAD_LOAD;
    }
    keep(rig, picture);
}

static void draw_together(struct rig *rig, const struct layer layers[DRAWS], struct picture *picture)
{
    draw_together_over(rig, layers, NULL, picture);
}

static void draw_one_by_one(struct rig *rig, const struct layer layers[DRAWS], struct picture *picture)
{
    draw_one_by_one_over(rig, layers, NULL, picture);
}

static void assert_equal_pictures(const struct picture *a, const struct picture *b)
{
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (memcmp(a->color[i], b->color[i], sizeof a->color[i]) != 0 ||
            memcmp(&a->depth[i], &b->depth[i], sizeof a->depth[i]) != 0) {
            fail_msg("pixel %d,%d: %g at depth %g, one by one %g at %g", i % SIZE, i / SIZE,
                     (double)a->color[i][0], (double)a->depth[i], (double)b->color[i][0],
                     (double)b->depth[i]);
        }
    }
}

static void open_rig(struct rig *rig, enum rhw_compare compare)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_depth(rig);
    rig->pipeline.depth_compare = compare;
    // A depth that layers have too: what was there before is not theirs.
    rig->pass.depth.clear = compare == RHW_COMPARE_LESS || compare == RHW_COMPARE_LESS_EQUAL ? 0.75f : 0.25f;
}

// Depth that memory keeps in steps is tested as stencil is.
static void use_depth_steps(struct rig *rig)
{
    const struct rhw_texture_def def = {.format = RHW_FORMAT_D24_UNORM, .width = SIZE, .height = SIZE};
    rhw_texture_destroy(rig->context, rig->pass.depth.texture);
    assert_int_equal(rhw_texture_create(rig->context, &def, &rig->pass.depth.texture), RHW_OK);
}

static void test_the_picture_of_one_by_one(void **state)
{
    (void)state;
    static const enum rhw_compare compares[] = {RHW_COMPARE_LESS, RHW_COMPARE_LESS_EQUAL, RHW_COMPARE_GREATER,
                                                RHW_COMPARE_GREATER_EQUAL};
    static struct picture together, alone;
    static struct layer layers[DRAWS];
    uint64_t random = 11;
    for (int i = 0; i < 2 * 4; i++) {
        struct rig rig;
        open_rig(&rig, compares[i / 2]);
        if (i % 2) {
            use_depth_steps(&rig);
        }
        for (int n = 0; n < 3; n++) {
            make_layers(&rig, &random, layers);
            draw_together(&rig, layers, &together);
            draw_one_by_one(&rig, layers, &alone);
            assert_equal_pictures(&together, &alone);
            assert_true(together.shaded < alone.shaded); // something was put off
        }
        rig_close(&rig);
    }
}

static void test_one_run_after_another(void **state)
{
    (void)state;
    static struct picture together, alone;
    static struct layer layers[DRAWS];
    uint64_t random = 13;
    struct rig rig;
    open_rig(&rig, RHW_COMPARE_LESS);
    make_layers(&rig, &random, layers);
    for (int d = 0; d < DRAWS / 2; d++) {
        layers[d].compare = RHW_COMPARE_LESS_EQUAL;
    }
    draw_together(&rig, layers, &together);
    draw_one_by_one(&rig, layers, &alone);
    assert_equal_pictures(&together, &alone);
    rig_close(&rig);
}

// Any comparison after any other: what lies behind a block now may lie before it later. A third of the pictures have
// runs of one of them, and a third runs as long as chunks, which are drawn depth first where they can be.
static void test_depth_that_moves_both_ways(void **state)
{
    (void)state;
    static struct picture together, alone;
    static struct layer layers[DRAWS];
    uint64_t random = 29;
    struct rig rig;
    open_rig(&rig, RHW_COMPARE_LESS);
    for (int n = 0; n < 9; n++) {
        const int run = n % 3 == 0 ? 1 : n % 3 == 1 ? 8 : DRAWS / 2;
        make_layers(&rig, &random, layers);
        for (int d = 0; d < DRAWS; d++) {
            layers[d].compare = d % run != 0
                                    ? layers[d - 1].compare
                                    : (enum rhw_compare)rig_random_int(&random, RHW_COMPARE_ALWAYS + 1);
            layers[d].writes = n % 3 == 2 || rig_random_int(&random, 3) != 0;
        }
        draw_together(&rig, layers, &together);
        draw_one_by_one(&rig, layers, &alone);
        assert_equal_pictures(&together, &alone);
    }
    rig_close(&rig);
}

// Depth that was there may be NaN, which passes no test and says nothing about what is around it.
static void test_depth_that_is_no_number(void **state)
{
    (void)state;
    static struct picture together, alone;
    static struct layer layers[DRAWS];
    static float depth[SIZE * SIZE];
    uint64_t random = 30;
    for (int n = 0; n < 4; n++) {
        struct rig rig;
        open_rig(&rig, n % 2 ? RHW_COMPARE_GREATER : RHW_COMPARE_LESS);
        const float near = n % 2 ? 0.8f : 0.2f;
        for (int i = 0; i < SIZE * SIZE; i++) {
            const int line = (n < 2 ? i % SIZE : i / SIZE) % 8;
            depth[i] = line == 6 ? NAN : line < 6 ? 1 - near : near;
        }
        make_layers(&rig, &random, layers);
        draw_together_over(&rig, layers, depth, &together);
        draw_one_by_one_over(&rig, layers, depth, &alone);
        assert_equal_pictures(&together, &alone);
        rig_close(&rig);
    }
}

// Without a depth test the last fragment wins; one that may be discarded keeps its turn.
static void test_the_last_wins_without_depth(void **state)
{
    (void)state;
    static struct picture together, alone;
    static struct layer layers[DRAWS];
    uint64_t random = 14;
    struct rig rig;
    open_rig(&rig, RHW_COMPARE_LESS);
    rig.pipeline.depth_test = false;
    for (int n = 0; n < 6; n++) {
        make_layers(&rig, &random, layers);
        for (int d = 0; d < DRAWS; d++) {
            const bool turn = n >= 3 && d >= 40; // in the second chunk
            layers[d].kind = turn ? KIND_MASKED : layers[d].kind == KIND_COORD ? KIND_COORD : KIND_PLAIN;
        }
        draw_together(&rig, layers, &together);
        draw_one_by_one(&rig, layers, &alone);
        assert_equal_pictures(&together, &alone);
        assert_true(together.shaded < alone.shaded);
    }
    rig_close(&rig);
}

// A triangle over the whole target.
static void cover(const struct rig *rig, float depth, float value, struct rig_vertex vertices[3])
{
    const float corners[3][2] = {{-SIZE, -SIZE}, {3 * SIZE, -SIZE}, {-SIZE, 3 * SIZE}};
    for (int i = 0; i < 3; i++) {
        vertices[i] = (struct rig_vertex){.value = {value, value, value, 1}};
        rig_place(rig, corners[i][0], corners[i][1], depth, 1, vertices[i].position);
    }
}

// The last draw of a run with a depth test may discard, so its fragments wait for their test when the next run begins,
// which has none. Small: few fragments, which wait.
static void assert_next_run_covers(enum rhw_compare compare)
{
    struct rig rig;
    open_rig(&rig, compare);
    static struct layer layers[DRAWS];
    for (int d = 0; d < DRAWS; d++) {
        const bool second = d >= DRAWS / 2;
        layers[d].kind = KIND_PLAIN;
        layers[d].tests = !second;
        layers[d].writes = true;
        layers[d].compare = compare;
        for (int i = 0; i < TRIANGLES; i++) {
            const float near = (float)(d * TRIANGLES + i) / (2 * DRAWS * TRIANGLES);
            cover(&rig, compare == RHW_COMPARE_LESS ? 0.75f - near : 0.25f + near, second ? 2 : 1,
                  &layers[d].vertices[3 * i]);
        }
    }
    struct layer *const last = &layers[DRAWS / 2 - 1];
    last->kind = KIND_MASKED;
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        const float at[3][2] = {{8, 8}, {12, 8}, {8, 12}};
        const float depth = compare == RHW_COMPARE_LESS ? 0.1f : 0.9f;
        rig_place(&rig, at[i % 3][0], at[i % 3][1], depth, 1, last->vertices[i].position);
    }
    static struct picture together;
    draw_together(&rig, layers, &together);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(together.color[i][0] == 2);
    }
    rig_close(&rig);
}

static void test_a_run_without_depth_after_one_that_waits(void **state)
{
    (void)state;
    assert_next_run_covers(RHW_COMPARE_LESS);
    assert_next_run_covers(RHW_COMPARE_GREATER);
}

// Runs of every kind, one after the other, over what was there.
static void test_runs_of_every_kind(void **state)
{
    (void)state;
    static const enum rhw_compare kinds[] = {RHW_COMPARE_LESS, RHW_COMPARE_LESS_EQUAL, RHW_COMPARE_GREATER,
                                             RHW_COMPARE_GREATER_EQUAL, RHW_COMPARE_ALWAYS};
    static struct picture together, alone;
    static struct layer layers[DRAWS];
    uint64_t random = 15;
    for (int first = 0; first < 5; first++) {
        for (int second = 0; second < 5; second++) {
            struct rig rig;
            open_rig(&rig, kinds[first]);
            make_layers(&rig, &random, layers);
            for (int d = 0; d < DRAWS; d++) {
                layers[d].compare = kinds[d < DRAWS / 2 ? first : second];
                layers[d].tests = layers[d].compare != RHW_COMPARE_ALWAYS; // which stands for no test here
                if (!layers[d].tests && layers[d].kind >= KIND_MASKED) {
                    layers[d].kind = KIND_PLAIN;
                }
            }
            draw_together(&rig, layers, &together);
            draw_one_by_one(&rig, layers, &alone);
            assert_equal_pictures(&together, &alone);
            rig_close(&rig);
        }
    }
}

// A draw that blends, keeps some channels or does not write depth has its turn between the others.
static void test_others_keep_their_turn(void **state)
{
    (void)state;
    static struct picture together, alone;
    static struct layer layers[DRAWS];
    uint64_t random = 12;
    struct rig rig;
    open_rig(&rig, RHW_COMPARE_LESS);
    for (int n = 0; n < 3; n++) {
        rig.pipeline.targets[0].blend = n == 0;
        rig.pipeline.targets[0].color =
            (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
        rig.pipeline.targets[0].write_mask = n == 1 ? 5 : 15;
        rig.pipeline.depth_read_only = n == 2;
        make_layers(&rig, &random, layers);
        draw_together(&rig, layers, &together);
        draw_one_by_one(&rig, layers, &alone);
        assert_equal_pictures(&together, &alone);
        assert_int_equal(together.shaded, alone.shaded);
    }
    rig_close(&rig);
}

enum { LAYERS = 16 };

// Layers from far to near that cover everything, on a target that ends within tiles, perhaps beside one that is left out:
// so many are shaded.
static void assert_shaded(bool depth, bool leaves_out, enum rhw_paths paths, int layers)
{
    enum { WIDTH = 100, HEIGHT = 70 };
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    def.paths = paths;
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &def);
    if (depth) {
        rig_set_depth(&rig);
    }
    if (leaves_out) {
        rig.pass.color_count = rig.pipeline.target_count = 2;
        rig.pipeline.targets[1].format = RHW_FORMAT_NONE;
    }
    rig_begin(&rig);
    for (int i = 0; i < LAYERS; i++) {
        struct rig_vertex all[6];
        rig_cover(&rig, 1 - (float)(i + 1) / (2 * LAYERS), (const float[4]){(float)i, 0, 0, 1}, all);
        rig_draw(&rig, all, 6);
    }
    rig_end(&rig);
    const float(*const seen)[4] = rig_read_float4(&rig);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(seen[i][0] == LAYERS - 1);
    }
    assert_int_equal(rig.stats.fragments_shaded, layers * WIDTH * HEIGHT);
    rig_close(&rig);
}

static void test_what_is_hidden_is_not_shaded(void **state)
{
    (void)state;
    for (int leaves_out = 0; leaves_out < 2; leaves_out++) {
        assert_shaded(true, leaves_out, RHW_PATHS_ALL, 1);
        assert_shaded(false, leaves_out, RHW_PATHS_ALL, 1);
    }
}

static void test_unless_the_context_wants_it(void **state)
{
    (void)state;
    for (int depth = 0; depth < 2; depth++) {
        assert_shaded(depth, false, RHW_PATHS_IN_ORDER, LAYERS);
        assert_shaded(depth, false, RHW_PATHS_GENERAL, LAYERS);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_the_picture_of_one_by_one),
    cmocka_unit_test(test_one_run_after_another),
    cmocka_unit_test(test_depth_that_moves_both_ways),
    cmocka_unit_test(test_depth_that_is_no_number),
    cmocka_unit_test(test_the_last_wins_without_depth),
    cmocka_unit_test(test_a_run_without_depth_after_one_that_waits),
    cmocka_unit_test(test_runs_of_every_kind),
    cmocka_unit_test(test_others_keep_their_turn),
    cmocka_unit_test(test_what_is_hidden_is_not_shaded),
    cmocka_unit_test(test_unless_the_context_wants_it),
};

const struct unit_tests test_hidden_surface = UNIT_TESTS(tests, NULL, NULL);
