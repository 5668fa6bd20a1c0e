// SPDX-License-Identifier: MIT
// Samples that are done for all groups together: a table of what they name, and a call for each pair of varyings.
#include "generator.h"

void shader_take_group_samples(struct shader_generator *g)
{
    g->sample_count =
        g->kind == RHW_SHADER_FRAGMENT ? shader_find_group_samples(g->stage, &g->plan, g->samples) : 0;
    for (uint32_t i = 0; i < g->sample_count; i++) {
        g->values[g->samples[i].value].is_kept = true;
        shader_take_block(g, g->samples[i].value);
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
        shader_invoke_plain(
            g, SHADER_CALL_LIST, 2,
            (struct shader_argument[]){shader_one_image(g, g->samples[i].texture, g->samples[i].sampler),
                                       shader_address_argument(entry_of(g, i))});
    }
}

void shader_sample_groups(struct shader_generator *g)
{
    for (uint32_t left = (1u << g->sample_count) - 1; left != 0;) {
        const uint32_t at = g->samples[__builtin_ctz(left)].at;
        const uint32_t which = shader_samples_alike(g->samples, g->sample_count, &left);
        shader_invoke_plain(g, SHADER_CALL_SAMPLE_GROUPS, 4,
                            (struct shader_argument[]){shader_address_argument(SHADER_FRAME(together)),
                                                       shader_address_argument(entry_of(g, 0)),
                                                       shader_number_argument(which),
                                                       shader_number_argument(at)});
    }
}
