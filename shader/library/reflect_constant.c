// SPDX-License-Identifier: MIT
// Which constants a module lets its user choose.
#include <stdlib.h>

#include "shader.h"

static bool is_chosen(const struct shader_module *module, uint32_t id)
{
    const uint32_t opcode = module->ids[id].opcode;
    // An instruction of that kind in a function defines none.
    return module->ids[id].word != 0 && module->ids[id].data.as_constant &&
           (opcode == SPIRV_OP_SpecConstantTrue || opcode == SPIRV_OP_SpecConstantFalse ||
            opcode == SPIRV_OP_SpecConstant) &&
           shader_find_decoration(module, id, -1, SPIRV_SPEC_ID) != NULL;
}

static struct rhw_shader_constant_info tell(const struct shader_module *module, uint32_t id)
{
    const struct shader_type *const type = module->ids[id].data.as_constant->type;
    const uint32_t *const words = module->words + module->ids[id].word;
    struct rhw_shader_constant_info told = {.id =
                                                shader_find_decoration(module, id, -1, SPIRV_SPEC_ID)->value,
                                            .kind = RHW_SHADER_UINT,
                                            .bits = 32,
                                            .name = module->names[id] ? module->names[id] : ""};
    if (module->ids[id].opcode != SPIRV_OP_SpecConstant) {
        told.is_bool = true;
        told.value = module->ids[id].opcode == SPIRV_OP_SpecConstantTrue ? 1 : 0;
        return told;
    }
    told.kind = type->kind == SHADER_FLOAT ? RHW_SHADER_FLOAT
                : type->is_signed          ? RHW_SHADER_INT
                                           : RHW_SHADER_UINT;
    told.bits = (uint32_t)type->bits;
    told.value = words[3];
    return told;
}

static int compare(const void *a, const void *b)
{
    const struct rhw_shader_constant_info *const x = a, *const y = b;
    return x->id < y->id ? -1 : x->id > y->id;
}

void shader_reflect_constants(rhw_shader *shader)
{
    const struct shader_module *const module = shader->form->module;
    uint32_t count = 0;
    for (uint32_t id = 0; id < module->bound; id++) {
        count += is_chosen(module, id) ? 1 : 0;
    }
    struct rhw_shader_constant_info *const constants = shader_take(&shader->memory, count, sizeof *constants);
    shader->info.constant_count = count;
    shader->info.constants = constants;
    count = 0;
    for (uint32_t id = 0; id < module->bound; id++) {
        if (is_chosen(module, id)) {
            constants[count++] = tell(module, id);
        }
    }
    if (count > 0) {
        qsort(constants, count, sizeof *constants, compare);
    }
}
