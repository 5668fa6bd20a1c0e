// SPDX-License-Identifier: MIT
// What shaders are, as a table and as JSON; see shader_job.h.
#include "json.h"
#include "shader_job.h"
#include "shader_name.h"
#include "shader_values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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
        char name[CLI_SHADER_TYPE_NAME];
        cli_shader_name_type(type->members[i].type, name);
        printf("    %6u  %-12s ", (unsigned)type->members[i].offset, name);
        print_name(type->members[i].name);
        putchar('\n');
    }
}

// Print what kind of image a resource is.
static void print_image(const struct rhw_shader_resource *resource)
{
    char type[CLI_SHADER_TYPE_NAME];
    const char *const format = cli_shader_format_name(resource);
    cli_shader_name_image(resource, type);
    printf("%s%s%s%s", type[0] ? ", " : "", type, format[0] ? ", " : "", format);
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
        print_image(resource);
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
        char type[CLI_SHADER_TYPE_NAME];
        cli_shader_name_variable(variable, type);
        printf("  location %u%s%.1s  %-6s ", (unsigned)variable->location, variable->component > 0 ? "." : "",
               variable->component > 0 ? &"xyzw"[variable->component] : "", type);
        print_name(variable->name);
        putchar('\n');
    }
}

// Write a number of a constant as a word of JSON and of the table.
static void write_constant(const struct rhw_shader_constant_info *constant)
{
    float number;
    memcpy(&number, &constant->value, sizeof number);
    if (constant->is_bool) {
        fputs(constant->value ? "true" : "false", stdout);
    } else if (constant->kind == RHW_SHADER_FLOAT && constant->bits == 32 && isfinite(number)) {
        cli_shader_values_print_float(constant->value);
    } else if (constant->kind == RHW_SHADER_FLOAT && constant->bits == 32) {
        fputs("null", stdout); // JSON has no word for it
    } else if (constant->kind == RHW_SHADER_INT) {
        printf("%d", (int)(int32_t)constant->value);
    } else {
        printf("%u", (unsigned)constant->value); // of a float of 16 bits: its bits
    }
}

static void print_constants(const struct rhw_shader_info *info)
{
    if (info->constant_count > 0) {
        puts("specialization constants");
    }
    for (uint32_t i = 0; i < info->constant_count; i++) {
        const struct rhw_shader_constant_info *const constant = &info->constants[i];
        printf("  id %-6u  %-6s ", (unsigned)constant->id, cli_shader_constant_type(constant));
        print_name(constant->name);
        fputs(constant->name[0] ? " = " : "= ", stdout);
        write_constant(constant);
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
    print_constants(info);
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
        char name[CLI_SHADER_TYPE_NAME];
        cli_shader_name_type(type->members[i].type, name);
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
               (unsigned)variables[i].components,
               !variables[i].is_integer ? "float"
               : variables[i].is_signed ? "int"
                                        : "uint");
        cli_json_string(stdout, variables[i].name);
        putchar('}');
    }
    puts("],");
}

static void write_constants(const struct rhw_shader_info *info)
{
    fputs("     \"constants\": [", stdout);
    for (uint32_t i = 0; i < info->constant_count; i++) {
        const struct rhw_shader_constant_info *const constant = &info->constants[i];
        printf("%s{\"id\": %u, \"type\": \"%s\", \"default\": ", i > 0 ? ", " : "", (unsigned)constant->id,
               cli_shader_constant_type(constant));
        write_constant(constant);
        fputs(", \"name\": ", stdout);
        cli_json_string(stdout, constant->name);
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
        char image[CLI_SHADER_TYPE_NAME];
        cli_shader_name_image(resource, image);
        if (image[0]) {
            printf(", \"image\": \"%s\", \"format\": \"%s\"", image, cli_shader_format_name(resource));
        }
        printf(", \"read_only\": %s, \"bytes\": %u, ", resource->is_read_only ? "true" : "false",
               (unsigned)resource->size);
        write_members(resource->type);
        putchar('}');
    }
    puts("],");
    write_variables("inputs", info->inputs, info->input_count);
    write_variables("outputs", info->outputs, info->output_count);
    write_constants(info);
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
