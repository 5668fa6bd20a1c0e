// SPDX-License-Identifier: MIT
// Draws the same picture with the shaders of each instruction set that this computer has, and with shaders that see
// one vertex and one fragment at a time. Prints a number made of its bytes for each: they are equal.
// usage: ripples [FILE.ppm]
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>

#include "shaders.h"

enum { WIDTH = 500, HEIGHT = 400, TEXTURE = 64 };

static unsigned char pixels[HEIGHT][WIDTH][4];

// The one-at-a-time form of shaders.c.

static void place1(struct rhw_vertex1 *v)
{
    const struct ripple *ripple = v->uniforms;
    const float x = v->attribute[0][0], y = v->attribute[0][1];
    v->position[0] = x;
    v->position[1] = y * ripple->cosine;
    v->position[2] = 0;
    v->position[3] = 1.5f + y * ripple->sine;
    v->varying[0] = x;
    v->varying[1] = y;
}

static void paint1(struct rhw_fragment1 *f)
{
    const struct ripple *ripple = f->uniforms;
    const float *at = f->varying;
    const float square = at[0] * at[0] + at[1] * at[1];
    const float wave = rhw_sin1(square * ripple->frequency + ripple->phase);
    const float light = 0.75f + 0.25f * wave;
    const float grad[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
    float texel[4];
    rhw_sample_grad1(f->bindings, 0, at, grad, texel);
    for (int c = 0; c < 3; c++) {
        f->color[0][c] = texel[c] * light;
    }
    f->color[0][3] = 1;
    f->discard = !(square <= 1);
}

static void must(enum rhw_result result)
{
    if (result != RHW_OK) {
        fprintf(stderr, "ripples: %s\n", rhw_result_string(result));
        exit(1);
    }
}

// Fields of red and yellow, with all levels.
static rhw_texture make_fields(rhw_context *context)
{
    static unsigned char texels[TEXTURE][TEXTURE][4];
    for (int y = 0; y < TEXTURE; y++) {
        for (int x = 0; x < TEXTURE; x++) {
            const bool red = (x / 16 + y / 16) % 2 == 0;
            memcpy(texels[y][x],
                   red ? (unsigned char[]){200, 40, 20, 255} : (unsigned char[]){240, 200, 60, 255}, 4);
        }
    }
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_SRGB;
    def.width = def.height = TEXTURE;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture));
    rhw_texture_write(context, texture, 0, texels, 0);
    must(rhw_texture_generate_mips(context, texture));
    return texture;
}

static rhw_pipeline make_pipeline(rhw_context *context, bool one_at_a_time)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){
        .vertex = RHW_ISA_TABLE(place),
        .fragment = RHW_ISA_TABLE(paint),
        .varyings = {{.components = 2, .qualifier = RHW_SMOOTH, .derivatives = true}},
        .varying_count = 1,
        .uses = RHW_USE_DISCARD,
        .uniform_size = sizeof(struct ripple),
    };
    if (one_at_a_time) {
        memset(def.program.vertex, 0, sizeof def.program.vertex);
        memset(def.program.fragment, 0, sizeof def.program.fragment);
        def.program.vertex1 = place1;
        def.program.fragment1 = paint1;
    }
    def.attributes[0] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT2};
    def.attribute_count = 1;
    def.buffers[0].stride = 2 * sizeof(float);
    def.buffer_count = 1;
    def.topology = RHW_TRIANGLE_STRIP;
    def.targets[0].format = RHW_FORMAT_RGBA8_SRGB;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline));
    return pipeline;
}

// Draws into `pixels`.
static void draw(enum rhw_isa isa, bool one_at_a_time)
{
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    static const struct ripple ripple = {.cosine = 0.8f, .sine = 0.6f, .frequency = 40, .phase = 0.5f};
    struct rhw_context_def context_def = rhw_context_def_default();
    struct rhw_buffer_def buffer_def = {.size = sizeof corners, .data = corners};
    struct rhw_texture_def image_def = rhw_texture_def_default();
    struct rhw_sampler_def sampler_def = rhw_sampler_def_default();
    struct rhw_pass_def pass_def = rhw_pass_def_default();
    rhw_context *context;
    rhw_buffer buffer;
    rhw_texture image;
    rhw_sampler sampler;
    rhw_pass pass;

    context_def.isa_limit = rhw_isa_up_to(isa);
    must(rhw_context_create(&context_def, &context));
    must(rhw_buffer_create(context, &buffer_def, &buffer));
    must(rhw_sampler_create(context, &sampler_def, &sampler));
    image_def.format = RHW_FORMAT_RGBA8_SRGB;
    image_def.width = WIDTH;
    image_def.height = HEIGHT;
    must(rhw_texture_create(context, &image_def, &image));

    pass_def.colors[0].texture = image;
    must(rhw_pass_begin(context, &pass_def, &pass));
    rhw_pass_set_pipeline(context, pass, make_pipeline(context, one_at_a_time));
    rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
    rhw_pass_set_uniforms(context, pass, &ripple, sizeof ripple);
    rhw_pass_set_texture(context, pass, 0, make_fields(context), sampler);
    rhw_pass_draw(context, pass, 0, 4, 0, 1);
    must(rhw_pass_end(context, pass, NULL));
    rhw_texture_read(context, image, 0, pixels, 0);
    rhw_context_destroy(context);
}

// FNV-1a of the picture.
static void print_hash(const char *name)
{
    const unsigned char *bytes = &pixels[0][0][0];
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < sizeof pixels; i++) {
        hash = (hash ^ bytes[i]) * 1099511628211u;
    }
    printf("%-14s %016llx\n", name, (unsigned long long)hash);
}

static bool write_ppm(const char *name)
{
    FILE *file = fopen(name, "wb");
    if (!file) {
        return false;
    }
    fprintf(file, "P6 %d %d 255\n", WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        fwrite(pixels[i / WIDTH][i % WIDTH], 1, 3, file);
    }
    const bool failed = ferror(file) != 0;
    return fclose(file) == 0 && !failed;
}

int main(int argc, char **argv)
{
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (rhw_isa_supported((enum rhw_isa)isa)) {
            draw((enum rhw_isa)isa, false);
            print_hash(rhw_isa_name((enum rhw_isa)isa));
        }
    }
    draw(RHW_ISA_COUNT, true);
    print_hash("one at a time");
    if (argc > 1 && !write_ppm(argv[1])) {
        perror(argv[1]);
        return 1;
    }
    return 0;
}
