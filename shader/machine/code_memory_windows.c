// SPDX-License-Identifier: MIT
// There is no code on Windows, whose calling convention is another one.
#include "code_memory.h"

void *shader_code_map(const void *bytes, size_t size)
{
    (void)bytes;
    (void)size;
    return NULL;
}

void shader_code_unmap(void *code, size_t size)
{
    (void)code;
    (void)size;
}

bool shader_code_name(const void *code, size_t size, const char *name)
{
    (void)code;
    (void)size;
    (void)name;
    return false;
}
