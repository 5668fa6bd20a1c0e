// SPDX-License-Identifier: MIT
// Varyings of a fragment are I = I_0 − (b·(I_0 − I_1) + c·(I_0 − I_2)), in float, with the weights of raster/plane.h.
// If the three vertices agree, both differences are 0, and the constant survives bit for bit, −0 included.
#ifndef RHW_INTERPOLATE_H
#define RHW_INTERPOLATE_H

#include "kernels/tile_work.h"
#include "kernels/triangle_work.h"

// Return a varying by the one formula. d1 and d2 are I_0 − I_1 and I_0 − I_2.
RHW_INLINE f32x8 interpolate(f32x8 i0, f32x8 d1, f32x8 d2, f32x8 b, f32x8 c)
{
    return i0 - (b * d1 + c * d2);
}

// Return the vertex, of three, that flat varyings come from.
static inline int provoking_vertex(const struct rhw_pipeline_data *pipeline)
{
    return pipeline->def.provoking == RHW_PROVOKING_FIRST ? 0 : 2;
}

static void set_values(struct triangle_work *triangle, const struct rhw_pipeline_data *pipeline)
{
    const float *const a = triangle->v[0]->varyings, *const b = triangle->v[1]->varyings,
                       *const c = triangle->v[2]->varyings;
    triangle->provoking = triangle->v[provoking_vertex(pipeline)]->varyings;
    // Vertex records are padded to whole vectors.
    for (int i = 0; i < pipeline->varying_components; i += 8) {
        const f32x8 i0 = f32x8_load(a + i);
        f32x8_store(&triangle->i0[i], i0);
        f32x8_store(&triangle->d1[i], i0 - f32x8_load(b + i));
        f32x8_store(&triangle->d2[i], i0 - f32x8_load(c + i));
    }
}

RHW_INLINE f32x8 interpolate_component(const struct triangle_work *triangle, int i, f32x8 b, f32x8 c)
{
    return interpolate(f32x8_splat(triangle->i0[i]), f32x8_splat(triangle->d1[i]),
                       f32x8_splat(triangle->d2[i]), b, c);
}

// Return true if groups that are filled together have components beside noperspective ones.
RHW_INLINE bool wants_weights(const struct rhw_pipeline_data *pipeline)
{
    return pipeline->any_noperspective ? pipeline->smooth_runs != 0 : pipeline->varying_components != 0;
}

// The perspective weights of some groups.
struct group_weights {
    f32x8 b[RHW_BLOCK], c[RHW_BLOCK];
};

// Set the flat varyings of `count` groups. `varyings` are those of the first group.
RHW_INLINE void set_flat_groups(f32x8 *varyings, const struct rhw_pipeline_data *pipeline,
                                const struct triangle_work *triangle, int count)
{
    for (int i = 0; i < pipeline->flat_count; i++) {
        const int component = pipeline->flat_component[i];
        f32x8 *to = varyings + component;
        for (int n = 0; n < count; n++, to += pipeline->varying_components) {
            *to = f32x8_splat(triangle->provoking[component]);
        }
    }
}

// Set a run of components as smooth ones. Flat components in the run are set afterwards.
RHW_INLINE void interpolate_groups(f32x8 *varyings, ptrdiff_t components, struct rhw_component_run run,
                                   const struct triangle_work *triangle, const struct group_weights *weights,
                                   int count)
{
    for (int i = run.first; i < run.end; i++) {
        const f32x8 i0 = f32x8_splat(triangle->i0[i]), d1 = f32x8_splat(triangle->d1[i]),
                    d2 = f32x8_splat(triangle->d2[i]);
        f32x8 *to = varyings + i;
        for (int n = 0; n < count; n++, to += components) {
            *to = interpolate(i0, d1, d2, weights->b[n], weights->c[n]);
        }
    }
}

// Set varyings of any qualifier. `screen` has the weights on the screen, if they are wanted.
RHW_INLINE void interpolate_any_groups(f32x8 *varyings, const struct rhw_pipeline_data *pipeline,
                                       const struct triangle_work *triangle,
                                       const struct group_weights *weights,
                                       const struct group_weights *screen, int count)
{
    const ptrdiff_t components = pipeline->varying_components;
    for (int i = 0; i < components; i++) {
        const bool on_screen = pipeline->component_qualifier[i] == RHW_NOPERSPECTIVE;
        const struct group_weights *const w = on_screen ? screen : weights;
        const f32x8 i0 = f32x8_splat(triangle->i0[i]), d1 = f32x8_splat(triangle->d1[i]),
                    d2 = f32x8_splat(triangle->d2[i]);
        f32x8 *to = varyings + i;
        for (int n = 0; n < count; n++, to += components) {
            *to = interpolate(i0, d1, d2, w->b[n], w->c[n]);
        }
    }
    set_flat_groups(varyings, pipeline, triangle, count);
}

// Return true if noperspective varyings of a triangle are made in double, by interpolate_homogeneous. Rows alone are.
RHW_INLINE bool interpolates_in_double(const struct rhw_pipeline_data *pipeline,
                                       const struct triangle_work *triangle)
{
    return triangle->planes.is_homogeneous && pipeline->any_noperspective;
}

// Set noperspective varyings of a triangle with a vertex that is not snapped. Weights on the screen may have any size
// and either sign there, and what float loses while they cancel would pass the bound: the values are computed in double
// and rounded once. The added 0 keeps a constant −0, whose differences times negative weights are −0.
static __attribute__((noinline)) void interpolate_homogeneous(f32x8 *varyings,
                                                              const struct rhw_pipeline_data *pipeline,
                                                              const struct triangle_work *triangle,
                                                              const struct screen_weights *w)
{
    for (int i = 0; i < pipeline->varying_components; i++) {
        if (pipeline->component_qualifier[i] == RHW_NOPERSPECTIVE) {
            const double i0 = (double)triangle->v[0]->varyings[i],
                         d1 = i0 - (double)triangle->v[1]->varyings[i],
                         d2 = i0 - (double)triangle->v[2]->varyings[i];
            const f64x8 change =
                f64x8_add(f64x8_mul(w->s, f64x8_splat(d1)), f64x8_mul(w->t, f64x8_splat(d2)));
            varyings[i] = f32x8_from_f64x8(f64x8_sub(f64x8_splat(i0), f64x8_add(change, f64x8_splat(0))));
        }
    }
}

// Set varyings of any qualifier.
static void interpolate_any(f32x8 *varyings, const struct rhw_pipeline_data *pipeline,
                            const struct triangle_work *triangle, const struct weights *weights,
                            const struct screen_weights *screen)
{
    const f32x8 s = f32x8_from_f64x8(screen->s), t = f32x8_from_f64x8(screen->t);
    for (int i = 0; i < pipeline->varying_components; i++) {
        switch (pipeline->component_qualifier[i]) {
        case RHW_SMOOTH: varyings[i] = interpolate_component(triangle, i, weights->b, weights->c); break;
        case RHW_NOPERSPECTIVE: varyings[i] = interpolate_component(triangle, i, s, t); break;
        default: varyings[i] = f32x8_splat(triangle->provoking[i]); break;
        }
    }
    if (interpolates_in_double(pipeline, triangle)) {
        interpolate_homogeneous(varyings, pipeline, triangle, screen);
    }
}

#endif
