// SPDX-License-Identifier: MIT
// The first program: one triangle, written to hello.ppm. It needs librhw and libc alone.
// docs/hello.md explains it; a test holds the code there, and what the README shows of it, to this file.
#include <rhw/rhw.h>
#include <rhw/shader.h>
#include <stdio.h>
#include <string.h>

static const float triangle[3][8] = { // X, Y, Z, W; red, green, blue, alpha
    {-0.8f, -0.8f, 0, 1, 1, 0, 0, 1},
    {2.4f, -2.4f, 0, 3, 0, 1, 0, 1},
    {0, 0.8f, 0, 1, 0, 0, 1, 1}};

static void vertex(struct rhw_vertex1 *v)
{
    memcpy(v->position, &triangle[v->vertex_index][0], 4 * sizeof(float));
    memcpy(v->varying, &triangle[v->vertex_index][4], 4 * sizeof(float));
}

static void fragment(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying, 4 * sizeof(float));
}

int main(void)
{
    struct rhw_context_def context_def = rhw_context_def_default();
    struct rhw_texture_def image_def = rhw_texture_def_default();
    struct rhw_pipeline_def pipeline_def = rhw_pipeline_def_default();
    struct rhw_pass_def pass_def = rhw_pass_def_default();
    rhw_context *context;
    rhw_texture image;
    rhw_pipeline pipeline;
    rhw_pass pass;
    static unsigned char pixels[512 * 512][4];

    if (rhw_context_create(&context_def, &context) != RHW_OK) {
        return 1;
    }
    image_def.width = image_def.height = 512;
    rhw_texture_create(context, &image_def, &image);

    pipeline_def.program.vertex1 = vertex;
    pipeline_def.program.fragment1 = fragment;
    pipeline_def.program.varyings[0] = (struct rhw_varying){.components = 4};
    pipeline_def.program.varying_count = 1;
    rhw_pipeline_create(context, &pipeline_def, &pipeline);

    pass_def.colors[0].texture = image;
    rhw_pass_begin(context, &pass_def, &pass);
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    rhw_pass_end(context, pass, NULL);
    rhw_texture_read(context, image, 0, pixels, 0);
    rhw_context_destroy(context);

    FILE *file = fopen("hello.ppm", "wb");
    if (!file) {
        return 1;
    }
    fprintf(file, "P6 512 512 255\n");
    for (int i = 0; i < 512 * 512; i++) {
        fwrite(pixels[i], 1, 3, file);
    }
    return fclose(file) != 0;
}
