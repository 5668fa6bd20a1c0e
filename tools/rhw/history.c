// SPDX-License-Identifier: MIT
// See history.h.
#include "history.h"

#include <stdlib.h>
#include <string.h>

static bool grow(struct cli_history *history)
{
    const int capacity = history->capacity ? 2 * history->capacity : 16;
    struct cli_past_fragment *const fragments =
        realloc(history->fragments, (size_t)capacity * sizeof *fragments);
    if (fragments) {
        history->fragments = fragments;
        history->capacity = capacity;
    }
    return fragments != NULL;
}

// Copies what the library keeps during the call alone.
static bool keep_values(struct cli_past_fragment *past, const struct rhw_explained_fragment *from)
{
    const size_t count = (size_t)from->component_count, size = count * sizeof *past->values;
    past->values = calloc(4 * count + 1, sizeof *past->values);
    if (!past->values) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        memcpy(past->values + (size_t)i * count, from->vertex_varyings[i], size);
        past->told.vertex_varyings[i] = past->values + (size_t)i * count;
    }
    memcpy(past->values + 3 * count, from->varyings, size);
    past->told.varyings = past->values + 3 * count;
    past->told.ddx = past->told.ddy = NULL;
    past->told.bindings = NULL;
    return true;
}

void cli_history_add(void *user, const struct rhw_explained_fragment *fragment,
                     const struct scene_drawn *drawn, int first_row)
{
    struct cli_history *const history = user;
    if (history->failed || (history->count == history->capacity && !grow(history))) {
        history->failed = true;
        return;
    }
    struct cli_past_fragment *const past = &history->fragments[history->count];
    *past = (struct cli_past_fragment){.told = *fragment, .drawn = *drawn};
    if (drawn->instance >= 0) {
        past->look_count = scene_texture_looks(fragment, &drawn->surface, past->looks);
        scene_light_looks(fragment, &drawn->surface, &past->light);
    }
    if (!keep_values(past, fragment)) {
        history->failed = true;
        return;
    }
    past->told.sample_y += first_row * 256;
    for (int i = 0; i < 3 && fragment->is_snapped; i++) {
        past->told.y[i] += first_row * 256;
    }
    history->count++;
}

const struct cli_past_fragment *cli_history_seen(const struct cli_history *history)
{
    for (int i = history->count - 1; i >= 0; i--) {
        const struct cli_past_fragment *const past = &history->fragments[i];
        if (past->told.fate == RHW_FRAGMENT_WRITTEN && past->told.is_shaded &&
            past->drawn.instance != SCENE_DRAWN_BACKGROUND) {
            return past;
        }
    }
    return NULL;
}

void cli_history_free(struct cli_history *history)
{
    for (int i = 0; i < history->count; i++) {
        free(history->fragments[i].values);
    }
    free(history->fragments);
    *history = (struct cli_history){0};
}

const char *cli_fate_name(enum rhw_fragment_fate fate)
{
    static const char *const names[] = {[RHW_FRAGMENT_FAILED_EARLY] = "fails the depth test",
                                        [RHW_FRAGMENT_DISCARDED] = "discarded by its shader",
                                        [RHW_FRAGMENT_FAILED_LATE] = "fails the depth test after its shader",
                                        [RHW_FRAGMENT_WRITTEN] = "written"};
    return names[fate];
}

const char *cli_history_subject(const struct cli_past_fragment *fragment, const struct scene_model *model)
{
    const int32_t instance = fragment->drawn.instance;
    return instance == SCENE_DRAWN_BACKGROUND ? "background"
           : instance == SCENE_DRAWN_GROUND   ? "ground"
           : model->instances[instance].name  ? model->instances[instance].name
                                              : "";
}

const struct scene_material *cli_history_material(const struct cli_past_fragment *fragment,
                                                  const struct scene_model *model)
{
    const int32_t instance = fragment->drawn.instance;
    return instance < 0 ? NULL : &model->materials[model->meshes[model->instances[instance].mesh].material];
}
