// SPDX-License-Identifier: MIT
#include "info_layers.h"

#include <stddef.h>
#include <string.h>

// `usual` is what does nothing.
struct layer_number {
    const char *name;
    size_t offset;
    int count;
    float usual[3];
};

#define NAMED(name) #name, offsetof(struct scene_layers, name)

static const struct layer_number numbers[] = {
    {NAMED(clearcoat), 1, {0}},
    {NAMED(clearcoat_roughness), 1, {0}},
    {NAMED(sheen_color), 3, {0, 0, 0}},
    {NAMED(sheen_roughness), 1, {0}},
    {NAMED(specular), 1, {1}},
    {NAMED(specular_color), 3, {1, 1, 1}},
    {NAMED(ior), 1, {1.5f}},
    {NAMED(transmission), 1, {0}},
    {NAMED(thickness), 1, {0}},
    {NAMED(attenuation_distance), 1, {__builtin_inff()}},
    {NAMED(attenuation_color), 3, {1, 1, 1}},
    {NAMED(dispersion), 1, {0}},
    {NAMED(anisotropy), 1, {0}},
    {NAMED(iridescence), 1, {0}},
};

// In the place of metallic and roughness.
static const struct layer_number gloss_numbers[] = {
    {NAMED(gloss_specular), 3, {-1, -1, -1}},
    {NAMED(glossiness), 1, {-1}},
};

static void tell_unusual(const struct scene_layers *layers, const struct layer_number *number, size_t count,
                         cli_layer_teller *tell)
{
    for (size_t i = 0; i < count; i++) {
        float values[3];
        const size_t size = (size_t)number[i].count * sizeof *values;
        memcpy(values, (const char *)layers + number[i].offset, size);
        if (memcmp(values, number[i].usual, size) != 0) {
            tell(number[i].name, values, number[i].count);
        }
    }
}

void cli_info_layers(const struct scene_layers *layers, cli_layer_teller *tell)
{
    if (!layers->used) {
        return;
    }
    tell_unusual(layers, numbers, sizeof numbers / sizeof *numbers, tell);
    if (layers->glossy) {
        tell_unusual(layers, gloss_numbers, sizeof gloss_numbers / sizeof *gloss_numbers, tell);
    }
}
