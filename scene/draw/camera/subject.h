// SPDX-License-Identifier: MIT
// What of a model a fitted picture is about: a ground or a sea that is hundreds of times larger than what stands on it would
// make that a dot.
#ifndef SCENE_SUBJECT_H
#define SCENE_SUBJECT_H

#include "model.h"

/// Where everything is that is not flat: thinner along one axis than a fiftieth of its longest side.
struct scene_subject {
    double low[3], high[3];
    bool is_all; ///< everything is flat
};

struct scene_subject scene_subject_find(const struct scene_model *model);
/// Whether an instance belongs to it: all do but flat ones that cover more than 100 times what the others do, seen along
/// the axis in which they are thin.
bool scene_subject_has(const struct scene_subject *subject, const struct scene_model *model,
                       uint32_t instance);

#endif
