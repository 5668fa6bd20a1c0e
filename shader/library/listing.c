// SPDX-License-Identifier: MIT
// A translation as a text.
#include "form/pass.h"
#include "form/print.h"
#include "interpreter/assemble.h"
#include "interpreter/print_bytecode.h"
#include "shader.h"

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
    enum rhw_result result = RHW_OK;
    if (setjmp(memory.end) == 0) {
        print(&memory, &sink, words, size, def, stop);
    } else {
        shader_say(message, "%s",
                   memory.is_short ? "out of memory, or of what a translation may take" : memory.message);
        result = memory.is_short ? RHW_ERROR_OUT_OF_MEMORY : RHW_ERROR_MISUSE;
    }
    shader_memory_free(&memory);
    return result;
}
