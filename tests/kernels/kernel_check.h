// SPDX-License-Identifier: MIT
// A kernel check compares one function of src/kernels (or of the wrappers below it) between instruction sets: random
// and hostile input goes to the copy of each set, and what comes out has to have the bits that the baseline's has.
//
// The functions are static in headers, so a file check_FOLDER.c wraps them and is compiled once per instruction set, as
// the kernels are. An entry takes three parts, all in that file:
//
//     struct rect_input {                                                       // 1. what the function is given: plain
//         int x, y, rect[4];                                                    //    numbers, no pointers
//     };
//
//     static void make_rect(struct kernel_random *random, void *input) {...}    // 2. an input that keeps the
//                                                                               //    preconditions, see kernel_random.h
//     static void run_rect(const void *input, void *result) {...}               // 3. the call
//
//     {"rect_mask", sizeof(struct rect_input), sizeof(uint64_t), KERNEL_BITS, make_rect, run_rect},
//
// Whole kernels, from a draw to the tile, are given the draws of scene_input.h, of which draw_scene.h makes a pass.
//
// A new folder takes a line in kernel_folders.h, and one in kernel_folders.c.
#ifndef KERNEL_CHECK_H
#define KERNEL_CHECK_H

#include <stddef.h>
#include <string.h>

#include "kernel_random.h"

// What the bytes of a result are. NaNs of two instruction sets may differ where two operands are NaN, because the
// compiler may swap the operands: the kernels promise no more of a NaN than that it is one. The halves of KERNEL_HALVES
// are bits that were made in two ways, as by a special path and by the general one, and have to be the same too.
enum kernel_result { KERNEL_BITS, KERNEL_FLOATS, KERNEL_DOUBLES, KERNEL_HALVES };

enum { KERNEL_ALIGNMENT = 64 }; // of inputs and results

struct kernel_check {
    const char *name; // of the function
    // Bytes. A result has no padding, and is filled with the same bytes for each instruction set before it is run.
    size_t input_size, result_size;
    enum kernel_result result;
    void (*make)(struct kernel_random *random,
                 void *input); // fills a zeroed input; the baseline's makes it for all
    void (*run)(const void *input, void *result);
};

// Makes one NaN of all, for results that are bits but for some floats.
static inline void unify_nans(void *floats, int count)
{
    static const uint32_t nan = 0x7fc00000;
    for (int i = 0; i < count; i++) {
        unsigned char *const at = (unsigned char *)floats + 4 * (size_t)i;
        float value;
        memcpy(&value, at, sizeof value);
        if (value != value) {
            memcpy(at, &nan, sizeof nan);
        }
    }
}

struct kernel_folder {
    const char *name;
    const struct kernel_check *checks;
    int count;
};

#endif
