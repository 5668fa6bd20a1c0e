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
    SCENE_UV_STREAMS =
        10, // one for each texture of the base, the untransformed set 0, and some of the layers
    SCENE_DATA_OUTPUTS = 9,
    SCENE_SLOT_BACKDROP = 14, // slots of a draw; materials have those before
    SCENE_SLOT_ENVIRONMENT
};

enum scene_tone { SCENE_TONE_NEUTRAL, SCENE_TONE_ACES, SCENE_TONE_AGX, SCENE_TONE_NONE };

// What a light sees first, in a square map. A point p of the world lies at column and row c/w, where c = rows · (p, 1); its
// depth is reversed, 1 near and 0 far. w is 1 for a directional light and the distance along the map's axis for others.
struct scene_shadow_map {
    const float *depth; // NULL: nothing casts a shadow
    int32_t size, pitch;
    float rows[4][4]; // column, row, depth and w
    int32_t perspective;
    float unit;     // texels that a length of 1 across the light takes; perspective: at distance 1
    float range;    // depth is 1 − distance / range; perspective: range / distance
    float softness; // as the light's
};

// A light as the shader sums it. `color` holds intensity and exposure.
struct scene_shader_light {
    enum scene_light_type type;
    float position[3];
    float direction[3]; // unit, towards the light (directional), or the way it shines (spot)
    float color[3];
    float inverse_range;           // 0: unlimited
    float spot_scale, spot_offset; // of the cosine: KHR_lights_punctual's recommended falloff
    float size;                    // added to the squared roughness, as a light of some extent does
    int32_t casts;                 // shadows
    float softness;                // of them: the width of a penumbra per distance from what casts it
    float spread;                  // of a spot: tangent of half its angle
    int32_t map_count; // shadow maps: 0; 1; 6 around a point light, in the order of a cube's faces
    const struct scene_shadow_map *maps;
};

// The surroundings: a ground and a sky with a soft horizon, and soft boxes of light with the shape of a
// spherical Gaussian: amplitude · exp(sharpness · (cos − 1)). All radiances hold the exposure.
struct scene_environment {
    float up[3];
    float sky[3], ground[3];
    float lobe_direction[SCENE_LOBES][3];
    float lobe_color[SCENE_LOBES][3];
    float sharpness;  // of every lobe
    float diffuse[3]; // a lobe's irradiance / π at cosine t: diffuse[0] + diffuse[1] t + diffuse[2] t²
    // With a panorama instead of all that: a cube in texture slot SCENE_SLOT_ENVIRONMENT, whose level is roughness times
    // `levels`, and irradiance / π as 9 products with 1, x, y, z, xy, yz, zx, 3z² − 1 and x² − y².
    int32_t mapped;
    float levels, strength; // what the cube is multiplied by
    float irradiance[9][3];
};

// A plane of scene_guide, and the one of distances beside it, as shaders gather from them.
struct scene_guide_lookup {
    const float *distance, *occlusion; // occlusion NULL: there is none
    int32_t width, height, pitch;      // texels
    float scale;                       // texels of the guide per pixel of the picture
};

// Constant over a pass.
struct scene_frame {
    float eye[3];
    float forward[3]; // unit, the way the camera looks
    int32_t orthographic;
    float pixel[2];  // size of a pixel in NDC
    float samples;   // side of the sample grid: pixels of the pass per pixel of the picture
    float first_row; // of the picture, that the pass begins with
    struct scene_guide_lookup guide;
    int32_t light_count;
    const struct scene_shader_light *lights;
    struct scene_environment environment;
    enum scene_tone tone;
    int32_t display_slot, linear_slot; // colour attachments for light after and before tone mapping; −1: none
    float view_projection[16];         // for what is seen through a surface; depth does not matter
    float backdrop_levels;             // its texture's, less 1, in slot SCENE_SLOT_BACKDROP
    float line_color[3], plain_color[3]; // wireframe
    float line_half_width;               // pixels of the pass
    int32_t plain;                       // wireframe over an even surface
    int32_t peel_samples; // of the depth that fragments must be nearer than, a texture; 0: no such thing
    int32_t output_slot[SCENE_DATA_OUTPUTS]; // enum scene_data_output to colour attachment; −1: not wanted
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

// A texture coordinate set under a transform; slots that share both share a stream.
struct scene_uv_stream {
    int32_t attribute; // −1: the mesh lacks the set
    float transform[6];
};

// Constant over a draw. Places are −1 where a thing is absent.
struct scene_surface {
    const struct scene_frame *frame;
    float clip[16];   // model to clip coordinates, depth reversed: 1 near, 0 far
    float world[12];  // model to world: 3 rows of 4
    float normal[9];  // normals to world: 3 columns
    float handedness; // −1 where `world` mirrors
    int32_t attribute_normal, attribute_tangent, attribute_color;
    int32_t varying_position, varying_normal, varying_tangent, varying_color, varying_uv, varying_disc;
    int32_t varying_support; // how far above the eye the tangent plane of a corner lies, along its normal
    int32_t stream_count;
    struct scene_uv_stream streams[SCENE_UV_STREAMS];

    int32_t slot_varying[SCENE_SLOT_COUNT]; // where the stream of a slot begins; −1: no texture
    int32_t slot_unit[SCENE_SLOT_COUNT];    // the draw's texture slot
    int32_t peel_unit;                      // that of the depth, with frame->peel_samples
    const struct scene_layers *layers;      // of a layered surface
    float attenuation[3];                   // of its volume: log2 of what a unit of length leaves
    float thickness;                        // of its volume, in the world
    int32_t uv_varying;                     // untransformed set 0, for the data pass
    uint32_t shared_slots;                  // bits of those that are sampled at once, at the same coordinates
    int32_t occlusion_shared;               // occlusion reads the texel that metallic-roughness read
    float base_color[4], emissive[3];
    float metallic, roughness, normal_scale, occlusion_strength;
    int32_t alpha_mode; // enum scene_alpha_mode
    float alpha_cutoff; // fragments below are discarded; 0: none is
    int32_t double_sided, wireframe;
    int32_t shadowed; // some light has a shadow map

    uint32_t object, first_triangle;
    uint32_t triangles_per_id; // 1; 2 where a quad stands for a line or a point
    int32_t is_triangle;
    float half_width; // of lines and points, pixels of the pass
    float disc[2];    // the least half width and height of points, in clip coordinates
};

// Uniforms of the background. `top`, linear and premultiplied, is all of it where it is even; between two sRGB codes it is
// dithered, because the codes between are too few for a smooth run.
struct scene_backdrop {
    float top[4];
    float codes[2][3];    // of the first and the last row, 0..255
    float inverse_height; // of the picture
    float first_row;      // of this band, in pixels of the pass
    float inverse_side;   // pixels of the picture per pixel of the pass
    float decode[256];    // codes to light
};

// Uniforms of the passes that make ambient occlusion. View space: x right, y up, z to the viewer; a texel's centre (x, y)
// at distance d lies at d (x ray[0] + ray[1], y ray[2] + ray[3], −1), of an orthographic camera at
// (x ray[0] + ray[1], y ray[2] + ray[3], −d).
struct scene_ambient {
    const float *distance, *source; // source: what a blur reads
    int32_t width, height, pitch;
    int32_t orthographic;
    float ray[4];
    float axes[3][3];          // of the view, in the world
    float radius;              // in the world
    float texels, most_texels; // that the radius takes at distance 1; at most
    int32_t step;              // of a blur, from texel to texel: 1 or pitch
};

enum { SCENE_PREFILTER_SAMPLES = 64 };

// Uniforms of the passes that turn a panorama into a cube, and show it. A pixel at (u, v), each −1..1, right and down,
// looks along u axes[0] + v axes[1] + axes[2] in the world.
struct scene_panorama_pass {
    float axes[3][3];
    float scale[2], offset[2]; // of the pass's coordinates to u and v
    float turn[3][3];          // the world to the panorama
    float level;
    float strength;
    enum scene_tone tone;
    int32_t sample_count;
    float samples[SCENE_PREFILTER_SAMPLES][4]; // direction around the pixel's, level
};

// Uniforms of the resolve: `side`² samples of texture 0 become a pixel.
struct scene_resolve {
    int32_t side;
    int32_t straight_alpha; // divide by alpha
    float inverse_size[2];  // of the sample texture
};

// Uniforms of a layer, which has as many samples as what it goes over.
struct scene_layer {
    int32_t samples, count; // count: of textures
};

enum scene_fragment_kind {
    SCENE_FRAGMENT_LIT,      // no textures
    SCENE_FRAGMENT_TEXTURED, // any textures but a normal map
    SCENE_FRAGMENT_MAPPED,   // a normal map too
    SCENE_FRAGMENT_UNLIT,
    SCENE_FRAGMENT_GROUND,  // the shadow on it alone
    SCENE_FRAGMENT_LAYERED, // extensions of the material, and any textures
    SCENE_FRAGMENT_DATA,
    SCENE_FRAGMENT_SHADOW, // discards what casts no shadow
    SCENE_FRAGMENT_KINDS,
    SCENE_FRAGMENT_NONE = -1
};
enum scene_vertex_kind { SCENE_VERTEX_SURFACE, SCENE_VERTEX_LINE, SCENE_VERTEX_POINT, SCENE_VERTEX_KINDS };
enum scene_screen_kind {
    SCENE_SCREEN_BACKDROP,
    SCENE_SCREEN_RESOLVE,
    SCENE_SCREEN_LAYER, // textures 0 and 1 over what is there
    SCENE_SCREEN_OCCLUSION,
    SCENE_SCREEN_OCCLUSION_BLUR,
    SCENE_SCREEN_PANORAMA,  // to a face of a cube
    SCENE_SCREEN_PREFILTER, // a cube to a rougher one
    SCENE_SCREEN_SURROUNDINGS,
    SCENE_SCREEN_KINDS
};

struct scene_surface_shaders {
    rhw_vertex_function *vertex[SCENE_VERTEX_KINDS];
    rhw_fragment_function *fragment[SCENE_FRAGMENT_KINDS]; // but SCENE_FRAGMENT_LAYERED
};

struct scene_layered_shaders {
    rhw_fragment_function *fragment;
};

struct scene_screen_shaders {
    rhw_vertex_function *vertex;                             // a triangle over the whole viewport; draw(0, 3)
    rhw_fragment_function *fragment[SCENE_SCREEN_OCCLUSION]; // the kinds before that one
};

struct scene_panorama_shaders {
    rhw_fragment_function *fragment[3]; // from SCENE_SCREEN_PANORAMA on
};

struct scene_occlusion_shaders {
    rhw_fragment_function *fragment[2]; // SCENE_SCREEN_OCCLUSION, its blur
};

// Attribute 0 of surfaces is the position. Lines and points: 4 vertices per quad, attributes 0 position of
// this end, 1 position of the other end (lines), then colour and normal where present; vertex_index & 3
// tells which of the 4.
void scene_program_surface(struct rhw_program *program, enum scene_vertex_kind vertex,
                           enum scene_fragment_kind fragment);
void scene_program_screen(struct rhw_program *program, enum scene_screen_kind kind);

RHW_ISA_DECLARE(const struct scene_surface_shaders, scene_surface_shaders);
RHW_ISA_DECLARE(const struct scene_layered_shaders, scene_layered_shaders);
RHW_ISA_DECLARE(const struct scene_screen_shaders, scene_screen_shaders);
RHW_ISA_DECLARE(const struct scene_occlusion_shaders, scene_occlusion_shaders);
RHW_ISA_DECLARE(const struct scene_panorama_shaders, scene_panorama_shaders);

#endif
