// SPDX-License-Identifier: MIT
// What the drawing code and the built-in shaders agree on: uniforms, the places of varyings, and the
// table of shader functions that every instruction set has.
//
// Which attributes a mesh has and which varyings a material needs is decided once per draw and written into
// the uniforms as positions. A branch on a uniform costs one well predicted jump per 8 fragments, so the
// functions come in few variants: one for each amount of work per fragment.
#ifndef SCENE_SHADERS_H
#define SCENE_SHADERS_H

#include "model.h"
#include "rhw/isa.h"
#include "rhw/types.h"

enum {
    SCENE_LOBES = 3, // soft boxes of the environment
    // Streams: one for each texture of the base, the untransformed set 0, and some of the layers.
    SCENE_UV_STREAMS = 10,
    SCENE_DATA_OUTPUTS = 9,
    SCENE_SLOT_BACKDROP = 14, // slots of a draw from here on; materials have the slots before
    SCENE_SLOT_ENVIRONMENT
};

enum scene_tone { SCENE_TONE_NEUTRAL, SCENE_TONE_ACES, SCENE_TONE_AGX, SCENE_TONE_NONE };

// A square map of what a light sees first. A point p of the world lies at column and row c/w, where c = rows · (p, 1).
// Its depth is reversed, 1 near and 0 far. w is 1 for a directional light and the distance along the map's axis for
// other lights.
struct scene_shadow_map {
    const float *depth; // NULL if nothing casts a shadow
    int32_t size, pitch;
    float rows[4][4]; // column, row, depth and w
    int32_t perspective;
    float unit;     // texels that a length of 1 across the light takes, in perspective at distance 1
    float range;    // depth is 1 − distance / range; in perspective it is range / distance
    float softness; // softness of the light
};

// A light as the shader sums it. `color` holds intensity and exposure.
struct scene_shader_light {
    enum scene_light_type type;
    float position[3];
    float direction[3]; // unit direction towards a directional light, or the way that a spot shines
    float color[3];
    float inverse_range; // 0 if the range is unlimited
    float spot_scale,
        spot_offset; // factor and offset of the cosine, for KHR_lights_punctual's recommended falloff
    float size;      // extent of the light, which is added to the squared roughness
    int32_t casts;   // the light casts shadows
    float softness;  // width of a penumbra per distance from what casts the shadow
    float spread;    // tangent of half the angle of a spot
    // Number of shadow maps: 0, 1, or 6 around a point light, in the order of a cube's faces.
    int32_t map_count;
    const struct scene_shadow_map *maps;
};

// The surroundings are a ground and a sky with a soft horizon, and soft boxes of light. A box has the shape of a
// spherical Gaussian: amplitude · exp(sharpness · (cos − 1)). All radiances hold the exposure.
struct scene_environment {
    float up[3];
    float sky[3], ground[3];
    float lobe_direction[SCENE_LOBES][3];
    float lobe_color[SCENE_LOBES][3];
    float sharpness;  // sharpness of every lobe
    float diffuse[3]; // a lobe's irradiance / π at cosine t: diffuse[0] + diffuse[1] t + diffuse[2] t²
    // `mapped` is set if a panorama takes the place of all members above. The panorama is a cube in texture slot
    // SCENE_SLOT_ENVIRONMENT, whose level is roughness times `levels`. `irradiance` is irradiance / π as 9 products
    // with 1, x, y, z, xy, yz, zx, 3z² − 1 and x² − y².
    int32_t mapped;
    float levels, strength; // `strength` is what the cube is multiplied by
    float irradiance[9][3];
};

// A plane of scene_guide, and the plane of distances beside it, as shaders gather from them.
struct scene_guide_lookup {
    const float *distance, *occlusion; // `occlusion` is NULL if there is none
    int32_t width, height, pitch;      // texels
    float scale;                       // texels of the guide per pixel of the picture
};

// What is constant over a pass.
struct scene_frame {
    float eye[3];
    float forward[3]; // unit direction in which the camera looks
    float unit;       // factor, a power of two, that makes lengths from the eye moderate
    int32_t orthographic;
    float pixel[2];  // size of a pixel in NDC
    float samples;   // side of the sample grid: pixels of the pass per pixel of the picture
    float first_row; // row of the picture that the pass begins with
    struct scene_guide_lookup guide;
    int32_t light_count;
    const struct scene_shader_light *lights;
    struct scene_environment environment;
    enum scene_tone tone;
    int32_t display_slot,
        linear_slot;           // colour attachments for light after and before tone mapping; −1 for none
    float view_projection[16]; // matrix for what is seen through a surface; its depth does not matter
    float backdrop_levels;     // levels of the texture in slot SCENE_SLOT_BACKDROP, less 1
    float line_color[3], plain_color[3]; // colours of a wireframe
    float line_half_width;               // half the width of a line, pixels of the pass
    int32_t plain;                       // the wireframe is over an even surface
    // The samples of the texture of depths that fragments must be nearer than. It is 0 if there is no texture.
    int32_t peel_samples;
    int32_t peel_behind; // fragments must be farther than these depths instead, wherever there is one
    int32_t output_slot
        [SCENE_DATA_OUTPUTS]; // colour attachment of each enum scene_data_output; −1 if it is not wanted
};

enum scene_data_output {
    SCENE_DATA_DEPTH,
    SCENE_DATA_DISTANCE,
    SCENE_DATA_NORMAL,
    SCENE_DATA_POSITION,
    SCENE_DATA_UV,
    SCENE_DATA_OBJECT,
    SCENE_DATA_TRIANGLE,
    SCENE_DATA_BARYCENTRIC,
    SCENE_DATA_OVERDRAW
};

// A texture coordinate set under a transform. Slots that share both share a stream.
struct scene_uv_stream {
    int32_t attribute; // −1 if the mesh lacks the set
    float transform[6];
};

// What is constant over a draw. Places are −1 where a thing is absent.
struct scene_surface {
    const struct scene_frame *frame;
    float clip[16];   // matrix from the model to clip coordinates, depth reversed: 1 near, 0 far
    float world[12];  // matrix from the model to the world: 3 rows of 4
    float normal[9];  // matrix of normals to the world: 3 columns
    float handedness; // −1 if `world` mirrors
    int32_t attribute_normal, attribute_tangent, attribute_color;
    int32_t varying_position, varying_normal, varying_tangent, varying_color, varying_uv, varying_disc;
    int32_t varying_support; // height of a corner's tangent plane above the eye, along its normal
    int32_t stream_count;
    struct scene_uv_stream streams[SCENE_UV_STREAMS];

    // Place at which a slot's stream begins; −1 if there is no texture.
    int32_t slot_varying[SCENE_SLOT_COUNT];
    int32_t slot_unit[SCENE_SLOT_COUNT]; // texture slot of the draw
    int32_t peel_unit;                   // texture slot of the depth, with frame->peel_samples
    const struct scene_layers *layers;   // layers of a layered surface
    float attenuation[3];                // log2 of what a unit of length of the volume leaves of light
    float thickness;                     // thickness of the volume in the world
    int32_t uv_varying;                  // place of the untransformed set 0, for the data pass
    uint32_t shared_slots;    // bits of the slots that are sampled at once, at the same coordinates
    int32_t occlusion_shared; // occlusion reads the texel that metallic-roughness read
    float base_color[4], emissive[3];
    float metallic, roughness, normal_scale, occlusion_strength;
    int32_t alpha_mode; // enum scene_alpha_mode
    float alpha_cutoff; // fragments with less alpha are discarded; at 0 none is
    int32_t double_sided, wireframe;
    int32_t inside_out; // the normals of the mesh are on the other side of its facets
    int32_t shadowed;   // some light has a shadow map
    int32_t casts;      // the surface casts shadows

    uint32_t object, first_triangle;
    uint32_t triangles_per_id; // 2 where a quad stands for a line or a point, and 1 elsewhere
    int32_t is_triangle;
    float half_width; // half the width of lines and points, pixels of the pass
    float disc[2];    // the least half width and height of points, in clip coordinates
};

// Uniforms of the background. `top`, linear and premultiplied, is all of the background if it is even. Between two sRGB
// codes the background is dithered in 8 bits, because the codes between are too few for a smooth run there.
struct scene_backdrop {
    int32_t smooth; // the picture has more than 8 bits, so that the background is not dithered
    float top[4];
    float codes[2][3];    // codes of the first and the last row, 0..255
    float inverse_height; // 1 / height of the picture
    float first_row;      // first row of this band, in pixels of the pass
    float inverse_side;   // pixels of the picture per pixel of the pass
    float decode[256];    // light of each code
};

// Uniforms of the passes that make ambient occlusion. In view space x is right, y is up, and z is towards the viewer. A
// texel's centre (x, y) at distance d lies at d (x ray[0] + ray[1], y ray[2] + ray[3], −1). For an orthographic camera
// it lies at (x ray[0] + ray[1], y ray[2] + ray[3], −d).
struct scene_ambient {
    const float *distance, *source; // `source` is what a blur reads
    int32_t width, height, pitch;
    int32_t orthographic;
    float ray[4];
    float axes[3][3];          // axes of the view in the world
    float unit;                // factor, a power of two, that makes the radius moderate
    float radius;              // radius in the world, times the unit
    float texels, most_texels; // texels that the radius takes at distance 1, and at most
    int32_t step;              // step of a blur from texel to texel: 1 or pitch
};

enum { SCENE_PREFILTER_SAMPLES = 64 };

// Uniforms of the passes that turn a panorama into a cube, and of the pass that shows it. A pixel at (u, v), each
// −1..1, right and down, looks along u axes[0] + v axes[1] + axes[2] in the world.
struct scene_panorama_pass {
    float axes[3][3];
    float scale[2], offset[2]; // factors and offsets from the pass's coordinates to u and v
    float turn[3][3];          // matrix from the world to the panorama
    float level;
    float strength;
    enum scene_tone tone;
    int32_t sample_count;
    float samples[SCENE_PREFILTER_SAMPLES][4]; // direction around the pixel's, and level
};

// Uniforms of the resolve: `side`² samples of texture 0 become a pixel.
struct scene_resolve {
    int32_t side;
    int32_t straight_alpha; // the colour is divided by alpha
    float inverse_size[2];  // 1 / size of the sample texture
};

// Uniforms of a layer, which has as many samples as the target that it goes over.
struct scene_layer {
    int32_t samples, count; // `count` is the number of textures
};

enum scene_fragment_kind {
    SCENE_FRAGMENT_LIT,      // no textures
    SCENE_FRAGMENT_TEXTURED, // any textures but a normal map
    SCENE_FRAGMENT_MAPPED,   // any textures, with a normal map
    SCENE_FRAGMENT_UNLIT,
    SCENE_FRAGMENT_GROUND,  // ground, of which only the shadow on it shows
    SCENE_FRAGMENT_LAYERED, // extensions of the material, and any textures
    SCENE_FRAGMENT_DATA,
    SCENE_FRAGMENT_GUIDE,  // distance, and normals of the guide
    SCENE_FRAGMENT_SHADOW, // fragments that cast no shadow are discarded
    SCENE_FRAGMENT_KINDS,
    SCENE_FRAGMENT_NONE = -1
};
enum scene_vertex_kind { SCENE_VERTEX_SURFACE, SCENE_VERTEX_LINE, SCENE_VERTEX_POINT, SCENE_VERTEX_KINDS };
enum scene_screen_kind {
    SCENE_SCREEN_BACKDROP,
    SCENE_SCREEN_RESOLVE,
    SCENE_SCREEN_LAYER, // textures 0 and 1 over what the target has
    SCENE_SCREEN_OCCLUSION,
    SCENE_SCREEN_OCCLUSION_BLUR,
    SCENE_SCREEN_PANORAMA,  // panorama to a face of a cube
    SCENE_SCREEN_PREFILTER, // cube to a rougher cube
    SCENE_SCREEN_SURROUNDINGS,
    SCENE_SCREEN_KINDS
};

struct scene_surface_shaders {
    rhw_vertex_function *vertex[SCENE_VERTEX_KINDS];
    rhw_fragment_function *fragment[SCENE_FRAGMENT_KINDS]; // all kinds but SCENE_FRAGMENT_LAYERED
};

struct scene_layered_shaders {
    rhw_fragment_function *fragment;
};

struct scene_screen_shaders {
    rhw_vertex_function *vertex;                             // a triangle over the whole viewport; draw(0, 3)
    rhw_fragment_function *fragment[SCENE_SCREEN_OCCLUSION]; // kinds before SCENE_SCREEN_OCCLUSION
};

struct scene_panorama_shaders {
    rhw_fragment_function *fragment[3]; // kinds from SCENE_SCREEN_PANORAMA on
};

struct scene_occlusion_shaders {
    rhw_fragment_function *fragment[2]; // SCENE_SCREEN_OCCLUSION and its blur
};

// Put the functions of surfaces into a program. Attribute 0 of surfaces is the position. Lines and points have 4
// vertices per quad. Their attribute 0 is the position of this end, and attribute 1 of lines is the position of the
// other end. Colour and normal follow where they are present. vertex_index & 3 tells which of the 4 a vertex is.
void scene_program_surface(struct rhw_program *program, enum scene_vertex_kind vertex,
                           enum scene_fragment_kind fragment);
void scene_program_screen(struct rhw_program *program, enum scene_screen_kind kind);

RHW_ISA_DECLARE(const struct scene_surface_shaders, scene_surface_shaders);
RHW_ISA_DECLARE(const struct scene_layered_shaders, scene_layered_shaders);
RHW_ISA_DECLARE(const struct scene_screen_shaders, scene_screen_shaders);
RHW_ISA_DECLARE(const struct scene_occlusion_shaders, scene_occlusion_shaders);
RHW_ISA_DECLARE(const struct scene_panorama_shaders, scene_panorama_shaders);

#endif
