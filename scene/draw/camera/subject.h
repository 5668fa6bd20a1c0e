// SPDX-License-Identifier: MIT
// What of a model a fitted picture is about. A ground or a sea that is hundreds of times larger than what stands on it
// would make all else a dot.
#ifndef SCENE_SUBJECT_H
#define SCENE_SUBJECT_H

#include "model.h"

/// The box of everything that is not flat. A thing is flat if it is thinner along one axis than a fiftieth of its
/// longest side.
struct scene_subject {
    double low[3], high[3];
    bool is_all; ///< everything is flat
};

struct scene_subject scene_subject_find(const struct scene_model *model);
/// Return true if an instance belongs to the subject. All instances belong to it but flat ones that cover more than 100
/// times what the others cover, seen along the axis in which they are thin.
bool scene_subject_has(const struct scene_subject *subject, const struct scene_model *model,
                       uint32_t instance);

#endif
