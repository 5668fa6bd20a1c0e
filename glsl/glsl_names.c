// SPDX-License-Identifier: MIT
// See glsl_names.h. The walk over instructions trusts nothing but the magic number.
#include "glsl_names.h"

#include <stdio.h>
#include <string.h>

enum {
    HEADER_WORDS = 5,
    OP_NAME = 5,
    OP_MEMBER_NAME = 6,
    OP_TYPE_INT = 21,
    OP_TYPE_FLOAT = 22,
    OP_TYPE_VECTOR = 23,
    OP_TYPE_MATRIX = 24,
    OP_TYPE_ARRAY = 28,
    OP_TYPE_STRUCT = 30,
    OP_TYPE_POINTER = 32,
    OP_CONSTANT = 43,
    OP_FUNCTION = 54,
    OP_VARIABLE = 59,
    OP_DECORATE = 71,
    OP_MEMBER_DECORATE = 72,
    BLOCK = 2,
    ARRAY_STRIDE = 6,
    MATRIX_STRIDE = 7,
    LOCATION = 30,
    BINDING = 33,
    DESCRIPTOR_SET = 34,
    OFFSET = 35,
    STORAGE_UNIFORM_CONSTANT = 0,
    STORAGE_INPUT = 1,
    STORAGE_UNIFORM = 2,
    STORAGE_OUTPUT = 3,
    STORAGE_BUFFER = 12,
    MAX_DEPTH = 16,    // types in each other
    MAX_LOCATIONS = 32 // The inputs of a fragment shader have this many.
};

// The block of uniforms that are in none.
static const char loose[] = "gl_DefaultUniformBlock";

// Return how many words an instruction has that is looked at, which ends with a literal or a name.
static uint32_t words_of(uint32_t opcode)
{
    switch (opcode) {
    case OP_TYPE_STRUCT: return 2;
    case OP_NAME:
    case OP_DECORATE:
    case OP_TYPE_FLOAT: return 3;
    case OP_MEMBER_DECORATE: return 5;
    default: return 4;
    }
}

// A name ends within its instruction.
static bool is_whole(const uint32_t *words)
{
    const uint32_t opcode = words[0] & 0xffff, count = words[0] >> 16;
    return count >= words_of(opcode) &&
           ((opcode != OP_NAME && opcode != OP_MEMBER_NAME) || words[count - 1] >> 24 == 0);
}

// Find the next instruction of an opcode that stands behind `before`, or the first where that is NULL. Functions, which
// follow all that is looked for, are not looked at.
static uint32_t *next(const struct glsl_code *code, uint32_t opcode, const uint32_t *before)
{
    const size_t count = code->size / sizeof(uint32_t);
    size_t place = before == NULL ? HEADER_WORDS : (size_t)(before - code->words) + (before[0] >> 16);
    while (place < count) {
        uint32_t *const words = code->words + place;
        const uint32_t length = words[0] >> 16;
        if ((words[0] & 0xffff) == OP_FUNCTION || length == 0 || length > count - place) {
            return NULL;
        }
        if ((words[0] & 0xffff) == opcode && is_whole(words)) {
            return words;
        }
        place += length;
    }
    return NULL;
}

// Find the instruction of an opcode with an id in one of its words.
static const uint32_t *find(const struct glsl_code *code, uint32_t opcode, int word, uint32_t id)
{
    const uint32_t *found = next(code, opcode, NULL);
    while (found != NULL && found[word] != id) {
        found = next(code, opcode, found);
    }
    return found;
}

static const char *name_of(const struct glsl_code *code, uint32_t id)
{
    const uint32_t *const name = find(code, OP_NAME, 1, id);
    return name != NULL ? (const char *)(name + 2) : "";
}

static const char *name_of_member(const struct glsl_code *code, uint32_t id, uint32_t member)
{
    const uint32_t *name = next(code, OP_MEMBER_NAME, NULL);
    while (name != NULL && (name[1] != id || name[2] != member)) {
        name = next(code, OP_MEMBER_NAME, name);
    }
    return name != NULL ? (const char *)(name + 3) : "";
}

static bool is_of(enum glsl_thing thing, uint32_t storage)
{
    switch (thing) {
    case GLSL_INPUT: return storage == STORAGE_INPUT;
    case GLSL_OUTPUT: return storage == STORAGE_OUTPUT;
    case GLSL_RESOURCE:
        return storage == STORAGE_UNIFORM_CONSTANT || storage == STORAGE_UNIFORM || storage == STORAGE_BUFFER;
    default: return false;
    }
}

static const uint32_t *find_decoration(const struct glsl_code *code, uint32_t id, uint32_t decoration)
{
    const uint32_t *words = next(code, OP_DECORATE, NULL);
    while (words != NULL && (words[1] != id || words[2] != decoration)) {
        words = next(code, OP_DECORATE, words);
    }
    return words;
}

static bool has_literal(const uint32_t *decoration)
{
    return decoration[0] >> 16 > 3;
}

// Return a literal of the decoration of an id.
static uint32_t decoration_of(const struct glsl_code *code, uint32_t id, uint32_t decoration)
{
    const uint32_t *const words = find_decoration(code, id, decoration);
    return words != NULL && has_literal(words) ? words[3] : 0;
}

// Return the name by which other stages know a variable: of a block that of its type.
static const char *name_of_variable(const struct glsl_code *code, const uint32_t *variable)
{
    const uint32_t *const pointer = find(code, OP_TYPE_POINTER, 1, variable[1]);
    uint32_t type = pointer != NULL ? pointer[3] : 0;
    const uint32_t *array = find(code, OP_TYPE_ARRAY, 1, type);
    for (int depth = 0; array != NULL && depth < MAX_DEPTH; depth++) {
        type = array[2];
        array = find(code, OP_TYPE_ARRAY, 1, type);
    }
    const bool is_block = variable[3] == STORAGE_UNIFORM || variable[3] == STORAGE_BUFFER ||
                          find_decoration(code, type, BLOCK) != NULL;
    return name_of(code, type != 0 && is_block ? type : variable[2]);
}

// Return whether a function may use an id: a literal that is the same number counts, too.
static bool may_use(const struct glsl_code *code, uint32_t id)
{
    const size_t count = code->size / sizeof(uint32_t);
    bool is_function = false;
    for (size_t place = HEADER_WORDS; place < count;) {
        const uint32_t *const words = code->words + place;
        const uint32_t length = words[0] >> 16;
        if (length == 0 || length > count - place) {
            return true;
        }
        is_function = is_function || (words[0] & 0xffff) == OP_FUNCTION;
        for (uint32_t i = 1; is_function && i < length; i++) {
            if (words[i] == id) {
                return true;
            }
        }
        place += length;
    }
    return false;
}

// Return the name of what a decoration is about, or NULL where that is another thing.
static const char *name_of_thing(const struct glsl_code *code, enum glsl_thing thing,
                                 const uint32_t *decoration)
{
    if (thing == GLSL_UNIFORM) {
        const bool is_loose = strcmp(name_of(code, decoration[1]), loose) == 0;
        return is_loose && decoration[3] == OFFSET ? name_of_member(code, decoration[1], decoration[2])
                                                   : NULL;
    }
    const uint32_t *const variable = find(code, OP_VARIABLE, 2, decoration[1]);
    if (decoration[2] != (thing == GLSL_RESOURCE ? BINDING : LOCATION) || !has_literal(decoration) ||
        variable == NULL || !is_of(thing, variable[3]) ||
        (thing == GLSL_RESOURCE && decoration_of(code, decoration[1], DESCRIPTOR_SET) != 0)) {
        return NULL;
    }
    return name_of_variable(code, variable);
}

static uint32_t opcode_of(enum glsl_thing thing)
{
    return thing == GLSL_UNIFORM ? OP_MEMBER_DECORATE : OP_DECORATE;
}

const char *glsl_place(const struct glsl_code *code, enum glsl_thing thing, const struct glsl_place *places,
                       uint32_t count)
{
    const uint32_t opcode = opcode_of(thing);
    for (uint32_t *words = next(code, opcode, NULL); words != NULL; words = next(code, opcode, words)) {
        const char *const name = name_of_thing(code, thing, words);
        uint32_t i = 0;
        while (name != NULL && i < count && strcmp(places[i].name, name) != 0) {
            i++;
        }
        if (name != NULL && i == count) {
            return name;
        }
        if (name != NULL) {
            words[thing == GLSL_UNIFORM ? 4 : 3] = places[i].number;
        }
    }
    return NULL;
}

// Two stages -------------------------------------------------------------------------------------------

// Find the decoration that places a thing of a name. Return NULL if there is none.
static const uint32_t *find_named(const struct glsl_code *code, enum glsl_thing thing, const char *name)
{
    const uint32_t *words = NULL;
    while ((words = next(code, opcode_of(thing), words)) != NULL) {
        const char *const own = name_of_thing(code, thing, words);
        if (own != NULL && strcmp(own, name) == 0) {
            return words;
        }
    }
    return NULL;
}

static const uint32_t *find_type(const struct glsl_code *code, uint32_t type)
{
    static const uint32_t opcodes[] = {OP_TYPE_INT,    OP_TYPE_FLOAT, OP_TYPE_VECTOR,
                                       OP_TYPE_MATRIX, OP_TYPE_ARRAY, OP_TYPE_STRUCT};
    const uint32_t *found = NULL;
    for (size_t i = 0; i < sizeof opcodes / sizeof *opcodes && found == NULL; i++) {
        found = find(code, opcodes[i], 1, type);
    }
    return found;
}

static uint32_t opcode_of_type(const uint32_t *type)
{
    return type != NULL ? type[0] & 0xffff : 0;
}

static uint32_t length_of(const struct glsl_code *code, const uint32_t *array)
{
    const uint32_t *const length = find(code, OP_CONSTANT, 2, array[3]);
    return length != NULL ? length[3] : 0;
}

// Return how many locations a type takes, at most MAX_LOCATIONS.
static uint32_t locations_of(const struct glsl_code *code, uint32_t id, int depth)
{
    const uint32_t *const type = depth < MAX_DEPTH ? find_type(code, id) : NULL;
    uint64_t count = 0;
    switch (opcode_of_type(type)) {
    case OP_TYPE_MATRIX: count = type[3]; break;
    case OP_TYPE_ARRAY:
        count = (uint64_t)length_of(code, type) * locations_of(code, type[2], depth + 1);
        break;
    case OP_TYPE_STRUCT:
        for (uint32_t i = 2; i < type[0] >> 16; i++) {
            count += locations_of(code, type[i], depth + 1);
        }
        break;
    default: count = 1;
    }
    return count < MAX_LOCATIONS ? (uint32_t)count : MAX_LOCATIONS;
}

static uint32_t type_of_member(const struct glsl_code *code, uint32_t id, uint32_t member)
{
    const uint32_t *const type = find(code, OP_TYPE_STRUCT, 1, id);
    return type != NULL && member + 2 < type[0] >> 16 ? type[2 + member] : 0;
}

// Return which locations a type takes from one on, a bit for each, or UINT64_MAX where they are too many.
static uint64_t locations_from(const struct glsl_code *code, uint32_t type, uint32_t location)
{
    const uint32_t count = locations_of(code, type, 0);
    return location < MAX_LOCATIONS && location + count <= MAX_LOCATIONS
               ? ((UINT64_C(1) << count) - 1) << location
               : UINT64_MAX;
}

static uint32_t type_of_variable(const struct glsl_code *code, uint32_t id)
{
    const uint32_t *const variable = find(code, OP_VARIABLE, 2, id);
    const uint32_t *const pointer = variable != NULL ? find(code, OP_TYPE_POINTER, 1, variable[1]) : NULL;
    return pointer != NULL ? pointer[3] : 0;
}

// Return which locations the members of blocks take that have their own.
static uint64_t locations_of_members(const struct glsl_code *code)
{
    uint64_t taken = 0;
    for (const uint32_t *words = next(code, OP_MEMBER_DECORATE, NULL); words != NULL;
         words = next(code, OP_MEMBER_DECORATE, words)) {
        taken |= words[3] == LOCATION
                     ? locations_from(code, type_of_member(code, words[1], words[2]), words[4])
                     : 0;
    }
    return taken;
}

// Put an input that is not read where no other is. `taken` has a bit for each location of the others.
static void put_aside(const struct glsl_code *fragment, uint32_t *decoration, uint64_t *taken)
{
    const uint32_t type = type_of_variable(fragment, decoration[1]);
    uint32_t location = 0;
    while (location < MAX_LOCATIONS && (locations_from(fragment, type, location) & *taken) != 0) {
        location++;
    }
    decoration[3] = location;
    *taken |= locations_from(fragment, type, location);
}

// Put inputs where the outputs of their names are, and others where no input is. Return NULL, or the name of an input
// that is read and not written.
static const char *match_inputs(const struct glsl_code *vertex, const struct glsl_code *fragment)
{
    uint64_t taken = locations_of_members(fragment);
    for (uint32_t *words = next(fragment, OP_DECORATE, NULL); words != NULL;
         words = next(fragment, OP_DECORATE, words)) {
        const char *const name = name_of_thing(fragment, GLSL_INPUT, words);
        const uint32_t *const output = name != NULL ? find_named(vertex, GLSL_OUTPUT, name) : NULL;
        if (name != NULL && output == NULL && may_use(fragment, words[1])) {
            return name;
        }
        if (output != NULL) {
            words[3] = output[3];
            taken |= locations_from(fragment, type_of_variable(fragment, words[1]), words[3]);
        }
    }
    for (uint32_t *words = next(fragment, OP_DECORATE, NULL); words != NULL;
         words = next(fragment, OP_DECORATE, words)) {
        const char *const name = name_of_thing(fragment, GLSL_INPUT, words);
        if (name != NULL && find_named(vertex, GLSL_OUTPUT, name) == NULL) {
            put_aside(fragment, words, &taken);
        }
    }
    return NULL;
}

// Return whether a code has a resource at a binding. Make *free a number above all its bindings.
static bool has_binding(const struct glsl_code *code, uint32_t binding, uint32_t *free)
{
    bool has = false;
    for (const uint32_t *words = next(code, OP_DECORATE, NULL); words != NULL;
         words = next(code, OP_DECORATE, words)) {
        if (name_of_thing(code, GLSL_RESOURCE, words) != NULL) {
            has = has || words[3] == binding;
            *free = words[3] >= *free ? words[3] + 1 : *free;
        }
    }
    return has;
}

// Resources of one name are one, and those of different names have different bindings.
static void match_resources(const struct glsl_code *fixed, const struct glsl_code *moved)
{
    uint32_t free = 0;
    has_binding(moved, 0, &free);
    has_binding(fixed, 0, &free);
    for (uint32_t *words = next(moved, OP_DECORATE, NULL); words != NULL;
         words = next(moved, OP_DECORATE, words)) {
        const char *const name = name_of_thing(moved, GLSL_RESOURCE, words);
        const uint32_t *const same = name != NULL ? find_named(fixed, GLSL_RESOURCE, name) : NULL;
        if (same != NULL) {
            words[3] = same[3];
        } else if (name != NULL && has_binding(fixed, words[3], &free)) {
            words[3] = free++;
        }
    }
}

static uint32_t decoration_of_member(const struct glsl_code *code, uint32_t id, uint32_t member,
                                     uint32_t decoration)
{
    const uint32_t *words = next(code, OP_MEMBER_DECORATE, NULL);
    while (words != NULL && (words[1] != id || words[2] != member || words[3] != decoration)) {
        words = next(code, OP_MEMBER_DECORATE, words);
    }
    return words != NULL ? words[4] : 0;
}

// Return the bytes of a type in a block of uniforms. A matrix counts as one of 4 columns or rows.
static uint32_t size_of(const struct glsl_code *code, uint32_t id, uint32_t matrix_stride, int depth)
{
    const uint32_t *const type = depth < MAX_DEPTH ? find_type(code, id) : NULL;
    uint32_t size = 0;
    switch (opcode_of_type(type)) {
    case OP_TYPE_VECTOR: return 4 * type[3];
    case OP_TYPE_MATRIX: return 4 * matrix_stride;
    case OP_TYPE_ARRAY: return length_of(code, type) * decoration_of(code, id, ARRAY_STRIDE);
    case OP_TYPE_STRUCT:
        for (uint32_t i = 0; i + 2 < type[0] >> 16; i++) {
            const uint32_t stride = decoration_of_member(code, id, i, MATRIX_STRIDE);
            const uint32_t end =
                decoration_of_member(code, id, i, OFFSET) + size_of(code, type[2 + i], stride, depth + 1);
            size = end > size ? end : size;
        }
        return size;
    default: return 4;
    }
}

static bool are_equal(const struct glsl_code *code, uint32_t id, const struct glsl_code *other,
                      uint32_t other_id, int depth)
{
    const uint32_t *const a = depth < MAX_DEPTH ? find_type(code, id) : NULL, *const b =
                                                                                  find_type(other, other_id);
    if (a == NULL || b == NULL || a[0] != b[0]) {
        return false;
    }
    switch (opcode_of_type(a)) {
    case OP_TYPE_INT: return a[3] == b[3];
    case OP_TYPE_FLOAT: return true;
    case OP_TYPE_ARRAY:
        return length_of(code, a) == length_of(other, b) && are_equal(code, a[2], other, b[2], depth + 1);
    case OP_TYPE_STRUCT: break;
    default: return a[3] == b[3] && are_equal(code, a[2], other, b[2], depth + 1);
    }
    bool is_equal = true;
    for (uint32_t i = 2; i < a[0] >> 16 && is_equal; i++) {
        is_equal = are_equal(code, a[i], other, b[i], depth + 1);
    }
    return is_equal;
}

static uint32_t find_loose(const struct glsl_code *code)
{
    const uint32_t *name = next(code, OP_NAME, NULL);
    while (name != NULL && strcmp((const char *)(name + 2), loose) != 0) {
        name = next(code, OP_NAME, name);
    }
    return name != NULL ? name[1] : 0;
}

// Uniforms of one name are one; others of the moved code stand behind those of the fixed one. Return NULL, or the name
// of a uniform that has two types.
static const char *match_uniforms(const struct glsl_code *fixed, const struct glsl_code *moved)
{
    const uint32_t block = find_loose(fixed);
    if (block == 0) {
        return NULL;
    }
    const uint32_t end = (size_of(fixed, block, 0, 0) + 15) / 16 * 16;
    for (uint32_t *words = next(moved, OP_MEMBER_DECORATE, NULL); words != NULL;
         words = next(moved, OP_MEMBER_DECORATE, words)) {
        const char *const name = name_of_thing(moved, GLSL_UNIFORM, words);
        const uint32_t *const same = name != NULL ? find_named(fixed, GLSL_UNIFORM, name) : NULL;
        if (same != NULL && !are_equal(fixed, type_of_member(fixed, same[1], same[2]), moved,
                                       type_of_member(moved, words[1], words[2]), 0)) {
            return name;
        }
        if (name != NULL) {
            words[4] = same != NULL ? same[4] : words[4] + end;
        }
    }
    return NULL;
}

bool glsl_match(const struct glsl_code *vertex, const struct glsl_code *fragment, char *message,
                size_t message_size)
{
    if (!vertex->is_relaxed && !fragment->is_relaxed) {
        return true;
    }
    const struct glsl_code *const fixed = fragment->is_relaxed ? vertex : fragment;
    const struct glsl_code *const moved = fragment->is_relaxed ? fragment : vertex;
    const char *const input = match_inputs(vertex, fragment);
    if (input != NULL) {
        snprintf(message, message_size,
                 "the fragment shader reads '%.60s', which the vertex shader does not write; what has no "
                 "location goes "
                 "by its name",
                 input);
        return false;
    }
    match_resources(fixed, moved);
    const char *const uniform = match_uniforms(fixed, moved);
    if (uniform != NULL) {
        snprintf(message, message_size, "uniform '%.60s' is of another type in the other shader", uniform);
    }
    return uniform == NULL;
}
