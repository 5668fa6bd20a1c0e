// SPDX-License-Identifier: MIT
// What of a model a picture shows, and how: everything that the command line says about one.
#ifndef SCENE_VIEW_H
#define SCENE_VIEW_H

#include <stddef.h>

#include "draw/camera/camera.h"
#include "draw/shading/scene_shaders.h"

struct scene_panorama;

/// What a draw gives; or them together. Rows top to bottom, tightly packed. Data outputs show the nearest
/// surface; a surface of alpha mode BLEND counts where its opacity is at least one half.
enum scene_output {
    SCENE_OUTPUT_COLOR = 1,    ///< tone-mapped sRGB, RGBA8, straight alpha
    SCENE_OUTPUT_LINEAR = 2,   ///< light before tone mapping, RGBA32F, premultiplied, without background
    SCENE_OUTPUT_DEPTH = 4,    ///< R32F: NDC depth, 0 near to 1 far; 1 where nothing is
    SCENE_OUTPUT_DISTANCE = 8, ///< R32F: world units along the view axis; +infinity where nothing is
    SCENE_OUTPUT_NORMAL = 16, ///< RGBA32F: unit world normal as shaded, turned to the viewer; w 1; else all 0
    SCENE_OUTPUT_POSITION = 32, ///< RGBA32F: world position, from the origin of the pictures; w as above
    SCENE_OUTPUT_UV = 64,       ///< RGBA32F: first texture coordinate set u, v, then 0; w as above
    SCENE_OUTPUT_OBJECT = 128,  ///< R32_UINT: scene_instance.object; 0 where nothing is
    SCENE_OUTPUT_TRIANGLE =
        256, ///< R32_UINT: 1 + number of the triangle (line, point), instances in their order
    SCENE_OUTPUT_BARYCENTRIC = 512, ///< RGBA32F: perspective-correct a, b, c; w as above
    SCENE_OUTPUT_DISPLAY = 1024,    ///< RGBA32F: COLOR before it is sRGB encoded and rounded to 8 bits
    SCENE_OUTPUT_ALL = 2047,        ///< all outputs of what is seen; those below tell of the work
    SCENE_OUTPUT_OVERDRAW =
        2048, ///< R32F: how many surfaces lie above each other at the pixel's centre, seen or not
    SCENE_OUTPUT_TILES = 4096, ///< R32_UINT: triangles that the pixel's tile has in the colour pass
    SCENE_OUTPUT_PLAN =
        8192, ///< R32_UINT: or-ed rhw_tile_order of the model in that tile; 0: none of it is there
    SCENE_OUTPUT_WORK = SCENE_OUTPUT_OVERDRAW | SCENE_OUTPUT_TILES | SCENE_OUTPUT_PLAN
};

enum scene_wireframe {
    SCENE_WIREFRAME_NONE,
    SCENE_WIREFRAME_OVER, ///< lines over the shaded surface
    SCENE_WIREFRAME_PLAIN ///< lines over one even surface
};

enum scene_background {
    SCENE_BACKGROUND_DEFAULT, ///< a soft vertical gradient
    SCENE_BACKGROUND_COLOR,
    SCENE_BACKGROUND_PANORAMA, ///< needs one
    SCENE_BACKGROUND_TRANSPARENT
};

/// How surfaces of alpha mode BLEND lie above each other.
enum scene_transparency {
    SCENE_TRANSPARENCY_SORTED, ///< meshes by their middle, and the triangles of each by theirs, from back to front
    SCENE_TRANSPARENCY_EXACT ///< the surfaces of every sample by their depth there, peeled one after the other
};

struct scene_explain;

struct scene_view {
    int width, height; ///< 1..RHW_MAX_TARGET_SIZE
    int samples; ///< per pixel for colour: 1, 2, 4, 8 or 16, at each of which surfaces are tested, not shaded
    int supersample; ///< pixels drawn and shaded for one of the picture: 1, 4, 9 or 16, a regular grid
    struct scene_camera camera;
    enum scene_axis up; ///< where the sky of the studio is
    enum rhw_qualifier
        interpolate; ///< qualifier of all varyings: SMOOTH; NOPERSPECTIVE shows what is wrong with it
    enum scene_wireframe wireframe;
    enum scene_background background;
    uint8_t background_color[3]; ///< sRGB, for SCENE_BACKGROUND_COLOR
    bool default_lights;         ///< leave the lights of the file off
    bool no_lights;              ///< with default_lights: the surroundings alone
    bool shadows;                ///< whether the lights cast shadows
    bool ground;                 ///< below the model, of which only the shadow on it shows, in colour outputs
    bool ambient_occlusion;      ///< what stands near dims the light of the surroundings
    const struct scene_panorama
        *panorama;            ///< lights the model instead of the studio; NULL: none. Outlives the scene
    double panorama_rotation; ///< degrees about what is up, against the clock as seen from there
    /// Shades the triangles of COLOR and DISPLAY instead of their materials (material_program.h), not tone-mapped; or
    /// NULL. It outlives the scene, which draws with no other.
    const struct rhw_program *program;
    enum scene_transparency transparency;
    enum scene_tone tone; ///< how light becomes a picture
    double exposure;      ///< stops, added to what is chosen for the lights; −20..20
    uint32_t outputs;     ///< scene_output, at least one
    /// Sample whose history is told while colour is drawn, without supersampling and SORTED; NULL: none.
    const struct scene_explain *explain;
    /// Asked all the while, on the thread that draws; false: the draw is given up (RHW_ERROR_GIVEN_UP). NULL: nobody is
    /// asked.
    bool (*goes_on)(void *user);
    void *user;
    /// Gives the memory of a picture, which free() gives back, on the thread that draws; NULL: malloc does.
    void *(*allocate)(size_t size);
};

/// 1280×720, one sample, the whole model fitted, gradient, colour.
struct scene_view scene_view_default(const struct scene_model *model);

/// False with one line in `error` when the view cannot be drawn (a usage error); names the rule.
bool scene_view_check(const struct scene_view *view, char *error, size_t error_size);

/// The side of the grid of `supersample` pixels; 0 where that is no square of 1..4.
int scene_view_grid_side(const struct scene_view *view);

#endif
