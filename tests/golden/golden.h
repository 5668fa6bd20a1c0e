// SPDX-License-Identifier: MIT
// What the golden tests share: the hash, the table, and the configurations that must all give one image.
#ifndef GOLDEN_H
#define GOLDEN_H

#include <rhw/rhw.h>

/// FNV-1a, 64 bits.
#define GOLDEN_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t golden_hash(uint64_t hash, const void *data, size_t size);

struct golden_set {
    int count;
    const char *(*name)(int number);
    /// Draws image `number` in a context of that definition; 0 where that is not possible here (skipped).
    uint64_t (*hash)(int number, const struct rhw_context_def *def);
};

/// `PROGRAM TABLE [--update | --few]`: the exit status.
/// `PROGRAM TABLE --matrix THREADS REPEATS`, THREADS as in 1,2,8, is for script/determinism: every instruction
/// set with every number of threads, each scene REPEATS times, in turn with ordinary and with tiny bins. Prints
/// "ISA THREADS MATCHED SCENES HASH" for each, where HASH is over what was drawn; every difference on stderr.
int golden_main(const struct golden_set *set, int argc, char **argv);

#endif
