// SPDX-License-Identifier: MIT
// Structure, and which lanes are active. The mask at a place has a name of its own, m1, m2, …, so that it needs
// nothing to come back to an outer one. `alive` has the lanes that have not left: what is active behind structure that
// loses lanes is what came in and is alive. Structure whose lanes all go one way is that of C.
#include "c_emit.h"

#include <string.h>

uint32_t shader_c_new_mask(struct shader_emitter *emitter)
{
    return ++emitter->masks;
}

void shader_c_line_of_mask(struct shader_emitter *emitter, uint32_t mask, const char *expression)
{
    shader_text_line(emitter->out, "const rhw_int m%u = %s;", (unsigned)mask, expression);
}

// Behind structure that loses lanes, those are active that came in and are alive.
static void go_on_alive(struct shader_emitter *emitter, uint32_t came_in)
{
    emitter->mask = shader_c_new_mask(emitter);
    shader_c_line_of_mask(emitter, emitter->mask,
                          shader_format(emitter->memory, "m%u & alive", (unsigned)came_in));
}

// Statements of structure ----------------------------------------------------------------------------

static void write_set(struct shader_emitter *emitter, const struct shader_node *node)
{
    const uint32_t home = node->operands[0];
    const bool is_float = emitter->is_float[home];
    const char *const name = shader_c_name(emitter, home);
    if (shader_resource_of(&emitter->plan, home) != home) {
        return; // a binding that is named once serves everywhere
    }
    const char *const value = shader_c_argument(emitter, node->operands[1], is_float);
    if (strcmp(name, value) == 0) {
        return; // it is in the home already
    }
    // Where lanes go one way, those that are not active never read the home again.
    if (emitter->divergence == 0 || shader_is_shared(emitter->form, home)) {
        shader_text_line(emitter->out, "%s = %s;", name, value);
        return;
    }
    shader_text_line(emitter->out, "%s = %s(m%u, %s, %s);", name, is_float ? "rhw_select" : "rhw_select_int",
                     (unsigned)emitter->mask, value, name);
}

// Jump to the end of structure: out of the innermost loop of C, or to a label.
void shader_c_jump_to_end(struct shader_emitter *emitter, uint32_t structure)
{
    if (emitter->loop_depth > 0 && emitter->loops[emitter->loop_depth - 1] == structure) {
        shader_text_line(emitter->out, "break;");
        return;
    }
    emitter->is_label_used[structure] = true;
    shader_text_line(emitter->out, "goto end%u;", (unsigned)structure);
}

void shader_c_write_label(struct shader_emitter *emitter, uint32_t structure)
{
    if (emitter->is_label_used[structure]) {
        shader_text_line(emitter->out, "end%u:;", (unsigned)structure);
    }
}

// Active lanes leave structure, or are discarded.
static void write_leave(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_node *const node = &emitter->form->nodes[emitter->form->code[place]];
    const bool discards = node->op == SHADER_DISCARD;
    const uint32_t target = discards ? SHADER_NONE : emitter->plan.place[node->operands[0]];
    const struct shader_structure *const structure = discards ? NULL : &emitter->plan.structures[target];
    emitter->is_dead = true;
    if (structure && structure->is_uniform) {
        shader_c_jump_to_end(emitter, target);
        return;
    }
    if (structure && structure->loses) {
        shader_text_line(emitter->out, "left%u |= m%u;", (unsigned)target, (unsigned)emitter->mask);
    }
    shader_text_line(emitter->out, "alive &= ~m%u;", (unsigned)emitter->mask);
}

// Write what stands in a branch, with a mask. Return true if control flow of C comes to its end.
static void write_branch(struct shader_emitter *emitter, uint32_t begin, uint32_t end, uint32_t mask)
{
    emitter->mask = mask;
    emitter->is_dead = false;
    shader_walk_narrow(&emitter->walk, begin, end, SHADER_NONE);
    emitter->is_dead = false;
}

static void write_if(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_structure *const structure = &emitter->plan.structures[place];
    const uint32_t condition = emitter->form->nodes[emitter->form->code[place]].operands[0];
    const uint32_t before = emitter->mask;
    const bool has_else = structure->otherwise != SHADER_NONE;
    const uint32_t middle = has_else ? structure->otherwise : structure->end;
    const char *const truth = shader_c_operand(emitter, condition, false);
    uint32_t bits, inside = before;
    if (structure->is_uniform) {
        const bool is_number = shader_c_is_number(emitter, condition, &bits);
        shader_text_line(emitter->out, is_number ? "if (%s) {" : "if (%s[0]) {", truth);
    } else {
        inside = shader_c_new_mask(emitter);
        shader_c_line_of_mask(emitter, inside,
                              shader_format(emitter->memory, "m%u & %s", (unsigned)before, truth));
        shader_text_line(emitter->out, "if (rhw_any(m%u)) {", (unsigned)inside);
        emitter->divergence++;
    }
    write_branch(emitter, place + 1, middle, inside);
    if (has_else && structure->is_uniform) {
        shader_text_line(emitter->out, "} else {");
        write_branch(emitter, middle + 1, structure->end, before);
    } else if (has_else) {
        const uint32_t outside = shader_c_new_mask(emitter);
        shader_text_line(emitter->out, "}");
        shader_c_line_of_mask(
            emitter, outside,
            shader_format(emitter->memory, "m%u & ~m%u", (unsigned)before, (unsigned)inside));
        shader_text_line(emitter->out, "if (rhw_any(m%u)) {", (unsigned)outside);
        write_branch(emitter, middle + 1, structure->end, outside);
    }
    shader_text_line(emitter->out, "}");
    emitter->divergence -= structure->is_uniform ? 0 : 1;
    emitter->mask = before;
    if (structure->loses) {
        go_on_alive(emitter, before);
    }
}

// Lanes that leave structure come back at its end. Where none is lost further out, all that were alive are again.
static void begin_leaving(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_structure *const structure = &emitter->plan.structures[place];
    if (!structure->is_uniform && structure->loses) {
        shader_text_line(emitter->out, "rhw_int left%u = rhw_splat_int(0);", (unsigned)place);
    } else if (!structure->is_uniform) {
        shader_text_line(emitter->out, "const rhw_int alive%u = alive;", (unsigned)place);
    }
    emitter->divergence += structure->is_uniform ? 0 : 1;
}

static void end_leaving(struct shader_emitter *emitter, uint32_t place, uint32_t before)
{
    const struct shader_structure *const structure = &emitter->plan.structures[place];
    emitter->divergence -= structure->is_uniform ? 0 : 1;
    if (!structure->is_uniform) {
        shader_text_line(emitter->out, structure->loses ? "alive |= left%u;" : "alive = alive%u;",
                         (unsigned)place);
    }
    emitter->is_dead = false;
    emitter->mask = before;
    if (structure->loses) {
        go_on_alive(emitter, before);
    }
}

static void write_region(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t before = emitter->mask;
    begin_leaving(emitter, place);
    shader_text_line(emitter->out, "{");
    shader_walk_narrow(&emitter->walk, place + 1, emitter->plan.structures[place].end, place);
    shader_text_line(emitter->out, "}");
    shader_c_write_label(emitter, place);
    end_leaving(emitter, place, before);
}

// A loop may have no end, so the program is asked now and then whether somebody waits for it.
void shader_c_write_giving_up(struct shader_emitter *emitter)
{
    if (!emitter->counts_rounds) {
        shader_text_line(&emitter->once, "uint32_t rounds = 0;");
        emitter->counts_rounds = true;
    }
    shader_text_line(emitter->out, "if (rhw_spirv_is_given_up(&rounds, %s)) {",
                     emitter->kind == RHW_SHADER_COMPUTE ? "w->bindings" : "groups[0].bindings");
    shader_text_line(emitter->out, "return;");
    shader_text_line(emitter->out, "}");
}

// A round begins with the lanes that came to the end of the one before.
static void write_loop(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_structure *const structure = &emitter->plan.structures[place];
    const uint32_t before = emitter->mask, round = shader_c_new_mask(emitter);
    begin_leaving(emitter, place);
    shader_text_line(emitter->out, "rhw_int m%u = m%u;", (unsigned)round, (unsigned)before);
    if (structure
            ->is_uniform) { // no lane may be active, and then memory that lanes would write does not change
        shader_text_line(emitter->out, "while (rhw_any(m%u)) {", (unsigned)round);
    } else {
        shader_text_line(emitter->out, "do {");
    }
    emitter->loops[emitter->loop_depth++] = place;
    emitter->mask = round;
    shader_walk_narrow(&emitter->walk, place + 1, structure->end, place);
    emitter->loop_depth--;
    if (emitter->is_dead && !structure->is_uniform) {
        shader_text_line(emitter->out, "m%u = rhw_splat_int(0);", (unsigned)round);
    } else if (!emitter->is_dead && emitter->mask != round) {
        shader_text_line(emitter->out, "m%u = m%u;", (unsigned)round, (unsigned)emitter->mask);
    }
    if (!emitter->is_dead) {
        shader_c_write_giving_up(emitter);
    }
    if (structure->is_uniform) {
        shader_text_line(emitter->out, "}");
    } else {
        shader_text_line(emitter->out, "} while (rhw_any(m%u));", (unsigned)round);
    }
    shader_c_write_label(emitter, place);
    end_leaving(emitter, place, before);
}

// The whole ------------------------------------------------------------------------------------------

void shader_c_write_node(void *user, uint32_t place)
{
    struct shader_emitter *const emitter = user;
    const uint32_t value = emitter->form->code[place];
    const struct shader_node *const node = &emitter->form->nodes[value];
    struct shader_text *const out = emitter->out;
    if (emitter->plan.is_hoisted[value]) {
        emitter->out = &emitter->once;
    }
    switch ((enum shader_op)node->op) {
    case SHADER_SET: write_set(emitter, node); break;
    case SHADER_LEAVE:
    case SHADER_DISCARD: write_leave(emitter, place); break;
    default:
        if (!shader_c_write_input(emitter, place) && !shader_c_write_access(emitter, place) &&
            !shader_c_write_image(emitter, place)) {
            shader_c_write_value(emitter, place);
        }
    }
    emitter->out = out;
}

void shader_c_skip_rest(void *user, uint32_t structure)
{
    struct shader_emitter *const emitter = user;
    shader_text_line(emitter->out, "if (!rhw_any(m%u)) {", (unsigned)emitter->mask);
    if (structure == SHADER_NONE) {
        shader_text_line(emitter->out, "f->mask = m%u;", (unsigned)emitter->mask);
        shader_text_line(emitter->out, "continue;");
    } else {
        shader_c_jump_to_end(emitter, structure);
    }
    shader_text_line(emitter->out, "}");
}

void shader_c_write_structure(void *user, uint32_t place)
{
    struct shader_emitter *const emitter = user;
    const enum shader_op op = shader_op_at(&emitter->plan, place);
    if (op == SHADER_IF) {
        write_if(emitter, place);
    } else if (op == SHADER_REGION) {
        write_region(emitter, place);
    } else {
        write_loop(emitter, place);
    }
}
