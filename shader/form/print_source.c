// SPDX-License-Identifier: MIT
// What OpLine and OpSource tell: which line of which text an instruction comes from.
#include <stdlib.h>
#include <string.h>

#include "print.h"

// From `word` on, up to the next entry, instructions come from a line. Line 0 is none.
struct source_mark {
    uint32_t word, file, line;
};

struct source_text {
    uint32_t file;      // id of its OpString
    const char *bytes;  // with a 0 at the end
    const char **lines; // by number, from 1 on
    uint32_t line_count;
};

struct shader_source_lines {
    const struct shader_module *module;
    struct source_mark *marks;
    uint32_t mark_count;
    struct source_text *texts;
    uint32_t text_count;
    uint32_t file, line; // what was printed last
};

static bool ends_block(uint32_t opcode)
{
    return opcode == SPIRV_OP_NoLine || opcode == SPIRV_OP_FunctionEnd ||
           (opcode >= SPIRV_OP_Branch && opcode <= SPIRV_OP_Unreachable);
}

static void find_marks(struct shader_source_lines *lines)
{
    const struct shader_module *const module = lines->module;
    uint32_t count;
    for (uint32_t word = SPIRV_HEADER_WORDS; word < module->word_count; word += count) {
        const uint32_t *const words = module->words + word;
        const uint32_t opcode = words[0] & 0xffff;
        count = words[0] >> 16;
        if (opcode == SPIRV_OP_Line) {
            lines->marks[lines->mark_count++] = (struct source_mark){word, words[1], words[2]};
        } else if (ends_block(opcode)) {
            lines->marks[lines->mark_count++] = (struct source_mark){word + count, 0, 0};
        }
    }
}

// glslang writes what it was asked for before the text, and "#line 1" behind that.
static const char *skip_preface(const char *bytes)
{
    static const char start[] = "// OpModuleProcessed", end[] = "#line 1\n";
    if (strncmp(bytes, start, sizeof start - 1) != 0) {
        return bytes;
    }
    const char *const found = strstr(bytes, end);
    return found ? found + sizeof end - 1 : bytes;
}

static void split(struct shader_memory *memory, struct source_text *text)
{
    uint32_t count = 2;
    for (const char *c = text->bytes; *c != '\0'; c++) {
        count += *c == '\n' ? 1 : 0;
    }
    text->lines = shader_take(memory, count, sizeof(const char *));
    text->lines[++text->line_count] = text->bytes;
    for (const char *c = text->bytes; *c != '\0'; c++) {
        if (*c == '\n') {
            text->lines[++text->line_count] = c + 1;
        }
    }
}

// Return the string from `from` on, with what instructions OpSourceContinued behind it add.
static char *join(struct shader_memory *memory, const struct shader_module *module, uint32_t word,
                  uint32_t from)
{
    size_t size = 1;
    for (int pass = 0;; pass++) {
        char *const bytes = pass == 0 ? NULL : shader_take(memory, size, 1);
        size_t length = 0;
        uint32_t at = word, first = from;
        do {
            const char *const part = (const char *)(module->words + first);
            const size_t room = 4 * (size_t)((module->words[at] >> 16) - (first - at));
            const char *const end = memchr(part, 0, room);
            const size_t part_length = end ? (size_t)(end - part) : room;
            if (bytes) {
                memcpy(bytes + length, part, part_length);
            }
            length += part_length;
            at += module->words[at] >> 16;
            first = at + 1;
        } while (at < module->word_count && (module->words[at] & 0xffff) == SPIRV_OP_SourceContinued);
        if (bytes) {
            return bytes;
        }
        size = length + 1;
    }
}

static void find_texts(struct shader_memory *memory, struct shader_source_lines *lines)
{
    const struct shader_module *const module = lines->module;
    uint32_t count;
    for (uint32_t word = SPIRV_HEADER_WORDS; word < module->word_count; word += count) {
        const uint32_t opcode = module->words[word] & 0xffff;
        count = module->words[word] >> 16;
        if (opcode == SPIRV_OP_Source && count > 4) {
            struct source_text *const text = &lines->texts[lines->text_count++];
            text->file = module->words[word + 3];
            text->bytes = skip_preface(join(memory, module, word, word + 4));
            split(memory, text);
        } else if (opcode == SPIRV_OP_Function) {
            return;
        }
    }
}

struct shader_source_lines *shader_find_source_lines(struct shader_memory *memory,
                                                     const struct shader_module *module)
{
    uint32_t marks = 0, texts = 0, count;
    bool has_lines = false;
    for (uint32_t word = SPIRV_HEADER_WORDS; word < module->word_count; word += count) {
        const uint32_t opcode = module->words[word] & 0xffff;
        count = module->words[word] >> 16;
        has_lines = has_lines || opcode == SPIRV_OP_Line;
        marks += opcode == SPIRV_OP_Line || ends_block(opcode) ? 1 : 0;
        texts += opcode == SPIRV_OP_Source && count > 4 ? 1 : 0;
    }
    if (!has_lines) {
        return NULL;
    }
    struct shader_source_lines *const lines = shader_take(memory, 1, sizeof *lines);
    lines->module = module;
    lines->marks = shader_take(memory, marks, sizeof *lines->marks);
    lines->texts = shader_take(memory, texts, sizeof *lines->texts);
    find_marks(lines);
    find_texts(memory, lines);
    return lines;
}

// Return the last mark at or before a word, or NULL.
static const struct source_mark *find_mark(const struct shader_source_lines *lines, uint32_t word)
{
    uint32_t low = 0, high = lines->mark_count;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (lines->marks[middle].word <= word) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low > 0 ? &lines->marks[low - 1] : NULL;
}

static const char *name_of_file(const struct shader_module *module, uint32_t file)
{
    const bool is_string = file < module->bound && module->ids[file].opcode == SPIRV_OP_String;
    return is_string ? (const char *)(module->words + module->ids[file].word + 2) : "?";
}

// Print a line of a text without the spaces that it begins with.
static void print_text(const struct shader_sink *sink, const struct shader_source_lines *lines, uint32_t file,
                       uint32_t line)
{
    for (uint32_t i = 0; i < lines->text_count; i++) {
        const struct source_text *const text = &lines->texts[i];
        if (text->file == file && line <= text->line_count) {
            const char *const bytes = text->lines[line] + strspn(text->lines[line], " \t");
            const size_t length = strcspn(bytes, "\r\n");
            shader_sink_print(sink, "  %.*s", (int)(length > 160 ? 160 : length), bytes);
            return;
        }
    }
}

void shader_print_source_line(const struct shader_sink *sink, struct shader_source_lines *lines,
                              uint32_t word, int indent)
{
    const struct source_mark *const mark = word != 0 ? find_mark(lines, word) : NULL;
    if (!mark || mark->line == 0 || (mark->file == lines->file && mark->line == lines->line)) {
        return;
    }
    lines->file = mark->file;
    lines->line = mark->line;
    shader_sink_print(sink, "%*s; %.200s:%u", indent, "", name_of_file(lines->module, mark->file),
                      (unsigned)mark->line);
    print_text(sink, lines, mark->file, mark->line);
    shader_sink_print(sink, "\n");
}
