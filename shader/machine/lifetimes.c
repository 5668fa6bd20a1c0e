// SPDX-License-Identifier: MIT
// From where to where values live: where each is read, and the last place that may read it.
#include "generator.h"

static void count_use(const struct shader_generator *g, uint32_t value, uint32_t place, bool writes)
{
    if (writes) {
        g->uses[g->first_use[value]] = place;
    }
    g->first_use[value]++;
}

static void walk_uses(struct shader_generator *g, bool writes)
{
    for (uint32_t i = 0; i < g->form->code_count; i++) {
        uint32_t count;
        const uint32_t *const operands = shader_operands(g->form, &g->form->nodes[g->form->code[i]], &count);
        for (uint32_t o = 0; o < count; o++) {
            count_use(g, operands[o], i, writes);
        }
    }
}

// Write down where each value is read, from first to last.
static void find_uses(struct shader_generator *g)
{
    const uint32_t nodes = g->form->node_count;
    g->first_use = shader_take(g->memory, nodes + 1, sizeof *g->first_use);
    walk_uses(g, false);
    uint32_t sum = 0;
    for (uint32_t value = 0; value <= nodes; value++) {
        const uint32_t count = g->first_use[value];
        g->first_use[value] = sum;
        sum += count;
    }
    g->uses = shader_take(g->memory, sum + 1, sizeof *g->uses);
    walk_uses(g, true);
    for (uint32_t value = nodes; value > 0; value--) {
        g->first_use[value] = g->first_use[value - 1];
    }
    g->first_use[0] = 0;
}

// A value that a loop reads and does not compute lives until the loop ends, and a home lives in the whole of every loop
// where it is named.
static void find_ends(struct shader_generator *g)
{
    const struct shader_program *const form = g->form;
    uint32_t *const loops = shader_take(g->memory, SHADER_MAX_DEPTH + 2, sizeof *loops);
    uint32_t depth = 0;
    for (uint32_t i = 0; i < form->code_count; i++) {
        const uint32_t value = form->code[i];
        struct shader_node *const node = &form->nodes[value];
        uint32_t count;
        const uint32_t *const operands = shader_operands(form, node, &count);
        while (depth > 0 && g->plan.structures[loops[depth - 1]].end < i) {
            depth--;
        }
        for (uint32_t o = 0; o < count; o++) {
            const bool is_home = form->nodes[operands[o]].op == SHADER_HOME;
            const uint32_t from = g->plan.place[operands[o]];
            uint32_t end = i;
            for (uint32_t d = 0; d < depth; d++) {
                if (is_home || (from != SHADER_NONE && loops[d] > from)) {
                    end = g->plan.structures[loops[d]].end;
                    break;
                }
            }
            struct shader_machine_value *const v = &g->values[operands[o]];
            v->end = end > v->end ? end : v->end;
        }
        g->values[value].end = i > g->values[value].end ? i : g->values[value].end;
        if (node->op == SHADER_LOOP && !g->plan.structures[i].is_wide) {
            loops[depth++] = i;
        }
    }
}

// Find what the code of every group reads, of values that are computed once a call.
static void find_lasting(struct shader_generator *g, bool *is_lasting)
{
    const struct shader_program *const form = g->form;
    for (uint32_t i = 0; i < form->code_count; i++) {
        const uint32_t value = form->code[i];
        const uint16_t op = form->nodes[value].op;
        uint32_t count;
        const uint32_t *const operands = shader_operands(form, &form->nodes[value], &count);
        is_lasting[value] = is_lasting[value] || op == SHADER_BUFFER || op == SHADER_WORKGROUP;
        for (uint32_t o = 0; o < count && (!g->plan.is_hoisted[value] || op == SHADER_BUFFER); o++) {
            is_lasting[operands[o]] = true;
        }
    }
}

static void list_ends(struct shader_generator *g)
{
    const struct shader_program *const form = g->form;
    bool *const is_read = shader_take(g->memory, form->node_count, sizeof *is_read);
    find_lasting(g, is_read);
    // What is sampled stays until its last part is read.
    for (uint32_t i = 0; i < form->code_count; i++) {
        const struct shader_node *const node = &form->nodes[form->code[i]];
        if (node->op == SHADER_PART) {
            struct shader_machine_value *const whole = &g->values[node->operands[0]];
            const uint32_t end = g->values[form->code[i]].end;
            whole->end = end > whole->end ? end : whole->end;
        }
    }
    g->first_end = shader_take(g->memory, form->code_count + 1, sizeof *g->first_end);
    for (uint32_t value = 0; value < form->node_count; value++) {
        struct shader_machine_value *const v = &g->values[value];
        const bool is_lasting = (g->plan.is_hoisted[value] && is_read[value]) || g->plan.is_kept[value] ||
                                g->plan.is_joint[value] || form->nodes[value].op == SHADER_CONSTANT;
        v->end = is_lasting ? UINT32_MAX : v->end;
        if (!is_lasting && v->end < form->code_count) {
            v->next_end = g->first_end[v->end];
            g->first_end[v->end] = value + 1;
        }
    }
}

void shader_find_lifetimes(struct shader_generator *g)
{
    find_uses(g);
    find_ends(g);
    list_ends(g);
}
