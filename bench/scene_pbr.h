// SPDX-License-Identifier: MIT
// The physically based scenes: DamagedHelmet and Sponza as `rhw render` shades them, under the studio's light.
//
// rhw draws the model itself with its built-in shader, through the code that `rhw render` draws with. A peer
// draws the meshes, textures and draws of the scene, in the same order, with the same formulas in GLSL
// (shaders_glsl_pbr.c). That both pictures agree says that the two are the same.
#ifndef BENCH_SCENE_PBR_H
#define BENCH_SCENE_PBR_H

#include "bench_scene.h"
#include "draw/light.h"
#include "model.h"

enum bench_pbr_variant {
    BENCH_PBR_HELMET,
    BENCH_PBR_SPONZA,
    BENCH_PBR_HELMET_SHADOWED,
    BENCH_PBR_SPONZA_SHADOWED,
    BENCH_PBR_HAIR,
    BENCH_PBR_GLASS
};

bool bench_make_pbr(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                    char *why, size_t why_size);

// What the GLSL shaders read in every draw, as vec4s.
struct bench_surface_uniforms {
    float clip[16];            // model to clip coordinates
    float world[12];           // model to world: 3 rows of 4
    float normal[12];          // normals to world: 3 columns of 4
    float color[4];            // base colour
    float emissive[3], cutoff; // of the alpha test
    float metallic, roughness, normal_scale, occlusion_strength;
    float attenuation[3], thickness; // of glass: log2 of what a unit of length leaves
    float ior, transmission, unused[2];
};

// What they read once per frame.
struct bench_frame_uniforms {
    float eye[4];
    float light[3], light_size; // direction to the one light
    float light_color[4];
    float up[3], sharpness;
    float sky[4], ground[4];
    float lobe_direction[SCENE_LOBES][4], lobe_color[SCENE_LOBES][4];
    float diffuse[4];
    float map_rows[3][4];                  // of a shadow map: world to column, row and depth
    float map_size, unit, range, softness; // see struct scene_shadow_map
    float view_projection[16];
    float backdrop_levels, unused[3]; // of the texture that is seen through glass, less 1
};

struct bench_surfaces {
    // For rhw.
    struct scene_model *model;
    struct scene_lighting lighting;
    struct scene_frame frame,
        light_frame; // of the picture; of what is drawn before, seen by the light or as light
    bool is_shadowed, is_glass;
    struct scene_shadow_map map; // where it is; its plane is the renderer's
    double view_projection[16];  // depth reversed
    // For peers.
    struct bench_frame_uniforms frame_uniforms;
    struct bench_surface_uniforms *uniforms; // per draw
};

void bench_surfaces_free(struct bench_surfaces *surfaces); // NULL is ignored

#endif
