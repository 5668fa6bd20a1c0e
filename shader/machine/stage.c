// SPDX-License-Identifier: MIT
// A stage as a function: what is computed once a call, the loops over groups, and what stands around them. The function
// begins behind its code, because only then it is known how much of the stack it takes.
#include "code_memory.h"
#include "generator.h"

enum { SAVED = 5, WORD = 8, MAX_STACK = 160 << 10, NEAR = 20 << 10, FEWEST = 4 };

static const int saved[SAVED] = {X86_RBX, X86_R12, X86_R13, X86_R14, X86_R15};

static const struct shader_layout layouts[RHW_SHADER_STAGE_COUNT] = {
    [RHW_SHADER_VERTEX] = {sizeof(struct rhw_vertex), offsetof(struct rhw_vertex, mask),
                           offsetof(struct rhw_vertex, attribute), offsetof(struct rhw_vertex, varying)},
    [RHW_SHADER_FRAGMENT] = {sizeof(struct rhw_fragment), offsetof(struct rhw_fragment, mask),
                             offsetof(struct rhw_fragment, varying), offsetof(struct rhw_fragment, color)},
    [RHW_SHADER_COMPUTE] = {sizeof(struct rhw_invocations), offsetof(struct rhw_invocations, mask), 0, 0},
};

const struct shader_layout *shader_layout_of(const struct shader_generator *g)
{
    return &layouts[g->kind];
}

static void put_immediate(struct shader_generator *g, unsigned instruction, struct x86_operand at,
                          int32_t number)
{
    shader_encode(&g->code, instruction, 0, 0, at, number);
}

static void put_pointer(struct shader_generator *g, int reg, struct x86_operand at)
{
    shader_put(g, X86_MOV | X86_WIDE, reg, 0, at);
}

static void store_pointer(struct shader_generator *g, int reg, struct x86_operand at)
{
    shader_put(g, X86_MOV_STORE | X86_WIDE, reg, 0, at);
}

// Memory of the lanes is 0 at first.
void shader_clear_own(struct shader_generator *g)
{
    if (g->form->private_count == 0) {
        return;
    }
    const uint32_t again = shader_label_new(&g->code);
    shader_put(g, X86_LEA | X86_WIDE, X86_RAX, 0,
               x86_at(g->plan.has_cuts ? X86_R15 : X86_RSP, (int32_t)g->own));
    shader_encode_number(&g->code, X86_RCX, g->form->private_count);
    shader_put(g, X86_VXORPS, 0, 0, x86_reg(0));
    shader_label_place(&g->code, again);
    shader_put(g, X86_VMOVUPS_STORE, 0, 0, x86_at(X86_RAX, 0));
    put_immediate(g, X86_ADD_I | X86_WIDE, x86_reg(X86_RAX), VECTOR);
    put_immediate(g, X86_SUB_I, x86_reg(X86_RCX), 1);
    shader_encode_jump_if(&g->code, X86_NOT_EQUAL, again);
}

// What is computed once ------------------------------------------------------------------------------

static void generate_once(struct shader_generator *g)
{
    for (uint32_t i = 0; i < g->form->code_count; i++) {
        if (g->plan.is_hoisted[g->form->code[i]]) {
            shader_generate_node(g, i);
        }
    }
    g->place = g->form->code_count;
    shader_pair_once(g);
    shader_list_group_samples(g);
    shader_flush(g, UINT32_MAX);
    shader_forget_registers(g);
    for (uint32_t value = 0; value < g->value_count; value++) {
        g->values[value].use = 0;
    }
    g->place = 0;
}

// Stages ---------------------------------------------------------------------------------------------

static void begin_home(struct shader_generator *g, uint32_t home)
{
    shader_put(g, X86_VBROADCASTSS, 0, 0, shader_pool_scalar(&g->code, g->form->nodes[home].immediate));
    shader_put(g, X86_VMOVUPS_STORE, 0, 0, shader_home_of(g, home));
}

static bool has_functions_of_groups(const struct shader_generator *g)
{
    for (uint32_t i = 0; i < g->form->code_count; i++) {
        if (g->plan.is_for_groups[i]) {
            return true;
        }
    }
    return false;
}

// Begin what goes from run to run: masks, homes that are kept or joint, memory of the lanes.
static void begin_records(struct shader_generator *g)
{
    const struct shader_program *const form = g->form;
    g->mask = shader_new_value(g);
    g->alive = shader_new_value(g);
    g->group_pointer = shader_take_record(g, sizeof(void *));
    g->values[g->mask].is_kept = g->values[g->alive].is_kept = true;
    for (uint32_t value = 0; value < form->node_count; value++) {
        if (form->nodes[value].op == SHADER_HOME && g->plan.is_joint[value]) {
            begin_home(g, value);
        }
    }
    const uint32_t list = has_functions_of_groups(g) ? shader_list_of_all(g) : 0;
    shader_open_groups(g, &(struct shader_groups){.is_plain = true, .lists = list});
    if (list > 0) {
        shader_list_group(g, -1);
    }
    store_pointer(g, X86_RBX, x86_at(X86_R15, (int32_t)g->group_pointer));
    shader_put(g, X86_VMOVUPS, 0, 0, x86_at(X86_RBX, layouts[g->kind].mask));
    shader_put(g, X86_VMOVUPS_STORE, 0, 0, shader_home_of(g, g->mask));
    shader_put(g, X86_VMOVUPS_STORE, 0, 0, shader_home_of(g, g->alive));
    for (uint32_t value = 0; value < form->node_count; value++) {
        if (form->nodes[value].op == SHADER_HOME && g->plan.is_kept[value]) {
            begin_home(g, value);
        }
    }
    shader_clear_own(g);
    shader_close_groups(g);
}

static void end_records(struct shader_generator *g)
{
    if (g->kind == RHW_SHADER_FRAGMENT && g->plan.loses_lanes) {
        const struct x86_operand mask = x86_at(X86_RBX, layouts[g->kind].mask);
        shader_open_groups(g, &(struct shader_groups){.is_plain = true});
        shader_put(g, X86_VMOVUPS, 0, 0, shader_home_of(g, g->alive));
        shader_put(g, X86_VANDPS, 0, 0, mask);
        shader_put(g, X86_VMOVUPS_STORE, 0, 0, mask);
        shader_close_groups(g);
    }
}

// Groups go through the code in batches where they have records.
static void generate_batches(struct shader_generator *g)
{
    const uint32_t again = shader_label_new(&g->code), fits = shader_label_new(&g->code);
    shader_label_place(&g->code, again);
    shader_put(g, X86_MOV, X86_RAX, 0, SHADER_FRAME(count));
    shader_put(g, X86_CMP, X86_RAX, 0, SHADER_FRAME(batch));
    shader_encode_jump_if(&g->code, X86_BELOW_EQUAL, fits);
    shader_put(g, X86_MOV, X86_RAX, 0, SHADER_FRAME(batch));
    shader_label_place(&g->code, fits);
    shader_put(g, X86_MOV_STORE, X86_RAX, 0, SHADER_FRAME(together.here));
    shader_sample_groups(g);
    if (g->plan.has_cuts) {
        begin_records(g);
        shader_generate_code(g);
        end_records(g);
    } else {
        shader_generate_code(g);
    }
    shader_put(g, X86_MOV, X86_RAX, 0, SHADER_FRAME(together.here));
    shader_encode(&g->code, X86_IMUL_I | X86_WIDE, X86_RCX, 0, x86_reg(X86_RAX), layouts[g->kind].size);
    shader_put(g, X86_ADD_STORE | X86_WIDE, X86_RCX, 0, SHADER_FRAME(together.groups));
    shader_put(g, X86_SUB_STORE, X86_RAX, 0, SHADER_FRAME(count));
    shader_encode_jump_if(&g->code, X86_NOT_EQUAL, again);
}

static void generate_body(struct shader_generator *g)
{
    const uint32_t own = g->form->private_count * VECTOR;
    shader_take_group_samples(g);
    g->has_records = g->plan.has_cuts || g->sample_count > 0;
    g->own = g->plan.has_cuts ? shader_take_record(g, own) : shader_take_frame(g, own);
    generate_once(g);
    if (!g->plan.has_cuts) {
        g->mask = shader_new_value(g);
        g->alive = shader_new_value(g);
        g->values[g->mask].home = SHADER_IN_GROUP;
        g->values[g->mask].offset = (uint32_t)layouts[g->kind].mask;
    }
    if (g->has_records) {
        generate_batches(g);
    } else {
        shader_generate_code(g);
    }
    shader_label_place(&g->code, g->exit);
    shader_put(g, X86_VZEROUPPER | X86_NARROW, 0, 0, x86_reg(0));
    shader_put(g, X86_LEA | X86_WIDE, X86_RSP, 0, x86_at(X86_RBP, -SAVED * WORD));
    for (int i = SAVED; i-- > 0;) {
        shader_encode(&g->code, X86_POP, saved[i], 0, x86_reg(0), 0);
    }
    shader_encode(&g->code, X86_POP, X86_RBP, 0, x86_reg(0), 0);
    shader_put(g, X86_RET, 0, 0, x86_reg(0));
}

// Return how many groups go through the code together. Where it shows nowhere how many, what they keep stays near.
static uint32_t batch_of(const struct shader_generator *g)
{
    const uint32_t most = g->stage->batch;
    if ((g->plan.has_cuts && !g->plan.has_steps_alone) || g->record_size * most <= NEAR) {
        return most;
    }
    const uint32_t parts = (g->record_size * most + NEAR - 1) / NEAR, near = (most + parts - 1) / parts,
                   few = most < FEWEST ? most : FEWEST;
    return near < few ? few : near;
}

#if defined(RHW_GUARDS)

// Go on with a stack of the thread's own, whose end is guarded.
static void take_stack(struct shader_generator *g, int32_t size)
{
    static const int kept[] = {X86_RDI, X86_RSI, X86_RSI}; // three, so that the stack is aligned
    void *(*const function)(void) = shader_guarded_stack;
    for (int i = 0; i < 3; i++) {
        shader_encode(&g->code, X86_PUSH, kept[i], 0, x86_reg(0), 0);
    }
    shader_put(g, X86_CALL, 0, 0, shader_pool_bytes(&g->code, &function, sizeof function));
    for (int i = 3; i-- > 0;) {
        shader_encode(&g->code, X86_POP, kept[i], 0, x86_reg(0), 0);
    }
    shader_put(g, X86_LEA | X86_WIDE, X86_RSP, 0, x86_at(X86_RAX, -size));
}

#else

static void take_stack(struct shader_generator *g, int32_t size)
{
    enum { PAGE = 4096 - 64 };
    int32_t left = size;
    for (; left > PAGE; left -= PAGE) { // no page is stepped over, as one may guard the stack
        put_immediate(g, X86_SUB_I | X86_WIDE, x86_reg(X86_RSP), PAGE);
        put_immediate(g, X86_MOV_I, x86_at(X86_RSP, 0), 0);
    }
    put_immediate(g, X86_SUB_I | X86_WIDE, x86_reg(X86_RSP), left);
    put_immediate(g, X86_AND_I | X86_WIDE, x86_reg(X86_RSP), -VECTOR);
}

#endif

// Where the function begins. It goes to its body.
static void generate_entry(struct shader_generator *g, uint32_t body)
{
    const bool is_compute = g->kind == RHW_SHADER_COMPUTE;
    const size_t bound = is_compute                       ? offsetof(struct rhw_workgroup, uniforms)
                         : g->kind == RHW_SHADER_FRAGMENT ? offsetof(struct rhw_fragment, uniforms)
                                                          : offsetof(struct rhw_vertex, uniforms);
    shader_encode(&g->code, X86_PUSH, X86_RBP, 0, x86_reg(0), 0);
    shader_put(g, X86_MOV | X86_WIDE, X86_RBP, 0, x86_reg(X86_RSP));
    for (int i = 0; i < SAVED; i++) {
        shader_encode(&g->code, X86_PUSH, saved[i], 0, x86_reg(0), 0);
    }
    const uint32_t batch = batch_of(g);
    take_stack(g, (int32_t)(g->frame_size + batch * g->record_size));
    put_pointer(g, X86_RAX, x86_at(X86_RDI, (int32_t)bound));
    store_pointer(g, X86_RAX, SHADER_FRAME(bound));
    if (is_compute) {
        shader_put(g, X86_MOV | X86_WIDE, X86_R14, 0, x86_reg(X86_RDI));
        shader_put(g, X86_MOV, X86_RSI, 0, x86_at(X86_RDI, offsetof(struct rhw_workgroup, count)));
        put_pointer(g, X86_RDI, x86_at(X86_RDI, offsetof(struct rhw_workgroup, groups)));
    }
    store_pointer(g, X86_RDI, SHADER_FRAME(together.groups));
    put_immediate(g, X86_MOV_I, SHADER_FRAME(batch), (int32_t)batch);
    shader_put(g, X86_MOV_STORE, X86_RSI, 0, SHADER_FRAME(count));
    shader_put(g, X86_MOV_STORE, X86_RSI, 0, SHADER_FRAME(together.here));
    shader_put(g, X86_LEA | X86_WIDE, X86_RAX, 0, x86_at(X86_RSP, (int32_t)g->frame_size));
    store_pointer(g, X86_RAX, SHADER_FRAME(together.records));
    shader_encode_number(&g->code, X86_RAX, g->record_size);
    store_pointer(g, X86_RAX, SHADER_FRAME(together.record_size));
    put_immediate(g, X86_MOV_I, SHADER_FRAME(rounds), SHADER_ROUNDS_A_QUESTION);
    shader_encode_jump(&g->code, body);
}

static bool generate(struct shader_memory *memory, const struct shader_linked_stage *stage,
                     enum rhw_shader_stage kind, int registers, bool has_records, bool has_steps,
                     struct shader_generated *made)
{
    const uint32_t places = stage->form->code_count + 1;
    struct shader_generator g = {.memory = memory,
                                 .stage = stage,
                                 .kind = kind,
                                 .form = stage->form,
                                 .allowed = (1u << registers) - 1,
                                 .ends = shader_take(memory, places, sizeof *g.ends),
                                 .left = shader_take(memory, places, sizeof *g.left),
                                 .lists = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *g.lists)};
    shader_make_plan(memory, stage->form, has_steps, &g.plan);
    shader_encoder_init(&g.code, memory);
    g.code.has_records = has_records;
    shader_registers_init(&g);
    (void)shader_take_frame(&g, sizeof(struct shader_machine_frame));
    const uint32_t body = shader_label_new(&g.code);
    g.exit = shader_label_new(&g.code);
    shader_label_place(&g.code, body);
    generate_body(&g);
    if (g.sample_count > 0) { // texels stand at multiples of their size
        g.record_size = (g.record_size + 4 * VECTOR - 1) / (4 * VECTOR) * (4 * VECTOR);
    }
    if (g.frame_size + (uint64_t)batch_of(&g) * g.record_size > MAX_STACK) {
        return false;
    }
    made->entry = g.code.size;
    generate_entry(&g, body);
    (void)shader_encoder_finish(&g.code);
    made->code = g.code;
    return true;
}

bool shader_generate(struct shader_memory *memory, const struct shader_linked_stage *stage,
                     enum rhw_shader_stage kind, int registers, bool has_records,
                     struct shader_generated *made)
{
    const uint32_t *const size = stage->form->entry->local_size;
    const bool has_steps = kind != RHW_SHADER_COMPUTE || size[0] * size[1] * size[2] > FEWEST / 2 * RHW_LANES;
    // What groups keep from step to step may be more than the stack has room for.
    return generate(memory, stage, kind, registers, has_records, has_steps, made) ||
           (has_steps && generate(memory, stage, kind, registers, has_records, false, made));
}
