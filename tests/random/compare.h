// SPDX-License-Identifier: MIT
// The table of random programs, which emit_many writes: each as a module, and as the C that was written of it.
#ifndef RANDOM_COMPARE_H
#define RANDOM_COMPARE_H

#include <rhw/spirv.h>

struct random_words {
    const char *name;
    const uint32_t *words;
    size_t size; // bytes
};

struct random_program {
    struct random_words words;
    const struct rhw_program *drawn; // NULL: it is compute
    const struct rhw_compute_program *compute;
};

extern const struct random_words random_vertex;
extern const struct random_program random_programs[];
extern const int random_count;

#endif
