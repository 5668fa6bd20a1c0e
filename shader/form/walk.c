// SPDX-License-Identifier: MIT
// See walk.h.
#include "walk.h"

enum { WORTH_A_JUMP = 8 }; // places that are left out

static bool is_written_before(const struct shader_walk *walk, uint32_t place)
{
    return walk->has_once && walk->plan->is_hoisted[walk->plan->form->code[place]];
}

// Values that are computed once a call may stand among places that no lane comes to.
static void walk_dead(const struct shader_walk *walk, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; i < end && !walk->has_once; i++) {
        if (walk->plan->is_hoisted[walk->plan->form->code[i]]) {
            walk->node(walk->user, i);
        }
    }
}

// Walk one item, a node or narrow structure. Return the place behind it.
static uint32_t walk_item(const struct shader_walk *walk, uint32_t place)
{
    if (shader_opens(shader_op_at(walk->plan, place))) {
        walk->narrow(walk->user, place);
        return walk->plan->structures[place].end + 1;
    }
    if (!is_written_before(walk, place)) {
        walk->node(walk->user, place);
    }
    return place + 1;
}

// Lanes were lost. If none is left, so many places are left out, where that is worth it.
static void skip_rest(const struct shader_walk *walk, uint32_t places, uint32_t structure)
{
    const bool can_skip =
        structure != SHADER_NONE || (walk->skips_group && *walk->divergence == 0 && *walk->loop_depth == 0);
    if (can_skip && places >= WORTH_A_JUMP) {
        walk->skip(walk->user, structure);
    }
}

void shader_walk_narrow(struct shader_walk *walk, uint32_t begin, uint32_t end, uint32_t structure)
{
    uint32_t i = begin;
    while (i < end && !*walk->is_dead) {
        const uint32_t mask = *walk->mask;
        const bool is_structure = shader_opens(shader_op_at(walk->plan, i));
        i = walk_item(walk, i);
        if (is_structure && *walk->mask != mask) {
            skip_rest(walk, end - i, structure);
        }
    }
    walk_dead(walk, i, end);
}

static void write_joint(struct shader_walk *walk, uint32_t place)
{
    walk->node(walk->user, place);
    walk->is_unsettled = true;
}

static void settle(struct shader_walk *walk)
{
    if (walk->is_unsettled) {
        walk->is_unsettled = false;
        walk->settle(walk->user);
    }
}

// Write all joint values of the run that begins at a place, because they need nothing of the run.
static void write_ahead(struct shader_walk *walk, uint32_t begin)
{
    const struct shader_plan *const plan = walk->plan;
    for (uint32_t i = begin; i < plan->form->code_count && plan->run[i] == plan->run[begin]; i++) {
        if (plan->is_joint[plan->form->code[i]]) {
            write_joint(walk, i);
        }
    }
}

static void open_run(struct shader_walk *walk, uint32_t place)
{
    if (!walk->is_run_open) {
        write_ahead(walk, place);
        settle(walk);
        walk->is_run_open = true;
        walk->open_run(walk->user, place);
    }
}

static void close_run(struct shader_walk *walk)
{
    if (walk->is_run_open) {
        walk->is_run_open = false;
        walk->close_run(walk->user);
    }
}

// Walk a barrier, an atomic that all groups come to before any goes on, a function for all groups, or wide structure.
// Return the place behind it.
static uint32_t walk_wide_item(struct shader_walk *walk, uint32_t place)
{
    const enum shader_op op = shader_op_at(walk->plan, place);
    if (walk->is_run_open && shader_is_decided(walk->plan, place)) {
        walk->decide(walk->user, place);
    }
    close_run(walk);
    settle(walk);
    if (walk->plan->is_for_groups[place]) {
        walk->for_groups(walk->user, place);
        return place + 1;
    }
    if (op == SHADER_BARRIER) {
        if (walk->barrier) {
            walk->barrier(walk->user);
        }
        return place + 1;
    }
    if (shader_is_cut(walk->plan, place)) {
        open_run(walk, place);
        walk->node(walk->user, place);
        close_run(walk);
        return place + 1;
    }
    if (op == SHADER_LEAVE) {
        walk->leave_wide(walk->user, place);
        return place + 1;
    }
    walk->wide(walk->user, place);
    return walk->plan->structures[place].end + 1;
}

void shader_walk_wide(struct shader_walk *walk, uint32_t begin, uint32_t end)
{
    uint32_t i = begin;
    while (i < end && !*walk->is_dead) {
        if (shader_is_cut(walk->plan, i) || walk->plan->is_for_groups[i] || shader_is_wide(walk->plan, i)) {
            i = walk_wide_item(walk, i);
        } else if (is_written_before(walk, i)) {
            i++;
        } else if (walk->plan->is_joint[walk->plan->form->code[i]]) {
            if (shader_is_joint_in_order(walk->plan, i)) {
                close_run(walk);
            }
            if (!walk->is_run_open) {
                write_joint(walk, i);
            }
            i++;
        } else {
            if (walk->plan->is_step[i]) {
                close_run(walk);
            }
            open_run(walk, i);
            i = walk_item(walk, i);
        }
    }
    close_run(walk);
    settle(walk);
    walk_dead(walk, i, end);
}
