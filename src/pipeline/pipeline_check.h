// SPDX-License-Identifier: MIT
// The rules that the definition of a pipeline has to keep.
#ifndef RHW_PIPELINE_CHECK_H
#define RHW_PIPELINE_CHECK_H

#include <stdbool.h>
#include <stdint.h>

#include "rhw/types.h"

struct rhw_context;

// Return true if rhw_pipeline_create can make a pipeline of its arguments. Report misuse and return false if not.
bool rhw_pipeline_check(const struct rhw_context *context, const struct rhw_pipeline_def *def, uint32_t flaws,
                        const rhw_pipeline *pipeline);

// Return true if no compiler flags of the program would make its shaders draw other bytes. Report misuse and return
// false if some would. `where` is the public function that was called.
bool rhw_check_flaws(const struct rhw_context *context, uint32_t flaws, const char *where);

// Log a warning about each state of a valid definition that is set and switched off. Validation asks for the warnings.
// They are no misuse, because programs that switch a state on and off leave it set.
void rhw_pipeline_warn(const struct rhw_context *context, const struct rhw_pipeline_def *def);
// Log, for information, that the program has functions on 8 lanes and lacks their copy for `isa`.
void rhw_pipeline_tell_copies(const struct rhw_context *context, enum rhw_isa isa,
                              const struct rhw_program *program);

#endif
