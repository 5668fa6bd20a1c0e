// SPDX-License-Identifier: MIT
// A linked program as C.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "emitter/emitter.h"
#include "program.h"

static bool is_identifier(const char *name)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    static const char all[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
    return name && name[0] != '\0' && strchr(letters, name[0]) && name[strspn(name, all)] == '\0';
}

// Return what a module calls a binding, or NULL.
static const char *name_of(const rhw_shader_program *program, const struct rhw_shader_layout *layout)
{
    for (int s = 0; s < STAGES; s++) {
        const rhw_shader *const shader = program->shaders[s];
        for (uint32_t r = 0; shader && r < shader->info.resource_count; r++) {
            const struct rhw_shader_resource *const resource = &shader->info.resources[r];
            if (resource->set == layout->set && resource->binding == layout->binding && resource->name[0]) {
                return resource->name;
            }
        }
    }
    return NULL;
}

// Refuse a program that has more registers than the stack of the interpreter, for C has its arrays there.
static void check_stack(struct shader_memory *memory, const rhw_shader_program *program)
{
    const unsigned bytes = program->compute.invocation_size,
                   groups = program->bytecode[RHW_SHADER_COMPUTE].batch;
    if (bytes > 0) {
        snprintf(memory->message, sizeof memory->message,
                 "an invocation keeps %u bytes from barrier to barrier: C has room for %u of %u invocations",
                 bytes, (unsigned)(SHADER_REGISTER_VECTORS * sizeof(uint32_t)) / groups, 8 * groups);
        shader_memory_end(memory);
    }
}

// Return the text in the memory, through which a program that is refused ends.
static const char *write_program(struct shader_memory *memory, const rhw_shader_program *program,
                                 const struct rhw_shader_c_def *def)
{
    check_stack(memory, program);
    const char **const names = shader_take(memory, program->layout_count, sizeof *names);
    for (uint32_t i = 0; i < program->layout_count; i++) {
        names[i] = name_of(program, &program->layout[i]);
    }
    struct shader_c_program all = {.name = def->name,
                                   .source = def->source,
                                   .program = &program->program,
                                   .compute = program->shaders[RHW_SHADER_COMPUTE] ? &program->compute : NULL,
                                   .layout = program->layout,
                                   .layout_count = program->layout_count,
                                   .layout_names = names};
    for (int s = 0; s < STAGES; s++) {
        const bool is_left_out = s == RHW_SHADER_FRAGMENT && !program->program.fragment[RHW_ISA_BASELINE];
        if (program->shaders[s] && !is_left_out) {
            all.stages[s] = shader_describe_stage(program, (enum rhw_shader_stage)s);
        }
    }
    return shader_c_write(memory, &all);
}

enum rhw_result rhw_shader_program_emit_c(const rhw_shader_program *program,
                                          const struct rhw_shader_c_def *def, char **text, char *message)
{
    struct shader_memory memory;
    *text = NULL;
    shader_say(message, "%s", "");
    if (!def || !is_identifier(def->name)) {
        shader_say(message, "rhw_shader_program_emit_c: the name is an identifier of C");
        return RHW_ERROR_MISUSE;
    }
    shader_memory_init(&memory, RHW_SHADER_MAX_MEMORY);
    if (setjmp(memory.end) == 0) {
        const char *const written = write_program(&memory, program, def);
        const size_t size = strlen(written) + 1;
        *text = malloc(size);
        if (*text) {
            memcpy(*text, written, size);
        }
        memory.is_short = !*text;
    }
    const bool is_short = memory.is_short;
    if (!*text) {
        shader_say(message, "%s",
                   is_short ? "out of memory, or of what a translation may take" : memory.message);
    }
    shader_memory_free(&memory);
    return *text ? RHW_OK : is_short ? RHW_ERROR_OUT_OF_MEMORY : RHW_ERROR_MISUSE;
}

void rhw_shader_free_text(char *text)
{
    free(text);
}
