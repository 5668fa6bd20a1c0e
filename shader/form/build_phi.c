// SPDX-License-Identifier: MIT
// A phi is a home for each of its scalars, which is set wherever control flow goes to its block.
#include "build_flow.h"

// Return the homes of a phi, which are made where control flow first comes to it.
static uint32_t *phi_homes(struct shader_builder *builder, uint32_t id, const struct shader_type *type)
{
    struct shader_built *const built = &builder->built[id];
    if (!built->phi) {
        built->phi = shader_new_scalars(builder, type);
        for (uint32_t i = 0; i < type->scalars; i++) {
            built->phi[i] = shader_new_home(builder, 0);
        }
    }
    return built->phi;
}

// All phis are read before any is written, since one may be the operand of another.
void shader_set_phis(struct shader_builder *builder, uint32_t label)
{
    const uint32_t *const words = builder->module->words;
    const uint32_t from = builder->block, at = builder->word;
    if (label >= builder->module->bound || builder->label_words[label] == 0) {
        shader_build_refuse(builder, "id %u is no label", (unsigned)label);
    }
    uint32_t first = builder->label_words[label] + 2, word = first;
    size_t count = 0, room = 0;
    uint32_t *values = NULL;
    for (int writes = 0; writes < 2; writes++) {
        size_t next = 0;
        for (word = first; word < builder->module->word_count; word += words[word] >> 16) {
            const uint32_t opcode = words[word] & 0xffff;
            if (opcode == SPIRV_OP_Line || opcode == SPIRV_OP_NoLine) {
                continue;
            }
            if (opcode != SPIRV_OP_Phi) {
                break;
            }
            builder->word = word;
            const struct shader_type *const type = shader_result_type(builder);
            const uint32_t *const homes = phi_homes(builder, words[word + 2], type);
            uint32_t operand = 3;
            while (operand + 1 < shader_word_count(builder) && words[word + operand + 1] != from) {
                operand += 2;
            }
            shader_spend(builder, operand);
            if (operand + 1 >= shader_word_count(builder)) {
                shader_build_refuse(builder, "it has no value for control flow from block %u",
                                    (unsigned)from);
            }
            if (writes) {
                for (uint32_t i = 0; i < type->scalars; i++) {
                    shader_set_home(builder, homes[i], values[next++]);
                }
                continue;
            }
            if (shader_type_of_value(builder, words[word + operand]) != type) {
                shader_build_refuse(builder, "id %u is of another type", (unsigned)words[word + operand]);
            }
            const uint32_t *const scalars = shader_scalars(builder, words[word + operand]);
            for (uint32_t i = 0; i < type->scalars; i++) {
                if (count == room) {
                    values = shader_grow(builder->memory, values, &room, sizeof *values);
                }
                values[count++] = scalars[i];
            }
        }
    }
    builder->word = at;
}

void shader_build_phi(struct shader_builder *builder)
{
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t *const homes = phi_homes(builder, shader_operand(builder, 2), type);
    uint32_t *const scalars = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        scalars[i] = shader_get_home(builder, homes[i]);
    }
    shader_define(builder, scalars);
}
