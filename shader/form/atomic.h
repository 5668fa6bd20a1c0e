// SPDX-License-Identifier: MIT
// Atomics as librhw executes them.
#ifndef SHADER_ATOMIC_H
#define SHADER_ATOMIC_H

#include "form.h"
#include "rhw/shader_storage.h"

static inline enum rhw_storage_operation shader_storage_operation(uint32_t atomic)
{
#define ATOMIC(name, printed, operation) RHW_STORAGE_##operation,
    static const enum rhw_storage_operation operations[] = {
#include "atomic.inc"
    };
#undef ATOMIC
    return operations[atomic];
}

#endif
