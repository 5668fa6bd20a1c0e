// SPDX-License-Identifier: MIT
// Writes a model as golden scenes carry it (golden_model_file.h): positions, normals and coordinates quantized,
// images halved to at most SIDE texels, materials reduced to their base colour.
//
//   golden_pack MODEL FILE
#include "model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 128 };

static void write_u32(FILE *file, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        putc((int)(value >> 8 * i & 0xff), file);
    }
}

static void write_u16(FILE *file, uint32_t value)
{
    putc((int)(value & 0xff), file);
    putc((int)(value >> 8 & 0xff), file);
}

static void write_floats(FILE *file, const float *floats, int count)
{
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &floats[i], sizeof bits);
        write_u32(file, bits);
    }
}

// Every texel of the file is the mean of step × step codes: what looks right is enough here.
static void write_image(FILE *file, const struct scene_image *image)
{
    uint32_t step = 1;
    while (image->width / step > SIDE || image->height / step > SIDE) {
        step *= 2;
    }
    const uint32_t width = image->width / step, height = image->height / step;
    const unsigned char *const texels = image->texels;
    write_u32(file, width);
    write_u32(file, height);
    for (uint32_t at = 0; at < width * height * 3; at++) {
        const uint32_t x = at / 3 % width * step, y = at / 3 / width * step;
        uint32_t sum = 0;
        for (uint32_t i = 0; i < step * step; i++) {
            sum += texels[((size_t)(y + i / step) * image->width + x + i % step) * 4 + at % 3];
        }
        putc((int)(sum / (step * step)), file);
    }
}

static void write_material(FILE *file, const struct scene_material *material)
{
    write_floats(file, material->base_color, 4);
    write_floats(file, &material->metallic, 1);
    write_floats(file, &material->roughness, 1);
    write_u32(file, (uint32_t)material->slots[SCENE_SLOT_BASE_COLOR].image);
    write_u32(file, (uint32_t)material->alpha_mode);
    write_floats(file, &material->alpha_cutoff, 1);
    write_u32(file, material->double_sided);
}

static uint32_t place(float low, float high, float value)
{
    return high > low ? (uint32_t)(65535.0f * (value - low) / (high - low) + 0.5f) : 0;
}

static void write_mesh(FILE *file, const struct scene_mesh *mesh)
{
    write_u32(file, mesh->material);
    write_u32(file, mesh->vertex_count);
    write_u32(file, mesh->index_count);
    write_u32(file, mesh->uvs[0] != NULL);
    float low[5] = {INFINITY, INFINITY, INFINITY, INFINITY, INFINITY}, high[5];
    for (int c = 0; c < 5; c++) {
        high[c] = -low[c];
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        for (int c = 0; c < 5; c++) {
            const float value = c < 3 ? mesh->positions[v][c] : mesh->uvs[0] ? mesh->uvs[0][v][c - 3] : 0;
            low[c] = fminf(low[c], value);
            high[c] = fmaxf(high[c], value);
        }
    }
    write_floats(file, low, 3);
    write_floats(file, high, 3);
    write_floats(file, low + 3, 2);
    write_floats(file, high + 3, 2);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        for (int c = 0; c < 3; c++) {
            write_u16(file, place(low[c], high[c], mesh->positions[v][c]));
        }
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        for (int c = 0; c < 3; c++) {
            putc((int)lrintf(mesh->normals[v][c] * 127) & 0xff, file);
        }
    }
    for (uint32_t v = 0; v < mesh->vertex_count && mesh->uvs[0]; v++) {
        for (int c = 0; c < 2; c++) {
            write_u16(file, place(low[3 + c], high[3 + c], mesh->uvs[0][v][c]));
        }
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        write_u16(file, mesh->indices[i]);
    }
}

static const char *refuse(const struct scene_model *model)
{
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        if (model->meshes[i].primitive != SCENE_PRIMITIVE_TRIANGLES ||
            model->meshes[i].vertex_count > 65536) {
            return "a mesh is not of triangles, or has more than 65536 vertices";
        }
    }
    for (uint32_t i = 0; i < model->image_count; i++) {
        if (model->images[i].type != SCENE_IMAGE_RGBA8) {
            return "an image has more than 8 bits per channel";
        }
    }
    return NULL;
}

int main(int argc, char **argv)
{
    char error[512] = "";
    struct scene_model *const model = argc == 3 ? scene_model_load(argv[1], NULL, error, sizeof error) : NULL;
    const char *const cause = model ? refuse(model) : error;
    if (cause) {
        fprintf(stderr, "golden_pack: %s\n", argc == 3 ? cause : "usage: golden_pack MODEL FILE");
        return 2;
    }
    FILE *const file = fopen(argv[2], "wb");
    if (file == NULL) {
        fprintf(stderr, "golden_pack: %s cannot be written\n", argv[2]);
        return 2;
    }
    fwrite("RHWG", 1, 4, file);
    write_u32(file, model->image_count);
    write_u32(file, model->material_count);
    write_u32(file, model->mesh_count);
    write_u32(file, model->instance_count);
    for (uint32_t i = 0; i < model->image_count; i++) {
        write_image(file, &model->images[i]);
    }
    for (uint32_t i = 0; i < model->material_count; i++) {
        write_material(file, &model->materials[i]);
    }
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        write_mesh(file, &model->meshes[i]);
    }
    for (uint32_t i = 0; i < model->instance_count; i++) {
        write_u32(file, model->instances[i].mesh);
        write_floats(file, model->instances[i].world, 16);
    }
    scene_model_free(model);
    return fclose(file) != 0;
}
