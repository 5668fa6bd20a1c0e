// SPDX-License-Identifier: MIT
// What the files of a Mesa driver under measurement share: renderer_gles.c draws frames, renderer_gles_upload.c makes
// the meshes, textures and programs of a scene, renderer_gles_target.c what its passes draw into.
#ifndef BENCH_RENDERER_GLES_H
#define BENCH_RENDERER_GLES_H

#include "bench_scene.h"
#include "gles.h"
#include "renderer.h"

struct gles_shader {
    GLuint program;
    GLint uniforms;
};

// What a pass draws into. Passes of one size that throw their depth away one after the other have the same
// renderbuffer for it.
struct gles_target {
    GLuint framebuffer;
    GLuint depth; // the renderbuffer, and 0 where depth is a texture or there is none
    int width, height;
};

struct gles_state {
    struct gles gl;
    const struct bench_scene *scene;
    int width, height;
    struct gles_shader shaders[BENCH_SHADERS]; // made when first needed, kept
    GLuint show_depth;                         // program of gles_read_depth; 0: not made yet
    GLuint color, depth;                       // the picture: a renderbuffer, and a texture where depth is it
    GLuint sampled, sampled_color, sampled_depth;    // what is drawn into with several samples; else 0
    struct gles_target *targets;                     // per pass
    GLuint *arrays, *vertices, *indices, *instances; // per mesh
    GLuint *textures;
    float *uniforms;         // of all draws, and where those of each begin
    size_t *uniform_offsets; // one more than draws
};

// Makes everything of `state->scene`. What there is after a failure is for gles_drop.
bool gles_upload(struct gles_state *state);
void gles_drop(struct gles_state *state);

// After the textures.
bool gles_targets_make(struct gles_state *state);
void gles_targets_drop(struct gles_state *state);
// The samples of the picture into its renderbuffer.
void gles_resolve(const struct gles_state *state);
// Rows as they stand in memory.
bool gles_read_color(const struct gles_state *state, uint8_t *color);
bool gles_read_depth(struct gles_state *state, float *depth);

#endif
