// SPDX-License-Identifier: MIT
// What is decided about a stage before its text or code is written: which values are computed once a call, where each
// is read, and where all groups have to arrive before any goes on.
//
// A cut is a BARRIER, or an ATOMIC whose order among groups shows. Structure around a cut is wide: all groups go
// through it together. The code between cuts and wide structure is a run, through which one group goes after the
// other. What one run computes and another reads is kept in an array with an element for each group. Without a cut
// there is one run.
//
// A group by itself may be one long chain of operations that wait for each other. A step ends a run in front of a
// function that would wait long, so that the processor computes it of many groups at the same time. A loop around a
// step is wide, so each of its rounds is done for all groups: what they share is computed between runs, once. What is
// joint in order stays where it stands, between two runs, and so does a function that one call computes for all groups.
#ifndef SHADER_PLAN_H
#define SHADER_PLAN_H

#include "form.h"

#define SHADER_NONE UINT32_MAX

// IF, REGION or LOOP, by the place in the code where it begins.
struct shader_structure {
    uint32_t end;       // place of its end
    uint32_t otherwise; // place of its ELSE, or SHADER_NONE
    bool loses;         // lanes that come in may not come out: they leave for further out, or are discarded
    bool is_wide;
    bool is_uniform; // all lanes take the same way
};

struct shader_plan {
    const struct shader_program *form;
    struct shader_structure *structures; // by place
    uint32_t *place;                     // by value: where it stands in the code, or SHADER_NONE
    uint32_t *block;                     // by place: number of the block around it
    uint32_t *run; // by place: its number, or SHADER_NONE at barriers, wide structure, what is joint in order
    bool *is_step; // by place: a run begins here, for speed
    bool *is_for_groups; // by place: a step that is one function of a kept value, for all groups in one call
    uint32_t *uses, *last_use; // by value: how often it is read, and a place where it is read
    bool *is_hoisted;          // by value: it is computed once a call
    bool *is_joint;       // by value: all groups share it, and it is computed or set once where it stands
    bool *is_kept;        // by value: it has an element for each group
    uint32_t *home_run;   // by value: the run that a home belongs to; SHADER_NONE: it is kept
    uint32_t *first_home; // by run: the first of its homes, counted from 1
    uint32_t *next_home;  // by value: the next home of its run, counted from 1
    bool has_cuts, has_effects, loses_lanes; // steps are among the cuts
    bool has_steps_alone;                    // it shows nowhere how many groups go through the code together
    bool has_steps;                          // as was asked for
};

static inline enum shader_op shader_op_at(const struct shader_plan *plan, uint32_t place)
{
    return (enum shader_op)plan->form->nodes[plan->form->code[place]].op;
}

bool shader_is_cut(const struct shader_plan *plan, uint32_t place);
bool shader_is_wide(const struct shader_plan *plan, uint32_t place);
// Return true for memory that nobody writes while the shader runs, as far as it can tell.
bool shader_is_constant_memory(const struct shader_plan *plan, uint32_t buffer);
// joint.c: find what is joint, once wide structure is known.
void shader_find_joint(struct shader_memory *memory, struct shader_plan *plan);
// Return true for what is joint and has to stay where it is: it sets a home, or reads memory that changes.
bool shader_is_joint_in_order(const struct shader_plan *plan, uint32_t place);
// Return true for wide structure that asks for lanes of which the run before it computes the condition.
bool shader_is_decided(const struct shader_plan *plan, uint32_t place);
// Return true for the home of a resource that is found once a call, which serves everywhere in the place of its home.
bool shader_is_resource_home(const struct shader_plan *plan, uint32_t value);
// Return the BUFFER, PUSH or WORKGROUP that a value is, or the home that keeps an element that lanes name.
uint32_t shader_resource_of(const struct shader_plan *plan, uint32_t value);
void shader_make_plan(struct shader_memory *memory, const struct shader_program *form, bool has_steps,
                      struct shader_plan *plan);

#endif
