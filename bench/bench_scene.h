// SPDX-License-Identifier: MIT
// A benchmark scene as plain arrays that say nothing about who draws them, so that every renderer is given
// the same triangles, texels and numbers. docs/performance.md describes the scenes.
//
// Conventions: clip coordinates with OpenGL's depth −1..1, the one range that all renderers have; matrices
// column major; faces counter-clockwise; texture row 0 at v = 0.
#ifndef BENCH_SCENE_H
#define BENCH_SCENE_H

#include "camera.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { BENCH_MIP_LEVELS = 15, BENCH_DRAW_TEXTURES = 5 };

// What a vertex may have, in this order, as floats one after the other.
enum bench_attribute {
    BENCH_POSITION, // 3
    BENCH_NORMAL,   // 3
    BENCH_UV,       // 2
    BENCH_COLOR,    // 4
    BENCH_TANGENT,  // 4
    BENCH_ATTRIBUTES
};

struct bench_mesh {
    uint32_t vertex_count, index_count;
    bool has[BENCH_ATTRIBUTES];
    float *vertices;
    uint32_t *indices; // triangle list, or points
    bool points;
};

// RGBA8 with its whole mip chain; repeated, trilinear.
struct bench_texture {
    int width, height, levels;
    bool srgb; // colours are decoded before they are filtered
    uint8_t *texels[BENCH_MIP_LEVELS];
};

// The pairs of shaders; both forms of each stand in shaders_lanes.c (8 lanes) and shaders_glsl.c.
enum bench_shader {
    BENCH_SHADER_FLAT,      // one colour, a uniform
    BENCH_SHADER_LITERAL,   // one colour, which the shader itself names
    BENCH_SHADER_COLOR,     // interpolated colour
    BENCH_SHADER_TEXTURE,   // a texel
    BENCH_SHADER_LIT,       // Blinn-Phong
    BENCH_SHADER_LIT_POINT, // the same for points, of one pixel
    BENCH_SHADER_LIT_FLAT, // Blinn-Phong; the colour is a flat varying, and the fragment looks at its instance
    BENCH_SHADER_LIT_TEXTURE, // Blinn-Phong, texel times colour
    BENCH_SHADER_LIT_MASKED,  // the same; a texel whose alpha is below the cutoff is discarded
    BENCH_SHADER_DEPTH,       // no colour at all
    // The physically based shader of rhw with the textures that a material has. The 8-lane form is that of
    // scene/, which `rhw render` draws with; see scene_pbr.h.
    BENCH_SHADER_PBR_BASE,   // base colour
    BENCH_SHADER_PBR_MAPPED, // metallic-roughness and normals too
    BENCH_SHADER_PBR_MASKED, // the same; a texel whose alpha is below the cutoff is discarded, and both sides show
    BENCH_SHADER_PBR_FULL, // mapped, occlusion and emission too
    BENCH_SHADERS
};

// What all of these shaders read; a multiple of four floats, which GLSL sees as vec4s.
struct bench_uniforms {
    float clip[16];  // model to clip coordinates
    float world[12]; // model to world: 3 rows of 4; normals too, so rotations and even scales only
    float eye[3], shininess;
    float light[3]; // unit, towards the light
    float ambient;
    float color[4];
    float specular, cutoff, unused[2];
};

struct bench_draw {
    enum bench_shader shader;
    uint32_t mesh;
    int texture_count;
    uint32_t textures[BENCH_DRAW_TEXTURES]; // enum scene_slot numbers those of the physically based shader
    bool cull_back;
    struct bench_uniforms uniforms;
};

// How far two images may be apart and still show the same; agreement.h says how it is measured. The makers
// say why where it is more than 1/255 and no pixel.
struct bench_tolerance {
    int color;       // 1/255
    double outliers; // fraction of pixels that may differ by more, or be covered in one image only
    double depth;    // of the depth range
};

// What the rate of a scene counts.
enum bench_unit { BENCH_FRAGMENTS, BENCH_TRIANGLES, BENCH_DRAWS, BENCH_POINTS };

struct bench_scene {
    uint32_t mesh_count, texture_count, draw_count;
    struct bench_mesh *meshes;
    struct bench_texture *textures;
    struct bench_draw *draws;
    struct bench_surfaces *surfaces; // of the physically based shader, scene_pbr.h; NULL: none
    bool has_color, depth_test, blends;
    // Every fragment is to be shaded, hidden or not: fewer than `work` fragments are a failure.
    bool shades_all;
    // No picture to look at: the time is that of opening and closing rhw, or an empty texture; of making the mip chain
    // of the first texture; or of the program that renders this file.
    bool opens_context, opens_texture, makes_mips;
    const char *renders_file;
    // The peer's target has no depth buffer beside it: llvmpipe then leaves out what opaque triangles hide.
    bool without_depth;
    int max_anisotropy; // of all textures; 0: off
    int samples;        // of a pixel, resolved at the end of a frame; 0: one
    float clear[4];     // alpha 0, which no shader writes: it tells what is covered
    struct bench_tolerance tolerance;
    enum bench_unit unit;
    double work; // units per frame
};

// One scene that can be made. `make` fills a zeroed scene for a target of that size; on failure it returns
// false and a line in `why`, and bench_scene_free clears up.
struct bench_scene_entry {
    const char *name, *what;
    bool (*make)(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                 char *why, size_t why_size);
    int variant; // of scenes that share a maker
};

extern const struct bench_scene_entry bench_scene_entries[];
extern const int bench_scene_entry_count;

bool bench_scene_make(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size);
void bench_scene_free(struct bench_scene *scene);
// Whether renderers draw it; else it is of rhw alone.
bool bench_scene_has_picture(const struct bench_scene *scene);

// For makers. Zeroed arrays of the numbers that the scene names; false without memory.
bool bench_scene_allocate(struct bench_scene *scene);
bool bench_mesh_allocate(struct bench_mesh *mesh, uint32_t vertex_count, uint32_t index_count);
uint32_t bench_mesh_stride(const struct bench_mesh *mesh); // floats
// 1024² checker with its mip chain.
bool bench_texture_checker(struct bench_texture *texture);
// Allocates all levels below a width × height of level 0 and fills them with a box filter.
bool bench_texture_allocate(struct bench_texture *texture, int width, int height);
void bench_texture_fill_mips(struct bench_texture *texture);

// Sets the matrices, the eye and the usual light for a model that stands at `world` in front of `camera`.
struct bench_uniforms bench_look(const struct scene_camera *camera, double aspect, const double world[16]);

#endif
