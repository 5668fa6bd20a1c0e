// SPDX-License-Identifier: MIT
// From the words of a module to a translated shader.
#include "shader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "form/pass.h"
#include "interpreter/assemble.h"

enum { MAGIC = 0x07230203, MAGIC_SWAPPED = 0x03022307, HEADER_WORDS = 5 };

static const enum spirv_execution_model models[RHW_SHADER_STAGE_COUNT] = {SPIRV_VERTEX, SPIRV_FRAGMENT,
                                                                          SPIRV_COMPUTE};
static const char *const stage_names[RHW_SHADER_STAGE_COUNT] = {"vertex", "fragment", "compute"};

static void destroy(struct shader_kept *kept)
{
    rhw_shader *const shader = (rhw_shader *)kept;
    shader_memory_free(&shader->memory);
    free(shader);
}

size_t shader_size(const rhw_shader *shader)
{
    return sizeof *shader + shader->memory.bound - shader->memory.left;
}

// Return a copy of the words in the order of bytes of this machine.
static const uint32_t *copy_words(struct shader_memory *memory, const void *words, size_t count)
{
    uint32_t *const copy = shader_take(memory, count, sizeof *copy);
    memcpy(copy, words, count * sizeof *copy);
    if (copy[0] == MAGIC_SWAPPED) {
        for (size_t i = 0; i < count; i++) {
            const uint32_t w = copy[i];
            copy[i] = w >> 24 | (w >> 8 & 0xff00) | (w << 8 & 0xff0000) | w << 24;
        }
    }
    return copy;
}

static const struct shader_entry_point *find_entry(struct shader_module *module,
                                                   const struct rhw_shader_def *def)
{
    const char *const name = def->entry_point ? def->entry_point : "main";
    for (uint32_t i = 0; i < module->entry_point_count; i++) {
        const struct shader_entry_point *const entry = &module->entry_points[i];
        if (entry->model == models[def->stage] && strcmp(entry->name, name) == 0) {
            return entry;
        }
    }
    snprintf(module->memory->message, sizeof module->memory->message,
             "the module has no %s entry point \"%.100s\"", stage_names[def->stage], name);
    shader_memory_end(module->memory);
}

struct shader_program *shader_build_form(struct shader_memory *memory, const void *words, size_t size,
                                         const struct rhw_shader_def *def)
{
    const size_t count = size / sizeof(uint32_t);
    struct shader_specialization *const constants =
        shader_take(memory, def->constant_count, sizeof *constants);
    for (uint32_t i = 0; i < def->constant_count; i++) {
        constants[i] = (struct shader_specialization){def->constants[i].id, def->constants[i].value};
    }
    struct shader_module *const module =
        shader_module_read(memory, copy_words(memory, words, count), count, constants, def->constant_count);
    return shader_build(module, find_entry(module, def), def->view_index);
}

// Return false, with what is wrong in the shader's memory, where the module is refused.
static bool translate(rhw_shader *shader, const void *words, size_t size, const struct rhw_shader_def *def)
{
    if (setjmp(shader->memory.end) != 0) {
        return false;
    }
    struct shader_program *const form = shader_build_form(&shader->memory, words, size, def);
    shader_run_passes(form);
    shader->form = form;
    shader->info.stage = def->stage;
    shader_find_interface(form, &shader->interface);
    shader->bytecode = shader_assemble(form);
    shader_reflect(shader);
    return true;
}

const char *shader_find_misuse(const void *words, size_t size, const struct rhw_shader_def *def)
{
    if (!def || !words) {
        return "`words` and the definition of a shader are not NULL";
    }
    if ((unsigned)def->stage >= RHW_SHADER_STAGE_COUNT) {
        return "`stage` of a shader is one of enum rhw_shader_stage";
    }
    if (def->constant_count != 0 && !def->constants) {
        return "`constants` of a shader is not NULL where there are some";
    }
    if (size % sizeof(uint32_t) != 0 || size < HEADER_WORDS * sizeof(uint32_t)) {
        return "a SPIR-V module is a number of whole words, 5 at least";
    }
    return size / sizeof(uint32_t) > RHW_SHADER_MAX_WORDS
               ? "the module has more words than RHW_SHADER_MAX_WORDS"
               : NULL;
}

// Return a shader that is new, or NULL with a message.
static rhw_shader *make(const void *words, size_t size, const struct rhw_shader_def *def, char *message,
                        enum rhw_result *result)
{
    rhw_shader *const made = calloc(1, sizeof *made);
    if (!made) {
        shader_say(message, "out of memory");
        *result = RHW_ERROR_OUT_OF_MEMORY;
        return NULL;
    }
    shader_memory_init(&made->memory, RHW_SHADER_MAX_MEMORY);
    shader_kept_init(&made->kept, destroy);
    if (translate(made, words, size, def)) {
        *result = RHW_OK;
        return made;
    }
    const bool is_short = made->memory.is_short;
    shader_say(message, "%s", is_short ? "out of memory" : made->memory.message);
    shader_release(&made->kept);
    *result = is_short ? RHW_ERROR_OUT_OF_MEMORY : RHW_ERROR_MISUSE;
    return NULL;
}

enum rhw_result rhw_shader_create(const void *words, size_t size, const struct rhw_shader_def *def,
                                  rhw_shader **shader, char *message)
{
    *shader = NULL;
    shader_say(message, "%s", "");
    const char *const misuse = shader_find_misuse(words, size, def);
    if (misuse) {
        shader_say(message, "%s", misuse);
        return RHW_ERROR_MISUSE;
    }
    const char *const entry = def->entry_point ? def->entry_point : "main";
    // With the parts of the key: all that the definition has but its cache.
    const size_t begin[] = {(size_t)def->stage, strlen(entry), def->constant_count, def->view_index};
    const struct shader_key key = {{{begin, sizeof begin},
                                    {entry, strlen(entry)},
                                    {def->constants, def->constant_count * sizeof *def->constants},
                                    {words, size}}};
    struct shader_kept *const found = shader_cache_find(def->cache, &key);
    if (found) {
        *shader = (rhw_shader *)found;
        return RHW_OK;
    }
    enum rhw_result result;
    rhw_shader *const made = make(words, size, def, message, &result);
    if (made) {
        *shader = (rhw_shader *)shader_cache_add(def->cache, &key, &made->kept, shader_size(made));
    }
    return result;
}

void rhw_shader_destroy(rhw_shader *shader)
{
    if (shader) {
        shader_release(&shader->kept);
    }
}

const struct rhw_shader_info *rhw_shader_get_info(const rhw_shader *shader)
{
    return &shader->info;
}
