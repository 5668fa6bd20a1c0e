// SPDX-License-Identifier: MIT
// Shader functions that take long find out here whether anybody still waits for them.
#include "binding.h"
#include "context/given_up.h"

bool rhw_work_is_given_up(const struct rhw_bindings *bindings)
{
    return bindings->asked && rhw_context_is_given_up_within(bindings->asked);
}
