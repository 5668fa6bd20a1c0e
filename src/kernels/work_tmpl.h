// SPDX-License-Identifier: MIT
// A worker's work on a tile: where it is, and what the draw under way asks of it. Template: compiled once per
// instruction set.

#include "scratch.h"

// How depth is tested for a draw.
enum depth_mode {
    DEPTH_NONE,
    DEPTH_EARLY,       // tested and written before shading
    DEPTH_LATE,        // after: the fragment function writes depth
    DEPTH_EARLY_REJECT // tested before, tested again and written after: the fragment function may discard
};

enum phase {
    PHASE_ONLY,  // depth and shading, as submitted
    PHASE_DEPTH, // the first of two: depth alone, of draws that do not discard
    PHASE_SHADE,
    PHASE_BACKWARDS // the last triangle first, where no depth is tested: pixels that are open
};

// What a test has to do with open pixels.
enum open_rule {
    OPEN_IGNORED,
    OPEN_MARK, // what passes opens its pixel
    OPEN_TAKE, // only open pixels pass; they are not open any more
    OPEN_TRY,  // equal depth passes too where the pixel is open
    OPEN_CLOSE // as OPEN_TRY; what passes closes its pixel
};

struct depth_rule {
    enum rhw_compare compare;
    bool write;
    enum open_rule open;
};

// What opaque draws with LESS and GREATER ask for, in one phase and in two: constants for the loops that test.
enum common_rule { RULE_LESS, RULE_GREATER, RULE_MARK_LESS, RULE_MARK_GREATER, RULE_TAKE, RULE_OTHER };

// One worker's work on one tile.
struct tile_work {
    struct rhw_pass_state *pass;
    struct rhw_tile_scratch *scratch;
    struct rhw_counters *counters;
    int tile;          // its number, row by row
    int x, y;          // pixels of the tile's first pixel in the target
    int width, height; // pixels of the tile: fewer at the target's end
    enum phase phase;
    bool hit;          // a fragment passed a test with OPEN_MARK
    int open_count;    // open pixels, in PHASE_BACKWARDS
    int hiz_direction; // which way depth moves: see hiz_tmpl.h; 0 where it may move both ways

    // Of the draw whose fragments are collected:
    const struct rhw_draw *draw;
    const struct rhw_draw_state *state;
    const struct rhw_pipeline_data *pipeline;
    enum depth_mode depth_mode;
    struct depth_rule early, late; // late: after the fragment function
    enum common_rule common;       // which of them `early` is
    bool hiz_tests;                // fragments behind the tile's bounds fail the test
    bool skips;                    // nothing of it is drawn in this phase
    bool scissored;                // the scissor, or the target's end, leaves out pixels of the tile
    bool shades;                   // there is a fragment function
    bool constant;                 // that receives nothing: one call tells the colour of all fragments
    bool smooth;                   // smooth varyings and their derivatives are all it needs the weights for
    bool packs;                    // its groups can be packed
    bool wants;                    // the groups carry depth, facing or ids
    bool needs_depth;              // depth is tested or given to the fragment function
    bool keeps_depth;              // and the collected groups carry it

    bool constant_ready; // and it was made

    bool all_full;         // every group is 8 live pixels in a row
    int count;             // groups in the window
    int loose_count;       // fragments of the triangle under way that are in no group, see collect_tmpl.h
    int waiting_count;     // fragments of several triangles that wait for a group
    unsigned packed_count; // triangles packed so far
};
