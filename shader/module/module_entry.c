// SPDX-License-Identifier: MIT
// Entry points and their modes of execution.
#include "module.h"

void shader_read_entry_point(struct shader_module *module, uint32_t word)
{
    const uint32_t *const words = module->words + word;
    const uint32_t count = words[0] >> 16;
    const char *const name = (const char *)(words + 3);
    uint32_t behind = 3; // the name
    while ((words[behind] & 0xff) && (words[behind] & 0xff00) && (words[behind] & 0xff0000) &&
           (words[behind] >> 24)) {
        behind++;
    }
    behind++;
    if (words[1] != SPIRV_VERTEX && words[1] != SPIRV_FRAGMENT && words[1] != SPIRV_COMPUTE) {
        shader_refuse(module, word, "execution model %u is not supported: vertex, fragment and compute are",
                      (unsigned)words[1]);
    }
    module->entry_points[module->entry_point_count++] =
        (struct shader_entry_point){.model = (enum spirv_execution_model)words[1],
                                    .function = words[2],
                                    .word = word,
                                    .name = name,
                                    .interface = words + behind,
                                    .interface_count = count - behind,
                                    .local_size = {1, 1, 1}};
}

static void set_mode(struct shader_module *module, uint32_t word, struct shader_entry_point *entry)
{
    const uint32_t *const words = module->words + word;
    const uint32_t literals = (words[0] >> 16) - 3;
    switch (words[2]) {
    case SPIRV_EARLY_FRAGMENT_TESTS: entry->has_early_tests = true; return;
    case SPIRV_DEPTH_REPLACING: entry->replaces_depth = true; return;
    case SPIRV_DEPTH_GREATER: entry->depth_change = 1; return;
    case SPIRV_DEPTH_LESS: entry->depth_change = -1; return;
    case SPIRV_ORIGIN_UPPER_LEFT:
    case SPIRV_XFB:
    case SPIRV_DEPTH_UNCHANGED: return;
    case SPIRV_LOCAL_SIZE:
        for (uint32_t i = 0; i < 3; i++) {
            entry->local_size[i] = i < literals ? words[3 + i] : 0;
        }
        return;
    case SPIRV_LOCAL_SIZE_ID: entry->size_word = word; return;
    default: shader_refuse(module, word, "execution mode %u is not supported", (unsigned)words[2]);
    }
}

void shader_read_execution_mode(struct shader_module *module, uint32_t word)
{
    for (uint32_t i = 0; i < module->entry_point_count; i++) {
        if (module->entry_points[i].function == module->words[word + 1]) {
            set_mode(module, word, &module->entry_points[i]);
        }
    }
}

// Take the size from the constants that OpExecutionModeId names.
static void take_size_of_ids(const struct shader_module *module, struct shader_entry_point *entry)
{
    const uint32_t word = entry->size_word, *const words = module->words + word;
    for (uint32_t i = 0; i < 3; i++) {
        const bool has_id = 3 + i < words[0] >> 16;
        if (!has_id || words[3 + i] >= module->bound) {
            shader_refuse(module, word, "a size is three constants");
        }
        const struct shader_constant *const constant = shader_constant_of_id(module, word, words[3 + i]);
        if (constant->type->kind != SHADER_INT) {
            shader_refuse(module, word, "id %u is no integer", (unsigned)words[3 + i]);
        }
        entry->local_size[i] = constant->scalars[0];
    }
}

// Take the size from the constant that is decorated as WorkgroupSize, which counts before all else.
static void take_size_of_constant(const struct shader_module *module, struct shader_entry_point *entry)
{
    const uint32_t id = module->workgroup_size, word = module->ids[id].word;
    const struct shader_constant *const constant = shader_constant_of_id(module, word, id);
    if (constant->type->kind != SHADER_VECTOR || constant->type->count != 3 ||
        constant->type->element->kind != SHADER_INT) {
        shader_refuse(module, word, "WorkgroupSize is a constant of three integers");
    }
    for (int i = 0; i < 3; i++) {
        entry->local_size[i] = constant->scalars[i];
    }
}

void shader_settle_sizes(const struct shader_module *module)
{
    for (uint32_t e = 0; e < module->entry_point_count; e++) {
        struct shader_entry_point *const entry = &module->entry_points[e];
        uint64_t product = 1;
        if (entry->model != SPIRV_COMPUTE) {
            continue;
        }
        if (module->workgroup_size != 0) {
            take_size_of_constant(module, entry);
        } else if (entry->size_word != 0) {
            take_size_of_ids(module, entry);
        }
        for (int i = 0; i < 3; i++) {
            const uint32_t size = entry->local_size[i];
            product = size == 0 || size > SHADER_MAX_INVOCATIONS ? 0 : product * size;
        }
        if (product == 0 || product > SHADER_MAX_INVOCATIONS) {
            shader_refuse(module, entry->word, "a workgroup of %u x %u x %u is not of 1 to %d invocations",
                          (unsigned)entry->local_size[0], (unsigned)entry->local_size[1],
                          (unsigned)entry->local_size[2], SHADER_MAX_INVOCATIONS);
        }
    }
}
