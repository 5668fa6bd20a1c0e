// SPDX-License-Identifier: MIT
// A model made from arrays in memory instead of a file. It goes the way of files, through an equal child process,
// completion of normals and checks, so that a mesh is drawn as it would be from a glTF.
#ifndef SCENE_MODEL_ARRAYS_H
#define SCENE_MODEL_ARRAYS_H

#include "model.h"

/// How normals are made where there are none.
enum scene_arrays_normals { SCENE_ARRAYS_SMOOTH, SCENE_ARRAYS_FLAT };

/// A mesh has tightly packed arrays. A pointer is NULL if the mesh has no array of that kind.
struct scene_array_mesh {
    const char *name;
    enum scene_primitive primitive;
    enum scene_arrays_normals shading;
    uint32_t material, vertex_count, index_count;
    const double (*positions)[3]; ///< never NULL
    const float (*normals)[3];
    const float (*uvs)[2];
    const float (*colors)[4]; ///< linear
    const uint32_t *indices;  ///< NULL if the vertices are taken in their order
};

struct scene_array_image {
    const char *name;
    uint32_t width, height;
    const uint8_t (*texels)[4]; ///< sRGB
};

struct scene_array_material {
    const char *name;
    float base_color[4], emissive[3];
    float metallic, roughness, alpha_cutoff;
    enum scene_alpha_mode alpha_mode;
    bool unlit, double_sided;
    int32_t image; ///< index of the image of the base colour; −1 if there is none
};

struct scene_array_instance {
    const char *name;
    uint32_t mesh;
    double world[16]; ///< column major
};

struct scene_arrays {
    const char *name; ///< name that takes the place of a path
    enum scene_axis up;
    const struct scene_array_mesh *meshes;
    const struct scene_array_image *images;
    const struct scene_array_material *materials;
    const struct scene_array_instance *instances;
    uint32_t mesh_count, image_count, material_count, instance_count;
};

/// Make a model as scene_model_load does. The arrays are copied and must stay as they are meanwhile. An index that is
/// out of range fails the import. Numbers that are not finite are left out, as they are of a file. Windows keeps no
/// time.
struct scene_model *scene_model_make(const struct scene_arrays *arrays,
                                     const struct scene_model_options *options, char *error,
                                     size_t error_size);

#endif
