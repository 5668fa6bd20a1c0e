// SPDX-License-Identifier: MIT
// See golden_model_file.h. The files are the repository's own: lengths are asserted, not reported.
#include "golden_model_file.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *golden_allocate(size_t count, size_t size)
{
    void *const memory = calloc(count ? count : 1, size);
    if (memory == NULL) {
        fprintf(stderr, "golden: no memory for a model\n");
        exit(2);
    }
    return memory;
}

static void read_bytes(FILE *file, void *bytes, size_t size)
{
    if (fread(bytes, 1, size, file) != size) {
        fprintf(stderr, "golden: a model file ends early\n");
        exit(2);
    }
}

static uint32_t read_u32(FILE *file)
{
    unsigned char b[4];
    read_bytes(file, b, sizeof b);
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static uint32_t read_u16(FILE *file)
{
    unsigned char b[2];
    read_bytes(file, b, sizeof b);
    return (uint32_t)b[0] | (uint32_t)b[1] << 8;
}

static void read_floats(FILE *file, float *floats, int count)
{
    for (int i = 0; i < count; i++) {
        const uint32_t bits = read_u32(file);
        memcpy(&floats[i], &bits, sizeof bits);
    }
}

static void read_image(FILE *file, struct scene_image *image)
{
    *image = (struct scene_image){.name = "", .type = SCENE_IMAGE_RGBA8, .used_as_color = true};
    image->width = read_u32(file);
    image->height = read_u32(file);
    image->size = (size_t)image->width * image->height * 4;
    unsigned char *const texels = golden_allocate(image->size, 1);
    for (size_t i = 0; i < image->size; i += 4) {
        read_bytes(file, texels + i, 3);
        texels[i + 3] = 255;
    }
    image->texels = texels;
}

static void read_material(FILE *file, struct scene_material *material)
{
    *material = (struct scene_material){.name = "", .normal_scale = 1, .occlusion_strength = 1};
    read_floats(file, material->base_color, 4);
    read_floats(file, &material->metallic, 1);
    read_floats(file, &material->roughness, 1);
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        material->slots[s] = (struct scene_texture_slot){.image = -1,
                                                         .transform = {1, 0, 0, 0, 1, 0},
                                                         .min_filter = RHW_FILTER_LINEAR,
                                                         .mag_filter = RHW_FILTER_LINEAR,
                                                         .mip_filter = RHW_MIP_FILTER_LINEAR};
    }
    material->slots[SCENE_SLOT_BASE_COLOR].image = (int32_t)read_u32(file);
    material->alpha_mode = (enum scene_alpha_mode)read_u32(file);
    read_floats(file, &material->alpha_cutoff, 1);
    material->double_sided = read_u32(file) != 0;
}

// Arithmetic in double: exact enough, and the same everywhere.
static float between(float low, float high, uint32_t place)
{
    return (float)((double)low + ((double)high - (double)low) * (double)place / 65535.0);
}

static void read_normal(FILE *file, float normal[3])
{
    signed char bytes[3];
    read_bytes(file, bytes, sizeof bytes);
    const float square = (float)(bytes[0] * bytes[0] + bytes[1] * bytes[1] + bytes[2] * bytes[2]);
    for (int c = 0; c < 3; c++) {
        normal[c] = square > 0 ? (float)bytes[c] / __builtin_sqrtf(square) : c == 2 ? 1.0f : 0.0f;
    }
}

static void read_mesh(FILE *file, struct scene_mesh *mesh)
{
    *mesh = (struct scene_mesh){.name = "", .primitive = SCENE_PRIMITIVE_TRIANGLES};
    mesh->material = read_u32(file);
    mesh->vertex_count = read_u32(file);
    mesh->index_count = read_u32(file);
    const bool coordinates = read_u32(file) != 0;
    float low[5], high[5]; // position, then coordinates
    read_floats(file, low, 3);
    read_floats(file, high, 3);
    read_floats(file, low + 3, 2);
    read_floats(file, high + 3, 2);
    mesh->positions = golden_allocate(mesh->vertex_count, sizeof *mesh->positions);
    mesh->normals = golden_allocate(mesh->vertex_count, sizeof *mesh->normals);
    mesh->indices = golden_allocate(mesh->index_count, sizeof *mesh->indices);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        for (int c = 0; c < 3; c++) {
            mesh->positions[v][c] = between(low[c], high[c], read_u16(file));
        }
    }
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        read_normal(file, mesh->normals[v]);
    }
    if (coordinates) {
        mesh->uvs[0] = golden_allocate(mesh->vertex_count, sizeof *mesh->uvs[0]);
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            for (int c = 0; c < 2; c++) {
                mesh->uvs[0][v][c] = between(low[3 + c], high[3 + c], read_u16(file));
            }
        }
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = read_u16(file);
        assert(mesh->indices[i] < mesh->vertex_count);
    }
}

static void widen(float low[3], float high[3], const float point[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = point[c] < low[c] ? point[c] : low[c];
        high[c] = point[c] > high[c] ? point[c] : high[c];
    }
}

static float determinant(const float m[16])
{
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
           m[8] * (m[1] * m[6] - m[2] * m[5]);
}

void golden_model_complete(struct scene_model *model)
{
    static const uint32_t corners[] = {3, 2, 1};
    const float large = 3e38f;
    for (int c = 0; c < 3; c++) {
        model->bounds_min[c] = large;
        model->bounds_max[c] = -large;
    }
    model->path = model->format = "";
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        struct scene_mesh *const mesh = &model->meshes[m];
        for (int c = 0; c < 3; c++) {
            mesh->bounds_min[c] = large;
            mesh->bounds_max[c] = -large;
        }
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            widen(mesh->bounds_min, mesh->bounds_max, mesh->positions[mesh->indices[i]]);
        }
        model->triangles_stored += mesh->index_count / corners[mesh->primitive];
    }
    for (uint32_t i = 0; i < model->instance_count; i++) {
        struct scene_instance *const instance = &model->instances[i];
        const struct scene_mesh *const mesh = &model->meshes[instance->mesh];
        const float *const m = instance->world;
        instance->name = "";
        instance->object = i + 1;
        instance->mirrored = determinant(m) < 0;
        for (uint32_t v = 0; v < mesh->index_count; v++) {
            const float *const p = mesh->positions[mesh->indices[v]];
            float point[3];
            for (int c = 0; c < 3; c++) {
                point[c] = m[c] * p[0] + m[4 + c] * p[1] + m[8 + c] * p[2] + m[12 + c];
            }
            widen(model->bounds_min, model->bounds_max, point);
        }
        model->triangles_drawn += mesh->index_count / corners[mesh->primitive];
    }
}

const struct scene_model *golden_model_file_read(const char *path)
{
    FILE *const file = fopen(path, "rb");
    char magic[4];
    if (file == NULL) {
        fprintf(stderr, "golden: %s cannot be opened\n", path);
        exit(2);
    }
    read_bytes(file, magic, sizeof magic);
    assert(memcmp(magic, "RHWG", sizeof magic) == 0);
    struct scene_model *const model = golden_allocate(1, sizeof *model);
    model->image_count = read_u32(file);
    model->material_count = read_u32(file);
    model->mesh_count = read_u32(file);
    model->instance_count = read_u32(file);
    model->images = golden_allocate(model->image_count, sizeof *model->images);
    model->materials = golden_allocate(model->material_count, sizeof *model->materials);
    model->meshes = golden_allocate(model->mesh_count, sizeof *model->meshes);
    model->instances = golden_allocate(model->instance_count, sizeof *model->instances);
    for (uint32_t i = 0; i < model->image_count; i++) {
        read_image(file, &model->images[i]);
    }
    for (uint32_t i = 0; i < model->material_count; i++) {
        read_material(file, &model->materials[i]);
    }
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        read_mesh(file, &model->meshes[i]);
    }
    for (uint32_t i = 0; i < model->instance_count; i++) {
        model->instances[i].mesh = read_u32(file);
        read_floats(file, model->instances[i].world, 16);
    }
    fclose(file);
    golden_model_complete(model);
    return model;
}
