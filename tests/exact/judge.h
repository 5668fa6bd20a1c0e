// SPDX-License-Identifier: MIT
// Compares what a renderer drew of a scene with the oracle, sample by sample.
#ifndef EXACT_JUDGE_H
#define EXACT_JUDGE_H

#include <stdbool.h>
#include <stdint.h>

#include "probe.h"
#include "scene.h"
#include "tally.h"

// What is measured in ULP of the largest vertex value.
enum quantity {
    QUANTITY_SMOOTH,
    QUANTITY_NOPERSPECTIVE,
    QUANTITY_DEPTH,
    QUANTITY_INVERSE_W,
    QUANTITY_SPACE,      // a, b, c: of 1
    QUANTITY_SCREEN,     // r, s, t: of 1
    QUANTITY_DERIVATIVE, // of the largest d(weight)·value
    // sampling_judge.h:
    QUANTITY_SAMPLE,       // smooth and noperspective at every sample
    QUANTITY_CENTROID,     // the same at the centroid
    QUANTITY_SAMPLE_DEPTH, // at every sample
    QUANTITY_OFFSET,       // rhw_interpolate_at
    // primitive_judge.h:
    QUANTITY_POINT_COORD,     // of 1
    QUANTITY_LINE,            // smooth and noperspective along rectangular lines
    QUANTITY_BRESENHAM,       // the same along Bresenham lines, between their ends
    QUANTITY_PRIMITIVE_DEPTH, // of points and lines
    QUANTITY_COUNT
};

// What must be equal, to the last bit.
enum equality {
    EQUAL_COVERAGE, // which samples, how often
    EQUAL_OWNER,    // the triangle drawn last
    EQUAL_FLAT,
    EQUAL_CONSTANT,
    EQUAL_FACING,
    EQUAL_DEPTH,     // the depth attachment and the fragment's depth
    EQUAL_PLACE,     // where in its pixel a fragment of a multisampled pass has its values
    EQUAL_PRIMITIVE, // which pixels points and lines cover, how often
    EQUALITY_COUNT
};

struct judge_results {
    uint64_t scenes, triangles, fragments;
    uint64_t ambiguous; // scenes left out because a cut corner lies on a rounding tie
    uint64_t outside;   // fragments of a cut triangle that snapping moved off the triangle itself
    uint64_t family_fragments[FAMILY_COUNT];
    uint64_t unequal[EQUALITY_COUNT];
    struct tally_place unequal_at[EQUALITY_COUNT];       // the first one
    struct tally quantity[FAMILY_COUNT][QUANTITY_COUNT]; // smooth, noperspective: kinds up to VALUE_OPPOSITE
    struct tally kind[VALUE_KINDS][2];                   // smooth, noperspective; all families
};

struct judge_mode {
    // Another renderer: its own coverage, triangles on the grid only, noperspective only where no plane of the view
    // cuts (docs/exactness.md says why).
    bool peer;
    bool integers;         // every value through the integers, not only where doubles leave a doubt
    int derivative_stride; // check derivatives at one pixel of so many
};

struct judge;

const char *judge_quantity_name(enum quantity quantity);
const char *judge_equality_name(enum equality equality);

struct judge *judge_create(void);
void judge_destroy(struct judge *judge);
// Adds the scene to `results`. Call judge_prepare once per scene, then judge_compare for every renderer.
void judge_prepare(struct judge *judge, const struct scene *scene);
void judge_compare(struct judge *judge, const struct probe_image *image, const struct judge_mode *mode,
                   struct judge_results *results);
void judge_merge(struct judge_results *into, const struct judge_results *from);
// Prints everything the oracle and the image know about one pixel.
void judge_explain(struct judge *judge, const struct probe_image *image, int x, int y);

#endif
