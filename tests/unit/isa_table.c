// SPDX-License-Identifier: MIT
// Which copies of isa_templates.c this build and this CPU have.
#include "isa_templates.h"

#include <rhw/rhw.h>

static const struct isa_templates *const templates[RHW_ISA_COUNT] = RHW_ISA_TABLE(&isa_templates);

const struct isa_templates *isa_templates_for(enum rhw_isa isa)
{
    return rhw_isa_supported(isa) ? templates[isa] : NULL;
}
