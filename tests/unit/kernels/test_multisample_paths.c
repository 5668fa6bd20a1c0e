// SPDX-License-Identifier: MIT
// Multisampling: the special paths give the bytes of the general one, whatever a draw asks for and wherever its samples go.
#include "sample_rig.h"

enum { INPUTS = 6 };

enum { CROWD = 600 }; // vertices

// Slanted triangles in perspective, large, small and clipped, drawn by the special paths and by the general one.
static void make_crowd(const struct rig *rig, struct rig_vertex vertices[CROWD])
{
    uint64_t random = 31;
    float corner[2] = {0, 0};
    for (int v = 0; v < CROWD; v++) {
        const float size = v < 60 ? 120 : v < 300 ? 12 : 2;
        const float w = rig_random_float(&random, v < 60 ? -0.2f : 0.5f, 4);
        float at[2];
        for (int c = 0; c < 2; c++) {
            corner[c] = v % 3 == 0 ? rig_random_float(&random, 0, SIZE) : corner[c];
            at[c] = v % 3 == 0 ? corner[c] : corner[c] + rig_random_float(&random, -size, size);
        }
        rig_place(rig, at[0], at[1], rig_random_float(&random, 0, 1), w, vertices[v].position);
        for (int c = 0; c < 4; c++) {
            vertices[v].value[c] = rig_random_float(&random, 0, 1);
        }
    }
}

static void draw_crowd(struct rig *rig)
{
    struct rig_vertex vertices[CROWD];
    make_crowd(rig, vertices);
    rig_draw_once(rig, vertices, CROWD);
}

static void test_paths_agree(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        uint64_t hash[2] = {0, 0};
        for (int general = 0; general < 2; general++) {
            struct rig rig;
            open_samples(&rig, counts[i], general ? RHW_PATHS_GENERAL : RHW_PATHS_ALL);
            draw_crowd(&rig);
            for (int s = 0; s < counts[i]; s++) {
                hash[general] = rig_hash_bytes(hash[general], read_color(&rig, s), PIXELS * 16);
                hash[general] = rig_hash_bytes(hash[general], read_depth(&rig, s), PIXELS * 4);
            }
            rig_close(&rig);
        }
        assert_true(hash[0] == hash[1]);
    }
}

static void coord_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].coord[c] + groups[g].varying[c];
        }
    }
}

static void input_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_float facing = rhw_select(f->front_facing, rhw_splat(1), rhw_splat(0));
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = f->coord[c] + f->varying[c] + f->ddx[c] * f->ddy[c];
        }
        for (int c = 0; c < 3; c++) {
            groups[g].color[0][c] += f->barycentric[c] - f->barycentric_noperspective[c] * facing;
            groups[g].color[0][c] += f->barycentric_ddx[c] + f->barycentric_ddy[c];
        }
        groups[g].color[0][3] += rhw_float_from_int(f->primitive);
    }
}

// Half of what is there, and coordinates.
static void read_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] =
                groups[g].color[0][c] * 0.5f + groups[g].coord[c] * 0x1p-8f + groups[g].varying[c];
        }
    }
}

static uint64_t hash_of_inputs(int samples, int inputs, enum rhw_paths paths)
{
    const uint32_t every =
        RHW_USE_COORD | RHW_USE_FACING | RHW_USE_IDS | RHW_USE_BARYCENTRIC | RHW_USE_BARYCENTRIC_DERIVATIVES;
    const struct {
        rhw_fragment_function *fragment;
        uint32_t uses;
        enum rhw_qualifier qualifier;
        bool derivatives;
        enum rhw_sampling sampling;
    } asked[INPUTS] = {
        {coord_fragment, RHW_USE_COORD, RHW_SMOOTH, false, RHW_SAMPLING_CENTER},
        {input_fragment, every, RHW_SMOOTH, true, RHW_SAMPLING_CENTER},
        {input_fragment, every, RHW_NOPERSPECTIVE, true, RHW_SAMPLING_CENTER},
        {coord_fragment, RHW_USE_COORD, RHW_SMOOTH, true, RHW_SAMPLING_SAMPLE},
        {coord_fragment, RHW_USE_COORD, RHW_NOPERSPECTIVE, false, RHW_SAMPLING_SAMPLE},
        {read_fragment, RHW_USE_COORD | RHW_USE_COLOR_INPUT, RHW_SMOOTH, false, RHW_SAMPLING_CENTER}};
    struct rig rig;
    open_samples(&rig, samples, paths);
    rig_set_program(&rig, rig_vertex_pass, asked[inputs].fragment);
    rig.pipeline.program.uses = asked[inputs].uses;
    rig.pipeline.program.varyings[0].qualifier = asked[inputs].qualifier;
    rig.pipeline.program.varyings[0].derivatives = asked[inputs].derivatives;
    rig.pipeline.program.varyings[0].sampling = asked[inputs].sampling;
    draw_crowd(&rig);
    uint64_t hash = 0;
    for (int s = 0; s < samples; s++) {
        hash = rig_hash_bytes(hash, read_color(&rig, s), PIXELS * 16);
    }
    rig_close(&rig);
    return hash;
}

static void test_paths_agree_on_inputs(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        for (int inputs = 0; inputs < INPUTS; inputs++) {
            assert_true(hash_of_inputs(counts[i], inputs, RHW_PATHS_ALL) ==
                        hash_of_inputs(counts[i], inputs, RHW_PATHS_GENERAL));
        }
    }
}

// The sample and where it lies, with some pixels left out.
static void sample_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        for (int c = 0; c < 4; c++) {
            f->color[0][c] = f->varying[c] + f->sample_position[c % 2] + rhw_float_from_int(f->sample_id);
        }
        f->mask &= rhw_less(f->varying[0], rhw_splat(0.6f));
    }
}

// Shades each sample of tiles that triangles cover all over: the first and the last lie on a floor, with depth and 1/W
// level along a row, the others anywhere. The last ones are blended if `blend` is true.
static uint64_t hash_of_whole_tiles(int samples, int inputs, bool blend, enum rhw_paths paths)
{
    const struct {
        rhw_fragment_function *fragment;
        uint32_t uses;
        enum rhw_qualifier qualifier;
        bool derivatives;
    } asked[INPUTS] = {{rig_fragment_pass, 0, RHW_SMOOTH, false},
                       {coord_fragment, RHW_USE_COORD, RHW_SMOOTH, false},
                       {coord_fragment, RHW_USE_COORD, RHW_SMOOTH, true},
                       {coord_fragment, RHW_USE_COORD, RHW_NOPERSPECTIVE, true},
                       {read_fragment, RHW_USE_COORD | RHW_USE_COLOR_INPUT, RHW_SMOOTH, false},
                       {sample_fragment, RHW_USE_SAMPLE | RHW_USE_DISCARD, RHW_SMOOTH, false}};
    static const float corners[4][3][3] = {{{-300, -100, 1}, {900, -100, 1}, {100, 1500, 7}},
                                           {{-300, -100, 1}, {900, -120, 4}, {100, 1500, 7}},
                                           {{-300, -100, 3}, {900, -120, 3}, {100, 1500, 3}},
                                           {{100, -900, 5}, {-400, 370, 1.3f}, {700, 370, 1.3f}}};
    struct rig rig;
    open_samples(&rig, samples, paths);
    rig_set_program(&rig, rig_vertex_pass, asked[inputs].fragment);
    rig.pipeline.program.uses = asked[inputs].uses;
    rig.pipeline.program.varyings[0].qualifier = asked[inputs].qualifier;
    rig.pipeline.program.varyings[0].derivatives = asked[inputs].derivatives;
    rig.pipeline.program.varyings[0].sampling = RHW_SAMPLING_SAMPLE;
    rig.pipeline.depth_test = false;
    rig_begin(&rig);
    for (int n = 0; n < 4; n++) {
        struct rig_vertex vertices[3];
        for (int k = 0; k < 3; k++) {
            const float *const at = corners[n][k];
            rig_place(&rig, at[0], at[1], 0.5f + 0.0002f * at[1], at[2], vertices[k].position);
            for (int c = 0; c < 4; c++) {
                vertices[k].value[c] = (float)((7 * k + 3 * c + n) % 5) * 0.25f;
            }
        }
        rig.pipeline.targets[0].blend = blend && n >= 2;
        rig.pipeline.targets[0].color.dst = RHW_BLEND_ONE;
        rig_draw(&rig, vertices, 3);
    }
    rig_end(&rig);
    uint64_t hash = 0;
    for (int s = 0; s < samples; s++) {
        hash = rig_hash_bytes(hash, read_color(&rig, s), PIXELS * 16);
    }
    rig_close(&rig);
    return hash;
}

static void test_paths_agree_on_whole_tiles(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        for (int inputs = 0; inputs < 2 * INPUTS; inputs++) {
            const bool blend = inputs >= INPUTS;
            assert_true(hash_of_whole_tiles(counts[i], inputs % INPUTS, blend, RHW_PATHS_ALL) ==
                        hash_of_whole_tiles(counts[i], inputs % INPUTS, blend, RHW_PATHS_GENERAL));
        }
    }
}

struct way_of_writing {
    enum rhw_format format;
    uint8_t write_mask;
    enum rhw_logic logic;
};

// Of every way in which the texels of scattered groups are put in their places.
static uint64_t hash_of_writing(const struct way_of_writing *way, int samples, enum rhw_paths paths)
{
    const enum rhw_format format = way->format;
    static unsigned char pixels[PIXELS * 16];
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_depth(&rig);
    rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
    rhw_texture_destroy(rig.context, rig.pass.depth.texture);
    const struct rhw_texture_def def = {.format = format, .width = SIZE, .height = SIZE, .samples = samples};
    assert_int_equal(rhw_texture_create(rig.context, &def, &rig.pass.colors[0].texture), RHW_OK);
    rig.pass.depth.texture = make_texture(&rig, RHW_FORMAT_D32_FLOAT, samples);
    rig.pipeline.targets[0].format = format;
    rig.pipeline.targets[0].write_mask = way->write_mask;
    rig.pipeline.logic = way->logic;
    draw_crowd(&rig);
    uint64_t hash = 0;
    for (int s = 0; s < samples; s++) {
        assert_int_equal(rhw_texture_read_sample(rig.context, rig.pass.colors[0].texture, s, pixels, 0),
                         RHW_OK);
        hash = rig_hash_bytes(hash, pixels, PIXELS * rhw_format_size(format));
    }
    rig_close(&rig);
    return hash;
}

static void test_paths_agree_on_formats(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {
        RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB,   RHW_FORMAT_R32_UINT,    RHW_FORMAT_R32_FLOAT,
        RHW_FORMAT_R8_UNORM,    RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_RGBA32_FLOAT};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        for (int samples = 1; samples <= 4; samples *= 4) {
            for (uint8_t write_mask = 0; write_mask <= 5; write_mask += 5) { // 0: all
                const struct way_of_writing way = {formats[i], write_mask, RHW_LOGIC_OFF};
                assert_true(hash_of_writing(&way, samples, RHW_PATHS_ALL) ==
                            hash_of_writing(&way, samples, RHW_PATHS_GENERAL));
            }
        }
    }
}

// Each fragment reads what the one before left in its pixel, so that no group may have two of the same.
static void test_paths_agree_on_logic(void **state)
{
    (void)state;
    const struct way_of_writing way = {RHW_FORMAT_R32_UINT, 0, RHW_LOGIC_XOR};
    for (int samples = 1; samples <= 4; samples *= 4) {
        assert_true(hash_of_writing(&way, samples, RHW_PATHS_ALL) ==
                    hash_of_writing(&way, samples, RHW_PATHS_GENERAL));
    }
}

static void add_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].color[0][c] * rhw_splat(0.5f) + groups[g].varying[c];
        }
    }
}

static void flat_color_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(0.25f * (float)c + 0.1f);
        }
    }
}

static void empty_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].position, groups[g].attribute[0], 4 * sizeof(rhw_float));
    }
}

// How the second half of a crowd comes into the target.
enum way { WAY_REPLACE, WAY_OVER, WAY_SUM, WAY_MASKED, WAY_INPUT, WAY_CONSTANT, WAY_CONSTANT_SUM, WAYS };

static void set_way(struct rig *rig, enum way way)
{
    struct rhw_color_target *const target = &rig->pipeline.targets[0];
    target->blend = way == WAY_OVER || way == WAY_SUM || way == WAY_CONSTANT_SUM;
    if (way == WAY_OVER) {
        target->color = target->alpha =
            (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    } else if (target->blend) {
        target->color = target->alpha =
            (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    }
    target->write_mask = way == WAY_MASKED ? RHW_WRITE_RED | RHW_WRITE_BLUE : 0;
    if (way == WAY_INPUT) {
        rig_set_program(rig, rig_vertex_pass, add_fragment);
        rig->pipeline.program.uses = RHW_USE_COLOR_INPUT;
    } else if (way >= WAY_CONSTANT) {
        rig_set_program(rig, empty_vertex, flat_color_fragment);
        memset(rig->pipeline.program.varyings, 0, sizeof rig->pipeline.program.varyings);
        rig->pipeline.program.varying_count = 0;
    }
}

// Of samples that live in tiles alone and are resolved there.
static uint64_t hash_of_resolved(enum rhw_format format, enum way way, int samples, enum rhw_paths paths)
{
    struct rig rig;
    struct rig_vertex vertices[CROWD];
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_depth(&rig);
    rig.pass.depth.store = RHW_STORE_DISCARD;
    rig_set_target(&rig, 0, format);
    rig.pass.samples = samples;
    make_crowd(&rig, vertices);
    rig_begin(&rig);
    rig_draw(&rig, vertices, CROWD);
    set_way(&rig, way);
    rig.pipeline.depth_compare = RHW_COMPARE_GREATER;
    rig_draw(&rig, vertices, CROWD);
    rig_end(&rig);
    const uint64_t hash = rig_hash(&rig, 0);
    rig_close(&rig);
    return hash;
}

static void test_paths_agree_on_resolved(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {
        RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_R32_FLOAT,   RHW_FORMAT_RGBA16_FLOAT,
        RHW_FORMAT_R8_UNORM,    RHW_FORMAT_RG8_UNORM,  RHW_FORMAT_RGBA32_FLOAT};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        for (int way = 0; way < WAYS; way++) {
            for (int samples = 2; samples <= 4; samples *= 2) {
                assert_true(hash_of_resolved(formats[i], (enum way)way, samples, RHW_PATHS_ALL) ==
                            hash_of_resolved(formats[i], (enum way)way, samples, RHW_PATHS_GENERAL));
            }
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_paths_agree),
    cmocka_unit_test(test_paths_agree_on_inputs),
    cmocka_unit_test(test_paths_agree_on_whole_tiles),
    cmocka_unit_test(test_paths_agree_on_formats),
    cmocka_unit_test(test_paths_agree_on_logic),
    cmocka_unit_test(test_paths_agree_on_resolved),
};

const struct unit_tests test_multisample_paths = UNIT_TESTS(tests, NULL, NULL);
