// SPDX-License-Identifier: MIT
// MTL as it is written in the field: the 1995 specification, the PBR extension (Pr, Pm, norm, their maps) and file
// names with blanks.
#include "mtl.h"

#include "import/builder/find_file.h"
#include "import/builder/numbers.h"
#include "import/builder/phong.h"
#include "import/builder/text_lines.h"
#include "import/builder/unknown_words.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool key_is(struct scene_word word, const char *key)
{
    return strlen(key) == word.length && strncasecmp(word.start, key, word.length) == 0;
}

size_t scene_mtl_find(struct scene_import *import, struct scene_mtl *mtl, const char *name)
{
    const uint32_t hash = scene_hash_bytes(name, strlen(name));
    size_t place = SIZE_MAX;
    uint32_t found = scene_hash_next(&mtl->names, hash, &place);
    while (found != UINT32_MAX && strcmp(mtl->materials[found].name, name) != 0) {
        found = scene_hash_next(&mtl->names, hash, &place);
    }
    if (found != UINT32_MAX) {
        return found;
    }
    if (mtl->count >= INT32_MAX) {
        scene_import_fail(import, "has too many materials");
    }
    scene_import_reserve(import, &mtl->materials, &mtl->capacity, mtl->count + 1, sizeof *mtl->materials);
    mtl->materials[mtl->count] = (struct scene_mtl_material){name, scene_phong_default(), NULL, {-1, -1}};
    mtl->materials[mtl->count].phong.name = scene_import_string(import, name, strlen(name));
    scene_hash_add(import, &mtl->names, hash, (uint32_t)mtl->count);
    return mtl->count++;
}

uint32_t scene_mtl_use(struct scene_import *import, struct scene_mtl *mtl, size_t index, bool colored)
{
    struct scene_mtl_material *material = &mtl->materials[index];
    material->phong.colored = colored;
    if (material->made[colored] < 0) {
        material->made[colored] = (int32_t)scene_phong_add(import, &material->phong);
    }
    return (uint32_t)material->made[colored];
}

// Textures ------------------------------------------------------------------------------------------

// What an option takes after its name: words, or numbers of which some may be left out.
struct option {
    const char *name;
    int words, numbers;
};

static const struct option *find_option(struct scene_word word)
{
    static const struct option options[] = {
        {"-o", 0, 3},       {"-s", 0, 3},      {"-t", 0, 3},     {"-mm", 0, 2},         {"-bm", 0, 1},
        {"-boost", 0, 1},   {"-texres", 1, 0}, {"-clamp", 1, 0}, {"-blendu", 1, 0},     {"-blendv", 1, 0},
        {"-imfchan", 1, 0}, {"-cc", 1, 0},     {"-type", 1, 0},  {"-colorspace", 1, 0},
    };
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        if (key_is(word, options[i].name)) {
            return &options[i];
        }
    }
    return NULL;
}

static int channel_of(struct scene_word word)
{
    return key_is(word, "g") ? 1 : key_is(word, "b") ? 2 : key_is(word, "m") ? 3 : 0;
}

// A key that names a texture, and where its texture goes.
struct map {
    const char *key;
    struct scene_phong_texture *texture;
    const char *channels; // letters that -imfchan may ask for; NULL for a texture that is not drawn
    bool is_color;
};

// Return true for an option that changes how a texture looks and is not drawn.
static bool is_unused_option(const struct map *map, struct scene_word option, struct scene_word setting,
                             const float values[3])
{
    if (key_is(option, "-imfchan")) {
        return setting.length != 1 || strchr(map->channels, setting.start[0]) == NULL;
    }
    return (key_is(option, "-mm") && !(values[0] == 0 && values[1] == 1)) ||
           (key_is(option, "-t") && !(values[0] == 0 && values[1] == 0)) ||
           (key_is(option, "-boost") && values[0] != 0) || (key_is(option, "-cc") && key_is(setting, "on")) ||
           ((key_is(option, "-blendu") || key_is(option, "-blendv")) && key_is(setting, "off")) ||
           (key_is(option, "-colorspace") && key_is(setting, "sRGB") != map->is_color) ||
           key_is(option, "-type");
}

// Read the options in front of a file name. The rest of the line is the name. `folder` is that of the library.
static void read_texture(struct scene_import *import, const char *folder, struct scene_line line,
                         const struct map *map, float *multiplier)
{
    float offset[3] = {0, 0, 0}, scale[3] = {1, 1, 1};
    struct scene_word word, setting = {"", 0};
    struct scene_line before = line;
    int channel = 0;
    bool clamp = false;
    *multiplier = 1;
    while (scene_text_word(&line, &word) && find_option(word) != NULL) {
        const struct option *option = find_option(word);
        float others[3] = {0, key_is(word, "-mm") ? 1 : 0, 0};
        float *values = key_is(word, "-o")    ? offset
                        : key_is(word, "-s")  ? scale
                        : key_is(word, "-bm") ? multiplier
                                              : others;
        if (option->words > 0) {
            scene_text_word(&line, &setting);
        }
        scene_text_numbers(&line, values, option->numbers);
        channel = key_is(word, "-imfchan") ? channel_of(setting) : channel;
        if (map->channels != NULL && is_unused_option(map, word, setting, others)) {
            scene_import_unsupported(import, "%s of textures (MTL): not used",
                                     scene_word_string(import, word));
        }
        clamp = clamp || (key_is(word, "-clamp") && key_is(setting, "on"));
        before = line;
    }
    const struct scene_word name = scene_text_rest(before);
    if (name.length == 0) {
        return;
    }
    struct scene_phong_texture *const texture = map->texture;
    *texture = scene_phong_texture_default();
    texture->name = scene_word_string(import, name);
    texture->channel = channel;
    scene_import_find_image(import, folder, scene_word_bytes(import, name), &texture->source);
    if (clamp) {
        texture->slot.address_u = texture->slot.address_v = RHW_ADDRESS_CLAMP;
    }
    // MTL's v points up, with v' = s·v + o. The model's v points down, before and after the transform.
    const float transform[6] = {scale[0], 0, offset[0], 0, scale[1], 1 - scale[1] - offset[1]};
    if (scene_import_finite(transform, 6)) {
        memcpy(texture->slot.transform, transform, sizeof transform);
    }
}

static bool read_map(struct scene_import *import, const char *folder, struct scene_word key,
                     struct scene_line line, struct scene_phong *phong)
{
    static const char any[] = "rgbl"; // a grey picture is the same in all of them
    const struct map maps[] = {
        {"map_Kd", &phong->color, "", true},
        {"map_d", &phong->opacity_map, "lm", false},
        {"map_opacity", &phong->opacity_map, "lm", false},
        {"map_bump", &phong->height, any, false},
        {"bump", &phong->height, any, false},
        {"norm", &phong->normal, "", false},
        {"map_Ke", &phong->emissive_map, "", true},
        {"map_emissive", &phong->emissive_map, "", true},
        {"map_Pr", &phong->roughness_map, "rgblm", false},
        {"map_Pm", &phong->metallic_map, "rgblm", false},
        {"map_Pc", &phong->clearcoat_map, "rl", false},
        {"map_Pcr", &phong->clearcoat_roughness_map, "gl", false},
    };
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++) {
        if (key_is(key, maps[i].key)) {
            float multiplier;
            read_texture(import, folder, line, &maps[i], &multiplier);
            const bool relief = maps[i].texture == &phong->height || maps[i].texture == &phong->normal;
            phong->normal_scale =
                relief && scene_import_finite(&multiplier, 1) ? multiplier : phong->normal_scale;
            return true;
        }
    }
    return false;
}

// Tell of a texture that is not drawn. Return false if the key names none.
static bool note_unused_map(struct scene_import *import, struct scene_word key)
{
    static const struct {
        const char *key, *name;
    } maps[] = {
        {"map_Ks", "specular"},     {"map_Ns", "shininess"},  {"refl", "reflection"},
        {"map_refl", "reflection"}, {"disp", "displacement"}, {"map_disp", "displacement"},
        {"map_Ps", "sheen"},        {"decal", "decal"},
    };
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++) {
        if (key_is(key, maps[i].key)) {
            scene_import_unsupported(import, "%s textures: not used", maps[i].name);
            return true;
        }
    }
    const bool is_map = key.length > 4 && strncasecmp(key.start, "map_", 4) == 0;
    // map_aat is no texture but asks for anti-aliasing.
    if (is_map && !key_is(key, "map_aat")) {
        scene_import_unsupported(import, "textures of %s (MTL): not used", scene_word_string(import, key));
    }
    return is_map;
}

// Tell of ambient textures that are not the colour's as well, as most are.
static void note_ambient_maps(struct scene_import *import, const struct scene_mtl *mtl)
{
    for (size_t i = 0; i < mtl->count; i++) {
        const char *ambient = mtl->materials[i].ambient, *color = mtl->materials[i].phong.color.name;
        if (ambient != NULL && (color == NULL || strcmp(ambient, color) != 0)) {
            scene_import_unsupported(import, "ambient textures: not used");
        }
    }
}

// Values --------------------------------------------------------------------------------------------

// Read a number of the PBR extension. Return false if the key is none of the extension's.
static bool read_surface(struct scene_word key, float value, struct scene_phong *phong)
{
    const struct {
        const char *key;
        float *value;
    } values[] = {
        {"Pr", &phong->roughness},
        {"Pm", &phong->metallic},
        {"Pc", &phong->clearcoat},
        {"Pcr", &phong->clearcoat_roughness},
        {"Ps", &phong->sheen},
        {"aniso", &phong->anisotropy},
        {"anisor", &phong->anisotropy_turns},
    };
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        if (key_is(key, values[i].key)) {
            *values[i].value = value;
            return true;
        }
    }
    return false;
}

// Read a colour. One number is a grey. Text that is no number, as in "Kd spectral …", leaves the colour alone.
static bool read_color(struct scene_line line, float color[3])
{
    float values[3];
    const int count = scene_text_numbers(&line, values, 3);
    if (count == 0 || !scene_import_finite(values, (size_t)count)) {
        return false;
    }
    for (int c = 0; c < 3; c++) {
        color[c] = values[count == 3 ? c : 0];
    }
    return true;
}

// Tell of values that would change how a surface looks.
static void note_unused_value(struct scene_import *import, struct scene_word key, struct scene_line line)
{
    struct scene_line rest = line;
    struct scene_word word;
    float filter[3];
    const bool any = scene_text_word(&rest, &word);
    const bool color = key_is(key, "Kd") || key_is(key, "Ks") || key_is(key, "Ke");
    if (color && any && (key_is(word, "spectral") || key_is(word, "xyz"))) {
        scene_import_unsupported(import, "colours as \"%s\" (MTL): not used",
                                 key_is(word, "xyz") ? "xyz" : "spectral");
    }
    if (key_is(key, "d") && any && key_is(word, "-halo")) {
        scene_import_unsupported(import, "d -halo (MTL): not used");
    }
    if (key_is(key, "Tf") && scene_text_numbers(&line, filter, 3) == 3 &&
        (filter[0] != filter[1] || filter[1] != filter[2])) {
        scene_import_unsupported(import, "colours of transmitted light (Tf): not used");
    }
}

// Tell of a key that means nothing here. Ambient light, illumination models, refraction without rays and the sharpness
// of reflections are not told of: whoever writes a material writes them.
static void note_unknown_key(struct scene_import *import, struct scene_unknown_words *unknown,
                             struct scene_word key)
{
    static const char *const known[] = {"Ka", "Kd",  "Ks",    "Ke",     "Ns",    "Ni",
                                        "d",  "Tr",  "Tf",    "Pr",     "Pm",    "Pc",
                                        "Ps", "Pcr", "aniso", "anisor", "illum", "sharpness"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (key_is(key, known[i])) {
            return;
        }
    }
    scene_unknown_words_tell(import, unknown, key);
}

// Tell of a value that should be a number and is none, or none that is finite.
static void note_bad_value(struct scene_import *import, struct scene_word key, struct scene_line line)
{
    static const char *const keys[] = {"Kd", "Ks", "Ke", "Ns",  "d",     "Tr",     "Pr",
                                       "Pm", "Pc", "Ps", "Pcr", "aniso", "anisor", "illum"};
    const struct scene_word text = scene_text_rest(line);
    struct scene_word word = {"", 0};
    float values[3];
    struct scene_line rest = line;
    const int count = scene_text_numbers(&rest, values, 3);
    scene_text_word(&line, &word);
    const bool is_told = key_is(word, "spectral") || key_is(word, "xyz") || key_is(word, "-halo");
    for (size_t i = 0; i < sizeof keys / sizeof keys[0] && !is_told; i++) {
        if (key_is(key, keys[i]) && (count == 0 || !scene_import_finite(values, (size_t)count))) {
            scene_import_warn(import, "\"%s %.40s\" (MTL) is no number: left out", keys[i],
                              scene_word_string(import, text));
        }
    }
}

static void read_value(struct scene_word key, struct scene_line line, struct scene_phong *phong,
                       bool *dissolve)
{
    struct scene_line rest = line;
    float value = 0;
    const bool number = scene_text_numbers(&rest, &value, 1) == 1 && scene_import_finite(&value, 1);
    if (key_is(key, "Kd")) {
        phong->described = read_color(line, phong->diffuse) || phong->described;
    } else if (key_is(key, "Ks")) {
        read_color(line, phong->specular);
    } else if (key_is(key, "Ke")) {
        read_color(line, phong->emissive);
    } else if (!number) {
        return;
    } else if (key_is(key, "Ns")) {
        phong->shininess = value;
    } else if (key_is(key, "d")) {
        phong->opacity = value;
        *dissolve = true;
        // Some files write both keys, and they may contradict each other.
    } else if (key_is(key, "Tr") && !*dissolve) {
        phong->opacity = 1 - value;
    } else if (!read_surface(key, value, phong) && key_is(key, "illum")) {
        phong->unlit = value == 0;
        phong->dull = value == 1;
    }
}

// Return the part of a path up to its last slash. A path without a slash has none.
static const char *folder_of(struct scene_import *import, const char *path)
{
    const char *const slash = strrchr(path, '/');
    const size_t length = slash == NULL ? 0 : (size_t)(slash - path) + 1;
    return memcpy(scene_import_allocate(import, length + 1, 1), path, length);
}

bool scene_mtl_read(struct scene_import *import, struct scene_mtl *mtl, const char *name)
{
    const char *path = scene_import_find_file(import, name), *problem = import->missing;
    size_t size = 0;
    char *bytes = path == NULL ? NULL : scene_import_read_file(import, path, &size, &problem);
    if (bytes == NULL) {
        scene_import_warn(import, "material library \"%.200s\": %s", name, problem);
        return false;
    }
    struct scene_text text = scene_text_open(import, bytes, size);
    const char *const folder = folder_of(import, path);
    struct scene_line line;
    struct scene_word key;
    size_t current = SIZE_MAX;
    bool dissolve = false;
    struct scene_unknown_words unknown = {.format = "MTL"};
    while (scene_text_line(&text, false, &line)) {
        if (!scene_text_word(&line, &key) || key.start[0] == '#') {
            continue;
        }
        if (key_is(key, "newmtl")) {
            current = scene_mtl_find(import, mtl, scene_word_bytes(import, scene_text_rest(line)));
            dissolve = false;
            continue;
        }
        if (current == SIZE_MAX) {
            scene_import_unsupported(import, "what stands before the first newmtl (MTL): not used");
            continue;
        }
        struct scene_phong *phong = &mtl->materials[current].phong;
        if (key_is(key, "map_Ka")) {
            struct scene_phong_texture ambient = scene_phong_texture_default();
            float multiplier;
            read_texture(import, folder, line, &(const struct map){.texture = &ambient}, &multiplier);
            mtl->materials[current].ambient = ambient.name;
        } else if (!read_map(import, folder, key, line, phong) && !note_unused_map(import, key)) {
            note_unknown_key(import, &unknown, key);
            note_unused_value(import, key, line);
            note_bad_value(import, key, line);
            read_value(key, line, phong, &dissolve);
        }
    }
    note_ambient_maps(import, mtl);
    free(bytes);
    return true;
}
