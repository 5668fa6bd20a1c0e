// SPDX-License-Identifier: MIT
// Tests of translated shaders draw with the interpreter or, where the environment has RHW_TEST_BACK_END=c, with C that
// was written of the same modules when the tests were built. For that the build gives these functions, by macros, to
// those who call rhw_shader_create, rhw_shader_program_create, _get and _get_compute. What was not written draws with the interpreter: modules
// that no text of the folder glsl gives, shaders with constants or a layout of the test's own, and what is asked to be
// interpreted.
#ifndef TEST_EMITTED_H
#define TEST_EMITTED_H

#include <rhw/spirv.h>

enum rhw_result emitted_shader_create(const void *words, size_t size, const struct rhw_shader_def *def,
                                      rhw_shader **shader, char *message);
enum rhw_result emitted_program_create(const struct rhw_shader_program_def *def, rhw_shader_program **program,
                                       char *message);
const struct rhw_program *emitted_program_get(const rhw_shader_program *program);
const struct rhw_compute_program *emitted_program_get_compute(const rhw_shader_program *program);

/// Return how many programs were drawn or dispatched as C so far.
int emitted_count(void);

#endif
