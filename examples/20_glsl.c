// SPDX-License-Identifier: MIT
// Lesson 20: shaders in GLSL. Two texts, knot.vert and knot.frag, draw a knot of marble, of wood and of embers.
//
// The texts are compiled when the lesson is: rhw_add_glsl of the CMake package has glslangValidator make SPIR-V of them,
// and the words are arrays in a header. When it runs, librhw-shader translates the words. No compiler is needed there,
// and a module may as well come from a file or over a network: one that is wrong is refused with a line that says where.
//
//     rhw_shader_create             words of a stage, with values for its constants: here which stuff the knot is of
//     rhw_shader_program_create     a vertex and a fragment shader that fit together
//     rhw_shader_program_get        what a pipeline takes in place of functions
//
// What the shaders read lies in sets of bindings, arrays that belong to the program. A frame points to them, and is the
// uniforms of the draw.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/bind.h>
#include <rhw/rhw.h>
#include <rhw/spirv.h>

#include "knot_frag.h"
#include "knot_vert.h"
#include "picture.h"
#include "solid.h"

enum { SIZE = 400, STUFFS = 3, VERTICES = 320 * 24 * 6, SAMPLES = 4 };

// What both texts call Scene, as std140 lays it out.
struct scene {
    float to_clip[16], eye[4], sun[4];
};

static void fill_scene(struct scene *scene)
{
    *scene = (struct scene){.eye = {0, 3.1f, 3.6f}, .sun = {-0.48f, 0.72f, 0.5f}};
    solid_camera(scene->eye, (const float[3]){0, -0.1f, 0.06f}, 2.55f, scene->to_clip);
}

// Translate an entry point, or end with the line that says what is wrong.
static rhw_shader *make_shader(const void *words, size_t size, enum rhw_shader_stage stage, int stuff)
{
    const struct rhw_shader_constant constant = {.id = 0, .value = (uint32_t)stuff};
    const struct rhw_shader_def def = {.stage = stage, .constants = &constant, .constant_count = 1};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    must(rhw_shader_create(words, size, &def, &shader, message), message);
    return shader;
}

static rhw_shader_program *make_program(int stuff)
{
    rhw_shader *const vertex = make_shader(knot_vert, sizeof knot_vert, RHW_SHADER_VERTEX, stuff),
                      *const fragment = make_shader(knot_frag, sizeof knot_frag, RHW_SHADER_FRAGMENT, stuff);
    char message[RHW_SHADER_MESSAGE];
    rhw_shader_program *program;
    must(rhw_shader_program_create(&(struct rhw_shader_program_def){.vertex = vertex, .fragment = fragment},
                                   &program, message),
         message);
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
    return program;
}

// Draw a knot with a program that asks for `uniforms`.
static void draw(rhw_context *context, rhw_texture target, const struct rhw_program *program,
                 const void *uniforms, size_t size)
{
    struct rhw_pipeline_def def = {
        .program = *program, .depth_test = true, .target_count = 1, .label = "lesson 20"};
    def.targets[0].format = rhw_texture_format(context, target);
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    const struct rhw_pass_def attachments = {
        .colors = {{.texture = target, .clear = {0.012f, 0.014f, 0.018f, 1}}},
        .color_count = 1,
        .samples = SAMPLES,
        .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
        .label = "knot"};
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_uniforms(context, pass, uniforms, size);
    rhw_pass_draw(context, pass, 0, VERTICES, 0, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_pipeline_destroy(context, pipeline);
}

static void draw_glsl(rhw_context *context, rhw_texture target, int stuff)
{
    struct scene scene;
    fill_scene(&scene);
    struct rhw_binding set[1];
    rhw_binding_of_memory(&scene, sizeof scene, true, &set[0]);
    const struct rhw_shader_frame frame = {.sets = {set}};
    rhw_shader_program *const program = make_program(stuff);
    draw(context, target, rhw_shader_program_get(program), &frame, sizeof frame);
    rhw_shader_program_destroy(program);
}

// Print what a shader says of itself.
static void print_interface(const void *words, size_t size, enum rhw_shader_stage stage)
{
    rhw_shader *const shader = make_shader(words, size, stage, 0);
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    printf("%s shader\n", stage == RHW_SHADER_VERTEX ? "vertex" : "fragment");
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const resource = &info->resources[i];
        printf("  set %u, binding %u: %s, %u bytes\n", (unsigned)resource->set, (unsigned)resource->binding,
               resource->name, (unsigned)resource->size);
    }
    for (uint32_t i = 0; i < info->input_count; i++) {
        printf("  in, location %u: %s, %u components\n", (unsigned)info->inputs[i].location,
               info->inputs[i].name, (unsigned)info->inputs[i].components);
    }
    for (uint32_t i = 0; i < info->output_count; i++) {
        printf("  out, location %u: %s, %u components\n", (unsigned)info->outputs[i].location,
               info->outputs[i].name, (unsigned)info->outputs[i].components);
    }
    rhw_shader_destroy(shader);
}

int main(int argc, char **argv)
{
    static uint8_t picture[SIZE][STUFFS * SIZE][4];
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE, SIZE, 1);
    for (int stuff = 0; stuff < STUFFS; stuff++) {
        draw_glsl(context, target, stuff);
        uint8_t *const pixels = picture_read(context, target, 0);
        for (int y = 0; y < SIZE; y++) {
            memcpy(picture[y][stuff * SIZE], pixels + (size_t)y * SIZE * 4, SIZE * 4);
        }
        free(pixels);
    }
    picture_write_png(directory, "20_glsl.png", STUFFS * SIZE, SIZE, picture[0][0]);
    print_interface(knot_vert, sizeof knot_vert, RHW_SHADER_VERTEX);
    print_interface(knot_frag, sizeof knot_frag, RHW_SHADER_FRAGMENT);
    rhw_context_destroy(context);
    return 0;
}
