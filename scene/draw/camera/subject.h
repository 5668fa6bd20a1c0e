// SPDX-License-Identifier: MIT
// What of a model a fitted picture is about. A ground or a sea that is hundreds of times larger than what stands on it
// would make all else a dot.
#ifndef SCENE_SUBJECT_H
#define SCENE_SUBJECT_H

#include "box.h"
#include "model.h"

/// Return the model's frame.
struct scene_box scene_subject_frame(const struct scene_model *model);

/// Return the box of what the model's frame holds, which is the frame with room for rounding, or all of space for a
/// model without one.
struct scene_box scene_subject_room(const struct scene_model *model);

/// Write where an instance puts a point of its mesh, as exactly as it is known.
void scene_subject_place(const struct scene_instance *instance, const double point[3], double place[3]);

/// Return the box around the corners of an instance's own box, in the world.
struct scene_box scene_subject_box(const struct scene_model *model, uint32_t instance);

/// Write the box of an instance to `box`. Return the axis in which it is thinner than a fiftieth of its longest side.
/// Return −1 if there is none.
int scene_subject_thin_axis(const struct scene_model *model, uint32_t instance, struct scene_box *box);

/// Return true if a box, which is thin along an axis, covers more than 100 times what another one covers, seen along
/// that axis. An axis of −1 is none.
bool scene_subject_is_ground(const struct scene_box *box, int axis, const struct scene_box *other);

/// The box of everything within the frame that is seen and is not thin, or the frame if everything is thin.
struct scene_subject {
    struct scene_box box;
    bool is_all; ///< everything is thin
};

struct scene_subject scene_subject_find(const struct scene_model *model);
/// Return true if an instance belongs to the subject. All that are seen do, but those that are a ground for it.
bool scene_subject_has(const struct scene_subject *subject, const struct scene_model *model,
                       uint32_t instance);

#endif
