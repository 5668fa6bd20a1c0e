// SPDX-License-Identifier: MIT
// See pass.h. Lanes leave a loop one by one, so behind the loop its counter differs from lane to lane. In the loop it
// does not: all lanes begin together and count together. The interpreter, whose groups go round a loop together, keeps
// such a home once for all of them, and computes once what follows from it.
//
// A home is shared where it is
//   - set in a block, and all that reads it stands behind that in the block,
//   - otherwise set in the rounds of one loop of this block alone, outside of structure in which lanes part,
//   - and set to what lanes share.
// Whichever lanes are active at a read have all been active where the home was set last. What reads a value is never
// behind the structure that computes it (keep.c).
#include "pass.h"

// After so many rounds what is still open counts as different, as in uniform.c.
enum { MAX_ROUNDS = 32 };

struct block {
    uint32_t number;  // unique, in the order of the code
    bool is_loop;     // the body of a LOOP
    bool is_together; // an IF where all lanes that come to it go one way
};

// What is known of a home on the way through the code.
struct home {
    uint32_t block; // number of the block that sets it first; 0: nothing has set it
    uint32_t depth; // how deep the block lies
    uint32_t loop;  // number of the loop that sets it too, or 0
};

struct walk {
    struct shader_program *program;
    bool *differs;      // by value
    struct home *homes; // by value
    struct block blocks[SHADER_MAX_DEPTH + 2];
    uint32_t depth;
    bool has_changed;
};

static void mark(struct walk *walk, uint32_t value)
{
    walk->has_changed = walk->has_changed || !walk->differs[value];
    walk->differs[value] = true;
}

static bool is_open(const struct walk *walk, uint32_t number, uint32_t depth)
{
    return depth <= walk->depth && walk->blocks[depth].number == number;
}

static void read_home(struct walk *walk, uint32_t value)
{
    const struct home *const home = &walk->homes[value];
    const bool is_right = home->loop != 0 ? is_open(walk, home->loop, home->depth + 1)
                                          : is_open(walk, home->block, home->depth);
    if (home->block == 0 || !is_right) {
        mark(walk, value);
    }
}

static void set_home(struct walk *walk, uint32_t value, uint32_t to)
{
    struct home *const home = &walk->homes[value];
    uint32_t depth = walk->depth;
    while (walk->blocks[depth].is_together) {
        depth--;
    }
    if (walk->differs[to]) {
        mark(walk, value);
    } else if (home->block == 0) {
        *home = (struct home){.block = walk->blocks[walk->depth].number, .depth = walk->depth};
    } else if (!walk->blocks[depth].is_loop || depth != home->depth + 1 ||
               !is_open(walk, home->block, home->depth) ||
               (home->loop != 0 && home->loop != walk->blocks[depth].number)) {
        mark(walk, value);
    } else {
        home->loop = walk->blocks[depth].number;
    }
}

static void open_block(struct walk *walk, uint32_t place, const struct shader_node *node)
{
    walk->blocks[++walk->depth] =
        (struct block){.number = place + 2,
                       .is_loop = node->op == SHADER_LOOP,
                       .is_together = node->op == SHADER_IF && !walk->differs[node->operands[0]]};
}

static bool follow_structure(struct walk *walk, uint32_t place, const struct shader_node *node)
{
    switch ((enum shader_op)node->op) {
    case SHADER_IF:
    case SHADER_REGION:
    case SHADER_LOOP: open_block(walk, place, node); return true;
    case SHADER_ELSE: walk->blocks[walk->depth].number = place + 2; return true;
    case SHADER_END_IF:
    case SHADER_END_REGION:
    case SHADER_END_LOOP: walk->depth--; return true;
    default: return node->op == SHADER_LEAVE;
    }
}

static void follow(struct walk *walk, uint32_t place)
{
    struct shader_program *const program = walk->program;
    const uint32_t value = program->code[place];
    struct shader_node *const node = &program->nodes[value];
    bool differs = false;
    uint32_t count;
    const uint32_t *const operands = shader_operands(program, node, &count);
    for (uint32_t o = node->op == SHADER_SET ? 1 : 0; o < count; o++) {
        if (program->nodes[operands[o]].op == SHADER_HOME && !walk->differs[operands[o]] &&
            !(program->nodes[operands[o]].flags & SHADER_UNIFORM)) {
            read_home(walk, operands[o]);
        }
        differs = differs || walk->differs[operands[o]];
    }
    if (follow_structure(walk, place, node)) {
        return;
    }
    if (node->op == SHADER_SET) {
        const uint32_t home = node->operands[0];
        if (!walk->differs[home] && !(program->nodes[home].flags & SHADER_UNIFORM)) {
            set_home(walk, home, node->operands[1]);
        }
    } else if (!(node->flags & SHADER_UNIFORM) && (differs || shader_is_varying((enum shader_op)node->op))) {
        mark(walk, value);
    }
}

void shader_mark_dynamically_uniform(struct shader_program *program)
{
    struct walk walk = {.program = program,
                        .differs = shader_take(program->memory, program->node_count, sizeof(bool)),
                        .homes = shader_take(program->memory, program->node_count, sizeof(struct home)),
                        .blocks = {{.number = 1}},
                        .has_changed = true};
    for (uint32_t value = 0; value < program->node_count; value++) {
        walk.differs[value] = program->nodes[value].op == SHADER_PRIVATE;
    }
    for (int round = 0; walk.has_changed && round < MAX_ROUNDS; round++) {
        walk.has_changed = false;
        for (uint32_t value = 0; value < program->node_count; value++) {
            walk.homes[value] = (struct home){0};
        }
        for (uint32_t i = 0; i < program->code_count; i++) {
            follow(&walk, i);
        }
    }
    for (uint32_t value = 0; value < program->node_count; value++) {
        struct shader_node *const node = &program->nodes[value];
        const bool is_alike = (node->flags & SHADER_UNIFORM) || (!walk.has_changed && !walk.differs[value]);
        node->flags |= is_alike ? SHADER_DYNAMICALLY_UNIFORM : 0;
    }
}
