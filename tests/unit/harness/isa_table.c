// SPDX-License-Identifier: MIT
// Which copies of isa_templates.c and isa_kit*.c this build and this CPU have.
#include "isa_kit.h"
#include "isa_templates.h"

#include <rhw/rhw.h>

static const struct isa_templates *const templates[RHW_ISA_COUNT] = RHW_ISA_TABLE(&isa_templates);

const struct isa_templates *isa_templates_for(enum rhw_isa isa)
{
    return rhw_isa_supported(isa) ? templates[isa] : NULL;
}

static const struct kit_table *const kits[RHW_ISA_COUNT] = RHW_ISA_TABLE(&kit_table);
static const struct kit_table *const dual_kits[RHW_ISA_COUNT] = RHW_ISA_TABLE(&kit_dual_table);
static const struct kit_table *const bits_kits[RHW_ISA_COUNT] = RHW_ISA_TABLE(&kit_bits_table);

const struct kit_table *kit_table_for(enum rhw_isa isa)
{
    return rhw_isa_supported(isa) ? kits[isa] : NULL;
}

const struct kit_table *kit_dual_table_for(enum rhw_isa isa)
{
    return rhw_isa_supported(isa) ? dual_kits[isa] : NULL;
}

const struct kit_table *kit_bits_table_for(enum rhw_isa isa)
{
    return rhw_isa_supported(isa) ? bits_kits[isa] : NULL;
}
