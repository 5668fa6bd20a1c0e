// SPDX-License-Identifier: MIT
// Inputs, which mostly are read where the library put them, and outputs.
#include "generator.h"

static void place_value(struct shader_generator *g, uint32_t value, enum shader_home_kind home, size_t offset)
{
    g->values[value].home = (uint8_t)home;
    g->values[value].offset = (uint32_t)offset;
    g->values[value].is_stored = true;
}

// Load what a pointer of the group points to.
static void load_behind(struct shader_generator *g, uint32_t value, size_t pointer, uint32_t component)
{
    const int result = shader_result(g, value);
    shader_put(g, X86_MOV | X86_WIDE, X86_RAX, 0, x86_at(X86_RBX, (int32_t)pointer));
    shader_put(g, X86_VMOVUPS, result, 0, x86_at(X86_RAX, (int32_t)(component * VECTOR)));
}

static void invoke_input(struct shader_generator *g, uint32_t value, uint32_t component, int w)
{
    const struct shader_node *const node = &g->form->nodes[value];
    struct shader_invocation call = {.which = node->op, .argument_count = 3, .result = value};
    call.arguments[0] = shader_address_argument(x86_at(X86_RBX, 0));
    call.arguments[1] = shader_number_argument(component);
    call.arguments[2] = shader_number_argument((uint32_t)w);
    if (node->op == SHADER_INPUT_AT) {
        call.vector_count = 2;
        call.vectors[0] = node->operands[0];
        call.vectors[1] = node->operands[1];
    }
    shader_invoke(g, &call);
}

static void select_input(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    const uint32_t number = node->immediate, component = g->stage->component_of[number];
    if (g->plan.uses[value] == 0) {
        return; // it was for samples of all groups
    }
    switch ((enum shader_op)node->op) {
    case SHADER_INPUT:
        place_value(g, value, SHADER_IN_INPUTS,
                    VECTOR * (g->kind == RHW_SHADER_VERTEX ? number % SHADER_IN_CENTROID : component));
        return;
    case SHADER_INPUT_DX: load_behind(g, value, offsetof(struct rhw_fragment, ddx), component); return;
    case SHADER_INPUT_DY: load_behind(g, value, offsetof(struct rhw_fragment, ddy), component); return;
    default: invoke_input(g, value, component, g->stage->is_linear[number] ? -1 : g->stage->w_component);
    }
}

static void invoke_sample_place(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    const struct shader_invocation call = {.which = node->op,
                                           .argument_count = 1,
                                           .arguments = {shader_bound_argument()},
                                           .vector_count = 1,
                                           .vectors = {node->operands[0]},
                                           .result = value};
    shader_invoke(g, &call);
}

// Built-in inputs ------------------------------------------------------------------------------------

struct x86_operand shader_lane_numbers(struct shader_generator *g)
{
    static const int32_t numbers[RHW_LANES] = {0, 1, 2, 3, 4, 5, 6, 7};
    return shader_pool_bytes(&g->code, numbers, sizeof numbers);
}

// Inputs that lie in the group, with their components behind one another.
static const struct {
    uint16_t number, count;
    size_t offset;
} places[RHW_SHADER_STAGE_COUNT][8] = {
    [RHW_SHADER_VERTEX] = {{SHADER_IN_VERTEX_INDEX, 1, offsetof(struct rhw_vertex, vertex_index)},
                           {SHADER_IN_INSTANCE_INDEX, 1, offsetof(struct rhw_vertex, instance_index)}},
    [RHW_SHADER_FRAGMENT] = {{SHADER_IN_COORD, 4, offsetof(struct rhw_fragment, coord)},
                             {SHADER_IN_FRONT_FACING, 1, offsetof(struct rhw_fragment, front_facing)},
                             {SHADER_IN_PRIMITIVE, 1, offsetof(struct rhw_fragment, primitive)},
                             {SHADER_IN_SAMPLE_ID, 1, offsetof(struct rhw_fragment, sample_id)},
                             {SHADER_IN_SAMPLE_POSITION, 2, offsetof(struct rhw_fragment, sample_position)},
                             {SHADER_IN_POINT_COORD, 2, offsetof(struct rhw_fragment, point_coord)},
                             {SHADER_IN_LAYER, 1, offsetof(struct rhw_fragment, layer)},
                             {SHADER_IN_VIEWPORT, 1, offsetof(struct rhw_fragment, viewport_index)}},
    [RHW_SHADER_COMPUTE] = {{SHADER_IN_GLOBAL, 3, offsetof(struct rhw_invocations, id)},
                            {SHADER_IN_LOCAL, 3, offsetof(struct rhw_invocations, local)},
                            {SHADER_IN_LOCAL_INDEX, 1, offsetof(struct rhw_invocations, index)}},
};

static void select_built_in(struct shader_generator *g, uint32_t value)
{
    const uint32_t number = g->form->nodes[value].immediate;
    for (int i = 0; i < 8; i++) {
        const uint32_t component = number - places[g->kind][i].number;
        if (component < places[g->kind][i].count) {
            place_value(g, value, SHADER_IN_GROUP, places[g->kind][i].offset + VECTOR * component);
            return;
        }
    }
    const int result = shader_result(g, value);
    if (number == SHADER_IN_LANE) {
        shader_put(g, X86_VMOVUPS, result, 0, shader_lane_numbers(g));
    } else if (g->kind == RHW_SHADER_FRAGMENT && number == SHADER_IN_SAMPLE_MASK) { // an output changes it
        shader_put(g, X86_VMOVUPS, result, 0, x86_at(X86_RBX, offsetof(struct rhw_fragment, sample_mask)));
    } else if (g->kind == RHW_SHADER_COMPUTE && number >= SHADER_IN_WORKGROUP_COUNT) {
        const uint32_t component = number - SHADER_IN_WORKGROUP_COUNT;
        const size_t offset = component < 3 ? offsetof(struct rhw_workgroup, counts) + 4 * component
                                            : offsetof(struct rhw_workgroup, id) + 4 * (component - 3);
        shader_put(g, X86_VBROADCASTSS, result, 0, x86_at(X86_R14, (int32_t)offset));
    } else {
        shader_put(g, X86_VXORPS, result, result, x86_reg(result));
    }
}

// Outputs --------------------------------------------------------------------------------------------

static void put_varying(struct shader_generator *g, uint32_t input, int reg)
{
    const uint32_t component = g->stage->component_of[input];
    if (component != NO_COMPONENT) {
        shader_put(g, X86_VMOVUPS_STORE, reg, 0, x86_at(X86_R13, (int32_t)(component * VECTOR)));
    }
}

static void put_behind(struct shader_generator *g, size_t pointer, uint32_t number, int reg)
{
    shader_put(g, X86_MOV | X86_WIDE, X86_RAX, 0, x86_at(X86_RBX, (int32_t)pointer));
    shader_put(g, X86_VMOVUPS_STORE, reg, 0, x86_at(X86_RAX, (int32_t)(number * VECTOR)));
}

static void put_in_group(struct shader_generator *g, size_t offset, int reg)
{
    shader_put(g, X86_VMOVUPS_STORE, reg, 0, x86_at(X86_RBX, (int32_t)offset));
}

static void put_vertex_output(struct shader_generator *g, uint32_t slot, int reg)
{
    if (slot < SHADER_OUT_POSITION + 4) {
        put_in_group(g, offsetof(struct rhw_vertex, position) + VECTOR * (slot - SHADER_OUT_POSITION), reg);
        if (slot == SHADER_OUT_POSITION + 3 && g->stage->w_component != NO_COMPONENT) {
            shader_put(g, X86_VMOVUPS_STORE, reg, 0,
                       x86_at(X86_R13, (int32_t)(g->stage->w_component * VECTOR)));
        }
    } else if (slot == SHADER_OUT_POINT_SIZE) {
        put_in_group(g, offsetof(struct rhw_vertex, point_size), reg);
    } else if (slot < SHADER_OUT_CULL_DISTANCE) {
        put_behind(g, offsetof(struct rhw_vertex, clip_distance), slot - SHADER_OUT_CLIP_DISTANCE, reg);
    } else if (slot < SHADER_OUT_LAYER) {
        put_behind(g, offsetof(struct rhw_vertex, cull_distance), slot - SHADER_OUT_CULL_DISTANCE, reg);
    } else if (slot == SHADER_OUT_LAYER) {
        put_in_group(g, offsetof(struct rhw_vertex, layer), reg);
    } else if (slot == SHADER_OUT_VIEWPORT) {
        put_in_group(g, offsetof(struct rhw_vertex, viewport_index), reg);
    } else if (slot >= SHADER_OUT_VARYING) {
        const uint32_t place = slot - SHADER_OUT_VARYING;
        put_varying(g, SHADER_IN_DECLARED + place, reg);
        put_varying(g, SHADER_IN_CENTROID + place, reg);
        put_varying(g, SHADER_IN_CENTER + place, reg);
    }
    if (slot >= SHADER_OUT_CLIP_DISTANCE &&
        slot < SHADER_OUT_LAYER) { // clip distances, and behind them cull distances
        put_varying(g, SHADER_IN_CLIP_DISTANCE + slot - SHADER_OUT_CLIP_DISTANCE, reg);
    }
}

static void put_fragment_output(struct shader_generator *g, uint32_t slot, int reg)
{
    const uint32_t channel = slot - SHADER_OUT_VARYING;
    if (slot == SHADER_OUT_DEPTH) {
        put_in_group(g, offsetof(struct rhw_fragment, depth), reg);
    } else if (slot == SHADER_OUT_SAMPLE_MASK) {
        const int left = shader_temporary(g);
        shader_put(g, X86_VANDPS, left, reg, x86_at(X86_RBX, offsetof(struct rhw_fragment, sample_mask)));
        put_in_group(g, offsetof(struct rhw_fragment, sample_mask), left);
    } else if (slot >= SHADER_OUT_VARYING && channel / 4 < g->stage->target_count) {
        shader_put(g, X86_VMOVUPS_STORE, reg, 0, x86_at(X86_R13, (int32_t)(channel * VECTOR)));
    }
}

bool shader_select_input(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    switch ((enum shader_op)node->op) {
    case SHADER_INPUT:
    case SHADER_INPUT_DX:
    case SHADER_INPUT_DY:
    case SHADER_INPUT_BESIDE:
    case SHADER_INPUT_BELOW:
    case SHADER_INPUT_AT: select_input(g, value); return true;
    case SHADER_SAMPLE_X:
    case SHADER_SAMPLE_Y: invoke_sample_place(g, value); return true;
    case SHADER_BUILT_IN: select_built_in(g, value); return true;
    case SHADER_OUTPUT:
        if (g->kind == RHW_SHADER_VERTEX) {
            put_vertex_output(g, node->immediate, shader_in_register(g, node->operands[0]));
        } else {
            put_fragment_output(g, node->immediate, shader_in_register(g, node->operands[0]));
        }
        return true;
    default: return false;
    }
}
