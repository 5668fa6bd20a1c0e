// SPDX-License-Identifier: MIT
// Which copies of isa_templates.c and isa_kit*.c this build and this CPU have.
#include "isa_kit.h"
#include "isa_support.h"
#include "isa_templates.h"

#include <rhw/rhw.h>

static const struct isa_templates *const templates[RHW_ISA_COUNT] = RHW_ISA_TABLE(&isa_templates);

const struct isa_templates *isa_templates_for(enum rhw_isa isa)
{
    return isa_is_there(isa) ? templates[isa] : NULL;
}

static const struct kit_table *const kits[KIT_PARTS][RHW_ISA_COUNT] = {
    [KIT_LANES] = RHW_ISA_TABLE(&kit_lanes_table),
    [KIT_MATH] = RHW_ISA_TABLE(&kit_math_table),
    [KIT_BITS] = RHW_ISA_TABLE(&kit_bits_table),
    [KIT_DUAL] = RHW_ISA_TABLE(&kit_dual_table),
};

const struct kit_table *kit_table_for(enum kit_part part, enum rhw_isa isa)
{
    return isa_is_there(isa) ? kits[part][isa] : NULL;
}
