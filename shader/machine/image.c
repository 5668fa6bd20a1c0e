// SPDX-License-Identifier: MIT
// Images: operands are stored into a request, and a call does what is asked.
#include "generator.h"

#include <string.h>

uint32_t shader_sampler_of(const struct shader_generator *g, const struct shader_node *node,
                           const uint32_t *operands)
{
    return node->immediate & SHADER_IMAGE_HAS_SAMPLER
               ? shader_resource_of(&g->plan, operands[SHADER_IMAGE_SAMPLER])
               : SHADER_NONE;
}

bool shader_is_one_image(const struct shader_generator *g, uint32_t texture, uint32_t sampler)
{
    return shader_is_one(g, texture) && (sampler == SHADER_NONE || shader_is_one(g, sampler));
}

// Pairs ----------------------------------------------------------------------------------------------

static struct shader_machine_pair *find_pair(const struct shader_generator *g, uint32_t texture,
                                             uint32_t sampler)
{
    for (uint32_t i = 0; i < g->pair_count; i++) {
        if (g->pairs[i].texture == texture && g->pairs[i].sampler == sampler) {
            return &g->pairs[i];
        }
    }
    return NULL;
}

// Give a pair a place in the frame.
static struct shader_argument add_pair(struct shader_generator *g, uint32_t texture, uint32_t sampler,
                                       uint32_t size)
{
    if (g->pair_count == g->pair_room) {
        g->pairs = shader_grow(g->memory, g->pairs, &g->pair_room, sizeof *g->pairs);
    }
    const uint32_t offset = shader_take_frame(g, size);
    g->pairs[g->pair_count++] = (struct shader_machine_pair){texture, sampler, offset};
    return shader_address_argument(x86_at(X86_RSP, (int32_t)offset));
}

static void put_together(struct shader_generator *g, uint32_t texture, uint32_t sampler)
{
    shader_invoke_plain(
        g, SHADER_CALL_FIND_PAIR, 3,
        (struct shader_argument[]){shader_found_argument(g, texture), shader_found_argument(g, sampler),
                                   add_pair(g, texture, sampler, sizeof(struct shader_found_pair))});
}

// Return true for a fetch from level 0 of which nothing but the first component is read, by the part behind it.
static bool is_plane_fetch(const struct shader_generator *g, uint32_t place)
{
    const uint32_t value = g->form->code[place];
    struct shader_node *const nodes = g->form->nodes;
    if (nodes[value].op != SHADER_SAMPLE || g->plan.uses[value] != 1 || place + 1 == g->form->code_count ||
        nodes[value].immediate != (SHADER_DO_FETCH | 2 << SHADER_IMAGE_SPATIAL_SHIFT)) {
        return false;
    }
    const struct shader_node *const part = &nodes[g->form->code[place + 1]];
    uint32_t count;
    const uint32_t *const operands = shader_operands(g->form, &nodes[value], &count);
    return part->op == SHADER_PART && part->operands[0] == value && part->immediate == 0 &&
           shader_is_one(g, shader_resource_of(&g->plan, operands[SHADER_IMAGE_TEXTURE]));
}

static void find_plane(struct shader_generator *g, uint32_t texture)
{
    if (find_pair(g, texture, SHADER_NONE)) {
        return;
    }
    shader_invoke_plain(
        g, SHADER_CALL_FIND_PLANE, 2,
        (struct shader_argument[]){shader_found_argument(g, texture),
                                   add_pair(g, texture, SHADER_NONE, sizeof(struct shader_found_plane))});
}

void shader_pair_once(struct shader_generator *g)
{
    for (uint32_t i = 0; i < g->form->code_count; i++) {
        struct shader_node *const node = &g->form->nodes[g->form->code[i]];
        if (is_plane_fetch(g, i)) {
            uint32_t count;
            find_plane(g, shader_resource_of(&g->plan,
                                             shader_operands(g->form, node, &count)[SHADER_IMAGE_TEXTURE]));
            continue;
        }
        if (node->op != SHADER_SAMPLE && node->op != SHADER_IMAGE_STORE) {
            continue;
        }
        uint32_t count;
        const uint32_t *const operands = shader_operands(g->form, node, &count);
        const uint32_t texture = shader_resource_of(&g->plan, operands[SHADER_IMAGE_TEXTURE]),
                       sampler = shader_sampler_of(g, node, operands);
        if (sampler != SHADER_NONE && shader_is_one_image(g, texture, sampler) &&
            !find_pair(g, texture, sampler)) {
            put_together(g, texture, sampler);
        }
    }
}

// Requests -------------------------------------------------------------------------------------------

static void put_in_request(struct shader_generator *g, int reg, size_t offset)
{
    const size_t request = offsetof(struct shader_machine_frame, request);
    shader_put(g, X86_VMOVUPS_STORE, reg, 0, x86_at(X86_RSP, (int32_t)(request + offset)));
    shader_unlock(g);
}

static void put_operand(struct shader_generator *g, uint32_t value, size_t offset)
{
    put_in_request(g, shader_in_register(g, value), offset);
}

// Store operands behind one another, and zeros behind them.
static void put_operands(struct shader_generator *g, const uint32_t *values, uint32_t count, uint32_t all,
                         size_t offset)
{
    for (uint32_t i = 0; i < count; i++) {
        put_operand(g, values[i], offset + VECTOR * i);
    }
    for (uint32_t i = count; i < all; i++) {
        const int zero = shader_temporary(g);
        shader_put(g, X86_VXORPS, zero, zero, x86_reg(zero));
        put_in_request(g, zero, offset + VECTOR * i);
    }
}

static void put_request(struct shader_generator *g, const uint32_t *operands, uint32_t flags)
{
    static const struct {
        uint32_t flag, operand;
        size_t offset;
    } singles[] = {
        {SHADER_IMAGE_HAS_LOD, SHADER_IMAGE_LOD, offsetof(struct shader_request, lod)},
        {SHADER_IMAGE_HAS_REFERENCE, SHADER_IMAGE_REFERENCE, offsetof(struct shader_request, reference)},
        {SHADER_IMAGE_HAS_BIAS, SHADER_IMAGE_BIAS, offsetof(struct shader_request, bias)},
        {SHADER_IMAGE_HAS_LEAST_LOD, SHADER_IMAGE_LEAST_LOD, offsetof(struct shader_request, least)},
        {SHADER_IMAGE_HAS_SAMPLE, SHADER_IMAGE_SAMPLE, offsetof(struct shader_request, sample)},
    };
    const uint32_t spatial = flags >> SHADER_IMAGE_SPATIAL_SHIFT & 3;
    const uint32_t count = spatial + (flags & SHADER_IMAGE_IS_ARRAYED ? 1 : 0);
    put_operands(g, &operands[SHADER_IMAGE_COORDINATES], count < 4 ? count : 4, 4,
                 offsetof(struct shader_request, at));
    if (flags & SHADER_IMAGE_HAS_GRADIENT) {
        put_operands(g, &operands[SHADER_IMAGE_DX], spatial, spatial,
                     offsetof(struct shader_request, gradient));
        put_operands(g, &operands[SHADER_IMAGE_DY], spatial, 6 - spatial,
                     offsetof(struct shader_request, gradient) + VECTOR * spatial);
    }
    if (flags & SHADER_IMAGE_HAS_OFFSET) {
        put_operands(g, &operands[SHADER_IMAGE_OFFSET], spatial, 3, offsetof(struct shader_request, offset));
    }
    for (size_t i = 0; i < sizeof singles / sizeof *singles; i++) {
        if (flags & singles[i].flag) {
            put_operand(g, operands[singles[i].operand], singles[i].offset);
        }
    }
}

// What lanes name, where they do not all name the same.
static void put_named(struct shader_generator *g, uint32_t texture, uint32_t sampler)
{
    put_operand(g, shader_element_of(g, texture), offsetof(struct shader_request, texture));
    if (sampler != SHADER_NONE) {
        put_operand(g, shader_element_of(g, sampler), offsetof(struct shader_request, sampler));
    }
}

// The binding that all lanes name.
struct shader_argument shader_one_image(struct shader_generator *g, uint32_t texture, uint32_t sampler)
{
    return sampler == SHADER_NONE
               ? shader_found_argument(g, texture)
               : shader_address_argument(x86_at(X86_RSP, (int32_t)find_pair(g, texture, sampler)->offset));
}

static void invoke_image(struct shader_generator *g, uint32_t value, bool is_store)
{
    struct shader_node *const node = &g->form->nodes[value];
    uint32_t count;
    const uint32_t *const operands = shader_operands(g->form, node, &count);
    const uint32_t texture = shader_resource_of(&g->plan, operands[SHADER_IMAGE_TEXTURE]),
                   sampler = shader_sampler_of(g, node, operands);
    const bool is_one = shader_is_one_image(g, texture, sampler);
    put_request(g, operands, node->immediate);
    if (is_store) {
        put_operands(g, &operands[SHADER_IMAGE_TEXEL], 4, 4, offsetof(struct shader_request, texel));
    }
    if (!is_one) {
        put_named(g, texture, sampler);
    }
    if (!is_one || is_store) {
        put_operand(g, g->mask, offsetof(struct shader_request, mask));
    }
    struct shader_invocation call = {.which = node->op, .argument_count = 4, .result = SHADER_NONE};
    call.arguments[0] = shader_bound_argument();
    call.arguments[1] = shader_site_argument(g, texture, sampler, node->immediate, 0);
    call.arguments[2] = is_one ? shader_one_image(g, texture, sampler) : shader_number_argument(0);
    call.arguments[3] = shader_address_argument(SHADER_FRAME(request));
    if (!is_store) {
        shader_take_block(g, value);
        call.arguments[call.argument_count++] = shader_address_argument(shader_home_of(g, value));
    }
    shader_invoke(g, &call);
}

// Windows --------------------------------------------------------------------------------------------

enum { FEWEST_PARTS = 3, WIDEST = 8, FAR = 512 };

// Comparisons of one place at offsets that are known, as percentage-closer filters have them. They are one call.
struct window {
    int64_t low[2], high[2]; // offsets
    uint32_t corner[2];      // the constants of the lowest
    uint32_t parts;
};

// Return true for a SAMPLE that asks what the first one does, but for the offset, which is known.
static bool is_in_window(const struct shader_generator *g, uint32_t place, uint32_t first)
{
    const uint32_t fields = 15 | 3 << SHADER_IMAGE_SPATIAL_SHIFT | SHADER_IMAGE_IS_ARRAYED |
                            SHADER_IMAGE_HAS_REFERENCE | SHADER_IMAGE_HAS_OFFSET | SHADER_IMAGE_HAS_LEAST_LOD;
    const uint32_t wanted = SHADER_DO_SAMPLE | 2 << SHADER_IMAGE_SPATIAL_SHIFT | SHADER_IMAGE_HAS_REFERENCE |
                            SHADER_IMAGE_HAS_OFFSET;
    const struct shader_program *const form = g->form;
    struct shader_node *const a = &form->nodes[form->code[first]], *const b = &form->nodes[form->code[place]];
    if (b->op != SHADER_SAMPLE || (b->immediate & fields) != wanted || a->immediate != b->immediate ||
        g->plan.block[place] != g->plan.block[first] || g->plan.run[place] != g->plan.run[first]) {
        return false;
    }
    uint32_t count;
    const uint32_t *const of = shader_operands(form, a, &count), *const by = shader_operands(form, b, &count);
    for (uint32_t o = 0; o < count; o++) {
        const bool is_offset = o == SHADER_IMAGE_OFFSET || o == SHADER_IMAGE_OFFSET + 1;
        if (is_offset ? form->nodes[by[o]].op != SHADER_CONSTANT
                      : of[o] != by[o] || form->nodes[of[o]].op == SHADER_HOME) {
            return false;
        }
    }
    for (uint32_t i = place + 1; i < form->code_count && form->nodes[form->code[i]].op == SHADER_PART; i++) {
        if (form->nodes[form->code[i]].immediate != 0) {
            return false;
        }
    }
    return true;
}

static int32_t offset_of(const struct shader_generator *g, uint32_t place, uint32_t axis, uint32_t *constant)
{
    uint32_t count;
    *constant =
        shader_operands(g->form, &g->form->nodes[g->form->code[place]], &count)[SHADER_IMAGE_OFFSET + axis];
    return (int32_t)g->form->nodes[*constant].immediate;
}

static struct window find_window(const struct shader_generator *g, uint32_t first, uint32_t end)
{
    struct window window = {.parts = 0};
    for (uint32_t i = first; i < end; i++) {
        if (!is_in_window(g, i, first)) {
            continue;
        }
        for (uint32_t axis = 0; axis < 2; axis++) {
            uint32_t constant;
            const int32_t offset = offset_of(g, i, axis, &constant);
            if (window.parts == 0 || offset < window.low[axis]) {
                window.low[axis] = offset;
                window.corner[axis] = constant;
            }
            window.high[axis] = window.parts == 0 || offset > window.high[axis] ? offset : window.high[axis];
        }
        window.parts++;
    }
    return window;
}

// Write a window with the first of its parts. Return false where there is none that pays.
static bool select_window(struct shader_generator *g, uint32_t value)
{
    struct shader_node *const node = &g->form->nodes[value];
    const uint32_t first = g->place, rest = g->form->code_count - first;
    const uint32_t end = first + (rest < FAR ? rest : FAR);
    const struct window window = find_window(g, first, end);
    const int64_t columns = window.high[0] - window.low[0] + 1, rows = window.high[1] - window.low[1] + 1;
    uint32_t operands[SHADER_IMAGE_OPERANDS], count;
    const uint32_t *const given = shader_operands(g->form, node, &count);
    const uint32_t texture = shader_resource_of(&g->plan, given[SHADER_IMAGE_TEXTURE]),
                   sampler = shader_sampler_of(g, node, given);
    if (window.parts < FEWEST_PARTS || columns > WIDEST || rows > WIDEST ||
        columns * rows > 2 * window.parts || !shader_is_one_image(g, texture, sampler) ||
        g->plan.has_effects) {
        return false;
    }
    memcpy(operands, given, count * sizeof *operands);
    memcpy(&operands[SHADER_IMAGE_OFFSET], window.corner, sizeof window.corner);
    put_request(g, operands, node->immediate);
    const uint32_t parts = shader_take_frame(g, (uint32_t)(columns * rows) * VECTOR);
    shader_invoke_plain(g, SHADER_CALL_COMPARE_WINDOW, 6,
                        (struct shader_argument[]){shader_one_image(g, texture, sampler),
                                                   shader_address_argument(SHADER_FRAME(request)),
                                                   shader_number_argument(node->immediate),
                                                   shader_number_argument((uint64_t)columns),
                                                   shader_number_argument((uint64_t)rows),
                                                   shader_address_argument(x86_at(X86_RSP, (int32_t)parts))});
    for (uint32_t i = first; i < end; i++) {
        if (is_in_window(g, i, first)) {
            uint32_t constant;
            const int64_t column = offset_of(g, i, 0, &constant) - window.low[0],
                          row = offset_of(g, i, 1, &constant) - window.low[1];
            g->values[g->form->code[i]].home = SHADER_IN_WINDOW;
            g->values[g->form->code[i]].offset = parts + (uint32_t)(row * columns + column) * VECTOR;
        }
    }
    return true;
}

// Set a register to the mask of lanes whose number is not above the last, nor negative.
static void put_inside(struct shader_generator *g, int inside, int number, struct x86_operand last)
{
    shader_put(g, X86_VPMINUD, inside, number, last);
    shader_put(g, X86_VPCMPEQD, inside, inside, x86_reg(number));
}

// Write a fetch whose first component alone is read: the part behind it is what comes of it. Texels outside are 0.
static bool select_fetch(struct shader_generator *g, uint32_t value)
{
    if (!is_plane_fetch(g, g->place)) {
        return false;
    }
    uint32_t count;
    const uint32_t *const operands = shader_operands(g->form, &g->form->nodes[value], &count);
    const uint32_t texture = shader_resource_of(&g->plan, operands[SHADER_IMAGE_TEXTURE]);
    const uint32_t column = operands[SHADER_IMAGE_COORDINATES], row = operands[SHADER_IMAGE_COORDINATES + 1];
    const int32_t plane = (int32_t)find_pair(g, texture, SHADER_NONE)->offset;
    const int32_t last = plane + (int32_t)offsetof(struct shader_found_plane, last);
    const struct shader_invocation call = {.which = SHADER_CALL_FETCH_PLANE,
                                           .argument_count = 1,
                                           .arguments = {shader_address_argument(x86_at(X86_RSP, plane))},
                                           .vector_count = 2,
                                           .vectors = {column, row}};
    const int x = shader_in_register(g, column), y = shader_in_register(g, row);
    const int inside = shader_temporary(g), at = shader_temporary(g), result = shader_temporary(g);
    const uint32_t here = shader_label_new(&g->code), end = shader_label_new(&g->code);
    put_inside(g, inside, x, x86_at(X86_RSP, last));
    put_inside(g, at, y, x86_at(X86_RSP, last + VECTOR));
    shader_put(g, X86_VANDPS, inside, inside, x86_reg(at));
    shader_put(g, X86_VPMULLD, at, y,
               x86_at(X86_RSP, plane + (int32_t)offsetof(struct shader_found_plane, row_length)));
    shader_put(g, X86_VPADDD, at, at, x86_reg(x));
    shader_put(g, X86_MOV | X86_WIDE, X86_RAX, 0,
               x86_at(X86_RSP, plane + (int32_t)offsetof(struct shader_found_plane, plane.texels)));
    shader_put(g, X86_TEST | X86_WIDE, X86_RAX, 0, x86_reg(X86_RAX));
    shader_encode_jump_if(&g->code, X86_NOT_EQUAL, here);
    shader_invoke_aside(g, &call, result);
    shader_encode_jump(&g->code, end);
    shader_label_place(&g->code, here);
    shader_put_gather(g, result, at, inside);
    shader_label_place(&g->code, end);
    shader_assign(g, g->form->code[g->place + 1], result);
    return true;
}

// A part lies where the whole does.
static void place_part(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    const struct shader_machine_value *const whole = &g->values[node->operands[0]];
    struct shader_machine_value *const v = &g->values[value];
    if (v->reg >= 0) {
        return; // it is what a fetch returned
    }
    if (v->is_kept && !whole->is_kept) {
        struct x86_operand at = shader_home_of(g, node->operands[0]);
        at.offset += (int32_t)(VECTOR * node->immediate);
        shader_put(g, X86_VMOVUPS, shader_result(g, value), 0, at);
        return;
    }
    v->home = whole->home;
    v->offset = whole->offset + VECTOR * node->immediate;
    v->is_stored = true;
}

static void ask_for_gradient(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    shader_invoke_plain(g, SHADER_NEEDS_GRADIENT, 2,
                        (struct shader_argument[]){shader_found_argument(g, node->operands[0]),
                                                   shader_found_argument(g, node->operands[1])});
    shader_spread(g, value);
}

bool shader_select_image(struct shader_generator *g, uint32_t value)
{
    switch ((enum shader_op)g->form->nodes[value].op) {
    case SHADER_SAMPLE:
        // What has a home came before, for all groups or with another.
        if (g->values[value].home == SHADER_HOMELESS && !select_window(g, value) && !select_fetch(g, value)) {
            invoke_image(g, value, false);
        }
        return true;
    case SHADER_PART: place_part(g, value); return true;
    case SHADER_IMAGE_STORE: invoke_image(g, value, true); return true;
    case SHADER_NEEDS_GRADIENT: ask_for_gradient(g, value); return true;
    default: return false;
    }
}
