// SPDX-License-Identifier: MIT
// A program of the caller's own that shades triangles instead of their materials, in colours. It finds what is here
// where programs of rhw/spirv.h find theirs: attributes by location, a uniform block and a texture in set 0, and push
// constants. Lines, points, the ground and what light passes through keep the shaders of this folder. Shadows,
// occlusion and data do not ask the program.
#ifndef SCENE_MATERIAL_PROGRAM_H
#define SCENE_MATERIAL_PROGRAM_H

#include "surface_pass.h"

/// Locations of the vertex shader. What a mesh lacks is a normal of 0, 0, 1, a place 0, 0 and a colour of 1, 1, 1, 1.
enum scene_program_attribute {
    SCENE_PROGRAM_POSITION, ///< vec3
    SCENE_PROGRAM_NORMAL,   ///< vec3
    SCENE_PROGRAM_UV,       ///< vec2, that the base colour's texture is read with
    SCENE_PROGRAM_COLOR,    ///< vec4
    SCENE_PROGRAM_ATTRIBUTES
};

/// Bindings of set 0. The layout that the program is linked with has one element of each.
enum scene_program_binding {
    SCENE_PROGRAM_BLOCK,      ///< struct scene_program_block
    SCENE_PROGRAM_BASE_COLOR, ///< texture and sampler; white where there is none
    SCENE_PROGRAM_BINDINGS
};

/// The uniform block, as std140 has it.
struct scene_program_block {
    float camera[4];      ///< where the eye is, and 1; without perspective the unit direction to it, and 0
    float light[4];       ///< where the first light is, and 1; or the unit direction to it, and 0
    float light_color[3]; ///< 0, 0, 0 without a light
    float alpha_cutoff;   ///< fragments of less alpha are holes; 0: none is
    float base_color[4], emissive[3];
    float metallic, roughness, unused[3];
};

/// The push constants: what places a vertex, columns of 4 floats.
struct scene_program_place {
    float clip[16], world[16], normal[12];
    float uv[2][4]; ///< rows of the texture's transform
};

/// What draws with a program have in memory, kept from draw to draw. Zeroed: nothing.
struct scene_program_draws {
    const struct rhw_program *program; ///< the program of the view under way, or NULL
    struct scene_program_item *items;  ///< what each instance has
    uint32_t count;
    rhw_buffer defaults; ///< attributes that a mesh lacks
    rhw_texture white;
    rhw_sampler sampler;
};

/// Make room for the instances of a model. No pass is under way.
enum rhw_result scene_program_prepare(struct scene_program_draws *draws, const struct scene_upload *upload,
                                      const struct rhw_program *program);
void scene_program_destroy(rhw_context *context, struct scene_program_draws *draws);

/// Change the key of an instance to that of the program. Return false where the program does not shade it.
bool scene_program_lay_out(const struct scene_upload *upload, const struct scene_surface_pass *def,
                           uint32_t instance, struct scene_surface_key *key);
/// Set what the program reads of an instance that was laid out.
enum rhw_result scene_program_bind(const struct scene_upload *upload, const struct scene_surface_pass *def,
                                   rhw_pass pass, uint32_t instance, const struct scene_surface *surface);
/// Put the program and its vertices into the definition of a pipeline with such a key.
void scene_program_describe(const struct scene_surface_key *key, const struct rhw_program *program,
                            struct rhw_pipeline_def *def);

#endif
