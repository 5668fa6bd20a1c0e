// SPDX-License-Identifier: MIT
// The switch of mutants, which every source of a mutated build includes first. RHW_MUTANT in the environment is the number
// of the mutant that is on. RHW_MUTANTS_REACHED names a file with a byte for each mutant, which becomes 1 where a program
// comes past its place; the file is mapped, so that a process that ends abruptly has written it too.
#ifndef RHW_MUTANT_H
#define RHW_MUTANT_H

#ifdef __cplusplus
extern "C" {
#endif

// No header of the system is included here, because a source may have to say first which of its features it wants.
char *rhw_mutant_getenv(const char *name) __asm__("getenv");
int rhw_mutant_atoi(const char *text) __asm__("atoi");
int rhw_mutant_open(const char *path, int flags, ...) __asm__("open");
void *rhw_mutant_mmap(void *address, unsigned long size, int protection, int flags, int file,
                      long offset) __asm__("mmap");

enum { RHW_MUTANTS_MOST = 65536 };

// Every program and shared object has one of each.
__attribute__((weak, visibility("hidden"))) int rhw_mutant_on;
__attribute__((weak, visibility("hidden"))) unsigned char rhw_mutants_unread[RHW_MUTANTS_MOST];
__attribute__((weak, visibility("hidden"))) unsigned char *rhw_mutants_reached = rhw_mutants_unread;

__attribute__((constructor, unused)) static void rhw_mutant_start(void)
{
    const char *const on = rhw_mutant_getenv("RHW_MUTANT"), *const reached =
                                                                rhw_mutant_getenv("RHW_MUTANTS_REACHED");
    if (on) {
        rhw_mutant_on = rhw_mutant_atoi(on);
    }
    if (reached && rhw_mutants_reached == rhw_mutants_unread) {
        const int file = rhw_mutant_open(reached, 02000002); // O_RDWR | O_CLOEXEC
        void *const map =
            rhw_mutant_mmap(0, RHW_MUTANTS_MOST, 3, 1, file, 0); // PROT_READ | PROT_WRITE, MAP_SHARED
        if (map != (void *)-1) {
            rhw_mutants_reached = (unsigned char *)map;
        }
    }
}

// Return true if mutant `number` is on.
static inline __attribute__((unused, always_inline)) int rhw_mutant(int number)
{
    rhw_mutants_reached[number] = 1;
    return rhw_mutant_on == number;
}

#ifdef __cplusplus
}
#endif

#endif
