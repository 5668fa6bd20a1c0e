// SPDX-License-Identifier: MIT
// Endpoints: the two colours of a partition, between which the colours of its texels lie.
#ifndef RHW_ASTC_ENDPOINT_H
#define RHW_ASTC_ENDPOINT_H

#include <stdbool.h>
#include <stdint.h>

struct rhw_astc_endpoints {
    // The mode is of high dynamic range: it gives the error colour in a profile without it.
    bool is_error;
    uint8_t color[2][4];
};

// Return how many numbers a mode, 0..15, takes: 2, 4, 6 or 8.
static inline int rhw_astc_endpoint_numbers(int mode)
{
    return 2 * (mode / 4 + 1);
}

struct rhw_astc_endpoints rhw_astc_endpoints(int mode, const uint8_t *number);

#endif
