// SPDX-License-Identifier: MIT
// See world.h.
#include "world.h"

#include <stdio.h>
#include <string.h>

// Return a float, which often is one that formulas seldom think of.
static float special_float(uint64_t *state)
{
    static const uint32_t bits[] = {0x7f800000, 0xff800000, 0x7fc00000, 0xffc00001, 0x00000001, 0x807fffff,
                                    0x00800000, 0x80000000, 0x7f7fffff, 0xcf000000, 0x4f800000, 0x3f7fffff};
    float number;
    memcpy(&number, &bits[rig_random_int(state, sizeof bits / sizeof *bits)], sizeof number);
    return rig_random_int(state, 2) ? number : rig_random_float(state, -16, 16);
}

void fill_world(struct world *world, int kind)
{
    uint64_t state = 1 + (uint64_t)kind;
    memset(world, 0, sizeof *world);
    for (int i = 0; i < 32; i++) {
        world->numbers[i / 4][i % 4] = kind > 0 ? special_float(&state) : rig_random_float(&state, -16, 16);
        world->wholes[i / 4][i % 4] = rig_random_int(&state, 30) - 5;
    }
    for (int i = 0; i < SOURCE; i++) {
        world->source[i] = (uint32_t)rig_random(&state);
    }
    for (int i = 0; i < OWN; i++) {
        world->own[i] = (uint32_t)rig_random_int(&state, 100);
    }
    memset(world->counters, 0x5a, sizeof world->counters);
}

static rhw_texture make_texture(rhw_context *context, int side, enum rhw_format format, int levels)
{
    rhw_texture texture;
    const struct rhw_texture_def def = {
        .width = side, .height = side, .format = format, .mip_levels = levels};
    assert_int_equal(rhw_texture_create(context, &def, &texture), RHW_OK);
    return texture;
}

// Make what is sampled: a picture of one level, whose sampler needs no gradient, one of all levels, and a shadow map,
// which is fetched as well.
static void make_pictures(struct stage *stage)
{
    static float texels[PICTURE * PICTURE][4];
    rhw_context *const context = stage->rig.context;
    const struct rhw_sampler_def sampler = rhw_sampler_def_default(),
                                 filtering = {.mip_filter = RHW_MIP_FILTER_LINEAR, .max_anisotropy = 4},
                                 comparing = {.compares = true, .compare = RHW_COMPARE_LESS_EQUAL};
    uint64_t state = 7;
    for (int i = 0; i < PICTURE * PICTURE * 4; i++) {
        texels[i / 4][i % 4] = rig_random_float(&state, 0, 1);
    }
    stage->picture = make_texture(context, PICTURE, RHW_FORMAT_RGBA32_FLOAT, 1);
    stage->levels = make_texture(context, PICTURE, RHW_FORMAT_RGBA32_FLOAT, 4);
    stage->shadow = make_texture(context, PICTURE, RHW_FORMAT_D32_FLOAT, 1);
    assert_int_equal(rhw_texture_write(context, stage->picture, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_texture_write(context, stage->levels, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_texture_generate_mips(context, stage->levels), RHW_OK);
    assert_int_equal(rhw_texture_write(context, stage->shadow, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_sampler_create(context, &sampler, &stage->sampler), RHW_OK);
    assert_int_equal(rhw_sampler_create(context, &filtering, &stage->filtering), RHW_OK);
    assert_int_equal(rhw_sampler_create(context, &comparing, &stage->comparing), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(context, stage->picture, stage->sampler, &stage->set[4]), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(context, stage->levels, stage->filtering, &stage->set[6]),
                     RHW_OK);
    assert_int_equal(rhw_binding_of_texture(context, stage->shadow, stage->comparing, &stage->set[7]),
                     RHW_OK);
    assert_int_equal(rhw_binding_of_texture(context, stage->shadow, stage->sampler, &stage->set[8]), RHW_OK);
    assert_non_null(rhw_binding_sample_plane(&stage->set[8]).texels);
    assert_false(rhw_binding_sample_needs_gradient(&stage->set[4], &stage->set[4]));
    assert_true(rhw_binding_sample_needs_gradient(&stage->set[6], &stage->set[6]));
}

void open_stage(struct stage *stage)
{
    const float scale = 1.75f;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1; // so that atomics come in one order
    rig_open_with(&stage->rig, SIDE, SIDE, &def);
    rhw_context *const context = stage->rig.context;
    make_pictures(stage);
    stage->canvas = make_texture(context, CANVAS, RHW_FORMAT_RGBA32_FLOAT, 1);
    assert_int_equal(rhw_binding_of_image(context, stage->canvas, 0, false, &stage->set[5]), RHW_OK);
    stage->push[0] = 3;
    memcpy(&stage->push[1], &scale, sizeof scale);
}

static void bind_world(struct stage *stage, struct world *world)
{
    assert_true(rhw_binding_of_memory(world->numbers, sizeof world->numbers + sizeof world->wholes, true,
                                      &stage->set[0]));
    assert_true(rhw_binding_of_memory(world->source, sizeof world->source, true, &stage->set[1]));
    assert_true(rhw_binding_of_memory(world->own, sizeof world->own, false, &stage->set[2]));
    assert_true(rhw_binding_of_memory(world->counters, sizeof world->counters, false, &stage->set[3]));
    assert_int_equal(rhw_texture_write(stage->rig.context, stage->canvas, 0, world->canvas, 0), RHW_OK);
}

// The frame of a program, whose set has the bindings that it uses, one behind the other.
static struct rhw_shader_frame frame_of(const struct stage *stage, const rhw_shader_program *program,
                                        struct rhw_binding set[BINDINGS])
{
    for (uint32_t b = 0; b < BINDINGS; b++) {
        const int place = rhw_shader_program_find(program, 0, b);
        if (place >= 0) {
            set[place] = stage->set[b];
        }
    }
    return (struct rhw_shader_frame){
        .sets = {set}, .push_constants = stage->push, .push_size = sizeof stage->push};
}

static void draw(struct stage *stage, const struct rhw_program *program, const struct rhw_shader_frame *frame,
                 struct world *world)
{
    static const struct rig_vertex vertices[4] = {{{-1, -1, 0.25f, 1}, {0, 0.5f, -1, 2}},
                                                  {{1.5f, -1, 0.5f, 1.5f}, {3, -0.5f, 1, 0}},
                                                  {{-1, 1, 0.75f, 1}, {-2, 1, 0.5f, 1}},
                                                  {{1, 1, 0.5f, 1}, {1, 0, 4, -3}}};
    struct rig *const rig = &stage->rig;
    rig->pipeline.program = *program;
    rig->pipeline.topology = RHW_TRIANGLE_STRIP;
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, sizeof vertices);
    rhw_pass_set_uniforms(rig->context, rig->recording, frame, sizeof *frame);
    rhw_pass_draw(rig->context, rig->recording, 0, 4, 0, 1);
    rig_end(rig);
    memcpy(world->color, rig_read_float4(rig), sizeof world->color);
}

void run_program(struct stage *stage, const struct rhw_program *drawn,
                 const struct rhw_compute_program *compute, const rhw_shader_program *linked,
                 struct world *world, int kind)
{
    struct rhw_binding set[BINDINGS];
    fill_world(world, kind);
    bind_world(stage, world);
    const struct rhw_shader_frame frame = frame_of(stage, linked, set);
    if (drawn) {
        draw(stage, drawn, &frame, world);
    } else {
        const struct rhw_dispatch_def def = {
            .program = *compute, .uniforms = &frame, .uniform_bytes = sizeof frame};
        assert_int_equal(rhw_dispatch(stage->rig.context, &def, WORKGROUPS, 1, 1), RHW_OK);
    }
    assert_int_equal(rhw_texture_read(stage->rig.context, stage->canvas, 0, world->canvas, 0), RHW_OK);
}

rhw_shader *create_shader(const char *name, const uint32_t *words, size_t size, enum rhw_shader_stage stage)
{
    const struct rhw_shader_def def = {.stage = stage};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    if (rhw_shader_create(words, size, &def, &shader, message) != RHW_OK) {
        fail_msg("%s: %s", name, message);
    }
    return shader;
}

bool worlds_differ(const char *name, const struct world *a, const struct world *b, const char *other)
{
    const uint32_t *const x = (const uint32_t *)(const void *)a, *const y = (const uint32_t *)(const void *)b;
    for (size_t i = 0; i < sizeof *a / sizeof *x; i++) {
        if (x[i] != y[i]) {
            const size_t own = offsetof(struct world, own) / 4,
                         counters = offsetof(struct world, counters) / 4;
            const size_t canvas = offsetof(struct world, canvas) / 4,
                         color = offsetof(struct world, color) / 4;
            const size_t at = i >= color ? color : i >= canvas ? canvas : i >= counters ? counters : own;
            fprintf(stderr, "%s: word %zu of %s: the interpreter has 0x%x, %s 0x%x\n", name, i - at,
                    at == color      ? "the picture"
                    : at == canvas   ? "the image"
                    : at == counters ? "the counters"
                                     : "the buffer",
                    (unsigned)x[i], other, (unsigned)y[i]);
            return true;
        }
    }
    return false;
}
