// SPDX-License-Identifier: MIT
// What a textureInfo of a material says: image, sampler and coordinates (§3.8). The limits of the numbers beside it
// stand here too.
#include "gltf.h"

#include <string.h>

#include "elementary.h"
#include "import/builder/data_uri.h"
#include "import/builder/find_file.h"
#include "import/builder/numbers.h"

float scene_gltf_limited(double value, double least, double most)
{
    // NaN gives `least`.
    return (float)(value >= least && value <= most ? value : value > most ? most : least);
}

void scene_gltf_limit_color(float color[4])
{
    for (int c = 0; c < 4; c++) {
        color[c] = scene_gltf_limited((double)color[c], 0, c == 3 ? 1 : 1e6);
    }
}

// Images --------------------------------------------------------------------------------------------

static int32_t add_image(struct scene_gltf *gltf, int64_t index)
{
    struct scene_import *import = gltf->import;
    const json_t *image = scene_gltf_item(gltf, "images", index);
    const char *uri = scene_gltf_text(gltf, image, "uri");
    const char *name = scene_gltf_name(gltf, image);
    struct scene_import_source source = {.opacity_image = -1};
    size_t stride = 0;
    if (gltf->images[index] >= 0) {
        return gltf->images[index];
    }
    if (uri != NULL) {
        name = scene_data_uri_is(uri) ? name : scene_import_string(import, uri, strlen(uri));
        scene_import_find_image(import, NULL, uri, &source);
    } else if (json_object_get(image, "bufferView") != NULL) {
        source.bytes =
            scene_gltf_view(gltf, scene_gltf_integer(gltf, image, "bufferView", -1), &source.size, &stride);
    } else {
        source.problem = "has neither a URI nor a bufferView";
    }
    if (name[0] == 0) {
        char number[40];
        snprintf(number, sizeof number, "images[%lld]", (long long)index);
        name = scene_import_string(import, number, sizeof number);
    }
    gltf->images[index] = scene_import_add_image(import, name, &source);
    return gltf->images[index];
}

// Add the stand-in for a texture that has no image which can be read.
static int32_t add_missing(struct scene_gltf *gltf, int64_t texture)
{
    char name[40];
    snprintf(name, sizeof name, "textures[%lld]", (long long)texture);
    const struct scene_import_source source = {.opacity_image = -1,
                                               .problem = "has no image that can be read"};
    return scene_import_add_image(gltf->import, scene_import_string(gltf->import, name, sizeof name),
                                  &source);
}

// Textures ------------------------------------------------------------------------------------------

static enum rhw_address address(struct scene_gltf *gltf, const json_t *sampler, const char *key)
{
    switch (scene_gltf_integer(gltf, sampler, key, 10497)) {
    case 33071: return RHW_ADDRESS_CLAMP;
    case 33648: return RHW_ADDRESS_MIRROR;
    default: return RHW_ADDRESS_REPEAT;
    }
}

static void read_sampler(struct scene_gltf *gltf, const json_t *sampler, struct scene_texture_slot *slot)
{
    slot->address_u = address(gltf, sampler, "wrapS");
    slot->address_v = address(gltf, sampler, "wrapT");
    if (scene_gltf_integer(gltf, sampler, "magFilter", 9729) == 9728) {
        slot->mag_filter = RHW_FILTER_NEAREST;
    }
    const int64_t minimum = scene_gltf_integer(gltf, sampler, "minFilter", 9987);
    const bool nearest = minimum == 9728 || minimum == 9984 || minimum == 9986;
    slot->min_filter = nearest ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR;
    slot->mip_filter = minimum == 9728 || minimum == 9729   ? RHW_MIP_FILTER_NONE
                       : minimum == 9984 || minimum == 9985 ? RHW_MIP_FILTER_NEAREST
                                                            : RHW_MIP_FILTER_LINEAR;
}

// Read KHR_texture_transform, which scales, turns and moves, in this order.
static void read_transform(struct scene_gltf *gltf, const json_t *extension, struct scene_texture_slot *slot)
{
    float offset[2] = {0, 0}, scale[2] = {1, 1};
    scene_gltf_floats(gltf, extension, "offset", offset, 2);
    scene_gltf_floats(gltf, extension, "scale", scale, 2);
    const double rotation = scene_gltf_number(gltf, extension, "rotation", 0);
    const float c = (float)scene_cos(rotation), s = (float)scene_sin(rotation);
    const float transform[6] = {c * scale[0],  s * scale[1], offset[0],
                                -s * scale[0], c * scale[1], offset[1]};
    if (scene_import_finite(transform, 6)) {
        memcpy(slot->transform, transform, sizeof transform);
    }
}

// Return the index of the image. A WebP or KTX2 image comes first; `source` may be there for programs that cannot read
// it. An AVIF or DDS image comes last, because not every build reads the one, and the other is often of less quality.
static int64_t find_image(struct scene_gltf *gltf, const json_t *texture)
{
    const json_t *avif = scene_gltf_extension(gltf, texture, "EXT_texture_avif");
    const json_t *dds = scene_gltf_extension(gltf, texture, "MSFT_texture_dds");
    const json_t *webp = scene_gltf_extension(gltf, texture, "EXT_texture_webp");
    const json_t *basis = scene_gltf_extension(gltf, texture, "KHR_texture_basisu");
    const int64_t rare =
        scene_gltf_integer(gltf, dds, "source", scene_gltf_integer(gltf, avif, "source", -1));
    const int64_t plain = scene_gltf_integer(gltf, texture, "source", rare);
    const int64_t source = scene_gltf_integer(gltf, webp, "source", plain);
    return scene_gltf_integer(gltf, basis, "source", source);
}

void scene_gltf_slot(struct scene_gltf *gltf, const json_t *info, struct scene_texture_slot *slot)
{
    if (info == NULL) {
        return;
    }
    const int64_t number = scene_gltf_integer(gltf, info, "index", -1);
    const json_t *texture = scene_gltf_item(gltf, "textures", number);
    const int64_t image = find_image(gltf, texture);
    const int64_t sampler = scene_gltf_integer(gltf, texture, "sampler", -1);
    const json_t *transform = scene_gltf_extension(gltf, info, "KHR_texture_transform");
    const int64_t own_set = scene_gltf_integer(gltf, info, "texCoord", 0);
    const int64_t set = scene_gltf_integer(gltf, transform, "texCoord", own_set);
    slot->image = image >= 0 ? add_image(gltf, image) : add_missing(gltf, number);
    if (sampler >= 0) {
        read_sampler(gltf, scene_gltf_item(gltf, "samplers", sampler), slot);
    }
    if (transform != NULL) {
        read_transform(gltf, transform, slot);
    }
    scene_gltf_note_extensions(gltf, texture);
    scene_gltf_note_extensions(gltf, info);
    if (set < SCENE_UV_SETS) {
        slot->uv_set = (uint32_t)set;
    } else {
        scene_import_unsupported(gltf->import, "texture coordinate set %lld: set 0 is read instead",
                                 (long long)set);
    }
}
