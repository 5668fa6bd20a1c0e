// SPDX-License-Identifier: MIT
// Materials of assimp's scenes become metallic-roughness: where a format has those values they are taken,
// else Phong's are converted. Colours in these formats are meant as they look on the screen (sRGB).
#include <assimp/material.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import_assimp.h"

// What a surface of no described material looks like: a light grey, neither dull nor shiny.
static const float default_grey = 0.6f, default_roughness = 0.55f;

const char *rhw_assimp_string(struct rhw_import *import, const struct aiString *string)
{
    return rhw_import_string(import, string->data, string->length < sizeof string->data ? string->length : sizeof string->data - 1);
}

struct reader {
    struct rhw_import *import;
    const struct aiScene *scene;
    const struct aiMaterial *source;
    struct rhw_material *material;
};

// Values --------------------------------------------------------------------------------------------

static bool get_float(const struct reader *reader, const char *key, float *value)
{
    float read = 0;
    const bool found = aiGetMaterialFloatArray(reader->source, key, 0, 0, &read, NULL) == aiReturn_SUCCESS;
    if (!found || !rhw_import_finite(&read, 1))
        return false;
    *value = read;
    return true;
}

static int get_integer(const struct reader *reader, const char *key, int fallback)
{
    int value = 0;
    return aiGetMaterialIntegerArray(reader->source, key, 0, 0, &value, NULL) == aiReturn_SUCCESS ? value : fallback;
}

// A colour, linear.
static bool get_color(const struct reader *reader, const char *key, float color[3])
{
    struct aiColor4D read;
    if (aiGetMaterialColor(reader->source, key, 0, 0, &read) != aiReturn_SUCCESS)
        return false;
    const float encoded[3] = {read.r, read.g, read.b};
    if (!rhw_import_finite(encoded, 3))
        return false;
    for (int c = 0; c < 3; c++)
        color[c] = rhw_import_from_srgb(encoded[c] > 1 ? 1 : encoded[c]);
    return true;
}

static float limited(float value, float least, float most)
{
    return value < least ? least : value > most ? most : value;
}

// Textures ------------------------------------------------------------------------------------------

// assimp keeps uncompressed textures as BGRA.
static void raw_texels(struct rhw_import *import, const struct aiTexture *texture, struct rhw_import_source *source)
{
    const size_t count = (size_t)texture->mWidth * texture->mHeight;
    if (texture->mWidth == 0 || texture->mWidth > RHW_MAX_TARGET_SIZE || texture->mHeight > RHW_MAX_TARGET_SIZE) {
        source->problem = "width and height must be 1 to 16384";
        return;
    }
    uint8_t(*texels)[4] = rhw_import_allocate(import, count, sizeof *texels);
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
    if (path[0] == '*')
        return number < scene->mNumTextures ? scene->mTextures[number] : NULL;
    for (uint32_t i = 0; i < scene->mNumTextures; i++)
        if (strcmp(scene->mTextures[i]->mFilename.data, path) == 0)
            return scene->mTextures[i];
    return NULL;
}

static bool same_text(const char *a, const char *b)
{
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

// The image with this source, new or shared with another slot.
static int32_t find_or_add(struct rhw_import *import, const char *name, const struct rhw_import_source *source)
{
    for (uint32_t i = 0; i < import->source_count; i++) {
        const struct rhw_import_source *other = &import->sources[i];
        if (same_text(other->file, source->file) && other->bytes == source->bytes && other->height == source->height
            && other->opacity_image == source->opacity_image && other->white == source->white
            && strcmp(import->model.images[i].name, name) == 0)
            return (int32_t)i;
    }
    return rhw_import_add_image(import, name, source);
}

static enum rhw_address address(enum aiTextureMapMode mode)
{
    return mode == aiTextureMapMode_Clamp ? RHW_ADDRESS_CLAMP
        : mode == aiTextureMapMode_Mirror ? RHW_ADDRESS_MIRROR
        : mode == aiTextureMapMode_Decal  ? RHW_ADDRESS_BORDER
                                          : RHW_ADDRESS_REPEAT;
}

// assimp scales, then turns about the middle of the image, then moves, with v upward; ours is downward.
static void read_transform(const struct reader *reader, enum aiTextureType type, struct rhw_texture_slot *slot)
{
    struct aiUVTransform t;
    if (aiGetMaterialUVTransform(reader->source, _AI_MATKEY_UVTRANSFORM_BASE, (unsigned)type, 0, &t) != aiReturn_SUCCESS)
        return;
    const float c = (float)cos((double)t.mRotation), s = (float)sin((double)t.mRotation);
    const float x = t.mScaling.x, y = t.mScaling.y;
    // Upward: u' = c·x·u − s·y·v + e, v' = s·x·u + c·y·v + f; then v → 1 − v on both sides.
    const float e = 0.5f * (1 - c + s) + t.mTranslation.x, f = 0.5f * (1 - s - c) + t.mTranslation.y;
    const float transform[6] = {c * x, s * y, e - s * y, -s * x, c * y, 1 - f - c * y};
    if (rhw_import_finite(transform, 6))
        memcpy(slot->transform, transform, sizeof transform);
}

// Fills `source` and `slot` with the first texture of a type. Returns its name, or NULL.
static const char *get_texture(const struct reader *reader, enum aiTextureType type, struct rhw_import_source *source,
                               struct rhw_texture_slot *slot)
{
    struct aiString path;
    enum aiTextureMapping mapping = aiTextureMapping_UV;
    enum aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned set = 0;
    *source = (struct rhw_import_source){.opacity_image = -1, .problem = "No such file or directory"};
    if (aiGetMaterialTexture(reader->source, type, 0, &path, &mapping, &set, NULL, NULL, modes, NULL) != aiReturn_SUCCESS
        || path.length == 0)
        return NULL;
    const struct aiTexture *texture = embedded(reader, path.data);
    if (texture != NULL && texture->mHeight == 0) {
        source->bytes = texture->pcData;
        source->size = texture->mWidth;
    } else if (texture != NULL) {
        raw_texels(reader->import, texture, source);
    } else {
        source->file = rhw_import_find_file(reader->import, path.data);
    }
    slot->uv_set = set < RHW_UV_SETS ? set : 0;
    slot->address_u = address(modes[0]);
    slot->address_v = address(modes[1]);
    read_transform(reader, type, slot);
    return rhw_assimp_string(reader->import, &path);
}

static bool read_slot(const struct reader *reader, enum aiTextureType type, enum rhw_slot kind)
{
    struct rhw_import_source source;
    struct rhw_texture_slot slot = rhw_import_slot_default();
    const char *name = get_texture(reader, type, &source, &slot);
    if (name == NULL)
        return false;
    source.height = type == aiTextureType_HEIGHT;
    slot.image = find_or_add(reader->import, name, &source);
    reader->material->slots[kind] = slot;
    return true;
}

// The base colour's image gets the opacity map as its alpha; without one, the map becomes a white image.
static void read_opacity(const struct reader *reader, bool textured, enum aiTextureType color)
{
    struct rhw_import *import = reader->import;
    struct rhw_import_source opacity, source;
    struct rhw_texture_slot opacity_slot = rhw_import_slot_default(), slot = opacity_slot;
    const char *opacity_name = get_texture(reader, aiTextureType_OPACITY, &opacity, &opacity_slot);
    if (opacity_name == NULL)
        return;
    const int32_t map = find_or_add(import, opacity_name, &opacity);
    const char *name = textured ? get_texture(reader, color, &source, &slot) : opacity_name;
    if (!textured) {
        source = opacity;
        source.white = true;
        slot = opacity_slot;
    }
    source.opacity_image = map;
    slot.image = find_or_add(import, name, &source);
    reader->material->slots[RHW_SLOT_BASE_COLOR] = slot;
    reader->material->alpha_mode = RHW_ALPHA_BLEND; // MASK, if the decoded map turns out to be one
}

// Material ------------------------------------------------------------------------------------------

static bool read_base_color(const struct reader *reader, bool colored)
{
    struct rhw_material *material = reader->material;
    struct aiString name;
    const bool textured = read_slot(reader, aiTextureType_BASE_COLOR, RHW_SLOT_BASE_COLOR)
        || read_slot(reader, aiTextureType_DIFFUSE, RHW_SLOT_BASE_COLOR);
    const bool described = get_color(reader, "$clr.base", material->base_color)
        || get_color(reader, "$clr.diffuse", material->base_color);
    const bool is_default = aiGetMaterialString(reader->source, "?mat.name", 0, 0, &name) == aiReturn_SUCCESS
        && strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0;
    const float *color = material->base_color;
    const bool black = color[0] == 0 && color[1] == 0 && color[2] == 0;
    // Colours or a texture say it all. A black factor under a texture is an exporter's habit, not a wish.
    const bool all_said = colored || (textured && (black || !described)) || (textured && is_default);
    for (int c = 0; c < 3; c++)
        if (all_said)
            material->base_color[c] = 1;
        else if (!described || is_default)
            material->base_color[c] = default_grey;
    return textured;
}

static void read_surface(const struct reader *reader)
{
    struct rhw_material *material = reader->material;
    float shininess = 0, specular[3] = {0, 0, 0};
    material->metallic = 0;
    material->roughness = default_roughness;
    get_color(reader, "$clr.specular", specular);
    // Blinn-Phong's exponent n as roughness: α = √(2 / (n + 2)), α = roughness² (Walter and others, 2007).
    if (get_float(reader, "$mat.shininess", &shininess) && shininess > 0)
        material->roughness = limited(sqrtf(sqrtf(2 / (shininess + 2))), 0.1f, 1);
    if (get_integer(reader, "$mat.shadingm", aiShadingMode_Phong) == aiShadingMode_Gouraud
        || (shininess > 0 && specular[0] + specular[1] + specular[2] == 0))
        material->roughness = limited(material->roughness, 0.8f, 1);
    float value = 0;
    if (get_float(reader, "$mat.metallicFactor", &value))
        material->metallic = limited(value, 0, 1);
    if (get_float(reader, "$mat.roughnessFactor", &value))
        material->roughness = limited(value, 0, 1);
    material->unlit = get_integer(reader, "$mat.shadingm", aiShadingMode_Phong) == aiShadingMode_NoShading;
}

static void read_opacity_factor(const struct reader *reader)
{
    struct rhw_material *material = reader->material;
    float opacity = 1;
    get_float(reader, "$mat.opacity", &opacity);
    if (opacity <= 0) {
        rhw_import_warn(reader->import, "material \"%s\" is wholly transparent: drawn opaque", material->name);
        opacity = 1;
    }
    material->base_color[3] = limited(opacity, 0, 1);
    if (opacity < 1)
        material->alpha_mode = RHW_ALPHA_BLEND;
}

static void read_other_textures(const struct reader *reader)
{
    struct rhw_material *material = reader->material;
    if (!read_slot(reader, aiTextureType_NORMALS, RHW_SLOT_NORMAL)
        && !read_slot(reader, aiTextureType_NORMAL_CAMERA, RHW_SLOT_NORMAL))
        read_slot(reader, aiTextureType_HEIGHT, RHW_SLOT_NORMAL);
    read_slot(reader, aiTextureType_AMBIENT_OCCLUSION, RHW_SLOT_OCCLUSION);
    get_color(reader, "$clr.emissive", material->emissive);
    if (!read_slot(reader, aiTextureType_EMISSIVE, RHW_SLOT_EMISSIVE))
        read_slot(reader, aiTextureType_EMISSION_COLOR, RHW_SLOT_EMISSIVE);
    const float *emissive = material->emissive;
    if (material->slots[RHW_SLOT_EMISSIVE].image >= 0 && emissive[0] + emissive[1] + emissive[2] == 0)
        material->emissive[0] = material->emissive[1] = material->emissive[2] = 1;
    static const struct {
        enum aiTextureType type;
        const char *name;
    } unused[] = {
        {aiTextureType_SPECULAR, "specular"},          {aiTextureType_SHININESS, "shininess"},
        {aiTextureType_REFLECTION, "reflection"},      {aiTextureType_DISPLACEMENT, "displacement"},
        {aiTextureType_METALNESS, "separate metallic"}, {aiTextureType_DIFFUSE_ROUGHNESS, "separate roughness"},
    };
    for (size_t i = 0; i < sizeof unused / sizeof unused[0]; i++)
        if (aiGetMaterialTextureCount(reader->source, unused[i].type) > 0)
            rhw_import_unsupported(reader->import, "%s textures: not used", unused[i].name);
}

uint32_t rhw_assimp_material(struct rhw_import *import, const struct aiScene *scene, const struct aiMaterial *source,
                             bool colored)
{
    struct reader reader = {import, scene, source, rhw_import_add_material(import)};
    struct aiString name;
    if (aiGetMaterialString(source, "?mat.name", 0, 0, &name) == aiReturn_SUCCESS)
        reader.material->name = rhw_assimp_string(import, &name);
    reader.material->double_sided = true; // none of these formats can be trusted to know
    const bool textured = read_base_color(&reader, colored);
    const bool base = textured && aiGetMaterialTextureCount(source, aiTextureType_BASE_COLOR) > 0;
    read_surface(&reader);
    read_opacity_factor(&reader);
    read_opacity(&reader, textured, base ? aiTextureType_BASE_COLOR : aiTextureType_DIFFUSE);
    read_other_textures(&reader);
    return import->model.material_count - 1;
}
