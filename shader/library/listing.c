// SPDX-License-Identifier: MIT
// A translation as a text.
#include "form/pass.h"
#include "form/print.h"
#include "interpreter/assemble.h"
#include "interpreter/print_bytecode.h"
#include "program.h"

static void print(struct shader_memory *memory, const struct shader_sink *sink, const void *words,
                  size_t size, const struct rhw_shader_def *def, enum rhw_shader_stop stop)
{
    struct shader_program *const form = shader_build_form(memory, words, size, def);
    if (stop != RHW_SHADER_BUILT) {
        shader_run_passes(form);
    }
    if (stop == RHW_SHADER_ASSEMBLED) {
        shader_print_bytecode(sink, form, shader_assemble(form));
    } else {
        shader_print(sink, form);
    }
}

// Tell why printing ended, and give the memory back.
static enum rhw_result end(struct shader_memory *memory, bool is_printed, char *message)
{
    const bool is_short = memory->is_short;
    if (!is_printed) {
        shader_say(message, "%s",
                   is_short ? "out of memory, or of what a translation may take" : memory->message);
    }
    shader_memory_free(memory);
    return is_printed ? RHW_OK : is_short ? RHW_ERROR_OUT_OF_MEMORY : RHW_ERROR_MISUSE;
}

enum rhw_result rhw_shader_print(const void *words, size_t size, const struct rhw_shader_def *def,
                                 enum rhw_shader_stop stop,
                                 void (*write)(void *user, const char *text, size_t size), void *user,
                                 char *message)
{
    shader_say(message, "%s", "");
    const char *const misuse = shader_find_misuse(words, size, def);
    if (misuse) {
        shader_say(message, "%s", misuse);
        return RHW_ERROR_MISUSE;
    }
    struct shader_memory memory;
    shader_memory_init(&memory, RHW_SHADER_MAX_MEMORY);
    const struct shader_sink sink = {write, user};
    if (setjmp(memory.end) != 0) {
        return end(&memory, false, message);
    }
    print(&memory, &sink, words, size, def, stop);
    return end(&memory, true, message);
}

static void print_code(struct shader_memory *memory, const struct shader_sink *sink,
                       const rhw_shader_program *program, enum rhw_shader_stage kind)
{
    const struct shader_linked_stage stage = shader_describe_stage(program, kind);
    if (kind == RHW_SHADER_FRAGMENT && !program->program.fragment[RHW_ISA_BASELINE]) {
        shader_sink_print(sink, "; this stage does nothing and is not called\n");
        return;
    }
    if (!program->machine[kind].code) {
        shader_sink_print(sink, "; the interpreter executes this stage here\n");
    }
    if (!shader_machine_print(sink, memory, &stage, kind)) {
        shader_sink_print(sink, "; it takes more of the stack than machine code may\n");
    }
}

enum rhw_result rhw_shader_program_print_code(const rhw_shader_program *program, enum rhw_shader_stage stage,
                                              void (*write)(void *user, const char *text, size_t size),
                                              void *user, char *message)
{
    shader_say(message, "%s", "");
    if ((unsigned)stage >= RHW_SHADER_STAGE_COUNT || !program->shaders[stage]) {
        shader_say(message, "rhw_shader_program_print_code: the program does not have this stage");
        return RHW_ERROR_MISUSE;
    }
    struct shader_memory memory;
    shader_memory_init(&memory, RHW_SHADER_MAX_MEMORY);
    const struct shader_sink sink = {write, user};
    if (setjmp(memory.end) != 0) {
        return end(&memory, false, message);
    }
    print_code(&memory, &sink, program, stage);
    return end(&memory, true, message);
}
