// SPDX-License-Identifier: MIT
// A benchmark scene as plain arrays that say nothing about who draws them, so that every renderer is given
// the same triangles, texels and numbers. docs/performance.md describes the scenes.
//
// Conventions: clip coordinates with OpenGL's depth −1..1, the one range that all renderers have; matrices
// column major; faces counter-clockwise; texture row 0 at v = 0.
#ifndef BENCH_SCENE_H
#define BENCH_SCENE_H

#include "draw/camera/camera.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { BENCH_MIP_LEVELS = 15, BENCH_DRAW_TEXTURES = 6, BENCH_PASS_COLORS = 4, BENCH_LIGHTS = 32 };

// What a vertex may have, in this order, as floats one after the other.
enum bench_attribute {
    BENCH_POSITION, // 3
    BENCH_NORMAL,   // 3
    BENCH_UV,       // 2
    BENCH_COLOR,    // 4
    BENCH_TANGENT,  // 4
    BENCH_VERTEX_ATTRIBUTES,
    // Of an instance, in an array of their own.
    BENCH_PLACE = BENCH_VERTEX_ATTRIBUTES, // 4: position and size
    BENCH_TINT,                            // 4
    BENCH_ATTRIBUTES
};
extern const int bench_attribute_components[BENCH_ATTRIBUTES];

enum bench_topology { BENCH_TRIANGLE_LIST, BENCH_LINE_LIST, BENCH_POINT_LIST };

struct bench_mesh {
    enum bench_topology topology;
    uint32_t vertex_count, index_count, instance_count; // instances: 0 is one, without attributes
    bool has[BENCH_ATTRIBUTES];
    float *vertices, *instances;
    uint32_t *indices;
};

enum bench_format {
    BENCH_RGBA8,
    BENCH_SRGB8_ALPHA8, // colours are decoded before they are filtered
    BENCH_RGBA16F,
    BENCH_R32F,
    BENCH_D32F,
    // Of pictures alone.
    BENCH_R8,
    BENCH_RG8,
    BENCH_BGRA8,
    BENCH_R16,
    BENCH_RG16,
    BENCH_RGBA16,
    BENCH_RGB10A2,
    BENCH_RGB565,
    BENCH_RGBA4,
    BENCH_RGB5A1,
    BENCH_RGBA8S, // SNORM
    BENCH_RGBA16S,
    BENCH_R16F,
    BENCH_RG16F,
    BENCH_RG32F,
    BENCH_RGBA32F,
    BENCH_RG11B10F,
    BENCH_FORMATS
};

enum bench_filter {
    BENCH_TRILINEAR, // and repeated
    BENCH_LEVELS,    // and held to the edge
    BENCH_LINEAR,    // of level 0, held to the edge
    BENCH_FETCH,     // texels by whole numbers
    BENCH_COMPARE    // the part of four texels, by their weights, that is not nearer than a reference
};

// What passes sample: texels with their whole mip chain, or what earlier passes have drawn.
struct bench_texture {
    int width, height, levels;
    enum bench_format format;
    enum bench_filter filter;
    bool target, cube;
    uint8_t *texels[BENCH_MIP_LEVELS]; // RGBA8; of a target none
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
    BENCH_SHADER_PARTICLE,    // a disc of the instance's tint, on the plane of the first two rows of `world`
    BENCH_SHADER_VOLUME,      // no colour; what faces along `color`, in the model, is moved by it
    // BENCH_SHADER_COLOR, and what a fragment function may ask for or do beside it.
    BENCH_SHADER_SCREEN,       // the colour is interpolated on the screen
    BENCH_SHADER_COORD,        // coordinates of the fragment, times `color`, are added
    BENCH_SHADER_SLOPES,       // derivatives of the first two components, times the cutoff, are added
    BENCH_SHADER_COORD_SLOPES, // both
    BENCH_SHADER_DISCARD,      // a fragment whose first component is below the cutoff is discarded
    BENCH_SHADER_MOVE,         // the fourth component, times that of `color`, is the fragment's depth
    BENCH_SHADER_MANY,         // 16 varyings of four components, parts of the colour, are squared and added
    BENCH_SHADER_SAMPLE,       // the colour is interpolated at every sample
    BENCH_SHADER_INPUT,        // the colour is weighed by its fourth component, and what is there by the rest
    // Those that read what earlier passes drew, shaders_lanes_passes.c. All but the last draw bodies.
    BENCH_SHADER_SHADOWED, // Blinn-Phong times the light that a shadow map lets through; shared: rows from the world to
                           // u, v and depth of the map, and the size of a texel
    BENCH_SHADER_REFLECT, // what a cube shows in the direction of reflection
    BENCH_SHADER_SURFACE, // colour, normal, distance and material into four targets
    BENCH_SHADER_LIGHTS, // reads these; the normal is the ray of the pixel. Shared: per light its place and 1 / radius²,
                         // and its colour
    // The physically based shader of rhw with the textures that a material has. The 8-lane form is that of
    // scene/, which `rhw render` draws with; see scene_pbr.h.
    BENCH_SHADER_PBR_BASE,   // base colour
    BENCH_SHADER_PBR_MAPPED, // metallic-roughness and normals too
    BENCH_SHADER_PBR_MASKED, // the same; a texel whose alpha is below the cutoff is discarded, and both sides show
    BENCH_SHADER_PBR_FULL, // mapped, occlusion and emission too
    // The same with the shadows of the light, from a map that is the last texture; and what draws that.
    BENCH_SHADER_PBR_BASE_SHADOWED,
    BENCH_SHADER_PBR_MAPPED_SHADOWED,
    BENCH_SHADER_PBR_MASKED_SHADOWED,
    BENCH_SHADER_PBR_FULL_SHADOWED,
    BENCH_SHADER_PBR_HAIR,        // no texture; blended, and both sides show
    BENCH_SHADER_PBR_GLASS,       // what lies behind, bent, blurred and dimmed, from the last texture
    BENCH_SHADER_PBR_BASE_LINEAR, // base colour as light, before tone mapping
    BENCH_SHADER_PBR_CAST,
    BENCH_SHADER_PBR_CAST_MASKED,
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

enum bench_depth {
    BENCH_DEPTH_OFF,
    BENCH_DEPTH_LESS,  // tested and written
    BENCH_DEPTH_TEST,  // the same, not written
    BENCH_DEPTH_EQUAL, // not written
};

enum bench_blend {
    BENCH_BLEND_OFF,
    BENCH_BLEND_OVER, // by source alpha
    BENCH_BLEND_ADD,
    BENCH_BLEND_PREMULTIPLIED // over, of colours that are multiplied by alpha already
};

enum bench_stencil {
    BENCH_STENCIL_OFF,
    // Nothing but stencil is written. Where depth fails, back faces count up and front faces down: what is left is in how
    // many closed meshes the surface lies that was there before.
    BENCH_STENCIL_COUNT,
    BENCH_STENCIL_ZERO // passes where the count is 0
};

struct bench_draw {
    enum bench_shader shader;
    enum bench_depth depth;
    enum bench_blend blend;
    enum bench_stencil stencil;
    bool cull_back;
    bool has_scissor; // of all draws of a pass, or of none
    int scissor[4];   // x, y, width, height; as far from the lower edge as from the upper one
    uint32_t mesh;
    int texture_count;
    uint32_t textures[BENCH_DRAW_TEXTURES]; // enum scene_slot numbers those of the physically based shader
    struct bench_uniforms uniforms;
};

enum { BENCH_PICTURE = -1 }; // in place of a texture's number: what the frame is for

enum bench_pass_depth {
    BENCH_PASS_NO_DEPTH, // of the peer: llvmpipe then leaves out what opaque triangles hide
    BENCH_PASS_DEPTH,    // thrown away at the end of the pass
    BENCH_PASS_DEPTH_STENCIL,
    BENCH_PASS_DEPTH_KEPT // in `depth_texture`
};

// One after the other, each with a run of the scene's draws. Everything is cleared: depth to 1, stencil to 0.
struct bench_pass {
    int color_count;
    int colors[BENCH_PASS_COLORS]; // textures, or BENCH_PICTURE
    int face;                      // of colors[0], where that is a cube
    enum bench_pass_depth depth;
    int depth_texture;
    bool makes_levels; // of colors[0], after it
    float clear[4]; // of all colours. In the picture alpha 0, which no shader writes, tells what is not covered
    uint32_t first_draw, draw_count;
};

// How far two images may be apart and still show the same; agreement.h says how it is measured. The makers
// say why where it is more than 1/255 and no pixel.
struct bench_tolerance {
    int color;       // 1/255
    int alpha;       // the same, where alpha may differ by more than colour
    double outliers; // fraction of pixels that may differ by more, or be covered in one image only
    double depth;    // of the depth range
};

// What the rate of a scene counts.
enum bench_unit { BENCH_FRAGMENTS, BENCH_TRIANGLES, BENCH_DRAWS, BENCH_POINTS, BENCH_LINES };

struct bench_scene {
    uint32_t mesh_count, texture_count, draw_count, pass_count;
    struct bench_mesh *meshes;
    struct bench_texture *textures;
    struct bench_draw *draws;
    struct bench_pass *passes; // the last one draws the picture
    // What the shaders of shaders_lanes_passes.c read behind the uniforms of a draw, the same for all of them.
    uint32_t shared_count;
    float (*shared)[4];
    struct bench_surfaces *surfaces; // of the physically based shader, scene_pbr.h; NULL: none
    bool has_color;                  // of the picture; else it is its depth
    enum bench_format picture;       // its colour; scenes with `surfaces` have one of their own
    // Every fragment is to be shaded, hidden or not: fewer than `work` fragments are a failure.
    bool shades_all;
    // rhw records the pass of the scene, which has one, once, and runs it in each frame; and keeps its triangles besides.
    bool replays, keeps_triangles;
    // Before each draw the first vertex of its mesh is written, as it is.
    bool writes_between;
    // No picture to look at: the time is that of opening and closing rhw, or an empty texture; of making the mip chain
    // of the first texture; of a pipeline, from SPIR-V on; or of the program that renders this file.
    bool opens_context, opens_texture, makes_mips, translates;
    const char *renders_file;
    struct bench_files *files; // what was made for it, scene_process.h; NULL: nothing
    int max_anisotropy;        // of all textures; 0: off
    int samples;               // of a pixel of the picture, resolved at the end of a frame; 0: one
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

// For makers. Zeroed arrays of the numbers that the scene names; false without memory. A scene that names no passes
// has one, which draws the picture with all draws and throws depth away, or keeps it where that is the picture.
bool bench_scene_allocate(struct bench_scene *scene);
bool bench_mesh_allocate(struct bench_mesh *mesh, uint32_t vertex_count, uint32_t index_count);
bool bench_mesh_allocate_instances(struct bench_mesh *mesh, uint32_t instance_count);
// Floats of a vertex, and of an instance.
uint32_t bench_mesh_stride(const struct bench_mesh *mesh);
uint32_t bench_mesh_instance_stride(const struct bench_mesh *mesh);
// 1024² checker with its mip chain.
bool bench_texture_checker(struct bench_texture *texture);
// Allocates all levels below a width × height of level 0 and fills them with a box filter.
bool bench_texture_allocate(struct bench_texture *texture, int width, int height);
void bench_texture_fill_mips(struct bench_texture *texture);

// Size of what a pass draws into: `width` × `height` for the picture.
void bench_pass_size(const struct bench_scene *scene, const struct bench_pass *pass, int *width, int *height);

// Sets the matrices, the eye and the usual light for a model that stands at `world` in front of `camera`.
struct bench_uniforms bench_look(const struct scene_camera *camera, double aspect, const double world[16]);

#endif
