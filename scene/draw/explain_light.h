// SPDX-License-Identifier: MIT
// What the built-in shader makes of light at a fragment is told light by light: the normal that it takes, how far the
// surface faces the light, and how much of the light is in shadow; and what ambient occlusion leaves of what comes from
// all around. The shader's own functions are asked, so that their answers are what the picture shows.
#ifndef SCENE_EXPLAIN_LIGHT_H
#define SCENE_EXPLAIN_LIGHT_H

#include "explain_sample.h"

/// Each fragment of a history keeps at most this many lights, which can be read at a glance; few models have more. The
/// sum has all lights.
enum { SCENE_LIGHT_LOOKS = 8 };

struct scene_light_look {
    enum scene_light_type type;
    float direction[3]; ///< l, unit, towards the light
    float n_dot_l;      ///< below 0 the surface faces away
    bool has_shadows;   ///< whether shadows are taken of this light
    float open;         ///< the part that no shadow takes, 0..1
    float facing[3]; ///< what a surface gets that faces the light; irradiance over π, as a white one sends it on
    float arrives[3]; ///< light that arrives: times n·l, where above 0, and times the open part
};

struct scene_light_looks {
    bool is_lit;         ///< false: the surface has no light, and nothing else is set
    bool is_mapped;      ///< a normal map turned the normal
    float normal[3];     ///< unit, of the side that is seen
    int count, left_out; ///< lights that are told, and those beyond SCENE_LIGHT_LOOKS
    struct scene_light_look lights[SCENE_LIGHT_LOOKS];
    float sum[3];       ///< sum over all lights of what arrives
    bool has_occlusion; ///< there is ambient occlusion
    float around;       ///< part of what comes from all around that ambient occlusion leaves, 0..1
};

/// Of a surface's shaded fragment, while that is told.
void scene_light_looks(const struct rhw_explained_fragment *fragment, const struct scene_surface *surface,
                       struct scene_light_looks *looks);

#endif
