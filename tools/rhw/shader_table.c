// SPDX-License-Identifier: MIT
// What shaders are, as a table and as JSON; see shader_job.h.
#include "json.h"
#include "shader_job.h"

#include <stdio.h>

static const char *const kind_names[] = {
    [RHW_SHADER_UNIFORM_BUFFER] = "uniform buffer",
    [RHW_SHADER_STORAGE_BUFFER] = "storage buffer",
    [RHW_SHADER_SAMPLED_TEXTURE] = "sampled texture",
    [RHW_SHADER_TEXTURE] = "texture",
    [RHW_SHADER_SAMPLER] = "sampler",
    [RHW_SHADER_STORAGE_IMAGE] = "storage image",
    [RHW_SHADER_TEXEL_BUFFER] = "texel buffer",
    [RHW_SHADER_INPUT_ATTACHMENT] = "input attachment",
};

// Write the type of a number, vector or matrix as GLSL calls it.
static void name_number(const struct rhw_shader_type *type, char name[32])
{
    static const char *const scalars[] = {"float", "int", "uint"}, *const letters[] = {"", "i", "u"};
    const char *const narrow = type->bits == 8 ? "8" : type->bits == 16 ? "16" : "";
    if (type->columns > 1) {
        snprintf(name, 32, "mat%ux%u", (unsigned)type->columns, (unsigned)type->rows);
    } else if (type->rows > 1) {
        snprintf(name, 32, "%svec%u%s%s", letters[type->kind], (unsigned)type->rows, narrow[0] ? " of " : "",
                 narrow);
    } else {
        snprintf(name, 32, "%s%s", scalars[type->kind], narrow);
    }
}

// Write a type as GLSL calls it, with the lengths of its arrays.
static void name_type(const struct rhw_shader_type *type, char name[160])
{
    char lengths[64] = "", inner[32];
    size_t length = 0;
    for (; type->kind == RHW_SHADER_ARRAY; type = type->element) {
        char one[16] = "[]";
        if (type->count > 0) {
            snprintf(one, sizeof one, "[%u]", (unsigned)type->count);
        }
        if (length + sizeof one < sizeof lengths) {
            length += (size_t)snprintf(lengths + length, sizeof lengths - length, "%s", one);
        }
    }
    if (type->kind == RHW_SHADER_STRUCT) {
        snprintf(name, 160, "%.80s%s", type->name[0] ? type->name : "struct", lengths);
    } else {
        name_number(type, inner);
        snprintf(name, 160, "%s%s", inner, lengths);
    }
}

// Print a name of the module without what a terminal would obey.
static void print_name(const char *name)
{
    for (int i = 0; name[i] && i < 200; i++) {
        const unsigned char c = (unsigned char)name[i];
        putchar(c < ' ' || c == 0x7f ? '?' : name[i]);
    }
}

bool cli_shader_has_length(const struct rhw_shader_type *type)
{
    const struct rhw_shader_type *const last =
        type && type->count > 0 ? type->members[type->count - 1].type : NULL;
    return !last || last->kind != RHW_SHADER_ARRAY || last->count > 0;
}

// Text -----------------------------------------------------------------------------------------------

static void print_members(const struct rhw_shader_type *type)
{
    for (uint32_t i = 0; type && i < type->count; i++) {
        char name[160];
        name_type(type->members[i].type, name);
        printf("    %6u  %-12s ", (unsigned)type->members[i].offset, name);
        print_name(type->members[i].name);
        putchar('\n');
    }
}

static void print_resources(const struct rhw_shader_info *info)
{
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const resource = &info->resources[i];
        printf("  %u:%-3u %s%s ", (unsigned)resource->set, (unsigned)resource->binding,
               kind_names[resource->kind],
               resource->is_read_only && resource->kind == RHW_SHADER_STORAGE_BUFFER ? ", read only," : "");
        print_name(resource->name);
        if (resource->count != 1) {
            printf(resource->count > 0 ? "[%u]" : "[]", (unsigned)resource->count);
        }
        if (resource->type) {
            printf(", %u bytes%s", (unsigned)resource->size,
                   cli_shader_has_length(resource->type) ? "" : " and an array of any length");
        }
        putchar('\n');
        print_members(resource->type);
    }
}

static void print_variables(const char *title, const struct rhw_shader_variable *variables, uint32_t count)
{
    if (count > 0) {
        printf("%s\n", title);
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct rhw_shader_variable *const variable = &variables[i];
        const char *const scalar = variable->is_integer ? "int" : "float", *const letter =
                                                                               variable->is_integer ? "i"
                                                                                                    : "";
        char type[16];
        snprintf(type, sizeof type, variable->components > 1 ? "%svec%u" : "%s", letter,
                 (unsigned)variable->components);
        printf("  location %u%s%.1s  %-6s ", (unsigned)variable->location, variable->component > 0 ? "." : "",
               variable->component > 0 ? &"xyzw"[variable->component] : "",
               variable->components > 1 ? type : scalar);
        print_name(variable->name);
        putchar('\n');
    }
}

void cli_shader_print_table(const struct cli_shader_file *file)
{
    const struct rhw_shader_info *const info = rhw_shader_get_info(file->shader);
    printf("%s: %s shader ", file->path, cli_shader_stage_names[info->stage]);
    print_name(file->entry_point);
    printf("\n%s", info->resource_count > 0 ? "resources, by set and binding\n" : "");
    print_resources(info);
    if (info->push_size > 0) {
        printf("push constants, %u bytes\n", (unsigned)info->push_size);
        print_members(info->push_type);
    }
    print_variables("inputs", info->inputs, info->input_count);
    print_variables("outputs", info->outputs, info->output_count);
    if (info->stage == RHW_SHADER_COMPUTE) {
        printf("workgroup of %ux%ux%u, %u bytes shared\n", (unsigned)info->size[0], (unsigned)info->size[1],
               (unsigned)info->size[2], (unsigned)info->shared_size);
    }
}

// JSON -----------------------------------------------------------------------------------------------

static void write_members(const struct rhw_shader_type *type)
{
    fputs("\"members\": [", stdout);
    for (uint32_t i = 0; type && i < type->count; i++) {
        char name[160];
        name_type(type->members[i].type, name);
        printf("%s{\"name\": ", i > 0 ? ", " : "");
        cli_json_string(stdout, type->members[i].name);
        printf(", \"offset\": %u, \"type\": ", (unsigned)type->members[i].offset);
        cli_json_string(stdout, name);
        putchar('}');
    }
    putchar(']');
}

static void write_variables(const char *title, const struct rhw_shader_variable *variables, uint32_t count)
{
    printf("     \"%s\": [", title);
    for (uint32_t i = 0; i < count; i++) {
        printf("%s{\"location\": %u, \"component\": %u, \"components\": %u, \"type\": \"%s\", \"name\": ",
               i > 0 ? ", " : "", (unsigned)variables[i].location, (unsigned)variables[i].component,
               (unsigned)variables[i].components, variables[i].is_integer ? "int" : "float");
        cli_json_string(stdout, variables[i].name);
        putchar('}');
    }
    puts("],");
}

static void write_shader(const struct cli_shader_file *file)
{
    const struct rhw_shader_info *const info = rhw_shader_get_info(file->shader);
    fputs("    {\"file\": ", stdout);
    cli_json_string(stdout, file->path);
    printf(", \"stage\": \"%s\", \"entry_point\": ", cli_shader_stage_names[info->stage]);
    cli_json_string(stdout, file->entry_point);
    fputs(",\n     \"resources\": [", stdout);
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const resource = &info->resources[i];
        printf("%s\n       {\"set\": %u, \"binding\": %u, \"kind\": \"%s\", \"count\": %u, \"name\": ",
               i > 0 ? "," : "", (unsigned)resource->set, (unsigned)resource->binding,
               kind_names[resource->kind], (unsigned)resource->count);
        cli_json_string(stdout, resource->name);
        printf(", \"read_only\": %s, \"bytes\": %u, ", resource->is_read_only ? "true" : "false",
               (unsigned)resource->size);
        write_members(resource->type);
        putchar('}');
    }
    puts("],");
    write_variables("inputs", info->inputs, info->input_count);
    write_variables("outputs", info->outputs, info->output_count);
    printf("     \"push_constants\": {\"bytes\": %u, ", (unsigned)info->push_size);
    write_members(info->push_type);
    printf("},\n     \"workgroup\": [%u, %u, %u], \"shared_bytes\": %u}", (unsigned)info->size[0],
           (unsigned)info->size[1], (unsigned)info->size[2], (unsigned)info->shared_size);
}

void cli_shader_print_json(const struct cli_shader_file *files, int count)
{
    fputs("{\n  \"shaders\": [\n", stdout);
    for (int i = 0; i < count; i++) {
        write_shader(&files[i]);
        puts(i + 1 < count ? "," : "");
    }
    puts("  ]\n}");
}
