// SPDX-License-Identifier: MIT
// See explain.h.
#include "explain.h"

#include <stdio.h>
#include <stdlib.h>

bool scene_draw_log_add(struct scene_draw_log *log, int32_t instance, const struct scene_surface *surface)
{
    if (log->count == log->capacity) {
        const uint32_t capacity = log->capacity ? 2 * log->capacity : 16;
        struct scene_drawn *const draws = realloc(log->draws, capacity * sizeof *draws);
        if (!draws) {
            return false;
        }
        log->draws = draws;
        log->capacity = capacity;
    }
    struct scene_drawn *const drawn = &log->draws[log->count++];
    *drawn = (struct scene_drawn){.instance = instance};
    if (surface) {
        drawn->surface = *surface;
    }
    return true;
}

void scene_draw_log_free(struct scene_draw_log *log)
{
    free(log->draws);
    *log = (struct scene_draw_log){0};
}

static const char *slot_name(const struct scene_surface *surface, int first)
{
    static const char *const names[SCENE_BASE_SLOTS] = {"base color", "metallic-roughness", "normal map",
                                                        "occlusion", "emission"};
    for (int slot = 0; slot < SCENE_SLOT_COUNT; slot++) {
        if (surface->slot_varying[slot] == first) {
            return slot < SCENE_BASE_SLOTS ? names[slot] : "a layer";
        }
    }
    return "nothing";
}

void scene_component_name(const struct scene_surface *s, int component, char name[SCENE_COMPONENT_NAME])
{
    const struct {
        int first, count;
        const char *name, *parts;
    } groups[] = {{s->varying_position, 3, "position", "xyz"},
                  {s->varying_normal, 3, "normal", "xyz"},
                  {s->varying_tangent, 4, "tangent", "xyzw"},
                  {s->varying_color, 4, "color", "rgba"},
                  {s->varying_disc, 2, "disc", "xy"}};
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) {
        const int part = component - groups[i].first;
        if (groups[i].first >= 0 && part >= 0 && part < groups[i].count) {
            snprintf(name, SCENE_COMPONENT_NAME, "%s %c", groups[i].name, groups[i].parts[part]);
            return;
        }
    }
    const int part = s->varying_uv >= 0 && component >= s->varying_uv ? (component - s->varying_uv) % 2 : -1;
    if (part >= 0) {
        snprintf(name, SCENE_COMPONENT_NAME, "uv of %s %c", slot_name(s, component - part), "uv"[part]);
    } else {
        snprintf(name, SCENE_COMPONENT_NAME, "component %d", component);
    }
}
