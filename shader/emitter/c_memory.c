// SPDX-License-Identifier: MIT
// What lies in buffers, and memory of the lanes and of the workgroup.
#include "c_emit.h"

// Bindings -------------------------------------------------------------------------------------------

static const char *resource_name(struct shader_emitter *emitter, uint32_t resource)
{
    return shader_c_clean(emitter->memory,
                          emitter->form->module->names[emitter->form->resources[resource].variable->id]);
}

bool shader_c_is_one_binding(const struct shader_emitter *emitter, uint32_t buffer)
{
    return emitter->plan.is_hoisted[buffer];
}

// Return the element that lanes name.
static const char *element_of(struct shader_emitter *emitter, uint32_t buffer)
{
    return shader_c_argument(
        emitter, emitter->plan.is_hoisted[buffer] ? emitter->form->nodes[buffer].operands[0] : buffer, false);
}

static const char *element_text(struct shader_emitter *emitter, uint32_t buffer, const char *element)
{
    const uint32_t resource = shader_resource_node(emitter->form, buffer)->immediate;
    const struct shader_slot *const slot = &emitter->stage->slots[resource];
    return shader_format(emitter->memory, "rhw_spirv_element(frame, %u, %u, %u, %s)", (unsigned)slot->set,
                         (unsigned)slot->first, (unsigned)slot->count, element);
}

// Write the binding of a BUFFER, and its words.
static void write_binding(struct shader_emitter *emitter, uint32_t buffer)
{
    const struct shader_node *const node = &emitter->form->nodes[buffer];
    if (!emitter->plan.is_hoisted[buffer]) { // lanes name their own
        shader_c_define(emitter, buffer, shader_c_argument(emitter, node->operands[0], false), "");
        return;
    }
    uint32_t bits;
    const char *const element =
        shader_c_is_number(emitter, node->operands[0], &bits)
            ? shader_format(emitter->memory, "%u", (unsigned)bits)
            : shader_format(emitter->memory, "(uint32_t)%s[0]", shader_c_name(emitter, node->operands[0]));
    const char *const name = resource_name(emitter, node->immediate);
    shader_text_line(&emitter->once, "const struct rhw_binding *const binding%u = %s;%s%s", (unsigned)buffer,
                     element_text(emitter, buffer, element), name[0] ? " // " : "", name);
    if (emitter->form->resources[node->immediate].type->kind == SHADER_STRUCT) {
        shader_text_line(&emitter->once,
                         "const struct rhw_spirv_words words%u = rhw_spirv_words_of(binding%u);",
                         (unsigned)buffer, (unsigned)buffer);
    }
}

// The memory of a workgroup is a binding and words too.
static void write_shared(struct shader_emitter *emitter, uint32_t buffer)
{
    const unsigned size = emitter->form->workgroup_size, number = buffer;
    struct shader_text *const once = &emitter->once;
    shader_text_line(once, "struct rhw_binding shared%u;", number);
    shader_text_line(once, "(void)rhw_binding_of_memory(w->shared, %u, false, &shared%u);", size, number);
    shader_text_line(once, "const struct rhw_binding *const binding%u = &shared%u;", number, number);
    shader_text_line(once, "const struct rhw_spirv_words words%u = rhw_spirv_words_of(binding%u);", number,
                     number);
}

// Return true if a texture with a sampler, or with SHADER_NONE, is met for the first time.
static bool is_new_pair(struct shader_emitter *emitter, uint32_t texture, uint32_t sampler)
{
    for (size_t p = 0; p < emitter->pair_count; p++) {
        if (emitter->pairs[p].texture == texture && emitter->pairs[p].sampler == sampler) {
            return false;
        }
    }
    if (emitter->pair_count == emitter->pair_room) {
        emitter->pairs =
            shader_grow(emitter->memory, emitter->pairs, &emitter->pair_room, sizeof *emitter->pairs);
    }
    emitter->pairs[emitter->pair_count++] = (struct shader_c_pair){texture, sampler};
    return true;
}

// Return the name of a texture with a sampler. They are put together once a call.
static const char *pair_of(struct shader_emitter *emitter, uint32_t texture, uint32_t sampler)
{
    const char *const name =
        shader_format(emitter->memory, "pair%u_%u", (unsigned)texture, (unsigned)sampler);
    if (is_new_pair(emitter, texture, sampler)) {
        shader_text_line(&emitter->once, "struct rhw_binding memory_of_%s;", name);
        shader_text_line(
            &emitter->once,
            "const struct rhw_binding *const %s = rhw_spirv_pair(binding%u, binding%u, &memory_of_%s);", name,
            (unsigned)texture, (unsigned)sampler, name);
    }
    return name;
}

const char *shader_c_plane(struct shader_emitter *emitter, uint32_t texture)
{
    const unsigned number = texture;
    if (is_new_pair(emitter, texture, SHADER_NONE)) {
        shader_text_line(&emitter->once,
                         "const struct rhw_texel_plane plane%u = rhw_binding_sample_plane(binding%u);",
                         number, number);
    }
    return shader_format(emitter->memory, "plane%u", number);
}

const char *shader_c_begin_bindings(struct shader_emitter *emitter, uint32_t texture, uint32_t sampler,
                                    const char **lanes)
{
    struct shader_memory *const memory = emitter->memory;
    const bool has_sampler = sampler != SHADER_NONE;
    if (shader_c_is_one_binding(emitter, texture) &&
        (!has_sampler || shader_c_is_one_binding(emitter, sampler))) {
        *lanes = shader_format(memory, "m%u", (unsigned)emitter->mask);
        return has_sampler ? pair_of(emitter, texture, sampler)
                           : shader_format(memory, "binding%u", (unsigned)texture);
    }
    *lanes = "lanes";
    shader_text_line(emitter->out, "for (rhw_int todo = m%u, lanes; rhw_any(todo);) {",
                     (unsigned)emitter->mask);
    shader_text_line(emitter->out, "const uint32_t named = (uint32_t)rhw_binding_next(%s, &todo, &lanes);",
                     element_of(emitter, texture));
    shader_text_line(emitter->out, "const struct rhw_binding *%s = %s;", has_sampler ? "texture" : "binding",
                     element_text(emitter, texture, "named"));
    if (has_sampler) {
        shader_text_line(emitter->out, "rhw_int same = lanes, rest = lanes;");
        shader_text_line(emitter->out, "const uint32_t other = (uint32_t)rhw_binding_next(%s, &rest, &same);",
                         element_of(emitter, sampler));
        shader_text_line(emitter->out, "todo |= rest;");
        shader_text_line(emitter->out, "lanes = same;");
        shader_text_line(emitter->out, "struct rhw_binding pair;");
        shader_text_line(emitter->out,
                         "const struct rhw_binding *const binding = rhw_spirv_pair(texture, %s, &pair);",
                         element_text(emitter, sampler, "other"));
    }
    return "binding";
}

void shader_c_end_bindings(struct shader_emitter *emitter, uint32_t texture, uint32_t sampler)
{
    if (!shader_c_is_one_binding(emitter, texture) ||
        (sampler != SHADER_NONE && !shader_c_is_one_binding(emitter, sampler))) {
        shader_text_line(emitter->out, "}");
    }
}

// Words ----------------------------------------------------------------------------------------------

// Return the number of the word at an offset of bytes: of all lanes alike, or lane by lane.
static const char *index_text(struct shader_emitter *emitter, uint32_t offset, uint32_t more, bool is_alike)
{
    uint32_t bits;
    if (shader_c_is_number(emitter, offset, &bits)) {
        return shader_format(emitter->memory, is_alike ? "%u" : "rhw_splat_int(%u)",
                             (unsigned)((bits + more) >> 2));
    }
    return shader_format(emitter->memory,
                         is_alike ? "((uint32_t)%s[0] + %uu) >> 2" : "rhw_spirv_index(%s, %u)",
                         shader_c_argument(emitter, offset, false), (unsigned)more);
}

static const char *load_alike(struct shader_emitter *emitter, const struct shader_node *node, bool is_float)
{
    const char *const index = index_text(emitter, node->operands[1], node->immediate, true);
    const uint32_t buffer = shader_resource_of(&emitter->plan, node->operands[0]);
    const bool is_push = emitter->form->nodes[buffer].op == SHADER_PUSH;
    const char *const word =
        is_push ? shader_format(emitter->memory, "rhw_spirv_push_word(frame, %s)", index)
                : shader_format(emitter->memory, "rhw_spirv_word(words%u, %s)", (unsigned)buffer, index);
    return shader_format(emitter->memory,
                         is_float ? "rhw_float_from_bits(rhw_splat_int(%s))" : "rhw_splat_int(%s)", word);
}

static bool is_written(const struct shader_emitter *emitter, uint32_t buffer)
{
    const struct shader_node *const node = shader_resource_node(emitter->form, buffer);
    return node->op == SHADER_BUFFER && emitter->plan.has_effects &&
           (emitter->form->resources[node->immediate].variable->storage == SPIRV_STORAGE_BUFFER ||
            emitter->form->resources[node->immediate].type->is_buffer_block);
}

// Words of the lane and constants -------------------------------------------------------------------

// Return the number of a word behind the first of a PRIVATE or TABLE.
static const char *own_index(struct shader_emitter *emitter, const struct shader_node *node, bool is_alike)
{
    const uint32_t first = emitter->form->nodes[node->operands[0]].immediate;
    return index_text(emitter, node->operands[1], node->immediate + 4 * first, is_alike);
}

static bool is_own(const struct shader_emitter *emitter, const struct shader_node *node)
{
    const uint16_t op = emitter->form->nodes[node->operands[0]].op;
    return op == SHADER_PRIVATE || op == SHADER_TABLE;
}

static void write_own_load(struct shader_emitter *emitter, uint32_t value)
{
    const struct shader_node *const node = &emitter->form->nodes[value];
    const bool is_private = emitter->form->nodes[node->operands[0]].op == SHADER_PRIVATE;
    const bool is_alike = shader_is_shared(emitter->form, node->operands[1]);
    const unsigned count = is_private ? emitter->form->private_count : emitter->form->table_count;
    const char *const text = shader_format(
        emitter->memory, "%s%s(%s, %u, %s)", is_private ? "rhw_spirv_own" : "rhw_spirv_table",
        is_alike ? "_alike" : "", is_private ? "own" : "table", count, own_index(emitter, node, is_alike));
    shader_c_define(emitter, value,
                    emitter->is_float[value] ? shader_format(emitter->memory, "rhw_float_from_bits(%s)", text)
                                             : text,
                    "");
}

static void write_own_store(struct shader_emitter *emitter, const struct shader_node *node)
{
    const bool is_alike = shader_is_shared(emitter->form, node->operands[1]);
    shader_text_line(emitter->out, "rhw_spirv_own_store%s(own, %u, %s, %s, m%u);", is_alike ? "_alike" : "",
                     (unsigned)emitter->form->private_count, own_index(emitter, node, is_alike),
                     shader_c_argument(emitter, node->operands[2], false), (unsigned)emitter->mask);
}

// Begin to read bindings. What is the same in all lanes is read for all of them, as those that are not active are
// looked at, too.
static const char *begin_reading(struct shader_emitter *emitter, const struct shader_node *node,
                                 uint32_t buffer, const char **lanes)
{
    const uint32_t active = emitter->mask;
    if (node->flags & SHADER_DYNAMICALLY_UNIFORM) {
        emitter->mask = shader_c_new_mask(emitter);
        shader_text_line(emitter->out, "const rhw_int m%u = rhw_splat_int(-1);", (unsigned)emitter->mask);
    }
    const char *const binding = shader_c_begin_bindings(emitter, buffer, SHADER_NONE, lanes);
    emitter->mask = active;
    return binding;
}

static void write_load(struct shader_emitter *emitter, uint32_t value)
{
    struct shader_memory *const memory = emitter->memory;
    const struct shader_node *const node = &emitter->form->nodes[value];
    if (is_own(emitter, node)) {
        write_own_load(emitter, value);
        return;
    }
    const uint32_t buffer = shader_resource_of(&emitter->plan, node->operands[0]);
    const bool is_float = emitter->is_float[value], is_one = shader_c_is_one_binding(emitter, buffer);
    if (shader_is_shared(emitter->form, value) && is_one) {
        shader_c_define(emitter, value, load_alike(emitter, node, is_float), "");
        return;
    }
    const char *const index = index_text(emitter, node->operands[1], node->immediate, false);
    const char *const name = shader_format(memory, "words%u", (unsigned)value);
    const char *text;
    if (emitter->form->nodes[buffer].op == SHADER_PUSH) {
        text = shader_format(memory, "rhw_spirv_push(frame, %s)", index);
    } else if (is_one && is_written(emitter, buffer)) {
        text = shader_format(memory, "rhw_spirv_load(words%u, %s, m%u)", (unsigned)buffer, index,
                             (unsigned)emitter->mask);
    } else if (is_one) {
        text = shader_format(memory, "rhw_spirv_gather(words%u, %s)", (unsigned)buffer, index);
    } else {
        const char *lanes;
        shader_text_line(emitter->out, "rhw_int %s = rhw_splat_int(0);", name);
        const char *const binding = begin_reading(emitter, node, buffer, &lanes);
        shader_text_line(emitter->out, "%s |= rhw_spirv_load(rhw_spirv_words_of(%s), %s, %s);", name, binding,
                         index, lanes);
        shader_c_end_bindings(emitter, buffer, SHADER_NONE);
        text = name;
    }
    shader_c_define(emitter, value, is_float ? shader_format(memory, "rhw_float_from_bits(%s)", text) : text,
                    "");
}

// Store the lowest 8 or 16 bits.
static void write_store_part(struct shader_emitter *emitter, const struct shader_node *node)
{
    const uint32_t buffer = shader_resource_of(&emitter->plan, node->operands[0]);
    const char *const offset = shader_c_argument(emitter, node->operands[1], false);
    const char *const value = shader_c_argument(emitter, node->operands[2], false);
    const char *lanes;
    const char *const binding = shader_c_begin_bindings(emitter, buffer, SHADER_NONE, &lanes);
    shader_text_line(emitter->out, "rhw_spirv_store_part(%s, %s, %u, %s, %d, %s);", binding, offset,
                     (unsigned)node->immediate, value, node->op == SHADER_STORE8 ? 8 : 16, lanes);
    shader_c_end_bindings(emitter, buffer, SHADER_NONE);
}

static void write_store(struct shader_emitter *emitter, const struct shader_node *node)
{
    if (is_own(emitter, node)) {
        write_own_store(emitter, node);
        return;
    }
    const uint32_t buffer = shader_resource_of(&emitter->plan, node->operands[0]);
    const char *const index = index_text(emitter, node->operands[1], node->immediate, false);
    const char *const value = shader_c_argument(emitter, node->operands[2], false);
    const char *lanes;
    if (emitter->form->nodes[buffer].op == SHADER_WORKGROUP) {
        shader_text_line(emitter->out, "rhw_spirv_share(w->shared, %u, %s, %s, m%u);",
                         (unsigned)emitter->form->workgroup_size, index, value, (unsigned)emitter->mask);
        return;
    }
    const char *const binding = shader_c_begin_bindings(emitter, buffer, SHADER_NONE, &lanes);
    shader_text_line(emitter->out, "rhw_binding_storage_store(%s, %s, %s, %s);", binding, index, value,
                     lanes);
    shader_c_end_bindings(emitter, buffer, SHADER_NONE);
}

static void write_length(struct shader_emitter *emitter, uint32_t value)
{
    const struct shader_node *const node = &emitter->form->nodes[value];
    const uint32_t buffer = shader_resource_of(&emitter->plan, node->operands[0]);
    if (shader_c_is_one_binding(emitter, buffer)) {
        shader_c_define(
            emitter, value,
            shader_format(emitter->memory, "rhw_splat_int(rhw_spirv_bytes(words%u))", (unsigned)buffer), "");
        return;
    }
    const char *const name = shader_format(emitter->memory, "bytes%u", (unsigned)value);
    const char *lanes;
    shader_text_line(emitter->out, "rhw_int %s = rhw_splat_int(0);", name);
    const char *const binding = begin_reading(emitter, node, buffer, &lanes);
    shader_text_line(emitter->out, "%s |= rhw_splat_int(rhw_spirv_bytes(rhw_spirv_words_of(%s))) & %s;", name,
                     binding, lanes);
    shader_c_end_bindings(emitter, buffer, SHADER_NONE);
    shader_c_define(emitter, value, name, "");
}

static const char *const atomic_names[] = {
#define ATOMIC(name, printed, operation) #operation,
#include "form/atomic.inc"
#undef ATOMIC
};

// Of a word of a buffer, or of a texel.
static void write_atomic(struct shader_emitter *emitter, uint32_t value)
{
    struct shader_memory *const memory = emitter->memory;
    struct shader_node *const node = &emitter->form->nodes[value];
    const bool is_image = node->op == SHADER_IMAGE_ATOMIC;
    uint32_t count;
    const uint32_t *const operands = shader_operands(emitter->form, node, &count);
    const uint32_t number = operands[is_image ? SHADER_IMAGE_ATOMIC_VALUE : SHADER_ATOMIC_VALUE];
    const uint32_t comparand = operands[is_image ? SHADER_IMAGE_ATOMIC_COMPARAND : SHADER_ATOMIC_COMPARAND];
    const uint32_t buffer = shader_resource_of(&emitter->plan, operands[SHADER_ATOMIC_BUFFER]);
    const char *const name = shader_format(memory, "before%u", (unsigned)value);
    const char *index = shader_format(memory, "at%u", (unsigned)value), *lanes;
    if (is_image) {
        const uint32_t *const at = &operands[SHADER_IMAGE_ATOMIC_COORDINATES];
        shader_text_line(emitter->out, "const rhw_int %s[4] = {%s, %s, %s};", index,
                         shader_c_argument(emitter, at[0], false), shader_c_argument(emitter, at[1], false),
                         shader_c_argument(emitter, at[2], false));
    } else {
        index = index_text(emitter, operands[SHADER_ATOMIC_OFFSET], 0, false);
    }
    shader_text_line(emitter->out, "rhw_int %s = rhw_splat_int(0);", name);
    const char *const binding = shader_c_begin_bindings(emitter, buffer, SHADER_NONE, &lanes);
    shader_text_line(emitter->out, "%s |= %s(%s, RHW_STORAGE_%s, %s, %s, %s, %s);", name,
                     is_image ? "rhw_spirv_image_atomic" : "rhw_spirv_atomic", binding,
                     atomic_names[node->immediate], index, shader_c_argument(emitter, number, false),
                     shader_c_argument(emitter, comparand, false), lanes);
    shader_c_end_bindings(emitter, buffer, SHADER_NONE);
    if (emitter->plan.uses[value] > 0) {
        shader_c_define(emitter, value, name, "");
    }
}

bool shader_c_write_access(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t value = emitter->form->code[place];
    const struct shader_node *const node = &emitter->form->nodes[value];
    switch ((enum shader_op)node->op) {
    case SHADER_BUFFER: write_binding(emitter, value); return true;
    case SHADER_PUSH: return true;
    case SHADER_WORKGROUP: write_shared(emitter, value); return true;
    case SHADER_LOAD: write_load(emitter, value); return true;
    case SHADER_STORE: write_store(emitter, node); return true;
    case SHADER_STORE8:
    case SHADER_STORE16: write_store_part(emitter, node); return true;
    case SHADER_LENGTH: write_length(emitter, value); return true;
    case SHADER_ATOMIC:
    case SHADER_IMAGE_ATOMIC: write_atomic(emitter, value); return true;
    default: return false;
    }
}
