// SPDX-License-Identifier: MIT
// Draco's meshes, for C: the library is C++. Numbers that Draco keeps as whole ones within bounds, and normals that it
// keeps folded onto an octahedron, are computed here, so that they are the same on every machine.
#ifndef SCENE_DRACO_DECODER_H
#define SCENE_DRACO_DECODER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct scene_draco;

/// What the elements of an attribute are made into.
enum scene_draco_type {
    SCENE_DRACO_INT8,
    SCENE_DRACO_UINT8,
    SCENE_DRACO_INT16,
    SCENE_DRACO_UINT16,
    SCENE_DRACO_UINT32,
    SCENE_DRACO_FLOAT
};

/// A mesh of `size` bytes, or NULL with the reason in `problem`, which is valid until the next call. Never freed: the
/// process that imports ends.
const struct scene_draco *scene_draco_open(const void *bytes, size_t size, const char **problem);
uint32_t scene_draco_vertex_count(const struct scene_draco *draco);
uint32_t scene_draco_triangle_count(const struct scene_draco *draco);
/// Three for each triangle, each below the count of vertices.
void scene_draco_indices(const struct scene_draco *draco, uint32_t *indices);
/// Components of the attribute with that unique id, 0 where there is none.
int scene_draco_components(const struct scene_draco *draco, uint32_t id);
/// `components` numbers for each vertex, packed. False where the attribute is kept as floats and asked for as another type,
/// or does not fit it.
bool scene_draco_attribute(const struct scene_draco *draco, uint32_t id, enum scene_draco_type type,
                           int components, void *elements);

#ifdef __cplusplus
}
#endif

#endif
