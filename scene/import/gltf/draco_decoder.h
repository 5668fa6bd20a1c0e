// SPDX-License-Identifier: MIT
// Draco's meshes, for C: the library is C++. Two kinds of attributes are computed here, so that they are equal on every
// machine: numbers that Draco keeps as whole ones within bounds, and normals that it keeps folded onto an octahedron.
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

/// Return a mesh of `size` bytes. Return NULL, with the reason in `problem`, if they are none; the reason is valid
/// until the next call. The mesh is never freed: the process that imports ends.
const struct scene_draco *scene_draco_open(const void *bytes, size_t size, const char **problem);
uint32_t scene_draco_vertex_count(const struct scene_draco *draco);
uint32_t scene_draco_triangle_count(const struct scene_draco *draco);
/// Write three indices for each triangle, each below the count of vertices.
void scene_draco_indices(const struct scene_draco *draco, uint32_t *indices);
/// Return the number of components of the attribute with this unique id. Return 0 if there is none.
int scene_draco_components(const struct scene_draco *draco, uint32_t id);
/// Write `components` numbers for each vertex, packed. Return false if the attribute is kept as floats and asked for as
/// another type, or does not fit that type.
bool scene_draco_attribute(const struct scene_draco *draco, uint32_t id, enum scene_draco_type type,
                           int components, void *elements);

#ifdef __cplusplus
}
#endif

#endif
