// SPDX-License-Identifier: MIT
// Samples at coordinates that are inputs, as those of a material mostly are. Outside of structure they need nothing
// that the code computes, so they are done for all groups before the code of the first begins: the library samples
// textures of one size together, and the texels of one are on their way while it filters another.
#include "generator.h"

// Return the number of the first of two varyings that values are: inputs, or derivatives of inputs. Return
// NO_COMPONENT for others.
static uint32_t varyings_of(const struct shader_generator *g, const uint32_t *values, enum shader_op op)
{
    const struct shader_node *const first = &g->form->nodes[values[0]], *const next =
                                                                            &g->form->nodes[values[1]];
    if (first->op != op || next->op != op || next->immediate != first->immediate + 1) {
        return NO_COMPONENT;
    }
    const uint32_t at = g->stage->component_of[first->immediate];
    return g->stage->component_of[next->immediate] == at + 1 ? at : NO_COMPONENT;
}

// Return where a SAMPLE finds its coordinates among the varyings, or NO_COMPONENT where it has to wait for its group.
static uint32_t sampled_at(const struct shader_generator *g, uint32_t place, uint32_t **gradient)
{
    struct shader_node *const node = &g->form->nodes[g->form->code[place]];
    const uint32_t plain = SHADER_DO_SAMPLE | 2 << SHADER_IMAGE_SPATIAL_SHIFT | SHADER_IMAGE_HAS_GRADIENT;
    if (node->op != SHADER_SAMPLE || g->plan.block[place] != 0 ||
        (node->immediate & ~(uint32_t)SHADER_IMAGE_HAS_SAMPLER) != plain) {
        return NO_COMPONENT;
    }
    uint32_t count;
    uint32_t *const operands = shader_operands(g->form, node, &count);
    const uint32_t texture = shader_resource_of(g, operands[SHADER_IMAGE_TEXTURE]),
                   sampler = shader_sampler_of(g, node, operands);
    const uint32_t at = varyings_of(g, &operands[SHADER_IMAGE_COORDINATES], SHADER_INPUT);
    *gradient = &operands[SHADER_IMAGE_DX];
    return at != NO_COMPONENT && varyings_of(g, &operands[SHADER_IMAGE_DX], SHADER_INPUT_DX) == at &&
                   varyings_of(g, &operands[SHADER_IMAGE_DY], SHADER_INPUT_DY) == at &&
                   shader_is_one_image(g, texture, sampler)
               ? at
               : NO_COMPONENT;
}

void shader_find_group_samples(struct shader_generator *g)
{
    const bool is_possible = g->kind == RHW_SHADER_FRAGMENT && !g->plan.has_effects;
    for (uint32_t i = 0; is_possible && i < g->form->code_count; i++) {
        uint32_t *gradient = NULL;
        const uint32_t value = g->form->code[i], at = sampled_at(g, i, &gradient);
        if (at == NO_COMPONENT || g->sample_count == SHADER_MAX_GROUP_SAMPLES) {
            continue;
        }
        g->samples[g->sample_count++] = (struct shader_group_sample){value, at};
        g->values[value].is_kept = true;
        shader_take_block(g, value);
        for (int axis = 0; axis < 2; axis++) {
            g->plan.uses[gradient[axis]]--;
            g->plan.uses[gradient[3 + axis]]--;
        }
    }
}

static struct x86_operand entry_of(const struct shader_generator *g, uint32_t sample)
{
    return x86_at(X86_RSP, (int32_t)(g->table + sample * sizeof(struct rhw_binding)));
}

void shader_list_group_samples(struct shader_generator *g)
{
    g->table = shader_take_frame(g, g->sample_count * (uint32_t)sizeof(struct rhw_binding));
    for (uint32_t i = 0; i < g->sample_count; i++) {
        struct shader_node *const node = &g->form->nodes[g->samples[i].value];
        uint32_t count;
        const uint32_t *const operands = shader_operands(g->form, node, &count);
        const uint32_t texture = shader_resource_of(g, operands[SHADER_IMAGE_TEXTURE]);
        shader_invoke_plain(
            g, SHADER_CALL_LIST, 2,
            (struct shader_argument[]){shader_one_image(g, texture, shader_sampler_of(g, node, operands)),
                                       shader_address_argument(entry_of(g, i))});
    }
}

void shader_sample_groups(struct shader_generator *g)
{
    for (uint32_t left = (1u << g->sample_count) - 1; left != 0;) {
        const uint32_t at = g->samples[__builtin_ctz(left)].at;
        uint32_t which = 0;
        for (uint32_t i = 0; i < g->sample_count; i++) {
            which |= g->samples[i].at == at ? 1u << i : 0;
        }
        left &= ~which;
        shader_invoke_plain(g, SHADER_CALL_SAMPLE_GROUPS, 4,
                            (struct shader_argument[]){shader_address_argument(SHADER_FRAME(together)),
                                                       shader_address_argument(entry_of(g, 0)),
                                                       shader_number_argument(which),
                                                       shader_number_argument(at)});
    }
}
