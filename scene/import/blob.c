// SPDX-License-Identifier: MIT
// The model's structs are described once, in tables of the pointers they hold. Writing and reading walk these tables in
// one order. The place of every array follows from the counts before it, so no offset is stored: a pointer in the bytes
// only says whether the array is there. Reading sets the pointers in place, without copying what they point to.
#include "blob.h"

#include <string.h>

enum { ALIGNMENT = 64 }; // bytes between starts of arrays, so that vector loads from them are aligned

enum field_kind {
    FIELD_STRING, // const char *, which ends with a zero
    FIELD_ARRAY,  // `count` elements
    FIELD_STRINGS // `count` strings
};

struct layout;

struct field {
    enum field_kind kind;
    size_t pointer; // offset of the pointer in its struct
    // The offset of the count in its struct. The count is a uint32_t or, for bytes, a size_t.
    size_t count;
    size_t element;              // bytes per element
    bool count_is_size;          // the count is a size_t, not a uint32_t
    bool required;               // NULL is no valid value
    const struct layout *layout; // layout of an element; NULL if it holds no pointers
};

struct layout {
    size_t field_count;
    const struct field *fields;
};

#define STRING(type, name)                                                 \
    {                                                                      \
        FIELD_STRING, offsetof(struct type, name), 0, 1, false, true, NULL \
    }
#define ARRAY(type, name, counter, size, required)                                                       \
    {                                                                                                    \
        FIELD_ARRAY, offsetof(struct type, name), offsetof(struct type, counter), size, false, required, \
            NULL                                                                                         \
    }
#define STRUCTS(type, name, counter, size, layout)                                                          \
    {                                                                                                       \
        FIELD_ARRAY, offsetof(struct type, name), offsetof(struct type, counter), size, false, true, layout \
    }
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct field mesh_fields[] = {
    STRING(scene_mesh, name),
    ARRAY(scene_mesh, indices, index_count, sizeof(uint32_t), true),
    ARRAY(scene_mesh, positions, vertex_count, sizeof(float[3]), true),
    ARRAY(scene_mesh, normals, vertex_count, sizeof(float[3]), false),
    ARRAY(scene_mesh, tangents, vertex_count, sizeof(float[4]), false),
    ARRAY(scene_mesh, uvs[0], vertex_count, sizeof(float[2]), false),
    ARRAY(scene_mesh, uvs[1], vertex_count, sizeof(float[2]), false),
    ARRAY(scene_mesh, colors, vertex_count, sizeof(float[4]), false),
};
static const struct field material_fields[] = {STRING(scene_material, name)};
static const struct field image_fields[] = {
    STRING(scene_image, name),
    {FIELD_ARRAY, offsetof(struct scene_image, texels), offsetof(struct scene_image, size), 1, true, true,
     NULL},
};
static const struct field instance_fields[] = {STRING(scene_instance, name)};
static const struct field camera_fields[] = {STRING(scene_model_camera, name)};
static const struct field light_fields[] = {STRING(scene_model_light, name)};
static const struct field animation_fields[] = {STRING(scene_model_animation, name)};

static const struct layout mesh_layout = {COUNT(mesh_fields), mesh_fields};
static const struct layout material_layout = {COUNT(material_fields), material_fields};
static const struct layout image_layout = {COUNT(image_fields), image_fields};
static const struct layout instance_layout = {COUNT(instance_fields), instance_fields};
static const struct layout camera_layout = {COUNT(camera_fields), camera_fields};
static const struct layout light_layout = {COUNT(light_fields), light_fields};
static const struct field extension_fields[] = {STRING(scene_model_extension, name)};
static const struct layout extension_layout = {COUNT(extension_fields), extension_fields};
static const struct layout animation_layout = {COUNT(animation_fields), animation_fields};

static const struct field model_fields[] = {
    STRING(scene_model, path),
    STRING(scene_model, format),
    STRING(scene_model, unit),
    STRUCTS(scene_model, meshes, mesh_count, sizeof(struct scene_mesh), &mesh_layout),
    STRUCTS(scene_model, materials, material_count, sizeof(struct scene_material), &material_layout),
    STRUCTS(scene_model, images, image_count, sizeof(struct scene_image), &image_layout),
    STRUCTS(scene_model, instances, instance_count, sizeof(struct scene_instance), &instance_layout),
    STRUCTS(scene_model, cameras, camera_count, sizeof(struct scene_model_camera), &camera_layout),
    STRUCTS(scene_model, lights, light_count, sizeof(struct scene_model_light), &light_layout),
    STRUCTS(scene_model, animations, animation_count, sizeof(struct scene_model_animation),
            &animation_layout),
    STRUCTS(scene_model, extensions, extension_count, sizeof(struct scene_model_extension),
            &extension_layout),
    {FIELD_STRINGS, offsetof(struct scene_model, warnings), offsetof(struct scene_model, warning_count),
     sizeof(char *), false, true, NULL},
    {FIELD_STRINGS, offsetof(struct scene_model, unsupported),
     offsetof(struct scene_model, unsupported_count), sizeof(char *), false, true, NULL},
    {FIELD_STRINGS, offsetof(struct scene_model, variants), offsetof(struct scene_model, variant_count),
     sizeof(char *), false, true, NULL},
};
static const struct layout model_layout = {COUNT(model_fields), model_fields};

static size_t field_count(const struct field *field, const unsigned char *object)
{
    uint32_t number;
    size_t size;
    if (field->count_is_size) {
        memcpy(&size, object + field->count, sizeof size);
        return size;
    }
    memcpy(&number, object + field->count, sizeof number);
    return number;
}

static const void *field_pointer(const struct field *field, const unsigned char *object)
{
    const void *pointer;
    memcpy(&pointer, object + field->pointer, sizeof pointer);
    return pointer;
}

// Writing -------------------------------------------------------------------------------------------

struct writer {
    FILE *file;
    size_t cursor;
    bool failed;
};

static void write_bytes(struct writer *writer, const void *bytes, size_t size, size_t alignment)
{
    static const unsigned char zeros[ALIGNMENT];
    const size_t padding = (alignment - writer->cursor % alignment) % alignment;
    if (fwrite(zeros, 1, padding, writer->file) != padding || fwrite(bytes, 1, size, writer->file) != size) {
        writer->failed = true;
    }
    writer->cursor += padding + size;
}

static void write_fields(struct writer *writer, const struct layout *layout, const unsigned char *object)
{
    for (size_t i = 0; i < layout->field_count; i++) {
        const struct field *field = &layout->fields[i];
        const unsigned char *data = field_pointer(field, object);
        if (field->kind == FIELD_STRING) {
            write_bytes(writer, data, strlen((const char *)data) + 1, 1);
            continue;
        }
        const size_t count = field_count(field, object);
        if (data == NULL || count == 0) {
            continue;
        }
        if (field->kind == FIELD_STRINGS) {
            write_bytes(writer, data, count * field->element, ALIGNMENT);
            for (size_t k = 0; k < count; k++) {
                const char *text = ((const char *const *)(const void *)data)[k];
                write_bytes(writer, text, strlen(text) + 1, 1);
            }
            continue;
        }
        write_bytes(writer, data, count * field->element, ALIGNMENT);
        for (size_t k = 0; field->layout != NULL && k < count; k++) {
            write_fields(writer, field->layout, data + k * field->element);
        }
    }
}

bool scene_blob_write(const struct scene_model *model, FILE *file)
{
    struct writer writer = {file, 0, false};
    write_bytes(&writer, model, sizeof *model, ALIGNMENT);
    write_fields(&writer, &model_layout, (const unsigned char *)model);
    return !writer.failed && fflush(file) == 0;
}

// Reading -------------------------------------------------------------------------------------------

struct reader {
    unsigned char *bytes;
    size_t size, cursor;
};

// Return the next `count` elements. Return NULL if they do not fit.
static void *read_array(struct reader *reader, size_t count, size_t element, size_t alignment)
{
    const size_t padding = (alignment - reader->cursor % alignment) % alignment;
    const size_t left = reader->size - reader->cursor;
    if (padding > left || count > (left - padding) / element) {
        return NULL;
    }
    void *array = reader->bytes + reader->cursor + padding;
    reader->cursor += padding + count * element;
    return array;
}

static char *read_string(struct reader *reader)
{
    char *text = (char *)reader->bytes + reader->cursor;
    const char *end = memchr(text, 0, reader->size - reader->cursor);
    if (end == NULL) {
        return NULL;
    }
    reader->cursor += (size_t)(end - text) + 1;
    return text;
}

static bool read_fields(struct reader *reader, const struct layout *layout, unsigned char *object)
{
    for (size_t i = 0; i < layout->field_count; i++) {
        const struct field *field = &layout->fields[i];
        void *data = NULL;
        if (field->kind == FIELD_STRING) {
            data = read_string(reader);
            if (data == NULL) {
                return false;
            }
        } else {
            const size_t count = field_count(field, object);
            const bool present = field_pointer(field, object) != NULL;
            if (field->required && !present && count > 0) {
                return false;
            }
            if (present && count > 0) {
                data = read_array(reader, count, field->element, ALIGNMENT);
                if (data == NULL) {
                    return false;
                }
            }
            for (size_t k = 0; k < count && field->kind == FIELD_STRINGS; k++) {
                char *text = read_string(reader);
                if (text == NULL) {
                    return false;
                }
                ((char **)data)[k] = text;
            }
            for (size_t k = 0; k < count && field->layout != NULL; k++) {
                if (!read_fields(reader, field->layout, (unsigned char *)data + k * field->element)) {
                    return false;
                }
            }
        }
        memcpy(object + field->pointer, &data, sizeof data);
    }
    return true;
}

// What the arrays mean ------------------------------------------------------------------------------

static bool mesh_valid(const struct scene_mesh *mesh, const struct scene_model *model)
{
    if ((unsigned)mesh->primitive > SCENE_PRIMITIVE_POINTS || mesh->material >= model->material_count) {
        return false;
    }
    const uint32_t corners = scene_mesh_corners(mesh);
    if (mesh->index_count % corners != 0) {
        return false;
    }
    if (corners == 3 && mesh->vertex_count > 0 && mesh->normals == NULL) {
        return false;
    }
    uint32_t largest = 0;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        largest = mesh->indices[i] > largest ? mesh->indices[i] : largest;
    }
    return mesh->index_count == 0 || largest < mesh->vertex_count;
}

static bool image_valid(const struct scene_image *image)
{
    static const size_t texel_size[] = {4, 8, 16};
    if ((unsigned)image->type > SCENE_IMAGE_RGBA32F || image->width - 1 >= RHW_MAX_TARGET_SIZE ||
        image->height - 1 >= RHW_MAX_TARGET_SIZE) {
        return false;
    }
    return image->size == (size_t)image->width * image->height * texel_size[image->type];
}

static bool material_valid(const struct scene_material *material, const struct scene_model *model)
{
    if ((unsigned)material->alpha_mode > SCENE_ALPHA_BLEND) {
        return false;
    }
    for (int i = 0; i < SCENE_SLOT_COUNT; i++) {
        const struct scene_texture_slot *slot = &material->slots[i];
        if (slot->image < -1 || (slot->image >= 0 && (uint32_t)slot->image >= model->image_count) ||
            slot->uv_set >= SCENE_UV_SETS || (unsigned)slot->address_u > RHW_ADDRESS_BORDER ||
            (unsigned)slot->address_v > RHW_ADDRESS_BORDER ||
            (unsigned)slot->min_filter > RHW_FILTER_NEAREST ||
            (unsigned)slot->mag_filter > RHW_FILTER_NEAREST ||
            (unsigned)slot->mip_filter > RHW_MIP_FILTER_NONE) {
            return false;
        }
        for (int c = 0; c < 4; c++) {
            if (!(slot->border[c] >= 0 && slot->border[c] <= 1)) {
                return false;
            }
        }
    }
    return true;
}

static bool model_valid(const struct scene_model *model)
{
    if ((unsigned)model->up > SCENE_AXIS_MINUS_X) {
        return false;
    }
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        if (!mesh_valid(&model->meshes[i], model)) {
            return false;
        }
    }
    for (uint32_t i = 0; i < model->image_count; i++) {
        if (!image_valid(&model->images[i])) {
            return false;
        }
    }
    for (uint32_t i = 0; i < model->material_count; i++) {
        if (!material_valid(&model->materials[i], model)) {
            return false;
        }
    }
    for (uint32_t i = 0; i < model->instance_count; i++) {
        if (model->instances[i].mesh >= model->mesh_count) {
            return false;
        }
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        if ((unsigned)model->lights[i].type > SCENE_LIGHT_SPOT) {
            return false;
        }
    }
    return true;
}

struct scene_model *scene_blob_read(void *bytes, size_t size)
{
    struct reader reader = {bytes, size, 0};
    struct scene_model *model = read_array(&reader, 1, sizeof *model, ALIGNMENT);
    if (model == NULL || !read_fields(&reader, &model_layout, (unsigned char *)model) ||
        reader.cursor != size) {
        return NULL;
    }
    return model_valid(model) ? model : NULL;
}
