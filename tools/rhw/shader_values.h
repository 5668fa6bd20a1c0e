// SPDX-License-Identifier: MIT
// What a buffer holds, as the command line says it and as it is printed.
#ifndef CLI_SHADER_VALUES_H
#define CLI_SHADER_VALUES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Read "FILE", "BYTES" of zeros, or "f32:", "i32:" or "u32:" and numbers with commas, to memory of malloc. Report what
/// is wrong with the `argument` of `option`, which has `value` at its end.
bool cli_shader_values_read(const char *option, const char *argument, const char *value, void **bytes,
                            size_t *size);

/// Return whether `type` is f32, i32 or u32.
bool cli_shader_values_are(const char *type);

/// Print the fewest digits that are read as a float of these bits again.
void cli_shader_values_print_float(uint32_t bits);

/// Print bytes as numbers of 32 bits with commas on one line. Return false if `type` is not f32, i32 or u32.
bool cli_shader_values_print(const char *type, const void *bytes, size_t size);

#endif
