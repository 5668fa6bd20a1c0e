// SPDX-License-Identifier: MIT
// See shader_resources.h.
#include "shader_resources.h"

#include "image_write.h"
#include "import/image/read.h"
#include "shader_uniforms.h"
#include "shader_values.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MOST_PICTURE ((size_t)1 << 30)

// Options --------------------------------------------------------------------------------------------

bool cli_shader_binding_is(const struct cli_shader_binding *binding,
                           const struct rhw_shader_resource *resource)
{
    return binding->name[0] ? strcmp(binding->name, resource->name) == 0
                            : binding->set == resource->set && binding->binding == resource->binding;
}

static struct cli_shader_binding *find_binding(struct cli_shader_bindings *bindings,
                                               const struct rhw_shader_resource *what)
{
    struct cli_shader_binding *found = NULL;
    for (int i = 0; i < bindings->count; i++) {
        struct cli_shader_binding *const one = &bindings->list[i];
        if (cli_shader_binding_is(one, what)) {
            one->is_used = true;
            found = one;
        }
    }
    return found;
}

static bool is_buffer(const struct rhw_shader_resource *what)
{
    return what->kind == RHW_SHADER_UNIFORM_BUFFER || what->kind == RHW_SHADER_STORAGE_BUFFER;
}

static bool is_image(const struct rhw_shader_resource *what)
{
    return what->kind == RHW_SHADER_SAMPLED_TEXTURE || what->kind == RHW_SHADER_TEXTURE ||
           what->kind == RHW_SHADER_STORAGE_IMAGE;
}

static bool is_result(const struct rhw_shader_resource *what)
{
    return is_buffer(what) || what->kind == RHW_SHADER_STORAGE_IMAGE;
}

// Write the names of the resources that an option may mean, as many as there is room for.
static void list_names(const struct cli_shader_resources *resources,
                       bool (*is_meant)(const struct rhw_shader_resource *), char *names, size_t room)
{
    snprintf(names, room, "there is none");
    const char *before = "there is ";
    for (int i = 0, at = 0; i < resources->count && at < (int)room; i++) {
        const struct rhw_shader_resource *const what = resources->list[i].what;
        if (is_meant(what)) {
            char place[16];
            snprintf(place, sizeof place, "%u:%u", (unsigned)what->set, (unsigned)what->binding);
            at += snprintf(names + at, room - (size_t)at, "%s%s", before, what->name[0] ? what->name : place);
            before = ", ";
        }
    }
}

static bool check_used(const struct cli_shader_resources *resources,
                       const struct cli_shader_bindings *bindings, const char *kind,
                       bool (*is_meant)(const struct rhw_shader_resource *))
{
    for (int i = 0; i < bindings->count; i++) {
        const struct cli_shader_binding *const one = &bindings->list[i];
        if (!one->is_used) {
            char names[400];
            list_names(resources, is_meant, names, sizeof names);
            cli_error(one->option, "'%s': no shader here uses such a %s; %s", one->argument, kind, names);
            return false;
        }
    }
    return true;
}

// Find what a shader has at the set and binding of a resource.
static const struct rhw_shader_resource *find_resource(const struct cli_shader_file *file,
                                                       const struct rhw_shader_resource *what)
{
    const struct rhw_shader_info *const info = rhw_shader_get_info(file->shader);
    for (uint32_t i = 0; i < info->resource_count; i++) {
        if (info->resources[i].set == what->set && info->resources[i].binding == what->binding) {
            return &info->resources[i];
        }
    }
    return NULL;
}

// Buffers --------------------------------------------------------------------------------------------

// A binding of two shaders may have more members in one of them.
static uint32_t largest_size(const struct cli_shader_file *files, int count,
                             const struct rhw_shader_resource *what)
{
    uint32_t size = what->size;
    for (int i = 0; i < count; i++) {
        const struct rhw_shader_resource *const other = find_resource(&files[i], what);
        size = other && other->size > size ? other->size : size;
    }
    return size;
}

static bool open_buffer(struct cli_shader_resource *resource, struct cli_shader_job *job,
                        const struct cli_shader_file *files, int count)
{
    const struct rhw_shader_resource *const what = resource->what;
    const struct cli_shader_binding *const given = find_binding(&job->buffers, what);
    find_binding(&job->results, what);
    if (given) {
        return cli_shader_values_read("--buffer", given->argument, given->value, &resource->memory,
                                      &resource->size);
    }
    if (!cli_shader_has_length(what->type)) {
        cli_error("--run", "buffer %u:%u has no length of its own; --buffer %u:%u=BYTES gives it one",
                  (unsigned)what->set, (unsigned)what->binding, (unsigned)what->set, (unsigned)what->binding);
        return false;
    }
    resource->size = largest_size(files, count, what);
    resource->memory = calloc(1, resource->size + 4);
    if (!resource->memory) {
        cli_error("--run", "out of memory");
        return false;
    }
    return true;
}

static bool open_push_constants(struct cli_shader_resources *resources, const struct cli_shader_job *job,
                                const struct cli_shader_file *files, int count)
{
    for (int i = 0; i < count; i++) {
        const uint32_t size = rhw_shader_get_info(files[i].shader)->push_size;
        resources->push_size = size > resources->push_size ? size : resources->push_size;
    }
    if (job->push) {
        if (resources->push_size == 0) {
            cli_error("--push", "no shader here has push constants");
            return false;
        }
        return cli_shader_values_read("--push", job->push, job->push, &resources->push,
                                      &resources->push_size);
    }
    resources->push = calloc(1, resources->push_size + 4);
    for (int i = 0; resources->push && i < count; i++) {
        cli_shader_uniforms_set(rhw_shader_get_info(files[i].shader)->push_type, job, resources,
                                resources->push, resources->push_size);
    }
    if (!resources->push) {
        cli_error("--run", "out of memory");
    }
    return resources->push != NULL;
}

// Textures -------------------------------------------------------------------------------------------

static bool create_texture(struct cli_shader_resource *resource, rhw_context *context, enum rhw_format format)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = resource->width;
    def.height = resource->height;
    if (rhw_texture_create(context, &def, &resource->texture) != RHW_OK) {
        cli_error("--run", "there is no memory for a picture of %dx%d", def.width, def.height);
        return false;
    }
    return true;
}

// Put the rows of a picture in opposite order: y points up in a text with mainImage().
static void turn_over(struct scene_image *image)
{
    const size_t row = image->size / image->height;
    unsigned char *top = image->texels, *bottom = top + image->size - row;
    for (; top < bottom; top += row, bottom -= row) {
        for (size_t i = 0; i < row; i++) {
            const unsigned char byte = top[i];
            top[i] = bottom[i];
            bottom[i] = byte;
        }
    }
}

static bool has_main_image(const struct cli_shader_file *files, int count)
{
    for (int i = 0; i < count; i++) {
        if (files[i].main_image.text) {
            return true;
        }
    }
    return false;
}

static bool load_texture(struct cli_shader_resource *resource, rhw_context *context, const char *path,
                         bool is_turned)
{
    static const enum rhw_format formats[] = {[SCENE_IMAGE_RGBA8] = RHW_FORMAT_RGBA8_UNORM,
                                              [SCENE_IMAGE_RGBA16] = RHW_FORMAT_RGBA16_UNORM,
                                              [SCENE_IMAGE_RGBA32F] = RHW_FORMAT_RGBA32_FLOAT};
    struct scene_image image = {0};
    size_t size;
    char *const bytes = cli_shader_read(path, MOST_PICTURE, &size);
    if (!bytes) {
        return false;
    }
    const char *const problem = scene_image_decode(bytes, size, &image);
    free(bytes);
    if (problem) {
        cli_error(path, "%s", strcmp(problem, "outofmem") == 0 ? "out of memory" : problem);
        return false;
    }
    if (is_turned) {
        turn_over(&image);
    }
    resource->width = (int)image.width;
    resource->height = (int)image.height;
    const bool made = create_texture(resource, context, formats[image.type]) &&
                      rhw_texture_write(context, resource->texture, 0, image.texels, 0) == RHW_OK;
    free(image.texels);
    return made;
}

static bool open_image(struct cli_shader_resource *resource, rhw_context *context, struct cli_shader_job *job,
                       bool is_turned)
{
    const struct cli_shader_binding *const given = find_binding(&job->textures, resource->what);
    if (resource->what->kind == RHW_SHADER_STORAGE_IMAGE) {
        find_binding(&job->results, resource->what);
    }
    if (given) {
        return load_texture(resource, context, given->value, is_turned);
    }
    if (resource->what->kind != RHW_SHADER_STORAGE_IMAGE) {
        return true; // it reads as 0
    }
    resource->width = job->width;
    resource->height = job->height;
    return create_texture(resource, context, RHW_FORMAT_RGBA8_UNORM);
}

// All ------------------------------------------------------------------------------------------------

static bool open_resource(struct cli_shader_resource *resource, rhw_context *context,
                          struct cli_shader_job *job, const struct cli_shader_file *files, int count)
{
    switch (resource->what->kind) {
    case RHW_SHADER_UNIFORM_BUFFER:
    case RHW_SHADER_STORAGE_BUFFER: return open_buffer(resource, job, files, count);
    case RHW_SHADER_SAMPLED_TEXTURE:
    case RHW_SHADER_TEXTURE:
    case RHW_SHADER_STORAGE_IMAGE: return open_image(resource, context, job, has_main_image(files, count));
    case RHW_SHADER_SAMPLER: return true;
    default:
        cli_error("--run", "%u:%u is a texel buffer or an input attachment, which are not given here",
                  (unsigned)resource->what->set, (unsigned)resource->what->binding);
        return false;
    }
}

// Set uniforms of known names in the buffers that no option fills. All textures are there by then.
static void set_uniforms(const struct cli_shader_resources *resources, struct cli_shader_job *job,
                         const struct cli_shader_file *files, int count)
{
    for (int i = 0; i < resources->count; i++) {
        const struct cli_shader_resource *const resource = &resources->list[i];
        if (!is_buffer(resource->what) || find_binding(&job->buffers, resource->what)) {
            continue;
        }
        for (int f = 0; f < count; f++) {
            const struct rhw_shader_resource *const one = find_resource(&files[f], resource->what);
            cli_shader_uniforms_set(one ? one->type : NULL, job, resources, resource->memory, resource->size);
        }
    }
}

// Put a resource into its set, in all elements of an array.
static bool bind(struct cli_shader_resources *resources, const struct cli_shader_resource *resource,
                 const rhw_shader_program *program, rhw_sampler sampler)
{
    const struct rhw_shader_resource *const what = resource->what;
    const bool has_texture = resource->width > 0;
    struct rhw_binding binding = {0};
    enum rhw_result result = RHW_OK;
    if (is_buffer(what)) {
        const bool is_read_only = what->kind == RHW_SHADER_UNIFORM_BUFFER;
        result = rhw_binding_of_memory(resource->memory, resource->size, is_read_only, &binding)
                     ? RHW_OK
                     : RHW_ERROR_MISUSE;
    } else if (what->kind == RHW_SHADER_SAMPLER) {
        result = rhw_binding_of_sampler(resources->context, sampler, &binding);
    } else if (what->kind == RHW_SHADER_STORAGE_IMAGE) {
        result = rhw_binding_of_image(resources->context, resource->texture, 0, false, &binding);
    } else if (has_texture) {
        const bool is_sampled = what->kind == RHW_SHADER_SAMPLED_TEXTURE;
        result = rhw_binding_of_texture(resources->context, resource->texture,
                                        is_sampled ? sampler : (rhw_sampler){0}, &binding);
    }
    const int first = rhw_shader_program_find(program, what->set, what->binding);
    for (uint32_t i = 0; first >= 0 && i < what->count; i++) {
        resources->sets[what->set][(uint32_t)first + i] = binding;
    }
    return result == RHW_OK;
}

static bool open_sets(struct cli_shader_resources *resources, const rhw_shader_program *program)
{
    rhw_sampler sampler;
    const struct rhw_sampler_def def = rhw_sampler_def_default();
    bool is_right = rhw_sampler_create(resources->context, &def, &sampler) == RHW_OK;
    for (uint32_t set = 0; set < RHW_SHADER_MAX_SETS; set++) {
        const uint32_t size = rhw_shader_program_set_size(program, set);
        resources->sets[set] = size > 0 ? calloc(size, sizeof(struct rhw_binding)) : NULL;
        is_right = is_right && (size == 0 || resources->sets[set]);
        resources->frame.sets[set] = resources->sets[set];
    }
    for (int i = 0; i < resources->count && is_right; i++) {
        is_right = bind(resources, &resources->list[i], program, sampler);
    }
    if (!is_right) {
        cli_error("--run", "out of memory");
    }
    return is_right;
}

// Report a result that could not be given, before anything is computed.
static bool check_result(const struct cli_shader_resources *resources,
                         const struct cli_shader_resource *resource, const struct cli_shader_binding *asked)
{
    const size_t length = strlen(asked->value);
    if (is_buffer(resource->what)) {
        return cli_shader_values_are(asked->value) || cli_output_file_check(asked->value);
    }
    if (length < 5 || strcasecmp(asked->value + length - 4, ".png") != 0) {
        cli_error("--result", "'%s': an image is written to a file named .png", asked->argument);
        return false;
    }
    if (rhw_texture_format(resources->context, resource->texture) != RHW_FORMAT_RGBA8_UNORM) {
        cli_error("--result", "'%s': only an image of 8 bits a channel is written", asked->argument);
        return false;
    }
    return cli_output_file_check(asked->value);
}

static bool check_results(const struct cli_shader_resources *resources,
                          const struct cli_shader_bindings *results)
{
    for (int i = 0; i < results->count; i++) {
        for (int r = 0; r < resources->count; r++) {
            if (cli_shader_binding_is(&results->list[i], resources->list[r].what) &&
                !check_result(resources, &resources->list[r], &results->list[i])) {
                return false;
            }
        }
    }
    return true;
}

static bool is_listed(const struct cli_shader_resources *resources, const struct rhw_shader_resource *what)
{
    for (int i = 0; i < resources->count; i++) {
        const struct rhw_shader_resource *const other = resources->list[i].what;
        if (other->set == what->set && other->binding == what->binding) {
            return true;
        }
    }
    return false;
}

bool cli_shader_resources_open(struct cli_shader_resources *resources, rhw_context *context,
                               struct cli_shader_job *job, const struct cli_shader_file *files, int count,
                               const rhw_shader_program *program)
{
    *resources = (struct cli_shader_resources){.context = context};
    resources->list = calloc((size_t)count * RHW_SHADER_MAX_RESOURCES, sizeof *resources->list);
    if (!resources->list) {
        cli_error("--run", "out of memory");
        return false;
    }
    for (int f = 0; f < count; f++) {
        const struct rhw_shader_info *const info = rhw_shader_get_info(files[f].shader);
        for (uint32_t i = 0; i < info->resource_count; i++) {
            if (is_listed(resources, &info->resources[i])) {
                continue;
            }
            struct cli_shader_resource *const one = &resources->list[resources->count++];
            one->what = &info->resources[i];
            if (!open_resource(one, context, job, files, count)) {
                return false;
            }
        }
    }
    set_uniforms(resources, job, files, count);
    if (!check_used(resources, &job->buffers, "buffer", is_buffer) ||
        !check_used(resources, &job->textures, "texture", is_image) ||
        !check_used(resources, &job->results, "buffer or storage image", is_result) ||
        !check_results(resources, &job->results) || !open_push_constants(resources, job, files, count) ||
        !open_sets(resources, program)) {
        return false;
    }
    resources->frame.push_constants = resources->push;
    resources->frame.push_size = (uint32_t)resources->push_size;
    return true;
}

void cli_shader_resources_close(struct cli_shader_resources *resources)
{
    for (int i = 0; i < resources->count; i++) {
        free(resources->list[i].memory);
    }
    for (int set = 0; set < RHW_SHADER_MAX_SETS; set++) {
        free(resources->sets[set]);
    }
    free(resources->list);
    free(resources->push);
    *resources = (struct cli_shader_resources){0};
}

// Results --------------------------------------------------------------------------------------------

struct picture {
    const uint8_t *texels;
    int width, channels;
};

static void fill_row(const void *user, int y, void *row)
{
    const struct picture *const picture = user;
    const uint8_t *texel = picture->texels + 4 * (size_t)picture->width * (size_t)y;
    uint8_t *bytes = row;
    for (int x = 0; x < picture->width; x++, texel += 4, bytes += picture->channels) {
        memcpy(bytes, texel, (size_t)picture->channels);
    }
}

bool cli_shader_write_picture(rhw_context *context, rhw_texture texture, int width, int height, int channels,
                              const char *path)
{
    uint8_t *const texels = malloc(4 * (size_t)width * (size_t)height);
    if (!texels || rhw_texture_read(context, texture, 0, texels, 0) != RHW_OK) {
        cli_error(path, "out of memory");
        free(texels);
        return false;
    }
    const struct picture picture = {.texels = texels, .width = width, .channels = channels};
    const struct cli_raster raster = {.width = width,
                                      .height = height,
                                      .channels = channels,
                                      .bits = 8,
                                      .srgb = true,
                                      .row = fill_row,
                                      .user = &picture};
    struct cli_output_file file;
    bool written = cli_output_file_open(&file, path);
    if (written) {
        written =
            cli_png_write(&file, &raster) && cli_output_file_finish(&file) && cli_output_file_commit(&file);
        if (!written) {
            cli_output_file_discard(&file);
        }
    }
    free(texels);
    return written;
}

static bool give(const struct cli_shader_resources *resources, const struct cli_shader_resource *resource,
                 const struct cli_shader_binding *asked)
{
    if (is_buffer(resource->what)) {
        return cli_shader_values_print(asked->value, resource->memory, resource->size) ||
               cli_shader_write_bytes(asked->value, resource->memory, resource->size);
    }
    return cli_shader_write_picture(resources->context, resource->texture, resource->width, resource->height,
                                    4, asked->value);
}

bool cli_shader_resources_give(const struct cli_shader_resources *resources, const struct cli_shader_job *job)
{
    for (int i = 0; i < job->results.count; i++) {
        const struct cli_shader_binding *const asked = &job->results.list[i];
        for (int r = 0; r < resources->count; r++) {
            if (cli_shader_binding_is(asked, resources->list[r].what) &&
                !give(resources, &resources->list[r], asked)) {
                return false;
            }
        }
    }
    return true;
}
