// SPDX-License-Identifier: MIT
// Memory of generated code. It is never writable and executable at once: it is filled before anyone may execute it, and
// nobody may write it after that. Each block is mapped by itself, so that threads share nothing; a system that refuses
// such memory costs speed alone, for the interpreter does the same.
#ifndef SHADER_CODE_MEMORY_H
#define SHADER_CODE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

// Return whether machine code can be executed here, and RHW_JIT is not 0 in the environment.
bool shader_code_is_wanted(void);

// Copy code into memory of whole pages that is executed and not written. Return NULL where the system has none or
// refuses it.
void *shader_code_map(const void *bytes, size_t size);
void shader_code_unmap(void *code, size_t size);

// Where RHW_PERF_MAP is 1 in the environment, append the name of a function to /tmp/perf-PID.map, in which perf looks
// for names. Return whether it was appended.
bool shader_code_name(const void *code, size_t size, const char *name);

#if defined(RHW_GUARDS)
// Return the end of the stack that generated code takes on this thread, behind which nobody may touch memory.
void *shader_guarded_stack(void);
#endif

#endif
