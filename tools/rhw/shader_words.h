// SPDX-License-Identifier: MIT
// What rhw shader asks of a module before it is translated.
#ifndef CLI_SHADER_WORDS_H
#define CLI_SHADER_WORDS_H

#include <rhw/spirv.h>

struct cli_shader_words {
    uint32_t *words;
    size_t count;
    bool is_swapped;
};

struct cli_shader_words cli_shader_words_of(uint32_t *words, size_t size);

/// Find the entry point of a name, or, where that is NULL, "main" or the first. Return its name by malloc, and set its
/// stage. Return NULL if there is none that rhw has a stage for.
char *cli_shader_find_entry(const struct cli_shader_words *words, const char *name,
                            enum rhw_shader_stage *stage);

enum cli_shader_constant_kind {
    CLI_CONSTANT_ABSENT,
    CLI_CONSTANT_FLOAT,
    CLI_CONSTANT_INT,
    CLI_CONSTANT_BOOL
};

/// Return what the constant of a SpecId is.
enum cli_shader_constant_kind cli_shader_find_constant(const struct cli_shader_words *words, uint32_t id);

/// Make a number what the constants of a SpecId have where nobody chooses: its bits, or of a truth 0 or another number.
void cli_shader_set_constant(const struct cli_shader_words *words, uint32_t id, uint32_t value);

#endif
