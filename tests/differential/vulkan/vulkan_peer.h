// SPDX-License-Identifier: MIT
// Compute shaders on the Vulkan driver of the machine that runs on the CPU (Mesa's lavapipe), without a window.
#ifndef VULKAN_PEER_H
#define VULKAN_PEER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PEER_BUFFERS = 4, PEER_CONSTANTS = 8 };

/// A buffer of set 0, whose binding is its number.
struct peer_buffer {
    void *bytes; // filled before, and read after
    size_t size;
};

struct peer_constant {
    uint32_t id, value;
};

struct peer_dispatch {
    const uint32_t *words;
    size_t size; // bytes
    struct peer_buffer buffers[PEER_BUFFERS];
    int buffer_count;
    struct peer_constant constants[PEER_CONSTANTS];
    uint32_t constant_count, groups;
};

/// Open the driver. Return NULL where there is none that runs on the CPU.
struct vulkan_peer *vulkan_peer_open(void);
void vulkan_peer_close(struct vulkan_peer *peer);
/// Return the driver's name and version.
const char *vulkan_peer_name(const struct vulkan_peer *peer);
/// Run the shader. Return false where the driver refuses it.
bool vulkan_peer_dispatch(struct vulkan_peer *peer, const struct peer_dispatch *dispatch);

#endif
