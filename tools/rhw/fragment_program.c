// SPDX-License-Identifier: MIT
// See fragment_program.h.
#include "fragment_program.h"

#include "draw/material_program.h"
#include "message.h"
#include "shader_name.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

static const uint32_t vertex_words[] = {
#include "material.inc"
};

const char cli_fragment_hint[] = "rhw render --fragment-shader-template shows what there is";

const struct cli_fragment_known cli_fragment_inputs[CLI_FRAGMENT_INPUTS] = {
    {"position", SCENE_PROGRAM_POSITION, 3},
    {"normal", SCENE_PROGRAM_NORMAL, 3},
    {"uv", SCENE_PROGRAM_UV, 2},
    {"vertex_color", SCENE_PROGRAM_COLOR, 4}};

const struct cli_fragment_known cli_fragment_members[CLI_FRAGMENT_MEMBERS] = {
    {"camera", offsetof(struct scene_program_block, camera), 4},
    {"light", offsetof(struct scene_program_block, light), 4},
    {"light_color", offsetof(struct scene_program_block, light_color), 3},
    {"alpha_cutoff", offsetof(struct scene_program_block, alpha_cutoff), 1},
    {"base_color", offsetof(struct scene_program_block, base_color), 4},
    {"emissive", offsetof(struct scene_program_block, emissive), 3},
    {"metallic", offsetof(struct scene_program_block, metallic), 1},
    {"roughness", offsetof(struct scene_program_block, roughness), 1}};

// Report a uniform of a text as OpenGL has it that is of another type.
static bool check_members(const char *path, const struct rhw_shader_type *type)
{
    for (uint32_t i = 0; type && i < type->count; i++) {
        const struct rhw_shader_member *const member = &type->members[i];
        for (int k = 0; k < CLI_FRAGMENT_MEMBERS; k++) {
            const struct rhw_shader_type *const own = member->type;
            if (strcmp(member->name, cli_fragment_members[k].name) == 0 &&
                (own->kind != RHW_SHADER_FLOAT || own->columns != 1 ||
                 own->rows != cli_fragment_members[k].rows)) {
                char name[CLI_SHADER_TYPE_NAME], wanted[CLI_SHADER_TYPE_NAME];
                cli_shader_name_type(own, name);
                cli_shader_name_type(
                    &(struct rhw_shader_type){.bits = 32, .rows = cli_fragment_members[k].rows, .columns = 1},
                    wanted);
                cli_error(path, "uniform '%s' is a %s, and there it is a %s; %s", member->name, name, wanted,
                          cli_fragment_hint);
                return false;
            }
        }
    }
    return true;
}

// What there is ----------------------------------------------------------------------------------------

// Report a resource that there is nothing for.
static bool check_resource(const char *path, const struct rhw_shader_resource *r)
{
    char image[CLI_SHADER_TYPE_NAME];
    char place[120];
    cli_shader_name_image(r, image);
    snprintf(place, sizeof place, "'%.60s' at set %u, binding %u", r->name, (unsigned)r->set,
             (unsigned)r->binding);
    if (r->set != 0 || r->binding >= SCENE_PROGRAM_BINDINGS) {
        cli_error(path,
                  "there is nothing for %s; set 0 has a uniform block at binding %d and a sampler2D at "
                  "binding %d; %s",
                  place, SCENE_PROGRAM_BLOCK, SCENE_PROGRAM_BASE_COLOR, cli_fragment_hint);
    } else if (r->count != 1) {
        cli_error(path, "%s is an array, and there is one; %s", place, cli_fragment_hint);
    } else if (r->binding == SCENE_PROGRAM_BLOCK && r->kind != RHW_SHADER_UNIFORM_BUFFER) {
        cli_error(path, "%s is no uniform block, which is what is there; %s", place, cli_fragment_hint);
    } else if (r->binding == SCENE_PROGRAM_BLOCK && r->size > sizeof(struct scene_program_block)) {
        cli_error(path, "%s has %u bytes, and the block that is there %zu; %s", place, (unsigned)r->size,
                  sizeof(struct scene_program_block), cli_fragment_hint);
    } else if (r->binding == SCENE_PROGRAM_BASE_COLOR && strcmp(image, "sampler2D") != 0) {
        cli_error(path, "%s is no sampler2D, which is what is there; %s", place, cli_fragment_hint);
    } else {
        return true;
    }
    return false;
}

// Report an input that there is nothing for.
static bool check_input(const char *path, const struct rhw_shader_variable *v)
{
    const bool is_there = v->location < CLI_FRAGMENT_INPUTS;
    if (is_there && !v->is_integer && v->component + v->components <= cli_fragment_inputs[v->location].rows) {
        return true;
    }
    char type[CLI_SHADER_TYPE_NAME];
    cli_shader_name_variable(v, type);
    if (is_there) {
        cli_error(path, "reads '%.60s' at location %u as a %s, and %s is there, a vec%u; %s", v->name,
                  (unsigned)v->location, type, cli_fragment_inputs[v->location].name,
                  (unsigned)cli_fragment_inputs[v->location].rows, cli_fragment_hint);
    } else {
        cli_error(path, "reads '%.60s' at location %u, and the last input is at %d; %s", v->name,
                  (unsigned)v->location, CLI_FRAGMENT_INPUTS - 1, cli_fragment_hint);
    }
    return false;
}

// Report an output that nothing is done with.
static bool check_output(const char *path, const struct rhw_shader_variable *v)
{
    if (v->location == 0 && v->index == 0 && !v->is_integer) {
        return true;
    }
    char type[CLI_SHADER_TYPE_NAME];
    cli_shader_name_variable(v, type);
    cli_error(path, "writes '%.60s', a %s at location %u, and only a vec4 at location 0 is drawn; %s",
              v->name, type, (unsigned)v->location, cli_fragment_hint);
    return false;
}

// Report what a shader has that there is nothing for.
static bool check(const char *path, const rhw_shader *shader, bool is_relaxed)
{
    static const char *const stages[RHW_SHADER_STAGE_COUNT] = {"vertex", "fragment", "compute"};
    const struct rhw_shader_info *const info = rhw_shader_get_info(shader);
    if (info->stage != RHW_SHADER_FRAGMENT) {
        cli_error(path, "is a %s shader, and no fragment shader", stages[info->stage]);
        return false;
    }
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const r = &info->resources[i];
        if (!check_resource(path, r) || (is_relaxed && !check_members(path, r->type))) {
            return false;
        }
    }
    for (uint32_t i = 0; i < info->input_count; i++) {
        if (!check_input(path, &info->inputs[i])) {
            return false;
        }
    }
    if (info->push_size > 0) {
        cli_error(path, "has push constants, which nothing sets; %s", cli_fragment_hint);
        return false;
    }
    if (info->output_count == 0) {
        cli_error(path, "writes no colour, which is a vec4 at location 0; %s", cli_fragment_hint);
        return false;
    }
    for (uint32_t i = 0; i < info->output_count; i++) {
        if (!check_output(path, &info->outputs[i])) {
            return false;
        }
    }
    return true;
}

static rhw_shader_program *link_shader(const char *path, const rhw_shader *fragment)
{
    static const struct rhw_shader_layout layout[SCENE_PROGRAM_BINDINGS] = {
        {.binding = SCENE_PROGRAM_BLOCK, .count = 1}, {.binding = SCENE_PROGRAM_BASE_COLOR, .count = 1}};
    char message[RHW_SHADER_MESSAGE] = "";
    rhw_shader *vertex;
    rhw_shader_program *program = NULL;
    const struct rhw_shader_def vertex_def = {.stage = RHW_SHADER_VERTEX};
    enum rhw_result result =
        rhw_shader_create(vertex_words, sizeof vertex_words, &vertex_def, &vertex, message);
    if (result == RHW_OK) {
        const struct rhw_shader_program_def def = {
            .vertex = vertex, .fragment = fragment, .layout = layout, .layout_count = SCENE_PROGRAM_BINDINGS};
        result = rhw_shader_program_create(&def, &program, message);
    }
    rhw_shader_destroy(vertex);
    if (result != RHW_OK) {
        cli_error(path, "%s", message);
    }
    return program;
}

rhw_shader_program *cli_fragment_program_create(const char *path, const rhw_shader *fragment, bool is_relaxed)
{
    return check(path, fragment, is_relaxed) ? link_shader(path, fragment) : NULL;
}
