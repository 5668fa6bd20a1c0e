// SPDX-License-Identifier: MIT
// A texture compares versions to learn that its texels have been written by somebody else.
#include "shared_texels.h"

#include "clean_tiles.h"
#include "context/context.h"
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

void rhw_shared_texels_note_stale(struct rhw_shared_texels *shared)
{
    if (shared->bound_texels && !shared->is_stale) {
        shared->is_stale = true;
        shared->next_stale = shared->bound_texels->stale;
        shared->bound_texels->stale = shared;
    }
}

void rhw_shared_texels_unbind(struct rhw_texture_data *texture)
{
    struct rhw_texture_data **next = texture->is_bound ? &texture->shared->bound : NULL;
    while (next && *next != texture) {
        next = &(*next)->next_bound;
    }
    if (next) {
        *next = texture->next_bound;
    }
}

// Take a record that is released out of the list of those that need a look.
static void forget_stale(struct rhw_shared_texels *shared)
{
    struct rhw_shared_texels **next = shared->is_stale ? &shared->bound_texels->stale : NULL;
    while (next && *next != shared) {
        next = &(*next)->next_stale;
    }
    if (next) {
        *next = shared->next_stale;
    }
}

void rhw_shared_texels_release(struct rhw_memory *memory, struct rhw_shared_texels *shared)
{
    if (--shared->owners != 0) {
        return;
    }
    forget_stale(shared);
    if (!shared->is_callers) {
        rhw_memory_release(memory, shared->bytes, shared->size);
    }
    rhw_memory_release(memory, shared, sizeof *shared);
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
    shared->version += rhw_shared_texels_are_unsaid(shared) && shared->attached != pass_generation;
    shared->attached = pass_generation;
    catch_up(texture);
    texture->version = ++shared->version;
    rhw_shared_texels_note_stale(shared);
}

void rhw_texture_note_sampled(struct rhw_texture_data *texture, uint32_t pass_generation)
{
    struct rhw_shared_texels *const shared = texture->shared;
    if (shared) {
        shared->version += rhw_shared_texels_are_unsaid(shared) && shared->sampled != pass_generation;
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
    rhw_shared_texels_note_stale(texture->shared);
}

void rhw_texture_note_written(struct rhw_texture_data *texture)
{
    texture->linear_levels = 0;
    rhw_clean_tiles_forget(texture->clean);
    if (texture->shared) {
        texture->version = ++texture->shared->version;
        rhw_shared_texels_note_stale(texture->shared);
    }
}
