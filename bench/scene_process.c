// SPDX-License-Identifier: MIT
// Files that everybody has are read where they are. The others are made, in a folder that goes with the scene: a ball
// with bumps, as a scan, as what a printer takes, and as a model of many materials with textures.
#include "scene_process.h"

#include "elementary.h"
#include "file.h"
#include "process.h"
#include "scene_model.h"

#include <spng.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MATERIALS = 12, TEXTURE = 1024, FILES = MATERIALS + 2 };

struct bench_files {
    char folder[512], names[FILES][32], path[600]; // path: of the model
    int count;
};

void bench_files_remove(struct bench_files *files)
{
    char path[600];
    for (int i = 0; files && i < files->count; i++) {
        snprintf(path, sizeof path, "%s/%s", files->folder, files->names[i]);
        unlink(path);
    }
    if (files) {
        rmdir(files->folder);
        free(files);
    }
}

// Opens a new file of the folder for writing.
static FILE *open_file(struct bench_files *files, const char *name, char *path, size_t size)
{
    snprintf(files->names[files->count++], sizeof files->names[0], "%s", name);
    snprintf(path, size, "%s/%s", files->folder, name);
    return fopen(path, "wb");
}

// The ball ------------------------------------------------------------------------------------------

// A grid of `rows` × 2 `rows` cells around a ball. Each has two triangles.
struct ball {
    uint32_t rows;
    float (*points)[3]; // (rows + 1) × (2 rows + 1)
};

static uint32_t columns_of(const struct ball *ball)
{
    return 2 * ball->rows;
}

static bool make_ball(struct ball *ball, uint32_t rows)
{
    *ball = (struct ball){.rows = rows};
    ball->points = malloc((size_t)(rows + 1) * (2 * rows + 1) * sizeof *ball->points);
    for (uint32_t y = 0; ball->points && y <= rows; y++) {
        for (uint32_t x = 0; x <= columns_of(ball); x++) {
            const double pi = 3.14159265358979323846, polar = pi * y / rows, around = pi * x / rows;
            const double radius = 1.0 + 0.05 * scene_sin(20 * polar) * scene_sin(20 * around);
            float *const p = ball->points[y * (columns_of(ball) + 1) + x];
            p[0] = (float)(radius * scene_sin(polar) * scene_cos(around));
            p[1] = (float)(radius * scene_cos(polar));
            p[2] = (float)(radius * scene_sin(polar) * scene_sin(around));
        }
    }
    return ball->points != NULL;
}

static uint32_t triangles_of(const struct ball *ball)
{
    return 4 * ball->rows * ball->rows;
}

// Writes the corners of a triangle.
static void find_triangle(const struct ball *ball, uint32_t number, uint32_t corners[3])
{
    const uint32_t cell = number / 2, columns = columns_of(ball);
    const uint32_t first = cell / columns * (columns + 1) + cell % columns, below = first + columns + 1;
    const uint32_t upper[3] = {first, first + 1, below + 1}, lower[3] = {first, below + 1, below};
    memcpy(corners, number % 2 == 0 ? upper : lower, sizeof upper);
}

// Files ---------------------------------------------------------------------------------------------

static void write_ply(FILE *out, const struct ball *ball)
{
    const uint32_t points = (ball->rows + 1) * (columns_of(ball) + 1), triangles = triangles_of(ball);
    fprintf(out,
            "ply\nformat binary_little_endian 1.0\nelement vertex %u\nproperty float x\nproperty float y\n"
            "property float z\nelement face %u\nproperty list uchar int vertex_indices\nend_header\n",
            points, triangles);
    fwrite(ball->points, sizeof *ball->points, points, out);
    for (uint32_t i = 0; i < triangles; i++) {
        uint32_t corners[3];
        find_triangle(ball, i, corners);
        fputc(3, out);
        fwrite(corners, sizeof *corners, 3, out);
    }
}

static void write_stl(FILE *out, const struct ball *ball)
{
    const uint32_t triangles = triangles_of(ball);
    static const char head[80] = "a ball";
    static const float no_normal[3] = {0, 0, 0};
    fwrite(head, 1, sizeof head, out);
    fwrite(&triangles, sizeof triangles, 1, out);
    for (uint32_t i = 0; i < triangles; i++) {
        uint32_t corners[3];
        find_triangle(ball, i, corners);
        fwrite(no_normal, sizeof no_normal, 1, out);
        for (int k = 0; k < 3; k++) {
            fwrite(ball->points[corners[k]], sizeof *ball->points, 1, out);
        }
        fwrite("\0", 1, 2, out);
    }
}

// Texels that pack as those of photographs do, more or less.
static void fill_texture(uint8_t (*texels)[3], uint32_t number)
{
    uint32_t state = number + 1;
    for (uint32_t i = 0; i < TEXTURE * TEXTURE; i++) {
        state = state * 1664525 + 1013904223;
        for (uint32_t c = 0; c < 3; c++) {
            const uint32_t wave = (i % TEXTURE * (c + 1) + i / TEXTURE * (number + 1)) / 8;
            texels[i][c] = (uint8_t)(wave + (state >> 29));
        }
    }
}

static bool write_texture(FILE *out, uint8_t (*texels)[3], uint32_t number)
{
    struct spng_ihdr header = {
        .width = TEXTURE, .height = TEXTURE, .bit_depth = 8, .color_type = SPNG_COLOR_TYPE_TRUECOLOR};
    spng_ctx *const png = spng_ctx_new(SPNG_CTX_ENCODER);
    fill_texture(texels, number);
    const bool is_written = png && spng_set_png_file(png, out) == 0 && spng_set_ihdr(png, &header) == 0 &&
                            spng_encode_image(png, texels, sizeof *texels * TEXTURE * TEXTURE, SPNG_FMT_PNG,
                                              SPNG_ENCODE_FINALIZE) == 0;
    spng_ctx_free(png);
    return is_written;
}

static void write_obj(FILE *out, const struct ball *ball)
{
    const uint32_t columns = columns_of(ball), triangles = triangles_of(ball);
    fprintf(out, "mtllib ball.mtl\n");
    for (uint32_t i = 0; i < (ball->rows + 1) * (columns + 1); i++) {
        const float *const p = ball->points[i];
        fprintf(out, "v %.6f %.6f %.6f\n", (double)p[0], (double)p[1], (double)p[2]);
        fprintf(out, "vn %.4f %.4f %.4f\n", (double)p[0], (double)p[1], (double)p[2]);
        fprintf(out, "vt %.6f %.6f\n", (double)(i % (columns + 1)) / columns,
                (double)(i / (columns + 1)) / ball->rows);
    }
    for (uint32_t i = 0; i < triangles; i++) {
        uint32_t c[3];
        if (i * MATERIALS / triangles != (i - 1) * MATERIALS / triangles || i == 0) {
            fprintf(out, "g part%u\nusemtl material%u\n", i * MATERIALS / triangles,
                    i * MATERIALS / triangles);
        }
        find_triangle(ball, i, c);
        fprintf(out, "f %u/%u/%u %u/%u/%u %u/%u/%u\n", c[0] + 1, c[0] + 1, c[0] + 1, c[1] + 1, c[1] + 1,
                c[1] + 1, c[2] + 1, c[2] + 1, c[2] + 1);
    }
}

// Writes the library of materials and their textures.
static bool write_materials(struct bench_files *files)
{
    char path[600], name[32];
    uint8_t(*const texels)[3] = malloc(sizeof *texels * TEXTURE * TEXTURE);
    FILE *const library = open_file(files, "ball.mtl", path, sizeof path);
    bool is_written = texels && library;
    for (uint32_t i = 0; i < MATERIALS && is_written; i++) {
        snprintf(name, sizeof name, "texture%u.png", i);
        fprintf(library, "newmtl material%u\nKd 1 1 1\nmap_Kd %s\n", i, name);
        FILE *const out = open_file(files, name, path, sizeof path);
        is_written = out && write_texture(out, texels, i);
        is_written = out && fclose(out) == 0 && is_written;
    }
    free(texels);
    return library && fclose(library) == 0 && is_written;
}

// Makes the file of a row in a folder of its own. The numbers of triangles are those of a scanned dragon, of a part for
// a printer and of a figure of a game.
static bool make_file(struct bench_files *files, enum bench_process_variant variant)
{
    static const struct {
        const char *name;
        uint32_t rows;
        void (*write)(FILE *out, const struct ball *ball);
    } kinds[] = {[BENCH_PROCESS_PLY] = {"ball.ply", 467, write_ply},
                 [BENCH_PROCESS_STL] = {"ball.stl", 250, write_stl},
                 [BENCH_PROCESS_MTL] = {"ball.obj", 100, write_obj}};
    struct ball ball;
    if (!system_folder_make_unnamed(files->folder, sizeof files->folder) ||
        !make_ball(&ball, kinds[variant].rows)) {
        return false;
    }
    FILE *const out = open_file(files, kinds[variant].name, files->path, sizeof files->path);
    if (out) {
        kinds[variant].write(out, &ball);
    }
    free(ball.points);
    const bool is_written = out && ferror(out) == 0;
    return out && fclose(out) == 0 && is_written && (variant != BENCH_PROCESS_MTL || write_materials(files));
}

// Finds a file that is not made, and says where in `files`.
static bool find_file(struct bench_files *files, enum bench_process_variant variant, char *why,
                      size_t why_size)
{
    return bench_model_find(variant == BENCH_PROCESS_OBJ ? bench_bunny_path : "gltf/DamagedHelmet.glb",
                            files->path, sizeof files->path, why, why_size);
}

bool bench_make_process(const struct bench_scene_entry *entry, struct bench_scene *scene, int width,
                        int height, char *why, size_t why_size)
{
    (void)width, (void)height;
    const enum bench_process_variant variant = (enum bench_process_variant)entry->variant;
    const bool is_made = variant != BENCH_PROCESS_OBJ && variant != BENCH_PROCESS_GLB;
    scene->unit = BENCH_DRAWS;
    scene->files = calloc(1, sizeof *scene->files);
    if (!bench_can_start_itself()) {
        snprintf(why, why_size, "this machine does not say where the program is");
        return false;
    }
    if (!scene->files || !bench_scene_allocate(scene) ||
        !(is_made ? make_file(scene->files, variant) : find_file(scene->files, variant, why, why_size))) {
        return false;
    }
    scene->renders_file = scene->files->path;
    return true;
}
