// SPDX-License-Identifier: MIT
// A model in the context's memory: what drawing code binds. Everything that does not depend on the view is
// worked out here, once.
#ifndef SCENE_UPLOAD_H
#define SCENE_UPLOAD_H

#include "model.h"
#include "rhw/rhw.h"
#include "draw/shading/scene_shaders.h"
#include "upload_image.h"

enum { SCENE_MESH_ATTRIBUTES = 6 };

struct scene_uploaded_mesh {
    rhw_buffer vertices, indices; // one interleaved vertex buffer; 32-bit indices of a triangle list
    uint32_t index_count;
    enum scene_vertex_kind kind;
    bool inside_out; // most normals are on the other side of their facets, by 120 degrees or more
    struct rhw_attribute attributes[SCENE_MESH_ATTRIBUTES];
    int attribute_count;
    uint32_t stride;
    // Numbers of attributes; −1 where the mesh has none. Position is 0; the far end of a line is 1.
    int normal, tangent, color, uv[SCENE_UV_SETS];
};

struct scene_uploaded_slot {
    rhw_texture texture; // null: no texture
    rhw_sampler sampler;
};

struct scene_uploaded_material {
    struct scene_uploaded_slot slots[SCENE_SLOT_COUNT];
    bool textured;         // any slot but the normal map
    bool occlusion_shared; // its texture is that of metallic-roughness
};

struct scene_upload {
    rhw_context *context;
    const struct scene_model *model;
    struct scene_uploaded_mesh *meshes;
    struct scene_uploaded_image *images;
    struct scene_uploaded_material *materials;
    struct scene_combined_images combined;
    uint32_t *first_triangle; // for each instance 1 + triangles, lines and points of the instances before it
};

/// On failure everything is released again.
enum rhw_result scene_upload_create(rhw_context *context, const struct scene_model *model,
                                    struct scene_upload *upload);
/// Takes meshes and instances from another pose of the same model, which then must outlive the upload. Materials and
/// images stay. On failure the upload is as good as empty, to be destroyed.
enum rhw_result scene_upload_pose(struct scene_upload *upload, const struct scene_model *pose);
void scene_upload_destroy(struct scene_upload *upload);

#endif
