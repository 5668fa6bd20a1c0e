// SPDX-License-Identifier: MIT
// The extensions of glTF's materials that need a shader of their own.
#include "elementary.h"
#include "gltf.h"

enum { LAYER_TEXTURES = 9 }; // texture slots of a draw that are left for layers

static float number(struct scene_gltf *gltf, const json_t *object, const char *key, double absent,
                    double most)
{
    return scene_gltf_limited(scene_gltf_number(gltf, object, key, absent), 0, most);
}

static void texture(struct scene_gltf *gltf, const json_t *object, const char *key,
                    struct scene_material *material, enum scene_slot slot)
{
    scene_gltf_slot(gltf, scene_gltf_object(gltf, object, key), &material->slots[slot]);
}

static void color(struct scene_gltf *gltf, const json_t *object, const char *key, float values[3])
{
    scene_gltf_floats(gltf, object, key, values, 3);
    for (int c = 0; c < 3; c++) {
        values[c] = scene_gltf_limited((double)values[c], 0, 1e6);
    }
}

static void read_clearcoat(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    struct scene_layers *layers = &material->layers;
    const json_t *normal = scene_gltf_object(gltf, object, "clearcoatNormalTexture");
    layers->clearcoat = number(gltf, object, "clearcoatFactor", 0, 1);
    layers->clearcoat_roughness = number(gltf, object, "clearcoatRoughnessFactor", 0, 1);
    layers->clearcoat_normal_scale =
        scene_gltf_limited(scene_gltf_number(gltf, normal, "scale", 1), -1e6, 1e6);
    texture(gltf, object, "clearcoatTexture", material, SCENE_SLOT_CLEARCOAT);
    texture(gltf, object, "clearcoatRoughnessTexture", material, SCENE_SLOT_CLEARCOAT_ROUGHNESS);
    texture(gltf, object, "clearcoatNormalTexture", material, SCENE_SLOT_CLEARCOAT_NORMAL);
}

static void read_sheen(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    color(gltf, object, "sheenColorFactor", material->layers.sheen_color);
    material->layers.sheen_roughness = number(gltf, object, "sheenRoughnessFactor", 0, 1);
    texture(gltf, object, "sheenColorTexture", material, SCENE_SLOT_SHEEN_COLOR);
    texture(gltf, object, "sheenRoughnessTexture", material, SCENE_SLOT_SHEEN_ROUGHNESS);
}

static void read_specular(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    material->layers.specular = number(gltf, object, "specularFactor", 1, 1);
    color(gltf, object, "specularColorFactor", material->layers.specular_color);
    texture(gltf, object, "specularTexture", material, SCENE_SLOT_SPECULAR);
    texture(gltf, object, "specularColorTexture", material, SCENE_SLOT_SPECULAR_COLOR);
}

// Read the index of refraction. 0 stands for an index so high that everything is mirrored, as old files have it.
static void read_ior(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    const double ior = scene_gltf_number(gltf, object, "ior", 1.5);
    material->layers.ior = ior > 0 ? scene_gltf_limited(ior, 1, 1000) : ior < 0 ? 1.5f : 1000;
}

static void read_transmission(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    material->layers.transmission = number(gltf, object, "transmissionFactor", 0, 1);
    texture(gltf, object, "transmissionTexture", material, SCENE_SLOT_TRANSMISSION);
}

static void read_volume(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    struct scene_layers *layers = &material->layers;
    layers->thickness = number(gltf, object, "thicknessFactor", 0, 1e30);
    texture(gltf, object, "thicknessTexture", material, SCENE_SLOT_THICKNESS);
    color(gltf, object, "attenuationColor", layers->attenuation_color);
    const double distance = scene_gltf_number(gltf, object, "attenuationDistance", 0);
    layers->attenuation_distance = distance > 0 && distance < 1e30 ? (float)distance : __builtin_inff();
}

static void read_anisotropy(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    const double rotation = scene_gltf_number(gltf, object, "anisotropyRotation", 0);
    material->layers.anisotropy = number(gltf, object, "anisotropyStrength", 0, 1);
    material->layers.anisotropy_direction[0] = (float)scene_cos(rotation);
    material->layers.anisotropy_direction[1] = (float)scene_sin(rotation);
    texture(gltf, object, "anisotropyTexture", material, SCENE_SLOT_ANISOTROPY);
}

static void read_iridescence(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    struct scene_layers *layers = &material->layers;
    layers->iridescence = number(gltf, object, "iridescenceFactor", 0, 1);
    layers->iridescence_ior =
        scene_gltf_limited(scene_gltf_number(gltf, object, "iridescenceIor", 1.3), 1, 1000);
    layers->iridescence_thickness[0] = number(gltf, object, "iridescenceThicknessMinimum", 100, 1e6);
    layers->iridescence_thickness[1] = number(gltf, object, "iridescenceThicknessMaximum", 400, 1e6);
    texture(gltf, object, "iridescenceTexture", material, SCENE_SLOT_IRIDESCENCE);
    texture(gltf, object, "iridescenceThicknessTexture", material, SCENE_SLOT_IRIDESCENCE_THICKNESS);
}

// Read the older model of shading. Where a file has both models, it means this one, and has the other for programs that
// cannot draw it.
static void read_gloss(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    struct scene_layers *layers = &material->layers;
    layers->glossy = true;
    for (int c = 0; c < 4; c++) {
        material->base_color[c] = 1;
    }
    material->slots[SCENE_SLOT_BASE_COLOR].image = material->slots[SCENE_SLOT_METALLIC_ROUGHNESS].image = -1;
    scene_gltf_floats(gltf, object, "diffuseFactor", material->base_color, 4);
    scene_gltf_limit_color(material->base_color);
    color(gltf, object, "specularFactor", layers->gloss_specular);
    layers->glossiness = number(gltf, object, "glossinessFactor", 1, 1);
    texture(gltf, object, "diffuseTexture", material, SCENE_SLOT_BASE_COLOR);
    texture(gltf, object, "specularGlossinessTexture", material, SCENE_SLOT_GLOSS);
}

static void read_dispersion(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    material->layers.dispersion = number(gltf, object, "dispersion", 0, 100);
}

// Drop the textures that a draw has no slots for. Layers take slots before SCENE_SLOT_BACKDROP, and the base material
// takes the others.
static void drop_textures(struct scene_gltf *gltf, struct scene_material *material)
{
    int count = 0;
    for (int slot = SCENE_BASE_SLOTS; slot < SCENE_SLOT_COUNT; slot++) {
        count += material->slots[slot].image >= 0;
        if (material->slots[slot].image >= 0 && count > LAYER_TEXTURES) {
            scene_import_unsupported(gltf->import, "material \"%s\": more than %d textures of extensions",
                                     material->name, LAYER_TEXTURES);
            material->slots[slot].image = -1;
        }
    }
}

void scene_gltf_layers(struct scene_gltf *gltf, const json_t *object, struct scene_material *material)
{
    static const struct {
        const char *extension;
        void (*read)(struct scene_gltf *gltf, const json_t *object, struct scene_material *material);
    } readers[] = {
        {"KHR_materials_pbrSpecularGlossiness", read_gloss},
        {"KHR_materials_clearcoat", read_clearcoat},
        {"KHR_materials_sheen", read_sheen},
        {"KHR_materials_specular", read_specular},
        {"KHR_materials_ior", read_ior},
        {"KHR_materials_transmission", read_transmission},
        {"KHR_materials_volume", read_volume},
        {"KHR_materials_anisotropy", read_anisotropy},
        {"KHR_materials_iridescence", read_iridescence},
        {"KHR_materials_dispersion", read_dispersion},
    };
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++) {
        const json_t *extension = scene_gltf_extension(gltf, object, readers[i].extension);
        if (extension != NULL) {
            readers[i].read(gltf, extension, material);
            material->layers.used = true;
        }
    }
    drop_textures(gltf, material);
}
