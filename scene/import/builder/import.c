// SPDX-License-Identifier: MIT
// The model under construction: growing arrays, lines for the user, and files.

#include "import.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "child.h"
#include "file.h"
#include "huge_pages.h"

enum { MESSAGES = 64 }; // lines of each kind that are kept; a hostile file could make millions

_Noreturn void scene_import_fail(struct scene_import *import, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    import->leave(import, line);
    abort();
}

static void *check(struct scene_import *import, void *memory, size_t count, size_t size)
{
    if (memory == NULL) {
        scene_import_fail(import, "needs more memory than there is (%zu MiB more)", count / 1048576 * size);
    }
    system_huge_pages_prefer(memory, count * size);
    return memory;
}

void *scene_import_allocate(struct scene_import *import, size_t count, size_t size)
{
    return check(import, calloc(count > 0 ? count : 1, size), count, size);
}

void *scene_import_allocate_any(struct scene_import *import, size_t count, size_t size)
{
    const size_t least = count > 0 ? count : 1;
    return check(import, least <= SIZE_MAX / size ? malloc(least * size) : NULL, count, size);
}

void scene_import_reserve(struct scene_import *import, void *array, size_t *capacity, size_t needed,
                          size_t size)
{
    void **elements = array;
    if (needed <= *capacity) {
        return;
    }
    const size_t larger = needed > *capacity * 2 ? needed + 16 : *capacity * 2;
    void *moved = realloc(*elements, larger * size);
    if (moved == NULL) {
        scene_import_fail(import, "needs more memory than there is");
    }
    system_huge_pages_prefer(moved, larger * size);
    *elements = moved;
    *capacity = larger;
}

// Add an element at the end of an array. Return it zeroed.
static void *grow(struct scene_import *import, void *array, uint32_t *count, uint32_t *capacity, size_t size)
{
    void **elements = array;
    if (*count == *capacity) {
        if (*capacity >= UINT32_MAX / 2) {
            scene_import_fail(import, "has too many parts");
        }
        const uint32_t larger = *capacity == 0 ? 16 : *capacity * 2;
        void *moved = realloc(*elements, larger * size);
        if (moved == NULL) {
            scene_import_fail(import, "needs more memory than there is");
        }
        system_huge_pages_prefer(moved, larger * size);
        *elements = moved;
        *capacity = larger;
    }
    void *element = (char *)*elements + *count * size;
    memset(element, 0, size);
    ++*count;
    return element;
}

static void grow_exact(struct scene_import *import, struct scene_import_exact *exact)
{
    grow(import, &exact->matrices, &exact->count, &exact->capacity, sizeof *exact->matrices);
}

// Return the number of bytes of the well-formed UTF-8 character at `text` (RFC 3629). Return 0 if there is none.
static size_t utf8_length(const unsigned char *text, size_t left)
{
    const unsigned char lead = text[0];
    const size_t length = lead < 0x80   ? 1
                          : lead < 0xc2 ? 0
                          : lead < 0xe0 ? 2
                          : lead < 0xf0 ? 3
                          : lead < 0xf5 ? 4
                                        : 0;
    if (length == 0 || length > left) {
        return 0;
    }
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    if ((lead == 0xe0 && text[1] < 0xa0) || (lead == 0xed && text[1] > 0x9f) ||
        (lead == 0xf0 && text[1] < 0x90) || (lead == 0xf4 && text[1] > 0x8f)) {
        return 0;
    }
    return length;
}

const char *scene_import_string(struct scene_import *import, const char *text, size_t length)
{
    length = text == NULL ? 0 : strnlen(text, length);
    char *copy = scene_import_allocate(import, length + 1, 1);
    for (size_t i = 0; i < length;) {
        const size_t character = utf8_length((const unsigned char *)text + i, length - i);
        if (character == 0 || (unsigned char)text[i] < 32 || text[i] == 127) {
            copy[i++] = '?';
            continue;
        }
        memcpy(copy + i, text + i, character);
        i += character;
    }
    return copy;
}

// Add a line unless it is there already.
static void add_line(struct scene_import *import, const char ***lines, uint32_t *count, uint32_t *capacity,
                     const char *format, va_list arguments)
{
    char line[512];
    vsnprintf(line, sizeof line, format, arguments);
    for (uint32_t i = 0; i < *count; i++) {
        if (strcmp((*lines)[i], line) == 0) {
            return;
        }
    }
    if (*count > MESSAGES) {
        return;
    }
    const char **slot = grow(import, lines, count, capacity, sizeof *slot);
    *slot = scene_import_string(import, *count > MESSAGES ? "and more of the kind" : line, sizeof line);
}

void scene_import_warn(struct scene_import *import, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_line(import, &import->model.warnings, &import->model.warning_count, &import->warning_capacity, format,
             arguments);
    va_end(arguments);
}

void scene_import_clear_reply(struct scene_import *import)
{
    FILE *const reply = import->child->reply;
    rewind(reply);
    if (ftruncate(fileno(reply), 0) != 0) {
        abort();
    }
}

void scene_import_enter(struct scene_import *import, const char *library, const char *more)
{
    FILE *const reply = import->child->reply;
    scene_import_clear_reply(import);
    if (library != NULL) {
        fprintf(reply, SCENE_IMPORT_ENTERED "%s, the library that reads it, crashed%s", library, more);
        fflush(reply);
    }
}

void scene_import_unsupported(struct scene_import *import, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_line(import, &import->model.unsupported, &import->model.unsupported_count,
             &import->unsupported_capacity, format, arguments);
    va_end(arguments);
}

struct scene_mesh *scene_import_add_mesh(struct scene_import *import)
{
    struct scene_mesh *mesh =
        grow(import, &import->model.meshes, &import->model.mesh_count, &import->mesh_capacity, sizeof *mesh);
    mesh->name = "";
    grow_exact(import, &import->exact_meshes);
    return mesh;
}

struct scene_texture_slot scene_import_slot_default(void)
{
    return (struct scene_texture_slot){
        .image = -1,
        .transform = {1, 0, 0, 0, 1, 0},
        .min_filter = RHW_FILTER_LINEAR,
        .mag_filter = RHW_FILTER_LINEAR,
        .mip_filter = RHW_MIP_FILTER_LINEAR,
        .address_u = RHW_ADDRESS_REPEAT,
        .address_v = RHW_ADDRESS_REPEAT,
    };
}

struct scene_material *scene_import_add_material(struct scene_import *import)
{
    struct scene_material *material = grow(import, &import->model.materials, &import->model.material_count,
                                           &import->material_capacity, sizeof *material);
    *material = (struct scene_material){
        .name = "",
        .base_color = {1, 1, 1, 1},
        .metallic = 1,
        .roughness = 1,
        .normal_scale = 1,
        .occlusion_strength = 1,
        .alpha_cutoff = 0.5f,
        .layers = {.clearcoat_normal_scale = 1,
                   .specular = 1,
                   .specular_color = {1, 1, 1},
                   .ior = 1.5f,
                   .attenuation_distance = __builtin_inff(),
                   .attenuation_color = {1, 1, 1},
                   .anisotropy_direction = {1, 0},
                   .iridescence_ior = 1.3f,
                   .iridescence_thickness = {100, 400},
                   .gloss_specular = {1, 1, 1},
                   .glossiness = 1},
    };
    for (int i = 0; i < SCENE_SLOT_COUNT; i++) {
        material->slots[i] = scene_import_slot_default();
    }
    return material;
}

struct scene_instance *scene_import_add_instance(struct scene_import *import)
{
    struct scene_instance *instance = grow(import, &import->model.instances, &import->model.instance_count,
                                           &import->instance_capacity, sizeof *instance);
    instance->name = "";
    grow_exact(import, &import->exact_instances);
    return instance;
}

struct scene_model_camera *scene_import_add_camera(struct scene_import *import)
{
    struct scene_model_camera *camera = grow(import, &import->model.cameras, &import->model.camera_count,
                                             &import->camera_capacity, sizeof *camera);
    camera->name = "";
    grow_exact(import, &import->exact_cameras);
    return camera;
}

struct scene_model_light *scene_import_add_light(struct scene_import *import)
{
    grow_exact(import, &import->exact_lights);
    struct scene_model_light *light = grow(import, &import->model.lights, &import->model.light_count,
                                           &import->light_capacity, sizeof *light);
    light->name = "";
    return light;
}

int32_t scene_import_add_image(struct scene_import *import, const char *name,
                               const struct scene_import_source *source)
{
    struct scene_image *image = grow(import, &import->model.images, &import->model.image_count,
                                     &import->image_capacity, sizeof *image);
    image->name = name;
    struct scene_import_source *place =
        grow(import, &import->sources, &import->source_count, &import->source_capacity, sizeof *place);
    *place = *source;
    return (int32_t)(import->model.image_count - 1);
}

const char *scene_import_pointer_problem(const void *bytes, size_t size)
{
    enum { MOST = 2048 }; // pointers are shorter than 1024 bytes
    const char *text = bytes;
    if (size < MOST && strncmp(text, "version http", 12) == 0 && strstr(text, "\noid sha256:") != NULL) {
        return "is a Git LFS pointer, not the file (git lfs pull)";
    }
    if (size < MOST && strncmp(text, "/annex/objects/", 15) == 0) {
        return "is a git-annex pointer, not the file (git annex get)";
    }
    return NULL;
}

const char scene_import_no_memory[] = "outofmem"; // the words of stb_image

void *scene_import_read_bytes(const char *path, size_t *size, const char **problem)
{
    const int descriptor = system_file_open_regular(path);
    if (descriptor < 0) {
        *problem = errno != 0 ? strerror(errno) : "not a regular file";
        return NULL;
    }
    struct stat status;
    if (fstat(descriptor, &status) != 0) {
        *problem = strerror(errno);
        close(descriptor);
        return NULL;
    }
    *size = (size_t)status.st_size;
    char *bytes = malloc(*size + 1);
    if (bytes == NULL) {
        *problem = scene_import_no_memory;
        close(descriptor);
        return NULL;
    }
    system_huge_pages_prefer(bytes, *size);
    bytes[*size] = 0;
    size_t done = 0;
    while (done < *size) {
        // Windows reads no more at a time, and Linux little more.
        const size_t left = *size - done, most = 1 << 30;
        const ssize_t step = read(descriptor, bytes + done, (unsigned)(left < most ? left : most));
        if (step < 0 && errno == EINTR) {
            continue;
        }
        if (step <= 0) {
            break;
        }
        done += (size_t)step;
    }
    close(descriptor);
    *problem = done < *size ? "could not be read to its end" : scene_import_pointer_problem(bytes, *size);
    if (*problem != NULL) {
        free(bytes);
        return NULL;
    }
    return bytes;
}

void *scene_import_read_file(struct scene_import *import, const char *path, size_t *size,
                             const char **problem)
{
    void *bytes = scene_import_read_bytes(path, size, problem);
    if (bytes == NULL && *problem == scene_import_no_memory) {
        scene_import_fail(import, "needs more memory than there is (%zu MiB more)", *size / 1048576);
    }
    return bytes;
}
