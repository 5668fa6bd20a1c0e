// SPDX-License-Identifier: MIT
// Texels that are not one texture's alone: those of a texture and its views, and those on the caller's memory. They
// have a common record of what was true of a texture as long as nobody else touched its texels: whether the pass being
// recorded draws into them or samples them, and whether anybody has written since. Textures without views that stand on
// the library's memory have no record.
#ifndef RHW_SHARED_TEXELS_H
#define RHW_SHARED_TEXELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rhw_bound_texels;
struct rhw_memory;
struct rhw_texture_data;

struct rhw_shared_texels {
    void *bytes;
    size_t size;
    // The texels are the caller's memory: nothing is released, and others write them between passes.
    bool is_callers;
    bool is_told;    // the caller tells what it writes there, by rhw_texture_changed
    bool has_stores; // shader functions may write the texels through a binding, in any pass
    uint32_t owners; // number of textures: the texture and its views
    // Generation of the last pass that draws into the texels, and of the last pass that samples them.
    uint32_t attached, sampled;
    uint32_t version; // counts writes, and passes before which others may have written unsaid
    // See bound_texels.h: textures that bindings sample, a list by next_bound, and the place of the record in the list
    // of those that need a look before the next pass. NULL `bound_texels`: no binding samples the texels.
    struct rhw_texture_data *bound;
    struct rhw_bound_texels *bound_texels;
    struct rhw_shared_texels *next_stale;
    bool is_stale;
};

// Make the texture's texels shared, where they are not yet. Return false when out of memory.
bool rhw_texture_share(struct rhw_memory *memory, struct rhw_texture_data *texture);
// Give up the texture's part of its texels. They are released with the last part.
void rhw_shared_texels_release(struct rhw_memory *memory, struct rhw_shared_texels *shared);

// Note that texels were written, or will be: what bindings sample of them needs a look before the next pass.
void rhw_shared_texels_note_stale(struct rhw_shared_texels *shared);
// Take a texture that is destroyed out of the list of those that bindings sample.
void rhw_shared_texels_unbind(struct rhw_texture_data *texture);

// Return true if others may have written the texels before a pass, and do not say so.
static inline bool rhw_shared_texels_are_unsaid(const struct rhw_shared_texels *shared)
{
    return (shared->is_callers && !shared->is_told) || shared->has_stores;
}

// Note that a pass draws into the texture, or samples it. What is kept about its texels is forgotten where others have
// written them.
void rhw_texture_note_attached(struct rhw_texture_data *texture, uint32_t pass_generation);
void rhw_texture_note_sampled(struct rhw_texture_data *texture, uint32_t pass_generation);
// Note that the texture's texels are written between draws.
void rhw_texture_note_written(struct rhw_texture_data *texture);
// Note that others have written layers of a level of shared texels.
void rhw_texture_note_changed(struct rhw_texture_data *texture, int level, int layer, int layer_count);

#endif
