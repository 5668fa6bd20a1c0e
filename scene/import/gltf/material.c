// SPDX-License-Identifier: MIT
// Materials (§3.9), and the extensions of them that are supported.
#include <string.h>

#include "gltf.h"

static void read_metallic_roughness(struct scene_gltf *gltf, const json_t *pbr,
                                    struct scene_material *material)
{
    scene_gltf_floats(gltf, pbr, "baseColorFactor", material->base_color, 4);
    scene_gltf_limit_color(material->base_color);
    material->metallic = scene_gltf_limited(scene_gltf_number(gltf, pbr, "metallicFactor", 1), 0, 1);
    material->roughness = scene_gltf_limited(scene_gltf_number(gltf, pbr, "roughnessFactor", 1), 0, 1);
    scene_gltf_slot(gltf, scene_gltf_object(gltf, pbr, "baseColorTexture"),
                    &material->slots[SCENE_SLOT_BASE_COLOR]);
    scene_gltf_slot(gltf, scene_gltf_object(gltf, pbr, "metallicRoughnessTexture"),
                    &material->slots[SCENE_SLOT_METALLIC_ROUGHNESS]);
}

static void read_alpha(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    const char *mode = scene_gltf_text(gltf, object, "alphaMode");
    if (mode != NULL && strcmp(mode, "MASK") == 0) {
        material->alpha_mode = SCENE_ALPHA_MASK;
    } else if (mode != NULL && strcmp(mode, "BLEND") == 0) {
        material->alpha_mode = SCENE_ALPHA_BLEND;
    } else if (mode != NULL && strcmp(mode, "OPAQUE") != 0) {
        scene_import_warn(gltf->import, "material \"%s\" has an alphaMode that does not exist: drawn opaque",
                          material->name);
    }
    material->alpha_cutoff = (float)scene_gltf_number(gltf, object, "alphaCutoff", 0.5);
}

static void read_material(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    const json_t *pbr = scene_gltf_object(gltf, object, "pbrMetallicRoughness");
    const json_t *normal = scene_gltf_object(gltf, object, "normalTexture");
    const json_t *occlusion = scene_gltf_object(gltf, object, "occlusionTexture");
    const json_t *strength = scene_gltf_extension(gltf, object, "KHR_materials_emissive_strength");
    material->name = scene_gltf_name(gltf, object);
    scene_gltf_note_extensions(gltf, object);
    read_metallic_roughness(gltf, pbr, material);
    scene_gltf_layers(gltf, object, material);
    scene_gltf_slot(gltf, normal, &material->slots[SCENE_SLOT_NORMAL]);
    scene_gltf_slot(gltf, occlusion, &material->slots[SCENE_SLOT_OCCLUSION]);
    scene_gltf_slot(gltf, scene_gltf_object(gltf, object, "emissiveTexture"),
                    &material->slots[SCENE_SLOT_EMISSIVE]);
    material->normal_scale = scene_gltf_limited(scene_gltf_number(gltf, normal, "scale", 1), -1e6, 1e6);
    material->occlusion_strength =
        scene_gltf_limited(scene_gltf_number(gltf, occlusion, "strength", 1), 0, 1);
    scene_gltf_floats(gltf, object, "emissiveFactor", material->emissive, 3);
    for (int c = 0; c < 3; c++) {
        material->emissive[c] *= (float)scene_gltf_number(gltf, strength, "emissiveStrength", 1);
    }
    read_alpha(gltf, object, material);
    material->double_sided = scene_gltf_flag(gltf, object, "doubleSided", false);
    material->unlit = scene_gltf_extension(gltf, object, "KHR_materials_unlit") != NULL;
}

uint32_t scene_gltf_material(struct scene_gltf *gltf, int64_t index)
{
    if (index >= 0) {
        scene_gltf_item(gltf, "materials", index);
    }
    int32_t *made = index < 0 ? &gltf->default_material : &gltf->materials[index];
    if (*made >= 0) {
        return (uint32_t)*made;
    }
    *made = (int32_t)gltf->import->model.material_count;
    struct scene_material *material = scene_import_add_material(gltf->import);
    if (index >= 0) {
        read_material(gltf, scene_gltf_item(gltf, "materials", index), material);
    }
    return (uint32_t)*made;
}
