// SPDX-License-Identifier: MIT
// KHR_draco_mesh_compression. What the compressed mesh holds takes the place of the primitive's accessors, which are
// afterwards read like any other.
#include <stdlib.h>
#include <string.h>

#include "draco_decoder.h"
#include "gltf.h"

enum { TYPE_INT8 = 5120, TYPE_UINT32 = 5125, TYPE_FLOAT = 5126 };

struct type {
    enum scene_draco_type type;
    size_t size; // 0 if there is no componentType of this number
};

static struct type find_type(int64_t component_type)
{
    static const struct type types[] = {
        {SCENE_DRACO_INT8, 1}, {SCENE_DRACO_UINT8, 1},  {SCENE_DRACO_INT16, 2}, {SCENE_DRACO_UINT16, 2},
        {SCENE_DRACO_INT8, 0}, {SCENE_DRACO_UINT32, 4}, {SCENE_DRACO_FLOAT, 4}};
    const bool known = component_type >= TYPE_INT8 && component_type <= TYPE_FLOAT;
    return known ? types[component_type - TYPE_INT8] : (struct type){SCENE_DRACO_INT8, 0};
}

static int find_components(const char *shape)
{
    static const char *const shapes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    for (int i = 0; shape != NULL && i < 4; i++) {
        if (strcmp(shape, shapes[i]) == 0) {
            return i + 1;
        }
    }
    return 0;
}

// Read indices of joints. COLLADA2GLTF keeps them as floats within bounds, which are near whole numbers again.
static bool read_joints(struct scene_gltf *gltf, const struct scene_draco *draco, uint32_t id,
                        enum scene_draco_type type, unsigned char *bytes)
{
    const size_t count = 4 * (size_t)scene_draco_vertex_count(draco);
    float *const floats = scene_import_allocate(gltf->import, count, sizeof *floats);
    bool fits = (type == SCENE_DRACO_UINT8 || type == SCENE_DRACO_UINT16) &&
                scene_draco_attribute(draco, id, SCENE_DRACO_FLOAT, 4, floats);
    const float most = type == SCENE_DRACO_UINT8 ? UINT8_MAX : UINT16_MAX;
    for (size_t i = 0; i < count && fits; i++) {
        fits = floats[i] > -0.5f && floats[i] < most + 0.5f;
        const uint16_t joint = fits ? (uint16_t)(floats[i] + 0.5f) : 0;
        if (type == SCENE_DRACO_UINT8) {
            bytes[i] = (unsigned char)joint;
        } else {
            memcpy(bytes + i * sizeof joint, &joint, sizeof joint);
        }
    }
    free(floats);
    return fits;
}

static void read_attribute(struct scene_gltf *gltf, const struct scene_draco *draco, const char *what,
                           const char *name, uint32_t id, int64_t accessor)
{
    const json_t *object = scene_gltf_item(gltf, "accessors", accessor);
    const int64_t component_type = scene_gltf_integer(gltf, object, "componentType", -1);
    const struct type type = find_type(component_type);
    const int components = find_components(scene_gltf_text(gltf, object, "type"));
    const uint32_t count = scene_draco_vertex_count(draco);
    if (type.size == 0 || components == 0 || scene_draco_components(draco, id) != components) {
        scene_import_fail(gltf->import,
                          "%s: its Draco data has no attribute %s of the shape its accessor says", what,
                          name);
    }
    const size_t stride = type.size * (size_t)components;
    unsigned char *bytes = scene_import_allocate(gltf->import, count, stride);
    const bool has_joints = strncmp(name, "JOINTS_", 7) == 0 && components == 4;
    if (!scene_draco_attribute(draco, id, type.type, components, bytes) &&
        !(has_joints && read_joints(gltf, draco, id, type.type, bytes))) {
        scene_import_fail(gltf->import, "%s: %s in its Draco data does not fit its accessor's componentType",
                          what, name);
    }
    gltf->accessors[accessor] = (struct scene_gltf_decoded){
        .bytes = bytes, .size = count * stride, .stride = stride, .count = count, .type = (int)component_type};
}

static void read_indices(struct scene_gltf *gltf, const struct scene_draco *draco, int64_t accessor)
{
    const uint32_t triangles = scene_draco_triangle_count(draco);
    uint32_t *indices = scene_import_allocate(gltf->import, triangles, 3 * sizeof *indices);
    scene_draco_indices(draco, indices);
    scene_gltf_item(gltf, "accessors", accessor);
    gltf->accessors[accessor] = (struct scene_gltf_decoded){.bytes = (const unsigned char *)indices,
                                                            .size = 3 * sizeof *indices * triangles,
                                                            .stride = sizeof *indices,
                                                            .count = 3 * triangles,
                                                            .type = TYPE_UINT32};
}

void scene_gltf_draco(struct scene_gltf *gltf, const json_t *primitive, const json_t *extension,
                      const char *what)
{
    const int64_t view = scene_gltf_integer(gltf, extension, "bufferView", -1);
    const json_t *ids = scene_gltf_object(gltf, extension, "attributes");
    const json_t *accessors = scene_gltf_object(gltf, primitive, "attributes");
    const int64_t indices = scene_gltf_integer(gltf, primitive, "indices", -1);
    size_t size = 0, stride = 0;
    const char *problem = NULL;
    const unsigned char *bytes = scene_gltf_view(gltf, view, &size, &stride);
    const struct scene_draco *draco = scene_draco_open(bytes, size, &problem);
    if (draco == NULL) {
        scene_import_fail(gltf->import, "%s: its Draco data cannot be read: %s", what, problem);
    }
    if (scene_draco_vertex_count(draco) == 0 || scene_draco_triangle_count(draco) == 0 ||
        scene_draco_triangle_count(draco) > UINT32_MAX / 4) {
        scene_import_fail(gltf->import, "%s: its Draco data has no triangles", what);
    }
    const char *name;
    const json_t *value;
    json_object_foreach((json_t *)ids, name, value)
    {
        const int64_t id = scene_gltf_integer(gltf, ids, name, -1);
        const int64_t accessor = scene_gltf_integer(gltf, accessors, name, -1);
        if (accessor >= 0) {
            read_attribute(gltf, draco, what, name, id <= UINT32_MAX ? (uint32_t)id : UINT32_MAX, accessor);
        }
    }
    if (indices >= 0) {
        read_indices(gltf, draco, indices);
    }
}
