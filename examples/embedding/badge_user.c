// SPDX-License-Identifier: MIT
// A program that knows badge.h and nothing of rhw. Prints a number made of the badge.
#include <stdint.h>
#include <stdio.h>

#include "badge.h"

enum { SIZE = 200 };

int main(void)
{
    static unsigned char pixels[SIZE * SIZE * 4];
    uint64_t hash = 14695981039346656037u; // FNV-1a
    if (badge_draw(pixels, SIZE) != 0) {
        return 1;
    }
    for (size_t i = 0; i < sizeof pixels; i++) {
        hash = (hash ^ pixels[i]) * 1099511628211u;
    }
    printf("%016llx\n", (unsigned long long)hash);
    return 0;
}
