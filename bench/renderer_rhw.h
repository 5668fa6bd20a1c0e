// SPDX-License-Identifier: MIT
// What the files of rhw under measurement share: renderer_rhw.c draws frames, renderer_rhw_upload.c makes what a scene
// needs for them.
#ifndef BENCH_RENDERER_RHW_H
#define BENCH_RENDERER_RHW_H

#include "bench_scene.h"
#include "rhw/rhw.h"
#include "rhw/spirv.h"
#include "draw/surface.h"
#include "draw/render_target.h"

enum { BENCH_FILTERS = BENCH_COMPARE + 1 };

// What a draw gives to translated shaders. They find uniforms in set 0 and textures in set 1.
struct bench_draw_frame {
    struct rhw_shader_frame frame;
    struct rhw_binding uniforms[2], textures[BENCH_DRAW_TEXTURES];
    float *numbers; // uniforms of the draw with those of the scene behind them; NULL: those of the draw alone
};

struct bench_state {
    rhw_context *context;
    struct rhw_context_def def;
    const struct bench_scene *scene;
    int width, height;
    rhw_buffer *vertices, *indices, *instances; // per mesh
    rhw_texture *textures;
    rhw_sampler samplers[BENCH_FILTERS];
    rhw_pipeline *pipelines;    // per draw; equal ones in a row are one
    rhw_texture color, depth;   // the picture
    struct scene_upload upload; // of the model of a physically based scene, instead of the above
    struct scene_surface_pipelines surface_pipelines;
    struct scene_triangle_order order;
    // Of a renderer whose shaders are translated: the program of a shader, or NULL where it cannot be translated.
    const struct rhw_program *(*translated)(void *programs, enum bench_shader shader);
    void *programs;                  // what `translated` takes
    struct bench_draw_frame *frames; // per draw
    rhw_context *recorder;           // of a scene that is replayed
    rhw_recording *recording;        // its only pass; NULL: it was not recorded yet
    struct scene_plane map;          // what shadows are looked up in, of such a scene
};

// Whether the model is drawn with the shaders of scene/, rather than mesh by mesh.
bool bench_rhw_draws_surfaces(const struct bench_state *state);

// Makes everything of `state->scene` in `state->context`. What there is after a failure is for bench_rhw_drop, which
// leaves the context, its definition and translated shaders.
bool bench_rhw_upload(struct bench_state *state);
void bench_rhw_drop(struct bench_state *state);

#endif
