// SPDX-License-Identifier: MIT
// The form that shaders are translated into: operations on scalars of 32 bits, in structured order.
//
// A node is an operation and, if it has a result, that result: node number and value are one. `code` lists the nodes
// in the order in which they are executed; IF, REGION and LOOP nest. A node is executed in the lanes that are active
// there: IF keeps those whose condition is true, LEAVE takes lanes away until the end of what they leave. Values of
// nodes that are not in `code` (constants, homes) are there from the beginning. A value may be read where it was
// computed in all lanes that read it; a HOME may be read anywhere.
#ifndef SHADER_FORM_H
#define SHADER_FORM_H

#include "module/module.h"

#define OP(name, operands, kind) SHADER_##name,
enum shader_op {
#include "op.inc"
    SHADER_OP_COUNT
};
#undef OP

enum shader_op_kind { SHADER_KIND_VALUE, SHADER_KIND_READ, SHADER_KIND_EFFECT, SHADER_KIND_FLOW };

enum {
    SHADER_MAX_NODES = 1 << 18,
    SHADER_MAX_NESTING = 128, // selections, loops and calls inside each other
    SHADER_MAX_DEPTH =
        3 * SHADER_MAX_NESTING + 2, // IF, REGION and LOOP inside each other: a switch has three
    SHADER_MAX_PRIVATE = 3072,      // words of a lane
    SHADER_MAX_TABLE = 1 << 16      // constants that indices pick from
};

struct shader_node {
    uint16_t op;
    uint16_t flags; // enum shader_node_flag
    uint32_t immediate;
    uint32_t operands[3];
};

enum shader_node_flag {
    SHADER_UNIFORM = 1,            // all lanes of a call have one value
    SHADER_PER_QUAD = 4,           // a derivative: one number for the quad
    SHADER_DYNAMICALLY_UNIFORM = 8 // all lanes that are active have one value
};

// Built-in inputs and outputs, by component where there are several.
enum shader_built_in {
    SHADER_IN_VERTEX_INDEX,
    SHADER_IN_INSTANCE_INDEX,
    SHADER_IN_COORD, // 4
    SHADER_IN_FRONT_FACING = SHADER_IN_COORD + 4,
    SHADER_IN_PRIMITIVE,
    SHADER_IN_SAMPLE_ID,
    SHADER_IN_SAMPLE_POSITION, // 2
    SHADER_IN_SAMPLE_MASK = SHADER_IN_SAMPLE_POSITION + 2,
    SHADER_IN_POINT_COORD, // 2
    SHADER_IN_LAYER = SHADER_IN_POINT_COORD + 2,
    SHADER_IN_VIEWPORT,
    SHADER_IN_WORKGROUP_COUNT,                           // 3
    SHADER_IN_WORKGROUP = SHADER_IN_WORKGROUP_COUNT + 3, // 3
    SHADER_IN_LOCAL = SHADER_IN_WORKGROUP + 3,           // 3
    SHADER_IN_GLOBAL = SHADER_IN_LOCAL + 3,              // 3
    SHADER_IN_LOCAL_INDEX = SHADER_IN_GLOBAL + 3,
    SHADER_IN_LANE, // number of the lane in its group of 8, which is the subgroup
    SHADER_IN_COUNT
};

// Numbers of inputs. A fragment shader may take an input at another place than it is declared for.
enum shader_input {
    SHADER_IN_DECLARED,            // 4 components for each location
    SHADER_IN_CENTROID = 128,      // 4 components for each location, at the centroid
    SHADER_IN_CENTER = 256,        // 4 components for each location, at the centre of the pixel
    SHADER_IN_CLIP_DISTANCE = 384, // 8
    SHADER_IN_CULL_DISTANCE = SHADER_IN_CLIP_DISTANCE + 8, // 8
    SHADER_IN_NUMBERS = SHADER_IN_CULL_DISTANCE + 8
};

enum shader_output {
    SHADER_OUT_POSITION, // 4
    SHADER_OUT_POINT_SIZE = SHADER_OUT_POSITION + 4,
    SHADER_OUT_CLIP_DISTANCE,                                // 8
    SHADER_OUT_CULL_DISTANCE = SHADER_OUT_CLIP_DISTANCE + 8, // 8
    SHADER_OUT_LAYER = SHADER_OUT_CULL_DISTANCE + 8,
    SHADER_OUT_VIEWPORT,
    SHADER_OUT_DEPTH,
    SHADER_OUT_SAMPLE_MASK,
    SHADER_OUT_VARYING, // 4 components for each location: vertices; [target][channel] of fragments
    SHADER_OUT_COUNT = SHADER_OUT_VARYING + 128
};

// A resource that the program uses.
struct shader_resource {
    const struct shader_variable *variable;
    const struct shader_type *type; // type of one element
    uint32_t count;                 // number of elements; 0: as many as are bound
};

enum {
    SHADER_MAX_CAPTURE_BUFFERS = 4,
    SHADER_DRAW_OFFSET = 256 // bytes of push constants up to the numbers of the draw
};

// Scalars of outputs, one slot after the other, that transform feedback keeps of a vertex.
struct shader_capture {
    uint32_t slot, count; // enum shader_output
    uint32_t buffer;
    uint32_t offset; // bytes
};

struct shader_program {
    struct shader_memory *memory;
    const struct shader_module *module;
    const struct shader_entry_point *entry;
    struct shader_node *nodes;
    uint32_t node_count;
    size_t node_room;
    uint32_t *constant_buckets; // hash table of constants
    uint32_t *origins;          // by node: the word of the instruction that it comes from; 0: of none
    uint32_t *code;
    uint32_t code_count;
    size_t code_room;
    uint32_t *lists; // a list is its length and as many values
    uint32_t list_count;
    size_t list_room;
    struct shader_resource *resources;
    uint32_t resource_count;
    uint32_t *table; // constants that TABLEs have
    uint32_t table_count;
    size_t table_room;
    uint32_t private_count;                    // words that PRIVATEs have
    uint8_t interpolation[SHADER_IN_CENTROID]; // or-ed enum shader_interpolation, by number of an input
    bool writes[SHADER_OUT_COUNT];
    struct shader_capture *captures;
    uint32_t capture_count;
    size_t capture_room;
    uint32_t strides[SHADER_MAX_CAPTURE_BUFFERS]; // bytes from vertex to vertex; 0: none is given
    uint32_t workgroup_size;                      // bytes of memory of the workgroup
    bool has_barriers, uses_atomic_results;
    uint32_t view_index; // value of ViewIndex
    bool reads_view_index;
    bool reads_draw;
    bool shades_samples; // a fragment is one sample: an input is declared so, or the sample is built in
};

// Operands of SHADER_SAMPLE and SHADER_IMAGE_STORE, in their list. Value 0, the constant 0, stands where there is none;
// the immediate tells which there are.
enum shader_image_operand {
    SHADER_IMAGE_TEXTURE, // BUFFER node
    SHADER_IMAGE_SAMPLER, // BUFFER node
    SHADER_IMAGE_COORDINATES,
    SHADER_IMAGE_REFERENCE = SHADER_IMAGE_COORDINATES + 4,
    SHADER_IMAGE_BIAS,
    SHADER_IMAGE_LOD,
    SHADER_IMAGE_DX,
    SHADER_IMAGE_DY = SHADER_IMAGE_DX + 3,
    SHADER_IMAGE_OFFSET = SHADER_IMAGE_DY + 3,
    SHADER_IMAGE_SAMPLE = SHADER_IMAGE_OFFSET + 3,
    SHADER_IMAGE_LEAST_LOD,
    SHADER_IMAGE_TEXEL, // 4, that are stored
    SHADER_IMAGE_OPERANDS = SHADER_IMAGE_TEXEL + 4
};

// Operands of SHADER_ATOMIC, in their list. The immediate is its enum shader_atomic.
enum shader_atomic_operand {
    SHADER_ATOMIC_BUFFER,
    SHADER_ATOMIC_OFFSET, // bytes
    SHADER_ATOMIC_VALUE,
    SHADER_ATOMIC_COMPARAND,
    SHADER_ATOMIC_OPERANDS
};

// Operands of SHADER_IMAGE_ATOMIC, in their list. The immediate is its enum shader_atomic.
enum shader_image_atomic_operand {
    SHADER_IMAGE_ATOMIC_IMAGE,       // BUFFER node
    SHADER_IMAGE_ATOMIC_COORDINATES, // 3
    SHADER_IMAGE_ATOMIC_VALUE = SHADER_IMAGE_ATOMIC_COORDINATES + 3,
    SHADER_IMAGE_ATOMIC_COMPARAND,
    SHADER_IMAGE_ATOMIC_OPERANDS
};

enum shader_atomic {
#define ATOMIC(name, printed, operation) SHADER_ATOMIC_##name,
#include "atomic.inc"
#undef ATOMIC
};

// What a SHADER_SAMPLE does, in the lowest 4 bits of its immediate.
enum shader_image_operation {
    SHADER_DO_SAMPLE,
    SHADER_DO_FETCH,
    SHADER_DO_GATHER,
    SHADER_DO_SIZE,
    SHADER_DO_LEVELS,
    SHADER_DO_SAMPLES,
    SHADER_DO_QUERY_LOD,
    SHADER_DO_LOAD,      // a texel of a storage image or texel buffer
    SHADER_DO_IMAGE_SIZE // size of a storage image or texel buffer
};

// Fields of the immediate: the operation, spatial coordinates, the channel that is gathered, and which operands there
// are.
enum {
    SHADER_IMAGE_SPATIAL_SHIFT = 4,
    SHADER_IMAGE_CHANNEL_SHIFT = 6,
    SHADER_IMAGE_IS_ARRAYED = 1 << 8,
    SHADER_IMAGE_HAS_SAMPLER = 1 << 9,
    SHADER_IMAGE_HAS_REFERENCE = 1 << 10,
    SHADER_IMAGE_HAS_BIAS = 1 << 11,
    SHADER_IMAGE_HAS_LOD = 1 << 12,
    SHADER_IMAGE_HAS_GRADIENT = 1 << 13,
    SHADER_IMAGE_HAS_OFFSET = 1 << 14,
    SHADER_IMAGE_HAS_SAMPLE = 1 << 15,
    SHADER_IMAGE_HAS_LEAST_LOD = 1 << 16
};

// What a SHADER_SCAN does with the values of active lanes, in the lowest 4 bits of its immediate.
enum shader_scan {
    SHADER_SCAN_FADD,
    SHADER_SCAN_FMUL,
    SHADER_SCAN_FMIN,
    SHADER_SCAN_FMAX,
    SHADER_SCAN_IADD,
    SHADER_SCAN_IMUL,
    SHADER_SCAN_MIN_INT,
    SHADER_SCAN_MAX_INT,
    SHADER_SCAN_MIN_UINT,
    SHADER_SCAN_MAX_UINT,
    SHADER_SCAN_AND,
    SHADER_SCAN_OR,
    SHADER_SCAN_XOR
};

// Fields of the immediate: the operation, how far a lane looks, and the binary logarithm of a cluster's lanes.
enum {
    SHADER_SCAN_REACH_SHIFT = 4, // 0: all lanes, 1: up to the lane itself, 2: those before the lane
    SHADER_SCAN_CLUSTER_SHIFT = 6
};

// Return what a node changes: the HOME of a SET, the PRIVATE of a STORE, or the node itself.
uint32_t shader_changed(const struct shader_program *program, uint32_t value);
// Add a list of values. Return its place.
uint32_t shader_add_list(struct shader_program *program, const uint32_t *values, uint32_t count);

// Return the resource node that a value names: BUFFER, PUSH or WORKGROUP. The value is that node, or the home that
// keeps it.
const struct shader_node *shader_resource_node(const struct shader_program *program, uint32_t value);

// Translate an entry point, for a view of several.
struct shader_program *shader_build(const struct shader_module *module,
                                    const struct shader_entry_point *entry, uint32_t view_index);

// Add a node without putting it into the code. Equal constants are one node.
uint32_t shader_add_node(struct shader_program *program, enum shader_op op, uint32_t immediate, uint32_t a,
                         uint32_t b, uint32_t c);
uint32_t shader_add_constant(struct shader_program *program, uint32_t bits);

struct shader_op_description {
    const char *name;
    int operands;
    enum shader_op_kind kind;
};

extern const struct shader_op_description shader_ops[SHADER_OP_COUNT];

// Return true if the active lanes of a group, of which there may be none, have one value. Where it is computed, all
// others have it, too.
static inline bool shader_is_shared(const struct shader_program *program, uint32_t value)
{
    return (program->nodes[value].flags & SHADER_DYNAMICALLY_UNIFORM) != 0;
}

static inline const char *shader_op_name(enum shader_op op)
{
    return shader_ops[op].name;
}

static inline int shader_op_operands(enum shader_op op)
{
    return shader_ops[op].operands;
}

static inline enum shader_op_kind shader_op_kind_of(enum shader_op op)
{
    return shader_ops[op].kind;
}

// Return true for what begins structure that ends.
static inline bool shader_opens(uint32_t op)
{
    return op == SHADER_IF || op == SHADER_REGION || op == SHADER_LOOP;
}

static inline bool shader_closes(uint32_t op)
{
    return op == SHADER_END_IF || op == SHADER_END_REGION || op == SHADER_END_LOOP;
}

// Return true if operand 0 is the place of a list.
static inline bool shader_op_has_list(enum shader_op op)
{
    return op == SHADER_SAMPLE || op == SHADER_IMAGE_STORE || op == SHADER_ATOMIC ||
           op == SHADER_IMAGE_ATOMIC;
}

// Return true if others may read what the operation gives.
static inline bool shader_op_has_result(enum shader_op op)
{
    const enum shader_op_kind kind = shader_op_kind_of(op);
    return kind == SHADER_KIND_VALUE || kind == SHADER_KIND_READ || op == SHADER_ATOMIC ||
           op == SHADER_IMAGE_ATOMIC;
}

// Return the operands of a node that are values, and how many there are. Passes ask for those of every node, so this is
// a function of the header.
static inline uint32_t *shader_operands(const struct shader_program *program, struct shader_node *node,
                                        uint32_t *count)
{
    const enum shader_op op = (enum shader_op)node->op;
    if (shader_op_has_list(op)) {
        *count = program->lists[node->operands[0]];
        return &program->lists[node->operands[0] + 1];
    }
    *count = op == SHADER_LEAVE ? 0 : (uint32_t)shader_op_operands(op);
    return node->operands;
}

// fold.c. Return the value of an operation on constants. Return false where it has no value that is known.
bool shader_fold(enum shader_op op, const uint32_t operands[3], uint32_t *result);

#endif
