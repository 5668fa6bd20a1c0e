// SPDX-License-Identifier: MIT
// Whole images, held against hashes that stand in the repository. Every scene is drawn at several thread
// counts, on every instruction set the CPU has and with small bins; all must give the bytes that the hash was
// taken of. What a build with another compiler or for another architecture draws is thereby held against this
// one: script/determinism does that.
//
//   golden TABLE            compares; lines of TABLE are "HASH NAME"
//   golden TABLE --update   writes the table, after a change that was meant
//   golden TABLE --few      compares, at one thread count: all that a sanitizer sees runs
//   golden TABLE --matrix   see golden.h
//   golden --show NAME FILE writes one scene as PPM, to look at it: its images in a row
#include "golden.h"
#include "golden_scenes.h"
#include "base/half.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct scene {
    const char *name;
    golden_draw_function *draw;
    int number;
};

static const struct scene features[] = {
    {"blend", golden_blend_draw, 0},
    {"write-masks", golden_write_mask_draw, 0},
    {"formats", golden_formats_draw, 0},
    {"targets-bytes", golden_targets_draw, 0},
    {"targets-words", golden_targets_draw, 1},
    {"targets-packed", golden_targets_draw, 2},
    {"targets-integers", golden_targets_draw, 3},
    {"passes", golden_passes_draw, 0},
    {"depth", golden_depth_draw, 0},
    {"culling", golden_culling_draw, 0},
    {"topology", golden_topology_draw, 0},
    {"primitives", golden_primitives_draw, 0},
    {"primitives-bresenham", golden_primitives_draw, 1},
    {"primitives-conservative", golden_primitives_draw, 2},
    {"primitives-stipple", golden_primitives_draw, 3},
    {"primitives-fully-covered", golden_primitives_draw, 4},
    {"primitives-smooth", golden_primitives_draw, 5},
    {"viewports", golden_viewport_draw, 0},
    {"layered-cube", golden_routing_draw, 0},
    {"clipping", golden_clipping_draw, 0},
    {"vertex-formats", golden_vertex_format_draw, 0},
    {"instances", golden_instances_draw, 0},
    {"samplers", golden_sampler_draw, 0},
    {"texels", golden_texel_draw, 0},
    {"texels-mirrored-once", golden_texel_draw, 1},
    {"chain", golden_chain_draw, 0},
    {"blocks", golden_blocks_draw, 0},
    {"blocks-in-parts", golden_blocks_draw, 1},
    {"stencil", golden_stencil_draw, 0},
    {"stencil-24", golden_stencil_draw, 1},
    {"stencil-views", golden_stencil_views_draw, 0},
    {"samples-2", golden_samples_draw, 0},
    {"samples-4", golden_samples_draw, 1},
    {"samples-8", golden_samples_draw, 2},
    {"samples-16", golden_samples_draw, 3},
    {"areas", golden_areas_draw, 0},
    {"queries", golden_queries_draw, 0},
    {"queries-4", golden_queries_draw, 1},
    {"texture-kinds", golden_kinds_draw, 0},
    {"texture-layers", golden_layers_draw, 0},
    {"texture-views", golden_views_draw, 0},
    {"transfers", golden_transfers_draw, 0},
    {"builtins", golden_builtins_draw, 0},
    {"offsets", golden_offsets_draw, 0},
    {"heights", golden_heights_draw, 0},
    {"maths", golden_maths_draw, 0},
    {"maths-of-all-floats", golden_maths_draw, 1},
    {"one-at-a-time", golden_single_draw, 0},
    {"storage", golden_storage_draw, 0},
    {"dispatch", golden_dispatch_draw, 0},
    {"glsl-sphere", golden_glsl_draw, 0},
    {"glsl-deferred", golden_glsl_draw, 1},
    {"glsl-dispatch", golden_glsl_draw, 2},
    {"gallery", golden_gallery_draw, 0},
    {"gallery-wireframe-over", golden_gallery_draw, 1},
    {"gallery-orthographic", golden_gallery_draw, 2},
    {"gallery-wireframe-plain", golden_gallery_draw, 3},
    {"gallery-layers", golden_gallery_draw, 4},
    {"gallery-transparency", golden_gallery_draw, 5},
    {"spot", golden_model_draw, 0},
    {"spider", golden_model_draw, 1},
};
enum { FEATURES = sizeof features / sizeof *features, MAX_SCENES = FEATURES + 16 };

static struct scene scenes[MAX_SCENES];
static int scene_count;

static void list_scenes(void)
{
    for (int i = 0; golden_shape_name(i) != NULL; i++) {
        scenes[scene_count++] = (struct scene){golden_shape_name(i), golden_shape_draw, i};
    }
    for (int i = 0; i < FEATURES; i++) {
        scenes[scene_count++] = features[i];
    }
}

// False where this machine cannot make the threads.
static bool draw(int number, const struct rhw_context_def *def, struct golden_images *images)
{
    rhw_context *context;
    const struct rhw_context_def golden = golden_context_def(def);
    const enum rhw_result result = rhw_context_create(&golden, &context);
    if (result == RHW_ERROR_THREAD) {
        return false;
    }
    golden_check(result, scenes[number].name);
    scenes[number].draw(context, scenes[number].number, images);
    rhw_context_destroy(context);
    return true;
}

static uint64_t hash_scene(int number, const struct rhw_context_def *def)
{
    struct golden_images images = {0};
    if (!draw(number, def, &images)) {
        return 0;
    }
    uint64_t hash = GOLDEN_HASH_START;
    for (int i = 0; i < images.count; i++) {
        const struct golden_image *image = &images.image[i];
        hash = golden_hash(hash, image->pixels,
                           rhw_format_size(image->format) * (size_t)image->width * (size_t)image->height);
    }
    golden_images_free(&images);
    return hash;
}

static const char *scene_name(int number)
{
    return scenes[number].name;
}

// A value of a linear image on the way to 8 bits; NaN is black. The square root is near enough to sRGB's curve.
static unsigned char display(float linear)
{
    const float encoded = linear > 0 ? linear < 1 ? __builtin_sqrtf(linear) : 1.0f : 0.0f;
    return (unsigned char)(255.0f * encoded + 0.5f);
}

static void show_pixel(const struct golden_image *image, size_t pixel, unsigned char rgb[3])
{
    const unsigned char *at = (const unsigned char *)image->pixels + pixel * rhw_format_size(image->format);
    float value[4] = {0};
    uint32_t bits;
    switch (image->format) {
    case RHW_FORMAT_R8_UNORM: rgb[0] = rgb[1] = rgb[2] = at[0]; return;
    case RHW_FORMAT_RG8_UNORM: memcpy(rgb, (const unsigned char[]){at[0], at[1], 0}, 3); return;
    case RHW_FORMAT_RGBA8_UNORM:
    case RHW_FORMAT_RGBA8_SRGB: memcpy(rgb, at, 3); return;
    case RHW_FORMAT_R32_UINT: // a colour for each number
        memcpy(&bits, at, sizeof bits);
        bits *= UINT32_C(0x9e3779b1);
        memcpy(rgb,
               (const unsigned char[]){(unsigned char)(bits >> 24), (unsigned char)(bits >> 16),
                                       (unsigned char)(bits >> 8)},
               3);
        return;
    case RHW_FORMAT_RGBA16_FLOAT:
        for (int c = 0; c < 3; c++) {
            uint16_t half;
            memcpy(&half, at + 2 * c, sizeof half);
            value[c] = rhw_half_to_float(half);
        }
        break;
    case RHW_FORMAT_RGBA32_FLOAT: memcpy(value, at, 12); break;
    case RHW_FORMAT_R32_FLOAT:
    case RHW_FORMAT_D32_FLOAT:
        memcpy(value, at, 4);
        value[1] = value[2] = value[0];
        break;
    default: // the first bytes
        for (size_t c = 0; c < 3; c++) {
            rgb[c] = c < rhw_format_size(image->format) ? at[c] : 0;
        }
        return;
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = display(value[c]);
    }
}

static int show(const char *name, const char *file)
{
    int number = 0;
    while (number < scene_count && strcmp(scenes[number].name, name) != 0) {
        number++;
    }
    struct golden_images images = {0};
    const struct rhw_context_def def = rhw_context_def_default();
    if (number == scene_count || !draw(number, &def, &images)) {
        fprintf(stderr, "golden: there is no scene %s\n", name);
        return 2;
    }
    int width = 0, height = 0;
    for (int i = 0; i < images.count; i++) {
        width += images.image[i].width + (i > 0 ? 4 : 0);
        height = images.image[i].height > height ? images.image[i].height : height;
    }
    FILE *stream = fopen(file, "wb");
    if (stream == NULL) {
        return 2;
    }
    fprintf(stream, "P6\n%d %d\n255\n", width, height);
    for (int y = 0; y < height; y++) {
        for (int i = 0; i < images.count; i++) {
            const struct golden_image *image = &images.image[i];
            unsigned char rgb[3] = {255, 255, 255};
            for (int x = 0; i > 0 && x < 4; x++) {
                fwrite(rgb, 1, 3, stream);
            }
            for (int x = 0; x < image->width; x++) {
                if (y < image->height) {
                    show_pixel(image, (size_t)y * (size_t)image->width + (size_t)x, rgb);
                }
                fwrite(rgb, 1, 3, stream);
            }
        }
    }
    golden_images_free(&images);
    return fclose(stream) != 0;
}

// The folder models/ beside the table; --show is run from the root of the repository.
static void find_models(const char *table)
{
    static char path[1000];
    const char *const end = strrchr(table, '/');
    snprintf(path, sizeof path, "%.*smodels", end ? (int)(end - table) + 1 : 0, table);
    golden_models_at(path);
}

int main(int argc, char **argv)
{
    list_scenes();
    const bool shows = argc == 4 && strcmp(argv[1], "--show") == 0;
    find_models(shows || argc < 2 ? "tests/golden/" : argv[1]);
    if (shows) {
        return show(argv[2], argv[3]);
    }
    const struct golden_set set = {scene_count, scene_name, hash_scene};
    return golden_main(&set, argc, argv);
}
