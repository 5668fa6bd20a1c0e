// SPDX-License-Identifier: MIT
// A texture compares versions to learn that its texels have been written by somebody else.
#include "shared_texels.h"

#include "clean_tiles.h"
#include "base/memory.h"
#include "texture.h"

bool rhw_texture_share(struct rhw_memory *memory, struct rhw_texture_data *texture)
{
    if (texture->shared) {
        return true;
    }
    struct rhw_shared_texels *const shared =
        rhw_memory_allocate(memory, sizeof *shared, _Alignof(struct rhw_shared_texels));
    if (!shared) {
        return false;
    }
    *shared = (struct rhw_shared_texels){
        .bytes = texture->memory, .size = texture->memory_size, .owners = 1, .attached = texture->attached};
    texture->shared = shared;
    return true;
}

void rhw_shared_texels_release(struct rhw_memory *memory, struct rhw_shared_texels *shared)
{
    if (--shared->owners != 0) {
        return;
    }
    if (!shared->is_callers) {
        rhw_memory_release(memory, shared->bytes, shared->size);
    }
    rhw_memory_release(memory, shared, sizeof *shared);
}

// Return true if others may have written the texels before a pass, and do not say so.
static bool is_unsaid(const struct rhw_shared_texels *shared)
{
    return shared->is_callers && !shared->is_told;
}

// Drop what the texture kept about its texels where somebody else has written them.
static void catch_up(struct rhw_texture_data *texture)
{
    if (texture->version != texture->shared->version) {
        texture->version = texture->shared->version;
        texture->linear_levels = 0;
        rhw_clean_tiles_forget(texture->clean);
    }
}

void rhw_texture_note_attached(struct rhw_texture_data *texture, uint32_t pass_generation)
{
    texture->attached = pass_generation;
    texture->linear_levels = 0;
    struct rhw_shared_texels *const shared = texture->shared;
    if (!shared) {
        return;
    }
    shared->version += is_unsaid(shared) && shared->attached != pass_generation;
    shared->attached = pass_generation;
    catch_up(texture);
    texture->version = ++shared->version;
}

void rhw_texture_note_sampled(struct rhw_texture_data *texture, uint32_t pass_generation)
{
    struct rhw_shared_texels *const shared = texture->shared;
    if (shared) {
        shared->version += is_unsaid(shared) && shared->sampled != pass_generation;
        shared->sampled = pass_generation;
        catch_up(texture);
    }
}

void rhw_texture_note_changed(struct rhw_texture_data *texture, int level, int layer, int layer_count)
{
    catch_up(texture);
    texture->linear_levels &= ~(1u << level);
    rhw_clean_tiles_forget_part(texture->clean, level, layer, layer_count);
    texture->version = ++texture->shared->version;
}

void rhw_texture_note_written(struct rhw_texture_data *texture)
{
    texture->linear_levels = 0;
    rhw_clean_tiles_forget(texture->clean);
    if (texture->shared) {
        texture->version = ++texture->shared->version;
    }
}
