// SPDX-License-Identifier: MIT
// Properties whose names are nearly those of glTF. A misspelt property means nothing, and what it should say is lost,
// so it is told. Other properties that glTF does not have are left alone: exporters keep data of their own anywhere. So
// are those that are about no picture, or without which the file is refused.
#include "gltf.h"

#include <ctype.h>
#include <string.h>

// What the properties of an object are. A property without a kind holds no object that is looked at.
enum kind {
    NONE,
    ROOT,
    SCENE,
    NODE,
    MESH,
    PRIMITIVE,
    MATERIAL,
    METALLIC_ROUGHNESS,
    TEXTURE_INFO,
    TEXTURE,
    SAMPLER,
    IMAGE,
    BUFFER,
    BUFFER_VIEW,
    ACCESSOR,
    SPARSE,
    SPARSE_PART,
    SKIN,
    ANIMATION,
    CHANNEL,
    TARGET,
    ANIMATION_SAMPLER,
    CAMERA,
    PERSPECTIVE,
    ORTHOGRAPHIC,
    EXTENSIONS,
    LAYER,
    LIGHTS,
    LIGHT,
    SPOT
};

static const struct property {
    enum kind of, kind;
    const char *name;
} properties[] = {
    {ROOT, NONE, "asset"},
    {ROOT, NONE, "extensionsUsed"},
    {ROOT, NONE, "extensionsRequired"},
    {ROOT, NONE, "scene"},
    {ROOT, SCENE, "scenes"},
    {ROOT, NODE, "nodes"},
    {ROOT, MESH, "meshes"},
    {ROOT, MATERIAL, "materials"},
    {ROOT, TEXTURE, "textures"},
    {ROOT, SAMPLER, "samplers"},
    {ROOT, IMAGE, "images"},
    {ROOT, BUFFER, "buffers"},
    {ROOT, BUFFER_VIEW, "bufferViews"},
    {ROOT, ACCESSOR, "accessors"},
    {ROOT, SKIN, "skins"},
    {ROOT, ANIMATION, "animations"},
    {ROOT, CAMERA, "cameras"},
    {SCENE, NONE, "nodes"},
    {NODE, NONE, "camera"},
    {NODE, NONE, "children"},
    {NODE, NONE, "skin"},
    {NODE, NONE, "matrix"},
    {NODE, NONE, "mesh"},
    {NODE, NONE, "rotation"},
    {NODE, NONE, "scale"},
    {NODE, NONE, "translation"},
    {NODE, NONE, "weights"},
    {MESH, PRIMITIVE, "primitives"},
    {MESH, NONE, "weights"},
    {PRIMITIVE, NONE, "attributes"},
    {PRIMITIVE, NONE, "indices"},
    {PRIMITIVE, NONE, "material"},
    {PRIMITIVE, NONE, "mode"},
    {PRIMITIVE, NONE, "targets"},
    {MATERIAL, METALLIC_ROUGHNESS, "pbrMetallicRoughness"},
    {MATERIAL, TEXTURE_INFO, "normalTexture"},
    {MATERIAL, TEXTURE_INFO, "occlusionTexture"},
    {MATERIAL, TEXTURE_INFO, "emissiveTexture"},
    {MATERIAL, NONE, "emissiveFactor"},
    {MATERIAL, NONE, "alphaMode"},
    {MATERIAL, NONE, "alphaCutoff"},
    {MATERIAL, NONE, "doubleSided"},
    {METALLIC_ROUGHNESS, NONE, "baseColorFactor"},
    {METALLIC_ROUGHNESS, TEXTURE_INFO, "baseColorTexture"},
    {METALLIC_ROUGHNESS, NONE, "metallicFactor"},
    {METALLIC_ROUGHNESS, NONE, "roughnessFactor"},
    {METALLIC_ROUGHNESS, TEXTURE_INFO, "metallicRoughnessTexture"},
    {TEXTURE_INFO, NONE, "index"},
    {TEXTURE_INFO, NONE, "texCoord"},
    {TEXTURE_INFO, NONE, "scale"},
    {TEXTURE_INFO, NONE, "strength"},
    {TEXTURE, NONE, "sampler"},
    {TEXTURE, NONE, "source"},
    {SAMPLER, NONE, "magFilter"},
    {SAMPLER, NONE, "minFilter"},
    {SAMPLER, NONE, "wrapS"},
    {SAMPLER, NONE, "wrapT"},
    {IMAGE, NONE, "uri"},
    {IMAGE, NONE, "mimeType"},
    {IMAGE, NONE, "bufferView"},
    {BUFFER, NONE, "uri"},
    {BUFFER, NONE, "byteLength"},
    {BUFFER_VIEW, NONE, "buffer"},
    {BUFFER_VIEW, NONE, "byteOffset"},
    {BUFFER_VIEW, NONE, "byteLength"},
    {BUFFER_VIEW, NONE, "byteStride"},
    {ACCESSOR, NONE, "bufferView"},
    {ACCESSOR, NONE, "byteOffset"},
    {ACCESSOR, NONE, "componentType"},
    {ACCESSOR, NONE, "normalized"},
    {ACCESSOR, NONE, "count"},
    {ACCESSOR, NONE, "type"},
    {ACCESSOR, NONE, "max"},
    {ACCESSOR, NONE, "min"},
    {ACCESSOR, SPARSE, "sparse"},
    {SPARSE, NONE, "count"},
    {SPARSE, SPARSE_PART, "indices"},
    {SPARSE, SPARSE_PART, "values"},
    {SPARSE_PART, NONE, "bufferView"},
    {SPARSE_PART, NONE, "byteOffset"},
    {SPARSE_PART, NONE, "componentType"},
    {SKIN, NONE, "inverseBindMatrices"},
    {SKIN, NONE, "joints"},
    {ANIMATION, CHANNEL, "channels"},
    {ANIMATION, ANIMATION_SAMPLER, "samplers"},
    {CHANNEL, NONE, "sampler"},
    {CHANNEL, TARGET, "target"},
    {TARGET, NONE, "node"},
    {TARGET, NONE, "path"},
    {ANIMATION_SAMPLER, NONE, "input"},
    {ANIMATION_SAMPLER, NONE, "interpolation"},
    {ANIMATION_SAMPLER, NONE, "output"},
    {CAMERA, ORTHOGRAPHIC, "orthographic"},
    {CAMERA, PERSPECTIVE, "perspective"},
    {CAMERA, NONE, "type"},
    {PERSPECTIVE, NONE, "aspectRatio"},
    {PERSPECTIVE, NONE, "yfov"},
    {PERSPECTIVE, NONE, "zfar"},
    {PERSPECTIVE, NONE, "znear"},
    {ORTHOGRAPHIC, NONE, "xmag"},
    {ORTHOGRAPHIC, NONE, "ymag"},
    {ORTHOGRAPHIC, NONE, "zfar"},
    {ORTHOGRAPHIC, NONE, "znear"},
    // Extensions that have properties, all of those of materials in one kind.
    {EXTENSIONS, LIGHTS, "KHR_lights_punctual"},
    {EXTENSIONS, TEXTURE_INFO, "KHR_texture_transform"},
    {EXTENSIONS, LAYER, "KHR_materials_anisotropy"},
    {EXTENSIONS, LAYER, "KHR_materials_clearcoat"},
    {EXTENSIONS, LAYER, "KHR_materials_dispersion"},
    {EXTENSIONS, LAYER, "KHR_materials_emissive_strength"},
    {EXTENSIONS, LAYER, "KHR_materials_ior"},
    {EXTENSIONS, LAYER, "KHR_materials_iridescence"},
    {EXTENSIONS, LAYER, "KHR_materials_pbrSpecularGlossiness"},
    {EXTENSIONS, LAYER, "KHR_materials_sheen"},
    {EXTENSIONS, LAYER, "KHR_materials_specular"},
    {EXTENSIONS, LAYER, "KHR_materials_transmission"},
    {EXTENSIONS, LAYER, "KHR_materials_volume"},
    {TEXTURE_INFO, NONE, "offset"},
    {TEXTURE_INFO, NONE, "rotation"},
    {LAYER, NONE, "anisotropyStrength"},
    {LAYER, NONE, "anisotropyRotation"},
    {LAYER, TEXTURE_INFO, "anisotropyTexture"},
    {LAYER, NONE, "clearcoatFactor"},
    {LAYER, TEXTURE_INFO, "clearcoatTexture"},
    {LAYER, NONE, "clearcoatRoughnessFactor"},
    {LAYER, TEXTURE_INFO, "clearcoatRoughnessTexture"},
    {LAYER, TEXTURE_INFO, "clearcoatNormalTexture"},
    {LAYER, NONE, "dispersion"},
    {LAYER, NONE, "emissiveStrength"},
    {LAYER, NONE, "ior"},
    {LAYER, NONE, "iridescenceFactor"},
    {LAYER, TEXTURE_INFO, "iridescenceTexture"},
    {LAYER, NONE, "iridescenceIor"},
    {LAYER, NONE, "iridescenceThicknessMinimum"},
    {LAYER, NONE, "iridescenceThicknessMaximum"},
    {LAYER, TEXTURE_INFO, "iridescenceThicknessTexture"},
    {LAYER, NONE, "diffuseFactor"},
    {LAYER, TEXTURE_INFO, "diffuseTexture"},
    {LAYER, NONE, "specularFactor"},
    {LAYER, NONE, "glossinessFactor"},
    {LAYER, TEXTURE_INFO, "specularGlossinessTexture"},
    {LAYER, NONE, "sheenColorFactor"},
    {LAYER, TEXTURE_INFO, "sheenColorTexture"},
    {LAYER, NONE, "sheenRoughnessFactor"},
    {LAYER, TEXTURE_INFO, "sheenRoughnessTexture"},
    {LAYER, TEXTURE_INFO, "specularTexture"},
    {LAYER, NONE, "specularColorFactor"},
    {LAYER, TEXTURE_INFO, "specularColorTexture"},
    {LAYER, NONE, "transmissionFactor"},
    {LAYER, TEXTURE_INFO, "transmissionTexture"},
    {LAYER, NONE, "thicknessFactor"},
    {LAYER, TEXTURE_INFO, "thicknessTexture"},
    {LAYER, NONE, "attenuationDistance"},
    {LAYER, NONE, "attenuationColor"},
    {LIGHTS, LIGHT, "lights"},
    {LIGHTS, NONE, "light"},
    {LIGHT, NONE, "color"},
    {LIGHT, NONE, "intensity"},
    {LIGHT, NONE, "type"},
    {LIGHT, NONE, "range"},
    {LIGHT, SPOT, "spot"},
    {SPOT, NONE, "innerConeAngle"},
    {SPOT, NONE, "outerConeAngle"},
};

static const struct property *find_property(enum kind of, const char *name)
{
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++) {
        if (properties[i].of == of && strcmp(properties[i].name, name) == 0) {
            return &properties[i];
        }
    }
    return NULL;
}

// Return how many letters must be put in, left out, changed or swapped with the next one to make one name of the other,
// whatever their case. Return more than 2 where names are longer than any of glTF's.
static unsigned distance(const char *a, const char *b)
{
    enum { LONGEST = 40 };
    const size_t rows = strlen(a), columns = strlen(b);
    unsigned cost[LONGEST + 1][LONGEST + 1];
    if (rows > LONGEST || columns > LONGEST) {
        return LONGEST;
    }
    for (size_t i = 0; i <= rows; i++) {
        for (size_t k = 0; k <= columns; k++) {
            if (i == 0 || k == 0) {
                cost[i][k] = (unsigned)(i + k);
                continue;
            }
            const bool same = tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[k - 1]);
            unsigned least = cost[i - 1][k - 1] + !same;
            least = cost[i - 1][k] + 1 < least ? cost[i - 1][k] + 1 : least;
            least = cost[i][k - 1] + 1 < least ? cost[i][k - 1] + 1 : least;
            const bool swapped = i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1];
            cost[i][k] = swapped && cost[i - 2][k - 2] + 1 < least ? cost[i - 2][k - 2] + 1 : least;
        }
    }
    return cost[rows][columns];
}

// Tell of a property of another name that is nearly that of one which the object has not.
static void tell_near(struct scene_gltf *gltf, enum kind of, const json_t *object, const char *name)
{
    for (size_t i = 0; i < sizeof properties / sizeof *properties; i++) {
        const char *const known = properties[i].name;
        const unsigned most = strlen(known) < 5   ? 0
                              : strlen(known) < 8 ? 1
                                                  : 2; // short names are near others
        const size_t shorter = strlen(name) < strlen(known) ? strlen(name) : strlen(known);
        const bool may_be = strlen(name) + strlen(known) - 2 * shorter <= most;
        if (properties[i].of == of && may_be && distance(name, known) <= most &&
            json_object_get(object, known) == NULL) {
            scene_import_unsupported(gltf->import,
                                     "the property \"%.60s\" (glTF), which should be \"%s\": not used",
                                     scene_import_string(gltf->import, name, strlen(name)), known);
            return;
        }
    }
}

static void look_at(struct scene_gltf *gltf, enum kind kind, json_t *value);

static void look_at_object(struct scene_gltf *gltf, enum kind kind, json_t *object)
{
    const char *name;
    json_t *value;
    json_object_foreach(object, name, value)
    {
        const struct property *const property = find_property(kind, name);
        if (strcmp(name, "extensions") == 0) {
            look_at(gltf, EXTENSIONS, value);
        } else if (property != NULL) {
            look_at(gltf, property->kind, value);
        } else if (kind != EXTENSIONS && strcmp(name, "extras") != 0 && strcmp(name, "name") != 0) {
            tell_near(gltf, kind, object, name);
        }
    }
}

// Look at an object, or at each of a list.
static void look_at(struct scene_gltf *gltf, enum kind kind, json_t *value)
{
    size_t i;
    json_t *item;
    if (kind == NONE) {
        return;
    }
    if (json_is_object(value)) {
        look_at_object(gltf, kind, value);
    }
    json_array_foreach(value, i, item)
    {
        if (json_is_object(item)) {
            look_at_object(gltf, kind, item);
        }
    }
}

void scene_gltf_tell_misspelt(struct scene_gltf *gltf)
{
    look_at(gltf, ROOT, gltf->root);
}
