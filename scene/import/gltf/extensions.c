// SPDX-License-Identifier: MIT
// The extensions that are drawn, and what the user is told of the others.
#include "gltf.h"

#include <string.h>

// Extensions that are drawn as they are meant.
static const char *const known_extensions[] = {
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_avif",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "MSFT_texture_dds",
};

// Extensions that say nothing about the picture.
static const char *const silent_extensions[] = {
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "FB_geometry_metadata",
    "KHR_audio_emitter",
    "KHR_physics_rigid_bodies",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_audio_emitter",
    "OMI_collider",
    "OMI_physics_body",
    "OMI_physics_shape",
    "VRMC_springBone",
    "VRMC_springBone_extended_collider",
};

static bool is_among(const char *const *list, size_t count, const char *extension)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(list[i], extension) == 0) {
            return true;
        }
    }
    return false;
}

static bool is_known(const char *extension)
{
    return is_among(known_extensions, sizeof known_extensions / sizeof *known_extensions, extension) ||
           is_among(silent_extensions, sizeof silent_extensions / sizeof *silent_extensions, extension);
}

static void note_extension(struct scene_gltf *gltf, const char *name)
{
    if (!is_known(name)) {
        scene_import_unsupported(gltf->import, "glTF extension %s: ignored", name);
    }
}

void scene_gltf_note_extensions(struct scene_gltf *gltf, const json_t *object)
{
    const char *name;
    json_t *value;
    json_object_foreach(json_object_get(object, "extensions"), name, value)
    {
        note_extension(gltf, name);
    }
}

static bool lists(struct scene_gltf *gltf, const char *list, const char *name)
{
    bool found = false;
    size_t i;
    json_t *value;
    json_array_foreach(scene_gltf_array(gltf, gltf->root, list), i, value)
    {
        found = found || (json_is_string(value) && strcmp(json_string_value(value), name) == 0);
    }
    return found;
}

static void list_extensions(struct scene_gltf *gltf)
{
    struct scene_model *const model = &gltf->import->model;
    const json_t *const used = scene_gltf_array(gltf, gltf->root, "extensionsUsed");
    const size_t most = json_array_size(used);
    model->extensions = scene_import_allocate(gltf->import, most, sizeof *model->extensions);
    for (size_t i = 0; i < most; i++) {
        const char *const name = json_string_value(json_array_get(used, i));
        if (name != NULL) {
            // VRM 0 alone. Avatars of VRM 1, which is VRMC_vrm, look where glTF has the front.
            model->faces_back = model->faces_back || strcmp(name, "VRM") == 0;
            model->extensions[model->extension_count++] =
                (struct scene_model_extension){.name = scene_import_string(gltf->import, name, strlen(name)),
                                               .is_required = lists(gltf, "extensionsRequired", name),
                                               .is_drawn = is_known(name)};
        }
    }
}

void scene_gltf_check_extensions(struct scene_gltf *gltf)
{
    list_extensions(gltf);
    size_t i;
    json_t *value;
    json_array_foreach(scene_gltf_array(gltf, gltf->root, "extensionsRequired"), i, value)
    {
        if (!json_is_string(value)) {
            scene_import_fail(gltf->import, "\"extensionsRequired\" must hold strings");
        }
        if (!is_known(json_string_value(value))) {
            scene_import_fail(gltf->import, "requires the glTF extension %s, which is not supported",
                              json_string_value(value));
        }
    }
    json_array_foreach(scene_gltf_array(gltf, gltf->root, "extensionsUsed"), i, value)
    {
        if (json_is_string(value)) {
            note_extension(gltf, json_string_value(value));
        }
    }
}
