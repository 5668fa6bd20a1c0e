// SPDX-License-Identifier: MIT
// Samples that are done for all groups together: a table of what they name, and a call for each pair of varyings.
#include "c_emit.h"

void shader_c_find_group_samples(struct shader_emitter *emitter)
{
    const bool is_possible = emitter->kind == RHW_SHADER_FRAGMENT;
    emitter->sample_count =
        is_possible ? shader_find_group_samples(emitter->stage, &emitter->plan, emitter->samples) : 0;
}

void shader_c_list_group_samples(struct shader_emitter *emitter)
{
    if (emitter->sample_count == 0) {
        return;
    }
    const unsigned count = emitter->sample_count;
    shader_text_line(&emitter->arrays, "rhw_float texels[GROUPS * %u][4];", count);
    shader_text_line(&emitter->once, "struct rhw_binding table_of_samples[%u];", count);
    for (unsigned i = 0; i < count; i++) {
        const struct shader_group_sample *const sample = &emitter->samples[i];
        const char *lanes;
        const char *const binding =
            shader_c_begin_bindings(emitter, sample->texture, sample->sampler, &lanes);
        shader_text_line(&emitter->once, "rhw_spirv_list(%s, &table_of_samples[%u]);", binding, i);
    }
}

void shader_c_sample_groups(const struct shader_emitter *emitter, struct shader_text *out)
{
    for (uint32_t left = (1u << emitter->sample_count) - 1; left != 0;) {
        const unsigned at = emitter->samples[__builtin_ctz(left)].at;
        const unsigned which = shader_samples_alike(emitter->samples, emitter->sample_count, &left);
        shader_text_line(out,
                         "rhw_spirv_sample_groups(table_of_samples, &groups[first], groups_here, 0x%x, %u, "
                         "texels, %u);",
                         which, at, (unsigned)emitter->sample_count);
    }
}

bool shader_c_write_group_sample(struct shader_emitter *emitter, uint32_t value)
{
    for (unsigned i = 0; i < emitter->sample_count; i++) {
        if (emitter->samples[i].value == value) {
            shader_text_line(emitter->out, "const rhw_float *const texel%u = texels[%u * %s + %u];",
                             (unsigned)value, (unsigned)emitter->sample_count, emitter->group, i);
            return true;
        }
    }
    return false;
}
