// SPDX-License-Identifier: MIT
// The words of a module, one instruction after the other.
#include "module.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void shader_refuse(const struct shader_module *module, uint32_t word, const char *format, ...)
{
    char *const message = module->memory->message;
    const uint32_t opcode = word < module->word_count ? module->words[word] & 0xffff : 0;
    int length = 0;
    if (word >= SPIRV_HEADER_WORDS) {
        length = snprintf(message, SHADER_MESSAGE, "word %u, Op%s: ", (unsigned)word,
                          shader_instruction_operands(opcode) ? shader_instruction_name(opcode) : "?");
    }
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message + length, (size_t)(SHADER_MESSAGE - length), format, arguments);
    va_end(arguments);
    for (char *c = message; *c != '\0'; c++) { // strings of the module may have anything
        *c = *c == 0x7f || (*c > 0 && *c < ' ') ? '?' : *c;
    }
    shader_memory_end(module->memory);
}

// Ids ------------------------------------------------------------------------------------------------

// Note what the result of an instruction is, where it has one.
static void define_result(struct shader_module *module, uint32_t word, const char *operands)
{
    const uint32_t *const words = module->words + word;
    const bool has_type = operands[0] == 'T';
    if (!has_type && operands[0] != 'R') {
        return;
    }
    const uint32_t id = words[has_type ? 2 : 1];
    struct shader_id *const defined = &module->ids[id];
    if (defined->word != 0) {
        shader_refuse(module, word, "id %u was defined before, at word %u", (unsigned)id,
                      (unsigned)defined->word);
    }
    defined->word = word;
    defined->opcode = (uint16_t)(words[0] & 0xffff);
    defined->type = has_type ? words[1] : 0;
    if (has_type && (module->ids[words[1]].word == 0 || !module->ids[words[1]].data.as_type)) {
        shader_refuse(module, word, "id %u is no type", (unsigned)words[1]);
    }
}

const struct shader_type *shader_type_of_id(const struct shader_module *module, uint32_t word, uint32_t id)
{
    const uint16_t opcode = module->ids[id].opcode;
    const bool is_type = opcode >= SPIRV_OP_TypeVoid && opcode <= SPIRV_OP_TypeFunction;
    if (!is_type || !module->ids[id].data.as_type) {
        shader_refuse(module, word, "id %u is no type", (unsigned)id);
    }
    return module->ids[id].data.as_type;
}

static bool is_constant(uint16_t opcode)
{
    return (opcode >= SPIRV_OP_ConstantTrue && opcode <= SPIRV_OP_SpecConstantOp) || opcode == SPIRV_OP_Undef;
}

const struct shader_constant *shader_constant_of_id(const struct shader_module *module, uint32_t word,
                                                    uint32_t id)
{
    if (!is_constant(module->ids[id].opcode) || !module->ids[id].data.as_constant) {
        shader_refuse(module, word, "id %u is no constant", (unsigned)id);
    }
    return module->ids[id].data.as_constant;
}

const struct shader_type *shader_value_type(const struct shader_module *module, uint32_t word, uint32_t id)
{
    if (module->ids[id].type == 0) {
        shader_refuse(module, word, "id %u is no value", (unsigned)id);
    }
    return shader_type_of_id(module, word, module->ids[id].type);
}

// Decorations ----------------------------------------------------------------------------------------

static void add_decoration(struct shader_module *module, uint32_t word, uint32_t id, int member,
                           uint32_t operand)
{
    const uint32_t end = word + (module->words[word] >> 16);
    if (module->decoration_count >= module->word_count) {
        shader_refuse(module, word, "the module has too many decorations");
    }
    const uint32_t number = ++module->decoration_count;
    module->decorations[number - 1] =
        (struct shader_decoration){.next = module->ids[id].decorations,
                                   .word = word,
                                   .number = module->words[operand],
                                   .member = member,
                                   .value = operand + 1 < end ? module->words[operand + 1] : 0};
    module->ids[id].decorations = number;
}

// Give an id, or a member of it, what a group was decorated with.
static void copy_decorations(struct shader_module *module, uint32_t word, uint32_t group, uint32_t id,
                             int member)
{
    for (uint32_t d = module->ids[group].decorations; d != 0; d = module->decorations[d - 1].next) {
        if (module->decoration_count >= module->word_count) {
            shader_refuse(module, word, "the module has too many decorations");
        }
        module->decorations[module->decoration_count] = module->decorations[d - 1];
        struct shader_decoration *const copy = &module->decorations[module->decoration_count++];
        copy->member = member;
        copy->next = module->ids[id].decorations;
        module->ids[id].decorations = module->decoration_count;
    }
}

static void read_decoration(struct shader_module *module, uint32_t word)
{
    const uint32_t *const words = module->words + word;
    const uint32_t opcode = words[0] & 0xffff, count = words[0] >> 16;
    if (opcode == SPIRV_OP_Decorate) {
        add_decoration(module, word, words[1], -1, word + 2);
        if (words[2] == SPIRV_BUILT_IN && count > 3 && words[3] == SPIRV_WORKGROUP_SIZE) {
            module->workgroup_size = words[1];
        }
    } else if (opcode == SPIRV_OP_MemberDecorate) {
        if (words[2] > SHADER_MAX_SCALARS) {
            shader_refuse(module, word, "there is no member %u", (unsigned)words[2]);
        }
        add_decoration(module, word, words[1], (int)words[2], word + 3);
    } else if (opcode == SPIRV_OP_GroupDecorate) {
        for (uint32_t i = 2; i < count; i++) {
            copy_decorations(module, word, words[1], words[i], -1);
        }
    } else {
        for (uint32_t i = 2; i + 1 < count; i += 2) {
            copy_decorations(module, word, words[1], words[i],
                             (int)(words[i + 1] > SHADER_MAX_SCALARS ? SHADER_MAX_SCALARS : words[i + 1]));
        }
    }
}

const struct shader_decoration *shader_find_decoration(const struct shader_module *module, uint32_t id,
                                                       int member, enum spirv_decoration number)
{
    for (uint32_t d = module->ids[id].decorations; d != 0; d = module->decorations[d - 1].next) {
        const struct shader_decoration *const decoration = &module->decorations[d - 1];
        if (decoration->member == member && decoration->number == (uint32_t)number) {
            return decoration;
        }
    }
    return NULL;
}

// Sections -------------------------------------------------------------------------------------------

// Capabilities of SPIR-V 1.3 under which nothing is asked that is not here (SPIR-V Specification, "Capability").
static bool is_supported(uint32_t capability)
{
    static const uint16_t supported[] = {
        0,    1,                    // Matrix, Shader
        2,    3,                    // Geometry, Tessellation: of gl_PrimitiveID and gl_Layer in fragments
        25,   26,                   // ImageGatherExtended, StorageImageMultisample
        27,   28,   29,   30,   31, // UniformBuffer, SampledImage, StorageBuffer, StorageImage arrays; ClipDistance
        32,   33,   34,   35,   36, // CullDistance, ImageCubeArray, SampleRateShading, ImageRect, SampledRect
        40,   41,   42,   43,       // InputAttachment, SparseResidency, MinLod, Sampled1D
        44,   45,                   // Image1D, SampledCubeArray
        46,   47,   48,   49,   50, 51, 52, // SampledBuffer … InterpolationFunction
        53,   55,   56,   57, // TransformFeedback, StorageImageRead, StorageImageWriteWithoutFormat, MultiViewport
        61,   62,   63,   64,   65, 66, 67, 68, // GroupNonUniform and its kin
        69,   70,   5254,                       // ShaderLayer, ShaderViewportIndex, and both in one
        4427,                                   // DrawParameters
        4433, 4434, 4435, 4436, // storage of 16 bits: buffers, uniforms, push constants, inputs and outputs
        4437, 4439, 4441,       // DeviceGroup, MultiView, VariablePointersStorageBuffer
        4448, 4449, 4450        // storage of 8 bits: buffers, uniforms, push constants
    };
    for (size_t i = 0; i < sizeof supported / sizeof *supported; i++) {
        if (supported[i] == capability) {
            return true;
        }
    }
    return capability >= 5301 &&
           capability <= 5312; // ShaderNonUniform and its kin: lanes may name any element
}

// Return the name of a capability that modules may well ask for and that is not here, or NULL.
static const char *capability_name(uint32_t capability)
{
    switch (capability) {
    case 9: return "Float16";
    case 10: return "Float64";
    case 11: return "Int64";
    case 22: return "Int16";
    case 39: return "Int8";
    case 4442: return "VariablePointers";
    default: return NULL;
    }
}

static const char *string_at(const struct shader_module *module, uint32_t word)
{
    return (const char *)(module->words + word);
}

static void read_import(struct shader_module *module, uint32_t word)
{
    const char *const name = string_at(module, word + 2);
    if (strcmp(name, "GLSL.std.450") == 0) {
        module->glsl_import = module->words[word + 1];
    } else if (strncmp(name, "NonSemantic.", 12) != 0) {
        shader_refuse(module, word, "the instruction set '%.64s' is not supported", name);
    }
}

static void read_function(struct shader_module *module, uint32_t word)
{
    struct shader_function *const function = &module->functions[module->function_count++];
    *function = (struct shader_function){.id = module->words[word + 2],
                                         .word = word,
                                         .type = shader_type_of_id(module, word, module->words[word + 4])};
    if (function->type->kind != SHADER_FUNCTION ||
        function->type->element != shader_type_of_id(module, word, module->words[word + 1])) {
        shader_refuse(module, word, "id %u is no type of a function that returns id %u",
                      (unsigned)module->words[word + 4], (unsigned)module->words[word + 1]);
    }
    module->ids[function->id].data.as_function = function;
}

// Read an instruction outside of functions.
static void read_global(struct shader_module *module, uint32_t word,
                        const struct shader_specialization *values, size_t count)
{
    const uint32_t opcode = module->words[word] & 0xffff;
    switch (opcode) {
    case SPIRV_OP_Capability:
        if (!is_supported(module->words[word + 1])) {
            const char *const name = capability_name(module->words[word + 1]);
            shader_refuse(module, word, "capability %u%s%s is not supported",
                          (unsigned)module->words[word + 1], name ? ", " : "", name ? name : "");
        }
        return;
    case SPIRV_OP_MemoryModel:
        if (module->words[word + 1] != 0 || (module->words[word + 2] != 1 && module->words[word + 2] != 3)) {
            shader_refuse(module, word,
                          "only logical addresses and the memory models GLSL450 and Vulkan are supported");
        }
        return;
    case SPIRV_OP_ExtInstImport: read_import(module, word); return;
    case SPIRV_OP_EntryPoint: shader_read_entry_point(module, word); return;
    case SPIRV_OP_ExecutionMode:
    case SPIRV_OP_ExecutionModeId: shader_read_execution_mode(module, word); return;
    case SPIRV_OP_Name: module->names[module->words[word + 1]] = string_at(module, word + 2); return;
    case SPIRV_OP_Decorate:
    case SPIRV_OP_MemberDecorate:
    case SPIRV_OP_GroupDecorate:
    case SPIRV_OP_GroupMemberDecorate: read_decoration(module, word); return;
    case SPIRV_OP_Variable: {
        struct shader_variable *const variable = shader_read_variable(module, word);
        if (variable->storage == SPIRV_FUNCTION) {
            shader_refuse(module, word, "a variable of a function stands outside of functions");
        }
        module->variables[module->variable_count++] = variable;
        return;
    }
    default: break;
    }
    if (opcode >= SPIRV_OP_TypeVoid && opcode <= SPIRV_OP_TypeFunction) {
        shader_read_type(module, word);
    } else if (is_constant((uint16_t)opcode)) {
        shader_read_constant(module, word, values, count);
    }
}

// Everything that a module has at most as many of as it has words.
static void make_room(struct shader_module *module)
{
    size_t decorations = 0, entry_points = 0, variables = 0, functions = 0;
    for (uint32_t word = SPIRV_HEADER_WORDS; word < module->word_count;) {
        const uint32_t count = module->words[word] >> 16;
        if (count == 0 || count > module->word_count - word) {
            shader_refuse(module, word, "its %u words do not fit into the module", (unsigned)count);
        }
        switch (module->words[word] & 0xffff) {
        case SPIRV_OP_Decorate:
        case SPIRV_OP_MemberDecorate: decorations++; break;
        case SPIRV_OP_GroupDecorate:
        case SPIRV_OP_GroupMemberDecorate: decorations = module->word_count; break;
        case SPIRV_OP_EntryPoint: entry_points++; break;
        case SPIRV_OP_Variable: variables++; break;
        case SPIRV_OP_Function: functions++; break;
        default: break;
        }
        word += count;
    }
    struct shader_memory *const memory = module->memory;
    decorations = decorations > module->word_count ? module->word_count : decorations;
    if (entry_points > SHADER_MAX_ENTRY_POINTS) {
        shader_refuse(module, 0, "the module has more than %d entry points", SHADER_MAX_ENTRY_POINTS);
    }
    module->decorations = shader_take(memory, decorations, sizeof *module->decorations);
    module->entry_points = shader_take(memory, entry_points, sizeof *module->entry_points);
    module->variables = shader_take(memory, variables, sizeof(struct shader_variable *));
    module->functions = shader_take(memory, functions, sizeof *module->functions);
    module->ids = shader_take(memory, module->bound, sizeof *module->ids);
    module->names = shader_take(memory, module->bound, sizeof *module->names);
}

static void check_header(struct shader_module *module, const uint32_t *words, size_t word_count)
{
    if (word_count < SPIRV_HEADER_WORDS || words[0] != SPIRV_MAGIC) {
        shader_refuse(module, 0, "this is no SPIR-V module: it does not begin with the magic number");
    }
    if (word_count > SHADER_MAX_WORDS) {
        shader_refuse(module, 0, "the module has more than %d words", SHADER_MAX_WORDS);
    }
    if (words[1] < 0x10000 || words[1] > 0x10600) {
        shader_refuse(module, 0, "version 0x%x of SPIR-V is not known", (unsigned)words[1]);
    }
    if (words[3] == 0 || words[3] > SHADER_MAX_IDS) {
        shader_refuse(module, 0, "a bound of %u ids is not supported; it is 1 to %d", (unsigned)words[3],
                      SHADER_MAX_IDS);
    }
}

struct shader_module *shader_module_read(struct shader_memory *memory, const uint32_t *words,
                                         size_t word_count,
                                         const struct shader_specialization *specialization, size_t count)
{
    struct shader_module *const module = shader_take(memory, 1, sizeof *module);
    module->memory = memory;
    check_header(module, words, word_count);
    module->words = words;
    module->word_count = (uint32_t)word_count;
    module->bound = words[3];
    make_room(module);
    bool in_function = false;
    for (uint32_t word = SPIRV_HEADER_WORDS; word < module->word_count; word += words[word] >> 16) {
        const uint32_t opcode = words[word] & 0xffff;
        const char *const operands = shader_instruction_operands(opcode);
        if (!operands) {
            shader_refuse(module, word, "instruction %u is not supported", (unsigned)opcode);
        }
        shader_check_words(module, word, operands);
        define_result(module, word, operands);
        if (opcode == SPIRV_OP_Function) {
            if (in_function) {
                shader_refuse(module, word, "a function begins within another");
            }
            in_function = true;
            read_function(module, word);
        } else if (opcode == SPIRV_OP_FunctionEnd) {
            if (!in_function) {
                shader_refuse(module, word, "no function has begun");
            }
            in_function = false;
            module->functions[module->function_count - 1].end = word + 1;
        } else if (!in_function) {
            read_global(module, word, specialization, count);
        } else if (opcode == SPIRV_OP_Undef) {
            shader_read_constant(module, word, NULL, 0);
        } else if (opcode == SPIRV_OP_Variable &&
                   shader_read_variable(module, word)->storage != SPIRV_FUNCTION) {
            shader_refuse(module, word, "a variable of the module stands in a function");
        }
    }
    if (in_function) {
        shader_refuse(module, 0, "the last function has no end");
    }
    shader_settle_sizes(module);
    return module;
}
