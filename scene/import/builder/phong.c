// SPDX-License-Identifier: MIT
// Phong's values become metallic-roughness. Colours in these formats are meant as they look on the screen, so they are
// decoded from sRGB.
#include "phong.h"

#include "hash_table.h"
#include "numbers.h"

#include <string.h>

#include "elementary.h"

// A surface whose material is not described is a light grey, neither dull nor shiny.
static const float default_grey = 0.6f, default_roughness = 0.55f;

struct scene_phong_texture scene_phong_texture_default(void)
{
    return (struct scene_phong_texture){
        .source = {.opacity_image = -1, .problem = "No such file or directory"},
        .slot = scene_import_slot_default(),
    };
}

struct scene_phong scene_phong_default(void)
{
    const struct scene_phong_texture none = scene_phong_texture_default();
    return (struct scene_phong){
        .name = "",
        .opacity = 1,
        .metallic = -1,
        .roughness = -1,
        .color = none,
        .opacity_map = none,
        .normal = none,
        .height = none,
        .occlusion = none,
        .emissive_map = none,
        .roughness_map = none,
        .metallic_map = none,
        .normal_scale = 1,
        .clearcoat_map = none,
        .clearcoat_roughness_map = none,
    };
}

static float limited(float value, float least, float most)
{
    return value > most ? most : value >= least ? value : least; // NaN gives `least`
}

static bool is_black(const float color[3])
{
    return !(color[0] > 0 || color[1] > 0 || color[2] > 0);
}

static bool is_grey(const float color[3])
{
    return is_black(color) || (color[0] == color[1] && color[1] == color[2]);
}

static void decode(const float encoded[3], float color[3])
{
    for (int c = 0; c < 3; c++) {
        color[c] = scene_import_from_srgb(limited(encoded[c], 0, 1));
    }
}

// Textures ------------------------------------------------------------------------------------------

static bool same_text(const char *a, const char *b)
{
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

// Return true if an image was made of this source and has this name.
static bool is_image(const struct scene_import *import, uint32_t number, const char *name,
                     const struct scene_import_source *source)
{
    const struct scene_import_source *other = &import->sources[number];
    return same_text(other->file, source->file) && other->bytes == source->bytes &&
           other->height == source->height && other->opacity_image == source->opacity_image &&
           other->is_opacity == source->is_opacity && other->is_opaque == source->is_opaque &&
           other->white == source->white && strcmp(import->model.images[number].name, name) == 0;
}

// Return the image with this source, new or shared with another slot.
static int32_t find_or_add(struct scene_import *import, const char *name,
                           const struct scene_import_source *source)
{
    if (import->image_names == NULL) {
        import->image_names = scene_import_allocate(import, 1, sizeof *import->image_names);
    }
    const uint32_t hash = scene_hash_bytes(name, strlen(name));
    size_t place = SIZE_MAX;
    for (uint32_t i = scene_hash_next(import->image_names, hash, &place); i != UINT32_MAX;
         i = scene_hash_next(import->image_names, hash, &place)) {
        if (is_image(import, i, name, source)) {
            return (int32_t)i;
        }
    }
    const int32_t added = scene_import_add_image(import, name, source);
    scene_hash_add(import, import->image_names, hash, (uint32_t)added);
    return added;
}

static bool set_slot(struct scene_import *import, const struct scene_phong_texture *texture,
                     struct scene_texture_slot *slot)
{
    if (texture->name == NULL) {
        return false;
    }
    *slot = texture->slot;
    slot->image = find_or_add(import, texture->name, &texture->source);
    return true;
}

// Give the base colour's image the opacity map as its alpha. Without an image, the map becomes a white image.
static void set_opacity_map(struct scene_import *import, const struct scene_phong *phong,
                            struct scene_material *material)
{
    const struct scene_phong_texture *map = &phong->opacity_map;
    if (map->name == NULL && phong->color.source.is_opacity) {
        material->alpha_mode = SCENE_ALPHA_BLEND; // unless the decoded image has no alpha
    }
    if (map->name == NULL) {
        return;
    }
    struct scene_phong_texture base = phong->color.name != NULL ? phong->color : *map;
    base.source.opacity_image = find_or_add(import, map->name, &map->source);
    base.source.white = phong->color.name == NULL;
    set_slot(import, &base, &material->slots[SCENE_SLOT_BASE_COLOR]);
    // The mode becomes MASK if the decoded map turns out to be a cut-out.
    material->alpha_mode = SCENE_ALPHA_BLEND;
}

static bool is_there(const struct scene_phong_texture *texture)
{
    return texture->source.file != NULL || texture->source.bytes != NULL;
}

// Join two maps of one number each. Each map takes the place of its number, as in Blender, unless it is missing.
static void set_surface_maps(struct scene_import *import, const struct scene_phong *phong,
                             struct scene_material *material)
{
    const struct scene_phong_texture *roughness = &phong->roughness_map, *metallic = &phong->metallic_map;
    const struct scene_phong_texture *first = roughness->name != NULL ? roughness : metallic;
    if (first->name == NULL) {
        return;
    }
    struct scene_import_channels *channels = scene_import_allocate(import, 1, sizeof *channels);
    *channels = (struct scene_import_channels){-1, -1, roughness->channel, metallic->channel};
    if (roughness->name != NULL) {
        channels->roughness = find_or_add(import, roughness->name, &roughness->source);
        material->roughness = is_there(roughness) ? 1 : material->roughness;
    }
    if (metallic->name != NULL) {
        channels->metallic = find_or_add(import, metallic->name, &metallic->source);
        material->metallic = is_there(metallic) ? 1 : material->metallic;
    }
    const struct scene_import_source source = {.opacity_image = -1, .channels = channels};
    struct scene_texture_slot *slot = &material->slots[SCENE_SLOT_METALLIC_ROUGHNESS];
    *slot = first->slot;
    slot->image = scene_import_add_image(import, first->name, &source);
}

// Values --------------------------------------------------------------------------------------------

static void set_base_color(const struct scene_phong *phong, struct scene_material *material)
{
    const bool textured = phong->color.name != NULL;
    // A black or grey factor under a texture is an exporter's habit, not a wish. 3ds Max writes 0.588, Maya 0, Blender
    // 0.64 or 0.8, and their own readers let the texture take its place. A colour is meant to tint.
    const bool white = phong->colored || (textured && (!phong->described || is_grey(phong->diffuse)));
    decode(phong->diffuse, material->base_color);
    for (int c = 0; c < 3; c++) {
        material->base_color[c] = white ? 1 : phong->described ? material->base_color[c] : default_grey;
    }
}

// Let the material alone show where a texture that is not repeated, a decal, ends.
static void set_borders(const struct scene_phong *phong, struct scene_material *material)
{
    static const float none[4] = {1, 1, 1, 1}, straight[4] = {0.5f, 0.5f, 1, 1};
    const float *const factor = material->base_color;
    const bool is_replaced = !phong->colored && factor[0] == 1 && factor[1] == 1 && factor[2] == 1;
    float own[4] = {default_grey, default_grey, default_grey, 1};
    if (phong->described) {
        decode(phong->diffuse, own);
    }
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        float *const border = material->slots[s].border;
        if (s == SCENE_SLOT_BASE_COLOR && is_replaced) {
            memcpy(border, own, sizeof own);
        } else if (s != SCENE_SLOT_EMISSIVE) {
            memcpy(border, s == SCENE_SLOT_NORMAL ? straight : none, sizeof none);
        }
    }
}

static void set_surface(const struct scene_phong *phong, struct scene_material *material)
{
    const bool shiny = phong->shininess > 0;
    material->metallic = phong->metallic >= 0 ? limited(phong->metallic, 0, 1) : 0;
    material->roughness = default_roughness;
    // The exponent n of the highlight gives the roughness: α = √(2 / (n + 2)) (Walter and others, Microfacet models for
    // refraction through rough surfaces, 2007) and α = roughness².
    if (shiny) {
        material->roughness = limited(__builtin_sqrtf(__builtin_sqrtf(2 / (phong->shininess + 2))), 0.1f, 1);
    }
    if (phong->dull || (shiny && is_black(phong->specular))) {
        material->roughness = limited(material->roughness, 0.8f, 1);
    }
    if (phong->roughness >= 0) {
        material->roughness = limited(phong->roughness, 0, 1);
    }
    material->unlit = phong->unlit;
}

// Set the layers of MTL's PBR extension, which go as far as a material of this kind goes. Sheen is white and as rough
// as Blender has it.
static void set_layers(struct scene_import *import, const struct scene_phong *phong,
                       struct scene_material *material)
{
    const double turn = 2 * 3.14159265358979324;
    const float sheen_roughness = 0.5f;
    struct scene_layers *layers = &material->layers;
    const bool coated = set_slot(import, &phong->clearcoat_map, &material->slots[SCENE_SLOT_CLEARCOAT]);
    const bool rough =
        set_slot(import, &phong->clearcoat_roughness_map, &material->slots[SCENE_SLOT_CLEARCOAT_ROUGHNESS]);
    layers->clearcoat = coated ? 1 : limited(phong->clearcoat, 0, 1);
    layers->clearcoat_roughness = rough ? 1 : limited(phong->clearcoat_roughness, 0, 1);
    layers->anisotropy = limited(phong->anisotropy, 0, 1);
    layers->anisotropy_direction[0] = (float)scene_cos((double)phong->anisotropy_turns * turn);
    layers->anisotropy_direction[1] = (float)scene_sin((double)phong->anisotropy_turns * turn);
    layers->sheen_roughness = sheen_roughness;
    for (int c = 0; c < 3; c++) {
        layers->sheen_color[c] = limited(phong->sheen, 0, 1);
    }
    layers->used = layers->clearcoat > 0 || layers->anisotropy > 0 || phong->sheen > 0;
}

// Tell of highlights that should be coloured: those that are drawn are white, unless the surface is a metal. Where the
// file says how metallic it is, its highlights follow from that.
static void tell_highlights(struct scene_import *import, const struct scene_phong *phong)
{
    const float least = 1.0f / 32; // less cannot be seen, and may be what rounding left
    float low = 1, high = 0;
    for (int c = 0; c < 3; c++) {
        const float value = limited(phong->specular[c], 0, 1);
        low = value < low ? value : low;
        high = value > high ? value : high;
    }
    if (high - low >= least && phong->metallic < 0 && !is_there(&phong->metallic_map) && !phong->dull &&
        !phong->unlit) {
        scene_import_unsupported(import, "coloured highlights: drawn white");
    }
}

static void set_opacity(struct scene_import *import, const struct scene_phong *phong,
                        struct scene_material *material)
{
    float opacity = limited(phong->opacity, 0, 1);
    if (opacity == 0 && !phong->may_be_clear) {
        scene_import_warn(import, "material \"%s\" is wholly transparent: drawn opaque", material->name);
        opacity = 1;
    }
    material->base_color[3] = opacity;
    if (opacity < 1) {
        material->alpha_mode = SCENE_ALPHA_BLEND;
    }
}

uint32_t scene_phong_add(struct scene_import *import, const struct scene_phong *phong)
{
    struct scene_material *material = scene_import_add_material(import);
    material->name = phong->name;
    // None of these formats can be trusted to know its sides.
    material->double_sided = true;
    import->sides_are_open = true;
    set_base_color(phong, material);
    set_surface(phong, material);
    tell_highlights(import, phong);
    set_opacity(import, phong, material);
    struct scene_phong_texture color = phong->color;
    color.source.is_opaque = material->alpha_mode == SCENE_ALPHA_BLEND && phong->opacity_map.name == NULL &&
                             !color.source.is_opacity && color.source.layer == NULL;
    set_slot(import, &color, &material->slots[SCENE_SLOT_BASE_COLOR]);
    set_opacity_map(import, phong, material);
    if (!set_slot(import, &phong->normal, &material->slots[SCENE_SLOT_NORMAL]) &&
        phong->height.name != NULL) {
        struct scene_phong_texture height = phong->height;
        height.source.height = true;
        set_slot(import, &height, &material->slots[SCENE_SLOT_NORMAL]);
    }
    material->normal_scale = limited(phong->normal_scale, -10, 10);
    set_surface_maps(import, phong, material);
    set_layers(import, phong, material);
    set_slot(import, &phong->occlusion, &material->slots[SCENE_SLOT_OCCLUSION]);
    decode(phong->emissive, material->emissive);
    const bool glows = set_slot(import, &phong->emissive_map, &material->slots[SCENE_SLOT_EMISSIVE]);
    for (int c = 0; c < 3 && glows && is_black(phong->emissive); c++) {
        material->emissive[c] = 1;
    }
    set_borders(phong, material);
    return import->model.material_count - 1;
}
