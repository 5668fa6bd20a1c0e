// SPDX-License-Identifier: MIT
#include "fragment_shader.h"

#include "draw/material_program.h"
#include "fragment_program.h"
#include "shader_job.h"

#include <glsl_names.h>

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

// Put things of one kind where their names belong. Report a name that is none of those.
static bool place(const struct cli_shader_file *file, enum glsl_thing thing,
                  const struct cli_fragment_known *known, uint32_t count, const char *noun)
{
    struct glsl_place places[CLI_FRAGMENT_MEMBERS];
    for (uint32_t i = 0; i < count; i++) {
        places[i] = (struct glsl_place){.name = known[i].name, .number = known[i].number};
    }
    const struct glsl_code code = {.words = file->words, .size = file->size};
    const char *const unknown = glsl_place(&code, thing, places, count);
    if (unknown) {
        cli_error(file->path,
                  "there is no %s '%.60s', and what has no location or binding goes by its name; %s", noun,
                  unknown, cli_fragment_hint);
    }
    return !unknown;
}

// A text as OpenGL has it says what things are called, and not where they are.
static bool place_names(const struct cli_shader_file *file)
{
    static const struct cli_fragment_known resources[] = {
        {"gl_DefaultUniformBlock", SCENE_PROGRAM_BLOCK, 0},
        {"Scene", SCENE_PROGRAM_BLOCK, 0},
        {"base_color_texture", SCENE_PROGRAM_BASE_COLOR, 0}};
    return !file->is_relaxed ||
           (place(file, GLSL_INPUT, cli_fragment_inputs, CLI_FRAGMENT_INPUTS, "input") &&
            place(file, GLSL_RESOURCE, resources, sizeof resources / sizeof *resources, "block or texture") &&
            place(file, GLSL_UNIFORM, cli_fragment_members, CLI_FRAGMENT_MEMBERS, "uniform"));
}

rhw_shader_program *cli_fragment_shader_open(const char *path)
{
    struct cli_shader_job job = {.print = CLI_SHADER_NOTHING, .is_relaxed = true, .shades_models = true};
    struct cli_shader_file file;
    rhw_shader_program *program = NULL;
    if (cli_shader_file_open(&file, path, &job) && place_names(&file) &&
        cli_shader_file_translate(&file, &job)) {
        program = cli_fragment_program_create(path, file.shader, file.is_relaxed);
    }
    cli_shader_file_close(&file);
    return program;
}
