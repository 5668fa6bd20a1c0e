// SPDX-License-Identifier: MIT
// See group_samples.h.
#include "group_samples.h"

enum { NO_COMPONENT = 0xff };

// Return the number of the first of two varyings that values are: inputs, or derivatives of inputs. Return
// NO_COMPONENT for others.
static uint32_t varyings_of(const struct shader_linked_stage *stage, const uint32_t *values,
                            enum shader_op op)
{
    const struct shader_node *const first = &stage->form->nodes[values[0]], *const next =
                                                                                &stage->form->nodes[values[1]];
    if (first->op != op || next->op != op || next->immediate != first->immediate + 1) {
        return NO_COMPONENT;
    }
    const uint32_t at = stage->component_of[first->immediate];
    return stage->component_of[next->immediate] == at + 1 ? at : NO_COMPONENT;
}

// Return true for a SAMPLE that does not have to wait for its group.
static bool find_sample(const struct shader_linked_stage *stage, const struct shader_plan *plan,
                        uint32_t place, struct shader_group_sample *sample, const uint32_t **operands)
{
    const uint32_t value = plan->form->code[place];
    struct shader_node *const node = &plan->form->nodes[value];
    const uint32_t plain = SHADER_DO_SAMPLE | 2 << SHADER_IMAGE_SPATIAL_SHIFT | SHADER_IMAGE_HAS_GRADIENT;
    const bool has_sampler = node->immediate & SHADER_IMAGE_HAS_SAMPLER;
    if (node->op != SHADER_SAMPLE || plan->block[place] != 0 ||
        (node->immediate & ~(uint32_t)SHADER_IMAGE_HAS_SAMPLER) != plain) {
        return false;
    }
    uint32_t count;
    const uint32_t *const given = *operands = shader_operands(plan->form, node, &count);
    const uint32_t at = varyings_of(stage, &given[SHADER_IMAGE_COORDINATES], SHADER_INPUT);
    *sample = (struct shader_group_sample){
        .value = value,
        .at = at,
        .texture = shader_resource_of(plan, given[SHADER_IMAGE_TEXTURE]),
        .sampler = has_sampler ? shader_resource_of(plan, given[SHADER_IMAGE_SAMPLER]) : SHADER_NONE};
    return at != NO_COMPONENT && varyings_of(stage, &given[SHADER_IMAGE_DX], SHADER_INPUT_DX) == at &&
           varyings_of(stage, &given[SHADER_IMAGE_DY], SHADER_INPUT_DY) == at &&
           plan->is_hoisted[sample->texture] && (!has_sampler || plan->is_hoisted[sample->sampler]);
}

uint32_t shader_find_group_samples(const struct shader_linked_stage *stage, struct shader_plan *plan,
                                   struct shader_group_sample samples[SHADER_MAX_GROUP_SAMPLES])
{
    uint32_t count = 0;
    if (plan->has_effects) {
        return 0;
    }
    for (uint32_t i = 0; i < plan->form->code_count && count < SHADER_MAX_GROUP_SAMPLES; i++) {
        const uint32_t *operands = NULL;
        if (find_sample(stage, plan, i, &samples[count], &operands)) {
            count++;
            for (int axis = 0; axis < 2; axis++) {
                plan->uses[operands[SHADER_IMAGE_COORDINATES + axis]]--;
                plan->uses[operands[SHADER_IMAGE_DX + axis]]--;
                plan->uses[operands[SHADER_IMAGE_DY + axis]]--;
            }
        }
    }
    return count;
}

uint32_t shader_samples_alike(const struct shader_group_sample *samples, uint32_t count, uint32_t *left)
{
    const uint32_t at = samples[__builtin_ctz(*left)].at;
    uint32_t alike = 0;
    for (uint32_t i = 0; i < count; i++) {
        alike |= samples[i].at == at ? *left & 1u << i : 0;
    }
    *left &= ~alike;
    return alike;
}
