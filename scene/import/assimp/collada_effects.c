// SPDX-License-Identifier: MIT
// Parameters of Collada's effects. assimp 5.2.5 takes no colour or number from one, and finds none that stands outside
// of a profile. So colours and numbers are written in the places that name their parameters, the other parameters into
// the common profile, and an effect once more for each material that sets some of them otherwise.
#include "assimp.h"
#include "collada_markup.h"
#include "edits.h"
#include "import/builder/decimal.h"
#include "import/builder/import.h"
#include "x3d_names.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = 4, LONGEST = 64 }; // numbers of a colour, and bytes of one

// A parameter, and the numbers that it begins with, none where it has other values.
struct parameter {
    struct scene_collada_value name, numbers[CHANNELS];
    size_t number_count;
    const char *start, *last; // the < and the > of the element
};

struct parameters {
    struct parameter *list;
    size_t count, capacity;
    struct scene_x3d_names names; // where those that have a name stand in the list
};

struct effect {
    char *start, *last; // from its < to its >
    struct scene_collada_value id;
    struct parameters common, free; // parameters of the common profile, and ones outside of all profiles
};

struct effects {
    struct effect *list;
    size_t count, capacity;
    struct scene_x3d_names names;
};

struct out {
    struct scene_import *import;
    size_t *left; // bytes that all effects may become together, 0 once they would be more
    char *text;
    size_t size, capacity;
};

static bool is_full(const struct out *out)
{
    return *out->left == 0;
}

static void add_bytes(struct out *out, const char *bytes, size_t size)
{
    if (size >= *out->left) {
        *out->left = 0;
        return;
    }
    *out->left -= size;
    scene_import_reserve(out->import, &out->text, &out->capacity, out->size + size + 1, 1);
    memcpy(out->text + out->size, bytes, size);
    out->size += size;
}

static void add_text(struct out *out, const char *text)
{
    add_bytes(out, text, strlen(text));
}

static const struct parameter *find_parameter(const struct parameters *parameters,
                                              struct scene_collada_value name)
{
    const struct scene_x3d_name *const found =
        name.text == NULL ? NULL : scene_x3d_find_name(&parameters->names, name);
    return found == NULL ? NULL : &parameters->list[found->at];
}

static void free_parameters(struct parameters *parameters)
{
    free(parameters->list);
    scene_x3d_free_names(&parameters->names);
}

static bool is_number_type(const char *tag)
{
    static const char *const types[] = {"float", "float2", "float3", "float4", "color"};
    bool is_type = false;
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        is_type = is_type || scene_collada_is_tag(tag, types[i]);
    }
    return is_type;
}

// Return true for a number that assimp reads, which fails a file at another one.
static bool is_short_number(const char *text, size_t length)
{
    const char *const digits = text + (*text == '-' || *text == '+');
    const bool has_digit =
        isdigit((unsigned char)digits[0]) || (digits[0] == '.' && isdigit((unsigned char)digits[1]));
    double value;
    return has_digit && length <= LONGEST && scene_decimal_read(text, text + length, &value) == text + length;
}

// Take the numbers that a text begins with, up to those of a colour. Take none where something else is among them.
static void read_numbers(struct parameter *parameter, char *text)
{
    parameter->number_count = 0;
    while (parameter->number_count < CHANNELS) {
        text += strspn(text, " \t\r\n");
        const size_t length = strcspn(text, " \t\r\n<");
        if (length == 0) {
            return;
        }
        if (!is_short_number(text, length)) {
            parameter->number_count = 0;
            return;
        }
        parameter->numbers[parameter->number_count++] = (struct scene_collada_value){text, length};
        text += length;
    }
}

// Return true for a tag in front of which all parameters end.
static bool is_beyond(const char *tag)
{
    return scene_collada_is_tag(tag, "instance_effect") || scene_collada_is_end(tag, "instance_effect") ||
           scene_collada_is_end(tag, "effect");
}

// Read the parameter whose start tag is at `tag`. Return the > at its end, or NULL if it has none.
static char *read_parameter(char *tag, char *close, const char *end, const char *element,
                            struct parameter *parameter)
{
    parameter->start = tag;
    for (char *c = strchr(close, '<'), *last; c != NULL && close[-1] != '/'; c = strchr(last, '<')) {
        last = scene_collada_markup_end(c, end);
        if (last == NULL || is_beyond(c)) {
            return NULL;
        }
        if (scene_collada_is_end(c, element)) {
            parameter->last = last;
            return last;
        }
        if (is_number_type(c) && last[-1] != '/') {
            read_numbers(parameter, last + 1);
        }
    }
    return NULL;
}

static void add_parameter(struct scene_import *import, struct parameters *parameters,
                          struct parameter parameter)
{
    scene_import_reserve(import, &parameters->list, &parameters->capacity, parameters->count + 1,
                         sizeof *parameters->list);
    scene_x3d_add_name(import, &parameters->names,
                       (struct scene_x3d_name){.name = parameter.name, .at = parameters->count});
    parameters->list[parameters->count++] = parameter;
}

// Read an effect from its start tag on. Return the > at its end, or NULL if it has none.
static char *read_effect(struct scene_import *import, char *close, const char *end, struct effect *effect)
{
    size_t profiles = 0;
    bool is_common = false;
    char *last;
    for (char *c = strchr(close, '<'); c != NULL; c = strchr(last, '<')) {
        last = scene_collada_markup_end(c, end);
        if (last == NULL || scene_collada_is_end(c, "effect")) {
            effect->last = last;
            return last;
        }
        const bool is_end = c[1] == '/';
        if (strncmp(c + 1 + is_end, "profile_", strlen("profile_")) == 0 && last[-1] != '/') {
            profiles += is_end ? (size_t)-1 : 1;
            is_common = scene_collada_is_tag(c, "profile_COMMON");
        }
        if (scene_collada_is_tag(c, "newparam")) {
            struct parameter parameter = {.name = scene_collada_attribute(c, last, "sid")};
            last = read_parameter(c, last, end, "newparam", &parameter);
            if (last == NULL) {
                return NULL;
            }
            if (is_common || profiles == 0) {
                add_parameter(import, is_common ? &effect->common : &effect->free, parameter);
            }
        }
    }
    return NULL;
}

// Write the numbers of a parameter as a colour, or the first where the element that they are for has one.
static void write_value(struct out *out, const struct parameter *parameter, bool is_number)
{
    add_text(out, is_number ? "<float>" : "<color>");
    for (size_t i = 0; i < (is_number ? 1 : CHANNELS); i++) {
        if (i < parameter->number_count) {
            add_bytes(out, parameter->numbers[i].text, parameter->numbers[i].length);
            add_text(out, " ");
        } else {
            add_text(out, i < 3 ? "0 " : "1 ");
        }
    }
    add_text(out, is_number ? "</float>" : "</color>");
}

// Return true for an element that has a colour or a number of a material. Say which.
static bool is_channel(const char *tag, bool *is_number)
{
    static const char *const numbers[] = {"shininess", "reflectivity", "transparency", "index_of_refraction"};
    static const char *const colors[] = {"emission", "ambient",    "diffuse",
                                         "specular", "reflective", "transparent"};
    bool is_color = false;
    *is_number = false;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        *is_number = *is_number || scene_collada_is_tag(tag, numbers[i]);
    }
    for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++) {
        is_color = is_color || scene_collada_is_tag(tag, colors[i]);
    }
    return is_color || *is_number;
}

// Return the parameter of a material that has a name, the innermost one that sets it. Return NULL where it is not known
// or without numbers.
static const struct parameter *find_value(const struct effect *effect, const struct parameters *set,
                                          struct scene_collada_value name)
{
    const struct parameter *parameter = set == NULL ? NULL : find_parameter(set, name);
    parameter = parameter != NULL ? parameter : find_parameter(&effect->common, name);
    parameter = parameter != NULL ? parameter : find_parameter(&effect->free, name);
    return parameter == NULL || parameter->number_count == 0 ? NULL : parameter;
}

static void write_free_parameters(struct out *out, const struct effect *effect)
{
    for (size_t i = 0; i < effect->free.count && !is_full(out); i++) {
        const struct parameter *const parameter = &effect->free.list[i];
        add_bytes(out, parameter->start, (size_t)(parameter->last + 1 - parameter->start));
    }
}

// Return the > at the end of a reference to a parameter whose start tag ends at `last`.
static char *reference_end(char *last, const char *end)
{
    char *const next = last[-1] == '/' ? NULL : strchr(last, '<');
    char *const next_end =
        next != NULL && scene_collada_is_end(next, "param") ? scene_collada_markup_end(next, end) : NULL;
    return next_end != NULL ? next_end : last;
}

// Write an effect without references to colours and numbers, from `done` on. Return true if that changed it. `set` has
// what a material sets otherwise.
static bool write_effect(struct out *out, const struct effect *effect, const struct parameters *set,
                         const char *done)
{
    const char *const end = effect->last + 1;
    bool has_changed = false, is_number = false, is_in_channel = false;
    size_t next_free = 0;
    char *last;
    for (char *c = effect->start; c != NULL && c < end && !is_full(out); c = strchr(last, '<')) {
        last = scene_collada_markup_end(c, end);
        if (last == NULL) {
            break;
        }
        while (next_free < effect->free.count && effect->free.list[next_free].last < c) {
            next_free++;
        }
        const struct parameter *const parameter =
            next_free < effect->free.count ? &effect->free.list[next_free] : NULL;
        bool is_now_number;
        if (parameter != NULL && parameter->start == c) {
            add_bytes(out, done, (size_t)(c - done));
            last = (char *)(uintptr_t)parameter->last;
            done = last + 1;
            has_changed = true;
        } else if (scene_collada_is_tag(c, "profile_COMMON") && last[-1] != '/') {
            add_bytes(out, done, (size_t)(last + 1 - done));
            write_free_parameters(out, effect);
            done = last + 1;
        } else if (is_channel(c, &is_now_number)) {
            is_in_channel = true;
            is_number = is_now_number;
        } else if (is_in_channel && scene_collada_is_tag(c, "param")) {
            const struct parameter *const value =
                find_value(effect, set, scene_collada_attribute(c, last, "ref"));
            last = reference_end(last, end);
            if (value == NULL) {
                scene_import_unsupported(out->import,
                                         "parameters of materials that are not there (Collada): not used");
            } else {
                add_bytes(out, done, (size_t)(c - done));
                write_value(out, value, is_number);
                done = last + 1;
                has_changed = true;
            }
        } else if (c[1] == '/' && is_channel(c + 1, &is_now_number)) {
            is_in_channel = false;
        }
    }
    add_bytes(out, done, (size_t)(end - done));
    return has_changed;
}

static void free_effects(struct effects *effects)
{
    for (size_t i = 0; i < effects->count; i++) {
        free_parameters(&effects->list[i].common);
        free_parameters(&effects->list[i].free);
    }
    free(effects->list);
    scene_x3d_free_names(&effects->names);
}

static void read_effects(struct scene_import *import, char *text, const char *end, struct effects *effects)
{
    char *last;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(last, '<')) {
        last = scene_collada_markup_end(c, end);
        if (last == NULL) {
            return;
        }
        if (scene_collada_is_tag(c, "effect") && last[-1] != '/') {
            struct effect effect = {.start = c, .id = scene_collada_attribute(c, last, "id")};
            last = read_effect(import, last, end, &effect);
            if (last == NULL) {
                free_parameters(&effect.common);
                free_parameters(&effect.free);
                return;
            }
            scene_import_reserve(import, &effects->list, &effects->capacity, effects->count + 1,
                                 sizeof *effects->list);
            scene_x3d_add_name(import, &effects->names,
                               (struct scene_x3d_name){.name = effect.id, .at = effects->count});
            effects->list[effects->count++] = effect;
        }
    }
}

// Find the effect of this document that an address means. Return NULL if there is none.
static const struct effect *find_effect(const struct effects *effects, struct scene_collada_value url)
{
    const bool is_here = url.length > 1 && url.text[0] == '#';
    const struct scene_x3d_name *const found =
        is_here
            ? scene_x3d_find_name(&effects->names, (struct scene_collada_value){url.text + 1, url.length - 1})
            : NULL;
    return found == NULL ? NULL : &effects->list[found->at];
}

// Read what a material sets from the start tag of its effect on. Return the > at the end of it.
static char *read_settings(struct scene_import *import, char *close, const char *end, struct parameters *set)
{
    char *last = close;
    for (char *c = strchr(close, '<'); c != NULL && close[-1] != '/'; c = strchr(last, '<')) {
        char *const tag_end = scene_collada_markup_end(c, end);
        last = tag_end != NULL ? tag_end : last;
        if (tag_end == NULL || scene_collada_is_end(c, "instance_effect")) {
            return last;
        }
        if (scene_collada_is_tag(c, "setparam")) {
            struct parameter parameter = {.name = scene_collada_attribute(c, tag_end, "ref")};
            char *const parameter_end = read_parameter(c, tag_end, end, "setparam", &parameter);
            if (parameter_end == NULL) {
                return last;
            }
            last = parameter_end;
            if (parameter.number_count == 0) {
                scene_import_unsupported(import,
                                         "images and samplers that materials set (Collada): not used");
            } else {
                add_parameter(import, set, parameter);
            }
        }
    }
    return last;
}

// Write the effect of a material that sets parameters once more, behind it, and make the material use it.
static void write_own_effect(struct out out, struct scene_edits *edits, const char *text,
                             const struct effect *effect, struct scene_collada_value url,
                             const struct parameters *set, size_t number)
{
    char name[48], reference[64];
    snprintf(name, sizeof name, "rhw-effect-%zu", number);
    snprintf(reference, sizeof reference, "#%s", name);
    add_bytes(&out, effect->start, (size_t)(effect->id.text - effect->start));
    add_text(&out, name);
    write_effect(&out, effect, set, effect->id.text + effect->id.length);
    if (is_full(&out)) {
        scene_import_unsupported(out.import, "parameters that materials set (Collada): not all used");
        free(out.text);
        return;
    }
    scene_edits_add(out.import, edits,
                    (struct scene_edit){(size_t)(effect->last + 1 - text), 0, out.text, out.size});
    scene_edits_add_string(out.import, edits, (size_t)(url.text - text), url.length, reference);
}

// Look through the materials for those that set parameters of their effects.
static void write_materials(struct out out, struct scene_edits *edits, char *text, const char *end,
                            const struct effects *effects)
{
    size_t number = 0;
    char *last;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(last, '<')) {
        last = scene_collada_markup_end(c, end);
        if (last == NULL) {
            return;
        }
        if (scene_collada_is_tag(c, "instance_effect")) {
            const struct scene_collada_value url = scene_collada_attribute(c, last, "url");
            struct parameters set = {0};
            last = read_settings(out.import, last, end, &set);
            const struct effect *const effect = set.count == 0 ? NULL : find_effect(effects, url);
            if (effect != NULL) {
                write_own_effect(out, edits, text, effect, url, &set, number++);
            }
            free_parameters(&set);
        }
    }
}

char *scene_assimp_write_effects(struct scene_import *import, char *text, size_t *size)
{
    if (strstr(text, "<newparam") == NULL) {
        return text;
    }
    // Each profile has all free parameters, and each material a copy of its effect, which many could make too large.
    const size_t room = (size_t)1 << 23, per_byte = 8;
    size_t left = room + per_byte * *size;
    const struct out empty = {.import = import, .left = &left};
    struct effects effects = {0};
    struct scene_edits edits = {0};
    const char *const end = text + *size;
    read_effects(import, text, end, &effects);
    for (size_t i = 0; i < effects.count; i++) {
        const struct effect *const effect = &effects.list[i];
        struct out out = empty;
        const bool has_changed = write_effect(&out, effect, NULL, effect->start);
        if (has_changed && left > 0) {
            scene_edits_add(import, &edits,
                            (struct scene_edit){(size_t)(effect->start - text),
                                                (size_t)(effect->last + 1 - effect->start), out.text,
                                                out.size});
        } else {
            free(out.text);
        }
    }
    if (left == 0) {
        scene_import_unsupported(import, "parameters of effects (Collada): not all used");
    }
    write_materials(empty, &edits, text, end, &effects);
    free_effects(&effects);
    return scene_edits_replace(import, &edits, text, size);
}
