// SPDX-License-Identifier: MIT
// What both forms of rhw info count and call alike; see info_print.h.
#include "info_print.h"

#include <math.h>

const char *const cli_primitive_names[] = {"triangles", "lines", "points"};
const char *const cli_image_type_names[] = {"RGBA8", "RGBA16", "RGBA32F"};
const char *const cli_alpha_names[] = {"opaque", "mask", "blend"};
const char *const cli_light_names[] = {"directional", "point", "spot"};
const char *const cli_filter_names[] = {[RHW_FILTER_LINEAR] = "linear", [RHW_FILTER_NEAREST] = "nearest"};
const char *const cli_mip_filter_names[] = {
    [RHW_MIP_FILTER_LINEAR] = "linear", [RHW_MIP_FILTER_NEAREST] = "nearest", [RHW_MIP_FILTER_NONE] = "none"};
const char *const cli_address_names[] = {[RHW_ADDRESS_REPEAT] = "repeat",
                                         [RHW_ADDRESS_MIRROR] = "mirror",
                                         [RHW_ADDRESS_CLAMP] = "clamp",
                                         [RHW_ADDRESS_BORDER] = "border",
                                         [RHW_ADDRESS_MIRROR_ONCE] = "mirror once"};
const char *const cli_slot_names[SCENE_SLOT_COUNT] = {
    [SCENE_SLOT_BASE_COLOR] = "base_color",
    [SCENE_SLOT_METALLIC_ROUGHNESS] = "metallic_roughness",
    [SCENE_SLOT_NORMAL] = "normal",
    [SCENE_SLOT_OCCLUSION] = "occlusion",
    [SCENE_SLOT_EMISSIVE] = "emissive",
    [SCENE_SLOT_CLEARCOAT] = "clearcoat",
    [SCENE_SLOT_CLEARCOAT_ROUGHNESS] = "clearcoat_roughness",
    [SCENE_SLOT_CLEARCOAT_NORMAL] = "clearcoat_normal",
    [SCENE_SLOT_SHEEN_COLOR] = "sheen_color",
    [SCENE_SLOT_SHEEN_ROUGHNESS] = "sheen_roughness",
    [SCENE_SLOT_SPECULAR] = "specular",
    [SCENE_SLOT_SPECULAR_COLOR] = "specular_color",
    [SCENE_SLOT_TRANSMISSION] = "transmission",
    [SCENE_SLOT_THICKNESS] = "thickness",
    [SCENE_SLOT_ANISOTROPY] = "anisotropy",
    [SCENE_SLOT_IRIDESCENCE] = "iridescence",
    [SCENE_SLOT_IRIDESCENCE_THICKNESS] = "iridescence_thickness",
    [SCENE_SLOT_GLOSS] = "specular_glossiness",
};

uint32_t cli_info_objects(const struct scene_model *model)
{
    uint32_t largest = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        largest = model->instances[i].object > largest ? model->instances[i].object : largest;
    }
    return largest;
}

uint32_t cli_info_elements(const struct scene_mesh *mesh)
{
    static const uint32_t corners[] = {3, 2, 1};
    return mesh->index_count / corners[mesh->primitive];
}

int cli_info_digits(const struct scene_model *model, int near)
{
    double size = 0.0, distance = 0.0;
    for (int c = 0; c < 3; c++) {
        size = fmax(size, (double)model->bounds_max[c] - (double)model->bounds_min[c]);
        distance = fmax(distance, fabs(model->origin[c]));
    }
    int digits = near;
    for (; digits < 17 && distance > size; distance /= 10.0) {
        digits++;
    }
    return digits;
}

bool cli_info_find_place(const struct scene_model *model, const float floats[3], const double exact[3],
                         double place[3])
{
    enum { SEEN = 1 << 16 }; // parts of the model's size that a large picture shows
    double size = 0.0, lost = 0.0;
    scene_exact_place(floats, exact, place);
    for (int c = 0; c < 3; c++) {
        size = fmax(size, (double)model->bounds_max[c] - (double)model->bounds_min[c]);
        lost = fmax(lost, fabs(place[c] - (double)floats[c]));
    }
    const bool is_far = scene_origin_is_far(model->origin) || model->is_scattered || lost * SEEN > size;
    for (int c = 0; c < 3; c++) {
        place[c] = is_far ? place[c] + model->origin[c] : (double)floats[c];
    }
    return is_far;
}

bool cli_info_draws_anything(const struct scene_model *model)
{
    return model->bounds_min[0] <= model->bounds_max[0];
}

uint64_t cli_info_mesh_bytes(const struct scene_model *model)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        const struct scene_mesh *const mesh = &model->meshes[i];
        const uint64_t vertex = 12u + (mesh->normals ? 12u : 0u) + (mesh->tangents ? 16u : 0u) +
                                (mesh->colors ? 16u : 0u) + (mesh->uvs[0] ? 8u : 0u) +
                                (mesh->uvs[1] ? 8u : 0u);
        sum += mesh->vertex_count * vertex + (uint64_t)mesh->index_count * sizeof *mesh->indices;
    }
    return sum;
}

uint64_t cli_info_texture_bytes(const struct scene_model *model)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < model->image_count; i++) {
        const struct scene_image *const image = &model->images[i];
        const uint64_t texel = image->type == SCENE_IMAGE_RGBA8 ? 4 : 16;
        const uint64_t uses = (uint64_t)image->used_as_color + (uint64_t)image->used_as_data;
        sum += (uint64_t)image->width * image->height * texel * uses * 4 / 3; // a mip chain adds a third
    }
    return sum;
}
