// SPDX-License-Identifier: MIT
// What assimp says about a material, as struct scene_phong.
#include <assimp/material.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "elementary.h"
#include "assimp.h"
#include "import/builder/find_file.h"
#include "import/builder/name_forms.h"
#include "import/builder/numbers.h"
#include "import/builder/phong.h"
#include "skins.h"
#include "x3d_materials.h"

const char *scene_assimp_string(struct scene_import *import, const struct aiString *string)
{
    const size_t most = sizeof string->data - 1;
    return scene_import_string(import, string->data, string->length < most ? string->length : most);
}

struct reader {
    struct scene_import *import;
    const struct aiScene *scene;
    const struct aiMaterial *source;
};

// Values --------------------------------------------------------------------------------------------

// End texts with a 0 where they say. assimp's own reader of materials ends the process for one that has none there, as
// those of MDL7 may have.
static void mend_texts(const struct aiMaterial *material)
{
    enum { LEAST = sizeof(uint32_t) + 1, MOST = sizeof(((struct aiString *)NULL)->data) + sizeof(uint32_t) };
    for (unsigned i = 0; i < material->mNumProperties; i++) {
        struct aiMaterialProperty *const property = material->mProperties[i];
        if (property->mType == aiPTI_String && property->mDataLength >= LEAST &&
            property->mDataLength <= MOST) {
            const uint32_t length = property->mDataLength - LEAST;
            memcpy(property->mData, &length, sizeof length);
            property->mData[property->mDataLength - 1] = 0;
        } else if (property->mType == aiPTI_String) {
            property->mType = aiPTI_Buffer;
        }
    }
}

static void get_float(const struct reader *reader, const char *key, float *value)
{
    float read = 0;
    if (aiGetMaterialFloatArray(reader->source, key, 0, 0, &read, &(unsigned){1}) == aiReturn_SUCCESS &&
        scene_import_finite(&read, 1)) {
        *value = read;
    }
}

static int get_integer(const struct reader *reader, const char *key, int fallback)
{
    int value = 0;
    return aiGetMaterialIntegerArray(reader->source, key, 0, 0, &value, &(unsigned){1}) == aiReturn_SUCCESS
               ? value
               : fallback;
}

static bool get_color(const struct reader *reader, const char *key, float color[3])
{
    struct aiColor4D read;
    if (aiGetMaterialColor(reader->source, key, 0, 0, &read) != aiReturn_SUCCESS) {
        return false;
    }
    const float encoded[3] = {read.r, read.g, read.b};
    if (!scene_import_finite(encoded, 3)) {
        return false;
    }
    memcpy(color, encoded, sizeof encoded);
    return true;
}

// Read how opaque a surface is. Exporters of FBX write TransparencyFactor or Opacity or both, and some a factor of 0 or
// 1 that nobody meant. Blender, which says that Unity does, and three.js believe the factor between these two, and
// else the opacity. assimp knows the latter, or finds it by TransparentColor.
static void get_opacity(const struct reader *reader, float *opacity)
{
    float factor = 0;
    get_float(reader, "$mat.opacity", opacity);
    get_float(reader, "$mat.transparencyfactor", &factor);
    struct aiColor4D face;
    if (strcasecmp(reader->import->ending, "x") == 0 &&
        aiGetMaterialColor(reader->source, "$clr.diffuse", 0, 0, &face) == aiReturn_SUCCESS && face.a >= 0) {
        *opacity = face.a; // the face colour of DirectX has an alpha
    }
    if (strcasecmp(reader->import->ending, "fbx") == 0 && factor > 0 && factor < 1) {
        *opacity = 1 - factor;
    }
}

// Textures ------------------------------------------------------------------------------------------

// assimp keeps uncompressed textures as BGRA.
static void raw_texels(struct scene_import *import, const struct aiTexture *texture,
                       struct scene_import_source *source)
{
    const size_t count = (size_t)texture->mWidth * texture->mHeight;
    if (texture->mWidth == 0 || texture->mWidth > RHW_MAX_TARGET_SIZE ||
        texture->mHeight > RHW_MAX_TARGET_SIZE) {
        source->problem = "width and height must be 1 to 16384";
        return;
    }
    uint8_t(*texels)[4] = scene_import_allocate(import, count, sizeof *texels);
    for (size_t i = 0; i < count; i++) {
        const struct aiTexel *texel = &texture->pcData[i];
        const uint8_t turned[4] = {texel->r, texel->g, texel->b, texel->a};
        memcpy(texels[i], turned, sizeof turned);
    }
    source->bytes = texels;
    source->size = count * sizeof *texels;
    source->raw_width = texture->mWidth;
    source->raw_height = texture->mHeight;
}

static const struct aiTexture *embedded(const struct reader *reader, const char *path)
{
    const struct aiScene *scene = reader->scene;
    const unsigned long number = path[0] == '*' ? strtoul(path + 1, NULL, 10) : 0;
    if (path[0] == '*') {
        return number < scene->mNumTextures ? scene->mTextures[number] : NULL;
    }
    for (uint32_t i = 0; i < scene->mNumTextures; i++) {
        if (strcmp(scene->mTextures[i]->mFilename.data, path) == 0) {
            return scene->mTextures[i];
        }
    }
    return NULL;
}

static bool is_x3d(const struct scene_import *import)
{
    return strcasecmp(import->ending, "x3d") == 0;
}

// assimp 5.2.5 gives what an X3D repeats as what it does not, and the other way round.
static enum rhw_address address(const struct scene_import *import, enum aiTextureMapMode mode)
{
    if (is_x3d(import)) {
        return mode == aiTextureMapMode_Clamp ? RHW_ADDRESS_REPEAT : RHW_ADDRESS_CLAMP;
    }
    return mode == aiTextureMapMode_Clamp    ? RHW_ADDRESS_CLAMP
           : mode == aiTextureMapMode_Mirror ? RHW_ADDRESS_MIRROR
           : mode == aiTextureMapMode_Decal  ? RHW_ADDRESS_BORDER
                                             : RHW_ADDRESS_REPEAT;
}

// assimp scales, then turns about the middle of the image, then moves, with v upward; ours is downward. An X3D turns
// about the origin, then scales, as it is written for assimp.
static void read_transform(const struct reader *reader, enum aiTextureType type,
                           struct scene_texture_slot *slot)
{
    struct aiUVTransform t;
    if (aiGetMaterialUVTransform(reader->source, _AI_MATKEY_UVTRANSFORM_BASE, (unsigned)type, 0, &t) !=
        aiReturn_SUCCESS) {
        return;
    }
    const float c = (float)scene_cos((double)t.mRotation), s = (float)scene_sin((double)t.mRotation);
    const float x = t.mScaling.x, y = t.mScaling.y;
    const bool is_scaled_last = is_x3d(reader->import);
    // Upward: u' = m0·u + m1·v + e, v' = m2·u + m3·v + f; then v → 1 − v on both sides.
    const float m[4] = {c * x, -s * (is_scaled_last ? x : y), s * (is_scaled_last ? y : x), c * y};
    const float e = t.mTranslation.x + (is_scaled_last ? 0 : 0.5f * (1 - c + s)),
                f = t.mTranslation.y + (is_scaled_last ? 0 : 0.5f * (1 - s - c));
    const float transform[6] = {m[0], -m[1], e + m[1], -m[2], m[3], 1 - f - m[3]};
    if (scene_import_finite(transform, 6)) {
        memcpy(slot->transform, transform, sizeof transform);
    }
}

// What some of assimp's importers give a material that has no texture.
static bool is_dummy(const char *name)
{
    return strncmp(name, "$texture_dummy", 14) == 0;
}

// Tell of what assimp says of a texture's use and is not drawn: a strength below 1, and operations but the usual one.
static void tell_of_use(const struct reader *reader, enum aiTextureType type)
{
    float strength = 1;
    int flags = 0, operation = 0;
    aiGetMaterialFloatArray(reader->source, _AI_MATKEY_TEXBLEND_BASE, (unsigned)type, 0, &strength,
                            &(unsigned){1});
    aiGetMaterialIntegerArray(reader->source, _AI_MATKEY_TEXFLAGS_BASE, (unsigned)type, 0, &flags,
                              &(unsigned){1});
    aiGetMaterialIntegerArray(reader->source, _AI_MATKEY_TEXOP_BASE, (unsigned)type, 0, &operation,
                              &(unsigned){1});
    if (strength < 0.999f && type != aiTextureType_HEIGHT && type != aiTextureType_NORMALS) {
        scene_import_unsupported(reader->import, "textures of less than their whole strength: drawn whole");
    }
    if (flags & aiTextureFlags_Invert) {
        scene_import_unsupported(reader->import, "inverted textures: drawn as they are");
    }
    if (operation != aiTextureOp_Multiply) {
        scene_import_unsupported(reader->import, "textures that are added or subtracted: multiplied");
    }
}

// Tell of a texture whose place another one has taken.
static void tell_of_second(const struct reader *reader, enum aiTextureType type,
                           const struct scene_phong_texture *texture)
{
    struct aiString path;
    if (aiGetMaterialTexture(reader->source, type, 0, &path, NULL, NULL, NULL, NULL, NULL, NULL) ==
            aiReturn_SUCCESS &&
        path.length > 0 && !is_dummy(path.data) &&
        strcmp(texture->name, scene_assimp_string(reader->import, &path)) != 0) {
        scene_import_unsupported(reader->import, "textures for one purpose: the first alone is used");
    }
}

// The first texture of a type, if there is one and `texture` is not taken yet.
static void read_texture(const struct reader *reader, enum aiTextureType type,
                         struct scene_phong_texture *texture)
{
    struct aiString path;
    enum aiTextureMapping mapping = aiTextureMapping_UV;
    enum aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned set = 0;
    if (texture->name != NULL) {
        tell_of_second(reader, type, texture);
        return;
    }
    if (aiGetMaterialTexture(reader->source, type, 0, &path, &mapping, &set, NULL, NULL, modes, NULL) !=
            aiReturn_SUCCESS ||
        path.length == 0 || is_dummy(path.data)) {
        return;
    }
    if (strncmp(path.data, "Procedural,", 11) == 0) {
        scene_import_unsupported(reader->import, "textures that are no images: left out");
        return;
    }
    const struct aiTexture *inside = embedded(reader, path.data);
    if (strcasecmp(reader->import->ending, "x3d") == 0) { // assimp has got its blanks as %20
        path.length = (ai_uint32)strlen(scene_name_decode_percent(path.data));
    }
    texture->name = scene_assimp_string(reader->import, &path);
    if (inside != NULL && inside->mHeight == 0) {
        texture->source.bytes = inside->pcData;
        texture->source.size = inside->mWidth;
    } else if (inside != NULL) {
        raw_texels(reader->import, inside, &texture->source);
    } else {
        scene_import_find_image(reader->import, NULL, path.data, &texture->source);
    }
    tell_of_use(reader, type);
    if (set >= SCENE_UV_SETS) {
        scene_import_unsupported(reader->import, "texture coordinate set %u: set 0 is read instead", set);
    }
    if (mapping != aiTextureMapping_UV) {
        scene_import_unsupported(reader->import,
                                 "textures without coordinates: not mapped as they are meant");
    }
    if (aiGetMaterialTextureCount(reader->source, type) > 1) {
        scene_import_unsupported(reader->import, "textures above each other: the first alone is used");
    }
    texture->slot.uv_set = set < SCENE_UV_SETS ? set : 0;
    texture->slot.address_u = address(reader->import, modes[0]);
    texture->slot.address_v = address(reader->import, modes[1]);
    read_transform(reader, type, &texture->slot);
}

// Return true for formats in which the alpha of a texture is that of the surface, as X3D defines it, and as all
// programs draw AC3D. What is wholly transparent in them is meant to be, as panes for clicks are.
static bool has_alpha(const struct scene_import *import)
{
    static const char *const endings[] = {"ac", "acc", "x3d"};
    bool has = false;
    for (size_t i = 0; i < sizeof endings / sizeof endings[0] && !has; i++) {
        has = strcasecmp(import->ending, endings[i]) == 0;
    }
    return has;
}

// Take the skin that lies beside a model for games in place of one that is not there.
static void read_skin(const struct reader *reader, struct scene_phong_texture *texture)
{
    struct scene_import_source skin = texture->source;
    if (!scene_assimp_has_skins(reader->import) || skin.file != NULL || skin.bytes != NULL) {
        return;
    }
    if (!scene_assimp_find_skin(reader->import, texture->name, &skin)) {
        if (texture->name == NULL) {
            scene_import_unsupported(reader->import, "skins that the file does not name: not drawn");
        }
        return;
    }
    const char *const folder = reader->import->directory[0] != 0 ? reader->import->directory : "./";
    const char *const name = skin.file + strlen(folder); // from the folder of the model
    if (texture->name == NULL) {
        scene_import_warn(reader->import, "names no skin; \"%s\" beside it is drawn", name);
    } else {
        scene_import_warn(reader->import, "skin \"%s\" is not there; \"%s\" is drawn", texture->name, name);
    }
    texture->name = scene_import_string(reader->import, name, strlen(name));
    texture->source = skin;
}

static void read_textures(const struct reader *reader, struct scene_phong *phong)
{
    read_texture(reader, aiTextureType_BASE_COLOR, &phong->color);
    read_texture(reader, aiTextureType_DIFFUSE, &phong->color);
    read_skin(reader, &phong->color);
    phong->color.source.is_skin = scene_assimp_has_skins(reader->import);
    read_texture(reader, aiTextureType_OPACITY, &phong->opacity_map);
    phong->color.source.is_opacity = phong->color.name != NULL && has_alpha(reader->import);
    // Collada calls relief what may be heights or normals, which the image itself tells.
    const bool is_relief = strcmp(reader->import->model.format, "Collada") == 0;
    read_texture(reader, aiTextureType_NORMALS, is_relief ? &phong->height : &phong->normal);
    read_texture(reader, aiTextureType_NORMAL_CAMERA, &phong->normal);
    read_texture(reader, aiTextureType_HEIGHT, &phong->height);
    read_texture(reader, aiTextureType_AMBIENT_OCCLUSION, &phong->occlusion);
    read_texture(reader, aiTextureType_EMISSIVE, &phong->emissive_map);
    read_texture(reader, aiTextureType_EMISSION_COLOR, &phong->emissive_map);
    read_texture(reader, aiTextureType_METALNESS, &phong->metallic_map);
    read_texture(reader, aiTextureType_DIFFUSE_ROUGHNESS, &phong->roughness_map);
    static const struct {
        enum aiTextureType type;
        const char *name;
    } unused[] = {
        {aiTextureType_SPECULAR, "specular"},     {aiTextureType_SHININESS, "shininess"},
        {aiTextureType_REFLECTION, "reflection"}, {aiTextureType_DISPLACEMENT, "displacement"},
        {aiTextureType_LIGHTMAP, "light"},        {aiTextureType_SHEEN, "sheen"},
        {aiTextureType_CLEARCOAT, "clearcoat"},   {aiTextureType_TRANSMISSION, "transmission"},
        {aiTextureType_UNKNOWN, "other"},
    };
    for (size_t i = 0; i < sizeof unused / sizeof unused[0]; i++) {
        if (aiGetMaterialTextureCount(reader->source, unused[i].type) > 0) {
            scene_import_unsupported(reader->import, "%s textures: not used", unused[i].name);
        }
    }
    // Most ambient textures are the colour's as well.
    struct aiString ambient;
    if (aiGetMaterialTexture(reader->source, aiTextureType_AMBIENT, 0, &ambient, NULL, NULL, NULL, NULL, NULL,
                             NULL) == aiReturn_SUCCESS &&
        ambient.length > 0 && !is_dummy(ambient.data) &&
        (phong->color.name == NULL ||
         strcmp(phong->color.name, scene_assimp_string(reader->import, &ambient)) != 0)) {
        scene_import_unsupported(reader->import, "ambient textures: not used");
    }
}

// Return true for a colour of the material that assimp gives to what has none. Its reader of NFF gives the name of that
// material to all.
static bool is_default_grey(const float color[3])
{
    static const float greys[] = {0.6f, 0.8f};
    bool is_default = false;
    for (size_t i = 0; i < sizeof greys / sizeof greys[0]; i++) {
        is_default = is_default || (color[0] == greys[i] && color[1] == greys[i] && color[2] == greys[i]);
    }
    return is_default;
}

static bool is_black(const float color[3])
{
    return !(color[0] > 0 || color[1] > 0 || color[2] > 0);
}

// Make what a material without light sends out its colour, which it is in Collada: it has no other one there, but in
// files that keep to no schema.
static void show_emission(const struct scene_import *import, struct scene_phong *phong)
{
    const bool is_dark = is_black(phong->emissive) && phong->emissive_map.name == NULL;
    if (!phong->unlit || strcmp(import->model.format, "Collada") != 0 || phong->color.name != NULL ||
        (is_dark && !is_default_grey(phong->diffuse))) {
        return;
    }
    memcpy(phong->diffuse, phong->emissive, sizeof phong->diffuse);
    memset(phong->emissive, 0, sizeof phong->emissive);
    phong->color = phong->emissive_map;
    phong->emissive_map = scene_phong_texture_default();
    phong->described = true;
}

// Let light that a material sends out come through its texture, as in formats for hardware and programs that multiply
// the sum of all light by it.
static void glow_through_texture(const struct scene_import *import, struct scene_phong *phong)
{
    static const char *const endings[] = {"3ds", "ac", "acc", "ase", "lwo", "lws", "ms3d", "x"};
    bool is_multiplied = false;
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        is_multiplied = is_multiplied || strcasecmp(import->ending, endings[i]) == 0;
    }
    if (is_multiplied && phong->emissive_map.name == NULL && !is_black(phong->emissive)) {
        phong->emissive_map = phong->color;
    }
}

// Return true for the material that assimp gives to what has none. That of 3DS and IFC is darker, by another name.
static bool is_default(const struct scene_phong *phong)
{
    return (strcmp(phong->name, AI_DEFAULT_MATERIAL_NAME) == 0 && is_default_grey(phong->diffuse)) ||
           strcmp(phong->name, "%%%DEFAULT") == 0 || strcmp(phong->name, "<IFCDefault>") == 0;
}

uint32_t scene_assimp_material(struct scene_import *import, const struct aiScene *scene,
                               const struct aiMaterial *source, bool colored)
{
    const struct reader reader = {import, scene, source};
    struct scene_phong phong = scene_phong_default();
    struct aiString name;
    mend_texts(source);
    if (aiGetMaterialString(source, "?mat.name", 0, 0, &name) == aiReturn_SUCCESS) {
        phong.name = scene_assimp_string(import, &name);
    }
    phong.colored = colored;
    phong.described =
        get_color(&reader, "$clr.base", phong.diffuse) || get_color(&reader, "$clr.diffuse", phong.diffuse);
    if (is_default(&phong)) {
        phong.described = false;
    }
    get_color(&reader, "$clr.specular", phong.specular);
    get_color(&reader, "$clr.emissive", phong.emissive);
    get_opacity(&reader, &phong.opacity);
    phong.may_be_clear = has_alpha(import);
    get_float(&reader, "$mat.shininess", &phong.shininess);
    get_float(&reader, "$mat.metallicFactor", &phong.metallic);
    get_float(&reader, "$mat.roughnessFactor", &phong.roughness);
    if (get_integer(&reader, "$mat.blend", aiBlendMode_Default) == aiBlendMode_Additive) {
        scene_import_unsupported(import, "additive blending: drawn as ordinary blending");
    }
    if (get_integer(&reader, "$mat.wireframe", 0) != 0) {
        scene_import_unsupported(import, "wire frames: drawn as surfaces");
    }
    const int shading = get_integer(&reader, "$mat.shadingm", aiShadingMode_Phong);
    const bool is_x3d_unlit = phong.shininess == SCENE_X3D_UNLIT && strcasecmp(import->ending, "x3d") == 0;
    if (is_x3d_unlit) {
        phong.shininess = 0;
        phong.described = true;
    }
    phong.unlit = is_x3d_unlit || shading == aiShadingMode_NoShading;
    phong.dull = shading == aiShadingMode_Gouraud;
    read_textures(&reader, &phong);
    show_emission(import, &phong);
    glow_through_texture(import, &phong);
    return scene_phong_add(import, &phong);
}
