// SPDX-License-Identifier: MIT
// A stage as a back end gets it: its form, and what linking found.
#ifndef SHADER_LINKED_STAGE_H
#define SHADER_LINKED_STAGE_H

#include "form.h"
#include "rhw/spirv.h"

// Where a resource of a stage lies: as many bindings of a set from place `first` on.
struct shader_slot {
    uint32_t set, first, count;
};

struct shader_linked_stage {
    const struct shader_program *form; // NULL: the program has no such stage
    const struct shader_slot *slots;   // by resource
    const uint8_t *component_of;       // number among the varyings, by enum shader_input; 0xff: none
    const bool *is_linear;             // by enum shader_input: it is flat or noperspective
    uint8_t w_component;               // varying that holds W of the position; 0xff: none
    uint32_t batch;                    // groups that go through the shader together where their order shows
    uint32_t target_count;
};

#endif
