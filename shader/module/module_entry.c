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
    case SPIRV_DEPTH_UNCHANGED: return;
    case SPIRV_LOCAL_SIZE:
        for (uint32_t i = 0; i < 3; i++) {
            entry->local_size[i] = i < literals ? words[3 + i] : 0;
            if (entry->local_size[i] == 0 || entry->local_size[i] > 1024) {
                shader_refuse(module, word, "a workgroup has 1 to 1024 invocations each way");
            }
        }
        return;
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
