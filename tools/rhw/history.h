// SPDX-License-Identifier: MIT
// The history of a sample as rhw explain keeps it: the fragments that came to it, and what their triangles and varyings
// were.
#ifndef CLI_HISTORY_H
#define CLI_HISTORY_H

#include "draw/explain_light.h"
#include "model.h"

struct cli_past_fragment {
    struct rhw_explained_fragment told; ///< its arrays are those below; rows count from the top of the picture
    struct scene_drawn drawn;
    int look_count;
    struct scene_texture_look looks[SCENE_SLOT_COUNT];
    struct scene_light_looks light;
    float *values; ///< [4][component_count]: at the three vertices and at the sample
};

struct cli_history {
    struct cli_past_fragment *fragments;
    int count, capacity;
    bool failed; ///< out of memory
};

/// For scene_explain.fragment; `user` is the history.
void cli_history_add(void *user, const struct rhw_explained_fragment *fragment,
                     const struct scene_drawn *drawn, int first_row);
/// The last fragment that was written and shaded, or NULL: the one that is explained at length.
const struct cli_past_fragment *cli_history_seen(const struct cli_history *history);
void cli_history_free(struct cli_history *history);

/// "written", "discarded", ..
const char *cli_fate_name(enum rhw_fragment_fate fate);
/// The node of the model that a fragment belongs to; "background" and "ground" are none.
const char *cli_history_subject(const struct cli_past_fragment *fragment, const struct scene_model *model);
/// Its material; NULL: the background and the ground have none of the model's.
const struct scene_material *cli_history_material(const struct cli_past_fragment *fragment,
                                                  const struct scene_model *model);

#endif
