// SPDX-License-Identifier: MIT
// Typed access to the JSON. A value of the wrong type fails the import by its name.
#include "gltf.h"

#include <math.h>
#include <string.h>

static json_t *typed(struct scene_gltf *gltf, const json_t *object, const char *key,
                     bool (*is)(const json_t *), const char *type)
{
    json_t *value = json_object_get(object, key);
    if (value != NULL && !is(value)) {
        scene_import_fail(gltf->import, "\"%s\" must be %s", key, type);
    }
    return value;
}

static bool is_object(const json_t *value)
{
    return json_is_object(value);
}

static bool is_array(const json_t *value)
{
    return json_is_array(value);
}

static bool is_text(const json_t *value)
{
    return json_is_string(value);
}

static bool is_flag(const json_t *value)
{
    return json_is_boolean(value);
}

static bool is_number(const json_t *value)
{
    return json_is_number(value);
}

json_t *scene_gltf_object(struct scene_gltf *gltf, const json_t *object, const char *key)
{
    return typed(gltf, object, key, is_object, "an object");
}

json_t *scene_gltf_array(struct scene_gltf *gltf, const json_t *object, const char *key)
{
    return typed(gltf, object, key, is_array, "an array");
}

const char *scene_gltf_text(struct scene_gltf *gltf, const json_t *object, const char *key)
{
    return json_string_value(typed(gltf, object, key, is_text, "a string"));
}

bool scene_gltf_flag(struct scene_gltf *gltf, const json_t *object, const char *key, bool fallback)
{
    const json_t *value = typed(gltf, object, key, is_flag, "true or false");
    return value == NULL ? fallback : json_is_true(value);
}

double scene_gltf_number(struct scene_gltf *gltf, const json_t *object, const char *key, double fallback)
{
    const json_t *value = typed(gltf, object, key, is_number, "a number");
    return value == NULL ? fallback : json_number_value(value);
}

int64_t scene_gltf_integer(struct scene_gltf *gltf, const json_t *object, const char *key, int64_t fallback)
{
    const json_t *value = typed(gltf, object, key, is_number, "a whole number");
    if (value == NULL) {
        return fallback;
    }
    const double number = json_number_value(value); // some exporters write 3.0
    if (!(number >= 0 && number <= 9007199254740992.0) || number != floor(number)) {
        scene_import_fail(gltf->import, "\"%s\" must be a whole number, 0 to 9007199254740992", key);
    }
    return (int64_t)number;
}

bool scene_gltf_numbers(struct scene_gltf *gltf, const json_t *object, const char *key, double *values,
                        size_t count)
{
    const json_t *array = scene_gltf_array(gltf, object, key);
    if (array == NULL) {
        return false;
    }
    if (json_array_size(array) != count) {
        scene_import_fail(gltf->import, "\"%s\" must have %zu numbers", key, count);
    }
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(array, i);
        if (!json_is_number(value)) {
            scene_import_fail(gltf->import, "\"%s\" must hold numbers", key);
        }
        values[i] = json_number_value(value);
    }
    return true;
}

bool scene_gltf_floats(struct scene_gltf *gltf, const json_t *object, const char *key, float *values,
                       size_t count)
{
    enum { MOST = 16 };
    double numbers[MOST];
    if (!scene_gltf_numbers(gltf, object, key, numbers, count)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        values[i] = (float)numbers[i];
    }
    return true;
}

json_t *scene_gltf_extension(struct scene_gltf *gltf, const json_t *object, const char *name)
{
    return scene_gltf_object(gltf, scene_gltf_object(gltf, object, "extensions"), name);
}

const char *scene_gltf_name(struct scene_gltf *gltf, const json_t *object)
{
    // A name is of no consequence, so a wrong one is never an error.
    const char *name = json_string_value(json_object_get(object, "name"));
    return scene_import_string(gltf->import, name, name == NULL ? 0 : strlen(name));
}

size_t scene_gltf_count(struct scene_gltf *gltf, const char *list)
{
    return json_array_size(scene_gltf_array(gltf, gltf->root, list));
}

json_t *scene_gltf_item(struct scene_gltf *gltf, const char *list, int64_t index)
{
    const size_t count = scene_gltf_count(gltf, list);
    if (index < 0 || (uint64_t)index >= count) {
        scene_import_fail(gltf->import, "refers to %s[%lld], but there are %zu", list, (long long)index,
                          count);
    }
    json_t *item = json_array_get(scene_gltf_array(gltf, gltf->root, list), (size_t)index);
    if (!json_is_object(item)) {
        scene_import_fail(gltf->import, "%s[%lld] must be an object", list, (long long)index);
    }
    return item;
}
