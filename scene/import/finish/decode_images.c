// SPDX-License-Identifier: MIT
// The textures of a model: decoding all images side by side, and the two conversions that other shading models than
// glTF's need, of opacity maps and of height maps.
#include "decode_images.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "import/image/read.h"
#include "channels.h"
#include "layer.h"
#include "rgba8.h"
#include "machine.h"

// Decoding ------------------------------------------------------------------------------------------

struct decoding {
    const struct scene_import *import; // helpers cannot fail it
    const char **problems;             // problem of each image, written by the thread that took the image
    atomic_uint next;                  // next image that nobody has taken
};

static bool is_no_memory(const char *problem)
{
    return problem != NULL && strcmp(problem, scene_import_no_memory) == 0;
}

// Decode one image. Large images are decoded one at a time, so that threads do not decide what they take together, nor
// whether there is memory for it. With `is_alone` no thread but this one decodes, which makes it certain whether memory
// lacks or the file is to blame.
static const char *decode_bytes(const struct scene_import *import, const void *bytes, size_t size,
                                bool is_alone, struct scene_image *image)
{
    enum { LARGE = 1 << 25 }; // texels
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    const bool large = scene_image_texels(bytes, size) >= LARGE;
    if (large) {
        pthread_mutex_lock(&one_at_a_time);
    }
    const char *const problem =
        scene_image_decode_within(bytes, size, import->texture_side, image->used_as_color, image);
    if (large) {
        pthread_mutex_unlock(&one_at_a_time);
    }
    const bool asks_too_much = is_alone && is_no_memory(problem) && scene_image_has_memory(bytes, size);
    return asks_too_much ? "damaged, or too large for the memory that there is" : problem;
}

static const char *decode_image(const struct scene_import *import, uint32_t index, bool is_alone)
{
    struct scene_image *image = &import->model.images[index];
    const struct scene_import_source *source = &import->sources[index];
    const char *problem = source->problem != NULL ? source->problem : "is not there";
    if (source->channels != NULL) {
        return NULL; // the image is made of others later
    }
    if (source->raw_width > 0) {
        image->type = SCENE_IMAGE_RGBA8;
        image->width = source->raw_width;
        image->height = source->raw_height;
        image->size = source->size;
        image->texels = (void *)source->bytes;
        scene_image_find_alpha(image);
        return NULL;
    }
    if (source->bytes != NULL) {
        return decode_bytes(import, source->bytes, source->size, is_alone, image);
    }
    if (source->file == NULL) {
        return problem;
    }
    size_t size = 0;
    void *bytes = scene_import_read_bytes(source->file, &size, &problem);
    if (bytes == NULL) {
        return problem;
    }
    problem = decode_bytes(import, bytes, size, is_alone, image);
    free(bytes);
    return problem;
}

static void *decode_some(void *argument)
{
    struct decoding *decoding = argument;
    for (;;) {
        const uint32_t index = atomic_fetch_add(&decoding->next, 1);
        if (index >= decoding->import->model.image_count) {
            return NULL;
        }
        decoding->problems[index] = decode_image(decoding->import, index, false);
        if (decoding->import->progress != NULL) {
            __atomic_fetch_add(&decoding->import->progress->images, 1, __ATOMIC_RELAXED);
        }
    }
}

// Return the number of threads beside this one. ThreadSanitizer allows none in the child of a process that had some.
static int helper_count(uint32_t images)
{
    enum { MOST = 7 };
#ifdef __SANITIZE_THREAD__
    return 0;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
    return 0;
#endif
#endif
    const long processors = system_machine_processors();
    long count = processors - 1 < (long)images - 1 ? processors - 1 : (long)images - 1;
    count = count > MOST ? MOST : count;
    return count > 0 ? (int)count : 0;
}

// Conversions ---------------------------------------------------------------------------------------

// Set alpha from the opacity map at the nearest texel: from the map's own alpha if it has one, else from its
// brightness.
static void apply_opacity(struct scene_image *image, const struct scene_image *opacity, bool white)
{
    if (opacity->missing) {
        return;
    }
    const bool alpha = opacity->has_alpha;
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++) {
            const size_t column = (size_t)x * opacity->width / image->width;
            const size_t row = (size_t)y * opacity->height / image->height;
            const size_t from = (row * opacity->width + column) * 4, to = ((size_t)y * image->width + x) * 4;
            const int sum = scene_import_value8(opacity, from) + scene_import_value8(opacity, from + 1) +
                            scene_import_value8(opacity, from + 2);
            scene_import_set_value8(image, to + 3,
                                    alpha ? scene_import_value8(opacity, from + 3) : (uint8_t)(sum / 3));
            for (size_t c = 0; c < 3 && white; c++) {
                scene_import_set_value8(image, to + c, UINT8_MAX);
            }
        }
    }
    scene_image_find_alpha(image);
}

static void drop_alpha(struct scene_image *image)
{
    const size_t end = (size_t)image->width * image->height * 4;
    for (size_t i = 3; i < end; i += 4) {
        scene_import_set_value8(image, i, UINT8_MAX);
    }
    image->has_alpha = false;
}

static bool is_grey(const struct scene_image *image)
{
    // The tolerance is of 255. JPEG does not keep grey exactly.
    enum { TOLERANCE = 8 };
    const size_t end = (size_t)image->width * image->height * 4;
    for (size_t i = 0; i < end; i += 4) {
        const int red = scene_import_value8(image, i), green = scene_import_value8(image, i + 1),
                  blue = scene_import_value8(image, i + 2);
        if (abs(red - green) > TOLERANCE || abs(green - blue) > TOLERANCE) {
            return false;
        }
    }
    return true;
}

// Make normals of a height field by central differences. The whole range of heights is as high as 4 texels are broad.
static void height_to_normals(struct scene_import *import, struct scene_image *image)
{
    if (image->missing || !is_grey(image)) {
        return;
    }
    scene_import_make_rgba8(import, image);
    const float scale = 4.0f / 255 / 2;
    const uint32_t width = image->width, height = image->height;
    const uint8_t *heights = image->texels;
    uint8_t *normals = scene_import_allocate(import, image->size, 1);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const size_t row = (size_t)y * width;
            const int left = heights[(row + (x + width - 1) % width) * 4];
            const int right = heights[(row + (x + 1) % width) * 4];
            const int above = heights[((size_t)((y + height - 1) % height) * width + x) * 4];
            const int below = heights[((size_t)((y + 1) % height) * width + x) * 4];
            const float dx = (float)(left - right) * scale, dy = (float)(below - above) * scale;
            const float length = __builtin_sqrtf(dx * dx + dy * dy + 1);
            const float normal[3] = {dx / length, dy / length, 1 / length};
            for (int c = 0; c < 3; c++) {
                normals[(row + x) * 4 + (size_t)c] = (uint8_t)(normal[c] * 127.5f + 128.0f);
            }
            normals[(row + x) * 4 + 3] = UINT8_MAX;
        }
    }
    free(image->texels);
    image->texels = normals;
    image->has_alpha = false;
}

// Return true if nearly all texels are either there or not, as in the cut-out leaves of a tree.
static bool is_cut_out(const struct scene_image *image)
{
    const size_t count = (size_t)image->width * image->height;
    size_t between = 0;
    for (size_t i = 0; i < count; i++) {
        const uint8_t alpha = scene_import_value8(image, 4 * i + 3);
        between += alpha > 16 && alpha < 239;
    }
    return between <= count / 10;
}

// Choose the mode of materials whose texture has an alpha that counts. A cut-out needs no sorting by distance, which
// blending does.
static void choose_alpha_modes(struct scene_import *import)
{
    for (uint32_t i = 0; i < import->model.material_count; i++) {
        struct scene_material *material = &import->model.materials[i];
        const int32_t image = material->slots[SCENE_SLOT_BASE_COLOR].image;
        const struct scene_import_source *const source = image < 0 ? NULL : &import->sources[image];
        if (source == NULL || (source->opacity_image < 0 && !source->is_opacity) ||
            material->base_color[3] < 1) {
            continue;
        }
        if (!import->model.images[image].has_alpha) {
            material->alpha_mode = SCENE_ALPHA_OPAQUE;
        } else if (is_cut_out(&import->model.images[image])) {
            material->alpha_mode = SCENE_ALPHA_MASK;
        }
    }
}

// Return, for each image, whether a material takes its base colour from it.
static bool *find_colors(struct scene_import *import)
{
    const struct scene_model *const model = &import->model;
    bool *const colors = scene_import_allocate(import, model->image_count, sizeof *colors);
    for (uint32_t i = 0; i < model->material_count; i++) {
        const int32_t image = model->materials[i].slots[SCENE_SLOT_BASE_COLOR].image;
        if (image >= 0) {
            colors[image] = true;
        }
    }
    return colors;
}

// Show a checker with hard edges in plain magenta: nothing else of the material darkens, tints or thins it.
static void show_stand_in(struct scene_material *material)
{
    struct scene_texture_slot *slot = &material->slots[SCENE_SLOT_BASE_COLOR];
    slot->min_filter = slot->mag_filter = RHW_FILTER_NEAREST;
    for (int c = 0; c < 4; c++) {
        material->base_color[c] = 1;
    }
    material->metallic = 0;
    material->layers.used = false;
    material->alpha_mode = SCENE_ALPHA_OPAQUE;
}

// Drop the stand-ins of data. A stand-in is for colours to show that something is missing; as a normal or a roughness
// it would lie.
static void drop_missing_data(struct scene_model *model)
{
    for (uint32_t i = 0; i < model->material_count; i++) {
        for (int k = 0; k < SCENE_SLOT_COUNT; k++) {
            struct scene_material *material = &model->materials[i];
            struct scene_texture_slot *slot = &material->slots[k];
            if (slot->image < 0 || !model->images[slot->image].missing) {
                continue;
            }
            if (k == SCENE_SLOT_BASE_COLOR) {
                show_stand_in(material);
                continue;
            }
            slot->image = -1;
            if (k == SCENE_SLOT_EMISSIVE) {
                material->emissive[0] = material->emissive[1] = material->emissive[2] = 0;
            }
        }
    }
}

// Put a white texel in the place of each image.
static void leave_images_out(struct scene_import *import)
{
    for (uint32_t i = 0; i < import->model.image_count; i++) {
        struct scene_image *const image = &import->model.images[i];
        image->type = SCENE_IMAGE_RGBA8;
        image->width = image->height = 1;
        image->size = 4;
        image->texels = memset(scene_import_allocate(import, 4, 1), UINT8_MAX, 4);
    }
}

void scene_import_decode_images(struct scene_import *import)
{
    enum { MOST_HELPERS = 8 };
    struct scene_model *model = &import->model;
    if (import->without_images) {
        leave_images_out(import);
        return;
    }
    if (import->progress != NULL) {
        __atomic_store_n(&import->progress->image_count, model->image_count, __ATOMIC_RELAXED);
    }
    struct decoding decoding = {import, NULL, 0};
    decoding.problems = scene_import_allocate(import, model->image_count, sizeof *decoding.problems);
    pthread_t helpers[MOST_HELPERS];
    const int wanted = helper_count(model->image_count);
    int started = 0;
    while (started < wanted && pthread_create(&helpers[started], NULL, decode_some, &decoding) == 0) {
        started++;
    }
    decode_some(&decoding);
    for (int i = 0; i < started; i++) {
        pthread_join(helpers[i], NULL);
    }
    const bool *const colors = find_colors(import);
    for (uint32_t i = 0; i < model->image_count; i++) {
        if (is_no_memory(decoding.problems[i])) {
            decoding.problems[i] = decode_image(import, i, true);
        }
        if (decoding.problems[i] == NULL) {
            if (model->images[i].lacks_end) {
                scene_import_warn(import, "texture \"%.200s\": has no mark at its end: it may be cut",
                                  model->images[i].name);
            }
            continue;
        }
        if (is_no_memory(decoding.problems[i])) {
            scene_import_fail(import, "needs more memory than there is for texture \"%s\"",
                              model->images[i].name);
        }
        scene_import_warn(import, "texture \"%.200s\": %s; %s", model->images[i].name, decoding.problems[i],
                          colors[i] ? "drawn in magenta" : "left out");
        if (!scene_image_stand_in(&model->images[i])) {
            scene_import_fail(import, "needs more memory than there is");
        }
    }
    for (uint32_t i = 0; i < model->image_count; i++) {
        const struct scene_import_channels *channels = import->sources[i].channels;
        if (channels != NULL && !scene_import_join_channels(import, &model->images[i], channels) &&
            !scene_image_stand_in(&model->images[i])) {
            scene_import_fail(import, "needs more memory than there is");
        }
        if (import->sources[i].opacity_image >= 0) {
            apply_opacity(&model->images[i], &model->images[import->sources[i].opacity_image],
                          import->sources[i].white);
        }
        if (import->sources[i].is_opaque) {
            drop_alpha(&model->images[i]);
        }
        if (import->sources[i].is_skin && model->images[i].has_alpha && !model->images[i].missing) {
            scene_import_unsupported(import, "alpha of skins: not used");
        }
        if (import->sources[i].height) {
            height_to_normals(import, &model->images[i]);
        }
        if (import->sources[i].layer != NULL) {
            scene_import_lay_image(import, &model->images[i], import->sources[i].layer);
        }
    }
    choose_alpha_modes(import);
    drop_missing_data(model);
}
