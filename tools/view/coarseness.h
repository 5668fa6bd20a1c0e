// SPDX-License-Identifier: MIT
// How coarse a picture of something that moves is, so that it takes no longer than the eye wants to wait: but no
// coarser than gains time. What pixels cost goes with fewer of them; what a model of many triangles costs stays.
#ifndef VIEW_COARSENESS_H
#define VIEW_COARSENESS_H

#include <stdbool.h>

/// Levels: 0 is a picture in full, each further one does without something more.
enum { VIEW_COARSENESS_LEVELS = 6, VIEW_COARSENESS_FIRST = 3 };

/// What a level does without.
struct view_coarse_look {
    int divisor;     ///< of width and height
    bool one_sample; ///< for each pixel
    bool plain;      ///< no shadows, no ambient occlusion
};

struct view_coarseness {
    int level;                         ///< of the next picture in a hurry
    int last;                          ///< beyond it nothing is gained
    double ms[VIEW_COARSENESS_LEVELS]; ///< what the last picture of each took; 0: none did
};

/// Of a model that was not drawn yet: in a hurry it is coarse at once.
struct view_coarseness view_coarseness_start(void);
struct view_coarse_look view_coarseness_look(int level);
/// Learns what a picture of `level` took, drawn in a hurry or at rest, and chooses the next level.
void view_coarseness_learn(struct view_coarseness *coarseness, int level, bool hurried, double ms);

#endif
