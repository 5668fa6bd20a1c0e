// SPDX-License-Identifier: MIT
// Draws with two shaders that are files of SPIR-V: glsl VERTEX.spv FRAGMENT.spv. Writes glsl.ppm, and prints its hash.
// Nothing is compiled here: what the files are is decided when the program runs.
#include <rhw/spirv.h>
#include <stdio.h>

#include "picture_hash.h"

enum { SIZE = 512 };

// Translate the shader in a file, or end the program with a line that says what is wrong.
static rhw_shader *read_shader(const char *path, enum rhw_shader_stage stage)
{
    static uint32_t words[1 << 16];
    FILE *const file = fopen(path, "rb");
    const size_t size = file ? fread(words, 1, sizeof words, file) : 0;
    char message[RHW_SHADER_MESSAGE] = "cannot be opened";
    rhw_shader *shader = NULL;
    if (file) {
        fclose(file);
        rhw_shader_create(words, size, &(struct rhw_shader_def){.stage = stage}, &shader, message);
    }
    if (!shader) {
        fprintf(stderr, "%s: %s\n", path, message);
        exit(1);
    }
    return shader;
}

static rhw_shader_program *link_shaders(const char *vertex_path, const char *fragment_path)
{
    const struct rhw_shader_program_def def = {.vertex = read_shader(vertex_path, RHW_SHADER_VERTEX),
                                               .fragment = read_shader(fragment_path, RHW_SHADER_FRAGMENT)};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader_program *program;
    if (rhw_shader_program_create(&def, &program, message) != RHW_OK) {
        fprintf(stderr, "%s and %s: %s\n", vertex_path, fragment_path, message);
        exit(1);
    }
    return program;
}

int main(int argc, char **argv)
{
    static uint8_t pixels[SIZE * SIZE][4];
    if (argc != 3) {
        fprintf(stderr, "usage: glsl VERTEX.spv FRAGMENT.spv\n");
        return 2;
    }
    rhw_shader_program *const program = link_shaders(argv[1], argv[2]);
    const struct rhw_context_def context_def = {0};
    const struct rhw_texture_def image_def = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = SIZE, .height = SIZE};
    const struct rhw_pipeline_def pipeline_def = {.program = *rhw_shader_program_get(program),
                                                  .targets = {{.format = RHW_FORMAT_RGBA8_UNORM}},
                                                  .target_count = 1};
    struct rhw_pass_def pass_def = {.color_count = 1};
    rhw_context *context;
    rhw_pipeline pipeline;
    rhw_pass pass;
    if (rhw_context_create(&context_def, &context) != RHW_OK) {
        return 1;
    }
    rhw_texture_create(context, &image_def, &pass_def.colors[0].texture);
    rhw_pipeline_create(context, &pipeline_def, &pipeline);

    const float radius = 0.4f; // the push constant of disc.frag
    const struct rhw_shader_frame frame = {.push_constants = &radius, .push_size = sizeof radius};
    rhw_pass_begin(context, &pass_def, &pass);
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_uniforms(context, pass, &frame, sizeof frame);
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    rhw_pass_end(context, pass, NULL);
    rhw_texture_read(context, pass_def.colors[0].texture, 0, pixels, 0);
    printf("%016llx\n", (unsigned long long)hash_bytes(pixels[0], sizeof pixels));
    rhw_context_destroy(context);
    rhw_shader_program_destroy(program);

    FILE *const file = fopen("glsl.ppm", "wb");
    if (!file) {
        return 1;
    }
    fprintf(file, "P6 %d %d 255\n", SIZE, SIZE);
    for (int i = 0; i < SIZE * SIZE; i++) {
        fwrite(pixels[i], 1, 3, file);
    }
    return fclose(file) != 0;
}
