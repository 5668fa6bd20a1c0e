// SPDX-License-Identifier: MIT
// The form as a text that can be read beside the source.
#ifndef SHADER_PRINT_H
#define SHADER_PRINT_H

#include <stddef.h>

#include "form.h"

// Whoever takes a text, piece by piece.
struct shader_sink {
    void (*write)(void *user, const char *text, size_t size);
    void *user;
};

// Print to a sink. A control character, which names of a module may have, becomes '?', but for line breaks.
void shader_sink_print(const struct shader_sink *sink, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Print the code line by line: u is a value that is computed once a call, v one of every lane, h a home. Lines of the
// source stand before what became of them, if the module knows them.
void shader_print(const struct shader_sink *sink, const struct shader_program *program);

// Print a node of the code as it stands in its line.
void shader_print_node(const struct shader_sink *sink, const struct shader_program *program, uint32_t value);

// Print the bits of a constant: as a float, as a whole number, or as what they seem to be.
enum shader_number_style { SHADER_NUMBER_FLOAT, SHADER_NUMBER_INT, SHADER_NUMBER_EITHER };
void shader_print_number(const struct shader_sink *sink, uint32_t bits, enum shader_number_style style);
// Return what an operation takes a constant operand for.
enum shader_number_style shader_print_style(enum shader_op op, int operand);

// Print a value: a constant in its style, others by their numbers and names.
void shader_print_value(const struct shader_sink *sink, const struct shader_program *program, uint32_t value,
                        enum shader_number_style style);

// print_group.c. Print an operation whose lanes work together.
void shader_print_atomic(const struct shader_sink *sink, const struct shader_program *program,
                         uint32_t value);
void shader_print_scan(const struct shader_sink *sink, const struct shader_program *program, uint32_t value);

// print_name.c. Print the name of an input, of a built-in input, of an output, or of a home; with its component.
void shader_print_input(const struct shader_sink *sink, const struct shader_program *program,
                        uint32_t number);
void shader_print_built_in(const struct shader_sink *sink, uint32_t number);
void shader_print_output(const struct shader_sink *sink, const struct shader_program *program,
                         uint32_t number);
void shader_print_home(const struct shader_sink *sink, const struct shader_program *program, uint32_t home);
// Print name, set and binding of a resource.
void shader_print_resource(const struct shader_sink *sink, const struct shader_program *program,
                           uint32_t number);

// print_source.c. Lines of the source, by the words of the module.
struct shader_source_lines;
// Find them, in the memory. Return NULL if the module does not know any.
struct shader_source_lines *shader_find_source_lines(struct shader_memory *memory,
                                                     const struct shader_module *module);
// Print the line of the instruction at `word` if it is another than the last one.
void shader_print_source_line(const struct shader_sink *sink, struct shader_source_lines *lines,
                              uint32_t word, int indent);

#endif
