// SPDX-License-Identifier: MIT
#include "fragment_shader.h"

#include "draw/material_program.h"
#include "shader_job.h"

static const uint32_t vertex_words[] = {
#include "material.inc"
};

const char cli_fragment_shader_template[] =
    "#version 450\n"
    "// A fragment shader for rhw render --fragment-shader. What a shader does not read it may leave out.\n"
    "layout(location = 0) in vec3 position;     // in the world\n"
    "layout(location = 1) in vec3 normal;       // in the world, of the front side\n"
    "layout(location = 2) in vec2 uv;           // for base_color_texture\n"
    "layout(location = 3) in vec4 vertex_color; // linear; 1, 1, 1, 1 where the model has none\n"
    "\n"
    "layout(set = 0, binding = 0) uniform Scene {\n"
    "    vec4 camera;        // where it is, and 1; with --ortho the direction to it, and 0\n"
    "    vec4 light;         // where the first light is, and 1; of a far one the direction to it, and 0\n"
    "    vec3 light_color;   // 0, 0, 0 without a light\n"
    "    float alpha_cutoff; // fragments of less alpha are holes\n"
    "    vec4 base_color;    // of the material: what its texture and the vertex colors are multiplied by\n"
    "    vec3 emissive;\n"
    "    float metallic;\n"
    "    float roughness;\n"
    "};\n"
    "layout(set = 0, binding = 1) uniform sampler2D base_color_texture; // white where there is none\n"
    "\n"
    "layout(location = 0) out vec4 color; // linear, as a screen shows it; alpha counts where the material "
    "blends\n"
    "\n"
    "void main()\n"
    "{\n"
    "    vec4 base = base_color * vertex_color * texture(base_color_texture, uv);\n"
    "    if (base.a < alpha_cutoff) {\n"
    "        discard;\n"
    "    }\n"
    "    vec3 n = normalize(gl_FrontFacing ? normal : -normal);\n"
    "    vec3 to_light = normalize(light.xyz - light.w * position);\n"
    "    vec3 to_camera = normalize(camera.xyz - camera.w * position);\n"
    "    float diffuse = max(dot(n, to_light), 0.0);\n"
    "    float edge = pow(1.0 - max(dot(n, to_camera), 0.0), 3.0);\n"
    "    color = vec4(base.rgb * (0.15 + 0.85 * diffuse) + 0.2 * edge, base.a);\n"
    "}\n";

// Report what a shader has that there is nothing for.
static bool check(const char *path, const struct rhw_shader_info *info)
{
    static const enum rhw_shader_resource_kind kinds[SCENE_PROGRAM_BINDINGS] = {
        [SCENE_PROGRAM_BLOCK] = RHW_SHADER_UNIFORM_BUFFER,
        [SCENE_PROGRAM_BASE_COLOR] = RHW_SHADER_SAMPLED_TEXTURE};
    const char *const hint = "rhw render --fragment-shader-template shows what there is";
    if (info->stage != RHW_SHADER_FRAGMENT) {
        cli_error(path, "is no fragment shader");
        return false;
    }
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const r = &info->resources[i];
        if (r->set != 0 || r->binding >= SCENE_PROGRAM_BINDINGS || r->kind != kinds[r->binding] ||
            r->count != 1 || r->size > sizeof(struct scene_program_block) ||
            r->texture_kind != RHW_TEXTURE_2D || r->is_array || r->is_multisampled || r->is_integer) {
            cli_error(path, "there is no such '%s' at set %u, binding %u; %s", r->name, (unsigned)r->set,
                      (unsigned)r->binding, hint);
            return false;
        }
    }
    if (info->push_size > 0) {
        cli_error(path, "there are no push constants; %s", hint);
        return false;
    }
    if (info->output_count == 0) {
        cli_error(path, "writes no colour, which is a vec4 at location 0; %s", hint);
        return false;
    }
    for (uint32_t i = 0; i < info->output_count; i++) {
        if (info->outputs[i].location != 0 || info->outputs[i].is_integer) {
            cli_error(path, "writes '%s' at location %u, and only a vec4 at location 0 is drawn; %s",
                      info->outputs[i].name, (unsigned)info->outputs[i].location, hint);
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

rhw_shader_program *cli_fragment_shader_open(const char *path)
{
    struct cli_shader_job job = {.print = CLI_SHADER_NOTHING};
    struct cli_shader_file file;
    rhw_shader_program *program = NULL;
    if (cli_shader_file_open(&file, path, &job) && check(path, rhw_shader_get_info(file.shader))) {
        program = link_shader(path, file.shader);
    }
    cli_shader_file_close(&file);
    return program;
}
