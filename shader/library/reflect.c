// SPDX-License-Identifier: MIT
// What a shader tells about itself: resources, inputs and outputs.
#include <stdlib.h>

#include "shader.h"

// Return the name of an id, or "".
static const char *name_of(const struct shader_module *module, uint32_t id)
{
    const char *const name = module->names[id];
    return name ? name : "";
}

// Resources ------------------------------------------------------------------------------------------

static enum rhw_shader_resource_kind kind_of_image(const struct shader_image_type *image)
{
    if (image->dim == SPIRV_DIM_SUBPASS) {
        return RHW_SHADER_INPUT_ATTACHMENT;
    }
    if (image->dim == SPIRV_DIM_BUFFER) {
        return RHW_SHADER_TEXEL_BUFFER;
    }
    return image->is_storage ? RHW_SHADER_STORAGE_IMAGE : RHW_SHADER_TEXTURE;
}

static enum rhw_shader_resource_kind kind_of(const struct shader_resource *resource)
{
    const struct shader_type *const type = resource->type;
    switch (type->kind) {
    case SHADER_SAMPLER: return RHW_SHADER_SAMPLER;
    case SHADER_SAMPLED_IMAGE:
        return type->element->image.dim == SPIRV_DIM_BUFFER ? RHW_SHADER_TEXEL_BUFFER
                                                            : RHW_SHADER_SAMPLED_TEXTURE;
    case SHADER_IMAGE: return kind_of_image(&type->image);
    default:
        return resource->variable->storage == SPIRV_STORAGE_BUFFER || type->is_buffer_block
                   ? RHW_SHADER_STORAGE_BUFFER
                   : RHW_SHADER_UNIFORM_BUFFER;
    }
}

// Fill in what an image is.
static void reflect_image(const struct shader_type *type, struct rhw_shader_resource *resource)
{
    static const enum rhw_texture_kind kinds[] = {[SPIRV_DIM_1D] = RHW_TEXTURE_1D,
                                                  [SPIRV_DIM_2D] = RHW_TEXTURE_2D,
                                                  [SPIRV_DIM_3D] = RHW_TEXTURE_3D,
                                                  [SPIRV_DIM_CUBE] = RHW_TEXTURE_CUBE};
    const struct shader_type *const image = type->kind == SHADER_SAMPLED_IMAGE ? type->element : type;
    if (image->kind == SHADER_IMAGE) {
        resource->texture_kind =
            image->image.dim <= SPIRV_DIM_CUBE ? kinds[image->image.dim] : RHW_TEXTURE_2D;
        resource->is_array = image->image.is_arrayed;
        resource->is_multisampled = image->image.is_multisampled;
        resource->is_integer = image->element->kind == SHADER_INT;
        resource->is_signed = resource->is_integer && image->element->is_signed;
        resource->is_depth = image->image.is_depth;
        resource->format = image->image.format;
    }
}

static int compare_resources(const void *a, const void *b)
{
    const struct rhw_shader_resource *const x = a, *const y = b;
    const uint32_t p = x->set != y->set ? x->set : x->binding, q = x->set != y->set ? y->set : y->binding;
    return p < q ? -1 : p > q;
}

// What code does with a resource.
struct use {
    bool is_used, is_written;
};

// Mark the resource whose BUFFER node is `value`.
static void mark_written(const struct shader_program *form, struct use *uses, uint32_t value)
{
    const struct shader_node *const node = shader_resource_node(form, value);
    if (node->op == SHADER_BUFFER) {
        uses[node->immediate].is_written = true;
    }
}

static const struct use *find_uses(const struct shader_program *form)
{
    struct use *const uses = shader_take(form->memory, form->resource_count, sizeof *uses);
    for (uint32_t i = 0; i < form->code_count; i++) {
        const struct shader_node *const node = &form->nodes[form->code[i]];
        const uint32_t first = node->operands[0];
        switch ((enum shader_op)node->op) {
        case SHADER_BUFFER: uses[node->immediate].is_used = true; break;
        case SHADER_STORE8:
        case SHADER_STORE16:
        case SHADER_STORE: mark_written(form, uses, first); break;
        case SHADER_ATOMIC:
            if (node->immediate != SHADER_ATOMIC_LOAD) {
                mark_written(form, uses, form->lists[first + 1 + SHADER_ATOMIC_BUFFER]);
            }
            break;
        case SHADER_IMAGE_STORE:
            mark_written(form, uses, form->lists[first + 1 + SHADER_IMAGE_TEXTURE]);
            break;
        case SHADER_IMAGE_ATOMIC:
            if (node->immediate != SHADER_ATOMIC_LOAD) {
                mark_written(form, uses, form->lists[first + 1 + SHADER_IMAGE_ATOMIC_IMAGE]);
            }
            break;
        default: break;
        }
    }
    return uses;
}

// Return the name of a variable, or that of its block.
static const char *name_of_resource(const struct shader_module *module,
                                    const struct shader_resource *resource)
{
    const char *const name = name_of(module, resource->variable->id);
    return name[0] || resource->type->kind != SHADER_STRUCT ? name : name_of(module, resource->type->id);
}

// Resources that no code reaches are left out: they may be those of another entry point.
static void reflect_resources(rhw_shader *shader)
{
    const struct shader_program *const form = shader->form;
    const struct shader_module *const module = form->module;
    const struct use *const uses = find_uses(form);
    struct rhw_shader_resource *const resources =
        shader_take(form->memory, form->resource_count, sizeof *resources);
    uint32_t count = 0;
    for (uint32_t r = 0; r < form->resource_count; r++) {
        const struct shader_resource *const resource = &form->resources[r];
        const struct shader_variable *const variable = resource->variable;
        if (!uses[r].is_used) {
            continue;
        }
        if (variable->set < 0 || variable->set >= RHW_SHADER_MAX_SETS || variable->binding < 0) {
            shader_refuse(module, module->ids[variable->id].word,
                          "a resource has a binding, and a set below %d", RHW_SHADER_MAX_SETS);
        }
        if (count == RHW_SHADER_MAX_RESOURCES) {
            shader_refuse(module, module->ids[variable->id].word, "the shader uses more than %d resources",
                          RHW_SHADER_MAX_RESOURCES);
        }
        const struct rhw_shader_type *const type =
            resource->type->kind == SHADER_STRUCT ? shader_reflect_type(shader, resource->type) : NULL;
        resources[count] = (struct rhw_shader_resource){.kind = kind_of(resource),
                                                        .set = (uint32_t)variable->set,
                                                        .binding = (uint32_t)variable->binding,
                                                        .count = resource->count,
                                                        .name = name_of_resource(module, resource),
                                                        .size = type ? type->size : 0,
                                                        .is_read_only = !uses[r].is_written,
                                                        .type = type};
        reflect_image(resource->type, &resources[count++]);
    }
    if (count > 0) {
        qsort(resources, count, sizeof *resources, compare_resources);
    }
    shader->info.resources = resources;
    shader->info.resource_count = count;
}

// Inputs and outputs ---------------------------------------------------------------------------------

struct variable_list {
    struct shader_memory *memory;
    struct rhw_shader_variable *variables;
    uint32_t count;
    size_t room;
    uint32_t index; // index of blending that variables have that are added next
};

// Add what a type has from a location on. Return the location behind.
static uint32_t add_variables(struct variable_list *list, const struct shader_type *type, uint32_t location,
                              uint32_t component, const char *name)
{
    if (type->is_empty) {
        return location; // arrays of it may have any number of elements
    }
    if (type->kind == SHADER_MATRIX || type->kind == SHADER_ARRAY) {
        for (uint32_t i = 0; i < type->count; i++) {
            location = add_variables(list, type->element, location, component, name);
        }
        return location;
    }
    if (type->kind == SHADER_STRUCT) {
        for (uint32_t i = 0; i < type->count; i++) {
            const struct shader_member *const member = &type->members[i];
            if (member->built_in >= 0) {
                continue;
            }
            // Members of blocks alone have places of their own.
            const bool counts = type->is_block;
            location = counts && member->location >= 0 ? (uint32_t)member->location : location;
            location = add_variables(list, member->type, location,
                                     counts && member->component > 0 ? (uint32_t)member->component : 0, name);
        }
        return location;
    }
    if (list->count == list->room) {
        list->variables = shader_grow(list->memory, list->variables, &list->room, sizeof *list->variables);
    }
    const struct shader_type *const scalar = type->kind == SHADER_VECTOR ? type->element : type;
    list->variables[list->count++] =
        (struct rhw_shader_variable){.location = location,
                                     .component = component,
                                     .components = type->kind == SHADER_VECTOR ? type->count : 1,
                                     .index = list->index,
                                     .is_integer = scalar->kind == SHADER_INT,
                                     .is_signed = scalar->kind == SHADER_INT && scalar->is_signed,
                                     .name = name};
    return location + 1;
}

static int compare_variables(const void *a, const void *b)
{
    const struct rhw_shader_variable *const x = a, *const y = b;
    const uint32_t p = 8 * x->location + 4 * x->index + x->component;
    const uint32_t q = 8 * y->location + 4 * y->index + y->component;
    return p < q ? -1 : p > q;
}

// The form has room for more attributes and targets than the library.
static void check_location(const rhw_shader *shader, uint32_t id, enum spirv_storage_class storage,
                           uint32_t location)
{
    const bool is_attribute = shader->info.stage == RHW_SHADER_VERTEX && storage == SPIRV_INPUT;
    const bool is_target = shader->info.stage == RHW_SHADER_FRAGMENT && storage == SPIRV_OUTPUT;
    const uint32_t limit = is_attribute ? RHW_MAX_ATTRIBUTES : RHW_MAX_COLOR_ATTACHMENTS;
    if ((is_attribute || is_target) && location >= limit) {
        const struct shader_module *const module = shader->form->module;
        shader_refuse(module, module->ids[id].word, "location %u is not below %u", (unsigned)location,
                      (unsigned)limit);
    }
}

// Set *count, and return what the entry point has in a storage class.
static const struct rhw_shader_variable *reflect_variables(rhw_shader *shader,
                                                           enum spirv_storage_class storage, uint32_t *count)
{
    const struct shader_program *const form = shader->form;
    const struct shader_module *const module = form->module;
    struct variable_list list = {.memory = form->memory};
    bool *const is_listed = shader_take(form->memory, module->bound, sizeof *is_listed);
    for (uint32_t i = 0; i < form->entry->interface_count; i++) {
        const uint32_t id = form->entry->interface[i];
        const struct shader_variable *const variable =
            id < module->bound && module->ids[id].opcode == SPIRV_OP_Variable
                ? module->ids[id].data.as_variable
                : NULL;
        if (variable && variable->storage == storage && variable->built_in < 0 && !is_listed[id]) {
            is_listed[id] = true;
            list.index = variable->index > 0 ? 1 : 0;
            const uint32_t before = list.count;
            (void)add_variables(
                &list, variable->type, variable->location < 0 ? 0 : (uint32_t)variable->location,
                variable->component < 0 ? 0 : (uint32_t)variable->component, name_of(module, id));
            for (uint32_t v = before; v < list.count; v++) {
                check_location(shader, id, storage, list.variables[v].location);
            }
        }
    }
    if (list.count > 0) {
        qsort(list.variables, list.count, sizeof *list.variables, compare_variables);
    }
    *count = list.count;
    return list.variables;
}

// Tell the block of push constants, where code reaches one.
static void reflect_push_constants(rhw_shader *shader)
{
    const struct shader_program *const form = shader->form;
    bool is_used = false;
    for (uint32_t i = 0; i < form->code_count; i++) {
        is_used = is_used || form->nodes[form->code[i]].op == SHADER_PUSH;
    }
    for (uint32_t i = 0; is_used && i < form->module->variable_count; i++) {
        const struct shader_variable *const variable = form->module->variables[i];
        if (variable->storage == SPIRV_PUSH_CONSTANT && variable->type->kind == SHADER_STRUCT) {
            shader->info.push_type = shader_reflect_type(shader, variable->type);
            shader->info.push_size = shader->info.push_type->size;
            return;
        }
    }
}

void shader_reflect(rhw_shader *shader)
{
    struct rhw_shader_info *const info = &shader->info;
    reflect_resources(shader);
    reflect_push_constants(shader);
    shader_name_members(shader);
    shader_reflect_constants(shader);
    info->inputs = reflect_variables(shader, SPIRV_INPUT, &info->input_count);
    info->outputs = reflect_variables(shader, SPIRV_OUTPUT, &info->output_count);
    info->shared_size = shader->form->workgroup_size;
    info->reads_view_index = shader->form->reads_view_index;
    info->reads_draw = shader->form->reads_draw;
    for (int i = 0; i < 3; i++) {
        info->size[i] = info->stage == RHW_SHADER_COMPUTE ? shader->form->entry->local_size[i] : 0;
    }
}
