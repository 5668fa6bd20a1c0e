// SPDX-License-Identifier: MIT
// The list of scenes and the memory of one; see bench_scene.h.
#include "bench_scene.h"

#include "scene_deferred.h"
#include "scene_floor.h"
#include "scene_asked.h"
#include "scene_format.h"
#include "scene_latency.h"
#include "scene_model.h"
#include "scene_particles.h"
#include "scene_pbr.h"
#include "scene_process.h"
#include "scene_reflection.h"
#include "scene_shadow_map.h"
#include "scene_shadow_volume.h"
#include "scene_small.h"
#include "scene_sphere.h"
#include "scene_translation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A fill scene with a picture of another format, and its neighbour of RGBA8.
#define FORMAT(name, neighbour, variant, format)                                    \
    {                                                                               \
        "cliffs_" name, neighbour " into a picture of " #format, bench_make_format, \
            BENCH_FORMAT_VARIANT(BENCH_##format, BENCH_FORMAT_##variant)            \
    }

const struct bench_scene_entry bench_scene_entries[] = {
    {"fill_flat", "8 floors over the whole picture, one colour each, a uniform", bench_make_floor,
     BENCH_FLOOR_FLAT},
    {"fill_literal", "the same, one colour that the shader names: half the price to llvmpipe",
     bench_make_floor, BENCH_FLOOR_LITERAL},
    {"fill_color", "8 floors, interpolated colours", bench_make_floor, BENCH_FLOOR_COLOR},
    {"fill_blend", "the same, blended by source alpha", bench_make_floor, BENCH_FLOOR_BLEND},
    {"fill_tex", "the same, a trilinear texture of 1024x1024", bench_make_floor, BENCH_FLOOR_TEXTURE},
    {"fill_aniso", "fill_tex with up to 16 samples along the longer axis of a footprint", bench_make_floor,
     BENCH_FLOOR_ANISOTROPIC},
    {"overdraw", "fill_tex with a depth test: 8 opaque layers, far to near", bench_make_floor,
     BENCH_FLOOR_OVERDRAW},
    {"painter", "fill_tex again, where hidden fragments may be skipped", bench_make_floor,
     BENCH_FLOOR_PAINTER},
    {"painter_free", "painter, without the depth buffer that keeps llvmpipe from skipping them",
     bench_make_floor, BENCH_FLOOR_PAINTER_FREE},
    {"sphere_10k", "bumpy sphere of 10,000 triangles, Blinn-Phong per pixel", bench_make_sphere,
     BENCH_SPHERE_10K},
    {"sphere_82k", "the same of 82,000 triangles", bench_make_sphere, BENCH_SPHERE_82K},
    {"sphere_82k_flat", "the same with a flat varying and ids", bench_make_sphere, BENCH_SPHERE_82K_FLAT},
    {"sphere_1m", "the same of 1,000,000 triangles", bench_make_sphere, BENCH_SPHERE_1M},
    {"sphere_1m_tex", "the same with a trilinear texture", bench_make_sphere, BENCH_SPHERE_1M_TEXTURE},
    {"sphere_1m_depth", "the same, depth only", bench_make_sphere, BENCH_SPHERE_1M_DEPTH},
    {"msaa4_sphere_1m", "sphere_1m with 4 samples a pixel", bench_make_sphere, BENCH_SPHERE_1M_SAMPLES},
    {"lines_1m", "the grid of the same as 1,000,000 lines of one pixel", bench_make_sphere,
     BENCH_SPHERE_1M_LINES},
    {"points_1m", "its vertices as 1,000,000 points of one pixel", bench_make_sphere, BENCH_SPHERE_1M_POINTS},
    {"bunny_lit", "Stanford bunny, Blinn-Phong per pixel", bench_make_model, BENCH_MODEL_BUNNY},
    {"bunny_depth", "the same, depth only", bench_make_model, BENCH_MODEL_BUNNY_DEPTH},
    {"sponza", "Sponza: 262k triangles, 25 materials, textures, alpha test", bench_make_model,
     BENCH_MODEL_SPONZA},
    {"msaa4_sponza", "sponza with 4 samples a pixel", bench_make_model, BENCH_MODEL_SPONZA_SAMPLES},
    {"pbr_helmet", "DamagedHelmet: physically based, 5 textures", bench_make_pbr, BENCH_PBR_HELMET},
    {"pbr_sponza", "Sponza: physically based, up to 3 textures, alpha test", bench_make_pbr,
     BENCH_PBR_SPONZA},
    {"shadowed_helmet", "pbr_helmet with the soft shadows of its light, from a map of 1024x1024",
     bench_make_pbr, BENCH_PBR_HELMET_SHADOWED},
    {"shadowed_sponza", "pbr_sponza with the same", bench_make_pbr, BENCH_PBR_SPONZA_SHADOWED},
    {"hair", "160,000 transparent triangles, sorted, physically based", bench_make_pbr, BENCH_PBR_HAIR},
    {"transmission", "12 spheres of glass, smooth and rough, that show what lies behind", bench_make_pbr,
     BENCH_PBR_GLASS},
    {"shadow_volumes", "50 bodies on a floor, their shadows counted in stencil", bench_make_shadow_volumes,
     0},
    {"shadow_map", "100,000 triangles and a shadow map of 2048x2048, 3x3 footprints compared",
     bench_make_shadow_map, 0},
    {"reflection", "a ball that shows its surroundings, drawn into six faces of 256x256",
     bench_make_reflection, 0},
    {"deferred", "four targets, and 32 lights that read them", bench_make_deferred, 0},
    {"particles", "100,000 instances of a quad, blended", bench_make_particles, 0},
    {"empty", "a frame that is cleared and nothing else", bench_make_latency, BENCH_LATENCY_EMPTY},
    {"draws_10k", "10,000 draws of 12 triangles with uniforms of their own", bench_make_latency,
     BENCH_LATENCY_DRAWS},
    {"draws_textures", "draws_10k with a texture of its own for each draw, one of 64", bench_make_latency,
     BENCH_LATENCY_DRAWS_TEXTURES},
    {"draws_10k_recorded", "the same pass, recorded once and run again", bench_make_latency,
     BENCH_LATENCY_DRAWS_RECORDED},
    {"draws_10k_replayed", "the same pass, of which the triangles are kept too", bench_make_latency,
     BENCH_LATENCY_DRAWS_REPLAYED},
    {"context", "creating and destroying a context of rhw", bench_make_latency, BENCH_LATENCY_CONTEXT},
    {"texture", "creating and destroying a texture of 8192x8192", bench_make_latency, BENCH_LATENCY_TEXTURE},
    {"mips", "the mip chain of an sRGB texture of 2048x2048", bench_make_latency, BENCH_LATENCY_MIPS},
    {"translation", "a pipeline of the lights of deferred, 200 operations, from SPIR-V on",
     bench_make_translation, 0},
    {"process", "rhw render of the bunny, an OBJ, as a process, file to file", bench_make_process,
     BENCH_PROCESS_OBJ},
    {"process_ply", "the same of a ball as a binary PLY of 872,356 triangles", bench_make_process,
     BENCH_PROCESS_PLY},
    {"process_stl", "the same of a ball as a binary STL of 250,000 facets", bench_make_process,
     BENCH_PROCESS_STL},
    {"process_glb", "the same of DamagedHelmet, a GLB with 5 textures", bench_make_process,
     BENCH_PROCESS_GLB},
    {"process_mtl", "the same of a ball as an OBJ of 40,000 triangles, 12 materials and textures",
     bench_make_process, BENCH_PROCESS_MTL},
    {"cliffs_write_none", "1,000 draws of 12 triangles, from a buffer of a mebibyte", bench_make_latency,
     BENCH_LATENCY_WRITES_NONE},
    {"cliffs_write_between", "the same, a vertex of the buffer written before each", bench_make_latency,
     BENCH_LATENCY_WRITES_BETWEEN},
    {"cliffs_draws_state", "draws_textures, each with another pipeline and scissor than the one before",
     bench_make_latency, BENCH_LATENCY_DRAWS_STATE},
    {"cliffs_passes_16", "2,000 passes into a target of 16x16, a lit ball in each", bench_make_small,
     BENCH_SMALL_16},
    {"cliffs_passes_64", "500 passes into a target of 64x64, one tile", bench_make_small, BENCH_SMALL_64},
    {"cliffs_passes_256", "100 passes into a target of 256x256, sixteen tiles", bench_make_small,
     BENCH_SMALL_256},
    FORMAT("flat_r8", "fill_flat", FLAT, R8),
    FORMAT("flat_bgra8", "fill_flat", FLAT, BGRA8),
    FORMAT("flat_rgba16", "fill_flat", FLAT, RGBA16),
    FORMAT("flat_rgb565", "fill_flat", FLAT, RGB565),
    FORMAT("flat_rgba16f", "fill_flat", FLAT, RGBA16F),
    FORMAT("store_r8", "fill_color", STORE, R8),
    FORMAT("store_rg8", "fill_color", STORE, RG8),
    FORMAT("store_bgra8", "fill_color", STORE, BGRA8),
    FORMAT("store_r16", "fill_color", STORE, R16),
    FORMAT("store_rg16", "fill_color", STORE, RG16),
    FORMAT("store_rgba16", "fill_color", STORE, RGBA16),
    FORMAT("store_rgb10a2", "fill_color", STORE, RGB10A2),
    FORMAT("store_rgb565", "fill_color", STORE, RGB565),
    FORMAT("store_rgba4", "fill_color", STORE, RGBA4),
    FORMAT("store_rgb5a1", "fill_color", STORE, RGB5A1),
    FORMAT("store_rgba8s", "fill_color", STORE, RGBA8S),
    FORMAT("store_rgba16s", "fill_color", STORE, RGBA16S),
    FORMAT("store_r16f", "fill_color", STORE, R16F),
    FORMAT("store_rg16f", "fill_color", STORE, RG16F),
    FORMAT("store_rgba16f", "fill_color", STORE, RGBA16F),
    FORMAT("store_r32f", "fill_color", STORE, R32F),
    FORMAT("store_rg32f", "fill_color", STORE, RG32F),
    FORMAT("store_rgba32f", "fill_color", STORE, RGBA32F),
    FORMAT("store_rg11b10f", "fill_color", STORE, RG11B10F),
    FORMAT("blend_r8", "fill_blend", BLEND, R8),
    FORMAT("blend_rg8", "fill_blend", BLEND, RG8),
    FORMAT("blend_bgra8", "fill_blend", BLEND, BGRA8),
    FORMAT("blend_r16", "fill_blend", BLEND, R16),
    FORMAT("blend_rg16", "fill_blend", BLEND, RG16),
    FORMAT("blend_rgba16", "fill_blend", BLEND, RGBA16),
    FORMAT("blend_rgb10a2", "fill_blend", BLEND, RGB10A2),
    FORMAT("blend_rgb565", "fill_blend", BLEND, RGB565),
    FORMAT("blend_rgba4", "fill_blend", BLEND, RGBA4),
    FORMAT("blend_rgb5a1", "fill_blend", BLEND, RGB5A1),
    FORMAT("blend_rgba8s", "fill_blend", BLEND, RGBA8S),
    FORMAT("blend_rgba16s", "fill_blend", BLEND, RGBA16S),
    FORMAT("blend_r16f", "fill_blend", BLEND, R16F),
    FORMAT("blend_rg16f", "fill_blend", BLEND, RG16F),
    FORMAT("blend_rgba16f", "fill_blend", BLEND, RGBA16F),
    FORMAT("blend_r32f", "fill_blend", BLEND, R32F),
    FORMAT("blend_rg32f", "fill_blend", BLEND, RG32F),
    FORMAT("blend_rgba32f", "fill_blend", BLEND, RGBA32F),
    FORMAT("blend_rg11b10f", "fill_blend", BLEND, RG11B10F),
    {"cliffs_mesh", "a sphere of 82,000 triangles in the colours of its vertices", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_COLOR, BENCH_ASKED_MESH)},
    {"cliffs_coord_fill", "fill_color, and coordinates", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_COORD, BENCH_ASKED_FILL)},
    {"cliffs_coord_mesh", "cliffs_mesh, and coordinates", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_COORD, BENCH_ASKED_MESH)},
    {"cliffs_slopes_fill", "fill_color, and derivatives", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_SLOPES, BENCH_ASKED_FILL)},
    {"cliffs_slopes_mesh", "cliffs_mesh, and derivatives", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_SLOPES, BENCH_ASKED_MESH)},
    {"cliffs_coord_slopes_fill", "cliffs_slopes_fill, and coordinates", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_COORD_SLOPES, BENCH_ASKED_FILL)},
    {"cliffs_coord_slopes_mesh", "cliffs_slopes_mesh, and coordinates", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_COORD_SLOPES, BENCH_ASKED_MESH)},
    {"cliffs_screen_fill", "fill_color, interpolated on the screen", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_SCREEN, BENCH_ASKED_FILL)},
    {"cliffs_screen_mesh", "cliffs_mesh, interpolated on the screen", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_SCREEN, BENCH_ASKED_MESH)},
    {"cliffs_many_fill", "fill_color as the sum of 16 squared varyings", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_MANY, BENCH_ASKED_FILL)},
    {"cliffs_many_mesh", "cliffs_mesh as the sum of 16 squared varyings", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_MANY, BENCH_ASKED_MESH)},
    {"cliffs_discard_fill", "fill_color, of which a part is discarded", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_DISCARD, BENCH_ASKED_FILL)},
    {"cliffs_discard_mesh", "cliffs_mesh, of which a part is discarded", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_DISCARD, BENCH_ASKED_MESH)},
    {"cliffs_move_fill", "fill_color, with depths that the shader writes", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_MOVE, BENCH_ASKED_FILL)},
    {"cliffs_move_mesh", "cliffs_mesh, with depths that the shader writes", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_MOVE, BENCH_ASKED_MESH)},
    {"cliffs_sample4_fill", "fill_color with 4 samples, each shaded", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_SAMPLE, BENCH_ASKED_FILL_SAMPLES)},
    {"cliffs_sample4_mesh", "cliffs_mesh with 4 samples, each shaded", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_SAMPLE, BENCH_ASKED_MESH_SAMPLES)},
    {"cliffs_input_fill", "fill_blend, blended by the shader", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_INPUT, BENCH_ASKED_FILL)},
    {"cliffs_input_mesh", "cliffs_mesh, blended by the shader", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_INPUT, BENCH_ASKED_MESH)},
    {"cliffs_input4_fill", "cliffs_input_fill with 4 samples", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_INPUT, BENCH_ASKED_FILL_SAMPLES)},
    {"cliffs_input4_mesh", "cliffs_input_mesh with 4 samples", bench_make_asked,
     BENCH_ASKED_VARIANT(BENCH_SHADER_INPUT, BENCH_ASKED_MESH_SAMPLES)},
};
const int bench_scene_entry_count = (int)(sizeof bench_scene_entries / sizeof *bench_scene_entries);

const int bench_attribute_components[BENCH_ATTRIBUTES] = {3, 3, 2, 4, 4, 4, 4};

bool bench_scene_make(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size)
{
    *scene = (struct bench_scene){.has_color = true};
    snprintf(why, why_size, "out of memory");
    if (entry->make(entry, scene, width, height, why, why_size)) {
        return true;
    }
    bench_scene_free(scene);
    return false;
}

void bench_scene_free(struct bench_scene *scene)
{
    for (uint32_t i = 0; scene->meshes && i < scene->mesh_count; i++) {
        free(scene->meshes[i].vertices);
        free(scene->meshes[i].instances);
        free(scene->meshes[i].indices);
    }
    for (uint32_t i = 0; scene->textures && i < scene->texture_count; i++) {
        for (int level = 0; level < BENCH_MIP_LEVELS; level++) {
            free(scene->textures[i].texels[level]);
        }
    }
    free(scene->meshes);
    free(scene->textures);
    free(scene->draws);
    free(scene->passes);
    free(scene->shared);
    bench_surfaces_free(scene->surfaces);
    bench_files_remove(scene->files);
    *scene = (struct bench_scene){0};
}

bool bench_scene_has_picture(const struct bench_scene *scene)
{
    return !scene->opens_context && !scene->opens_texture && !scene->makes_mips && !scene->translates &&
           !scene->renders_file;
}

bool bench_scene_allocate(struct bench_scene *scene)
{
    const bool simple = scene->pass_count == 0;
    scene->pass_count += simple;
    // One more than needed: calloc(0) may return NULL.
    scene->meshes = calloc((size_t)scene->mesh_count + 1, sizeof *scene->meshes);
    scene->textures = calloc((size_t)scene->texture_count + 1, sizeof *scene->textures);
    scene->draws = calloc((size_t)scene->draw_count + 1, sizeof *scene->draws);
    scene->passes = calloc(scene->pass_count, sizeof *scene->passes);
    scene->shared = calloc((size_t)scene->shared_count + 1, sizeof *scene->shared);
    if (!scene->meshes || !scene->textures || !scene->draws || !scene->passes || !scene->shared) {
        return false;
    }
    if (simple) {
        scene->passes[0] =
            (struct bench_pass){.color_count = scene->has_color,
                                .colors = {BENCH_PICTURE},
                                .depth = scene->has_color ? BENCH_PASS_DEPTH : BENCH_PASS_DEPTH_KEPT,
                                .depth_texture = BENCH_PICTURE,
                                .draw_count = scene->draw_count};
    }
    return true;
}

void bench_pass_size(const struct bench_scene *scene, const struct bench_pass *pass, int *width, int *height)
{
    const int number = pass->color_count ? pass->colors[0] : pass->depth_texture;
    if (number != BENCH_PICTURE) {
        *width = scene->textures[number].width;
        *height = scene->textures[number].height;
    }
}

static uint32_t stride(const struct bench_mesh *mesh, int first, int end)
{
    int floats = 0;
    for (int a = first; a < end; a++) {
        floats += mesh->has[a] ? bench_attribute_components[a] : 0;
    }
    return (uint32_t)floats;
}

uint32_t bench_mesh_stride(const struct bench_mesh *mesh)
{
    return stride(mesh, 0, BENCH_VERTEX_ATTRIBUTES);
}

uint32_t bench_mesh_instance_stride(const struct bench_mesh *mesh)
{
    return stride(mesh, BENCH_VERTEX_ATTRIBUTES, BENCH_ATTRIBUTES);
}

bool bench_mesh_allocate(struct bench_mesh *mesh, uint32_t vertex_count, uint32_t index_count)
{
    mesh->vertex_count = vertex_count;
    mesh->index_count = index_count;
    mesh->vertices = calloc((size_t)vertex_count * bench_mesh_stride(mesh), sizeof *mesh->vertices);
    mesh->indices = calloc(index_count, sizeof *mesh->indices);
    return mesh->vertices && mesh->indices;
}

bool bench_mesh_allocate_instances(struct bench_mesh *mesh, uint32_t instance_count)
{
    mesh->instance_count = instance_count;
    mesh->instances =
        calloc((size_t)instance_count * bench_mesh_instance_stride(mesh), sizeof *mesh->instances);
    return mesh->instances != NULL;
}

bool bench_texture_allocate(struct bench_texture *texture, int width, int height)
{
    texture->width = width;
    texture->height = height;
    for (texture->levels = 0; texture->levels < BENCH_MIP_LEVELS; texture->levels++) {
        const int level = texture->levels;
        const int w = width >> level, h = height >> level;
        if (w == 0 && h == 0) {
            break;
        }
        texture->texels[level] = malloc((size_t)(w ? w : 1) * (size_t)(h ? h : 1) * 4);
        if (!texture->texels[level]) {
            return false;
        }
    }
    return true;
}

static int level_size(int size, int level)
{
    return size >> level ? size >> level : 1;
}

// Box of 2×2; of odd sizes the last row or column counts for nothing, which no scene here can see.
static void fill_level(struct bench_texture *texture, int level)
{
    const int above = level_size(texture->width, level - 1), rows = level_size(texture->height, level - 1);
    const int width = level_size(texture->width, level), height = level_size(texture->height, level);
    const uint8_t *const from = texture->texels[level - 1];
    uint8_t *to = texture->texels[level];
    for (int y = 0; y < height; y++) {
        const int y0 = 2 * y, y1 = 2 * y + 1 < rows ? 2 * y + 1 : y0;
        for (int x = 0; x < width; x++) {
            const int x0 = 2 * x, x1 = 2 * x + 1 < above ? 2 * x + 1 : x0;
            for (int c = 0; c < 4; c++) {
                const int sum = from[4 * (y0 * above + x0) + c] + from[4 * (y0 * above + x1) + c] +
                                from[4 * (y1 * above + x0) + c] + from[4 * (y1 * above + x1) + c];
                *to++ = (uint8_t)((sum + 2) / 4);
            }
        }
    }
}

void bench_texture_fill_mips(struct bench_texture *texture)
{
    for (int level = 1; level < texture->levels; level++) {
        fill_level(texture, level);
    }
}

// Squares of 32 texels in two colours that drift over the texture, so that a texel fetched from the wrong
// place shows.
bool bench_texture_checker(struct bench_texture *texture)
{
    enum { SIZE = 1024, SQUARE = 32 };
    if (!bench_texture_allocate(texture, SIZE, SIZE)) {
        return false;
    }
    uint8_t *to = texture->texels[0];
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++, to += 4) {
            const bool light = ((x / SQUARE ^ y / SQUARE) & 1) != 0;
            to[0] = (uint8_t)(light ? 230 - x / 16 : 40 + x / 16);
            to[1] = (uint8_t)(light ? 225 : 60 + y / 16);
            to[2] = (uint8_t)(light ? 215 - y / 16 : 110);
            to[3] = 255;
        }
    }
    bench_texture_fill_mips(texture);
    return true;
}

struct bench_uniforms bench_look(const struct scene_camera *camera, double aspect, const double world[16])
{
    double view[16], projection[16], both[16], clip[16];
    scene_camera_view(camera, view);
    scene_camera_projection(camera, aspect, projection);
    scene_matrix_multiply(projection, view, both);
    scene_matrix_multiply(both, world, clip);
    struct bench_uniforms u = {
        .shininess = 40.0f,
        .light = {0.48f, 0.64f, 0.6f},
        .ambient = 0.15f,
        .color = {1.0f, 1.0f, 1.0f, 1.0f},
        .specular = 0.35f,
    };
    for (int c = 0; c < 4; c++) {
        for (int r = 0; r < 4; r++) {
            // The camera's depth is 0..1; −1..1 is 2 Z − W.
            const double value = r == 2 ? 2.0 * clip[4 * c + 2] - clip[4 * c + 3] : clip[4 * c + r];
            u.clip[4 * c + r] = (float)value;
        }
        for (int r = 0; r < 3; r++) {
            u.world[4 * r + c] = (float)world[4 * c + r];
        }
    }
    for (int i = 0; i < 3; i++) {
        u.eye[i] = (float)camera->eye[i];
    }
    return u;
}
