// SPDX-License-Identifier: MIT
// Golden scenes of translated shaders: a textured sphere, the same in four targets with lights that read them, and sums
// in shared memory. glsl/ has the texts, and golden_words.inc their SPIR-V.
#include "golden_scenes.h"

#include <rhw/bind.h>
#include <rhw/spirv.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "golden_words.inc"

enum { WIDTH = 200, HEIGHT = 150, SPHERE = 6 * 36 * 18, LIGHTS = 12, GROUPS = 5, SUMS = 64 * GROUPS };

#define TRANSLATE(words, stage) translate(words, sizeof(words), stage)

// Ends the program where a shader or a program could not be made.
static void check(enum rhw_result result, const char *message)
{
    if (result != RHW_OK) {
        fprintf(stderr, "golden: %s\n", message);
        exit(1);
    }
}

static rhw_shader *translate(const uint32_t *words, size_t size, enum rhw_shader_stage stage)
{
    char message[RHW_SHADER_MESSAGE];
    const struct rhw_shader_def def = {.stage = stage};
    rhw_shader *shader;
    check(rhw_shader_create(words, size, &def, &shader, message), message);
    return shader;
}

// Links shaders, and destroys them.
static rhw_shader_program *link_stages(rhw_shader *vertex, rhw_shader *fragment, rhw_shader *compute)
{
    char message[RHW_SHADER_MESSAGE];
    const struct rhw_shader_program_def def = {.vertex = vertex, .fragment = fragment, .compute = compute};
    rhw_shader_program *program;
    check(rhw_shader_program_create(&def, &program, message), message);
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
    rhw_shader_destroy(compute);
    return program;
}

static void bind_memory(void *memory, size_t size, struct rhw_binding *binding)
{
    if (!rhw_binding_of_memory(memory, size, false, binding)) {
        fprintf(stderr, "golden: memory cannot be bound\n");
        exit(1);
    }
}

// Drawing --------------------------------------------------------------------------------------------

// A view of the sphere from a distance, 4:3.
static const float clip[16] = {1.65f, 0.3f,  0.1f,   0.1f,  0, 2.1f, -0.4f, -0.4f,
                               0.4f,  -0.8f, -0.95f, -0.9f, 0, 0,    2.3f,  2.5f};

static void draw(struct golden_board *board, const rhw_shader_program *program,
                 const struct rhw_shader_frame *frame, const enum rhw_format *formats, int count,
                 uint32_t vertices)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = *rhw_shader_program_get(program);
    def.depth_test = count > 1;
    for (int i = 0; i < count && formats[i] != RHW_FORMAT_D32_FLOAT; i++) {
        def.targets[i].format = formats[i];
        def.target_count = i + 1;
    }
    golden_board_begin(board);
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, &def));
    rhw_pass_set_uniforms(board->context, board->pass, frame, sizeof *frame);
    rhw_pass_draw(board->context, board->pass, 0, vertices, 0, 1);
    golden_board_end(board);
}

static rhw_texture make_checker(rhw_context *context)
{
    enum { SIDE = 32 };
    unsigned char texels[SIDE][SIDE][4];
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            const unsigned char on = (x / 8 + y / 8) % 2 ? 230 : 40;
            const unsigned char texel[4] = {on, (unsigned char)(8 * x), (unsigned char)(8 * y), 255};
            memcpy(texels[y][x], texel, sizeof texel);
        }
    }
    const rhw_texture texture = golden_texture(context, RHW_FORMAT_RGBA8_UNORM, SIDE, SIDE, 6);
    rhw_texture_write(context, texture, 0, texels, 0);
    golden_check(rhw_texture_generate_mips(context, texture), "mips");
    return texture;
}

static void draw_sphere(rhw_context *context, struct golden_images *images)
{
    static const enum rhw_format formats[] = {RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_D32_FLOAT};
    float scene[8] = {0.48f, 0.64f, -0.6f, 0, 0.4f, 0.9f, -2.5f, 1};
    rhw_shader_program *const program = link_stages(TRANSLATE(sphere_vert, RHW_SHADER_VERTEX),
                                                    TRANSLATE(lit_frag, RHW_SHADER_FRAGMENT), NULL);
    struct rhw_sampler_def state = rhw_sampler_def_default();
    rhw_sampler sampler;
    struct rhw_binding set[2];
    struct golden_board board;
    golden_check(rhw_sampler_create(context, &state, &sampler), "sampler");
    bind_memory(scene, sizeof scene, &set[0]);
    golden_check(rhw_binding_of_texture(context, make_checker(context), sampler, &set[1]), "binding");
    const struct rhw_shader_frame frame = {.sets = {set}, .push_constants = clip, .push_size = sizeof clip};
    golden_board_make(&board, context, WIDTH, HEIGHT, formats, 2);
    draw(&board, program, &frame, formats, 2, SPHERE);
    golden_board_keep(&board, images);
    rhw_shader_program_destroy(program);
}

static void draw_deferred(rhw_context *context, struct golden_images *images)
{
    static const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA16_FLOAT,
                                              RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_R32_UINT,
                                              RHW_FORMAT_D32_FLOAT};
    float lights[LIGHTS][2][4];
    uint64_t random = 3;
    for (int i = 0; i < LIGHTS; i++) {
        for (int c = 0; c < 3; c++) {
            lights[i][0][c] = golden_random(&random, -1.6f, 1.6f);
            lights[i][1][c] = golden_random(&random, 0.3f, 1.5f);
        }
        lights[i][0][3] = golden_random(&random, 0.1f, 0.3f);
        lights[i][1][3] = 0;
    }
    rhw_shader_program *const surface = link_stages(TRANSLATE(sphere_vert, RHW_SHADER_VERTEX),
                                                    TRANSLATE(surface_frag, RHW_SHADER_FRAGMENT), NULL);
    rhw_shader_program *const light = link_stages(TRANSLATE(cover_vert, RHW_SHADER_VERTEX),
                                                  TRANSLATE(lights_frag, RHW_SHADER_FRAGMENT), NULL);
    struct golden_board first, second;
    struct rhw_binding set[5];
    golden_board_make(&first, context, WIDTH, HEIGHT, formats, 5);
    memset(first.def.colors[1].clear, 0, sizeof first.def.colors[1].clear);
    draw(&first, surface, &(struct rhw_shader_frame){.push_constants = clip, .push_size = sizeof clip},
         formats, 5, SPHERE);
    for (int i = 0; i < 4; i++) {
        golden_check(rhw_binding_of_texture(context, first.targets[i], (rhw_sampler){0}, &set[i]), "binding");
    }
    bind_memory(lights, sizeof lights, &set[4]);
    golden_board_make(&second, context, WIDTH, HEIGHT, formats, 1);
    draw(&second, light, &(struct rhw_shader_frame){.sets = {set}}, formats, 1, 3);
    golden_board_keep(&first, images);
    golden_board_keep(&second, images);
    rhw_shader_program_destroy(surface);
    rhw_shader_program_destroy(light);
}

// Computing ------------------------------------------------------------------------------------------

static void *copy(const void *data, size_t size)
{
    void *const to = malloc(size);
    if (!to) {
        golden_check(RHW_ERROR_OUT_OF_MEMORY, "copy");
    }
    return memcpy(to, data, size);
}

static void add_up(rhw_context *context, struct golden_images *images)
{
    float values[SUMS];
    uint32_t counts[16] = {0};
    uint64_t random = 5;
    struct rhw_binding set[2];
    rhw_shader_program *const program = link_stages(NULL, NULL, TRANSLATE(sums_comp, RHW_SHADER_COMPUTE));
    for (int i = 0; i < SUMS; i++) {
        values[i] = golden_random(&random, -0.1f, 0.3f);
    }
    bind_memory(values, sizeof values, &set[0]);
    bind_memory(counts, sizeof counts, &set[1]);
    const struct rhw_shader_frame frame = {.sets = {set}};
    const struct rhw_dispatch_def def = {.program = *rhw_shader_program_get_compute(program),
                                         .uniforms = &frame,
                                         .uniform_bytes = sizeof frame};
    golden_check(rhw_dispatch(context, &def, GROUPS, 1, 1), "dispatch");
    golden_give(images, RHW_FORMAT_R32_FLOAT, 64, GROUPS, copy(values, sizeof values));
    golden_give(images, RHW_FORMAT_R32_UINT, 16, 1, copy(counts, sizeof counts));
    rhw_shader_program_destroy(program);
}

void golden_glsl_draw(rhw_context *context, int number, struct golden_images *images)
{
    static void (*const draws[])(rhw_context *, struct golden_images *) = {draw_sphere, draw_deferred,
                                                                           add_up};
    draws[number](context, images);
}
