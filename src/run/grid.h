// SPDX-License-Identifier: MIT
// A grid is the workgroups of a dispatch, as a value that was checked.
#ifndef RHW_GRID_H
#define RHW_GRID_H

#include "rhw/dispatch.h"

struct rhw_bindings;
struct rhw_executor;

struct rhw_grid {
    const struct rhw_compute_program *program;
    rhw_workgroup_function *function; // NULL: the one-at-a-time form
    const struct rhw_bindings *bindings;
    const void *uniforms;
    int size[3];      // invocations of a workgroup, at least 1
    int32_t base[3];  // place of the first workgroup
    int32_t count[3]; // workgroups; 0: there are none
};

// Call the program's function for every workgroup of a grid. Return RHW_OK, RHW_ERROR_OUT_OF_MEMORY or
// RHW_ERROR_GIVEN_UP.
enum rhw_result rhw_executor_run_grid(struct rhw_executor *executor, const struct rhw_grid *grid);

#endif
