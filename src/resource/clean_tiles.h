// SPDX-License-Identifier: MIT
// Which tiles of a texture hold nothing but one clear value. A pass that clears them to it and draws nothing there
// leaves them alone: what most of a picture without much in it is, frame after frame.
#ifndef RHW_CLEAN_TILES_H
#define RHW_CLEAN_TILES_H

#include <stdbool.h>
#include <stddef.h>

struct rhw_memory;

enum { RHW_CLEAR_BYTES = 32 }; // every texel size divides it

// Of one layer of a level of a texture, which is drawn into.
struct rhw_clean_tiles {
    struct rhw_clean_tiles *next; // of another part of the texture
    int layer, level;
    size_t count;
    unsigned char texels[RHW_CLEAR_BYTES]; // what clean tiles hold, texels side by side
    bool is_clean[];                       // row by row; each is written by the thread that has the tile
};

// The record of a part in a texture's list, of that size in pixels; a new one has no tile clean. NULL
// when out of memory.
struct rhw_clean_tiles *rhw_clean_tiles_of_part(struct rhw_memory *memory, struct rhw_clean_tiles **list,
                                                int layer, int level, int width, int height);

// Of all parts; `list` may be NULL.
void rhw_clean_tiles_destroy(struct rhw_memory *memory, struct rhw_clean_tiles *list);

// From now on the part's clean tiles are those that hold `texels`; `clean` may be NULL.
void rhw_clean_tiles_expect(struct rhw_clean_tiles *clean, const unsigned char texels[RHW_CLEAR_BYTES]);

// Texels have been written by other hands than a pass, of any part; `list` may be NULL.
void rhw_clean_tiles_forget(struct rhw_clean_tiles *list);

#endif
