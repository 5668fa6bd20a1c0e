// SPDX-License-Identifier: MIT
// Lighting in numbers. The studio's strengths were chosen by eye, on models from white plaster to black
// rubber, under one rule: a surface that faces the viewer comes out with about four fifths of its base
// colour and one that faces the key light with all of it, so that the neutral tone mapping keeps colours.
#include "light.h"

#include "draw/camera/subject.h"
#include "headlamp.h"
#include "panorama.h"

#include "rhw/shader.h"

#include <stdlib.h>

static const double pi = 3.14159265358979323846;

struct studio_lobe {
    double direction[3]; // camera space: right, up, back to the viewer
    double color[3];
};

static const double key_direction[3] = {-0.50, 0.62, 0.60};
static const double key_color[3] = {0.56, 0.535, 0.50}; // radiance of white that faces it
static const double key_size = 0.012;
static const double key_softness = 0.12, lamp_softness = 0.02;
static const double widest_cosine = 0.1; // cosine of the widest half angle within which a spot casts shadows
static const double sky_color[3] = {0.31, 0.33, 0.36};
static const double ground_color[3] = {0.18, 0.17, 0.16};
static const double lobe_sharpness = 9.0;
static const struct studio_lobe studio_lobes[SCENE_LOBES] = {
    {{-0.55, 0.75, 0.35}, {1.55, 1.50, 1.42}}, // large, above and to the left
    {{0.80, 0.12, 0.55}, {0.62, 0.70, 0.80}},  // fill from the right
    {{0.30, 0.55, -0.80}, {1.10, 1.15, 1.25}}, // rim from behind
};

static double power_of_two(double exponent)
{
    return (double)rhw_exp2(rhw_splat((float)exponent))[0];
}

// Camera space to world, made unit.
static void to_world(const double view[16], const double direction[3], float world[3])
{
    double length2 = 0.0, turned[3];
    for (int i = 0; i < 3; i++) {
        turned[i] =
            view[4 * i] * direction[0] + view[4 * i + 1] * direction[1] + view[4 * i + 2] * direction[2];
        length2 += turned[i] * turned[i];
    }
    const double length = __builtin_sqrt(length2);
    for (int i = 0; i < 3; i++) {
        world[i] = (float)(turned[i] / length);
    }
}

// The zonal harmonics of exp(λ (t − 1)) to order 2, times those of the clamped cosine over π, gathered by
// powers of t (Ramamoorthi and Hanrahan 2001).
static void lobe_diffuse(double lambda, float coefficients[3])
{
    const double tail = power_of_two(-2.0 * lambda * 1.44269504088896341);
    const double moment0 = (1.0 - tail) / lambda;
    const double moment1 = (1.0 + tail) / lambda - moment0 / lambda;
    const double moment2 = moment0 - 2.0 * moment1 / lambda;
    const double f0 = 0.5 * moment0, f1 = 1.5 * moment1, f2 = 2.5 * (1.5 * moment2 - 0.5 * moment0);
    coefficients[0] = (float)(f0 - f2 / 8.0);
    coefficients[1] = (float)(f1 * 2.0 / 3.0);
    coefficients[2] = (float)(f2 * 3.0 / 8.0);
}

static void set_environment(struct scene_environment *e, const double view[16], enum scene_axis up,
                            double scale)
{
    double upward[3] = {0.0, 1.0, 0.0};
    scene_axis_turn(up, upward);
    for (int i = 0; i < 3; i++) {
        e->up[i] = (float)upward[i];
    }
    e->sharpness = (float)lobe_sharpness;
    lobe_diffuse(lobe_sharpness, e->diffuse);
    for (int c = 0; c < 3; c++) {
        e->sky[c] = (float)(sky_color[c] * scale);
        e->ground[c] = (float)(ground_color[c] * scale);
        for (int i = 0; i < SCENE_LOBES; i++) {
            e->lobe_color[i][c] = (float)(studio_lobes[i].color[c] * scale);
        }
    }
    for (int i = 0; i < SCENE_LOBES; i++) {
        to_world(view, studio_lobes[i].direction, e->lobe_direction[i]);
    }
}

static void set_key(struct scene_shader_light *key, const double view[16], double scale)
{
    *key = (struct scene_shader_light){
        .type = SCENE_LIGHT_DIRECTIONAL, .size = (float)key_size, .softness = (float)key_softness};
    to_world(view, key_direction, key->direction);
    for (int c = 0; c < 3; c++) {
        key->color[c] = (float)(key_color[c] * pi * scale);
    }
}

static double luminance(const float color[3])
{
    return 0.2126 * (double)color[0] + 0.7152 * (double)color[1] + 0.0722 * (double)color[2];
}

// Irradiance that the lights of the file give at the middle of the model, on a surface that faces them all.
// A light nearer than a quarter of the model's radius counts as if it stood there.
static double reference_irradiance(const struct scene_model *model, const struct scene_headlamp *headlamp)
{
    const struct scene_box frame = scene_subject_frame(model);
    double middle[3], radius2 = 0.0, sum = 0.0;
    for (int i = 0; i < 3; i++) {
        const double low = frame.low[i], high = frame.high[i];
        middle[i] = 0.5 * (low + high);
        radius2 += 0.25 * (high - low) * (high - low);
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        const struct scene_model_light light = scene_headlamp_carry(headlamp, &model->lights[i]);
        double falloff = 1.0;
        if (light.type != SCENE_LIGHT_DIRECTIONAL) {
            double distance2 = 0.0;
            for (int c = 0; c < 3; c++) {
                const double d = (double)light.position[c] - middle[c];
                distance2 += d * d;
            }
            const double nearest = radius2 / 16.0;
            falloff = 1.0 / (distance2 > nearest ? distance2 : nearest);
        }
        sum += luminance(light.color) * (double)light.intensity * falloff;
    }
    return sum;
}

static void set_light(struct scene_shader_light *light, const struct scene_model_light *source, double scale)
{
    *light = (struct scene_shader_light){.type = source->type, .casts = 1, .softness = (float)lamp_softness};
    const bool directional = source->type == SCENE_LIGHT_DIRECTIONAL;
    for (int c = 0; c < 3; c++) {
        light->position[c] = source->position[c];
        light->direction[c] = directional ? -source->direction[c] : source->direction[c];
        light->color[c] = (float)((double)source->color[c] * (double)source->intensity * scale);
    }
    light->inverse_range = source->range > 0.0f ? 1.0f / source->range : 0.0f;
    const float width = source->inner_cos - source->outer_cos;
    light->spot_scale = 1.0f / (width > 0.001f ? width : 0.001f);
    light->spot_offset = -source->outer_cos * light->spot_scale;
    const double cosine =
        (double)source->outer_cos > widest_cosine ? (double)source->outer_cos : widest_cosine;
    light->spread = (float)(__builtin_sqrt(1.0 - cosine * cosine) / cosine);
}

bool scene_lighting_create(struct scene_lighting *lighting, const struct scene_model *model,
                           const struct scene_camera *camera, enum scene_axis up, bool default_lights,
                           double exposure)
{
    const double stops = power_of_two(exposure);
    double view[16];
    scene_camera_view(camera, view);
    *lighting = (struct scene_lighting){.count = 1};
    const struct scene_headlamp headlamp = scene_headlamp_find(model, camera);
    const double irradiance = default_lights ? 0.0 : reference_irradiance(model, &headlamp);
    const bool from_file = irradiance > 0.0 && irradiance < 1e30;
    lighting->from_file = from_file;
    if (from_file) {
        lighting->count = model->light_count;
    }
    lighting->lights = calloc(lighting->count, sizeof *lighting->lights);
    if (!lighting->lights) {
        return false;
    }
    if (!from_file) {
        set_key(&lighting->lights[0], view, stops);
        const struct scene_box frame = scene_subject_frame(model);
        lighting->lights[0].casts = !scene_box_surrounds(&frame, camera->eye);
        set_environment(&lighting->environment, view, up, stops);
        return true;
    }
    const double white = 0.9 * pi / irradiance;
    for (uint32_t i = 0; i < lighting->count; i++) {
        const struct scene_model_light light = scene_headlamp_carry(&headlamp, &model->lights[i]);
        set_light(&lighting->lights[i], &light, white * stops);
    }
    set_environment(&lighting->environment, view, up, 0.25 * stops);
    return true;
}

void scene_lighting_surround(struct scene_lighting *lighting, const struct scene_surroundings *surroundings,
                             double exposure)
{
    const float scale = (float)power_of_two(exposure);
    struct scene_environment *e = &lighting->environment;
    *e = surroundings->environment;
    e->strength *= scale;
    for (int i = 0; i < 27; i++) {
        e->irradiance[i / 3][i % 3] *= scale;
    }
    if (!lighting->from_file && lighting->count > 0) { // in place of the key light
        struct scene_shader_light *sun = &lighting->lights[0];
        *sun = surroundings->sun;
        sun->casts = 1;
        sun->softness = (float)lamp_softness;
        for (int c = 0; c < 3; c++) {
            sun->color[c] *= scale;
        }
        lighting->count = sun->color[1] > 0.0f ? 1 : 0;
    }
}

void scene_lighting_destroy(struct scene_lighting *lighting)
{
    free(lighting->lights);
    *lighting = (struct scene_lighting){0};
}
