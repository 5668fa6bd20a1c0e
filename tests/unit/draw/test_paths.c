// SPDX-License-Identifier: MIT
// Every path draws the bytes of the general one: passes of random draws, whose states change from one to the next, with
// triangles of all sizes, rectangles among them that cover whole blocks, some cut by planes.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 150, HEIGHT = 137, PASSES = 480, DRAWS_MOST = 10, WAVE_DRAWS = 50, TRIANGLES_MOST = 12 };

// Everything a pass is made of follows from this.
struct recipe {
    uint64_t seed;
    bool has_depth;
    bool in_waves; // of a chunk each
    int draws;
};

static void plain(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
}

static void discarding(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        const rhw_int digit = __builtin_convertvector(groups[g].varying[0] * 8.0f, rhw_int);
        groups[g].mask &= (digit & 1) == 0;
    }
}

static void deepening(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].depth = 0.5f * groups[g].depth + 0.25f;
    }
}

static void identified(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][1] = rhw_float_from_int(groups[g].front_facing);
        groups[g].color[0][2] = rhw_float_from_int(groups[g].primitive + 100 * groups[g].draw);
    }
}

static void located(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].coord[0] + groups[g].coord[3];
        groups[g].color[0][1] = groups[g].barycentric[1];
        groups[g].color[0][2] = groups[g].barycentric_noperspective[2];
        groups[g].color[0][3] = groups[g].coord[2];
    }
}

static void derived(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].color[0][1] = groups[g].ddx[1];
        groups[g].color[0][2] = groups[g].ddy[2];
    }
}

static void constant(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(0.25f * (float)c);
        }
    }
}

static void position_alone(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].position, groups[g].attribute[0], sizeof groups[g].position);
    }
}

static const struct {
    rhw_fragment_function *fragment;
    uint32_t uses;
} shaders[] = {
    {plain, 0},
    {plain, 0},
    {discarding, RHW_USE_DISCARD},
    {deepening, RHW_USE_DEPTH},
    {identified, RHW_USE_FACING | RHW_USE_IDS},
    {located, RHW_USE_COORD | RHW_USE_BARYCENTRIC},
    {derived, 0},
    {constant, 0},
    {NULL, 0},
};

enum { SHADERS = (int)(sizeof shaders / sizeof shaders[0]) };

static void choose_program(struct rig *rig, uint64_t *seed)
{
    struct rhw_program *const program = &rig->pipeline.program;
    const int shader = rig_random_int(seed, SHADERS);
    const bool is_constant = shaders[shader].fragment == constant;
    rig_set_program(rig, is_constant ? position_alone : rig_vertex_pass, shaders[shader].fragment);
    program->uses = shaders[shader].uses;
    // Smooth ones more often than not: they have most paths.
    const int qualifier = rig_random_int(seed, 6);
    const struct rhw_varying varying = {.components = 4,
                                        .qualifier =
                                            qualifier < 3 ? (enum rhw_qualifier)qualifier : RHW_SMOOTH,
                                        .derivatives = shaders[shader].fragment == derived};
    program->varying_count = is_constant ? 0 : 1;
    program->varyings[0] = is_constant ? (struct rhw_varying){0} : varying;
}

static void choose_state(struct rig *rig, const struct recipe *recipe, uint64_t *seed)
{
    struct rhw_color_target *const target = &rig->pipeline.targets[0];
    choose_program(rig, seed);
    rig->pipeline.depth_test = recipe->has_depth && rig_random_int(seed, 8) != 0;
    rig->pipeline.depth_read_only = rig_random_int(seed, 6) == 0;
    const int compare =
        rig_random_int(seed, 16); // LESS as a rule: what follows from it goes on over some draws
    rig->pipeline.depth_compare = compare < 8 ? (enum rhw_compare)compare : RHW_COMPARE_LESS;
    rig->pipeline.provoking = rig_random_int(seed, 2) == 0 ? RHW_PROVOKING_FIRST : RHW_PROVOKING_LAST;
    rig->pipeline.cull = (enum rhw_cull)(rig_random_int(seed, 6) == 0 ? 1 + rig_random_int(seed, 2) : 0);
    target->blend = rig_random_int(seed, 6) == 0;
    target->color = (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE, RHW_BLEND_ADD};
    const bool masked = rig_random_int(seed, 8) == 0;
    target->write_mask = rig->pipeline.program.fragment[0] == NULL ? RHW_WRITE_NONE : masked ? 5 : 15;
}

// A triangle anywhere, at most `size` pixels wide.
static void make_triangle(const struct rig *rig, uint64_t *seed, float size, struct rig_vertex *vertices)
{
    const float x = rig_random_float(seed, -20, WIDTH), y = rig_random_float(seed, -20, HEIGHT);
    const bool cut = rig_random_int(seed, 12) == 0, level = rig_random_int(seed, 3) == 0;
    const float depth = rig_random_float(seed, 0, 1);
    for (int i = 0; i < 3; i++) {
        const float w = level ? 1.0f : rig_random_float(seed, cut ? -0.5f : 0.25f, 2);
        rig_place(rig, x + rig_random_float(seed, 0, size), y + rig_random_float(seed, 0, size),
                  level ? depth : rig_random_float(seed, cut ? -0.5f : 0, 1), w, vertices[i].position);
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = rig_random_float(seed, -1, 1);
        }
    }
}

// A rectangle of whole pixels.
static void make_rectangle(const struct rig *rig, uint64_t *seed, int size, struct rig_vertex *vertices)
{
    const float x = (float)rig_random_int(seed, WIDTH), y = (float)rig_random_int(seed, HEIGHT);
    const float value[4] = {rig_random_float(seed, -1, 1), 0.5f, rig_random_float(seed, 0, 1), 1};
    rig_rectangle(rig, x, y, x + (float)(1 + rig_random_int(seed, size)),
                  y + (float)(1 + rig_random_int(seed, size)), rig_random_float(seed, 0, 1), value, vertices);
}

static void draw_some(struct rig *rig, uint64_t *seed)
{
    static const int sizes[] = {3, 12, 40, 63, 200};
    struct rig_vertex vertices[3 * TRIANGLES_MOST];
    const int triangles = 2 * (1 + rig_random_int(seed, TRIANGLES_MOST / 2));
    for (int t = 0; t < triangles; t += 2) {
        const int size = sizes[rig_random_int(seed, 5)];
        if (rig_random_int(seed, 2) == 0) {
            make_rectangle(rig, seed, size, &vertices[3 * t]);
        } else {
            make_triangle(rig, seed, (float)size, &vertices[3 * t]);
            make_triangle(rig, seed, (float)size, &vertices[3 * (t + 1)]);
        }
    }
    rig_draw(rig, vertices, 3 * triangles);
}

static void choose_area(struct rig *rig, uint64_t *seed)
{
    if (rig_random_int(seed, 6) == 0) {
        const struct rhw_rect scissor = {rig_random_int(seed, 40), rig_random_int(seed, 40),
                                         20 + rig_random_int(seed, WIDTH), 20 + rig_random_int(seed, HEIGHT)};
        rhw_pass_set_scissor(rig->context, rig->recording, &scissor);
    }
    if (rig_random_int(seed, 6) == 0) {
        const struct rhw_viewport viewport = {
            rig_random_float(seed, -30, 30), rig_random_float(seed, -30, 30), rig_random_float(seed, 50, 200),
            rig_random_float(seed, 50, 200), rig_random_float(seed, 0, 1),    rig_random_float(seed, 0, 1)};
        rhw_pass_set_viewport(rig->context, rig->recording, &viewport);
    }
}

static void draw_pass(struct rig *rig, const struct recipe *recipe)
{
    uint64_t seed = recipe->seed;
    rig_begin(rig);
    for (int d = 0; d < recipe->draws; d++) {
        if (d == 0 || rig_random_int(&seed, 3) != 0) {
            choose_state(rig, recipe, &seed);
        }
        choose_area(rig, &seed);
        draw_some(rig, &seed);
    }
    rig_end(rig);
}

// What a pass leaves on these paths: colour, then depth.
static void draw_on(enum rhw_paths paths, const struct recipe *recipe, float *result)
{
    struct rig rig;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.paths = paths;
    def.bin_memory = recipe->in_waves ? 1 : 0;
    rig_open_with(&rig, WIDTH, HEIGHT, &def);
    if (recipe->has_depth) {
        rig_set_depth(&rig);
    }
    draw_pass(&rig, recipe);
    memcpy(result, rig_read_float4(&rig), sizeof(float) * 4 * WIDTH * HEIGHT);
    if (recipe->has_depth) {
        memcpy(result + 4 * WIDTH * HEIGHT, rig_read_depth(&rig), sizeof(float) * WIDTH * HEIGHT);
    }
    rig_close(&rig);
}

static void test_every_path_draws_the_same_bytes(void **state)
{
    (void)state;
    enum { FLOATS = 5 * WIDTH * HEIGHT };
    float *const results[3] = {calloc(FLOATS, sizeof(float)), calloc(FLOATS, sizeof(float)),
                               calloc(FLOATS, sizeof(float))};
    uint64_t seed = 14;
    for (int i = 0; i < PASSES; i++) {
        const bool in_waves = i % 16 == 0;
        const struct recipe recipe = {.seed = rig_random(&seed),
                                      .has_depth = rig_random_int(&seed, 4) != 0,
                                      .in_waves = in_waves,
                                      .draws = in_waves ? WAVE_DRAWS : 1 + rig_random_int(&seed, DRAWS_MOST)};
        for (int paths = 0; paths < 3; paths++) {
            draw_on((enum rhw_paths)paths, &recipe, results[paths]);
        }
        for (int paths = 0; paths < 2; paths++) {
            for (int n = 0; n < FLOATS; n++) {
                if (memcmp(&results[paths][n], &results[2][n], sizeof(float)) != 0) {
                    const int pixel = n < 4 * WIDTH * HEIGHT ? n / 4 : n - 4 * WIDTH * HEIGHT;
                    fail_msg("pass %d, paths %d, %s of pixel %d,%d: %.9g, but %.9g", i, paths,
                             n < 4 * WIDTH * HEIGHT ? "colour" : "depth", pixel % WIDTH, pixel / WIDTH,
                             (double)results[paths][n], (double)results[2][n]);
                }
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        free(results[i]);
    }
}

// One colour, of which RGBA8 takes the texel: in blocks that the rectangle fills, and in the parts of others.
static void test_constant_texels(void **state)
{
    (void)state;
    static const unsigned char texel[4] = {0, 64, 128, 191};
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open(&rig, WIDTH, HEIGHT);
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_UNORM);
    rig_set_program(&rig, position_alone, constant);
    rig.pipeline.program.varying_count = 0;
    rig.pipeline.program.varyings[0] = (struct rhw_varying){0};
    rig_rectangle(&rig, 3, 5, 61, 60, 0.5f, (const float[4]){0}, vertices);
    rig_draw_once(&rig, vertices, 6);
    const unsigned char *const texels = rig_read(&rig, rig.pass.colors[0].texture);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const bool inside = x >= 3 && x < 61 && y >= 5 && y < 60;
        assert_memory_equal(texels + 4 * (size_t)i, inside ? texel : (const unsigned char[4]){0}, 4);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_every_path_draws_the_same_bytes),
    cmocka_unit_test(test_constant_texels),
};

const struct unit_tests test_paths = UNIT_TESTS(tests, NULL, NULL);
