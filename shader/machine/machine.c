// SPDX-License-Identifier: MIT
// See machine.h.
#include "machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "code_memory.h"
#include "generator.h"
#include "print_code.h"
#include "rhw/isa.h"

enum { FEWEST_REGISTERS = 6 };

RHW_ISA_DECLARE(shader_call_finder, shader_find_call);

#if defined(__x86_64__)

shader_call_function *shader_machine_function(unsigned which)
{
    return shader_find_call_avx2(which);
}

#else

shader_call_function *shader_machine_function(unsigned which)
{
    (void)which;
    return NULL;
}

#endif

// Return how many registers code may use: RHW_JIT may ask for fewer, to test what happens when they do not suffice.
static int registers_to_use(void)
{
    const char *const text = getenv("RHW_JIT");
    int asked = 0;
    for (const char *c = text ? text : ""; *c >= '0' && *c <= '9' && asked < REGISTERS; c++) {
        asked = 10 * asked + *c - '0';
    }
    return asked >= FEWEST_REGISTERS && asked < REGISTERS ? asked : REGISTERS;
}

bool shader_machine_make(const struct shader_linked_stage *stage, enum rhw_shader_stage kind,
                         struct shader_machine_block *block)
{
    static const char *const names[RHW_SHADER_STAGE_COUNT] = {"vertex", "fragment", "compute"};
    *block = (struct shader_machine_block){.code = NULL};
    if (!shader_code_is_wanted()) {
        return false;
    }
    struct shader_memory memory;
    shader_memory_init(&memory, RHW_SHADER_MAX_MEMORY);
    if (setjmp(memory.end) == 0) {
        struct shader_generated made;
        if (shader_generate(&memory, stage, kind, registers_to_use(), false, &made)) {
            block->code = shader_code_map(made.code.bytes, made.code.size);
            block->size = block->code ? made.code.size : 0;
            block->entry = made.entry;
        }
    }
    shader_memory_free(&memory);
    if (block->code) {
        char name[128];
        snprintf(name, sizeof name, "rhw %s %.100s", names[kind], stage->form->entry->name);
        (void)shader_code_name(block->code, block->size, name);
    }
    return block->code != NULL;
}

void shader_machine_free(struct shader_machine_block *block)
{
    if (block->code) {
        shader_code_unmap(block->code, block->size);
    }
}

bool shader_machine_print(const struct shader_sink *sink, struct shader_memory *memory,
                          const struct shader_linked_stage *stage, enum rhw_shader_stage kind)
{
    struct shader_generated made;
    if (!shader_generate(memory, stage, kind, registers_to_use(), true, &made)) {
        return false;
    }
    shader_print_code(sink, stage->form, &made.code);
    return true;
}
