// SPDX-License-Identifier: MIT
// The programs of the built-in shaders, which have a copy for each instruction set.
#include "scene_shaders.h"

static const struct scene_surface_shaders *const surface_shaders[RHW_ISA_COUNT] =
    RHW_ISA_TABLE(&scene_surface_shaders);

static const struct scene_layered_shaders *const layered_shaders[RHW_ISA_COUNT] =
    RHW_ISA_TABLE(&scene_layered_shaders);

static const struct scene_screen_shaders *const screen_shaders[RHW_ISA_COUNT] =
    RHW_ISA_TABLE(&scene_screen_shaders);

static const struct scene_occlusion_shaders *const occlusion_shaders[RHW_ISA_COUNT] =
    RHW_ISA_TABLE(&scene_occlusion_shaders);

static const struct scene_panorama_shaders *const panorama_shaders[RHW_ISA_COUNT] =
    RHW_ISA_TABLE(&scene_panorama_shaders);

void scene_program_surface(struct rhw_program *program, enum scene_vertex_kind vertex,
                           enum scene_fragment_kind fragment)
{
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (surface_shaders[isa]) {
            program->vertex[isa] = surface_shaders[isa]->vertex[vertex];
            program->fragment[isa] = fragment == SCENE_FRAGMENT_NONE ? NULL
                                     : fragment == SCENE_FRAGMENT_LAYERED
                                         ? layered_shaders[isa]->fragment
                                         : surface_shaders[isa]->fragment[fragment];
        }
    }
    program->uniform_size = sizeof(struct scene_surface);
}

static rhw_fragment_function *screen_fragment(int isa, enum scene_screen_kind kind)
{
    if (kind >= SCENE_SCREEN_PANORAMA) {
        return panorama_shaders[isa]->fragment[kind - SCENE_SCREEN_PANORAMA];
    }
    return kind >= SCENE_SCREEN_OCCLUSION ? occlusion_shaders[isa]->fragment[kind - SCENE_SCREEN_OCCLUSION]
                                          : screen_shaders[isa]->fragment[kind];
}

void scene_program_screen(struct rhw_program *program, enum scene_screen_kind kind)
{
    static const uint32_t sizes[SCENE_SCREEN_KINDS] = {
        [SCENE_SCREEN_BACKDROP] = sizeof(struct scene_backdrop),
        [SCENE_SCREEN_RESOLVE] = sizeof(struct scene_resolve),
        [SCENE_SCREEN_LAYER] = sizeof(struct scene_layer),
        [SCENE_SCREEN_OCCLUSION] = sizeof(struct scene_ambient),
        [SCENE_SCREEN_OCCLUSION_BLUR] = sizeof(struct scene_ambient),
        [SCENE_SCREEN_PANORAMA] = sizeof(struct scene_panorama_pass),
        [SCENE_SCREEN_PREFILTER] = sizeof(struct scene_panorama_pass),
        [SCENE_SCREEN_SURROUNDINGS] = sizeof(struct scene_panorama_pass),
    };
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (screen_shaders[isa]) {
            program->vertex[isa] = screen_shaders[isa]->vertex;
            program->fragment[isa] = screen_fragment(isa, kind);
        }
    }
    program->uses = RHW_USE_COORD;
    program->uniform_size = sizes[kind];
}
