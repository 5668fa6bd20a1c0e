// SPDX-License-Identifier: MIT
// The triangles of blended surfaces from back to front as a camera sees them: what lies above what is then no matter of
// the order in the file, unless triangles are long or cut each other.
#ifndef SCENE_TRIANGLE_ORDER_H
#define SCENE_TRIANGLE_ORDER_H

#include "upload.h"

/// Index buffers by instance, null for instances that keep theirs. Zeroed: none.
struct scene_triangle_order {
    rhw_buffer *indices;
    uint32_t count; // number of instances
};

/// Sorts the indices of a mesh of triangles from back to front as seen along `forward`. Triangles at equal distances
/// keep their order. Returns false when out of memory.
bool scene_triangle_order_sort(const struct scene_mesh *mesh, const float world[16], const float forward[3],
                               uint32_t *sorted);
/// Sorts the triangles of all instances with a material that blends by the distance of their middles along the view.
/// Triangles at equal distances keep their order.
enum rhw_result scene_triangle_order_make(struct scene_triangle_order *order,
                                          const struct scene_upload *upload, const struct scene_frame *frame);
void scene_triangle_order_destroy(rhw_context *context, struct scene_triangle_order *order);
/// The index buffer to use instead of the mesh's, or null. `order` may be NULL.
rhw_buffer scene_triangle_order_of(const struct scene_triangle_order *order, uint32_t instance);

#endif
