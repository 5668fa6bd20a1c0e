// SPDX-License-Identifier: MIT
// The way of a back end through the code of a stage: which runs begin and end where, what is left out because no lane
// comes to it, and when it is worth a jump that a group has no active lane any more. plan.h says what a run is. What is
// written for a node and for structure, and which lanes are active there, is the back end's.
#ifndef SHADER_WALK_H
#define SHADER_WALK_H

#include "plan.h"

struct shader_walk {
    const struct shader_plan *plan;
    void *user; // what the functions get
    // The back end's, at the place that it is at: its mask, structures around that whose lanes go different ways, loops
    // around that, and whether no lane comes to it.
    const uint32_t *mask, *divergence, *loop_depth;
    const bool *is_dead;
    bool has_once; // what is computed once a call is written already
    bool skips_group; // where a group has no active lane, and has nothing around that may wait for it, its code may end
    void (*node)(void *user, uint32_t place);
    void (*barrier)(void *user); // NULL: a back end writes none
    // Structure from a place on whose inside the back end has walked, too: narrow, and wide. A LEAVE of wide structure.
    void (*narrow)(void *user, uint32_t place);
    void (*wide)(void *user, uint32_t place);
    void (*leave_wide)(void *user, uint32_t place);
    void (*open_run)(void *user, uint32_t place);
    void (*close_run)(void *user);
    // Of a plan with joint values: behind nodes that were written between runs, and where the condition of wide
    // structure at a place is known, before the run that computes it is closed.
    void (*settle)(void *user);
    void (*decide)(void *user, uint32_t place);
    // A function for all groups.
    void (*for_groups)(void *user, uint32_t place);
    // Where no lane is active, go to the end of the structure at a place; SHADER_NONE: to that of the group.
    void (*skip)(void *user, uint32_t structure);
    bool is_run_open, is_unsettled; // nodes were written between runs and are not settled
};

// Walk a block inside of a run, in structure that jumps may leave for its end, or in none.
void shader_walk_narrow(struct shader_walk *walk, uint32_t begin, uint32_t end, uint32_t structure);
// Walk a block that may have barriers.
void shader_walk_wide(struct shader_walk *walk, uint32_t begin, uint32_t end);

#endif
