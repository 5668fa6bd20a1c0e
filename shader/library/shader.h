// SPDX-License-Identifier: MIT
// A translated shader, shared by whoever holds it and by the programs that were linked of it.
#ifndef SHADER_SHADER_H
#define SHADER_SHADER_H

#include "cache.h"
#include "form/form.h"
#include "interpreter/bytecode.h"
#include "link.h"
#include "message.h"
#include "rhw/spirv.h"

struct rhw_shader {
    struct shader_kept kept;
    struct shader_memory memory; // holds all that follows points to
    const struct shader_program *form;
    const struct shader_bytecode *bytecode; // without slots and components
    struct shader_interface interface;
    struct rhw_shader_info info;
    struct rhw_shader_type **types; // structs that `info` tells of, by id; NULL: none yet
};

// Return the bytes that a shader takes.
size_t shader_size(const rhw_shader *shader);

// Return what is wrong with the arguments of rhw_shader_create, or NULL.
const char *shader_find_misuse(const void *words, size_t size, const struct rhw_shader_def *def);
// Read a module and build the form of an entry point, before passes.
struct shader_program *shader_build_form(struct shader_memory *memory, const void *words, size_t size,
                                         const struct rhw_shader_def *def);

// reflect.c. Fill the shader's info.
void shader_reflect(rhw_shader *shader);

// reflect_type.c. Return a struct in memory, with its members. Each struct of a module is told once.
const struct rhw_shader_type *shader_reflect_type(rhw_shader *shader, const struct shader_type *type);
// Give the members of all structs that were told their names.
void shader_name_members(const rhw_shader *shader);

// reflect_constant.c. Tell the constants that a user of the module chooses.
void shader_reflect_constants(rhw_shader *shader);

#endif
