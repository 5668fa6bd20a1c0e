// SPDX-License-Identifier: MIT
// Texels that are not one texture's alone: those of a texture and its views, and those on the caller's memory. What was true
// of a texture as long as nobody else touched its texels is asked here: whether the pass being recorded draws into them or
// samples them, and whether anybody has written since. Textures without views that stand on the library's memory have none
// of this.
#ifndef RHW_SHARED_TEXELS_H
#define RHW_SHARED_TEXELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rhw_memory;
struct rhw_texture_data;

struct rhw_shared_texels {
    void *bytes;
    size_t size;
    bool is_callers;            // nothing to release, and written by others between passes
    uint32_t owners;            // the texture and its views
    uint32_t attached, sampled; // generation of the last pass that draws into them, or samples them
    uint32_t version;           // counts writes, and passes before which others may have written
};

// Makes the texture's texels such; nothing where they are. False when out of memory.
bool rhw_texture_share(struct rhw_memory *memory, struct rhw_texture_data *texture);
// Releases the texture's part of its texels, which are released with the last one.
void rhw_shared_texels_release(struct rhw_memory *memory, struct rhw_shared_texels *shared);

// Notes that a pass draws into the texture, or samples it; what is kept about its texels is forgotten where others have
// written them.
void rhw_texture_note_attached(struct rhw_texture_data *texture, uint32_t pass_generation);
void rhw_texture_note_sampled(struct rhw_texture_data *texture, uint32_t pass_generation);
// Notes that the texture's texels are written between draws.
void rhw_texture_note_written(struct rhw_texture_data *texture);

#endif
