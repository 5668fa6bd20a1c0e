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

#define NUMBER(name, count, ...) {#name, offsetof(struct scene_layers, name), count, {__VA_ARGS__}}

static const struct layer_number numbers[] = {
    NUMBER(clearcoat, 1, 0),
    NUMBER(clearcoat_roughness, 1, 0),
    NUMBER(sheen_color, 3, 0, 0, 0),
    NUMBER(sheen_roughness, 1, 0),
    NUMBER(specular, 1, 1),
    NUMBER(specular_color, 3, 1, 1, 1),
    NUMBER(ior, 1, 1.5f),
    NUMBER(transmission, 1, 0),
    NUMBER(thickness, 1, 0),
    NUMBER(attenuation_distance, 1, __builtin_inff()),
    NUMBER(attenuation_color, 3, 1, 1, 1),
    NUMBER(dispersion, 1, 0),
    NUMBER(anisotropy, 1, 0),
    NUMBER(iridescence, 1, 0),
};

// In the place of metallic and roughness.
static const struct layer_number gloss_numbers[] = {
    NUMBER(gloss_specular, 3, -1, -1, -1),
    NUMBER(glossiness, 1, -1),
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
