// SPDX-License-Identifier: MIT
// Variables, and where they are bound.
#include "module.h"

static int decorated(const struct shader_module *module, uint32_t id, enum spirv_decoration number)
{
    const struct shader_decoration *const found = shader_find_decoration(module, id, -1, number);
    if (found && found->value > INT32_MAX) {
        shader_refuse(module, found->word, "%u is too large", (unsigned)found->value);
    }
    return found ? (int)found->value : -1;
}

static bool is_decorated(const struct shader_module *module, uint32_t id, enum spirv_decoration number)
{
    return shader_find_decoration(module, id, -1, number) != NULL;
}

static bool is_storage_class(uint32_t storage)
{
    return (storage <= SPIRV_WORKGROUP || storage == SPIRV_PRIVATE || storage == SPIRV_FUNCTION ||
            storage == SPIRV_PUSH_CONSTANT || storage == SPIRV_STORAGE_BUFFER);
}

// Return how a variable is decorated to be interpolated: or-ed enum shader_interpolation.
static uint8_t interpolation_of(const struct shader_module *module, uint32_t id)
{
    return (uint8_t)((is_decorated(module, id, SPIRV_FLAT) ? SHADER_FLAT : 0) |
                     (is_decorated(module, id, SPIRV_NO_PERSPECTIVE) ? SHADER_NOPERSPECTIVE : 0) |
                     (is_decorated(module, id, SPIRV_CENTROID) ? SHADER_AT_CENTROID : 0) |
                     (is_decorated(module, id, SPIRV_SAMPLE) ? SHADER_AT_SAMPLE : 0));
}

struct shader_variable *shader_read_variable(struct shader_module *module, uint32_t word)
{
    const uint32_t *const words = module->words + word;
    const struct shader_type *const pointer = shader_type_of_id(module, word, words[1]);
    if (pointer->kind != SHADER_POINTER || (uint32_t)pointer->storage != words[3]) {
        shader_refuse(module, word, "id %u is no pointer to storage class %u", (unsigned)words[1],
                      (unsigned)words[3]);
    }
    if (!is_storage_class(words[3])) {
        shader_refuse(module, word, "storage class %u is not supported", (unsigned)words[3]);
    }
    const uint32_t id = words[2];
    struct shader_variable *const variable = shader_take(module->memory, 1, sizeof *variable);
    *variable = (struct shader_variable){
        .type = pointer->element,
        .storage = pointer->storage,
        .id = id,
        .set = decorated(module, id, SPIRV_DESCRIPTOR_SET),
        .binding = decorated(module, id, SPIRV_BINDING),
        .location = decorated(module, id, SPIRV_LOCATION),
        .component = decorated(module, id, SPIRV_COMPONENT),
        .index = decorated(module, id, SPIRV_INDEX),
        .built_in = decorated(module, id, SPIRV_BUILT_IN),
        .input_attachment = decorated(module, id, SPIRV_INPUT_ATTACHMENT_INDEX),
        .interpolation = interpolation_of(module, id),
        .is_not_readable = is_decorated(module, id, SPIRV_NON_READABLE),
        .is_not_writable = is_decorated(module, id, SPIRV_NON_WRITABLE),
    };
    if ((words[0] >> 16) > 4) {
        variable->initial = shader_constant_of_id(module, word, words[4]);
        if (variable->initial->type != variable->type) {
            shader_refuse(module, word, "the initial value is of another type");
        }
    }
    const bool holds_values = variable->storage == SPIRV_FUNCTION || variable->storage == SPIRV_PRIVATE ||
                              variable->storage == SPIRV_INPUT || variable->storage == SPIRV_OUTPUT;
    if (holds_values && variable->type->scalars == 0 && !variable->type->is_empty) {
        shader_refuse(module, word, "the variable holds no value of at most %d scalars", SHADER_MAX_SCALARS);
    }
    module->ids[id].data.as_variable = variable;
    return variable;
}
