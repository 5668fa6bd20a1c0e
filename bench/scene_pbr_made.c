// SPDX-License-Identifier: MIT
// See scene_pbr_made.h.
#include "scene_pbr_made.h"

#include "elementary.h"
#include "file.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FOLDER_SIZE = 512, PATH_SIZE = 600, FILES = 3 };
static const char *const names[FILES] = {"model.obj", "model.mtl", "wall.ppm"};

static FILE *open_file(const char *folder, int file)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof path, "%s/%s", folder, names[file]);
    return fopen(path, "wb");
}

static struct scene_model *load(bool (*write)(const char *folder), char *why, size_t why_size)
{
    char folder[FOLDER_SIZE], path[PATH_SIZE];
    struct scene_model *model = NULL;
    if (!system_folder_make_unnamed(folder, sizeof folder)) {
        snprintf(why, why_size, "no folder can be made for its files");
        return NULL;
    }
    snprintf(path, sizeof path, "%s/%s", folder, names[0]);
    if (write(folder)) {
        model = scene_model_load(path, NULL, why, why_size);
    } else {
        snprintf(why, why_size, "%s cannot be written", path);
    }
    for (int i = 0; i < FILES; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
    return model;
}

static bool write_text(const char *folder, int file, const char *text)
{
    FILE *const stream = open_file(folder, file);
    const bool written = stream && fputs(text, stream) >= 0;
    return stream && fclose(stream) == 0 && written;
}

// Hair ----------------------------------------------------------------------------------------------

// Outwards, then down.
static void write_strand(FILE *model, const double root[3])
{
    enum { PIECES = 8 };
    for (int k = 0; k <= PIECES; k++) {
        const double t = (double)k / PIECES, width = 0.012 * (1.0 - 0.8 * t), out = 1.0 + 0.45 * t;
        const double p[3] = {root[0] * out, root[1] * out - 0.8 * t * t, root[2] * out};
        fprintf(model, "v %.6f %.6f %.6f\nv %.6f %.6f %.6f\n", p[0] - width, p[1], p[2] + width, p[0] + width,
                p[1], p[2] - width);
        if (k > 0) {
            fputs("f -4 -3 -1 -2\n", model);
        }
    }
}

static bool write_hair(const char *folder)
{
    enum { STRANDS = 10000 };
    FILE *const model = open_file(folder, 0);
    if (!model || !write_text(folder, 1, "newmtl hair\nKd 0.45 0.27 0.12\nd 0.35\nPr 0.5\n")) {
        return false;
    }
    fputs("mtllib model.mtl\nusemtl hair\n", model);
    uint32_t random = 1;
    for (int i = 0; i < STRANDS; i++) {
        double at[3];
        for (int c = 0; c < 3; c++) {
            random = random * 1664525u + 1013904223u;
            at[c] = (double)(random >> 8) / 0x1p23 - 1.0;
        }
        const double length = __builtin_sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]) + 1e-3;
        const double root[3] = {at[0] / length, at[1] / length, at[2] / length};
        write_strand(model, root);
    }
    return fclose(model) == 0;
}

struct scene_model *bench_make_hair(char *why, size_t why_size)
{
    return load(write_hair, why, why_size);
}

// Glass ---------------------------------------------------------------------------------------------

enum { COLUMNS = 4, ROWS = 3, SLICES = 96, STACKS = 48 };

static bool write_wall(const char *folder)
{
    enum { SIDE = 256 };
    FILE *const stream = open_file(folder, 2);
    if (!stream) {
        return false;
    }
    fprintf(stream, "P6\n%d %d\n255\n", SIDE, SIDE);
    for (int y = 0; y < SIDE; y++) {
        for (int x = 0; x < SIDE; x++) {
            const bool dark = (x / 64 + y / 64) % 2, line = x % 32 < 2 || y % 32 < 2;
            fputc(line ? 40 : dark ? 60 : 230, stream);
            fputc(line ? 40 : dark ? 110 : 215, stream);
            fputc(line ? 45 : dark ? 160 : 190, stream);
        }
    }
    return fclose(stream) == 0;
}

// A ring of vertices for each stack, the poles among them, and the quads to the ring before.
static void write_sphere(FILE *model, double x, double y)
{
    const double pi = 3.14159265358979323846, radius = 0.46;
    for (int i = 0; i <= STACKS; i++) {
        const double down = pi * i / STACKS, ring = scene_sin(down);
        for (int k = 0; k < SLICES; k++) {
            const double turn = 2.0 * pi * k / SLICES;
            const double n[3] = {ring * scene_cos(turn), scene_cos(down), ring * scene_sin(turn)};
            fprintf(model, "v %.6f %.6f %.6f\nvn %.6f %.6f %.6f\n", x + radius * n[0], y + radius * n[1],
                    radius * n[2], n[0], n[1], n[2]);
        }
        for (int k = 0; i > 0 && k < SLICES; k++) {
            const int a = k - 2 * SLICES, b = (k + 1) % SLICES - 2 * SLICES, c = b + SLICES, d = a + SLICES;
            fprintf(model, "f %d//%d %d//%d %d//%d %d//%d\n", a, a, b, b, c, c, d, d);
        }
    }
}

static bool write_glass(const char *folder)
{
    FILE *const model = open_file(folder, 0);
    if (!model || !write_wall(folder) ||
        !write_text(folder, 1,
                    "newmtl wall\nKd 1 1 1\nmap_Kd wall.ppm\nPr 0.8\nnewmtl glass0\nKd 1 1 1\nPr 0\n"
                    "newmtl glass1\nKd 0.8 1 0.9\nPr 0.25\nnewmtl glass2\nKd 1 0.9 0.7\nPr 0.5\n")) {
        return false;
    }
    fputs("mtllib model.mtl\nusemtl wall\nv -2.2 -1.7 -1\nv 2.2 -1.7 -1\nv 2.2 1.7 -1\nv -2.2 1.7 -1\n"
          "vn 0 0 1\nvt 0 0\nvt 6 0\nvt 6 4.6\nvt 0 4.6\nf 1/1/1 2/2/1 3/3/1 4/4/1\n",
          model);
    for (int row = 0; row < ROWS; row++) {
        fprintf(model, "usemtl glass%d\n", row);
        for (int column = 0; column < COLUMNS; column++) {
            write_sphere(model, column - 0.5 * (COLUMNS - 1), 0.5 * (ROWS - 1) - row);
        }
    }
    return fclose(model) == 0;
}

struct scene_model *bench_make_glass(char *why, size_t why_size)
{
    struct scene_model *const model = load(write_glass, why, why_size);
    for (uint32_t i = 0; model && i < model->material_count; i++) {
        struct scene_material *const material = &model->materials[i];
        material->double_sided = false;
        if (material->slots[SCENE_SLOT_BASE_COLOR].image < 0) {
            material->layers = (struct scene_layers){.used = true,
                                                     .specular = 1.0f,
                                                     .specular_color = {1.0f, 1.0f, 1.0f},
                                                     .ior = 1.5f,
                                                     .transmission = 1.0f,
                                                     .thickness = 0.6f,
                                                     .attenuation_distance = 1.0f,
                                                     .attenuation_color = {0.8f, 0.9f, 0.95f}};
        }
    }
    return model;
}
