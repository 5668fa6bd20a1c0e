// SPDX-License-Identifier: MIT
// Inputs and outputs.
#include "c_emit.h"

enum { COMPONENTS = 4, NO_COMPONENT = 0xff };

// Return what the module calls a component of an input or output, or "".
static const char *interface_name(struct shader_emitter *emitter, uint32_t slot,
                                  enum spirv_storage_class storage)
{
    const struct shader_module *const module = emitter->form->module;
    for (uint32_t i = 0; i < module->variable_count; i++) {
        const struct shader_variable *const variable = module->variables[i];
        const uint32_t first = (uint32_t)variable->location * COMPONENTS +
                               (variable->component < 0 ? 0 : (uint32_t)variable->component);
        if (variable->storage == storage && variable->location >= 0 && module->names[variable->id] &&
            slot >= first && slot < first + variable->type->scalars) {
            const char *const name = shader_c_clean(emitter->memory, module->names[variable->id]);
            return variable->type->scalars == 1
                       ? name
                       : shader_format(emitter->memory, "%s[%u]", name, (unsigned)(slot - first));
        }
    }
    return "";
}

static void write_input(struct shader_emitter *emitter, uint32_t value)
{
    const struct shader_node *const node = &emitter->form->nodes[value];
    const struct shader_linked_stage *const stage = emitter->stage;
    const unsigned number = node->immediate, component = stage->component_of[number];
    const unsigned slot = number % SHADER_IN_CENTROID;
    const int w = stage->is_linear[number] ? -1 : (int)stage->w_component;
    const char *text;
    if (emitter->plan.uses[value] == 0) {
        return; // samples for all groups read it
    }
    switch ((enum shader_op)node->op) {
    case SHADER_INPUT:
        text =
            emitter->kind == RHW_SHADER_VERTEX
                ? shader_format(emitter->memory, "v->attribute[%u][%u]", slot / COMPONENTS, slot % COMPONENTS)
                : shader_format(emitter->memory, "f->varying[%u]", component);
        break;
    case SHADER_INPUT_DX: text = shader_format(emitter->memory, "f->ddx[%u]", component); break;
    case SHADER_INPUT_DY: text = shader_format(emitter->memory, "f->ddy[%u]", component); break;
    case SHADER_INPUT_AT:
        text = shader_format(emitter->memory, "rhw_spirv_input_at(f, %u, %d, %s, %s)", component, w,
                             shader_c_argument(emitter, node->operands[0], true),
                             shader_c_argument(emitter, node->operands[1], true));
        break;
    default:
        text = shader_format(emitter->memory, "rhw_spirv_partner(f, %u, %d, %d)", component, w,
                             node->op == SHADER_INPUT_BESIDE ? 0 : 1);
    }
    shader_c_define(emitter, value, text,
                    number < SHADER_IN_CLIP_DISTANCE ? interface_name(emitter, slot, SPIRV_INPUT) : "");
}

// The place of a sample from the centre of the pixel, along an axis.
static void write_sample_place(struct shader_emitter *emitter, uint32_t value)
{
    const struct shader_node *const node = &emitter->form->nodes[value];
    shader_c_define(emitter, value,
                    shader_format(emitter->memory, "rhw_spirv_sample_place(frame, %s, %d)",
                                  shader_c_argument(emitter, node->operands[0], false),
                                  node->op == SHADER_SAMPLE_X ? 0 : 1),
                    "");
}

static const char *fragment_built_in(struct shader_emitter *emitter, uint32_t number)
{
    switch (number) {
    case SHADER_IN_COORD:
    case SHADER_IN_COORD + 1:
    case SHADER_IN_COORD + 2:
    case SHADER_IN_COORD + 3:
        return shader_format(emitter->memory, "f->coord[%u]", (unsigned)(number - SHADER_IN_COORD));
    case SHADER_IN_FRONT_FACING: return "f->front_facing";
    case SHADER_IN_PRIMITIVE: return "f->primitive";
    case SHADER_IN_SAMPLE_ID: return "f->sample_id";
    case SHADER_IN_SAMPLE_POSITION:
    case SHADER_IN_SAMPLE_POSITION + 1:
        return shader_format(emitter->memory, "f->sample_position[%u]",
                             (unsigned)(number - SHADER_IN_SAMPLE_POSITION));
    case SHADER_IN_SAMPLE_MASK: return "f->sample_mask";
    case SHADER_IN_POINT_COORD:
    case SHADER_IN_POINT_COORD + 1:
        return shader_format(emitter->memory, "f->point_coord[%u]",
                             (unsigned)(number - SHADER_IN_POINT_COORD));
    case SHADER_IN_LAYER: return "f->layer";
    case SHADER_IN_VIEWPORT: return "f->viewport_index";
    case SHADER_IN_LANE: return "rhw_lane_numbers()";
    default: return "rhw_splat_int(0)";
    }
}

static const char *invocation_built_in(struct shader_emitter *emitter, uint32_t number)
{
    if (number >= SHADER_IN_LOCAL_INDEX) {
        return number == SHADER_IN_LANE ? "rhw_lane_numbers()" : "i->index";
    }
    const bool is_of_workgroup = number < SHADER_IN_LOCAL;
    const uint32_t first = number >= SHADER_IN_GLOBAL      ? SHADER_IN_GLOBAL
                           : number >= SHADER_IN_LOCAL     ? SHADER_IN_LOCAL
                           : number >= SHADER_IN_WORKGROUP ? SHADER_IN_WORKGROUP
                                                           : SHADER_IN_WORKGROUP_COUNT;
    const char *const array = number >= SHADER_IN_GLOBAL      ? "i->id"
                              : number >= SHADER_IN_LOCAL     ? "i->local"
                              : number >= SHADER_IN_WORKGROUP ? "w->id"
                                                              : "w->counts";
    return shader_format(emitter->memory, is_of_workgroup ? "rhw_splat_int(%s[%u])" : "%s[%u]", array,
                         (unsigned)(number - first));
}

static void write_built_in(struct shader_emitter *emitter, uint32_t value)
{
    const uint32_t number = emitter->form->nodes[value].immediate;
    const char *text;
    switch (emitter->kind) {
    case RHW_SHADER_VERTEX:
        text = number == SHADER_IN_INSTANCE_INDEX ? "v->instance_index"
               : number == SHADER_IN_LANE         ? "rhw_lane_numbers()"
                                                  : "v->vertex_index";
        break;
    case RHW_SHADER_FRAGMENT: text = fragment_built_in(emitter, number); break;
    default: text = invocation_built_in(emitter, number);
    }
    shader_c_define(emitter, value, text, "");
}

// Write what the fragment stage takes as the input of a number, if it does.
static void write_varying(struct shader_emitter *emitter, uint32_t input, const char *number,
                          const char *name)
{
    const unsigned component = emitter->stage->component_of[input];
    if (component != NO_COMPONENT) {
        shader_text_line(emitter->out, "v->varying[%u] = %s;%s%s", component, number, name[0] ? " // " : "",
                         name);
    }
}

static void write_vertex_output(struct shader_emitter *emitter, uint32_t slot, uint32_t value)
{
    const char *const number = shader_c_argument(emitter, value, true);
    const struct shader_linked_stage *const stage = emitter->stage;
    struct shader_text *const out = emitter->out;
    if (slot < SHADER_OUT_POSITION + 4) {
        shader_text_line(out, "v->position[%u] = %s;", (unsigned)(slot - SHADER_OUT_POSITION), number);
        if (slot == SHADER_OUT_POSITION + 3 && stage->w_component != NO_COMPONENT) {
            shader_text_line(out, "v->varying[%u] = v->position[3];", (unsigned)stage->w_component);
        }
    } else if (slot == SHADER_OUT_POINT_SIZE) {
        shader_text_line(out, "v->point_size = %s;", number);
    } else if (slot < SHADER_OUT_CULL_DISTANCE) {
        shader_text_line(out, "v->clip_distance[%u] = %s;", (unsigned)(slot - SHADER_OUT_CLIP_DISTANCE),
                         number);
    } else if (slot < SHADER_OUT_LAYER) {
        shader_text_line(out, "v->cull_distance[%u] = %s;", (unsigned)(slot - SHADER_OUT_CULL_DISTANCE),
                         number);
    } else if (slot == SHADER_OUT_LAYER || slot == SHADER_OUT_VIEWPORT) {
        shader_text_line(out, "v->%s = %s;", slot == SHADER_OUT_LAYER ? "layer" : "viewport_index",
                         shader_c_argument(emitter, value, false));
    } else if (slot >= SHADER_OUT_VARYING) {
        const uint32_t place = slot - SHADER_OUT_VARYING;
        const char *const name = interface_name(emitter, place, SPIRV_OUTPUT);
        write_varying(emitter, SHADER_IN_DECLARED + place, number, name);
        write_varying(emitter, SHADER_IN_CENTROID + place, number, name);
        write_varying(emitter, SHADER_IN_CENTER + place, number, name);
    }
    if (slot >= SHADER_OUT_CLIP_DISTANCE &&
        slot < SHADER_OUT_LAYER) { // clip distances, and behind them cull distances
        write_varying(emitter, SHADER_IN_CLIP_DISTANCE + slot - SHADER_OUT_CLIP_DISTANCE, number, "");
    }
}

static void write_fragment_output(struct shader_emitter *emitter, uint32_t slot, uint32_t value)
{
    const uint32_t channel = slot - SHADER_OUT_VARYING;
    if (slot == SHADER_OUT_DEPTH) {
        shader_text_line(emitter->out, "f->depth = %s;", shader_c_argument(emitter, value, true));
    } else if (slot == SHADER_OUT_SAMPLE_MASK) {
        shader_text_line(emitter->out, "f->sample_mask &= %s;", shader_c_argument(emitter, value, false));
    } else if (slot >= SHADER_OUT_VARYING && channel / COMPONENTS < emitter->stage->target_count) {
        shader_text_line(emitter->out, "f->color[%u][%u] = %s;", (unsigned)(channel / COMPONENTS),
                         (unsigned)(channel % COMPONENTS), shader_c_argument(emitter, value, true));
    }
}

bool shader_c_write_input(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t value = emitter->form->code[place];
    const struct shader_node *const node = &emitter->form->nodes[value];
    switch ((enum shader_op)node->op) {
    case SHADER_INPUT:
    case SHADER_INPUT_DX:
    case SHADER_INPUT_DY:
    case SHADER_INPUT_BESIDE:
    case SHADER_INPUT_BELOW:
    case SHADER_INPUT_AT: write_input(emitter, value); return true;
    case SHADER_SAMPLE_X:
    case SHADER_SAMPLE_Y: write_sample_place(emitter, value); return true;
    case SHADER_BUILT_IN: write_built_in(emitter, value); return true;
    case SHADER_OUTPUT:
        if (emitter->kind == RHW_SHADER_VERTEX) {
            write_vertex_output(emitter, node->immediate, node->operands[0]);
        } else {
            write_fragment_output(emitter, node->immediate, node->operands[0]);
        }
        return true;
    default: return false;
    }
}
