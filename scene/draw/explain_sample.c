// SPDX-License-Identifier: MIT
// See explain_sample.h.
#include "explain_sample.h"

#include "rhw/shader.h"

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

// Textures ------------------------------------------------------------------------------------------

const char *scene_slot_name(enum scene_slot slot)
{
    static const char *const names[SCENE_BASE_SLOTS] = {"base color", "metallic-roughness", "normal map",
                                                        "occlusion", "emission"};
    return slot < SCENE_BASE_SLOTS ? names[slot] : "a layer";
}

// Take the four texels of a level around u, v, as the sampler's address mode finds them: a sample at the middle of each
// gives the texel.
static void look_around(const struct rhw_explained_fragment *fragment, int unit, const float uv[2], int level,
                        float texels[4][4])
{
    const rhw_int number = rhw_splat_int(level);
    const rhw_float lod = rhw_splat((float)level);
    rhw_int size[3];
    rhw_sample_size(fragment->bindings, unit, &number, size);
    rhw_float at[2], texel[4];
    for (int i = 0; i < 2; i++) {
        const float side = (float)(size[i][0] > 0 ? size[i][0] : 1);
        const float first = rhw_floor(rhw_splat(uv[i] * side - 0.5f))[0];
        for (int lane = 0; lane < RHW_LANES; lane++) {
            at[i][lane] = (first + 0.5f + (float)(lane >> i & 1)) / side;
        }
    }
    const struct rhw_sample_request request = {.coordinates = at, .lod = &lod};
    rhw_sample(fragment->bindings, unit, &request, texel);
    for (int i = 0; i < 4; i++) {
        for (int c = 0; c < 4; c++) {
            texels[i][c] = texel[c][i];
        }
    }
}

// The library samples 8 places at once: all of them are this one.
static void look_at(const struct rhw_explained_fragment *fragment, int unit, int first,
                    struct scene_texture_look *look)
{
    const rhw_float uv[2] = {rhw_splat(fragment->varyings[first]), rhw_splat(fragment->varyings[first + 1])};
    const rhw_float gradient[4] = {rhw_splat(fragment->ddx[first]), rhw_splat(fragment->ddx[first + 1]),
                                   rhw_splat(fragment->ddy[first]), rhw_splat(fragment->ddy[first + 1])};
    const struct rhw_sample_request request = {.coordinates = uv, .gradient = gradient};
    rhw_float lod[2], texel[4];
    rhw_int size[3];
    rhw_sample(fragment->bindings, unit, &request, texel);
    rhw_sample_query_lod(fragment->bindings, unit, &request, lod);
    look->level = lod[0][0];
    look->lod = lod[1][0];
    look->is_enlarged = lod[1][0] <= 0.0f; // Vulkan 1.3, Texel Filtering
    rhw_sample_size(fragment->bindings, unit, NULL, size);
    look->base_width = size[0][0];
    look->base_height = size[1][0];
    const rhw_int level = rhw_splat_int((int)look->level);
    rhw_sample_size(fragment->bindings, unit, &level, size);
    look->width = size[0][0];
    look->height = size[1][0];
    for (int i = 0; i < 2; i++) {
        look->uv[i] = fragment->varyings[first + i];
        look->step[0][i] = fragment->ddx[first + i];
        look->step[1][i] = fragment->ddy[first + i];
        look->place[i] = look->uv[i] * (float)size[i][0] - 0.5f;
    }
    for (int c = 0; c < 4; c++) {
        look->texel[c] = texel[c][0];
    }
    for (int i = 0; i < 2; i++) {
        look_around(fragment, unit, look->uv, (int)look->level + i, look->texels[i]);
    }
}

int scene_texture_looks(const struct rhw_explained_fragment *fragment, const struct scene_surface *surface,
                        struct scene_texture_look looks[SCENE_SLOT_COUNT])
{
    int count = 0;
    for (int slot = 0; slot < SCENE_SLOT_COUNT && fragment->is_shaded; slot++) {
        const int first = surface->slot_varying[slot];
        if (first >= 0 && fragment->bindings) {
            looks[count].slot = (enum scene_slot)slot;
            look_at(fragment, surface->slot_unit[slot], first, &looks[count++]);
        }
    }
    return count;
}

// Names ---------------------------------------------------------------------------------------------

static const char *stream_name(const struct scene_surface *surface, int first)
{
    for (int slot = 0; slot < SCENE_SLOT_COUNT; slot++) {
        if (surface->slot_varying[slot] == first) {
            return scene_slot_name((enum scene_slot)slot);
        }
    }
    return "nothing";
}

void scene_component_name(const struct scene_surface *s, int component, char name[SCENE_COMPONENT_NAME])
{
    const struct {
        int first, count;
        const char *name, *parts;
    } groups[] = {{s->varying_position, 3, "position", "xyz"}, {s->varying_normal, 3, "normal", "xyz"},
                  {s->varying_tangent, 4, "tangent", "xyzw"},  {s->varying_color, 4, "color", "rgba"},
                  {s->varying_support, 1, "plane", "d"},       {s->varying_disc, 2, "disc", "xy"}};
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) {
        const int part = component - groups[i].first;
        if (groups[i].first >= 0 && part >= 0 && part < groups[i].count) {
            snprintf(name, SCENE_COMPONENT_NAME, "%s %c", groups[i].name, groups[i].parts[part]);
            return;
        }
    }
    const int part = s->varying_uv >= 0 && component >= s->varying_uv ? (component - s->varying_uv) % 2 : -1;
    if (part >= 0) {
        snprintf(name, SCENE_COMPONENT_NAME, "uv of %s %c", stream_name(s, component - part), "uv"[part]);
    } else {
        snprintf(name, SCENE_COMPONENT_NAME, "component %d", component);
    }
}
