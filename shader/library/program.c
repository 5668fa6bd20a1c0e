// SPDX-License-Identifier: MIT
// Shaders that were linked, with what a pipeline or a dispatch takes of them.
#include <stdlib.h>
#include <string.h>

#include "interpreter/interpret.h"
#include "program.h"
#include "rhw/isa.h"

RHW_ISA_DECLARE(rhw_vertex_function, shader_interpret_vertices);
RHW_ISA_DECLARE(rhw_fragment_function, shader_interpret_fragments);
RHW_ISA_DECLARE(rhw_workgroup_function, shader_interpret_workgroup);

typedef void shader_function(void);

// Layout ---------------------------------------------------------------------------------------------

static int compare_layouts(const void *a, const void *b)
{
    const struct rhw_shader_layout *const x = a, *const y = b;
    const uint32_t p = x->set != y->set ? x->set : x->binding, q = x->set != y->set ? y->set : y->binding;
    return p < q ? -1 : p > q;
}

// Sort a layout. Of equal bindings the largest count stays.
static void settle_layout(rhw_shader_program *program)
{
    struct rhw_shader_layout *const layout = program->layout;
    uint32_t kept = 0;
    if (program->layout_count > 0) {
        qsort(layout, program->layout_count, sizeof *layout, compare_layouts);
    }
    for (uint32_t i = 0; i < program->layout_count; i++) {
        struct rhw_shader_layout *const last = kept > 0 ? &layout[kept - 1] : NULL;
        if (last && last->set == layout[i].set && last->binding == layout[i].binding) {
            last->count = layout[i].count > last->count ? layout[i].count : last->count;
        } else {
            layout[kept++] = layout[i];
        }
    }
    program->layout_count = kept;
}

// Take the layout of the definition, or what the shaders name. Return false without memory.
static bool make_layout(rhw_shader_program *program, const struct rhw_shader_program_def *def)
{
    uint32_t room = def->layout ? def->layout_count : 0;
    for (int s = 0; !def->layout && s < STAGES; s++) {
        room += program->shaders[s] ? program->shaders[s]->info.resource_count : 0;
    }
    program->layout = calloc(room + 1, sizeof *program->layout);
    if (!program->layout) {
        return false;
    }
    if (def->layout) {
        memcpy(program->layout, def->layout, room * sizeof *program->layout);
        program->layout_count = room;
    }
    for (int s = 0; !def->layout && s < STAGES; s++) {
        const rhw_shader *const shader = program->shaders[s];
        for (uint32_t r = 0; shader && r < shader->info.resource_count; r++) {
            const struct rhw_shader_resource *const resource = &shader->info.resources[r];
            program->layout[program->layout_count++] =
                (struct rhw_shader_layout){resource->set, resource->binding, resource->count};
        }
    }
    settle_layout(program);
    return true;
}

static const struct rhw_shader_layout *find_layout(const rhw_shader_program *program, uint32_t set,
                                                   uint32_t binding)
{
    const struct rhw_shader_layout key = {set, binding, 0};
    return program->layout_count == 0
               ? NULL
               : bsearch(&key, program->layout, program->layout_count, sizeof key, compare_layouts);
}

int rhw_shader_program_find(const rhw_shader_program *program, uint32_t set, uint32_t binding)
{
    const struct rhw_shader_layout *const found = find_layout(program, set, binding);
    int first = 0;
    for (const struct rhw_shader_layout *l = program->layout; found && l < found; l++) {
        first += l->set == set ? (int)l->count : 0;
    }
    return found ? first : -1;
}

uint32_t rhw_shader_program_set_size(const rhw_shader_program *program, uint32_t set)
{
    uint32_t size = 0;
    for (uint32_t i = 0; i < program->layout_count; i++) {
        size += program->layout[i].set == set ? program->layout[i].count : 0;
    }
    return size;
}

// Give the resources of a stage their places in the layout. Return false, with a message or without memory, on failure.
static bool place_resources(rhw_shader_program *program, int stage, char *message)
{
    const struct shader_program *const form = program->shaders[stage]->form;
    const struct rhw_shader_info *const info = &program->shaders[stage]->info;
    struct shader_slot *const slots = calloc(form->resource_count + 1, sizeof *slots);
    program->slots[stage] = slots;
    program->bytecode[stage].slots = slots;
    if (!slots) {
        return false;
    }
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const struct rhw_shader_resource *const resource = &info->resources[i];
        const struct rhw_shader_layout *const layout = find_layout(program, resource->set, resource->binding);
        if (!layout || layout->count < resource->count) {
            shader_say(message, "the layout has fewer bindings of set %u, binding %u than a shader names",
                       (unsigned)resource->set, (unsigned)resource->binding);
            return false;
        }
    }
    for (uint32_t r = 0; r < form->resource_count; r++) {
        const struct shader_variable *const variable = form->resources[r].variable;
        const struct rhw_shader_layout *const layout =
            variable->set < 0 || variable->binding < 0
                ? NULL
                : find_layout(program, (uint32_t)variable->set, (uint32_t)variable->binding);
        if (layout) { // otherwise no code reaches it
            slots[r] = (struct shader_slot){
                .set = layout->set,
                .first = (uint32_t)rhw_shader_program_find(program, layout->set, layout->binding),
                .count = layout->count};
        }
    }
    return true;
}

// Linking --------------------------------------------------------------------------------------------

static const char *check_stages(const struct rhw_shader_program_def *def)
{
    const rhw_shader *const given[STAGES] = {def->vertex, def->fragment, def->compute};
    for (int s = 0; s < STAGES; s++) {
        if (given[s] && (int)given[s]->info.stage != s) {
            return "rhw_shader_program_create: a shader stands in the place of another stage";
        }
    }
    if (def->compute ? def->vertex || def->fragment : !def->vertex) {
        return "rhw_shader_program_create: a program has a vertex shader, or a compute shader alone";
    }
    uint64_t bindings = 0;
    for (uint32_t i = 0; def->layout && i < def->layout_count; i++) {
        bindings += def->layout[i].count;
        if (bindings > INT32_MAX) {
            return "rhw_shader_program_create: the bindings of a layout are fewer than 2^31";
        }
        if (def->layout[i].set >= RHW_SHADER_MAX_SETS) {
            return "rhw_shader_program_create: sets of a layout are below RHW_SHADER_MAX_SETS";
        }
    }
    return NULL;
}

// Return whether a fragment stage does anything. One that does nothing draws depth only, as a stage that is left out.
static bool has_work(const struct shader_interface *fragment)
{
    bool has = fragment->discards || fragment->has_effects;
    for (int i = 0; !has && i < SHADER_OUT_COUNT; i++) {
        has = fragment->writes[i];
    }
    return has;
}

struct shader_linked_stage shader_describe_stage(const rhw_shader_program *program,
                                                 enum rhw_shader_stage kind)
{
    const struct shader_bytecode *const bytecode = &program->bytecode[kind];
    return (struct shader_linked_stage){.form = program->shaders[kind]->form,
                                        .slots = program->slots[kind],
                                        .component_of = bytecode->component_of,
                                        .is_linear = bytecode->is_linear,
                                        .w_component = bytecode->w_component,
                                        .batch = bytecode->batch,
                                        .target_count = bytecode->target_count};
}

// Generate the code of a stage. Return the function, or NULL where the interpreter has to do.
static shader_function *generate(rhw_shader_program *program, enum rhw_shader_stage kind)
{
    struct shader_machine_block *const block = &program->machine[kind];
    const struct shader_linked_stage stage = shader_describe_stage(program, kind);
    if (program->is_interpreted || !shader_machine_make(&stage, kind, block)) {
        return NULL;
    }
    return (shader_function *)((uintptr_t)block->code + block->entry);
}

// Put generated code where instruction sets have what it needs.
static void generate_graphics(rhw_shader_program *program, bool has_fragment)
{
    shader_function *const vertex = generate(program, RHW_SHADER_VERTEX);
    shader_function *const fragment = has_fragment ? generate(program, RHW_SHADER_FRAGMENT) : NULL;
    for (int isa = RHW_ISA_AVX2; isa < RHW_ISA_COUNT; isa++) {
        if (vertex) {
            program->program.vertex[isa] = (rhw_vertex_function *)vertex;
        }
        if (fragment) {
            program->program.fragment[isa] = (rhw_fragment_function *)fragment;
        }
    }
}

static bool link_graphics(rhw_shader_program *program, char *message)
{
    static rhw_vertex_function *const vertex[RHW_ISA_COUNT] = RHW_ISA_TABLE(shader_interpret_vertices);
    static rhw_fragment_function *const fragment[RHW_ISA_COUNT] = RHW_ISA_TABLE(shader_interpret_fragments);
    const rhw_shader *const given = program->shaders[RHW_SHADER_FRAGMENT];
    const rhw_shader *const below = given && has_work(&given->interface) ? given : NULL;
    struct shader_bytecode *const bytecode = program->bytecode;
    bool fits = shader_link(&program->shaders[RHW_SHADER_VERTEX]->interface, below ? &below->interface : NULL,
                            &bytecode[RHW_SHADER_VERTEX], below ? &bytecode[RHW_SHADER_FRAGMENT] : NULL,
                            &program->program, message);
    fits =
        fits && shader_link_feedback(program->shaders[RHW_SHADER_VERTEX]->form, &bytecode[RHW_SHADER_VERTEX],
                                     &program->program, &program->feedback, message);
    bytecode[RHW_SHADER_FRAGMENT].target_count = MAX_TARGETS;
    memcpy(program->program.vertex, vertex, sizeof vertex);
    if (below) {
        memcpy(program->program.fragment, fragment, sizeof fragment);
        program->program.early_fragment_tests = below->form->entry->has_early_tests;
    }
    program->program.user = &program->stages;
    if (fits) {
        generate_graphics(program, below != NULL);
    }
    return fits;
}

static void link_compute(rhw_shader_program *program)
{
    static rhw_workgroup_function *const workgroup[RHW_ISA_COUNT] = RHW_ISA_TABLE(shader_interpret_workgroup);
    const rhw_shader *const shader = program->shaders[RHW_SHADER_COMPUTE];
    struct rhw_compute_program *const compute = &program->compute;
    memcpy(compute->workgroup, workgroup, sizeof workgroup);
    for (int i = 0; i < 3; i++) {
        compute->size[i] = (int)shader->info.size[i];
    }
    compute->shared_size = shader->info.shared_size;
    compute->invocation_size = shader->bytecode->invocation_size;
    compute->uniform_size = sizeof(struct rhw_shader_frame);
    compute->uses_atomic_results = shader->interface.uses_atomic_results;
    compute->user = &program->stages;
    shader_function *const generated = generate(program, RHW_SHADER_COMPUTE);
    for (int isa = RHW_ISA_AVX2; generated && isa < RHW_ISA_COUNT; isa++) {
        compute->workgroup[isa] = (rhw_workgroup_function *)generated;
    }
}

// Return false, with a message or without memory, on failure.
static bool link_program(rhw_shader_program *program, const struct rhw_shader_program_def *def, char *message)
{
    const rhw_shader *const given[STAGES] = {def->vertex, def->fragment, def->compute};
    program->is_interpreted = def->is_interpreted;
    for (int s = 0; s < STAGES; s++) {
        if (given[s]) {
            shader_hold(&given[s]->kept);
            program->shaders[s] = given[s];
            program->bytecode[s] = *given[s]->bytecode;
        }
    }
    if (!make_layout(program, def)) {
        return false;
    }
    for (int s = 0; s < STAGES; s++) {
        if (given[s] && !place_resources(program, s, message)) {
            return false;
        }
    }
    program->stages = (struct shader_stages){.vertex = &program->bytecode[RHW_SHADER_VERTEX],
                                             .fragment = &program->bytecode[RHW_SHADER_FRAGMENT],
                                             .compute = &program->bytecode[RHW_SHADER_COMPUTE]};
    if (def->compute) {
        link_compute(program);
        return true;
    }
    return link_graphics(program, message);
}

static void destroy(struct shader_kept *kept)
{
    rhw_shader_program *const program = (rhw_shader_program *)kept;
    for (int s = 0; s < STAGES; s++) {
        shader_machine_free(&program->machine[s]);
        free(program->slots[s]);
        if (program->shaders[s]) {
            shader_release(&program->shaders[s]->kept);
        }
    }
    free(program->layout);
    free(program);
}

// Return the bytes that a program takes, with its shaders.
static size_t program_size(const rhw_shader_program *program)
{
    size_t size = sizeof *program + program->layout_count * sizeof *program->layout;
    for (int s = 0; s < STAGES; s++) {
        size += program->machine[s].size + (program->shaders[s] ? shader_size(program->shaders[s]) : 0);
    }
    return size;
}

// Return a program that is new, or NULL, with a message or without memory.
static rhw_shader_program *make(const struct rhw_shader_program_def *def, char *message)
{
    rhw_shader_program *const made = calloc(1, sizeof *made);
    if (!made) {
        return NULL;
    }
    shader_kept_init(&made->kept, destroy);
    if (!link_program(made, def, message)) {
        shader_release(&made->kept);
        return NULL;
    }
    return made;
}

enum rhw_result rhw_shader_program_create(const struct rhw_shader_program_def *def,
                                          rhw_shader_program **program, char *message)
{
    char own[RHW_SHADER_MESSAGE] = "";
    char *const text = message ? message : own;
    text[0] = '\0';
    *program = NULL;
    const char *const misuse = check_stages(def);
    if (misuse) {
        shader_say(text, "%s", misuse);
        return RHW_ERROR_MISUSE;
    }
    // With the parts of the key: all that the definition has but its cache.
    const size_t begin[] = {STAGES, def->layout != NULL, def->is_interpreted};
    const rhw_shader *const shaders[STAGES] = {def->vertex, def->fragment, def->compute};
    const struct shader_key key = {
        {{begin, sizeof begin},
         {shaders, sizeof shaders},
         {def->layout, def->layout ? def->layout_count * sizeof *def->layout : 0}}};
    struct shader_kept *const found = shader_cache_find(def->cache, &key);
    if (found) {
        *program = (rhw_shader_program *)found;
        return RHW_OK;
    }
    rhw_shader_program *const made = make(def, text);
    if (made) {
        *program = (rhw_shader_program *)shader_cache_add(def->cache, &key, &made->kept, program_size(made));
        return RHW_OK;
    }
    if (text[0]) {
        return RHW_ERROR_MISUSE;
    }
    shader_say(text, "out of memory");
    return RHW_ERROR_OUT_OF_MEMORY;
}

void rhw_shader_program_destroy(rhw_shader_program *program)
{
    if (program) {
        shader_release(&program->kept);
    }
}

bool rhw_shader_program_is_generated(const rhw_shader_program *program, enum rhw_shader_stage stage)
{
    return program->machine[stage].code != NULL;
}

const struct rhw_program *rhw_shader_program_get(const rhw_shader_program *program)
{
    return &program->program;
}

const struct rhw_shader_feedback *rhw_shader_program_get_feedback(const rhw_shader_program *program)
{
    return &program->feedback;
}

const struct rhw_compute_program *rhw_shader_program_get_compute(const rhw_shader_program *program)
{
    return &program->compute;
}
