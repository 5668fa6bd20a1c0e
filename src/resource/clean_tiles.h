// SPDX-License-Identifier: MIT
// Which tiles of a texture hold nothing but one clear value. A pass that clears them to this value and draws nothing
// there leaves them alone: most tiles of a picture without much in it are left alone, frame after frame.
#ifndef RHW_CLEAN_TILES_H
#define RHW_CLEAN_TILES_H

#include <stdbool.h>
#include <stddef.h>

struct rhw_memory;

enum { RHW_CLEAR_BYTES = 32 }; // bytes; every texel size divides them

// The record of one layer of a level of a texture that is drawn into.
struct rhw_clean_tiles {
    struct rhw_clean_tiles *next; // record of another part of the texture
    int layer, level;
    size_t count;
    unsigned char texels[RHW_CLEAR_BYTES]; // what clean tiles hold: texels side by side
    bool is_clean[];                       // row by row; the thread that has a tile writes its element
};

// Return the record of a part in a texture's list, with that size in pixels. A new record has no clean tile. Return
// NULL when out of memory.
struct rhw_clean_tiles *rhw_clean_tiles_of_part(struct rhw_memory *memory, struct rhw_clean_tiles **list,
                                                int layer, int level, int width, int height);

// Release the records of all parts. `list` may be NULL.
void rhw_clean_tiles_destroy(struct rhw_memory *memory, struct rhw_clean_tiles *list);

// Expect `texels` from now on: clean tiles of the part are those that hold them. `clean` may be NULL.
void rhw_clean_tiles_expect(struct rhw_clean_tiles *clean, const unsigned char texels[RHW_CLEAR_BYTES]);

// Forget which tiles are clean, in all parts: something else than a pass has written texels. `list` may be NULL.
void rhw_clean_tiles_forget(struct rhw_clean_tiles *list);

// Forget which tiles of layers of a level are clean. `list` may be NULL.
void rhw_clean_tiles_forget_part(struct rhw_clean_tiles *list, int level, int layer, int layer_count);

#endif
